#include "coarse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TURN (2 * (float)M_PI)

/* A bump of this height and width around a direction: longitude 0 is the face, radians. */
static float bump(float longitude, float latitude, float at_longitude, float at_latitude,
                  float width, float height) {
    float x = (longitude - at_longitude) * cosf(latitude), y = latitude - at_latitude;
    return height * expf(-(x * x + y * y) / (width * width));
}

/* Distance from the middle of the head, whose mean is about 1. */
static float radius_of(float longitude, float latitude) {
    float r = 1;
    r += bump(longitude, latitude, 0, -.05f, .2f, .3f);              /* nose */
    r += bump(longitude, latitude, 0, -.75f, .3f, .15f);             /* chin */
    r += bump(longitude, latitude, 0, .35f, .45f, .08f);             /* brow */
    r -= bump(fabsf(longitude), latitude, .4f, .12f, .22f, .14f);    /* eyes */
    r -= bump(longitude, latitude, 0, -.45f, .2f, .08f);             /* mouth */
    r += bump(fabsf(longitude), latitude, TURN / 4, 0, .2f, .15f);   /* ears */
    r += bump(fabsf(longitude), latitude, TURN / 2, .3f, .7f, .15f); /* back */
    return r;
}

static void edge(const struct gn_shape *shape, uint32_t from, uint32_t to, float out[3]) {
    float length = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = shape->vertices[to].position[k] - shape->vertices[from].position[k];
        length += out[k] * out[k];
    }
    for (int k = 0; k < 3; k++) out[k] /= fmaxf(sqrtf(length), 1e-12f);
}

/* Adds the face's normal, times the angle at the corner, to the vertex. */
static void add_normal(const struct gn_shape *shape, const uint32_t *face, int corner, float *sum) {
    float a[3], b[3], n[3], length = 0;
    edge(shape, face[corner], face[(corner + 1) % 3], a);
    edge(shape, face[corner], face[(corner + 2) % 3], b);
    for (int k = 0; k < 3; k++) {
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        length += n[k] * n[k];
    }
    length = sqrtf(length);
    float angle = atan2f(length, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    for (int k = 0; k < 3 && length > 1e-6f; k++) sum[k] += n[k] / length * angle;
}

/* Of the vertices from `first` on; those at one place get one normal. */
static void smooth(struct gn_shape *shape, uint32_t first, size_t first_index) {
    size_t count = shape->vertex_count - first;
    float(*sums)[3] = calloc(count, sizeof *sums);
    if (!sums) abort();
    for (size_t i = first_index; i < shape->index_count; i++) {
        const uint32_t *face = shape->indices + i - (i - first_index) % 3;
        add_normal(shape, face, (int)((i - first_index) % 3), sums[shape->indices[i] - first]);
    }
    for (size_t v = 0; v < count; v++) {
        struct gn_vertex *vertex = &shape->vertices[first + v];
        float n[3] = {0}, length = 0;
        for (size_t w = 0; w < count; w++) {
            const float *other = shape->vertices[first + w].position;
            float apart = 0;
            for (int k = 0; k < 3; k++) apart += fabsf(other[k] - vertex->position[k]);
            for (int k = 0; k < 3 && apart < 1e-4f; k++) n[k] += sums[w][k];
        }
        for (int k = 0; k < 3; k++) length += n[k] * n[k];
        for (int k = 0; k < 3; k++) vertex->normal[k] = n[k] / fmaxf(sqrtf(length), 1e-12f);
    }
    free(sums);
}

void gn_coarse_head(struct gn_shape *shape, float height, int around, int down) {
    uint32_t first = (uint32_t)shape->vertex_count, columns = (uint32_t)around + 1;
    size_t first_index = shape->index_count;
    for (int row = 0; row <= down; row++)
        for (int i = 0; i <= around; i++) {
            bool pole = row == 0 || row == down;
            float latitude = TURN / 2 * ((float)row / (float)down - .5f);
            float longitude = TURN * ((float)(i % around) / (float)around - .5f);
            float r = .42f * height * radius_of(longitude, latitude), c = pole ? 0 : cosf(latitude);
            float p[3] = {.8f * r * c * sinf(longitude), .48f * height + 1.1f * r * sinf(latitude),
                          r * c * cosf(longitude)};
            gn_shape_vertex(shape, p, (float[3]){0, 1, 0}, (float[2]){0});
        }
    for (uint32_t row = 0; row < (uint32_t)down; row++)
        for (uint32_t i = 0; i < (uint32_t)around; i++) {
            uint32_t a = first + row * columns + i, b = a + 1, c = a + columns, d = c + 1;
            if (row > 0) gn_shape_triangle(shape, a, b, d);
            if (row + 1 < (uint32_t)down) gn_shape_triangle(shape, a, d, c);
        }
    smooth(shape, first, first_index);
}
