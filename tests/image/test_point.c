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

enum { MAP_PX = 128, SIDE_PX = 400, VIEWS = 20, LONG_PX = 1600, SHORT_PX = 48 };

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

static const struct gn_plan *draw_sized(int camera, int technique, int encoding, int width_px,
                                        int height_px) {
    struct gn_frame_opts opts = {.width_px = (uint32_t)width_px,
                                 .height_px = (uint32_t)height_px,
                                 .camera = camera,
                                 .technique_given = true,
                                 .technique = (enum gn_technique)technique,
                                 .encoding = (enum gn_encoding)encoding,
                                 .map_px = MAP_PX,
                                 .taps_fixed = true,
                                 .aov = GN_AOV_VISIBILITY};
    struct gn_err err = {0};
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err))
        fail_msg("%s", err.text);
    return plan;
}

static const struct gn_plan *draw(int camera, int technique, int encoding) {
    return draw_sized(camera, technique, encoding, SIDE_PX, SIDE_PX);
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

/* Two cameras that see of the same square a strip along the edge, the picture's width once along it
 * and once across. */
static void add_strips(struct gn_maker *maker, float direction[3], char *roots) {
    float along[3] = {0};
    int axis = 0; /* the edge's; at a corner the x axis goes on as an edge */
    for (int k = 0; k < 3; k++)
        if (fabsf(direction[k]) < 0.1f) axis = k;
    along[axis] = 1;
    glm_vec3_muladds(direction, -direction[axis], along);
    glm_vec3_normalize(along);
    for (int across = 0; across < 2; across++) {
        mat4 look = GLM_MAT4_IDENTITY_INIT;
        versor q;
        char json[300];
        glm_vec3_negate_to(direction, look[2]);
        glm_vec3_copy(along, look[!across ? 0 : 1]);
        if (across)
            glm_vec3_cross(look[1], look[2], look[0]);
        else
            glm_vec3_cross(look[2], look[0], look[1]);
        glm_mat4_quat(look, q);
        snprintf(json, sizeof json,
                 "{'camera':%d,'translation':[%.9g,%.9g,%.9g],'rotation':[%.9g,%.9g,%.9g,%.9g]}",
                 1 + across, 1.8 * (double)direction[0], 1.8 * (double)direction[1],
                 1.8 * (double)direction[2], (double)q[0], (double)q[1], (double)q[2],
                 (double)q[3]);
        snprintf(roots + strlen(roots), 8, "%d,", gn_maker_add(maker, "nodes", json));
    }
}

static void load_sets(const char *turn, bool masked) {
    struct gn_maker maker;
    char roots[400] = "", json[600];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    if (masked) {
        gn_maker_set(&maker, "materials", "[{'alphaMode':'MASK'}]");
        gn_maker_set(&maker, "meshes",
                     "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    }
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 27; i++) {
            vec3 d = {(float)(i % 3 - 1), (float)(i / 3 % 3 - 1), (float)(i / 9 - 1)};
            if (glm_vec3_norm2(d) < 1.5f) continue;
            glm_vec3_normalize(d);
            if (pass)
                add_strips(&maker, d, roots);
            else
                add_set(&maker, d, roots);
        }
    int light = gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    snprintf(json, sizeof json, "{'translation':[0.3,1.2,-0.7],'rotation':%s,'children':[%s%d]}",
             turn, roots, light);
    snprintf(roots, sizeof roots, "[{'nodes':[%d]}]", gn_maker_add(&maker, "nodes", json));
    gn_maker_set(&maker, "scenes", roots);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':0.8,'ymag':0.8,'znear':0.01,"
                 "'zfar':2}},{'type':'orthographic','orthographic':{'xmag':0.8,'ymag':0.024,"
                 "'znear':0.01,'zfar':2}},{'type':'orthographic','orthographic':{'xmag':0.024,"
                 "'ymag':0.8,'znear':0.01,'zfar':2}}]");
    load(&maker);
    assert_int_equal(scene->camera_count, 3 * VIEWS);
}

static int load_seams(void **state) {
    (void)state;
    load_sets("[0,0,0,1]", false);
    return 0;
}

/* How far from the edges of the tiles, in texels; *corner: from where three tiles meet. */
static double from_seam(const double from_light[3], double *corner) {
    double a = fabs(from_light[0]), b = fabs(from_light[1]), c = fabs(from_light[2]);
    double most = fmax(fmax(a, b), c), least = fmin(fmin(a, b), c), next = a + b + c - most - least;
    if (corner) *corner = (1 - least / most) * MAP_PX / 2;
    return (1 - next / most) * MAP_PX / 2;
}

struct seams {
    int technique, encoding;
    double fetches;
    double reach_px;          /* further than this from a shadow's edge the answer is certain */
    int near, wrong;          /* pixels that are near a seam; of those far from an edge, wrong */
    int pairs;                /* of pixels of strips that are beside each other, near a seam */
    double step, corner_step; /* by how much such a pair differs at most; where three tiles meet */
    double plain;             /* the same without a seam */
    double across;            /* by how much two differ at most between which an edge goes */
};
#define SEAMS                                                                                      \
    {GN_TECHNIQUE_HARD, GN_ENCODING_R16F, 1, 24, 0, 0, 0, 0, 0, 0, 0},                             \
        {GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH, 1, 24, 0, 0, 0, 0, 0, 0, 0},                        \
        {GN_TECHNIQUE_PCF2, GN_ENCODING_DEPTH, 1, 24, 0, 0, 0, 0, 0, 0, 0},                        \
        {GN_TECHNIQUE_PCF, GN_ENCODING_DEPTH, 4, 36, 0, 0, 0, 0, 0, 0, 0},                         \
        {GN_TECHNIQUE_PCF, GN_ENCODING_R32UI, 4, 36, 0, 0, 0, 0, 0, 0, 0},                         \
        {GN_TECHNIQUE_PCF3, GN_ENCODING_DEPTH, 4, 36, 0, 0, 0, 0, 0, 0, 0},                        \
        {GN_TECHNIQUE_PCF5, GN_ENCODING_DEPTH, 9, 56, 0, 0, 0, 0, 0, 0, 0},                        \
        {GN_TECHNIQUE_PCF5, GN_ENCODING_RGBA8, 9, 56, 0, 0, 0, 0, 0, 0, 0},                        \
        {GN_TECHNIQUE_DISK, GN_ENCODING_R16F, 16, 60, 0, 0, 0, 0, 0, 0, 0},                        \
        {GN_TECHNIQUE_POISSON, GN_ENCODING_R16F, 16, 60, 0, 0, 0, 0, 0, 0, 0},                     \
        {GN_TECHNIQUE_PCSS, GN_ENCODING_R16F, 16, 60, 0, 0, 0, 0, 0, 0, 0}, {                      \
        GN_TECHNIQUE_PCSS, GN_ENCODING_DEPTH, 16, 60, 0, 0, 0, 0, 0, 0, 0                          \
    }

static void test_shadows_are_right_where_tiles_meet(void **state) {
    (void)state;
    struct seams cells[] = {SEAMS};
    enum { CELLS = sizeof cells / sizeof *cells };
    static float picture[4 * SIDE_PX * SIDE_PX], edges[SIDE_PX * SIDE_PX];
    for (uint32_t view = 0; view < VIEWS; view++) {
        struct gn_truth truth;
        struct gn_truth_opts opts = {.width_px = SIDE_PX, .height_px = SIDE_PX, .camera = view};
        struct gn_err err = {0};
        if (!gn_truth_make(&truth, scene, &opts, &err)) fail_msg("%s", err.text);
        gn_mask_edges(&truth.mask, edges);
        for (int c = 0; c < CELLS; c++) {
            draw((int)view, cells[c].technique, cells[c].encoding);
            if (!gn_gl_read_f32(gl, picture, &err)) fail_msg("%s", err.text);
            for (int i = 0; i < SIDE_PX * SIDE_PX; i++) {
                double v[3];
                for (int k = 0; k < 3; k++)
                    v[k] = (double)truth.mask.point_ws[3 * i + k] - truth.frame.lamp.position_ws[k];
                if (from_seam(v, NULL) > 3) continue;
                double wrong = fabs((double)picture[4 * i] - (double)truth.mask.lit[i]);
                cells[c].near++;
                cells[c].wrong += (double)edges[i] > cells[c].reach_px && wrong > 0.05;
            }
        }
        gn_truth_finish(&truth);
    }
    for (int c = 0; c < CELLS; c++) {
        assert_true(cells[c].near > 100000);
        assert_int_equal(cells[c].wrong, 0);
    }
}

static double step(const float *picture, int a, int b) {
    return fabs((double)picture[4 * a] - (double)picture[4 * b]);
}

struct strip {
    int width, height;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
};

/* From the light to what pixel i sees; its tile. */
static int direction_of(const struct strip *t, int i, double v[3]) {
    const double x = (2 * (i % t->width + 0.5) / t->width - 1) * t->eye.half_width;
    const double y = (1 - 2 * (i / t->width + 0.5) / t->height) * t->eye.half_height;
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        v[k] = t->eye.position_ws[k] + 1.2 * t->eye.forward[k] + x * t->eye.right[k] +
               y * t->eye.up[k] - t->lamp.position_ws[k];
        if (fabs(v[k]) > fabs(v[axis])) axis = k;
    }
    return 2 * axis + (v[axis] < 0);
}

/* All pairs of pixels beside each other. Near a seam, where tiles are shared, a pixel knows what
 * its neighbour saw, so two can differ as two do elsewhere that have one between them. */
static void look_at_strip(uint32_t camera, bool across, const float *picture, struct seams *s) {
    struct strip t = {.width = across ? SHORT_PX : LONG_PX, .height = across ? LONG_PX : SHORT_PX};
    gn_ray_eye_init(&t.eye, &pose, camera, t.width, t.height);
    gn_ray_lamp_init(&t.lamp, &pose, 0);
    for (int i = 0; i < t.width * (t.height - 1); i++) {
        double corner, v[3], other[3];
        const int tile = direction_of(&t, i, v);
        const double seam = from_seam(v, &corner);
        double below = step(picture, i, i + t.width),
               beside = (i + 1) % t.width ? step(picture, i, i + 1) : 0;
        double next = i % t.width + 2 < t.width ? step(picture, i, i + 2) : 0;
        if (i / t.width + 2 < t.height) next = fmax(next, step(picture, i, i + 2 * t.width));
        double *most = seam > 6 ? &s->plain : corner < 2 ? &s->corner_step : &s->step;
        s->pairs += seam < 2 ? 2 : 0;
        if (seam < 2 || seam > 6) *most = fmax(*most, fmax(below, seam > 6 ? next : beside));
        if (seam > 2) continue;
        if (direction_of(&t, i + t.width, other) != tile) s->across = fmax(s->across, below);
        if (direction_of(&t, i + 1, other) != tile) s->across = fmax(s->across, beside);
    }
}

static void look_at_strips(struct seams *cells, int count) {
    static float picture[4 * LONG_PX * SHORT_PX];
    struct gn_err err = {0};
    for (uint32_t camera = VIEWS; camera < 3 * VIEWS; camera++)
        for (int c = 0; c < count; c++) {
            bool across = camera % 2;
            draw_sized((int)camera, cells[c].technique, cells[c].encoding,
                       across ? SHORT_PX : LONG_PX, across ? LONG_PX : SHORT_PX);
            if (!gn_gl_read_f32(gl, picture, &err)) fail_msg("%s", err.text);
            look_at_strip(camera, across, picture, &cells[c]);
        }
}

/* Pixels are a 25th of a texel, so a shadow's own gradient is next to nothing. How far a technique
 * jumps all the same (of taps some may leave a texel together) is measured where the same things,
 * turned, lie inside tiles. Masked materials may have holes, after which nothing can be shared. */
static void test_there_is_no_seam_between_tiles(void **state) {
    struct seams cells[] = {SEAMS};
    enum { CELLS = sizeof cells / sizeof *cells, MASKED = 5 };
    look_at_strips(cells, CELLS);
    unload(state);
    load_sets("[0,0,0,1]", true);
    look_at_strips(cells + MASKED, 3);
    unload(state);
    load_sets("[0.35,0.12,-0.25,0.894762]", false);
    look_at_strips(cells, CELLS);
    for (int c = 0; c < CELLS; c++) {
        const struct seams *s = &cells[c];
        printf("%-7s %-6s %d pairs at seams differ by %.3f at most, at corners by %.3f, without a "
               "seam by %.3f, across the edge by %.3f; a tap is %.3f\n",
               gn_techniques[s->technique].name, gn_encodings[s->encoding].name, s->pairs, s->step,
               s->corner_step, s->plain, s->across, 1 / s->fetches);
        assert_true(s->pairs > 1000000 && s->plain > 0);
        assert_true(fmax(s->step, s->corner_step) <= fmax(1 / s->fetches, s->plain));
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
            draw((int)view, GN_TECHNIQUE_HARD, encodings[e]);
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
        cmocka_unit_test_setup_teardown(test_shadows_are_right_where_tiles_meet, load_seams,
                                        unload),
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
