/* tool_models FOLDER OUT [SHADOW]: the default pictures of models against the same by rays, the
 * shadows of both in the made light: how much of what an eye sees as hatch and torn edges differs.
 * FOLDER has the models of tests/image/models (../shared/assets), OUT gets both pictures. SHADOW: a
 * technique in place of the default one; with $GATHER, the value of --gather.
 *
 * Per model: the mean and the 99th percentile, of 255, of the difference between the pictures after
 * a band of 2 to 8 pixels (a Gaussian of 1 px less one of 4), of the green channel as encoded,
 * where rays darken the picture by over 2 of 255. Without samples in a pixel, as rays have none. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/shot.h"

enum { WIDTH = 800, HEIGHT = 600, PIXELS = WIDTH * HEIGHT, RADIUS = 12, FEW = 100 };
static const float NEAR_PX = 1, FAR_PX = 4, DARKER = 2.0f / 255;

static int quit(const char *text) {
    fprintf(stderr, "tool_models: %s\n", text);
    return 1;
}

/* Green, as encoded; NULL: it was not drawn. */
static float *draw(const char *model, const char *out, const char *shadow) {
    const char *gather = getenv("GATHER");
    const char *argv[] = {gn_shot_program(),
                          "render",
                          model,
                          "-o",
                          out,
                          "--size",
                          "800x600",
                          "--msaa",
                          "0",
                          "--gather",
                          gather ? gather : "auto",
                          shadow ? "--shadow" : NULL,
                          shadow,
                          NULL};
    struct gn_run run;
    struct gn_err err = {0};
    struct gn_picture picture;
    if (!gn_run(&run, argv, 600, &err) || run.status != 0) {
        printf("%s: %s%s", model, err.text, run.err);
        return NULL;
    }
    if (!gn_picture_read(&picture, out, &err)) {
        printf("%s\n", err.text);
        return NULL;
    }
    float *green = gn_xalloc(PIXELS, sizeof *green);
    for (int i = 0; i < PIXELS; i++)
        green[i] = gn_picture_at(&picture, i % WIDTH, i / WIDTH)[picture.channels > 2];
    gn_picture_finish(&picture);
    return green;
}

/* A Gaussian along rows, or columns; the picture ends at its rim. */
static void blur_lines(const float *from, float *to, float sigma_px, int step, int length) {
    float kernel[RADIUS + 1];
    for (int k = 0; k <= RADIUS; k++)
        kernel[k] = expf(-.5f * (float)(k * k) / (sigma_px * sigma_px));
    for (int i = 0; i < PIXELS; i++) {
        const int at = i / step % length;
        float sum = 0, weight = 0;
        for (int k = -RADIUS; k <= RADIUS; k++) {
            if (at + k < 0 || at + k >= length) continue;
            sum += kernel[abs(k)] * from[i + k * step];
            weight += kernel[abs(k)];
        }
        to[i] = sum / weight;
    }
}

static void blur(const float *from, float *room, float *to, float sigma_px) {
    blur_lines(from, room, sigma_px, 1, WIDTH);
    blur_lines(room, to, sigma_px, WIDTH, HEIGHT);
}

static int by_size(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

struct score {
    int pixels;
    double mean, most; /* of 255 */
};

static struct score compare(const float *shot, const float *truth, const float *unshadowed) {
    float *memory = gn_xalloc(4 * PIXELS, sizeof *memory), *difference = memory,
          *room = memory + PIXELS, *near = memory + 2 * PIXELS, *far = memory + 3 * PIXELS;
    struct score score = {0};
    for (int i = 0; i < PIXELS; i++) difference[i] = shot[i] - truth[i];
    blur(difference, room, near, NEAR_PX);
    blur(difference, room, far, FAR_PX);
    for (int i = 0; i < PIXELS; i++) {
        if (unshadowed[i] - truth[i] <= DARKER) continue;
        room[score.pixels] = 255 * fabsf(near[i] - far[i]);
        score.mean += (double)room[score.pixels++];
    }
    if (score.pixels > 0) {
        qsort(room, (size_t)score.pixels, sizeof *room, by_size);
        score.mean /= score.pixels;
        score.most = (double)room[(int)(.99 * (score.pixels - 1))];
    }
    free(memory);
    return score;
}

int main(int argc, char **argv) {
    char line[300], name[100], path[600], out[3][700];
    double mean = 0, most = 0;
    int models = 0, missing = 0;
    if (argc < 3) return quit("tool_models FOLDER OUT [SHADOW]");
    FILE *list = fopen("tests/image/models", "r");
    if (!list) return quit("cannot open tests/image/models");
    printf("%-16s %9s %8s %8s\n", "model", "pixels", "mean", "99 %");
    while (fgets(line, sizeof line, list)) {
        const char *const kinds[] = {argc > 3 ? argv[3] : NULL, "truth", "none"};
        static const char *const ends[] = {"", "-truth", "-none"};
        float *pictures[3] = {0};
        char file[200];
        if (line[0] == '#' || sscanf(line, "%99s %199[^\n]", name, file) != 2) continue;
        snprintf(path, sizeof path, "%.300s/%s", argv[1], file);
        bool all = true;
        for (int i = 0; i < 3 && all; i++) {
            snprintf(out[i], sizeof out[i], "%.500s/%s%s.png", argv[2], name, ends[i]);
            all = (pictures[i] = draw(path, out[i], kinds[i])) != NULL;
        }
        if (all) {
            const struct score score = compare(pictures[0], pictures[1], pictures[2]);
            const bool counts = score.pixels >= FEW; /* else in its row alone */
            printf("%-16s %9d %8.2f %8.2f\n", name, score.pixels, score.mean, score.most);
            mean += counts ? score.mean : 0;
            most += counts ? score.most : 0;
            models += counts;
        }
        missing += !all;
        fflush(stdout);
        for (int i = 0; i < 3; i++) free(pictures[i]);
    }
    fclose(list);
    if (models > 0)
        printf("%-16s %9d %8.2f %8.2f\n", "mean of models", models, mean / models, most / models);
    return missing > 0;
}
