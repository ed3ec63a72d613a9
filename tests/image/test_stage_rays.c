/* Rays of a thread: what the kiosk shows as truth while its loop goes on. */
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "options/args.h"
#include "stage/rays.h"
#include "unit/gltf_maker.h"
#include "unit/options_help.h"

enum { WIDTH = 96, HEIGHT = 72 };

/* A square that moves over another one, without a light of its own. */
static struct gn_scene *make_unlit(void) {
    static const float times_s[] = {0, 2}, moves[] = {0, 1, 0, 1, 1, 0};
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'scale':[2,2,2]},{'mesh':0,'translation':[0,1,0]}]");
    gn_maker_accessor(&maker, "SCALAR", 5126, 2, times_s, sizeof times_s, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, 2, moves, sizeof moves, NULL);
    gn_maker_add(&maker, "animations",
                 "{'samplers':[{'input':2,'output':3}],'channels':[{'sampler':0,"
                 "'target':{'node':1,'path':'translation'}}]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    return gn_maker_load(&maker, NULL, &err);
}

/* A thread has a copy of the pose. */
static void test_rays_of_a_thread_are_those_of_the_picture(void **state) {
    (void)state;
    char *argv[] = {"gnomon", "render", "--backend",  "egl",       "--size", "96x72", "--shadow",
                    "truth",  "--aov",  "visibility", "--samples", "4",      NULL};
    static float once[WIDTH * HEIGHT][4], again[WIDTH * HEIGHT][4];
    struct gn_stage stage;
    const struct gn_plan *plan = NULL;
    if (!gn_args_parse(&options, 12, argv, &warnings, &err) ||
        !gn_stage_take(&stage, options.settings, make_unlit(), &warnings, &err) ||
        !gn_stage_open(&stage, &warnings, &err) ||
        !gn_view_draw(&stage.shown, &stage, GN_NS_PER_S, &warnings, &err) ||
        !gn_gl_read_f32(stage.gl, once[0], &err) ||
        !(plan = gn_view_plan(&stage.shown, stage.gl, &warnings, &err)))
        fail_msg("%s", err.text);
    struct gn_rays *rays = gn_rays_begin(&stage, &stage.shown, plan, &err);
    if (!rays) fail_msg("%s", err.text);
    while (!gn_rays_are_done(rays)) usleep(1000);
    stage.shown.rays = rays;
    assert_non_null(gn_view_draw(&stage.shown, &stage, GN_NS_PER_S, &warnings, &err));
    assert_true(gn_gl_read_f32(stage.gl, again[0], &err));
    assert_memory_equal(once, again, sizeof once);
    int dark = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) dark += once[i][0] == 0;
    assert_in_range(dark, 100, WIDTH * HEIGHT / 2);
    gn_rays_destroy(rays);
    gn_stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_rays_of_a_thread_are_those_of_the_picture, clean),
    };
    return RUN(tests);
}
