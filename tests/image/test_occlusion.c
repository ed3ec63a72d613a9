/* The volume of occlusion against rays, and what takes part in it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/occlusion.h"
#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

static const struct gn_sky even = {.turn = {1, 0}};
static struct gn_err err;

static struct gn_occlusion_made make(const struct gn_scene *scene, const struct gn_sky *sky) {
    const struct gn_occlusion_work work = {.threads = 0};
    return gn_occlusion_make(scene, GN_POSE_NONE, sky, &work);
}

/* ---- exactness ---- */

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double score_scene(const char *name, struct gn_scene *scene, const struct gn_sky *sky) {
    const int side_px = gn_shot_full() ? 160 : 40;
    if (!scene) fail_msg("%s: %s", name, err.text);
    struct gn_occlusion_made made = make(scene, sky);
    if (!made.texels) fail_msg("%s: no volume", name);
    const struct gn_occlusion_score score =
        gn_occlusion_measure(scene, GN_POSE_NONE, sky, (const int8_t(*)[4])made.texels, side_px,
                             gn_shot_full() ? 1024 : 64);
    print_message("%s: %.4f of %.3f, error told %.4f\n", name, score.rmse, score.none,
                  (double)made.error);
    if (!(score.rmse < .05) || !(score.rmse < score.none / 3))
        fail_msg("%s: %g off, without occlusion %g", name, score.rmse, score.none);
    if (!(fabs(score.bias) < .01)) fail_msg("%s: %g too light", name, score.bias);
    if (!((double)made.error < 2 * score.rmse + .01))
        fail_msg("%s: tells an error of %g", name, (double)made.error);
    free(made.texels);
    gn_scene_destroy(scene);
    return score.rmse;
}

static void the_volume_is_near_the_rays(void **state) {
    static const char *const files[] = {"assets/bench/s1.glb", "assets/lessons/hut.glb",
                                        "assets/lessons/lean.glb"};
    enum { FILES = sizeof files / sizeof files[0], COUNT = GN_OCCLUSION_SCENES + FILES };
    /* light mostly from above and from one side */
    static const struct gn_sky aimed = {.radiance = {1, .6f, 0, .3f}, .turn = {1, 0}};
    double off[COUNT];
    (void)state;
    for (int i = 0; i < GN_OCCLUSION_SCENES; i++)
        off[i] = score_scene(gn_occlusion_names[i], gn_occlusion_scene(i, &err), &even);
    for (int i = 0; i < FILES; i++)
        off[GN_OCCLUSION_SCENES + i] =
            score_scene(files[i], gn_scene_load(files[i], NULL, NULL, &err), &even);
    qsort(off, COUNT, sizeof off[0], compare_doubles);
    if (!(off[COUNT / 2] < .02)) fail_msg("median %g", off[COUNT / 2]);
    score_scene("aimed pavilion", gn_occlusion_scene(GN_OCCLUSION_PAVILION, &err), &aimed);
}

static void any_number_of_threads_makes_the_same(void **state) {
    struct gn_scene *scene = gn_occlusion_scene(GN_OCCLUSION_TABLE, &err);
    struct gn_occlusion_made made[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        const struct gn_occlusion_work work = {.rays = 1 << 18, .threads = 1 + 4 * i};
        made[i] = gn_occlusion_make(scene, GN_POSE_NONE, &even, &work);
    }
    const uint32_t *size = scene->occlusion.size;
    assert_true(size[0] * size[1] * size[2] <= 32768);
    assert_memory_equal(made[0].texels, made[1].texels, 4 * size[0] * size[1] * size[2]);
    free(made[0].texels);
    free(made[1].texels);
    gn_scene_destroy(scene);
}

static void cancelled_work_makes_nothing(void **state) {
    struct gn_scene *scene = gn_occlusion_scene(GN_OCCLUSION_TABLE, &err);
    const atomic_bool cancel = true;
    const struct gn_occlusion_work work = {.cancel = &cancel};
    (void)state;
    assert_null(gn_occlusion_make(scene, GN_POSE_NONE, &even, &work).texels);
    gn_scene_destroy(scene);
}

/* ---- a plate under a lid: nodes 0 and 1, meshes 0 and 1 ---- */

static struct gn_maker maker;

/* A plate of 2 x 2 that faces up, and over it a lid of four times that, which is node 1. */
static void begin_lidded(const char *lid_material, const char *lid) {
    memset(&err, 0, sizeof err);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_add(&maker, "materials", lid_material);
    gn_maker_add(&maker, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}");
    gn_maker_add(&maker, "nodes", lid);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
}

#define LID       "'mesh':1,'translation':[0,0.5,0],'scale':[4,1,4]"
#define TWO_SIDED "'doubleSided':true"

static struct gn_scene *load_lidded(void) {
    struct gn_warnings warnings = {0};
    struct gn_scene *scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Which share of the sky the middle of the plate sees. */
static double share_of_plate(const struct gn_scene *scene, const struct gn_sky *sky, float side_m) {
    struct gn_occlusion o;
    double whole = 0;
    const struct gn_occlusion_site site = {
        .point_ws = {.1f, 0, .1f}, .normal_ws = {0, 1, 0}, .face_ws = {0, 1, 0}, .side_m = side_m};
    gn_occlusion_init(&o, scene, NULL, sky, NULL);
    const double light = gn_occlusion_cast(&o, &site, 0, 4096, &whole);
    gn_occlusion_finish(&o);
    return light / whole;
}

static double share_under(const char *lid_material, const char *lid) {
    begin_lidded(lid_material, lid);
    struct gn_scene *scene = load_lidded();
    const double share = share_of_plate(scene, &even, 4);
    gn_scene_destroy(scene);
    return share;
}

static void what_is_still_occludes(void **state) {
    (void)state;
    assert_true(share_under("{" TWO_SIDED "}", "{" LID "}") < .1);
    assert_true(share_under("{}", "{" LID "}") < .1); /* from both sides, as it casts */
    assert_true(share_under("{" TWO_SIDED ",'alphaMode':'BLEND','pbrMetallicRoughness':"
                            "{'baseColorFactor':[1,1,1,0.5]}}",
                            "{" LID "}") == 1);
    assert_true(share_under("{" TWO_SIDED ",'alphaMode':'MASK','pbrMetallicRoughness':"
                            "{'baseColorFactor':[1,1,1,0.2]}}",
                            "{" LID "}") == 1);
}

/* A lid as wide as twice its height over the middle of a ground, against the configuration factor
 * of a rectangle parallel to a point's plane (Howell, "A Catalog of Radiation Heat Transfer
 * Configuration Factors", C-11): whatever else there is, and however large that is. */
static void a_low_lid_in_a_large_scene(void **state) {
    static const struct {
        double ground_m, lid_m;
    } sizes[] = {{1e-3, 1e-4}, {1, .1}, {1e3, .003}, {1e4, .1}, {1e5, .1}, {1e5, .003}};
    const double right = 1 - 4 / M_PI * M_SQRT1_2 * atan(M_SQRT1_2);
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const double h = sizes[i].lid_m, half = sizes[i].ground_m / 2;
        const struct gn_occlusion_site site = {.normal_ws = {0, 1, 0}, .face_ws = {0, 1, 0}};
        struct gn_occlusion occlusion;
        char lid[120], ground[60];
        double whole = 0;
        snprintf(lid, sizeof lid, "{'mesh':1,'translation':[0,%.9g,0],'scale':[%.9g,1,%.9g]}", h, h,
                 h);
        snprintf(ground, sizeof ground, "{'mesh':0,'scale':[%.9g,1,%.9g]}", half, half);
        begin_lidded("{" TWO_SIDED "}", lid);
        gn_maker_add(&maker, "nodes", ground);
        gn_maker_set(&maker, "scenes", "[{'nodes':[1,2]}]");
        struct gn_scene *scene = load_lidded();
        gn_occlusion_init(&occlusion, scene, NULL, &even, NULL);
        const double seen = gn_occlusion_cast(&occlusion, &site, 0, 4096, &whole) / whole;
        print_message("%g m, lid %g m up: %.4f, right %.4f\n", 2 * half, h, seen, right);
        assert_true(fabs(seen - right) < .005);
        gn_occlusion_finish(&occlusion);
        gn_scene_destroy(scene);
    }
}

/* A plate 8 m wide has a lid of the same size a millimetre up, as a bottle a label that its file
 * has rounded to below the glass: they are one. Of a stick it is a lid, and so is what is higher.
 */
static void faces_that_touch_are_one(void **state) {
    static const struct {
        float side_m;
        const char *lid;
        double most; /* 1: all of the sky */
    } rows[] = {
        {4, "{'mesh':1,'translation':[0,0.001,0],'scale':[4,1,4]}", 1},
        {4, "{'mesh':1,'translation':[0,0.1,0],'scale':[4,1,4]}", .1},
        {.1f, "{'mesh':1,'translation':[0,0.001,0],'scale':[4,1,4]}", .1},
        {4, "{'mesh':1,'translation':[0,0.001,0],'scale':[0.12,1,0.12]}", .1},
        {0, "{'mesh':1,'translation':[0,0.001,0],'scale':[4,1,4]}", .1},
        {4, "{'mesh':1,'translation':[0.1,0,0.1],'rotation':[0.0871557,0,0,0.9961947]}", .995},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        begin_lidded("{" TWO_SIDED "}", rows[i].lid);
        struct gn_scene *scene = load_lidded();
        const double share = share_of_plate(scene, &even, rows[i].side_m);
        print_message("%zu: %.3f\n", i, share);
        if (rows[i].most == 1 ? share != 1 : share > rows[i].most)
            fail_msg("row %zu: %g", i, share);
        gn_scene_destroy(scene);
    }
}

/* The light of a bright zenith is behind the lid, more of it than of an even sky. */
static void a_sky_weighs_directions(void **state) {
    const struct gn_sky zenith = {.radiance = {1, .9f}, .turn = {1, 0}},
                        side = {.radiance = {1, 0, 0, .9f}, .turn = {1, 0}},
                        turned = {.radiance = {1, 0, 0, .9f}, .turn = {0, 1}};
    (void)state;
    begin_lidded("{" TWO_SIDED "}", "{'mesh':1,'translation':[2,0.5,0],'scale':[2,1,4]}");
    struct gn_scene *scene = load_lidded();
    const double of_even = share_of_plate(scene, &even, 4);
    assert_true(share_of_plate(scene, &side, 4) < of_even - .05); /* the lid is at +X */
    assert_true(fabs(share_of_plate(scene, &turned, 4) - of_even) < .03);
    gn_scene_destroy(scene);
    begin_lidded("{" TWO_SIDED "}", "{'mesh':1,'translation':[0,0.5,0],'scale':[0.4,1,0.4]}");
    scene = load_lidded();
    assert_true(share_of_plate(scene, &zenith, 4) < share_of_plate(scene, &even, 4) - .01);
    gn_scene_destroy(scene);
}

/* A clip of four seconds that moves the lid. */
static void move_lid(const char *path, const char *type, const float *keys, size_t bytes) {
    static const float times[4] = {0, 1.3f, 2.6f, 4};
    const int time =
        gn_maker_accessor(&maker, "SCALAR", 5126, 4, times, sizeof times, "'min':[0],'max':[4]");
    const int place = gn_maker_accessor(&maker, type, 5126, 4, keys, bytes, NULL);
    char json[200];
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':"
             "{'node':1,'path':'%s'}}]}",
             time, place, path);
    gn_maker_add(&maker, "animations", json);
}

static void what_leaves_its_place_does_not(void **state) {
    static const float places[4][3] = {{0, .5f, 0}, {0, 1, 0}, {0, 2, 0}, {0, .5f, 0}};
    (void)state;
    begin_lidded("{" TWO_SIDED "}", "{" LID "}");
    move_lid("translation", "VEC3", places[0], sizeof places);
    struct gn_scene *scene = load_lidded();
    assert_true(share_of_plate(scene, &even, 4) == 1);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        const bool moves = strcmp(scene->nodes[item->node].name, "floor") == 0 ||
                           scene->materials[item->material].double_sided;
        assert_true(item->stays == !moves);
        assert_true(gn_item_is_occluded(scene, item) == !moves);
    }
    gn_scene_destroy(scene);
}

/* Without clips, by default, and by the first three. The scene is destroyed. */
static void score_clips(const char *name, struct gn_scene *scene) {
    if (!scene) fail_msg("%s: %s", name, err.text);
    uint32_t occluded = 0;
    for (uint32_t i = 0; i < scene->item_count; i++)
        occluded += gn_item_is_occluded(scene, &scene->items[i]);
    print_message("%s: %u of %u occluded\n", name, occluded, scene->item_count);
    if (occluded < (scene->item_count * 3 + 3) / 4) fail_msg("%s: %u occluded", name, occluded);
    for (int clips = GN_POSE_NONE; clips < 3; clips++) {
        const struct gn_occlusion_work work = {.threads = 0};
        struct gn_occlusion_made made = gn_occlusion_make(scene, clips, &even, &work);
        if (!made.texels && clips <= 0) fail_msg("%s, clip %d: no volume", name, clips);
        if (!made.texels) continue; /* it would be too far off */
        const struct gn_occlusion_score score = gn_occlusion_measure(
            scene, clips, &even, (const int8_t(*)[4])made.texels, gn_shot_full() ? 120 : 30, 64);
        print_message("%s, clip %d: %.4f of %.3f\n", name, clips, score.rmse, score.none);
        if (!(score.rmse < score.none / (clips == GN_POSE_NONE ? 3 : 2)) || !(score.p999 < .8))
            fail_msg("%s, clip %d: %g off, 1 of 1000 %g; without occlusion %g", name, clips,
                     score.rmse, score.p999, score.none);
        free(made.texels);
    }
    gn_scene_destroy(scene);
}

static void what_moves_near_its_place_does_in_the_mean(void **state) {
    static const float s = .8660254f,
                       turns[4][4] = {{0, 0, 0, 1}, {0, s, 0, .5f}, {0, s, 0, -.5f}, {0, 0, 0, -1}},
                       tilts[4][4] = {{0, 0, .1f, .995f},
                                      {0, 0, .3f, .954f},
                                      {0, 0, 0, 1},
                                      {0, 0, .1f, .995f}};
    static const float lifts[4][3] = {{0, .4f, 0}, {.1f, .4f, 0}, {-.1f, .5f, 0}, {0, .4f, 0}};
    const char *shared = getenv("GNOMON_SHARED");
    char path[600];
    (void)state;
    begin_lidded("{" TWO_SIDED "}", "{'mesh':1,'translation':[0,0.4,0],'scale':[0.9,1,0.4]}");
    move_lid("rotation", "VEC4", turns[0], sizeof turns);
    move_lid("rotation", "VEC4", tilts[0], sizeof tilts);
    move_lid("translation", "VEC3", lifts[0], sizeof lifts);
    score_clips("a lid", load_lidded());
    static const char *const models[] = {"robot.glb", "Fox.glb"}; /* of parts; with a skin */
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%.500s/assets/gltf/%s", shared ? shared : "../shared",
                 models[i]);
        if (access(path, R_OK) == 0)
            score_clips(models[i], gn_scene_load(path, NULL, NULL, &err));
        else
            print_message("[  SKIPPED ] %s is not here\n", path);
    }
}

/* Between two plates there is nothing that rays could measure. */
static void nothing_is_dark_where_nothing_is(void **state) {
    (void)state;
    begin_lidded("{}", "{'mesh':1,'translation':[40,0,0]}");
    struct gn_scene *scene = load_lidded();
    struct gn_occlusion_made made = make(scene, &even);
    assert_non_null(made.texels);
    for (int i = 0; i < 3; i++) {
        const float normal[3] = {i == 0, i == 1, i == 2};
        const float read = gn_occlusion_read(&scene->occlusion, (const int8_t(*)[4])made.texels,
                                             (const double[3]){20, 0, 0}, normal);
        if (!(read > .98f)) fail_msg("%g along %d", (double)read, i);
    }
    free(made.texels);
    gn_scene_destroy(scene);
}

static void a_posed_mesh_is_still_without_clips(void **state) {
    (void)state;
    gn_maker_init(&maker);
    gn_maker_posed_square(&maker);
    struct gn_scene *scene = load_lidded();
    assert_true(scene->occlusion.size[0] > 0);
    assert_true(gn_item_is_occluded(scene, &scene->items[0]));
    gn_scene_destroy(scene);
}

/* The underside of a body near the unseen floor sees less of the light there. */
static void the_unseen_floor_is_in_the_way(void **state) {
    double shares[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct gn_warnings warnings = {0};
        const struct gn_scene_limits limits = {.floor.kind = i ? GN_FLOOR_AUTO : GN_FLOOR_NONE};
        gn_maker_init(&maker);
        gn_maker_cube(&maker);
        gn_maker_add(&maker, "nodes", "{'mesh':0}");
        gn_maker_add(&maker, "scenes", "{'nodes':[0]}");
        struct gn_made glb = gn_maker_glb(&maker);
        struct gn_scene *scene =
            gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
        if (!scene) fail_msg("%s", err.text);
        struct gn_occlusion o;
        double whole = 0;
        const struct gn_occlusion_site site = {
            .point_ws = {1, -.95f, 0}, .normal_ws = {1, 0, 0}, .face_ws = {1, 0, 0}};
        gn_occlusion_init(&o, scene, NULL, &even, NULL);
        shares[i] = gn_occlusion_cast(&o, &site, 0, 4096, &whole) / whole;
        gn_occlusion_finish(&o);
        gn_scene_destroy(scene);
        gn_maker_finish(&maker);
        free(glb.data);
    }
    assert_true(shares[0] == 1);
    assert_true(shares[1] < .9 && shares[1] > .5);
}

/* A cube of the grid is as large as all there is to see. */
static void a_small_thing_far_off_leaves_none(void **state) {
    (void)state;
    begin_lidded("{" TWO_SIDED "}", "{'mesh':1,'translation':[0,0.5,0]}");
    gn_maker_add(&maker, "nodes", "{'mesh':0,'translation':[3000,0,0]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    struct gn_scene *scene = load_lidded();
    assert_null(make(scene, &even).texels);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_volume_is_near_the_rays),
        cmocka_unit_test(any_number_of_threads_makes_the_same),
        cmocka_unit_test(cancelled_work_makes_nothing),
        cmocka_unit_test(what_is_still_occludes),
        cmocka_unit_test(a_low_lid_in_a_large_scene),
        cmocka_unit_test(faces_that_touch_are_one),
        cmocka_unit_test(a_sky_weighs_directions),
        cmocka_unit_test(what_leaves_its_place_does_not),
        cmocka_unit_test(what_moves_near_its_place_does_in_the_mean),
        cmocka_unit_test(nothing_is_dark_where_nothing_is),
        cmocka_unit_test(a_posed_mesh_is_still_without_clips),
        cmocka_unit_test(the_unseen_floor_is_in_the_way),
        cmocka_unit_test(a_small_thing_far_off_leaves_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
