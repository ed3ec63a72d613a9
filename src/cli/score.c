/* gnomon score: how far the shadows in pictures of the open benchmark are from the truth
 * (assets/benchmark). */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/score_report.h"
#include "core/file.h"
#include "core/text.h"
#include "image/measure.h"
#include "image/write.h"

enum { PATH_ROOM = 4096 };

/* ---- folders ---- */

/* The name of a picture, without folder and suffix; false: it does not end in the suffix. */
static bool stem_of(const char *path, const char *suffix, char out[GN_SCORE_NAME]) {
    const char *name = gn_file_name(path);
    const size_t length = strlen(name), end = strlen(suffix);
    if (length <= end || strcmp(name + length - end, suffix) != 0 || length - end >= GN_SCORE_NAME)
        return false;
    memcpy(out, name, length - end);
    out[length - end] = '\0';
    return true;
}

static int is_scene(const struct dirent *entry) {
    char name[GN_SCORE_NAME];
    return stem_of(entry->d_name, ".glb", name);
}
static int is_picture(const struct dirent *entry) {
    char name[GN_SCORE_NAME];
    return stem_of(entry->d_name, ".pfm", name) || stem_of(entry->d_name, ".png", name);
}

static void free_list(struct dirent **list, int count) {
    for (int i = 0; i < count; i++) free(list[i]);
    free(list);
}

/* Why there is no scene of that name. */
static bool fail_name(const char *folder, const char *name, struct gn_err *err) {
    struct dirent **scenes = NULL;
    struct gn_text_guess guess = {0};
    const int count = scandir(folder, &scenes, is_scene, alphasort);
    for (int i = 0; i < count; i++) {
        scenes[i]->d_name[strlen(scenes[i]->d_name) - 4] = '\0';
        gn_text_guess(&guess, name, scenes[i]->d_name);
    }
    if (count <= 0)
        gn_fail(err,
                "%.200s: no scenes of the benchmark here: `make benchmark-scenes` in the source "
                "of gnomon makes them in assets/benchmark; --benchmark DIR names another folder",
                folder);
    else if (guess.name)
        gn_fail_usage(err, "unknown truth \"%.80s\"; did you mean %s?", name, guess.name);
    else
        gn_fail_usage(err, "unknown truth \"%.80s\": %.200s has no scene of that name, but %s",
                      name, folder, scenes[0]->d_name);
    free_list(scenes, count);
    return false;
}

/* The file of a scene or its truth; false: no scene has that name. */
static bool file_of(const char *folder, const char *name, const char *suffix, char *path,
                    struct gn_err *err) {
    struct gn_benchmark_name parts;
    const bool known = gn_benchmark_name_parse(name, &parts) &&
                       snprintf(path, PATH_ROOM, "%s/%s.glb", folder, name) < PATH_ROOM &&
                       access(path, F_OK) == 0;
    if (!known) return fail_name(folder, name, err);
    memcpy(path + strlen(path) - 4, suffix, 5);
    return true;
}

/* ---- truth ---- */

static bool make_truth(const char *folder, const char *name, struct gn_err *err) {
    char scene_path[PATH_ROOM], path[PATH_ROOM];
    struct gn_benchmark_name parts;
    if (!file_of(folder, name, ".glb", scene_path, err) ||
        !file_of(folder, name, ".pfm", path, err) || !gn_benchmark_name_parse(name, &parts))
        return false;
    const struct gn_benchmark_class_row *row = &gn_benchmark_classes[parts.kind];
    float *rgb = gn_picture_alloc(gn_benchmark_pixels(parts.kind), 3 * sizeof *rgb, err);
    struct gn_scene *scene = rgb ? gn_scene_load(scene_path, NULL, NULL, err) : NULL;
    bool ok = scene && (gn_benchmark_make(scene, parts.kind, rgb, err) ||
                        gn_fail_prefix(err, "%s", scene_path));
    ok = ok && gn_picture_write_pfm(path, rgb, 3, row->width_px, row->height_px, err);
    gn_scene_destroy(scene);
    free(rgb);
    return ok;
}

static bool load_truth(const struct gn_settings *o, const char *name, struct gn_pixels *truth,
                       struct gn_err *err) {
    char path[PATH_ROOM];
    struct gn_benchmark_name parts;
    if (!file_of(o->run.benchmark, name, ".pfm", path, err) ||
        !gn_benchmark_name_parse(name, &parts))
        return false;
    if (access(path, F_OK) != 0)
        return gn_fail(err,
                       "%.300s: no truth yet: `gnomon score --make-truth --truth %s` or `make "
                       "benchmark` makes it",
                       path, name);
    if (!gn_pixels_load(truth, path, err)) return false;
    const struct gn_benchmark_class_row *row = &gn_benchmark_classes[parts.kind];
    if ((int)truth->width_px == row->width_px && (int)truth->height_px == row->height_px)
        return true;
    return gn_fail(err, "%s is %zux%zu, not the %dx%d of a truth: delete it and make it again",
                   path, truth->width_px, truth->height_px, row->width_px, row->height_px);
}

/* ---- pictures ---- */

static bool score_picture(const struct gn_settings *o, const char *path, const char *name,
                          struct gn_score_row *row, struct gn_err *err) {
    struct gn_pixels truth = {0}, shot = {0};
    bool ok = load_truth(o, name, &truth, err) && gn_pixels_load(&shot, path, err);
    if (ok && (shot.width_px != truth.width_px || shot.height_px != truth.height_px))
        ok = gn_fail(err, "%.200s is %zux%zu, the truth of %s is %zux%zu: render it in that size",
                     path, shot.width_px, shot.height_px, name, truth.width_px, truth.height_px);
    if (ok) {
        snprintf(row->scene, sizeof row->scene, "%s", name);
        gn_benchmark_name_parse(name, &row->name);
        gn_benchmark_compare(row->name.kind, truth.rgb, shot.rgb, o->run.reach, &row->score);
    }
    gn_pixels_finish(&truth);
    gn_pixels_finish(&shot);
    return ok;
}

/* All pictures of a folder, each called as its scene. */
static bool score_folder(const struct gn_settings *o, const char *folder,
                         struct gn_score_report *report, struct gn_err *err) {
    struct dirent **pictures = NULL;
    const int count = scandir(folder, &pictures, is_picture, alphasort);
    bool ok = count > 0;
    if (!ok) gn_fail(err, "%s: no pictures called as scenes of the benchmark here", folder);
    if (ok) report->rows = gn_xalloc((size_t)count, sizeof *report->rows);
    for (int i = 0; ok && i < count; i++) {
        char path[PATH_ROOM], name[GN_SCORE_NAME];
        const char *file = pictures[i]->d_name;
        snprintf(path, sizeof path, "%s/%s", folder, file);
        ok = (stem_of(file, ".pfm", name) || stem_of(file, ".png", name)) &&
             score_picture(o, path, name, &report->rows[report->row_count++], err);
    }
    free_list(pictures, count);
    return ok;
}

static bool score_one(const struct gn_settings *o, const char *path, struct gn_score_report *report,
                      struct gn_err *err) {
    char name[GN_SCORE_NAME] = "";
    if (o->run.truth)
        snprintf(name, sizeof name, "%s", o->run.truth);
    else if (!stem_of(path, ".pfm", name) && !stem_of(path, ".png", name))
        return gn_fail_usage(err, "score: which scene is %.200s? Add --truth NAME", path);
    report->rows = gn_xalloc(1, sizeof *report->rows);
    report->row_count = 1;
    return score_picture(o, path, name, report->rows, err);
}

bool gn_cli_score(const struct gn_options *options, struct gn_warnings *warnings,
                  struct gn_err *err) {
    (void)warnings;
    const struct gn_settings *o = options->settings;
    const char *path = options->word_count > 0 ? options->words[0] : NULL;
    struct stat status;
    if (o->run.make_truth) {
        if (path)
            return gn_fail_usage(err, "score --make-truth: unexpected argument \"%.80s\"", path);
        if (!o->run.truth) return gn_fail_usage(err, "score --make-truth: add --truth NAME");
        return make_truth(o->run.benchmark, o->run.truth, err);
    }
    if (!path) return gn_fail_usage(err, "score: expected a picture, or a folder of pictures");
    const bool is_folder = stat(path, &status) == 0 && S_ISDIR(status.st_mode);
    if (is_folder && o->run.truth)
        return gn_fail_usage(err, "score: --truth is of one picture, and %.200s is a folder", path);
    struct gn_score_report report = {.reach_texels = o->run.reach};
    const bool ok =
        (is_folder ? score_folder(o, path, &report, err) : score_one(o, path, &report, err)) &&
        gn_score_print(&report,
                       o->run.json  ? GN_SCORE_JSON
                       : o->run.csv ? GN_SCORE_CSV
                                    : GN_SCORE_TEXT,
                       stdout, err);
    free(report.rows);
    return ok;
}
