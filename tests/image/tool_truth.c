/* `make truth`: every technique and map encoding against ray-traced truth, over the generated
 * scenes, as a table for each kind of light. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "image/soft.h"
#include "image/table.h"
#include "shadow/technique.h"

static const char usage[] =
    "usage: tool_truth [options]\n"
    "  --scenes A-B[,C..]  which of 0-44 (all; 24-29: point lights;\n"
    "                      30-38: coarse meshes with smooth normals; 39-41: thin rods,\n"
    "                      42-44: mirrored, uneven scale, both under spots)\n"
    "  --technique LIST    of hard,pcf,pcf2,.. (all)\n"
    "  --format LIST       of depth,r16f,r16f-raw,r32ui,rgba8 (hard: all; others: depth,r16f, or\n"
    "                      auto where the map is filtered; planar has its own: a mask, as auto,\n"
    "                      and stencil)\n"
    "  --map LIST          of sizes in pixels (1024,256)\n"
    "  --save DIR          shot, truth and diff of every cell, as PNG\n"
    "  --no-contact        leave out the gaps at contacts\n"
    "  --no-soft           leave out how torn soft shadows look\n"
    "  --only-soft         that alone\n"
    "  --csv FILE          write the figures as CSV, too\n"
    "  --limits            exit 1 if a limit is passed\n";

struct arguments {
    char *scenes, *techniques, *formats, *maps, *save, *csv;
    bool contact, limits, soft, hard;
};

static int refuse(const char *what) {
    fprintf(stderr, "tool_truth: %s\n%s", what, usage);
    return 2;
}

static bool parse(int argc, char **argv, struct arguments *a) {
    struct {
        const char *name;
        char **value;
    } const valued[] = {{"--scenes", &a->scenes},  {"--technique", &a->techniques},
                        {"--format", &a->formats}, {"--map", &a->maps},
                        {"--save", &a->save},      {"--csv", &a->csv}};
    for (int i = 1; i < argc; i++) {
        bool known = true;
        if (!strcmp(argv[i], "--limits"))
            a->limits = true;
        else if (!strcmp(argv[i], "--no-contact"))
            a->contact = false;
        else if (!strcmp(argv[i], "--no-soft"))
            a->soft = false;
        else if (!strcmp(argv[i], "--only-soft"))
            a->hard = a->contact = false;
        else
            known = false;
        for (size_t k = 0; !known && k < sizeof valued / sizeof *valued; k++)
            if (!strcmp(argv[i], valued[k].name) && i + 1 < argc) {
                *valued[k].value = argv[++i];
                known = true;
            }
        if (!known) return false;
    }
    return true;
}

static bool choose_scenes(struct gn_table *table, const char *list) {
    char *end;
    for (const char *p = list; *p; p = *end ? end + 1 : end) {
        long from = strtol(p, &end, 10), to = from;
        if (end == p) return false;
        if (*end == '-') to = strtol(end + 1, &end, 10);
        if (from < 0 || to < from || to >= GN_TABLE_SCENES || (*end && *end != ',')) return false;
        for (long i = from; i <= to; i++) table->scenes[i] = true;
    }
    return true;
}

/* Splits a list at its commas, in place. */
static int split(char *list, const char *out[], int room) {
    int count = 0;
    for (char *word = strtok(list, ","); word && count < room; word = strtok(NULL, ","))
        out[count++] = word;
    return count;
}

/* As the techniques page has them: hard in every encoding, what reads a map itself in two, and what
 * filters a map in the one that it takes itself. */
static bool add_technique(struct gn_table *table, const char *name, const char *const *given,
                          int given_count, unsigned map_px) {
    static const char *const all[] = {"depth", "r16f", "r16f-raw", "r32ui", "rgba8"};
    enum gn_technique technique;
    if (!gn_technique_find(name, strlen(name), &technique) || technique == GN_TECHNIQUE_NONE)
        return false;
    const struct gn_technique_row *row = &gn_techniques[technique];
    if (row->on_plane || (row->filter && !given_count)) {
        gn_table_add(table, row->name, "auto", map_px);
        if (row->on_plane) gn_table_add(table, row->name, "stencil", map_px);
        return true;
    }
    const int count = given_count ? given_count : technique == GN_TECHNIQUE_HARD ? 5 : 2;
    for (int f = 0; f < count; f++)
        gn_table_add(table, row->name, strdup(given_count ? given[f] : all[f]), map_px);
    return true;
}

static bool add_rows(struct gn_table *table, const struct arguments *a, unsigned map_px) {
    const char *formats[8], *techniques[GN_TECHNIQUE_COUNT];
    char format_list[200], technique_list[200];
    snprintf(format_list, sizeof format_list, "%s", a->formats ? a->formats : "");
    snprintf(technique_list, sizeof technique_list, "%s", a->techniques ? a->techniques : "");
    const int format_count = split(format_list, formats, 8);
    int technique_count = split(technique_list, techniques, GN_TECHNIQUE_COUNT);
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT && !a->techniques; t++)
        techniques[technique_count++] = gn_techniques[t].name;
    for (int t = 0; t < technique_count; t++)
        if (!add_technique(table, techniques[t], formats, format_count, map_px)) return false;
    return true;
}

static bool add_maps(struct gn_table *table, const struct arguments *a) {
    char maps[200];
    const char *sizes[8];
    snprintf(maps, sizeof maps, "%s", a->maps ? a->maps : "1024,256");
    int count = split(maps, sizes, 8);
    for (int i = 0; i < count; i++) {
        long px = strtol(sizes[i], NULL, 10);
        if (px < 1 || px > 16384) return false;
        if (!add_rows(table, a, (unsigned)px)) return false;
    }
    return true;
}

/* hard and pcf3 as asked for, on the larger map. */
static int contacts(const struct gn_table *table, struct gn_err *err) {
    struct gn_table_row rows[GN_TABLE_ROWS];
    int count = 0;
    for (int i = 0; i < table->row_count; i++)
        if (table->rows[i].map_px >= 1024 && (!strcmp(table->rows[i].technique, "hard") ||
                                              !strcmp(table->rows[i].technique, "pcf3")))
            rows[count++] = table->rows[i];
    if (!count) return 0;
    char *folder = gn_table_scenes(true, err);
    if (!folder) return -1;
    int over = gn_table_contacts(folder, rows, count, stdout);
    free(folder);
    return over;
}

static bool fill(struct gn_table *table, const struct arguments *a, const char *folder) {
    *table = (struct gn_table){.folder = folder, .save = a->save, .progress = true};
    return choose_scenes(table, a->scenes ? a->scenes : "0-44") && add_maps(table, a);
}

/* A table for each kind of light; the faults of all. */
static int measure(struct gn_table *table, const struct arguments *a, const char *folder,
                   FILE *csv) {
    int over = 0, failures = 0;
    bool head = true;
    for (int kind = 0; kind < GN_TABLE_KINDS; kind++) {
        fill(table, a, folder);
        if (!gn_table_keep(table, (enum gn_table_kind)kind)) continue;
        gn_table_run(table);
        gn_table_print(table, stdout);
        if (csv) gn_table_print_csv(table, head, csv);
        head = false;
        over += gn_table_check(table, stdout);
        failures += table->failures;
        printf("\n");
    }
    return a->limits ? over : failures;
}

/* Those asked for, else all that are soft. Returns how many pictures failed. */
static int print_soft(const struct arguments *a, FILE *csv) {
    const char *techniques[GN_TECHNIQUE_COUNT];
    char list[200];
    snprintf(list, sizeof list, "%s", a->techniques ? a->techniques : "");
    int count = split(list, techniques, GN_TECHNIQUE_COUNT);
    for (int t = 0; t < GN_TECHNIQUE_COUNT && !a->techniques; t++)
        if (gn_techniques[t].soft) techniques[count++] = gn_techniques[t].name;
    const int failures = gn_soft_table(techniques, count, 480, 360, stdout, csv);
    printf("\n");
    return failures;
}

int main(int argc, char **argv) {
    static struct gn_table table;
    struct arguments a = {.contact = true, .soft = true, .hard = true};
    struct gn_err err = {0};
    if (!parse(argc, argv, &a)) return refuse("wrong options");
    if (!fill(&table, &a, NULL))
        return refuse("wrong list of scenes or techniques, or wrong map size");
    char *folder = gn_table_scenes(false, &err);
    if (!folder) {
        fprintf(stderr, "tool_truth: %s\n", err.text);
        return 1;
    }
    FILE *csv = a.csv ? fopen(a.csv, "w") : NULL;
    if (a.csv && !csv) {
        fprintf(stderr, "tool_truth: %s: cannot be written\n", a.csv);
        return 1;
    }
    int over = a.hard ? measure(&table, &a, folder, csv) : 0;
    if (!a.hard && csv) gn_table_print_csv(&table, true, csv); /* the line of names */
    if (a.soft) over += print_soft(&a, csv);
    if (csv && fclose(csv) != 0) over++;
    int contact = a.contact ? contacts(&table, &err) : 0;
    if (contact < 0) fprintf(stderr, "tool_truth: %s\n", err.text);
    free(folder);
    return over || (a.limits && contact) || contact < 0 ? 1 : 0;
}
