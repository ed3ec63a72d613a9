/* The truth of a small picture: rays of a larger one, averaged. Without image/picture.h, whose name
 * is another one of the options. */
#ifndef GN_IMAGE_FINE_H
#define GN_IMAGE_FINE_H

#include "core/err.h"

/* Green, as a file encodes it, 0..1, row 0 on top: of FINE x FINE rays' pixels each. */
enum { GN_FINE = 8 };
bool gn_fine_truth(const char *scene_path, const char *exposure, int width_px, int height_px,
                   float *out, struct gn_err *err);
/* The picture of a .png that gnomon renders, likewise; args end with NULL. */
bool gn_fine_shot(const char *scene_path, const char *const args[], float *out, struct gn_err *err);
/* gn_penumbra_write() and its name. */
char *gn_fine_write(int scene, const char **name, struct gn_err *err);
enum { GN_FINE_SUN, GN_FINE_SPOT, GN_FINE_POINT, GN_FINE_SCENES };

#endif
