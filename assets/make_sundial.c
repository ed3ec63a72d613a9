/* The default scene: a sundial in a walled court, three o'clock on an afternoon in August, 50
 * degrees north. +x is east, -z north. Around the dial stand things that throw and catch shadows of
 * every kind. */
#include "dial.h"
#include "glb.h"
#include "outline.h"
#include "paint.h"
#include "shapes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define RADIANS  (float)(M_PI / 180)
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

static const struct gn_dial dial = {
    .latitude = 50, .radius = 1.42f, .centre = 0.72f, .length = 0.92f, .thickness = 0.07f};
static const float DIAL_TOP = 1.245f;

enum picture { NO_PICTURE, GRAIN, PAVING, TIMBER, BUSH, LATTICE, BRANCH, PICTURES };
enum surface {
    COURT,
    LAWN,
    STONE,
    MARBLE,
    LIME,
    BRONZE,
    INLAY,
    WOOD,
    BARK,
    HEDGE,
    SCREEN,
    LEAVES,
    IRON,
    GLASS,
    PANE,
    GLOW,
    GULL
};

struct garden {
    struct gn_glb *glb;
    int pictures[PICTURES];
    int surfaces[GULL + 1];
};

/* ---- pictures and materials ---- */

static void paint(struct garden *g) {
    static const char *const names[PICTURES] = {"",     "grain",   "paving", "timber",
                                                "bush", "lattice", "branch"};
    struct gn_image images[PICTURES] = {{0}};
    gn_paint_grain(&images[GRAIN], 256, 0.25f, 11);
    gn_paint_paving(&images[PAVING], 512, 5);
    gn_paint_wood(&images[TIMBER], 128, 3);
    gn_paint_hedge(&images[BUSH], 128, 8);
    gn_paint_lattice(&images[LATTICE], 128, 6, 4);
    gn_paint_branch(&images[BRANCH], 256, 21);
    for (int i = GRAIN; i < PICTURES; i++) {
        enum gn_glb_wrap wrap = i == BRANCH ? GN_GLB_CLAMP : GN_GLB_REPEAT;
        g->pictures[i] = gn_glb_texture(g->glb, names[i], &images[i], wrap);
        gn_image_finish(&images[i]);
    }
}

static const struct {
    const char *name;
    float rgba[4], metal, rough, glow;
    enum picture picture;
    enum gn_glb_alpha alpha;
    bool double_sided;
} surfaces[] = {
    [COURT] = {"court", {.90f, .79f, .62f, 1}, 0, 1, 0, PAVING},
    [LAWN] = {"lawn", {.30f, .46f, .12f, 1}, 0, 1, 0, BUSH},
    [STONE] = {"stone", {.78f, .72f, .62f, 1}, 0, .9f, 0, GRAIN},
    [MARBLE] = {"marble", {.93f, .90f, .84f, 1}, 0, .6f, 0, GRAIN},
    [LIME] = {"limewash", {.95f, .93f, .88f, 1}, 0, 1, 0, GRAIN},
    [BRONZE] = {"bronze", {.46f, .27f, .10f, 1}, .7f, .38f, 0, NO_PICTURE},
    [INLAY] = {"inlay", {.10f, .06f, .03f, 1}, .3f, .5f, 0, NO_PICTURE},
    [WOOD] = {"wood", {.42f, .24f, .11f, 1}, 0, .8f, 0, TIMBER},
    [BARK] = {"bark", {.24f, .16f, .10f, 1}, 0, 1, 0, TIMBER},
    [HEDGE] = {"hedge", {.16f, .30f, .07f, 1}, 0, 1, 0, BUSH},
    [SCREEN] = {"lattice", {.62f, .40f, .22f, 1}, 0, .9f, 0, LATTICE, GN_GLB_MASK, true},
    [LEAVES] = {"leaves", {.55f, .75f, .40f, 1}, 0, .9f, 0, BRANCH, GN_GLB_MASK, true},
    [IRON] = {"iron", {.05f, .06f, .06f, 1}, .2f, .5f, 0, NO_PICTURE},
    [GLASS] = {"glass", {.10f, .42f, .50f, .42f}, 0, .12f, 0, NO_PICTURE, GN_GLB_BLEND},
    [PANE] = {"pane", {.95f, .70f, .40f, .35f}, 0, .3f, .15f, NO_PICTURE, GN_GLB_BLEND},
    [GLOW] = {"flame", {1, .7f, .4f, 1}, 0, 1, 1, NO_PICTURE},
    [GULL] = {"gull", {.92f, .93f, .95f, 1}, 0, .8f, 0, NO_PICTURE, GN_GLB_OPAQUE, true},
};

static void mix_materials(struct garden *g) {
    for (int i = 0; i < COUNT(surfaces); i++) {
        struct gn_glb_material m = {.name = surfaces[i].name,
                                    .metal = surfaces[i].metal,
                                    .rough = surfaces[i].rough,
                                    .texture = g->pictures[surfaces[i].picture],
                                    .alpha = surfaces[i].alpha,
                                    .double_sided = surfaces[i].double_sided};
        memcpy(m.rgba, surfaces[i].rgba, sizeof m.rgba);
        for (int c = 0; c < 3; c++) m.emissive[c] = surfaces[i].glow * surfaces[i].rgba[c];
        g->surfaces[i] = gn_glb_material(g->glb, &m);
    }
}

/* ---- meshes and nodes ---- */

static float uv_scale(enum surface surface) {
    switch (surfaces[surface].picture) {
    case GRAIN: return 0.55f;
    case TIMBER: return 1.4f;
    case BUSH: return surface == LAWN ? 0.4f : 1.1f;
    case NO_PICTURE: return 0;
    default: return 1;
    }
}

static struct gn_shape begin(enum surface surface) {
    struct gn_shape shape;
    gn_shape_init(&shape, uv_scale(surface));
    return shape;
}

/* Takes the shape. */
static int finish(struct garden *g, const char *name, struct gn_shape *shape,
                  enum surface surface) {
    int mesh = gn_glb_mesh(g->glb, name, gn_glb_geometry(g->glb, shape), g->surfaces[surface]);
    gn_shape_finish(shape);
    return mesh;
}

struct place {
    float x, y, z, yaw;
};

static int stand(struct garden *g, const char *name, int mesh, struct place at,
                 const char *extras) {
    struct gn_glb_node node = {
        .name = name, .mesh = mesh, .move = {at.x, at.y, at.z}, .extras = extras};
    if (at.yaw != 0) gn_glb_turn_y(at.yaw, node.turn);
    return gn_glb_node(g->glb, &node);
}

/* A thing that is there once, its shape already in the scene's coordinates. */
static void put(struct garden *g, const char *name, struct gn_shape *shape, enum surface surface) {
    stand(g, name, finish(g, name, shape, surface), (struct place){0}, NULL);
}

/* ---- court, wall, hedge ---- */

static void add_ground(struct garden *g) {
    struct gn_shape court = begin(COURT), lawn = begin(LAWN);
    gn_shape_paving(&court, 1.4f, 7.1f, 10, 52);
    stand(g, "Court", finish(g, "court", &court, COURT), (struct place){0},
          "{\"gnomon_plane\":true}");
    gn_shape_at(&lawn, 0, -0.02f, 0);
    gn_shape_ring(&lawn, 7.0f, 60, 48);
    put(g, "Lawn", &lawn, LAWN);
}

static void add_wall(struct garden *g) {
    const float body[][2] = {{6.9f, -.05f}, {7.25f, -.05f}, {7.25f, .46f}, {6.9f, .46f}};
    const float coping[][2] = {{6.84f, .45f}, {7.31f, .45f}, {7.31f, .52f},
                               {7.24f, .57f}, {6.91f, .57f}, {6.84f, .52f}};
    struct gn_shape shape = begin(LIME), top = begin(STONE);
    gn_shape_arc(&shape, body, COUNT(body), -36, 255, 42);
    put(g, "Wall", &shape, LIME);
    gn_shape_arc(&top, coping, COUNT(coping), -36.4f, 255.4f, 42);
    put(g, "Coping", &top, STONE);
}

static void add_hedge(struct garden *g) {
    const float profile[][2] = {{7.75f, -.05f}, {8.75f, -.05f}, {8.8f, .9f}, {8.6f, 1.22f},
                                {8.25f, 1.32f}, {7.9f, 1.22f},  {7.7f, .9f}};
    struct gn_shape shape = begin(HEDGE);
    gn_shape_arc(&shape, profile, COUNT(profile), -4, 222, 36);
    put(g, "Hedge", &shape, HEDGE);
}

static void add_gate(struct garden *g) {
    static const float profile[][2] = {{0, .87f}, {.14f, .87f}, {.1f, .93f}, {.1f, .96f}};
    struct gn_shape shape = begin(LIME);
    gn_shape_move(&shape, 0, -.05f, 0);
    gn_shape_block(&shape, .56f, .9f, .56f);
    gn_shape_move(&shape, 0, .85f, 0);
    gn_shape_block(&shape, .68f, .09f, .68f);
    gn_shape_home(&shape);
    gn_shape_lathe(&shape, profile, COUNT(profile), 20);
    gn_shape_move(&shape, 0, 1.17f, 0);
    gn_shape_sphere(&shape, .24f, 24, 12);
    int mesh = finish(g, "gatepost", &shape, LIME);
    const float angles[2] = {-38.2f, 257.2f};
    for (int i = 0; i < 2; i++) {
        struct place at = {7.07f * cosf(angles[i] * RADIANS), 0, -7.07f * sinf(angles[i] * RADIANS),
                           angles[i]};
        stand(g, i ? "Gatepost W" : "Gatepost E", mesh, at, NULL);
    }
}

/* ---- the sundial ---- */

static void add_plinth(struct garden *g) {
    static const float profile[][2] = {
        {0, -.05f},     {2.2f, -.05f},  {2.2f, .14f},   {2.17f, .17f},  {1.84f, .17f},
        {1.84f, .32f},  {1.81f, .35f},  {1.36f, .35f},  {1.40f, .375f}, {1.42f, .41f},
        {1.40f, .445f}, {1.36f, .47f},  {1.28f, .47f},  {1.28f, .50f},  {1.21f, .54f},
        {1.165f, .61f}, {1.15f, .70f},  {1.165f, .80f}, {1.22f, .89f},  {1.28f, .93f},
        {1.28f, .96f},  {1.34f, .96f},  {1.43f, 1.0f},  {1.49f, 1.06f}, {1.52f, 1.11f},
        {1.52f, 1.16f}, {1.50f, 1.18f}, {0, 1.18f},
    };
    struct gn_shape shape = begin(STONE);
    gn_shape_lathe(&shape, profile, COUNT(profile), 48);
    put(g, "Plinth", &shape, STONE);
}

static void add_dial(struct garden *g) {
    static const float profile[][2] = {
        {0, 1.17f}, {1.42f, 1.17f}, {1.44f, 1.19f}, {1.44f, 1.225f}, {1.42f, 1.245f}};
    struct gn_shape plate = begin(MARBLE), inlay = begin(INLAY), gnomon = begin(BRONZE);
    gn_shape_lathe(&plate, profile, COUNT(profile), 48);
    gn_shape_at(&plate, 0, DIAL_TOP, 0);
    gn_shape_ring(&plate, .02f, 1.42f, 48);
    put(g, "Dial plate", &plate, MARBLE);
    gn_shape_at(&inlay, 0, DIAL_TOP, 0);
    gn_dial_inlay(&inlay, &dial);
    put(g, "Hours", &inlay, INLAY);
    gn_shape_at(&gnomon, 0, DIAL_TOP, 0);
    gn_dial_gnomon(&gnomon, &dial);
    put(g, "Gnomon", &gnomon, BRONZE);
}

/* ---- thick and round ---- */

static int column_mesh(struct garden *g) {
    static const float profile[][2] = {
        {0, .12f},     {.27f, .12f},  {.30f, .15f},  {.30f, .19f},  {.27f, .22f},  {.23f, .24f},
        {.22f, .30f},  {.215f, 1.1f}, {.19f, 2.22f}, {.22f, 2.25f}, {.22f, 2.29f}, {.19f, 2.31f},
        {.20f, 2.38f}, {.27f, 2.45f}, {.29f, 2.49f}, {0, 2.49f},
    };
    struct gn_shape shape = begin(STONE);
    gn_shape_move(&shape, 0, -.05f, 0);
    gn_shape_block(&shape, .72f, .18f, .72f);
    gn_shape_home(&shape);
    gn_shape_lathe(&shape, profile, COUNT(profile), 24);
    gn_shape_move(&shape, 0, 2.48f, 0);
    gn_shape_block(&shape, .64f, .12f, .64f);
    return finish(g, "column", &shape, STONE);
}

static const float portico[4][2] = {
    {-4.30f, -3.55f}, {-5.25f, -1.85f}, {-5.55f, .05f}, {-5.2f, 1.95f}};

static void add_beam(struct gn_shape *shape, const float a[2], const float b[2]) {
    gn_shape_at(shape, (a[0] + b[0]) / 2, 2.59f, (a[1] + b[1]) / 2);
    gn_shape_turn(shape, 'y', atan2f(a[1] - b[1], b[0] - a[0]) / RADIANS);
    gn_shape_block(shape, hypotf(b[0] - a[0], b[1] - a[1]) + .1f, .26f, .42f);
}

static void add_portico(struct garden *g) {
    struct gn_shape beams = begin(STONE);
    int column = column_mesh(g);
    for (int i = 0; i < 4; i++) {
        char name[24];
        snprintf(name, sizeof name, "Column %d", i + 1);
        struct place at = {portico[i][0], 0, portico[i][1], 12.0f * (float)i - 30};
        stand(g, name, column, at, NULL);
    }
    for (int i = 0; i < 3; i++) {
        add_beam(&beams, portico[i], portico[i + 1]);
        gn_shape_home(&beams);
    }
    put(g, "Architrave", &beams, STONE);
}

static void add_bench(struct garden *g) {
    struct gn_shape shape = begin(STONE);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(&shape, .72f * (float)side, -.05f, 0);
        gn_shape_block(&shape, .22f, .48f, .42f);
    }
    gn_shape_at(&shape, 0, .42f, 0);
    gn_shape_block(&shape, 2.0f, .11f, .56f);
    stand(g, "Bench", finish(g, "bench", &shape, STONE), (struct place){4.5f, 0, -4.1f, -44}, NULL);
}

static void add_urn(struct garden *g) {
    static const float profile[][2] = {
        {0, .69f},     {.20f, .69f},  {.20f, .73f},   {.10f, .78f},  {.075f, .84f}, {.10f, .90f},
        {.22f, .97f},  {.31f, 1.08f}, {.34f, 1.20f},  {.31f, 1.33f}, {.24f, 1.42f}, {.22f, 1.47f},
        {.27f, 1.53f}, {.34f, 1.56f}, {.34f, 1.585f}, {.28f, 1.58f}, {.19f, 1.50f}, {0, 1.47f},
    };
    struct gn_shape shape = begin(LIME);
    gn_shape_move(&shape, 0, -.05f, 0);
    gn_shape_block(&shape, .74f, .17f, .74f);
    gn_shape_move(&shape, 0, .16f, 0);
    gn_shape_block(&shape, .52f, .54f, .52f);
    gn_shape_move(&shape, 0, .53f, 0);
    gn_shape_block(&shape, .64f, .08f, .64f);
    gn_shape_home(&shape);
    gn_shape_lathe(&shape, profile, COUNT(profile), 28);
    int mesh = finish(g, "urn", &shape, LIME);
    stand(g, "Urn N", mesh, (struct place){1.1f, 0, -5.4f, 10}, NULL);
    stand(g, "Urn E", mesh, (struct place){5.55f, 0, -.55f, 30}, NULL);
}

static void add_balls(struct garden *g) {
    static const float balls[][3] = {{2.55f, 2.75f, .36f}, {3.2f, 2.2f, .22f}, {2.2f, 3.4f, .18f}};
    struct gn_shape shape = begin(STONE), glass = begin(GLASS), foot = begin(BRONZE);
    gn_shape_sphere(&shape, 1, 32, 16);
    int mesh = finish(g, "ball", &shape, STONE);
    for (int i = 0; i < COUNT(balls); i++) {
        char name[24];
        snprintf(name, sizeof name, "Ball %d", i + 1);
        gn_glb_node(g->glb,
                    &(struct gn_glb_node){.name = name,
                                          .mesh = mesh,
                                          .move = {balls[i][0], balls[i][2] - .004f, balls[i][1]},
                                          .scale = {balls[i][2], balls[i][2], balls[i][2]}});
    }
    gn_shape_at(&glass, -.35f, .93f, 4.35f);
    gn_shape_sphere(&glass, .27f, 32, 16);
    stand(g, "Gazing globe", finish(g, "globe", &glass, GLASS), (struct place){0},
          "{\"gnomon_cast\":false}");
    const float profile[][2] = {{0, -.02f},   {.2f, -.02f}, {.2f, .03f},  {.06f, .09f},
                                {.035f, .3f}, {.05f, .55f}, {.12f, .67f}, {0, .665f}};
    gn_shape_at(&foot, -.35f, 0, 4.35f);
    gn_shape_lathe(&foot, profile, COUNT(profile), 20);
    put(g, "Globe stand", &foot, BRONZE);
}

/* ---- thin ---- */

static void add_armillary(struct garden *g) {
    static const float profile[][2] = {{0, -.05f},   {.34f, -.05f}, {.34f, .08f}, {.24f, .14f},
                                       {.17f, .24f}, {.15f, .60f},  {.19f, .80f}, {.26f, .86f},
                                       {.26f, .93f}, {0, .95f}};
    struct gn_shape foot = begin(STONE), rings = begin(BRONZE);
    gn_shape_lathe(&foot, profile, COUNT(profile), 24);
    stand(g, "Armillary foot", finish(g, "armillary foot", &foot, STONE),
          (struct place){4.6f, 0, 1.6f, 0}, NULL);
    const float tilt = 90 - dial.latitude;
    for (int i = 0; i < 3; i++) {
        gn_shape_at(&rings, 0, 1.5f, 0);
        gn_shape_turn(&rings, 'x',
                      tilt - 90 + 90); /* the equator's ring lies square to the earth's axis */
        if (i > 0) gn_shape_turn(&rings, 'z', 90);
        if (i > 1) gn_shape_turn(&rings, 'x', 90);
        gn_shape_torus(&rings, .46f + .018f * (float)i, .016f, 36, 6);
    }
    const float c = cosf(dial.latitude * RADIANS), s = sinf(dial.latitude * RADIANS);
    gn_shape_home(&rings);
    gn_shape_rod(&rings, (float[3]){0, 1.5f - .62f * s, .62f * c},
                 (float[3]){0, 1.5f + .62f * s, -.62f * c}, .012f, 6);
    gn_shape_rod(&rings, (float[3]){0, .93f, 0}, (float[3]){0, 1.03f, 0}, .03f, 8);
    stand(g, "Armillary", finish(g, "armillary", &rings, BRONZE), (struct place){4.6f, 0, 1.6f, 0},
          NULL);
}

static void add_arches(struct garden *g) {
    struct gn_shape shape = begin(IRON);
    for (int i = 0; i < 3; i++) {
        gn_shape_at(&shape, 0, -.05f, .45f * (float)(i - 1));
        gn_shape_arch(&shape, 1.5f, 1.5f, .022f, 6);
    }
    gn_shape_home(&shape);
    for (int i = 0; i < 9; i++) {
        float angle = (float)M_PI * (float)(i - 1) / 6, x = -.75f * cosf(angle),
              y = 1.45f + .75f * sinf(angle);
        if (i == 0 || i == 8) x = i ? .75f : -.75f, y = .8f;
        gn_shape_rod(&shape, (float[3]){x, y, -.52f}, (float[3]){x, y, .52f}, .014f, 5);
    }
    stand(g, "Rose arch", finish(g, "arch", &shape, IRON), (struct place){2.55f, 0, -5.0f, -30},
          NULL);
}

static void add_canes(struct garden *g) {
    struct gn_shape shape = begin(WOOD);
    for (int i = 0; i < 5; i++) {
        float angle = 2 * (float)M_PI * (float)i / 5, c = cosf(angle), s = sinf(angle);
        gn_shape_rod(&shape, (float[3]){.55f * c, -.03f, .55f * s},
                     (float[3]){-.1f * c, 1.95f + .03f * (float)i, -.1f * s}, .014f, 6);
    }
    gn_shape_at(&shape, 0, 1.62f, 0);
    gn_shape_torus(&shape, .045f, .014f, 12, 6);
    stand(g, "Canes", finish(g, "canes", &shape, WOOD), (struct place){-.6f, 0, -5.6f, 0}, NULL);
}

static void add_fence(struct garden *g) {
    struct gn_shape shape = begin(WOOD);
    gn_shape_fence(&shape, &(struct gn_fence){.length = 2.3f,
                                              .height = .82f,
                                              .pitch = .19f,
                                              .pale = .085f,
                                              .depth = .03f,
                                              .pointed = true});
    stand(g, "Fence", finish(g, "fence", &shape, WOOD), (struct place){-3.6f, -.004f, -4.75f, 12},
          NULL);
}

/* ---- holes ---- */

static void add_screen(struct garden *g) {
    struct gn_shape frame = begin(WOOD), card = begin(SCREEN);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(&frame, .95f * (float)side, -.05f, 0);
        gn_shape_block(&frame, .09f, 2.0f, .09f);
        gn_shape_at(&frame, 0, side < 0 ? .12f : 1.76f, 0);
        gn_shape_block(&frame, 1.83f, .07f, .06f);
    }
    gn_shape_at(&card, 0, .18f, 0);
    gn_shape_card(&card, 1.84f, 1.6f);
    struct place at = {-2.75f, 0, 4.0f, 72};
    stand(g, "Screen frame", finish(g, "screen frame", &frame, WOOD), at, NULL);
    stand(g, "Screen", finish(g, "screen", &card, SCREEN), at, NULL);
}

static void leaf_card(struct gn_shape *shape, int i) {
    float turn = 137.5f * (float)i, lift = .5f + .5f * cosf(.9f * (float)i),
          out = .25f + .55f * (1 - lift * .6f);
    gn_shape_at(shape, 0, 2.15f + 1.5f * lift, 0);
    gn_shape_turn(shape, 'y', turn);
    gn_shape_move(shape, 0, 0, .6f * out);
    gn_shape_turn(shape, 'x', 78 - 60 * lift);
    gn_shape_turn(shape, 'y', 40 * sinf(1.7f * (float)i));
    gn_shape_card(shape, 1.25f, 1.25f);
}

static void add_trees(struct garden *g) {
    static const struct place places[] = {
        {-8.3f, 0, 5.0f, 0}, {6.9f, 0, -7.4f, 100}, {-3.9f, 0, -9.6f, 220}};
    static const float bole[][2] = {{0, -.05f},   {.16f, -.05f}, {.11f, .3f},
                                    {.09f, 1.6f}, {.05f, 3.2f},  {0, 3.3f}};
    struct gn_shape trunk = begin(BARK), crown = begin(LEAVES);
    gn_shape_lathe(&trunk, bole, COUNT(bole), 10);
    for (int i = 0; i < 46; i++) leaf_card(&crown, i);
    int trunk_mesh = finish(g, "trunk", &trunk, BARK),
        crown_mesh = finish(g, "crown", &crown, LEAVES);
    for (int i = 0; i < COUNT(places); i++) {
        char name[24];
        snprintf(name, sizeof name, "Trunk %d", i + 1);
        stand(g, name, trunk_mesh, places[i], NULL);
        snprintf(name, sizeof name, "Crown %d", i + 1);
        stand(g, name, crown_mesh, places[i], NULL);
    }
}

static void add_cypresses(struct garden *g) {
    static const float places[][3] = {{-8.2f, -9.5f, 1},
                                      {1.2f, -11.2f, 1.15f},
                                      {3.2f, -12.3f, .9f},
                                      {11.0f, -6.0f, 1.05f},
                                      {-11.5f, -4.5f, 1.2f}};
    static const float profile[][2] = {{0, -.05f},   {.5f, -.05f}, {.62f, .5f}, {.6f, 1.3f},
                                       {.42f, 2.5f}, {.18f, 3.5f}, {0, 3.9f}};
    struct gn_shape shape = begin(HEDGE);
    gn_shape_lathe(&shape, profile, COUNT(profile), 18);
    int mesh = finish(g, "cypress", &shape, HEDGE);
    for (int i = 0; i < COUNT(places); i++) {
        char name[24];
        snprintf(name, sizeof name, "Cypress %d", i + 1);
        float s = places[i][2];
        gn_glb_node(g->glb, &(struct gn_glb_node){.name = name,
                                                  .mesh = mesh,
                                                  .move = {places[i][0], 0, places[i][1]},
                                                  .scale = {s, s, s}});
    }
}

/* ---- hanging and flying ---- */

static void add_hoop(struct garden *g) {
    struct gn_shape shape = begin(BRONZE);
    gn_shape_turn(&shape, 'x', 90);
    gn_shape_torus(&shape, .34f, .025f, 32, 6);
    gn_shape_turn(&shape, 'z', 90);
    gn_shape_torus(&shape, .24f, .018f, 28, 6);
    gn_shape_home(&shape);
    gn_shape_rod(&shape, (float[3]){0, .22f, 0}, (float[3]){0, .95f, 0}, .007f, 5);
    float x = (portico[1][0] + portico[2][0]) / 2, z = (portico[1][1] + portico[2][1]) / 2;
    int node =
        stand(g, "Hoop", finish(g, "hoop", &shape, BRONZE), (struct place){x, 1.66f, z, 0}, NULL);
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

static int wing_mesh(struct garden *g, float side) {
    const float right[][2] = {{0, -.14f}, {.34f, -.2f}, {.82f, -.02f}, {.40f, .08f}, {0, .12f}};
    float points[5][2];
    for (int i = 0; i < 5; i++) {
        const float *p = right[side > 0 ? i : 4 - i];
        points[i][0] = side * p[0];
        points[i][1] = p[1];
    }
    struct gn_shape shape = begin(GULL);
    gn_shape_turn(&shape, 'x', -90);
    gn_shape_extrude(&shape, &(struct gn_outline){.points = (const float(*)[2])points, .count = 5},
                     .018f);
    return finish(g, side > 0 ? "wing R" : "wing L", &shape, GULL);
}

static int body_mesh(struct garden *g) {
    static const float profile[][2] = {{0, -.42f},   {.035f, -.3f}, {.085f, -.05f}, {.08f, .12f},
                                       {.05f, .24f}, {.045f, .3f},  {0, .4f}};
    static const float tail[][2] = {{-.03f, .25f}, {-.12f, .55f}, {.12f, .55f}, {.03f, .25f}};
    float fan[4][2];
    for (int i = 0; i < 4; i++) fan[i][0] = tail[i][0], fan[i][1] = -tail[i][1];
    struct gn_shape shape = begin(GULL);
    gn_shape_turn(&shape, 'x', -90);
    gn_shape_lathe(&shape, profile, COUNT(profile), 14);
    gn_shape_home(&shape);
    gn_shape_turn(&shape, 'x', -90);
    gn_shape_extrude(&shape, &(struct gn_outline){.points = (const float(*)[2])fan, .count = 4},
                     .014f);
    return finish(g, "gull", &shape, GULL);
}

enum { LAP = 8 }; /* seconds of key frames; the lap takes twelve seconds */

/* Where the gull is at the lap's share t, and its velocity per share. */
static void gull_at(float t, float at[3], float velocity[3]) {
    float a = 2 * (float)M_PI * (t + .27f), w = 2 * (float)M_PI;
    at[0] = -1.7f + 3.3f * cosf(a), at[1] = 3.5f + .35f * sinf(2 * a), at[2] = .9f + 3.6f * sinf(a);
    velocity[0] = -3.3f * w * sinf(a), velocity[1] = .7f * w * cosf(2 * a),
    velocity[2] = 3.6f * w * cosf(a);
}

static void fly(struct garden *g, int animation, int node) {
    enum { KEYS = LAP + 1, TURNS = 4 * LAP + 1 };
    float times[KEYS], path[KEYS][3][3], turn_times[TURNS], turns[TURNS][4];
    for (int i = 0; i < KEYS; i++) {
        float velocity[3];
        gull_at((float)(i % LAP) / LAP, path[i][1], velocity);
        times[i] = 12.0f * (float)i / LAP;
        for (int c = 0; c < 3; c++) path[i][0][c] = path[i][2][c] = velocity[c] / 12;
    }
    for (int i = 0; i < TURNS; i++) {
        float at[3], v[3], t = (float)i / (TURNS - 1);
        gull_at(t, at, v);
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

static void flap(struct garden *g, int animation, int node, float side) {
    enum { KEYS = 31 };
    float times[KEYS], turns[KEYS][4] = {{0}};
    for (int i = 0; i < KEYS; i++) {
        float angle = side * (i % 2 ? -14.0f : 26.0f) * RADIANS;
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

static void add_gull(struct garden *g) {
    float at[3], velocity[3];
    gull_at(0, at, velocity);
    int animation = gn_glb_animation(g->glb, "gull");
    int gull = stand(g, "Gull", body_mesh(g), (struct place){at[0], at[1], at[2], 0}, NULL);
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

/* ---- light ---- */

static const float lamp[3] = {4.15f, 2.62f, -2.35f};

static void add_lamp_post(struct garden *g) {
    static const float foot[][2] = {{0, -.05f},   {.17f, -.05f}, {.17f, .1f}, {.09f, .2f},
                                    {.055f, .5f}, {.04f, 3.0f},  {0, 3.05f}};
    static const float roof[][2] = {{0, .26f}, {.24f, .24f}, {.13f, .36f}, {.05f, .42f}, {0, .5f}};
    static const float box[][2] = {{.10f, -.06f}, {.17f, .25f}};
    struct gn_shape iron = begin(IRON), pane = begin(PANE), flame = begin(GLOW);
    gn_shape_at(&iron, .62f, -lamp[1], 0);
    gn_shape_lathe(&iron, foot, COUNT(foot), 14);
    gn_shape_home(&iron);
    const float arm[][3] = {
        {.62f, .2f, 0}, {.5f, .48f, 0}, {.28f, .6f, 0}, {.08f, .58f, 0}, {0, .46f, 0}};
    gn_shape_tube(&iron, arm, COUNT(arm), .022f, 6);
    gn_shape_lathe(&iron, roof, COUNT(roof), 6);
    gn_shape_lathe(&pane, box, COUNT(box), 6);
    gn_shape_at(&flame, 0, .12f, 0);
    gn_shape_sphere(&flame, .06f, 12, 8);
    struct place at = {lamp[0], lamp[1], lamp[2], 20};
    stand(g, "Lamp post", finish(g, "lamp post", &iron, IRON), at, NULL);
    stand(g, "Lamp panes", finish(g, "lamp panes", &pane, PANE), at, "{\"gnomon_cast\":false}");
    stand(g, "Flame", finish(g, "flame", &flame, GLOW), at, "{\"gnomon_cast\":false}");
}

static void add_lights(struct garden *g) {
    struct gn_glb_light sun = {
        .name = "Sun", .kind = GN_GLB_DIRECTIONAL, .rgb = {1, .93f, .80f}, .intensity = 3.0f};
    struct gn_glb_node node = {.name = "Sun"};
    gn_dial_sun(&dial, 15.5f, 15, node.move);
    for (int i = 0; i < 3; i++) node.move[i] *= 20;
    gn_glb_look(node.move, (float[3]){0}, node.turn);
    node.light = gn_glb_light(g->glb, &sun);
    gn_glb_node(g->glb, &node);

    struct gn_glb_light spot = {.name = "Lantern",
                                .kind = GN_GLB_SPOT,
                                .rgb = {1, .42f, .12f},
                                .intensity = 30,
                                .range = 14,
                                .inner = 26 * RADIANS,
                                .outer = 46 * RADIANS};
    struct gn_glb_node hung = {.name = "Lantern", .move = {lamp[0], lamp[1] - .08f, lamp[2]}};
    gn_glb_look(hung.move, (float[3]){2.35f, 0, -1.55f}, hung.turn);
    hung.light = gn_glb_light(g->glb, &spot);
    gn_glb_node(g->glb, &hung);
}

/* ---- cameras ---- */

static void add_view(struct garden *g, const struct gn_glb_camera *lens, const float eye[3],
                     const float target[3]) {
    struct gn_glb_node node = {.name = lens->name,
                               .camera = gn_glb_camera(g->glb, lens),
                               .move = {eye[0], eye[1], eye[2]}};
    gn_glb_look(eye, target, node.turn);
    gn_glb_node(g->glb, &node);
}

static void add_cameras(struct garden *g) {
    add_view(
        g,
        &(struct gn_glb_camera){.name = "Garden", .yfov = 32 * RADIANS, .znear = .1f, .zfar = 100},
        (float[3]){3.9f, 5.2f, 10.2f}, (float[3]){.2f, .95f, -.35f});
    add_view(
        g,
        &(struct gn_glb_camera){.name = "Dial", .yfov = 40 * RADIANS, .znear = .05f, .zfar = 100},
        (float[3]){1.85f, 3.55f, 2.15f}, (float[3]){.12f, 1.3f, -.1f});
    add_view(g,
             &(struct gn_glb_camera){
                 .name = "Top", .xmag = 8.6f * 16 / 9, .ymag = 8.6f, .znear = .1f, .zfar = 40},
             (float[3]){0, 20, 0}, (float[3]){0, 0, 0});
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: make_sundial OUT.glb\n");
        return 2;
    }
    struct garden g = {.glb = gn_glb_create("CC0 1.0, the authors of gnomon")};
    gn_glb_scene_extras(g.glb,
                        "{\"gnomon_sky\":[0.19,0.23,0.29],\"gnomon_ground\":[0.12,0.1,0.075],"
                        "\"gnomon_background\":[0.5,0.66,0.84]}");
    paint(&g);
    mix_materials(&g);
    static void (*const parts[])(struct garden *) = {
        add_cameras,   add_lights, add_ground,  add_wall,      add_hedge,  add_gate,
        add_plinth,    add_dial,   add_portico, add_bench,     add_urn,    add_balls,
        add_armillary, add_arches, add_canes,   add_fence,     add_screen, add_trees,
        add_cypresses, add_hoop,   add_gull,    add_lamp_post,
    };
    for (int i = 0; i < COUNT(parts); i++) parts[i](&g);
    bool ok = gn_glb_write(g.glb, argv[1]);
    gn_glb_destroy(g.glb);
    return ok ? 0 : 1;
}
