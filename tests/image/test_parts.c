/* Every part of the kiosk, in each state of the machine: it follows its settings at a reload, and
 * survives that, a lost context, an open that fails, and its end. A row that is added to the table
 * of kiosk/part.h takes part; what it needs here is a line of `trials`. */
#include "unit/check.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "unit/folder.h"
#include "unit/health_help.h"
#include "unit/show_help.h"

static const int64_t PATIENCE_NS = 60 * GN_NS_PER_S, MINUTE_NS = 60 * GN_NS_PER_S;

/* A line of the configuration with which a part does something else than without it. */
static const struct trial {
    const char *section, *line;
    const char *why; /* there is none */
} trials[GN_PART_COUNT] = {
    [GN_PART_kiosk] = {"mode \"b\"", "shadow = none", NULL},
    [GN_PART_state] = {.why = "[kiosk] state counts from the next start on"},
    [GN_PART_trial] = {.why = "it has no settings"},
    [GN_PART_scene] = {.why = "it has no settings"},
    [GN_PART_schedule] = {"schedule", "dim = 00:00-24:00", NULL},
    [GN_PART_sun] = {"sun",
                     "latitude = 52.5\nlongitude = 13.4\ndate = 2026-06-21T12:00Z\nspeed = 0",
                     NULL},
    [GN_PART_television] = {"schedule", "off = cec\ncec_device = /dev/null", NULL},
    [GN_PART_health] = {.why = "it has no settings"},
    [GN_PART_process] = {.why = "it has no settings"},
    [GN_PART_answers] = {.why = "it has no settings"},
    [GN_PART_control] = {.why = "[kiosk] socket counts from the next start on"},
    [GN_PART_content] = {"kiosk", "watch = yes", NULL},
    [GN_PART_shaders] = {"render", "shaders = shaders_es", NULL},
    [GN_PART_service] = {.why = "its settings are the environment of the start"},
    [GN_PART_stats] = {.why = "--stats is of the command line"},
    [GN_PART_shift] = {"display", "pixel_shift = 3", NULL},
};

enum state { NORMAL, PAUSED, BLANKED, ASLEEP, INFO, LOADING, STATES };
static const char *const names[STATES] = {"normal", "paused", "blanked",
                                          "asleep", "info",   "loading"};

static char folder[] = "/tmp/gnomon-parts.XXXXXX", config[64], root[64], saved[64];

/* ---- a kiosk --------------------------------------------------------------------------------- */

/* with: a bit for each part whose trial is in the configuration. */
static void write_config(enum state state, unsigned with) {
    FILE *file = fopen(config, "w");
    char hours[64] = "always";
    static const char days[][4] = {"sun", "mon", "tue", "wed", "thu", "fri", "sat"};
    const time_t far = time(NULL) + 3 * 24 * 3600; /* the screen is on three days from now */
    assert_non_null(file);
    if (state == ASLEEP)
        snprintf(hours, sizeof hours, "%s 00:00-23:00", days[localtime(&far)->tm_wday]);
    fprintf(file,
            "[render]\nshadow = none\n[schedule]\non = %s\nclock = trusted\n"
            "[kiosk]\nstate = %s\n[mode \"a\"]\nshadow = none\n",
            hours, saved);
    for (int i = 0; i < GN_PART_COUNT; i++)
        if (with >> i & 1) fprintf(file, "[%s]\n%s\n", trials[i].section, trials[i].line);
    assert_int_equal(fclose(file), 0);
}

static bool has_health(struct gn_show *show) {
    const struct gn_part *row = show->parts.rows[GN_PART_health];
    return row->status(show->parts.of[GN_PART_health]);
}

/* A step that waits for nothing. */
static void step_soon(struct gn_show *show) {
    struct gn_timer wake = {.due_ns = gn_clock_monotonic_ns() + GN_NS_PER_S / 200};
    gn_loop_add_timer(show->loop, &wake);
    help_show_step(show);
    gn_loop_remove_timer(&wake);
}

/* Until all that was asked for has been done. */
static void settle(struct gn_show *show) {
    const int64_t begun_ns = gn_clock_monotonic_ns();
    do {
        step_soon(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    } while (show->wants_reload || show->reload.options || gn_show_is_stale(&show->screen) ||
             gn_kiosk_waits(&show->screen.kiosk) || !has_health(show));
}

static struct gn_show *open_show(enum state state, unsigned with) {
    write_config(state, with);
    struct gn_show *show =
        help_show((const char *const[]){"--size", "64x64", "--no-animation", "-c", config, NULL});
    if (show->config.options->config_error) fail_msg("%s", show->config.options->config_error);
    show->parts.host.root = root;
    show->parts.host.reading_ns = 60 * MINUTE_NS;
    gn_part_open(&show->parts, GN_PART_health);
    settle(show);
    return show;
}

static void enter(struct gn_show *show, enum state state) {
    static const struct gn_action actions[STATES] = {
        [PAUSED] = {.kind = GN_ACTION_PAUSE, .turn = GN_TURN_ON},
        [BLANKED] = {.kind = GN_ACTION_BLANK, .turn = GN_TURN_ON},
        [INFO] = {.kind = GN_ACTION_INFO, .turn = GN_TURN_ON},
    };
    if (actions[state].kind)
        gn_show_act(&show->screen, &actions[state], gn_loop_now_ns(show->loop));
    settle(show);
    assert_int_equal(show->screen.kiosk.asleep, state == ASLEEP);
    if (state != LOADING) return;
    show->wants_reload = true;
    step_soon(show);
    assert_non_null(show->reload.options);
}

static void reload(struct gn_show *show) {
    const struct gn_kiosk before = show->screen.kiosk;
    show->wants_reload = true;
    settle(show);
    if (show->config.options->config_error) fail_msg("%s", show->config.options->config_error);
    assert_int_equal(show->screen.kiosk.blanked, before.blanked);
    assert_int_equal(show->screen.kiosk.asleep, before.asleep);
    assert_int_equal(show->screen.kiosk.woken, before.woken);
    assert_true(show->screen.kiosk.used_ns >= before.used_ns);
}

/* ---- what a part does, as a text --------------------------------------------------------------
 */

/* What is another one at each look, or of a thread. */
static bool is_stable(const struct gn_metric *m) {
    static const char *const others[] = {"fps",
                                         "problem",
                                         "waits",
                                         "paused",
                                         "info",
                                         "television.told",
                                         "television.device",
                                         "television.waits"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (strcmp(m->name, others[i]) == 0) return false;
    return strcmp(m->unit, "s") != 0 && m->kind != GN_METRIC_NUMBER && m->kind != GN_METRIC_COUNTER;
}

/* Those whose names begin so, without what a thread has open for a moment. */
static int count_files(const char *start) {
    int count = 0;
    DIR *list = opendir("/proc/self/fd");
    assert_non_null(list);
    for (struct dirent *entry; (entry = readdir(list));) {
        char to[64] = "";
        if (readlinkat(dirfd(list), entry->d_name, to, sizeof to - 1) < 0 ||
            strncmp(to, folder, strlen(folder)) == 0 || strncmp(to, "/proc/", 6) == 0)
            continue;
        count += strncmp(to, start, strlen(start)) == 0;
    }
    closedir(list);
    return count;
}

/* Its metrics, what it adds to a frame that is drawn after some minutes and to the screen, when it
 * is due, and what watches files. Freed by the caller. */
static char *portrait_of(struct gn_show *show, int part) {
    const struct gn_part *row = show->parts.rows[part];
    void *of = show->parts.of[part];
    const void *values = show->parts.is_open[part] && row->status ? row->status(of) : NULL;
    struct gn_frame_opts frame = {0};
    struct gn_screen_opts screen = {0};
    json_t *all = json_object();
    for (int i = 0; values && i < row->metric_count; i++) {
        json_t *one = json_object();
        gn_metrics_put(&row->metrics[i], 1, values, false, one);
        if (is_stable(&row->metrics[i])) json_object_update_recursive(all, one);
        json_decref(one);
    }
    show->counts.begun_ns = gn_loop_now_ns(show->loop) - 5 * MINUTE_NS - MINUTE_NS / 2;
    const bool wants = row->wants_frame && row->wants_frame(of);
    if (row->add_frame) row->add_frame(of, &frame);
    if (row->add_screen) row->add_screen(of, &screen);
    const bool is_due = row->due_ns && row->due_ns(of) < INT64_MAX;
    json_object_set_new(all, "frame",
                        json_pack("{s:f, s:i, s:i, s:b}", "dimmed", (double)frame.cover.dimmed, "x",
                                  frame.view.shift_px[0], "y", frame.view.shift_px[1], "wants",
                                  wants && part != GN_PART_shift)); /* it may just have moved */
    json_object_set_new(all, "again", json_integer(screen.again_ns));
    json_object_set_new(all, "due", json_boolean(is_due));
    char *text = json_dumps(all, JSON_SORT_KEYS);
    json_decref(all);
    return text;
}

struct portraits {
    char *of[GN_PART_COUNT];
    int watches; /* of files */
};

static struct portraits take_portraits(struct gn_show *show) {
    struct portraits p = {.watches = count_files("anon_inode:inotify")};
    for (int i = 0; i < GN_PART_COUNT; i++) p.of[i] = portrait_of(show, i);
    return p;
}

static void drop_portraits(struct portraits *p) {
    for (int i = 0; i < GN_PART_COUNT; i++) free(p->of[i]);
}

/* Compares, and drops the second. */
static void are_same(struct gn_show *show, const struct portraits *want, struct portraits is,
                     enum state state, const char *after) {
    for (int i = 0; i < GN_PART_COUNT; i++)
        if (strcmp(want->of[i], is.of[i]) != 0)
            fail_msg("%s, after %s while %s: not\n%s\nbut\n%s", show->parts.rows[i]->name, after,
                     names[state], want->of[i], is.of[i]);
    if (want->watches != is.watches)
        fail_msg("after %s while %s: %d watches of files, not %d", after, names[state], is.watches,
                 want->watches);
    drop_portraits(&is);
}

/* ---- settings -------------------------------------------------------------------------------- */

static unsigned all_trials(void) {
    unsigned with = 0;
    for (int i = 0; i < GN_PART_COUNT; i++) {
        if (!trials[i].line == !trials[i].why) fail_msg("part %d: either a trial, or why not", i);
        if (trials[i].line) with |= 1u << i;
    }
    return with;
}

/* As a kiosk that starts with them. */
static void each_part_follows_its_settings_at_a_reload(void **state) {
    (void)state;
    for (enum state in = 0; in < STATES; in++) {
        struct gn_show *show = open_show(in, all_trials());
        enter(show, in);
        if (in == LOADING) settle(show);
        struct portraits with = take_portraits(show);
        gn_show_close(show);
        show = open_show(in, 0);
        enter(show, in);
        if (in == LOADING) settle(show);
        struct portraits without = take_portraits(show);
        for (int i = 0; i < GN_PART_COUNT; i++) /* or the test is vain */
            if (trials[i].line && i != GN_PART_shaders && strcmp(with.of[i], without.of[i]) == 0)
                fail_msg("%s: the same with \"%s\" as without", show->parts.rows[i]->name,
                         trials[i].line);
        assert_int_equal(with.watches, without.watches + 2); /* of shaders and content */
        for (int k = 0; k < 2; k++) {
            write_config(in, k ? 0 : all_trials());
            reload(show);
            are_same(show, k ? &without : &with, take_portraits(show), in, "a reload");
        }
        gn_show_close(show);
        drop_portraits(&with);
        drop_portraits(&without);
    }
}

/* ---- survival -------------------------------------------------------------------------------- */

static void lose_context(struct gn_show *show) {
    show->screen.stage.display.screen.generation++;
    settle(show);
    assert_non_null(show->screen.stage.gl);
}

/* Is there a source of the loop in that memory? */
static bool is_in_loop(struct gn_show *show, const char *from, size_t size) {
    struct gn_timer last = {.due_ns = GN_LOOP_NEVER};
    bool found = false;
    gn_loop_add_timer(show->loop, &last);
    const struct gn_loop_link *const lists[] = {&last.link, &show->signals.watch.link};
    for (int k = 0; k < 2; k++) {
        const struct gn_loop_link *at = lists[k];
        while (at->next) at = at->next;
        for (; at; at = at->previous)
            found |= (const char *)at >= from && (const char *)at < from + size;
    }
    gn_loop_remove_timer(&last);
    return found;
}

/* As at a start. */
static void open_part(struct gn_show *show, int part) {
    const struct gn_part *row = show->parts.rows[part];
    void *of = show->parts.of[part];
    if (row->begin) row->begin(of);
    gn_part_open(&show->parts, part);
    if (row->loaded) row->loaded(of, GN_PART_LOAD_SCENE);
}

/* No descriptor can be had meanwhile. */
static void fail_to_open(struct gn_show *show, int part) {
    struct rlimit before, none;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    none = before;
    none.rlim_cur = 0;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &none), 0);
    open_part(show, part);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
}

static void close_and_open(struct gn_show *show, int part, enum state state) {
    const struct gn_part *row = show->parts.rows[part];
    struct gn_part copy = *row;
    const struct gn_part *rows[GN_PART_COUNT];
    const int files = count_files("");
    /* by hand, since gn_part_close() clears the memory */
    memcpy(rows, show->parts.rows, sizeof rows);
    if (row->end) row->end(show->parts.of[part]);
    if (row->close) row->close(show->parts.of[part]);
    if (is_in_loop(show, show->parts.of[part], row->size))
        fail_msg("%s: closed while %s, it is still in the loop", row->name, names[state]);
    copy.close = NULL;
    rows[part] = &copy;
    const struct gn_part *const *const own = show->parts.rows;
    show->parts.rows = rows;
    gn_part_close(&show->parts, part);
    show->parts.rows = own;
    const int less = files - count_files("");
    show->problems = (struct gn_problems){0};
    fail_to_open(show, part);
    if (less > 0 && !gn_problem_last(&show->problems))
        fail_msg("%s: cannot be opened while %s, and there is no problem", row->name, names[state]);
    if (count_files("") > files - less) /* a thread that ends may have closed more by now */
        fail_msg("%s: what failed to open while %s leaves files", row->name, names[state]);
    step_soon(show);
    gn_part_close(&show->parts, part);
    gn_part_close(&show->parts, part); /* legal */
    open_part(show, part);
    settle(show);
}

static void each_part_survives_in_each_state(void **state) {
    (void)state;
    for (enum state in = 0; in < STATES; in++) {
        static const char *const what[] = {"a lost context", "a reload"};
        void (*const events[])(struct gn_show * show) = {lose_context, reload};
        struct gn_show *show = open_show(in, all_trials());
        enter(show, in);
        struct portraits before = take_portraits(show);
        for (int i = 0; i < 2; i++) {
            events[i](show);
            are_same(show, &before, take_portraits(show), in, what[i]);
            if (in == PAUSED || in == INFO || in == LOADING) enter(show, in);
        }
        for (int i = 0; i < GN_PART_COUNT; i++) {
            close_and_open(show, i, in);
            are_same(show, &before, take_portraits(show), in, show->parts.rows[i]->name);
        }
        if (in == LOADING) enter(show, in);
        gn_show_close(show);
        drop_portraits(&before);
    }
}

static void a_kiosk_that_has_ended_leaves_nothing_open(void **state) {
    (void)state;
    gn_show_close(open_show(NORMAL, all_trials())); /* what the driver keeps */
    const int files = count_files("");
    for (enum state in = 0; in < STATES; in++) {
        struct gn_show *show = open_show(in, all_trials());
        enter(show, in);
        gn_show_close(show);
        for (int i = 0; i < 60000 && count_files("") > files; i++)
            usleep(1000); /* threads that are not waited for */
        assert_int_equal(count_files(""), files);
    }
}

static int setup(void **state) {
    (void)state;
    if (!mkdtemp(folder)) return -1;
    snprintf(config, sizeof config, "%s/kiosk.ini", folder);
    snprintf(saved, sizeof saved, "%s/state", folder);
    snprintf(root, sizeof root, "%s/board", folder);
    health_pi4(root);
    char *shaders = realpath("shaders_es", NULL), link[64];
    assert_non_null(shaders);
    snprintf(link, sizeof link, "%s/shaders_es", folder);
    assert_int_equal(symlink(shaders, link), 0); /* the configuration's paths begin in its folder */
    free(shaders);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    return gn_test_remove_folder(folder);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_part_follows_its_settings_at_a_reload),
        cmocka_unit_test(each_part_survives_in_each_state),
        cmocka_unit_test(a_kiosk_that_has_ended_leaves_nothing_open),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
