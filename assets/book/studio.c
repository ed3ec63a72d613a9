/* A studio with two large lamps: an amphora on a plinth, among forms of plaster. Metres. */
#include "book.h"

enum { PAPER, GLAZE, MEANDER, PLASTER, STONE, SURFACES };

/* Keys of a Greek meander, between two lines: 16 around, each as wide as it is high. */
static void meander_at(float u, float v, const void *what, float out[4]) {
    static const char *const key[8] = {"########", ".......#", "######.#", "#....#.#",
                                       "#.####.#", "#.#....#", "#.######", "########"};
    (void)what;
    const float x = u * 16 - floorf(u * 16), y = (v - .14f) / .72f;
    const bool inside = y >= 0 && y < 1;
    const bool line = (v > .03f && v < .085f) || (v > .915f && v < .97f);
    const bool dark = inside ? key[(int)(y * 8)][(int)(x * 8)] == '#' : line;
    const float clay[3] = {.80f, .44f, .25f}, glaze[3] = {.075f, .06f, .055f};
    const float tone = .9f + .2f * gn_paint_fractal(u, v, 6, 4, 3);
    for (int c = 0; c < 3; c++) out[c] = dark ? glaze[c] : clay[c] * tone;
}

static void mix_surfaces(struct gn_book *b, int surfaces[SURFACES]) {
    const int plaster = gn_book_relief(b, "plaster", 512, .0012f, gn_book_plaster, NULL);
    const int marble = gn_book_picture(b, "marble", (int[]){1024, 1024}, 3, gn_book_marble, NULL);
    surfaces[PAPER] = gn_glb_material(
        b->glb, &(struct gn_glb_material){.name = "paper", .rgba = {.50f, .47f, .44f}, .rough = 1});
    surfaces[GLAZE] = gn_glb_material(
        b->glb, &(struct gn_glb_material){
                    .name = "black glaze", .rgba = {.022f, .018f, .017f}, .rough = .24f});
    surfaces[MEANDER] = gn_glb_material(
        b->glb,
        &(struct gn_glb_material){
            .name = "meander",
            .rgba = {.92f, .80f, .74f},
            .rough = .38f,
            .texture = gn_book_picture(b, "meander", (int[]){1024, 64}, 3, meander_at, NULL)});
    surfaces[PLASTER] =
        gn_glb_material(b->glb, &(struct gn_glb_material){.name = "plaster",
                                                          .rgba = {.86f, .84f, .80f},
                                                          .rough = .9f,
                                                          .normal_texture = plaster});
    surfaces[STONE] = gn_glb_material(
        b->glb, &(struct gn_glb_material){
                    .name = "marble", .rgba = {.94f, .94f, .94f}, .rough = .3f, .texture = marble});
}

/* An amphora: black glaze, and two bands of clay with a meander. */
static void add_amphora(struct gn_book *b, const int *surfaces) {
    static const float foot[][2] = {{0, 0},         {.062f, 0},     {.062f, 0},     {.067f, .006f},
                                    {.066f, .016f}, {.05f, .026f},  {.033f, .034f}, {.036f, .046f},
                                    {.062f, .078f}, {.096f, .125f}, {.121f, .172f}, {.133f, .215f}};
    static const float belly[][2] = {{.133f, .215f}, {.1385f, .25f}, {.1375f, .285f}};
    static const float shoulder[][2] = {
        {.1375f, .285f}, {.130f, .318f}, {.108f, .345f}, {.076f, .365f}, {.058f, .380f}};
    static const float neck[][2] = {{.058f, .380f}, {.0535f, .405f}, {.0545f, .440f}};
    static const float lip[][2] = {{.0545f, .440f}, {.060f, .458f}, {.078f, .472f}, {.078f, .472f},
                                   {.083f, .478f},  {.083f, .492f}, {.078f, .497f}, {.078f, .497f},
                                   {.068f, .495f},  {.052f, .470f}, {.046f, .40f},  {0, .38f}};
    static const float ear[][3] = {{.050f, .432f, 0}, {.088f, .444f, 0}, {.122f, .425f, 0},
                                   {.133f, .385f, 0}, {.126f, .345f, 0}, {.112f, .325f, 0}};
    struct gn_shape *shape = gn_book_begin(b, 0);
    gn_shape_at(shape, 0, .62f, 0);
    gn_book_lathe(shape, foot, GN_COUNT(foot), 6, 128);
    gn_book_lathe(shape, shoulder, GN_COUNT(shoulder), 6, 128);
    gn_book_lathe(shape, lip, GN_COUNT(lip), 5, 96);
    for (int side = 0; side < 2; side++) {
        gn_shape_at(shape, 0, .62f, 0);
        gn_shape_turn(shape, 'y', 180.0f * (float)side + 14);
        gn_shape_vine(shape, ear, GN_COUNT(ear), .0115f, .0115f, 20);
    }
    gn_book_put(b, "Amphora", surfaces[GLAZE], NULL);
    /* texture once around, and once over the height of a band */
    for (int band = 0; band < 2; band++) {
        shape = gn_book_begin(b, 1 / (band ? .0604f : .0704f));
        gn_shape_at(shape, 0, .62f, 0);
        gn_book_lathe(shape, band ? neck : belly, 3, 8, 128);
        float width = 0;
        for (size_t i = 0; i < shape->vertex_count; i++)
            width = fmaxf(width, shape->vertices[i].uv[0]);
        for (size_t i = 0; i < shape->vertex_count; i++) shape->vertices[i].uv[0] /= width;
        gn_book_put(b, "Meander", surfaces[MEANDER], NULL);
    }
}

static void add_plinth(struct gn_book *b, const int *surfaces) {
    static const float column[][2] = {
        {0, .05f},      {.158f, .05f},  {.158f, .05f},  {.170f, .062f}, {.170f, .076f},
        {.158f, .088f}, {.158f, .088f}, {.150f, .096f}, {.140f, .110f}, {.140f, .110f},
        {.137f, .3f},   {.132f, .52f},  {.132f, .52f},  {.138f, .532f}, {.150f, .545f},
        {.150f, .545f}, {.165f, .560f}, {.165f, .572f}, {.158f, .58f},  {.158f, .58f},
        {0, .58f}};
    struct gn_shape *shape = gn_book_begin(b, 1.6f);
    gn_book_lathe(shape, column, GN_COUNT(column), 6, 96);
    gn_shape_at(shape, 0, .025f, 0);
    gn_shape_soft_box(shape, (float[3]){.40f, .05f, .40f}, .006f, 3);
    gn_shape_at(shape, 0, .60f, 0);
    gn_shape_soft_box(shape, (float[3]){.38f, .04f, .38f}, .005f, 3);
    gn_book_put(b, "Plinth", surfaces[STONE], NULL);
}

static void add_forms(struct gn_book *b, const int *surfaces) {
    static const float cone[][2] = {{0, 0}, {.125f, 0}, {.127f, .003f}, {.002f, .36f}, {0, .361f}};
    struct gn_shape *shape = gn_book_begin(b, 2);
    gn_shape_at(shape, .42f, .13f, .14f);
    gn_shape_sphere(shape, .13f, 96, 64);
    gn_shape_at(shape, -.44f, 0, -.02f);
    gn_shape_lathe(shape, cone, GN_COUNT(cone), 96);
    gn_shape_at(shape, -.30f, .085f, .29f);
    gn_shape_turn(shape, 'y', 34);
    gn_shape_soft_box(shape, (float[3]){.17f, .17f, .17f}, .003f, 3);
    gn_shape_at(shape, .70f, .0f, -.12f);
    gn_shape_turn(shape, 'y', 10);
    gn_shape_move(shape, 0, .21f, 0);
    gn_shape_soft_box(shape, (float[3]){.16f, .42f, .16f}, .003f, 3);
    gn_book_put(b, "Forms", surfaces[PLASTER], NULL);
}

void gn_book_make_studio(struct gn_book *b) {
    int surfaces[SURFACES];
    gn_glb_scene_extras(b->glb,
                        "{\"gnomon_sky\":[0.055,0.055,0.06],\"gnomon_ground\":[0.045,0.04,0.036],"
                        "\"gnomon_background\":[0.02,0.02,0.02]}");
    mix_surfaces(b, surfaces);
    gn_book_backdrop(gn_book_begin(b, 1), (float[3]){9, 3.0f, 4}, .7f);
    gn_book_put(b, "Backdrop", surfaces[PAPER], "{\"gnomon_cast\":false}");
    add_amphora(b, surfaces);
    add_plinth(b, surfaces);
    add_forms(b, surfaces);
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Key",
                                          .kind = GN_GLB_SPOT,
                                          .at = {-1.75f, 1.75f, 1.9f},
                                          .aim = {.1f, .4f, -.2f},
                                          .radius = .16f,
                                          .intensity = 24,
                                          .cone_deg = 60,
                                          .rgb = {1, .86f, .70f},
                                          .keys = "\"gnomon_map_px\":2048"});
    gn_lamp_add(b->glb, &(struct gn_lamp){.name = "Fill",
                                          .kind = GN_GLB_SPOT,
                                          .at = {2.3f, 1.5f, 1.5f},
                                          .aim = {0, .4f, -.2f},
                                          .radius = .28f,
                                          .intensity = 12,
                                          .cone_deg = 60,
                                          .rgb = {.62f, .78f, 1},
                                          .keys = "\"gnomon_map_px\":1024"});
    gn_view_add(b->glb, &(struct gn_view){
                            .eye = {.12f, .86f, 3.3f}, .aim = {.10f, .60f, -.1f}, .yfov_deg = 24});
}
