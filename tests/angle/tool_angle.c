/* tool_angle LIBRARY_PATH: gnomon on ANGLE, whose libEGL.so.1 is found on that path, against gnomon
 * on this machine's own EGL. First, whether what draws there is OpenGL ES 3.0 and no more: else
 * nothing of the rest would be a test. Then the same pictures from both, with every technique of
 * the table in every encoding that strict ES 3.0 has, and with GN_FULL=1 the limits of truth, on
 * all scenes. A picture that fails is left in build/failures. */
#include <jansson.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/compare.h"
#include "image/shot.h"
#include "image/table.h"
#include "shadow/technique.h"

enum { JOBS_MAX = 200, THREADS = 2, FORMATS_MAX = 16 };
/* What may differ: a channel by 2/255, and more than that in half a per cent of the pixels. */
static const double tolerance = 2.001 / 255, share_allowed = .005;
/* ES 3.0 has these by extensions alone, and those it promises. */
static const char *const missing[] = {"r16f", "rgba16f", "timer", "debug"};
static const char *const promised[] = {"depth-compare", "r32ui", "srgb", "msaa4"};
/* Rasterisers may place an edge by a sixteenth of a texel or pixel apart: the larger the picture,
 * the smaller the share of what lies at edges. */
#define SIZE "640x480"

struct job {
    char name[60];
    const char *scene;
    const char *args[20];
    struct gn_picture shots[2]; /* strict, own */
    struct gn_err err;
    bool failed;
};

struct run {
    const char *library_path;
    const char *formats[FORMATS_MAX];
    int format_count, job_count;
    char without[400]; /* what is missing there, for this machine's own EGL to do without */
    json_t *doctor, *automatic;
    struct job jobs[JOBS_MAX];
};

/* Of the programs that are started from now on. */
static void draw_strictly(const struct run *run, bool strict) {
    if (strict)
        setenv("LD_LIBRARY_PATH", run->library_path, 1);
    else
        unsetenv("LD_LIBRARY_PATH");
}

static bool refuse(const char *why) {
    printf("%s\n", why);
    return false;
}

/* ---- what draws ---- */

static json_t *ask_doctor(struct gn_err *err) {
    const char *const argv[] = {gn_shot_program(), "doctor", "--backend", "egl", "--json", NULL};
    struct gn_run *run = malloc(sizeof *run);
    json_t *answer = NULL;
    if (!run) abort();
    if (gn_run(run, argv, 0, err)) {
        answer = json_loads(run->out, 0, NULL);
        if (!answer || run->status)
            gn_fail(err, "doctor: status %d: %s", run->status, run->err[0] ? run->err : run->out);
    }
    free(run);
    return answer;
}

static const char *text_of(const json_t *object, const char *key) {
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

static bool lists(const json_t *list, const char *const names[], size_t count) {
    for (size_t i = 0; i < count; i++) {
        bool found = false;
        for (size_t k = 0; k < json_array_size(list); k++) {
            const json_t *entry = json_array_get(list, k);
            const char *name =
                json_is_string(entry) ? json_string_value(entry) : text_of(entry, "name");
            found |= strcmp(name, names[i]) == 0;
        }
        if (!found) return refuse(names[i]);
    }
    return true;
}

static bool lacks_extensions(struct run *run, const json_t *gpu) {
    const json_t *lacks = json_object_get(gpu, "not_proved");
    for (size_t i = 0; i < json_array_size(lacks); i++) {
        const char *name = text_of(json_array_get(lacks, i), "name");
        const size_t used = strlen(run->without);
        printf("not proved: %s; instead: %s\n", name, text_of(json_array_get(lacks, i), "instead"));
        snprintf(run->without + used, sizeof run->without - used, "%s%s", used ? "," : "", name);
    }
    return (lists(lacks, missing, sizeof missing / sizeof *missing) ||
            refuse("is an extension's and not missing")) &&
           (lists(json_object_get(gpu, "proved"), promised, sizeof promised / sizeof *promised) ||
            refuse("is promised by ES 3.0 and missing"));
}

static bool is_strict(struct run *run) {
    struct gn_err err = {0};
    draw_strictly(run, true);
    run->doctor = ask_doctor(&err);
    if (!run->doctor) return refuse(err.text);
    const json_t *gpu = json_object_get(run->doctor, "gpu");
    const char *gles = text_of(gpu, "gles"), *renderer = text_of(gpu, "renderer");
    printf("%s on %s\n", gles, renderer);
    if (strncmp(gles, "OpenGL ES 3.0 (ANGLE", 20) != 0 || !strstr(renderer, "SwiftShader"))
        return refuse("that is not ES 3.0 by ANGLE on SwiftShader");
    if (!lacks_extensions(run, gpu)) return false;
    const json_t *formats = json_object_get(gpu, "map_formats");
    for (size_t i = 0; i < json_array_size(formats) && i < FORMATS_MAX; i++)
        run->formats[run->format_count++] = json_string_value(json_array_get(formats, i));
    run->automatic = json_object_get(gpu, "auto");
    return run->format_count >= 3; /* depth, r32ui, rgba8 */
}

/* ---- what is drawn ---- */

static void add_job(struct run *run, const char *scene, const char *technique, const char *format,
                    const char *planar) {
    if (run->job_count == JOBS_MAX) abort();
    struct job *job = &run->jobs[run->job_count++];
    const char *base = strrchr(scene, '/');
    const char *const args[] = {"--size",       SIZE,   "--shadow",  technique,
                                "--planar",     planar, "--backend", "egl",
                                "--map-format", format, "--without", run->without};
    *job = (struct job){.scene = scene};
    memcpy(job->args, args, sizeof args);
    snprintf(job->name, sizeof job->name, "%.20s %s %s", base ? base + 1 : scene, technique,
             strcmp(planar, "mask") != 0 ? planar : format);
}

static bool is_encoding(const char *name) {
    for (int i = 0; i < GN_ENCODING_MASK; i++)
        if (strcmp(name, gn_encodings[i].name) == 0) return true;
    return false;
}

/* One of several that a technique's moments can be kept in. */
static bool is_store(const struct gn_technique_row *row, const char *name) {
    for (int i = 0; i < GN_STORES_MAX && row->stores[1] && row->stores[i]; i++)
        if (strcmp(name, gn_moments[row->stores[i]].name) == 0) return true;
    return false;
}

/* What a technique's maps can be kept in; always at least one. Of moments `auto` is the best: the
 * rest is for the full form. */
static int formats_of(const struct run *run, enum gn_technique technique,
                      const char *out[FORMATS_MAX]) {
    const struct gn_technique_row *row = &gn_techniques[technique];
    const bool encodes = is_encoding(text_of(run->automatic, row->name));
    int count = 0;
    for (int i = 0; i < run->format_count && row->file && !row->on_plane; i++)
        if (encodes ? is_encoding(run->formats[i])
                    : gn_shot_full() && is_store(row, run->formats[i]))
            out[count++] = run->formats[i];
    if (!count) out[count++] = "auto";
    return count;
}

static void add_technique(struct run *run, const char *scene, enum gn_technique technique) {
    const char *formats[FORMATS_MAX], *name = gn_techniques[technique].name;
    const int count = formats_of(run, technique, formats);
    for (int i = 0; i < count; i++) add_job(run, scene, name, formats[i], "mask");
    if (gn_techniques[technique].on_plane) add_job(run, scene, name, "auto", "stencil");
}

static int draw_job(struct job *job, int which) {
    job->failed |= !gn_shot(&job->shots[which], NULL, &job->err, "png", job->scene, job->args);
    return job->failed;
}

struct phase {
    struct run *run;
    int which;
    atomic_int next;
};

static void *draw_jobs(void *argument) {
    struct phase *phase = argument;
    for (int i; (i = atomic_fetch_add(&phase->next, 1)) < phase->run->job_count;)
        draw_job(&phase->run->jobs[i], phase->which);
    return NULL;
}

static void draw_all(struct run *run, bool strict) {
    struct phase phase = {.run = run, .which = strict ? 0 : 1};
    pthread_t threads[THREADS];
    draw_strictly(run, strict);
    for (int i = 0; i < THREADS; i++)
        if (pthread_create(&threads[i], NULL, draw_jobs, &phase)) abort();
    for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
}

static bool judge(const struct job *job) {
    struct gn_difference d;
    if (job->failed) {
        printf("%-32s %s\n", job->name, job->err.text);
        return false;
    }
    bool alike =
        gn_compare(&job->shots[1], &job->shots[0], tolerance, &d) && d.share <= share_allowed;
    printf("%-32s %.3f %% of the pixels alike, at most %.0f/255 apart (at %d, %d)%s\n", job->name,
           100 * (1 - d.share), 255 * d.max, d.worst_x, d.worst_y, alike ? "" : " FAILED");
    char name[80];
    snprintf(name, sizeof name, "angle-%s", job->name);
    for (char *c = name; *c; c++)
        if (*c == ' ') *c = '-';
    if (!alike) gn_compare_save(NULL, name, &job->shots[0], &job->shots[1]);
    return alike;
}

static int compare_pictures(struct run *run, const char *const scenes[], int scene_count) {
    int failures = 0;
    for (int s = 0; s < scene_count; s++)
        for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
            add_technique(run, scenes[s], (enum gn_technique)t);
    /* all that there is beside shadows; the leaves of its trees are all edge */
    add_job(run, "assets/bench/yard.glb", "none", "auto", "mask");
    draw_all(run, true);
    draw_all(run, false);
    for (int i = 0; i < run->job_count; i++) {
        failures += !judge(&run->jobs[i]);
        gn_picture_finish(&run->jobs[i].shots[0]);
        gn_picture_finish(&run->jobs[i].shots[1]);
    }
    return failures;
}

/* ---- truth ---- */

static int check_kind(const struct run *run, enum gn_table_kind kind, const char *folder) {
    static struct gn_table table;
    table = (struct gn_table){.folder = folder};
    for (int i = 0; i < GN_TABLE_SCENES; i++) /* those of the quick form of test_truth */
        table.scenes[i] = i % 3 == 1 || i >= gn_table_kinds[GN_TABLE_POINT].first;
    for (int t = GN_TECHNIQUE_NONE + 1; t < GN_TECHNIQUE_COUNT; t++) {
        const char *formats[FORMATS_MAX], *name = gn_techniques[t].name;
        const int count = formats_of(run, (enum gn_technique)t, formats);
        for (int f = 0; f < count; f++) gn_table_add(&table, name, formats[f], 1024);
        if (gn_techniques[t].on_plane) gn_table_add(&table, name, "stencil", 1024);
    }
    gn_table_keep(&table, kind);
    gn_table_run(&table);
    gn_table_print(&table, stdout);
    int over = gn_table_check(&table, stdout);
    if (over > table.failures) gn_table_save_failures(&table);
    return over;
}

int main(int argc, char **argv) {
    static struct run run;
    struct gn_err err = {0};
    static char generated[3][600];
    static const int numbers[] = {3, 14, 26}; /* a sun, a spot, a point light */
    if (argc != 2) {
        fprintf(stderr, "usage: tool_angle LIBRARY_PATH\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0); /* a log that is cut says how far it came */
    run.library_path = argv[1];
    char *folder = gn_table_scenes(false, &err);
    if (!folder) {
        refuse(err.text);
        return 1;
    }
    if (!is_strict(&run)) return 1;
    for (int i = 0; i < 3; i++)
        snprintf(generated[i], sizeof generated[i], "%s/truth-%02d.glb", folder, numbers[i]);
    const char *const scenes[] = {generated[0], generated[1], generated[2]};
    int failures = compare_pictures(&run, scenes, gn_shot_full() ? 3 : 1);
    draw_strictly(&run, true);
    for (int kind = 0; gn_shot_full() && kind < GN_TABLE_KINDS; kind++)
        failures += check_kind(&run, (enum gn_table_kind)kind, folder);
    json_decref(run.doctor);
    free(folder);
    return failures ? 1 : 0;
}
