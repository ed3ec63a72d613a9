/* The unseen floor that the loader adds: when, where, and what of the sky it sees, against rays. */
#include <math.h>
#include <string.h>

#include "scene/pose.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* Mesh 0 is a square, mesh 1 a cube of side 2 about its middle, meshes 2 and 3 a cube
 * and a square that faces down, of both sides, mesh 4 a cube that faces inwards. places: from where
 * to where node 0 goes in a second; NULL: nowhere. */
static struct gn_scene *load_moving(const char *nodes, const char *scenes, enum gn_floor kind,
                                    float height_m, const float (*places)[3]) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_add(&maker, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':2},'indices':3,'material':0}]}");
    const int down = gn_maker_accessor(&maker, "SCALAR", 5123, 6,
                                       (const uint16_t[]){0, 2, 1, 0, 3, 2}, 12, NULL);
    char mesh[100];
    snprintf(mesh, sizeof mesh,
             "{'primitives':[{'attributes':{'POSITION':0},'indices':%d,'material':0}]}", down);
    gn_maker_add(&maker, "meshes", mesh);
    uint16_t inwards[36];
    for (int i = 0; i < 36; i++)
        inwards[i] = (uint16_t)(i / 6 * 4 + (const int[]){0, 2, 1, 0, 3, 2}[i % 6]);
    snprintf(mesh, sizeof mesh, "{'primitives':[{'attributes':{'POSITION':2},'indices':%d}]}",
             gn_maker_accessor(&maker, "SCALAR", 5123, 36, inwards, sizeof inwards, NULL));
    gn_maker_add(&maker, "meshes", mesh);
    gn_maker_set(&maker, "materials", "[{'doubleSided':true}]");
    gn_maker_set(&maker, "cameras", "[{'type':'perspective','perspective':{'yfov':1,'znear':1}}]");
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "scenes", scenes);
    if (places) {
        char clip[200];
        const int in = gn_maker_accessor(&maker, "SCALAR", 5126, 2, (const float[]){0, 1}, 8,
                                         "'min':[0],'max':[1]");
        snprintf(clip, sizeof clip,
                 "{'samplers':[{'input':%d,'output':%d}],"
                 "'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]}",
                 in, gn_maker_accessor(&maker, "VEC3", 5126, 2, places, 24, NULL));
        gn_maker_add(&maker, "animations", clip);
    }
    const struct gn_scene_limits limits = {.floor = {.kind = kind, .height_m = height_m}};
    struct gn_made glb = gn_maker_glb(&maker);
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    free(glb.data);
    gn_maker_finish(&maker);
    return scene;
}

static struct gn_scene *load_nodes(const char *nodes, const char *scenes, enum gn_floor kind,
                                   float height_m) {
    return load_moving(nodes, scenes, kind, height_m, NULL);
}

/* A cube of side 2 that stands on y = 0, and more. */
static struct gn_scene *load(const char *more, enum gn_floor kind, float height_m) {
    char nodes[300];
    snprintf(nodes, sizeof nodes, "[{'mesh':1,'translation':[0,1,0]}%s]", more);
    return load_nodes(nodes, more[0] ? "[{'nodes':[0,1]}]" : "[{'nodes':[0]}]", kind, height_m);
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

/* The underside of a body of both sides is no floor, but a ground that faces down is, and what lies
 * under a roof. */
static void test_what_lies_under_the_model_is_no_floor(void **state) {
    (void)state;
    static const struct {
        const char *nodes, *list;
        bool adds;
    } cases[] = {
        {"[{'mesh':2,'translation':[0,1,0]}]", "[{'nodes':[0]}]", true},
        {"[{'mesh':0,'scale':[3,1,3]},{'mesh':0,'translation':[0,2,0],'scale':[3,1,3]}]",
         "[{'nodes':[0,1]}]", false},
        {"[{'mesh':2,'scale':[3,0.01,3]},{'mesh':2,'translation':[0,1,0]}]", "[{'nodes':[0,1]}]",
         false},
        {"[{'mesh':3,'scale':[3,1,3]},{'mesh':2,'translation':[0,1,0]}]", "[{'nodes':[0,1]}]",
         false},
        {"[{'mesh':3,'scale':[0.9,1,0.9]},{'mesh':2,'translation':[0,1.1,0]}]", "[{'nodes':[0,1]}]",
         true},
        {"[{'mesh':3,'scale':[0.9,1,0.9]},{'mesh':2,'translation':[0,2,0]}]", "[{'nodes':[0,1]}]",
         true},
        {"[{'mesh':4,'translation':[0,1,0]}]", "[{'nodes':[0]}]", true}, /* it faces inwards */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct gn_scene *scene = load_nodes(cases[i].nodes, cases[i].list, GN_FLOOR_AUTO, 0);
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

/* ---- what of the sky it sees ---- */

enum { BOXES_MAX = 9 };
struct box {
    double least[3], most[3];
    double turn_rad; /* about the vertical axis through its middle */
};
#define THIN .02 /* half of it is less than half a texel in all of these models */
#define POST(x, z)                                                                                 \
    { {x - .015, 0, z - .015}, {x + .015, .8, z + .015}, 0 }
/* Models of boxes that stand on y = 0, or over it; limits on the mean and the largest error, and
 * on that along circles about the middle, where a model is round enough. */
static const struct model {
    const char *name;
    int count;
    struct box boxes[BOXES_MAX];
    double mean, most, ring;
    double goes[3]; /* of the first box, in a second */
    bool leaves;    /* so far that it has no occlusion */
} models[] = {
    {"cube", 1, {{{-1, 0, -1}, {1, 2, 1}, 0}}, .008, .10, .01, {0}, false},
    {"post", 1, {{{-.04, 0, -.04}, {.04, 2, .04}, 0}}, .010, .08, .05, {0}, false},
    {"wall", 1, {{{-1, 0, -.01}, {1, 1, .01}, 0}}, .010, .05, .03, {0}, false},
    {"board", 1, {{{-.7, .6, -.7}, {.7, .65, .7}, 0}}, .014, .04, .01, {0}, false},
    {"table",
     3,
     {{{-1, .95, -.6}, {1, 1, .6}, 0},
      {{-.9, 0, -.03}, {-.85, 1, .03}, 0},
      {{.85, 0, -.03}, {.9, 1, .03}, 0}},
     .024,
     .13,
     .05,
     {0},
     false},
    {"wall at an angle", 1, {{{-1, 0, -.005}, {1, 1, .005}, .35}}, .011, .11, .06, {0}, false},
    {"low wall at an angle", 1, {{{-1, 0, -.002}, {1, .3, .002}, .8}}, .011, .16, .045, {0}, false},
    {"crossed walls",
     2,
     {{{-1, 0, -.005}, {1, .7, .005}, .2}, {{-1, 0, -.005}, {1, .7, .005}, 1.3}},
     .018,
     .16,
     .08,
     {0},
     false},
    {"posts",
     9,
     {POST(-.6, -.6), POST(0, -.6), POST(.6, -.6), POST(-.6, 0), POST(0, 0), POST(.6, 0),
      POST(-.6, .6), POST(0, .6), POST(.6, .6)},
     .036,
     .12,
     .085,
     {0},
     false},
    {"open box",
     4,
     {{{-.805, 0, -.6}, {-.795, .5, .6}, 0},
      {{.795, 0, -.6}, {.805, .5, .6}, 0},
      {{-.8, 0, -.605}, {.8, .5, -.595}, 0},
      {{-.8, 0, .595}, {.8, .5, .605}, 0}},
     .019,
     .12,
     .012,
     {0},
     false},
    {"board that rises",
     1,
     {{{-.7, .3, -.7}, {.7, .35, .7}, 0}},
     .009,
     .03,
     .01,
     .goes = {0, 2, 0}},
    {"board that sways",
     1,
     {{{-.7, .3, -.7}, {.7, .35, .7}, 0}},
     .009,
     .03,
     .02,
     .goes = {.4, 0, .2}},
    {"board that leaves",
     1,
     {{{-.7, .3, -.7}, {.7, .35, .7}, 0}},
     .001,
     .01,
     .01,
     .goes = {0, 0, 3},
     .leaves = true},
};

static struct gn_scene *load_model(const struct model *model) {
    char nodes[1200] = "", list[40] = "";
    for (int i = 0; i < model->count; i++) {
        const struct box *b = &model->boxes[i];
        const size_t at = strlen(nodes), end = strlen(list);
        snprintf(
            nodes + at, sizeof nodes - at,
            "%s{'mesh':1,'rotation':[0,%.9g,0,%.9g],'translation':[%g,%g,%g],'scale':[%g,%g,%g]}",
            i ? "," : "[", sin(b->turn_rad / 2), cos(b->turn_rad / 2),
            (b->least[0] + b->most[0]) / 2, (b->least[1] + b->most[1]) / 2,
            (b->least[2] + b->most[2]) / 2, (b->most[0] - b->least[0]) / 2,
            (b->most[1] - b->least[1]) / 2, (b->most[2] - b->least[2]) / 2);
        snprintf(list + end, sizeof list - end, "%s%d", i ? "," : "[{'nodes':[", i);
    }
    const struct box *b = &model->boxes[0];
    float places[2][3];
    bool goes = false;
    for (int k = 0; k < 3; k++) {
        places[0][k] = (float)((b->least[k] + b->most[k]) / 2);
        places[1][k] = places[0][k] + (float)model->goes[k];
        goes |= model->goes[k] != 0;
    }
    return load_moving(strcat(nodes, "]"), strcat(list, "]}]"), GN_FLOOR_HEIGHT, 0,
                       goes ? places : NULL);
}

/* A vector as seen from a box that is turned so far. */
static void turn_back(double c, double s, double v[3]) {
    const double x = v[0];
    v[0] = c * x - s * v[2];
    v[2] = s * x + c * v[2];
}

/* A box as a ray meets it that begins at a given point. */
struct target {
    double place[3], half[3], c, s;
};

static struct target aim(const struct box *box, const double from[3]) {
    struct target target = {.c = cos(box->turn_rad), .s = sin(box->turn_rad)};
    for (int k = 0; k < 3; k++) {
        target.place[k] = from[k] - (box->least[k] + box->most[k]) / 2;
        target.half[k] = (box->most[k] - box->least[k]) / 2;
    }
    turn_back(target.c, target.s, target.place);
    return target;
}

static bool meets(const struct target *target, const double along[3]) {
    double enters = 0, leaves = 1e9, way[3] = {along[0], along[1], along[2]};
    turn_back(target->c, target->s, way);
    for (int k = 0; k < 3; k++) {
        const double a = (-target->half[k] - target->place[k]) / way[k],
                     b = (target->half[k] - target->place[k]) / way[k];
        const double near = a < b ? a : b, far = a < b ? b : a;
        enters = near > enters ? near : enters;
        leaves = far < leaves ? far : leaves;
        if (enters >= leaves) return false;
    }
    return true;
}

enum { TURNS = 180, RINGS = 30, RAYS = TURNS * RINGS };

/* Equal shares of the sky, weighted by the cosine. */
static const double (*sky_rays(void))[3] {
    static double rays[RAYS][3];
    for (int i = 0; i < RAYS && rays[RAYS - 1][1] == 0; i++) {
        const double aside = sqrt((i % RINGS + .5) / RINGS),
                     turn = (i / RINGS + .37) * 2 * acos(-1) / TURNS;
        rays[i][0] = aside * cos(turn);
        rays[i][1] = sqrt(1 - aside * aside);
        rays[i][2] = aside * sin(turn);
    }
    return (const double(*)[3])rays;
}

static double sky_at(const struct model *model, const double from[3]) {
    const double(*rays)[3] = sky_rays();
    struct target targets[BOXES_MAX];
    int seen = 0;
    for (int i = 0; i < model->count; i++) targets[i] = aim(&model->boxes[i], from);
    for (int r = 0; r < RAYS; r++) {
        bool met = false;
        for (int i = 0; i < model->count && !met; i++) met = meets(&targets[i], rays[r]);
        seen += !met;
    }
    return seen / (double)RAYS;
}

/* Whether a point of the floor is inside of what is thinner than a texel: nobody sees it. */
static bool is_in_wall(const struct model *model, double x, double z) {
    bool inside = false;
    for (int i = 0; i < model->count; i++) {
        const struct box *b = &model->boxes[i];
        double at[3] = {x - (b->least[0] + b->most[0]) / 2, 0, z - (b->least[2] + b->most[2]) / 2};
        const double half[2] = {(b->most[0] - b->least[0]) / 2, (b->most[2] - b->least[2]) / 2};
        turn_back(cos(b->turn_rad), sin(b->turn_rad), at);
        inside |= fmin(half[0], half[1]) < THIN && fabs(at[0]) <= half[0] && fabs(at[2]) <= half[1];
    }
    return inside;
}

/* On average over four poses, if it moves. */
static double sky_by_rays(const struct model *model, double x, double z) {
    double sum = 0;
    if (model->leaves) return 1;
    if (!model->goes[0] && !model->goes[1]) return sky_at(model, (double[3]){x, 1e-6, z});
    for (int p = 0; p < 4; p++) /* it goes one way as the floor goes the other */
        sum +=
            sky_at(model, (double[3]){x - p / 4.0 * model->goes[0], 1e-6 - p / 4.0 * model->goes[1],
                                      z - p / 4.0 * model->goes[2]});
    return sum / 4;
}

/* How far it is from what rays see, at each texel that does not fade out. */
static void compare_sky(const struct model *model) {
    struct gn_scene *scene = load_model(model);
    const struct gn_item *floor = find_floor(scene);
    const int32_t texture =
        scene->materials[floor->material].textures[GN_TEXTURE_OCCLUSION].texture;
    const struct gn_image *image = &scene->pictures.images[scene->pictures.textures[texture].image];
    const double side = (double)(scene->nodes[floor->node].scale[0] * GN_FLOOR_OCCLUDED);
    const float *middle = scene->nodes[floor->node].translation;
    const double texel = side / image->width_px;
    double most = 0, sum = 0, ring[2] = {1, -1};
    int count = 0;
    for (uint32_t z = 0; z < image->height_px; z++)
        for (uint32_t x = 0; x < image->width_px; x++) {
            const double px = (x + .5) * texel - side / 2, pz = (z + .5) * texel - side / 2;
            if (fmax(fabs(px), fabs(pz)) > side * .28) continue; /* where it fades out */
            if (is_in_wall(model, px + (double)middle[0], pz + (double)middle[2])) continue;
            const double sky = image->rgba[4 * (z * image->width_px + x)] / 255.0;
            const double right = sky_by_rays(model, px + (double)middle[0], pz + (double)middle[2]);
            const double wrong = sky - right;
            const double r = hypot(px, pz) / texel;
            if (r > 8 && r < 9) ring[0] = fmin(ring[0], wrong), ring[1] = fmax(ring[1], wrong);
            most = fmax(most, fabs(wrong));
            sum += fabs(wrong);
            count++;
        }
    print_message(
        "%s: sky wrong by %.4f on average, at most %.3f, on a circle %.3f, of %d texels\n",
        model->name, sum / count, most, ring[1] - ring[0], count);
    assert_true(count > 200);
    assert_true(sum / count < model->mean && most < model->most && ring[1] - ring[0] < model->ring);
    gn_scene_destroy(scene);
}

static void test_it_sees_as_much_of_the_sky_as_rays_do(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) compare_sky(&models[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_it_is_added_where_there_is_none),
        cmocka_unit_test(test_a_ground_is_a_floor),
        cmocka_unit_test(test_what_lies_under_the_model_is_no_floor),
        cmocka_unit_test(test_its_height_can_be_given),
        cmocka_unit_test(test_it_sees_as_much_of_the_sky_as_rays_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
