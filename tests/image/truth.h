/* The true picture of a scene's shadow (truth/sight.h), kept in build/truth-cache under the hash of
 * the scene file. */
#ifndef GN_IMAGE_TRUTH_H
#define GN_IMAGE_TRUTH_H

#include "image/compare.h"
#include "truth/sight.h"

/* At time 0, with the clips that are on by default. */
bool gn_truth_load(struct gn_truth *truth, const char *scene_path, const struct gn_truth_opts *opts,
                   struct gn_err *err);

#endif
