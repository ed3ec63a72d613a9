/* A body with levels of detail against the whole of it: it has no hole, also where two of its
 * meshes meet; it does not shade itself; its colours are the same. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cglm/cglm.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { ROUND = 160, UP = 80, ROW = ROUND + 1, VERTICES = ROW * (UP + 1), CORNERS = 6 * ROUND * UP };
#define PX "320"

static float positions[VERTICES][3];
static uint32_t corners[CORNERS];
static char path[300];

/* A ball with bumps, its upper and its lower half meshes of their own. */
static void make_ball(void) {
    uint32_t *c = corners;
    for (int i = 0; i < VERTICES; i++) {
        const float a = 2 * GLM_PIf * (float)(i % ROW % ROUND) / ROUND,
                    b = GLM_PIf * (float)(i / ROW) / UP,
                    r = 1 + .03f * sinf(5 * a) * sinf(b) * sinf(7 * b);
        positions[i][0] = r * cosf(a) * sinf(b);
        positions[i][1] = r * cosf(b);
        positions[i][2] = -r * sinf(a) * sinf(b);
    }
    for (uint32_t y = 0; y < UP; y++)
        for (uint32_t x = 0; x < ROUND; x++, c += 6) {
            const uint32_t v = y * ROW + x;
            memcpy(c, (uint32_t[]){v, v + ROW, v + 1, v + 1, v + ROW, v + ROW + 1}, 6 * sizeof *c);
        }
}

static int write_scene(void **state) {
    (void)state;
    struct gn_maker m;
    struct gn_err err = {0};
    char json[400];
    make_ball();
    gn_maker_init(&m);
    const size_t half = CORNERS / 2;
    /* the directions of a ball are near enough to its normals */
    const int p = gn_maker_accessor(&m, "VEC3", 5126, VERTICES, positions, sizeof positions, NULL),
              above =
                  gn_maker_accessor(&m, "SCALAR", 5125, half, corners, sizeof corners / 2, NULL),
              below = gn_maker_accessor(&m, "SCALAR", 5125, half, corners + half,
                                        sizeof corners / 2, NULL);
    snprintf(json, sizeof json,
             "{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d},'indices':%d},"
             "{'attributes':{'POSITION':%d,'NORMAL':%d},'indices':%d}]}",
             p, p, above, p, p, below);
    gn_maker_add(&m, "meshes", json);
    gn_maker_set(&m, "cameras", "[{'type':'perspective','perspective':{'yfov':0.6,'znear':1}}]");
    gn_maker_set(&m, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    gn_maker_set(&m, "nodes",
                 "[{'mesh':0},{'camera':0,'translation':[0,0,4]},"
                 "{'rotation':[-0.3,0.3,0,0.90553851],'extensions':{'KHR_lights_punctual':"
                 "{'light':0}}}]");
    gn_maker_set(&m, "scenes", "[{'nodes':[0,1,2]}]");
    snprintf(path, sizeof path, "%s/detail.glb", gn_shot_build());
    if (!gn_maker_write(&m, path, &err)) fail_msg("%s", err.text);
    return 0;
}

static struct gn_picture shoot(const char *aov, const char *detail) {
    struct gn_picture shot;
    struct gn_err err = {0};
    const char *const args[] = {"--aov",     aov,   "--size",   PX "x" PX, "--detail", detail,
                                "--backend", "egl", "--shadow", "pcf",     NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    return shot;
}

/* Pixels where the surface is seen, and all around them. */
static bool is_inside(const struct gn_picture *distance, int x, int y) {
    for (int k = 0; k < 9; k++)
        if (!isfinite(*gn_picture_at(distance, x - 1 + k % 3, y - 1 + k / 3))) return false;
    return true;
}

static void another_mesh_is_drawn(void **state) {
    (void)state;
    struct gn_picture whole = shoot("distance", "full"), less = shoot("distance", "auto");
    int other = 0;
    for (int i = 0; i < whole.width_px * whole.height_px; i++)
        other += whole.data[i * whole.channels] != less.data[i * less.channels];
    assert_true(other > 1000);
    gn_picture_finish(&whole);
    gn_picture_finish(&less);
}

static void it_has_no_hole(void **state) {
    (void)state;
    struct gn_picture whole = shoot("distance", "full"), less = shoot("distance", "auto");
    for (int y = 1; y + 1 < whole.height_px; y++)
        for (int x = 1; x + 1 < whole.width_px; x++) {
            const float far = *gn_picture_at(&whole, x, y), there = *gn_picture_at(&less, x, y);
            if (is_inside(&whole, x, y) && !(fabsf(there - far) < .1f))
                fail_msg("a hole at %d,%d: %g m, not %g", x, y, (double)there, (double)far);
        }
    gn_picture_finish(&whole);
    gn_picture_finish(&less);
}

static void it_does_not_shade_itself(void **state) {
    (void)state;
    struct gn_picture whole = shoot("visibility", "full"), less = shoot("visibility", "auto");
    int lit = 0, dark = 0;
    for (int i = 0; i < whole.width_px * whole.height_px; i++)
        if (whole.data[i * whole.channels] > .99f) {
            lit++;
            dark += less.data[i * less.channels] < .7f;
        }
    if (dark * 500 > lit) fail_msg("%d of %d pixels that are lit", dark, lit);
    gn_picture_finish(&whole);
    gn_picture_finish(&less);
}

static void its_colours_are_the_same(void **state) {
    (void)state;
    struct gn_picture whole = shoot("color", "full"), less = shoot("color", "auto");
    const int count = whole.width_px * whole.height_px * whole.channels;
    double sum = 0;
    for (int i = 0; i < count; i++) sum += fabs((double)whole.data[i] - (double)less.data[i]);
    if (sum / count > .002) fail_msg("%g on average", sum / count);
    gn_picture_finish(&whole);
    gn_picture_finish(&less);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(another_mesh_is_drawn),
        cmocka_unit_test(it_has_no_hole),
        cmocka_unit_test(it_does_not_shade_itself),
        cmocka_unit_test(its_colours_are_the_same),
    };
    return cmocka_run_group_tests(tests, write_scene, NULL);
}
