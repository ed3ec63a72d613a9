/* Every kind of program compiles and links: each technique with each encoding and type of light,
 * each feature alone and all together, each way to fill a map, and as many lights as there may be.
 */
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gl_help.h"

static struct gn_display display;
static struct gn_gl *gl;

static void open_backend(const char *name) {
    help_open(&display, name);
    gl = help_gl(&display, NULL, NULL);
}

static int open_egl(void **state) {
    (void)state;
    open_backend("egl");
    return 0;
}

static int open_osmesa(void **state) {
    (void)state;
    open_backend("osmesa");
    return 0;
}

static int close_all(void **state) {
    (void)state;
    gn_gl_destroy(gl);
    gn_display_close(&display);
    return 0;
}

static struct gn_program_key key_of(enum gn_program_kind kind) {
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = (uint8_t)kind;
    return key;
}

static void add_light(struct gn_program_key *key, int type, int technique, int encoding) {
    struct gn_program_light *light = &key->lights[key->light_count++];
    light->type = (uint8_t)type;
    light->technique = (uint8_t)technique;
    light->encoding = (uint8_t)(technique ? encoding : 0);
    key->shadow_count += technique != GN_TECHNIQUE_NONE;
    light->taps = (uint8_t)gn_taps_count(gn_techniques[technique].taps, 0);
    if (light->taps) key->taps_turn = 1;
}

static void filter_map(struct gn_program_light *light, int moments) {
    light->encoding =
        gn_techniques[light->technique].reads_both ? GN_ENCODING_DEPTH : GN_ENCODING_R32UI;
    light->moments = (uint8_t)moments;
}

static void compiles(const struct gn_program_key *key) {
    struct gn_err err = {0};
    char *log = NULL;
    if (!gn_gl_try_program(gl, key, &log, &err)) fail_msg("%s\n%s", err.text, log ? log : "");
    free(log);
}

/* A mask and the stencil go with what is on a plane, and a plane with every light. */
static bool go_together(int technique, int encoding) {
    if (gn_technique_filters_map((enum gn_technique)technique)) return false;
    bool on_plane = gn_techniques[technique].on_plane;
    if (encoding == GN_ENCODING_DEPTH16) return false; /* has no programs of its own */
    return on_plane == (encoding >= GN_ENCODING_MASK);
}

/* Those that are there for comparison, in the quick form: each encoding with one type of light. */
static bool is_left_out(int technique, int encoding, int type) {
    const bool compares = technique == GN_TECHNIQUE_BOX3 || technique == GN_TECHNIQUE_BOX5 ||
                          technique == GN_TECHNIQUE_WHITE;
    return compares && !gn_shot_full() && (technique + encoding + type) % 3 != 0;
}

static void test_techniques(void **state) {
    (void)state;
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++)
        for (int e = 0; e < GN_ENCODING_COUNT; e++)
            for (int type = GN_LIGHT_DIRECTIONAL; type < GN_LIGHT_TYPE_COUNT; type++) {
                if (!go_together(t, e) || is_left_out(t, e, type)) continue;
                struct gn_program_key key = key_of(GN_PROGRAM_LIT);
                add_light(&key, type, t, e);
                compiles(&key);
                key.kind = GN_PROGRAM_AOV;
                key.aov = GN_AOV_VISIBILITY;
                compiles(&key);
                if (type != GN_LIGHT_DIRECTIONAL || gn_techniques[t].on_plane) continue;
                key.lights[0].cascades = 1;
                key.features = e % 2 ? GN_FEATURE(ALPHA_MASK) : 0; /* which shares no tiles */
                compiles(&key);
            }
}

/* What reads a value for each pixel, alone and beside a map. */
static void test_truth(void **state) {
    (void)state;
    for (int type = GN_LIGHT_DIRECTIONAL; type < GN_LIGHT_TYPE_COUNT; type++) {
        struct gn_program_key key = key_of(GN_PROGRAM_LIT);
        add_light(&key, type, GN_TECHNIQUE_TRUTH, GN_ENCODING_SCREEN);
        compiles(&key);
        key.kind = GN_PROGRAM_AOV;
        key.aov = GN_AOV_VISIBILITY;
        compiles(&key);
        key = key_of(GN_PROGRAM_LIT);
        add_light(&key, type, GN_TECHNIQUE_TRUTH, GN_ENCODING_SCREEN);
        add_light(&key, type, GN_TECHNIQUE_PCSS, GN_ENCODING_R16F);
        key.features = GN_FEATURE(ALPHA_MASK);
        compiles(&key);
    }
}

/* What reads a filtered map, and the steps of the filter. */
static void test_moments(void **state) {
    (void)state;
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++)
        for (int i = 0; i < GN_STORES_MAX && gn_techniques[t].stores[i]; i++) {
            for (int type = GN_LIGHT_DIRECTIONAL; type < GN_LIGHT_TYPE_COUNT; type++) {
                struct gn_program_key key = key_of(GN_PROGRAM_LIT);
                add_light(&key, type, t, 0);
                filter_map(&key.lights[0], gn_techniques[t].stores[i]);
                compiles(&key);
                key.kind = GN_PROGRAM_AOV;
                key.aov = GN_AOV_VISIBILITY;
                compiles(&key);
            }
            const struct gn_filter_row *filter = &gn_filters[gn_techniques[t].filter];
            for (uint32_t s = 0; s < 2 * filter->count; s++) {
                struct gn_program_key key = key_of(GN_PROGRAM_FILTER);
                key.step = (uint8_t)filter->stages[s / 2].step;
                key.moments = gn_techniques[t].stores[i];
                if (gn_filter_steps[key.step].reads_map) {
                    key.technique = (uint8_t)t;
                    key.encoding = s % 2 ? GN_ENCODING_R32UI : GN_ENCODING_RGBA8;
                    if (gn_techniques[t].reads_both) key.encoding = GN_ENCODING_DEPTH;
                }
                compiles(&key);
            }
        }
}

/* Files that several of them read come once, and what each names its own way does not collide. */
static void test_as_many_moments_as_may_be(void **state) {
    (void)state;
    static const struct {
        int technique, moments;
    } lights[][GN_SHADOWS_MAX] = {
        {{GN_TECHNIQUE_VSSM, GN_MOMENTS_TABLE_RGBA32UI},
         {GN_TECHNIQUE_SMSM, GN_MOMENTS_TABLE_RGBA32UI},
         {GN_TECHNIQUE_VSM, GN_MOMENTS_RGBA16UI},
         {GN_TECHNIQUE_VSSM, GN_MOMENTS_TABLE_RGBA32UI}},
        {{GN_TECHNIQUE_VSM, GN_MOMENTS_RG32UI},
         {GN_TECHNIQUE_EVSM, GN_MOMENTS_RGBA32F_SHARE},
         {GN_TECHNIQUE_MSM, GN_MOMENTS_RGBA16UI},
         {GN_TECHNIQUE_MSM, GN_MOMENTS_RGBA16F}},
        {{GN_TECHNIQUE_VSM, GN_MOMENTS_RGBA16UI},
         {GN_TECHNIQUE_VSM, GN_MOMENTS_RGBA16F},
         {GN_TECHNIQUE_EVSM, GN_MOMENTS_RGBA32F_SHARE},
         {GN_TECHNIQUE_MSM, GN_MOMENTS_RGBA32F_BITS}},
        {{GN_TECHNIQUE_CONE, GN_MOMENTS_CONE_RG16F},
         {GN_TECHNIQUE_MSM, GN_MOMENTS_RGBA16F},
         {GN_TECHNIQUE_CONE, GN_MOMENTS_CONE_BITS},
         {GN_TECHNIQUE_CONE, GN_MOMENTS_CONE_BYTES}},
    };
    for (size_t n = 0; n < sizeof lights / sizeof *lights; n++) {
        struct gn_program_key key = key_of(GN_PROGRAM_LIT);
        key.features = GN_FEATURE(SPECULAR);
        for (int i = 0; i < GN_SHADOWS_MAX; i++) {
            add_light(&key, i % 3, lights[n][i].technique, 0);
            filter_map(&key.lights[i], lights[n][i].moments);
        }
        compiles(&key);
    }
}

/* Each reads two textures; the slides beside them are fewer: src/frame/slides.c. */
static void test_as_many_samplers_as_may_be(void **state) {
    (void)state;
    struct gn_program_key key = key_of(GN_PROGRAM_LIT);
    key.features = GN_FEATURES_ALL - GN_FEATURE(UNLIT);
    for (int i = 0; i < GN_SHADOWS_MAX; i++) {
        add_light(&key, i == 3 ? GN_LIGHT_DIRECTIONAL : GN_LIGHT_SPOT, GN_TECHNIQUE_CONE, 0);
        filter_map(&key.lights[i], GN_MOMENTS_CONE_RG16F);
        if (i < 3) key.lights[i].slide = GN_SLIDE_LIT;
    }
    compiles(&key);
}

static void test_features(void **state) {
    (void)state;
    for (int i = 0; i <= GN_FEATURE_COUNT; i++) {
        struct gn_program_key key = key_of(GN_PROGRAM_LIT);
        key.features = i == GN_FEATURE_COUNT ? GN_FEATURES_ALL : UINT64_C(1) << i;
        add_light(&key, GN_LIGHT_DIRECTIONAL, GN_TECHNIQUE_PCF, GN_ENCODING_DEPTH);
        add_light(&key, GN_LIGHT_POINT, GN_TECHNIQUE_NONE, 0);
        compiles(&key);
        key.kind = GN_PROGRAM_AOV;
        key.aov = GN_AOV_NORMAL;
        compiles(&key);
    }
}

static void test_casters(void **state) {
    (void)state;
    const uint64_t mask = GN_FEATURE(ALPHA_MASK) | GN_FEATURE(BASE_TEXTURE);
    const uint64_t features[] = {0,
                                 GN_FEATURE(ALPHA_MASK),
                                 mask,
                                 mask | GN_FEATURE(BASE_UV1),
                                 mask | GN_FEATURE(VERTEX_COLOR),
                                 GN_FEATURE(MIDDLE)};
    for (size_t i = 0; i < sizeof features / sizeof *features; i++)
        for (int e = 0; e < GN_ENCODING_COUNT; e++)
            for (int spot = 0; spot < 2; spot++) {
                struct gn_program_key key =
                    key_of(gn_encoding_is_depth(e)    ? GN_PROGRAM_DEPTH
                           : e == GN_ENCODING_STENCIL ? GN_PROGRAM_FLAT
                                                      : GN_PROGRAM_DISTANCE);
                key.encoding = (uint8_t)e;
                key.features = features[i] | (spot ? GN_FEATURE(PERSPECTIVE) : 0);
                compiles(&key);
            }
}

static void test_many_lights(void **state) {
    (void)state;
    struct gn_program_key key = key_of(GN_PROGRAM_LIT);
    key.features = GN_FEATURE(SPECULAR) | GN_FEATURE(HEMISPHERE);
    for (int i = 0; i < GN_SHADOWS_MAX; i++) add_light(&key, i % 3, GN_TECHNIQUE_HARD + i, i);
    for (int i = GN_SHADOWS_MAX; i < GN_LIGHTS_MAX; i++)
        add_light(&key, i % 3, GN_TECHNIQUE_NONE, 0);
    compiles(&key);
    key.features |= GN_FEATURES_ALL;
    compiles(&key);
    key.lights[GN_SHADOWS_MAX - 1].type = GN_LIGHT_POINT; /* two ways to be looked up, in one */
    key.lights[GN_SHADOWS_MAX - 1].technique = GN_TECHNIQUE_PLANAR;
    key.lights[GN_SHADOWS_MAX - 1].encoding = GN_ENCODING_MASK;
    compiles(&key);
    key.lights[GN_SHADOWS_MAX - 1].encoding = GN_ENCODING_STENCIL;
    compiles(&key);
}

static void test_slides(void **state) {
    (void)state;
    for (int slide = GN_SLIDE_DARK; slide < GN_SLIDE_COUNT; slide++)
        for (int t = GN_TECHNIQUE_NONE; t < GN_TECHNIQUE_COUNT; t++) {
            struct gn_program_key key = key_of(GN_PROGRAM_LIT);
            key.features = t % 2 ? GN_FEATURE(SPECULAR) : GN_FEATURE(FLAT_CONSTANTS);
            add_light(&key, GN_LIGHT_SPOT, t,
                      gn_techniques[t].on_plane ? GN_ENCODING_MASK : GN_ENCODING_DEPTH);
            if (gn_technique_filters_map((enum gn_technique)t))
                filter_map(&key.lights[0], gn_techniques[t].stores[0]);
            key.lights[0].slide = (uint8_t)slide;
            compiles(&key);
        }
}

static void test_as_many_slides_as_may_be(void **state) {
    (void)state;
    struct gn_program_key key = key_of(GN_PROGRAM_LIT);
    key.features = GN_FEATURES_ALL - GN_FEATURE(UNLIT);
    for (int i = 0; i < GN_LIGHTS_MAX; i++) {
        add_light(&key, GN_LIGHT_SPOT, i < GN_SHADOWS_MAX ? GN_TECHNIQUE_PCF : GN_TECHNIQUE_NONE,
                  i % GN_ENCODING_COUNT);
        if (i % 2) key.lights[i].slide = i % 4 == 1 ? GN_SLIDE_DARK : GN_SLIDE_LIT;
    }
    compiles(&key);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_techniques, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_truth, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_moments, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_as_many_moments_as_may_be, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_as_many_samplers_as_may_be, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_features, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_casters, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_many_lights, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_slides, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_as_many_slides_as_may_be, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_techniques, open_osmesa, close_all),
        cmocka_unit_test_setup_teardown(test_moments, open_osmesa, close_all),
        cmocka_unit_test_setup_teardown(test_many_lights, open_osmesa, close_all),
        cmocka_unit_test_setup_teardown(test_as_many_slides_as_may_be, open_osmesa, close_all),
    };
    return RUN(tests);
}
