#include "cost/raster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

enum {
    STEPS = 256,  /* of a pixel, in which corners are placed */
    BLOCK = 16,   /* pixels along a side of what is skipped as a whole */
    CORNERS = 12, /* of a clipped triangle: 3, and 1 for each plane */
};
#define GUARD 8.0 /* triangles are clipped so many half viewports off its middle */

static const int8_t places[3][4][2] = {/* of samples, sixteenths of a pixel off its middle */
                                       {{0, 0}},
                                       {{4, 4}, {-4, -4}},
                                       {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}};

static int place_kind(const struct gn_raster *r) { return r->samples == 4 ? 2 : r->samples - 1; }

void gn_raster_create(struct gn_raster *r, int width_px, int height_px, int samples) {
    *r = (struct gn_raster){.width_px = width_px, .height_px = height_px, .samples = samples};
    r->depth = gn_xalloc((size_t)width_px * (size_t)height_px * (size_t)samples, sizeof *r->depth);
    r->viewport = r->scissor = (struct gn_raster_rect){0, 0, width_px, height_px};
    gn_raster_clear(r, &r->viewport);
}

void gn_raster_destroy(struct gn_raster *r) {
    free(r->depth);
    r->depth = NULL;
}

void gn_raster_clear(struct gn_raster *r, const struct gn_raster_rect *rect) {
    const size_t samples = (size_t)r->samples, row = (size_t)r->width_px * samples;
    for (int y = rect->y; y < rect->y + rect->height; y++) {
        float *first = r->depth + (size_t)y * row + (size_t)rect->x * samples;
        for (size_t i = 0; i < (size_t)rect->width * samples; i++) first[i] = 1.0f;
    }
}

/* ---- clipping ---- */

/* How far inside a plane: near, far, left, right, below, above. */
static double inside(const struct gn_raster_vertex *v, int plane) {
    const double *c = v->clip, limit = plane < 2 ? c[3] : GUARD * c[3];
    const double along = c[plane < 2 ? 2 : plane < 4 ? 0 : 1];
    return plane % 2 ? limit - along : limit + along;
}

static struct gn_raster_vertex between(const struct gn_raster_vertex *a,
                                       const struct gn_raster_vertex *b, double t) {
    struct gn_raster_vertex v;
    for (int k = 0; k < 4; k++) v.clip[k] = a->clip[k] + t * (b->clip[k] - a->clip[k]);
    for (int k = 0; k < 3; k++)
        v.attributes[k] = a->attributes[k] + t * (b->attributes[k] - a->attributes[k]);
    return v;
}

/* Sutherland and Hodgman 1974. */
static int clip_polygon(struct gn_raster_vertex *v, int count) {
    for (int plane = 0; plane < 6; plane++) {
        struct gn_raster_vertex out[CORNERS];
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const struct gn_raster_vertex *a = &v[i], *b = &v[(i + 1) % count];
            const double at = inside(a, plane), to = inside(b, plane);
            if (at >= 0) out[kept++] = *a;
            if ((at >= 0) != (to >= 0)) out[kept++] = between(a, b, at / (at - to));
        }
        memcpy(v, out, (size_t)kept * sizeof *v);
        count = kept;
    }
    return count;
}

/* ---- a triangle on the screen ---- */

struct edge { /* e(x, y) = a x + b y + c in steps: inside where it is over 0 */
    int64_t a, b, c;
};
struct setup {
    struct edge edges[3];
    int64_t area;     /* twice, square steps */
    double z[3];      /* at 0, 0, and per pixel along x and y */
    double over_w[3]; /* at the corner opposite of each edge */
    double attributes[3][3];
    int64_t offsets[3][4]; /* of the samples, for each edge */
    int64_t pixels[3][4];  /* of a quad's pixels from the first */
    int64_t furthest[3];   /* the largest of a quad's samples, off the middle of its first pixel */
    double z_offsets[4];   /* of the samples */
    int least[2], end[2];  /* pixels, even */
};

/* On the edge counts as inside on the left and the top: of a triangle that winds counter-clockwise,
 * y up, where the edge goes down, or is level and goes to the left. */
static struct edge edge_of(const int64_t p[2], const int64_t q[2]) {
    struct edge e = {p[1] - q[1], q[0] - p[0], 0};
    e.c = -(e.a * p[0] + e.b * p[1]);
    const bool top_left = q[1] < p[1] || (q[1] == p[1] && q[0] < p[0]);
    if (!top_left) e.c -= 1;
    return e;
}

static void set_bounds(const struct gn_raster *r, int64_t p[3][2], struct setup *s) {
    const int first[2] = {r->scissor.x > r->viewport.x ? r->scissor.x : r->viewport.x,
                          r->scissor.y > r->viewport.y ? r->scissor.y : r->viewport.y};
    const int sizes[2][2] = {
        {r->scissor.x + r->scissor.width, r->viewport.x + r->viewport.width},
        {r->scissor.y + r->scissor.height, r->viewport.y + r->viewport.height}};
    for (int k = 0; k < 2; k++) {
        int64_t least = p[0][k], most = p[0][k];
        for (int i = 1; i < 3; i++) {
            least = p[i][k] < least ? p[i][k] : least;
            most = p[i][k] > most ? p[i][k] : most;
        }
        const int end = sizes[k][0] < sizes[k][1] ? sizes[k][0] : sizes[k][1];
        const int64_t from = (least - STEPS) / STEPS, to = (most + 2 * STEPS) / STEPS;
        s->least[k] = from > first[k] ? (int)from : first[k];
        s->end[k] = to < end ? (int)to : end;
    }
}

static void set_depth(const double p[3][2], const double z[3], struct setup *s) {
    const double x1 = p[1][0] - p[0][0], y1 = p[1][1] - p[0][1], x2 = p[2][0] - p[0][0],
                 y2 = p[2][1] - p[0][1], over = 1 / (x1 * y2 - x2 * y1);
    s->z[1] = ((z[1] - z[0]) * y2 - (z[2] - z[0]) * y1) * over;
    s->z[2] = ((z[2] - z[0]) * x1 - (z[1] - z[0]) * x2) * over;
    s->z[0] = z[0] - s->z[1] * p[0][0] - s->z[2] * p[0][1];
}

/* Of the samples and of a quad's pixels for edge i, and the largest of both. */
static void set_offsets(const struct gn_raster *r, struct setup *s, int i) {
    const struct edge *e = &s->edges[i];
    int64_t most = INT64_MIN;
    for (int k = 0; k < r->samples; k++) {
        const int8_t *place = places[place_kind(r)][k];
        s->offsets[i][k] = (e->a * place[0] + e->b * place[1]) * (STEPS / 16);
        most = s->offsets[i][k] > most ? s->offsets[i][k] : most;
    }
    for (int k = 0; k < 4; k++) s->pixels[i][k] = STEPS * (k % 2 * e->a + k / 2 * e->b);
    s->furthest[i] = most + STEPS * ((e->a > 0 ? e->a : 0) + (e->b > 0 ? e->b : 0));
}

/* False: it has no area, or the side that is left out is seen. */
static bool set_up(const struct gn_raster *r, const struct gn_raster_vertex *const v[3],
                   struct setup *s) {
    int64_t p[3][2];
    double at[3][2], z[3];
    for (int i = 0; i < 3; i++) {
        const double *c = v[i]->clip;
        const double half[2] = {0.5 * r->viewport.width, 0.5 * r->viewport.height};
        p[i][0] = llround((r->viewport.x + half[0] * (c[0] / c[3] + 1)) * STEPS);
        p[i][1] = llround((r->viewport.y + half[1] * (c[1] / c[3] + 1)) * STEPS);
        for (int k = 0; k < 2; k++) at[i][k] = (double)p[i][k] / STEPS;
        z[i] = 0.5 * (c[2] / c[3]) + 0.5;
    }
    s->area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
    const bool front = (s->area > 0) != r->mirrored;
    if (s->area == 0 || (r->cull == GN_RASTER_CULL_BACK && !front) ||
        (r->cull == GN_RASTER_CULL_FRONT && front))
        return false;
    const int order[3] = {0, s->area > 0 ? 1 : 2, s->area > 0 ? 2 : 1};
    set_depth((const double(*)[2])at, z, s);
    set_bounds(r, p, s);
    for (int i = 0; i < 3; i++) {
        const int from = order[(i + 1) % 3], to = order[(i + 2) % 3];
        s->edges[i] = edge_of(p[from], p[to]);
        s->over_w[i] = 1 / v[order[i]]->clip[3];
        memcpy(s->attributes[i], v[order[i]]->attributes, sizeof s->attributes[i]);
        set_offsets(r, s, i);
    }
    for (int k = 0; k < r->samples; k++) {
        const int8_t *place = places[place_kind(r)][k];
        s->z_offsets[k] = (s->z[1] * place[0] + s->z[2] * place[1]) / 16.0;
    }
    return true;
}

/* ---- its pixels ---- */

static bool has_hole(const struct gn_raster *r, const struct setup *s, const int64_t e[3]) {
    double weights[3], sum = 0, attributes[3] = {0};
    for (int i = 0; i < 3; i++) sum += weights[i] = (double)e[i] * s->over_w[i];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) attributes[k] += weights[i] / sum * s->attributes[i][k];
    return r->is_hole(r->context, attributes);
}

/* Returns whether a sample of the pixel is in front; e: of its middle. */
static bool draw_pixel(struct gn_raster *r, const struct setup *s, int x, int y, const int64_t e[3],
                       bool *reached) {
    float *depth = r->depth + ((size_t)y * (size_t)r->width_px + (size_t)x) * (size_t)r->samples;
    const double middle = s->z[0] + s->z[1] * (x + 0.5) + s->z[2] * (y + 0.5);
    bool shown = false, hole = false;
    for (int k = 0; k < r->samples; k++) {
        if (((e[0] + s->offsets[0][k]) | (e[1] + s->offsets[1][k]) | (e[2] + s->offsets[2][k])) < 0)
            continue; /* one of them is */
        *reached = true;
        const double at = middle + s->z_offsets[k];
        const float z = at < 0 ? 0 : at > 1 ? 1 : (float)at;
        if (r->tests_depth && z > depth[k]) continue;
        if (!shown && r->is_hole) hole = has_hole(r, s, e);
        shown = true;
        if (r->writes_depth && r->tests_depth && !hole) depth[k] = z;
    }
    return shown;
}

/* e: of the middle of its first pixel. */
static void draw_quad(struct gn_raster *r, const struct setup *s, int x, int y,
                      const int64_t first[3], bool *reached) {
    int shown = 0;
    for (int i = 0; i < 4; i++) {
        const int px = x + i % 2, py = y + i / 2;
        if (px < s->least[0] || px >= s->end[0] || py < s->least[1] || py >= s->end[1]) continue;
        int64_t e[3];
        for (int k = 0; k < 3; k++) e[k] = first[k] + s->pixels[k][i];
        shown += draw_pixel(r, s, px, py, e, reached);
    }
    r->count.pixels += (uint64_t)shown;
    r->count.lanes += shown > 0 ? 4 : 0;
}

/* Whether samples of a quad may be inside: none is where an edge is under 0 at the sample that is
 * furthest inside of it. */
static bool reaches_quad(const struct setup *s, const int64_t first[3]) {
    return ((first[0] + s->furthest[0]) | (first[1] + s->furthest[1]) |
            (first[2] + s->furthest[2])) >= 0;
}

/* The quads of a row from x to right. */
static void draw_row(struct gn_raster *r, const struct setup *s, int x, int right, int y,
                     bool *reached) {
    int64_t e[3];
    for (int k = 0; k < 3; k++)
        e[k] = s->edges[k].a * (x * STEPS + STEPS / 2) + s->edges[k].b * (y * STEPS + STEPS / 2) +
               s->edges[k].c;
    for (; x < right; x += 2) {
        if (reaches_quad(s, e)) draw_quad(r, s, x, y, e, reached);
        for (int k = 0; k < 3; k++) e[k] += 2 * STEPS * s->edges[k].a;
    }
}

/* Whether the triangle may reach pixels of a block: the greatest of each edge is at one corner. */
static bool reaches(const struct setup *s, int x, int y) {
    for (int k = 0; k < 3; k++) {
        const struct edge *e = &s->edges[k];
        const int64_t at[2] = {(e->a > 0 ? x + BLOCK : x) * (int64_t)STEPS,
                               (e->b > 0 ? y + BLOCK : y) * (int64_t)STEPS};
        if (e->a * at[0] + e->b * at[1] + e->c < 0) return false;
    }
    return true;
}

static void draw_triangle(struct gn_raster *r, const struct gn_raster_vertex *const v[3]) {
    struct setup s;
    bool reached = false;
    if (!set_up(r, v, &s)) return;
    for (int y = s.least[1] & ~(BLOCK - 1); y < s.end[1]; y += BLOCK)
        for (int x = s.least[0] & ~(BLOCK - 1); x < s.end[0]; x += BLOCK) {
            if (!reaches(&s, x, y)) continue;
            const int top = y + BLOCK < s.end[1] ? y + BLOCK : s.end[1],
                      right = x + BLOCK < s.end[0] ? x + BLOCK : s.end[0];
            for (int qy = y > s.least[1] ? y : s.least[1] & ~1; qy < top; qy += 2)
                draw_row(r, &s, x > s.least[0] ? x : s.least[0] & ~1, right, qy, &reached);
        }
    r->count.triangles += reached;
}

void gn_raster_triangle(struct gn_raster *r, const struct gn_raster_vertex corners[3]) {
    struct gn_raster_vertex v[CORNERS];
    int outside = 0;
    memcpy(v, corners, 3 * sizeof *v);
    for (int plane = 0; plane < 6; plane++)
        for (int i = 0; i < 3; i++) outside |= !(inside(&v[i], plane) >= 0);
    const int count = outside ? clip_polygon(v, 3) : 3;
    for (int i = 1; i + 1 < count; i++)
        draw_triangle(r, (const struct gn_raster_vertex *const[]){&v[0], &v[i], &v[i + 1]});
}
