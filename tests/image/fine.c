#include "image/fine.h"

#include <math.h>
#include <stdio.h>

#include "core/srgb.h"
#include "image/penumbra.h"
#include "image/shot.h"

bool gn_fine_truth(const char *scene_path, const char *exposure, int width_px, int height_px,
                   float *out, struct gn_err *err) {
    struct gn_picture truth;
    char size[32];
    snprintf(size, sizeof size, "%dx%d", GN_FINE * width_px, GN_FINE * height_px);
    if (!gn_shot(&truth, NULL, err, "pfm", scene_path,
                 (const char *const[]){"--size", size, "--shadow", "truth", "--exposure", exposure,
                                       NULL}))
        return false;
    for (int y = 0; y < height_px; y++)
        for (int x = 0; x < width_px; x++) {
            float sum = 0;
            for (int i = 0; i < GN_FINE * GN_FINE; i++)
                sum += fminf(
                    gn_picture_at(&truth, GN_FINE * x + i % GN_FINE, GN_FINE * y + i / GN_FINE)[1],
                    1);
            *out++ = gn_srgb_encode(sum / (GN_FINE * GN_FINE));
        }
    gn_picture_finish(&truth);
    return true;
}

bool gn_fine_shot(const char *scene_path, const char *const args[], float *out,
                  struct gn_err *err) {
    struct gn_picture shot;
    if (!gn_shot(&shot, NULL, err, "png", scene_path, args)) return false;
    for (int y = 0; y < shot.height_px; y++)
        for (int x = 0; x < shot.width_px; x++) *out++ = gn_picture_at(&shot, x, y)[1];
    gn_picture_finish(&shot);
    return true;
}

char *gn_fine_write(int scene, const char **name, struct gn_err *err) {
    static const int scenes[GN_FINE_SCENES] = {[GN_FINE_SUN] = GN_PENUMBRA_BARS,
                                               [GN_FINE_SPOT] = GN_PENUMBRA_BOX,
                                               [GN_FINE_POINT] = GN_PENUMBRA_BULB};
    *name = gn_penumbra_names[scenes[scene]];
    return gn_penumbra_write(scenes[scene], err);
}
