#include <cglm/cglm.h>
#include <math.h>

#include "plan/stage_scene.h"
#include "shadow/reach.h"
#include "unit/check.h"

enum { WIDTH = 400, HEIGHT = 200 };

/* A light at the origin that shines along -Z, and an eye at (0, 0, 10) that looks at it. */
static struct gn_reach reach_of(float range_m, float outer_rad) {
    return (struct gn_reach){.cone = outer_rad > 0.0f,
                             .axis_ws = {0, 0, -1},
                             .range_m = range_m,
                             .sin_cone = sinf(outer_rad),
                             .cos_cone = cosf(outer_rad)};
}

static struct gn_eye eye_at(float z, float yaw_rad) {
    mat4 view, projection, clip;
    glm_look((vec3){0, 0, z}, (vec3){sinf(yaw_rad), 0, -cosf(yaw_rad)}, (vec3){0, 1, 0}, view);
    glm_perspective(1.0f, (float)WIDTH / HEIGHT, 0.1f, 100.0f, projection);
    glm_mat4_mul(projection, view, clip);
    struct gn_eye eye;
    gn_eye_build(&eye, clip);
    return eye;
}

static struct gn_box cube(float x, float y, float z, float half) {
    return (struct gn_box){{x - half, y - half, z - half}, {x + half, y + half, z + half}};
}

static bool touches(const struct gn_reach *reach, struct gn_box box) {
    return gn_reach_touches(reach, &box);
}

static void test_a_ball_touches_what_is_in_range(void **state) {
    (void)state;
    struct gn_reach r = reach_of(2, 0);
    assert_true(touches(&r, cube(0, 0, 0, 0.5f)));
    assert_true(touches(&r, cube(2.4f, 0, 0, 0.5f)));
    assert_false(touches(&r, cube(2.6f, 0, 0, 0.5f)));
    assert_false(touches(&r, cube(2, 2, 0, 0.5f))); /* its corner is 2.12 away */
    assert_true(touches(&r, cube(0, 0, 0, 50)));
    r.everywhere = true;
    assert_true(touches(&r, cube(100, 0, 0, 0.5f)));
}

static void test_a_cone_touches_what_is_before_it(void **state) {
    (void)state;
    struct gn_reach r = reach_of(10, 0.5f);
    assert_true(touches(&r, cube(0, 0, -5, 0.5f)));
    assert_false(touches(&r, cube(0, 0, 5, 0.5f)));
    assert_false(touches(&r, cube(6, 0, -5, 0.5f)));
    assert_true(touches(&r, cube(2.8f, 0, -5, 0.5f))); /* tan .5 = .546: 2.73 */
    assert_false(touches(&r, cube(0, 0, -12, 0.5f)));
    assert_true(touches(&r, cube(0, 0, 0, 0.5f)));
}

/* Every point that the light reaches and the eye sees lies inside the rectangle. */
static void expect_inside(const struct gn_reach *reach, const struct gn_eye *eye) {
    struct gn_reach_rect r = gn_reach_rect(reach, eye, WIDTH, HEIGHT);
    for (int i = 0; i < 20000; i++) { /* a spiral over the sphere, at growing distances */
        float z = 1.0f - 2.0f * ((float)i + 0.5f) / 20000.0f, turn = 2.399963f * (float)i;
        float flat = sqrtf(1.0f - z * z), d = reach->range_m * (float)(i % 17) / 16.0f;
        if (reach->cone && -z < reach->cos_cone) continue;
        vec4 p = {d * flat * cosf(turn), d * flat * sinf(turn), d * z, 1.0f};
        glm_mat4_mulv((vec4 *)eye->clip_from_world, p, p);
        if (p[3] <= 0 || fabsf(p[0]) > p[3] || fabsf(p[1]) > p[3] || fabsf(p[2]) > p[3]) continue;
        float x = (0.5f * p[0] / p[3] + 0.5f) * WIDTH, y = (0.5f * p[1] / p[3] + 0.5f) * HEIGHT;
        if (x < (float)r.x0 || x > (float)r.x1 || y < (float)r.y0 || y > (float)r.y1)
            fail_msg("%g, %g is outside %d..%d, %d..%d", (double)x, (double)y, r.x0, r.x1, r.y0,
                     r.y1);
    }
}

static void test_all_that_is_lit_lies_inside(void **state) {
    (void)state;
    static const float cones[] = {0, 0.1f, 0.5f, 1.0f, 1.3f, 1.57f};
    for (int c = 0; c < 6; c++)
        for (float range_m = 0.5f; range_m < 40.0f; range_m *= 3.0f)
            for (float z = -8; z <= 10; z += 4.5f)
                for (float yaw_rad = 0; yaw_rad < 3; yaw_rad += 0.4f) {
                    struct gn_reach r = reach_of(range_m, cones[c]);
                    struct gn_eye eye = eye_at(z, yaw_rad);
                    expect_inside(&r, &eye);
                }
}

static void test_bounds_are_not_much_larger(void **state) {
    (void)state;
    struct gn_eye eye = eye_at(10, 0);
    struct gn_reach r = reach_of(1, 0);
    struct gn_reach_rect rect = gn_reach_rect(&r, &eye, WIDTH, HEIGHT);
    /* the cube's near face is 9 away: half of it shows under 1 / (9 tan .5) of the half height */
    float half = HEIGHT / 2 / (9 * tanf(0.5f));
    assert_true(fabsf((float)rect.x0 - (WIDTH / 2 - half)) <= 2.0f);
    assert_true(fabsf((float)rect.y1 - (HEIGHT / 2 + half)) <= 2.0f);
    r = reach_of(4, 0.1f); /* away from the eye: a narrow cone, not its cube */
    rect = gn_reach_rect(&r, &eye, WIDTH, HEIGHT);
    assert_in_range(rect.x1 - rect.x0, 1, 14);
    assert_in_range(rect.y1 - rect.y0, 1, 14);
}

static void test_what_the_eye_does_not_see_has_no_bounds(void **state) {
    (void)state;
    struct gn_eye away = eye_at(10, 3.14159f);
    struct gn_reach r = reach_of(2, 0);
    struct gn_reach_rect rect = gn_reach_rect(&r, &away, WIDTH, HEIGHT);
    assert_true(rect.x0 >= rect.x1);
    struct gn_eye inside = eye_at(0.5f, 3.14159f);
    rect = gn_reach_rect(&r, &inside, WIDTH, HEIGHT);
    assert_true(rect.x0 == 0 && rect.y0 == 0 && rect.x1 == WIDTH && rect.y1 == HEIGHT);
}

static void test_rects_unite(void **state) {
    (void)state;
    struct gn_reach_rect a = {1, 2, 3, 4}, b = {0, 3, 2, 9}, none = {0};
    struct gn_reach_rect both = gn_reach_rect_unite(a, b);
    assert_true(both.x0 == 0 && both.y0 == 2 && both.x1 == 3 && both.y1 == 9);
    both = gn_reach_rect_unite(none, a);
    assert_true(both.x0 == 1 && both.x1 == 3);
}

static void test_reach_of_the_lights_of_a_scene(void **state) {
    (void)state;
    struct gn_scene *scene = gn_stage_scene_make();
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    gn_pose_step(&pose, 0);
    struct gn_reach r;
    gn_reach_build(&r, &pose, 0);
    assert_true(r.everywhere);
    gn_reach_build(&r, &pose, 1);
    assert_true(r.cone && !r.everywhere);
    float farthest = r.range_m; /* no range of its own: as far as the scene goes */
    assert_true(farthest > 10.0f && farthest < 20.0f);
    scene->lights[1].range_m = 3.0f;
    gn_reach_build(&r, &pose, 1);
    assert_true(r.range_m == 3.0f);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_ball_touches_what_is_in_range),
        cmocka_unit_test(test_a_cone_touches_what_is_before_it),
        cmocka_unit_test(test_all_that_is_lit_lies_inside),
        cmocka_unit_test(test_bounds_are_not_much_larger),
        cmocka_unit_test(test_what_the_eye_does_not_see_has_no_bounds),
        cmocka_unit_test(test_rects_unite),
        cmocka_unit_test(test_reach_of_the_lights_of_a_scene),
    };
    return RUN(tests);
}
