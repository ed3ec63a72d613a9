#include "cli/fit_report.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/json.h"
#include "core/text.h"
#include "options/file.h"
#include "options/value.h"

enum { REFRESH_HZ = 60, VALUE = 1024 };

/* ---- kiosk.ini ---- */

bool gn_fit_may_write(const char *path, struct gn_err *err) {
    struct stat info;
    if (!path || stat(path, &info) != 0 || !S_ISREG(info.st_mode) || info.st_size == 0) return true;
    return gn_fail(err, "%s exists: fit writes over no file; name another one, or move it away",
                   path);
}

/* Without links; from the folder of that file on, where it lies in that. */
static bool place_path(const char *path, const char *seen_from, char out[PATH_MAX],
                       struct gn_err *err) {
    char all[PATH_MAX], folder[PATH_MAX] = "";
    const char *slash = seen_from ? strrchr(seen_from, '/') : NULL;
    snprintf(all, sizeof all, "%.*s", slash ? (int)(slash - seen_from + 1) : 1,
             slash ? seen_from : ".");
    if (!realpath(path, out)) return gn_fail(err, "%s: no file of that name", path);
    if (!seen_from || !realpath(all, folder)) return true;
    const size_t length = strlen(folder);
    if (strncmp(out, folder, length) == 0 && out[length] == '/')
        memmove(out, out + length + 1, strlen(out + length + 1) + 1);
    return true;
}

bool gn_fit_has_taps(const struct gn_settings *o) {
    return gn_settings_given(o, render.shadow) &&
           gn_techniques[o->render.shadow.items[0]].taps != GN_TAPS_NONE;
}

/* Samples are written where they are drawn, or were asked for. */
static bool is_chosen(const struct gn_fitting *f, const struct gn_settings *chosen,
                      const struct gn_option_row *row) {
    const size_t i = (size_t)(row - gn_option_rows);
    return row->section && chosen->source[i] == GN_SOURCE_FLAG &&
           (row->offset != offsetof(struct gn_settings, render.taps) ||
            f->given->source[i] == GN_SOURCE_FLAG || gn_fit_has_taps(chosen));
}

static bool is_path(const struct gn_option_row *row, const char *text) {
    return row->kind == GN_KIND_SCENES ||
           (row->kind == GN_KIND_PATH && !gn_option_has_choice(row, text));
}

static bool print_setting(const struct gn_fitting *f, const struct gn_settings *chosen,
                          const struct gn_option_row *row, FILE *to, struct gn_err *err) {
    char key[64], text[VALUE], path[PATH_MAX];
    gn_settings_text(chosen, row, text, sizeof text);
    if (is_path(row, text)) {
        const char *const *given = gn_settings_value(chosen, row);
        if (!place_path(*given, f->given->run.out, path, err)) return false;
    }
    fprintf(to, "%s = %s\n", gn_option_key(row, key, sizeof key), is_path(row, text) ? path : text);
    return true;
}

/* The picture is as large as the screen's mode: so that it is no larger than was weighed. */
static void print_display(const struct gn_settings *given, FILE *to) {
    const struct gn_size *px = &given->render.size;
    const bool is_slower = given->run.fps >= 1 && given->run.fps < REFRESH_HZ;
    if (px->width_px < px->height_px && !is_slower) return;
    fprintf(to, "[display]\n");
    if (px->width_px >= px->height_px && px->height_px >= 16)
        fprintf(to, "max_mode = %dx%d@%g\n", px->width_px, px->height_px,
                fmax(ceil(given->run.fps), REFRESH_HZ));
    if (is_slower) fprintf(to, "max_fps = %g\n", floor(given->run.fps));
}

static bool print_section(const struct gn_fitting *f, const struct gn_settings *chosen,
                          const char *title, FILE *to, struct gn_err *err) {
    bool any = false;
    for (const struct gn_option_row *row = gn_option_rows; row < gn_option_rows + GN_OPTION_COUNT;
         row++) {
        if (!is_chosen(f, chosen, row) || strcmp(row->section, title) != 0) continue;
        if (!any) fprintf(to, "[%s]\n", title);
        any = true;
        if (!print_setting(f, chosen, row, to, err)) return false;
    }
    return true;
}

static bool print_ini(const struct gn_fitting *f, const struct gn_settings *chosen, FILE *to,
                      struct gn_err *err) {
    const struct gn_size *px = &f->given->render.size;
    fprintf(to,
            "; Made by gnomon fit: %s, %dx%d, %g frames a second.\n"
            "; A frame takes %.1f ms at least, after the model of gnomon inspect --for %s.\n",
            f->gpu->what, px->width_px, px->height_px, f->given->run.fps, f->search.ms,
            f->gpu->name);
    if (!print_section(f, chosen, "scene", to, err)) return false;
    print_display(f->given, to);
    if (!print_section(f, chosen, "render", to, err)) return false;
    for (int i = 0; i < f->search.count; i++)
        if (f->steps[i].light && f->search.taken >> i & 1)
            fprintf(to, "[light \"%s\"]\n%s = %s\n", f->steps[i].light, f->steps[i].option,
                    f->steps[i].value);
    return true;
}

/* Whether the reader of kiosk.ini takes it, and for the same scene: a name may have what would
 * begin a comment there, or be too long. */
static bool check_ini(const struct gn_fitting *f, const char *text, struct gn_err *err) {
    struct gn_options options;
    struct stat a, b;
    const char *out = f->given->run.out, *scene = f->given->scene.path;
    gn_options_init(&options, GN_COMMAND_SHOW);
    bool ok = gn_config_load_text(&options, out ? out : "kiosk.ini", text, strlen(text), err) ||
              gn_fail_prefix(err, "the settings cannot be written as a kiosk.ini");
    const char *read = options.settings->scene.path;
    if (ok && scene &&
        !(read && stat(scene, &a) == 0 && stat(read, &b) == 0 && a.st_dev == b.st_dev &&
          a.st_ino == b.st_ino))
        ok = gn_fail(err, "%s: a kiosk.ini cannot name this file; give it a shorter, plain name",
                     scene);
    gn_options_finish(&options);
    return ok;
}

char *gn_fit_write(const struct gn_fitting *f, const struct gn_settings *chosen,
                   struct gn_err *err) {
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    bool ok = to && print_ini(f, chosen, to, err);
    if (!to || fclose(to) != 0) ok = gn_fail(err, "no memory for a kiosk.ini");
    if (ok && check_ini(f, text, err)) return text;
    free(text);
    return NULL;
}

/* ---- the report ---- */

static bool is_taken(const struct gn_fitting *f, int i) { return f->search.taken >> i & 1; }

/* The frame's time before that step. */
static double ms_before(const struct gn_fitting *f, int i) {
    return i > 0 ? f->search.step_ms[i - 1] : f->search.best_ms;
}

static void print_bound(const char *what, double ms, FILE *to) {
    gn_text_print_line(to, "%-32s %8.2f ms  at most %.0f frames a second", what, ms,
                       floor(1000 / fmax(ms, 1e-3)));
}

static void print_text(const struct gn_fitting *f, const char *ini, FILE *to) {
    const struct gn_size *px = &f->given->render.size;
    char what[160];
    fprintf(to, "%s at %dx%d: %g frames a second are %.2f ms each\n", f->gpu->what, px->width_px,
            px->height_px, f->given->run.fps, f->search.goal_ms);
    print_bound("the best picture takes", f->search.best_ms, to);
    if (!f->search.taken) gn_text_print_line(to, "nothing has to be given up");
    for (int i = 0; i < f->search.count; i++) {
        const struct gn_fit_step *step = &f->steps[i];
        if (!is_taken(f, i)) continue;
        gn_text_format(what, sizeof what, "%s = %s%s%s saves", step->option, step->value,
                       step->light ? " of " : "", step->light ? step->light : "");
        gn_text_print_line(to, "%-32s %8.2f ms  %s", what, ms_before(f, i) - f->search.step_ms[i],
                           step->loses);
    }
    if (f->search.taken) print_bound("so a frame takes", f->search.ms, to);
    gn_text_print_line(to,
                       "at least, after the model of gnomon inspect --for %s (%s). Fewer triangles "
                       "and a smaller picture are not chosen here: gnomon bake --simplify, --size",
                       f->gpu->name,
                       f->gpu->error > 0 ? "calibrated in fetches alone" : "not calibrated");
    fprintf(to, "\n%s", ini);
}

static json_t *step_json(const struct gn_fitting *f, int i) {
    const struct gn_fit_step *step = &f->steps[i];
    return json_pack("{ss ss so ss so}", "option", step->option, "value", step->value, "light",
                     gn_json_make_text(step->light), "loses", step->loses, "saves_ms",
                     gn_json_make_number(ms_before(f, i) - f->search.step_ms[i]));
}

static bool print_json(const struct gn_fitting *f, const char *ini, FILE *to, struct gn_err *err) {
    const struct gn_size *px = &f->given->render.size;
    json_t *steps = json_array();
    for (int i = 0; i < f->search.count; i++)
        if (is_taken(f, i)) json_array_append_new(steps, step_json(f, i));
    return gn_json_print(
        json_pack("{ss ss si si so so so so sb so so}", "gpu", f->gpu->name, "board", f->gpu->what,
                  "width_px", px->width_px, "height_px", px->height_px, "frames_per_second",
                  gn_json_make_number(f->given->run.fps), "goal_ms",
                  gn_json_make_number(f->search.goal_ms), "best_ms",
                  gn_json_make_number(f->search.best_ms), "ms", gn_json_make_number(f->search.ms),
                  "met", f->search.is_met, "steps", steps, "ini", gn_json_make_text(ini)),
        9, to, err);
}

bool gn_fit_print(const struct gn_fitting *f, const char *ini, FILE *to, struct gn_err *err) {
    if (f->given->run.json) return print_json(f, ini, to, err);
    print_text(f, ini, to);
    return true;
}
