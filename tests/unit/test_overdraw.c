/* Small files that draw each pixel a million times: what is over the limit on overdraw is left out,
 * by numbers that follow from where squares of 2 m lie under a camera. */
#include <stdlib.h>

#include "frame/frame.h"
#include "scene/pose.h"
#include "unit/scene_help.h"

#define CLEAR       "{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5]}"
#define BLENDED     "[" CLEAR "}]"
#define TWO_BLENDED "[" CLEAR "}," CLEAR ",'doubleSided':true}]"
#define OPAQUE      "[{}]"

#define STACK_M 0.05f
#define WIDE_CAMERA                                                                                \
    "[{'type':'perspective','perspective':{'yfov':1.57079633,'aspectRatio':1,'znear':0.01}}]"

static struct gn_pose pose;
static struct gn_frame *frame;
static struct gn_scene *scene;

/* Node 0 draws mesh 0 of the material; node 1 is a camera that looks down from there, and sees 45
 * degrees to each side. */
static void set_scene(const char *material, const char *drawn, double height_m) {
    char json[200];
    gn_maker_set(&maker, "materials", material);
    gn_maker_set(&maker, "nodes", "[]");
    gn_maker_add(&maker, "nodes", drawn);
    snprintf(json, sizeof json,
             "{'camera':0,'translation':[0,%g,0],'rotation':[-0.70710678,0,0,0.70710678]}",
             height_m);
    gn_maker_add(&maker, "nodes", json);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    gn_maker_set(&maker, "cameras", WIDE_CAMERA);
}

/* Instances above one another, within STACK_M. */
static void set_instances(const char *material, uint32_t count, double height_m) {
    char json[200];
    float(*at)[3] = calloc(count, sizeof *at);
    for (uint32_t i = 0; i < count; i++) at[i][1] = STACK_M * (float)i / (float)count;
    const int where = gn_maker_accessor(&maker, "VEC3", 5126, count, at, count * sizeof *at, NULL);
    free(at);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    snprintf(json, sizeof json,
             "{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':%d}}}"
             "}",
             where);
    set_scene(material, json, height_m);
}

/* The same as triangles of one mesh. */
static void set_triangles(const char *material, uint32_t count, double height_m) {
    char json[160];
    uint16_t(*square)[6] = calloc(count, sizeof *square);
    for (uint32_t i = 0; i < count; i++)
        memcpy(square[i], (const uint16_t[]){0, 2, 1, 0, 3, 2}, sizeof *square);
    const int indices = gn_maker_accessor(&maker, "SCALAR", 5123, 6 * (size_t)count, square,
                                          count * sizeof *square, NULL);
    free(square);
    snprintf(json, sizeof json,
             "[{'primitives':[{'attributes':{'POSITION':0},'indices':%d,'material':0}]}]", indices);
    gn_maker_set(&maker, "meshes", json);
    set_scene(material, "{'mesh':0}", height_m);
}

static const struct gn_plan *build(const struct gn_frame_opts *opts) {
    const struct gn_caps caps = {
        .has = (1u << GN_CAP_COUNT) - 1, .max_texture_px = 4096, .max_texture_units = 16};
    scene = load();
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    frame = gn_frame_create(scene, &caps);
    memset(&warnings, 0, sizeof warnings);
    const struct gn_plan *plan = gn_frame_build(frame, &pose, opts, &warnings);
    assert_null(gn_plan_check(plan));
    return plan;
}

static void finish(void) {
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

/* Instances of the scene's geometry that passes of a kind draw; *draw: the last such draw. */
static uint32_t count_drawn(const struct gn_plan *plan, enum gn_pass_kind kind,
                            const struct gn_draw **draw) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        for (uint32_t k = 0; k < plan->passes[i].draw_count && plan->passes[i].kind == kind; k++) {
            *draw = &plan->draws[plan->passes[i].first_draw + k];
            if ((*draw)->geometry != GN_NO_GEOMETRY) count += (*draw)->instance_count;
        }
    return count;
}

/* From 1 m each fills the picture; from 10 m, less the radius of 2 m of a square, it is 1/64 of
 * that. An opaque one counts a quarter. The nearest are drawn. */
static void test_instances_over_the_limit_are_left_out(void **state) {
    (void)state;
    static const struct {
        const char *material;
        double height_m;
        uint64_t limit;
        uint32_t drawn;
    } rows[] = {
        {BLENDED, 1, 10, 10}, {BLENDED, 1, 0, 1000}, {BLENDED, 10, 1, 64},
        {OPAQUE, 1, 10, 40},  {OPAQUE, 10, 2, 512},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (i > 0) setup(NULL);
        set_instances(rows[i].material, 1000, rows[i].height_m);
        const struct gn_draw *draw = NULL;
        const struct gn_plan *plan = build(&(struct gn_frame_opts){
            .overdraw = rows[i].limit, .output.width_px = 64, .output.height_px = 64});
        const uint32_t drawn = count_drawn(plan, GN_PASS_PICTURE, &draw);
        assert_in_range(drawn, rows[i].drawn * 98 / 100, rows[i].drawn * 102 / 100);
        const bool from_end = rows[i].material[2] == '\'';
        const struct gn_instance *nearest =
            &plan->instances[draw->first_instance + (from_end ? draw->instance_count - 1 : 0)];
        assert_true(nearest->world[1][3] > 0.97f * STACK_M);
        const bool named =
            warnings.count == 1 && strstr(warnings.text[0], " instances are not drawn");
        assert_int_equal(named, rows[i].limit > 0);
        finish();
    }
}

/* Of two blended draws the nearer one is whole. */
static void test_the_nearest_draw_stays(void **state) {
    (void)state;
    const struct gn_draw *draw = NULL;
    set_instances(TWO_BLENDED, 20, 1);
    gn_maker_add(&maker, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':1}]}");
    gn_maker_add(&maker, "nodes", "{'mesh':1,'translation':[0,0.5,0]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    const struct gn_frame_opts opts = {.overdraw = 10};
    const struct gn_plan *plan = build(&opts);
    assert_int_equal(count_drawn(plan, GN_PASS_PICTURE, &draw), 10);
    assert_near(plan->instances[draw->first_instance].world[1][3], 0.5f);
    finish();
}

/* Triangles of one mesh lie on one another as its instances do. */
static void test_layers_of_one_mesh_count(void **state) {
    (void)state;
    const struct gn_draw *draw;
    for (uint64_t limit = 999; limit <= 1001; limit += 2) {
        if (limit > 999) setup(NULL);
        set_triangles(BLENDED, 1000, 1);
        const struct gn_frame_opts opts = {.overdraw = limit};
        assert_int_equal(count_drawn(build(&opts), GN_PASS_PICTURE, &draw), limit > 1000);
        assert_near(scene->geometries[0].layers[1], 1000);
        finish();
    }
}

/* Squares that lie together at rest: each with its own joint, which spread them, or all with one;
 * vertices have four joints or eight. Every fourth triangle may have no area. The camera is where
 * all of them are seen, or half a metre over the first, level. */
struct skinned {
    bool spread, passes_eye, eight, holes;
    uint32_t drawn;
};
static void set_skinned(const struct skinned *s) {
    enum { SQUARES = 200, A_ROW = 15 };
    static const float corners[6][2] = {{-1, -1}, {-1, 1}, {1, 1}, {-1, -1}, {1, 1}, {1, -1}};
    static float positions[6 * SQUARES][3], weights[6 * SQUARES][4];
    static uint16_t joints[6 * SQUARES][4];
    gn_maker_finish(&maker);
    gn_maker_init(&maker);
    for (int i = 0; i < 6 * SQUARES; i++) {
        const bool hole = s->holes && i / 3 % 4 == 0;
        positions[i][0] = hole ? 0 : corners[i % 6][0];
        positions[i][2] = hole ? 0 : corners[i % 6][1];
        weights[i][0] = s->eight ? 0.5f : 1;
        joints[i][0] = (uint16_t)(s->spread ? i / 6 : 0);
    }
    for (int i = 0; i < SQUARES; i++) {
        char json[80];
        snprintf(json, sizeof json, "{'translation':[%g,0,%g]%s}", 2.1 * (i % A_ROW),
                 2.1 * (i / A_ROW), s->passes_eye && i == 0 ? ",'children':[201]" : "");
        gn_maker_add(&maker, "nodes", json);
    }
    gn_maker_skinned(&maker, SQUARES, 6 * SQUARES, positions, joints, weights);
    if (s->eight)
        gn_maker_set(&maker, "meshes",
                     "[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':1,'WEIGHTS_0':2,"
                     "'JOINTS_1':1,'WEIGHTS_1':2}}]}]");
    if (!s->passes_eye) return;
    gn_maker_add(&maker, "nodes", "{'camera':0,'translation':[0,0.5,0]}");
    gn_maker_set(&maker, "cameras", WIDE_CAMERA);
}

static void test_a_posed_mesh_counts_as_it_lies(void **state) {
    (void)state;
    const struct gn_draw *draw;
    static const struct skinned rows[] = {
        {.drawn = 0},
        {.spread = true, .drawn = 1},
        {.passes_eye = true, .drawn = 0},
        {.eight = true, .drawn = 0},
        {.eight = true, .spread = true, .drawn = 1},
        {.holes = true, .drawn = 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        set_skinned(&rows[i]);
        const struct gn_frame_opts opts = {.overdraw = 5};
        assert_int_equal(count_drawn(build(&opts), GN_PASS_PICTURE, &draw), rows[i].drawn);
        assert_near(scene->geometries[0].layers[1], rows[i].holes ? 150 : 200);
        finish();
        setup(NULL);
    }
    gn_maker_finish(&maker);
}

/* Each map has a share, a quarter of the limit at least, in which an instance counts a quarter of
 * the part of the map that it covers. */
static void test_maps_are_bounded(void **state) {
    (void)state;
    static const struct {
        int lights;
        uint32_t drawn;
    } rows[] = {{1, 40}, {2, 2 * 20}, {8, 8 * 10}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct gn_draw *draw;
        char json[200], list[60] = "[{'nodes':[0,1";
        if (i > 0) setup(NULL);
        set_instances(OPAQUE, 1000, 10);
        gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual','EXT_mesh_gpu_instancing']");
        gn_maker_set(&maker, "extensions",
                     "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':9}]}}");
        for (int k = 0; k < rows[i].lights; k++) {
            snprintf(json, sizeof json,
                     "{'translation':[%g,1,0],'rotation':[-0.70710678,0,0,0.70710678],"
                     "'extensions':{'KHR_lights_punctual':{'light':0}}}",
                     0.01 * k);
            gn_maker_add(&maker, "nodes", json);
            sprintf(list + strlen(list), ",%d", 2 + k);
        }
        gn_maker_set(&maker, "scenes", strcat(list, "]}]"));
        const struct gn_frame_opts opts = {.overdraw = 10};
        assert_int_equal(count_drawn(build(&opts), GN_PASS_MAP, &draw), rows[i].drawn);
        finish();
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_instances_over_the_limit_are_left_out, setup),
        cmocka_unit_test_setup(test_the_nearest_draw_stays, setup),
        cmocka_unit_test_setup(test_layers_of_one_mesh_count, setup),
        cmocka_unit_test_setup(test_a_posed_mesh_counts_as_it_lies, setup),
        cmocka_unit_test_setup(test_maps_are_bounded, setup),
    };
    return RUN(tests);
}
