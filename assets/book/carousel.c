/* A carousel at dusk: the lamp in its middle throws the shadows of horses, poles and people's posts
 * over the square, and they turn with it. Metres; a turn takes sixteen seconds. */
#include "book.h"

enum { PAVING, WOODEN, CREAM, RED, BLUE, GREEN, GOLD, STRIPES, BULB, DARK, STUCCO, LEAF, SURFACES };
enum { HORSES = 10 };

static void stripes_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float x = 2 * u, at = x - floorf(x);
    const float red =
        gn_paint_ramp(.0f, .012f, fminf(fminf(at, fabsf(at - .5f)), 1 - at)) * (at < .5f ? 1 : -1);
    const float t = .5f + .5f * red;
    const float a[3] = {.62f, .07f, .07f}, c[3] = {.93f, .86f, .72f};
    for (int k = 0; k < 3; k++)
        out[k] = a[k] + t * (c[k] - a[k]) - .04f * gn_paint_noise(u, v, 64, 2);
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    struct gn_image paving;
    gn_paint_paving(&paving, 1024, 5);
    const int setts = gn_book_texture(b, "paving", &paving);
    const int wood = gn_book_picture(b, "wood", (int[]){512, 512}, 3, gn_book_wood, NULL);
    const struct gn_glb_material m[SURFACES] = {
        [PAVING] = {.name = "paving", .rgba = {.80f, .74f, .70f}, .rough = .55f, .texture = setts},
        [WOODEN] = {.name = "boards", .rgba = {.34f, .27f, .22f}, .rough = .6f, .texture = wood},
        [CREAM] = {.name = "cream paint", .rgba = {.66f, .60f, .50f}, .rough = .35f},
        [RED] = {.name = "red paint", .rgba = {.55f, .05f, .05f}, .rough = .3f},
        [BLUE] = {.name = "blue paint", .rgba = {.06f, .16f, .42f}, .rough = .3f},
        [GREEN] = {.name = "green paint", .rgba = {.05f, .28f, .16f}, .rough = .3f},
        [GOLD] = {.name = "gold leaf", .rgba = {.90f, .66f, .28f}, .metal = 1, .rough = .34f},
        [STRIPES] = {.name = "canvas",
                     .rgba = {1, 1, 1},
                     .rough = .9f,
                     .texture =
                         gn_book_picture(b, "stripes", (int[]){256, 64}, 3, stripes_at, NULL),
                     .double_sided = true},
        [BULB] = {.name = "bulb", .rgba = {1, .8f, .5f}, .rough = 1, .emissive = {1, .80f, .46f}},
        [STUCCO] = {.name = "stucco", .rgba = {.62f, .54f, .44f}, .rough = 1},
        [LEAF] = {.name = "leaf", .rgba = {.14f, .22f, .07f}, .rough = .8f},
        [DARK] = {.name = "dark paint", .rgba = {.07f, .04f, .03f}, .rough = .4f},
    };
    for (int i = 0; i < SURFACES; i++) surfaces[i] = gn_glb_material(b->glb, &m[i]);
}

/* A horse of wood, sawn out and rounded, its head towards +x. */
static const float horse[][2] = {
    {.98f, .70f},   {1.02f, .76f},  {.97f, .83f},   {.89f, .93f},   {.87f, 1.03f}, {.81f, .97f},
    {.72f, .985f},  {.62f, .93f},   {.52f, .82f},   {.42f, .71f},   {.30f, .66f},  {.10f, .645f},
    {-.08f, .66f},  {-.22f, .70f},  {-.33f, .68f},  {-.40f, .62f},  {-.50f, .63f}, {-.60f, .57f},
    {-.67f, .44f},  {-.70f, .28f},  {-.60f, .36f},  {-.54f, .46f},  {-.46f, .48f}, {-.42f, .43f},
    {-.41f, .35f},  {-.47f, .25f},  {-.57f, .16f},  {-.63f, .07f},  {-.68f, .02f}, {-.61f, -.05f},
    {-.52f, -.01f}, {-.47f, .09f},  {-.36f, .20f},  {-.28f, .29f},  {-.25f, .20f}, {-.28f, .08f},
    {-.34f, -.03f}, {-.37f, -.10f}, {-.28f, -.13f}, {-.22f, -.07f}, {-.18f, .08f}, {-.12f, .24f},
    {-.07f, .34f},  {.05f, .325f},  {.20f, .335f},  {.29f, .35f},   {.33f, .28f},  {.28f, .18f},
    {.21f, .10f},   {.23f, .02f},   {.33f, .03f},   {.38f, .13f},   {.44f, .23f},  {.48f, .31f},
    {.56f, .29f},   {.645f, .21f},  {.62f, .10f},   {.64f, .01f},   {.74f, .02f},  {.755f, .12f},
    {.765f, .27f},  {.68f, .38f},   {.60f, .45f},   {.61f, .54f},   {.65f, .62f},  {.705f, .70f},
    {.75f, .75f},   {.82f, .72f},   {.90f, .66f}};

static int horse_mesh(struct gn_book *b, int body, int saddle, int gold) {
    static const float blanket[][2] = {{-.16f, .40f}, {.30f, .40f},   {.31f, .56f}, {.30f, .68f},
                                       {.10f, .668f}, {-.10f, .685f}, {-.18f, .62f}};
    static const float collar[][2] = {
        {.36f, .46f}, {.44f, .44f}, {.62f, .86f}, {.56f, .90f}, {.42f, .72f}};
    struct gn_shape *shape = gn_book_begin(b, 0);
    gn_shape_bevel(shape, &(struct gn_outline){.points = horse, .count = GN_COUNT(horse)}, .24f,
                   .028f, 3);
    const int mesh = gn_book_mesh(b, "horse", body);
    shape = gn_book_begin(b, 0);
    gn_shape_bevel(shape, &(struct gn_outline){.points = blanket, .count = GN_COUNT(blanket)}, .29f,
                   .02f, 2);
    gn_glb_mesh_add(b->glb, mesh, gn_glb_geometry(b->glb, shape), saddle);
    shape = gn_book_begin(b, 0);
    gn_shape_bevel(shape, &(struct gn_outline){.points = collar, .count = GN_COUNT(collar)}, .27f,
                   .015f, 2);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(shape, .83f, .86f, .122f * (float)side);
        gn_shape_sphere(shape, .020f, 12, 8);
    }
    gn_glb_mesh_add(b->glb, mesh, gn_glb_geometry(b->glb, shape), gold);
    return mesh;
}

/* Up and down on its pole, twice a turn. */
static void add_gallop(struct gn_book *b, int node, const float at[3], float phase) {
    enum { KEYS = 33 };
    float times[KEYS], places[KEYS][3];
    for (int i = 0; i < KEYS; i++) {
        times[i] = 16 * (float)i / (KEYS - 1);
        memcpy(places[i], at, sizeof places[i]);
        places[i][1] += .16f * sinf(2 * (float)M_PI * (4 * (float)i / (KEYS - 1) + phase));
    }
    gn_glb_channel(b->glb, gn_glb_animation(b->glb, "gallop"),
                   &(struct gn_glb_channel){.node = node,
                                            .path = GN_GLB_TRANSLATION,
                                            .keys = KEYS,
                                            .times = times,
                                            .values = places[0]});
}

static void add_horses(struct gn_book *b, const int *surfaces) {
    const int colors[5][2] = {
        {CREAM, RED}, {DARK, BLUE}, {CREAM, GREEN}, {RED, CREAM}, {CREAM, BLUE}};
    int meshes[5];
    for (int i = 0; i < 5; i++)
        meshes[i] = horse_mesh(b, surfaces[colors[i][0]], surfaces[colors[i][1]], surfaces[GOLD]);
    gn_shape_at(gn_book_begin(b, 0), 0, .32f, 0);
    gn_shape_cylinder(&b->shape, .024f, 2.6f, 16);
    const int pole = gn_book_mesh(b, "pole", surfaces[GOLD]);
    const int turning = b->parent;
    for (int i = 0; i < HORSES; i++) {
        const float angle = 360.0f * ((float)i + .5f) / HORSES, r = 2.3f;
        struct gn_glb_node arm = {.name = "Arm", .parent = turning};
        gn_glb_turn_y(angle, arm.turn);
        b->parent = gn_glb_node(b->glb, &arm);
        const float at[3] = {0, .86f, r};
        const int node = gn_book_stand(b, "Horse", meshes[i % 5],
                                       (struct gn_spot){at[0], at[1], at[2], 0, 0}, NULL);
        add_gallop(b, node, at, .37f * (float)i);
        gn_book_stand(b, "Pole", pole, (struct gn_spot){.1f, 0, r, 0, 0}, NULL);
    }
    b->parent = turning;
}

/* Scallops of cloth around the canopy. */
static void add_valance(struct gn_shape *shape, float radius, float top) {
    enum { SCALLOPS = 30, BEND = 10 };
    const float width = 2 * radius * tanf((float)M_PI / SCALLOPS);
    float points[BEND + 3][2];
    int count = 0;
    points[count][0] = width / 2, points[count++][1] = 0;
    points[count][0] = -width / 2, points[count++][1] = 0;
    for (int i = 0; i <= BEND; i++, count++) {
        const float angle = (float)M_PI * (1 + (float)i / BEND);
        points[count][0] = width / 2 * cosf(angle), points[count][1] = -.16f + .17f * sinf(angle);
    }
    for (int i = 0; i < SCALLOPS; i++) {
        gn_shape_at(shape, 0, top, 0);
        gn_shape_turn(shape, 'y', 360.0f * (float)i / SCALLOPS);
        gn_shape_move(shape, 0, 0, radius);
        gn_shape_bevel(shape,
                       &(struct gn_outline){.points = (const float(*)[2])points, .count = count},
                       .035f, .010f, 1);
    }
}

static void add_canopy(struct gn_book *b, const int *surfaces) {
    static const float tent[][2] = {
        {3.30f, 3.02f}, {2.2f, 3.36f}, {1.2f, 3.80f}, {.5f, 4.25f}, {.22f, 4.6f}};
    static const float top[][2] = {{.0f, 4.5f},   {.25f, 4.56f}, {.27f, 4.62f}, {.12f, 4.68f},
                                   {.06f, 4.76f}, {.14f, 4.84f}, {.16f, 4.92f}, {.12f, 5.0f},
                                   {.04f, 5.06f}, {.02f, 5.2f},  {0, 5.35f}};
    static const float rim[][2] = {{3.18f, 2.92f}, {3.34f, 2.92f}, {3.38f, 2.95f},
                                   {3.38f, 3.03f}, {3.32f, 3.07f}, {3.18f, 3.05f}};
    struct gn_shape *shape = gn_book_begin(b, 1.4f);
    gn_shape_lathe(shape, tent, GN_COUNT(tent), 120);
    gn_book_put(b, "Canvas", surfaces[STRIPES], NULL);
    shape = gn_book_begin(b, 0);
    gn_book_lathe(shape, top, GN_COUNT(top), 4, 40);
    gn_book_lathe(shape, rim, GN_COUNT(rim), 2, 120);
    gn_book_put(b, "Crown", surfaces[GOLD], NULL);
    add_valance(gn_book_begin(b, 0), 3.33f, 2.93f);
    gn_book_put(b, "Valance", surfaces[RED], NULL);
    shape = gn_book_begin(b, 0);
    for (int i = 0; i < 60; i++) {
        const float angle = 2 * (float)M_PI * (float)i / 60;
        gn_shape_at(shape, 3.41f * cosf(angle), 2.99f, 3.41f * sinf(angle));
        gn_shape_sphere(shape, .034f, 12, 8);
    }
    gn_book_put(b, "Bulbs", surfaces[BULB], "{\"gnomon_cast\":false}");
}

static void add_stage(struct gn_book *b, const int *surfaces) {

    static const float skirt[][2] = {{3.0f, .02f},  {3.06f, .02f},  {3.06f, .05f},
                                     {3.02f, .08f}, {3.02f, .24f},  {3.08f, .27f},
                                     {3.08f, .30f}, {3.05f, .315f}, {2.98f, .315f}};
    static const float core[][2] = {{0, .31f},     {.62f, .31f},  {.62f, .31f},  {.64f, .36f},
                                    {.58f, .42f},  {.56f, 1.02f}, {.56f, 1.02f}, {.64f, 1.06f},
                                    {.64f, 1.12f}, {.0f, 1.16f}};
    static const float drum[][2] = {{0, 2.62f},    {.60f, 2.62f}, {.60f, 2.62f}, {.64f, 2.68f},
                                    {.58f, 2.78f}, {.58f, 3.9f},  {.58f, 3.9f},  {0, 3.9f}};
    struct gn_shape *shape = gn_book_begin(b, .9f);
    gn_shape_at(shape, 0, .30f, 0);
    gn_shape_ring(shape, .05f, 3.02f, 120);
    gn_book_put(b, "Deck", surfaces[WOODEN], NULL);

    shape = gn_book_begin(b, 0);
    gn_book_lathe(shape, skirt, GN_COUNT(skirt), 3, 120);
    gn_book_put(b, "Skirt", surfaces[BLUE], NULL);
    shape = gn_book_begin(b, 0);
    gn_book_lathe(shape, core, GN_COUNT(core), 4, 64);
    gn_book_lathe(shape, drum, GN_COUNT(drum), 4, 64);
    gn_book_put(b, "Core", surfaces[CREAM], NULL);
    shape = gn_book_begin(b, 0);
    for (int i = 0; i < 10; i++) {
        const float angle = 2 * (float)M_PI * (float)i / 10;
        gn_shape_at(shape, .57f * cosf(angle), 1.1f, .57f * sinf(angle));
        gn_shape_cylinder(shape, .016f, 1.55f, 12);
    }
    gn_book_put(b, "Cage", surfaces[GOLD], NULL);
    gn_shape_at(gn_book_begin(b, 0), 0, 2.25f, 0);
    gn_shape_sphere(&b->shape, .17f, 32, 20);
    gn_book_put(b, "Lamp", surfaces[BULB], "{\"gnomon_cast\":false}");
}

/* A wall around the back of the square and clipped trees in front of it: the shadows end there. */
static void add_square(struct gn_book *b, const int *surfaces) {
    static const float wall[][2] = {{15, 0},         {15.6f, 0},     {15.6f, 2.3f},
                                    {15.75f, 2.35f}, {15.75f, 2.6f}, {14.85f, 2.6f},
                                    {14.85f, 2.35f}, {15, 2.3f}};
    static const float trunk[][2] = {{0, 0}, {.10f, 0}, {.07f, .3f}, {.06f, 1.7f}, {0, 1.7f}};
    gn_shape_paving(gn_book_begin(b, 1), 1.5f, 40, 64, 96);
    gn_book_put(b, "Square", surfaces[PAVING], "{\"gnomon_cast\":false}");
    gn_shape_arc(gn_book_begin(b, .3f), wall, GN_COUNT(wall), -10, 190, 120);
    gn_book_put(b, "Wall", surfaces[STUCCO], NULL);
    struct gn_shape *shape = gn_book_begin(b, .9f);
    gn_shape_lathe(shape, trunk, GN_COUNT(trunk), 16);
    const int wood = gn_book_mesh(b, "trunk", surfaces[DARK]);
    shape = gn_book_begin(b, .9f);
    for (int i = 0; i < 900; i++) { /* leaves all around a ball */
        const float y = 1 - 2 * ((float)i + .5f) / 900, angle = 2.399963f * (float)i,
                    r = sqrtf(1 - y * y);
        const float out = .92f + .10f * gn_paint_hash(i, 1, 2);
        gn_shape_at(shape, out * r * cosf(angle), 2.3f + out * y, out * r * sinf(angle));
        gn_shape_turn(shape, 'y', 360 * gn_paint_hash(i, 2, 2));
        gn_shape_turn(shape, 'x', 140 * gn_paint_hash(i, 3, 2) - 70);
        gn_shape_box(shape, .17f, .02f, .26f);
    }
    const int leaves = gn_book_mesh(b, "crown", surfaces[LEAF]);
    for (int i = 0; i < 9; i++) {
        const float angle = (8 + 20.5f * (float)i) * GN_RADIANS;
        const struct gn_spot at = {12.6f * cosf(angle), 0, -12.6f * sinf(angle), 50 * (float)i, 0};
        gn_book_stand(b, "Trunk", wood, at, NULL);
        gn_book_stand(b, "Tree", leaves, at, NULL);
    }
}

void gn_book_make_carousel(struct gn_book *b) {
    int surfaces[SURFACES];
    gn_glb_scene_extras(b->glb,
                        "{\"gnomon_sky\":[0.040,0.052,0.10],\"gnomon_ground\":[0.035,0.030,0.035],"
                        "\"gnomon_background\":[0.030,0.045,0.11]}");
    mix_surfaces(b, surfaces);
    add_square(b, surfaces);
    b->parent = gn_glb_node(b->glb, &(struct gn_glb_node){.name = "Carousel"});
    gn_book_spin(b, "turn", b->parent, 'y', 0, 1, 16);
    add_stage(b, surfaces);
    add_horses(b, surfaces);
    add_canopy(b, surfaces);
    b->parent = 0;
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Lamp in the middle",
                                          .kind = GN_GLB_POINT,
                                          .at = {0, 2.25f, 0},
                                          .aim = {0, 2.25f, -1},
                                          .radius = .08f,
                                          .intensity = 44,
                                          .rgb = {1, .70f, .38f},
                                          .range = 30,
                                          .keys = "\"gnomon_map_px\":1024"});
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Moon",
                                          .at = {-12, 14, 16},
                                          .radius = .01f,
                                          .intensity = .32f,
                                          .rgb = {.55f, .70f, 1}});
    gn_view_add(b->glb, &(struct gn_view){
                            .eye = {1.4f, 3.1f, 11.4f}, .aim = {0, 1.95f, 0}, .yfov_deg = 37});
}
