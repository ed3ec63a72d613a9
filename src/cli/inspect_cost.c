/* What a scene costs: passes, draws and bytes of its default view, from its plan. */
#include <string.h>

#include "cli/inspect.h"
#include "frame/frame.h"

void gn_inspect_build(struct gn_inspection *in, const char *file, const struct gn_scene *scene,
                      const struct gn_frame_shadow_opts *shadow, struct gn_warnings *warnings) {
    *in = (struct gn_inspection){.file = file, .scene = scene, .warnings = warnings};
    const struct gn_caps caps = {
        .has = (1u << GN_CAP_COUNT) - 1, .max_texture_px = 16384, .max_texture_units = 16};
    const struct gn_frame_opts opts = {.output.width_px = GN_INSPECT_WIDTH_PX,
                                       .output.height_px = GN_INSPECT_HEIGHT_PX,
                                       .shadow.triangles = shadow ? shadow->triangles : 0};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    struct gn_frame *frame = gn_frame_create(scene, &caps);
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, warnings);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        const bool shadow = pass->kind != GN_PASS_PICTURE;
        uint64_t drawn = 0;
        for (uint32_t k = 0; k < pass->draw_count; k++) {
            const struct gn_draw *draw = &plan->draws[pass->first_draw + k];
            uint32_t corners = draw->geometry == GN_NO_GEOMETRY
                                   ? draw->vertex_count
                                   : scene->geometries[draw->geometry].index_count;
            drawn += (uint64_t)corners / 3 * draw->instance_count;
        }
        *(shadow ? &in->cost.shadow_passes : &in->cost.passes) += 1;
        *(shadow ? &in->cost.shadow_draws : &in->cost.draws) += pass->draw_count;
        *(shadow ? &in->cost.shadow_triangles : &in->cost.triangles) += drawn;
    }
    in->cost.map_bytes = gn_plan_map_bytes(plan);
    in->cost.programs = plan->program_count;
    in->cost.culled = plan->culled;
    in->cost.target_bytes = (uint64_t)GN_INSPECT_WIDTH_PX * GN_INSPECT_HEIGHT_PX * 8;
    if (scene->added.light) {
        const uint32_t last = scene->light_count - 1;
        const struct gn_frame_opts used = {.shadow = shadow ? *shadow : opts.shadow};
        const struct gn_light_opts holds = gn_frame_light_opts(frame, &pose, &used, last);
        in->made_light = scene->lights[last];
        in->made_light.radius = holds.radius;
        memcpy(in->made_light.color, holds.color, sizeof holds.color);
    }
    for (uint32_t i = 0; i < scene->camera_count && i < GN_INSPECT_CAMERAS; i++) {
        const struct gn_frame_view_opts view = {.camera = (int)i};
        struct gn_framing framing;
        gn_frame_camera(&pose, &view, (float)GN_INSPECT_WIDTH_PX / GN_INSPECT_HEIGHT_PX, &framing);
        in->depths_m[i][0] = framing.camera.near_m;
        in->depths_m[i][1] = framing.camera.far_m;
    }
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);

    in->cost.vertex_bytes = (uint64_t)gn_scene_vertex_bytes(scene) * scene->buffers.vertex_count;
    in->cost.index_bytes = gn_scene_index_bytes(scene);
    for (uint32_t i = 0; i < scene->pictures.image_count; i++)
        in->cost.texture_bytes += gn_scene_image_bytes(&scene->pictures.images[i]);
    in->cost.texture_bytes += gn_scene_deformation_bytes(scene);
    gn_inspect_advise(in);
}
