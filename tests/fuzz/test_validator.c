/* The files of the glTF validator (malformed/validator in ../shared or $GNOMON_SHARED), each with
 * its faulty object in use (graft.h): what the validator's report beside it calls an error is
 * refused for it, or shown with a warning that names the object; what it does not is shown. Where
 * this is not so, validator_rows.h says why. Prints tables of severities and of codes; the verdict
 * on each file is that of verdicts.txt, which GN_UPDATE=1 writes anew. With GN_VERBOSE: each file;
 * with GN_GRAFTS=FOLDER, a copy of the corpus: what is tried and shown stands there instead of the
 * file. Skipped (77) without the corpus. */
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/file.h"
#include "fuzz/graft.h"
#include "fuzz/validator_rows.h"
#include "unit/scene_check.h"

enum { CODES = 200, KEPT = 24 };
/* Of another: for another reason than the report's, or with warnings that do not name its objects.
 */
enum outcome { REFUSED, REFUSED_OTHER, NAMED, NAMED_OTHER, SILENT, OUTCOMES };
static const char *const outcome_names[OUTCOMES] = {"refused", "refused*", "named", "named*",
                                                    "silent"};
enum { ERROR, WARNING, LESS, NONE, SEVERITIES };
static const char *const severity_names[SEVERITIES] = {"error", "warning", "info, hint", "none"};

static struct {
    struct {
        char name[80];
        int files[OUTCOMES];
    } codes[CODES];
    int code_count, files[SEVERITIES][OUTCOMES], wrong, explained, empty;
    bool verbose;
    FILE *verdicts;
    bool used[GN_VALIDATOR_FILES], code_used[GN_VALIDATOR_CODES];
} tally;

/* Its messages of the worst severity that it has. */
struct report {
    const char *codes[KEPT], *pointers[KEPT];
    int count, severity;
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
    report->severity = NONE;
    json_array_foreach((json_t *)messages, i, m) {
        const int severity = (int)json_integer_value(json_object_get(m, "severity"));
        const int least = severity < LESS ? severity : LESS;
        if (least < report->severity) report->severity = least;
    }
    json_array_foreach((json_t *)messages, i, m) {
        const int severity = (int)json_integer_value(json_object_get(m, "severity"));
        if ((severity < LESS ? severity : LESS) != report->severity) continue;
        const char *pointer = json_string_value(json_object_get(m, "pointer"));
        if (report->count == KEPT) continue;
        report->codes[report->count] = json_string_value(json_object_get(m, "code"));
        report->pointers[report->count++] = pointer ? pointer : "";
    }
}

/* Does a message name the object that a pointer is to, "/nodes/0/mesh" as nodes[0].mesh, or
 * "/buffers/0" as buffer 0 of what uses it? Of the file as a whole, a byte of it. */
static bool is_about(const char *message, const char *pointer) {
    char array[40] = "", text[60], user[60];
    int index = -1;
    if (!pointer[0]) return strstr(message, ": byte ") != NULL;
    if (sscanf(pointer, "/%39[^/]/%d", array, &index) < 1)
        return strstr(message, ": asset") != NULL;
    snprintf(text, sizeof text, index < 0 ? "%s" : "%s[%d]", array, index);
    snprintf(user, sizeof user, " %.*s %d", (int)strlen(array) - 1, array, index);
    const char *used = strncmp(array, "buffer", 6) == 0 ? strstr(message, user) : NULL;
    return strstr(message, text) || (used && strchr(" ,", used[strlen(user)]));
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
    if (report->severity != ERROR || outcome == REFUSED_OTHER) return false;
    bool all = true;
    for (int i = 0; i < report->count; i++) all &= is_harmless(report->codes[i]);
    return all;
}

/* What is said of a file: the error, or warnings, and what is missing of an extension. */
static bool says(const struct gn_scene *scene, const char *error,
                 const struct gn_warnings *warnings, const struct report *report) {
    bool about = false;
    for (int i = 0; i < report->count; i++) {
        const char *material = strstr(report->pointers[i], "/KHR_materials_");
        char word[40] = "";
        if (material) sscanf(material, "/KHR_materials_%39[^/]", word);
        about |= scene && word[0] && strstr(scene->missing, word);
        about |= !scene && is_about(error, report->pointers[i]);
        for (int k = 0; k < warnings->count; k++)
            about |= is_about(warnings->text[k], report->pointers[i]);
    }
    return about;
}

static void judge(const char *path, const struct report *report, enum outcome outcome,
                  const char *said) {
    const bool agrees = report->severity == ERROR ? outcome == REFUSED || outcome == NAMED
                                                  : outcome != REFUSED && outcome != REFUSED_OTHER;
    const char *name = strstr(path, "/test/"), *place = strstr(said, path);
    tally.files[report->severity][outcome]++;
    for (int i = 0; i < report->count; i++) {
        int k = 0;
        while (k < i && strcmp(report->codes[k], report->codes[i]) != 0) k++;
        if (k == i) tally.codes[row_of(report->codes[i])].files[outcome]++;
    }
    tally.empty += strstr(said, "scene is empty") != NULL;
    const bool explained = !agrees && is_explained(path, report, outcome);
    tally.explained += explained;
    tally.wrong += !agrees && !explained;
    name = name ? name + 6 : path;
    fprintf(tally.verdicts, "%-10s %-8s %s\n", severity_names[report->severity],
            outcome_names[outcome], name);
    if (!tally.verbose && (agrees || explained)) return;
    if (place == said) said += strlen(path);
    printf("%s%s %s %s: %s", agrees || explained ? "" : "FAIL ", severity_names[report->severity],
           outcome_names[outcome], name, said);
    for (int i = 0; i < report->count; i++)
        printf(" | %s %s", report->codes[i], report->pointers[i]);
    printf("\n");
}

/* In place of the file, in a copy of the corpus. */
static void write_graft(const char *path, const struct gn_made *made) {
    const char *folder = getenv("GN_GRAFTS"), *name = strstr(path, "/test/");
    char to[PATH_MAX];
    struct gn_err err = {0};
    if (!folder || !name) return;
    snprintf(to, sizeof to, "%s%s", folder, name);
    if (!made->data) {
        unlink(to);
    } else if (!gn_file_replace(to, made->data, made->size, &err)) {
        printf("FAIL %s\n", err.text);
        tally.wrong++;
    }
}

static void try_file(const char *path, const json_t *json) {
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    struct report report = {.count = 0};
    struct gn_bytes file;
    read_report(json, &report);
    if (!gn_file_read(path, SIZE_MAX, &file, &err)) return;
    struct gn_made made = gn_graft(file.data, file.size);
    struct gn_scene *scene =
        gn_scene_load_converted(path, made.data ? made.data : file.data,
                                made.data ? made.size : file.size, NULL, &warnings, &err);
    const char *wrong = scene ? gn_scene_check(scene) : NULL, *said = err.text;
    if (scene) said = warnings.count ? warnings.text[0] : scene->missing;
    if (wrong) {
        printf("FAIL %s: %s\n", path, wrong);
        tally.wrong++;
    }
    const bool about = says(scene, err.text, &warnings, &report);
    judge(path, &report,
          !scene    ? about ? REFUSED : REFUSED_OTHER
          : about   ? NAMED
          : said[0] ? NAMED_OTHER
                    : SILENT,
          said);
    write_graft(path, scene ? &made : &(struct gn_made){0});
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

/* Of lines, which have it last. */
static int by_path(const void *a, const void *b) {
    return strcmp(strrchr(*(char *const *)a, ' '), strrchr(*(char *const *)b, ' '));
}

static void print_line(const char *name, const int files[OUTCOMES]) {
    printf("%-54s", name);
    for (int i = 0; i < OUTCOMES; i++) printf(" %8d", files[i]);
    printf("\n");
}

static void print_table(void) {
    qsort(tally.codes, (size_t)tally.code_count, sizeof tally.codes[0], by_name);
    printf("%-54s", "");
    for (int i = 0; i < OUTCOMES; i++) printf(" %8s", outcome_names[i]);
    printf("\n");
    for (int i = 0; i < tally.code_count; i++)
        print_line(tally.codes[i].name, tally.codes[i].files);
    for (int i = 0; i < SEVERITIES; i++) {
        char name[40];
        snprintf(name, sizeof name, "files whose worst is: %s", severity_names[i]);
        print_line(name, tally.files[i]);
    }
    printf("* not for the report's reason, or of other objects\n"
           "%d refused as empty; %d disagreements, all but %d explained\n",
           tally.empty, tally.explained + tally.wrong, tally.wrong);
}

/* Are all verdicts those of the file? Sorted, since the order of a folder's files is none. */
static void check_verdicts(char *text) {
    static const char golden[] = "tests/fuzz/verdicts.txt";
    char *lines[1000], *rest = NULL;
    size_t count = 0, used = 0, size = strlen(text);
    for (char *line = strtok_r(text, "\n", &rest); line && count < 1000;
         line = strtok_r(NULL, "\n", &rest))
        lines[count++] = line;
    qsort(lines, count, sizeof *lines, by_path);
    char *sorted = gn_xalloc(size + 1, 1);
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(sorted + used, size + 1 - used, "%s\n", lines[i]);
    struct gn_bytes known = {0};
    struct gn_err err = {0};
    if (getenv("GN_UPDATE")) gn_file_replace(golden, sorted, used, &err);
    const bool same = gn_file_read(golden, SIZE_MAX, &known, &err) && known.size == used &&
                      memcmp(known.data, sorted, used) == 0;
    for (size_t i = 0; !same && i < count; i++)
        if (!known.data || !memmem(known.data, known.size, lines[i], strlen(lines[i])))
            printf("FAIL another verdict than in %s: %s\n", golden, lines[i]);
    if (!same)
        printf("FAIL: verdicts differ from %s; GN_UPDATE=1 writes it %s\n", golden, err.text);
    tally.wrong += !same;
    free(known.data);
    free(sorted);
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
    char *text = NULL;
    size_t size = 0;
    tally.verdicts = open_memstream(&text, &size);
    snprintf(folder, sizeof folder, "%s/malformed/validator", shared ? shared : "../shared");
    if (nftw(folder, visit, 16, FTW_PHYS) != 0) {
        printf("SKIP: there is no folder %s\n", folder);
        return 77;
    }
    fclose(tally.verdicts);
    print_table();
    check_rows();
    check_verdicts(text);
    free(text);
    return tally.wrong > 0 || tally.code_count == 0;
}
