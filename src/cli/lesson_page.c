/* Texts are those of the table of lessons, which need no escapes (tests/unit/test_lesson.c). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/lesson.h"
#include "core/file.h"

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Lessons</title>\n"
    "<meta name=\"viewport\" content=\"width=device-width\"><style>\n"
    "body { font: 16px/1.5 sans-serif; max-width: 76em; margin: 2em auto; padding: 0 1em; }\n"
    ".steps { display: flex; flex-wrap: wrap; gap: 1em; }\n"
    "figure { margin: 0; flex: 1 1 20em; max-width: 30em; }\n"
    "img { width: 100%; display: block; margin-bottom: .3em; }\n"
    "td { padding-right: 1em; vertical-align: top; } td + td { white-space: nowrap; } .fault { "
    "color: #b00; } .cure { color: #060; }\n"
    "code { font-size: .85em; overflow-wrap: anywhere; }\n"
    "</style></head><body>\n<h1>Lessons</h1>\n"
    "<p>Each fault of shadows stands beside its cures, with what it measures: against rays that "
    "are "
    "cast on the CPU. The second picture of a step is its difference from the truth: red is too "
    "dark, "
    "blue too bright.</p>\n<ol>\n";

static void print_step(FILE *to, const struct gn_lesson_result *result, int index) {
    const struct gn_lesson *lesson = result->lesson;
    const struct gn_lesson_step *step = &lesson->steps[index];
    char flags[400];
    gn_lesson_flags(lesson, index, flags, sizeof flags);
    fprintf(to,
            "<figure><img src=\"%s-%d.png\" alt=\"%s\"><img src=\"%s-%d-diff.png\" "
            "alt=\"difference\">\n",
            lesson->name, index + 1, step->name, lesson->name, index + 1);
    fprintf(to, "<figcaption><b>%s</b><table>", step->name);
    for (int i = 0; i < GN_FIGURE_COUNT; i++) {
        if (!isfinite(result->figures[index][i])) continue;
        fprintf(to, "<tr class=\"%s\"><td>%s</td><td>%.3g %s</td></tr>",
                step->fault == (enum gn_figure)i ? "fault"
                : step->fault                    ? ""
                                                 : "cure",
                gn_figures[i].what, result->figures[index][i], gn_figures[i].unit);
    }
    fprintf(to, "</table><code>gnomon render %s%s%s -o a.png</code></figcaption></figure>\n",
            GN_SCENE_LESSON, lesson->scene, flags);
}

static void print_lesson(FILE *to, const struct gn_lesson_result *result) {
    const struct gn_lesson *lesson = result->lesson;
    fprintf(to, "<h2 id=\"%s\">%s</h2>\n<p>%s</p>\n<div class=\"steps\">\n", lesson->name,
            lesson->title, lesson->teaches);
    for (int i = 0; i < gn_lesson_steps(lesson); i++) print_step(to, result, i);
    fprintf(to,
            "<figure><img src=\"%s-truth.png\" alt=\"truth\"><figcaption><b>truth</b>, by rays"
            "</figcaption></figure>\n</div>\n",
            lesson->name);
}

bool gn_lesson_write_page(const struct gn_lesson_result *results, int count, const char *folder,
                          struct gn_err *err) {
    char path[4096], *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (!to) return gn_fail(err, "no memory left for a page");
    fputs(head, to);
    for (int i = 0; i < count; i++)
        fprintf(to, "<li><a href=\"#%s\">%s</a></li>\n", results[i].lesson->name,
                results[i].lesson->title);
    fputs("</ol>\n", to);
    for (int i = 0; i < count; i++) print_lesson(to, &results[i]);
    fputs("</body></html>\n", to);
    const bool whole = fclose(to) == 0;
    snprintf(path, sizeof path, "%s/index.html", folder);
    const bool ok =
        whole ? gn_file_write(path, text, size, err) : gn_fail(err, "no memory left for a page");
    free(text);
    return ok;
}
