/* Occlusion made beside the frames. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/clock.h"
#include "image/occlusion.h"
#include "stage/occlusion.h"
#include "unit/check.h"

static struct gn_scene *scene;
static struct gn_frame_opts opts;

static int setup(void **state) {
    struct gn_err err = {0};
    (void)state;
    opts = (struct gn_frame_opts){.occlusion.on = true};
    scene = gn_occlusion_scene(GN_OCCLUSION_PAVILION, &err);
    return scene ? 0 : -1;
}

static int teardown(void **state) {
    (void)state;
    gn_scene_destroy(scene);
    return 0;
}

/* Frames at one time of the kiosk, until the thread is done. */
static void wait_for_thread(struct gn_occluder *o, int64_t now_ns) {
    const struct timespec little = {.tv_nsec = 2000000};
    while (gn_occluder_works(o)) {
        nanosleep(&little, NULL);
        gn_occluder_step(o, now_ns);
        gn_occluder_give(o, &opts, false);
    }
}

static size_t texel_bytes(void) {
    const uint32_t *size = scene->occlusion.size;
    return 4ul * size[0] * size[1] * size[2];
}

/* The largest change of a texel. */
static int largest_step(const int8_t *a, const int8_t *b) {
    int most = 0;
    for (size_t i = 0; i < texel_bytes(); i++)
        most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    return most;
}

static void now_it_is_complete(void **state) {
    struct gn_occluder *o = gn_occluder_create(scene);
    (void)state;
    gn_occluder_give(o, &opts, true);
    assert_non_null(opts.occlusion.texels);
    assert_true(opts.occlusion.id > 0);
    assert_false(gn_occluder_works(o));
    assert_false(gn_occluder_fades(o));
    const uint64_t id = opts.occlusion.id;
    gn_occluder_give(o, &opts, true); /* it is made once */
    assert_true(opts.occlusion.id == id);
    gn_occluder_destroy(o);
}

static void a_thread_makes_the_same_and_it_fades_in(void **state) {
    struct gn_occluder *now = gn_occluder_create(scene), *o = gn_occluder_create(scene);
    struct gn_frame_opts complete = opts;
    (void)state;
    gn_occluder_give(now, &complete, true);
    gn_occluder_give(o, &opts, false);
    assert_null(opts.occlusion.texels); /* no frame waits for it */
    assert_true(opts.occlusion.id == 0);
    assert_true(gn_occluder_works(o));
    wait_for_thread(o, 5 * GN_NS_PER_S);
    assert_true(gn_occluder_fades(o));

    int8_t *before = malloc(texel_bytes());
    if (!before) abort();
    memcpy(before, opts.occlusion.texels, texel_bytes());
    uint64_t id = opts.occlusion.id;
    int frames = 0;
    for (; gn_occluder_fades(o); frames++) {
        gn_occluder_step(o, 5 * GN_NS_PER_S + frames * GN_NS_PER_S / 60);
        gn_occluder_give(o, &opts, false);
        const int8_t *texels = opts.occlusion.texels[0];
        assert_true(opts.occlusion.id != id); /* GL sends it again */
        assert_true(largest_step(before, texels) <= 4);
        memcpy(before, texels, texel_bytes());
        id = opts.occlusion.id;
    }
    assert_true(frames > 60);
    assert_memory_equal(opts.occlusion.texels, complete.occlusion.texels, texel_bytes());
    gn_occluder_step(o, 9 * GN_NS_PER_S);
    gn_occluder_give(o, &opts, false);
    assert_true(opts.occlusion.id == id);
    free(before);
    gn_occluder_destroy(now);
    gn_occluder_destroy(o);
}

static void another_environment_is_made_anew(void **state) {
    static struct gn_environment side;
    struct gn_occluder *o = gn_occluder_create(scene);
    (void)state;
    for (int k = 0; k < 3; k++) {
        side.whole.harmonics[0][k] = 1;
        side.whole.harmonics[3][k] = .4f;
    }
    gn_occluder_give(o, &opts, true);
    int8_t *before = malloc(texel_bytes());
    if (!before) abort();
    memcpy(before, opts.occlusion.texels, texel_bytes());
    opts.environment.of = &side;
    gn_occluder_give(o, &opts, false);
    assert_memory_equal(opts.occlusion.texels, before, texel_bytes()); /* until it is there */
    wait_for_thread(o, GN_NS_PER_S);
    gn_occluder_step(o, GN_NS_PER_S);
    gn_occluder_step(o, 4 * GN_NS_PER_S);
    gn_occluder_give(o, &opts, false);
    assert_true(largest_step(before, opts.occlusion.texels[0]) > 6);

    /* changed while a thread works on the one before: that is not shown */
    opts.environment.turn_rad = 1;
    gn_occluder_give(o, &opts, false);
    opts.environment = (struct gn_frame_environment_opts){0};
    gn_occluder_give(o, &opts, false);
    wait_for_thread(o, 5 * GN_NS_PER_S);
    gn_occluder_step(o, 9 * GN_NS_PER_S);
    gn_occluder_step(o, 12 * GN_NS_PER_S);
    gn_occluder_give(o, &opts, false);
    assert_memory_equal(opts.occlusion.texels, before, texel_bytes());
    free(before);
    gn_occluder_destroy(o);
}

static void it_ends_while_a_thread_works(void **state) {
    struct gn_occluder *o = gn_occluder_create(scene);
    (void)state;
    gn_occluder_give(o, &opts, false);
    assert_true(gn_occluder_works(o));
    const struct timespec little = {.tv_nsec = 30000000};
    nanosleep(&little, NULL);
    const clock_t begun = clock(); /* of all threads, whatever else the machine does */
    gn_occluder_destroy(o);
    assert_true(clock() - begun < CLOCKS_PER_SEC / 4); /* of about 1 s */
    gn_occluder_destroy(NULL);
}

static void a_sky_has_the_radiance_of_its_harmonics(void **state) {
    static struct gn_environment_light light;
    (void)state;
    for (int k = 0; k < 3; k++) { /* diffuse light of the radiance 1 + y + xy */
        light.harmonics[0][k] = 1;
        light.harmonics[1][k] = 2 / 3.0f;
        light.harmonics[4][k] = .25f;
    }
    const struct gn_sky sky = gn_stage_sky(&light, 0);
    static const float expected[GN_SKY_TERMS] = {1, 1, 0, 0, 1};
    for (int i = 0; i < GN_SKY_TERMS; i++)
        assert_true(fabsf(sky.radiance[i] - expected[i]) < 1e-5f);
    assert_true(sky.turn[0] == 1 && sky.turn[1] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(now_it_is_complete, setup, teardown),
        cmocka_unit_test_setup_teardown(a_thread_makes_the_same_and_it_fades_in, setup, teardown),
        cmocka_unit_test_setup_teardown(another_environment_is_made_anew, setup, teardown),
        cmocka_unit_test_setup_teardown(it_ends_while_a_thread_works, setup, teardown),
        cmocka_unit_test(a_sky_has_the_radiance_of_its_harmonics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
