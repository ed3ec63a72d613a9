/* A product without light and floor: a kettle of hammered copper, and two cups. Metres. */
#include "book.h"

enum { COPPER, BRASS, WOOD, GLAZE, CLAY, SURFACES };

/* Dents of a hammer: distance to the nearest of scattered points. */
static void dents_at(float u, float v, const void *what, float out[4]) {
    enum { CELLS = 22 };
    (void)what;
    float nearest = 1;
    const float x = u * CELLS, y = v * CELLS;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int cx = (int)floorf(x) + dx, cy = (int)floorf(y) + dy;
            const int wx = (cx + CELLS) % CELLS, wy = (cy + CELLS) % CELLS;
            const float px = (float)cx + .5f + .7f * (gn_paint_hash(wx, wy, 3) - .5f),
                        py = (float)cy + .5f + .7f * (gn_paint_hash(wx, wy, 4) - .5f);
            nearest = fminf(nearest, hypotf(px - x, py - y));
        }
    out[0] = fminf(nearest * nearest, .6f);
}

static void speckles_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float speck = gn_paint_ramp(.80f, .92f, gn_paint_noise(u, v, 160, 6));
    const float cloud = gn_paint_fractal(u, v, 4, 4, 2);
    const float rgb[3] = {.86f - .05f * cloud, .84f - .06f * cloud, .78f - .07f * cloud};
    for (int c = 0; c < 3; c++) out[c] = rgb[c] - .4f * speck * rgb[c];
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    const int wood = gn_book_picture(b, "wood", (int[]){512, 512}, 3, gn_book_wood, NULL);
    surfaces[COPPER] = gn_glb_material(
        b->glb, &(struct gn_glb_material){
                    .name = "copper",
                    .rgba = {.93f, .50f, .36f},
                    .metal = 1,
                    .rough = .16f,
                    .normal_texture = gn_book_relief(b, "dents", 512, .011f, dents_at, NULL)});
    surfaces[BRASS] = gn_glb_material(
        b->glb, &(struct gn_glb_material){
                    .name = "brass", .rgba = {.88f, .68f, .36f}, .metal = 1, .rough = .2f});
    surfaces[WOOD] = gn_glb_material(
        b->glb, &(struct gn_glb_material){
                    .name = "wood", .rgba = {.42f, .30f, .24f}, .rough = .35f, .texture = wood});
    surfaces[GLAZE] = gn_glb_material(
        b->glb,
        &(struct gn_glb_material){
            .name = "glaze",
            .rgba = {.95f, .95f, .95f},
            .rough = .22f,
            .texture = gn_book_picture(b, "speckles", (int[]){512, 512}, 3, speckles_at, NULL)});
    surfaces[CLAY] = gn_glb_material(
        b->glb,
        &(struct gn_glb_material){.name = "clay", .rgba = {.42f, .27f, .18f}, .rough = .8f});
}

static void add_kettle(struct gn_book *b, const int *surfaces) {
    static const float body[][2] = {{0, 0},          {.094f, 0},     {.094f, 0},     {.101f, .002f},
                                    {.108f, .012f},  {.116f, .04f},  {.117f, .068f}, {.108f, .1f},
                                    {.089f, .127f},  {.064f, .142f}, {.064f, .142f}, {.064f, .148f},
                                    {.0605f, .151f}, {.057f, .149f}};
    static const float lid[][2] = {{.0585f, .147f}, {.0585f, .151f}, {.0585f, .151f},
                                   {.054f, .157f},  {.036f, .166f},  {.012f, .170f},
                                   {.012f, .170f},  {.009f, .174f},  {.009f, .178f}};
    static const float knob[][2] = {{.006f, .177f}, {.013f, .179f}, {.017f, .188f},
                                    {.016f, .196f}, {.009f, .203f}, {0, .205f}};
    static const float spout[][3] = {{.085f, .045f, 0},
                                     {.128f, .062f, 0},
                                     {.152f, .098f, 0},
                                     {.166f, .134f, 0},
                                     {.190f, .152f, 0}};
    static const float bail[][3] = {{-.079f, .133f, 0}, {-.098f, .165f, 0}, {-.098f, .215f, 0},
                                    {-.062f, .253f, 0}, {0, .262f, 0},      {.062f, .253f, 0},
                                    {.098f, .215f, 0},  {.098f, .165f, 0},  {.079f, .133f, 0}};
    static const float grip[][2] = {{0, -.052f},      {.008f, -.052f}, {.008f, -.052f},
                                    {.0115f, -.048f}, {.0125f, -.02f}, {.0135f, 0},
                                    {.0125f, .02f},   {.0115f, .048f}, {.008f, .052f},
                                    {.008f, .052f},   {0, .052f}};
    struct gn_shape *shape = gn_book_begin(b, 4);
    gn_book_lathe(shape, body, GN_COUNT(body), 8, 96);
    gn_book_lathe(shape, lid, GN_COUNT(lid), 6, 72);
    gn_shape_vine(shape, spout, GN_COUNT(spout), .026f, .0115f, 32);
    gn_book_put(b, "Kettle", surfaces[COPPER], NULL);

    shape = gn_book_begin(b, 0);
    gn_shape_vine(shape, bail, GN_COUNT(bail), .0042f, .0042f, 16);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(shape, .079f * (float)side, .133f, 0);
        gn_shape_sphere(shape, .010f, 24, 16);
    }
    gn_shape_at(shape, .190f, .152f, 0);
    gn_shape_turn(shape, 'z', -58);
    gn_shape_torus(shape, .0112f, .0022f, 32, 12);
    gn_shape_at(shape, 0, .146f, 0);
    gn_shape_torus(shape, .0635f, .0022f, 72, 12);
    gn_book_put(b, "Fittings", surfaces[BRASS], NULL);

    shape = gn_book_begin(b, 8);
    gn_book_lathe(shape, knob, GN_COUNT(knob), 6, 40);
    gn_shape_at(shape, 0, .2612f, 0);
    gn_shape_turn(shape, 'z', 90);
    gn_book_lathe(shape, grip, GN_COUNT(grip), 4, 32);
    gn_book_put(b, "Grip", surfaces[WOOD], NULL);
}

static void add_cups(struct gn_book *b, const int *surfaces) {
    static const float cup[][2] = {
        {0, .003f},      {.022f, .003f},  {.022f, .003f},  {.030f, .008f},   {.038f, .024f},
        {.0415f, .045f}, {.0425f, .062f}, {.0425f, .062f}, {.0415f, .0635f}, {.0402f, .062f},
        {.0402f, .062f}, {.039f, .045f},  {.035f, .024f},  {.026f, .010f},   {0, .008f}};
    static const float foot[][2] = {{.0f, 0},        {.0225f, 0},      {.0225f, 0},
                                    {.0235f, .002f}, {.0225f, .0055f}, {.015f, .0055f}};
    static const float ear[][3] = {{.0395f, .050f, 0}, {.054f, .053f, 0}, {.0625f, .042f, 0},
                                   {.058f, .028f, 0},  {.045f, .022f, 0}, {.036f, .020f, 0}};
    static const float tea[][2] = {{.0388f, .050f}, {0, .050f}};
    static const struct gn_spot places[] = {{.20f, 0, .075f, -35, 0}, {.275f, 0, -.03f, 130, 0}};
    struct gn_shape *shape = gn_book_begin(b, 7);
    gn_book_lathe(shape, cup, GN_COUNT(cup), 6, 64);
    gn_shape_vine(shape, ear, GN_COUNT(ear), .0046f, .0036f, 16);
    const int glazed = gn_book_mesh(b, "cup", surfaces[GLAZE]);
    shape = gn_book_begin(b, 0);
    gn_book_lathe(shape, foot, GN_COUNT(foot), 4, 48);
    const int bare = gn_book_mesh(b, "foot", surfaces[CLAY]);
    shape = gn_book_begin(b, 0);
    gn_shape_lathe(shape, tea, 2, 48);
    const int filled = gn_book_mesh(
        b, "tea",
        gn_glb_material(b->glb, &(struct gn_glb_material){
                                    .name = "tea", .rgba = {.22f, .075f, .018f}, .rough = .04f}));
    for (int i = 0; i < GN_COUNT(places); i++) {
        gn_book_stand(b, "Cup", glazed, places[i], NULL);
        gn_book_stand(b, "Foot", bare, places[i], NULL);
        gn_book_stand(b, "Tea", filled, places[i], NULL);
    }
}

void gn_book_make_product(struct gn_book *b) {
    int surfaces[SURFACES];
    mix_surfaces(b, surfaces);
    add_kettle(b, surfaces);
    add_cups(b, surfaces);
    gn_view_add(b->glb, &(struct gn_view){.eye = {.20f, .30f, .95f},
                                          .aim = {.085f, .118f, 0},
                                          .yfov_deg = 22,
                                          .znear = .05f,
                                          .zfar = 20});
}
