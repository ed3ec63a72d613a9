/* Plans with options of single lights, and as a light sees the scene. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "plan/fixture.h"
#include "unit/check.h"

static const struct gn_shadow_view *view_of(const struct gn_plan *plan, uint32_t light) {
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        if (plan->shadows[i].light == light) return &plan->shadows[i];
    return NULL;
}

static void test_options_of_a_light_beat_those_of_all(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.scene->lights[1].technique = "none";
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PCF);
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 512);
    GN_LIGHT_SET(&f.opts.shadow.any, strength, 1.0f);
    f.opts.shadow.lights[0] =
        (struct gn_light_opts){.light = 1,
                               .given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                        GN_LIGHT_GIVEN(map_format) | GN_LIGHT_GIVEN(strength),
                               .technique = GN_TECHNIQUE_HARD,
                               .map_px = 128,
                               .map_format = GN_MAP_FORMAT(GN_ENCODING_R32UI, GN_MOMENTS_NONE),
                               .strength = 0.25f};
    f.opts.shadow.lights[1] = (struct gn_light_opts){
        .light = 2, .given = GN_LIGHT_GIVEN(technique), .technique = GN_TECHNIQUE_NONE};
    f.opts.shadow.light_count = 2;
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_int_equal(plan->shadow_count, 2);
    assert_null(view_of(plan, 2));
    assert_int_equal(view_of(plan, 0)->technique, GN_TECHNIQUE_PCF);
    assert_int_equal(view_of(plan, 0)->map.tile_px, 512);
    assert_int_equal(view_of(plan, 1)->technique, GN_TECHNIQUE_HARD);
    assert_int_equal(view_of(plan, 1)->encoding, GN_ENCODING_R32UI);
    assert_int_equal(view_of(plan, 1)->map.tile_px, 128);
    const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
    const float(*c)[4] = (const float(*)[4])last->constants;
    assert_true(c[PASS_LIGHTS + LIGHT_COLOR][3] == 1.0f);
    assert_true(c[PASS_LIGHTS + LIGHT_SIZE + LIGHT_COLOR][3] == 0.25f);
    gn_plan_end(&f);
}

static void test_an_unknown_technique_is_told_with_the_one_that_is_used(void **state) {
    (void)state;
    static const enum gn_technique used[] = {GN_TECHNIQUE_PCF, GN_TECHNIQUE_HARD};
    for (int i = 0; i < 2; i++) {
        struct gn_plan_fixture f;
        struct gn_warnings warnings = {0};
        gn_plan_begin(&f, GN_EVERY_CAP);
        f.scene->lights[0].technique = "velvet";
        if (i > 0) GN_LIGHT_SET(&f.opts.shadow.any, technique, used[i]);
        const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
        assert_int_equal(view_of(plan, 0)->technique, used[i]);
        assert_int_equal(warnings.count, 1);
        const char *name = strstr(warnings.text[0], "'velvet' is not a known technique; using ");
        assert_non_null(name);
        assert_string_equal(strrchr(name, ' ') + 1, gn_techniques[used[i]].name);
        gn_plan_end(&f);
    }
}

static void test_a_light_has_the_colour_that_is_set_or_is_off(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    const struct gn_plan *plan = gn_plan_make(&f);
    const float exposure = plan->exposure;
    const uint32_t lights = plan->light_count;
    f.opts.shadow.lights[0] = (struct gn_light_opts){
        .light = 1, .given = GN_LIGHT_GIVEN(color), .color = {3e4f, 2e4f, 1e4f}};
    f.opts.shadow.lights[1] = (struct gn_light_opts){.light = 0, .given = GN_LIGHT_GIVEN(on)};
    f.opts.shadow.light_count = 2;
    plan = gn_plan_make(&f);
    assert_int_equal(plan->light_count, lights - 1);
    assert_null(view_of(plan, 0)); /* no map either */
    const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
    const float *c = ((const float(*)[4])last->constants)[PASS_LIGHTS + LIGHT_COLOR];
    for (int k = 0; k < 3; k++)
        assert_true(fabsf(c[k] - (float)(3 - k) * 1e4f * exposure / GLM_PIf) < .1f);
    assert_true(plan->exposure == exposure); /* chosen by the lights as the scene has them */
    gn_plan_end(&f);
}

/* Of the passes of that light's map; -1: not all alike. */
static int cull_of(const struct gn_plan *plan, uint32_t light) {
    int cull = -2;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        if (pass->kind != GN_PASS_MAP || plan->shadows[pass->target.slot].light != light) continue;
        for (uint32_t d = 0; d < pass->draw_count; d++) {
            const int one = plan->draws[pass->first_draw + d].cull;
            cull = cull == -2 || cull == one ? one : -1;
        }
    }
    return cull;
}

static void test_faces_of_all_casters_are_as_set(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    const uint64_t hash = view_of(gn_plan_make(&f), 1)->raster.tiles[0].content_hash;
    GN_LIGHT_SET(&f.opts.shadow.any, faces, 1 + GN_CAST_BACK);
    f.opts.shadow.lights[0] = (struct gn_light_opts){
        .light = 1, .given = GN_LIGHT_GIVEN(faces), .faces = 1 + GN_CAST_FRONT};
    f.opts.shadow.light_count = 1;
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_int_equal(cull_of(plan, 0), GN_CULL_FRONT);
    assert_int_equal(cull_of(plan, 1), GN_CULL_BACK);
    const uint64_t front = view_of(plan, 1)->raster.tiles[0].content_hash;
    assert_true(front != hash); /* the map is drawn again */
    f.opts.shadow.lights[0].faces = 0;
    plan = gn_plan_make(&f);
    assert_int_equal(cull_of(plan, 0), GN_CULL_FRONT);
    assert_true(view_of(plan, 1)->raster.tiles[0].content_hash == hash);
    gn_plan_end(&f);
}

/* In texels, and the techniques' own where it is automatic. */
static void test_the_bias_is_as_set(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PCF);
    const float own = gn_techniques[GN_TECHNIQUE_PCF].bias_texels;
    const struct gn_shadow_lookup before[] = {view_of(gn_plan_make(&f), 0)->lookup,
                                              view_of(gn_plan_make(&f), 1)->lookup};
    assert_true(before[0].bias_texels == own && before[0].margin_px == 2);
    GN_LIGHT_SET(&f.opts.shadow.any, bias_texels, 0);
    f.opts.shadow.lights[0] = (struct gn_light_opts){
        .light = 1, .given = GN_LIGHT_GIVEN(bias_texels), .bias_texels = own + 1.5f};
    f.opts.shadow.light_count = 1;
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_true(view_of(plan, 0)->lookup.normal_offset == 0.0f);
    assert_true(view_of(plan, 0)->lookup.slope_offset == 0.0f);
    const float(*c)[4] = (const float(*)[4])plan->passes[plan->pass_count - 1].constants;
    assert_true(c[PASS_SHADOWS + SHADOW_BIAS][BIAS_NORMAL] == 0.0f);
    const struct gn_shadow_lookup *large = &view_of(plan, 1)->lookup;
    assert_true(fabsf(large->normal_offset - (own + 1.5f) / own * before[1].normal_offset) < 1e-5f);
    assert_true(fabsf(large->slope_offset - (own + 1.5f) / own * before[1].slope_offset) < 1e-5f);
    assert_int_equal(large->margin_px, 4); /* lookups beside the map's window */
    assert_true(large->texel >= before[1].texel);
    f.opts.shadow.lights[0].bias_texels = -1.0f;
    assert_true(view_of(gn_plan_make(&f), 1)->lookup.normal_offset == before[1].normal_offset);
    gn_plan_end(&f);
}

static const struct gn_program_key *lit_of(const struct gn_plan *plan) {
    for (uint32_t i = 0; i < plan->program_count; i++)
        if (plan->programs[i].kind == GN_PROGRAM_LIT && plan->programs[i].shadow_count > 1)
            return &plan->programs[i];
    return NULL;
}

/* A constant, and a bit of the program's key; the margin follows, and of pcf the bias. */
static void test_the_radius_of_a_filter_is_as_set(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_DISK);
    f.opts.shadow.lights[0] = (struct gn_light_opts){
        .light = 1, .given = GN_LIGHT_GIVEN(filter_radius_px), .filter_radius_px = 5.5f};
    f.opts.shadow.light_count = 1;
    const struct gn_plan *plan = gn_plan_make(&f);
    const float(*c)[4] = (const float(*)[4])plan->passes[plan->pass_count - 1].constants;
    assert_true(c[PASS_SHADOWS + SHADOW_SLOPE][SLOPE_FILTER] == 0.0f);
    assert_true(c[PASS_SHADOWS + SHADOW_SIZE + SHADOW_SLOPE][SLOPE_FILTER] == 5.5f);
    assert_int_equal(view_of(plan, 0)->lookup.margin_px, 4);
    assert_int_equal(view_of(plan, 1)->lookup.margin_px, 7);
    assert_non_null(lit_of(plan));
    assert_false(lit_of(plan)->lights[0].radius_set);
    assert_true(lit_of(plan)->lights[1].radius_set);
    f.opts.shadow.lights[0].filter_radius_px = 0.0f;
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PCF);
    GN_LIGHT_SET(&f.opts.shadow.any, filter_radius_px, 30.0f); /* more than its taps can have */
    plan = gn_plan_make(&f);
    const struct gn_shadow_lookup *wide = &view_of(plan, 0)->lookup;
    assert_true(wide->filter_radius_px == 2.0f && wide->margin_px == 2);
    assert_true(fabsf(wide->bias_texels - 1.2f) < 1e-6f);
    assert_false(lit_of(plan)->lights[1].radius_set);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PCF5); /* it has one radius */
    plan = gn_plan_make(&f);
    assert_true(view_of(plan, 0)->lookup.filter_radius_px == 0.0f);
    assert_false(lit_of(plan)->lights[0].radius_set);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_VSM);
    GN_LIGHT_SET(&f.opts.shadow.any, filter_radius_px, 3.0f);
    plan = gn_plan_make(&f);
    assert_true(view_of(plan, 0)->penumbra.blur_px == 3.0f);
    assert_false(lit_of(plan)->lights[0].radius_set); /* the map is blurred */
    gn_plan_end(&f);
}

/* Of the programs' lights; those of cone are 8 to 16. */
static void test_lights_have_taps_of_their_own(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_POISSON);
    f.opts.shadow.lights[0] =
        (struct gn_light_opts){.light = 1, .given = GN_LIGHT_GIVEN(taps), .taps = 20};
    f.opts.shadow.light_count = 1;
    static const struct {
        uint32_t asked;
        uint8_t disk, cone;
    } rows[] = {{0, 16, 12}, {4, 4, 8}, {12, 12, 12}, {64, 64, 16}};
    for (int i = 0; i < 4; i++) {
        GN_LIGHT_SET(&f.opts.shadow.any, taps, rows[i].asked);
        GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_POISSON);
        const struct gn_plan *plan = gn_plan_make(&f);
        assert_int_equal(lit_of(plan)->lights[0].taps, rows[i].disk);
        assert_int_equal(lit_of(plan)->lights[1].taps, 20);
        GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_CONE);
        plan = gn_plan_make(&f);
        assert_int_equal(lit_of(plan)->lights[0].taps, rows[i].cone);
        assert_int_equal(lit_of(plan)->lights[1].taps, 16);
    }
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PCF);
    assert_int_equal(lit_of(gn_plan_make(&f))->lights[1].taps, 0);
    gn_plan_end(&f);
}

/* All that casts is in the picture of a sun, whatever its shape; a spot is where it stands. */
static void test_a_light_can_be_looked_from(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (int wide = 0; wide < 2; wide++) {
        f.opts.view.light_plus_1 = 1;
        f.opts.output.width_px = wide ? 640 : 200;
        f.opts.output.height_px = wide ? 200 : 640;
        const struct gn_plan *plan = gn_plan_make(&f);
        const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
        mat4 clip;
        memcpy(clip, last->constants[PASS_CLIP], sizeof clip);
        uint32_t seen = 0;
        for (uint32_t i = 0; i < 8 * f.scene->item_count; i++) {
            const struct gn_item *item = &f.scene->items[i / 8];
            const struct gn_box *box = &f.pose.items[i / 8].box_ws;
            vec4 p = {0, 0, 0, 1};
            if (!gn_shadow_item_casts(f.scene, i / 8) || item->plane ||
                f.pose.node_moves[item->node])
                continue;
            for (int k = 0; k < 3; k++) p[k] = i >> k & 1 ? box->max[k] : box->min[k];
            glm_mat4_mulv(clip, p, p);
            for (int k = 0; k < 3; k++) assert_true(fabsf(p[k]) <= 1.001f * p[3]);
            seen++;
        }
        assert_true(seen > 0);
        f.opts.view.light_plus_1 = 2;
        plan = gn_plan_make(&f);
        last = &plan->passes[plan->pass_count - 1];
        vec3 place, direction;
        gn_pose_light(&f.pose, 1, place, direction);
        for (int k = 0; k < 3; k++)
            assert_true(fabsf(last->constants[PASS_EYE][k] - place[k]) < 1e-4f);
    }
    gn_plan_end(&f);
}

/* Of specular items alone, and only where a light has a share of its own. */
static void test_highlights_in_shadow_have_a_feature(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (int given = 0; given < 2; given++) {
        GN_LIGHT_SET(&f.opts.shadow.any, strength, 0.75f);
        if (given) GN_LIGHT_SET(&f.opts.shadow.any, specular, 0.2f);
        const struct gn_plan *plan = gn_plan_make(&f);
        const uint64_t both = GN_FEATURE(SPECULAR) | GN_FEATURE(SHADOW_SPECULAR);
        int count = 0;
        for (uint32_t i = 0; i < plan->program_count; i++) {
            const uint64_t has = plan->programs[i].features & both;
            assert_true(has == 0 || has == (given ? both : GN_FEATURE(SPECULAR)));
            count += has != 0;
        }
        assert_true(count > 0);
        const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
        assert_true(last->constants[PASS_LIGHTS + LIGHT_COLOR][3] ==
                    0.75f + (given ? 2 * 51 : 0)); /* 51 / 255 */
    }
    gn_plan_end(&f);
}

/* The map's clear code and what it holds, in a plan like this. */
static void clear_of(struct gn_plan_fixture *f, bool near_end, float *code, uint64_t *hash) {
    f->opts.shadow.clears_near = near_end;
    const struct gn_plan *plan = gn_plan_make(f);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        if (plan->passes[i].kind != GN_PASS_MAP) continue;
        *code = plan->passes[i].clear.color[0];
        *hash = plan->passes[i].content.hash;
        return;
    }
    fail_msg("no map is drawn");
}

static void test_maps_are_cleared_to_the_far_end_but_in_a_lesson(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    float far_code, near_code;
    uint64_t far_hash, near_hash;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, map_format, GN_MAP_FORMAT(GN_ENCODING_R16F, GN_MOMENTS_NONE));
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_HARD);
    clear_of(&f, false, &far_code, &far_hash);
    clear_of(&f, true, &near_code, &near_hash);
    assert_true(far_code == 1.0f);
    assert_true(fabsf(near_code + 1.0f) < 1e-5f);
    assert_true(far_hash != near_hash); /* or the map would not be drawn again */
    gn_plan_end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options_of_a_light_beat_those_of_all),
        cmocka_unit_test(test_an_unknown_technique_is_told_with_the_one_that_is_used),
        cmocka_unit_test(test_a_light_has_the_colour_that_is_set_or_is_off),
        cmocka_unit_test(test_a_light_can_be_looked_from),
        cmocka_unit_test(test_faces_of_all_casters_are_as_set),
        cmocka_unit_test(test_the_bias_is_as_set),
        cmocka_unit_test(test_maps_are_cleared_to_the_far_end_but_in_a_lesson),
        cmocka_unit_test(test_the_radius_of_a_filter_is_as_set),
        cmocka_unit_test(test_lights_have_taps_of_their_own),
        cmocka_unit_test(test_highlights_in_shadow_have_a_feature),
    };
    return cmocka_run_group_tests_name("plan light options", tests, NULL, NULL);
}
