/* A library at night with eleven lights: pendants, a fire, a reading lamp, picture lights, sconces
 * and the moon in the window. The room is 7 m wide (x), 3.3 m high, and open towards the camera at
 * +z. Metres. */
#include "book.h"

enum {
    PANEL,
    CEILING,
    FLOOR,
    OAK,
    LEATHER,
    BRASS,
    RUG,
    GLOW,
    EMBER,
    MARBLE,
    SOOT,
    SHADE,
    GREEN,
    BOOKS,
    SURFACES = BOOKS + 6
};

static void rug_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float red[3] = {.42f, .07f, .06f}, navy[3] = {.06f, .09f, .20f},
                sand[3] = {.70f, .55f, .36f};
    const float edge = fminf(fminf(u, 1 - u) * 1.5f, fminf(v, 1 - v));
    const float x = fabsf(u - .5f) * 1.5f, y = fabsf(v - .5f);
    const float medal = x * 1.3f + y * 1.7f, lace = .5f + .5f * sinf(70 * x) * sinf(70 * y);
    const float *color = red;
    if (edge < .012f || (edge > .10f && edge < .112f))
        color = sand;
    else if (edge < .10f)
        color = lace > .78f ? sand : navy;
    else if (medal < .34f)
        color = medal > .31f ? sand : lace > .8f ? red : navy;
    else if (lace > .93f)
        color = sand;
    const float thread = .8f + .2f * gn_paint_noise(u, v, 256, 3);
    for (int c = 0; c < 3; c++) out[c] = color[c] * thread;
}

/* A landscape: hills in the haze, a sun above water. */
static void painting_at(float u, float v, const void *what, float out[4]) {
    const unsigned seed = *(const unsigned *)what;
    const float sky[3] = {.86f, .66f, .42f}, zenith[3] = {.30f, .42f, .58f};
    float rgb[3];
    for (int c = 0; c < 3; c++) rgb[c] = zenith[c] + (sky[c] - zenith[c]) * fminf(1, v * 1.7f);
    const float sun = hypotf(u - .64f, (v - .42f) * .75f);
    for (int c = 0; c < 3; c++)
        rgb[c] += (1 - gn_paint_ramp(.03f, .3f, sun)) * (c == 2 ? .1f : .25f);
    for (int layer = 0; layer < 4; layer++) {
        const float line =
            .46f + .12f * (float)layer -
            .20f * gn_paint_fractal(u * .5f, .1f * (float)layer, 4, 4, seed + (unsigned)layer);
        const float cover = gn_paint_ramp(line, line + .01f, v), t = (float)layer / 3;
        const float hill[3] = {.46f - .34f * t, .45f - .29f * t, .46f - .38f * t};
        for (int c = 0; c < 3; c++) rgb[c] += cover * (hill[c] - rgb[c]);
    }
    const float stroke = .88f + .24f * gn_paint_noise(u + .2f * v, v, 90, seed + 5);
    for (int c = 0; c < 3; c++) out[c] = rgb[c] * stroke;
}

static void damask_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float x = u * 4, y = v * 4, fx = x - floorf(x) - .5f, fy = y - floorf(y) - .5f;
    const float r = hypotf(fx * 1.3f, fy), a = atan2f(fy, fx);
    const float petal = .30f + .09f * cosf(6 * a) + .04f * cosf(14 * a);
    const float tone = .78f + .2f * (1 - gn_paint_ramp(petal - .02f, petal, r)) -
                       .1f * (1 - gn_paint_ramp(.1f, .12f, r));
    out[0] = tone;
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    static const float bindings[6][3] = {{.36f, .06f, .05f}, {.05f, .12f, .20f},
                                         {.08f, .18f, .09f}, {.40f, .22f, .08f},
                                         {.55f, .45f, .30f}, {.13f, .08f, .07f}};
    static const char *const names[6] = {"red books",   "blue books", "green books",
                                         "brown books", "pale books", "dark books"};
    const int half[2] = {512, 512};
    const int wood = gn_book_picture(b, "wood", half, 3, gn_book_wood, NULL);
    const int hide = gn_book_relief(b, "hide", 512, .01f, gn_book_plaster, NULL);
    struct gn_glb_material m[SURFACES] = {
        [PANEL] = {.name = "wallpaper",
                   .rgba = {.16f, .26f, .22f},
                   .rough = .75f,
                   .texture = gn_book_picture(b, "damask", half, 1, damask_at, NULL)},
        [CEILING] = {.name = "ceiling", .rgba = {.72f, .68f, .60f}, .rough = 1},
        [FLOOR] = {.name = "parquet", .rgba = {.62f, .55f, .50f}, .rough = .38f, .texture = wood},
        [OAK] = {.name = "oak", .rgba = {.50f, .42f, .38f}, .rough = .45f, .texture = wood},
        [LEATHER] = {.name = "leather",
                     .rgba = {.34f, .10f, .05f},
                     .rough = .42f,
                     .normal_texture = hide},
        [BRASS] = {.name = "brass", .rgba = {.86f, .64f, .32f}, .metal = 1, .rough = .3f},
        [RUG] = {.name = "rug",
                 .rgba = {1, 1, 1},
                 .rough = 1,
                 .texture = gn_book_picture(b, "rug", (int[]){1024, 683}, 3, rug_at, NULL)},
        [GLOW] = {.name = "bulb", .rgba = {1, .9f, .7f}, .rough = 1, .emissive = {1, .88f, .62f}},
        [EMBER] = {.name = "embers",
                   .rgba = {.1f, .02f, .01f},
                   .rough = 1,
                   .emissive = {1, .30f, .04f}},
        [MARBLE] = {.name = "marble",
                    .rgba = {.80f, .78f, .74f},
                    .rough = .3f,
                    .texture = gn_book_picture(b, "marble", half, 3, gn_book_marble, NULL)},
        [SOOT] = {.name = "soot", .rgba = {.03f, .026f, .024f}, .rough = 1},
        [SHADE] = {.name = "lampshade",
                   .rgba = {.85f, .72f, .50f},
                   .rough = 1,
                   .emissive = {.55f, .38f, .18f},
                   .double_sided = true},
        [GREEN] = {.name = "green glass",
                   .rgba = {.02f, .20f, .09f},
                   .rough = .15f,
                   .emissive = {.01f, .10f, .035f},
                   .double_sided = true},
    };
    for (int i = 0; i < 6; i++) {
        m[BOOKS + i] = (struct gn_glb_material){.name = names[i], .rough = .6f};
        memcpy(m[BOOKS + i].rgba, bindings[i], sizeof bindings[i]);
    }
    for (int i = 0; i < SURFACES; i++) surfaces[i] = gn_glb_material(b->glb, &m[i]);
}

static void soft_box(struct gn_shape *shape, float x, float y, float z, float sx, float sy,
                     float sz, float radius) {
    gn_shape_at(shape, x, y, z);
    gn_shape_soft_box(shape, (float[3]){sx, sy, sz}, radius, 2);
}

static void add_shell(struct gn_book *b, const int *surfaces) {
    struct gn_shape *shape = gn_book_begin(b, .8f);
    gn_shape_at(shape, -3.6f, 1.65f, 0);
    gn_shape_box(shape, .2f, 3.3f, 8);
    gn_shape_at(shape, 0, 1.65f, -2.6f);
    gn_shape_box(shape, 7.4f, 3.3f, .2f);
    /* the right wall has an opening for the window */
    const float wall[][2] = {{-4, 0}, {4, 0}, {4, 3.3f}, {-4, 3.3f}};
    const float opening[][2] = {{.3f, .85f}, {1.5f, .85f}, {1.5f, 2.6f}, {.3f, 2.6f}};
    gn_shape_at(shape, 3.6f, 0, 0);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_extrude(shape, &(struct gn_outline){wall, 4, opening, 4}, .2f);
    gn_book_put(b, "Walls", surfaces[PANEL], NULL);
    gn_shape_at(gn_book_begin(b, .6f), 0, 3.35f, 0);
    gn_shape_box(&b->shape, 7.4f, .1f, 8);
    gn_book_put(b, "Ceiling", surfaces[CEILING], NULL);
    gn_shape_at(gn_book_begin(b, .7f), 0, 0, 0);
    gn_shape_plane(&b->shape, 7, 8);
    gn_book_put(b, "Floor", surfaces[FLOOR], "{\"gnomon_cast\":false}");
    shape = gn_book_begin(b, .8f);
    for (int side = -1; side <= 1; side += 2) { /* skirting, dado, cornice */
        soft_box(shape, 3.48f * (float)side, .09f, 0, .05f, .18f, 8, .012f);
        soft_box(shape, 3.44f * (float)side, 3.22f, 0, .14f, .14f, 8, .05f);
    }
    soft_box(shape, 0, .09f, -2.47f, 7, .18f, .05f, .012f);
    soft_box(shape, 0, 3.22f, -2.43f, 7, .14f, .14f, .05f);
    for (int i = 0; i < 3; i++)
        soft_box(shape, 0, 3.22f, -1.2f + 1.7f * (float)i, 7, .2f, .22f, .02f); /* beams */
    for (int i = 0; i < 7; i++) { /* the window's bars, towards z from -1.5 to -.3 */
        const bool upright = i < 3;
        soft_box(shape, 3.56f, upright ? 1.725f : .87f + .57f * (float)(i - 3),
                 upright ? -1.48f + .58f * (float)i : -.9f, .06f, upright ? 1.75f : .05f,
                 upright ? .05f : 1.2f, .01f);
    }
    soft_box(shape, 3.46f, .83f, -.9f, .24f, .05f, 1.4f, .012f);
    gn_book_put(b, "Mouldings", surfaces[OAK], NULL);
    gn_shape_at(gn_book_begin(b, 1), .15f, .012f, 1.65f);
    gn_shape_turn(&b->shape, 'x', -90);
    gn_shape_card(&b->shape, 3.6f, 2.4f);
    gn_book_put(b, "Rug", surfaces[RUG], "{\"gnomon_cast\":false}");
}

/* Shelves and their books along the left part of the wall behind. */
static void add_shelves(struct gn_book *b, const int *surfaces) {
    const float x0 = -3.42f, width = 2.5f, z = -2.32f;
    struct gn_shape *shape = gn_book_begin(b, .9f);
    for (int i = 0; i < 3; i++)
        soft_box(shape, x0 + width / 2 * (float)i, 1.4f, z, .06f, 2.8f, .36f, .008f);
    for (int i = 0; i < 7; i++)
        soft_box(shape, x0 + width / 2, .12f + .44f * (float)i, z, width, .04f, .35f, .008f);
    soft_box(shape, x0 + width / 2, 2.84f, z, width + .16f, .1f, .44f, .02f);
    gn_book_put(b, "Shelves", surfaces[OAK], NULL);
    for (int color = 0; color < 6; color++) {
        shape = gn_book_begin(b, 0);
        int book = 0;
        for (int shelf = 0; shelf < 6; shelf++)
            for (float x = x0 + .05f; x < x0 + width - .06f; book++) {
                const float thick = .022f + .034f * gn_paint_hash(book, 1, 5),
                            tall = .24f + .12f * gn_paint_hash(book, 2, 5);
                const bool gap =
                    gn_paint_hash(book, 4, 5) < .05f || fabsf(x - x0 - width / 2) < .06f;
                if (!gap && (int)(5.99f * gn_paint_hash(book / 3, 3, 5)) == color)
                    soft_box(shape, x + thick / 2, .14f + .44f * (float)shelf + tall / 2,
                             z + .02f + .03f * gn_paint_hash(book, 6, 5), thick - .002f, tall, .22f,
                             .006f);
                x += gap ? .1f : thick;
            }
        gn_book_put(b, "Books", surfaces[BOOKS + color], NULL);
    }
}

static void add_fireplace(struct gn_book *b, const int *surfaces) {
    const float x = 1.05f, z = -2.34f;
    struct gn_shape *shape = gn_book_begin(b, 1);
    for (int side = -1; side <= 1; side += 2) {
        soft_box(shape, x + .66f * (float)side, .52f, z, .26f, 1.04f, .34f, .012f);
        soft_box(shape, x + .66f * (float)side, .08f, z, .32f, .16f, .40f, .016f);
    }
    soft_box(shape, x, 1.06f, z, 1.62f, .22f, .36f, .02f);
    soft_box(shape, x, 1.20f, z + .04f, 1.82f, .07f, .50f, .02f);
    soft_box(shape, x, .02f, z + .34f, 1.7f, .04f, .7f, .012f);
    gn_book_put(b, "Mantel", surfaces[MARBLE], NULL);
    shape = gn_book_begin(b, 0);
    gn_shape_at(shape, x, .5f, -2.49f);
    gn_shape_box(shape, 1.1f, 1, .02f);
    for (int i = 0; i < 4; i++) {
        gn_shape_at(shape, x - .28f, .09f + .07f * (float)(i / 2), -2.33f + .1f * (float)(i % 2));
        gn_shape_turn(shape, 'y', 8 * (float)i - 12);
        gn_shape_turn(shape, 'z', -90 + 4 * (float)i);
        gn_shape_cylinder(shape, .045f, .56f, 14);
    }
    gn_book_put(b, "Logs", surfaces[SOOT], NULL);
    static const float flame[][2] = {{0, 0},        {.05f, .03f},  {.06f, .08f},
                                     {.035f, .17f}, {.012f, .25f}, {0, .29f}};
    shape = gn_book_begin(b, 0);
    for (int i = 0; i < 7; i++) {
        gn_shape_at(shape, x - .24f + .08f * (float)i, .11f + .02f * (float)(i % 3),
                    -2.28f + .04f * (float)(i % 2));
        gn_shape_turn(shape, 'z', 10 * (float)(i % 3) - 10);
        gn_book_lathe(shape, flame, GN_COUNT(flame), 4, 16);
    }
    gn_book_put(b, "Flames", surfaces[EMBER], "{\"gnomon_cast\":false}");
}

static void add_pictures(struct gn_book *b, const int *surfaces) {
    static const struct {
        float x, y, w, h;
        unsigned seed;
    } frames[] = {
        {1.05f, 2.05f, 1.3f, .95f, 11}, {2.75f, 1.9f, .8f, .62f, 44}, {-.35f, 1.9f, .62f, .8f, 73}};
    for (int i = 0; i < GN_COUNT(frames); i++) {
        const float x = frames[i].x, y = frames[i].y, w = frames[i].w, h = frames[i].h;
        struct gn_shape *shape = gn_book_begin(b, 1);
        gn_shape_at(shape, x, y - h / 2, -2.465f);
        gn_shape_card(shape, w, h);
        gn_book_put(b, "Painting",
                    gn_glb_material(
                        b->glb, &(struct gn_glb_material){.name = "canvas",
                                                          .rgba = {.9f, .9f, .9f},
                                                          .rough = .7f,
                                                          .texture = gn_book_picture(
                                                              b, "painting", (int[]){512, 512}, 3,
                                                              painting_at, &frames[i].seed)}),
                    NULL);
        shape = gn_book_begin(b, 0);
        for (int side = -1; side <= 1; side += 2) {
            soft_box(shape, x + (w / 2 + .03f) * (float)side, y, -2.46f, .085f, h + .14f, .07f,
                     .018f);
            soft_box(shape, x, y + (h / 2 + .03f) * (float)side, -2.46f, w + .14f, .085f, .07f,
                     .018f);
        }
        gn_book_put(b, "Frame", surfaces[BRASS], NULL);
    }
}

static void add_table(struct gn_book *b, const int *surfaces) {
    static const float leg[][2] = {{0, 0},       {.05f, 0},    {.05f, 0},     {.062f, .03f},
                                   {.03f, .07f}, {.045f, .2f}, {.075f, .42f}, {.045f, .56f},
                                   {.07f, .60f}, {.07f, .72f}, {.07f, .72f},  {0, .72f}};
    struct gn_shape *shape = gn_book_begin(b, .9f);
    gn_shape_at(shape, .1f, .755f, .45f);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_soft_box(shape, (float[3]){1.0f, .05f, 2.2f}, .015f, 3);
    soft_box(shape, .1f, .69f, .45f, 1.95f, .10f, .76f, .01f);
    for (int i = 0; i < 4; i++) {
        gn_shape_at(shape, .1f + (i % 2 ? .95f : -.95f), 0, .45f + (i / 2 ? .38f : -.38f));
        gn_book_lathe(shape, leg, GN_COUNT(leg), 5, 32);
    }
    gn_book_put(b, "Table", surfaces[OAK], NULL);
    gn_book_chair(gn_book_begin(b, 2));
    const int chair = gn_book_mesh(b, "chair", surfaces[OAK]);
    static const struct gn_spot chairs[] = {{-.62f, 0, -.25f, 4, 0},
                                            {.02f, 0, -.3f, -8, 0},
                                            {-1.38f, 0, .55f, 78, 0},
                                            {1.55f, 0, .45f, -82, 0}};
    for (int i = 0; i < GN_COUNT(chairs); i++) gn_book_stand(b, "Chair", chair, chairs[i], NULL);
    for (int i = 0; i < 3; i++) { /* books on the table */
        shape = gn_book_begin(b, 0);
        gn_shape_at(shape, .62f, .80f + .045f * (float)i, .55f);
        gn_shape_turn(shape, 'y', 18 * (float)i - 12);
        gn_shape_soft_box(shape, (float[3]){.26f - .02f * (float)i, .042f, .19f}, .006f, 2);
        gn_book_put(b, "Book", surfaces[BOOKS + 2 * i], NULL);
    }
    static const float stem[][2] = {{0, .78f},      {.09f, .78f}, {.09f, .78f},
                                    {.085f, .80f},  {.02f, .82f}, {.012f, .9f},
                                    {.012f, 1.08f}, {.02f, 1.1f}, {0, 1.12f}};
    static const float shade[][2] = {
        {.14f, 1.07f}, {.135f, 1.1f}, {.10f, 1.15f}, {.05f, 1.175f}, {0, 1.18f}};
    shape = gn_book_begin(b, 0);
    gn_shape_at(shape, -.42f, 0, .35f);
    gn_book_lathe(shape, stem, GN_COUNT(stem), 4, 40);
    gn_book_put(b, "Lamp foot", surfaces[BRASS], NULL);
    shape = gn_book_begin(b, 0);
    gn_shape_at(shape, -.42f, 0, .35f);
    gn_book_lathe(shape, shade, GN_COUNT(shade), 6, 48);
    gn_book_put(b, "Lamp glass", surfaces[GREEN], "{\"gnomon_cast\":false}");
}

static void add_armchair(struct gn_book *b, const int *surfaces) {
    struct gn_shape *shape = gn_book_begin(b, 2);
    soft_box(shape, 0, .24f, .02f, .66f, .26f, .66f, .06f);
    soft_box(shape, 0, .42f, .06f, .56f, .16f, .60f, .07f);
    soft_box(shape, 0, .68f, -.30f, .76f, .90f, .18f, .085f);
    for (int side = -1; side <= 1; side += 2) {
        soft_box(shape, .36f * (float)side, .42f, .02f, .16f, .48f, .70f, .075f);
        soft_box(shape, .36f * (float)side, .86f, -.22f, .10f, .46f, .26f, .048f);
    }
    for (int i = 0; i < 4; i++)
        soft_box(shape, i % 2 ? .32f : -.32f, .06f, i / 2 ? .30f : -.30f, .05f, .12f, .05f, .01f);
    const int mesh = gn_book_mesh(b, "armchair", surfaces[LEATHER]);
    gn_book_stand(b, "Armchair", mesh, (struct gn_spot){2.45f, 0, -1.25f, -128, 0}, NULL);
    gn_book_stand(b, "Armchair", mesh, (struct gn_spot){-1.9f, 0, -1.15f, 62, 0}, NULL);
}

static const float pendants[][3] = {{-.75f, 2.3f, .45f}, {.1f, 2.3f, .45f}, {.95f, 2.3f, .45f}};
static const float sconces[][3] = {
    {-3.36f, 1.95f, -.6f}, {-3.36f, 1.95f, 1.2f}, {3.36f, 1.95f, .6f}};

static void add_fittings(struct gn_book *b, const int *surfaces) {
    static const float shade[][2] = {
        {.17f, -.10f}, {.15f, -.02f}, {.10f, .06f}, {.04f, .10f}, {.025f, .12f}};
    struct gn_shape *shape = gn_book_begin(b, 0);
    gn_book_lathe(shape, shade, GN_COUNT(shade), 5, 40);
    const int cup = gn_book_mesh(b, "pendant", surfaces[SHADE]);
    shape = gn_book_begin(b, 0);
    gn_shape_sphere(shape, .045f, 20, 12);
    const int bulb = gn_book_mesh(b, "bulb", surfaces[GLOW]);
    for (int i = 0; i < GN_COUNT(pendants); i++) {
        const float *p = pendants[i];
        gn_book_stand(b, "Pendant", cup, (struct gn_spot){p[0], p[1] + .04f, p[2], 0, 0},
                      "{\"gnomon_cast\":false}");
        gn_book_stand(b, "Bulb", bulb, (struct gn_spot){p[0], p[1], p[2], 0, 0},
                      "{\"gnomon_cast\":false}");
    }
    shape = gn_book_begin(b, 0);
    for (int i = 0; i < GN_COUNT(pendants); i++) {
        const float *p = pendants[i];
        gn_shape_rod(shape, (float[3]){p[0], p[1] + .14f, p[2]}, (float[3]){p[0], 3.3f, p[2]},
                     .006f, 8);
    }
    for (int i = 0; i < GN_COUNT(sconces); i++) {
        const float *p = sconces[i], side = p[0] < 0 ? -1 : 1;
        gn_shape_rod(shape, (float[3]){3.5f * side, p[1] - .14f, p[2]},
                     (float[3]){p[0], p[1] - .10f, p[2]}, .012f, 12);
        gn_shape_at(shape, p[0], p[1] - .11f, p[2]);
        gn_shape_cylinder(shape, .04f, .03f, 24);
    }
    gn_book_put(b, "Rods", surfaces[BRASS], NULL);
    static const float cone[][2] = {{.085f, -.08f}, {.055f, .10f}};
    gn_shape_lathe(gn_book_begin(b, 0), cone, 2, 32);
    const int wall_shade = gn_book_mesh(b, "sconce", surfaces[SHADE]);
    for (int i = 0; i < GN_COUNT(sconces); i++)
        gn_book_stand(b, "Sconce", wall_shade,
                      (struct gn_spot){sconces[i][0], sconces[i][1], sconces[i][2], 0, 0},
                      "{\"gnomon_cast\":false}");
}

static void add_lights(struct gn_book *b) {
    for (int i = 0; i < GN_COUNT(pendants); i++) {
        const float *p = pendants[i];
        gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Pendant",
                                              .kind = GN_GLB_SPOT,
                                              .at = {p[0], p[1], p[2]},
                                              .aim = {p[0], 0, p[2]},
                                              .radius = .05f,
                                              .intensity = 9,
                                              .cone_deg = 64,
                                              .rgb = {1, .82f, .58f}});
    }
    for (int i = 0; i < GN_COUNT(sconces); i++) {
        const float *p = sconces[i];
        gn_lamp_add(b->glb,
                    &(struct gn_lamp){.name = "Sconce",
                                      .kind = GN_GLB_POINT,
                                      .at = {p[0] - (p[0] < 0 ? -.06f : .06f), p[1] + .06f, p[2]},
                                      .intensity = 1.1f,
                                      .rgb = {1, .76f, .48f},
                                      .keys = "\"gnomon_shadow\":\"none\""});
    }
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Fire",
                                          .kind = GN_GLB_POINT,
                                          .at = {1.05f, .34f, -2.06f},
                                          .radius = .09f,
                                          .intensity = 9,
                                          .rgb = {1, .40f, .11f},
                                          .keys = "\"gnomon_map_px\":768"});
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Reading lamp",
                                          .kind = GN_GLB_SPOT,
                                          .at = {-.42f, 1.09f, .35f},
                                          .aim = {-.42f, 0, .35f},
                                          .radius = .03f,
                                          .intensity = 1.3f,
                                          .cone_deg = 60,
                                          .rgb = {1, .86f, .62f}});
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Picture light",
                                          .kind = GN_GLB_SPOT,
                                          .at = {1.05f, 2.95f, -1.75f},
                                          .aim = {1.05f, 1.95f, -2.5f},
                                          .radius = .04f,
                                          .intensity = 9,
                                          .cone_deg = 34,
                                          .rgb = {1, .84f, .62f}});
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Shelf light",
                                          .kind = GN_GLB_SPOT,
                                          .at = {-2.2f, 3.05f, -1.2f},
                                          .aim = {-2.2f, 1.3f, -2.4f},
                                          .radius = .04f,
                                          .intensity = 9,
                                          .cone_deg = 48,
                                          .rgb = {1, .80f, .54f}});
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Moon",
                                          .kind = GN_GLB_SPOT,
                                          .at = {11, 7.4f, -2.4f},
                                          .aim = {1.9f, 0, -.4f},
                                          .radius = .10f,
                                          .intensity = 1800,
                                          .cone_deg = 15,
                                          .rgb = {.42f, .60f, 1},
                                          .keys = "\"gnomon_map_px\":1536"});
}

void gn_book_make_room(struct gn_book *b) {
    int surfaces[SURFACES];
    gn_glb_scene_extras(b->glb,
                        "{\"gnomon_sky\":[0.062,0.056,0.052],\"gnomon_ground\":[0.060,0.046,0.036],"
                        "\"gnomon_background\":[0.010,0.014,0.03]}");
    mix_surfaces(b, surfaces);
    add_shell(b, surfaces);
    add_shelves(b, surfaces);
    add_fireplace(b, surfaces);
    add_pictures(b, surfaces);
    add_table(b, surfaces);
    add_armchair(b, surfaces);
    add_fittings(b, surfaces);
    add_lights(b);
    gn_view_add(
        b->glb,
        &(struct gn_view){.eye = {-.9f, 1.95f, 4.5f}, .aim = {.12f, 1.18f, -.6f}, .yfov_deg = 43});
}
