#include "framing_help.h"

#include <cglm/cglm.h>
#include <math.h>

enum { TIMES = 97 };

static float reach_of_item(const struct gn_pose *pose, uint32_t item, mat4 view_from_world,
                           const struct gn_framing *framing, float aspect) {
    const struct gn_scene *scene = pose->scene;
    const struct gn_geometry *g = &scene->geometries[scene->items[item].geometry];
    const float slope = tanf(framing->camera.yfov_rad / 2);
    float most = 0;
    for (uint32_t i = 0; i < g->index_count; i++) {
        const uint32_t vertex = scene->buffers.indices[g->first_index + i];
        vec3 p;
        gn_pose_corner(pose, item, vertex, p);
        glm_mat4_mulv3(view_from_world, p, 1, p);
        if (-p[2] < framing->camera.near_m || -p[2] > framing->camera.far_m) return INFINITY;
        const float x = fabsf(p[0]) / (-p[2] * slope * aspect), y = fabsf(p[1]) / (-p[2] * slope);
        most = fmaxf(most, fmaxf(x, y));
    }
    return most;
}

/* As the turntable has it. */
static void turn_view(const struct gn_scene *scene, float angle_rad, mat4 view_from_world) {
    vec3 centre, back;
    glm_vec3_center((float *)scene->box.min, (float *)scene->box.max, centre);
    glm_vec3_negate_to(centre, back);
    glm_translate(view_from_world, centre);
    glm_rotate_y(view_from_world, -angle_rad, view_from_world);
    glm_translate(view_from_world, back);
}

float help_framing_reach(const struct gn_scene *scene, int clips,
                         const struct gn_framing_opts *opts) {
    struct gn_pose pose;
    int64_t longest_ns = 0;
    float most = 0;
    for (uint32_t i = 0; i < scene->animation.clip_count; i++)
        if (scene->animation.clips[i].duration_ns > longest_ns)
            longest_ns = scene->animation.clips[i].duration_ns;
    gn_pose_init(&pose, scene, clips);
    for (int t = 0; t < (pose.animated || opts->turns ? TIMES : 1); t++) {
        struct gn_framing framing;
        gn_pose_step(&pose, 2 * longest_ns / TIMES * t); /* twice: clips may differ in length */
        gn_framing_build(&pose, scene->camera_count - 1, opts, &framing);
        if (opts->turns) turn_view(scene, 2 * GLM_PIf * (float)t / TIMES, framing.view_from_world);
        for (uint32_t i = 0; i < scene->item_count; i++)
            if (pose.items[i].visible)
                most = fmaxf(
                    most, reach_of_item(&pose, i, framing.view_from_world, &framing, opts->aspect));
    }
    gn_pose_finish(&pose);
    return most;
}
