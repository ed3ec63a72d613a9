#include "cli/selftest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/embedded.h"
#include "core/json.h"
#include "frame/frame.h"

#define LIT  1
#define EDGE 2

struct truth {
    uint32_t width_px, height_px;
    uint8_t *pixels; /* LIT, EDGE; malloc'ed */
};

/* ---- embedded files ------------------------------------------------------------ */

static bool load_truth(const char *scene, struct truth *truth, struct gn_err *err) {
    char path[64];
    snprintf(path, sizeof path, "selftest/%s.truth", scene);
    const struct gn_embedded *file = gn_embedded_find(path);
    size_t all = 1, done = 0;
    if (file && file->size >= 12 && memcmp(file->data, "gntruth1", 8) == 0) {
        const uint8_t *data = file->data;
        *truth = (struct truth){data[8] | data[9] << 8, data[10] | data[11] << 8, NULL};
        all = (size_t)truth->width_px * truth->height_px;
        truth->pixels = gn_xalloc(all, 1);
        for (size_t i = 12; i < file->size; i++)
            for (int run = data[i] >> 2; run >= 0 && done < all; run--)
                truth->pixels[done++] = data[i] & (LIT | EDGE);
    }
    if (done == all) return true;
    free(truth->pixels);
    truth->pixels = NULL;
    return gn_fail(err, "self-test: this build has no whole %s inside", path);
}

/* ---- drawing and counting ------------------------------------------------------------------ */

struct desk { /* one scene being tested */
    struct gn_gl *gl;
    struct truth truth;
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_frame *frame;
    float *picture; /* RGBA */
};

static struct gn_selftest_count count_wrong(const struct desk *desk) {
    size_t all = (size_t)desk->truth.width_px * desk->truth.height_px;
    size_t away = 0, away_wrong = 0, wrong = 0;
    for (size_t i = 0; i < all; i++) {
        bool lit = desk->truth.pixels[i] & LIT, edge = desk->truth.pixels[i] & EDGE;
        bool differs = (desk->picture[4 * i] >= 0.5f) != lit; /* NaN is dark */
        away += !edge;
        away_wrong += !edge && differs;
        wrong += differs;
    }
    return (struct gn_selftest_count){100.0 * (double)away_wrong / (double)(away ? away : 1),
                                      100.0 * (double)wrong / (double)all};
}

static bool draw_row(const struct desk *desk, const struct gn_selftest_row *row,
                     struct gn_err *err) {
    const struct gn_frame_opts opts = {
        .output.width_px = desk->truth.width_px,
        .output.height_px = desk->truth.height_px,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = row->technique,
                       .map_px = GN_SELFTEST_MAP_PX,
                       .map_format = GN_MAP_FORMAT(row->encoding, row->moments)},
        .debug.aov = GN_AOV_VISIBILITY,
    };
    const struct gn_plan *plan = gn_frame_build(desk->frame, &desk->pose, &opts, NULL);
    return gn_gl_prepare(desk->gl, plan, err) && gn_gl_run(desk->gl, plan, NULL, err) &&
           gn_gl_read_f32(desk->gl, desk->picture, err);
}

static bool run_scene(struct gn_selftest *test, uint32_t scene, struct gn_gl *gl,
                      struct gn_err *err) {
    struct desk desk = {.gl = gl};
    if (!load_truth(test->scenes[scene], &desk.truth, err)) return false;
    test->width_px = desk.truth.width_px;
    test->height_px = desk.truth.height_px;
    char path[64];
    snprintf(path, sizeof path, "selftest/%s.glb", test->scenes[scene]);
    const struct gn_embedded *file = gn_embedded_find(path);
    desk.scene = gn_scene_load_bytes(path, file->data, file->size, NULL, NULL, err);
    const bool ok = desk.scene && gn_gl_load(gl, desk.scene, err);
    if (ok) {
        gn_pose_init(&desk.pose, desk.scene, GN_POSE_DEFAULT);
        desk.frame = gn_frame_create(desk.scene, gn_gl_caps(gl));
        desk.picture = gn_xalloc((size_t)test->width_px * test->height_px, 4 * sizeof(float));
        for (uint32_t i = 0; i < test->row_count; i++, test->done++) {
            struct gn_selftest_row *row = &test->rows[i];
            struct gn_err why = {0};
            if (draw_row(&desk, row, &why))
                row->scenes[scene] = count_wrong(&desk);
            else if (!row->failure[0])
                snprintf(row->failure, sizeof row->failure, "%.199s", why.text);
        }
        free(desk.picture);
        gn_frame_destroy(desk.frame);
        gn_pose_finish(&desk.pose);
    }
    gn_scene_destroy(desk.scene);
    free(desk.truth.pixels);
    return ok;
}

static void add_row(struct gn_selftest *test, enum gn_technique technique,
                    enum gn_encoding encoding, enum gn_moments moments) {
    struct gn_selftest_row *row = &test->rows[test->row_count++];
    *row =
        (struct gn_selftest_row){.technique = technique, .encoding = encoding, .moments = moments};
    for (int i = 0; i < GN_SELFTEST_SCENES; i++)
        row->scenes[i] = (struct gn_selftest_count){NAN, NAN};
}

static const char *format_of(const struct gn_selftest_row *row) {
    return row->moments ? gn_moments[row->moments].name : gn_encodings[row->encoding].name;
}

bool gn_selftest_run(struct gn_selftest *test, struct gn_gl *gl, struct gn_err *err) {
    *test = (struct gn_selftest){0};
    for (const struct gn_embedded *e = gn_embedded_table; e->name; e++) {
        static const char folder[] = "selftest/"; /* "selftest/box.glb" is of the scene "box" */
        const size_t length = strlen(e->name), skip = sizeof folder - 1;
        if (test->scene_count == GN_SELFTEST_SCENES || strncmp(e->name, folder, skip) != 0 ||
            strcmp(e->name + length - 4, ".glb") != 0)
            continue;
        snprintf(test->scenes[test->scene_count++], sizeof test->scenes[0], "%.*s",
                 (int)(length - skip - 4), e->name + skip);
    }
    /* The techniques in every format of map that the GPU has. The truth has the shadows on all
     * surfaces: planar ones are not in it. */
    const uint32_t encodings = gn_caps_encodings(gn_gl_caps(gl));
    const uint32_t moments = gn_caps_moments(gn_gl_caps(gl));
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) {
        const enum gn_technique t = (enum gn_technique)i;
        const struct gn_technique_row *technique = &gn_techniques[i];
        if (gn_technique_filters_map(t)) {
            for (int k = 0; k < GN_STORES_MAX && technique->stores[k]; k++)
                if (moments & 1u << technique->stores[k])
                    add_row(test, t, GN_ENCODING_AUTO, (enum gn_moments)technique->stores[k]);
        } else if (technique->file && !technique->on_plane) {
            for (int e = 0; e < GN_ENCODING_COUNT; e++)
                if (encodings & 1u << e) add_row(test, t, (enum gn_encoding)e, GN_MOMENTS_NONE);
        }
    }
    test->all = test->row_count * test->scene_count;
    if (!test->all) return gn_fail(err, "self-test: this build has no scenes inside");
    for (uint32_t i = 0; i < test->scene_count; i++)
        if (!run_scene(test, i, gl, err)) return false;
    return true;
}

/* ---- results ------------------------------------------------------------------------------- */

struct sum { /* over the scenes of a row */
    double mean, worst;
    uint32_t worst_scene;
};

/* away: of the pixels away from edges; else of all. */
static struct sum sum_scenes(const struct gn_selftest *test, const struct gn_selftest_row *row,
                             bool away) {
    struct sum s = {0};
    for (uint32_t i = 0; i < test->scene_count; i++) {
        double share = away ? row->scenes[i].away : row->scenes[i].wrong;
        s.mean += share / test->scene_count;
        if (share <= s.worst) continue; /* NAN is worst */
        s.worst = share;
        s.worst_scene = i;
        if (isnan(share)) break;
    }
    if (isnan(s.worst)) s.mean = NAN;
    return s;
}

static bool row_passes(const struct gn_selftest *test, const struct gn_selftest_row *row) {
    return !row->failure[0] && sum_scenes(test, row, true).worst <= GN_SELFTEST_AWAY_MAX &&
           sum_scenes(test, row, false).worst <= GN_SELFTEST_WRONG_MAX;
}

uint32_t gn_selftest_failures(const struct gn_selftest *test) {
    uint32_t failures = 0;
    for (uint32_t i = 0; i < test->row_count; i++) failures += !row_passes(test, &test->rows[i]);
    return failures;
}

void gn_selftest_print(const struct gn_selftest *test, FILE *to) {
    fprintf(to, "\nSelf-test: %u scenes at %ux%u with maps of %d px, wrong pixels in %%\n",
            test->scene_count, test->width_px, test->height_px, GN_SELFTEST_MAP_PX);
    fprintf(to, "  %-10s %-12s %-6s %7s %7s  %-9s %7s %7s\n", "technique", "map", "", "away",
            "worst", "scene", "all", "worst");
    for (uint32_t i = 0; i < test->row_count; i++) {
        const struct gn_selftest_row *row = &test->rows[i];
        const struct sum away = sum_scenes(test, row, true);
        const struct sum wrong = sum_scenes(test, row, false);
        fprintf(to, "  %-10s %-12s", gn_techniques[row->technique].name, format_of(row));
        if (row->failure[0])
            fprintf(to, " FAIL   %s\n", row->failure);
        else
            fprintf(to, " %-6s %7.3f %7.3f  %-9s %7.2f %7.2f  %s\n",
                    row_passes(test, row) ? "PASS" : "FAIL", away.mean, away.worst,
                    away.worst > 0 ? test->scenes[away.worst_scene] : "-", wrong.mean, wrong.worst,
                    test->scenes[wrong.worst_scene]);
    }
    uint32_t failures = gn_selftest_failures(test);
    fprintf(to, "  %u of %u pass; limits for the worst scene: %g away from edges, %g of all\n",
            test->row_count - failures, test->row_count, GN_SELFTEST_AWAY_MAX,
            GN_SELFTEST_WRONG_MAX);
}

static json_t *sum_json(const struct gn_selftest *test, struct sum s) {
    return json_pack("{so so ss}", "mean", gn_json_make_number(s.mean), "worst",
                     gn_json_make_number(s.worst), "scene", test->scenes[s.worst_scene]);
}

json_t *gn_selftest_json(const struct gn_selftest *test) {
    json_t *scenes = json_array(), *rows = json_array();
    uint32_t failures = gn_selftest_failures(test);
    for (uint32_t i = 0; i < test->scene_count; i++)
        json_array_append_new(scenes, json_string(test->scenes[i]));
    for (uint32_t i = 0; i < test->row_count; i++) {
        const struct gn_selftest_row *row = &test->rows[i];
        json_array_append_new(
            rows, json_pack("{ss ss sb ss? so so}", "technique", gn_techniques[row->technique].name,
                            "map_format", format_of(row), "pass", row_passes(test, row), "failure",
                            row->failure[0] ? row->failure : NULL, "away",
                            sum_json(test, sum_scenes(test, row, true)), "wrong",
                            sum_json(test, sum_scenes(test, row, false))));
    }
    return json_pack("{s[ii] si s{sf sf} so so si si}", "size_px", (int)test->width_px,
                     (int)test->height_px, "map_px", GN_SELFTEST_MAP_PX, "limits", "away",
                     GN_SELFTEST_AWAY_MAX, "wrong", GN_SELFTEST_WRONG_MAX, "scenes", scenes, "rows",
                     rows, "passed", (int)(test->row_count - failures), "failed", (int)failures);
}
