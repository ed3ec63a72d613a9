/* gnomon lesson: faults of shadows beside their cures. With a screen the steps are the modes of a
 * kiosk; without one, or with -o, they are drawn, and measured against rays. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/commands.h"
#include "cli/lesson.h"
#include "core/json.h"
#include "core/stop.h"
#include "options/args.h"

enum { WIDTH = 96, ALL_MAX = 64 };

/* ---- printing ---- */

static void print_heading(const struct gn_lesson *lesson) {
    int at = 0;
    printf("%s: %s\n", lesson->name, lesson->title);
    for (const char *word = lesson->teaches; *word;) {
        const int length = (int)strcspn(word, " ");
        if (at > 0 && at + 1 + length > WIDTH) at = printf("\n") - 1;
        at += printf("%s%.*s", at > 0 ? " " : "  ", length, word);
        word += length + (word[length] == ' ');
    }
    printf("\n");
}

static void print_result(const struct gn_lesson_result *result) {
    const struct gn_lesson *lesson = result->lesson;
    char flags[400];
    printf("\n  %-34s", "");
    for (int i = 0; i < GN_FIGURE_COUNT; i++)
        if (gn_lesson_figures(lesson) & 1u << i)
            printf("%12s %-7s", gn_figures[i].name, gn_figures[i].unit);
    printf("\n");
    for (int step = 0; step < gn_lesson_steps(lesson); step++) {
        const enum gn_figure fault = lesson->steps[step].fault;
        printf("  %d %-32s", step + 1, lesson->steps[step].name);
        for (int i = 0; i < GN_FIGURE_COUNT; i++)
            if (gn_lesson_figures(lesson) & 1u << i)
                printf("%12.3g %-7s", result->figures[step][i],
                       fault && fault == (enum gn_figure)i ? "fault" : "");
        printf("\n");
    }
    printf("\n");
    for (int step = 0; step < gn_lesson_steps(lesson); step++) {
        gn_lesson_flags(lesson, step, flags, sizeof flags);
        printf("  %d gnomon render %s%s%s -o a.png\n", step + 1, GN_SCENE_LESSON, lesson->scene,
               flags);
    }
}

static json_t *make_json(const struct gn_lesson_result *result) {
    const struct gn_lesson *lesson = result->lesson;
    json_t *steps = json_array();
    for (int step = 0; step < gn_lesson_steps(lesson); step++) {
        const struct gn_lesson_step *s = &lesson->steps[step];
        json_t *figures = json_object();
        char flags[400];
        gn_lesson_flags(lesson, step, flags, sizeof flags);
        for (int i = 0; i < GN_FIGURE_COUNT; i++)
            if (gn_lesson_figures(lesson) & 1u << i)
                json_object_set_new(figures, gn_figures[i].name,
                                    gn_json_make_number(result->figures[step][i]));
        json_array_append_new(steps, json_pack("{ss ss ss? so}", "name", s->name, "flags",
                                               flags[0] ? flags + 1 : flags, "fault",
                                               s->fault ? gn_figures[s->fault].name : NULL,
                                               "figures", figures));
    }
    return json_pack("{ss ss ss ss so}", "name", lesson->name, "title", lesson->title, "teaches",
                     lesson->teaches, "scene", lesson->scene, "steps", steps);
}

/* ---- drawing and measuring ---- */

/* The options as if the command line had this name in the place of "all". */
static bool read_options(const struct gn_options *all, const char *name, struct gn_options *options,
                         struct gn_warnings *warnings, struct gn_err *err) {
    char **argv = gn_xalloc((size_t)all->argc + 1, sizeof *argv);
    for (int i = 0; i < all->argc; i++)
        argv[i] = all->argv[i] == all->words[0] ? (char *)name : all->argv[i];
    const bool ok = gn_args_parse(options, all->argc, argv, warnings, err);
    free(argv);
    return ok;
}

static bool measure(const struct gn_options *options, const struct gn_lesson *lesson,
                    struct gn_lesson_result *result, struct gn_warnings *warnings,
                    struct gn_err *err) {
    struct gn_options one = {0};
    const bool ok =
        read_options(options, lesson->name, &one, warnings, err) &&
        gn_lesson_measure(
            lesson, &(struct gn_lesson_opts){.options = &one, .folder = options->settings->run.out},
            result, warnings, err);
    gn_options_finish(&one);
    return ok;
}

static bool run_offline(const struct gn_options *options, const struct gn_lesson *first, int count,
                        struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_settings *o = options->settings;
    struct gn_lesson_result results[ALL_MAX];
    json_t *list = json_array();
    bool ok = !o->run.out || mkdir(o->run.out, 0777) == 0 || errno == EEXIST ||
              gn_fail(err, "%s: cannot make this folder: %s", o->run.out, strerror(errno));
    for (int i = 0; ok && i < count; i++) {
        ok = measure(options, &first[i], &results[i], warnings, err);
        if (ok && o->run.json) json_array_append_new(list, make_json(&results[i]));
        if (ok && !o->run.json) {
            if (count > 1) print_heading(&first[i]);
            print_result(&results[i]);
            if (i + 1 < count) printf("\n");
            fflush(stdout);
        }
    }
    ok = ok && (!o->run.out || gn_lesson_write_page(results, count, o->run.out, err));
    if (ok && o->run.json) return gn_json_print(list, 6, stdout, err);
    json_decref(list);
    return ok;
}

bool gn_cli_lesson(const struct gn_options *options, struct gn_warnings *warnings,
                   struct gn_err *err) {
    const struct gn_settings *o = options->settings;
    const char *name = options->words[0];
    if (strcmp(name, "list") == 0) {
        for (int i = 0; i < gn_lesson_count; i++)
            printf("%-16s %s\n", gn_lessons[i].name, gn_lessons[i].title);
        return true;
    }
    const bool all = strcmp(name, "all") == 0;
    const struct gn_lesson *lesson = all ? gn_lessons : gn_lesson_find(name, err);
    if (!lesson) return false;
    bool shown = false;
    if (!all && !o->run.out && !o->run.json && !gn_cli_show_here(options, &shown, warnings, err))
        return false;
    if (shown) return true;
    gn_stop_end_process();
    return run_offline(options, lesson, all ? gn_lesson_count : 1, warnings, err);
}
