#include "garden.h"

#include "glb.h"
#include "shape/outline.h"

#include <math.h>

void gn_garden_add_hoop(struct gn_garden *g) {
    struct gn_shape shape = gn_garden_begin(BRONZE);
    gn_shape_turn(&shape, 'x', 90);
    gn_shape_torus(&shape, .34f, .025f, 32, 6);
    gn_shape_turn(&shape, 'z', 90);
    gn_shape_torus(&shape, .24f, .018f, 28, 6);
    gn_shape_home(&shape);
    gn_shape_rod(&shape, (float[3]){0, .22f, 0}, (float[3]){0, .95f, 0}, .007f, 5);
    int node =
        gn_garden_stand(g, "Hoop", gn_garden_mesh(g, "hoop", &shape, BRONZE), g->plan->hoop, NULL);
    enum { KEYS = 5 };
    float times[KEYS], turns[KEYS][4];
    for (int i = 0; i < KEYS; i++) {
        times[i] = 3.0f * (float)i;
        gn_glb_turn_y(90.0f * (float)i, turns[i]);
    }
    gn_glb_channel(g->glb, gn_glb_animation(g->glb, "hoop"),
                   &(struct gn_glb_channel){.node = node,
                                            .path = GN_GLB_ROTATION,
                                            .keys = KEYS,
                                            .times = times,
                                            .values = turns[0]});
}

static int wing_mesh(struct gn_garden *g, float side) {
    const float right[][2] = {{0, -.14f}, {.34f, -.2f}, {.82f, -.02f}, {.40f, .08f}, {0, .12f}};
    float points[5][2];
    for (int i = 0; i < 5; i++) {
        const float *p = right[side > 0 ? i : 4 - i];
        points[i][0] = side * p[0];
        points[i][1] = p[1];
    }
    struct gn_shape shape = gn_garden_begin(GULL);
    gn_shape_turn(&shape, 'x', -90);
    gn_shape_extrude(&shape, &(struct gn_outline){.points = (const float(*)[2])points, .count = 5},
                     .018f);
    return gn_garden_mesh(g, side > 0 ? "wing R" : "wing L", &shape, GULL);
}

static int body_mesh(struct gn_garden *g) {
    static const float profile[][2] = {{0, -.42f},   {.035f, -.3f}, {.085f, -.05f}, {.08f, .12f},
                                       {.05f, .24f}, {.045f, .3f},  {0, .4f}};
    static const float tail[][2] = {{-.03f, .25f}, {-.12f, .55f}, {.12f, .55f}, {.03f, .25f}};
    float fan[4][2];
    for (int i = 0; i < 4; i++) fan[i][0] = tail[i][0], fan[i][1] = -tail[i][1];
    struct gn_shape shape = gn_garden_begin(GULL);
    gn_shape_turn(&shape, 'x', -90);
    gn_shape_lathe(&shape, profile, GN_COUNT(profile), 14);
    gn_shape_home(&shape);
    gn_shape_turn(&shape, 'x', -90);
    gn_shape_extrude(&shape, &(struct gn_outline){.points = (const float(*)[2])fan, .count = 4},
                     .014f);
    return gn_garden_mesh(g, "gull", &shape, GULL);
}

enum { LAP = 8 }; /* key frames of a lap, which takes twelve seconds */

/* Position of the gull at the fraction t of a lap, and its derivative by t. */
static void gull_at(float t, float at[3], float velocity[3]) {
    float a = 2 * (float)M_PI * t, w = 2 * (float)M_PI;
    at[0] = -.8f + 3.3f * cosf(a), at[1] = 3.5f + .35f * sinf(2 * a), at[2] = .9f + 3.6f * sinf(a);
    velocity[0] = -3.3f * w * sinf(a), velocity[1] = .7f * w * cosf(2 * a),
    velocity[2] = 3.6f * w * cosf(a);
}

static void fly(struct gn_garden *g, int animation, int node) {
    enum { KEYS = LAP + 1, TURNS = 4 * LAP + 1 };
    float times[KEYS], path[KEYS][3][3], turn_times[TURNS], turns[TURNS][4];
    for (int i = 0; i < KEYS; i++) {
        float velocity[3];
        gull_at((float)(i % LAP) / LAP + g->plan->lap, path[i][1], velocity);
        times[i] = 12.0f * (float)i / LAP;
        for (int c = 0; c < 3; c++) path[i][0][c] = path[i][2][c] = velocity[c] / 12;
    }
    for (int i = 0; i < TURNS; i++) {
        float at[3], v[3], t = (float)i / (TURNS - 1);
        gull_at(t + g->plan->lap, at, v);
        turn_times[i] = 12 * t;
        gn_glb_look((float[3]){0}, v, turns[i]);
        float same = 0;
        for (int c = 0; c < 4 && i; c++) same += turns[i][c] * turns[i - 1][c];
        for (int c = 0; c < 4 && same < 0; c++) turns[i][c] = -turns[i][c];
    }
    gn_glb_channel(g->glb, animation,
                   &(struct gn_glb_channel){.node = node,
                                            .path = GN_GLB_TRANSLATION,
                                            .interpolation = GN_GLB_CUBICSPLINE,
                                            .keys = KEYS,
                                            .times = times,
                                            .values = path[0][0]});
    gn_glb_channel(g->glb, animation,
                   &(struct gn_glb_channel){.node = node,
                                            .path = GN_GLB_ROTATION,
                                            .keys = TURNS,
                                            .times = turn_times,
                                            .values = turns[0]});
}

static void flap(struct gn_garden *g, int animation, int node, float side) {
    enum { KEYS = 31 };
    float times[KEYS], turns[KEYS][4] = {{0}};
    for (int i = 0; i < KEYS; i++) {
        float angle = side * (i % 2 ? -14.0f : 26.0f) * GN_RADIANS;
        times[i] = 12.0f * (float)i / (KEYS - 1);
        turns[i][2] = sinf(angle / 2), turns[i][3] = cosf(angle / 2);
    }
    gn_glb_channel(g->glb, animation,
                   &(struct gn_glb_channel){.node = node,
                                            .path = GN_GLB_ROTATION,
                                            .keys = KEYS,
                                            .times = times,
                                            .values = turns[0]});
}

void gn_garden_add_gull(struct gn_garden *g) {
    float at[3], velocity[3];
    gull_at(g->plan->lap, at, velocity);
    int animation = gn_glb_animation(g->glb, "gull");
    int gull =
        gn_garden_stand(g, "Gull", body_mesh(g), (struct gn_place){at[0], at[1], at[2], 0}, NULL);
    for (int side = -1; side <= 1; side += 2) {
        int wing =
            gn_glb_node(g->glb, &(struct gn_glb_node){.name = side > 0 ? "Wing R" : "Wing L",
                                                      .parent = gull,
                                                      .mesh = wing_mesh(g, (float)side),
                                                      .move = {.05f * (float)side, .03f, -.02f}});
        flap(g, animation, wing, (float)side);
    }
    fly(g, animation, gull);
}
