/* Whether `gnomon bake` would help, and by how much. */

#include "bake/bake.h"
#include "cli/inspect.h"
#include "cli/units.h"
#include "core/model.h"

#define LEAST_BYTES (4.0 * 1024 * 1024) /* less is not worth a word */
#define LEAST_SHARE .3

/* GPU memory of the pictures over the limit, now and then. */
static uint32_t count_large_images(const struct gn_scene *scene, double *before, double *after) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->pictures.image_count; i++) {
        const struct gn_image *image = &scene->pictures.images[i];
        const uint32_t px = image->width_px > image->height_px ? image->width_px : image->height_px;
        if (px <= GN_BAKE_TEXTURE_PX || image->levels) continue; /* KTX2 stays as it is */
        const double scale = (double)GN_BAKE_TEXTURE_PX / px;
        const double bytes = (double)gn_scene_image_bytes(image);
        *before += bytes;
        *after += bytes * scale * scale;
        count++;
    }
    return count;
}

static void advise_images(struct gn_inspection *in) {
    double before = 0, after = 0;
    const uint32_t count = count_large_images(in->scene, &before, &after);
    if (count)
        gn_problem_add(&in->advice, "gnomon bake scales them down (--texture-limit)",
                       "%u picture%s larger than %d pixels take%s %.0f MB of GPU memory, %.0f MB "
                       "at that size",
                       count, count == 1 ? "" : "s", GN_BAKE_TEXTURE_PX, count == 1 ? "s" : "",
                       GN_MB(before), GN_MB(after));
}

void gn_inspect_advise_bake(struct gn_inspection *in, const char *path,
                            const struct gn_scene_limits *limits) {
    struct gn_bytes bytes = {0};
    struct gn_bake_estimate e;
    const struct gn_bake_opts opts = {.path = path, .limits = limits};
    if (!gn_bake_is_built()) return;
    advise_images(in);
    if (!path || !gn_model_is_gltf(path)) return;
    if (gn_file_read(path, (size_t)limits->file_mb << 20, &bytes, NULL) &&
        gn_bake_estimate(&opts, bytes.data, bytes.size, &e) &&
        e.bytes - e.bytes_baked > LEAST_BYTES && e.bytes_baked < (1 - LEAST_SHARE) * e.bytes)
        gn_problem_add(&in->advice, "gnomon bake makes a smaller file that loads faster",
                       "meshes take %.1f MB of the file, %.1f MB would do", GN_MB(e.bytes),
                       GN_MB(e.bytes_baked));
    gn_bytes_finish(&bytes);
}
