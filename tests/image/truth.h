/* The true picture of a scene's shadow (truth/sight.h), kept in build/truth-cache under the hash of
 * the scene file, and the gap at contacts. */
#ifndef GN_IMAGE_TRUTH_H
#define GN_IMAGE_TRUTH_H

#include "image/compare.h"
#include "truth/sight.h"

/* At time 0, with the clips that are on by default. */
bool gn_truth_load(struct gn_truth *truth, const char *scene_path, const struct gn_truth_opts *opts,
                   struct gn_err *err);

/* The gap at contacts. A contact is a dark pixel on a surface that faces the light, next to (and
 * not merely in front of) a surface that turns away from it: the foot of a wall on its shadow side.
 * Its gap is the way, as the light sees it, to the nearest dark pixel of the shot on the same item.
 */
struct gn_contact {
    int contacts;            /* pixels */
    double mean, p99, worst; /* texels */
};
void gn_truth_contact(const struct gn_truth *truth, const struct gn_picture *shot, unsigned map_px,
                      struct gn_contact *contact);

#endif
