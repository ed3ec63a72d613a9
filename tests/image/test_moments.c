/* Filtered maps: how much light two casters, one behind the other, let through where there is none;
 * that contacts are dark; that no texel is ever anything but a number; and that a still scene is
 * filtered once. GN_FULL=1: every storage, and a thousand frames. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "gl/private.h"
#include "image/shot.h"
#include "plan/stage_scene.h"
#include "truth/raycast.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

static struct help_stage stage;

static void close_stage(void) { help_stage_close(&stage); }

/* A lamp 9 m above the ground, large enough for the widest blur; what is in its way: nodes with
 * mesh 0 (a square of 2 m, in y = 0) or 1 (a cube); the eye at x and y, looking down. */
static struct gn_scene *make_scene(const char *things, int count, const char *eye, double light_x) {
    struct gn_maker m;
    struct gn_err err = {0};
    char nodes[1500], roots[80] = "[{'nodes':[0,1,2";
    gn_maker_init(&m);
    gn_maker_square(&m);
    gn_maker_cube(&m);
    snprintf(nodes, sizeof nodes,
             "[{'mesh':0,'scale':[12,1,12]},{'camera':0,%s},{'translation':[%g,9,0],"
             "'rotation':[-0.70710678,0,0,0.70710678],"
             "'extensions':{'KHR_lights_punctual':{'light':0}}},%s]",
             eye, light_x, things);
    gn_maker_set(&m, "nodes", nodes);
    for (int i = 0; i < count; i++) snprintf(roots + strlen(roots), 4, ",%d", 3 + i);
    strcat(roots, "]}]");
    gn_maker_set(&m, "scenes", roots);
    gn_maker_set(&m, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&m, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':300,'spot':"
                 "{'innerConeAngle':1.0,'outerConeAngle':1.1},'extras':{'gnomon_radius':2}}]}}");
    gn_maker_set(&m, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.84,'znear':0.05,'zfar':60}}]");
    struct gn_scene *scene = gn_maker_load(&m, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Two half-planes, 1 m and 3 m up, whose edges are half a metre apart; the eye is below them. */
static struct gn_scene *make_two(void) {
    return make_scene("{'mesh':0,'translation':[-1.25,1,0],'scale':[1.75,1,3]},"
                      "{'mesh':0,'translation':[-1.5,3,0],'scale':[1.5,1,3]}",
                      2, "'translation':[0.28,0.9,0],'rotation':[-0.70710678,0,0,0.70710678]", 0);
}

/* A thin wall under a lamp aside; seen from above, its shadow lies at larger x. */
static struct gn_scene *make_wall(void) {
    return make_scene("{'mesh':1,'translation':[0,0.5,0],'scale':[0.01,0.5,1.5]}", 1,
                      "'translation':[0.6,3,0],'rotation':[-0.70710678,0,0,0.70710678]", -6);
}

enum { WIDTH = 960, HEIGHT = 720 };
static float picture[4 * WIDTH * HEIGHT];

static const struct gn_plan *draw(enum gn_technique technique, enum gn_moments moments) {
    const struct gn_frame_opts opts = {
        .output.width_px = WIDTH,
        .output.height_px = HEIGHT,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = technique,
                       .map_px = 1024,
                       .map_format = GN_MAP_FORMAT(GN_ENCODING_AUTO, moments)},
        .debug.aov = GN_AOV_VISIBILITY};
    struct gn_err err = {0};
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (!gn_gl_read_f32(stage.gl, picture, &err)) fail_msg("%s", err.text);
    return plan;
}

/* x and z of what the pixels see of the ground; NAN: something else. */
static double ground[WIDTH * HEIGHT][2];

static void find_ground(void) {
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    gn_raycast_init(&rays, stage.scene, &stage.pose, NULL);
    gn_ray_eye_init(&eye, &stage.pose, 0, WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        struct gn_ray_surface s;
        const bool found = gn_raycast_eye(&rays, &eye, i % WIDTH, i / WIDTH, &s);
        const bool is_ground = found && fabs(s.point_ws[1]) < 1e-6;
        ground[i][0] = is_ground ? s.point_ws[0] : (double)NAN;
        ground[i][1] = is_ground ? s.point_ws[2] : (double)NAN;
    }
    gn_raycast_finish(&rays);
}

/* ---- two casters ---- */

struct leak {
    double filter_m;          /* the filter's radius on the ground */
    double dark, band, worst; /* sums of what is seen: of all that is dark; where the upper edge is
                                 within the filter; and the most there */
    long dark_count, band_count;
    double lit;
    long lit_count;
};

/* The lower half-plane ends at x = .5, which from 9 m falls to .5 9/8; the upper one's edge at 0.
 */
static void see_two(double x, double seen, struct leak *leak) {
    const double edge = 0.5 * 9 / 8, beyond = x - edge;
    assert_true(isfinite(seen) && seen >= 0 && seen <= 1);
    if (beyond > leak->filter_m) leak->lit += seen, leak->lit_count++;
    if (beyond > -leak->filter_m) return;
    leak->dark += seen;
    leak->dark_count++;
    if (fabs(x) > leak->filter_m) return;
    leak->band += seen;
    leak->band_count++;
    leak->worst = fmax(leak->worst, seen);
}

static struct leak leak_of(enum gn_technique technique, enum gn_moments moments, const char *what) {
    const struct gn_plan *plan = draw(technique, moments);
    const struct gn_shadow_view *view = &plan->shadows[0];
    struct leak leak = {.filter_m =
                            9 * (double)(view->lookup.texel * (view->penumbra.blur_px + 1.0f))};
    assert_true(view->penumbra.blur_px == GN_BLUR_MOST_PX); /* nine texels wide */
    assert_int_equal(view->moments, moments);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        if (!isnan(ground[i][0])) see_two(ground[i][0], (double)picture[4 * i], &leak);
    assert_true(leak.dark_count > 100000 && leak.band_count > 2000 && leak.lit_count > 10000);
    leak.dark /= (double)leak.dark_count;
    leak.band /= (double)leak.band_count;
    leak.lit /= (double)leak.lit_count;
    print_message("%-5s %-13s %-18s dark %.5f, over the upper edge %.4f, at most %.4f; lit %.4f\n",
                  gn_techniques[technique].name, gn_moments[moments].name, what, leak.dark,
                  leak.band, leak.worst, leak.lit);
    assert_true(leak.lit > 0.999);
    return leak;
}

/* Shaders in which vsm cuts nothing off. */
static struct leak leak_of_plain_vsm(void) {
    const char *folder = help_folder();
    struct gn_err err = {0};
    char command[400];
    snprintf(command, sizeof command,
             "cp -r shaders_es/. '%s' && sed -i 's/VSM_BLEED = 0.2;/VSM_BLEED = 0.0;/' "
             "'%s/shadow/vsm.glsl' && grep -q 'VSM_BLEED = 0.0;' '%s/shadow/vsm.glsl'",
             folder, folder, folder);
    assert_int_equal(system(command), 0);
    gn_gl_destroy(stage.gl);
    stage.gl = help_gl(&stage.display, &(struct gn_gl_opts){.shaders = folder}, NULL);
    if (!gn_gl_load(stage.gl, stage.scene, &err)) fail_msg("%s", err.text);
    const struct leak leak = leak_of(GN_TECHNIQUE_VSM, GN_MOMENTS_RG32UI, "without reduction");
    help_remove(folder);
    return leak;
}

static void test_two_casters_let_little_through(void **state) {
    (void)state;
    help_stage_open(&stage, make_two, "egl", NULL, NULL);
    find_ground();
    struct leak leaks[GN_TECHNIQUE_COUNT] = {0};
    for (int t = GN_TECHNIQUE_VSM; t <= GN_TECHNIQUE_MSM; t++)
        for (int i = 0; i < GN_STORES_MAX && gn_techniques[t].stores[i]; i++) {
            const struct leak leak =
                leak_of((enum gn_technique)t, (enum gn_moments)gn_techniques[t].stores[i], "");
            if (i == 0) leaks[t] = leak;
        }
    const struct leak plain = leak_of_plain_vsm();
    assert_true(plain.band > 0.1); /* there is something to be kept out */
    assert_true(leaks[GN_TECHNIQUE_VSM].band < plain.band);
    assert_true(leaks[GN_TECHNIQUE_MSM].band <= plain.band / 5);
    assert_true(leaks[GN_TECHNIQUE_EVSM].band <= plain.band / 5);
    close_stage();
}

/* ---- contacts ---- */

enum { ROWS = 12 }; /* a texel each, from the wall on */

static void see_contact(double texel_m, double most[ROWS]) {
    for (int i = 0; i < ROWS; i++) most[i] = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double row = (ground[i][0] - 0.01) / texel_m;
        if (!(row >= 0 && row < ROWS && fabs(ground[i][1]) < 1)) continue;
        most[(int)row] = fmax(most[(int)row], (double)picture[4 * i]);
    }
}

static void test_contacts_are_dark(void **state) {
    (void)state;
    help_stage_open(&stage, make_wall, "egl", NULL, NULL);
    find_ground();
    for (int t = GN_TECHNIQUE_EVSM; t <= GN_TECHNIQUE_MSM; t++) {
        const enum gn_technique technique = (enum gn_technique)t;
        double most[ROWS];
        const struct gn_plan *plan = draw(technique, (enum gn_moments)gn_techniques[t].stores[0]);
        see_contact(9 * (double)plan->shadows[0].lookup.texel, most);
        print_message("%-5s at most, by texels from the wall:", gn_techniques[t].name);
        for (int i = 0; i < ROWS; i++) print_message(" %.4f", most[i]);
        print_message("\n");
        for (int i = 0; i < ROWS; i++) assert_true(most[i] < 0.5 / 255);
    }
    close_stage();
}

/* ---- numbers ---- */

static uint64_t seed = 88172645463325252u;
static float chance(float from, float to) {
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return from + (to - from) * (float)(seed >> 40) / (float)(1 << 24);
}

/* The light's texture, as its bits. */
static void expect_numbers(uint32_t slot, const struct gn_shadow_view *view, GLuint *bits) {
    const struct gn_gl_map *map = gn_gl_view_find(stage.gl, view, slot, true);
    assert_non_null(map);
    gn_gl_bind_framebuffer(stage.gl, map->framebuffer);
    GL(stage.gl, ReadPixels)
    (0, 0, (GLsizei)view->map.width_px, (GLsizei)view->map.height_px, GL_RGBA_INTEGER,
     GL_UNSIGNED_INT, bits);
    for (uint32_t i = 0; i < 4 * view->map.width_px * view->map.height_px; i++) {
        float value;
        memcpy(&value, &bits[i], sizeof value);
        if (!isfinite(value) || fabsf(value) > 1e36f)
            fail_msg("texel %u of map %u is %g", i / 4, slot, (double)value);
    }
}

static void test_no_texel_is_anything_but_a_number(void **state) {
    (void)state;
    enum { MAP = 64, W = 48, H = 32 };
    static GLuint bits[4 * 3 * MAP * 2 * MAP];
    static float seen[4 * W * H];
    const int frames = gn_shot_full() ? 1000 : 60;
    help_stage_open(&stage, gn_stage_scene_make, "egl", NULL, NULL);
    for (int n = 0; n < frames; n++) {
        const int light = n % 3;
        struct gn_frame_opts opts = {
            .output.width_px = W,
            .output.height_px = H,
            .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                           .technique = GN_TECHNIQUE_VSM + n / 3 % 3,
                           .map_px = MAP},
            .debug.light = light,
            .debug.aov = GN_AOV_VISIBILITY};
        struct gn_err err = {0};
        opts.view.orbit.yaw_rad = chance(-3, 3);
        opts.view.orbit.pitch_rad = chance(-0.2f, 1);
        opts.view.orbit.zoom = chance(-1, 1.5f);
        gn_pose_step(&stage.pose, (int64_t)(1e9f * chance(0, 4)));
        vec4 *node = stage.pose.world_from_node[stage.scene->lights[light].node];
        glm_rotate(node, chance(-0.3f, 0.3f), (vec3){chance(-1, 1), chance(-1, 1), 0.5f});
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        if (!gn_gl_read_f32(stage.gl, seen, &err)) fail_msg("%s", err.text);
        for (int i = 0; i < W * H; i++)
            if (!(seen[4 * i] >= 0 && seen[4 * i] <= 1))
                fail_msg("frame %d: a pixel is %g", n, (double)seen[4 * i]);
        for (uint32_t slot = 0; slot < plan->shadow_count; slot++)
            if (gn_moments[plan->shadows[slot].moments].file &&
                opts.shadow.any.technique ==
                    GN_TECHNIQUE_EVSM) /* the others' integers are all numbers */
                expect_numbers(slot, &plan->shadows[slot], bits);
    }
    close_stage();
}

/* ---- what samplers weigh ---- */

static void read_level(const struct gn_gl_map *map, GLint level, float *out) {
    gn_gl_bind_framebuffer(stage.gl, map->framebuffer);
    GL(stage.gl, FramebufferTexture2D)
    (GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map->texture, level);
    GL(stage.gl, ReadPixels)
    (0, 0, (GLsizei)map->width_px >> level, (GLsizei)map->height_px >> level, GL_RGBA, GL_FLOAT,
     out);
    GL(stage.gl, FramebufferTexture2D)
    (GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map->texture, 0);
}

/* After each change: a half of a map that moved is worse than none. */
static void test_mipmaps_are_means_of_the_map(void **state) {
    (void)state;
    enum { SIDE = 256 };
    static float whole[4 * SIDE * SIDE], half[4 * SIDE * SIDE / 4];
    const struct gn_frame_opts opts = {
        .output.width_px = 64,
        .output.height_px = 48,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = GN_TECHNIQUE_VSM,
                       .map_px = SIDE,
                       .map_format = GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA16F)},
        .shadow.cascades = 1};
    help_stage_open(&stage, gn_stage_scene_make, "egl", NULL, NULL);
    for (int frame = 0; frame < 3; frame++) {
        gn_pose_step(&stage.pose, (int64_t)frame * 500000000);
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        for (uint32_t slot = 0; slot < plan->shadow_count; slot++) {
            const struct gn_shadow_view *view = &plan->shadows[slot];
            const struct gn_gl_map *map = gn_gl_view_find(stage.gl, view, slot, true);
            assert_int_equal(map->mipmaps, view->map.tile_count == 1); /* tiles have neighbours */
            if (!map->mipmaps) continue;
            read_level(map, 0, whole);
            read_level(map, 1, half);
            double most = 0, varies = 0;
            for (int i = 0; i < SIDE * SIDE; i++) { /* i / 4: of the half; i % 4: the number */
                const int x = i / 4 % (SIDE / 2), y = i / 4 / (SIDE / 2);
                const float *at = &whole[4 * (2 * y * SIDE + 2 * x) + i % 4];
                const double mean = 0.25 * ((double)at[0] + (double)at[4] + (double)at[4 * SIDE] +
                                            (double)at[4 * SIDE + 4]);
                most = fmax(most, fabs(mean - (double)half[i]));
                varies = fmax(varies, fabs((double)half[i] - (double)half[i % 4]));
            }
            assert_true(most < 1e-3); /* a step of half floats */
            assert_true(varies > 0.1);
        }
    }
    close_stage();
}

/* ---- nothing moves ---- */

static void test_a_still_scene_is_filtered_once(void **state) {
    (void)state;
    help_stage_open(&stage, gn_stage_scene_make, "egl", NULL, NULL);
    for (int t = GN_TECHNIQUE_VSM; t <= GN_TECHNIQUE_MSM; t++) {
        const struct gn_frame_opts opts = {
            .output.width_px = 64,
            .output.height_px = 48,
            .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                           .technique = (enum gn_technique)t,
                           .map_px = 64}};
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        assert_int_equal(plan->shadow_count, 3);
        const struct gn_gl_stats stats = gn_gl_stats(stage.gl);
        assert_true(stats.shadow_draws >= 2 * 8); /* two passes for each of 1 + 1 + 6 tiles */
        help_stage_draw(&stage, &opts, NULL);
        assert_int_equal(gn_gl_stats(stage.gl).shadow_draws, 0);
    }
    close_stage();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_casters_let_little_through),
        cmocka_unit_test(test_contacts_are_dark),
        cmocka_unit_test(test_no_texel_is_anything_but_a_number),
        cmocka_unit_test(test_mipmaps_are_means_of_the_map),
        cmocka_unit_test(test_a_still_scene_is_filtered_once),
    };
    return RUN(tests);
}
