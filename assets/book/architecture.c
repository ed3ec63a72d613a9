/* A colonnade of forty metres in the afternoon, for cascades: columns, a vault with ribs, a paved
 * floor. It runs along -z; the sun comes in from the right. Metres. */
#include "book.h"

enum { LIME, WALL, PAVING, TIMBER, GRASS, LEAF, CLAY, SURFACES };
enum { BAYS = 14 };
#define BAY  3.0f
#define WIDE 4.4f  /* from the wall to the columns' axes */
#define LOW  3.5f  /* where the arches spring */
#define HIGH 4.86f /* and the vault */
#define FAR  17.0f /* the arcade on the other side of the court */

static void tiles_at(float u, float v, const void *what, float out[4]) {
    enum { TILES = 2 };
    (void)what;
    float stone[4];
    const float x = u * TILES, y = v * TILES;
    const int dark = ((int)floorf(x) + (int)floorf(y)) % 2;
    const float fx = x - floorf(x), fy = y - floorf(y),
                seam = fminf(fminf(fx, 1 - fx), fminf(fy, 1 - fy));
    gn_book_marble(u, v, NULL, stone);
    const float joint = .55f + .45f * gn_paint_ramp(.003f, .010f, seam);
    const float light[3] = {.90f, .85f, .76f}, red[3] = {.62f, .40f, .31f};
    for (int c = 0; c < 3; c++) out[c] = (dark ? red[c] : light[c]) * stone[c] * joint * 1.05f;
}

static void stucco_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float cloud = gn_paint_fractal(u, v, 3, 6, 91),
                stain = gn_paint_fractal(u, v * .5f, 6, 4, 14);
    const float tone = .80f + .16f * cloud - .07f * stain;
    out[0] = tone, out[1] = tone * (.90f + .03f * cloud), out[2] = tone * (.74f + .06f * cloud);
}

static void grass_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float blade = gn_paint_noise(u, v, 128, 4), clump = gn_paint_fractal(u, v, 6, 5, 8);
    const float tone = .35f + .4f * blade * clump + .3f * clump;
    out[0] = tone * .62f, out[1] = tone * .78f, out[2] = tone * .30f;
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    const int size[2] = {1024, 1024}, half[2] = {512, 512};
    const int plaster = gn_book_relief(b, "plaster", 512, .002f, gn_book_plaster, NULL);
    struct gn_glb_material m[SURFACES] = {
        [LIME] = {.name = "limestone",
                  .rgba = {.84f, .76f, .64f},
                  .rough = .9f,
                  .normal_texture = plaster},
        [WALL] = {.name = "stucco",
                  .rgba = {.90f, .82f, .70f},
                  .rough = 1,
                  .normal_texture = plaster},
        [PAVING] = {.name = "paving", .rgba = {.9f, .9f, .9f}, .rough = .35f},
        [TIMBER] = {.name = "door", .rgba = {.34f, .24f, .16f}, .rough = .6f},
        [GRASS] = {.name = "grass", .rgba = {.8f, .8f, .8f}, .rough = 1},
        [LEAF] = {.name = "leaf", .rgba = {.55f, .62f, .42f}, .rough = 1},
        [CLAY] = {.name = "clay",
                  .rgba = {.58f, .27f, .15f},
                  .rough = .9f,
                  .normal_texture = plaster},
    };
    m[LIME].texture = gn_book_picture(b, "grain", half, 1, gn_book_grain, NULL);
    m[WALL].texture = gn_book_picture(b, "stucco", half, 3, stucco_at, NULL);
    m[PAVING].texture = gn_book_picture(b, "tiles", size, 3, tiles_at, NULL);
    m[TIMBER].texture = gn_book_picture(b, "planks", half, 3, gn_book_wood, NULL);
    m[GRASS].texture = m[LEAF].texture = gn_book_picture(b, "lawn", half, 3, grass_at, NULL);
    for (int i = 0; i < SURFACES; i++) surfaces[i] = gn_glb_material(b->glb, &m[i]);
}

/* A fluted shaft: u around, v up, with entasis. */
static void shaft_at(float u, float v, const void *what, float out[3]) {
    enum { FLUTES = 20 };
    (void)what;
    const float turn = u * FLUTES, in = turn - floorf(turn) - .5f, end = fminf(v, 1 - v);
    const float groove =
        .030f * sqrtf(fmaxf(0, 1 - 4.6f * in * in)) * gn_paint_ramp(.0f, .04f, end);
    const float r = .27f - .045f * v * v - groove, angle = 2 * (float)M_PI * u;
    out[0] = r * cosf(angle), out[1] = .46f + v * 2.52f, out[2] = -r * sinf(angle);
}

static int column_mesh(struct gn_book *b, const int *surfaces) {
    static const float base[][2] = {
        {0, .14f},     {.36f, .14f},  {.385f, .165f}, {.392f, .195f}, {.385f, .225f}, {.36f, .25f},
        {.33f, .26f},  {.31f, .29f},  {.31f, .32f},   {.325f, .345f}, {.345f, .36f},  {.35f, .385f},
        {.342f, .41f}, {.32f, .425f}, {.285f, .43f},  {.27f, .46f},   {.26f, .47f}};
    static const float head[][2] = {{.222f, 2.97f}, {.24f, 2.98f},  {.25f, 3.0f},  {.24f, 3.02f},
                                    {.225f, 3.03f}, {.225f, 3.10f}, {.25f, 3.13f}, {.31f, 3.2f},
                                    {.34f, 3.26f},  {.345f, 3.29f}, {0, 3.29f}};
    struct gn_shape *shape = gn_book_begin(b, .9f);
    gn_shape_surface(
        shape, &(struct gn_surface){.at = shaft_at, .across = 160, .up = 12, .uv = {1.6f, 2.5f}});
    gn_shape_lathe(shape, base, GN_COUNT(base), 40);
    gn_shape_lathe(shape, head, GN_COUNT(head), 40);
    gn_shape_at(shape, 0, .07f, 0);
    gn_shape_soft_box(shape, (float[3]){.84f, .14f, .84f}, .012f, 2);
    gn_shape_at(shape, 0, 3.39f, 0);
    gn_shape_soft_box(shape, (float[3]){.78f, .2f, .78f}, .02f, 2);
    return gn_book_mesh(b, "column", surfaces[LIME]);
}

/* One bay of the outer wall: an arch between two columns, 5.9 m high. */
static int arch_mesh(struct gn_book *b, const int *surfaces) {
    enum { BEND = 32 };
    float points[BEND + 5][2];
    int count = 0;
    const float half = BAY / 2, radius = half - .34f;
    const float corners[][2] = {{half, 0}, {half, 3.75f}, {-half, 3.75f}, {-half, 0}};
    for (int i = 0; i < 4; i++) memcpy(points[count++], corners[i], sizeof *points);
    for (int i = 0; i <= BEND; i++, count++) {
        const float angle = (float)M_PI * (1 - (float)i / BEND);
        points[count][0] = radius * cosf(angle), points[count][1] = radius * sinf(angle);
    }
    struct gn_shape *shape = gn_book_begin(b, .5f);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_bevel(shape, &(struct gn_outline){.points = (const float(*)[2])points, .count = count},
                   .56f, .02f, 2);
    /* a moulding along the arch, inside and outside */
    float path[BEND + 1][3];
    for (int side = -1; side <= 1; side += 2) {
        for (int i = 0; i <= BEND; i++) {
            const float angle = (float)M_PI * (float)i / BEND;
            path[i][0] = (radius + .11f) * cosf(angle), path[i][1] = (radius + .11f) * sinf(angle);
            path[i][2] = .28f * (float)side;
        }
        gn_shape_tube(shape, (const float(*)[3])path, BEND + 1, .055f, 10);
    }
    return gn_book_mesh(b, "arch", surfaces[LIME]);
}

/* The barrel vault of a bay: seen from below. */
static void vault_at(float u, float v, const void *what, float out[3]) {
    (void)what;
    const float angle = (float)M_PI * u, r = WIDE / 2 - .02f;
    out[0] = -r * cosf(angle), out[1] = r * .80f * sinf(angle), out[2] = (v - .5f) * BAY;
}

static int vault_mesh(struct gn_book *b, const int *surfaces) {
    struct gn_shape *shape = gn_book_begin(b, .35f);
    gn_shape_surface(shape,
                     &(struct gn_surface){.at = vault_at, .across = 32, .up = 1, .uv = {6, BAY}});
    return gn_book_mesh(b, "vault", surfaces[WALL]);
}

static int rib_mesh(struct gn_book *b, const int *surfaces) {
    enum { BEND = 32 };
    float outer[BEND + 1][2], points[2 * (BEND + 1)][2];
    for (int i = 0; i <= BEND; i++) {
        const float angle = (float)M_PI * (float)i / BEND, c = cosf(angle), s = sinf(angle),
                    r = WIDE / 2;
        outer[i][0] = r * c, outer[i][1] = r * .80f * s + .05f;
        points[i][0] = outer[i][0], points[i][1] = outer[i][1];
        points[2 * BEND + 1 - i][0] = (r - .26f) * c,
                              points[2 * BEND + 1 - i][1] = (r * .80f - .26f) * s;
    }
    struct gn_shape *shape = gn_book_begin(b, .6f);
    gn_shape_bevel(shape,
                   &(struct gn_outline){.points = (const float(*)[2])points, .count = 2 * BEND + 2},
                   .42f, .03f, 2);
    return gn_book_mesh(b, "rib", surfaces[LIME]);
}

/* Pilaster, wall and, in every second bay, a door under a round head. */
static void add_wall(struct gn_book *b, const int *surfaces) {
    const float end = BAY * (BAYS + 1);
    struct gn_shape *shape = gn_book_begin(b, .35f);
    gn_shape_at(shape, -.2f, 0, -end / 2 + BAY);
    gn_shape_block(shape, .4f, 7.2f, end + 2 * BAY);
    gn_shape_at(shape, WIDE / 2, 0, -end - .6f);
    gn_shape_block(shape, WIDE + 1, 7.2f, .4f);
    gn_book_put(b, "Wall", surfaces[WALL], NULL);

    shape = gn_book_begin(b, .9f);
    gn_shape_at(shape, .08f, 2.43f, 0);
    gn_shape_soft_box(shape, (float[3]){.34f, 4.86f, .52f}, .015f, 2);
    gn_shape_at(shape, WIDE - .34f, 4.70f, 0);
    gn_shape_soft_box(shape, (float[3]){.24f, .32f, .54f}, .04f, 2);
    gn_shape_at(shape, .1f, .09f, 0);
    gn_shape_soft_box(shape, (float[3]){.46f, .18f, .64f}, .02f, 2);
    gn_shape_at(shape, .1f, 4.76f, 0);
    gn_shape_soft_box(shape, (float[3]){.50f, .2f, .68f}, .03f, 2);
    const int pilaster = gn_book_mesh(b, "pilaster", surfaces[LIME]);
    for (int i = 0; i <= BAYS; i++)
        gn_book_stand(b, "Pilaster", pilaster, (struct gn_spot){0, 0, -BAY * (float)i, 0, 0}, NULL);

    shape = gn_book_begin(b, .5f);
    gn_shape_at(shape, .03f, 1.25f, 0);
    gn_shape_soft_box(shape, (float[3]){.1f, 2.5f, 1.15f}, .01f, 2);
    for (int i = 0; i < 4; i++) {
        gn_shape_at(shape, .085f, i / 2 ? 1.75f : .72f, i % 2 ? .27f : -.27f);
        gn_shape_soft_box(shape, (float[3]){.05f, i / 2 ? 1.1f : .7f, .38f}, .02f, 2);
    }
    const int door = gn_book_mesh(b, "door", surfaces[TIMBER]);
    shape = gn_book_begin(b, .9f);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(shape, .07f, 1.3f, .69f * (float)side);
        gn_shape_soft_box(shape, (float[3]){.2f, 2.6f, .2f}, .015f, 2);
    }
    gn_shape_at(shape, .08f, 2.7f, 0);
    gn_shape_soft_box(shape, (float[3]){.24f, .22f, 1.72f}, .02f, 2);
    const int frame = gn_book_mesh(b, "frame", surfaces[LIME]);
    for (int i = 1; i < BAYS; i += 3) {
        const struct gn_spot at = {0, 0, -BAY * ((float)i + .5f), 0, 0};
        gn_book_stand(b, "Door", door, at, NULL);
        gn_book_stand(b, "Frame", frame, at, NULL);
    }
}

static void add_pots(struct gn_book *b, const int *surfaces) {
    static const float pot[][2] = {{0, 0},        {.17f, 0},    {.17f, 0},    {.19f, .02f},
                                   {.27f, .25f},  {.30f, .42f}, {.30f, .42f}, {.33f, .43f},
                                   {.335f, .48f}, {.32f, .5f},  {.29f, .5f},  {.29f, .5f},
                                   {.27f, .44f},  {0, .44f}};
    struct gn_shape *shape = gn_book_begin(b, 1);
    gn_book_lathe(shape, pot, GN_COUNT(pot), 4, 40);
    const int clay = gn_book_mesh(b, "pot", surfaces[CLAY]);
    shape = gn_book_begin(b, 2);
    for (int i = 0; i < 420; i++) { /* leaves all around a ball */
        const float t = ((float)i + .5f) / 420, y = 1 - 2 * t, angle = 2.399963f * (float)i;
        const float r = sqrtf(1 - y * y), out = .40f + .06f * gn_paint_hash(i, 1, 2);
        gn_shape_at(shape, out * r * cosf(angle), .92f + out * y, out * r * sinf(angle));
        gn_shape_turn(shape, 'y', 360 * gn_paint_hash(i, 2, 2));
        gn_shape_turn(shape, 'x', 140 * gn_paint_hash(i, 3, 2) - 70);
        gn_shape_box(shape, .11f, .012f, .17f);
    }
    const int leaves = gn_book_mesh(b, "laurel", surfaces[LEAF]);
    for (int i = 1; i < 8; i += 2) {
        const struct gn_spot at = {WIDE - .1f, 0, -BAY * ((float)i + .5f), 40 * (float)i, 0};
        gn_book_stand(b, "Pot", clay, at, NULL);
        gn_book_stand(b, "Laurel", leaves, at, NULL);
    }
}

/* The other side of the court, its hedge, and cypresses behind its roof. */
static void add_court(struct gn_book *b, const int *surfaces, int column, int arch) {
    static const float cypress[][2] = {{0, 0},    {.3f, .2f},  {.85f, 1.2f}, {.95f, 2.6f},
                                       {.75f, 5}, {.4f, 7.6f}, {0, 9.4f}};
    const float middle = -BAY * BAYS / 2, length = BAY * (BAYS + 6);
    for (int i = -1; i <= BAYS; i++) {
        const float z = -BAY * (float)i;
        gn_book_stand(b, "Column", column, (struct gn_spot){FAR, 0, z, 0, 0}, NULL);
        gn_book_stand(b, "Arch", arch, (struct gn_spot){FAR, LOW, z - BAY / 2, 0, 0}, NULL);
    }
    struct gn_shape *shape = gn_book_begin(b, .35f);
    gn_shape_at(shape, FAR + 4.2f, 0, middle);
    gn_shape_block(shape, .4f, 7.2f, length);
    gn_shape_at(shape, (WIDE + FAR) / 2, 0, middle - length / 2 + BAY);
    gn_shape_block(shape, FAR - WIDE + 9, 7.2f, .4f);
    gn_book_put(b, "Court", surfaces[WALL], NULL);
    shape = gn_book_begin(b, .5f);
    gn_shape_at(shape, FAR, .05f, middle);
    gn_shape_soft_box(shape, (float[3]){1.3f, .12f, length}, .02f, 2);
    gn_shape_at(shape, FAR, 7.28f, middle);
    gn_shape_soft_box(shape, (float[3]){1.0f, .22f, length}, .05f, 2);
    gn_book_put(b, "Cornice", surfaces[LIME], NULL);
    shape = gn_book_begin(b, .5f);
    gn_shape_at(shape, FAR + 2.0f, 7.9f, middle);
    gn_shape_turn(shape, 'z', 16);
    gn_shape_box(shape, 5.6f, .2f, length);
    gn_book_put(b, "Roof", surfaces[CLAY], NULL);
    shape = gn_book_begin(b, .6f);
    for (int i = 0; i < 2; i++) {
        gn_shape_at(shape, i ? FAR - 1.6f : WIDE + 3.2f, .36f, middle);
        gn_shape_soft_box(shape, (float[3]){.7f, .9f, length - 2}, .10f, 2);
    }
    for (int i = 0; i < 9; i++) {
        gn_shape_at(shape, FAR + 8 + 2 * gn_paint_hash(i, 1, 3), 0, 2 - 5.6f * (float)i);
        gn_book_lathe(shape, cypress, GN_COUNT(cypress), 4, 20);
    }
    gn_book_put(b, "Hedges", surfaces[LEAF], NULL);
}

void gn_book_make_architecture(struct gn_book *b) {
    int surfaces[SURFACES];
    gn_glb_scene_extras(b->glb,
                        "{\"gnomon_sky\":[0.24,0.28,0.36],\"gnomon_ground\":[0.23,0.18,0.12],"
                        "\"gnomon_background\":[0.42,0.62,0.92]}");
    mix_surfaces(b, surfaces);
    const int column = column_mesh(b, surfaces), arch = arch_mesh(b, surfaces),
              vault = vault_mesh(b, surfaces), rib = rib_mesh(b, surfaces);
    for (int i = -1; i <= BAYS; i++) {
        const float z = -BAY * (float)i, mid = z - BAY / 2;
        gn_book_stand(b, "Column", column, (struct gn_spot){WIDE, 0, z, 0, 0}, NULL);
        gn_book_stand(b, "Rib", rib, (struct gn_spot){WIDE / 2, HIGH, z, 0, 0}, NULL);
        gn_book_stand(b, "Arch", arch, (struct gn_spot){WIDE, LOW, mid, 0, 0}, NULL);
        gn_book_stand(b, "Vault", vault, (struct gn_spot){WIDE / 2, HIGH, mid, 0, 0}, NULL);
    }
    add_wall(b, surfaces);
    add_court(b, surfaces, column, arch);
    add_pots(b, surfaces);
    const float end = BAY * (BAYS + 2);
    gn_shape_at(gn_book_begin(b, 1 / 1.6f), WIDE / 2 + .4f, 0, -end / 2 + 2 * BAY);
    gn_shape_plane(&b->shape, WIDE + 1.6f, end + 3 * BAY);
    gn_book_put(b, "Paving", surfaces[PAVING], "{\"gnomon_cast\":false}");
    gn_shape_at(gn_book_begin(b, .3f), WIDE + 31.2f, -.12f, -20);
    gn_shape_plane(&b->shape, 60, 140);
    gn_book_put(b, "Lawn", surfaces[GRASS], "{\"gnomon_cast\":false}");
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Sun",
                                          .at = {26, 17.5f, 9},
                                          .aim = {0, 0, 0},
                                          .radius = .0075f,
                                          .intensity = 3.3f,
                                          .rgb = {1, .88f, .68f},
                                          .keys = "\"gnomon_map_px\":2048"});
    gn_view_add(b->glb, &(struct gn_view){.eye = {1.9f, 1.62f, 2.2f},
                                          .aim = {3.0f, 2.25f, -14},
                                          .yfov_deg = 50,
                                          .zfar = 160});
}
