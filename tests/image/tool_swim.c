/* `make swim`: shadows that swim while the camera or the sun moves slowly, as a table of all
 * techniques; soft ones under a sun of a size. tool_swim [TECHNIQUE..] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/swim.h"
#include "shadow/technique.h"

enum { COLUMNS = 4 };
static const char *const heads[COLUMNS] = {"yard, camera", "yard, sun", "cascades, camera",
                                           "cascades, sun"};

static bool is_asked(const char *name, int argc, char **argv) {
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], name) == 0) return true;
    return argc < 2;
}

static void quit(const struct gn_err *err) {
    fprintf(stderr, "tool_swim: %s\n", err->text);
    exit(1);
}

/* Those that are soft, or not. */
static void measure(bool soft, int argc, char **argv,
                    struct gn_swim_score scores[GN_TECHNIQUE_COUNT][COLUMNS]) {
    for (int c = 0; c < COLUMNS; c++) {
        struct gn_err err = {0};
        struct gn_swim swim;
        const struct gn_swim_opts opts = {.place = c < 2 ? GN_SWIM_YARD : GN_SWIM_FIELD,
                                          .sun = c % 2,
                                          .soft = soft,
                                          .width_px = 320,
                                          .height_px = 240,
                                          .frames = soft ? 12 : 40,
                                          .pace = soft ? 4 : 1};
        if (!gn_swim_init(&swim, &opts, &err)) quit(&err);
        for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++) {
            const struct gn_technique_row *row = &gn_techniques[t];
            if (row->on_plane || row->soft != soft || !is_asked(row->name, argc, argv)) continue;
            if (!gn_swim_measure(&swim, row->name, NULL, &scores[t][c], &err)) quit(&err);
        }
        gn_swim_finish(&swim);
    }
}

int main(int argc, char **argv) {
    static struct gn_swim_score scores[GN_TECHNIQUE_COUNT][COLUMNS];
    measure(false, argc, argv, scores);
    measure(true, argc, argv, scores);
    printf("change from frame to frame where truth does not change, per cent of full light: mean, "
           "99 %% are under\n%-8s",
           "");
    for (int c = 0; c < COLUMNS; c++) printf(" | %-16s", heads[c]);
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        if (!scores[t][0].changes) continue;
        printf("\n%-8s", gn_techniques[t].name);
        for (int c = 0; c < COLUMNS; c++)
            printf(" | %7.4f %8.3f", scores[t][c].mean, scores[t][c].p99);
    }
    printf("\nsoft ones (%s, ..) under a sun of tangent .05, four times as fast\n",
           gn_techniques[GN_TECHNIQUE_PCSS].name);
    return 0;
}
