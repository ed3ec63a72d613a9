/* Days of a kiosk with [sun], on a fake clock: at each hour its picture is that of `gnomon render
 * --date`, whatever the clock does: both changes of daylight saving, north and south of the
 * equator, a leap second's repeat, jumps, and a clock that is not set. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/info_page.h"
#include "kiosk/private.h"
#include "options/args.h"
#include "stage/sun.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

enum { WIDTH = 64, HEIGHT = 64, BYTES = 4 * WIDTH * HEIGHT, HOURS = 25 };
static const int64_t HOUR_S = 3600;

static int64_t clock_ns, ahead_ns;       /* of the time of day */
static const char *environment = "none"; /* a sky takes a second to make */

/* ---- references ---- */

static const char *const common[] = {
    "--backend", "egl",      "--size", "64x64",       "--shadow", "hard",           "--msaa",
    "0",         "--gather", "none",   "--occlusion", "none",     "--no-animation", NULL};

struct reference {
    struct gn_stage stage;
    struct gn_options options;
};

/* As `gnomon render` draws it with these arguments, up to NULL. */
static void draw(struct reference *r, const char *const args[], uint8_t *rgba) {
    const char *argv[40] = {"gnomon", "render", "-o", "none.png"};
    int argc = 4;
    struct gn_err err = {0};
    struct gn_options options;
    for (int i = 0; common[i]; i++) argv[argc++] = common[i];
    for (int i = 0; args[i]; i++) argv[argc++] = args[i];
    argv[argc++] = "--environment";
    argv[argc++] = environment;
    bool ok = gn_args_parse(&options, argc, (char *const *)(uintptr_t)argv, NULL, &err);
    if (ok && !r->stage.gl) {
        ok = gn_stage_load(&r->stage, options.settings, NULL, &err) &&
             gn_stage_open(&r->stage, NULL, &err);
    } else if (ok) {
        struct gn_stage_look look;
        ok = gn_stage_look_build(&look, options.settings, r->stage.scene, NULL, &err);
        if (ok) r->stage.shown.opts = look.frame_opts;
    }
    r->stage.shown.opts.output.keeps_alpha = true;
    r->stage.settings = options.settings;
    gn_options_finish(&r->options);
    r->options = options;
    if (!ok || !gn_view_draw(&r->stage.shown, &r->stage, 0, NULL, &err) ||
        !gn_gl_read_rgba8(r->stage.gl, rgba, &err))
        fail_msg("%s", err.text);
}

static void finish(struct reference *r) {
    gn_stage_close(&r->stage);
    gn_options_finish(&r->options);
}

/* ---- the kiosk ---- */

static const char *folder; /* of its configuration */

static struct gn_show *open_show(const char *sun, int64_t utc_s) {
    char config[400];
    snprintf(config, sizeof config,
             "[sun]\n%s\n[kiosk]\ncaptions = no\n[render]\ngather = none\nmsaa = 0\n"
             "occlusion = none\nenvironment = %s\n[mode \"a\"]\nshadow = hard\n",
             sun, environment);
    clock_ns = gn_clock_monotonic_ns();
    ahead_ns = utc_s * GN_NS_PER_S - clock_ns;
    gn_clock_fake_day(&clock_ns, &ahead_ns);
    static char path[200]; /* the kiosk reads its file again */
    folder = help_folder();
    help_write(folder, "kiosk.ini", config);
    snprintf(path, sizeof path, "%s/kiosk.ini", folder);
    struct gn_show *show =
        help_show((const char *const[]){"--size", "64x64", "-c", path, "--no-animation", NULL});
    gn_loop_fake_clock(show->loop, &clock_ns);
    show->parts.rows[GN_PART_sun]->reopen(show->parts.of[GN_PART_sun]);
    return show;
}

static void close_show(struct gn_show *show) {
    gn_show_close(show);
    help_remove(folder);
    gn_clock_fake_day(NULL, NULL);
}

/* Time goes on by so much; returns the frames. */
static uint64_t run(struct gn_show *show, int64_t ns) {
    const int64_t until_ns = clock_ns + ns;
    const uint64_t before = show->counts.frames;
    struct gn_timer end = {.due_ns = until_ns};
    gn_loop_add_timer(show->loop, &end);
    while (clock_ns < until_ns) help_show_step(show);
    gn_loop_remove_timer(&end);
    return show->counts.frames - before;
}

static void set_clock(int64_t utc_s) { ahead_ns = utc_s * GN_NS_PER_S - clock_ns; }

static int greatest_difference(const uint8_t *a, const uint8_t *b) {
    int most = 0;
    for (int i = 0; i < BYTES; i++) most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    return most;
}

static const char *shown_text(struct gn_show *show) {
    struct gn_info info = {0};
    gn_parts_add_info(&show->parts, &info);
    return info.sun;
}

/* Runs to that moment, until the picture is the expected one: a thread makes the sky, and one that
 * is late is shown by the next frame. */
static void assert_picture(struct gn_show *show, int64_t utc_s, const uint8_t *expected,
                           const char *what) {
    uint8_t shown[BYTES];
    int most = 256;
    for (int i = 0; i < 40 && most > 0; i++) {
        if (i > 0) usleep(20000);
        set_clock(utc_s - 60);
        run(show, 60 * GN_NS_PER_S + GN_NS_PER_S / 2);
        help_show_picture(show, shown);
        most = greatest_difference(shown, expected);
    }
    if (most > 0) fail_msg("%s: the picture differs by up to %d of 255", what, most);
}

/* ---- days ---- */

struct day {
    const char *place, *zone; /* as the flag has it */
    const char *config;
    int64_t begin_s;       /* the first hour, UTC */
    int hours;             /* of the local day */
    int before_h, after_h; /* the clock is ahead of UTC by this, */
    int change;            /* and from this hour after the first on by the second */
    int year, month, day;
    int every; /* hours that are looked at */
    const char *environment;
};
#define BERLIN "latitude = 52.5\nlongitude = 13.4\n"
#define SYDNEY "latitude = -33.9\nlongitude = 151.2\ntime_zone = Australia/Sydney"
static const struct day days[] = {
    {"52.5,13.4", "Europe/Berlin", BERLIN "time_zone = Europe/Berlin", 1774738800, 23, 1, 2, 2,
     2026, 3, 29, 1, "none"},
    {"52.5,13.4", "Europe/Berlin", BERLIN "time_zone = Europe/Berlin", 1792879200, 25, 2, 1, 3,
     2026, 10, 25, 1, "none"},
    {"-33.9,151.2", "Australia/Sydney", SYDNEY, 1775307600, 25, 11, 10, 3, 2026, 4, 5, 1, "none"},
    {"-33.9,151.2", "Australia/Sydney", SYDNEY, 1791036000, 23, 10, 11, 2, 2026, 10, 4, 1, "none"},
    {"52.5,13.4", "Europe/Berlin", BERLIN "time_zone = Europe/Berlin", 1774738800, 23, 1, 2, 2,
     2026, 3, 29, 6, "auto"},
};

static bool is_full(void) {
    const char *full = getenv("GN_FULL");
    return full && strcmp(full, "1") == 0;
}

static void a_day_has_the_pictures_of_its_hours(const struct day *d) {
    static uint8_t expected[HOURS][BYTES];
    static const char *const months[] = {"March", "April", "", "", "", "", "", "October"};
    struct reference r = {0};
    environment = d->environment;
    char date[HOURS][40], text[HOURS][60];
    for (int hour = 0; hour < d->hours; hour++) {
        const int ahead = hour < d->change ? d->before_h : d->after_h;
        const int clock = hour < d->change ? hour : hour + d->after_h - d->before_h;
        const bool twice = d->after_h < d->before_h && clock == d->change - 1;
        snprintf(text[hour], sizeof text[hour], "%d %s %d, %02d:00", d->day, months[d->month - 3],
                 d->year, clock);
        snprintf(date[hour], sizeof date[hour], "%d-%02d-%02dT%02d:00", d->year, d->month, d->day,
                 clock);
        if (twice)
            snprintf(date[hour] + strlen(date[hour]), sizeof date[hour] - strlen(date[hour]),
                     "+%02d:00", ahead);
        if (is_full() || hour % d->every == 0)
            draw(&r,
                 (const char *const[]){"--sun", d->place, "--date", date[hour], "--sun-time-zone",
                                       d->zone, NULL},
                 expected[hour]);
    }
    finish(&r);
    struct gn_show *show = open_show(d->config, d->begin_s);
    int looked = 0;
    for (int hour = 0; hour < d->hours; hour++) {
        if (!is_full() && hour % d->every != 0) continue;
        assert_picture(show, d->begin_s + hour * HOUR_S, expected[hour], date[hour]);
        if (strncmp(shown_text(show), text[hour], strlen(text[hour])) != 0)
            fail_msg("\"%s\" is said at %s", shown_text(show), text[hour]);
        looked++;
    }
    printf("%s, %d-%02d-%02d: %d hours of %d, environment %s, to the byte as render --date\n",
           d->zone, d->year, d->month, d->day, looked, d->hours, d->environment);
    close_show(show);
    environment = "none";
}

static void each_hour_is_as_render_draws_it(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof days / sizeof days[0]; i++)
        a_day_has_the_pictures_of_its_hours(&days[i]);
}

/* ---- what clocks do ---- */

static void draw_at(struct reference *r, const char *date, uint8_t *rgba) {
    draw(r, (const char *const[]){"--sun", "52.5,13.4", "--date", date, NULL}, rgba);
}

/* UTC without leap seconds: 23:59:59 comes twice. Honolulu's sun is up then. */
static void a_leap_second_repeats_a_picture(void **state) {
    (void)state;
    uint8_t expected[2][BYTES];
    struct reference r = {0};
    const int64_t midnight_s = 1798761600; /* 2027-01-01: one may come */
    static const char *const dates[] = {"2026-12-31T23:59Z", "2026-12-31T23:59:60Z"};
    for (int i = 0; i < 2; i++)
        draw(&r, (const char *const[]){"--sun", "21.3,-157.9", "--date", dates[i], NULL},
             expected[i]);
    finish(&r);
    struct gn_show *show = open_show("latitude = 21.3\nlongitude = -157.9\n", midnight_s - 600);
    assert_picture(show, midnight_s - 60, expected[0], "before");
    run(show, 59 * GN_NS_PER_S + GN_NS_PER_S / 4); /* 23:59:59.75 */
    const double before_s = show->screen.stage.shown.opts.view.sun_utc_s;
    run(show, GN_NS_PER_S / 2); /* the leap second */
    ahead_ns -= GN_NS_PER_S;
    run(show, GN_NS_PER_S / 2); /* 23:59:59 again */
    assert_true(show->screen.stage.shown.opts.view.sun_utc_s >= before_s);
    assert_true(show->screen.stage.shown.opts.view.sun_utc_s <= (double)midnight_s);
    assert_picture(show, midnight_s, expected[1], "after");
    close_show(show);
}

static void a_jump_is_seen_within_a_minute(void **state) {
    (void)state;
    static const struct {
        const char *date;
        int64_t utc_s;
    } to[] = {{"2026-06-21T10:00Z", 1782036000},
              {"2026-06-21T15:00Z", 1782054000},
              {"2026-06-21T04:00Z", 1782014400},
              {"2027-01-10T12:00Z", 1799582400}};
    uint8_t expected[4][BYTES], shown[BYTES];
    struct reference r = {0};
    for (int i = 0; i < 4; i++) draw_at(&r, to[i].date, expected[i]);
    finish(&r);
    struct gn_show *show = open_show(BERLIN, to[0].utc_s);
    for (int i = 0; i < 4; i++) {
        set_clock(to[i].utc_s - 59);
        run(show, 60 * GN_NS_PER_S); /* at its end the hour has begun */
        help_show_picture(show, shown);
        assert_true(show->screen.stage.shown.opts.view.sun_utc_s == (double)to[i].utc_s);
        assert_picture(show, to[i].utc_s, expected[i], to[i].date);
    }
    close_show(show);
}

static void an_unset_clock_has_the_lights_of_the_file(void **state) {
    (void)state;
    uint8_t file[BYTES], sun[BYTES], shown[BYTES];
    struct reference r = {0};
    const int64_t noon_s = 1782036000;
    draw(&r, (const char *const[]){NULL}, file);
    draw_at(&r, "2026-06-21T10:00Z", sun);
    finish(&r);
    struct gn_show *show = open_show(BERLIN, 1000); /* 1970 */
    run(show, 30 * GN_NS_PER_S);
    help_show_picture(show, shown);
    for (int i = 0; i < BYTES; i++) /* but the mark of the problem, in its corner */
        if (i / 4 / WIDTH > HEIGHT / 6 || i / 4 % WIDTH < WIDTH * 5 / 6)
            assert_int_equal(shown[i], file[i]);
    assert_string_equal(shown_text(show), "");
    assert_non_null(show->config.options->config_error);
    assert_non_null(strstr(show->config.options->config_error, "the clock is not set"));
    set_clock(noon_s - 600); /* by the network's time */
    for (int i = 0; i < 600 && !gn_stage_sun_moves(show->screen.stage.settings); i++)
        run(show, GN_NS_PER_S);
    assert_picture(show, noon_s, sun, "once it is set");
    assert_null(show->config.options->config_error);
    close_show(show);
}

/* ---- actions ---- */

static void steps_show_other_hours_and_days(void **state) {
    (void)state;
    static const struct {
        const char *step, *date, *text;
    } rows[] = {{"+1h", "2026-06-21T11:00Z", "21 June 2026, 11:00 (sundial time 11:51)"},
                {"+1h", "2026-06-21T12:00Z", "21 June 2026, 12:00 (sundial time 12:51)"},
                {"-15m", "2026-06-21T11:45Z", "21 June 2026, 11:45 (sundial time 12:36)"},
                {"-26w", "2025-12-21T11:45Z", "21 December 2025, 11:45 (sundial time 12:40)"},
                {"+1d", "2025-12-22T11:45Z", "22 December 2025, 11:45 (sundial time 12:39)"},
                {"now", "2026-06-21T10:00Z", "21 June 2026, 10:00 (sundial time 10:51)"}};
    enum { COUNT = sizeof rows / sizeof rows[0] };
    static uint8_t expected[COUNT][BYTES];
    struct reference r = {0};
    const int64_t begin_s = 1782036000; /* 10 h UTC */
    for (int i = 0; i < COUNT; i++) draw_at(&r, rows[i].date, expected[i]);
    finish(&r);
    struct gn_show *show = open_show(BERLIN "time_zone = UTC", begin_s);
    for (int i = 0; i < COUNT; i++) {
        const struct gn_action action = {.kind = GN_ACTION_SUN, .name = rows[i].step};
        gn_show_act(&show->screen, &action, clock_ns);
        assert_picture(show, begin_s, expected[i], rows[i].step);
        assert_string_equal(shown_text(show), rows[i].text);
    }
    close_show(show);
}

static void without_a_sun_a_step_is_refused(void **state) {
    (void)state;
    struct gn_show *show = open_show("", 1782036000);
    const struct gn_action action = {.kind = GN_ACTION_SUN, .name = "+1h"};
    struct gn_err err = {0};
    assert_false(gn_show_check_action(&show->screen, &action, &err));
    assert_non_null(strstr(err.text, "[sun] has no latitude"));
    close_show(show);
}

/* ---- cost ---- */

static void a_still_minute_has_some_frames(void **state) {
    (void)state;
    struct gn_show *show = open_show(BERLIN, 1782036000);
    run(show, 600 * GN_NS_PER_S); /* all programs are made */
    const struct gn_stage *stage = &show->screen.stage;
    const double step_s = gn_stage_sun_step_s(
        &stage->pose, &stage->shown.opts,
        gn_stage_sun_view(stage->settings, stage->shown.opts.view.sun_utc_s).altitude_deg);
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    const uint64_t frames = run(show, HOUR_S * GN_NS_PER_S);
    const double used_s = (double)(gn_clock_process_cpu_ns() - begun_ns) * 1e-9;
    printf("an hour of the sun, %dx%d: a step of %g s, %llu frames, %.1f ms of CPU a minute, "
           "without skies\n",
           WIDTH, HEIGHT, step_s, (unsigned long long)frames, 1000 * used_s / 60);
    assert_in_range(frames, (unsigned)(HOUR_S / (int)step_s) - 1,
                    (unsigned)(HOUR_S / (int)step_s) + 2);
    close_show(show);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_hour_is_as_render_draws_it),
        cmocka_unit_test(a_leap_second_repeats_a_picture),
        cmocka_unit_test(a_jump_is_seen_within_a_minute),
        cmocka_unit_test(an_unset_clock_has_the_lights_of_the_file),
        cmocka_unit_test(steps_show_other_hours_and_days),
        cmocka_unit_test(without_a_sun_a_step_is_refused),
        cmocka_unit_test(a_still_minute_has_some_frames),
    };
    return RUN(tests);
}
