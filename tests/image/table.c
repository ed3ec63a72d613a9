#include "image/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/file.h"
#include "core/hash.h"
#include "image/drawer.h"
#include "image/shot.h"
#include "shadow/technique.h"
#include "truth/contact.h"

const struct gn_table_range gn_table_kinds[GN_TABLE_KINDS] = {
    [GN_TABLE_SUN_AND_SPOT] = {"directional lights and spots", 0, 23},
    [GN_TABLE_POINT] = {"point lights", 24, 29},
    [GN_TABLE_SMOOTH] = {"coarse meshes with smooth normals: sun, spot, point", 30, 38},
    [GN_TABLE_THIN] = {"rods of 3 cm under spots", 39, 41},
    [GN_TABLE_MIRRORED] = {"boxes of mirrored, uneven scale under spots", 42, 44},
};

/* --- scenes --- */

static bool generate(const char *generator, bool contact, const char *folder, struct gn_err *err) {
    char making[600];
    struct gn_run *run = malloc(sizeof *run);
    if (!run) abort();
    snprintf(making, sizeof making, "%s.%d", folder, (int)getpid());
    mkdir(making, 0777);
    const char *plain[] = {generator, making, NULL};
    const char *contacts[] = {generator, "--contact", making, NULL};
    bool ok = gn_run(run, contact ? contacts : plain, 0, err);
    if (ok && run->status) ok = gn_fail(err, "%s: status %d: %s", generator, run->status, run->err);
    free(run);
    /* Another test may have been faster: then its folder stays and ours is left beside it, unused.
     */
    if (ok && rename(making, folder) && access(folder, R_OK))
        ok = gn_fail(err, "%s cannot be made", folder);
    return ok;
}

char *gn_table_scenes(bool contact, struct gn_err *err) {
    char parent[400], generator[500], *folder = malloc(500);
    struct gn_bytes bytes;
    if (!folder) abort();
    snprintf(parent, sizeof parent, "%s", gn_shot_build());
    char *slash = strrchr(parent, '/');
    snprintf(slash ? slash : parent, 2, slash ? "" : ".");
    snprintf(generator, sizeof generator, "%s/host/make_truth", parent);
    if (!gn_file_read(generator, 0, &bytes, err)) {
        gn_fail_prefix(err, "the generator of the scenes is missing (make %s)", generator);
        free(folder);
        return NULL;
    }
    snprintf(folder, 500, "%s/%s-%08x", parent, contact ? "contact" : "truth",
             (unsigned)gn_hash(GN_HASH_INIT, bytes.data, bytes.size));
    gn_bytes_finish(&bytes);
    if (!access(folder, R_OK) || generate(generator, contact, folder, err)) return folder;
    free(folder);
    return NULL;
}

/* --- measuring --- */

void gn_table_add(struct gn_table *table, const char *technique, const char *format,
                  unsigned map_px) {
    if (table->row_count == GN_TABLE_ROWS) return;
    table->rows[table->row_count++] =
        (struct gn_table_row){.technique = technique, .format = format, .map_px = map_px};
}

bool gn_table_keep(struct gn_table *table, enum gn_table_kind kind) {
    bool any = false;
    table->title = gn_table_kinds[kind].name;
    for (int i = 0; i < GN_TABLE_SCENES; i++) {
        table->scenes[i] &= i >= gn_table_kinds[kind].first && i <= gn_table_kinds[kind].last;
        any |= table->scenes[i];
    }
    return any;
}

/* The options of a row's picture. */
struct row_args {
    char size[32], map[16];
    const char *args[16];
};

static void row_args_init(struct row_args *a, const struct gn_table_row *row, int width_px,
                          int height_px) {
    const bool stencil = strcmp(row->format, "stencil") == 0;
    snprintf(a->size, sizeof a->size, "%dx%d", width_px, height_px);
    snprintf(a->map, sizeof a->map, "%u", row->map_px);
    const char *const args[] = {"--aov",
                                "visibility",
                                "--light",
                                "0",
                                "--size",
                                a->size,
                                "--shadow",
                                row->technique,
                                "--map",
                                a->map,
                                "--map-format",
                                stencil ? "auto" : row->format,
                                "--planar",
                                stencil ? "stencil" : "mask",
                                NULL};
    memcpy(a->args, args, sizeof args);
}

/* As a user would: for contacts, and for what is kept of a failure. */
static bool take_shot(struct gn_picture *shot, const struct gn_table_row *row, const char *scene,
                      int width_px, int height_px, struct gn_err *err) {
    struct row_args a;
    row_args_init(&a, row, width_px, height_px);
    if (!gn_shot(shot, NULL, err, "pfm", scene, a.args)) return false;
    if (shot->width_px == width_px && shot->height_px == height_px) return true;
    gn_picture_finish(shot);
    return gn_fail(err, "%s: the picture is not of the size that was asked for", scene);
}

struct job {
    struct gn_table *table;
    int done, total;
};

static void note_failure(struct job *job, const struct gn_err *err) {
    if (!job->table->failures++)
        snprintf(job->table->failure, sizeof job->table->failure, "%s", err->text);
}

static void note_progress(struct job *job) {
    job->done++;
    if (job->table->progress)
        if (isatty(STDERR_FILENO))
            fprintf(stderr, "\r%d of %d%s", job->done, job->total,
                    job->done < job->total ? "" : "\n");
}

static void cell_name(const struct gn_table_row *row, int scene, char *out, size_t size) {
    snprintf(out, size, "truth-%02d-%s-%s-%u", scene, row->technique, row->format, row->map_px);
}

static bool is_planar(const struct gn_table_row *row) { return !strcmp(row->technique, "planar"); }

/* A scene's truth, and that of planar shadows, which are on its plane alone. */
struct sight {
    struct gn_truth truth;
    uint8_t *planar_lit; /* per pixel */
    uint64_t plane_pixels;
    float *edges, *planar_edges; /* distances to them, per pixel */
};

static bool sight_load(struct sight *sight, const char *path, const struct gn_truth_opts *opts,
                       struct gn_err *err) {
    const struct gn_mask_truth *mask = &sight->truth.mask;
    *sight = (struct sight){0};
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, err);
    if (!scene || !gn_truth_load(&sight->truth, path, opts, err)) {
        gn_scene_destroy(scene);
        return false;
    }
    size_t count = (size_t)mask->width_px * mask->height_px;
    sight->planar_lit = malloc(count);
    if (!sight->planar_lit) abort();
    for (size_t i = 0; i < count; i++) {
        bool on_plane = mask->item[i] >= 0 && scene->items[mask->item[i]].plane;
        sight->planar_lit[i] = mask->lit[i] || !on_plane;
        sight->plane_pixels += on_plane;
    }
    gn_scene_destroy(scene);
    sight->edges = gn_xalloc(2 * count, sizeof *sight->edges);
    sight->planar_edges = sight->edges + count;
    gn_mask_edges(mask, sight->edges);
    struct gn_mask_truth planar = *mask;
    planar.lit = sight->planar_lit;
    gn_mask_edges(&planar, sight->planar_edges);
    return true;
}

static void sight_finish(struct sight *sight) {
    free(sight->planar_lit);
    free(sight->edges);
    gn_truth_finish(&sight->truth);
}

/* How far from a shadow's edge a technique may be less than lit, texels; one more since the map's
 * texels are larger than those of the truth. */
static double reach_of(const struct gn_table_row *row) {
    enum gn_technique technique = GN_TECHNIQUE_NONE;
    gn_technique_find(row->technique, strlen(row->technique), &technique);
    return gn_techniques[technique].radius_texels + 1.0;
}

/* Planar shadows: off the plane all is lit, and shares are of the plane's pixels. */
static void measure(struct job *job, struct gn_drawer *drawer, struct sight *sight,
                    struct gn_table_row *row, int scene) {
    struct gn_truth *truth = &sight->truth;
    struct gn_picture shot;
    struct gn_err err = {0};
    char name[100];
    gn_truth_band(truth, row->map_px);
    gn_truth_safe(truth, row->map_px, reach_of(row));
    struct gn_mask_truth mask = truth->mask;
    struct row_args args;
    row_args_init(&args, row, mask.width_px, mask.height_px);
    gn_picture_init(&shot, mask.width_px, mask.height_px, 4);
    if (!gn_drawer_draw(drawer, args.args, shot.data, &err)) {
        note_failure(job, &err);
        gn_picture_finish(&shot);
        return;
    }
    if (is_planar(row)) mask.lit = sight->planar_lit;
    gn_mask_compare_by(&mask, is_planar(row) ? sight->planar_edges : sight->edges, shot.data,
                       shot.channels, &row->scores[scene]);
    if (is_planar(row)) row->scores[scene].pixels = sight->plane_pixels;
    row->measured[scene] = true;
    cell_name(row, scene, name, sizeof name);
    if (job->table->save) gn_mask_save(job->table->save, name, &mask, &shot);
    gn_picture_finish(&shot);
}

static void scene_path(const struct gn_table *table, int scene, char *out, size_t size) {
    snprintf(out, size, "%s/truth-%02d.glb", table->folder, scene);
}

static void measure_scene(struct job *job, int scene) {
    struct gn_table *table = job->table;
    struct sight sight;
    struct gn_err err = {0};
    char path[600];
    scene_path(table, scene, path, sizeof path);
    if (!sight_load(&sight, path, NULL, &err)) {
        note_failure(job, &err);
        return;
    }
    table->band_px[scene] =
        table->row_count ? gn_truth_band(&sight.truth, table->rows[0].map_px) : 2;
    struct gn_drawer *drawer = gn_drawer_create(path);
    for (int r = 0; r < table->row_count; r++) {
        measure(job, drawer, &sight, &table->rows[r], scene);
        note_progress(job);
    }
    gn_drawer_destroy(drawer);
    const struct gn_mask_score *s = &table->rows[0].scores[scene];
    if (s->pixels)
        table->away[scene] = (double)(s->away_lit + s->away_dark) / (double)(s->lit + s->dark);
    sight_finish(&sight);
}

void gn_table_run(struct gn_table *table) {
    struct job job = {.table = table};
    for (int i = 0; i < GN_TABLE_SCENES; i++)
        if (table->scenes[i]) job.total += table->row_count;
    for (int i = 0; i < GN_TABLE_SCENES; i++)
        if (table->scenes[i]) measure_scene(&job, i);
}

/* --- judging --- */

static const char *const fault_names[GN_FAULT_COUNT] = {
    [GN_FAULT_ACNE] = "acne",         [GN_FAULT_DARKENING] = "darkening",
    [GN_FAULT_DARKENED] = "over 5 %", [GN_FAULT_LEAK] = "leak",
    [GN_FAULT_GAP] = "gap",           [GN_FAULT_WRONG] = "wrong",
};

static double fault_of(const struct gn_mask_score *s, enum gn_fault fault) {
    switch (fault) {
    case GN_FAULT_ACNE: return gn_mask_acne(s);
    case GN_FAULT_DARKENING: return gn_mask_darkening(s);
    case GN_FAULT_DARKENED: return gn_mask_darkened(s);
    case GN_FAULT_LEAK: return gn_mask_leak(s);
    case GN_FAULT_GAP: return gn_mask_gap(s);
    default: return gn_mask_wrong(s);
    }
}

struct gn_fault_sum gn_table_sum(const struct gn_table_row *row, enum gn_fault fault) {
    struct gn_fault_sum sum = {0, 0, -1};
    int count = 0;
    for (int i = 0; i < GN_TABLE_SCENES; i++) {
        if (!row->measured[i]) continue;
        double value = fault_of(&row->scores[i], fault);
        sum.mean += value;
        count++;
        if (sum.worst_scene < 0 || value > sum.worst) {
            sum.worst = value;
            sum.worst_scene = i;
        }
    }
    if (count) sum.mean /= count;
    return sum;
}

static bool is_hard(const struct gn_table_row *row) { return !strcmp(row->technique, "hard"); }

/* What Chebyshev's inequality lets through behind two casters is not all cut off. */
static bool is_bleeding(const struct gn_table_row *row) { return !strcmp(row->technique, "vsm"); }

static bool is_of(const struct gn_table_row *row, enum gn_table_kind kind) {
    int i = 0;
    while (i < GN_TABLE_SCENES && !row->measured[i]) i++;
    return i >= gn_table_kinds[kind].first && i <= gn_table_kinds[kind].last;
}

static const struct gn_limit_row no_limit = {INFINITY, INFINITY};

struct gn_limit_row gn_table_limit(const struct gn_table_row *row, enum gn_fault fault) {
    bool small = row->map_px < 1024;
    if (fault == GN_FAULT_DARKENING) return (struct gn_limit_row){.02, INFINITY};
    if (fault == GN_FAULT_DARKENED) return (struct gn_limit_row){.1, INFINITY};
    /* where the normal is turned away from the light and the face is not, no light arrives that a
     * shadow could take */
    if (is_of(row, GN_TABLE_SMOOTH) && (fault == GN_FAULT_ACNE || fault == GN_FAULT_WRONG))
        return no_limit;
    if (fault == GN_FAULT_LEAK && !small && is_bleeding(row)) return (struct gn_limit_row){.08, .3};
    /* beside such places a filter that needs a wide bias shows some of the shadow lit */
    if (is_of(row, GN_TABLE_SMOOTH) && fault == GN_FAULT_LEAK)
        return small ? (struct gn_limit_row){.06, INFINITY} : (struct gn_limit_row){.03, .3};
    if (fault <= GN_FAULT_LEAK)
        return small ? (struct gn_limit_row){.05, INFINITY} : (struct gn_limit_row){.02, .3};
    if (small || !(is_hard(row) || is_planar(row))) return no_limit;
    /* of a shadow that is three texels wide an edge is a larger share */
    if (fault == GN_FAULT_GAP && is_of(row, GN_TABLE_THIN)) return (struct gn_limit_row){5, 7};
    return fault == GN_FAULT_GAP ? (struct gn_limit_row){3, 5}
                                 : (struct gn_limit_row){.15, INFINITY};
}

static bool is_over(const struct gn_table_row *row, enum gn_fault fault) {
    struct gn_fault_sum sum = gn_table_sum(row, fault);
    struct gn_limit_row limit = gn_table_limit(row, fault);
    return sum.mean > limit.mean || sum.worst > limit.worst;
}

void gn_table_print(const struct gn_table *table, FILE *to) {
    if (table->title) fprintf(to, "%s\n", table->title);
    fprintf(to, "per cent: mean over the scenes, worst scene (its number); ! over a limit\n");
    fprintf(to, "%-6s %-9s %5s | %-23s | %-23s | %-23s | %-23s | %-23s | %-23s\n", "", "map", "px",
            "acne: lit but dark", "darkening of safely lit", "darkened by over 5 %",
            "leak: dark but lit", "gap: the same, edges in", "wrong: all, edges in");
    for (int r = 0; r < table->row_count; r++) {
        const struct gn_table_row *row = &table->rows[r];
        fprintf(to, "%-6s %-9s %5u", row->technique, row->format, row->map_px);
        for (int f = 0; f < GN_FAULT_COUNT; f++) {
            struct gn_fault_sum sum = gn_table_sum(row, f);
            if (sum.worst_scene < 0)
                fprintf(to, " | %-23s", "not measured");
            else
                fprintf(to, " | %7.4f  %7.4f (%02d) %s", sum.mean, sum.worst, sum.worst_scene,
                        is_over(row, f) ? "!" : " ");
        }
        fprintf(to, "\n");
    }
    double band = 0, away = 0, widest = 0;
    int count = 0;
    for (int i = 0; i < GN_TABLE_SCENES; i++) {
        if (!table->scenes[i]) continue;
        band += table->band_px[i];
        away += table->away[i];
        widest = fmax(widest, table->band_px[i]);
        count++;
    }
    if (count)
        fprintf(
            to,
            "%d scenes; edges are %.2f px wide to each side (mean; widest scene %.2f); %.1f %% of "
            "the pixels are away from them\n",
            count, band / count, widest, 100 * away / count);
}

void gn_table_print_csv(const struct gn_table *table, bool head, FILE *to) {
    static const char *const faults[GN_FAULT_COUNT] = {"acne", "darkening", "darkened",
                                                       "leak", "gap",       "wrong"};
    if (head)
        fprintf(to, "kind,technique,map_format,map_px,fault,mean_percent,worst_percent,"
                    "worst_scene,over\n");
    for (int r = 0; r < table->row_count; r++)
        for (int f = 0; f < GN_FAULT_COUNT; f++) {
            const struct gn_table_row *row = &table->rows[r];
            const struct gn_fault_sum sum = gn_table_sum(row, f);
            if (sum.worst_scene < 0) continue;
            fprintf(to, "\"%s\",%s,%s,%u,%s,%.6f,%.6f,%d,%s\n", table->title ? table->title : "",
                    row->technique, row->format, row->map_px, faults[f], sum.mean, sum.worst,
                    sum.worst_scene, is_over(row, f) ? "yes" : "no");
        }
}

int gn_table_check(const struct gn_table *table, FILE *to) {
    int over = 0;
    if (table->failures)
        fprintf(to, "%d pictures did not come about, the first: %s\n", table->failures,
                table->failure);
    for (int r = 0; r < table->row_count; r++)
        for (int f = 0; f < GN_FAULT_COUNT; f++) {
            const struct gn_table_row *row = &table->rows[r];
            if (!is_over(row, f)) continue;
            struct gn_fault_sum sum = gn_table_sum(row, f);
            struct gn_limit_row limit = gn_table_limit(row, f);
            fprintf(to, "%s %s %u: %s is %.4f %% (limit %g), worst scene truth-%02d %.4f %%",
                    row->technique, row->format, row->map_px, fault_names[f], sum.mean, limit.mean,
                    sum.worst_scene, sum.worst);
            if (isfinite(limit.worst)) fprintf(to, " (limit %g)", limit.worst);
            fprintf(to, "\n");
            over++;
        }
    return over + table->failures;
}

static void save_cell(const struct gn_table *table, const struct gn_table_row *row, int scene) {
    struct sight sight;
    struct gn_picture shot;
    struct gn_err err = {0};
    char path[600], name[100];
    scene_path(table, scene, path, sizeof path);
    if (!sight_load(&sight, path, NULL, &err)) return;
    gn_truth_band(&sight.truth, row->map_px);
    struct gn_mask_truth mask = sight.truth.mask;
    if (is_planar(row)) mask.lit = sight.planar_lit;
    if (take_shot(&shot, row, path, mask.width_px, mask.height_px, &err)) {
        cell_name(row, scene, name, sizeof name);
        gn_mask_save(NULL, name, &mask, &shot);
        gn_picture_finish(&shot);
    }
    sight_finish(&sight);
}

void gn_table_save_failures(const struct gn_table *table) {
    for (int r = 0; r < table->row_count; r++) {
        int last = -1;
        for (int f = 0; f < GN_FAULT_COUNT; f++) {
            if (!is_over(&table->rows[r], f)) continue;
            int scene = gn_table_sum(&table->rows[r], f).worst_scene;
            if (scene != last) save_cell(table, &table->rows[r], scene);
            last = scene;
        }
    }
}

/* --- contacts --- */

static bool measure_contact(const char *path, const struct gn_table_row *row,
                            struct gn_contact *contact, struct gn_truth *truth, FILE *to) {
    struct gn_picture shot;
    struct gn_err err = {0};
    const struct gn_mask_truth *mask = &truth->mask;
    if (!take_shot(&shot, row, path, mask->width_px, mask->height_px, &err)) {
        fprintf(to, "%s\n", err.text);
        return false;
    }
    gn_contact_compare(truth, shot.data, shot.channels, row->map_px, contact);
    double limit = is_hard(row) ? 1.5 : 2.5;
    bool ok = contact->contacts > 50 && contact->worst <= limit;
    fprintf(
        to,
        "%-6s %-9s %5u | %s: gap at %d contact pixels %.2f texels, 99 %% under %.2f, worst %.2f "
        "(limit %g)%s\n",
        row->technique, row->format, row->map_px, strrchr(path, '/') + 1, contact->contacts,
        contact->mean, contact->p99, contact->worst, limit, ok ? "" : " !");
    if (!ok) {
        char name[100];
        snprintf(name, sizeof name, "%.20s-%s-%s", strrchr(path, '/') + 1, row->technique,
                 row->format);
        gn_mask_save(NULL, name, mask, &shot);
    }
    gn_picture_finish(&shot);
    return ok;
}

int gn_table_contacts(const char *folder, const struct gn_table_row *rows, int row_count,
                      FILE *to) {
    static const char *const scenes[] = {"contact-sun.glb", "contact-spot.glb"};
    int failures = 0;
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        /* Larger than the rest, so that a pixel is smaller than a texel; too large to keep. */
        const struct gn_truth_opts opts = {.width_px = 1920, .height_px = 1440, .no_cache = true};
        struct gn_truth truth;
        struct gn_err err = {0};
        char path[600];
        snprintf(path, sizeof path, "%s/%s", folder, scenes[s]);
        if (!gn_truth_load(&truth, path, &opts, &err)) {
            fprintf(to, "%s\n", err.text);
            failures += row_count;
            continue;
        }
        gn_truth_band(&truth, 1024);
        for (int r = 0; r < row_count; r++) {
            struct gn_contact contact;
            failures += !measure_contact(path, &rows[r], &contact, &truth, to);
        }
        gn_truth_finish(&truth);
    }
    return failures;
}
