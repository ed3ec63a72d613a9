/* The unseen floor that the loader adds: when, where, and what of the sky it sees, against rays. */
#include <math.h>

#include "scene/pose.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* A cube of side 2 that stands on y = 0, and more. */
static struct gn_scene *load(const char *more, enum gn_floor kind, float height_m) {
    struct gn_maker maker;
    struct gn_err err = {0};
    char nodes[300], scenes[60];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    snprintf(nodes, sizeof nodes, "[{'mesh':1,'translation':[0,1,0]}%s]", more);
    snprintf(scenes, sizeof scenes, "[{'nodes':[0%s]}]", more[0] ? ",1" : "");
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "scenes", scenes);
    const struct gn_scene_limits limits = {.floor = {.kind = kind, .height_m = height_m}};
    struct gn_made glb = gn_maker_glb(&maker);
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    free(glb.data);
    gn_maker_finish(&maker);
    return scene;
}

static const struct gn_item *find_floor(const struct gn_scene *scene) {
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->materials[scene->items[i].material].shadow_catcher) return &scene->items[i];
    return NULL;
}

static void test_it_is_added_where_there_is_none(void **state) {
    (void)state;
    struct gn_scene *scene = load("", GN_FLOOR_AUTO, 0);
    const struct gn_item *floor = find_floor(scene);
    assert_non_null(floor);
    assert_true(scene->added.floor && floor->receives && !floor->casts && floor->plane == 1);
    assert_float_equal(scene->nodes[floor->node].translation[1], 0, 2e-3);
    assert_float_equal(scene->box.max[0], 1, 1e-6); /* it is not part of the model */
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    assert_float_equal(pose.box_ws.max[0], 1, 1e-6);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    scene = load("", GN_FLOOR_NONE, 0);
    assert_true(!find_floor(scene) && !scene->added.floor);
    gn_scene_destroy(scene);
}

static void test_a_ground_is_a_floor(void **state) {
    (void)state;
    static const struct {
        const char *more;
        bool adds;
    } cases[] = {
        {",{'mesh':0,'scale':[3,1,3]}", false},
        {",{'mesh':0,'scale':[3,1,3],'rotation':[1,0,0,0]}", true}, /* it faces down */
        {",{'mesh':0,'scale':[3,1,3],'translation':[0,1,0]}", true},
        {",{'mesh':1,'scale':[3,0.05,3],'translation':[0,-0.05,0]}", false}, /* a slab */
        {",{'mesh':0,'translation':[0,0,9]}", true}, /* under little of it */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct gn_scene *scene = load(cases[i].more, GN_FLOOR_AUTO, 0);
        if ((find_floor(scene) != NULL) != cases[i].adds) fail_msg("case %zu", i);
        gn_scene_destroy(scene);
    }
}

static void test_its_height_can_be_given(void **state) {
    (void)state;
    struct gn_scene *scene = load(",{'mesh':0,'scale':[3,1,3]}", GN_FLOOR_HEIGHT, -.5f);
    assert_float_equal(scene->nodes[find_floor(scene)->node].translation[1], -.5, 1e-6);
    gn_scene_destroy(scene);
}

/* Whether a ray from the floor meets the cube [-1, 1] x [0, 2] x [-1, 1]. */
static bool meets_cube(const double from[3], const double along[3]) {
    static const double least[3] = {-1, 0, -1}, most[3] = {1, 2, 1};
    double enters = 0, leaves = 1e9;
    for (int k = 0; k < 3; k++) {
        const double a = (least[k] - from[k]) / along[k], b = (most[k] - from[k]) / along[k];
        enters = fmax(enters, fmin(a, b));
        leaves = fmin(leaves, fmax(a, b));
    }
    return enters < leaves;
}

static double sky_by_rays(double x, double z) {
    enum { TURNS = 90, RINGS = 45 };
    int seen = 0;
    for (int t = 0; t < TURNS; t++)
        for (int r = 0; r < RINGS; r++) { /* equal shares, weighted by the cosine */
            const double aside = sqrt((r + .5) / RINGS), turn = (t + .37) * 2 * acos(-1) / TURNS;
            seen += !meets_cube(
                (double[3]){x, 1e-6, z},
                (double[3]){aside * cos(turn), sqrt(1 - aside * aside), aside * sin(turn)});
        }
    return seen / (double)(TURNS * RINGS);
}

static void test_it_sees_as_much_of_the_sky_as_rays_do(void **state) {
    (void)state;
    struct gn_scene *scene = load("", GN_FLOOR_AUTO, 0);
    const struct gn_item *floor = find_floor(scene);
    const int32_t texture =
        scene->materials[floor->material].textures[GN_TEXTURE_OCCLUSION].texture;
    const struct gn_image *image = &scene->pictures.images[scene->pictures.textures[texture].image];
    const double side = (double)(scene->nodes[floor->node].scale[0] * GN_FLOOR_OCCLUDED);
    const double texel = side / image->width_px;
    double most = 0, sum = 0;
    int count = 0;
    for (uint32_t z = 0; z < image->height_px; z++)
        for (uint32_t x = 0; x < image->width_px; x++) {
            const double px = (x + .5) * texel - side / 2, pz = (z + .5) * texel - side / 2;
            const double aside = fmax(fabs(px), fabs(pz));
            if (aside > side * .28) continue; /* where it fades out */
            const double sky = image->rgba[4 * (z * image->width_px + x)] / 255.0;
            if (aside < 1 - 2 * texel) assert_float_equal(sky, 0, .02); /* under the cube */
            if (aside < 1 + 2 * texel) continue;
            const double wrong = fabs(sky - sky_by_rays(px, pz));
            most = fmax(most, wrong);
            sum += wrong;
            count++;
        }
    print_message("sky: wrong by %.3f on average, at most %.3f, of %d texels\n", sum / count, most,
                  count);
    assert_true(count > 200);
    assert_true(sum / count < .03 && most < .08);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_it_is_added_where_there_is_none),
        cmocka_unit_test(test_a_ground_is_a_floor),
        cmocka_unit_test(test_its_height_can_be_given),
        cmocka_unit_test(test_it_sees_as_much_of_the_sky_as_rays_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
