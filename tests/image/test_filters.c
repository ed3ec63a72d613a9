/* What the filters of equal weights do, and settings that are there for comparison: README of
 * src/shadow has these figures. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/table.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

enum { WIDTH_PX = 640, HEIGHT_PX = 32, PIXELS = WIDTH_PX * HEIGHT_PX };
#define VIEW_M     0.8    /* of the ground, that a row shows */
#define SUN_COSINE 0.8944 /* to the ground's normal */

/* The edge of a sheet 1 m up, along z, whose shadow is seen from above beside it. */
static struct gn_scene *make_edge(void) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[5,1,5]},{'mesh':0,'translation':[-1,1,0],'scale':[1,1,2]},"
                 "{'rotation':[-0.63246,-0.31623,0,0.70711],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}},"
                 "{'camera':0,'translation':[0.5,3,0],'rotation':[-0.70710678,0,0,0.70710678]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':0.4,'ymag':0.02,'znear':0.1,"
                 "'zfar':10}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    struct gn_scene *scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Where a row from dark to lit passes that visibility, pixels. */
static double place_of(const float *row, double visibility) {
    int x = 1;
    while (x < WIDTH_PX - 1 && (double)row[4 * x] < visibility) x++;
    const double before = (double)row[4 * (x - 1)], after = (double)row[4 * x];
    return x - (after > before ? (after - visibility) / (after - before) : 0);
}

/* Across an edge along the map's axis a box is a ramp as wide as itself, of one slope; of which a
 * fiftieth is cut at both ends. */
static void test_a_box_is_a_straight_ramp(void **state) {
    (void)state;
    static const struct {
        enum gn_technique technique;
        double texels;
    } boxes[] = {{GN_TECHNIQUE_BOX3, 3}, {GN_TECHNIQUE_BOX5, 5}};
    static float aov[4 * PIXELS];
    struct help_stage stage;
    struct gn_err err = {0};
    help_stage_open(&stage, make_edge, "egl", NULL, NULL);
    for (int i = 0; i < 2; i++) {
        const struct gn_frame_opts opts = {.width_px = WIDTH_PX,
                                           .height_px = HEIGHT_PX,
                                           .shadow.technique_given = true,
                                           .shadow.technique = boxes[i].technique,
                                           .shadow.encoding = GN_ENCODING_AUTO,
                                           .shadow.map_px = 32,
                                           .debug.aov = GN_AOV_VISIBILITY};
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        if (!gn_gl_read_f32(stage.gl, aov, &err)) fail_msg("%s", err.text);
        const double px = (double)plan->shadows[0].lookup.texel / SUN_COSINE * WIDTH_PX / VIEW_M;
        double at[5];
        for (int k = 0; k < 5; k++) at[k] = place_of(aov, .1 + .2 * k) / px;
        const double width = (at[4] - at[0]) / .8 * 1.04;
        printf("%s: a ramp of %.3f texels, its fifths", gn_techniques[boxes[i].technique].name,
               width);
        for (int k = 0; k < 4; k++) printf(" %.3f", at[k + 1] - at[k]);
        printf("\n");
        assert_true(fabs(width - boxes[i].texels) <= .03 * boxes[i].texels);
        for (int k = 0; k < 4; k++)
            assert_true(fabs(at[k + 1] - at[k] - width / 1.04 / 5) <= .05 * width / 5);
    }
    help_stage_close(&stage);
}

/* The limits of the project, over two scenes of each kind of light, and one of coarse meshes. */
static void test_boxes_against_truth(void **state) {
    (void)state;
    static const int scenes[] = {2, 7, 14, 19, 25, 28, 31, 34, 37};
    static struct gn_table table;
    struct gn_err err = {0};
    char *folder = gn_table_scenes(false, &err);
    if (!folder) fail_msg("%s", err.text);
    for (int kind = 0; kind < GN_TABLE_KINDS; kind++) {
        table = (struct gn_table){.folder = folder};
        for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) table.scenes[scenes[i]] = true;
        gn_table_add(&table, "box3", "depth", 1024);
        gn_table_add(&table, "box5", "depth", 1024);
        gn_table_keep(&table, (enum gn_table_kind)kind);
        gn_table_run(&table);
        gn_table_print(&table, stdout);
        assert_int_equal(gn_table_check(&table, stdout), 0);
    }
    free(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_box_is_a_straight_ramp),
        cmocka_unit_test(test_boxes_against_truth),
    };
    return cmocka_run_group_tests_name("filters", tests, NULL, NULL);
}
