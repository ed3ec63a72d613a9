#include "form.h"

#include "shape/shapes.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* ---- surfaces ---- */

static void difference(const struct gn_surface *s, float u, float v, int axis, float out[3]) {
    const float step = 5e-4f;
    float ahead[3], behind[3];
    s->at(u + (axis == 0 ? step : 0), v + (axis == 1 ? step : 0), s->what, ahead);
    s->at(u - (axis == 0 ? step : 0), v - (axis == 1 ? step : 0), s->what, behind);
    float length = 0;
    for (int c = 0; c < 3; c++) out[c] = ahead[c] - behind[c], length += out[c] * out[c];
    length = sqrtf(length);
    for (int c = 0; c < 3; c++) out[c] = length > 1e-9f ? out[c] / length : 0;
}

static void normal_of(const struct gn_surface *s, float u, float v, float out[3]) {
    float length = 0;
    for (int tries = 0; tries < 2 && length < 1e-6f; tries++) {
        float du[3], dv[3];
        difference(s, u, v, 0, du);
        difference(s, u, v, 1, dv);
        length = 0;
        for (int c = 0; c < 3; c++) {
            out[c] = du[(c + 1) % 3] * dv[(c + 2) % 3] - du[(c + 2) % 3] * dv[(c + 1) % 3];
            length += out[c] * out[c];
        }
        /* a pole: take the normal beside it */
        u += u < .5f ? .004f : -.004f;
        v += v < .5f ? .004f : -.004f;
    }
    if (length < 1e-6f) out[0] = out[2] = 0, out[1] = 1;
}

void gn_shape_surface(struct gn_shape *shape, const struct gn_surface *s) {
    const uint32_t first = (uint32_t)shape->vertex_count, columns = (uint32_t)s->across + 1;
    for (int row = 0; row <= s->up; row++)
        for (int i = 0; i <= s->across; i++) {
            const float u = (float)i / (float)s->across, v = (float)row / (float)s->up;
            float p[3], n[3];
            s->at(u, v, s->what, p);
            normal_of(s, u, v, n);
            gn_shape_vertex(shape, p, n, (float[2]){u * s->uv[0], (1 - v) * s->uv[1]});
        }
    for (uint32_t row = 0; row < (uint32_t)s->up; row++)
        for (uint32_t i = 0; i < (uint32_t)s->across; i++) {
            const uint32_t a = first + row * columns + i, b = a + columns;
            gn_shape_triangle(shape, a, a + 1, b + 1);
            gn_shape_triangle(shape, a, b + 1, b);
        }
}

/* ---- boxes ---- */

/* Places along one axis of a side: the middle of the edge's circle, and the tangent of the angle.
 */
static int side_places(float half, int steps, float (*out)[2]) {
    for (int i = 0; i <= 2 * steps + 1; i++) {
        const bool second = i > steps;
        const float t =
            second ? (float)(i - steps - 1) / (float)steps : (float)i / (float)steps - 1;
        out[i][0] = second ? half : -half;
        out[i][1] = tanf(t * (float)M_PI / 4);
    }
    return 2 * steps + 2;
}

void gn_shape_soft_box(struct gn_shape *shape, const float size[3], float radius, int steps) {
    enum { PLACES = 40 };
    assert(2 * steps + 2 <= PLACES);
    for (int side = 0; side < 6; side++) {
        const int w = side / 2, a = (w + 1) % 3, b = (w + 2) % 3;
        const float sign = side % 2 ? -1 : 1;
        float across[PLACES][2], up[PLACES][2];
        const int columns = side_places(size[a] / 2 - radius, steps, across);
        const int rows = side_places(size[b] / 2 - radius, steps, up);
        const uint32_t first = (uint32_t)shape->vertex_count;
        for (int r = 0; r < rows; r++)
            for (int c = 0; c < columns; c++) {
                float n[3], p[3];
                n[a] = sign * across[c][1], n[b] = up[r][1], n[w] = sign;
                const float length = sqrtf(n[a] * n[a] + n[b] * n[b] + 1);
                p[a] = sign * across[c][0] + radius * n[a] / length;
                p[b] = up[r][0] + radius * n[b] / length;
                p[w] = sign * (size[w] / 2 - radius) + radius * n[w] / length;
                const float uv[2] = {w == 1 ? p[2] : w == 0 ? p[2] : p[0], w == 1 ? p[0] : p[1]};
                gn_shape_vertex(shape, p, n, uv);
            }
        for (int r = 0; r + 1 < rows; r++)
            for (int c = 0; c + 1 < columns; c++) {
                const uint32_t k = first + (uint32_t)(r * columns + c), d = k + (uint32_t)columns;
                gn_shape_triangle(shape, k, k + 1, d + 1);
                gn_shape_triangle(shape, k, d + 1, d);
            }
    }
}

/* ---- splines ---- */

static float spline(float a, float b, float c, float d, float t) {
    return b + .5f * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

struct vine {
    const float (*points)[3];
    int count;
    float from, to;
};

static void vine_middle(const struct vine *w, float v, float out[3]) {
    const float place = fminf(fmaxf(v, 0), 1) * (float)(w->count - 1);
    const int at = (int)fminf(place, (float)(w->count - 2));
    const float *b = w->points[at], *c = w->points[at + 1];
    const float *a = at > 0 ? w->points[at - 1] : b, *d = at + 2 < w->count ? w->points[at + 2] : c;
    for (int k = 0; k < 3; k++) out[k] = spline(a[k], b[k], c[k], d[k], place - (float)at);
}

void gn_shape_vine(struct gn_shape *shape, const float (*points)[3], int count, float from,
                   float to, int section) {
    const struct vine w = {points, count, from, to};
    enum { SPAN = 8 };
    const int rings = SPAN * (count - 1);
    float side[3] = {.36f, .48f, .8f};
    const uint32_t first = (uint32_t)shape->vertex_count;
    for (int r = -1; r <= rings + 1; r++) { /* the first and the last close the ends */
        const float v = fminf(fmaxf((float)r / (float)rings, 0), 1);
        const bool cap = r < 0 || r > rings;
        float at[3], ahead[3], behind[3], along[3], other[3], slip = 0, length = 0;
        vine_middle(&w, v, at);
        vine_middle(&w, v + .01f, ahead);
        vine_middle(&w, v - .01f, behind);
        for (int c = 0; c < 3; c++) along[c] = ahead[c] - behind[c], length += along[c] * along[c];
        for (int c = 0; c < 3; c++) along[c] /= sqrtf(length), slip += along[c] * side[c];
        for (int c = 0; c < 3; c++) side[c] -= slip * along[c];
        length = sqrtf(side[0] * side[0] + side[1] * side[1] + side[2] * side[2]);
        for (int c = 0; c < 3; c++) side[c] /= length;
        for (int c = 0; c < 3; c++)
            other[c] =
                along[(c + 1) % 3] * side[(c + 2) % 3] - along[(c + 2) % 3] * side[(c + 1) % 3];
        const float radius = (from + v * (to - from)) * (cap ? .02f : 1);
        for (int i = 0; i <= section; i++) {
            const float angle = 2 * (float)M_PI * (float)(i % section) / (float)section;
            float n[3], p[3];
            for (int c = 0; c < 3; c++) {
                n[c] = cosf(angle) * side[c] + sinf(angle) * other[c];
                p[c] = at[c] + radius * n[c];
            }
            for (int c = 0; c < 3 && cap; c++) n[c] = r < 0 ? -along[c] : along[c];
            gn_shape_vertex(shape, p, n, (float[2]){from * angle, v * from * 20});
        }
    }
    for (int r = 0; r < rings + 2; r++)
        for (int i = 0; i < section; i++) {
            const uint32_t a = first + (uint32_t)(r * (section + 1) + i),
                           b = a + (uint32_t)section + 1;
            gn_shape_triangle(shape, a, a + 1, b + 1);
            gn_shape_triangle(shape, a, b + 1, b);
        }
}

int gn_profile_smooth(const float (*points)[2], int count, int steps, float (*out)[2], int room) {
    int made = 0;
    for (int i = 0; i + 1 < count; i++) {
        const float *b = points[i], *c = points[i + 1];
        if (!memcmp(b, c, sizeof *points)) continue; /* a corner */
        const bool starts = i == 0 || !memcmp(points[i - 1], b, sizeof *points);
        const bool ends = i + 2 == count || !memcmp(points[i + 2], c, sizeof *points);
        const float *a = starts ? b : points[i - 1], *d = ends ? c : points[i + 2];
        for (int k = 0; k < steps; k++, made++) {
            assert(made < room);
            const float t = (float)k / (float)steps;
            for (int x = 0; x < 2; x++) out[made][x] = spline(a[x], b[x], c[x], d[x], t);
            out[made][0] = fmaxf(out[made][0], 0);
        }
    }
    assert(made < room);
    memcpy(out[made], points[count - 1], sizeof *out);
    return made + 1;
}
