/* gnomon doctor: what this machine can do. Each backend is opened in a child (child.h): what its
 * driver prints, a crash and a hang all end in the report. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "caption/shape.h"
#include "cli/commands.h"
#include "cli/doctor_report.h"
#include "cli/report.h"
#include "core/child.h"
#include "core/clock.h"
#include "core/terminal.h"
#include "display/display.h"

struct attempt { /* what the child does */
    const struct gn_settings *settings;
    const char *backend;
    bool self_test;
    int64_t begun_ns;
};
struct answer { /* what it finds, in shared memory */
    bool opens;
    struct gn_err err; /* of opening, or of the self-test */
    struct gn_caps caps;
    char egl[96];
    struct gn_selftest self_test;
    bool self_tested;
};

/* ---- in the child -------------------------------------------------------------------------- */

static void try_backend(void *shared, const void *argument) {
    const struct attempt *attempt = argument;
    struct answer *answer = shared;
    struct gn_display display = {0};
    if (!gn_display_open(&display, attempt->backend, NULL, &answer->err)) return;
    const struct gn_gl_opts opts = {
        .get_proc = gn_display_get_proc,
        .display = &display,
        .shaders = attempt->settings->render.shaders,
        .without = attempt->settings->render.without,
        .desktop = display.ops->desktop,
    };
    struct gn_gl *gl = gn_gl_create(&opts, NULL, &answer->err);
    answer->opens = gl;
    if (gl) answer->caps = *gn_gl_caps(gl);
    if (gl) gn_display_describe_egl(&display, answer->egl, sizeof answer->egl);
    if (gl && attempt->self_test)
        answer->self_tested = gn_selftest_run(&answer->self_test, gl, &answer->err);
    gn_gl_destroy(gl);
    gn_display_close(&display);
}

/* ---- in the parent
 * ---------------------------------------------------------------------------------- */

/* On a terminal, once the work has taken a second. */
static bool has_progress(const struct attempt *attempt) {
    return gn_clock_monotonic_ns() - attempt->begun_ns >= GN_NS_PER_S && isatty(STDERR_FILENO);
}

static void show_progress(void *shared, const void *argument) {
    const struct attempt *attempt = argument;
    const volatile struct gn_selftest *test = &((const struct answer *)shared)->self_test;
    if (has_progress(attempt))
        fprintf(stderr, "\rself-test: picture %u of %u ", test->done, test->all);
}

static const struct gn_display_ops *find_built(const char *name) {
    for (const struct gn_display_ops *const *row = gn_displays; *row; row++)
        if (strcmp((*row)->name, name) == 0) return *row;
    return NULL;
}

static struct gn_doctor_backend *add_backend(struct gn_doctor_report *report, const char *name) {
    const struct gn_display_ops *ops = find_built(name);
    if (report->backend_count == GN_DOCTOR_BACKENDS) return NULL;
    struct gn_doctor_backend *b = &report->backends[report->backend_count++];
    *b = (struct gn_doctor_backend){.name = name,
                                    .what = ops ? ops->what : NULL,
                                    .built = ops,
                                    .is_window = ops && ops->is_window,
                                    .is_console = ops && ops->is_console};
    return b;
}

/* All that --backend knows, in the order in which "auto" tries them, then those not built in. False
 * only for wrong usage: an unknown name in --without. */
static bool check_backends(struct gn_doctor_report *report, const struct gn_settings *settings,
                           struct answer *answer, struct gn_err *err) {
    const struct gn_option_row *row = gn_option_find("backend", strlen("backend"));
    for (const struct gn_display_ops *const *ops = gn_displays; *ops; ops++) {
        struct gn_doctor_backend *b = add_backend(report, (*ops)->name);
        if (!b) continue;
        const struct attempt attempt = {.settings = settings, .backend = b->name};
        const struct gn_child child = {.work = try_backend, .argument = &attempt};
        struct gn_err end = {0};
        memset(answer, 0, sizeof *answer);
        const bool ended = gn_child_run(&child, answer, &end);
        b->opens = ended && answer->opens;
        b->caps = answer->caps;
        memcpy(b->egl, answer->egl, sizeof b->egl);
        const char *why = ended ? answer->err.text : end.text;
        char prefix[64]; /* the report names the backend already */
        snprintf(prefix, sizeof prefix, "backend %s: ", b->name);
        if (strncmp(why, prefix, strlen(prefix)) == 0) why += strlen(prefix);
        if (!b->opens) snprintf(b->why, sizeof b->why, "%.319s", why);
        if (ended && answer->err.status == GN_EXIT_USAGE) {
            *err = answer->err;
            return false;
        }
    }
    for (const struct gn_choice *choice = row->choices; choice->name; choice++)
        if (strcmp(choice->name, "auto") != 0 && !find_built(choice->name))
            add_backend(report, choice->name);
    return true;
}

/* In which scripts texts on the picture are drawn. */
static void look_at_fonts(struct gn_doctor_report *report, const struct gn_settings *settings) {
    struct gn_err err = {0};
    struct gn_font *font = gn_font_open_file(settings->render.font, &err);
    if (font)
        gn_shape_find_missing(font, gn_shape_samples, report->texts, sizeof report->texts);
    else
        snprintf(report->texts, sizeof report->texts, "all but ASCII (%s)", err.text);
    gn_font_close(font);
}

bool gn_doctor_look(struct gn_doctor_report *report, const struct gn_settings *settings,
                    struct gn_err *err) {
    const char *wanted = settings->display.backend;
    struct answer *answer = gn_child_share(sizeof *answer, err);
    if (!answer) return false;
    *report = (struct gn_doctor_report){.chosen = -1};
    gn_machine_read(&report->machine, "");
    gn_health_read(&report->health, "");
    gn_input_list_lines(&report->input);
    look_at_fonts(report, settings);
    for (int i = 0; i < report->machine.device_count; i++) {
        struct gn_device *device = &report->machine.devices[i];
        if (device->kind == GN_DEVICE_CARD)
            gn_display_holder(device->path, device->holder, sizeof device->holder);
    }
    const bool ok = check_backends(report, settings, answer, err);
    for (int i = 0; i < report->backend_count && report->chosen < 0; i++) {
        const struct gn_doctor_backend *b = &report->backends[i];
        if (b->opens && (strcmp(wanted, "auto") == 0 || strcmp(wanted, b->name) == 0))
            report->chosen = i;
    }
    gn_child_unshare(answer, sizeof *answer);
    if (!ok) gn_input_list_finish(&report->input);
    return ok;
}

static void self_test(struct gn_doctor_report *report, const struct gn_settings *settings,
                      struct answer *answer) {
    const char *name = report->backends[report->chosen].name;
    const struct attempt attempt = {.settings = settings,
                                    .backend = name,
                                    .self_test = true,
                                    .begun_ns = gn_clock_monotonic_ns()};
    const struct gn_child child = {.work = try_backend,
                                   .watch = show_progress,
                                   .argument = &attempt,
                                   .progress = &answer->self_test.done,
                                   .stall_s = 120};
    struct gn_err end = {0};
    memset(answer, 0, sizeof *answer);
    bool ended = gn_child_run(&child, answer, &end);
    if (!ended) answer->err = end;
    if (has_progress(&attempt)) fprintf(stderr, "\r\33[K");
    if (answer->self_test.row_count) report->self_test = &answer->self_test;
    if (!ended || !answer->self_tested)
        gn_problem_add(&report->problems,
                       "send this report to those who make gnomon or the GPU's driver",
                       "the self-test on %s stopped after %u of %u pictures: %s", name,
                       answer->self_test.done, answer->self_test.all, answer->err.text);
}

static bool judge_report(const struct gn_doctor_report *report, const struct gn_settings *settings,
                         const struct answer *answer, struct gn_err *err) {
    bool any = strcmp(settings->display.backend, "auto") == 0;
    if (report->chosen < 0 && !any && !find_built(settings->display.backend))
        return gn_fail(err, "backend %s is not in this build: try --backend auto",
                       settings->display.backend);
    if (report->chosen < 0)
        return gn_fail(err, "%s%s cannot draw here: see the problems above",
                       any ? "gnomon" : "backend ", any ? "" : settings->display.backend);
    if (!settings->run.self_test) return true;
    uint32_t failures = report->self_test ? gn_selftest_failures(report->self_test) : 0;
    if (failures)
        return gn_fail(err, "self-test: %u of %u rows fail on %s", failures,
                       report->self_test->row_count,
                       report->backends[report->chosen].caps.renderer);
    return answer->self_tested || gn_fail(err, "self-test: %s", answer->err.text);
}

static void print_text(const struct gn_doctor_report *report) {
    struct gn_terminal terminal;
    gn_doctor_print(report, gn_terminal_begin(&terminal, stdout));
    gn_terminal_end(&terminal);
}

bool gn_cli_doctor(const struct gn_options *options, struct gn_warnings *warnings,
                   struct gn_err *err) {
    (void)warnings;
    const struct gn_settings *settings = options->settings;
    const bool sends = settings->run.report;
    struct gn_doctor_report report;
    if (settings->run.compare_reports)
        return gn_report_compare(options->words, options->word_count, stdout, err);
    if (settings->run.out && !sends)
        return gn_fail_usage(err, "doctor: -o is the file of --report: add --report");
    struct answer *answer = gn_child_share(sizeof *answer, err);
    if (!answer) return false;
    bool ok = gn_doctor_look(&report, settings, err);
    if (ok) {
        gn_doctor_diagnose(&report);
        if ((settings->run.self_test || sends) && report.chosen >= 0)
            self_test(&report, settings, answer);
        if (sends)
            ok = gn_report_write(&report, settings, err);
        else if (settings->run.json)
            ok = gn_doctor_print_json(&report, stdout, err);
        else
            print_text(&report);
        ok = ok && (sends || judge_report(&report, settings, answer, err));
        gn_input_list_finish(&report.input);
    }
    gn_child_unshare(answer, sizeof *answer);
    return ok;
}
