#include "cli/score_report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/json.h"

/* ---- means ---- */

struct group {
    enum gn_benchmark_class kind;
    const char *light;
    size_t count;
    struct gn_benchmark_score mean;
};
enum { GROUPS_MAX = 3 * GN_BENCHMARK_CLASS_COUNT };

/* In the order of classes, and of lights: sun, spot, point. Returns how many have pictures. */
static int make_groups(const struct gn_score_report *report, struct group out[GROUPS_MAX]) {
    static const char *const lights[] = {"sun", "spot", "point"};
    struct gn_benchmark_score *of = gn_xalloc(report->row_count, sizeof *of);
    int groups = 0;
    for (int k = 0; k < GN_BENCHMARK_CLASS_COUNT; k++)
        for (int l = 0; l < 3; l++) {
            size_t count = 0;
            for (size_t i = 0; i < report->row_count; i++)
                if ((int)report->rows[i].name.kind == k &&
                    strcmp(report->rows[i].name.light, lights[l]) == 0)
                    of[count++] = report->rows[i].score;
            if (count == 0) continue;
            out[groups] = (struct group){(enum gn_benchmark_class)k, lights[l], count, {{0}}};
            gn_benchmark_mean(of, count, &out[groups++].mean);
        }
    free(of);
    return groups;
}

static bool is_percent(int measure) { return measure < GN_BENCHMARK_PENUMBRA; }
static bool is_slope(int measure) { return measure >= GN_BENCHMARK_TEAR; }

/* After a measure's name, in files. */
static const char *unit_of(int measure) {
    return is_slope(measure) ? "_percent_px" : is_percent(measure) ? "_percent" : "";
}

/* ---- text ---- */

static void print_text_row(const struct gn_benchmark_score *score, FILE *to) {
    for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++)
        if (isnan(score->of[m]))
            fprintf(to, " %9s", "");
        else
            fprintf(to, is_percent(m) ? " %9.4f" : " %9.5f", score->of[m]);
}

static void print_text_head(const char *first, FILE *to) {
    fprintf(to, "%-24s", first);
    for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++)
        fprintf(to, is_slope(m) ? " %6s/px" : " %9s", gn_benchmark_measures[m]);
}

static void print_text(const struct gn_score_report *report, const struct group *groups, int count,
                       FILE *to) {
    print_text_head("picture", to);
    for (size_t i = 0; i < report->row_count; i++) {
        fprintf(to, "\n%-24s", report->rows[i].scene);
        print_text_row(&report->rows[i].score, to);
    }
    fprintf(to, "\n\n");
    print_text_head("class, light, pictures", to);
    for (int g = 0; g < count; g++) {
        const struct gn_benchmark_class_row *row = &gn_benchmark_classes[groups[g].kind];
        fprintf(to, "\n%-7s %-5s %10zu", row->name, groups[g].light, groups[g].count);
        print_text_row(&groups[g].mean, to);
        fprintf(to, "  merit: %s %.4g", gn_benchmark_measures[row->merit],
                groups[g].mean.of[row->merit]);
    }
    fprintf(to,
            "\nacne to wrong in per cent; penumbra to grain: errors of visibility, 0 to 1; tear/px "
            "and grain/px: per cent per pixel; safely lit is %.4g texels from edges\n",
            report->reach_texels);
}

/* ---- CSV ---- */

static void print_csv_row(const char *scene, enum gn_benchmark_class kind, const char *light,
                          size_t pictures, const struct gn_benchmark_score *score, FILE *to) {
    const struct gn_benchmark_class_row *row = &gn_benchmark_classes[kind];
    fprintf(to, "%s,%s,%s,%zu,%s,%.6g", scene, row->name, light, pictures,
            gn_benchmark_measures[row->merit], score->of[row->merit]);
    for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++)
        if (isnan(score->of[m]))
            fputc(',', to);
        else
            fprintf(to, ",%.6g", score->of[m]);
    fputc('\n', to);
}

static void print_csv(const struct gn_score_report *report, const struct group *groups, int count,
                      FILE *to) {
    fputs("scene,class,light,pictures,merit,merit_value", to);
    for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++)
        fprintf(to, ",%s%s", gn_benchmark_measures[m], unit_of(m));
    fputc('\n', to);
    for (size_t i = 0; i < report->row_count; i++) {
        const struct gn_score_row *row = &report->rows[i];
        print_csv_row(row->scene, row->name.kind, row->name.light, 1, &row->score, to);
    }
    for (int g = 0; g < count; g++)
        print_csv_row("mean", groups[g].kind, groups[g].light, groups[g].count, &groups[g].mean,
                      to);
}

/* ---- JSON ---- */

static json_t *make_json_row(enum gn_benchmark_class kind, const char *light,
                             const struct gn_benchmark_score *score) {
    const struct gn_benchmark_class_row *row = &gn_benchmark_classes[kind];
    json_t *object = json_pack("{ss ss ss so}", "class", row->name, "light", light, "merit",
                               gn_benchmark_measures[row->merit], "merit_value",
                               gn_json_make_number(score->of[row->merit]));
    for (int m = 0; object && m < GN_BENCHMARK_MEASURE_COUNT; m++) {
        char key[40];
        if (isnan(score->of[m])) continue;
        snprintf(key, sizeof key, "%s%s", gn_benchmark_measures[m], unit_of(m));
        json_object_set_new(object, key, gn_json_make_number(score->of[m]));
    }
    return object;
}

static bool print_json(const struct gn_score_report *report, const struct group *groups, int count,
                       FILE *to, struct gn_err *err) {
    json_t *pictures = json_array(), *classes = json_array();
    for (size_t i = 0; i < report->row_count; i++) {
        const struct gn_score_row *row = &report->rows[i];
        json_t *object = make_json_row(row->name.kind, row->name.light, &row->score);
        json_object_set_new(object, "scene", gn_json_make_text(row->scene));
        json_array_append_new(pictures, object);
    }
    for (int g = 0; g < count; g++) {
        json_t *object = make_json_row(groups[g].kind, groups[g].light, &groups[g].mean);
        json_object_set_new(object, "pictures", gn_json_make_count(groups[g].count));
        json_array_append_new(classes, object);
    }
    return gn_json_print(json_pack("{so so so}", "reach_texels",
                                   gn_json_make_number(report->reach_texels), "pictures", pictures,
                                   "classes", classes),
                         7, to, err);
}

bool gn_score_print(const struct gn_score_report *report, enum gn_score_form form, FILE *to,
                    struct gn_err *err) {
    struct group groups[GROUPS_MAX];
    const int count = make_groups(report, groups);
    if (form == GN_SCORE_JSON) return print_json(report, groups, count, to, err);
    if (form == GN_SCORE_CSV)
        print_csv(report, groups, count, to);
    else
        print_text(report, groups, count, to);
    return true;
}
