#include "image/penumbra.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/shot.h"
#include "unit/gltf_maker.h"

/* ---- scenes ---- */

/* Bars of .12 m, 5 m up, and a trellis of bars of .08 m, 4 m up; below them posts and walls of 1 to
 * 1.4 m. */
#define THIN                                                                                       \
    "{'mesh':1,'translation':[-2,5,0],'rotation':[0,0.1305,0,0.9914],'scale':[0.06,0.06,4]},"      \
    "{'mesh':1,'translation':[-1.1,5,0.4],'rotation':[0,0.1305,0,0.9914],'scale':[0.06,0.06,4]},"  \
    "{'mesh':1,'translation':[-0.9,4,-0.2],'scale':[0.04,0.04,1.5]},"                              \
    "{'mesh':1,'translation':[-0.4,4,-0.2],'scale':[0.04,0.04,1.5]},"                              \
    "{'mesh':1,'translation':[0.1,4,-0.2],'scale':[0.04,0.04,1.5]},"                               \
    "{'mesh':1,'translation':[-0.4,4,-0.9],'scale':[1,0.04,0.04]},"                                \
    "{'mesh':1,'translation':[-0.4,4,0.5],'scale':[1,0.04,0.04]},"                                 \
    "{'mesh':1,'translation':[0,0.7,1],'rotation':[0,0.2588,0,0.9659],'scale':[0.15,0.7,0.15]},"   \
    "{'mesh':1,'translation':[1.2,0.5,-1.2],'scale':[0.2,0.5,0.2]},"                               \
    "{'mesh':1,'translation':[2.2,0.6,0.6],'rotation':[0,0.1305,0,0.9914],'scale':[0.2,0.6,0.2]}," \
    "{'mesh':1,'translation':[0.3,0.5,-2],'rotation':[0,0.1305,0,0.9914],'scale':[0.05,0.5,1]},"   \
    "{'mesh':1,'translation':[1.5,0.5,2.4],'rotation':[0,0.1736,0,0.9848],'scale':[1.5,0.5,0.05]}"

/* Nodes with mesh 0 (a square of 2 m) or 1 (a cube of 2 m). */
static const struct {
    const char *name, *nodes;
    enum gn_light_type type;
    double radius, light_up_m; /* a lamp is at x .5, z .3 and looks down; at x -3.5 in the seam's
                                  scene and the thin ones */
    const char *sun;           /* rotation; NULL: straight down */
    const char *eye;           /* NULL: from the side */
    double ground_m;           /* half the side of a slab; 0: a square, 12 */
} scenes[GN_PENUMBRA_ALL] = {
    [GN_PENUMBRA_LOW] = {"low", "{'mesh':0,'translation':[0,1,0],'scale':[1.2,1,0.8]}",
                         GN_LIGHT_SPOT, 0.3, .light_up_m = 9},
    [GN_PENUMBRA_MIDDLE] = {"middle",
                            "{'mesh':0,'translation':[0,2,0],'rotation':[0,0.2588,0,0.9659],"
                            "'scale':[1,1,1]}",
                            GN_LIGHT_SPOT, 0.8, .light_up_m = 9},
    [GN_PENUMBRA_HIGH] = {"high", "{'mesh':0,'translation':[0,4,0],'scale':[1.5,1,1]}",
                          GN_LIGHT_SPOT, 1.5, .light_up_m = 9},
    [GN_PENUMBRA_BOX] = {"box",
                         "{'mesh':1,'translation':[0,2.5,0],'rotation':[0.2,0.3,0.1,0.9274],"
                         "'scale':[0.8,0.5,0.6]}",
                         GN_LIGHT_SPOT, 0.6, .light_up_m = 9},
    [GN_PENUMBRA_BARS] = {"bars",
                          "{'mesh':1,'translation':[-1.5,1,0],'scale':[0.2,0.2,2]},"
                          "{'mesh':1,'translation':[0,2,0],'scale':[0.2,0.2,2]},"
                          "{'mesh':1,'translation':[1.5,3,0],'scale':[0.2,0.2,2]}",
                          GN_LIGHT_DIRECTIONAL, 0.08, 0, /* 40 degrees off */
                          .sun = "-0.5577,-0.1494,-0.1002,0.8102"},
    [GN_PENUMBRA_LEAN] = {"lean",
                          "{'mesh':0,'translation':[0,1,0],'rotation':[0,0,0.4226,0.9063],"
                          "'scale':[1.3054,1,1.5]}",
                          GN_LIGHT_SPOT, 0.6, .light_up_m = 9},
    [GN_PENUMBRA_BULB] = {"bulb",
                          "{'mesh':0,'translation':[0,2,0],'rotation':[0,0.2588,0,0.9659],"
                          "'scale':[1,1,0.7]},"
                          "{'mesh':1,'translation':[-2.2,1,0],'scale':[0.2,0.2,1.5]}",
                          GN_LIGHT_POINT, 0.6, .light_up_m = 6},
    [GN_PENUMBRA_SEAM] = {"seam",
                          "{'mesh':0,'translation':[-1,1.5,-0.8],'rotation':[0,0.2588,0,0.9659],"
                          "'scale':[0.6,1,0.6]},"
                          "{'mesh':1,'translation':[-0.6,1.2,1.2],'rotation':[0,0.3827,0,0.9239],"
                          "'scale':[1,0.1,0.15]}",
                          GN_LIGHT_POINT, 0.4, .light_up_m = 4},
    [GN_PENUMBRA_FIELD] = {"field",
                           "{'mesh':1,'translation':[-7,1.5,-130],'scale':[0.25,1.5,128]},"
                           "{'mesh':1,'translation':[-4,5,-130],'scale':[0.25,0.25,128]},"
                           "{'mesh':1,'translation':[3,3,-4],'scale':[0.2,3,0.2]},"
                           "{'mesh':1,'translation':[5,3,-12],'scale':[0.2,3,0.2]},"
                           "{'mesh':1,'translation':[7,3,-40],'scale':[0.2,3,0.2]},"
                           "{'mesh':1,'translation':[9,3,-90],'scale':[0.2,3,0.2]}",
                           GN_LIGHT_DIRECTIONAL, 0.05, 0, .sun = "-0.332,-0.4814,-0.2035,0.7852",
                           .eye = "'translation':[0,2.2,0],'rotation':[-0.0899,0,0,0.996]", 450},
    [GN_PENUMBRA_EDGE] = {"edge", "{'mesh':0,'translation':[-6,3,0],'scale':[6,1,20]}",
                          GN_LIGHT_DIRECTIONAL, 0.15, 0,
                          .eye = "'translation':[0,2.5,0],"
                                 "'rotation':[-0.70710678,0,0,0.70710678]"}, /* straight above */
    [GN_PENUMBRA_THIN_SUN] = {"thin-sun", THIN, GN_LIGHT_DIRECTIONAL, 0.06, 0,
                              .sun = "-0.4686,-0.3748,-0.0000,0.8000"},
    [GN_PENUMBRA_THIN_SPOT] = {"thin-spot", THIN, GN_LIGHT_SPOT, 0.5, .light_up_m = 9},
    [GN_PENUMBRA_THIN_POINT] = {"thin-point", THIN, GN_LIGHT_POINT, 0.5, .light_up_m = 8},
};
const char *const gn_penumbra_names[GN_PENUMBRA_ALL] = {
    "low",  "middle", "high", "box",      "bars",      "lean",      "bulb",
    "seam", "field",  "edge", "thin-sun", "thin-spot", "thin-point"};

enum gn_light_type gn_penumbra_light(int scene) { return scenes[scene].type; }

static void add_nodes(struct gn_maker *maker, int scene) {
    static const char aside[] = "'translation':[0,7,9],'rotation':[-0.3584,0,0,0.9336]";
    static const char straight_down[] = "-0.70710678,0,0,0.70710678";
    const char *eye = scenes[scene].eye, *sun = scenes[scene].sun;
    const double slab_m = scenes[scene].ground_m;
    char ground[100] = "{'mesh':0,'scale':[12,1,12]}", nodes[2000];
    if (slab_m > 0)
        snprintf(ground, sizeof ground, "{'mesh':1,'translation':[0,-0.5,0],'scale':[%g,0.5,%g]}",
                 slab_m, slab_m);
    snprintf(nodes, sizeof nodes,
             "[%s,{'camera':0,%s},"
             "{'translation':[%g,%g,0.3],'rotation':[%s],"
             "'extensions':{'KHR_lights_punctual':{'light':0}}},%s]",
             ground, eye ? eye : aside,
             scene == GN_PENUMBRA_SEAM || scene >= GN_PENUMBRA_COUNT ? -3.5 : 0.5,
             scenes[scene].light_up_m, sun ? sun : straight_down, scenes[scene].nodes);
    gn_maker_set(maker, "nodes", nodes);
    char roots[120] = "[{'nodes':[0";
    int count = 3;
    for (const char *at = scenes[scene].nodes; (at = strstr(at, "'mesh'")); at++) count++;
    for (int i = 1; i < count; i++) snprintf(roots + strlen(roots), 8, ",%d", i);
    strcat(roots, "]}]");
    gn_maker_set(maker, "scenes", roots);
}

static void add_light(struct gn_maker *maker, int scene) {
    static const char *const kinds[] = {
        [GN_LIGHT_DIRECTIONAL] = "'type':'directional','intensity':3",
        [GN_LIGHT_POINT] = "'type':'point','intensity':300",
        [GN_LIGHT_SPOT] = ("'type':'spot','intensity':300,'spot':{'innerConeAngle':0.9,"
                           "'outerConeAngle':1.0}"),
    };
    char light[600];
    snprintf(light, sizeof light,
             "{'KHR_lights_punctual':{'lights':[{%s,'extras':{'gnomon_radius':%g}}]}}",
             kinds[scenes[scene].type], scenes[scene].radius);
    gn_maker_set(maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(maker, "extensions", light);
}

char *gn_penumbra_write(int scene, struct gn_err *err) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    add_nodes(&maker, scene);
    add_light(&maker, scene);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.7,'znear':0.1,'zfar':1000}}]");
    char *path = NULL;
    if (asprintf(&path, "%s/penumbra-%s.glb", gn_shot_build(), scenes[scene].name) < 0) abort();
    if (gn_maker_write(&maker, path, err)) return path;
    free(path);
    return NULL;
}

/* ---- truth ---- */

void gn_penumbra_truth_of(struct gn_picture *truth, const struct gn_scene *scene, bool point,
                          int width_px, int height_px) {
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, 0);
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, 0, width_px, height_px);
    gn_ray_lamp_init(&lamp, &pose, 0);
    if (point) lamp.radius = 0;
    gn_picture_init(truth, width_px, height_px, 1);
    gn_penumbra_cast(&rays, &eye, &lamp, truth->data);
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
}

bool gn_penumbra_truth(struct gn_picture *truth, const char *path, bool point, int width_px,
                       int height_px, struct gn_err *err) {
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, err);
    if (!scene) return false;
    gn_penumbra_truth_of(truth, scene, point, width_px, height_px);
    gn_scene_destroy(scene);
    return true;
}

/* ---- measures ---- */

void gn_penumbra_score(const struct gn_picture *truth, const struct gn_picture *shot,
                       struct gn_penumbra_score *score) {
    gn_penumbra_compare(truth->data, shot->data, shot->channels, truth->width_px, truth->height_px,
                        score);
}

/* Means of the columns: the edge runs along the picture's height. */
static void profile(const struct gn_picture *picture, double *mean, double *deviation) {
    for (int x = 0; x < picture->width_px; x++) {
        double sum = 0, square = 0;
        for (int y = 0; y < picture->height_px; y++) {
            double v = *gn_picture_at(picture, x, y);
            sum += v;
            square += v * v;
        }
        mean[x] = sum / picture->height_px;
        deviation[x] = sqrt(fmax(square / picture->height_px - mean[x] * mean[x], 0));
    }
}

/* Where a profile crosses a level for the first time, in pixels. */
static double crossing(const double *mean, int count, double level) {
    for (int x = 1; x < count; x++)
        if ((mean[x - 1] - level) * (mean[x] - level) <= 0 && mean[x] != mean[x - 1])
            return x - 1 + (level - mean[x - 1]) / (mean[x] - mean[x - 1]);
    return NAN;
}

void gn_penumbra_edge(const struct gn_picture *truth, const struct gn_picture *shot,
                      struct gn_penumbra_edge *edge) {
    int count = truth->width_px;
    double *mean = gn_xalloc((size_t)count * 4, sizeof *mean);
    double *expected = mean + count, *deviation = mean + 2 * count, *none = mean + 3 * count;
    profile(shot, mean, deviation);
    profile(truth, expected, none);
    double pixel_m = 2 * 2.5 * tan(0.35) / truth->height_px, sum = 0;
    *edge = (struct gn_penumbra_edge){0};
    edge->width = fabs(crossing(mean, count, .9) - crossing(mean, count, .1)) * pixel_m;
    edge->width_truth =
        fabs(crossing(expected, count, .9) - crossing(expected, count, .1)) * pixel_m;
    double direction = expected[count - 1] > expected[0] ? 1 : -1;
    for (int x = 0; x < count; x++) {
        sum += mean[x] - expected[x];
        edge->grain = fmax(edge->grain, deviation[x]);
        if (x > 0) edge->rise = fmax(edge->rise, direction * (mean[x - 1] - mean[x]));
    }
    edge->energy = sum * pixel_m / (2 * GN_PENUMBRA_EDGE_M);
    free(mean);
}
