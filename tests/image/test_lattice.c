/* Filtered maps where a filter is mostly holes: the shadow of a lattice on a ground that is in no
 * map, since it casts nothing, and on one that is; and sheets that end in nothing, which are lit to
 * their edges. Against rays to all of the lamp. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gl/private.h"
#include "image/shot.h"
#include "truth/raycast.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

static struct help_stage stage;

/* Bars of 5 cm every 25 cm both ways, 1 m above a ground, under a lamp 9 m up; the eye is under the
 * lattice, beside the ground's edge, where there is one. */
enum { BARS = 13 };

static void add_node(struct gn_maker *m, char *roots, size_t size, const char *json) {
    const int node = gn_maker_add(m, "nodes", json);
    snprintf(roots + strlen(roots), size - strlen(roots), ",%d", node);
}

static void add_lattice(struct gn_maker *m, char *roots, size_t size) {
    char node[200];
    for (int i = 0; i < BARS; i++) {
        const double at = 0.25 * (i - BARS / 2);
        snprintf(node, sizeof node, "{'mesh':1,'translation':[%g,1,0],'scale':[0.025,0.01,1.55]}",
                 at + 0.5);
        add_node(m, roots, size, node);
        snprintf(node, sizeof node, "{'mesh':1,'translation':[0.5,1,%g],'scale':[1.55,0.01,0.025]}",
                 at);
        add_node(m, roots, size, node);
    }
}

static void begin(struct gn_maker *m, const char *eye) {
    char nodes[500];
    gn_maker_init(m);
    gn_maker_square(m);
    gn_maker_cube(m);
    snprintf(nodes, sizeof nodes,
             "[{'camera':0,%s},{'translation':[0,9,0],'rotation':[-0.70710678,0,0,0.70710678],"
             "'extensions':{'KHR_lights_punctual':{'light':0}}}]",
             eye);
    gn_maker_set(m, "nodes", nodes);
    gn_maker_set(m, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(m, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':300,'spot':"
                 "{'innerConeAngle':1.0,'outerConeAngle':1.1},'extras':{'gnomon_radius':1.5}}]}}");
    gn_maker_set(m, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':1.8,'znear':0.05,'zfar':60}}]");
}

static struct gn_scene *end(struct gn_maker *m, const char *roots) {
    struct gn_err err = {0};
    char scenes[500];
    snprintf(scenes, sizeof scenes, "[{'nodes':[0,1%s]}]", roots);
    gn_maker_set(m, "scenes", scenes);
    struct gn_scene *scene = gn_maker_load(m, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

#define UNDER_THE_LATTICE "'translation':[1.4,0.9,0],'rotation':[-0.70710678,0,0,0.70710678]"

static struct gn_scene *make_open_ground(void) {
    struct gn_maker m;
    char roots[400] = "";
    begin(&m, UNDER_THE_LATTICE);
    add_lattice(&m, roots, sizeof roots);
    add_node(&m, roots, sizeof roots, "{'mesh':0,'scale':[12,1,12]}");
    return end(&m, roots);
}

/* It ends at x = 1.2, and its shadow lies 2 m deeper. */
static struct gn_scene *make_casting_ground(void) {
    struct gn_maker m;
    char roots[400] = "";
    begin(&m, UNDER_THE_LATTICE);
    add_lattice(&m, roots, sizeof roots);
    add_node(&m, roots, sizeof roots, "{'mesh':0,'translation':[-1.8,0,0],'scale':[3,1,3]}");
    add_node(&m, roots, sizeof roots, "{'mesh':0,'translation':[0,-2,0],'scale':[12,1,12]}");
    return end(&m, roots);
}

/* Inclined by 60 degrees, away from the lamp; below it a ground that casts nothing. */
static struct gn_scene *make_sheet(void) {
    struct gn_maker m;
    char roots[400] = "";
    begin(&m, "'translation':[1.5,3.5,0],'rotation':[-0.70710678,0,0,0.70710678]");
    add_node(&m, roots, sizeof roots,
             "{'mesh':0,'translation':[1.5,1.5,0],'rotation':[0,0,-0.5,0.8660254]}");
    add_node(&m, roots, sizeof roots, "{'mesh':0,'scale':[12,1,12]}");
    return end(&m, roots);
}

/* A board at the far end of a ground that rises to the lamp: the map holds what is round it alone,
 * ground, too. */
static struct gn_scene *make_board(void) {
    struct gn_maker m;
    char roots[400] = "";
    begin(&m, "'translation':[0,6,0],'rotation':[-0.70710678,0,0,0.70710678]");
    add_node(&m, roots, sizeof roots,
             "{'mesh':1,'translation':[-4,-1.6,0],'scale':[0.05,0.8,0.5]}");
    add_node(&m, roots, sizeof roots,
             "{'mesh':0,'rotation':[0,0,0.2588190,0.9659258],'scale':[7,1,7]}");
    return end(&m, roots);
}

enum { WIDTH = 320, HEIGHT = 240, STEP = 2 };
static float picture[4 * WIDTH * HEIGHT];
static const enum gn_technique techniques[] = {
    GN_TECHNIQUE_VSM, GN_TECHNIQUE_EVSM, GN_TECHNIQUE_MSM, GN_TECHNIQUE_VSSM, GN_TECHNIQUE_SMSM};
enum { TECHNIQUES = sizeof techniques / sizeof techniques[0] };

static const struct gn_shadow_view *draw(enum gn_technique technique) {
    const struct gn_frame_opts opts = {
        .output.width_px = WIDTH,
        .output.height_px = HEIGHT,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = technique,
                       .map_px = 128},
        .debug.aov = GN_AOV_VISIBILITY};
    struct gn_err err = {0};
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (!gn_gl_read_f32(stage.gl, picture, &err)) fail_msg("%s", err.text);
    assert_int_equal(plan->shadow_count, 1);
    return &plan->shadows[0];
}

/* What the pixels on a lattice of their own see: a share of the lamp, or -1 elsewhere. */
static float truth[WIDTH * HEIGHT];

/* Of what the eye sees between these places; samples 1: whether the lamp's middle is seen. */
static double find_truth(const double low[3], const double high[3], int samples) {
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    double sum = 0;
    int count = 0;
    gn_raycast_init(&rays, stage.scene, &stage.pose, NULL);
    gn_ray_eye_init(&eye, &stage.pose, 0, WIDTH, HEIGHT);
    gn_ray_lamp_init(&lamp, &stage.pose, 0);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        struct gn_ray_surface s;
        truth[i] = -1;
        if (i % WIDTH % STEP || i / WIDTH % STEP) continue;
        if (!gn_raycast_eye(&rays, &eye, i % WIDTH, i / WIDTH, &s)) continue;
        bool within = true;
        for (int k = 0; k < 3; k++) within &= s.point_ws[k] >= low[k] && s.point_ws[k] <= high[k];
        if (!within) continue;
        truth[i] = (float)gn_raycast_share(&rays, &lamp, &s, samples);
        sum += (double)truth[i];
        count++;
    }
    gn_raycast_finish(&rays);
    assert_true(count > 500);
    return sum / count;
}

struct seen {
    double mean, darkest;
};

static struct seen see(void) {
    struct seen seen = {0, 1};
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (truth[i] < 0) continue;
        seen.mean += (double)picture[4 * i];
        seen.darkest = fmin(seen.darkest, (double)picture[4 * i]);
        count++;
    }
    seen.mean /= count;
    return seen;
}

/* Where vsm tells holes by distances alone it makes less of what is lit: it stretches what
 * Chebyshev's inequality says, for the sake of casters behind each other. */
static void check_ground(struct gn_scene *(*make)(void), bool casts) {
    help_stage_open(&stage, make, "egl", NULL, NULL);
    const double lit =
        find_truth((const double[]){0, -1e-3, -0.7}, (const double[]){0.8, 1e-3, 0.7}, 64);
    assert_true(lit > 0.6 && lit < 0.8);
    for (int t = 0; t < TECHNIQUES; t++) {
        const struct gn_shadow_view *view = draw(techniques[t]);
        assert_true(casts == (view->code.far_m > 9)); /* the lattice's last is nearer */
        const struct seen seen = see();
        print_message("%-4s, a ground that casts %s: %.3f, truth %.3f\n",
                      gn_techniques[techniques[t]].name, casts ? "too" : "nothing", seen.mean, lit);
        const bool stretches = casts && techniques[t] == GN_TECHNIQUE_VSM;
        assert_true(fabs(seen.mean - lit) <= (stretches ? 0.15 : 0.07));
    }
    help_stage_close(&stage);
}

static void test_a_lattice_on_a_ground_that_casts_nothing(void **state) {
    (void)state;
    check_ground(make_open_ground, false);
}

static void test_a_lattice_on_a_ground_that_casts_too(void **state) {
    (void)state;
    check_ground(make_casting_ground, true);
}

/* Those that do not know their casters' share take a little light from what is steep. */
static void test_a_sheet_is_lit_to_its_edges(void **state) {
    (void)state;
    static const struct {
        double mean, darkest;
    } least[GN_TECHNIQUE_COUNT] = {
        [GN_TECHNIQUE_VSM] = {0.9998, 0.99},  [GN_TECHNIQUE_EVSM] = {0.9998, 0.99},
        [GN_TECHNIQUE_VSSM] = {0.9998, 0.99}, [GN_TECHNIQUE_MSM] = {0.99, 0.9},
        [GN_TECHNIQUE_SMSM] = {0.96, 0.75},
    };
    help_stage_open(&stage, make_sheet, "egl", NULL, NULL);
    const double lit = find_truth((const double[]){-9, 0.1, -9}, (const double[]){9, 9, 9}, 64);
    assert_true(lit > 0.999);
    for (int t = 0; t < TECHNIQUES; t++) {
        const enum gn_technique technique = techniques[t];
        draw(technique);
        const struct seen seen = see();
        print_message("%-4s, an inclined sheet: %.4f, at the darkest %.3f\n",
                      gn_techniques[technique].name, seen.mean, seen.darkest);
        assert_true(seen.mean >= least[technique].mean);
        assert_true(seen.darkest >= least[technique].darkest);
    }
    help_stage_close(&stage);
}

static void test_beyond_a_map_is_light(void **state) {
    (void)state;
    help_stage_open(&stage, make_board, "egl", NULL, NULL);
    find_truth((const double[]){-8, -4, -5}, (const double[]){8, 4, 5}, 16);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        if (truth[i] < 1) truth[i] = -1;
    for (int t = 0; t < TECHNIQUES; t++) {
        draw(techniques[t]);
        const struct seen seen = see();
        print_message("%-4s, beyond the shadow: %.4f, the darkest %.3f\n",
                      gn_techniques[techniques[t]].name, seen.mean, seen.darkest);
        assert_true(seen.mean > 0.999);
    }
    help_stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_lattice_on_a_ground_that_casts_nothing),
        cmocka_unit_test(test_a_lattice_on_a_ground_that_casts_too),
        cmocka_unit_test(test_a_sheet_is_lit_to_its_edges),
        cmocka_unit_test(test_beyond_a_map_is_light),
    };
    return RUN(tests);
}
