/* tool_turn OPTION.. SCENE: how often shadows are drawn again in a turn of the camera round a scene
 * in which nothing else moves. Options as of `gnomon render`. Per light its technique, its map, its
 * texels, and what each frame after the first draws and filters of it. */
#include <cglm/cglm.h>
#include <stdio.h>
#include <string.h>

#include "options/args.h"
#include "plan/fixture.h"
#include "plan/redrawn.h"
#include "stage/lights.h"
#include "stage/stage.h"

enum { FRAMES = 60, MOST_ARGS = 64 };

struct texels {
    float least, most;
};

static int quit(const char *text) {
    fprintf(stderr, "tool_turn: %s\n", text);
    return 1;
}

static void add_texels(const struct gn_plan *plan, struct texels *texels) {
    for (uint32_t i = 0; i < plan->shadow_count; i++) {
        const struct gn_shadow_view *view = &plan->shadows[i];
        const float texel = view->map.cascade_count ? view->cascades[0].texel : view->lookup.texel;
        if (view->empty) continue;
        if (texels[i].least == 0 || texel < texels[i].least) texels[i].least = texel;
        if (texel > texels[i].most) texels[i].most = texel;
    }
}

static void print(const struct gn_plan *plan, const char *name, const struct gn_redrawn *redrawn,
                  const struct texels *texels) {
    for (uint32_t i = 0; i < plan->shadow_count; i++) {
        const struct gn_shadow_view *view = &plan->shadows[i];
        const struct gn_light *light = &plan->scene->lights[view->light];
        printf("%-20.20s %-12.12s %-11s %-7s %u x %4u px, texel %.3g to %.3g: a frame draws %.2f "
               "passes, %.2f draws, %.2f of its filter\n",
               name, light->name, gn_light_types[light->type].name,
               gn_techniques[view->technique].name, view->map.tile_count, view->map.tile_px,
               (double)texels[i].least, (double)texels[i].most,
               (double)redrawn[i].passes / (FRAMES - 1), (double)redrawn[i].draws / (FRAMES - 1),
               (double)redrawn[i].filters / (FRAMES - 1));
    }
}

int main(int argc, char **argv) {
    static struct gn_kept kept[GN_ALL_SHADOWS_MAX];
    static struct gn_redrawn redrawn[GN_ALL_SHADOWS_MAX], first[GN_ALL_SHADOWS_MAX];
    static struct texels texels[GN_ALL_SHADOWS_MAX];
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    struct gn_options options;
    struct gn_stage_look look;
    char *args[MOST_ARGS + 1] = {"gnomon", "render"};
    if (argc < 2 || argc + 1 > MOST_ARGS) return quit("tool_turn OPTION.. SCENE");
    memcpy(args + 2, argv + 1, (size_t)(argc - 1) * sizeof *args);
    if (!gn_args_parse(&options, argc + 1, args, &warnings, &err)) return quit(err.text);
    struct gn_scene *scene = gn_stage_scene(options.settings, &warnings, &err);
    if (!scene || !gn_stage_look_build(&look, options.settings, scene, &warnings, &err))
        return quit(err.text);

    const struct gn_caps caps = {
        .has = GN_EVERY_CAP, .max_texture_px = 4096, .max_texture_units = 16};
    struct gn_plan_fixture f = {.scene = scene, .opts = look.frame_opts};
    const struct gn_plan *plan = NULL;
    gn_pose_init(&f.pose, scene, look.clips);
    gn_pose_step(&f.pose, options.settings->scene.time_ns);
    f.frame = gn_frame_create(scene, &caps);
    for (int i = 0; i < FRAMES; i++) {
        f.opts.view.turntable_rad = 2 * GLM_PIf * (float)i / FRAMES;
        gn_stage_aim(&f.pose, &f.opts, options.settings);
        plan = gn_plan_make(&f);
        gn_redrawn_add(plan, kept, i == 0 ? first : redrawn);
        add_texels(plan, texels);
    }
    const char *name = strrchr(argv[argc - 1], '/');
    print(plan, name ? name + 1 : argv[argc - 1], redrawn, texels);
    gn_plan_end(&f);
    gn_options_finish(&options);
    return 0;
}
