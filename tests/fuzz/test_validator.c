/* The files of the glTF validator (malformed/validator in ../shared or $GNOMON_SHARED), each with
 * its faulty object in use (graft.h): what the validator's report beside it calls an error is
 * refused, or named by a warning or as missing, or is explained here; what it does not is shown.
 * Prints a table of its codes. With GN_VERBOSE: each file.
 * Skipped (77) without the folder. */
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/file.h"
#include "fuzz/graft.h"
#include "fuzz/validator_rows.h"
#include "unit/scene_check.h"

enum { CODES = 160, KEPT = 24 };
enum outcome { REFUSED, WARNED, SILENT, OUTCOMES };
static const char *const outcome_names[OUTCOMES] = {"refused", "warned", "silent"};

static struct {
    struct {
        char name[80];
        int files[OUTCOMES], elsewhere;
    } codes[CODES];
    int code_count, files[2][OUTCOMES], wrong, explained, empty, elsewhere;
    bool verbose;
    bool used[GN_VALIDATOR_FILES], code_used[GN_VALIDATOR_CODES];
} tally;

struct report {
    const char *codes[KEPT], *pointers[KEPT]; /* of its errors */
    int count;
};

static int row_of(const char *code) {
    for (int i = 0; i < tally.code_count; i++)
        if (!strcmp(tally.codes[i].name, code)) return i;
    if (tally.code_count == CODES) exit(2);
    snprintf(tally.codes[tally.code_count].name, 80, "%s", code);
    return tally.code_count++;
}

static void read_report(const json_t *json, struct report *report) {
    const json_t *messages = json_object_get(json_object_get(json, "issues"), "messages");
    size_t i;
    json_t *m;
    json_array_foreach((json_t *)messages, i, m) {
        if (json_integer_value(json_object_get(m, "severity")) != 0) continue;
        const char *code = json_string_value(json_object_get(m, "code")),
                   *pointer = json_string_value(json_object_get(m, "pointer"));
        int k = 0;
        while (k < report->count && strcmp(report->codes[k], code) != 0) k++;
        if (k < report->count || k == KEPT) continue;
        report->codes[k] = code;
        report->pointers[k] = pointer ? pointer : "";
        report->count++;
    }
}

/* Does a message name the object that a pointer is to, "/nodes/0/mesh" as nodes[0].mesh? Of the
 * file as a whole, a byte of it. */
static bool is_about(const char *message, const char *pointer) {
    char array[40] = "", text[60];
    int index = -1;
    if (!pointer[0]) return strstr(message, ": byte ") != NULL;
    if (sscanf(pointer, "/%39[^/]/%d", array, &index) < 1) return false;
    snprintf(text, sizeof text, index < 0 ? "%s" : "%s[%d]", array, index);
    return strstr(message, text) != NULL;
}

static bool is_harmless(const char *code) {
    for (int i = 0; i < GN_VALIDATOR_CODES; i++)
        if (!strcmp(gn_validator_codes[i].code, code)) return tally.code_used[i] = true;
    return false;
}

/* Is what became of the file explained? */
static bool is_explained(const char *path, const struct report *report, enum outcome outcome) {
    for (int i = 0; i < GN_VALIDATOR_FILES; i++)
        if (strstr(path, gn_validator_files[i].file)) return tally.used[i] = true;
    if (report->count == 0 || outcome == REFUSED) return false;
    bool all = true;
    for (int i = 0; i < report->count; i++) all &= is_harmless(report->codes[i]);
    return all;
}

static void judge(const char *path, const struct report *report, enum outcome outcome,
                  const char *said) {
    const bool invalid = report->count > 0,
               agrees = invalid ? outcome != SILENT : outcome != REFUSED;
    bool about = false;
    tally.files[invalid][outcome]++;
    for (int i = 0; i < report->count; i++) about |= is_about(said, report->pointers[i]);
    for (int i = 0; i < report->count; i++) {
        const int row = row_of(report->codes[i]);
        tally.codes[row].files[outcome]++;
        tally.codes[row].elsewhere += outcome == REFUSED && !about;
    }
    tally.elsewhere += invalid && outcome == REFUSED && !about;
    tally.empty += strstr(said, "scene is empty") != NULL;
    const bool explained = !agrees && is_explained(path, report, outcome);
    tally.explained += explained;
    tally.wrong += !agrees && !explained;
    if (!tally.verbose && (agrees || explained)) return;
    const char *name = strstr(path, "/test/"), *place = strstr(said, path);
    if (place == said) said += strlen(path);
    printf("%s%s %s %s: %s", agrees || explained ? "" : "FAIL ", invalid ? "invalid" : "valid",
           outcome_names[outcome], name ? name + 6 : path, said);
    for (int i = 0; i < report->count; i++)
        printf(" | %s %s", report->codes[i], report->pointers[i]);
    printf("\n");
}

static void try_file(const char *path, const json_t *json) {
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    struct report report = {.count = 0};
    struct gn_bytes file;
    read_report(json, &report);
    if (!gn_file_read(path, SIZE_MAX, &file, &err)) return;
    const struct gn_made made = gn_graft(file.data, file.size);
    struct gn_scene *scene =
        gn_scene_load_converted(path, made.data ? made.data : file.data,
                                made.data ? made.size : file.size, NULL, &warnings, &err);
    const char *wrong = scene ? gn_scene_check(scene) : NULL, *said = err.text;
    if (scene) said = warnings.count ? warnings.text[0] : scene->missing;
    if (wrong) {
        printf("FAIL %s: %s\n", path, wrong);
        tally.wrong++;
    }
    judge(path, &report, !scene ? REFUSED : said[0] ? WARNED : SILENT, said);
    gn_scene_destroy(scene);
    free(made.data);
    free(file.data);
}

static int visit(const char *path, const struct stat *status, int type, struct FTW *where) {
    (void)status;
    (void)where;
    const char *dot = strrchr(path, '.');
    char report[PATH_MAX];
    if (type != FTW_F || !dot || (strcmp(dot, ".gltf") != 0 && strcmp(dot, ".glb") != 0)) return 0;
    snprintf(report, sizeof report, "%s.report.json", path);
    json_t *json = json_load_file(report, 0, NULL);
    if (json) try_file(path, json);
    json_decref(json);
    return 0;
}

static int by_name(const void *a, const void *b) { return strcmp(a, b); }

static void print_table(void) {
    printf("%-62s refused (elsewhere)  warned  silent\n", "files with an error of the validator");
    qsort(tally.codes, (size_t)tally.code_count, sizeof tally.codes[0], by_name);
    for (int i = 0; i < tally.code_count; i++)
        printf("%-62s %7d (%9d) %7d %7d\n", tally.codes[i].name, tally.codes[i].files[REFUSED],
               tally.codes[i].elsewhere, tally.codes[i].files[WARNED],
               tally.codes[i].files[SILENT]);
    for (int invalid = 1; invalid >= 0; invalid--)
        printf("%-62s %7d (%9d) %7d %7d\n", invalid ? "invalid files" : "valid files",
               tally.files[invalid][REFUSED], invalid ? tally.elsewhere : 0,
               tally.files[invalid][WARNED], tally.files[invalid][SILENT]);
    printf("%d refused as empty; %d explained, %d wrong\n", tally.empty, tally.explained,
           tally.wrong);
}

/* A row that explains nothing hides the next fault. */
static void check_rows(void) {
    for (int i = 0; i < GN_VALIDATOR_FILES; i++)
        if (!tally.used[i]) {
            printf("FAIL: the row of %s explains nothing\n", gn_validator_files[i].file);
            tally.wrong++;
        }
    for (int i = 0; i < GN_VALIDATOR_CODES; i++)
        if (!tally.code_used[i]) {
            printf("FAIL: the row of %s explains nothing\n", gn_validator_codes[i].code);
            tally.wrong++;
        }
}

int main(void) {
    const char *shared = getenv("GNOMON_SHARED");
    char folder[PATH_MAX];
    tally.verbose = getenv("GN_VERBOSE") != NULL;
    snprintf(folder, sizeof folder, "%s/malformed/validator", shared ? shared : "../shared");
    if (nftw(folder, visit, 16, FTW_PHYS) != 0) {
        printf("SKIP: there is no folder %s\n", folder);
        return 77;
    }
    print_table();
    check_rows();
    return tally.wrong > 0 || tally.code_count == 0;
}
