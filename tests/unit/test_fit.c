#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "shadow/fit.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* A table top, 2 x 2 at y = 0, over a floor of 10 x 10 at y = -1; a light 3 over it that shines
 * straight down. An eye sees all of it. */
struct stage {
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_eye eye;
    struct gn_shadow_opts opts;
    struct gn_shadow_memory memory[GN_SHADOW_TILES_MAX];
    struct gn_shadow_view view;
};

static void load(struct stage *s, const char *light, float scale) {
    char text[160];
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    snprintf(text, sizeof text, "{'KHR_lights_punctual':{'lights':[%s]}}", light);
    gn_maker_set(&maker, "extensions", text);
    gn_maker_add(&maker, "nodes",
                 "{'name':'floor','mesh':0,'translation':[0,-1,0],'scale':[5,5,5]}");
    gn_maker_add(&maker, "nodes",
                 "{'matrix':[1,0,0,0, 0,0,-1,0, 0,1,0,0, 0,3,0,1],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}}");
    snprintf(text, sizeof text, "{'name':'all','scale':[%g,%g,%g],'children':[0,1,2]}",
             (double)scale, (double)scale, (double)scale);
    gn_maker_add(&maker, "nodes", text);
    gn_maker_set(&maker, "scenes", "[{'nodes':[3]}]");
    s->scene = gn_maker_load(&maker, NULL, &err);
    if (!s->scene) fail_msg("%s", err.text);
}

/* The eye and the rest of the stage, for the scene that is loaded. */
static void begin_loaded(struct stage *s, float scale) {
    mat4 view_from_world, clip_from_view, clip_from_world;
    s->opts = (struct gn_shadow_opts){
        .technique = GN_TECHNIQUE_PCF, .encoding = GN_ENCODING_DEPTH, .map_px = 1024};
    gn_pose_init(&s->pose, s->scene, GN_POSE_NONE);
    glm_lookat((vec3){0, 8 * scale, 12 * scale}, GLM_VEC3_ZERO, GLM_YUP, view_from_world);
    glm_perspective(1.0f, 1.0f, 0.1f * scale, 100.0f * scale, clip_from_view);
    glm_mat4_mul(clip_from_view, view_from_world, clip_from_world);
    gn_eye_build(&s->eye, clip_from_world);
    for (int i = 0; i < GN_SHADOW_TILES_MAX; i++)
        gn_shadow_memory_init(&s->memory[i], s->scene->item_count);
}

static void begin(struct stage *s, const char *light, float scale) {
    *s = (struct stage){0};
    load(s, light, scale);
    begin_loaded(s, scale);
}

static void end(struct stage *s) {
    for (int i = 0; i < GN_SHADOW_TILES_MAX; i++) gn_shadow_memory_finish(&s->memory[i]);
    gn_pose_finish(&s->pose);
    gn_scene_destroy(s->scene);
}

static bool fit(struct stage *s) {
    return gn_shadow_fit(&s->pose, 0, &s->eye, &s->opts, s->memory, &s->view);
}

/* ---- */

static void expect_finite(mat4 m) {
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) assert_true(isfinite(m[c][r]));
}

static void test_casters_in_one_plane_across_the_sun_have_a_depth(void **state) {
    (void)state;
    struct stage s;
    begin(&s, "{'type':'directional'}", 1);
    for (int encoding = 0; encoding < GN_ENCODING_MASK; encoding++) {
        s.opts.encoding = (enum gn_encoding)encoding;
        assert_true(fit(&s));
        expect_finite(s.view.raster.tiles[0].clip_from_world);
        expect_finite(s.view.lookup.map_from_world);
        vec4 on_table = {0.5f, 0.0f, 0.5f, 1.0f}, clip;
        glm_mat4_mulv(s.view.raster.tiles[0].clip_from_world, on_table, clip);
        assert_true(fabsf(clip[2]) < 0.9f);
        assert_true(s.view.code.ulp_m > 1e-7f); /* what a float says of a place some metres off */
    }
    end(&s);
}

static float spot_texel(float scale) {
    struct stage s;
    begin(&s, "{'type':'spot'}", scale);
    assert_true(fit(&s));
    float texel = s.view.lookup.texel;
    end(&s);
    return texel;
}

static void test_a_spots_window_does_not_grow_with_the_scene(void **state) {
    (void)state;
    float texel = spot_texel(1);
    assert_true(texel > 0.6f / 1024 && texel < 0.8f / 1024); /* the table is 2 wide, 3 away */
    assert_true(spot_texel(0x1p-8f) == texel && spot_texel(0x1p20f) == texel);
    assert_true(spot_texel(0x1p-16f) == texel); /* the table is 46 um away */
}

/* A lamp in a room that grows: its near plane goes with the room. */
static void test_a_kept_memory_fits_as_a_new_one(void **state) {
    (void)state;
    struct stage s;
    begin(&s, "{'type':'spot'}", 1);
    s.scene->items[1].casts = false;
    s.pose.items[0].world_from_item[3][1] = 2.99f; /* the table, before the lamp */
    s.pose.items[0].box_ws.min[1] = s.pose.items[0].box_ws.max[1] = 2.99f;
    s.pose.items[0].hash++;
    assert_true(fit(&s));
    const float near_m = s.view.code.near_m;
    s.pose.box_ws.max[0] = 300; /* the plane is 3 cm away by now: nothing is before it */
    assert_false(fit(&s));
    s.pose.box_ws.max[0] = 5;
    assert_true(fit(&s) && s.view.code.near_m == near_m);
    end(&s);
}

/* Clips move lights: a map is drawn again only for what it depends on. */
static void test_a_map_stays_for_a_colour_and_not_for_a_cone(void **state) {
    (void)state;
    struct stage s;
    begin(&s, "{'type':'spot','spot':{'innerConeAngle':0.1,'outerConeAngle':0.5}}", 1);
    struct gn_light light = s.scene->lights[0];
    const uint64_t *hash = &s.view.raster.tiles[0].content_hash;
    s.pose.lights = &light;
    assert_true(fit(&s));
    const uint64_t before = *hash;
    light.color[1] = 7;
    light.inner_rad = .2f;
    assert_true(fit(&s) && *hash == before);
    light.outer_rad = .6f; /* no caster is there */
    assert_true(fit(&s) && *hash == before);
    light.outer_rad = .21f; /* less than the table */
    assert_true(fit(&s) && *hash != before);
    light.outer_rad = .5f;
    assert_true(fit(&s) && *hash == before);
    end(&s);
}

static void test_what_is_beyond_the_range_takes_no_part(void **state) {
    (void)state;
    struct stage s;
    begin(&s, "{'type':'point'}", 1);
    struct gn_light *light = &s.scene->lights[0];
    light->range_m = 4.5f; /* the table is 3 away, the floor 4 */
    assert_true(fit(&s) && !s.view.raster.tiles[3].empty);
    for (uint32_t i = 0; i < 6; i++)
        if (i != 3) assert_true(s.view.raster.tiles[i].empty);
    light->range_m = 2.9f;
    assert_false(fit(&s));
    end(&s);
    begin(&s, "{'type':'spot'}", 1);
    light = &s.scene->lights[0];
    light->range_m = 2.9f;
    assert_false(fit(&s));
    light->range_m = 4.5f;
    assert_true(fit(&s));
    const float near_m = s.view.code.near_m, texel = s.view.lookup.texel;
    light->range_m = 0;
    assert_true(fit(&s) && s.view.code.near_m == near_m && s.view.lookup.texel == texel);
    end(&s);
}

/* Nothing below the table takes its shadow, unless nobody asks. */
static void test_all_receive_where_visibility_is_the_picture(void **state) {
    (void)state;
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_PCF, GN_TECHNIQUE_PLANAR};
    for (int t = 0; t < 2; t++) {
        struct stage s;
        begin(&s, "{'type':'spot'}", 1);
        s.opts.technique = techniques[t];
        assert_true(fit(&s));
        const float texel = s.view.lookup.texel;
        for (uint32_t i = 0; i < s.scene->item_count; i++) s.scene->items[i].receives = false;
        assert_false(fit(&s));
        s.opts.all_receive = true;
        assert_true(fit(&s) && s.view.lookup.texel == texel);
        end(&s);
    }
}

/* Where the map is read for a place beside the table: uv and code. */
static void look_up(struct stage *s, float x, float z, vec3 out) {
    vec4 p = {x, -0.5f, z, 1.0f};
    glm_mat4_mulv(s->view.lookup.map_from_world, p, p);
    glm_vec3_scale(p, 1.0f / p[3], out);
}

/* The table under a sun, and one more node: JSON. */
static void begin_with(struct stage *s, struct gn_maker *maker, const char *node) {
    struct gn_err err = {0};
    gn_maker_set(maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional'}]}}");
    gn_maker_add(maker, "nodes",
                 "{'rotation':[-0.70710678,0,0,0.70710678],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}}");
    gn_maker_add(maker, "nodes", node);
    *s = (struct stage){0};
    s->scene = gn_maker_load(maker, NULL, &err);
    if (!s->scene) fail_msg("%s", err.text);
    begin_loaded(s, 1);
}

/* Two tables, at 0 and 3, over a floor. */
static void test_a_window_holds_all_casters(void **state) {
    (void)state;
    struct stage s;
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_add(&maker, "nodes", "{'mesh':0,'translation':[0,-1,0],'scale':[9,9,9]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    begin_with(&s, &maker, "{'mesh':0,'translation':[3,0,0]}");
    assert_true(fit(&s));
    for (float x = -0.9f; x < 4; x += 0.9f) {
        vec3 at;
        look_up(&s, x, 0, at);
        assert_true(at[0] > 0 && at[0] < 1 && at[1] > 0 && at[1] < 1);
    }
    end(&s);
}

/* A mesh that has too many triangles to look at each, with those positions and these indices, often
 * enough. */
static int add_large_mesh(struct gn_maker *maker, int positions, const uint16_t *indices,
                          size_t count) {
    enum { LARGE = 30060 };
    static uint16_t all[LARGE];
    char text[100];
    for (size_t i = 0; i < LARGE; i++) all[i] = indices[i % count];
    const int accessor = gn_maker_accessor(maker, "SCALAR", 5123, LARGE, all, sizeof all, NULL);
    snprintf(text, sizeof text, "{'primitives':[{'attributes':{'POSITION':%d},'indices':%d}]}",
             positions, accessor);
    return gn_maker_add(maker, "meshes", text);
}

/* Splits go by powers from the nearest to the farthest place in a shadow, each to its next step. */
static void expect_distances(struct stage *s, float near_m, float far_m) {
    s->scene->items[0].receives = false;
    s->opts.cascades = 3;
    assert_true(fit(s));
    const float a = s->view.cascades[0].end_m, b = s->view.cascades[1].end_m;
    assert_float_equal(a * a / b, near_m, 1e-3f);
    assert_float_equal(b * b / a, far_m, 1e-3f);
}

/* The eye is at 0 8 12 and looks at 0, 33.7 degrees down: what is below the table is from 16.9 to
 * 18.6 away, on a floor at -6; and splits are 1.25 apart at least. */
static void test_distances_of_large_meshes_are_those_of_their_boxes(void **state) {
    static const uint16_t square[] = {0, 1, 2, 0, 2, 3};
    (void)state;
    for (int large = 0; large < 2; large++) {
        struct stage s;
        struct gn_maker maker;
        char node[100];
        gn_maker_init(&maker);
        gn_maker_square(&maker);
        gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
        const int mesh = large ? add_large_mesh(&maker, 0, square, 6) : 0;
        snprintf(node, sizeof node, "{'mesh':%d,'translation':[0,-6,0],'scale':[9,9,9]}", mesh);
        begin_with(&s, &maker, node);
        s.scene->items[1].casts = false;
        expect_distances(&s, 16, 31.25f);
        end(&s);
    }
}

/* Techniques divide by the area that a step along x and one along z make on the map. */
static void expect_empty(const char *light, enum gn_technique technique) {
    struct stage s;
    begin(&s, light, 1);
    s.opts.technique = technique;
    for (int i = 0; i < 6; i++) glm_vec4_copy((vec4){0, 0, 0, -1}, s.eye.planes[i]);
    assert_false(fit(&s));
    assert_true(s.view.empty);
    for (uint32_t i = 0; i < s.view.map.tile_count; i++) assert_true(s.view.raster.tiles[i].empty);
    assert_true(s.view.lookup.depth_code[0] == 0 && s.view.lookup.depth_code[1] == 0);
    assert_true(s.view.lookup.tangent_uv[0] > 0 && s.view.lookup.tangent_uv[1] > 0);
    if (s.view.map.tile_count == 1) {
        vec3 at, right, near;
        look_up(&s, 0.5f, 0.5f, at);
        look_up(&s, 0.75f, 0.5f, right);
        look_up(&s, 0.5f, 0.75f, near);
        assert_true(at[2] == 0 && right[2] == 0 && near[2] == 0);
        assert_true(fabsf((right[0] - at[0]) * (near[1] - at[1]) -
                          (right[1] - at[1]) * (near[0] - at[0])) > 1e-3f);
    }
    end(&s);
}

static void test_an_empty_view_has_no_slope_and_two_directions(void **state) {
    (void)state;
    static const char *const lights[] = {"{'type':'directional'}", "{'type':'spot'}",
                                         "{'type':'point'}"};
    for (int i = 0; i < 3; i++)
        for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++)
            expect_empty(lights[i], (enum gn_technique)t);
}

static void test_an_eye_that_is_not_a_number_sees_nothing(void **state) {
    (void)state;
    mat4 clip_from_world;
    struct gn_eye eye;
    const struct gn_box box = {{-1, -1, -1}, {1, 1, 1}};
    glm_perspective(1.0f, 1.0f, 2e38f, 3e38f, clip_from_world); /* their sum overflows */
    gn_eye_build(&eye, clip_from_world);
    assert_false(gn_eye_sees(&eye, &box));
    glm_perspective(1.0f, 1.0f, 0.1f, 10.0f, clip_from_world);
    gn_eye_build(&eye, clip_from_world);
    assert_true(gn_eye_sees(&eye, &box));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_casters_in_one_plane_across_the_sun_have_a_depth),
        cmocka_unit_test(test_a_spots_window_does_not_grow_with_the_scene),
        cmocka_unit_test(test_a_kept_memory_fits_as_a_new_one),
        cmocka_unit_test(test_what_is_beyond_the_range_takes_no_part),
        cmocka_unit_test(test_all_receive_where_visibility_is_the_picture),
        cmocka_unit_test(test_a_window_holds_all_casters),
        cmocka_unit_test(test_distances_of_large_meshes_are_those_of_their_boxes),
        cmocka_unit_test(test_an_empty_view_has_no_slope_and_two_directions),
        cmocka_unit_test(test_a_map_stays_for_a_colour_and_not_for_a_cone),
        cmocka_unit_test(test_an_eye_that_is_not_a_number_sees_nothing),
    };
    return RUN(tests);
}
