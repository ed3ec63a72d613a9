/* Plans of how a picture is shown: its tone, and what is blended. */
#include <cglm/cglm.h>
#include <string.h>

#include "plan/fixture.h"
#include "unit/check.h"

/* What is added has no tone of its own: the last pass maps the sum. */
static void test_tone_of_many_lights_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[13];
    gn_plan_begin(&f, GN_EVERY_CAP);
    gn_plan_add_lights(&f, lights);
    f.opts.tone = GN_TONE_NEUTRAL;
    gn_plan_expect(gn_plan_make(&f), "tone");
    gn_plan_end(&f);
}

/* A picture into a mean, and that over another view's picture, also over one that is finished last.
 */
static void test_mean_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.number = 3;
    f.opts.gather.part = 0.125f;
    assert_int_equal(gn_plan_make(&f)->passes[gn_plan_make(&f)->pass_count - 1].target.index, 1);
    f.opts.gather.whole = 0.25f;
    gn_plan_expect(gn_plan_make(&f), "mean-gather");
    assert_true(gn_plan_make(&f)->gathers);
    f.opts.background = GN_BACKGROUND_TRANSPARENT; /* its last pass makes bytes of it */
    f.opts.output.keeps_alpha = true;
    assert_false(gn_plan_make(&f)->gathers);
    gn_plan_end(&f);
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.cover.mean = 0.5f;
    f.opts.cover.mean_of = 3;
    f.opts.cover.dimmed = 0.25f; /* after it, as captions are */
    gn_plan_expect(gn_plan_make(&f), "mean-over");
    gn_plan_end(&f);
}

static bool maps_tone(const struct gn_plan *plan, enum gn_program_kind kind) {
    const uint64_t any = GN_FEATURE(TONE_NEUTRAL) | GN_FEATURE(TONE_ACES) | GN_FEATURE(TONE_AGX);
    for (uint32_t i = 0; i < plan->program_count; i++)
        if (plan->programs[i].kind == kind && plan->programs[i].features & any) return true;
    return false;
}

static void test_a_tone_is_for_pictures_that_are_looked_at(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.tone = GN_TONE_AGX;
    assert_true(maps_tone(gn_plan_make(&f), GN_PROGRAM_LIT));
    f.opts.output.linear = true;
    assert_false(maps_tone(gn_plan_make(&f), GN_PROGRAM_LIT));
    f.opts.output.linear = false;
    f.opts.output.floats = true;
    assert_false(maps_tone(gn_plan_make(&f), GN_PROGRAM_LIT));
    f.opts.output.floats = false;
    f.opts.tone = GN_TONE_AUTO;
    assert_int_equal(gn_plan_make(&f)->tone, GN_TONE_NONE); /* it has lights of its own */
    f.scene->added.light = true;
    assert_int_equal(gn_plan_make(&f)->tone, GN_TONE_NEUTRAL);
    for (int aov = GN_AOV_COLOR + 1; aov < GN_AOV_COUNT; aov++) {
        f.opts.debug.aov = (enum gn_aov)aov;
        assert_int_equal(gn_plan_make(&f)->tone, GN_TONE_NONE);
    }
    gn_plan_end(&f);
}

/* Opaque texels first, as of a masked item, then the rest: back faces, front faces. */
static void test_blended_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (uint32_t i = 0; i < f.scene->material_count; i++) {
        struct gn_material *m = &f.scene->materials[i];
        if (m->alpha != GN_ALPHA_BLEND) continue;
        m->base_color[3] = 1.0f;
        m->double_sided = true;
    }
    for (uint32_t i = 0; i < f.scene->item_count; i++)
        if (f.scene->materials[f.scene->items[i].material].alpha == GN_ALPHA_BLEND)
            f.scene->geometries[f.scene->items[i].geometry].flat = false;
    gn_plan_expect(gn_plan_make(&f), "blended");
    gn_plan_end(&f);
}

/* Coloured glass: its tint multiplies, then its light is blended, back faces before front faces;
 * what is behind it is drawn before both. With lights added, each adds to it in its place. */
static void test_glass_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[13];
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (uint32_t i = 0; i < f.scene->material_count; i++) {
        struct gn_material *m = &f.scene->materials[i];
        if (strcmp(m->name, "blue") == 0) m->factors[GN_FACTOR_COAT] = 1.0f;
        if (m->alpha != GN_ALPHA_BLEND) continue;
        m->alpha = GN_ALPHA_OPAQUE;
        m->factors[GN_FACTOR_TRANSMISSION] = 0.9f;
        m->double_sided = true;
        glm_vec3_copy((vec3){1, 0.5f, 0.2f}, m->base_color);
        m->textures[GN_TEXTURE_BASE].texture = -1;
    }
    for (uint32_t i = 0; i < f.scene->item_count; i++)
        if (gn_material_is_blended(&f.scene->materials[f.scene->items[i].material]))
            f.scene->geometries[f.scene->items[i].geometry].flat = false;
    gn_plan_expect(gn_plan_make(&f), "glass");
    gn_plan_add_lights(&f, lights);
    const struct gn_plan *plan = gn_plan_make(&f);
    uint32_t tints = 0, added = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        if (plan->passes[i].kind != GN_PASS_PICTURE) continue;
        tints += plan->passes[i].picture.blend == GN_BLEND_TINT;
        added += tints > 0 && plan->passes[i].picture.blend == GN_BLEND_ADD;
    }
    assert_int_equal(tints % 2, 0);
    assert_true(tints > 0 && added >= tints);
    gn_plan_end(&f);
}

static uint64_t lit_features(const struct gn_plan *plan) {
    uint64_t features = 0;
    for (uint32_t i = 0; i < plan->program_count; i++)
        if (plan->programs[i].kind == GN_PROGRAM_LIT) features |= plan->programs[i].features;
    return features;
}

static void check_layer(enum gn_layer layer, uint64_t feature) {
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    assert_false(lit_features(gn_plan_make(&f)) & feature);
    for (uint32_t i = 0; i < f.scene->material_count; i++)
        f.scene->materials[i].factors[gn_layers[layer].first] = 0.5f;
    assert_true(lit_features(gn_plan_make(&f)) & feature);
    gn_plan_end(&f);
}

static void test_every_layer_is_a_feature_of_programs(void **state) {
    (void)state;
#define GN_X(NAME, ...) check_layer(GN_LAYER_##NAME, GN_FEATURE(NAME));
    GN_LAYERS(GN_X, GN_LEAVE_OUT, GN_LEAVE_OUT)
#undef GN_X
}

/* With lights of its own: only metal reads the environment, and keeps the hemispheres. */
static void test_reflections_plan(void **state) {
    (void)state;
    static const struct gn_environment environment;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (uint32_t i = 0; i < f.scene->material_count; i++)
        if (strcmp(f.scene->materials[i].name, "blue") == 0) f.scene->materials[i].metalness = 1;
    f.opts.environment = (struct gn_frame_environment_opts){
        .of = &environment, .id = 2, .reflected_only = true, .strength = 1};
    gn_plan_expect(gn_plan_make(&f), "reflections");
    /* no AOV shows it */
    for (int aov = GN_AOV_COLOR + 1; aov < GN_AOV_COUNT; aov++) {
        f.opts.debug.aov = (enum gn_aov)aov;
        assert_null(gn_plan_make(&f)->environment.light);
    }
    gn_plan_end(&f);
}

/* After what is opaque, before what is blended over it; and where the whole picture is toned last.
 */
static void test_backdrop_plan(void **state) {
    (void)state;
    static const struct gn_environment environment;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.tone = GN_TONE_NEUTRAL;
    f.opts.environment = (struct gn_frame_environment_opts){.of = &environment,
                                                            .id = 2,
                                                            .reflected_only = true,
                                                            .show = GN_ENVIRONMENT_SHOW_BLUR,
                                                            .strength = 1};
    gn_plan_expect(gn_plan_make(&f), "backdrop");
    const uint32_t passes = gn_plan_make(&f)->pass_count;
    f.opts.environment.show = GN_ENVIRONMENT_SHOW_NO;
    assert_int_equal(gn_plan_make(&f)->pass_count, passes - 1);
    f.opts.environment.show = GN_ENVIRONMENT_SHOW_SHARP;
    assert_int_equal(gn_plan_make(&f)->pass_count, passes);
    f.opts.debug.aov = GN_AOV_NORMAL; /* no AOV shows it */
    assert_true(gn_plan_make(&f)->pass_count < passes);
    f.opts.debug.aov = GN_AOV_COLOR;
    f.opts.background = GN_BACKGROUND_TRANSPARENT; /* holds, where it is kept */
    assert_int_equal(gn_plan_make(&f)->pass_count, passes);
    f.opts.output.keeps_alpha = true;
    const struct gn_plan *plan = gn_plan_make(&f);
    for (uint32_t i = 0; i < plan->program_count; i++)
        assert_int_not_equal(plan->programs[i].kind, GN_PROGRAM_BACKDROP);
    gn_plan_end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tone_of_many_lights_plan),
        cmocka_unit_test(test_mean_plan),
        cmocka_unit_test(test_a_tone_is_for_pictures_that_are_looked_at),
        cmocka_unit_test(test_blended_plan),
        cmocka_unit_test(test_glass_plan),
        cmocka_unit_test(test_every_layer_is_a_feature_of_programs),
        cmocka_unit_test(test_reflections_plan),
        cmocka_unit_test(test_backdrop_plan),
    };
    return RUN(tests);
}
