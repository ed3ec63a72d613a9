/* Scenes of `gnomon lesson`: `make_lessons NAME OUT.glb`. Each is small, has one camera and, as
 * light 0, the light that is measured. What a lesson says about its scene is in
 * src/options/lesson_rows.h. */
#include "glb.h"
#include "lamp.h"
#include "paint.h"
#include "shape/outline.h"
#include "shape/shapes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define RADIANS (float)(M_PI / 180)

struct lesson {
    struct gn_glb *glb;
    struct gn_shape shape; /* of the next part, in scene coordinates */
};

/* ---- parts, lights, camera ---- */

static const float grey[3] = {.62f, .62f, .6f}, red[3] = {.72f, .3f, .22f},
                   blue[3] = {.25f, .4f, .65f}, ochre[3] = {.75f, .56f, .25f};

static struct gn_shape *begin(struct lesson *l) {
    gn_shape_finish(&l->shape);
    gn_shape_init(&l->shape, 0);
    return &l->shape;
}

static void end_part(struct lesson *l, const char *name, const float rgb[3], const char *extras) {
    const struct gn_glb_material material = {
        .name = name, .rgba = {rgb[0], rgb[1], rgb[2]}, .rough = 1};
    const int mesh = gn_glb_mesh(l->glb, name, gn_glb_geometry(l->glb, &l->shape),
                                 gn_glb_material(l->glb, &material));
    gn_glb_node(l->glb, &(struct gn_glb_node){.name = name, .mesh = mesh, .extras = extras});
}

static void end(struct lesson *l, const char *name, const float rgb[3]) {
    end_part(l, name, rgb, NULL);
}

static void add_ground(struct lesson *l, float size) {
    gn_shape_plane(begin(l), size, size);
    end(l, "ground", grey);
}

static void add_block(struct lesson *l, const char *name, const float at[3], float turn_deg,
                      const float size[3], const float rgb[3]) {
    struct gn_shape *shape = begin(l);
    gn_shape_at(shape, at[0], at[1], at[2]);
    gn_shape_turn(shape, 'y', turn_deg);
    gn_shape_block(shape, size[0], size[1], size[2]);
    end(l, name, rgb);
}

static void add_ball(struct lesson *l, const float at[3], float radius, const float rgb[3]) {
    struct gn_shape *shape = begin(l);
    gn_shape_at(shape, at[0], at[1], at[2]);
    gn_shape_sphere(shape, radius, 32, 20);
    end(l, "ball", rgb);
}

static void add_sun(struct lesson *l, float elevation_deg, float azimuth_deg, float radius) {
    const float e = elevation_deg * RADIANS, a = azimuth_deg * RADIANS;
    gn_lamp_add(l->glb, &(struct gn_lamp){
                            .kind = GN_GLB_DIRECTIONAL,
                            .at = {20 * cosf(e) * cosf(a), 20 * sinf(e), -20 * cosf(e) * sinf(a)},
                            .radius = radius,
                            .intensity = 3});
}

static void add_camera(struct lesson *l, const float eye[3], const float aim[3], float yfov_deg) {
    struct gn_view view = {.yfov_deg = yfov_deg};
    memcpy(view.eye, eye, sizeof view.eye);
    memcpy(view.aim, aim, sizeof view.aim);
    gn_view_add(l->glb, &view);
}

#define AT(...) ((const float[3]){__VA_ARGS__})

/* ---- the scenes ---- */

/* Closed things, and a thin wall, under a low sun. */
static void make_solids(struct lesson *l) {
    add_ground(l, 9);
    add_block(l, "box", AT(-1.4f, 0, .3f), 25, AT(1.2f, 1.2f, 1.2f), red);
    add_ball(l, AT(.7f, .7f, .9f), .7f, blue);
    add_block(l, "wall", AT(1.2f, 0, -1.3f), 8, AT(2.2f, 1.3f, .04f), ochre);
    add_sun(l, 38, -18, 0);
    add_camera(l, AT(-1.2f, 3.6f, 6.2f), AT(-.1f, .3f, .1f), 40);
}

/* A hut of thin walls, its door towards the camera, the sun behind it. */
static void make_hut(struct lesson *l) {
    add_ground(l, 9);
    add_block(l, "back", AT(0, 0, -1.2f), 0, AT(3, 1.7f, .05f), ochre);
    add_block(l, "left", AT(-1.475f, 0, 0), 0, AT(.05f, 1.7f, 2.4f), ochre);
    add_block(l, "right", AT(1.475f, 0, 0), 0, AT(.05f, 1.7f, 2.4f), ochre);
    add_block(l, "roof", AT(0, 1.7f, 0), 0, AT(3.1f, .05f, 2.5f), red);
    add_sun(l, 36, 62, 0);
    add_camera(l, AT(-.8f, 1.9f, 6.3f), AT(0, .75f, 0), 32);
}

/* Sheets without a thickness beside a closed box. */
static void make_sheets(struct lesson *l) {
    struct gn_shape *shape;
    add_ground(l, 9);
    for (int i = 0; i < 3; i++) {
        shape = begin(l);
        gn_shape_at(shape, -1.7f + 1.5f * (float)i, 1.1f, -.9f + .35f * (float)i);
        gn_shape_turn(shape, 'x', 20 + 4 * (float)i);
        gn_shape_turn(shape, 'z', -14);
        gn_shape_plane(shape, 1.1f, 1.1f);
        end(l, "sheet", blue);
    }
    add_block(l, "box", AT(-1.1f, 0, 1.3f), 30, AT(.9f, .9f, .9f), red);
    shape = begin(l);
    gn_shape_at(shape, 1.3f, 0, 1.3f);
    gn_shape_cylinder(shape, .45f, 1, 32);
    end(l, "drum", ochre);
    add_sun(l, 48, 75, 0);
    add_camera(l, AT(.4f, 4.2f, 6.4f), AT(-.1f, .3f, .1f), 38);
}

/* A lattice at one height: its penumbra has the same width everywhere. */
static void make_lattice(struct lesson *l) {
    add_ground(l, 9);
    for (int i = 0; i < 5; i++) {
        struct gn_shape *shape = begin(l);
        gn_shape_at(shape, 0, 1.1f, -.2f);
        gn_shape_turn(shape, 'y', 12);
        gn_shape_move(shape, (float)(i - 2) * .6f, 0, 0);
        gn_shape_box(shape, .16f, .03f, 2.4f);
        end(l, "bar", red);
    }
    for (int i = 0; i < 2; i++) {
        struct gn_shape *shape = begin(l);
        gn_shape_at(shape, 0, 1.1f, -.2f);
        gn_shape_turn(shape, 'y', 12);
        gn_shape_move(shape, 0, 0, i ? 1.2f : -1.2f);
        gn_shape_box(shape, 2.8f, .03f, .16f);
        end(l, "bar", red);
    }
    add_sun(l, 58, 80, .035f);
    add_camera(l, AT(0, 4.2f, 4.6f), AT(0, 0, .3f), 38);
}

/* A plate that stands on the ground and leans over it, and a post: sharp at their feet, soft at
 * their tops. */
static void make_lean(struct lesson *l) {
    add_ground(l, 12);
    struct gn_shape *shape = begin(l);
    gn_shape_at(shape, -.4f, 0, -.6f);
    gn_shape_turn(shape, 'y', 20);
    gn_shape_turn(shape, 'z', -30);
    gn_shape_block(shape, .08f, 2.6f, 1.5f);
    end(l, "plate", red);
    add_block(l, "post", AT(-2, 0, .9f), 0, AT(.16f, 2.2f, .16f), blue);
    add_sun(l, 42, 155, .12f);
    add_camera(l, AT(1.1f, 4, 6.8f), AT(.4f, .5f, .1f), 38);
}

/* Two plates, one above the other: the edge of the upper one's shadow crosses the lower one's. */
static void make_plates(struct lesson *l) {
    add_ground(l, 14);
    add_block(l, "upper", AT(-1.2f, 3, -2.6f), 20, AT(2.6f, .06f, 2.2f), blue);
    add_block(l, "lower", AT(0, .8f, -1.2f), 0, AT(3.4f, .06f, 1.5f), red);
    gn_lamp_add(l->glb, &(struct gn_lamp){.kind = GN_GLB_SPOT,
                                          .at = {-1.5f, 7, -7},
                                          .aim = {0, 0, 0},
                                          .radius = .6f,
                                          .intensity = 320,
                                          .cone_deg = 30});
    add_camera(l, AT(.6f, 4.4f, 6.6f), AT(.1f, .3f, .1f), 38);
}

/* A wall, a plate on the ground and a sheet, all thin, their shadow sides towards the camera. */
static void add_thin(struct lesson *l) {
    add_ground(l, 9);
    add_block(l, "wall", AT(-1.1f, 0, -.5f), -12, AT(2.2f, 1, .05f), ochre);
    add_block(l, "plate", AT(1.2f, 0, .9f), 20, AT(1, .06f, .7f), red);
    add_block(l, "wall", AT(1.4f, 0, -.9f), 25, AT(1.4f, .7f, .03f), blue);
    add_camera(l, AT(-.4f, 2.6f, 5.2f), AT(.1f, .2f, 0), 38);
}

static void make_thin(struct lesson *l) {
    add_thin(l);
    add_sun(l, 42, 75, 0);
}

/* 150 m from their lamp, where half-floats of metres are an eighth of one apart. */
static void make_far(struct lesson *l) {
    add_thin(l);
    gn_lamp_add(l->glb, &(struct gn_lamp){.kind = GN_GLB_SPOT,
                                          .at = {35, 100, -106},
                                          .aim = {0, 0, 0},
                                          .intensity = 3 * 150 * 150,
                                          .cone_deg = 2.4f});
}

/* Three balls of different heights that look alike without their shadows. */
static void make_position(struct lesson *l) {
    const float eye[3] = {0, 3.2f, 7};
    add_ground(l, 14);
    for (int i = 0; i < 3; i++) {
        /* on the ray to a ball on the ground, nearer to the eye and smaller the higher it is */
        const float on_ground[3] = {-1.7f + 1.7f * (float)i, .55f, -.9f};
        const float share = i == 1 ? .8f : i == 2 ? .64f : 1;
        float at[3];
        for (int k = 0; k < 3; k++) at[k] = eye[k] + share * (on_ground[k] - eye[k]);
        add_ball(l, at, .55f * share, i == 1 ? ochre : i ? blue : red);
    }
    add_sun(l, 68, 60, 0);
    add_camera(l, eye, AT(0, .6f, 0), 38);
}

/* A pole in front of steps, a slope and a wave: its shadow draws their form. */
static void make_form(struct lesson *l) {
    add_ground(l, 14);
    for (int i = 0; i < 4; i++)
        add_block(l, "step", AT(-1.8f, 0, -.3f - .5f * (float)i), 0,
                  AT(1.8f, .25f * (float)(i + 1), .5f), grey);
    struct gn_shape *shape = begin(l);
    for (int i = 0; i < 3; i++) {
        gn_shape_at(shape, 1.1f, -.12f, -.4f - .7f * (float)i);
        gn_shape_turn(shape, 'z', 90);
        gn_shape_cylinder(shape, .36f, 1.8f, 48);
    }
    end(l, "wave", grey);
    shape = begin(l);
    gn_shape_at(shape, 2.2f, 0, -.05f);
    gn_shape_turn(shape, 'x', 30);
    gn_shape_block(shape, 1.6f, .05f, 2.6f);
    end(l, "slope", grey);
    for (int i = 0; i < 3; i++) {
        const float x = -2.7f + 2 * (float)i;
        add_block(l, "pole", AT(x, 0, .8f), 0, AT(.09f, 1.9f, .09f), red);
    }
    add_sun(l, 38, -118, 0);
    add_camera(l, AT(0, 4.6f, 6.2f), AT(-.1f, .3f, -.5f), 40);
}

/* A fence and a pawn behind the camera: only their shadows are seen. */
static void make_unseen(struct lesson *l) {
    static const float pawn[][2] = {{0, 0},        {.62f, 0},    {.62f, .2f},  {.45f, .32f},
                                    {.25f, .6f},   {.2f, 1.2f},  {.4f, 1.28f}, {.4f, 1.38f},
                                    {.2f, 1.45f},  {.36f, 1.6f}, {.4f, 1.8f},  {.33f, 2},
                                    {.18f, 2.12f}, {0, 2.16f}};
    add_ground(l, 24);
    add_block(l, "box", AT(-.2f, 0, -1.8f), 20, AT(.8f, .8f, .8f), red);
    struct gn_shape *shape = begin(l);
    gn_shape_at(shape, 1.1f, 0, 4.1f);
    gn_shape_lathe(shape, pawn, sizeof pawn / sizeof *pawn, 40);
    end(l, "pawn", ochre);
    shape = begin(l);
    gn_shape_at(shape, -3, 0, 4);
    gn_shape_fence(shape, &(struct gn_fence){.length = 3,
                                             .height = 1.6f,
                                             .pitch = .4f,
                                             .pale = .2f,
                                             .depth = .05f,
                                             .pointed = true});
    end(l, "fence", blue);
    add_sun(l, 24, -80, 0);
    add_camera(l, AT(0, 2.9f, 3.6f), AT(0, -.2f, -1.5f), 46);
}

/* One post and three lamps out of the picture. */
static void make_lights(struct lesson *l) {
    static const struct gn_lamp lamps[] = {
        {.kind = GN_GLB_SPOT,
         .at = {-4, 5, -2.5f},
         .intensity = 90,
         .cone_deg = 34,
         .rgb = {1, .6f, .3f}},
        {.kind = GN_GLB_SPOT,
         .at = {4.5f, 4, -1.5f},
         .intensity = 80,
         .cone_deg = 34,
         .rgb = {.3f, .7f, 1}},
        {.kind = GN_GLB_SPOT,
         .at = {.8f, 5, -5},
         .intensity = 90,
         .cone_deg = 34,
         .rgb = {.6f, 1, .5f}},
    };
    add_ground(l, 14);
    add_block(l, "post", AT(0, 0, 0), 30, AT(.3f, 1.5f, .3f), grey);
    for (size_t i = 0; i < sizeof lamps / sizeof *lamps; i++) gn_lamp_add(l->glb, &lamps[i]);
    add_camera(l, AT(0, 3.6f, 5.6f), AT(0, .4f, .2f), 40);
}

/* Hammered by a smith: shallow hollows. */
static void hammered_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    out[0] = gn_paint_fractal(u, v, 12, 2, 5);
}

/* Patina: where it is thick the metal is dull, and less of one. */
static void patina_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float thick = gn_paint_ramp(.45f, .65f, gn_paint_fractal(u, v, 4, 3, 9));
    out[0] = 0;
    out[1] = .3f + .5f * thick;
    out[2] = 1 - .8f * thick;
}

/* No lesson: a model as they come from others, which `gnomon doctor --report` measures in the light
 * that gnomon makes: nine vases of hammered bronze with a normal map, without lights and camera. */
static void make_model(struct lesson *l) {
    static const float vase[][2] = {{0, 0},        {.2f, 0},     {.22f, .04f}, {.15f, .1f},
                                    {.16f, .16f},  {.27f, .3f},  {.36f, .48f}, {.38f, .64f},
                                    {.33f, .8f},   {.2f, .92f},  {.15f, 1},    {.16f, 1.08f},
                                    {.22f, 1.13f}, {.2f, 1.13f}, {.13f, 1.06f}};
    struct gn_image relief, rough;
    struct gn_shape *shape = begin(l);
    gn_paint_relief(&relief, 128, .01f, hammered_at, NULL);
    gn_paint_fill(&rough, 64, 64, 3, patina_at, NULL);
    const struct gn_glb_material bronze = {
        .name = "bronze",
        .rgba = {.72f, .5f, .3f},
        .metal = 1,
        .rough = 1,
        .normal_texture = gn_glb_texture(l->glb, "hammered", &relief, GN_GLB_REPEAT),
        .rough_texture = gn_glb_texture(l->glb, "patina", &rough, GN_GLB_REPEAT)};
    gn_image_finish(&relief);
    gn_image_finish(&rough);
    shape->uv_per_m = 1;
    gn_shape_lathe(shape, vase, sizeof vase / sizeof *vase, 64);
    const int mesh = gn_glb_mesh(l->glb, "vase", gn_glb_geometry(l->glb, shape),
                                 gn_glb_material(l->glb, &bronze));
    for (int i = 0; i < 9; i++) {
        struct gn_glb_node node = {
            .name = "vase", .mesh = mesh, .move = {(float)(i % 3) - 1, 0, (float)(i / 3) - 1}};
        gn_glb_turn_y(40 * (float)i, node.turn);
        gn_glb_node(l->glb, &node);
    }
}

static const struct {
    const char *name;
    void (*make)(struct lesson *lesson);
} scenes[] = {
    {"solids", make_solids},   {"hut", make_hut},       {"sheets", make_sheets},
    {"lattice", make_lattice}, {"lean", make_lean},     {"plates", make_plates},
    {"far", make_far},         {"thin", make_thin},     {"position", make_position},
    {"form", make_form},       {"unseen", make_unseen}, {"lights", make_lights},
    {"model", make_model},
};

int main(int argc, char **argv) {
    for (size_t i = 0; argc == 3 && i < sizeof scenes / sizeof *scenes; i++) {
        if (strcmp(argv[1], scenes[i].name) != 0) continue;
        struct lesson lesson = {
            .glb = gn_glb_create("gnomon assets", "CC0 1.0, the authors of gnomon")};
        if (scenes[i].make != make_model) /* which has no sky of its own */
            gn_glb_scene_extras(lesson.glb,
                                "{\"gnomon_sky\":[0.16,0.17,0.19],\"gnomon_ground\":[0.1,0.1,0.1],"
                                "\"gnomon_background\":[0.3,0.36,0.42]}");
        scenes[i].make(&lesson);
        const bool ok = gn_glb_write(lesson.glb, argv[2]);
        gn_shape_finish(&lesson.shape);
        gn_glb_destroy(lesson.glb);
        return ok ? 0 : 1;
    }
    fprintf(stderr, "usage: make_lessons SCENE OUT.glb, where SCENE is one of");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        fprintf(stderr, " %s", scenes[i].name);
    fprintf(stderr, "\n");
    return 2;
}
