/* Shadows against truth, as a table: a row for each technique and map encoding, over the generated
 * scenes. */
#ifndef GN_IMAGE_TABLE_H
#define GN_IMAGE_TABLE_H

#include <stdbool.h>
#include <stdio.h>

#include "image/truth.h"
#include "shadow/technique.h"

enum { GN_TABLE_SCENES = 45, GN_TABLE_ROWS = 8 * GN_TECHNIQUE_COUNT };

/* The scenes go by kinds of light, and those of coarse meshes with smooth normals are a kind, each
 * with a table of its own: what is asked of one kind must not hide behind another. */
enum gn_table_kind {
    GN_TABLE_SUN_AND_SPOT,
    GN_TABLE_POINT,
    GN_TABLE_SMOOTH,
    GN_TABLE_THIN,
    GN_TABLE_MIRRORED,
    GN_TABLE_KINDS
};
struct gn_table_range {
    const char *name;
    int first, last;
};
extern const struct gn_table_range gn_table_kinds[GN_TABLE_KINDS];

/* Folder with truth-00.glb .. truth-44.glb (or the contact scenes), made by <parent of
 * BUILD>/host/make_truth when it is not there yet; a new generator makes a new folder. NULL and a
 * message on failure; free() it. */
char *gn_table_scenes(bool contact, struct gn_err *err);

struct gn_table_row {
    const char *technique, *format; /* as on the command line; planar: auto or stencil */
    unsigned map_px;
    struct gn_mask_score scores[GN_TABLE_SCENES];
    bool measured[GN_TABLE_SCENES];
};

struct gn_table {
    const char *folder;
    const char *title;            /* or NULL */
    bool scenes[GN_TABLE_SCENES]; /* which to measure */
    int row_count;
    struct gn_table_row rows[GN_TABLE_ROWS];
    const char *save;  /* folder for shot, truth and diff of every cell; NULL: none */
    bool progress;     /* a line that counts, on stderr */
    int failures;      /* filled: shots that did not come about */
    char failure[512]; /* the first one */
    double band_px[GN_TABLE_SCENES],
        away[GN_TABLE_SCENES]; /* for the first row's map: mean width of the edges in pixels,
                                  and share of the pixels that are away from them */
};

void gn_table_add(struct gn_table *table, const char *technique, const char *format,
                  unsigned map_px);
/* Leaves out the scenes of other kinds and takes this one's name as title; false if none is left.
 */
bool gn_table_keep(struct gn_table *table, enum gn_table_kind kind);
/* Draws and compares everything: with what draws for render, but in this process. */
void gn_table_run(struct gn_table *table);

/* Of a row, over the measured scenes: means and worst, in per cent. */
enum gn_fault {
    GN_FAULT_ACNE,
    GN_FAULT_DARKENING, /* the mean over safely lit pixels */
    GN_FAULT_DARKENED,  /* the share of them that is over 5 % */
    GN_FAULT_LEAK,
    GN_FAULT_GAP,
    GN_FAULT_WRONG,
    GN_FAULT_COUNT
};
struct gn_fault_sum {
    double mean, worst;
    int worst_scene;
};
struct gn_fault_sum gn_table_sum(const struct gn_table_row *row, enum gn_fault fault);

/* The limits that the project has set itself, in per cent; INFINITY: none. Acne and leaks bind
 * every technique, the rest those with a hard edge (and planar, which is measured on its plane and
 * has to be lit elsewhere). With maps under 1024 gaps and wrong pixels are not limited, and acne
 * and wrong pixels not on coarse meshes. */
struct gn_limit_row {
    double mean, worst;
};
struct gn_limit_row gn_table_limit(const struct gn_table_row *row, enum gn_fault fault);

void gn_table_print(const struct gn_table *table, FILE *to);
/* The same as CSV: a line for each row and fault, with its mean, its worst scene and that one's
 * number; `head`: a line of names first. */
void gn_table_print_csv(const struct gn_table *table, bool head, FILE *to);
/* Prints each limit passed, with the scene that is worst; returns how many there are (failed shots
 * count). */
int gn_table_check(const struct gn_table *table, FILE *to);
/* Renders the worst scene of each row over its limits again and leaves shot, truth and diff in
 * build/failures. */
void gn_table_save_failures(const struct gn_table *table);

/* Gap at contacts over both contact scenes. Limits: 1.5 texels for hard, 2.5 for the others.
 * Returns how many are passed. */
int gn_table_contacts(const char *folder, const struct gn_table_row *rows, int row_count, FILE *to);

#endif
