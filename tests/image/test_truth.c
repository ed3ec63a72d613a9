/* Shadows against ray-traced truth, with the limits that the project has set itself: 30 scenes and
 * a few rows, or with GN_FULL=1 all scenes, techniques, encodings and map sizes. A failure
 * leaves shot, truth and diff in build/failures. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "image/table.h"
#include "shadow/technique.h"

/* All that compare a fixed kernel of texels. */
static void add_kernels(struct gn_table *table, unsigned map_px) {
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
        if (gn_techniques[t].one_code) gn_table_add(table, gn_techniques[t].name, "depth", map_px);
}

static void quick_rows(struct gn_table *table) {
    for (int i = 0; i < GN_TABLE_SCENES; i++)
        table->scenes[i] = i % 3 == 1 || i == 18 || i >= gn_table_kinds[GN_TABLE_POINT].first;
    gn_table_add(table, "hard", "r16f", 1024);
    gn_table_add(table, "hard", "depth", 1024);
    add_kernels(table, 1024);
    gn_table_add(table, "planar", "auto", 1024);
    gn_table_add(table, "msm", "auto", 1024);
}

/* Adds a technique with the map formats that its limits hold for. Those that are soft by a filtered
 * map are measured with the light's size, in test_penumbra; white is noise. */
static void add_technique(struct gn_table *table, enum gn_technique technique, unsigned map_px) {
    static const char *const formats[] = {"r16f", "depth", "r16f-raw", "r32ui", "rgba8"};
    const struct gn_technique_row *row = &gn_techniques[technique];
    const bool is_filtered = gn_technique_filters_map(technique);
    if (!row->file || technique == GN_TECHNIQUE_WHITE || (row->soft && is_filtered)) return;
    if (row->on_plane || is_filtered)
        gn_table_add(table, row->name, "auto", map_px);
    else
        for (int f = 0; f < (technique == GN_TECHNIQUE_HARD ? 5 : 2); f++)
            gn_table_add(table, row->name, formats[f], map_px);
}

/* A tile of a point light sees 90 degrees, whatever there is: 256 texels are too few for limits. */
static void full_rows(struct gn_table *table, enum gn_table_kind kind) {
    static const unsigned maps[] = {1024, 256}, further_maps[] = {512, 2048, 4096};
    for (int i = 0; i < GN_TABLE_SCENES; i++) table->scenes[i] = true;
    for (int m = 0; m < (kind == GN_TABLE_POINT ? 1 : 2); m++)
        for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
            add_technique(table, (enum gn_technique)t, maps[m]);
    for (int m = kind == GN_TABLE_POINT ? 1 : 0; m < 3; m++) add_kernels(table, further_maps[m]);
}

/* A spoilt table must not pass: the truth of one scene turned round counts as acne and as leaks. */
static bool notices_a_wrong_picture(const char *folder) {
    static struct gn_table table;
    struct gn_truth truth;
    struct gn_err err = {0};
    char path[600];
    snprintf(path, sizeof path, "%s/truth-01.glb", folder);
    if (!gn_truth_load(&truth, path, NULL, &err)) {
        printf("%s\n", err.text);
        return false;
    }
    struct gn_picture shot;
    gn_picture_init(&shot, truth.mask.width_px, truth.mask.height_px, 1);
    for (int i = 0; i < shot.width_px * shot.height_px; i++) shot.data[i] = !truth.mask.lit[i];
    gn_table_add(&table, "hard", "depth", 1024);
    gn_mask_compare(&truth.mask, shot.data, shot.channels, &table.rows[0].scores[1]);
    table.rows[0].measured[1] = table.scenes[1] = true;
    FILE *nowhere = fopen("/dev/null", "w");
    int over = nowhere ? gn_table_check(&table, nowhere) : 0;
    if (nowhere) fclose(nowhere);
    gn_picture_finish(&shot);
    gn_truth_finish(&truth);
    return over == GN_FAULT_COUNT;
}

static int check_contacts(const struct gn_table *table) {
    struct gn_table_row rows[GN_TABLE_ROWS];
    struct gn_err err = {0};
    int count = 0;
    for (int i = 0; i < table->row_count; i++)
        if (table->rows[i].map_px == 1024 && (!strcmp(table->rows[i].technique, "hard") ||
                                              !strcmp(table->rows[i].technique, "pcf3")))
            rows[count++] = table->rows[i];
    char *folder = gn_table_scenes(true, &err);
    if (!folder) {
        printf("%s\n", err.text);
        return 1;
    }
    int over = gn_table_contacts(folder, rows, count, stdout);
    free(folder);
    return over;
}

static int check_kind(struct gn_table *table, enum gn_table_kind kind, const char *folder) {
    *table = (struct gn_table){.folder = folder};
    if (gn_shot_full())
        full_rows(table, kind);
    else
        quick_rows(table);
    gn_table_keep(table, kind);
    gn_table_run(table);
    gn_table_print(table, stdout);
    int over = gn_table_check(table, stdout);
    if (over > table->failures) gn_table_save_failures(table);
    printf("\n");
    return over;
}

int main(void) {
    static struct gn_table table;
    struct gn_err err = {0};
    char *folder = gn_table_scenes(false, &err);
    int over = 0;
    if (!folder) {
        printf("%s\n", err.text);
        return 1;
    }
    if (!notices_a_wrong_picture(folder)) {
        printf("the comparison does not notice a picture that is all wrong\n");
        return 1;
    }
    for (int kind = 0; kind < GN_TABLE_KINDS; kind++)
        over += check_kind(&table, (enum gn_table_kind)kind, folder);
    over += check_contacts(&table);
    free(folder);
    return over ? 1 : 0;
}
