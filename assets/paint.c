#include "paint.h"

#include <math.h>
#include <png.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void gn_image_init(struct gn_image *image, int width, int height, int channels) {
    *image = (struct gn_image){.width = width, .height = height, .channels = channels};
    image->pixels = calloc((size_t)width * (size_t)height, (size_t)channels);
    if (!image->pixels) abort();
}

void gn_image_finish(struct gn_image *image) {
    free(image->pixels);
    *image = (struct gn_image){0};
}

void *gn_image_png(const struct gn_image *image, size_t *size) {
    static const png_uint_32 formats[] = {0, PNG_FORMAT_GRAY, 0, PNG_FORMAT_RGB, PNG_FORMAT_RGBA};
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)image->width,
                     .height = (png_uint_32)image->height,
                     .format = formats[image->channels]};
    png_alloc_size_t room = PNG_IMAGE_PNG_SIZE_MAX(png);
    void *bytes = malloc(room);
    if (!bytes || !png_image_write_to_memory(&png, bytes, &room, 0, image->pixels, 0, NULL))
        abort();
    *size = room;
    return bytes;
}

/* ---- noise ---- */

float gn_paint_hash(int x, int y, unsigned seed) {
    uint32_t h = (uint32_t)x * 0x8da6b343u + (uint32_t)y * 0xd8163841u + seed * 0xcb1ab31fu;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return (float)((h ^ (h >> 15)) >> 8) / 16777215.f;
}

static float fade(float t) { return t * t * (3 - 2 * t); }

static float mix(float a, float b, float t) { return a + (b - a) * t; }

static float clamp01(float v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

float gn_paint_ramp(float low, float high, float v) {
    return fade(clamp01((v - low) / (high - low)));
}

float gn_paint_noise(float u, float v, int cells, unsigned seed) {
    float x = u * (float)cells, y = v * (float)cells;
    int ix = (int)floorf(x), iy = (int)floorf(y);
    float fx = fade(x - (float)ix), fy = fade(y - (float)iy);
    int x0 = ((ix % cells) + cells) % cells, y0 = ((iy % cells) + cells) % cells;
    int x1 = (x0 + 1) % cells, y1 = (y0 + 1) % cells;
    return mix(mix(gn_paint_hash(x0, y0, seed), gn_paint_hash(x1, y0, seed), fx),
               mix(gn_paint_hash(x0, y1, seed), gn_paint_hash(x1, y1, seed), fx), fy);
}

float gn_paint_fractal(float u, float v, int cells, int octaves, unsigned seed) {
    float sum = 0, weight = 0, w = 1;
    for (int i = 0; i < octaves; i++, w *= 0.6f) {
        sum += w * gn_paint_noise(u, v, cells << i, seed + (unsigned)i);
        weight += w;
    }
    return sum / weight;
}

/* Few grey levels: not visible in grain, and the PNG has a third of the size. */
static unsigned char level(float v) { return (unsigned char)(lroundf(clamp01(v) * 63) * 255 / 63); }

typedef float grey_fn(float u, float v, const void *what);

static void fill_grey(struct gn_image *image, int size, grey_fn *paint, const void *what) {
    gn_image_init(image, size, size, 1);
    for (int i = 0; i < size * size; i++)
        image->pixels[i] = level(paint(((float)(i % size) + 0.5f) / (float)size,
                                       ((float)(i / size) + 0.5f) / (float)size, what));
}

struct recipe {
    float contrast;
    unsigned seed;
};

void gn_paint_fill(struct gn_image *image, int width, int height, int channels, gn_paint_fn *paint,
                   const void *what) {
    gn_image_init(image, width, height, channels);
    for (int i = 0; i < width * height; i++) {
        float texel[4] = {1, 1, 1, 1};
        paint(((float)(i % width) + 0.5f) / (float)width,
              ((float)(i / width) + 0.5f) / (float)height, what, texel);
        for (int c = 0; c < channels; c++)
            image->pixels[channels * i + c] = (unsigned char)lroundf(clamp01(texel[c]) * 255);
    }
}

struct relief {
    gn_paint_fn *paint;
    const void *what;
    float step, depth;
};

static void normal_at(float u, float v, const void *what, float out[4]) {
    const struct relief *r = what;
    float h[4][4] = {{0}}, n[3] = {0, 0, 1};
    r->paint(u - r->step, v, r->what, h[0]);
    r->paint(u + r->step, v, r->what, h[1]);
    r->paint(u, v - r->step, r->what, h[2]);
    r->paint(u, v + r->step, r->what, h[3]);
    n[0] = r->depth * (h[0][0] - h[1][0]) / (2 * r->step);
    n[1] = r->depth * (h[3][0] - h[2][0]) / (2 * r->step); /* v goes down, the bitangent up */
    float length = sqrtf(n[0] * n[0] + n[1] * n[1] + 1);
    for (int c = 0; c < 3; c++) out[c] = 0.5f + 0.5f * n[c] / length;
}

void gn_paint_relief(struct gn_image *image, int size_px, float depth, gn_paint_fn *height,
                     const void *what) {
    const struct relief relief = {height, what, 0.5f / (float)size_px, depth};
    gn_paint_fill(image, size_px, size_px, 3, normal_at, &relief);
}

/* ---- stone, wood, leaves ---- */

static float grain_at(float u, float v, const void *what) {
    const struct recipe *r = what;
    float cloud = gn_paint_fractal(u, v, 4, 4, r->seed);
    float speck = gn_paint_noise(u, v, 128, r->seed + 9);
    return 1 - r->contrast * (0.65f * cloud + 0.35f * speck);
}

void gn_paint_grain(struct gn_image *image, int size_px, float contrast, unsigned seed) {
    fill_grey(image, size_px, grain_at, &(struct recipe){contrast, seed});
}

enum { COURSES = 4 };

/* Distance of (u, v) from the nearest joint of its stone, in courses; joints are slightly uneven.
 */
static float joint_distance(float u, float v, unsigned seed, int *stone, int *course) {
    float y = v * COURSES;
    *course = (int)floorf(y) % COURSES;
    float shift = 0.25f * gn_paint_hash(*course, 77, seed);
    float x = u * COURSES + shift + 0.08f * (gn_paint_noise(u, v, 16, seed + 3) - 0.5f);
    float start = floorf(x);
    *stone = (int)start % COURSES;
    float fx = x - start, fy = y - floorf(y) + 0.05f * (gn_paint_noise(u, v, 16, seed + 5) - 0.5f);
    return fminf(fminf(fx, 1 - fx), fminf(fy, 1 - fy));
}

static float paving_at(float u, float v, const void *what) {
    const struct recipe *r = what;
    int stone, course;
    float edge = joint_distance(u, v, r->seed, &stone, &course);
    float tone = 0.80f + 0.2f * gn_paint_hash(stone, course, r->seed + 1) -
                 0.16f * gn_paint_fractal(u, v, 8, 4, r->seed + 2);
    return mix(0.42f, tone, gn_paint_ramp(0.012f, 0.05f, edge)) -
           0.06f * gn_paint_noise(u, v, 128, r->seed + 8);
}

void gn_paint_paving(struct gn_image *image, int size_px, unsigned seed) {
    fill_grey(image, size_px, paving_at, &(struct recipe){0, seed});
}

static float wood_at(float u, float v, const void *what) {
    const struct recipe *r = what;
    float bend = 0.06f * gn_paint_noise(u, v, 4, r->seed);
    float fibre = gn_paint_noise(u + bend, v * 0.125f, 64, r->seed + 1);
    float ring =
        0.5f + 0.5f * sinf(6.2831853f * (6 * u + 2 * gn_paint_noise(u, v, 4, r->seed + 2)));
    return 0.98f - 0.3f * fibre - 0.16f * ring;
}

void gn_paint_wood(struct gn_image *image, int size_px, unsigned seed) {
    fill_grey(image, size_px, wood_at, &(struct recipe){0, seed});
}

static float hedge_at(float u, float v, const void *what) {
    const struct recipe *r = what;
    float leaf = gn_paint_noise(u, v, 64, r->seed),
          clump = gn_paint_fractal(u, v, 8, 3, r->seed + 4);
    return 0.25f + 0.55f * leaf * leaf + 0.45f * clump * leaf;
}

void gn_paint_hedge(struct gn_image *image, int size_px, unsigned seed) {
    fill_grey(image, size_px, hedge_at, &(struct recipe){0, seed});
}

static float grass_at(float u, float v, const void *what) {
    const struct recipe *r = what;
    return .68f + .2f * gn_paint_noise(u, v, 64, r->seed) +
           .14f * gn_paint_noise(u, v, 32, r->seed + 1);
}

void gn_paint_grass(struct gn_image *image, int size_px, unsigned seed) {
    fill_grey(image, size_px, grass_at, &(struct recipe){0, seed});
}

/* ---- pictures with holes ---- */

static void set_pixel(struct gn_image *image, int x, int y, const float rgb[3], float alpha) {
    unsigned char *p = image->pixels + 4 * (y * image->width + x);
    for (int c = 0; c < 3; c++) p[c] = level(rgb[c]);
    p[3] = (unsigned char)(alpha >= 0.5f ? 255 : 0);
}

void gn_paint_lattice(struct gn_image *image, int size_px, int meshes, unsigned seed) {
    gn_image_init(image, size_px, size_px, 4);
    for (int i = 0; i < size_px * size_px; i++) {
        float u = ((float)(i % size_px) + 0.5f) / (float)size_px,
              v = ((float)(i / size_px) + 0.5f) / (float)size_px;
        float a = (u + v) * (float)meshes, b = (u - v) * (float)meshes + (float)meshes;
        float da = fabsf(a - floorf(a) - 0.5f), db = fabsf(b - floorf(b) - 0.5f);
        bool over = ((int)floorf(a) + (int)floorf(b)) % 2 ? da > 0.36f
                                                          : db <= 0.36f; /* which lath is on top */
        float along = over ? a : b,
              tone = 0.8f + 0.15f * gn_paint_noise(along, 0.5f * (u + v), 16, seed);
        float edge = fminf(fabsf(da - 0.36f), fabsf(db - 0.36f));
        tone *= 0.75f + 0.25f * gn_paint_ramp(0, 0.06f, edge);
        set_pixel(image, i % size_px, i / size_px, (float[3]){tone, tone, tone},
                  da > 0.36f || db > 0.36f);
    }
}

struct leaf {
    float x, y, angle, length, tone;
};

static void draw_leaf(struct gn_image *image, const struct leaf *leaf) {
    int size = image->width;
    float c = cosf(leaf->angle), s = sinf(leaf->angle);
    for (int i = 0; i < size * size; i++) {
        float dx = ((float)(i % size) + 0.5f) / (float)size - leaf->x;
        float dy = 1 - ((float)(i / size) + 0.5f) / (float)size - leaf->y;
        float t = (dx * c + dy * s) / leaf->length, side = (dy * c - dx * s) / leaf->length;
        if (t <= 0 || t >= 1) continue;
        float half = 0.62f * powf(t, 0.7f) * (1 - t) + 0.02f;
        if (fabsf(side) > half) continue;
        float vein = fabsf(side) < 0.025f ? 0.8f : 1,
              shade = leaf->tone * vein * (side > 0 ? 1 : 0.86f);
        set_pixel(image, i % size, i / size,
                  (float[3]){0.62f * shade, 0.92f * shade, 0.34f * shade}, 1);
    }
}

static void draw_twig(struct gn_image *image, float x0, float y0, float x1, float y1, float width) {
    int size = image->width;
    float dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
    for (int i = 0; i < size * size; i++) {
        float px = ((float)(i % size) + 0.5f) / (float)size - x0,
              py = 1 - ((float)(i / size) + 0.5f) / (float)size - y0;
        float t = clamp01((px * dx + py * dy) / length2);
        if (hypotf(px - t * dx, py - t * dy) < width * (1 - 0.6f * t))
            set_pixel(image, i % size, i / size, (float[3]){0.5f, 0.38f, 0.25f}, 1);
    }
}

/* Transparent pixels get the mean colour of a leaf, so that mipmaps have no dark edges. */
static void flood(struct gn_image *image) {
    for (int i = 0; i < image->width * image->height; i++)
        set_pixel(image, i % image->width, i / image->width, (float[3]){0.5f, 0.76f, 0.3f}, 0);
}

void gn_paint_branch(struct gn_image *image, int size_px, unsigned seed) {
    gn_image_init(image, size_px, size_px, 4);
    flood(image);
    draw_twig(image, 0.5f, 0, 0.5f, 0.9f, 0.014f);
    for (int i = 0; i < 10; i++) {
        float y = 0.1f + 0.078f * (float)i, side = i % 2 ? 1 : -1, spread = 0.42f * (1 - 0.5f * y);
        float x1 = 0.5f + side * spread * (0.75f + 0.25f * gn_paint_hash(i, 1, seed)),
              y1 = y + 0.12f + 0.06f * gn_paint_hash(i, 2, seed);
        draw_twig(image, 0.5f, y, x1, y1, 0.008f);
        for (int k = 0; k < 4; k++) {
            float t = 0.3f + 0.23f * (float)k,
                  turn = (gn_paint_hash(i, 10 + k, seed) - 0.5f) * 0.8f + (k % 2 ? 0.75f : -0.6f);
            float base = atan2f(y1 - y, x1 - 0.5f);
            draw_leaf(image, &(struct leaf){mix(0.5f, x1, t), mix(y, y1, t),
                                            base + (k == 3 ? 0 : turn * side),
                                            0.13f + 0.05f * gn_paint_hash(i, 20 + k, seed),
                                            0.62f + 0.38f * gn_paint_hash(i, 30 + k, seed)});
        }
    }
    draw_leaf(image, &(struct leaf){0.5f, 0.84f, 1.57f, 0.16f, 0.95f});
}

/* ---- light through a window ---- */

/* x from -.5 to .5, y from -.75 to .75, upwards; the head is a half circle around (0, SPRING). */
static const float HALF = 0.43f, SILL = -0.68f, SPRING = 0.25f, BAR = 0.02f, SOFT = 0.012f;
enum { ROWS = 3, QUARRIES = 3 /* diamonds across */ };

/* Distance from the edge of the opening, inwards. */
static float opening(float x, float y) {
    return y > SPRING ? HALF - hypotf(x, y - SPRING) : fminf(HALF - fabsf(x), y - SILL);
}

/* Distance from the axis of the nearest stone bar: mullion, transoms, spokes of the head. */
static float bars(float x, float y) {
    float row = (SPRING - SILL) / ROWS, r = hypotf(x, y - SPRING);
    float transom = fabsf(y - SILL - row * roundf((y - SILL) / row));
    if (y < SPRING + BAR) return fminf(fabsf(x), y < SILL + 0.5f * row ? 1 : transom);
    float turn = atan2f(y - SPRING, x) / 0.78539816f;
    float spoke = r < 0.5f * HALF ? 1 : r * 0.78539816f * fabsf(turn - roundf(turn));
    return fminf(fminf(spoke, fabsf(r - 0.5f * HALF)), y - SPRING);
}

/* Distance from the nearest lead, and the index of the piece of glass. */
static float leads(float x, float y, int piece[2]) {
    float a = (x * 1.35f + y) * QUARRIES, b = (x * 1.35f - y) * QUARRIES;
    piece[0] = (int)floorf(a), piece[1] = (int)floorf(b);
    return fminf(fabsf(a - roundf(a)), fabsf(b - roundf(b))) / (QUARRIES * 1.68f);
}

static void glass(const int piece[2], unsigned seed, float rgb[3]) {
    static const float tints[][3] = {
        {1, .86f, .58f}, {1, .78f, .42f}, {1, .93f, .76f}, {1, .66f, .30f}, {.62f, .86f, .84f}};
    float pick = gn_paint_hash(piece[0], piece[1], seed),
          tone = 0.8f + 0.2f * gn_paint_hash(piece[1], piece[0], seed);
    const float *tint = tints[(int)(pick * 4.99f)];
    for (int c = 0; c < 3; c++) rgb[c] = tint[c] * tone;
}

void gn_paint_window(struct gn_image *image, int width_px, unsigned seed) {
    gn_image_init(image, width_px, width_px * 3 / 2, 3);
    for (int i = 0; i < width_px * image->height; i++) {
        float u = ((float)(i % width_px) + 0.5f) / (float)width_px,
              v = ((float)(i / width_px) + 0.5f) / (float)width_px;
        float x = u - 0.5f, y = 0.75f - v, rgb[3];
        int piece[2];
        float lead = gn_paint_ramp(0.003f, 0.010f, leads(x, y, piece));
        float light = gn_paint_ramp(0, 2.5f * SOFT, opening(x, y)) *
                      gn_paint_ramp(BAR - SOFT, BAR + SOFT, bars(x, y)) * (0.25f + 0.75f * lead);
        glass(piece, seed, rgb);
        for (int c = 0; c < 3; c++) image->pixels[3 * i + c] = level(light * rgb[c]);
    }
}
