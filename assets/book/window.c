/* A dark chapel with a rose window: a spot outside projects its glass, leads and tracery onto the
 * floor and what stands there (gnomon_slide). The window is in the wall on the left, at x = -LEFT.
 * Metres. */
#include "book.h"

enum { STONE, FLAGS, OAK, IRON, CLOTH, WAX, SURFACES };
#define LEFT   3.0f
#define CENTRE 2.75f /* of the rose, above the floor */
#define RADIUS 1.25f

/* ---- the glass ---- */

/* Colours of a piece of glass, by the ring and the sector that it is in. */
static void glass_of(float ring, int sector, unsigned seed, float rgb[4]) {
    static const float tints[][3] = {{.05f, .12f, .85f}, {.92f, .06f, .05f}, {1, .70f, .08f},
                                     {.04f, .50f, .72f}, {.10f, .58f, .16f}, {.55f, .08f, .62f}};
    static const int order[4][4] = {{2, 1, 2, 1}, {0, 3, 0, 5}, {1, 0, 4, 0}, {0, 1, 3, 2}};
    const float *tint = tints[order[(int)ring % 4][sector % 4]];
    const float tone = .72f + .28f * gn_paint_hash(sector, (int)ring, seed);
    for (int c = 0; c < 3; c++) rgb[c] = tint[c] * tone;
}

/* A rose of twelve petals: x and y from -1 to 1. Returns 0 in stone and lead, 1 in glass. */
static float rose_at(float x, float y, float rgb[4]) {
    enum { PETALS = 12 };
    const float r = hypotf(x, y), turn = atan2f(y, x) / (2 * (float)M_PI) * PETALS + .5f;
    const int petal = ((int)floorf(turn) + PETALS) % PETALS;
    const float across = (turn - floorf(turn) - .5f) * 2 * (float)M_PI / PETALS * r;
    float stone = 1, ring;
    /* rings of stone */
    const float rims[] = {.17f, .225f, .66f, .975f};
    for (int i = 0; i < GN_COUNT(rims); i++)
        if (i != 1) stone = fminf(stone, fabsf(r - rims[i]) - (i == 3 ? .032f : .021f));
    if (r > rims[3]) stone = -1;
    if (r < .17f) {
        ring = 0;
    } else if (r < .66f) {
        /* petals: spokes, round at their outer ends */
        const float half = (float)M_PI / PETALS * r - .014f;
        stone = fminf(stone, half - fabsf(across));
        const float head = .5f, width = (float)M_PI / PETALS * head - .014f;
        if (r > head) stone = fminf(stone, width * 1.25f - hypotf(across, r - head));
        ring = 1 + floorf((r - .17f) / .125f);
    } else {
        /* a circle of glass over each petal's edge */
        const float at = (turn - floorf(turn + .5f)) * 2 * (float)M_PI / PETALS * r;
        stone = fminf(stone, .132f - hypotf(at, r - .818f));
        ring = hypotf(at, r - .818f) < .062f ? 7 : 6;
    }
    /* leads between the pieces of a petal */
    float lead = 1;
    if (r > .17f && r < .66f) {
        const float step = (r - .17f) / .125f;
        lead = fminf(fabsf(step - roundf(step)) * .125f, fabsf(across));
    } else if (r >= .66f) {
        const float at = (turn - floorf(turn + .5f)) * 2 * (float)M_PI / PETALS * r;
        lead = fabsf(hypotf(at, r - .818f) - .062f);
    } else {
        lead = fminf(fabsf(x), fabsf(y)) + (r < .04f ? 1 : 0);
    }
    glass_of(ring, petal * 2 + (across > 0) + (int)ring, 5, rgb);
    const float streak = .82f + .18f * gn_paint_noise(x * .5f + .5f, y * .5f + .5f, 48, 3);
    const float light =
        gn_paint_ramp(0, .014f, stone) * (.06f + .94f * gn_paint_ramp(.004f, .012f, lead));
    for (int c = 0; c < 3; c++) rgb[c] *= light * streak;
    return gn_paint_ramp(-.002f, .008f, stone);
}

static void slide_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    rose_at(2 * u - 1, 1 - 2 * v, out);
}

/* The stone of the tracery, with holes where glass is. */
static void tracery_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    float rgb[4];
    const float glass = rose_at(2 * u - 1, 1 - 2 * v, rgb);
    const float tone = .50f + .2f * gn_paint_fractal(u, v, 12, 3, 4);
    out[0] = tone, out[1] = tone * .95f, out[2] = tone * .86f;
    out[3] = 1 - glass;
}

/* ---- the room ---- */

static void flags_at(float u, float v, const void *what, float out[4]) {
    enum { STONES = 4 };
    (void)what;
    const float y = v * STONES, row = floorf(y), x = u * STONES + .5f * fmodf(row, 2);
    const int column = (int)floorf(x) % STONES;
    const float fx = x - floorf(x), fy = y - row;
    const float seam =
        fminf(fminf(fx, 1 - fx), fminf(fy, 1 - fy)) + .012f * (gn_paint_noise(u, v, 32, 2) - .5f);
    const float tone = (.55f + .2f * gn_paint_hash(column, (int)row, 8)) *
                       (.8f + .3f * gn_paint_fractal(u, v, 8, 5, 3));
    const float joint = .35f + .65f * gn_paint_ramp(.008f, .024f, seam);
    out[0] = tone * joint, out[1] = tone * .95f * joint, out[2] = tone * .87f * joint;
}

static void flags_height(float u, float v, const void *what, float out[4]) {
    float rgb[4];
    flags_at(u, v, what, rgb);
    out[0] = rgb[0] + .25f * gn_paint_fractal(u, v, 12, 4, 9);
}

static void blocks_at(float u, float v, const void *what, float out[4]) {
    enum { ROWS = 8, BLOCKS = 4 };
    (void)what;
    const float y = v * ROWS, row = floorf(y),
                x = u * BLOCKS + .5f * fmodf(row, 2) + .2f * gn_paint_hash((int)row, 2, 3);
    const int column = (int)floorf(x) % BLOCKS;
    const float fx = x - floorf(x), fy = y - row;
    const float seam = fminf(2 * fminf(fx, 1 - fx), fminf(fy, 1 - fy)) +
                       .03f * (gn_paint_noise(u, v, 48, 2) - .5f);
    const float tone = (.66f + .16f * gn_paint_hash(column, (int)row, 8)) *
                       (.82f + .26f * gn_paint_fractal(u, v, 8, 5, 3));
    const float joint = .6f + .4f * gn_paint_ramp(.02f, .07f, seam);
    out[0] = tone * joint, out[1] = tone * .94f * joint, out[2] = tone * .83f * joint;
}

static void blocks_height(float u, float v, const void *what, float out[4]) {
    float rgb[4];
    blocks_at(u, v, what, rgb);
    out[0] = rgb[0] + .2f * gn_paint_fractal(u, v, 16, 4, 9);
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    const int size[2] = {1024, 1024}, half[2] = {512, 512};
    struct gn_glb_material m[SURFACES] = {
        [STONE] = {.name = "stone", .rgba = {.66f, .64f, .63f}, .rough = .95f},
        [FLAGS] = {.name = "flags", .rgba = {.75f, .72f, .68f}, .rough = .6f},
        [OAK] = {.name = "oak", .rgba = {.62f, .45f, .34f}, .rough = .5f},
        [IRON] = {.name = "iron", .rgba = {.05f, .05f, .055f}, .metal = .4f, .rough = .45f},
        [CLOTH] = {.name = "cloth", .rgba = {.80f, .78f, .72f}, .rough = 1, .double_sided = true},
        [WAX] = {.name = "wax", .rgba = {.90f, .84f, .70f}, .rough = .5f},
    };
    m[STONE].texture = gn_book_picture(b, "blocks", size, 3, blocks_at, NULL);
    m[STONE].normal_texture = gn_book_relief(b, "blocks relief", 512, .012f, blocks_height, NULL);
    m[FLAGS].texture = gn_book_picture(b, "flags", size, 3, flags_at, NULL);
    m[FLAGS].normal_texture = gn_book_relief(b, "flags relief", 512, .01f, flags_height, NULL);
    m[OAK].texture = gn_book_picture(b, "oak", half, 3, gn_book_wood, NULL);
    for (int i = 0; i < SURFACES; i++) surfaces[i] = gn_glb_material(b->glb, &m[i]);
}

static void add_walls(struct gn_book *b, const int *surfaces) {
    enum { AROUND = 64 };
    float opening[AROUND][2];
    const float wall[][2] = {{-4, 0}, {4, 0}, {4, 6.4f}, {-4, 6.4f}};
    for (int i = 0; i < AROUND; i++) {
        const float angle = 2 * (float)M_PI * (float)i / AROUND;
        opening[i][0] = RADIUS * cosf(angle), opening[i][1] = CENTRE + RADIUS * sinf(angle);
    }
    /* a deep reveal; the spot stands outside, so the wall casts nothing that it should not */
    struct gn_shape *shape = gn_book_begin(b, .5f);
    gn_shape_at(shape, -LEFT - .25f, 0, 0);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_extrude(shape, &(struct gn_outline){wall, 4, (const float(*)[2])opening, AROUND}, .5f);
    gn_shape_at(shape, .5f, 3.2f, -3.3f);
    gn_shape_box(shape, 7.5f, 6.4f, .4f);
    gn_book_put(b, "Walls", surfaces[STONE], NULL);

    /* a shaft with rings in the corner, and half of one on the wall behind */
    static const float shaft[][2] = {{0, 0},        {.30f, 0},     {.30f, .16f},  {.27f, .20f},
                                     {.27f, .26f},  {.20f, .33f},  {.185f, .36f}, {.185f, 4.6f},
                                     {.23f, 4.65f}, {.23f, 4.72f}, {.19f, 4.78f}, {.34f, 5.2f},
                                     {.36f, 5.3f},  {0, 5.3f}};
    shape = gn_book_begin(b, .8f);
    gn_shape_lathe(shape, shaft, GN_COUNT(shaft), 48);
    const int mesh = gn_book_mesh(b, "shaft", surfaces[STONE]);
    for (int i = 0; i < 3; i++)
        gn_book_stand(b, "Shaft", mesh, (struct gn_spot){-2.75f + 2.6f * (float)i, 0, -2.95f, 0, 0},
                      NULL);

    gn_shape_at(gn_book_begin(b, .5f), .5f, 0, 0);
    gn_shape_plane(&b->shape, 8, 7);
    gn_book_put(b, "Floor", surfaces[FLAGS], "{\"gnomon_cast\":false}");
}

static void add_window(struct gn_book *b, int glass) {
    const int tracery = gn_book_picture(b, "tracery", (int[]){1024, 1024}, 4, tracery_at, NULL);
    struct gn_shape *shape = gn_book_begin(b, 1);
    for (int i = 0; i < 2; i++) {
        gn_shape_at(shape, -LEFT - (i ? .30f : .18f), CENTRE - RADIUS, 0);
        gn_shape_turn(shape, 'y', 90);
        gn_shape_card(shape, 2 * RADIUS, 2 * RADIUS);
    }
    gn_book_put(b, "Tracery",
                gn_glb_material(b->glb, &(struct gn_glb_material){.name = "tracery",
                                                                  .rgba = {.8f, .8f, .8f},
                                                                  .rough = 1,
                                                                  .texture = tracery,
                                                                  .alpha = GN_GLB_MASK,
                                                                  .double_sided = true}),
                "{\"gnomon_cast\":false}");
    shape = gn_book_begin(b, 1);
    gn_shape_at(shape, -LEFT - .31f, CENTRE - RADIUS, 0);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_card(shape, 2 * RADIUS, 2 * RADIUS);
    gn_book_put(b, "Glass",
                gn_glb_material(b->glb, &(struct gn_glb_material){.name = "glass",
                                                                  .rgba = {.02f, .02f, .02f},
                                                                  .rough = .3f,
                                                                  .emissive = {1, 1, 1},
                                                                  .emissive_texture = glass}),
                "{\"gnomon_cast\":false}");
}

static void add_candlestick(struct gn_book *b, const int *surfaces) {
    static const float foot[][2] = {
        {0, 0},        {.16f, 0},     {.16f, 0},      {.16f, .02f},   {.06f, .05f},  {.03f, .08f},
        {.018f, .2f},  {.03f, .5f},   {.045f, .54f},  {.03f, .58f},   {.018f, .62f}, {.018f, 1.1f},
        {.03f, 1.14f}, {.09f, 1.17f}, {.095f, 1.18f}, {.095f, 1.18f}, {0, 1.175f}};
    static const float candle[][2] = {
        {0, 1.17f}, {.032f, 1.17f}, {.032f, 1.50f}, {.028f, 1.508f}, {0, 1.503f}};
    static const float spots[][2] = {{.55f, -1.75f}, {1.35f, -2.0f}};
    gn_book_lathe(gn_book_begin(b, 0), foot, GN_COUNT(foot), 5, 40);
    const int iron = gn_book_mesh(b, "candlestick", surfaces[IRON]);
    gn_shape_lathe(gn_book_begin(b, 0), candle, GN_COUNT(candle), 32);
    const int wax = gn_book_mesh(b, "candle", surfaces[WAX]);
    static const float flame[][2] = {
        {0, 0}, {.010f, .012f}, {.012f, .026f}, {.006f, .052f}, {0, .072f}};
    gn_book_lathe(gn_book_begin(b, 0), flame, GN_COUNT(flame), 4, 16);
    const int fire = gn_book_mesh(
        b, "flame",
        gn_glb_material(b->glb, &(struct gn_glb_material){.name = "flame",
                                                          .rgba = {1, .6f, .2f},
                                                          .rough = 1,
                                                          .emissive = {1, .78f, .36f}}));
    for (int i = 0; i < GN_COUNT(spots); i++) {
        gn_book_stand(b, "Flame", fire, (struct gn_spot){spots[i][0], 1.515f, spots[i][1], 0, 0},
                      "{\"gnomon_cast\":false}");
        gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Candle",
                                              .kind = GN_GLB_POINT,
                                              .at = {spots[i][0], 1.56f, spots[i][1]},
                                              .radius = .012f,
                                              .intensity = 1.0f,
                                              .rgb = {1, .62f, .26f},
                                              .keys = "\"gnomon_map_px\":512"});
        const struct gn_spot at = {spots[i][0], 0, spots[i][1], 0, 0};
        gn_book_stand(b, "Candlestick", iron, at, NULL);
        gn_book_stand(b, "Candle", wax, at, NULL);
    }
}

void gn_book_make_window(struct gn_book *b) {
    int surfaces[SURFACES];
    gn_glb_scene_extras(b->glb,
                        "{\"gnomon_sky\":[0.085,0.095,0.125],\"gnomon_ground\":[0.080,0.066,0.062],"
                        "\"gnomon_background\":[0.004,0.004,0.006]}");
    mix_surfaces(b, surfaces);
    struct gn_image image;
    gn_paint_fill(&image, 1024, 1024, 3, slide_at, NULL);
    const int glass = gn_glb_texture(b->glb, "rose", &image, GN_GLB_CLAMP);
    gn_image_finish(&image);
    add_walls(b, surfaces);
    add_window(b, glass);
    gn_book_chair(gn_book_begin(b, 2));
    gn_book_stand(b, "Chair", gn_book_mesh(b, "chair", surfaces[OAK]),
                  (struct gn_spot){.15f, 0, -.45f, 52, 0}, NULL);
    add_candlestick(b, surfaces);

    /* the slide is as large as the rose, at the distance of the wall */
    const float at[3] = {-9.0f, 7.6f, .6f}, aim[3] = {.25f, 0, -.35f};
    const float share = (-LEFT - .3f - at[0]) / (aim[0] - at[0]);
    float away = 0;
    for (int i = 0; i < 3; i++) away += (aim[i] - at[i]) * (aim[i] - at[i]);
    const float distance = share * sqrtf(away);
    char keys[200];
    snprintf(keys, sizeof keys,
             "\"gnomon_map_px\":2048,\"gnomon_slide\":%d,\"gnomon_slide_size_m\":[%g,%g],"
             "\"gnomon_slide_distance_m\":%g,\"gnomon_slide_outside\":\"dark\"",
             glass - 1, 2 * (double)RADIUS * .95, 2 * (double)RADIUS * .95, (double)distance);
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Sun behind the window",
                                          .kind = GN_GLB_SPOT,
                                          .at = {at[0], at[1], at[2]},
                                          .aim = {aim[0], aim[1], aim[2]},
                                          .radius = .05f,
                                          .intensity = 3400,
                                          .cone_deg = 13,
                                          .rgb = {1, .95f, .88f},
                                          .keys = keys});
    gn_view_add(b->glb, &(struct gn_view){.eye = {2.75f, 1.75f, 4.3f},
                                          .aim = {-1.15f, 1.45f, -1.4f},
                                          .yfov_deg = 46});
}
