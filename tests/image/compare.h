/* Is the picture the expected one? Two ways to ask.
 *
 * Colour: how many pixels differ by more than so much (a tolerance is a largest difference and an
 * allowed share). Shadow masks: against truth, knowing about edges (truth/mask.h). */
#ifndef GN_IMAGE_COMPARE_H
#define GN_IMAGE_COMPARE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/picture.h"
#include "truth/mask.h"

struct gn_difference {
    double max;   /* largest difference of any channel */
    double share; /* of the pixels, those with a channel that differs by more than the tolerance;
                     0..1 */
    int worst_x, worst_y;
};
/* false if the sizes or channels differ (then max and share are infinite). NaN differs from all but
 * NaN. */
bool gn_compare(const struct gn_picture *a, const struct gn_picture *b, double tolerance,
                struct gn_difference *difference);

/* Writes <folder>/<name>-shot.png, -truth.png and -diff.png; folder is made if missing. NULL means
 * build/failures, and then the paths are printed on stdout. In the difference of masks red is acne,
 * blue is a leak, and pale red or blue the same on an edge; of colours it is |a - b| x 8. */
void gn_mask_save(const char *folder, const char *name, const struct gn_mask_truth *truth,
                  const struct gn_picture *shot);
void gn_compare_save(const char *folder, const char *name, const struct gn_picture *shot,
                     const struct gn_picture *expected);

#endif
