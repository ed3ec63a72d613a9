/* Point lights: no seams between the tiles of their maps. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/point_help.h"
#include "image/shot.h"
#include "image/truth.h"
#include "unit/check.h"

enum {
    MAP_PX = HELP_LAMP_MAP_PX,
    SIDE_PX = 400,
    VIEWS = 20,
    LONG_PX = 1600,
    SHORT_PX = 48,
    FINE_PX = 8
};

static const struct gn_plan *draw(int camera, int technique, int encoding) {
    return help_lamp_draw(camera, technique, encoding, SIDE_PX, SIDE_PX);
}

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
    help_lamp_load(&maker);
    assert_int_equal(lamp.scene->camera_count, 3 * VIEWS);
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
};
#define SEAMS                                                                                      \
    {GN_TECHNIQUE_HARD, GN_ENCODING_R16F, 1, 24, 0, 0, 0, 0, 0, 0},                                \
        {GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH, 1, 24, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_PCF2, GN_ENCODING_DEPTH, 1, 24, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_PCF, GN_ENCODING_DEPTH, 4, 36, 0, 0, 0, 0, 0, 0},                            \
        {GN_TECHNIQUE_PCF, GN_ENCODING_R32UI, 4, 36, 0, 0, 0, 0, 0, 0},                            \
        {GN_TECHNIQUE_PCF3, GN_ENCODING_DEPTH, 4, 36, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_PCF5, GN_ENCODING_DEPTH, 9, 56, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_PCF5, GN_ENCODING_RGBA8, 9, 56, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_BOX3, GN_ENCODING_DEPTH, 4, 48, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_BOX5, GN_ENCODING_DEPTH, 9, 64, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_DISK, GN_ENCODING_R16F, 16, 60, 0, 0, 0, 0, 0, 0},                           \
        {GN_TECHNIQUE_POISSON, GN_ENCODING_R16F, 16, 60, 0, 0, 0, 0, 0, 0},                        \
        {GN_TECHNIQUE_CONE, GN_ENCODING_DEPTH, 12, 60, 0, 0, 0, 0, 0, 0},                          \
        {GN_TECHNIQUE_PCSS, GN_ENCODING_R16F, 16, 60, 0, 0, 0, 0, 0, 0}, {                         \
        GN_TECHNIQUE_PCSS, GN_ENCODING_DEPTH, 16, 60, 0, 0, 0, 0, 0, 0                             \
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
        if (!gn_truth_make(&truth, lamp.scene, &opts, &err)) fail_msg("%s", err.text);
        gn_mask_edges(&truth.mask, edges);
        for (int c = 0; c < CELLS; c++) {
            draw((int)view, cells[c].technique, cells[c].encoding);
            if (!gn_gl_read_f32(lamp.gl, picture, &err)) fail_msg("%s", err.text);
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
    gn_ray_eye_init(&t.eye, &lamp.pose, camera, t.width, t.height);
    gn_ray_lamp_init(&t.lamp, &lamp.pose, 0);
    for (int i = 0; i < t.width * (t.height - 1); i++) {
        double corner, v[3];
        direction_of(&t, i, v);
        const double seam = from_seam(v, &corner);
        double below = step(picture, i, i + t.width),
               beside = (i + 1) % t.width ? step(picture, i, i + 1) : 0;
        double next = i % t.width + 2 < t.width ? step(picture, i, i + 2) : 0;
        if (i / t.width + 2 < t.height) next = fmax(next, step(picture, i, i + 2 * t.width));
        double *most = seam > 6 ? &s->plain : corner < 2 ? &s->corner_step : &s->step;
        s->pairs += seam < 2 ? 2 : 0;
        if (seam < 2 || seam > 6) *most = fmax(*most, fmax(below, seam > 6 ? next : beside));
    }
}

static void look_at_strips(struct seams *cells, int count) {
    static float picture[4 * LONG_PX * SHORT_PX];
    struct gn_err err = {0};
    for (uint32_t camera = VIEWS; camera < 3 * VIEWS; camera++)
        for (int c = 0; c < count; c++) {
            bool across = camera % 2;
            help_lamp_draw((int)camera, cells[c].technique, cells[c].encoding,
                           across ? SHORT_PX : LONG_PX, across ? LONG_PX : SHORT_PX);
            if (!gn_gl_read_f32(lamp.gl, picture, &err)) fail_msg("%s", err.text);
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
    help_lamp_unload(state);
    load_sets("[0,0,0,1]", true);
    look_at_strips(cells + MASKED, 3);
    help_lamp_unload(state);
    load_sets("[0.35,0.12,-0.25,0.894762]", false);
    look_at_strips(cells, CELLS);
    for (int c = 0; c < CELLS; c++) {
        const struct seams *s = &cells[c];
        printf("%-7s %-6s %d pairs at seams differ by %.3f at most, at corners by %.3f, without a "
               "seam by %.3f; a tap is %.3f\n",
               gn_techniques[s->technique].name, gn_encodings[s->encoding].name, s->pairs, s->step,
               s->corner_step, s->plain, 1 / s->fetches);
        assert_true(s->pairs > 1000000 && s->plain > 0);
        assert_true(fmax(s->step, s->corner_step) <= fmax(1 / s->fetches, s->plain));
    }
}

static double most_across(uint32_t camera, const float *picture, int width, int height,
                          int *pairs) {
    struct strip t = {.width = width, .height = height};
    double most = 0, v[3];
    gn_ray_eye_init(&t.eye, &lamp.pose, camera, width, height);
    gn_ray_lamp_init(&t.lamp, &lamp.pose, 0);
    for (int i = 0; i < width * (height - 1); i++) {
        const int tile = direction_of(&t, i, v), below = i + width;
        const int beside = (i + 1) % width ? i + 1 : i;
        if (direction_of(&t, below, v) != tile)
            most = fmax(most, step(picture, i, below)), ++*pairs;
        if (direction_of(&t, beside, v) != tile)
            most = fmax(most, step(picture, i, beside)), ++*pairs;
    }
    return most;
}

/* Pixels of 50 um, a 700th of a texel: between two of them taps leave a texel one by one, unless an
 * edge of tiles makes several leave at once. Where a tap of a blocker search leaves one, the
 * filter's width changes, too, and may take another tap along. The strips of before, in pieces:
 * all, or every sixth. */
static void test_across_an_edge_of_tiles_one_tap_changes(void **state) {
    (void)state;
    enum { REACH = 9 };
    static float picture[4 * LONG_PX * FINE_PX];
    struct seams cells[] = {SEAMS};
    enum { CELLS = sizeof cells / sizeof *cells };
    const float piece_m = LONG_PX * 50e-6f;
    const int every = gn_shot_full() ? 1 : 6;
    struct gn_err err = {0};
    for (uint32_t camera = VIEWS; camera < 3 * VIEWS; camera++) {
        const bool across = camera % 2;
        const int width = across ? FINE_PX : LONG_PX, height = across ? LONG_PX : FINE_PX;
        vec4 *world = lamp.pose.world_from_node[lamp.scene->cameras[camera].node];
        vec3 middle;
        glm_vec3_copy(world[3], middle);
        lamp.scene->cameras[camera].xmag_m = 0.5f * piece_m * (float)width / LONG_PX;
        lamp.scene->cameras[camera].ymag_m = 0.5f * piece_m * (float)height / LONG_PX;
        for (int at = -REACH; at <= REACH; at += every) {
            glm_vec3_copy(middle, world[3]);
            glm_vec3_muladds(world[across], piece_m * (float)at, world[3]);
            for (int c = 0; c < CELLS; c++) {
                help_lamp_draw((int)camera, cells[c].technique, cells[c].encoding, width, height);
                if (!gn_gl_read_f32(lamp.gl, picture, &err)) fail_msg("%s", err.text);
                double most = most_across(camera, picture, width, height, &cells[c].pairs);
                cells[c].step = fmax(cells[c].step, most);
            }
        }
    }
    for (int c = 0; c < CELLS; c++) {
        const struct seams *s = &cells[c];
        printf("%-7s %-6s %d pairs across edges differ by %.4f at most; a tap is %.4f\n",
               gn_techniques[s->technique].name, gn_encodings[s->encoding].name, s->pairs, s->step,
               1 / s->fetches);
        assert_true(s->pairs > 100000);
        const bool searches =
            gn_techniques[s->technique].searches && gn_techniques[s->technique].soft;
        assert_true(s->step <= (searches ? 2 : 1) / s->fetches + 1.0 / 1400);
    }
}

/* The range ends on the squares: of what throws and takes shadows a part lies beyond it. */
static void test_shadows_end_where_the_range_does(void **state) {
    (void)state;
    static const int encodings[] = {GN_ENCODING_R16F, GN_ENCODING_DEPTH, GN_ENCODING_RGBA8};
    static float picture[4 * SIDE_PX * SIDE_PX], edges[SIDE_PX * SIDE_PX];
    int dark = 0, beyond = 0, wrong = 0;
    lamp.scene->lights[0].range_m = 3.1f;
    for (uint32_t view = 0; view < VIEWS; view += 5) {
        struct gn_truth truth;
        struct gn_truth_opts opts = {.width_px = SIDE_PX, .height_px = SIDE_PX, .camera = view};
        struct gn_err err = {0};
        if (!gn_truth_make(&truth, lamp.scene, &opts, &err)) fail_msg("%s", err.text);
        gn_mask_edges(&truth.mask, edges);
        for (int e = 0; e < 3; e++) {
            draw((int)view, GN_TECHNIQUE_HARD, encodings[e]);
            if (!gn_gl_read_f32(lamp.gl, picture, &err)) fail_msg("%s", err.text);
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_shadows_are_right_where_tiles_meet, load_seams,
                                        help_lamp_unload),
        cmocka_unit_test_setup_teardown(test_there_is_no_seam_between_tiles, load_seams,
                                        help_lamp_unload),
        cmocka_unit_test_setup_teardown(test_across_an_edge_of_tiles_one_tap_changes, load_seams,
                                        help_lamp_unload),
        cmocka_unit_test_setup_teardown(test_shadows_end_where_the_range_does, load_seams,
                                        help_lamp_unload),
    };
    return cmocka_run_group_tests_name("seams", tests, help_lamp_open, help_lamp_close);
}
