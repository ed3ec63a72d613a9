/* Two scenes, triangle by triangle as they are drawn: how far the corners of the second are from
 * those of the first. Knows nothing of how the second was made: each triangle of the first is
 * compared with that of the second, of the same material, that is most alike. */
#ifndef GN_TESTS_FUZZ_DRAWN_H
#define GN_TESTS_FUZZ_DRAWN_H

#include "scene/pose.h"

/* What is allowed. Positions, along each axis of the mesh, in sizes of the mesh (its largest
 * extent); the angle of normals; texture coordinates as a material reads them. To each is added
 * what floats round. */
struct gn_drawn_promise {
    double position, normal_deg, uv;
};
struct gn_drawn_errors {
    size_t triangles, flat,
        missing; /* flat: so thin that they may be left out; missing: no triangle is near */
    struct gn_drawn_promise largest; /* less what floats round */
    double share;                    /* of the promise, the largest of the three */
};

/* Both at that time. posed: what skins and targets deform is compared as it is posed, with sizes of
 * the posed mesh, else as it is without them. */
struct gn_drawn_errors gn_drawn_compare(const struct gn_scene *first, const struct gn_scene *second,
                                        int64_t time_ns, bool posed,
                                        const struct gn_drawn_promise *promise);

#endif
