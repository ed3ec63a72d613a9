/* Where a point falls on a slide, by hand: the slide at 2 m, 4 m wide and 2 m high, unless said
 * otherwise; the lamp looks along its -Z. */
#include "shadow/slide.h"

#include <cglm/cglm.h>
#include <math.h>

#include "unit/check.h"

static struct gn_texture texture;
static struct gn_node node;
static struct gn_light light;
static struct gn_scene scene;
static mat4 world;
static struct gn_pose pose;

static void begin(void) {
    light = (struct gn_light){.type = GN_LIGHT_SPOT,
                              .outer_rad = GLM_PI_4f,
                              .slide_size_m = {4, 2},
                              .slide_distance_m = 2};
    scene = (struct gn_scene){.lights = &light,
                              .light_count = 1,
                              .nodes = &node,
                              .node_count = 1,
                              .pictures.textures = &texture,
                              .pictures.texture_count = 1};
    glm_mat4_identity(world);
    pose = (struct gn_pose){.scene = &scene, .lights = &light, .world_from_node = &world};
}

static void expect(float x, float y, float z, float u, float v) {
    struct gn_slide_view view;
    vec4 p = {x, y, z, 1};
    gn_slide_build(&pose, 0, 0.0f, &view);
    float w = glm_vec4_dot(view.w, p);
    assert_float_equal(glm_vec4_dot(view.u, p) / w, u, 1e-5f);
    assert_float_equal(glm_vec4_dot(view.v, p) / w, v, 1e-5f);
}

static float depth_at(float x, float y, float z) {
    struct gn_slide_view view;
    gn_slide_build(&pose, 0, 0.0f, &view);
    return glm_vec4_dot(view.w, (vec4){x, y, z, 1});
}

static float near_of(void) {
    struct gn_slide_view view;
    gn_slide_build(&pose, 0, 0.0f, &view);
    return view.near_m;
}

static void test_corners_of_the_slide_are_those_of_its_picture(void **state) {
    (void)state;
    begin();
    expect(0, 0, -2, 0.5f, 0.5f);
    expect(-2, 1, -2, 0, 0); /* upper left */
    expect(2, 1, -2, 1, 0);
    expect(-2, -1, -2, 0, 1);
    expect(4, -2, -4, 1, 1); /* on the same ray */
}

static void test_w_is_the_depth_before_the_lamp(void **state) {
    (void)state;
    begin();
    assert_float_equal(depth_at(3, -1, -7), 7, 1e-5f);
    assert_float_equal(depth_at(3, -1, 0), 0, 1e-5f);
    assert_true(depth_at(0, 0, 5) < 0);
    assert_float_equal(near_of(), 2, 0);
}

static void test_the_slide_goes_with_its_lamp(void **state) {
    (void)state;
    begin();
    /* At (10, 3, 0), looking down, its top to -Z of the world. */
    glm_translate_make(world, (vec3){10, 3, 0});
    glm_rotate(world, -GLM_PI_2f, (vec3){1, 0, 0});
    expect(10, 0, 0, 0.5f, 0.5f);
    expect(12, 1, -1, 1, 0);
    expect(8, 1, 1, 0, 1);
}

static void test_the_slide_rolls_with_its_node(void **state) {
    (void)state;
    begin();
    glm_rotate_make(world, GLM_PI_2f, (vec3){0, 0, 1}); /* its right is up, its top is left */
    expect(0, 2, -2, 1, 0.5f);
    expect(-1, 0, -2, 0.5f, 0);
}

static void test_the_scale_of_a_node_says_nothing(void **state) {
    (void)state;
    begin();
    glm_scale_make(world, (vec3){-3, 0.5f, 7});
    expect(2, 1, -2, 1, 0);
    assert_float_equal(depth_at(0, 0, -7), 7, 1e-5f);
}

static void test_without_a_size_it_is_as_large_as_the_cone(void **state) {
    (void)state;
    begin();
    light.slide_size_m[0] = light.slide_size_m[1] = 0;
    expect(5, 5, -5, 1, 0); /* 45 degrees */
    assert_float_equal(near_of(), 2, 0);
    light.slide_distance_m = 0;
    expect(5, 5, -5, 1, 0);
    assert_true(near_of() > 0 && near_of() < 0.001f);
    light.slide_distance_m = 2e-5f; /* in a scene of 1 mm */
    assert_float_equal(near_of(), 2e-5, 0);
}

static void test_a_size_alone_spans_the_cone_with_its_longer_side(void **state) {
    (void)state;
    begin();
    light.slide_distance_m = 0;
    expect(5, 0, -5, 1, 0.5f);
    expect(0, 2.5f, -5, 0.5f, 0);
    assert_float_equal(near_of(), 2, 1e-6f);
}

static void test_a_cone_of_half_a_sphere_is_cut(void **state) {
    (void)state;
    begin();
    light.outer_rad = GLM_PI_2f;
    light.slide_size_m[0] = light.slide_size_m[1] = 0;
    expect(5.6712818f, 0, -1, 1, 0.5f); /* tan 80 degrees */
}

static void test_only_a_spot_with_a_picture_throws_one(void **state) {
    (void)state;
    begin();
    assert_int_equal(gn_slide_of(&light), GN_SLIDE_DARK);
    light.slide_lit_outside = true;
    assert_int_equal(gn_slide_of(&light), GN_SLIDE_LIT);
    light.slide = -1;
    assert_int_equal(gn_slide_of(&light), GN_SLIDE_NONE);
    light.slide = 0;
    light.type = GN_LIGHT_POINT;
    assert_int_equal(gn_slide_of(&light), GN_SLIDE_NONE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corners_of_the_slide_are_those_of_its_picture),
        cmocka_unit_test(test_w_is_the_depth_before_the_lamp),
        cmocka_unit_test(test_the_slide_goes_with_its_lamp),
        cmocka_unit_test(test_the_slide_rolls_with_its_node),
        cmocka_unit_test(test_the_scale_of_a_node_says_nothing),
        cmocka_unit_test(test_without_a_size_it_is_as_large_as_the_cone),
        cmocka_unit_test(test_a_size_alone_spans_the_cone_with_its_longer_side),
        cmocka_unit_test(test_a_cone_of_half_a_sphere_is_cut),
        cmocka_unit_test(test_only_a_spot_with_a_picture_throws_one),
    };
    return RUN(tests);
}
