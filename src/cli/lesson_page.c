/* Texts are those of the table of lessons, which need no escapes (tests/unit/test_lesson.c). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/lesson.h"
#include "core/file.h"

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Lessons</title>\n"
    "<meta name=\"viewport\" content=\"width=device-width\"><style>\n"
    ":root { color-scheme: light dark; --fault: #b00000; --cure: #006400; }\n"
    "@media (prefers-color-scheme: dark) { :root { --fault: #ff9c9c; --cure: #8fdc8f; } }\n"
    "body { font: 16px/1.5 sans-serif; max-width: 84em; margin: 2em auto; padding: 0 1em; }\n"
    ".steps { display: grid; grid-template-columns: repeat(auto-fill, minmax(18em, 1fr)); gap: "
    "1.5em 1em; }\n"
    "figure { margin: 0; }\n"
    ".pictures { position: relative; }\n"
    "img { width: 100%; display: block; }\n"
    ".pictures img + img { position: absolute; top: 0; clip-path: inset(0 0 0 var(--at, 100%)); }\n"
    "input { width: 100%; margin: .2em 0; }\n"
    "table { width: 100%; } td { vertical-align: top; }\n"
    "td:last-child { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; "
    "}\n"
    ".fault { color: var(--fault); } .cure { color: var(--cure); }\n"
    "code { font-size: .85em; overflow-wrap: anywhere; }\n"
    "</style></head><body>\n<h1>Lessons</h1>\n"
    "<p>Each fault of shadows stands beside its cures, with what it measures against rays that are "
    "cast on the CPU. The first picture of a lesson is that of the rays. The slider below another "
    "one uncovers its difference from them: red is too dark, blue too bright. &#x2717; marks the "
    "figure of a fault, &#x2713; those of a cure.</p>\n<ol>\n";

/* Digits behind the point with which the largest figure of a lesson's steps has three in all: those
 * of all its steps. */
static int decimals_of(const struct gn_lesson_result *result, int figure) {
    double most = 0;
    for (int i = 0; i < gn_lesson_steps(result->lesson); i++)
        if (isfinite(result->figures[i][figure]))
            most = fmax(most, fabs(result->figures[i][figure]));
    const int digits = most > 0 ? 2 - (int)floor(log10(most)) : 0;
    return digits < 0 ? 0 : digits > 4 ? 4 : digits;
}

static void print_figures(FILE *to, const struct gn_lesson_result *result, int index) {
    const enum gn_figure fault = result->lesson->steps[index].fault;
    fputs("<table>", to);
    for (int i = 0; i < GN_FIGURE_COUNT; i++) {
        if (!isfinite(result->figures[index][i])) continue;
        const bool is_fault = fault == (enum gn_figure)i, is_cure = !fault;
        fprintf(to, "<tr class=\"%s\"><td>%s</td><td>%s</td><td>%.*f %s</td></tr>",
                is_fault  ? "fault"
                : is_cure ? "cure"
                          : "",
                is_fault  ? "&#x2717;"
                : is_cure ? "&#x2713;"
                          : "",
                gn_figures[i].what, decimals_of(result, i), result->figures[index][i],
                gn_figures[i].unit);
    }
    fputs("</table>", to);
}

static void print_step(FILE *to, const struct gn_lesson_result *result, int index) {
    const struct gn_lesson *lesson = result->lesson;
    const struct gn_lesson_step *step = &lesson->steps[index];
    char flags[400];
    gn_lesson_flags(lesson, index, flags, sizeof flags);
    fprintf(
        to,
        "<figure><div class=\"pictures\"><img src=\"%s-%d.png\" alt=\"%s\"><img "
        "src=\"%s-%d-diff.png\" alt=\"difference\"></div>\n"
        "<input type=\"range\" value=\"100\" aria-label=\"picture or difference\" "
        "oninput=\"this.previousElementSibling.style.setProperty('--at', this.value + '%%')\">\n",
        lesson->name, index + 1, step->name, lesson->name, index + 1);
    fprintf(to, "<figcaption><b>%s</b>", step->name);
    print_figures(to, result, index);
    fprintf(to, "<code>gnomon render %s%s%s -o a.png</code></figcaption></figure>\n",
            GN_SCENE_LESSON, lesson->scene, flags);
}

static void print_lesson(FILE *to, const struct gn_lesson_result *result) {
    const struct gn_lesson *lesson = result->lesson;
    fprintf(to,
            "<h2 id=\"%s\">%s</h2>\n<p>%s</p>\n<div class=\"steps\">\n<figure><img "
            "src=\"%s-truth.png\" alt=\"truth\"><figcaption><b>truth</b>, by rays</figcaption>"
            "</figure>\n",
            lesson->name, lesson->title, lesson->teaches, lesson->name);
    for (int i = 0; i < gn_lesson_steps(lesson); i++) print_step(to, result, i);
    fputs("</div>\n", to);
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
