/* Point lights: no seams between the tiles of their maps, and a tile is drawn only when what it
 * shows has changed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "frame/plan.h"
#include "image/truth.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

enum { MAP_PX = 128, SIDE_PX = 400, VIEWS = 20 };

static struct gn_display display;
static struct gn_gl *gl;
static struct gn_scene *scene;
static struct gn_pose pose;
static struct gn_frame *frame;

static int open_display(void **state) {
    (void)state;
    help_open(&display, "egl");
    gl = help_gl(&display, NULL, NULL);
    return 0;
}

static int close_display(void **state) {
    (void)state;
    gn_gl_destroy(gl);
    gn_display_close(&display);
    return 0;
}

static void load(struct gn_maker *maker) {
    struct gn_err err = {0};
    gn_maker_set(maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'point','intensity':50}]}}");
    scene = gn_maker_load(maker, NULL, &err);
    if (!scene || !gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, 0);
    frame = gn_frame_create(scene, gn_gl_caps(gl));
}

static int unload(void **state) {
    (void)state;
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    return 0;
}

static const struct gn_plan *draw(int camera, enum gn_technique technique,
                                  enum gn_encoding encoding) {
    struct gn_frame_opts opts = {.width_px = SIDE_PX,
                                 .height_px = SIDE_PX,
                                 .camera = camera,
                                 .technique_given = true,
                                 .technique = technique,
                                 .encoding = encoding,
                                 .map_px = MAP_PX,
                                 .taps_fixed = true,
                                 .aov = GN_AOV_VISIBILITY};
    struct gn_err err = {0};
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err))
        fail_msg("%s", err.text);
    return plan;
}

/* ---- seams ---- */

/* A set stands before each of the 12 edges and 8 corners of the cube round the light: 3 m away a
 * square that faces it, 1.2 m away bars, and between the two an eye that looks at the square. In
 * the set's frame the light shines along -y. */
static void add_set(struct gn_maker *maker, const float direction[3], char *roots) {
    static const char *const bars[] = {
        "'translation':[-0.1,-1.2,0.05],'rotation':[0,0.15,0,0.9887],'scale':[0.5,1,0.03]",
        "'translation':[0.05,-1.2,-0.1],'rotation':[0,0.6,0,0.8],'scale':[0.5,1,0.02]",
        "'translation':[0.1,-1.2,0.12],'rotation':[0,0.95,0,0.3122],'scale':[0.5,1,0.04]",
    };
    char json[300];
    int first = gn_maker_add(maker, "nodes", "{'mesh':0,'translation':[0,-3,0]}");
    for (int i = 0; i < 3; i++) {
        snprintf(json, sizeof json, "{'mesh':0,%s}", bars[i]);
        gn_maker_add(maker, "nodes", json);
    }
    gn_maker_add(maker, "nodes",
                 "{'camera':0,'translation':[0,-1.8,0],'rotation':[-0.70710678,0,0,0.70710678]}");
    /* +y turned to -direction: axis y x -direction, 1 + cosine in w */
    float q[4] = {-direction[2], 0, direction[0], 1 - direction[1]};
    glm_vec4_normalize(q);
    snprintf(json, sizeof json, "{'rotation':[%.9g,%.9g,%.9g,%.9g],'children':[%d,%d,%d,%d,%d]}",
             (double)q[0], (double)q[1], (double)q[2], (double)q[3], first, first + 1, first + 2,
             first + 3, first + 4);
    snprintf(roots + strlen(roots), 8, "%d,", gn_maker_add(maker, "nodes", json));
}

static int load_seams(void **state) {
    (void)state;
    struct gn_maker maker;
    char roots[200] = "", json[400];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    for (int i = 0; i < 27; i++) {
        vec3 d = {(float)(i % 3 - 1), (float)(i / 3 % 3 - 1), (float)(i / 9 - 1)};
        if (glm_vec3_norm2(d) < 1.5f) continue;
        glm_vec3_normalize(d);
        add_set(&maker, d, roots);
    }
    int light = gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    snprintf(json, sizeof json, "{'translation':[0.3,1.2,-0.7],'children':[%s%d]}", roots, light);
    snprintf(roots, sizeof roots, "[{'nodes':[%d]}]", gn_maker_add(&maker, "nodes", json));
    gn_maker_set(&maker, "scenes", roots);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':0.8,'ymag':0.8,'znear':0.01,"
                 "'zfar':2}}]");
    load(&maker);
    assert_int_equal(scene->camera_count, VIEWS);
    return 0;
}

/* How far from the edges of the tiles, in texels. */
static double from_seam(const struct gn_truth *truth, int i) {
    double v[3], most = 0, next = 0;
    for (int k = 0; k < 3; k++) {
        v[k] = fabs(truth->mask.point_ws[3 * i + k] - truth->frame.lamp.position_ws[k]);
        if (v[k] > most) {
            next = most;
            most = v[k];
        } else if (v[k] > next)
            next = v[k];
    }
    return (1 - next / most) * MAP_PX / 2;
}

/* On an edge of a shadow two tiles may differ by a texel, since their texels lie differently: by
 * what a row of texels weighs in the filter, and hardly anywhere by more than a fetch does. */
struct seams {
    int technique, encoding;
    double fetches, row;
    double reach_px; /* further than this from a shadow's edge the answer is certain */
    int near, wrong; /* pixels that are near a seam; of those far from an edge, wrong */
    int steps;       /* pairs of pixels beside each other that differ by more than a fetch */
    double step;     /* the largest difference of such a pair */
};

static void compare_pair(struct seams *s, float a, float b) {
    double step = fabs((double)a - (double)b);
    s->steps += step > 1 / s->fetches;
    s->step = fmax(s->step, step);
}

static void look_at_seams(const struct gn_truth *truth, const float *edges, const float *picture,
                          struct seams *s) {
    for (int i = 0; i < SIDE_PX * (SIDE_PX - 1); i++) {
        if (from_seam(truth, i) > 3) continue;
        double seen = (double)picture[4 * i], lit = truth->mask.lit[i];
        s->near++;
        s->wrong += (double)edges[i] > s->reach_px && fabs(seen - lit) > 0.05;
        compare_pair(s, picture[4 * i], picture[4 * (i + SIDE_PX)]);
        if ((i + 1) % SIDE_PX) compare_pair(s, picture[4 * i], picture[4 * (i + 1)]);
    }
}

static void test_there_is_no_seam_between_tiles(void **state) {
    (void)state;
    struct seams cells[] = {
        {GN_TECHNIQUE_HARD, GN_ENCODING_R16F, 1, 1, 24, 0, 0, 0, 0},
        {GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH, 1, 1, 24, 0, 0, 0, 0},
        {GN_TECHNIQUE_PCF, GN_ENCODING_DEPTH, 4, 0.5, 36, 0, 0, 0, 0},
        {GN_TECHNIQUE_PCF, GN_ENCODING_R32UI, 4, 0.5, 36, 0, 0, 0, 0},
        {GN_TECHNIQUE_PCF3, GN_ENCODING_DEPTH, 4, 0.5, 36, 0, 0, 0, 0},
        {GN_TECHNIQUE_PCF5, GN_ENCODING_DEPTH, 9, 0.34, 56, 0, 0, 0, 0},
        {GN_TECHNIQUE_PCF5, GN_ENCODING_RGBA8, 9, 0.34, 56, 0, 0, 0, 0},
        {GN_TECHNIQUE_DISK, GN_ENCODING_R16F, 4, 0.5, 60, 0, 0, 0, 0},
        {GN_TECHNIQUE_PCSS, GN_ENCODING_R16F, 4, 0.5, 60, 0, 0, 0, 0},
        {GN_TECHNIQUE_PCSS, GN_ENCODING_DEPTH, 4, 0.5, 60, 0, 0, 0, 0},
    };
    enum { CELLS = sizeof cells / sizeof *cells };
    float *picture = gn_xalloc(SIDE_PX * SIDE_PX, 4 * sizeof *picture),
          *edges = gn_xalloc(SIDE_PX * SIDE_PX, sizeof *edges);
    for (uint32_t view = 0; view < VIEWS; view++) {
        struct gn_truth truth;
        struct gn_truth_opts opts = {.width_px = SIDE_PX, .height_px = SIDE_PX, .camera = view};
        struct gn_err err = {0};
        if (!gn_truth_make(&truth, scene, &opts, &err)) fail_msg("%s", err.text);
        gn_mask_edges(&truth.mask, edges);
        for (int c = 0; c < CELLS; c++) {
            draw((int)view, (enum gn_technique)cells[c].technique,
                 (enum gn_encoding)cells[c].encoding);
            if (!gn_gl_read_f32(gl, picture, &err)) fail_msg("%s", err.text);
            look_at_seams(&truth, edges, picture, &cells[c]);
        }
        gn_truth_finish(&truth);
    }
    free(picture);
    free(edges);
    for (int c = 0; c < CELLS; c++) {
        const struct seams *s = &cells[c];
        printf("%-5s %-6s %d pixels at seams, %d wrong; of their pairs %d differ by over %.2f, by "
               "%.3f at most\n",
               gn_techniques[s->technique].name, gn_encodings[s->encoding].name, s->near, s->wrong,
               s->steps, 1 / s->fetches, s->step);
        assert_true(s->near > 100000);
        assert_int_equal(s->wrong, 0);
        assert_true(s->steps <= s->near / 500); /* a thousandth of the pairs */
        assert_true(s->step <= s->row);
    }
}

/* The range ends on the squares: of what throws and takes shadows a part lies beyond it. */
static void test_shadows_end_where_the_range_does(void **state) {
    (void)state;
    static const int encodings[] = {GN_ENCODING_R16F, GN_ENCODING_DEPTH, GN_ENCODING_RGBA8};
    static float picture[4 * SIDE_PX * SIDE_PX], edges[SIDE_PX * SIDE_PX];
    int dark = 0, beyond = 0, wrong = 0;
    scene->lights[0].range_m = 3.1f;
    for (uint32_t view = 0; view < VIEWS; view += 5) {
        struct gn_truth truth;
        struct gn_truth_opts opts = {.width_px = SIDE_PX, .height_px = SIDE_PX, .camera = view};
        struct gn_err err = {0};
        if (!gn_truth_make(&truth, scene, &opts, &err)) fail_msg("%s", err.text);
        gn_mask_edges(&truth.mask, edges);
        for (int e = 0; e < 3; e++) {
            draw((int)view, GN_TECHNIQUE_HARD, (enum gn_encoding)encodings[e]);
            if (!gn_gl_read_f32(gl, picture, &err)) fail_msg("%s", err.text);
            for (int i = 0; i < SIDE_PX * SIDE_PX; i++) {
                if (edges[i] <= 24) continue;
                const float *p = truth.mask.point_ws + 3 * (size_t)i;
                double from[3] = {(double)p[0], (double)p[1], (double)p[2]};
                for (int k = 0; k < 3; k++) from[k] -= truth.frame.lamp.position_ws[k];
                dark += !truth.mask.lit[i];
                beyond += sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]) > 3.1;
                wrong += fabsf(picture[4 * i] - (float)truth.mask.lit[i]) > 0.05f;
            }
        }
        gn_truth_finish(&truth);
    }
    assert_true(dark > 1000 && beyond > 1000);
    assert_int_equal(wrong, 0);
}

/* ---- what is drawn again ---- */

/* Six squares of 6 m round the light, one of .4 m before each; that before +x moves along y. Camera
 * 0 sees all, camera 1 the square at +x alone. */
static int load_box(void **state) {
    (void)state;
    static const char *const turns[6] = {
        "[0,0,0.70710678,0.70710678]",  "[0,0,-0.70710678,0.70710678]", "[1,0,0,0]", "[0,0,0,1]",
        "[-0.70710678,0,0,0.70710678]", "[0.70710678,0,0,0.70710678]"};
    static const float times[2] = {0, 1}, path[6] = {1.5f, 0, 0, 1.5f, 0.2f, 0};
    struct gn_maker maker;
    char json[300];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    for (int i = 0; i < 12; i++) {
        double at[3] = {0}, far = i < 6 ? 1.5 : 3;
        at[i % 6 / 2] = i % 2 ? -far : far;
        snprintf(json, sizeof json,
                 "{'mesh':0,'translation':[%g,%g,%g],'rotation':%s,'scale':[%g,1,%g]}", at[0],
                 at[1], at[2], turns[i % 6], i < 6 ? 0.2 : 3.0, i < 6 ? 0.2 : 3.0);
        gn_maker_add(&maker, "nodes", json);
    }
    gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    gn_maker_add(&maker, "nodes", "{'camera':0,'translation':[0,0,20]}");
    gn_maker_add(&maker, "nodes",
                 "{'camera':0,'translation':[2,0,0],'rotation':[0,-0.70710678,0,0.70710678]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':50}}]");
    int input = gn_maker_accessor(&maker, "SCALAR", 5126, 2, times, sizeof times, NULL);
    int output = gn_maker_accessor(&maker, "VEC3", 5126, 2, path, sizeof path, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{'node':1,"
             "'path':'translation'}}]}",
             input, output);
    gn_maker_add(&maker, "animations", json);
    load(&maker);
    return 0;
}

static void expect_shadow_work(uint32_t draws, uint32_t skipped) {
    struct gn_gl_stats stats = gn_gl_stats(gl);
    assert_int_equal(stats.shadow_draws, draws);
    assert_int_equal(stats.shadow_passes_skipped, skipped);
}

static void test_what_moves_draws_its_tiles_alone(void **state) {
    (void)state;
    enum { WIDTH = 3 * MAP_PX, HEIGHT = 2 * MAP_PX };
    float *still = gn_xalloc(WIDTH * HEIGHT, sizeof *still),
          *moved = gn_xalloc(WIDTH * HEIGHT, sizeof *moved);
    struct gn_err err = {0};
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_R32UI);
    expect_shadow_work(6, 0);
    assert_true(gn_gl_read_map(gl, 0, still, &err));
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_R32UI);
    expect_shadow_work(0, 6);
    gn_pose_step(&pose, 500000000);
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_R32UI);
    expect_shadow_work(1, 5);
    assert_true(gn_gl_read_map(gl, 0, moved, &err));
    int inside = 0, outside = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        bool tile = i % WIDTH < MAP_PX && i / WIDTH < MAP_PX;
        bool differs = still[i] != moved[i];
        inside += tile && differs;
        outside += !tile && differs;
    }
    assert_true(inside > 50);
    assert_int_equal(outside, 0);
    free(still);
    free(moved);
}

static void test_a_tile_whose_shadows_are_not_seen_is_not_drawn(void **state) {
    (void)state;
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH);
    expect_shadow_work(6, 0);
    const struct gn_shadow_view *view = draw(1, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH)->shadows;
    expect_shadow_work(0, 1); /* the others are cleared */
    for (int i = 0; i < 6; i++) assert_true(view->tiles[i].empty == (i > 0));
    draw(1, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH);
    expect_shadow_work(0, 6);
}

/* ---- near and far ---- */

/* One mesh: the shell of a room of 10 m, of 6 x 8 triangles, and a plate .5 m below the light,
 * which is in the middle. */
static int load_shell(void **state) {
    (void)state;
    enum { QUADS = 25 };
    float p[QUADS][4][3];
    uint16_t index[QUADS][6];
    for (int q = 0; q < QUADS; q++) {
        int axis = q / 8 % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        float side = q / 4 % 2 ? 5 : -5, size = 5;
        if (q == QUADS - 1) axis = 1, u = 0, v = 2, side = -0.5f, size = 0.2f;
        for (int c = 0; c < 4; c++) {
            p[q][c][axis] = side;
            p[q][c][u] = size * (float)((c == 1 || c == 2) - q % 2);
            p[q][c][v] = size * (float)((c >= 2) - q / 2 % 2);
        }
        for (int k = 0; k < 6; k++) index[q][k] = (uint16_t)(4 * q + "012023"[k] - '0');
    }
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_accessor(&maker, "VEC3", 5126, 4 * QUADS, p, sizeof p,
                      "'min':[-5,-5,-5],'max':[5,5,5]");
    gn_maker_accessor(&maker, "SCALAR", 5123, 6 * QUADS, index, sizeof index, NULL);
    gn_maker_add(&maker, "meshes", "{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}");
    gn_maker_add(&maker, "nodes", "{'mesh':0}");
    gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    gn_maker_add(&maker, "nodes", "{'camera':0,'translation':[0,0,4]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':50}}]");
    load(&maker);
    return 0;
}

static void test_what_a_mesh_round_the_light_has_near_it_casts(void **state) {
    (void)state;
    const struct gn_shadow_view *view = draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH)->shadows;
    assert_true(scene->geometries[0].index_count / 3 > 32);
    assert_false(view->empty);
    assert_true(view->near_m > 0.1f && view->near_m < 0.5f);
    assert_true(view->far_m > 8.6f && view->far_m < 12.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_there_is_no_seam_between_tiles, load_seams, unload),
        cmocka_unit_test_setup_teardown(test_shadows_end_where_the_range_does, load_seams, unload),
        cmocka_unit_test_setup_teardown(test_what_moves_draws_its_tiles_alone, load_box, unload),
        cmocka_unit_test_setup_teardown(test_a_tile_whose_shadows_are_not_seen_is_not_drawn,
                                        load_box, unload),
        cmocka_unit_test_setup_teardown(test_what_a_mesh_round_the_light_has_near_it_casts,
                                        load_shell, unload),
    };
    return cmocka_run_group_tests_name("point lights", tests, open_display, close_display);
}
