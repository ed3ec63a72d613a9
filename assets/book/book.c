#include "book.h"

#include <assert.h>

struct gn_shape *gn_book_begin(struct gn_book *book, float uv_per_m) {
    gn_shape_finish(&book->shape);
    gn_shape_init(&book->shape, uv_per_m);
    return &book->shape;
}

int gn_book_mesh(struct gn_book *book, const char *name, int material) {
    return gn_glb_mesh(book->glb, name, gn_glb_geometry(book->glb, &book->shape), material);
}

int gn_book_put(struct gn_book *book, const char *name, int material, const char *keys) {
    return gn_book_stand(book, name, gn_book_mesh(book, name, material), (struct gn_spot){0}, keys);
}

int gn_book_stand(struct gn_book *book, const char *name, int mesh, struct gn_spot at,
                  const char *keys) {
    const float scale = at.scale != 0 ? at.scale : 1;
    struct gn_glb_node node = {.name = name,
                               .parent = book->parent,
                               .mesh = mesh,
                               .move = {at.x, at.y, at.z},
                               .extras = keys};
    if (at.yaw_deg != 0) gn_glb_turn_y(at.yaw_deg, node.turn);
    for (int i = 0; i < 3 && scale != 1; i++) node.scale[i] = scale;
    return gn_glb_node(book->glb, &node);
}

int gn_book_texture(struct gn_book *book, const char *name, struct gn_image *image) {
    const int texture = gn_glb_texture(book->glb, name, image, GN_GLB_REPEAT);
    gn_image_finish(image);
    return texture;
}

int gn_book_picture(struct gn_book *book, const char *name, const int size[2], int channels,
                    gn_paint_fn *paint, const void *what) {
    struct gn_image image;
    gn_paint_fill(&image, size[0], size[1], channels, paint, what);
    return gn_book_texture(book, name, &image);
}

int gn_book_relief(struct gn_book *book, const char *name, int size_px, float depth,
                   gn_paint_fn *height, const void *what) {
    struct gn_image image;
    gn_paint_relief(&image, size_px, depth, height, what);
    return gn_book_texture(book, name, &image);
}

void gn_book_spin(struct gn_book *book, const char *clip, int node, char axis, float start_deg,
                  float turns, float seconds) {
    enum { MOST = 65 };
    float times[MOST], values[MOST][4];
    const int keys = (int)(4 * fmaxf(fabsf(turns), 1)) + 1;
    assert(keys <= MOST);
    for (int i = 0; i < keys; i++) {
        const float share = (float)i / (float)(keys - 1);
        const float half = (start_deg + 360 * turns * share) * GN_RADIANS / 2;
        times[i] = seconds * share;
        memset(values[i], 0, sizeof values[i]);
        values[i][axis - 'x'] = sinf(half);
        values[i][3] = cosf(half);
    }
    gn_glb_channel(book->glb, gn_glb_animation(book->glb, clip),
                   &(struct gn_glb_channel){.node = node,
                                            .path = GN_GLB_ROTATION,
                                            .keys = keys,
                                            .times = times,
                                            .values = values[0]});
}

void gn_book_lathe(struct gn_shape *shape, const float (*points)[2], int count, int steps,
                   int around) {
    float profile[400][2];
    const int made = gn_profile_smooth(points, count, steps, profile, GN_COUNT(profile));
    gn_shape_lathe(shape, (const float(*)[2])profile, made, around);
}

void gn_book_chair(struct gn_shape *shape) {
    for (int i = 0; i < 4; i++) {
        const float x = i % 2 ? .19f : -.19f, z = i / 2 ? .19f : -.19f;
        gn_shape_at(shape, x, z < 0 ? .5f : .22f, z);
        gn_shape_soft_box(shape, (float[3]){.042f, z < 0 ? 1.0f : .44f, .042f}, .008f, 2);
    }
    gn_shape_at(shape, 0, .45f, .01f);
    gn_shape_soft_box(shape, (float[3]){.45f, .03f, .44f}, .012f, 3);
    for (int i = 0; i < 3; i++) {
        gn_shape_at(shape, 0, .66f + .13f * (float)i, -.19f);
        gn_shape_soft_box(shape, (float[3]){.38f, .055f, .02f}, .008f, 2);
    }
    for (int i = 0; i < 3; i++) {
        gn_shape_at(shape, i == 2 ? 0 : i ? .19f : -.19f, i == 2 ? .16f : .2f, i == 2 ? .19f : 0);
        gn_shape_soft_box(shape,
                          i == 2 ? (float[3]){.38f, .024f, .024f} : (float[3]){.024f, .024f, .38f},
                          .006f, 2);
    }
}

struct backdrop {
    const float *size;
    float radius;
};

static void backdrop_at(float u, float v, const void *what, float out[3]) {
    const struct backdrop *b = what;
    const float depth = b->size[1], r = b->radius, flat = depth - r, bend = r * (float)M_PI / 2;
    const float along = v * (flat + bend + b->size[2] - r),
                turn = fminf(fmaxf(along - flat, 0), bend) / r;
    out[0] = (u - .5f) * b->size[0];
    out[1] = r * (1 - cosf(turn)) + fmaxf(along - flat - bend, 0);
    out[2] = depth / 2 - fminf(along, flat) - r * sinf(turn);
}

void gn_book_backdrop(struct gn_shape *shape, const float size[3], float radius) {
    const struct backdrop b = {size, radius};
    gn_shape_surface(shape, &(struct gn_surface){.at = backdrop_at,
                                                 .what = &b,
                                                 .across = 8,
                                                 .up = 96,
                                                 .uv = {size[0], size[1] + size[2]}});
}

/* ---- surfaces ---- */

void gn_book_grain(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float cloud = gn_paint_fractal(u, v, 4, 5, 31), speck = gn_paint_noise(u, v, 128, 5);
    out[0] = .84f + .16f * cloud - .1f * speck * speck;
}

void gn_book_wood(float u, float v, const void *what, float out[4]) {
    const int planks = 4, plank = (int)floorf(u * (float)planks);
    const unsigned seed = 40 + 7 * (unsigned)plank;
    (void)what;
    const float x = u * (float)planks - (float)plank, shift = gn_paint_hash(plank, 3, 9);
    const float bend = .35f * gn_paint_noise(v + shift, .5f, 4, seed);
    const float wave = x * .5f + bend + .1f * gn_paint_fractal(x, v + shift, 3, 3, seed);
    const float ring = .5f + .5f * sinf(40 * wave);
    const float fibre = gn_paint_noise(u, v * .06f + shift, 256, seed + 1);
    const float end = fabsf(v + shift - floorf(v + shift) - .5f) * 2;
    const float seam = gn_paint_ramp(0, .018f, fminf(x, 1 - x)) * gn_paint_ramp(0, .004f, 1 - end);
    const float tone =
        (.62f + .2f * ring + .18f * fibre) * (.8f + .28f * gn_paint_hash(plank, 1, 5));
    const float dark[3] = {.30f, .17f, .09f}, light[3] = {.80f, .58f, .38f};
    for (int c = 0; c < 3; c++)
        out[c] = (dark[c] + (light[c] - dark[c]) * tone) * (.25f + .75f * seam);
}

void gn_book_plaster(float u, float v, const void *what, float out[4]) {
    (void)what;
    out[0] = .6f * gn_paint_fractal(u, v, 6, 4, 77) + .4f * gn_paint_noise(u, v, 96, 12);
}

void gn_book_marble(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float warp = gn_paint_fractal(u, v, 3, 5, 17), fine = gn_paint_fractal(u, v, 6, 4, 23);
    const float vein = fabsf(gn_paint_noise(u + .18f * warp, v + .18f * fine, 4, 3) - .5f);
    const float dark = 1 - gn_paint_ramp(0, .07f, vein);
    const float cloud = gn_paint_fractal(u, v, 2, 4, 8);
    const float tone = .93f - .1f * cloud - .28f * dark * fine;
    out[0] = tone, out[1] = tone * .99f, out[2] = tone * .965f;
}
