/* Soft shadows as an eye sees them: pictures of a technique against rays, measured by truth/tear.h,
 * of the scenes of penumbra.h and of the default picture: a model without lights in the studio, on
 * its unseen floor. */
#ifndef GN_IMAGE_SOFT_H
#define GN_IMAGE_SOFT_H

#include <stdio.h>

#include "image/penumbra.h"
#include "truth/tear.h"

/* After the scenes of penumbra.h: a trellis, a table and a box. */
enum { GN_SOFT_DEFAULT = GN_PENUMBRA_ALL, GN_SOFT_SCENES };

struct gn_soft { /* a scene and its truth */
    int scene, width_px, height_px;
    char *path;
    struct gn_picture truth; /* grey */
    struct gn_tear tear;
};
/* Writes the scene and casts its rays: seconds. False: nothing to finish. */
bool gn_soft_init(struct gn_soft *soft, int scene, int width_px, int height_px, struct gn_err *err);
void gn_soft_finish(struct gn_soft *soft);
/* Visibility by a technique, as a user draws it. */
bool gn_soft_shoot(const struct gn_soft *soft, const char *technique, struct gn_picture *shot,
                   struct gn_err *err);
void gn_soft_compare(const struct gn_soft *soft, const struct gn_picture *shot,
                     struct gn_tear_score score[GN_TEAR_PARTS]);

/* A table of techniques over all scenes, by kinds of light; seconds for each scene and technique.
 * csv: the same as lines of gn_table_print_csv(), or NULL. Returns how many pictures there are not.
 */
int gn_soft_table(const char *const techniques[], int count, int width_px, int height_px, FILE *to,
                  FILE *csv);

#endif
