/* Scenes for comparing shadows with ray-traced truth: a ground and all kinds of casters under one
 * light, generated from tables and a seed. `--contact` writes the scenes of the contact test
 * instead. */
#include "coarse.h"
#include "glb.h"
#include "shape/outline.h"
#include "shape/shapes.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define RADIANS (float)(M_PI / 180)

struct scene {
    float size;      /* side of the ground, metres */
    float elevation; /* of the light, degrees */
    float azimuth;   /* of the light, degrees from +x towards -z */
    float distance;  /* of the spot, metres; 0: a directional light */
};

static const struct scene scenes[] = {
    {5, 35, 20, 0},     {5, 62, 200, 0},     {8, 20, 75, 0},    {8, 48, 310, 0},
    {13, 27, 140, 0},   {13, 71, 255, 0},    {25, 23, 15, 0},   {25, 54, 105, 0},
    {60, 31, 230, 0},   {60, 66, 340, 0},    {120, 41, 165, 0}, {120, 80, 50, 0},
    {5, 52, 285, 6},    {8, 33, 120, 10},    {13, 45, 30, 15},  {25, 68, 215, 27},
    {60, 38, 160, 70},  {120, 57, 325, 130}, {13, 24, 60, 100}, {13, 50, 190, 100},
    {13, 77, 280, 100}, {13, 30, 145, 400},  {13, 58, 10, 400}, {13, 72, 235, 400},
};
enum site { OPEN, ROOM, PEN, WALLED };
static const char *const sites[] = {"in the open", "in a room", "inside a fence", "near a wall"};

/* Scenes with a point light, numbered after those above. */
static const struct lamp {
    float size;    /* side of the ground, metres */
    float azimuth; /* decides the camera's position */
    float at[3];   /* in tenths of the ground's size */
    enum site site;
} lamps[] = {
    {5, 40, {.4f, 2.6f, -.3f}, ROOM},       {13, 150, {.2f, 2.0f, .3f}, PEN},
    {8, 275, {-1.2f, 2.9f, -4.3f}, WALLED}, {25, 15, {1.5f, 6.0f, 1.0f}, OPEN},
    {60, 225, {3.6f, 3.8f, -3.7f}, ROOM},   {13, 330, {-.4f, 1.4f, .6f}, OPEN},
};
/* Scenes of coarse meshes with smooth normals, numbered after those: three for each kind of light.
 */
static const struct scene coarse_scenes[] = {
    {8, 55, 20, 0},   {13, 33, 160, 0}, {5, 74, 290, 0},
    {8, 50, 250, 10}, {13, 66, 40, 18}, {13, 38, 120, 100},
};
static const struct lamp coarse_lamps[] = {
    {8, 60, {.5f, 4.5f, -.6f}, OPEN},
    {13, 170, {-3.8f, 3.6f, 3.4f}, OPEN},
    {5, 300, {.3f, 3.2f, .5f}, ROOM},
};
/* Scenes of rods of 3 cm, and of boxes of mirrored, uneven scale, numbered after those. */
static const struct scene rod_scenes[] = {{8, 60, 40, 12}, {8, 38, 200, 12}, {8, 75, 310, 12}};
static const struct scene mirror_scenes[] = {{8, 50, 70, 10}, {5, 35, 230, 12}, {13, 65, 340, 15}};

enum kind { BOX, WALL, BALL, FENCE, TILT, COARSE_BALL, HEAD, CYLINDER, CUBE, ROD, MIRROR, KINDS };

/* The casters of a set, which find a place in this order, over and over. */
static const enum kind mixed[] = {BOX,  WALL, BALL, FENCE, TILT, BOX, WALL,
                                  BALL, BOX,  TILT, WALL,  BALL, BOX};
static const enum kind coarse[] = {HEAD,     COARSE_BALL, CYLINDER, COARSE_BALL, CUBE,
                                   CYLINDER, COARSE_BALL, HEAD,     COARSE_BALL, CYLINDER};
static const enum kind rods[] = {ROD}, mirrors[] = {MIRROR};
#define LIST(array) array, sizeof(array) / sizeof *(array)
static const struct set {
    const struct scene *scenes;
    int scene_count;
    const struct lamp *lamps;
    int lamp_count;
    const enum kind *order;
    int order_count, casters;
} sets[] = {
    {LIST(scenes), LIST(lamps), LIST(mixed), 13},
    {LIST(coarse_scenes), LIST(coarse_lamps), LIST(coarse), 10},
    {LIST(rod_scenes), NULL, 0, LIST(rods), 20},
    {LIST(mirror_scenes), NULL, 0, LIST(mirrors), 10},
};
enum { SETS = sizeof sets / sizeof *sets, CASTERS_MAX = 24 };
_Static_assert(sizeof scenes == 24 * sizeof *scenes && sizeof lamps == 6 * sizeof *lamps &&
                   sizeof coarse_scenes == 6 * sizeof *coarse_scenes &&
                   sizeof coarse_lamps == 3 * sizeof *coarse_lamps,
               "the table is part of the contract");

struct spot { /* position of a caster on the ground, in units of the scene's scale */
    float x, z, radius;
};

struct build {
    struct gn_glb *glb;
    const struct scene *scene;
    const struct lamp *lamp; /* point light instead of the scene's light, or NULL */
    uint32_t seed;
    float unit; /* scale, metres: 1 for a scene of 10 m */
    struct spot placed[CASTERS_MAX + 2];
    int count;
    int counts[KINDS];
};

/* ---- random numbers ---- */

/* xorshift32: Marsaglia, "Xorshift RNGs", 2003. */
static float chance(struct build *b, float low, float high) {
    b->seed ^= b->seed << 13;
    b->seed ^= b->seed >> 17;
    b->seed ^= b->seed << 5;
    return low + (high - low) * (float)(b->seed >> 8) / 16777216.0f;
}

static bool is_free(const struct build *b, float x, float z, float radius) {
    for (int i = 0; i < b->count; i++)
        if (hypotf(x - b->placed[i].x, z - b->placed[i].z) < radius + b->placed[i].radius)
            return false;
    return true;
}

/* Finds a free circle on the ground; false if there is none. */
static bool find_place(struct build *b, float radius, struct spot *out) {
    for (int tries = 0; tries < 200; tries++) {
        float reach = 4.4f - radius, x = chance(b, -reach, reach), z = chance(b, -reach, reach);
        if (!is_free(b, x, z, radius)) continue;
        *out = b->placed[b->count++] = (struct spot){x, z, radius};
        return true;
    }
    return false;
}

/* ---- casters, in units of the scene's scale, at the pen ---- */

typedef void caster_fn(struct build *b, struct gn_shape *shape);

static void make_box(struct build *b, struct gn_shape *shape) {
    gn_shape_block(shape, chance(b, 0.5f, 1.1f) * b->unit, chance(b, 0.4f, 1.9f) * b->unit,
                   chance(b, 0.5f, 1.1f) * b->unit);
}

static void make_wall(struct build *b, struct gn_shape *shape) {
    gn_shape_block(shape, chance(b, 1.4f, 2.1f) * b->unit, chance(b, 0.6f, 1.5f) * b->unit,
                   chance(b, 0.012f, 0.05f) * b->unit);
}

static void make_ball(struct build *b, struct gn_shape *shape) {
    float radius = chance(b, 0.25f, 0.6f) * b->unit,
          lift = chance(b, 0, 1) < 0.5f ? 0 : chance(b, 0.1f, 1.2f) * b->unit;
    gn_shape_move(shape, 0, radius + lift, 0);
    gn_shape_sphere(shape, radius, 48, 32);
}

static void make_fence(struct build *b, struct gn_shape *shape) {
    float length = 2.0f * b->unit;
    gn_shape_move(shape, -length / 2, 0, 0);
    gn_shape_fence(shape, &(struct gn_fence){.length = length,
                                             .height = chance(b, 0.6f, 1.0f) * b->unit,
                                             .pitch = chance(b, 0.2f, 0.3f) * b->unit,
                                             .pale = chance(b, 0.07f, 0.1f) * b->unit,
                                             .depth = 0.03f * b->unit,
                                             .pointed = chance(b, 0, 1) < 0.5f});
}

static void make_tilt(struct build *b, struct gn_shape *shape) {
    gn_shape_move(shape, 0, chance(b, 0.7f, 1.4f) * b->unit, 0);
    gn_shape_turn(shape, 'x', chance(b, -40, 40));
    gn_shape_turn(shape, 'z', chance(b, -25, 25));
    gn_shape_plane(shape, chance(b, 0.8f, 1.4f) * b->unit, chance(b, 0.8f, 1.2f) * b->unit);
}

/* On the ground or in the air. */
static void make_coarse_ball(struct build *b, struct gn_shape *shape) {
    float radius = chance(b, .5f, .95f) * b->unit, lift = fmaxf(0, chance(b, -.6f, .6f)) * b->unit;
    gn_shape_move(shape, 0, radius + lift, 0);
    gn_shape_turn(shape, 'x', chance(b, -90, 90));
    gn_shape_sphere(shape, radius, (int)chance(b, 8, 15), (int)chance(b, 5, 10));
}

static void make_head(struct build *b, struct gn_shape *shape) {
    gn_coarse_head(shape, chance(b, 1.5f, 2) * b->unit, (int)chance(b, 12, 21),
                   (int)chance(b, 9, 15));
}

/* Upright, or leaning. */
static void make_cylinder(struct build *b, struct gn_shape *shape) {
    float lean = fmaxf(0, chance(b, -40, 60));
    gn_shape_move(shape, 0, lean > 0 ? .3f * b->unit : 0, 0);
    gn_shape_turn(shape, 'x', lean);
    gn_shape_cylinder(shape, chance(b, .3f, .6f) * b->unit, chance(b, .8f, 1.8f) * b->unit,
                      (int)chance(b, 11, 17));
}

static void make_cube(struct build *b, struct gn_shape *shape) {
    float side = chance(b, .7f, 1.2f) * b->unit;
    gn_shape_block(shape, side, side, side);
}

/* Upright, leaning or on the ground. */
static void make_rod(struct build *b, struct gn_shape *shape) {
    const float radius = .015f, length = chance(b, .6f, 1.6f), way = chance(b, 0, 3);
    gn_shape_move(shape, 0, way < 2 ? 0 : radius, 0);
    gn_shape_turn(shape, 'x', way < 1 ? 0 : way < 2 ? chance(b, 20, 60) : 90);
    gn_shape_cylinder(shape, radius, length, 12);
}

/* Its node makes it larger. */
static void make_mirror(struct build *b, struct gn_shape *shape) {
    gn_shape_turn(shape, 'y', chance(b, 0, 90));
    gn_shape_block(shape, .3f * b->unit, .3f * b->unit, .3f * b->unit);
}

static const struct {
    const char *name;
    caster_fn *make;
    float radius; /* of the free circle it needs */
} kinds[KINDS] = {
    [BOX] = {"box", make_box, 0.8f},
    [WALL] = {"wall", make_wall, 1.1f},
    [BALL] = {"sphere", make_ball, 0.65f},
    [FENCE] = {"fence", make_fence, 1.1f},
    [TILT] = {"plane", make_tilt, 0.9f},
    [COARSE_BALL] = {"coarse sphere", make_coarse_ball, 1},
    [HEAD] = {"head", make_head, 1.05f},
    [CYLINDER] = {"cylinder", make_cylinder, 1.1f},
    [CUBE] = {"cube", make_cube, 0.8f},
    [ROD] = {"rod", make_rod, .5f},
    [MIRROR] = {"mirrored box", make_mirror, .9f},
};

static void add_caster(struct build *b, enum kind kind) {
    struct spot place;
    if (b->count == CASTERS_MAX || !find_place(b, kinds[kind].radius, &place)) return;
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    kinds[kind].make(b, &shape);
    char name[24];
    snprintf(name, sizeof name, "%s %d", kinds[kind].name, ++b->counts[kind]);
    struct gn_glb_material material = {
        .rgba = {chance(b, 0.4f, 0.9f), chance(b, 0.4f, 0.9f), chance(b, 0.4f, 0.9f)},
        .rough = 1,
        .double_sided = kind == TILT};
    struct gn_glb_node node = {.name = name, .move = {place.x * b->unit, 0, place.z * b->unit}};
    node.mesh = gn_glb_mesh(b->glb, name, gn_glb_geometry(b->glb, &shape),
                            gn_glb_material(b->glb, &material));
    gn_glb_turn_y(chance(b, 0, 360), node.turn);
    if (kind == MIRROR) {
        node.scale[0] = -chance(b, 1, 3.5f);
        node.scale[1] = chance(b, 1, 5);
        node.scale[2] = chance(b, 1, 3.5f);
    }
    gn_glb_node(b->glb, &node);
    gn_shape_finish(&shape);
}

/* ---- ground, light, camera ---- */

static void add_ground(struct build *b) {
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    gn_shape_plane(&shape, b->scene->size, b->scene->size);
    int material =
        gn_glb_material(b->glb, &(struct gn_glb_material){.rgba = {.7f, .7f, .7f}, .rough = 1});
    gn_glb_node(b->glb, &(struct gn_glb_node){.name = "ground",
                                              .mesh = gn_glb_mesh(b->glb, "ground",
                                                                  gn_glb_geometry(b->glb, &shape),
                                                                  material)});
    gn_shape_finish(&shape);
}

/* A grey object, already in scene coordinates. */
static void add_fixed(struct build *b, const char *name, const struct gn_shape *shape) {
    int material =
        gn_glb_material(b->glb, &(struct gn_glb_material){.rgba = {.6f, .6f, .6f}, .rough = 1});
    gn_glb_node(b->glb,
                &(struct gn_glb_node){
                    .name = name,
                    .mesh = gn_glb_mesh(b->glb, name, gn_glb_geometry(b->glb, shape), material)});
}

/* Walls and a ceiling in one mesh, visible from inside only. */
static void add_room(struct build *b) {
    float size = b->scene->size, height = .5f * size;
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    for (int i = 0; i < 4; i++) {
        gn_shape_home(&shape);
        gn_shape_turn(&shape, 'y', 90.0f * (float)i);
        gn_shape_move(&shape, 0, height / 2, -size / 2);
        gn_shape_turn(&shape, 'x', 90);
        gn_shape_plane(&shape, size, height);
    }
    gn_shape_at(&shape, 0, height, 0);
    gn_shape_turn(&shape, 'x', 180);
    gn_shape_plane(&shape, size, size);
    add_fixed(b, "room", &shape);
    gn_shape_finish(&shape);
}

/* Four fences around the empty centre. */
static void add_pen(struct build *b) {
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    for (int i = 0; i < 4; i++) {
        gn_shape_home(&shape);
        gn_shape_turn(&shape, 'y', 90.0f * (float)i + 10);
        gn_shape_move(&shape, -b->unit, 0, 1.02f * b->unit);
        gn_shape_fence(&shape, &(struct gn_fence){.length = 2 * b->unit,
                                                  .height = .9f * b->unit,
                                                  .pitch = .4f * b->unit,
                                                  .pale = .15f * b->unit,
                                                  .depth = .03f * b->unit});
    }
    add_fixed(b, "pen", &shape);
    gn_shape_finish(&shape);
}

static void add_wall(struct build *b) {
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    gn_shape_at(&shape, 0, 0, -.49f * b->scene->size);
    gn_shape_block(&shape, .9f * b->scene->size, .4f * b->scene->size, .01f * b->scene->size);
    add_fixed(b, "long wall", &shape);
    gn_shape_finish(&shape);
}

/* Keeps casters away from the point light and the centre. */
static void add_site(struct build *b) {
    const struct lamp *lamp = b->lamp;
    b->placed[b->count++] = (struct spot){lamp->at[0], lamp->at[2], .4f};
    if (lamp->site == ROOM) add_room(b);
    if (lamp->site == WALLED) add_wall(b);
    if (lamp->site != PEN) return;
    add_pen(b);
    b->placed[b->count++] = (struct spot){0, 0, 1.6f};
}

static void towards(float elevation, float azimuth, float distance, float out[3]) {
    float e = elevation * RADIANS, a = azimuth * RADIANS;
    out[0] = distance * cosf(e) * cosf(a);
    out[1] = distance * sinf(e);
    out[2] = -distance * cosf(e) * sinf(a);
}

/* Half angle of a spot at `eye`, aimed at the origin, that covers the ground and all objects on it.
 */
static float cover(const float eye[3], float size) {
    float widest = 0, distance = sqrtf(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]);
    for (int corner = 0; corner < 8; corner++) {
        float p[3] = {(corner & 1 ? .5f : -.5f) * size, corner & 2 ? .25f * size : 0,
                      (corner & 4 ? .5f : -.5f) * size};
        float along = 0, length = 0;
        for (int i = 0; i < 3; i++) {
            along += (eye[i] - p[i]) * eye[i] / distance;
            length += (eye[i] - p[i]) * (eye[i] - p[i]);
        }
        widest = fmaxf(widest, acosf(along / sqrtf(length)));
    }
    return widest;
}

static void add_lamp(struct build *b) {
    struct gn_glb_light light = {
        .name = "light", .kind = GN_GLB_POINT, .intensity = .6f * b->scene->size * b->scene->size};
    struct gn_glb_node node = {.name = "light", .light = gn_glb_light(b->glb, &light)};
    for (int i = 0; i < 3; i++) node.move[i] = b->lamp->at[i] * b->unit;
    gn_glb_node(b->glb, &node);
}

static void add_light(struct build *b) {
    if (b->lamp) {
        add_lamp(b);
        return;
    }
    const struct scene *s = b->scene;
    bool spot = s->distance > 0, near = s->distance < 4 * s->size;
    struct gn_glb_node node = {.name = "light"};
    towards(s->elevation, s->azimuth, spot ? s->distance : 2 * s->size, node.move);
    gn_glb_look(node.move, (float[3]){0}, node.turn);
    struct gn_glb_light light = {.name = "light", .kind = GN_GLB_DIRECTIONAL, .intensity = 3};
    if (spot) {
        float half = 1.03f * cover(node.move, s->size);
        light.kind = GN_GLB_SPOT;
        light.intensity = 3 * s->distance * s->distance;
        light.outer = near ? fminf(fmaxf(half, 25 * RADIANS), 60 * RADIANS) : half;
        light.inner = 0.9f * light.outer;
    }
    node.light = gn_glb_light(b->glb, &light);
    gn_glb_node(b->glb, &node);
}

/* The camera looks across the direction of the light. */
static void add_camera(struct build *b) {
    float size = b->scene->size, side = chance(b, 0, 1) < .5f ? -1 : 1, eye[3];
    towards(chance(b, 30, 42), b->scene->azimuth + side * chance(b, 60, 115), 1.08f * size, eye);
    struct gn_glb_camera lens = {
        .name = "camera", .yfov = 42 * RADIANS, .znear = .02f * size, .zfar = 4 * size};
    struct gn_glb_node node = {.name = "camera", .camera = gn_glb_camera(b->glb, &lens)};
    memcpy(node.move, eye, sizeof node.move);
    gn_glb_look(eye, (float[3]){0, 0.01f * size, 0}, node.turn);
    gn_glb_node(b->glb, &node);
}

static void init_build(struct build *b, const struct scene *scene, uint32_t seed) {
    *b = (struct build){.scene = scene, .seed = seed * 2654435761u + 1, .unit = scene->size / 10};
    for (int i = 0; i < 8; i++) chance(b, 0, 1);
    b->glb = gn_glb_create("gnomon assets", "CC0 1.0, the authors of gnomon");
    gn_glb_scene_extras(b->glb, "{\"gnomon_sky\":[0.2,0.2,0.2],\"gnomon_ground\":[0.1,0.1,0.1],"
                                "\"gnomon_background\":[0.3,0.4,0.5]}");
}

/* ---- files ---- */

static bool write_note(const struct build *b, const char *path) {
    const struct scene *s = b->scene;
    char far[48] = "";
    if (s->distance > 0) snprintf(far, sizeof far, " %g m away", (double)s->distance);
    FILE *file = fopen(path, "w");
    if (!file) {
        perror(path);
        return false;
    }
    for (int i = 0, before = 0; i < KINDS; i++)
        if (b->counts[i])
            fprintf(file, "%s%s %d", before++ ? ", " : "", kinds[i].name, b->counts[i]);
    fprintf(file, " on %g m; ", (double)s->size);
    if (b->lamp)
        fprintf(file, "point %s at %g %g %g\n", sites[b->lamp->site],
                (double)(b->lamp->at[0] * b->unit), (double)(b->lamp->at[1] * b->unit),
                (double)(b->lamp->at[2] * b->unit));
    else
        fprintf(file, "%s%s, elevation %g, azimuth %g\n", s->distance > 0 ? "spot" : "directional",
                far, (double)s->elevation, (double)s->azimuth);
    return !fclose(file);
}

static bool write_scene(struct build *b, const char *folder, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.glb", folder, name);
    bool ok = gn_glb_write(b->glb, path);
    snprintf(path, sizeof path, "%s/%s.txt", folder, name);
    ok = ok && write_note(b, path);
    gn_glb_destroy(b->glb);
    return ok;
}

static bool write_truth(const char *folder, int index, const struct set *set, int nth) {
    const struct lamp *lamp = nth < set->scene_count ? NULL : &set->lamps[nth - set->scene_count];
    const struct scene around =
        lamp ? (struct scene){lamp->size, 0, lamp->azimuth, 0} : set->scenes[nth];
    struct build b;
    init_build(&b, &around, (uint32_t)index + 1);
    b.lamp = lamp;
    add_light(&b);
    add_ground(&b);
    if (lamp) add_site(&b);
    for (int i = 0; i < set->casters; i++) add_caster(&b, set->order[i % set->order_count]);
    add_camera(&b);
    char name[32];
    snprintf(name, sizeof name, "truth-%02d", index);
    return write_scene(&b, folder, name);
}

/* A box of 1 m in the centre of a ground of 10 m. */
static bool write_contact(const char *folder, const char *name, float distance,
                          const struct lamp *lamp) {
    const struct scene scene = {10, 45, 30, distance};
    struct build b;
    init_build(&b, &scene, 1);
    b.lamp = lamp;
    add_light(&b);
    add_ground(&b);
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    gn_shape_block(&shape, 1, 1, 1);
    int material =
        gn_glb_material(b.glb, &(struct gn_glb_material){.rgba = {.8f, .5f, .3f}, .rough = 1});
    gn_glb_node(b.glb,
                &(struct gn_glb_node){
                    .name = "box",
                    .mesh = gn_glb_mesh(b.glb, "box", gn_glb_geometry(b.glb, &shape), material)});
    gn_shape_finish(&shape);
    b.counts[BOX] = 1;
    add_camera(&b);
    return write_scene(&b, folder, name);
}

int main(int argc, char **argv) {
    bool contact = argc == 3 && !strcmp(argv[1], "--contact"), ok = true;
    if (argc != 2 && !contact) {
        fprintf(stderr, "usage: make_truth [--contact] OUTDIR\n");
        return 2;
    }
    if (contact) {
        const struct lamp lamp = {.size = 10, .at = {3.1f, 3.4f, -1.7f}};
        ok = write_contact(argv[2], "contact-sun", 0, NULL) &&
             write_contact(argv[2], "contact-spot", 12, NULL) &&
             write_contact(argv[2], "contact-point", 0, &lamp);
        return ok ? 0 : 1;
    }
    for (int i = 0, index = 0; i < SETS; i++)
        for (int nth = 0; ok && nth < sets[i].scene_count + sets[i].lamp_count; nth++)
            ok = write_truth(argv[1], index++, &sets[i], nth);
    return ok ? 0 : 1;
}
