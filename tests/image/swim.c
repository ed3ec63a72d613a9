#include "image/swim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/drawer.h"
#include "image/penumbra.h"
#include "image/shot.h"
#include "unit/gltf_maker.h"

enum { EXCUSE_PX = 2, SHADOW_PX = 8, STEPS_S = 8, FLOAT = 5126 };
static const double excuse_most = .02, frame_s = .1;
static const float along_px = .15f; /* more than anything moves in a frame, at pace 1 */

/* ---- scenes ---- */

/* Node 0 is the ground, 1 the camera, 2 the sun; a mesh is a square or a cube of 2 m. */
static const struct {
    const char *ground, *casters;
    double eye[3], eye_turn[4], walk_m[3], turn_rad; /* in a frame, at pace 1 */
} places[] = {
    [GN_SWIM_YARD] = {"{'mesh':0,'scale':[12,1,12]}",
                      "{'mesh':1,'translation':[-2.2,0.6,0.5],'rotation':[0,0.1305,0,0.9914],"
                      "'scale':[0.6,0.6,0.6]},"
                      "{'mesh':1,'translation':[1.8,1.2,-0.8],'rotation':[0,0.2588,0,0.9659],"
                      "'scale':[0.1,1.2,0.5]},"
                      "{'mesh':1,'translation':[0,2.2,-1.6],'rotation':[0,0.0436,0,0.999],"
                      "'scale':[2.4,0.06,0.06]},"
                      "{'mesh':1,'translation':[-0.4,0.8,1.4],'scale':[0.05,0.8,0.05]},"
                      "{'mesh':1,'translation':[0.6,0.8,1.8],'scale':[0.05,0.8,0.05]},"
                      "{'mesh':0,'translation':[0.4,1.5,0.3],'rotation':[0,0.2588,0,0.9659],"
                      "'scale':[0.7,1,0.5]}",
                      {0, 7, 9},
                      {-.3584, 0, 0, .9336},
                      {.0016, .0002, .0008},
                      .0006},
    [GN_SWIM_FIELD] = {"{'mesh':1,'translation':[0,-0.5,0],'scale':[450,0.5,450]}",
                       "{'mesh':1,'translation':[-7,1.5,-130],'scale':[0.25,1.5,128]},"
                       "{'mesh':1,'translation':[-4,5,-130],'scale':[0.25,0.25,128]},"
                       "{'mesh':1,'translation':[3,3,-4],'scale':[0.2,3,0.2]},"
                       "{'mesh':1,'translation':[5,3,-12],'scale':[0.2,3,0.2]},"
                       "{'mesh':1,'translation':[7,3,-40],'scale':[0.2,3,0.2]},"
                       "{'mesh':1,'translation':[9,3,-90],'scale':[0.2,3,0.2]}",
                       {0, 2.2, 0},
                       {-.0899, 0, 0, .996},
                       {.0008, .0001, -.0016},
                       .0003},
};
static const double sun_turn[4] = {-.332, -.4814, -.2035, .7852};

/* The quaternion a, then a turn about the vertical axis before it. */
static void turn_by(const double a[4], double angle_rad, float out[4]) {
    const double s = sin(angle_rad / 2), c = cos(angle_rad / 2);
    out[0] = (float)(c * a[0] + s * a[2]);
    out[1] = (float)(c * a[1] + s * a[3]);
    out[2] = (float)(c * a[2] - s * a[0]);
    out[3] = (float)(c * a[3] - s * a[1]);
}

/* A clip of STEPS_S seconds that moves the camera or the sun evenly; it ends after the last frame.
 */
static void add_clip(struct gn_maker *maker, const struct gn_swim_opts *o) {
    const double frames = STEPS_S / frame_s;
    float times[STEPS_S + 1], turns[STEPS_S + 1][4], walk[2][3];
    for (int k = 0; k <= STEPS_S; k++) {
        times[k] = (float)k;
        turn_by(sun_turn, places[o->place].turn_rad * o->pace * frames * k / STEPS_S, turns[k]);
    }
    const float ends[2] = {0, STEPS_S};
    for (int c = 0; c < 3; c++) {
        walk[0][c] = (float)places[o->place].eye[c];
        walk[1][c] =
            (float)(places[o->place].eye[c] + places[o->place].walk_m[c] * o->pace * frames);
    }
    char json[300];
    const int input = o->sun ? gn_maker_accessor(maker, "SCALAR", FLOAT, STEPS_S + 1, times,
                                                 sizeof times, "'min':[0],'max':[8]")
                             : gn_maker_accessor(maker, "SCALAR", FLOAT, 2, ends, sizeof ends,
                                                 "'min':[0],'max':[8]");
    const int output =
        o->sun ? gn_maker_accessor(maker, "VEC4", FLOAT, STEPS_S + 1, turns, sizeof turns, NULL)
               : gn_maker_accessor(maker, "VEC3", FLOAT, 2, walk, sizeof walk, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],"
             "'channels':[{'sampler':0,'target':{'node':%d,'path':'%s'}}]}",
             input, output, o->sun ? 2 : 1, o->sun ? "rotation" : "translation");
    gn_maker_add(maker, "animations", json);
}

static char *write_scene(const struct gn_swim_opts *o, struct gn_err *err) {
    struct gn_maker maker;
    char nodes[3000], roots[200] = "[{'nodes':[0,1,2", light[200], *path = NULL;
    const double *e = places[o->place].eye, *t = places[o->place].eye_turn;
    snprintf(nodes, sizeof nodes,
             "[%s,{'camera':0,'translation':[%g,%g,%g],'rotation':[%g,%g,%g,%g]},"
             "{'rotation':[%g,%g,%g,%g],'extensions':{'KHR_lights_punctual':{'light':0}}},%s]",
             places[o->place].ground, e[0], e[1], e[2], t[0], t[1], t[2], t[3], sun_turn[0],
             sun_turn[1], sun_turn[2], sun_turn[3], places[o->place].casters);
    int count = 3;
    for (const char *at = places[o->place].casters; (at = strstr(at, "'mesh'")); at++, count++)
        snprintf(roots + strlen(roots), 8, ",%d", count);
    strcat(roots, "]}]");
    snprintf(light, sizeof light,
             "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3,"
             "'extras':{'gnomon_radius':%g}}]}}",
             o->soft ? .05 : 0);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "scenes", roots);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions", light);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.7,'znear':0.1,'zfar':1000}}]");
    add_clip(&maker, o);
    if (asprintf(&path, "%s/swim-%d%d%d.glb", gn_shot_build(), (int)o->place, o->soft, o->sun) < 0)
        abort();
    if (gn_maker_write(&maker, path, err)) return path;
    free(path);
    return NULL;
}

/* ---- truth ---- */

struct frame {      /* what each pixel shows, and the share of the sun that it sees */
    float *share;   /* in the truth of all frames */
    uint32_t *face; /* of a thing; a number of no meaning */
};

static size_t pixels_of(const struct gn_swim *swim) {
    return (size_t)swim->opts.width_px * (size_t)swim->opts.height_px;
}

static int64_t time_of(int frame) { return (int64_t)(frame * frame_s * 1e9); }

static uint32_t face_of(const struct gn_ray_surface *surface) {
    uint32_t code = surface->item + 1;
    for (int c = 0; c < 3; c++)
        code = code * 31 + (uint32_t)(int32_t)lround(8 * surface->normal_ws[c]);
    return code;
}

static void cast_frame(const struct gn_swim *swim, const struct gn_scene *scene, int index,
                       struct frame *frame) {
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    const int w = swim->opts.width_px, h = swim->opts.height_px;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, time_of(index));
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, 0, w, h);
    gn_ray_lamp_init(&lamp, &pose, 0);
    if (swim->opts.soft) gn_penumbra_cast(&rays, &eye, &lamp, frame->share);
    for (int i = 0; i < w * h; i++) {
        struct gn_ray_surface surface;
        const bool hit = gn_raycast_eye(&rays, &eye, i % w, i / w, &surface);
        frame->face[i] = hit ? face_of(&surface) : 0;
        if (!swim->opts.soft)
            frame->share[i] = hit ? (float)gn_raycast_visible(&rays, &lamp, &surface) : 1;
    }
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
}

/* What is around a pixel in two frames. */
struct around {
    double change;     /* the largest of truth */
    float least, most; /* of truth */
    bool one_face;
};

static struct around look_around(const struct gn_swim *swim, const struct frame pair[2], int x,
                                 int y, int radius) {
    const int w = swim->opts.width_px, h = swim->opts.height_px;
    const uint32_t face = pair[0].face[y * w + x];
    struct around a = {0, INFINITY, -INFINITY, face != 0};
    for (int v = y - radius; v <= y + radius; v++)
        for (int u = x - radius; u <= x + radius; u++) {
            if (u < 0 || v < 0 || u >= w || v >= h) continue;
            const int i = v * w + u;
            a.change = fmax(a.change, fabs((double)pair[0].share[i] - (double)pair[1].share[i]));
            for (int f = 0; f < 2; f++) {
                a.least = fminf(a.least, pair[f].share[i]);
                a.most = fmaxf(a.most, pair[f].share[i]);
                a.one_face &= pair[f].face[i] == face;
            }
        }
    return a;
}

static void fill_excuses(const struct gn_swim *swim, const struct frame pair[2], float *excuse) {
    for (int y = 0; y < swim->opts.height_px; y++)
        for (int x = 0; x < swim->opts.width_px; x++) {
            const struct around close = look_around(swim, pair, x, y, EXCUSE_PX);
            bool measured = close.one_face && close.change <= excuse_most;
            if (measured) {
                const struct around wide = look_around(swim, pair, x, y, SHADOW_PX);
                measured = wide.least < .98f && wide.most > .02f && wide.most > wide.least;
            }
            excuse[y * swim->opts.width_px + x] = measured ? (float)close.change : NAN;
        }
}

bool gn_swim_init(struct gn_swim *swim, const struct gn_swim_opts *opts, struct gn_err *err) {
    *swim = (struct gn_swim){.opts = *opts};
    const size_t pixels = pixels_of(swim);
    swim->path = write_scene(opts, err);
    struct gn_scene *scene = swim->path ? gn_scene_load(swim->path, NULL, NULL, err) : NULL;
    if (!scene) {
        free(swim->path);
        return false;
    }
    struct frame frames[2];
    for (int f = 0; f < 2; f++) frames[f].face = gn_xalloc(pixels, sizeof(uint32_t));
    swim->truth = gn_xalloc((size_t)opts->frames * pixels, sizeof *swim->truth);
    swim->excuse = gn_xalloc((size_t)(opts->frames - 1) * pixels, sizeof *swim->excuse);
    for (int i = 0; i < opts->frames; i++) {
        frames[i % 2].share = swim->truth + (size_t)i * pixels;
        cast_frame(swim, scene, i, &frames[i % 2]);
        if (i > 0) fill_excuses(swim, frames, swim->excuse + (size_t)(i - 1) * pixels);
    }
    for (int f = 0; f < 2; f++) free(frames[f].face);
    gn_scene_destroy(scene);
    return true;
}

void gn_swim_finish(struct gn_swim *swim) {
    free(swim->path);
    free(swim->truth);
    free(swim->excuse);
    *swim = (struct gn_swim){0};
}

/* ---- pictures ---- */

static int compare_floats(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Length of the gradient at pixel i of a frame; between the borders alone. */
static float gradient_at(const struct gn_swim *swim, const float *frame, size_t i) {
    const size_t w = (size_t)swim->opts.width_px, x = i % w, y = i / w;
    if (x == 0 || y == 0 || x + 1 == w || y + 1 == (size_t)swim->opts.height_px) return 0;
    return .5f * hypotf(frame[i + 1] - frame[i - 1], frame[i + w] - frame[i - w]);
}

void gn_swim_compare(const struct gn_swim *swim, const float *shots, struct gn_swim_score *score) {
    const size_t pixels = pixels_of(swim), all = (size_t)(swim->opts.frames - 1) * pixels;
    const float along = swim->opts.soft ? 0 : along_px * (float)swim->opts.pace;
    float *changes = gn_xalloc(all + 1, sizeof *changes);
    size_t count = 0;
    double sum = 0;
    for (size_t i = 0; i < all; i++) {
        if (isnan(swim->excuse[i])) continue;
        const float *before = shots + i / pixels * pixels, *after = before + pixels;
        const size_t at = i % pixels;
        const float slope = fmaxf(gradient_at(swim, before, at), gradient_at(swim, after, at));
        const float change = fabsf(after[at] - before[at]) - swim->excuse[i] - along * slope;
        changes[count] = fmaxf(change, 0);
        sum += (double)changes[count++];
    }
    qsort(changes, count, sizeof *changes, compare_floats);
    score->changes = (long)count;
    score->mean = count ? 100 * sum / (double)count : (double)NAN;
    score->p99 = count ? 100 * (double)changes[count * 99 / 100] : (double)NAN;
    free(changes);
}

bool gn_swim_measure(const struct gn_swim *swim, const char *technique, const char *const args[],
                     struct gn_swim_score *score, struct gn_err *err) {
    const size_t pixels = pixels_of(swim);
    const char *argv[24] = {"--aov", "visibility", "--light", "0", "--shadow", technique, "--size"};
    char size[32];
    int count = 8;
    snprintf(size, sizeof size, "%dx%d", swim->opts.width_px, swim->opts.height_px);
    argv[7] = size;
    while (args && *args && count < 23) argv[count++] = *args++;
    float *rgba = gn_xalloc(4 * pixels, sizeof *rgba);
    float *shots = gn_xalloc((size_t)swim->opts.frames * pixels, sizeof *shots);
    struct gn_drawer *drawer = gn_drawer_create(swim->path);
    bool ok = true;
    for (int f = 0; ok && f < swim->opts.frames; f++) {
        gn_drawer_set_time(drawer, time_of(f));
        ok = gn_drawer_draw(drawer, argv, rgba, err);
        for (size_t i = 0; ok && i < pixels; i++) shots[(size_t)f * pixels + i] = rgba[4 * i];
    }
    if (ok) gn_swim_compare(swim, shots, score);
    gn_drawer_destroy(drawer);
    free(shots);
    free(rgba);
    return ok;
}
