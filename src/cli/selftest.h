/* Compares the shadows that this GPU draws with ray-traced ones. Small scenes are embedded, each
 * with whether every pixel is lit, traced when the program was built; they are drawn with every
 * technique in every map format that the GPU has.
 *
 * Embedded are pairs "selftest/NAME.glb" and "selftest/NAME.truth". The latter: the eight bytes
 * "gntruth1"; width and height in pixels, 16 bits each, little endian; then runs of pixels, rows
 * from the top, a byte each: bit 0 lit, bit 1 within two pixels of an edge (of a shadow or of a
 * thing), bits 2-7 the length of the run - 1. */
#ifndef GN_CLI_SELFTEST_H
#define GN_CLI_SELFTEST_H

#include <jansson.h>
#include <stdint.h>
#include <stdio.h>

#include "core/err.h"
#include "gl/gl.h"

enum {
    GN_SELFTEST_SCENES = 8,
    GN_SELFTEST_ROWS = GN_TECHNIQUE_COUNT * (GN_ENCODING_COUNT + GN_MOMENTS_COUNT),
    GN_SELFTEST_MAP_PX = 512, /* two texels are then less than two pixels, in every scene */
};
/* Most wrong pixels that a scene may have, in per cent: away from edges, where both acne and leaks
 * are, and of all. */
#define GN_SELFTEST_AWAY_MAX  0.3
#define GN_SELFTEST_WRONG_MAX 1.0

struct gn_selftest_count { /* wrong pixels of a scene, in per cent; NAN: not drawn */
    double away, wrong;
};
struct gn_selftest_row {
    enum gn_technique technique;
    enum gn_encoding encoding; /* AUTO with moments */
    enum gn_moments moments;
    struct gn_selftest_count scenes[GN_SELFTEST_SCENES];
    char failure[200]; /* why some scene was not drawn, or "" */
};
/* Plain data: the child that draws shares it with the one that prints. */
struct gn_selftest {
    uint32_t width_px, height_px, scene_count, row_count;
    char scenes[GN_SELFTEST_SCENES][24];
    struct gn_selftest_row rows[GN_SELFTEST_ROWS];
    uint32_t done, all; /* pictures */
};

/* Draws all; fills `done` as it goes. False if an embedded scene is broken or cannot be loaded;
 * the failure of a row is in that row. */
bool gn_selftest_run(struct gn_selftest *test, struct gn_gl *gl, struct gn_err *err);

uint32_t gn_selftest_failures(const struct gn_selftest *test); /* rows */

void gn_selftest_print(const struct gn_selftest *test, FILE *to);
/* {size_px: [w, h], map_px, limits: {away, wrong}, scenes: [name], rows: [{technique, map_format,
 * pass, failure, away: {mean, worst, scene}, wrong: {..}}], passed, failed}; shares in per cent.
 * The caller owns it. */
json_t *gn_selftest_json(const struct gn_selftest *test);

#endif
