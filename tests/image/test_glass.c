/* Clear coat and transmission against closed forms, in a uniform environment: a coat over black is
 * Fresnel's reflectance (Schlick's form of it), a pane of tint t before a known background is t x
 * background x (1 - F) + what it reflects. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/ball.h"
#include "image/shot.h"
#include "unit/check.h"

enum { SIDE = 120, RADIUS = 54 }; /* pixels */

static char folder[512], uniform[600], dark[600];
static const double behind[3] = {0.5, 0.25, 0.8};

/* One sphere, or a square that faces the eye, of one material, before `behind`. */
struct thing {
    const char *material;
    bool square, textured; /* the texture: left half 0, right half 255 */
    bool open;             /* the sphere lacks two facets, at a pole */
    const char *light;     /* of that intensity along the view, no sky; NULL: none */
};

static const char *write_thing(const struct thing *t) {
    static char path[600];
    static const float corners[] = {-.9f, .9f, 0, -.9f, -.9f, 0, .9f, -.9f, 0, .9f, .9f, 0},
                       normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1},
                       uv[] = {0, 0, 0, 1, 1, 1, 1, 0};
    static const uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    static const uint8_t texels[] = {0, 0, 0, 255, 255, 255, 255, 255};
    struct gn_maker maker;
    struct gn_err err = {0};
    char text[300];
    gn_maker_init(&maker);
    int first = 0, last = 2;
    if (t->square) {
        first = gn_maker_accessor(&maker, "VEC3", 5126, 4, corners, sizeof corners,
                                  "'min':[-0.9,-0.9,0],'max':[0.9,0.9,0]");
        gn_maker_accessor(&maker, "VEC3", 5126, 4, normals, sizeof normals, NULL);
        gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
        last = gn_maker_accessor(&maker, "SCALAR", 5123, 6, indices, sizeof indices, NULL);
    } else {
        first = gn_ball_add(&maker, 0.9f);
        json_t *indices_of =
            json_array_get(json_object_get(maker.root, "accessors"), (size_t)first + 2);
        const json_int_t count = json_integer_value(json_object_get(indices_of, "count"));
        if (t->open) json_object_set_new(indices_of, "count", json_integer(count - 12));
    }
    snprintf(text, sizeof text,
             "[{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d%s},'indices':%d,"
             "'material':0}]}]",
             first, first + 1, t->square ? ",'TEXCOORD_0':2" : "", last);
    gn_maker_set(&maker, "meshes", text);
    snprintf(text, sizeof text, "[{%s}]", t->material);
    gn_maker_set(&maker, "materials", text);
    if (t->textured) {
        struct gn_made png = gn_maker_png(2, 1, texels);
        snprintf(text, sizeof text, "[{'bufferView':%d,'mimeType':'image/png'}]",
                 gn_maker_view(&maker, png.data, png.size));
        free(png.data);
        gn_maker_set(&maker, "images", text);
        gn_maker_set(&maker, "samplers", "[{'magFilter':9728,'minFilter':9728,'wrapS':33071}]");
        gn_maker_set(&maker, "textures", "[{'source':0,'sampler':0}]");
    }
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':1,'ymag':1,'znear':1,'zfar':9}}]");
    gn_maker_set(&maker, "nodes", "[{'mesh':0},{'camera':0,'translation':[0,0,5]}]");
    if (t->light) {
        gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
        snprintf(text, sizeof text,
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':%s}]}}",
                 t->light);
        gn_maker_set(&maker, "extensions", text);
        gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    }
    snprintf(text, sizeof text, "[{'nodes':[0,1%s],'extras':{'gnomon_background':[%g,%g,%g]%s}}]",
             t->light ? ",2" : "", behind[0], behind[1], behind[2],
             t->light ? ",'gnomon_sky':0,'gnomon_ground':0" : "");
    gn_maker_set(&maker, "scenes", text);
    snprintf(path, sizeof path, "%s/thing.glb", folder);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static struct gn_picture draw(const struct thing *thing, const char *environment) {
    struct gn_picture picture;
    struct gn_err err = {0};
    const char *const args[] = {"--environment", environment, "--output", "linear",  "--size",
                                "120x120",       "--shadow",  "none",     "--floor", "none",
                                "--exposure",    "0",         NULL};
    if (!gn_shot(&picture, NULL, &err, "pfm", write_thing(thing), args)) fail_msg("%s", err.text);
    return picture;
}

static double schlick(double n_v) { return 0.04 + 0.96 * pow(1 - n_v, 5); }

/* Compares every pixel of a sphere but its rim with what `wanted` makes of F. The fit of the split
 * sum is .07 below Schlick's form at grazing angles, and within .016 where the cosine is over .4.
 */
static void compare_sphere(const struct gn_picture *picture, const char *what,
                           void (*wanted)(double f, double color[3])) {
    double worst = 0, worst_inside = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const double dx = x + .5 - SIDE / 2, dy = y + .5 - SIDE / 2;
            const double from = sqrt(dx * dx + dy * dy) / RADIUS;
            if (from > 0.985) continue;
            const double n_v = sqrt(1 - from * from);
            double color[3];
            wanted(schlick(n_v), color);
            for (int k = 0; k < 3; k++) {
                const double off = fabs((double)gn_picture_at(picture, x, y)[k] - color[k]);
                worst = fmax(worst, off);
                if (n_v > 0.4) worst_inside = fmax(worst_inside, off);
            }
        }
    print_message("%s: off by at most %.4f, where the cosine is over .4 %.4f\n", what, worst,
                  worst_inside);
    if (worst > 0.07 || worst_inside > 0.016) fail_msg("%s: %.4f, %.4f", what, worst, worst_inside);
}

#define BLACK                                                                                      \
    "'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':1,'baseColorFactor':[0,0,0,1]}," \
    "'extensions':{'KHR_materials_specular':{'specularFactor':0},'KHR_materials_clearcoat':{"

static void coat_of_one(double f, double color[3]) { color[0] = color[1] = color[2] = f; }
static void coat_of_half(double f, double color[3]) { color[0] = color[1] = color[2] = f / 2; }

static void test_a_coat_over_black_is_its_reflectance(void **state) {
    (void)state;
    const struct thing one = {.material = BLACK "'clearcoatFactor':1}}"},
                       half = {.material = BLACK "'clearcoatFactor':0.5}}"};
    struct gn_picture picture = draw(&one, uniform);
    compare_sphere(&picture, "coat", coat_of_one);
    gn_picture_finish(&picture);
    picture = draw(&half, uniform);
    compare_sphere(&picture, "half a coat", coat_of_half);
    gn_picture_finish(&picture);
}

/* A light along the view on a plane that faces it: the half vector is the normal, and the lobe of
 * the coat is its normalisation, exponent / 8 + 1 = 2500.75, times F = .04. */
static void test_a_light_has_a_highlight_in_the_coat(void **state) {
    (void)state;
    const struct thing thing = {BLACK "'clearcoatFactor':1,'clearcoatRoughnessFactor':0.1}}",
                                .square = true, .light = "0.01"};
    const double wanted = 0.01 / acos(-1) * 0.04 * 2500.75;
    struct gn_picture picture = draw(&thing, "none");
    const double got = (double)*gn_picture_at(&picture, 30, 40);
    print_message("highlight: %.4f, not %.4f\n", got, wanted);
    assert_true(fabs(got / wanted - 1) < 0.05);
    gn_picture_finish(&picture);
}

/* What the coat reflects does not reach what is below it: emission at normal incidence. */
static void test_a_coat_dims_what_is_below(void **state) {
    (void)state;
    const struct thing thing = {"'emissiveFactor':[1,0.5,0]," BLACK "'clearcoatFactor':1}}",
                                .square = true};
    struct gn_picture picture = draw(&thing, dark);
    const float *got = gn_picture_at(&picture, 30, 40);
    assert_true(fabs((double)got[0] - 0.96) < 0.005 && fabs((double)got[1] - 0.48) < 0.005);
    gn_picture_finish(&picture);
}

/* ---- glass ---- */

#define GLASS(color, rest)                                                                         \
    "'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':0,'baseColorFactor':" color      \
    "},'extensions':{'KHR_materials_transmission':{'transmissionFactor':1}}" rest

static void white_glass(double f, double color[3]) {
    for (int k = 0; k < 3; k++) color[k] = behind[k] * (1 - f) + f;
}
static void grey_glass(double f, double color[3]) {
    for (int k = 0; k < 3; k++) color[k] = 0.5 * behind[k] * (1 - f) + f;
}
static const double tint[3] = {0.2, 0.7, 1};
static void green_glass(double f, double color[3]) {
    for (int k = 0; k < 3; k++) color[k] = tint[k] * behind[k] * (1 - f) + f;
}
/* Both sides of a sphere: each reflects, and the light is tinted once where it is watertight. */
static void green_ball(double f, double color[3]) {
    for (int k = 0; k < 3; k++) color[k] = tint[k] * (behind[k] * (1 - f) + f) * (1 - f) + f;
}
static void grey_ball(double f, double color[3]) {
    for (int k = 0; k < 3; k++) color[k] = 0.5 * (behind[k] * (1 - f) + f) * (1 - f) + f;
}
static void two_walls(double f, double color[3]) {
    double once[3];
    green_glass(f, once);
    for (int k = 0; k < 3; k++) color[k] = tint[k] * once[k] * (1 - f) + f;
}
/* Alpha is what is covered at all, reflections included. */
static void half_there(double f, double color[3]) {
    green_glass(f, color);
    for (int k = 0; k < 3; k++) color[k] = 0.5 * color[k] + 0.5 * behind[k];
}

static void test_glass_tints_what_is_behind_and_reflects_wholly(void **state) {
    (void)state;
    static const struct {
        const char *what, *material;
        void (*wanted)(double f, double color[3]);
        bool open;
    } glasses[] = {
        {"white", GLASS("[1,1,1,1]", ""), white_glass, false},
        {"grey", GLASS("[0.5,0.5,0.5,1]", ""), grey_glass, false},
        {"green", GLASS("[0.2,0.7,1,1]", ""), green_glass, false},
        {"opaque, whatever its alpha", GLASS("[0.2,0.7,1,0.1]", ""), green_glass, false},
        {"green, both sides", GLASS("[0.2,0.7,1,1]", ",'doubleSided':true"), green_ball, false},
        {"grey, both sides", GLASS("[0.5,0.5,0.5,1]", ",'doubleSided':true"), grey_ball, false},
        {"two walls", GLASS("[0.2,0.7,1,1]", ",'doubleSided':true"), two_walls, true},
        {"half there", GLASS("[0.2,0.7,1,0.5]", ",'alphaMode':'BLEND'"), half_there, false},
    };
    for (size_t i = 0; i < sizeof glasses / sizeof *glasses; i++) {
        const struct thing thing = {.material = glasses[i].material, .open = glasses[i].open};
        struct gn_picture picture = draw(&thing, uniform);
        compare_sphere(&picture, glasses[i].what, glasses[i].wanted);
        gn_picture_finish(&picture);
    }
}

static void check_at(const struct gn_picture *picture, int x, const double wanted[3]) {
    const float *got = gn_picture_at(picture, x, SIDE / 2);
    for (int k = 0; k < 3; k++)
        if (fabs((double)got[k] - wanted[k]) > 0.01)
            fail_msg("at %d: %.3f %.3f %.3f, not %.3f %.3f %.3f", x, (double)got[0], (double)got[1],
                     (double)got[2], wanted[0], wanted[1], wanted[2]);
}

/* Halves of a pane: opaque on the left. Of a share the rest is diffuse, in the uniform light. */
static void test_a_texture_says_where_and_a_factor_how_much(void **state) {
    (void)state;
    double wanted[3];
    const struct thing pane = {
        "'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':0,'baseColorFactor':"
        "[0.2,0.7,1,1]},'extensions':{'KHR_materials_transmission':{'transmissionFactor':0.75,"
        "'transmissionTexture':{'index':0}}}",
        .square = true, .textured = true};
    struct gn_picture picture = draw(&pane, uniform);
    for (int k = 0; k < 3; k++) wanted[k] = tint[k] * 0.96 + 0.04;
    check_at(&picture, 30, wanted);
    for (int k = 0; k < 3; k++) wanted[k] = tint[k] * (0.25 + 0.75 * behind[k]) * 0.96 + 0.04;
    check_at(&picture, 90, wanted);
    gn_picture_finish(&picture);
}

static void test_textures_of_a_coat(void **state) {
    (void)state;
    const struct thing coat = {BLACK "'clearcoatFactor':1,'clearcoatTexture':{'index':0}}}",
                               .square = true, .textured = true};
    struct gn_picture picture = draw(&coat, uniform);
    check_at(&picture, 30, (double[3]){0, 0, 0});
    check_at(&picture, 90, (double[3]){0.04, 0.04, 0.04});
    gn_picture_finish(&picture);
}

static int set_up(void **state) {
    (void)state;
    char build[PATH_MAX];
    if (!realpath(gn_shot_build(), build)) return 1;
    snprintf(folder, sizeof folder, "%.400s/glass.%d", build, (int)getpid());
    mkdir(folder, 0700);
    setenv("XDG_CACHE_HOME", folder, 1);
    snprintf(uniform, sizeof uniform, "%s/uniform.hdr", folder);
    snprintf(dark, sizeof dark, "%s/dark.hdr", folder);
    return gn_uniform_write(uniform, 0) && gn_uniform_write(dark, -60) ? 0 : 1;
}

static int tear_down(void **state) {
    (void)state;
    char command[600];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) != 0; /* NOLINT: a path of our own */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_coat_over_black_is_its_reflectance),
        cmocka_unit_test(test_a_light_has_a_highlight_in_the_coat),
        cmocka_unit_test(test_a_coat_dims_what_is_below),
        cmocka_unit_test(test_textures_of_a_coat),
        cmocka_unit_test(test_glass_tints_what_is_behind_and_reflects_wholly),
        cmocka_unit_test(test_a_texture_says_where_and_a_factor_how_much),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
