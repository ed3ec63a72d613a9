/* A table under a vine, in the sun: leaves are pictures with holes (alpha MASK), and so are their
 * shadows. Metres. */
#include "book.h"

enum { WALL, TILES, BEAM, TABLE, LEAVES, BLUE, GLAZE, LEMON, GRAPE, CLAY, SURFACES };

static void tiles_at(float u, float v, const void *what, float out[4]) {
    enum { COUNT = 6 };
    (void)what;
    const float x = u * COUNT, y = v * COUNT, fx = x - floorf(x), fy = y - floorf(y);
    const float uneven = .02f * (gn_paint_noise(u, v, 48, 3) - .5f);
    const float seam = fminf(fminf(fx, 1 - fx), fminf(fy, 1 - fy)) + uneven;
    const float tone = (.72f + .28f * gn_paint_hash((int)x, (int)y, 5)) *
                       (.84f + .2f * gn_paint_fractal(u, v, 8, 5, 6));
    const float clay = gn_paint_ramp(.025f, .05f, seam);
    const float rgb[3] = {.80f, .50f, .36f}, joint[3] = {.60f, .55f, .48f};
    for (int c = 0; c < 3; c++) out[c] = joint[c] + clay * (rgb[c] * tone - joint[c]);
}

static void tiles_height(float u, float v, const void *what, float out[4]) {
    enum { COUNT = 6 };
    (void)what;
    const float x = u * COUNT, y = v * COUNT, fx = x - floorf(x), fy = y - floorf(y);
    const float seam = fminf(fminf(fx, 1 - fx), fminf(fy, 1 - fy));
    out[0] = gn_paint_ramp(.015f, .07f, seam) + .3f * gn_paint_fractal(u, v, 12, 4, 9);
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    const int size[2] = {1024, 1024}, half[2] = {512, 512};
    struct gn_image leaves;
    gn_paint_branch(&leaves, 512, 21);
    const int branch = gn_glb_texture(b->glb, "branch", &leaves, GN_GLB_CLAMP);
    gn_image_finish(&leaves);
    const int wood = gn_book_picture(b, "wood", half, 3, gn_book_wood, NULL);
    const int plaster = gn_book_relief(b, "plaster", 512, .0035f, gn_book_plaster, NULL);
    const struct gn_glb_material m[SURFACES] = {
        [WALL] = {.name = "whitewash",
                  .rgba = {.90f, .86f, .78f},
                  .rough = 1,
                  .normal_texture = plaster},
        [TILES] = {.name = "tiles",
                   .rgba = {.95f, .95f, .95f},
                   .rough = .75f,
                   .texture = gn_book_picture(b, "tiles", size, 3, tiles_at, NULL),
                   .normal_texture =
                       gn_book_relief(b, "tiles relief", 512, .006f, tiles_height, NULL)},
        [BEAM] = {.name = "beams", .rgba = {.55f, .46f, .40f}, .rough = .9f, .texture = wood},
        [TABLE] = {.name = "table", .rgba = {.82f, .76f, .70f}, .rough = .55f, .texture = wood},
        [LEAVES] = {.name = "leaves",
                    .rgba = {.46f, .58f, .34f},
                    .rough = .7f,
                    .texture = branch,
                    .alpha = GN_GLB_MASK,
                    .double_sided = true},
        [BLUE] = {.name = "blue paint", .rgba = {.07f, .22f, .42f}, .rough = .5f},
        [GLAZE] = {.name = "glaze", .rgba = {.86f, .87f, .86f}, .rough = .2f},
        [LEMON] = {.name = "lemon",
                   .rgba = {.94f, .68f, .06f},
                   .rough = .45f,
                   .normal_texture = plaster},
        [GRAPE] = {.name = "grape", .rgba = {.12f, .04f, .14f}, .rough = .3f},
        [CLAY] = {.name = "clay",
                  .rgba = {.62f, .30f, .17f},
                  .rough = .9f,
                  .normal_texture = plaster},
    };
    for (int i = 0; i < SURFACES; i++) surfaces[i] = gn_glb_material(b->glb, &m[i]);
}

/* A spray of leaves; `droop` is how far it hangs, in degrees. */
static void add_spray(struct gn_shape *shape, int i, const float at[3], float droop, float size) {
    gn_shape_at(shape, at[0], at[1], at[2]);
    gn_shape_turn(shape, 'y', 360 * gn_paint_hash(i, 4, 7));
    gn_shape_turn(shape, 'x', droop);
    gn_shape_turn(shape, 'y', 60 * gn_paint_hash(i, 5, 7) - 30);
    gn_shape_card(shape, size, size);
}

static void add_vine(struct gn_book *b, const int *surfaces) {
    struct gn_shape *shape = gn_book_begin(b, 1);
    for (int i = 0; i < 210; i++) { /* the roof */
        const float at[3] = {-2.7f + 5.4f * gn_paint_hash(i, 1, 7),
                             2.52f + .16f * gn_paint_hash(i, 2, 7),
                             -1.75f + 3.3f * gn_paint_hash(i, 3, 7)};
        add_spray(shape, i, at, 74 + 44 * gn_paint_hash(i, 6, 7),
                  .50f + .22f * gn_paint_hash(i, 8, 7));
    }
    for (int i = 0; i < 90; i++) { /* what hangs over the edges */
        const float t = gn_paint_hash(i, 1, 9);
        const float at[3] = {-2.7f + 5.4f * t, 2.44f - .22f * gn_paint_hash(i, 2, 9),
                             1.45f + .25f * gn_paint_hash(i, 3, 9)};
        add_spray(shape, i + 500, at, 120 + 50 * gn_paint_hash(i, 6, 9),
                  .40f + .18f * gn_paint_hash(i, 8, 9));
    }
    for (int i = 0; i < 80; i++) { /* and climbs up a post */
        const float y = 2.4f * powf(gn_paint_hash(i, 1, 4), .7f), out = .16f + .12f * (y / 2.4f);
        const float angle = 6.28f * gn_paint_hash(i, 2, 4);
        const float at[3] = {2.3f + out * .4f * cosf(angle), y, 1.3f + out * .4f * sinf(angle)};
        add_spray(shape, i + 900, at, 50 + 60 * gn_paint_hash(i, 3, 4),
                  .34f + .12f * gn_paint_hash(i, 5, 4));
    }
    gn_book_put(b, "Vine", surfaces[LEAVES], NULL);

    static const float stem[][3] = {
        {2.42f, 0, 1.42f},    {2.20f, .5f, 1.36f}, {2.40f, 1, 1.20f},
        {2.22f, 1.6f, 1.38f}, {2.36f, 2.2f, 1.3f}, {1.9f, 2.52f, .9f},
        {.9f, 2.56f, .3f},    {-.4f, 2.55f, .1f},  {-1.8f, 2.56f, -.5f}};
    shape = gn_book_begin(b, 3);
    gn_shape_vine(shape, stem, GN_COUNT(stem), .045f, .018f, 12);
    gn_book_put(b, "Stem", surfaces[BEAM], NULL);

    shape = gn_book_begin(b, 0);
    static const float bunches[][3] = {
        {-.95f, 2.36f, .9f}, {.55f, 2.34f, 1.1f}, {1.5f, 2.38f, .7f}, {-1.75f, 2.4f, .4f}};
    for (int k = 0; k < GN_COUNT(bunches); k++)
        for (int i = 0; i < 34; i++) {
            const float t = (float)i / 34, r = .085f * (1 - t) * sqrtf(gn_paint_hash(i, k, 5)),
                        a = 2.4f * (float)i;
            gn_shape_at(shape, bunches[k][0] + r * cosf(a), bunches[k][1] - .24f * t,
                        bunches[k][2] + r * sinf(a));
            gn_shape_sphere(shape, .021f, 12, 8);
        }
    gn_book_put(b, "Grapes", surfaces[GRAPE], NULL);
}

static void add_pergola(struct gn_book *b, const int *surfaces) {
    struct gn_shape *shape = gn_book_begin(b, .8f);
    for (int i = 0; i < 2; i++) {
        gn_shape_at(shape, i ? 2.3f : -2.3f, 1.2f, 1.3f);
        gn_shape_soft_box(shape, (float[3]){.13f, 2.4f, .13f}, .012f, 2);
    }
    gn_shape_at(shape, 0, 2.33f, 1.3f);
    gn_shape_soft_box(shape, (float[3]){5.4f, .15f, .11f}, .012f, 2);
    for (int i = 0; i < 8; i++) {
        gn_shape_at(shape, -2.45f + .7f * (float)i, 2.455f, -.1f);
        gn_shape_soft_box(shape, (float[3]){.075f, .10f, 3.5f}, .01f, 2);
    }
    gn_book_put(b, "Pergola", surfaces[BEAM], NULL);
}

static void add_house(struct gn_book *b, const int *surfaces) {
    gn_shape_at(gn_book_begin(b, .45f), 0, 1.8f, -2.1f);
    gn_shape_box(&b->shape, 14, 3.6f, .5f);
    gn_book_put(b, "Wall", surfaces[WALL], NULL);
    /* a window with shutters; the dark pane is inside of its frame */
    struct gn_shape *shape = gn_book_begin(b, 0);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(shape, -1.35f + .74f * (float)side, 1.45f, -1.82f);
        gn_shape_soft_box(shape, (float[3]){.48f, 1.24f, .045f}, .008f, 2);
        for (int i = 0; i < 14; i++) {
            gn_shape_at(shape, -1.35f + .74f * (float)side, .92f + .082f * (float)i, -1.79f);
            gn_shape_turn(shape, 'x', 28);
            gn_shape_soft_box(shape, (float[3]){.36f, .060f, .014f}, .005f, 1);
        }
    }
    for (int i = 0; i < 5; i++) {
        const bool upright = i < 3;
        gn_shape_at(shape, -1.35f + (upright ? .47f * (float)(i - 1) : 0),
                    upright  ? 1.45f
                    : i == 3 ? .86f
                             : 2.04f,
                    -1.82f);
        gn_shape_soft_box(shape,
                          upright ? (float[3]){.07f, 1.22f, .06f} : (float[3]){1.0f, .07f, .06f},
                          .008f, 2);
    }
    gn_book_put(b, "Shutters", surfaces[BLUE], NULL);
    gn_shape_at(gn_book_begin(b, 0), -1.35f, 1.45f, -1.845f);
    gn_shape_box(&b->shape, .94f, 1.2f, .02f);
    gn_book_put(b, "Pane",
                gn_glb_material(b->glb, &(struct gn_glb_material){.name = "pane",
                                                                  .rgba = {.03f, .045f, .06f},
                                                                  .rough = .12f}),
                NULL);
    gn_shape_at(gn_book_begin(b, .5f), 0, 0, 1);
    gn_shape_plane(&b->shape, 14, 9);
    gn_book_put(b, "Terrace", surfaces[TILES], "{\"gnomon_cast\":false}");
    static const float pot[][2] = {{0, 0},       {.13f, 0},     {.13f, 0},    {.15f, .02f},
                                   {.20f, .2f},  {.21f, .31f},  {.21f, .31f}, {.235f, .32f},
                                   {.24f, .36f}, {.22f, .375f}, {.20f, .37f}, {.2f, .37f},
                                   {.19f, .33f}, {0, .33f}};
    shape = gn_book_begin(b, 1);
    gn_shape_at(shape, 1.62f, 0, -1.45f);
    gn_book_lathe(shape, pot, GN_COUNT(pot), 5, 48);
    gn_shape_at(shape, 2.25f, 0, -1.35f);
    gn_book_lathe(shape, pot, GN_COUNT(pot), 5, 48);
    gn_book_put(b, "Pots", surfaces[CLAY], NULL);
    shape = gn_book_begin(b, 1);
    for (int i = 0; i < 64; i++) {
        const float at[3] = {(i % 2 ? 1.62f : 2.25f) + .14f * (gn_paint_hash(i, 1, 3) - .5f), .33f,
                             (i % 2 ? -1.45f : -1.35f) + .14f * (gn_paint_hash(i, 2, 3) - .5f)};
        add_spray(shape, i + 1300, at, -8 + 62 * gn_paint_hash(i, 3, 3),
                  .42f + .2f * gn_paint_hash(i, 4, 3));
    }
    gn_book_put(b, "Bush", surfaces[LEAVES], NULL);
}

static void add_table(struct gn_book *b, const int *surfaces) {
    static const float foot[][2] = {{0, 0},        {.055f, 0},   {.055f, 0},    {.06f, .03f},
                                    {.035f, .07f}, {.04f, .3f},  {.055f, .52f}, {.04f, .58f},
                                    {.05f, .62f},  {.05f, .70f}, {.05f, .7f},   {0, .7f}};
    static const float jug[][2] = {{0, 0},         {.055f, 0},     {.055f, 0},     {.07f, .02f},
                                   {.092f, .08f},  {.085f, .14f},  {.052f, .2f},   {.046f, .235f},
                                   {.060f, .275f}, {.060f, .275f}, {.056f, .276f}, {.042f, .24f},
                                   {0, .2f}};
    static const float ear[][3] = {
        {.05f, .25f, 0}, {.10f, .255f, 0}, {.125f, .2f, 0}, {.115f, .14f, 0}, {.085f, .11f, 0}};
    static const float bowl[][2] = {{0, 0},         {.07f, 0},      {.07f, 0},      {.075f, .012f},
                                    {.07f, .02f},   {.13f, .06f},   {.165f, .105f}, {.165f, .105f},
                                    {.158f, .107f}, {.120f, .065f}, {0, .035f}};
    static const float lemons[][4] = {{.0f, .095f, .05f, 20},
                                      {-.075f, .095f, -.02f, 80},
                                      {.07f, .095f, -.04f, 140},
                                      {.0f, .15f, .0f, 60},
                                      {.30f, .038f, .16f, 10}};
    struct gn_shape *shape = gn_book_begin(b, 1.1f);
    gn_shape_at(shape, 0, .745f, 0);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_soft_box(shape, (float[3]){.95f, .05f, 1.75f}, .014f, 3);
    gn_shape_at(shape, 0, .68f, 0);
    gn_shape_soft_box(shape, (float[3]){1.5f, .09f, .7f}, .01f, 2);
    for (int i = 0; i < 4; i++) {
        gn_shape_at(shape, i % 2 ? .72f : -.72f, 0, i / 2 ? .33f : -.33f);
        gn_book_lathe(shape, foot, GN_COUNT(foot), 5, 32);
    }
    gn_book_put(b, "Table", surfaces[TABLE], NULL);
    shape = gn_book_begin(b, 1);
    gn_shape_at(shape, -.38f, .77f, .1f);
    gn_shape_turn(shape, 'y', 150);
    gn_book_lathe(shape, jug, GN_COUNT(jug), 6, 56);
    gn_shape_vine(shape, ear, GN_COUNT(ear), .012f, .009f, 16);
    gn_shape_at(shape, .12f, .77f, .05f);
    gn_book_lathe(shape, bowl, GN_COUNT(bowl), 6, 64);
    gn_book_put(b, "Jug and bowl", surfaces[GLAZE], NULL);
    static const float lemon[][2] = {{0, -.052f},    {.008f, -.048f}, {.028f, -.035f}, {.037f, 0},
                                     {.028f, .035f}, {.008f, .048f},  {0, .054f}};
    shape = gn_book_begin(b, 6);
    for (int i = 0; i < GN_COUNT(lemons); i++) {
        gn_shape_at(shape, .12f + lemons[i][0], .77f + lemons[i][1], .05f + lemons[i][2]);
        gn_shape_turn(shape, 'y', lemons[i][3]);
        gn_shape_turn(shape, 'z', 86);
        gn_book_lathe(shape, lemon, GN_COUNT(lemon), 5, 32);
    }
    gn_book_put(b, "Lemons", surfaces[LEMON], NULL);
    gn_book_chair(gn_book_begin(b, 2));
    const int chair = gn_book_mesh(b, "chair", surfaces[BLUE]);
    gn_book_stand(b, "Chair", chair, (struct gn_spot){-.45f, 0, -.72f, 8, 0}, NULL);
    gn_book_stand(b, "Chair", chair, (struct gn_spot){.55f, 0, -.75f, -14, 0}, NULL);
    gn_book_stand(b, "Chair", chair, (struct gn_spot){1.35f, 0, .25f, -104, 0}, NULL);
}

void gn_book_make_foliage(struct gn_book *b) {
    int surfaces[SURFACES];
    gn_glb_scene_extras(b->glb,
                        "{\"gnomon_sky\":[0.20,0.23,0.28],\"gnomon_ground\":[0.17,0.13,0.10],"
                        "\"gnomon_background\":[0.40,0.60,0.92]}");
    mix_surfaces(b, surfaces);
    add_house(b, surfaces);
    add_pergola(b, surfaces);
    add_vine(b, surfaces);
    add_table(b, surfaces);
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Sun",
                                          .at = {-9, 15, 10},
                                          .radius = .008f,
                                          .intensity = 3.6f,
                                          .rgb = {1, .92f, .78f},
                                          .keys = "\"gnomon_map_px\":2048"});
    gn_view_add(b->glb, &(struct gn_view){.eye = {-.75f, 1.55f, 4.7f},
                                          .aim = {-.02f, 1.12f, -.4f},
                                          .yfov_deg = 38});
}
