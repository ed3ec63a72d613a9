/* Draws of a picture with more meshes than are sorted by insertion: each once, nearest first, and
 * nothing is allocated after the first frames. */
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "frame/frame.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { MESHES = 301 };

/* Triangles of their own in a shuffled row away from the camera. */
static struct gn_scene *make_scene(void) {
    static const float corners[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    struct gn_maker maker;
    struct gn_err err = {0};
    char json[200], list[MESHES * 5 + 20] = "[{'nodes':[", *to = list + strlen(list);
    gn_maker_init(&maker);
    for (int i = 0; i < MESHES; i++) {
        const int a = gn_maker_accessor(&maker, "VEC3", 5126, 3, corners, sizeof corners,
                                        "'min':[-1,-1,0],'max':[1,1,0]");
        snprintf(json, sizeof json, "{'primitives':[{'attributes':{'POSITION':%d}}]}", a);
        gn_maker_add(&maker, "meshes", json);
        snprintf(json, sizeof json, "{'mesh':%d,'translation':[0,0,%d]}", i,
                 -5 - i * 100 % MESHES); /* 100 and 301 have no factor in common */
        gn_maker_add(&maker, "nodes", json);
        to += sprintf(to, "%s%d", i ? "," : "", i);
    }
    sprintf(to, ",%d]}]", MESHES);
    gn_maker_add(&maker, "nodes", "{'camera':0}");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':1,'znear':0.1,'zfar':1000}}]");
    gn_maker_set(&maker, "scenes", list);
    struct gn_scene *scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

static void check_order(const struct gn_plan *plan) {
    const struct gn_pass *pass = NULL;
    for (uint32_t i = 0; i < plan->pass_count && !pass; i++)
        if (plan->passes[i].draw_count == MESHES && plan->passes[i].kind == GN_PASS_PICTURE)
            pass = &plan->passes[i];
    assert_non_null(pass);
    bool drawn[MESHES] = {false};
    for (uint32_t i = 0; i < MESHES; i++) {
        const struct gn_draw *draw = &plan->draws[pass->first_draw + i];
        assert_false(drawn[draw->geometry]);
        drawn[draw->geometry] = true;
        if (i > 0) assert_true(draw[-1].depth_m < draw->depth_m);
    }
}

static void test_many_draws_come_nearest_first(void **state) {
    (void)state;
    struct gn_scene *scene = make_scene();
    const struct gn_caps caps = {
        .has = (1u << GN_CAP_COUNT) - 1, .max_texture_px = 4096, .max_texture_units = 16};
    const struct gn_frame_opts opts = {.output.width_px = 320, .output.height_px = 180};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    struct gn_frame *frame = gn_frame_create(scene, &caps);
    check_order(gn_frame_build(frame, &pose, &opts, NULL));
    gn_frame_build(frame, &pose, &opts, NULL);
    const unsigned long before = gn_alloc_count();
    check_order(gn_frame_build(frame, &pose, &opts, NULL));
    assert_int_equal(gn_alloc_count(), before);
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_many_draws_come_nearest_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
