/* The kiosk while scenes load: frames go on, nothing waits for what nobody wants any more, and the
 * first picture does not wait for the first scene. The slow scene is a model whose importer, found
 * in PATH, sleeps. */
#include "unit/check.h"

#include <config.h> /* the generated one */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/clock.h"
#include "core/disk.h"
#include "kiosk/private.h"
#include "kiosk/state.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

#define PATIENCE_NS (60 * GN_NS_PER_S)

static char folder[100], good[300], other[300];
static bool remembers; /* kiosks have a state */

static const char *in_folder(const char *name) {
    static char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_config(const char *scene) {
    char text[500];
    snprintf(text, sizeof text,
             "[scene]\nfile = %s\nturntable = 10\n[render]\nshadow = hard\n[kiosk]\nstate = %s\n"
             "[mode \"A\"]\n[mode \"B\"]\n",
             scene, remembers ? "state" : "no");
    help_write(folder, "kiosk.ini", text);
}

/* An importer that takes two seconds, or is never done. */
static void write_importer(bool ends) {
    char text[800];
    snprintf(text, sizeof text, "#!/bin/sh\necho $$ > '%s/pid'\n%s sleep %d\nexec cat '%s'\n",
             folder, ends ? "" : "exec", ends ? 2 : 1000, good);
    help_write(folder, "gnomon-import", text);
    chmod(in_folder("gnomon-import"), 0755);
    unlink(in_folder("pid"));
}

static bool importer_runs(void) {
    char name[40], state = 'Z';
    int pid = 0;
    FILE *file = fopen(in_folder("pid"), "r");
    if (!file || fscanf(file, "%d", &pid) != 1) pid = 0;
    if (file) fclose(file);
    snprintf(name, sizeof name, "/proc/%d/stat", pid);
    file = pid ? fopen(name, "r") : NULL;
    if (file && fscanf(file, "%*d %*s %c", &state) != 1) state = 'Z';
    if (file) fclose(file);
    return state != 'Z';
}

static int begin(void **state) {
    struct gn_display display;
    char path[300];
    (void)state;
    help_open(&display, "egl"); /* or the test is skipped */
    gn_display_close(&display);
    if (access(GN_PREFIX "/libexec/gnomon-import", X_OK) == 0 ||
        access(GN_PREFIX "/bin/gnomon-import", X_OK) == 0) {
        puts("another gnomon-import is installed and would be used");
        exit(77);
    }
    snprintf(folder, sizeof folder, "%s", help_folder());
    snprintf(path, sizeof path, "%s:%s", folder, getenv("PATH"));
    setenv("PATH", path, 1);
    help_write(folder, "slow.obj", "");
    char *here = realpath(".", NULL);
    snprintf(good, sizeof good, "%s/assets/bench/s1.glb", here);
    snprintf(other, sizeof other, "%s/assets/bench/s2.glb", here);
    free(here);
    return 0;
}

static int end(void **state) {
    (void)state;
    help_remove(folder);
    return 0;
}

static struct gn_show *open_show(const char *scene) {
    static char config[200];
    write_config(scene);
    snprintf(config, sizeof config, "%s", in_folder("kiosk.ini"));
    return help_show_begun((const char *const[]){"--size", "64x64", "-c", config, NULL});
}

static bool is_shown(const struct gn_show *show, const char *scene) {
    return !show->reload.options &&
           strcmp(show->scenes.paths[show->screen.drawn.scene], scene) == 0;
}

static void wait_for_importer(struct gn_show *show) {
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (!importer_runs()) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
}

static void frames_go_on_during_a_reload_and_a_later_one_replaces_it(void **state) {
    (void)state;
    write_importer(false);
    struct gn_show *show = open_show(good);
    help_show_frames(show, 2);
    write_config(in_folder("slow.obj"));
    show->wants_reload = true;
    wait_for_importer(show);
    help_show_frames(show, 20);
    assert_non_null(show->reload.options);
    assert_int_equal(gn_loader_number(show->scenes.loader), GN_SHOW_RELOAD);
    assert_string_equal(show->scenes.paths[show->screen.drawn.scene], good);

    /* the later one, and the importer is gone */
    write_config(other);
    show->wants_reload = true;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (!is_shown(show, other)) {
        help_show_frames(show, 1);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_false(importer_runs());
    gn_show_close(show);
}

/* A scene of 36 MB. */
static const char *write_huge(void) {
    help_write_huge(folder, 2999997);
    return in_folder("huge.gltf");
}

static void wait_for_staging(struct gn_show *show) {
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (!gn_show_reload_is_staged(&show->screen)) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
}

static void frames_go_on_while_the_scene_of_a_reload_is_uploaded(void **state) {
    (void)state;
    struct gn_show *show = open_show(good);
    help_show_frames(show, 2);
    const struct gn_gl *gl = show->screen.stage.gl;
    write_config(write_huge());
    show->wants_reload = true;
    wait_for_staging(show);
    help_show_frames(show, 20); /* a megabyte in each */
    assert_true(gn_show_reload_is_staged(&show->screen));
    assert_string_equal(show->scenes.paths[show->screen.drawn.scene], good);

    /* the mode may change meanwhile */
    const struct gn_action b = {.kind = GN_ACTION_MODE, .name = "B"};
    gn_show_act(&show->screen, &b, gn_clock_monotonic_ns());
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (!is_shown(show, in_folder("huge.gltf"))) {
        help_show_frames(show, 1);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_string_equal(show->modes.names[show->screen.kiosk.shown.mode], "B");
    assert_ptr_equal(show->screen.stage.gl, gl);

    /* without room for two on the GPU the old one goes first */
    write_config(good);
    show->wants_reload = true;
    wait_for_staging(show);
    show->reload.alone = true;
    help_show_step(show);
    assert_null(show->reload.options);
    help_show_frames(show, 2);
    assert_true(is_shown(show, good));

    /* one that is not complete yet is dropped for a later one */
    write_config(other);
    show->wants_reload = true;
    wait_for_staging(show);
    write_config(in_folder("huge.gltf"));
    show->wants_reload = true;
    help_show_step(show);
    assert_false(gn_show_reload_is_staged(&show->screen));
    gn_show_close(show);
}

/* Four fifths are the file and its pictures, the last one is the upload; it never goes back. */
static void the_bar_counts_the_load_and_the_upload(void **state) {
    (void)state;
    struct gn_show *show = open_show(good);
    help_show_frames(show, 2);
    write_config(write_huge());
    show->wants_reload = true;
    int before = -1, loads = 0, uploads = 0, values[101] = {0};
    bool staged = false; /* by now: the last step shows it, and stages nothing any more */
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (!is_shown(show, in_folder("huge.gltf"))) {
        help_show_step(show);
        staged |= gn_show_reload_is_staged(&show->screen);
        const int bar = show->screen.text.bar;
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
        if (bar < 0) continue;
        assert_in_range(bar, before < 0 ? 0 : before, 100);
        before = bar;
        values[bar] = 1;
        if (!staged) assert_true(bar <= 80);
    }
    for (int i = 0; i <= 100; i++) loads += values[i] && i < 80, uploads += values[i] && i >= 80;
    if (loads < 2 || uploads < 5) fail_msg("%d steps of a load, %d of an upload", loads, uploads);
    gn_show_close(show);
}

static void a_bad_reload_keeps_the_scene(void **state) {
    (void)state;
    struct gn_show *show = open_show(good);
    help_show_frames(show, 2);
    help_write(folder, "bad.glb", "this is no scene");
    write_config(in_folder("bad.glb"));
    show->wants_reload = true;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (!show->config.options->config_error) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_non_null(strstr(show->config.error, "kiosk.ini:2: file: "));
    assert_non_null(strstr(show->config.error, "bad.glb: byte 0"));
    help_show_frames(show, 2);
    assert_true(is_shown(show, good));
    gn_show_close(show);
}

static void the_first_picture_does_not_wait_for_the_first_scene(void **state) {
    (void)state;
    write_importer(true);
    const int64_t begun_ns = gn_clock_monotonic_ns();
    struct gn_show *show = open_show(in_folder("slow.obj"));
    assert_true(show->reload.first);
    help_show_frames(show, 1);
    assert_true(show->reload.first || gn_clock_monotonic_ns() - begun_ns > 2 * GN_NS_PER_S);
    write_config(other);
    show->wants_reload = true; /* after the first load */
    while (show->reload.first) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_string_equal(show->scenes.paths[show->screen.drawn.scene], in_folder("slow.obj"));
    while (!is_shown(show, other)) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    gn_show_close(show);
}

/* Of a state: the second of both scenes that were shown last, since the first is gone. */
static void a_first_scene_that_fails_late_is_replaced_by_the_last_good_one(void **state) {
    (void)state;
    struct gn_state last = {
        .sequence = 1, .scene = "/none.glb", .runs = true, .boot = "that of another day"};
    struct gn_err err = {0};
    snprintf(last.past, sizeof last.past, "%s", other);
    assert_true(gn_state_save(&gn_disk, in_folder("state"), 0, &last, &err));
    help_write(folder, "gnomon-import", "#!/bin/sh\nsleep 2\nexit 1\n");
    chmod(in_folder("gnomon-import"), 0755);
    remembers = true;
    struct gn_show *show = open_show(in_folder("slow.obj"));
    remembers = false;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    assert_true(show->reload.first);
    while (show->reload.first) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    help_show_frames(show, 2);
    assert_true(is_shown(show, other));
    assert_non_null(strstr(show->config.error, "slow.obj: "));
    assert_non_null(strstr(show->config.error, " (showing the last good scene)"));
    gn_show_close(show); /* which saves the state */
    int older;
    assert_int_equal(gn_state_read(&gn_disk, in_folder("state"), &last, &older, &err),
                     GN_STATE_READ);
    assert_string_equal(last.scene, "/none.glb"); /* it may come back */
    assert_int_equal(last.counts.starts, 1);
    assert_int_equal(last.counts.cuts, 1);
    assert_int_equal(last.counts.restarts, 0);
}

/* The loop would wake ten times a second for a bar that nobody sees. */
static void no_bar_is_waited_for_without_a_lit_screen(void **state) {
    (void)state;
    write_importer(false);
    struct gn_show *show = open_show(in_folder("slow.obj"));
    bool *lit = &show->screen.stage.display.screen.lit, *dark = &show->screen.drawn.dark;
    help_show_frames(show, 1);
    assert_true(gn_show_bar_due_ns(&show->screen) < INT64_MAX);
    *lit = false;
    assert_true(gn_show_bar_due_ns(&show->screen) == INT64_MAX);
    *lit = *dark = true;
    assert_true(gn_show_bar_due_ns(&show->screen) == INT64_MAX);
    gn_show_close(show);
}

static void the_end_does_not_wait_for_the_first_scene(void **state) {
    (void)state;
    write_importer(false);
    struct gn_show *show = open_show(in_folder("slow.obj"));
    help_show_frames(show, 1);
    const int64_t begun_ns = gn_clock_monotonic_ns();
    gn_show_close(show);
    while (importer_runs()) {
        usleep(10000);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_go_on_during_a_reload_and_a_later_one_replaces_it),
        cmocka_unit_test(frames_go_on_while_the_scene_of_a_reload_is_uploaded),
        cmocka_unit_test(the_bar_counts_the_load_and_the_upload),
        cmocka_unit_test(a_bad_reload_keeps_the_scene),
        cmocka_unit_test(the_first_picture_does_not_wait_for_the_first_scene),
        cmocka_unit_test(a_first_scene_that_fails_late_is_replaced_by_the_last_good_one),
        cmocka_unit_test(no_bar_is_waited_for_without_a_lit_screen),
        cmocka_unit_test(the_end_does_not_wait_for_the_first_scene),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
