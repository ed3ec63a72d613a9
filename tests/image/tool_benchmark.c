/* `make benchmark`: the scenes of the open benchmark (assets/benchmark), their truths, and the
 * table of gnomon's own techniques, by `gnomon render` and `gnomon score`, as anybody else's is
 * made. */
#include <dirent.h>
#include <jansson.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"
#include "image/penumbra.h"
#include "image/shot.h"
#include "image/table.h"
#include "shadow/technique.h"
#include "truth/benchmark.h"

static const char usage[] =
    "usage: tool_benchmark scenes FOLDER          writes the scenes\n"
    "       tool_benchmark truths FOLDER          casts the rays of those without a truth\n"
    "       tool_benchmark run FOLDER OUT [NAME]  pictures of all techniques, or of one, into\n"
    "                                             OUT/TECHNIQUE, and the table\n";

static void quit(const char *what) {
    fprintf(stderr, "tool_benchmark: %s\n", what);
    exit(1);
}

/* ---- scenes ---- */

/* Those of make truth: the first and the last. */
static const struct {
    const char *name;
    int first, last;
} ranges[] = {{"field-sun", 0, 11},   {"field-spot", 12, 23},  {"field-point", 24, 29},
              {"coarse-sun", 30, 32}, {"coarse-spot", 33, 35}, {"coarse-point", 36, 38},
              {"rods-spot", 39, 41},  {"scaled-spot", 42, 44}};

/* What is there already and the same stays: its truth is not made again. */
static void copy(const char *from, const char *folder, const char *name) {
    char path[800];
    struct gn_bytes bytes, old;
    struct gn_err err = {0};
    snprintf(path, sizeof path, "%s/%s.glb", folder, name);
    if (!gn_file_read(from, 0, &bytes, &err)) quit(err.text);
    bool same = gn_file_read(path, 0, &old, NULL);
    if (same) {
        same = old.size == bytes.size && memcmp(old.data, bytes.data, old.size) == 0;
        gn_bytes_finish(&old);
    }
    if (!same && !gn_file_write(path, bytes.data, bytes.size, &err)) quit(err.text);
    gn_bytes_finish(&bytes);
}

static void write_scenes(const char *folder) {
    static const char *const kinds[] = {
        [GN_LIGHT_DIRECTIONAL] = "sun", [GN_LIGHT_POINT] = "point", [GN_LIGHT_SPOT] = "spot"};
    struct gn_err err = {0};
    char path[700], name[60];
    char *fields = gn_table_scenes(false, &err), *contacts = gn_table_scenes(true, &err);
    if (!fields || !contacts) quit(err.text);
    for (size_t r = 0; r < sizeof ranges / sizeof *ranges; r++)
        for (int i = ranges[r].first; i <= ranges[r].last; i++) {
            snprintf(path, sizeof path, "%s/truth-%02d.glb", fields, i);
            snprintf(name, sizeof name, "%s-%02d", ranges[r].name, i);
            copy(path, folder, name);
        }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        snprintf(name, sizeof name, "contact-%s", kinds[i]);
        snprintf(path, sizeof path, "%s/%s.glb", contacts, name);
        copy(path, folder, name);
    }
    for (int i = 0; i < GN_PENUMBRA_ALL; i++) {
        char *scene = gn_penumbra_write(i, &err);
        if (!scene) quit(err.text);
        if (i < GN_PENUMBRA_COUNT)
            snprintf(name, sizeof name, "soft-%s-%s", kinds[gn_penumbra_light(i)],
                     gn_penumbra_names[i]);
        else
            snprintf(name, sizeof name, "%s", gn_penumbra_names[i]);
        copy(scene, folder, name);
        free(scene);
    }
    free(fields);
    free(contacts);
}

/* ---- two at a time ---- */

enum { SCENES_MAX = 100, TECHNIQUES_MAX = GN_TECHNIQUE_COUNT };

struct work {
    const char *folder, *out;
    char scenes[SCENES_MAX][60];
    int scene_count;
    const struct gn_technique_row *techniques[TECHNIQUES_MAX];
    int technique_count, total;
    atomic_int next;
    void (*step)(const struct work *work, int index);
};

static int is_scene(const struct dirent *entry) {
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".glb") == 0;
}

static void list_scenes(struct work *work) {
    struct dirent **list = NULL;
    const int count = scandir(work->folder, &list, is_scene, alphasort);
    for (int i = 0; i < count && i < SCENES_MAX; i++) {
        snprintf(work->scenes[i], sizeof work->scenes[i], "%.*s", (int)strlen(list[i]->d_name) - 4,
                 list[i]->d_name);
        work->scene_count++;
    }
    for (int i = 0; i < count; i++) free(list[i]);
    free(list);
    if (count < 1) quit("no scenes: tool_benchmark scenes FOLDER");
}

static void *run_steps(void *data) {
    struct work *work = data;
    for (int i; (i = atomic_fetch_add(&work->next, 1)) < work->total;) {
        if (isatty(STDERR_FILENO)) fprintf(stderr, "\r%d of %d ", i + 1, work->total);
        work->step(work, i);
    }
    return NULL;
}

static void run_all(struct work *work) {
    pthread_t other;
    const bool two = pthread_create(&other, NULL, run_steps, work) == 0;
    run_steps(work);
    if (two) pthread_join(other, NULL);
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\n");
}

/* ---- truths ---- */

static void make_truth(const struct work *work, int index) {
    char scene[700], truth[700];
    struct stat made, from;
    struct gn_err err = {0};
    snprintf(scene, sizeof scene, "%s/%s.glb", work->folder, work->scenes[index]);
    snprintf(truth, sizeof truth, "%s/%s.pfm", work->folder, work->scenes[index]);
    if (stat(truth, &made) == 0 && stat(scene, &from) == 0 && made.st_mtime >= from.st_mtime)
        return;
    const char *const argv[] = {gn_shot_program(),   "score",       "--make-truth", "--truth",
                                work->scenes[index], "--benchmark", work->folder,   NULL};
    struct gn_run *run = malloc(sizeof *run);
    if (!run || !gn_run(run, argv, 600, &err)) quit(err.text);
    if (run->status) quit(run->err);
    free(run);
}

/* ---- pictures ---- */

/* As the techniques page measures: maps of 1024, and of the technique's own size for penumbrae. */
static void take_picture(const struct work *work, int index) {
    const struct gn_technique_row *technique = work->techniques[index / work->scene_count];
    const char *scene = work->scenes[index % work->scene_count];
    struct gn_benchmark_name name;
    struct gn_err err = {0};
    char path[800], scene_path[700], size[32];
    if (!gn_benchmark_name_parse(scene, &name)) quit("a scene has the wrong name");
    const struct gn_benchmark_class_row *row = &gn_benchmark_classes[name.kind];
    snprintf(scene_path, sizeof scene_path, "%s/%s.glb", work->folder, scene);
    snprintf(path, sizeof path, "%s/%s/%s.pfm", work->out, technique->name, scene);
    snprintf(size, sizeof size, "%dx%d", row->width_px, row->height_px);
    const char *args[] = {"--aov",    "visibility",    "--size", size,   "--backend", "egl",
                          "--shadow", technique->name, "--map",  "1024", NULL};
    if (row->soft) args[8] = NULL;
    if (!gn_shot_file(path, NULL, &err, scene_path, args)) quit(err.text);
}

/* ---- the table ---- */

enum { COLUMNS = 13 };
static const struct {
    const char *head, *kind, *measure; /* NULL: as in the techniques page */
    bool on_page;
} columns[COLUMNS] = {
    {"acne", "field", "acne_percent", true},
    {"darkening", "coarse", "darkening_percent", true},
    {"over 5 %", "coarse", "darkened_percent", true},
    {"leak", "field", "leak_percent", true},
    {"gap", "field", "gap_percent", true},
    {"wrong", "field", "wrong_percent", true},
    {"penumbra", "soft", "penumbra", true},
    {"thin", "thin", "penumbra", false},
    {"contact gap", "contact", "gap_percent", false},
    {"rods gap", "rods", "gap_percent", false},
    {"scaled gap", "scaled", "gap_percent", false},
    {"tear", "soft", "tear_percent_px", false},
    {"grain", "soft", "grain_percent_px", false},
};

/* Two digits that count, as in the techniques page. */
static void format_share(double value, char out[32]) {
    if (isnan(value))
        snprintf(out, 32, "%s", "");
    else if (value < .00005)
        snprintf(out, 32, "0");
    else
        snprintf(out, 32, "%.*f", value < .001 ? 4 : value < .1 ? 3 : 2, value);
}

static void read_row(json_t *report, const char *light, char out[COLUMNS][32]) {
    json_t *classes = json_object_get(report, "classes"), *object;
    size_t i;
    for (int c = 0; c < COLUMNS; c++) {
        double value = NAN;
        json_array_foreach(classes, i, object) {
            if (strcmp(json_string_value(json_object_get(object, "class")), columns[c].kind) == 0 &&
                strcmp(json_string_value(json_object_get(object, "light")), light) == 0)
                value = json_number_value(json_object_get(object, columns[c].measure));
        }
        format_share(value, out[c]);
    }
}

/* The cells of that row in src/shadow/README.md, of the encoding that stands first; false: there is
 * none. */
static bool read_page(const char *technique, const char *light, char out[COLUMNS][32]) {
    FILE *page = fopen("src/shadow/README.md", "r");
    char line[500], current[40] = "";
    bool found = false;
    while (page && !found && fgets(line, sizeof line, page)) {
        char *cells[20] = {0}, *rest = line;
        int count = 0;
        for (char *cell; count < 20 && (cell = strsep(&rest, "|"));) {
            cell += strspn(cell, " `");
            cell[strcspn(cell, " `\n")] = '\0';
            cells[count++] = cell;
        }
        if (count < 15) continue;
        if (cells[1][0]) snprintf(current, sizeof current, "%s", cells[1]);
        if (strcmp(current, technique) != 0 || strcmp(cells[2], light) != 0) continue;
        found = true;
        for (int c = 0; c < COLUMNS; c++)
            snprintf(out[c], 32, "%s", columns[c].on_page ? cells[4 + c] : "");
    }
    if (page) fclose(page);
    return found;
}

/* Returns how many cells are not those of the techniques page. */
static int print_technique(const struct work *work, const struct gn_technique_row *technique) {
    static const char *const lights[] = {"sun", "spot", "point"};
    char folder[700], reach[20];
    struct gn_err err = {0};
    int differ = 0;
    snprintf(folder, sizeof folder, "%s/%s", work->out, technique->name);
    snprintf(reach, sizeof reach, "%g", (double)technique->radius_texels + 1);
    const char *const argv[] = {gn_shot_program(), "score",      folder,   "--reach", reach,
                                "--benchmark",     work->folder, "--json", NULL};
    struct gn_run *run = malloc(sizeof *run);
    if (!run || !gn_run(run, argv, 300, &err)) quit(err.text);
    json_t *report = run->status ? NULL : json_loads(run->out, 0, NULL);
    if (!report) quit(run->err);
    for (int l = 0; l < 3; l++) {
        char cells[COLUMNS][32], page[COLUMNS][32];
        read_row(report, lights[l], cells);
        const bool on_page = read_page(technique->name, lights[l], page);
        printf("| %s%s%s | %s", l ? "" : "`", l ? "" : technique->name, l ? "" : "`", lights[l]);
        for (int c = 0; c < COLUMNS; c++) {
            const bool other = on_page && columns[c].on_page && strcmp(cells[c], page[c]) != 0;
            printf(" | %s%s%s", cells[c], other ? " not " : "", other ? page[c] : "");
            differ += other;
        }
        printf(" |\n");
    }
    fflush(stdout);
    json_decref(report);
    free(run);
    return differ;
}

static void run(struct work *work, const char *only) {
    char folder[700];
    int differ = 0;
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++) {
        const struct gn_technique_row *row = &gn_techniques[t];
        if (row->on_plane || (only && strcmp(only, row->name) != 0)) continue;
        snprintf(folder, sizeof folder, "%s/%s", work->out, row->name);
        mkdir(folder, 0777);
        work->techniques[work->technique_count++] = row;
    }
    if (!work->technique_count) quit("no technique of that name is in the benchmark");
    work->total = work->technique_count * work->scene_count;
    work->step = take_picture;
    run_all(work);
    printf("| technique | light");
    for (int c = 0; c < COLUMNS; c++) printf(" | %s", columns[c].head);
    printf(" |\n|---|---");
    for (int c = 0; c < COLUMNS; c++) printf("|---");
    printf("|\n");
    for (int t = 0; t < work->technique_count; t++)
        differ += print_technique(work, work->techniques[t]);
    printf(differ ? "\n%d cells are not those of src/shadow/README.md: \"not\" is before those; "
                    "make readme measures that table again\n"
                  : "\nwhere src/shadow/README.md has the same scenes it has the same figures\n",
           differ);
}

int main(int argc, char **argv) {
    static struct work work;
    if (argc < 3) {
        fputs(usage, stderr);
        return 2;
    }
    work.folder = argv[2];
    if (strcmp(argv[1], "scenes") == 0 && argc == 3) {
        write_scenes(argv[2]);
    } else if (strcmp(argv[1], "truths") == 0 && argc == 3) {
        list_scenes(&work);
        work.total = work.scene_count;
        work.step = make_truth;
        run_all(&work);
    } else if (strcmp(argv[1], "run") == 0 && (argc == 4 || argc == 5)) {
        work.out = argv[3];
        mkdir(work.out, 0777);
        list_scenes(&work);
        run(&work, argc == 5 ? argv[4] : NULL);
    } else {
        fputs(usage, stderr);
        return 2;
    }
    return 0;
}
