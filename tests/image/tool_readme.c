/* `make readme`: the table of techniques in src/shadow/README.md, measured: tool_readme BUDGETS
 * [TECHNIQUE]. A row for each technique, kind of light and map encoding: errors against truth, of
 * the penumbra too; processor time on the software driver; instructions of the lit program on real
 * GPUs, out of the folder of budgets that tests/gpus writes; bytes. Markdown, on stdout; of one
 * technique if it is named. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/map_format.h"
#include "image/penumbra.h"
#include "image/shot.h"
#include "image/table.h"
#include "shadow/technique.h"

static void quit(const char *what) {
    fprintf(stderr, "tool_readme: %s\n", what);
    exit(1);
}

static const struct {
    const char *name, *shader; /* how the budgets call it */
    enum gn_light_type type;
    int first, last;               /* scenes */
    int first_coarse, last_coarse; /* scenes of coarse meshes */
} lights[] = {{"sun", "DIRECTIONAL", GN_LIGHT_DIRECTIONAL, 0, 11, 30, 32},
              {"spot", "SPOT", GN_LIGHT_SPOT, 12, 23, 33, 35},
              {"point", "POINT", GN_LIGHT_POINT, 24, 29, 36, 38}};
enum { LIGHTS = sizeof lights / sizeof *lights };

static const struct gn_technique_row *technique_of(const struct gn_table_row *row) {
    enum gn_technique technique = GN_TECHNIQUE_NONE;
    gn_technique_find(row->technique, strlen(row->technique), &technique);
    return &gn_techniques[technique];
}

static bool is_stencil(const struct gn_table_row *row) {
    return strcmp(row->format, "stencil") == 0;
}

/* How many points of the lamp a planar mask is the mean of: soft-64; 0: it is not. */
static int points_of(const struct gn_table_row *row) {
    return strncmp(row->format, "soft-", 5) == 0 ? atoi(row->format + 5) : 0;
}

static enum gn_encoding encoding_of(const struct gn_table_row *row) {
    enum gn_encoding encoding = GN_ENCODING_MASK;
    if (is_stencil(row)) return GN_ENCODING_STENCIL;
    if (points_of(row) > 0) return GN_ENCODING_MEAN;
    if (technique_of(row)->reads_both) return GN_ENCODING_DEPTH;
    if (technique_of(row)->filter) return GN_ENCODING_R32UI;
    if (!technique_of(row)->on_plane) find_encoding(row->format, &encoding);
    return encoding;
}

/* What its technique makes of the map; NONE: it reads the map itself. */
static enum gn_moments moments_of(const struct gn_table_row *row) {
    enum gn_moments moments = GN_MOMENTS_NONE;
    if (technique_of(row)->filter) find_moments(row->format, &moments);
    return moments;
}

static const char *format_of(const struct gn_table_row *row) {
    const enum gn_moments moments = moments_of(row);
    if (points_of(row) > 0) return row->format;
    return moments ? gn_moments[moments].name : gn_encodings[encoding_of(row)].name;
}

/* ---- errors ---- */

static double mean_of(const struct gn_table_row *row, int first, int last,
                      double fault(const struct gn_mask_score *)) {
    double sum = 0;
    int count = 0;
    for (int i = first; i <= last && i < GN_TABLE_SCENES; i++) {
        if (!row->measured[i]) continue;
        sum += fault(&row->scores[i]);
        count++;
    }
    return count ? sum / count : NAN;
}

/* Two digits that count. */
static void print_share(double value) {
    if (isnan(value))
        printf(" | ");
    else if (value < .00005)
        printf(" | 0");
    else
        printf(" | %.*f", value < .001 ? 4 : value < .1 ? 3 : 2, value);
}

/* Per cent; what rounds to nothing has no sign. */
static void print_signed(double value, int digits) {
    bool nothing = fabs(value) < 0.5 * pow(10, -digits);
    printf(nothing ? " | %.*f %%" : " | %+.*f %%", digits, nothing ? 0.0 : value);
}

static struct gn_picture shoot(const char *path, const struct gn_table_row *row) {
    struct gn_err err = {0};
    struct gn_picture shot;
    const bool soft = points_of(row) > 0;
    const char *const args[] = {"--aov",
                                "visibility",
                                "--size",
                                "480x360",
                                "--backend",
                                "egl",
                                "--shadow",
                                row->technique,
                                "--map-format",
                                soft ? "auto" : row->format,
                                "--planar",
                                soft ? "soft" : "mask",
                                "--planar-points",
                                soft ? row->format + 5 : "64",
                                NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) quit(err.text);
    return shot;
}

struct penumbra {
    char *path[GN_PENUMBRA_COUNT];
    struct gn_picture truth[GN_PENUMBRA_COUNT];
};

static void make_penumbrae(struct penumbra *p) {
    struct gn_err err = {0};
    for (int i = 0; i < GN_PENUMBRA_COUNT; i++) {
        p->path[i] = gn_penumbra_write(i, &err);
        if (!p->path[i] || !gn_penumbra_truth(&p->truth[i], p->path[i], false, 480, 360, &err))
            quit(err.text);
    }
}

/* Planar shadows are on the scene's plane alone: makes both lit elsewhere. False: there is none. */
static bool keep_plane(const char *path, struct gn_picture *truth, struct gn_picture *shot) {
    struct gn_err err = {0};
    struct gn_truth sight;
    bool any = false;
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene || !gn_truth_load(&sight, path,
                                 &(struct gn_truth_opts){.width_px = truth->width_px,
                                                         .height_px = truth->height_px},
                                 &err))
        quit(err.text);
    for (int i = 0; i < truth->width_px * truth->height_px; i++) {
        const int32_t item = sight.mask.item[i];
        const bool on_plane = item >= 0 && scene->items[item].plane;
        any |= on_plane;
        if (!on_plane) truth->data[i] = shot->data[i * shot->channels] = 1;
    }
    gn_truth_finish(&sight);
    gn_scene_destroy(scene);
    return any;
}

/* RMSE over the penumbrae of this light's scenes, of soft planar ones over those on planes; of a
 * sun also the half-plane's width and energy. */
static void print_penumbra(const struct penumbra *p, const struct gn_table_row *row, int light) {
    double sum = 0;
    int count = 0;
    struct gn_penumbra_edge edge = {0};
    const bool everywhere = !technique_of(row)->on_plane; /* what others see on all surfaces */
    const bool soft = points_of(row) > 0;
    for (int i = 0; i < GN_PENUMBRA_COUNT && (everywhere || soft); i++) {
        if (gn_penumbra_light(i) != lights[light].type) continue;
        struct gn_picture shot = shoot(p->path[i], row), truth;
        struct gn_penumbra_score score;
        gn_picture_init(&truth, shot.width_px, shot.height_px, 1);
        memcpy(truth.data, p->truth[i].data,
               (size_t)shot.width_px * (size_t)shot.height_px * sizeof *truth.data);
        if (everywhere || keep_plane(p->path[i], &truth, &shot)) {
            gn_penumbra_score(&truth, &shot, &score);
            sum += score.soft;
            count++;
        }
        if (i == GN_PENUMBRA_EDGE) gn_penumbra_edge(&truth, &shot, &edge);
        gn_picture_finish(&truth);
        gn_picture_finish(&shot);
    }
    print_share(count ? sum / count : NAN);
    if (light == 0 && (everywhere || soft)) {
        print_signed(100 * (edge.width / edge.width_truth - 1), 0);
        print_signed(100 * edge.energy, 1);
    } else
        printf(" | | ");
}

/* ---- cost ---- */

/* Processor time of S1 (a sun and a spot) over that without shadows. */
static double cost_of(const struct gn_table_row *row) {
    struct gn_err err = {0};
    char list[64];
    const bool soft = points_of(row) > 0;
    snprintf(list, sizeof list, "none,%s", row->technique);
    const char *const argv[] = {gn_shot_program(),
                                "bench",
                                "assets/bench/s1.glb",
                                "--shadow",
                                list,
                                "--map-format",
                                is_stencil(row) || soft ? "auto" : row->format,
                                "--planar",
                                is_stencil(row) ? "stencil"
                                : soft          ? "soft"
                                                : "mask",
                                "--planar-points",
                                soft ? row->format + 5 : "64",
                                "--backend",
                                "egl",
                                "--frames",
                                "60",
                                "--json",
                                NULL};
    struct gn_run *run = malloc(sizeof *run);
    if (!run || !gn_run(run, argv, 300, &err) || run->status) quit("bench failed");
    json_t *json = json_loads(run->out, 0, NULL);
    json_t *runs = json_object_get(json, "runs");
    double none = json_number_value(json_object_get(json_array_get(runs, 0), "cpu_ms"));
    double with = json_number_value(json_object_get(json_array_get(runs, 1), "cpu_ms"));
    json_decref(json);
    free(run);
    return with / none;
}

enum { GPUS = 3 };
static const char *const gpus[GPUS] = {"pi4", "g52", "a618"};

/* Of the fragment stage, from a line "INSTRUCTIONS SPILLS fragment PROGRAM"; 0: there is none. The
 * program has a base texture, Blinn-Phong and a hemisphere. */
static int instructions_of(const char *budgets, const char *gpu, const char *program) {
    char path[200], line[300];
    int instructions = 0;
    snprintf(path, sizeof path, "%s/%s", budgets, gpu);
    FILE *from = fopen(path, "r");
    while (from && !instructions && fgets(line, sizeof line, from)) {
        int count, at = 0;
        line[strcspn(line, "\n")] = 0;
        if (sscanf(line, "%d %*d fragment %n", &count, &at) == 1 && at > 0 &&
            strcmp(line + at, program) == 0)
            instructions = count;
    }
    if (from) fclose(from);
    return instructions;
}

static void print_instructions(const char *budgets, const struct gn_table_row *row, int light) {
    char program[200];
    snprintf(program, sizeof program, "lit BASE_TEXTURE|SPECULAR|HEMISPHERE, %s %s %s",
             lights[light].shader, row->technique,
             points_of(row) > 0 ? gn_encodings[encoding_of(row)].name : format_of(row));
    for (int i = 0; i < GPUS; i++) {
        const int count = instructions_of(budgets, gpus[i], program);
        if (count)
            printf(" | %d", count);
        else
            printf(" | ");
    }
}

static double megabytes_of(const struct gn_table_row *row, int light) {
    enum gn_encoding encoding = encoding_of(row);
    double tiles = light == 2 && !technique_of(row)->on_plane ? 6 : 1;
    unsigned filtered = 2 * gn_moments[moments_of(row)].texel_bytes; /* one on the way */
    if (gn_filters[technique_of(row)->filter].halves) filtered /= 4;
    const unsigned bytes = gn_encodings[encoding].texel_bytes + filtered;
    return bytes * tiles * 1024 * 1024 / 1e6;
}

/* ---- all ---- */

static void print_row(const char *budgets, const struct penumbra *p, const struct gn_table_row *row,
                      int light, double cost) {
    printf("| %s%s%s | %s | %s", light ? "" : "`", light ? "" : row->technique, light ? "" : "`",
           lights[light].name, format_of(row));
    const int first = lights[light].first, last = lights[light].last;
    const int first_coarse = lights[light].first_coarse, last_coarse = lights[light].last_coarse;
    print_share(mean_of(row, first, last, gn_mask_acne));
    print_share(mean_of(row, first_coarse, last_coarse, gn_mask_darkening));
    print_share(mean_of(row, first_coarse, last_coarse, gn_mask_darkened));
    print_share(mean_of(row, first, last, gn_mask_leak));
    print_share(mean_of(row, first, last, gn_mask_gap));
    print_share(mean_of(row, first, last, gn_mask_wrong));
    print_penumbra(p, row, light);
    if (light == 0)
        printf(" | %.2f", cost);
    else
        printf(" | ");
    print_instructions(budgets, row, light);
    printf(" | %.1f |\n", megabytes_of(row, light));
}

/* only: of this technique; NULL: all. */
static void add_rows(struct gn_table *table, const char *only) {
    static const char *const by_hand[] = {"r16f", "depth", "r32ui", "rgba8", "r16f-raw"};
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++) {
        const struct gn_technique_row *row = &gn_techniques[t];
        if (only && strcmp(row->name, only) != 0) continue;
        if (row->on_plane) {
            gn_table_add(table, row->name, "auto", 1024);
            gn_table_add(table, row->name, "stencil", 1024);
        }
        for (int i = 0; i < GN_STORES_MAX && row->stores[i]; i++)
            gn_table_add(table, row->name, gn_moments[row->stores[i]].name, 1024);
        for (int f = 0; f < 5 && !row->on_plane && !row->filter; f++)
            if (t == GN_TECHNIQUE_HARD || f == (row->reads_distance ? 0 : 1))
                gn_table_add(table, row->name, by_hand[f], 1024);
    }
}

/* Their edges are those of the mask where the lamp has no size, as in the scenes of the table. */
static void add_soft_rows(struct gn_table *table, const char *only) {
    if (only && strcmp("planar", only) != 0) return;
    gn_table_add(table, "planar", "soft-64", 1024);
    gn_table_add(table, "planar", "soft-256", 1024);
}

int main(int argc, char **argv) {
    static struct gn_table table;
    static struct penumbra penumbra;
    struct gn_err err = {0};
    if (argc != 2 && argc != 3) quit("usage: tool_readme BUDGETS [TECHNIQUE]");
    const char *only = argc > 2 ? argv[2] : NULL;
    char *folder = gn_table_scenes(false, &err);
    if (!folder) quit(err.text);
    table.folder = folder;
    for (int i = 0; i < GN_TABLE_SCENES; i++) table.scenes[i] = true;
    add_rows(&table, only);
    gn_table_run(&table);
    if (table.failures) quit(table.failure);
    add_soft_rows(&table, only);
    make_penumbrae(&penumbra);
    printf("| technique | light | map | acne | darkening | over 5 %% | leak | gap | wrong | "
           "penumbra | width | energy | time |"
           " Pi 4 | G52 | A618 | MB "
           "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < table.row_count; i++) {
        double cost = cost_of(&table.rows[i]);
        for (int light = 0; light < LIGHTS; light++)
            if (lights[light].first < GN_TABLE_SCENES)
                print_row(argv[1], &penumbra, &table.rows[i], light, cost);
    }
    free(folder);
    return 0;
}
