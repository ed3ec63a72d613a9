/* Soft shadows against truth, as a table: tool_penumbra [-s WxH] [-m DIR] [OPTION of render].. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/compare.h"
#include "image/penumbra.h"
#include "image/shot.h"

static void fail(const struct gn_err *err) {
    fprintf(stderr, "tool_penumbra: %s\n", err->text);
    exit(1);
}

int main(int argc, char **argv) {
    const char *args[60] = {"--backend", "egl", "--aov", "visibility", "--size", "480x360"};
    const char *save = NULL;
    int n = 6;
    for (int i = 1; i < argc && n < 59; i++)
        if (strcmp(argv[i], "-d") == 0 && i + 1 < argc)
            save = argv[++i];
        else
            args[n++] = argv[i];
    struct gn_err err = {0};
    printf("%-8s %8s %8s %8s %8s\n", "scene", "soft", "grain", "bias", "rest");
    for (int s = 0; s < GN_PENUMBRA_COUNT; s++) {
        char *path = gn_penumbra_write(s, &err);
        struct gn_picture truth, shot;
        if (!path || !gn_penumbra_truth(&truth, path, false, 480, 360, &err)) fail(&err);
        if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail(&err);
        struct gn_penumbra_score score;
        gn_penumbra_score(&truth, &shot, &score);
        printf("%-8s %8.4f %8.4f %+8.4f %8.4f", gn_penumbra_names[s], score.soft, score.grain,
               score.bias, score.rest);
        if (s == GN_PENUMBRA_EDGE) {
            struct gn_penumbra_edge edge;
            gn_penumbra_edge(&truth, &shot, &edge);
            printf("  width %.3f of %.3f m, energy %+.4f, grain %.3f, back %.4f", edge.width,
                   edge.width_truth, edge.energy, edge.grain, edge.rise);
        }
        printf("\n");
        if (save) gn_compare_save(save, gn_penumbra_names[s], &shot, &truth);
        gn_picture_finish(&shot);
        gn_picture_finish(&truth);
        free(path);
    }
    return 0;
}
