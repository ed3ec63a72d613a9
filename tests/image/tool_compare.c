/* Is the screen what was rendered? tool_compare [--turn DEG] SHOT EXPECTED: two pictures, PNG or
 * PFM. Exit status 0 if they differ by at most 1/255 in 99.9 % of the pixels. --turn: the display
 * shows the expected picture turned clockwise by so much (what --rotate does). Prints the
 * figures; a failure leaves build/failures/<name of SHOT>-{shot,truth,diff}.png. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/compare.h"

static const double tolerance = 1.001 / 255, share_allowed = .001;

static void read_or_exit(struct gn_picture *picture, const char *path) {
    struct gn_err err = {0};
    if (gn_picture_read(picture, path, &err)) return;
    fprintf(stderr, "tool_compare: %s\n", err.text);
    exit(2);
}

/* once, clockwise */
static void turn(struct gn_picture *p) {
    struct gn_picture turned;
    gn_picture_init(&turned, p->height_px, p->width_px, p->channels);
    for (int y = 0; y < turned.height_px; y++)
        for (int x = 0; x < turned.width_px; x++)
            memcpy(gn_picture_at(&turned, x, y), gn_picture_at(p, y, p->height_px - 1 - x),
                   sizeof *p->data * p->channels);
    gn_picture_finish(p);
    *p = turned;
}

/* A screen has no alpha. */
static void drop_alpha(struct gn_picture *p) {
    if (p->channels != 4) return;
    size_t pixels = (size_t)p->width_px * p->height_px;
    for (size_t i = 0; i < pixels; i++)
        memmove(p->data + 3 * i, p->data + 4 * i, 3 * sizeof *p->data);
    p->channels = 3;
}

static const char *base_name(const char *path, char *buffer, size_t size) {
    const char *slash = strrchr(path, '/');
    snprintf(buffer, size, "%s", slash ? slash + 1 : path);
    char *dot = strrchr(buffer, '.');
    if (dot) *dot = 0;
    return buffer;
}

int main(int argc, char **argv) {
    int degrees = 0, first = 1;
    if (argc > 2 && strcmp(argv[1], "--turn") == 0) degrees = atoi(argv[2]), first = 3;
    if (argc != first + 2 || degrees % 90) {
        fprintf(stderr, "tool_compare [--turn DEG] SHOT EXPECTED\n");
        return 2;
    }
    struct gn_picture shot, expected;
    read_or_exit(&shot, argv[first]);
    read_or_exit(&expected, argv[first + 1]);
    drop_alpha(&shot);
    drop_alpha(&expected);
    for (int i = 0; i < degrees / 90; i++) turn(&expected);
    struct gn_difference d;
    char name[256];
    base_name(argv[first], name, sizeof name);
    bool same_size = gn_compare(&shot, &expected, tolerance, &d);
    if (!same_size)
        printf("%s: %dx%d, expected %dx%d\n", name, shot.width_px, shot.height_px,
               expected.width_px, expected.height_px);
    else
        printf(
            "%s: %.4f %% of the pixels differ by more than 1/255, at most by %.0f/255, at %d,%d\n",
            name, 100 * d.share, 255 * d.max, d.worst_x, d.worst_y);
    bool ok = same_size && d.share <= share_allowed;
    if (same_size && !ok) gn_compare_save(NULL, name, &shot, &expected);
    gn_picture_finish(&shot);
    gn_picture_finish(&expected);
    return ok ? 0 : 1;
}
