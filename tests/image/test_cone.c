/* cone against truth, beside pcss, with the taps that both take by themselves: whole scenes, thin
 * blockers over low ones, feet of walls, and how many pixels take more than one read. The figures
 * are in src/shadow/README.md; test_penumbra has the formats. GN_FULL=1: all scenes. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/file.h"
#include "frame/frame.h"
#include "image/penumbra.h"
#include "image/shot.h"
#include "image/table.h"
#include "truth/raycast.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

/* Pictures: small ones, and those of README's table. */
enum { WIDTH = 240, HEIGHT = 180, PAGE_WIDTH = 480, PAGE_HEIGHT = 360 };
enum { PIXELS_MAX = PAGE_WIDTH * PAGE_HEIGHT };

static struct gn_display display;
static struct gn_gl *gl;

static int open_gl(void **state) {
    (void)state;
    help_open(&display, "egl");
    gl = help_gl(&display, NULL, NULL);
    return 0;
}

static int close_gl(void **state) {
    (void)state;
    gn_gl_destroy(gl);
    gn_display_close(&display);
    return 0;
}

/* ---- truth and pictures of a scene's first light ---- */

struct view {
    struct gn_scene *scene;
    struct gn_picture truth;  /* the share of the light that a pixel sees */
    int32_t item[PIXELS_MAX]; /* that it shows; -1: background */
};

/* radius 0: the light's own. */
static void view_init_of_size(struct view *v, struct gn_scene *scene, float radius, int width_px,
                              int height_px) {
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    v->scene = scene;
    if (radius > 0) scene->lights[0].radius = radius;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, 0);
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, 0, width_px, height_px);
    gn_ray_lamp_init(&lamp, &pose, 0);
    gn_picture_init(&v->truth, width_px, height_px, 1);
    gn_penumbra_cast(&rays, &eye, &lamp, v->truth.data);
    for (int i = 0; i < width_px * height_px; i++) {
        struct gn_ray_surface surface;
        const bool seen = gn_raycast_eye(&rays, &eye, i % width_px, i / width_px, &surface);
        v->item[i] = seen ? (int32_t)surface.item : -1;
    }
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
}

static void view_init(struct view *v, struct gn_scene *scene, float radius) {
    view_init_of_size(v, scene, radius, WIDTH, HEIGHT);
}

static void view_finish(struct view *v) {
    gn_picture_finish(&v->truth);
    gn_scene_destroy(v->scene);
}

static bool moves; /* what casts: cone maps are smaller then */

/* The light's visibility. */
static void shoot(const struct view *v, enum gn_technique technique, struct gn_picture *shot) {
    static float aov[4 * PIXELS_MAX];
    const struct gn_frame_opts opts = {
        .output.width_px = (uint32_t)v->truth.width_px,
        .output.height_px = (uint32_t)v->truth.height_px,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = technique,
                       .map_px = 1024},
        .debug.aov = GN_AOV_VISIBILITY};
    struct gn_err err = {0};
    struct gn_pose pose;
    gn_pose_init(&pose, v->scene, GN_POSE_DEFAULT);
    for (uint32_t i = 0; i < v->scene->item_count; i++) pose.items[i].moves |= moves;
    if (!gn_gl_load(gl, v->scene, &err)) fail_msg("%s", err.text);
    struct gn_frame *frame = gn_frame_create(v->scene, gn_gl_caps(gl));
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err) ||
        !gn_gl_read_f32(gl, aov, &err))
        fail_msg("%s", err.text);
    gn_picture_init(shot, v->truth.width_px, v->truth.height_px, 1);
    for (int i = 0; i < shot->width_px * shot->height_px; i++) shot->data[i] = aov[4 * i];
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
}

/* ---- surfaces that are wholly lit or wholly dark ---- */

/* Of the pixels near another thing (the feet of walls, above all): those of a surface wholly lit
 * round about that are darkened by more than a tenth, and those wholly dark that get as much. A
 * dot is a pixel of such a surface that differs as much from both of its neighbours in a row. */
struct sure {
    long feet, darkened, lightened, dots, pixels;
    double darkness;
};

static void add_sure(const struct view *v, const struct gn_picture *shot, struct sure *sure) {
    enum { REACH = 3, PIXELS = WIDTH * HEIGHT };
    for (int i = 0; i < PIXELS; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        if (v->item[i] < 0 || x < REACH || y < REACH || x >= WIDTH - REACH || y >= HEIGHT - REACH)
            continue;
        bool lit = true, dark = true, foot = false;
        for (int dy = -REACH; dy <= REACH; dy++)
            for (int dx = -REACH; dx <= REACH; dx++) {
                const int near = i + dy * WIDTH + dx;
                foot |= v->item[near] != v->item[i];
                if (v->item[near] != v->item[i]) continue;
                lit &= v->truth.data[near] >= 1;
                dark &= v->truth.data[near] <= 0;
            }
        if (!lit && !dark) continue;
        const float *at = &shot->data[i];
        sure->pixels++;
        sure->dots += v->item[i - 1] == v->item[i] && v->item[i + 1] == v->item[i] &&
                      fabsf(at[0] - at[-1]) > .1f && fabsf(at[0] - at[1]) > .1f;
        if (!foot) continue;
        sure->feet++;
        sure->darkened += lit && *at < .9f;
        sure->lightened += dark && *at > .1f;
        if (lit) sure->darkness += 1 - (double)*at;
    }
}

static void print_sure(const char *name, const struct sure *s) {
    printf("%-5s feet: %ld pixels, darkened %.3f %%, mean %.4f %%, lightened %.3f %%; dots %.4f %% "
           "of %ld\n",
           name, s->feet, 100.0 * (double)s->darkened / (double)s->feet,
           100 * s->darkness / (double)s->feet, 100.0 * (double)s->lightened / (double)s->feet,
           100.0 * (double)s->dots / (double)s->pixels, s->pixels);
}

/* ---- whole scenes ---- */

/* Those of make_truth: boxes, thin walls, spheres, fences, tilted planes. A lamp is as large, seen
 * from them, as it is in penumbrae that a figure can be taken from. */
static const struct class {
    const char *name;
    int first, last, step; /* without GN_FULL: every so many of them */
    float radius;          /* tangent; spot: times its distance; point: times the scene's size */
    double most;
} classes[] = {{"sun", 0, 11, 3, .05f, .053},
               {"spot", 12, 23, 3, .04f, .0495},
               {"point", 24, 29, 1, .03f, .06}};

static float radius_of(const struct class *c, const struct gn_scene *scene) {
    struct gn_pose pose;
    vec3 place, direction, centre;
    float size = 1;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, 0);
    gn_pose_light(&pose, 0, place, direction);
    glm_vec3_center(pose.box_ws.min, pose.box_ws.max, centre);
    if (scene->lights[0].type == GN_LIGHT_SPOT) size = glm_vec3_distance(place, centre);
    if (scene->lights[0].type == GN_LIGHT_POINT)
        size = glm_vec3_distance(pose.box_ws.min, pose.box_ws.max) / 1.5f;
    gn_pose_finish(&pose);
    return c->radius * size;
}

static struct gn_scene *load_scene(const char *folder, int index) {
    struct gn_err err = {0};
    char path[600];
    snprintf(path, sizeof path, "%s/truth-%02d.glb", folder, index);
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Mean of the scenes' errors in penumbrae. */
static double check_class(const struct class *c, const char *folder, struct sure sure[2]) {
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_CONE, GN_TECHNIQUE_PCSS};
    double sum[2] = {0};
    int count = 0;
    for (int i = c->first; i <= c->last; i += gn_shot_full() ? 1 : c->step) {
        struct view v;
        struct gn_penumbra_score score[2];
        struct gn_scene *scene = load_scene(folder, i);
        view_init(&v, scene, radius_of(c, scene));
        for (int t = 0; t < 2; t++) {
            struct gn_picture shot;
            shoot(&v, techniques[t], &shot);
            gn_penumbra_score(&v.truth, &shot, &score[t]);
            add_sure(&v, &shot, &sure[t]);
            gn_picture_finish(&shot);
            sum[t] += score[t].soft;
        }
        printf("%-5s %02d: cone %.4f, pcss %.4f; elsewhere %.4f, %.4f; %ld pixels\n", c->name, i,
               score[0].soft, score[1].soft, score[0].rest, score[1].rest, score[0].soft_pixels);
        assert_true(score[0].soft_pixels > 400);
        count++;
        view_finish(&v);
    }
    printf("%-5s mean: cone %.4f, pcss %.4f\n", c->name, sum[0] / count, sum[1] / count);
    return sum[0] / count;
}

static void test_whole_scenes(void **state) {
    (void)state;
    struct gn_err err = {0};
    char *folder = gn_table_scenes(false, &err);
    if (!folder) fail_msg("%s", err.text);
    bool ok = true;
    for (int c = 0; c < 3; c++) {
        struct sure sure[2] = {{0}, {0}};
        ok &= check_class(&classes[c], folder, sure) <= classes[c].most;
        print_sure("cone", &sure[0]);
        print_sure("pcss", &sure[1]);
        ok &= sure[0].darkened <= sure[1].darkened + sure[0].feet / 500;
        ok &= sure[0].lightened <= sure[1].lightened + sure[0].feet / 500;
        ok &= sure[0].dots * 1000 <= sure[0].pixels;
    }
    free(folder);
    assert_true(ok);
}

/* ---- blockers over blockers ---- */

#define GROUND "{'mesh':0,'scale':[12,1,12]},"
#define EYE    "{'camera':0,'translation':[0,7,9],'rotation':[-0.3584,0,0,0.9336]},"
#define SUN    "'rotation':[-0.5577,-0.1494,-0.1002,0.8102]"
#define LAMP   "'translation':[0.5,9,0.3],'rotation':[-0.70710678,0,0,0.70710678]"

struct stack {
    const char *name, *nodes; /* three of them */
    const char *light, *place;
    float radius;
    double most;
};

static struct gn_scene *make_stack(const struct stack *s) {
    struct gn_maker maker;
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    char json[1600];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    snprintf(json, sizeof json,
             "[" GROUND EYE "{%s,'extensions':{'KHR_lights_punctual':{'light':0}}},%s]", s->place,
             s->nodes);
    gn_maker_set(&maker, "nodes", json);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4,5]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.7,'znear':0.1,'zfar':1000}}]");
    snprintf(json, sizeof json, "{'KHR_lights_punctual':{'lights':[{%s,'intensity':9}]}}",
             s->light);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions", json);
    struct gn_scene *scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

static double error_of(const struct view *v, enum gn_technique technique) {
    struct gn_picture shot;
    struct gn_penumbra_score score;
    shoot(v, technique, &shot);
    gn_penumbra_score(&v->truth, &shot, &score);
    gn_picture_finish(&shot);
    assert_true(score.soft_pixels > 400);
    return score.soft;
}

#define PLATES                                                                                     \
    "{'mesh':1,'translation':[-0.8,0.4,0.5],'scale':[0.6,0.4,0.6]},"                               \
    "{'mesh':1,'translation':[0.4,1.4,-0.2],'rotation':[0,0.2588,0,0.9659],"                       \
    "'scale':[0.9,0.05,0.7]},"                                                                     \
    "{'mesh':1,'translation':[0.1,2.6,-0.6],'rotation':[0,0.6,0,0.8],'scale':[0.8,0.05,0.8]}"
static void test_stacks(void **state) {
    (void)state;
    static const struct stack stacks[] = {
        {"stack, sun", PLATES, "'type':'directional'", SUN, .08f, .045},
        {"stack, spot", PLATES, "'type':'spot','spot':{'outerConeAngle':1.0}", LAMP, .6f, .13},
        {"stack, point", PLATES, "'type':'point'", LAMP, .6f, .13},
    };
    struct view v;
    struct gn_err err = {0};
    struct gn_scene *scene = gn_scene_load("build/selftest/stack.glb", NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    view_init(&v, scene, .3f);
    const double own = error_of(&v, GN_TECHNIQUE_CONE);
    printf("the self-test's stack: cone %.4f, pcss %.4f\n", own, error_of(&v, GN_TECHNIQUE_PCSS));
    bool ok = own <= .045;
    view_finish(&v);
    for (size_t i = 0; i < sizeof stacks / sizeof *stacks; i++) {
        view_init(&v, make_stack(&stacks[i]), stacks[i].radius);
        const double cone = error_of(&v, GN_TECHNIQUE_CONE), pcss = error_of(&v, GN_TECHNIQUE_PCSS);
        printf("%s: cone %.4f, pcss %.4f\n", stacks[i].name, cone, pcss);
        ok &= cone <= fmin(stacks[i].most, 1.1 * pcss);
        view_finish(&v);
    }
    assert_true(ok);
}

/* Blocks of four by four texels: over all, an error that is larger by a tenth at most. */
static void test_cones_of_what_moves(void **state) {
    (void)state;
    double sums[2] = {0};
    for (int i = -1; i < GN_PENUMBRA_COUNT; i++) {
        struct view v;
        struct gn_err err = {0};
        char *path = i < 0 ? strdup("build/selftest/stack.glb") : gn_penumbra_write(i, &err);
        struct gn_scene *scene = path ? gn_scene_load(path, NULL, NULL, &err) : NULL;
        if (!scene) fail_msg("%s", err.text);
        view_init(&v, scene, i < 0 ? .3f : 0);
        free(path);
        double errors[2];
        for (int k = 0; k < 2; k++) {
            moves = k == 1;
            errors[k] = error_of(&v, GN_TECHNIQUE_CONE);
            sums[k] += errors[k];
        }
        moves = false;
        printf("%-7s still %.4f, moving %.4f\n", i < 0 ? "stack" : gn_penumbra_names[i], errors[0],
               errors[1]);
        assert_true(errors[1] <= .06);
        view_finish(&v);
    }
    printf("moving: %.3f of the still error\n", sums[1] / sums[0]);
    assert_true(sums[1] <= 1.1 * sums[0]);
}

/* ---- the scenes of test_penumbra, and thin blockers high over low ones ---- */

static void view_penumbra(struct view *v, int which, int width_px, int height_px) {
    struct gn_err err = {0};
    char *path = gn_penumbra_write(which, &err);
    struct gn_scene *scene = path ? gn_scene_load(path, NULL, NULL, &err) : NULL;
    if (!scene) fail_msg("%s", err.text);
    view_init_of_size(v, scene, 0, width_px, height_px);
    free(path);
}

/* With 12 taps, over the scenes of each type of light; those are README's. */
static void test_with_fewer_taps_no_worse_than_pcss(void **state) {
    (void)state;
    double cone[GN_LIGHT_TYPE_COUNT] = {0}, pcss[GN_LIGHT_TYPE_COUNT] = {0};
    bool ok = true;
    for (int i = 0; i < GN_PENUMBRA_COUNT; i++) {
        struct view v;
        view_penumbra(&v, i, PAGE_WIDTH, PAGE_HEIGHT);
        const double errors[] = {error_of(&v, GN_TECHNIQUE_CONE), error_of(&v, GN_TECHNIQUE_PCSS)};
        printf("%-7s cone %.4f, pcss %.4f\n", gn_penumbra_names[i], errors[0], errors[1]);
        cone[gn_penumbra_light(i)] += errors[0];
        pcss[gn_penumbra_light(i)] += errors[1];
        if (i == GN_PENUMBRA_FIELD) ok &= errors[0] <= .05; /* four cascades */
        view_finish(&v);
    }
    for (int type = 0; type < GN_LIGHT_TYPE_COUNT; type++) {
        printf("%-11s sum: cone %.4f, pcss %.4f\n", gn_light_types[type].name, cone[type],
               pcss[type]);
        ok &= cone[type] <= .985 * pcss[type];
    }
    assert_true(ok);
}

/* The first cone wins, and what it is of decides the width: what pcss does better. */
static void test_thin_blockers_high_over_low_ones(void **state) {
    (void)state;
    for (int i = GN_PENUMBRA_THIN_SUN; i < GN_PENUMBRA_ALL; i++) {
        struct view v;
        view_penumbra(&v, i, WIDTH, HEIGHT);
        const double cone = error_of(&v, GN_TECHNIQUE_CONE), pcss = error_of(&v, GN_TECHNIQUE_PCSS);
        printf("%-10s cone %.4f, pcss %.4f\n", gn_penumbra_names[i], cone, pcss);
        assert_true(cone <= .15 && cone <= 2 * pcss);
        view_finish(&v);
    }
}

/* ---- what it costs ---- */

/* A folder of shaders in which cone says 0 wherever it goes on after its first read. */
static char *make_shaders(void) {
    static const char after[] = "if (inside > 0.0) {";
    struct gn_bytes text = {0};
    struct gn_err err = {0};
    char path[300], command[400];
    char *folder = NULL;
    if (asprintf(&folder, "%s/cone-shaders", gn_shot_build()) < 0) abort();
    snprintf(command, sizeof command, "rm -rf '%s' && cp -R shaders_es '%s'", folder, folder);
    if (system(command) != 0) fail_msg("%s", command);
    if (!gn_file_read("shaders_es/shadow/cone.glsl", 0, &text, &err)) fail_msg("%s", err.text);
    const char *at = memmem(text.data, text.size, after, sizeof after - 1);
    assert_non_null(at);
    const size_t before = (size_t)(at - (const char *)text.data) + sizeof after - 1;
    snprintf(path, sizeof path, "%s/shadow/cone.glsl", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fwrite(text.data, 1, before, file);
    fputs("\n    return 0.0;", file);
    fwrite(text.data + before, 1, text.size - before, file);
    assert_int_equal(fclose(file), 0);
    gn_bytes_finish(&text);
    return folder;
}

static void print_payers(const char *name, const struct view *v) {
    enum { PIXELS = WIDTH * HEIGHT };
    struct gn_picture shot;
    long dark = 0, soft = 0, pays = 0;
    shoot(v, GN_TECHNIQUE_CONE, &shot);
    for (int i = 0; i < PIXELS; i++) {
        dark += v->truth.data[i] <= 0;
        soft += v->truth.data[i] > 0 && v->truth.data[i] < 1;
        pays += shot.data[i] < .5f;
    }
    printf(
        "%s: %.1f %% of the pixels take taps; in truth %.1f %% are dark and %.1f %% in penumbrae\n",
        name, 100.0 * (double)pays / PIXELS, 100.0 * (double)dark / PIXELS,
        100.0 * (double)soft / PIXELS);
    assert_true(pays >= soft && pays <= dark + 2 * soft + PIXELS / 10);
    gn_picture_finish(&shot);
}

static void test_how_many_pixels_pay(void **state) {
    (void)state;
    struct gn_err err = {0};
    char *folder = gn_table_scenes(false, &err), *shaders = make_shaders();
    if (!folder) fail_msg("%s", err.text);
    gn_gl_destroy(gl);
    gl = help_gl(&display, &(struct gn_gl_opts){.shaders = shaders}, NULL);
    for (int i = 0; i < GN_PENUMBRA_COUNT; i++) {
        struct view v;
        view_penumbra(&v, i, WIDTH, HEIGHT);
        print_payers(gn_penumbra_names[i], &v);
        view_finish(&v);
    }
    for (int c = 0; c < 3; c++) {
        struct view v;
        struct gn_scene *scene = load_scene(folder, classes[c].first);
        view_init(&v, scene, radius_of(&classes[c], scene));
        print_payers(classes[c].name, &v);
        view_finish(&v);
    }
    free(folder);
    free(shaders);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_whole_scenes),
        cmocka_unit_test(test_stacks),
        cmocka_unit_test(test_cones_of_what_moves),
        cmocka_unit_test(test_with_fewer_taps_no_worse_than_pcss),
        cmocka_unit_test(test_thin_blockers_high_over_low_ones),
        cmocka_unit_test(test_how_many_pixels_pay), /* last: it takes other shaders */
    };
    return cmocka_run_group_tests_name("cone", tests, open_gl, close_gl);
}
