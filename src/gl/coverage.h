/* Alpha of smaller pictures of a mask, so that as much of them is at or over the cutoff as of the
 * whole picture: the mean of alphas is under the cutoff where a mask is fine, and leaves dissolve
 * with distance. After Castano, "Computing alpha mipmaps", 2010, but for the surface between texels
 * that a sampler sees instead of texels. No GL. */
#ifndef GN_GL_COVERAGE_H
#define GN_GL_COVERAGE_H

#include <stdbool.h>
#include <stdint.h>

struct gn_coverage {
    float cutoff; /* of texels, over 0 */
    float share;  /* of the whole picture that is at or over it */
};
struct gn_coverage_level { /* a picture of four bytes a pixel */
    const uint8_t *rgba;
    uint32_t px[2];
    const uint8_t *alpha; /* 256: what takes the place of each alpha; NULL: it stays */
};
/* Takes a bounded number of samples, as the next does. */
struct gn_coverage gn_coverage_measure(float cutoff, const struct gn_coverage_level *whole);
/* Fills the alpha that takes the place of each of a smaller picture, by which it has the share.
 * larger: the level before, or NULL. Samplers mix both, and what is halfway between has less of a
 * mask than either has: then their mean has the share. */
void gn_coverage_fit(const struct gn_coverage *coverage, const struct gn_coverage_level *larger,
                     const struct gn_coverage_level *level, uint8_t alpha[256]);

#endif
