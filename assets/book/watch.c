/* A watch of steel and glass around a cushion. Lengths in this file are centimetres; the root
 * node scales them. The head lies in the xz plane, its dial up, twelve o'clock towards -z; then
 * it is tilted towards the camera. */
#include "book.h"

enum {
    STEEL,
    BRUSHED,
    DIAL,
    WHITE,
    HANDS,
    ORANGE,
    GLASS,
    LEATHER,
    THREAD,
    CUSHION,
    TABLE,
    SURFACES
};
#define TILT 56.0f
#define LIFT 3.93f /* of the head, so that the strap stands on the table */
#define FACE .18f  /* of the dial */

/* ---- pictures ---- */

static float segment(float x, float y, const float s[4]) {
    const float dx = s[2] - s[0], dy = s[3] - s[1];
    const float t = fminf(fmaxf(((x - s[0]) * dx + (y - s[1]) * dy) / (dx * dx + dy * dy), 0), 1);
    return hypotf(x - s[0] - t * dx, y - s[1] - t * dy);
}

/* Distance to the letters G N O M O N: strokes in a box of 1 x 1 each, y downwards. */
static float lettering(float x, float y) {
    static const float n[][4] = {{0, 1, 0, 0}, {0, 0, .7f, 1}, {.7f, 1, .7f, 0}};
    static const float m[][4] = {
        {0, 1, .06f, 0}, {.06f, 0, .45f, .8f}, {.45f, .8f, .84f, 0}, {.84f, 0, .9f, 1}};
    static const float bar[4] = {.52f, .55f, .88f, .55f}, spur[4] = {.88f, .55f, .88f, .82f};
    static const float at[6] = {0, 1.25f, 2.3f, 3.6f, 4.85f, 6.2f};
    float best = 9;
    for (int i = 0; i < 3; i++)
        best = fminf(best, fminf(segment(x - at[1], y, n[i]), segment(x - at[5], y, n[i])));
    for (int i = 0; i < 4; i++) best = fminf(best, segment(x - at[3], y, m[i]));
    for (int i = 2; i <= 4; i += 2)
        best = fminf(best, fabsf(hypotf(x - at[i] - .5f, y - .5f) - .5f));
    const float gx = x - .5f, gy = y - .5f, turn = atan2f(gy, gx);
    if (turn < -.75f || turn > .12f) best = fminf(best, fabsf(hypotf(gx, gy) - .5f));
    return fminf(best, fminf(segment(x, y, bar), segment(x, y, spur)));
}

/* The dial, 3.2 cm wide, its middle in the corner of the texture, which repeats. */
static void dial_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float x = 3.2f * (u < .5f ? u : u - 1), y = 3.2f * (v < .5f ? v : v - 1);
    const float r = hypotf(x, y), turn = atan2f(y, x) / (2 * (float)M_PI);
    const float ray =
        gn_paint_noise(turn + 1, .5f, 720, 3) * .6f + gn_paint_noise(turn + 1, .2f, 180, 5) * .4f;
    const float lobe = powf(fabsf(cosf(2 * (float)M_PI * (turn - .17f))), 5);
    const float tone =
        (.50f + .62f * lobe) * (.86f + .28f * ray) * (1 - .35f * gn_paint_ramp(.9f, 1.6f, r));
    const float blue[3] = {.12f, .24f, .44f};
    for (int c = 0; c < 3; c++) out[c] = blue[c] * tone;
    /* minute track, its numbers left to the indices */
    const float minute = turn * 60, off = fabsf(minute - roundf(minute)) / 60 * 2 * (float)M_PI * r;
    float ink = 1 - gn_paint_ramp(.008f, .014f, off);
    if (r < 1.40f || r > 1.475f) ink = 0;
    ink = fmaxf(ink, 1 - gn_paint_ramp(.004f, .010f, fabsf(r - 1.485f)));
    ink = fmaxf(ink,
                1 - gn_paint_ramp(.06f, .11f, lettering((x + .415f) / .118f, (y + .70f) / .118f)));
    ink = fmaxf(ink, 1 - gn_paint_ramp(.004f, .010f, fabsf(hypotf(x, y - .72f) - .33f)));
    const float sub = hypotf(x, y - .72f), around = atan2f(y - .72f, x) / (2 * (float)M_PI) * 12;
    if (sub > .27f && sub < .33f)
        ink = fmaxf(ink, 1 - gn_paint_ramp(.008f, .014f,
                                           fabsf(around - roundf(around)) / 12 * 6.28f * sub));
    for (int c = 0; c < 3; c++) out[c] += ink * (.88f - out[c]);
}

static void brush_height(float u, float v, const void *what, float out[4]) {
    (void)what;
    out[0] = gn_paint_noise(u * .03f, v, 512, 4) + .5f * gn_paint_noise(u * .1f, v, 200, 7);
}

static void hide_height(float u, float v, const void *what, float out[4]) {
    enum { CELLS = 40 };
    (void)what;
    float first = 2, second = 2;
    const float x = u * CELLS, y = v * CELLS;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int cx = (int)floorf(x) + dx, cy = (int)floorf(y) + dy, wx = (cx + CELLS) % CELLS,
                      wy = (cy + CELLS) % CELLS;
            const float d = hypotf((float)cx + gn_paint_hash(wx, wy, 1) - x,
                                   (float)cy + gn_paint_hash(wx, wy, 2) - y);
            if (d < first)
                second = first, first = d;
            else
                second = fminf(second, d);
        }
    out[0] = gn_paint_ramp(0, .35f, second - first) + .3f * gn_paint_fractal(u, v, 12, 3, 5);
}

static void hide_at(float u, float v, const void *what, float out[4]) {
    float h[4];
    hide_height(u, v, what, h);
    const float tone = (.72f + .24f * h[0]) * (.85f + .2f * gn_paint_fractal(u, v, 3, 4, 8));
    out[0] = out[1] = out[2] = tone;
}

static void weave_height(float u, float v, const void *what, float out[4]) {
    (void)what;
    out[0] = .5f * gn_paint_noise(u, v, 128, 3) + .5f * gn_paint_fractal(u, v, 32, 3, 6);
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    const int large[2] = {2048, 2048}, half[2] = {512, 512};
    const struct gn_glb_material m[SURFACES] = {
        [STEEL] = {.name = "polished steel", .rgba = {.78f, .77f, .75f}, .metal = 1, .rough = .10f},
        [BRUSHED] = {.name = "brushed steel",
                     .rgba = {.66f, .65f, .64f},
                     .metal = 1,
                     .rough = .34f,
                     .normal_texture = gn_book_relief(b, "brush", 512, .0012f, brush_height, NULL)},
        [DIAL] = {.name = "dial",
                  .rgba = {1, 1, 1},
                  .metal = .35f,
                  .rough = .42f,
                  .texture = gn_book_picture(b, "dial", large, 3, dial_at, NULL)},
        [WHITE] = {.name = "lume", .rgba = {.85f, .88f, .80f}, .rough = .6f},
        [HANDS] = {.name = "rhodium", .rgba = {.90f, .89f, .87f}, .metal = 1, .rough = .16f},
        [ORANGE] = {.name = "orange lacquer", .rgba = {.85f, .20f, .02f}, .rough = .3f},
        [GLASS] = {.name = "sapphire",
                   .rgba = {.92f, .95f, 1, .08f},
                   .rough = .02f,
                   .alpha = GN_GLB_BLEND,
                   .ior = 1.77f,
                   .transmission = .94f},
        [LEATHER] = {.name = "leather",
                     .rgba = {.30f, .105f, .035f},
                     .rough = .48f,
                     .texture = gn_book_picture(b, "hide", half, 3, hide_at, NULL),
                     .normal_texture =
                         gn_book_relief(b, "hide relief", 512, .004f, hide_height, NULL)},
        [THREAD] = {.name = "thread", .rgba = {.74f, .60f, .42f}, .rough = .9f},
        [CUSHION] = {.name = "suede",
                     .rgba = {.62f, .56f, .47f},
                     .rough = 1,
                     .normal_texture = gn_book_relief(b, "suede", 512, .01f, weave_height, NULL)},
        [TABLE] = {.name = "slate",
                   .rgba = {.085f, .088f, .095f},
                   .rough = .42f,
                   .texture = gn_book_picture(b, "slate", half, 1, gn_book_grain, NULL),
                   .normal_texture =
                       gn_book_relief(b, "slate relief", 512, .0016f, gn_book_plaster, NULL)},
    };
    for (int i = 0; i < SURFACES; i++) surfaces[i] = gn_glb_material(b->glb, &m[i]);
}

/* ---- the case ---- */

static void add_case(struct gn_book *b, const int *surfaces) {
    static const float back[][2] = {{0, -.56f},     {1.5f, -.56f},   {1.56f, -.54f}, {1.72f, -.46f},
                                    {1.90f, -.34f}, {1.955f, -.28f}, {1.98f, -.26f}};
    static const float side[][2] = {{1.98f, -.26f}, {1.99f, -.24f}, {1.99f, .16f}, {1.98f, .18f}};
    static const float bezel[][2] = {{1.98f, .18f}, {1.98f, .18f},  {1.93f, .225f}, {1.93f, .225f},
                                     {1.93f, .27f}, {1.915f, .30f}, {1.88f, .345f}, {1.82f, .395f},
                                     {1.76f, .43f}, {1.71f, .445f}, {1.675f, .44f}, {1.66f, .42f},
                                     {1.66f, .42f}, {1.655f, .36f}};
    static const float rehaut[][2] = {{1.655f, .38f}, {1.53f, FACE}, {1.515f, FACE}};
    struct gn_shape *shape = gn_book_begin(b, 0);
    gn_shape_lathe(shape, back, GN_COUNT(back), 128);
    gn_book_lathe(shape, bezel, GN_COUNT(bezel), 4, 160);
    gn_book_put(b, "Bezel", surfaces[STEEL], NULL);
    shape = gn_book_begin(b, .4f);
    gn_shape_lathe(shape, side, GN_COUNT(side), 128);
    static const float lug[][2] = {{1.0f, -.34f},  {1.75f, -.40f}, {2.12f, -.52f}, {2.36f, -.70f},
                                   {2.46f, -.70f}, {2.50f, -.60f}, {2.44f, -.32f}, {2.28f, -.06f},
                                   {2.02f, .10f},  {1.7f, .155f},  {1.0f, .16f}};
    for (int i = 0; i < 4; i++) {
        float points[GN_COUNT(lug)][2];
        const float way = i / 2 ? 1 : -1;
        for (int k = 0; k < GN_COUNT(lug); k++) { /* mirrored, still counter-clockwise */
            const float *p = lug[way > 0 ? k : GN_COUNT(lug) - 1 - k];
            points[k][0] = way * p[0], points[k][1] = p[1];
        }
        gn_shape_at(shape, i % 2 ? 1.26f : -1.26f, 0, 0);
        gn_shape_turn(shape, 'y', -90);
        gn_shape_bevel(
            shape,
            &(struct gn_outline){.points = (const float(*)[2])points, .count = GN_COUNT(lug)}, .36f,
            .05f, 3);
    }
    gn_book_put(b, "Case", surfaces[BRUSHED], NULL);
    gn_shape_lathe(gn_book_begin(b, .4f), rehaut, GN_COUNT(rehaut), 128);
    gn_book_put(b, "Rehaut", surfaces[BRUSHED], NULL);

    enum { TEETH = 28 };
    float crown[4 * TEETH][2];
    for (int i = 0; i < 4 * TEETH; i++) {
        const float angle = 2 * (float)M_PI * (float)i / (4 * TEETH), r = i % 4 < 2 ? .36f : .325f;
        crown[i][0] = r * cosf(angle), crown[i][1] = r * sinf(angle);
    }
    shape = gn_book_begin(b, 0);
    gn_shape_at(shape, 2.32f, -.04f, 0);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_bevel(shape,
                   &(struct gn_outline){.points = (const float(*)[2])crown, .count = 4 * TEETH},
                   .36f, .03f, 2);
    gn_shape_at(shape, 1.9f, -.04f, 0);
    gn_shape_turn(shape, 'z', -90);
    gn_shape_cylinder(shape, .24f, .3f, 32);
    gn_shape_move(shape, 0, .58f, 0);
    gn_shape_sphere(shape, .22f, 32, 16);
    gn_shape_home(shape);
    for (int way = -1; way <= 1; way += 2)
        gn_shape_rod(shape, (float[3]){-1.2f, -.42f, 2.22f * (float)way},
                     (float[3]){1.2f, -.42f, 2.22f * (float)way}, .07f, 16);
    gn_book_put(b, "Crown", surfaces[STEEL], NULL);
}

static void add_dial(struct gn_book *b, const int *surfaces) {
    struct gn_shape *shape = gn_book_begin(b, 1 / 3.2f);
    gn_shape_at(shape, 0, FACE, 0);
    gn_shape_ring(shape, .01f, 1.56f, 128);
    gn_book_put(b, "Dial", surfaces[DIAL], NULL);
    shape = gn_book_begin(b, 0);
    for (int i = 0; i < 12; i++) {
        if (i == 6) continue;
        for (int k = 0; k < (i ? 1 : 2); k++) {
            gn_shape_at(shape, 0, FACE + .035f, 0);
            gn_shape_turn(shape, 'y', -30.0f * (float)i);
            gn_shape_move(shape, i ? 0 : .075f - .15f * (float)k, 0, -1.19f);
            gn_shape_soft_box(shape, (float[3]){i % 3 ? .085f : .11f, .075f, i % 3 ? .30f : .36f},
                              .022f, 2);
        }
    }
    gn_shape_at(shape, 0, FACE, 0);
    gn_shape_cylinder(shape, .03f, .22f, 24);
    gn_shape_at(shape, 0, FACE + .19f, 0);
    gn_shape_sphere(shape, .055f, 24, 12);
    gn_book_put(b, "Indices", surfaces[HANDS], NULL);
    shape = gn_book_begin(b, 0);
    for (int i = 0; i < 12; i++) {
        if (i == 6) continue;
        gn_shape_at(shape, 0, FACE + .072f, 0);
        gn_shape_turn(shape, 'y', -30.0f * (float)i);
        gn_shape_move(shape, 0, 0, -1.19f);
        if (i) gn_shape_soft_box(shape, (float[3]){.034f, .012f, .22f}, .005f, 1);
    }
    gn_book_put(b, "Lume", surfaces[WHITE], NULL);
}

/* A hand points to twelve; the outline's y is its length. */
static int hand_node(struct gn_book *b, const char *name, const float (*half)[2], int count,
                     float height, int material) {
    float points[24][2];
    for (int i = 0; i < count; i++) {
        points[i][0] = half[i][0], points[i][1] = half[i][1];
        points[2 * count - 1 - i][0] = -half[i][0], points[2 * count - 1 - i][1] = half[i][1];
    }
    struct gn_shape *shape = gn_book_begin(b, 0);
    gn_shape_at(shape, 0, height, 0);
    gn_shape_turn(shape, 'x', -90);
    gn_shape_bevel(shape,
                   &(struct gn_outline){.points = (const float(*)[2])points, .count = 2 * count},
                   .026f, .012f, 2);
    return gn_book_put(b, name, material, NULL);
}

static void add_hands(struct gn_book *b, const int *surfaces) {
    const int head = b->parent;
    static const float hour[][2] = {{.045f, -.16f}, {.055f, .1f}, {.085f, .35f}, {.018f, .82f}};
    static const float minute[][2] = {{.038f, -.2f}, {.045f, .1f}, {.068f, .5f}, {.015f, 1.34f}};
    static const float second[][2] = {
        {.036f, -.46f}, {.042f, -.30f}, {.014f, -.24f}, {.015f, 0}, {.009f, 1.40f}};
    const float at = 10.16f; /* hours */
    const int h = hand_node(b, "Hour hand", hour, GN_COUNT(hour), FACE + .085f, surfaces[HANDS]);
    const int m =
        hand_node(b, "Minute hand", minute, GN_COUNT(minute), FACE + .125f, surfaces[HANDS]);
    const int s =
        hand_node(b, "Second hand", second, GN_COUNT(second), FACE + .165f, surfaces[ORANGE]);
    gn_book_spin(b, "hours", h, 'y', -360 * at / 12, -1, 43200);
    gn_book_spin(b, "minutes", m, 'y', -360 * (at - floorf(at)), -1, 3600);
    b->parent = gn_glb_node(
        b->glb,
        &(struct gn_glb_node){.name = "Small dial", .parent = b->parent, .move = {0, 0, .72f}});
    static const float small[][2] = {{.020f, -.07f}, {.024f, 0}, {.007f, .25f}};
    const int d = hand_node(b, "Small hand", small, GN_COUNT(small), FACE + .03f, surfaces[HANDS]);
    gn_book_spin(b, "day", d, 'y', -150, -1, 86400);
    gn_book_spin(b, "seconds", s, 'y', -213, -1, 60);
    b->parent = head;
}

/* ---- the strap, and what holds it ---- */

/* Ellipse of the strap's middle, seen along x: centre y, half axes in y and z. */
static const float LOOP[3] = {-1.87f, 2.16f, 3.0f};

static void loop_at(float angle, float out, float p[2]) {
    p[0] = LOOP[0] + (LOOP[1] + out) * cosf(angle), p[1] = (LOOP[2] + out) * sinf(angle);
}

static void strap_at(float u, float v, const void *what, float out[3]) {
    (void)what;
    const float turn = 2 * (float)M_PI * u, angle = .80f + v * (2 * (float)M_PI - 1.6f),
                end = fminf(v, 1 - v);
    const float c = cosf(turn), s = sinf(turn);
    const float width = (1.02f - .2f * gn_paint_ramp(.0f, .3f, end)),
                thick = .12f + .07f * (1 - gn_paint_ramp(.0f, .2f, end));
    const float x = width * copysignf(powf(fabsf(c) + 1e-6f, .28f), c),
                n = thick * copysignf(powf(fabsf(s) + 1e-6f, .65f), s);
    float p[2];
    loop_at(angle, n, p);
    out[0] = x, out[1] = p[0], out[2] = p[1];
}

static void cushion_at(float u, float v, const void *what, float out[3]) {
    (void)what;
    const float turn = -2 * (float)M_PI * u, t = 2 * v - 1,
                round = powf(fmaxf(1 - powf(fabsf(t), 5), 0), .42f);
    const float waist = 1 - .045f * expf(-t * t * 30);
    out[0] = 2.75f * t;
    out[1] = LOOP[0] + (LOOP[1] - .2f) * round * waist * cosf(turn);
    out[2] = (LOOP[2] - .2f) * round * waist * sinf(turn);
}

static void add_strap(struct gn_book *b, const int *surfaces) {
    struct gn_shape *shape = gn_book_begin(b, .45f);
    gn_shape_surface(shape,
                     &(struct gn_surface){.at = strap_at, .across = 64, .up = 160, .uv = {5, 14}});
    gn_book_put(b, "Strap", surfaces[LEATHER], NULL);
    shape = gn_book_begin(b, 0);
    for (int i = 0; i < 2 * 46; i++) { /* stitches */
        const float v = .035f + .93f * (float)(i / 2) / 45, end = fminf(v, 1 - v),
                    angle = .80f + v * (2 * (float)M_PI - 1.6f);
        const float x = (.86f - .2f * gn_paint_ramp(.0f, .3f, end)) * (i % 2 ? 1 : -1);
        const float out = (.12f + .07f * (1 - gn_paint_ramp(.0f, .2f, end))) * .86f;
        float p[2], q[2];
        loop_at(angle, out, p);
        loop_at(angle + .055f, out, q);
        gn_shape_rod(shape, (float[3]){x, p[0], p[1]}, (float[3]){x, q[0], q[1]}, .026f, 8);
    }
    gn_book_put(b, "Stitches", surfaces[THREAD], NULL);
    shape = gn_book_begin(b, .25f);
    gn_shape_surface(shape,
                     &(struct gn_surface){.at = cushion_at, .across = 96, .up = 64, .uv = {16, 6}});
    gn_book_put(b, "Cushion", surfaces[CUSHION], NULL);
}

static void add_glass(struct gn_book *b, const int *surfaces) {
    static const float dome[][2] = {{1.655f, .37f}, {1.655f, .43f}, {1.63f, .455f}, {1.4f, .487f},
                                    {1.0f, .522f},  {.5f, .545f},   {0, .552f}};
    gn_shape_lathe(gn_book_begin(b, 0), dome, GN_COUNT(dome), 128);
    gn_book_put(b, "Crystal", surfaces[GLASS], "{\"gnomon_cast\":false}");
}

void gn_book_make_watch(struct gn_book *b) {
    int surfaces[SURFACES];
    gn_glb_scene_extras(b->glb, "{\"gnomon_background\":[0.030,0.027,0.026],\"gnomon_sky\":[0.1,0."
                                "1,0.1],\"gnomon_ground\":[0.05,0.05,0.05]}");
    mix_surfaces(b, surfaces);
    const int root = gn_glb_node(
        b->glb, &(struct gn_glb_node){.name = "Centimetres", .scale = {.01f, .01f, .01f}});
    b->parent = root;
    gn_book_backdrop(gn_book_begin(b, .11f), (float[3]){160, 110, 60}, 30);
    gn_book_put(b, "Table", surfaces[TABLE], "{\"gnomon_cast\":false}");
    const float half = TILT / 2 * GN_RADIANS, spin = 14 / 2 * GN_RADIANS;
    const int stand = gn_glb_node(
        b->glb, &(struct gn_glb_node){
                    .name = "Stand", .parent = root, .turn = {0, sinf(spin), 0, cosf(spin)}});
    b->parent = gn_glb_node(b->glb, &(struct gn_glb_node){.name = "Watch",
                                                          .parent = stand,
                                                          .move = {0, LIFT, 0},
                                                          .turn = {sinf(half), 0, 0, cosf(half)}});
    add_case(b, surfaces);
    add_dial(b, surfaces);
    add_hands(b, surfaces);
    add_strap(b, surfaces);
    add_glass(b, surfaces);
    b->parent = 0;
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Soft box",
                                          .kind = GN_GLB_SPOT,
                                          .at = {-.34f, .46f, .20f},
                                          .aim = {0, .03f, 0},
                                          .radius = .045f,
                                          .intensity = 1.05f,
                                          .cone_deg = 34,
                                          .rgb = {1, .93f, .84f},
                                          .keys = "\"gnomon_map_px\":2048"});
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Rim",
                                          .kind = GN_GLB_SPOT,
                                          .at = {.40f, .30f, -.22f},
                                          .aim = {0, .03f, 0},
                                          .radius = .03f,
                                          .intensity = .22f,
                                          .cone_deg = 30,
                                          .rgb = {.70f, .84f, 1}});
    gn_view_add(b->glb, &(struct gn_view){.eye = {.02f, .125f, .30f},
                                          .aim = {.004f, .036f, 0},
                                          .yfov_deg = 16,
                                          .znear = .02f,
                                          .zfar = 5});
}
