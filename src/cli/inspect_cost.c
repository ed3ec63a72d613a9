/* What a scene costs: passes, draws and bytes of its default view, from its plan. */
#include <string.h>

#include "cli/inspect.h"
#include "frame/frame.h"

/* Side of the pages of a map; 0 without. */
static uint64_t page_px(const struct gn_shadow_view *view) {
    return (view->map.cascade_count > 0 && !view->empty) || view->raster.drawn.paged
               ? view->map.tile_px
               : 0;
}

/* The bytes of a shadow map, of the pages that it is drawn into and of what it is filtered into.
 * Lights share pages of one kind, and the target between the steps of a filter. */
static uint64_t shadow_bytes(const struct gn_plan *plan, uint32_t slot) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    const uint64_t texels = (uint64_t)view->map.width_px * view->map.height_px;
    const uint64_t texel_bytes = gn_encodings[view->encoding].texel_bytes;
    const uint64_t filtered = texels * gn_moments[view->moments].texel_bytes;
    uint64_t pages = page_px(view) * page_px(view) * texel_bytes, between = filtered;
    for (uint32_t i = 0; i < slot; i++) {
        const struct gn_shadow_view *other = &plan->shadows[i];
        if (other->encoding == view->encoding && page_px(other) == page_px(view)) pages = 0;
        if (other->moments == view->moments && other->map.width_px == view->map.width_px &&
            other->map.height_px == view->map.height_px)
            between = 0;
    }
    const uint64_t mipmaps = gn_view_has_mipmaps(view) ? filtered / 3 : 0;
    return texels * texel_bytes + pages + filtered + mipmaps + between;
}

struct image_use {
    bool as[2]; /* data, colour */
    bool mipmaps;
};

static void use_image(struct image_use *use, const struct gn_scene *scene, uint32_t image,
                      int32_t texture, bool color) {
    if (texture < 0 || scene->pictures.textures[texture].image != image) return;
    use->as[color] = true;
    use->mipmaps |= scene->pictures.textures[texture].mipmaps;
}

uint64_t gn_inspect_image_bytes(const struct gn_scene *scene, uint32_t image) {
    struct image_use use = {0};
    for (uint32_t i = 0; i < scene->material_count; i++)
        for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
            use_image(&use, scene, image, scene->materials[i].textures[slot].texture,
                      gn_texture_slots[slot].texels == GN_TEXELS_SRGB);
    for (uint32_t i = 0; i < scene->light_count; i++)
        use_image(&use, scene, image, scene->lights[i].slide, true);
    uint64_t pixels =
        (uint64_t)scene->pictures.images[image].width_px * scene->pictures.images[image].height_px;
    return (uint64_t)(use.as[0] + use.as[1]) * (pixels * 4 * (use.mipmaps ? 4 : 3) / 3);
}

void gn_inspect_build(struct gn_inspection *in, const char *file, const struct gn_scene *scene,
                      const struct gn_warnings *warnings) {
    *in = (struct gn_inspection){.file = file, .scene = scene, .warnings = warnings};
    const struct gn_caps caps = {
        .has = (1u << GN_CAP_COUNT) - 1, .max_texture_px = 16384, .max_texture_units = 16};
    const struct gn_frame_opts opts = {.width_px = GN_INSPECT_WIDTH_PX,
                                       .height_px = GN_INSPECT_HEIGHT_PX,
                                       .shadow.encoding = GN_ENCODING_AUTO};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    struct gn_frame *frame = gn_frame_create(scene, &caps);
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        const bool shadow = pass->kind != GN_PASS_PICTURE;
        uint64_t triangles = 0;
        for (uint32_t k = 0; k < pass->draw_count; k++) {
            const struct gn_draw *draw = &plan->draws[pass->first_draw + k];
            uint32_t corners = draw->geometry == GN_NO_GEOMETRY
                                   ? draw->vertex_count
                                   : scene->geometries[draw->geometry].index_count;
            triangles += (uint64_t)corners / 3 * draw->instance_count;
        }
        *(shadow ? &in->cost.shadow_passes : &in->cost.passes) += 1;
        *(shadow ? &in->cost.shadow_draws : &in->cost.draws) += pass->draw_count;
        *(shadow ? &in->cost.shadow_triangles : &in->cost.triangles) += triangles;
    }
    for (uint32_t i = 0; i < plan->shadow_count; i++) in->cost.map_bytes += shadow_bytes(plan, i);
    in->cost.programs = plan->program_count;
    in->cost.culled = plan->culled;
    in->cost.target_bytes = (uint64_t)GN_INSPECT_WIDTH_PX * GN_INSPECT_HEIGHT_PX * 8;
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);

    in->cost.vertex_bytes = (uint64_t)gn_scene_vertex_bytes(scene) * scene->buffers.vertex_count;
    /* as gl/ lays them out: indices have 16 bits where that is enough */
    in->cost.index_bytes =
        (uint64_t)scene->buffers.index_count * (scene->buffers.vertex_count > 65536 ? 4 : 2);
    for (uint32_t i = 0; i < scene->pictures.image_count; i++)
        in->cost.texture_bytes += gn_inspect_image_bytes(scene, i);
    gn_inspect_advise(in);
}
