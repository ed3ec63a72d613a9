/* Point lights: a tile is drawn only when what it shows has changed, and what casts is in it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/point_help.h"
#include "unit/check.h"

enum { MAP_PX = HELP_LAMP_MAP_PX, SIDE_PX = 400 };

static const struct gn_plan *draw(int camera, int technique, int encoding) {
    return help_lamp_draw(camera, technique, encoding, SIDE_PX, SIDE_PX);
}

/* ---- what is drawn again ---- */

/* Six squares of 6 m round the light, one of .4 m before each; that before +x moves along y. Camera
 * 0 sees all, camera 1 the square at +x alone. */
static int load_box(void **state) {
    (void)state;
    static const char *const turns[6] = {
        "[0,0,0.70710678,0.70710678]",  "[0,0,-0.70710678,0.70710678]", "[1,0,0,0]", "[0,0,0,1]",
        "[-0.70710678,0,0,0.70710678]", "[0.70710678,0,0,0.70710678]"};
    static const float times[2] = {0, 1}, path[6] = {1.5f, 0, 0, 1.5f, 0.2f, 0};
    struct gn_maker maker;
    char json[300];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    for (int i = 0; i < 12; i++) {
        double at[3] = {0}, far = i < 6 ? 1.5 : 3;
        at[i % 6 / 2] = i % 2 ? -far : far;
        snprintf(json, sizeof json,
                 "{'mesh':0,'translation':[%g,%g,%g],'rotation':%s,'scale':[%g,1,%g]}", at[0],
                 at[1], at[2], turns[i % 6], i < 6 ? 0.2 : 3.0, i < 6 ? 0.2 : 3.0);
        gn_maker_add(&maker, "nodes", json);
    }
    gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    gn_maker_add(&maker, "nodes", "{'camera':0,'translation':[0,0,20]}");
    gn_maker_add(&maker, "nodes",
                 "{'camera':0,'translation':[2,0,0],'rotation':[0,-0.70710678,0,0.70710678]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':50}}]");
    int input = gn_maker_accessor(&maker, "SCALAR", 5126, 2, times, sizeof times, NULL);
    int output = gn_maker_accessor(&maker, "VEC3", 5126, 2, path, sizeof path, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{'node':1,"
             "'path':'translation'}}]}",
             input, output);
    gn_maker_add(&maker, "animations", json);
    help_lamp_load(&maker);
    return 0;
}

static void expect_shadow_work(uint32_t draws, uint32_t skipped) {
    struct gn_gl_stats stats = gn_gl_stats(lamp.gl);
    assert_int_equal(stats.shadow_draws, draws);
    assert_int_equal(stats.shadow_passes_skipped, skipped);
}

static void test_what_moves_draws_its_tiles_alone(void **state) {
    (void)state;
    enum { WIDTH = 3 * MAP_PX, HEIGHT = 2 * MAP_PX };
    float *still = gn_xalloc(WIDTH * HEIGHT, sizeof *still),
          *moved = gn_xalloc(WIDTH * HEIGHT, sizeof *moved);
    struct gn_err err = {0};
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_R32UI);
    expect_shadow_work(6, 0);
    assert_true(gn_gl_read_map(lamp.gl, 0, still, &err));
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_R32UI);
    expect_shadow_work(0, 6);
    gn_pose_step(&lamp.pose, 500000000);
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_R32UI);
    expect_shadow_work(1, 5);
    assert_true(gn_gl_read_map(lamp.gl, 0, moved, &err));
    int inside = 0, outside = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        bool tile = i % WIDTH < MAP_PX && i / WIDTH < MAP_PX;
        bool differs = still[i] != moved[i];
        inside += tile && differs;
        outside += !tile && differs;
    }
    assert_true(inside > 50);
    assert_int_equal(outside, 0);
    free(still);
    free(moved);
}

static void test_a_tile_whose_shadows_are_not_seen_is_not_drawn(void **state) {
    (void)state;
    draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH);
    expect_shadow_work(6, 0);
    const struct gn_shadow_view *view = draw(1, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH)->shadows;
    expect_shadow_work(0, 1); /* the others are cleared */
    for (int i = 0; i < 6; i++) assert_true(view->raster.tiles[i].empty == (i > 0));
    draw(1, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH);
    expect_shadow_work(0, 6);
}

/* ---- near and far ---- */

/* One mesh: the shell of a room of 10 m, of 6 x 8 triangles, and a plate .5 m below the light,
 * which is in the middle. */
static int load_shell(void **state) {
    (void)state;
    enum { QUADS = 25 };
    float p[QUADS][4][3];
    uint16_t index[QUADS][6];
    for (int q = 0; q < QUADS; q++) {
        int axis = q / 8 % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        float side = q / 4 % 2 ? 5 : -5, size = 5;
        if (q == QUADS - 1) axis = 1, u = 0, v = 2, side = -0.5f, size = 0.2f;
        for (int c = 0; c < 4; c++) {
            p[q][c][axis] = side;
            p[q][c][u] = size * (float)((c == 1 || c == 2) - q % 2);
            p[q][c][v] = size * (float)((c >= 2) - q / 2 % 2);
        }
        for (int k = 0; k < 6; k++) index[q][k] = (uint16_t)(4 * q + "012023"[k] - '0');
    }
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_accessor(&maker, "VEC3", 5126, 4 * QUADS, p, sizeof p,
                      "'min':[-5,-5,-5],'max':[5,5,5]");
    gn_maker_accessor(&maker, "SCALAR", 5123, 6 * QUADS, index, sizeof index, NULL);
    gn_maker_add(&maker, "meshes", "{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}");
    gn_maker_add(&maker, "nodes", "{'mesh':0}");
    gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    gn_maker_add(&maker, "nodes", "{'camera':0,'translation':[0,0,4]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':50}}]");
    help_lamp_load(&maker);
    return 0;
}

static void test_what_a_mesh_round_the_light_has_near_it_casts(void **state) {
    (void)state;
    const struct gn_shadow_view *view = draw(0, GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH)->shadows;
    assert_true(lamp.scene->geometries[0].index_count / 3 > 32);
    assert_false(view->empty);
    assert_true(view->code.near_m > 0.1f && view->code.near_m < 0.5f);
    assert_true(view->code.far_m > 8.6f && view->code.far_m < 12.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_what_moves_draws_its_tiles_alone, load_box,
                                        help_lamp_unload),
        cmocka_unit_test_setup_teardown(test_a_tile_whose_shadows_are_not_seen_is_not_drawn,
                                        load_box, help_lamp_unload),
        cmocka_unit_test_setup_teardown(test_what_a_mesh_round_the_light_has_near_it_casts,
                                        load_shell, help_lamp_unload),
    };
    return cmocka_run_group_tests_name("point lights", tests, help_lamp_open, help_lamp_close);
}
