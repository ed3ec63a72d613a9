#include "unit/show_help.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "options/args.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { ARGUMENTS_MAX = 32 };
#define PATIENCE_NS (60 * GN_NS_PER_S)

struct gn_show *help_show_begun(const char *const more[]) {
    static struct gn_warnings warnings;
    struct gn_options options;
    struct gn_err err = {0};
    struct gn_display display;
    static const char *argv[ARGUMENTS_MAX]; /* a reload reads them again */
    static const char *const first[] = {"gnomon", "show", "--backend", "egl"};
    int argc = 0;
    help_open(&display, "egl"); /* or the test is skipped */
    gn_display_close(&display);
    while (argc < 4) argv[argc] = first[argc], argc++;
    while (*more && argc < ARGUMENTS_MAX - 1) argv[argc++] = *more++;
    argv[argc] = NULL;
    setenv("XDG_CONFIG_HOME", "/nowhere", 1);
    if (!gn_args_parse(&options, argc, (char *const *)(uintptr_t)argv, &warnings, &err))
        fail_msg("%s", err.text);
    struct gn_show *show = gn_show_open(&options, &warnings, &err);
    gn_options_finish(&options);
    if (!show) fail_msg("%s", err.text);
    gn_part_close(&show->parts, GN_PART_health); /* its readings end steps between frames */
    return show;
}

struct gn_show *help_show(const char *const more[]) {
    struct gn_show *show = help_show_begun(more);
    while (show->reload.first) help_show_step(show);
    return show;
}

struct gn_show *help_show_of(const char *config, const char *const more[]) {
    static char path[200]; /* the kiosk names its file */
    const char *folder = help_folder(), *all[ARGUMENTS_MAX] = {"--size", "64x64", "-c", path};
    for (int i = 4; i < ARGUMENTS_MAX - 5 && *more; i++) all[i] = *more++;
    help_write(folder, "kiosk.ini", config);
    snprintf(path, sizeof path, "%s/kiosk.ini", folder);
    struct gn_show *show = help_show(all);
    help_remove(folder);
    if (show->config.options->config_error) fail_msg("%s", show->config.options->config_error);
    return show;
}

void help_show_all_modes(struct gn_show *show) {
    show->screen.rules.passed_by = 0;
    show->screen.ahead.idle = false;
}

void help_show_step(struct gn_show *show) {
    struct gn_err err = {0};
    if (!gn_show_step(show, &err)) fail_msg("%s", err.text);
}

void help_show_act(struct gn_show *show, enum gn_action_kind kind) {
    static const uint64_t one = 1;
    gn_show_act(&show->screen, &(struct gn_action){.kind = kind}, gn_clock_monotonic_ns());
    assert_int_equal(write(gn_loader_fd(show->scenes.loader), &one, sizeof one), sizeof one);
}

void help_show_frames(struct gn_show *show, unsigned count) {
    const uint64_t end = show->counts.frames + count;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (show->counts.frames < end) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
}

void help_show_until_warm(struct gn_show *show) {
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    do {
        help_show_step(show);
        assert_true(gn_clock_process_cpu_ns() - begun_ns < 3 * PATIENCE_NS);
    } while (show->counts.frames == 0 || gn_show_has_work(&show->screen));
}

bool help_show_changes(const struct gn_show *show) {
    const struct gn_show_screen *s = &show->screen;
    return !s->stage.display.screen.may_draw || s->kiosk.caption || gn_show_wants_frame(s) ||
           gn_show_captions_due_ns(s) < INT64_MAX;
}

void help_show_picture(const struct gn_show *show, uint8_t *out) {
    struct gn_err err = {0};
    if (!gn_gl_read_rgba8(show->screen.stage.gl, out, &err)) fail_msg("%s", err.text);
}
