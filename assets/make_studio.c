/* Host tool: make_studio FILE writes the studio inside the program (--environment studio),
 * prefiltered; FILE.hdr: as a Radiance picture of 1024x512, for other programs. A grey room with a
 * lighter ceiling and soft boxes; the first of them is the key light, which comes from above, the
 * front and the left of the camera that scenes without one get. Neutral: all is grey, but the key
 * is a little warm and the boxes behind a little cool. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "environment/environment.h"

struct box {
    float direction[3]; /* to its middle */
    float half[2];      /* tangents: across, and up */
    float radiance[3];
};
static const struct box boxes[] = {
    {{0.2f, 1.0f, 0.6f}, {0.18f, 0.18f}, {18.5f, 17.4f, 15.9f}},
    {{1.0f, 0.25f, 0.55f}, {0.28f, 0.6f}, {2.6f, 2.6f, 2.6f}},
    {{-1.0f, 0.3f, 0.5f}, {0.2f, 0.7f}, {1.9f, 1.9f, 1.9f}},
    {{-0.7f, 0.35f, -1.0f}, {0.25f, 0.5f}, {3.0f, 3.1f, 3.3f}},
    {{0.9f, 0.5f, -0.8f}, {0.2f, 0.45f}, {2.7f, 2.8f, 3.0f}},
};
#define EDGE 0.06f /* over which a box fades, tangent */

static float smooth(float from, float to, float x) {
    const float t = fminf(fmaxf((x - from) / (to - from), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalize(float v[3]) {
    const float scale = 1.0f / sqrtf(dot(v, v));
    for (int k = 0; k < 3; k++) v[k] *= scale;
}

/* 1 within a box, 0 outside, a smooth edge around it. */
static float cover(const struct box *box, const float d[3]) {
    float z[3] = {box->direction[0], box->direction[1], box->direction[2]};
    normalize(z);
    float x[3] = {z[2], 0.0f, -z[0]}; /* horizontal */
    normalize(x);
    const float y[3] = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2],
                        z[0] * x[1] - z[1] * x[0]};
    const float depth = dot(d, z);
    if (depth < 0.05f) return 0.0f;
    const float u = fabsf(dot(d, x)) / depth, v = fabsf(dot(d, y)) / depth;
    return (1.0f - smooth(box->half[0], box->half[0] + EDGE, u)) *
           (1.0f - smooth(box->half[1], box->half[1] + EDGE, v));
}

static void radiance_of(const float d[3], float rgb[3]) {
    const float floor_to_wall = smooth(-0.9f, 0.1f, d[1]),
                wall_to_ceiling = smooth(0.2f, 0.95f, d[1]);
    const float grey = 0.16f + 0.14f * floor_to_wall + 0.25f * wall_to_ceiling;
    for (int k = 0; k < 3; k++) rgb[k] = grey;
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++) {
        const float share = cover(&boxes[i], d);
        for (int k = 0; k < 3; k++) rgb[k] += share * (boxes[i].radiance[k] - rgb[k]);
    }
}

enum { WIDTH = 2048, HEIGHT = 1024 };

/* Radiance of a row of the picture of all directions. */
static void fill_row(uint32_t y, uint32_t width, uint32_t height, float (*row)[3]) {
    const float pi = 3.14159265358979f, down = pi * ((float)y + 0.5f) / (float)height;
    for (uint32_t x = 0; x < width; x++) {
        const float around = 2.0f * pi * ((float)x + 0.5f) / (float)width - pi;
        const float d[3] = {sinf(down) * cosf(around), cosf(down), sinf(down) * sinf(around)};
        radiance_of(d, row[x]);
    }
}

static bool write_prefiltered(FILE *file) {
    static struct gn_environment studio;
    static uint8_t bytes[GN_ENVIRONMENT_FILE_BYTES];
    static float row[WIDTH][3];
    const uint32_t px[2] = {WIDTH, HEIGHT};
    struct gn_sphere *sphere = gn_sphere_create();
    for (uint32_t y = 0; y < HEIGHT; y++) {
        fill_row(y, WIDTH, HEIGHT, row);
        gn_sphere_add_row(sphere, y, px, (const float(*)[3])row);
    }
    gn_environment_make(sphere, 1, &studio);
    gn_sphere_destroy(sphere);
    gn_environment_write(&studio, bytes);
    return fwrite(bytes, sizeof bytes, 1, file) == 1;
}

/* Mantissas over an exponent that the channels share; neither runs nor an exposure. */
static bool write_hdr(FILE *file) {
    static float row[WIDTH / 2][3];
    bool ok = fprintf(file, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", HEIGHT / 2,
                      WIDTH / 2) > 0;
    for (uint32_t y = 0; y < HEIGHT / 2 && ok; y++) {
        fill_row(y, WIDTH / 2, HEIGHT / 2, row);
        for (uint32_t x = 0; x < WIDTH / 2; x++) {
            const float *c = row[x];
            int exponent;
            frexpf(fmaxf(c[0], fmaxf(c[1], c[2])) * 1.002f,
                   &exponent); /* no mantissa rounds to 256 */
            uint8_t rgbe[4] = {0, 0, 0, (uint8_t)(exponent + 128)};
            for (int k = 0; k < 3; k++) rgbe[k] = (uint8_t)lrintf(ldexpf(c[k], 8 - exponent));
            ok &= fwrite(rgbe, sizeof rgbe, 1, file) == 1;
        }
    }
    return ok;
}

int main(int argc, char **argv) {
    if (argc != 2) return 2;
    const char *suffix = strrchr(argv[1], '.');
    const bool is_hdr = suffix && strcmp(suffix, ".hdr") == 0;
    FILE *file = fopen(argv[1], "wb");
    if (!file || !(is_hdr ? write_hdr(file) : write_prefiltered(file)) || fclose(file) != 0) {
        perror(argv[1]);
        return 1;
    }
    return 0;
}
