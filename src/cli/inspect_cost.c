/* What a scene costs: passes, draws and bytes of its default view, from its plan. */
#include <string.h>

#include "cli/inspect.h"
#include "frame/frame.h"

static void count_pass(struct gn_scene_cost *cost, const struct gn_plan *plan,
                       const struct gn_pass *pass) {
    bool shadow = pass->kind != GN_PASS_PICTURE;
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < pass->draw_count; i++) {
        const struct gn_draw *draw = &plan->draws[pass->first_draw + i];
        uint32_t corners = draw->geometry == GN_NO_GEOMETRY
                               ? draw->vertex_count
                               : plan->scene->geometries[draw->geometry].index_count;
        triangles += (uint64_t)corners / 3 * draw->instance_count;
    }
    *(shadow ? &cost->shadow_passes : &cost->passes) += 1;
    *(shadow ? &cost->shadow_draws : &cost->draws) += pass->draw_count;
    *(shadow ? &cost->shadow_triangles : &cost->triangles) += triangles;
}

static uint64_t map_bytes(const struct gn_shadow_view *view) {
    return (uint64_t)view->map.width_px * view->map.height_px *
           gn_encodings[view->encoding].texel_bytes;
}

/* Side of the pages of a map; 0: it has none. */
static uint64_t page_px(const struct gn_shadow_view *view) {
    return (view->map.cascade_count > 0 && !view->empty) || view->raster.drawn.paged
               ? view->map.tile_px
               : 0;
}

/* Where the pages of maps are drawn; those of one kind share it. */
static uint64_t pages_bytes(const struct gn_plan *plan, uint32_t slot) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    for (uint32_t i = 0; i < slot; i++)
        if (plan->shadows[i].encoding == view->encoding &&
            page_px(&plan->shadows[i]) == page_px(view))
            return 0;
    return page_px(view) * page_px(view) * gn_encodings[view->encoding].texel_bytes;
}

/* What a map is filtered into, and what that takes on the way: lights share it, too. */
static uint64_t moments_bytes(const struct gn_plan *plan, uint32_t slot) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    const uint64_t plain =
        (uint64_t)view->map.width_px * view->map.height_px * gn_moments[view->moments].texel_bytes;
    const uint64_t own = plain + (gn_view_has_mipmaps(view) ? plain / 3 : 0);
    for (uint32_t i = 0; i < slot; i++)
        if (plan->shadows[i].moments == view->moments &&
            plan->shadows[i].map.width_px == view->map.width_px &&
            plan->shadows[i].map.height_px == view->map.height_px)
            return own;
    return own + plain;
}

static void count_plan(struct gn_scene_cost *cost, const struct gn_scene *scene) {
    const struct gn_caps caps = {
        .has = (1u << GN_CAP_COUNT) - 1, .max_texture_px = 16384, .max_texture_units = 16};
    const struct gn_frame_opts opts = {.width_px = GN_INSPECT_WIDTH_PX,
                                       .height_px = GN_INSPECT_HEIGHT_PX,
                                       .shadow.encoding = GN_ENCODING_AUTO};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    struct gn_frame *frame = gn_frame_create(scene, &caps);
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    for (uint32_t i = 0; i < plan->pass_count; i++) count_pass(cost, plan, &plan->passes[i]);
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        cost->map_bytes +=
            map_bytes(&plan->shadows[i]) + pages_bytes(plan, i) + moments_bytes(plan, i);
    cost->programs = plan->program_count;
    cost->culled = plan->culled;
    cost->target_bytes = (uint64_t)GN_INSPECT_WIDTH_PX * GN_INSPECT_HEIGHT_PX * 8;
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
}

/* As gl/ lays them out: indices have 16 bits where that is enough. */
static void count_buffers(struct gn_scene_cost *cost, const struct gn_scene *scene) {
    cost->vertex_bytes = (uint64_t)gn_scene_vertex_bytes(scene) * scene->buffers.vertex_count;
    cost->index_bytes =
        (uint64_t)scene->buffers.index_count * (scene->buffers.vertex_count > 65536 ? 4 : 2);
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
    count_plan(&in->cost, scene);
    count_buffers(&in->cost, scene);
    for (uint32_t i = 0; i < scene->pictures.image_count; i++)
        in->cost.texture_bytes += gn_inspect_image_bytes(scene, i);
    gn_inspect_advise(in);
}
