#include "shape/shapes.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CREASE_COS 0.819f /* of 35 degrees */
static const float TURN = 6.28318530718f;

/* ---- the growing shape and its pen ---- */

static void *grown(void *old, size_t *room, size_t need, size_t size) {
    if (need <= *room) return old;
    *room = need * 2;
    void *bytes = realloc(old, *room * size);
    if (!bytes) abort();
    return bytes;
}

void gn_shape_init(struct gn_shape *shape, float uv_per_m) {
    *shape = (struct gn_shape){.uv_per_m = uv_per_m};
    gn_shape_home(shape);
}

void gn_shape_finish(struct gn_shape *shape) {
    free(shape->vertices);
    free(shape->indices);
    *shape = (struct gn_shape){0};
}

void gn_shape_home(struct gn_shape *shape) {
    shape->pen = (struct gn_pen){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
}

void gn_shape_at(struct gn_shape *shape, float x, float y, float z) {
    gn_shape_home(shape);
    gn_shape_move(shape, x, y, z);
}

static void turned(const struct gn_pen *pen, const float v[3], float out[3]) {
    for (int i = 0; i < 3; i++) out[i] = v[0] * pen->x[i] + v[1] * pen->y[i] + v[2] * pen->z[i];
}

void gn_shape_move(struct gn_shape *shape, float x, float y, float z) {
    float by[3];
    turned(&shape->pen, (float[3]){x, y, z}, by);
    for (int i = 0; i < 3; i++) shape->pen.at[i] += by[i];
}

void gn_shape_turn(struct gn_shape *shape, char axis, float degrees) {
    struct gn_pen *pen = &shape->pen;
    float *a = axis == 'x' ? pen->y : axis == 'y' ? pen->z : pen->x;
    float *b = axis == 'x' ? pen->z : axis == 'y' ? pen->x : pen->y;
    float c = cosf(degrees * TURN / 360), s = sinf(degrees * TURN / 360);
    for (int i = 0; i < 3; i++) {
        float was = a[i];
        a[i] = c * was + s * b[i];
        b[i] = c * b[i] - s * was;
    }
}

uint32_t gn_shape_vertex(struct gn_shape *shape, const float position[3], const float normal[3],
                         const float uv[2]) {
    shape->vertices = grown(shape->vertices, &shape->vertex_room, shape->vertex_count + 1,
                            sizeof *shape->vertices);
    struct gn_vertex *v = &shape->vertices[shape->vertex_count];
    turned(&shape->pen, position, v->position);
    turned(&shape->pen, normal, v->normal);
    float length = sqrtf(v->normal[0] * v->normal[0] + v->normal[1] * v->normal[1] +
                         v->normal[2] * v->normal[2]);
    for (int i = 0; i < 3; i++) {
        v->position[i] += shape->pen.at[i];
        v->normal[i] /= length;
    }
    for (int i = 0; i < 2; i++) v->uv[i] = uv[i] * shape->uv_per_m;
    return (uint32_t)shape->vertex_count++;
}

void gn_shape_triangle(struct gn_shape *shape, uint32_t a, uint32_t b, uint32_t c) {
    assert(a < shape->vertex_count && b < shape->vertex_count && c < shape->vertex_count);
    shape->indices =
        grown(shape->indices, &shape->index_room, shape->index_count + 3, sizeof *shape->indices);
    uint32_t corners[3] = {a, b, c};
    memcpy(shape->indices + shape->index_count, corners, sizeof corners);
    shape->index_count += 3;
}

/* Vertex with final texture coordinates, without uv_per_m. */
static uint32_t raw_vertex(struct gn_shape *shape, const float position[3], const float normal[3],
                           float u, float v) {
    float scale = shape->uv_per_m != 0 ? shape->uv_per_m : 1;
    return gn_shape_vertex(shape, position, normal, (float[2]){u / scale, v / scale});
}

/* Two triangles for each cell of a grid of vertices that starts at `first`, with `across` columns
 * and `up` rows of cells: row r, column c is vertex first + r * (across + 1) + c. */
static void weave(struct gn_shape *shape, uint32_t first, int across, int up) {
    for (int r = 0; r < up; r++)
        for (int c = 0; c < across; c++) {
            uint32_t a = first + (uint32_t)(r * (across + 1) + c), d = a + (uint32_t)across + 1;
            gn_shape_triangle(shape, a, a + 1, d + 1);
            gn_shape_triangle(shape, a, d + 1, d);
        }
}

/* ---- flat things ---- */

/* One side of a box: its normal is `axis` (0..2) times `sign`. */
static void box_side(struct gn_shape *shape, const float half[3], int axis, float sign) {
    int u = (axis + 1) % 3, w = (axis + 2) % 3;
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int corner = 0; corner < 4; corner++) {
        float p[3], n[3] = {0};
        n[axis] = sign;
        p[axis] = sign * half[axis];
        p[u] = (corner == 1 || corner == 2 ? 1 : -1) * sign * half[u];
        p[w] = (corner >= 2 ? 1 : -1) * half[w];
        bool level = axis == 1;
        float uv[2] = {level ? p[2] : axis == 0 ? p[2] : p[0], level ? p[0] : p[1]};
        gn_shape_vertex(shape, p, n, uv);
    }
    gn_shape_triangle(shape, first, first + 1, first + 2);
    gn_shape_triangle(shape, first, first + 2, first + 3);
}

void gn_shape_box(struct gn_shape *shape, float sx, float sy, float sz) {
    float half[3] = {sx / 2, sy / 2, sz / 2};
    for (int side = 0; side < 6; side++) box_side(shape, half, side / 2, side % 2 ? -1 : 1);
}

void gn_shape_block(struct gn_shape *shape, float sx, float sy, float sz) {
    gn_shape_move(shape, 0, sy / 2, 0);
    gn_shape_box(shape, sx, sy, sz);
    gn_shape_move(shape, 0, -sy / 2, 0);
}

void gn_shape_plane(struct gn_shape *shape, float sx, float sz) {
    float half[3] = {sx / 2, 0, sz / 2};
    box_side(shape, half, 1, 1);
}

void gn_shape_card(struct gn_shape *shape, float sx, float sy) {
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int corner = 0; corner < 4; corner++) {
        float u = corner % 2 ? 1 : 0, up = corner / 2 ? 1 : 0;
        raw_vertex(shape, (float[3]){(u - 0.5f) * sx, up * sy, 0}, (float[3]){0, 0, 1}, u, 1 - up);
    }
    weave(shape, first, 1, 1);
}

static void on_circle(int step, int around, float radius, float height, float out[3]) {
    float angle = TURN * (float)(step % around) / (float)around;
    out[0] = radius * cosf(angle);
    out[1] = height;
    out[2] = -radius * sinf(angle);
}

void gn_shape_paving(struct gn_shape *shape, float inner, float outer, int courses, int around) {
    float width = (outer - inner) / (float)courses;
    for (int course = 0; course < courses; course++) {
        float near = inner + width * (float)course;
        float stones = TURN * (near + width / 2) / (1.25f * width);
        float repeats = fmaxf(1, roundf(stones / 4)), shift = 0.37f * (float)course;
        uint32_t first = (uint32_t)shape->vertex_count;
        for (int row = 0; row < 2; row++)
            for (int i = 0; i <= around; i++) {
                float p[3], v = 0.25f * (float)(course % 4 + 1 - row);
                on_circle(i, around, row ? near : near + width, 0, p);
                raw_vertex(shape, p, (float[3]){0, 1, 0},
                           shift + repeats * (float)i / (float)around, v);
            }
        weave(shape, first, around, 1);
    }
}

void gn_shape_ring(struct gn_shape *shape, float inner, float outer, int around) {
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int row = 0; row < 2; row++)
        for (int i = 0; i <= around; i++) {
            float p[3];
            on_circle(i, around, row ? inner : outer, 0, p);
            gn_shape_vertex(shape, p, (float[3]){0, 1, 0}, (float[2]){p[0], p[2]});
        }
    weave(shape, first, around, 1);
}

/* ---- round things ---- */

struct sweep {
    float from, to; /* radians from +x towards -z */
    int around;
    float u; /* texture width of the whole sweep, metres */
};

static uint32_t sweep_row(struct gn_shape *shape, const struct sweep *s, const float point[2],
                          const float normal[2], float v) {
    uint32_t first = (uint32_t)shape->vertex_count;
    bool whole = fabsf(s->to - s->from - TURN) < 1e-4f;
    for (int i = 0; i <= s->around; i++) {
        float t = (float)i / (float)s->around,
              angle = s->from + (whole && i == s->around ? 0 : t * (s->to - s->from));
        float c = cosf(angle), n = sinf(angle);
        gn_shape_vertex(shape, (float[3]){point[0] * c, point[1], -point[0] * n},
                        (float[3]){normal[0] * c, normal[1], -normal[0] * n},
                        (float[2]){t * s->u, v});
    }
    return first;
}

static void sweep_band(struct gn_shape *shape, uint32_t low, uint32_t high, int around,
                       bool low_point, bool high_point) {
    for (uint32_t i = 0; i < (uint32_t)around; i++) {
        if (!low_point) gn_shape_triangle(shape, low + i, low + i + 1, high + i + 1);
        if (!high_point) gn_shape_triangle(shape, low + i, high + i + 1, high + i);
    }
}

/* Outward normal of the profile segment that starts at point `a`. */
static void segment_normal(const float a[2], const float b[2], float out[2]) {
    float dr = b[0] - a[0], dy = b[1] - a[1], length = hypotf(dr, dy);
    out[0] = dy / length;
    out[1] = -dr / length;
}

static void revolve(struct gn_shape *shape, const struct sweep *s, const float (*profile)[2],
                    int points) {
    float normal[2], next[2] = {0}, v = 0;
    segment_normal(profile[0], profile[1], normal);
    uint32_t low = sweep_row(shape, s, profile[0], normal, v);
    for (int i = 1; i < points; i++) {
        const float *a = profile[i - 1], *b = profile[i];
        bool last = i == points - 1;
        v += hypotf(b[0] - a[0], b[1] - a[1]);
        segment_normal(a, b, normal);
        if (!last) segment_normal(b, profile[i + 1], next);
        bool smooth = !last && normal[0] * next[0] + normal[1] * next[1] > CREASE_COS;
        float mean[2] = {normal[0] + next[0], normal[1] + next[1]};
        uint32_t high = sweep_row(shape, s, b, smooth ? mean : normal, v);
        sweep_band(shape, low, high, s->around, a[0] < 1e-6f, b[0] < 1e-6f);
        low = last || smooth ? high : sweep_row(shape, s, b, next, v);
    }
}

static float widest(const float (*profile)[2], int points) {
    float radius = 0;
    for (int i = 0; i < points; i++) radius = fmaxf(radius, profile[i][0]);
    return radius;
}

void gn_shape_lathe(struct gn_shape *shape, const float (*profile)[2], int points, int around) {
    float scale = shape->uv_per_m != 0 ? shape->uv_per_m : 1;
    float repeats = fmaxf(1, roundf(TURN * widest(profile, points) * scale));
    revolve(shape, &(struct sweep){0, TURN, around, repeats / scale}, profile, points);
}

static void arc_end(struct gn_shape *shape, const float (*profile)[2], int points, float angle,
                    bool last) {
    float c = cosf(angle), s = sinf(angle), side = last ? -1 : 1;
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int i = 0; i < points; i++)
        gn_shape_vertex(shape, (float[3]){profile[i][0] * c, profile[i][1], -profile[i][0] * s},
                        (float[3]){side * s, 0, side * c}, profile[i]);
    for (uint32_t i = 2; i < (uint32_t)points; i++)
        gn_shape_triangle(shape, first, first + (last ? i : i - 1), first + (last ? i - 1 : i));
}

void gn_shape_arc(struct gn_shape *shape, const float (*profile)[2], int points, float from,
                  float to, int around) {
    float closed[32][2];
    assert(points < 32);
    memcpy(closed, profile, (size_t)points * sizeof *profile);
    memcpy(closed[points], profile[0], sizeof *profile);
    struct sweep s = {from * TURN / 360, to * TURN / 360, around, 0};
    s.u = (s.to - s.from) * widest(profile, points);
    revolve(shape, &s, closed, points + 1);
    arc_end(shape, profile, points, s.from, false);
    arc_end(shape, profile, points, s.to, true);
}

void gn_shape_cylinder(struct gn_shape *shape, float radius, float height, int around) {
    const float profile[][2] = {{0, 0}, {radius, 0}, {radius, height}, {0, height}};
    gn_shape_lathe(shape, profile, 4, around);
}

void gn_shape_sphere(struct gn_shape *shape, float radius, int around, int down) {
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int row = 0; row <= down; row++)
        for (int i = 0; i <= around; i++) {
            float latitude = TURN / 2 * ((float)row / (float)down - 0.5f), n[3], p[3];
            bool pole = row == 0 || row == down;
            on_circle(i, around, pole ? 0 : cosf(latitude), sinf(latitude), n);
            for (int c = 0; c < 3; c++) p[c] = radius * n[c];
            float uv[2] = {TURN * radius * (float)i / (float)around, radius * latitude};
            gn_shape_vertex(shape, p, n, uv);
        }
    for (int row = 0; row < down; row++) {
        uint32_t low = first + (uint32_t)(row * (around + 1));
        sweep_band(shape, low, low + (uint32_t)around + 1, around, row == 0, row == down - 1);
    }
}

void gn_shape_torus(struct gn_shape *shape, float major, float minor, int around, int section) {
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int row = 0; row <= section; row++)
        for (int i = 0; i <= around; i++) {
            float angle = TURN * (float)(row % section) / (float)section, p[3], n[3];
            on_circle(i, around, major + minor * cosf(angle), minor * sinf(angle), p);
            on_circle(i, around, cosf(angle), sinf(angle), n);
            gn_shape_vertex(shape, p, n,
                            (float[2]){TURN * major * (float)i / (float)around, minor * angle});
        }
    weave(shape, first, around, section);
}

/* ---- bars ---- */

static void minus(const float a[3], const float b[3], float out[3]) {
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

static void cross(const float a[3], const float b[3], float out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(float v[3]) {
    float length = sqrtf(dot(v, v));
    for (int i = 0; i < 3; i++) v[i] /= length;
}

/* Makes `side` perpendicular to `along`. Passed from ring to ring, it prevents a tube from
 * twisting.
 */
static void straighten(float side[3], const float along[3]) {
    float slip = dot(side, along);
    for (int i = 0; i < 3; i++) side[i] -= slip * along[i];
    unit(side);
}

struct ring {
    float at[3], along[3], side[3], radius, v;
};

static uint32_t tube_ring(struct gn_shape *shape, const struct ring *ring, int section, float cap) {
    uint32_t first = (uint32_t)shape->vertex_count;
    float other[3];
    cross(ring->along, ring->side, other);
    for (int i = 0; i <= section; i++) {
        float angle = TURN * (float)(i % section) / (float)section, n[3], p[3], end[3];
        for (int c = 0; c < 3; c++) {
            n[c] = cosf(angle) * ring->side[c] + sinf(angle) * other[c];
            p[c] = ring->at[c] + ring->radius * n[c];
            end[c] = cap * ring->along[c];
        }
        gn_shape_vertex(shape, p, cap != 0 ? end : n, (float[2]){ring->radius * angle, ring->v});
    }
    return first;
}

static void tube_cap(struct gn_shape *shape, const struct ring *ring, int section, float cap) {
    uint32_t first = tube_ring(shape, ring, section, cap);
    for (uint32_t i = 2; i < (uint32_t)section; i++)
        gn_shape_triangle(shape, first, first + (cap > 0 ? i - 1 : i),
                          first + (cap > 0 ? i : i - 1));
}

static void direction_at(const float (*points)[3], int count, int i, float out[3]) {
    minus(points[i + 1 < count ? i + 1 : i], points[i > 0 ? i - 1 : i], out);
    unit(out);
}

void gn_shape_tube(struct gn_shape *shape, const float (*points)[3], int count, float radius,
                   int section) {
    struct ring ring = {.side = {0.36f, 0.48f, 0.8f}, .radius = radius};
    uint32_t below = 0;
    for (int i = 0; i < count; i++) {
        float step[3];
        minus(points[i], points[i ? i - 1 : 0], step);
        ring.v += sqrtf(dot(step, step));
        memcpy(ring.at, points[i], sizeof ring.at);
        direction_at(points, count, i, ring.along);
        straighten(ring.side, ring.along);
        if (i == 0) tube_cap(shape, &ring, section, -1);
        uint32_t row = tube_ring(shape, &ring, section, 0);
        if (i > 0) sweep_band(shape, below, row, section, false, false);
        below = row;
    }
    tube_cap(shape, &ring, section, 1);
}

void gn_shape_rod(struct gn_shape *shape, const float from[3], const float to[3], float radius,
                  int section) {
    float points[2][3];
    memcpy(points[0], from, sizeof points[0]);
    memcpy(points[1], to, sizeof points[1]);
    gn_shape_tube(shape, (const float(*)[3])points, 2, radius, section);
}

void gn_shape_arch(struct gn_shape *shape, float width, float post, float radius, int section) {
    enum { BEND = 16 };
    float points[BEND + 3][3] = {{-width / 2, 0, 0}};
    for (int i = 0; i <= BEND; i++) {
        float angle = TURN / 2 * (float)i / BEND;
        points[1 + i][0] = -width / 2 * cosf(angle);
        points[1 + i][1] = post + width / 2 * sinf(angle);
    }
    points[BEND + 2][0] = width / 2;
    gn_shape_tube(shape, (const float(*)[3])points, BEND + 3, radius, section);
}

static void knot_point(float u, float radius, float out[3]) {
    float turn = 3.0f / 2.0f * u;
    out[0] = radius * (2 + cosf(turn)) * 0.5f * cosf(u);
    out[1] = radius * (2 + cosf(turn)) * 0.5f * sinf(u);
    out[2] = radius * sinf(turn) * 0.5f;
}

void gn_shape_knot(struct gn_shape *shape, float radius, float tube, int tubular, int radial) {
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int i = 0; i <= tubular; i++) {
        float u = (float)(i % tubular) / (float)tubular * 2 * TURN, here[3], ahead[3], along[3],
              out[3], side[3];
        knot_point(u, radius, here);
        knot_point(u + 0.01f, radius, ahead);
        minus(ahead, here, along);
        for (int c = 0; c < 3; c++) out[c] = ahead[c] + here[c];
        cross(along, out, side);
        cross(side, along, out);
        unit(side);
        unit(out);
        for (int j = 0; j <= radial; j++) {
            float angle = TURN * (float)(j % radial) / (float)radial, p[3], n[3];
            for (int c = 0; c < 3; c++) {
                n[c] = -cosf(angle) * out[c] + sinf(angle) * side[c];
                p[c] = here[c] + tube * n[c];
            }
            raw_vertex(shape, p, n, (float)i / (float)tubular * 12, (float)j / (float)radial);
        }
    }
    for (int i = 0; i < tubular; i++)
        for (int j = 0; j < radial; j++) {
            uint32_t a = first + (uint32_t)(i * (radial + 1) + j), b = a + (uint32_t)radial + 1;
            gn_shape_triangle(shape, a, b, a + 1);
            gn_shape_triangle(shape, b, b + 1, a + 1);
        }
}
