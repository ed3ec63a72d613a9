/* Occlusion in a kiosk: made beside its frames, and shown again after what ends it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/clock.h"
#include "gl/private.h"
#include "image/occlusion.h"
#include "kiosk/private.h"
#include "stage/occlusion.h"
#include "unit/check.h"
#include "unit/show_help.h"

/* The thread has a low priority: it waits for all else that a machine does. */
#define PATIENCE_NS (600 * GN_NS_PER_S)

const char *gn_shot_build(void); /* image/shot.h, whose names are others of the options */

static char path[300];

static int begin(void **state) {
    struct gn_err err = {0};
    (void)state;
    snprintf(path, sizeof path, "%.200s/show-occlusion.glb", gn_shot_build());
    if (!gn_occlusion_write(GN_OCCLUSION_PAVILION, path, &err)) fail_msg("%s", err.text);
    return 0;
}

static struct gn_show *open_kiosk(void) {
    return help_show((const char *const[]){"--size", "64x64", "--turntable", "20", "--shadow",
                                           "hard", path, NULL});
}

static uint64_t id_of(const struct gn_show *show) {
    return show->screen.stage.shown.opts.occlusion.id;
}

/* Until it is complete. Returns how many frames had none. */
static uint64_t wait_for_occlusion(struct gn_show *show) {
    const struct gn_show_screen *s = &show->screen;
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_NS;
    const uint64_t first = show->counts.frames;
    const struct timespec little = {.tv_nsec = 20000000};
    uint64_t without = 0;
    do {
        nanosleep(&little, NULL);
        help_show_step(show);
        if (id_of(show) == 0) without = show->counts.frames - first;
        if (gn_clock_monotonic_ns() > until_ns) fail_msg("no occlusion");
    } while (id_of(show) == 0 || gn_occluder_fades(s->stage.occluder));
    for (int i = 0; i < 3; i++) help_show_step(show);
    return without;
}

/* And a lost context has it again. */
static void frames_go_on_while_it_is_made_and_fades(void **state) {
    (void)state;
    struct gn_show *show = open_kiosk();
    assert_true(show->screen.stage.shown.opts.occlusion.on);
    const uint64_t without = wait_for_occlusion(show);
    assert_true(without > 3);
    assert_int_equal(show->counts.objects, 0);
    assert_true(show->screen.stage.gl->occlusion.id == id_of(show));
    const uint64_t id = id_of(show), frames = show->counts.frames;
    const unsigned long allocations = show->counts.allocations;
    while (show->counts.frames < frames + 5) help_show_step(show);
    assert_true(id_of(show) == id); /* it stands, whatever the camera does */
    assert_int_equal(show->counts.allocations, allocations);
    show->screen.stage.display.screen.generation++;
    while (show->counts.frames < frames + 8) help_show_step(show);
    assert_true(id_of(show) == id); /* not made again */
    assert_true(show->screen.stage.gl->occlusion.id == id);
    gn_show_close(show);
}

static void a_scene_may_go_while_it_is_made(void **state) {
    (void)state;
    struct gn_show *show = open_kiosk();
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_NS;
    const struct gn_scene *first = show->screen.stage.scene;
    while (!gn_occluder_works(show->screen.stage.occluder)) {
        help_show_step(show);
        if (gn_clock_monotonic_ns() > until_ns) fail_msg("nothing makes it");
    }
    gn_show_load_file(show, path);
    while (show->screen.stage.scene == first) {
        help_show_step(show);
        if (gn_clock_monotonic_ns() > until_ns) fail_msg("the other scene does not come");
    }
    wait_for_occlusion(show);
    gn_show_close(show);
    show = open_kiosk(); /* the kiosk, too */
    help_show_step(show);
    gn_show_close(show);
}

int main(void) {
    setenv("CACHE_DIRECTORY", "/dev/null/none", 1); /* nothing is kept of earlier runs */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_go_on_while_it_is_made_and_fades),
        cmocka_unit_test(a_scene_may_go_while_it_is_made),
    };
    return cmocka_run_group_tests(tests, begin, NULL);
}
