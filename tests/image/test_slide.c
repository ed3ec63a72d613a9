/* Slides against a projection of the same texels in double precision: every pixel's place comes
 * from the ray caster, the slide's from its definition (where the ray from the lamp crosses the
 * film), the light's from the contract. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "truth/raycast.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { WIDTH = 640, HEIGHT = 480, TEXELS_X = 8, TEXELS_Y = 6, REPEAT = 10497, CLAMP = 33071 };
enum { MIRROR = 33648, NEAREST = 9728, LINEAR = 9729, TRILINEAR = 9987 };
#define INTENSITY 20.0

/* A beam over the stage: a ground of 8 m, a wall behind it, a plate of 1 m that casts. */
struct beam {
    const char *name;
    const char *node;      /* translation and rotation of the lamp */
    double inner, outer;   /* radians */
    double range_m;        /* 0: unlimited */
    double size_m[2];      /* 0, 0: not in the file */
    double distance_m;     /* 0: not in the file */
    const char *outside;   /* NULL: not in the file */
    int filter, wrap;      /* glTF's numbers */
    const char *technique; /* --shadow */
    bool checker;          /* a fine checkerboard instead of eight by six colours */
    double far_m;          /* 0: not in the file */
};

static uint8_t texels[TEXELS_Y][TEXELS_X][4];

static void make_texels(void) {
    uint32_t dice = 12345;
    for (size_t i = 0; i < sizeof texels; i++) {
        dice = dice * 1664525u + 1013904223u;
        ((uint8_t *)texels)[i] = (uint8_t)(i % 4 == 3 ? 255 : dice >> 24);
    }
    texels[2][3][3] = 128; /* half and fully clear film */
    texels[3][5][3] = 0;
}

/* ---- the scene ---- */

static struct gn_made checkerboard(void) {
    static uint8_t fine[256][256][4];
    for (int i = 0; i < 256 * 256; i++)
        memset(fine[i / 256][i % 256], (i % 256 + i / 256) % 2 ? 255 : 0, 3);
    for (int i = 0; i < 256 * 256; i++) fine[i / 256][i % 256][3] = 255;
    return gn_maker_png(256, 256, &fine[0][0][0]);
}

static void add_picture(struct gn_maker *maker, const struct beam *beam) {
    char json[200];
    struct gn_made png =
        beam->checker ? checkerboard() : gn_maker_png(TEXELS_X, TEXELS_Y, &texels[0][0][0]);
    snprintf(json, sizeof json, "[{'bufferView':%d,'mimeType':'image/png'}]",
             gn_maker_view(maker, png.data, png.size));
    free(png.data);
    gn_maker_set(maker, "images", json);
    snprintf(json, sizeof json, "[{'magFilter':%d,'minFilter':%d,'wrapS':%d,'wrapT':%d}]",
             beam->filter, beam->filter == NEAREST ? NEAREST : TRILINEAR, beam->wrap, beam->wrap);
    gn_maker_set(maker, "samplers", json);
    gn_maker_set(maker, "textures", "[{'source':0,'sampler':0}]");
}

static void add_lamp(struct gn_maker *maker, const struct beam *beam, bool with_slide) {
    char json[600], node[300];
    int n = snprintf(json, sizeof json,
                     "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':%g,'spot':{"
                     "'innerConeAngle':%g,'outerConeAngle':%.9g}",
                     INTENSITY, beam->inner, beam->outer);
    if (beam->range_m > 0) n += sprintf(json + n, ",'range':%g", beam->range_m);
    if (with_slide) n += sprintf(json + n, ",'extras':{'gnomon_slide':0");
    if (with_slide && beam->size_m[0] > 0)
        n += sprintf(json + n, ",'gnomon_slide_size_m':[%g,%g]", beam->size_m[0], beam->size_m[1]);
    if (with_slide && beam->distance_m > 0)
        n += sprintf(json + n, ",'gnomon_slide_distance_m':%g", beam->distance_m);
    if (with_slide && beam->far_m > 0)
        n += sprintf(json + n, ",'gnomon_slide_far_m':%g", beam->far_m);
    if (with_slide && beam->outside)
        n += sprintf(json + n, ",'gnomon_slide_outside':'%s'", beam->outside);
    sprintf(json + n, "%s}]}}", with_slide ? "}" : "");
    gn_maker_set(maker, "extensions", json);
    gn_maker_set(maker, "extensionsUsed", "['KHR_lights_punctual']");
    snprintf(node, sizeof node, "{%s,'extensions':{'KHR_lights_punctual':{'light':0}}}",
             beam->node);
    gn_maker_add(maker, "nodes", node);
}

static const char *make_scene(const struct beam *beam, bool with_slide) {
    static char path[600];
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    add_picture(&maker, beam);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':1}}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[4,1,4]},"
                 "{'mesh':0,'translation':[0,2,-4],'rotation':[0.70710678,0,0,0.70710678],"
                 "'scale':[4,1,2]},"
                 "{'mesh':0,'translation':[0.6,0.8,0],'scale':[0.5,1,0.5]},"
                 "{'camera':0,'translation':[0,4.5,7],'rotation':[-0.258819,0,0,0.9659258]}]");
    add_lamp(&maker, beam, with_slide);
    gn_maker_set(&maker, "scenes",
                 "[{'nodes':[0,1,2,3,4],"
                 "'extras':{'gnomon_sky':0,'gnomon_ground':0,'gnomon_background':0}}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':40}}]");
    snprintf(path, sizeof path, "%s/slide.glb", gn_shot_build());
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static void shoot(struct gn_picture *picture, const char *path, const char *aov,
                  const char *technique) {
    struct gn_err err = {0};
    const char *const args[] = {"--aov",    aov,       "--size",     "640x480", "--backend", "egl",
                                "--shadow", technique, "--exposure", "0",       NULL};
    if (!gn_shot(picture, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
}

/* ---- what is true ---- */

static double linear_of(uint8_t code) {
    double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static int wrap(int i, int count, int how) {
    if (how == CLAMP) return i < 0 ? 0 : i >= count ? count - 1 : i;
    int period = how == MIRROR ? 2 * count : count;
    i = (i % period + period) % period;
    return i >= count ? period - 1 - i : i;
}

/* RGBA of the picture at u, v as OpenGL ES 3.0, 3.8.10, has it at level 0. */
static void sample(const struct beam *beam, double u, double v, double out[4]) {
    double x = u * TEXELS_X, y = v * TEXELS_Y, weight[2][2] = {{1, 0}, {0, 0}};
    if (beam->filter == LINEAR) {
        double fx = x - 0.5 - floor(x - 0.5), fy = y - 0.5 - floor(y - 0.5);
        for (int k = 0; k < 4; k++)
            weight[k / 2][k % 2] = (k % 2 ? fx : 1 - fx) * (k / 2 ? fy : 1 - fy);
        x -= 0.5, y -= 0.5;
    }
    memset(out, 0, 4 * sizeof *out);
    for (int k = 0; k < 4; k++) {
        const uint8_t *texel = texels[wrap((int)floor(y) + k / 2, TEXELS_Y, beam->wrap)]
                                     [wrap((int)floor(x) + k % 2, TEXELS_X, beam->wrap)];
        for (int c = 0; c < 4; c++)
            out[c] += weight[k / 2][k % 2] * (c < 3 ? linear_of(texel[c]) : texel[c] / 255.0);
    }
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct lamp {
    double at[3], axes[3][3]; /* x, y, z of its node */
};

/* Where the film is, and how large: what the file says, else as the design has it. */
static void place_film(const struct beam *beam, double *distance, double size[2]) {
    double cone = 2 * tan(fmin(beam->outer, 80 * M_PI / 180));
    *distance = beam->distance_m > 0 ? beam->distance_m : 1;
    size[0] = size[1] = cone * *distance;
    if (beam->size_m[0] <= 0) return;
    memcpy(size, beam->size_m, sizeof beam->size_m);
    if (beam->distance_m <= 0) *distance = fmax(size[0], size[1]) / cone;
}

/* What the slide leaves of the light to a point that lies at x, y, depth before the lamp. */
static void slide_factor(const struct beam *beam, double x, double y, double depth, double out[3]) {
    double distance, size[2], color[4];
    bool film = beam->outside && strcmp(beam->outside, "lit") == 0;
    bool has_plane = beam->distance_m > 0 || beam->size_m[0] > 0;
    place_film(beam, &distance, size);
    double u = 0.5 + x * distance / depth / size[0], v = 0.5 - y * distance / depth / size[1];
    for (int c = 0; c < 3; c++) out[c] = film;
    if (beam->far_m > 0 && depth >= beam->far_m) return;
    if (depth <= (has_plane ? distance : 0) || fabs(u - 0.5) > 0.5 || fabs(v - 0.5) > 0.5) return;
    sample(beam, u, v, color);
    for (int c = 0; c < 3; c++) out[c] = 1 - color[3] * (1 - color[c]);
}

static void light_of(const struct beam *beam, const struct lamp *lamp,
                     const struct gn_ray_surface *s, double out[3]) {
    double from[3];
    for (int k = 0; k < 3; k++) from[k] = s->point_ws[k] - lamp->at[k];
    double d2 = dot(from, from), d = sqrt(d2), depth = -dot(from, lamp->axes[2]);
    double facing = fmax(-dot(from, s->normal_ws) / d, 0);
    double t = (depth / d - cos(beam->outer)) / (cos(beam->inner) - cos(beam->outer));
    t = fmin(fmax(t, 0), 1);
    double window = beam->range_m > 0 ? fmax(1 - pow(d / beam->range_m, 4), 0) : 1;
    double light = INTENSITY / M_PI * facing / d2 * window * t * t * (3 - 2 * t);
    slide_factor(beam, dot(from, lamp->axes[0]), dot(from, lamp->axes[1]), depth, out);
    for (int c = 0; c < 3; c++) out[c] *= light;
}

/* ---- comparing ---- */

struct verdict {
    int pixels, bad;   /* of the lit or truly dark surfaces; more than 2/255 off */
    int dark, leaking; /* truly dark ones; not exactly 0 */
    int bright;        /* truly over .1 */
    double worst;
};

static void judge(struct verdict *verdict, const float *shown, const double truth[3], double seen) {
    double off = 0, sum = 0, shown_sum = 0;
    for (int c = 0; c < 3; c++) {
        double wanted = truth[c] * seen;
        off = fmax(off, fabs(fmin(shown[c], 1) - fmin(wanted, 1)));
        sum += wanted;
        shown_sum += shown[c];
        if (!isfinite(shown[c])) off = INFINITY;
    }
    verdict->pixels++;
    verdict->bad += off > 2 / 255.0;
    verdict->worst = fmax(verdict->worst, off);
    verdict->bright += sum > 0.1;
    verdict->dark += sum == 0;
    verdict->leaking += sum == 0 && shown_sum != 0;
}

static struct lamp lamp_of(const struct gn_pose *pose) {
    struct lamp lamp;
    vec4 *world = pose->world_from_node[pose->scene->lights[0].node];
    for (int k = 0; k < 3; k++) {
        lamp.at[k] = (double)world[3][k];
        for (int axis = 0; axis < 3; axis++) lamp.axes[axis][k] = (double)world[axis][k];
    }
    return lamp;
}

static struct verdict compare(const struct beam *beam) {
    struct gn_err err = {0};
    struct gn_picture shown, seen = {0};
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct verdict verdict = {0};
    const char *path = make_scene(beam, true);
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, 0, WIDTH, HEIGHT);
    const struct lamp lamp = lamp_of(&pose);
    shoot(&shown, path, "color", beam->technique);
    shoot(&seen, path, "visibility", beam->technique);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        struct gn_ray_surface surface;
        double truth[3];
        if (!gn_raycast_eye(&rays, &eye, i % WIDTH, i / WIDTH, &surface)) continue;
        light_of(beam, &lamp, &surface, truth);
        judge(&verdict, &shown.data[3 * i], truth, (double)seen.data[i]);
    }
    gn_picture_finish(&shown);
    gn_picture_finish(&seen);
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    remove(path);
    return verdict;
}

/* Down on the ground from (0, 3.5, 1); -Z of the node is down, +Y to the wall. */
#define ABOVE  "'translation':[0,3.5,1],'rotation':[-0.70710678,0,0,0.70710678]"
/* The same, turned by 30 degrees about its axis. */
#define ROLLED "'translation':[0,3.5,1],'rotation':[-0.6830127,0.1830127,0.1830127,0.6830127]"
/* From the front left, to the right and to the wall's foot. */
#define ASLANT "'translation':[-2.5,2.5,2.5],'rotation':[-0.2,-0.3,-0.0655,0.9305]"

static const struct beam beams[] = {
    {"dark, as large as the cone", ABOVE, .4, .6, 0, {0}, 0, NULL, LINEAR, CLAMP, "none", false, 0},
    {"dark, rolled", ROLLED, .5, .8, 0, {.5, .3}, .5, "dark", LINEAR, REPEAT, "none", false, 0},
    {"lit, aslant, ends",
     ASLANT,
     .5,
     .7,
     0,
     {.6, .9},
     .8,
     "lit",
     LINEAR,
     MIRROR,
     "none",
     false,
     4.5},
    {"lit, nearest", ASLANT, .5, .7, 6, {.8, .8}, 0, "lit", NEAREST, REPEAT, "none", false, 0},
    {"dark, nearest, rolled",
     ROLLED,
     .2,
     .7,
     4,
     {.9, .5},
     1,
     "dark",
     NEAREST,
     MIRROR,
     "none",
     false,
     0},
    {"dark over pcf, ends",
     ASLANT,
     .5,
     .7,
     0,
     {1, 1},
     .9,
     "dark",
     LINEAR,
     CLAMP,
     "pcf",
     false,
     4.5},
    {"lit over hard", ABOVE, .5, .9, 0, {1.5, 1}, 2, "lit", LINEAR, CLAMP, "hard", false, 0},
    {"a film below the plate", ABOVE, .5, .9, 0, {1, 1}, 3, "lit", LINEAR, CLAMP, "none", false, 0},
    {"a slide below the plate",
     ABOVE,
     .5,
     .9,
     0,
     {1, 1},
     3,
     "dark",
     LINEAR,
     CLAMP,
     "none",
     false,
     0},
};

static void test_a_slide_is_the_projection_of_its_texels(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof beams / sizeof *beams; i++) {
        struct verdict v = compare(&beams[i]);
        print_message("%s: %.3f %% of %d pixels off by over 2/255, worst %.3f; %d bright\n",
                      beams[i].name, 100.0 * v.bad / v.pixels, v.pixels, v.worst, v.bright);
        assert_true(v.bright > 4000);
        assert_true(v.bad <= 0.005 * v.pixels);
    }
}

static void test_outside_and_behind_is_exactly_nothing(void **state) {
    (void)state;
    static const struct beam narrow = {"narrow", ABOVE,  .5,     .9,    0,     {.4, .4}, 1,
                                       "dark",   LINEAR, REPEAT, "pcf", false, 0};
    /* Half a sphere of light to +z, away from wall and plate, which lie at -z. */
    static const struct beam behind = {"behind", "'translation':[0,1,2],'rotation':[0,1,0,0]",
                                       1,        M_PI / 2,
                                       0,        {0},
                                       0,        NULL,
                                       LINEAR,   REPEAT,
                                       "none",   false,
                                       0};
    struct verdict v = compare(&narrow);
    assert_true(v.dark > 100000);
    assert_int_equal(v.leaking, 0);
    v = compare(&behind);
    assert_true(v.dark > 100000);
    assert_int_equal(v.leaking, 0);
}

/* The lamp hangs 5 cm over the ground and shines along it: w goes through 0 in the picture. */
static void test_where_w_is_nothing_there_is_no_fault(void **state) {
    (void)state;
    static const struct beam low[] = {
        {"low, dark",
         "'translation':[0,0.05,2]",
         1,
         1.3,
         0,
         {0},
         0,
         "dark",
         LINEAR,
         CLAMP,
         "none",
         false,
         0},
        {"low, lit",
         "'translation':[0,0.05,2]",
         1,
         1.5,
         0,
         {0},
         0,
         "lit",
         LINEAR,
         REPEAT,
         "none",
         false,
         0},
    };
    for (int i = 0; i < 2; i++) {
        struct verdict v = compare(&low[i]);
        print_message("%s: %.3f %% off, worst %.3f\n", low[i].name, 100.0 * v.bad / v.pixels,
                      v.worst);
        assert_true(v.bad <= 0.005 * v.pixels);
        assert_true(v.dark > 10000);
        assert_int_equal(v.leaking, 0);
    }
}

/* Of 256 x 256 squares, black and white, on a few dozen pixels only their mean is left. */
static void test_a_fine_slide_far_away_does_not_shimmer(void **state) {
    (void)state;
    static const struct beam fine = {"fine", ABOVE,  .3,    .4,     0,    {.1, .1}, 1,
                                     "dark", LINEAR, CLAMP, "none", true, 0};
    struct gn_picture shown, plain;
    shoot(&shown, make_scene(&fine, true), "color", "none");
    const char *path = make_scene(&fine, false);
    shoot(&plain, path, "color", "none");
    remove(path);
    int inside = 0, off = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        float share = shown.data[3 * i] / fmaxf(plain.data[3 * i], 1e-6f);
        inside += share > 0.25f;
        off += share > 0.25f && fabsf(share - 0.5f) > 0.03f;
    }
    gn_picture_finish(&shown);
    gn_picture_finish(&plain);
    print_message("%d pixels inside, %d not grey\n", inside, off);
    assert_true(inside > 300);
    assert_true(off < inside / 10); /* the frame's rim */
}

static int set_up(void **state) {
    (void)state;
    make_texels();
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_slide_is_the_projection_of_its_texels),
        cmocka_unit_test(test_outside_and_behind_is_exactly_nothing),
        cmocka_unit_test(test_where_w_is_nothing_there_is_no_fault),
        cmocka_unit_test(test_a_fine_slide_far_away_does_not_shimmer),
    };
    return cmocka_run_group_tests_name("slides", tests, set_up, NULL);
}
