/* How far a level is from its mesh: of samples of the vertices that it lacks, the nearest place on
 * it; then what the two show there, in each of some poses. */
#include <cglm/cglm.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "scene/level.h"
#include "scene/poses.h"

enum {
    SAMPLES = 500,
    POSED_SAMPLES = 250, /* of what is deformed */
    POSES = 4,           /* of a clip */
    CLIPS = 16,          /* that are looked at; scenes of more have no levels of what they deform */
    CELLS_MOST = 48,     /* of the grid, along each axis */
};
#define OVER   .05f /* of the samples, may be over it */
#define FAR    4.0f /* but none by more than this factor */
/* Of a pixel that is allowed, what a texture may slide and a normal may be off: they are seen less
 * than an outline. */
#define SLIDES 2.0f
#define TURNS  4.0f

struct sample {
    uint32_t vertex, corners[3]; /* of the triangle that is nearest */
    float shares[3];             /* of the corners, there */
    bool lost;                   /* there is none within most_m */
};
struct needs { /* what of a vertex its materials show */
    bool uv[2], tangents, colors;
};
struct gn_level_measure {
    const struct gn_scene *scene;
    const atomic_bool *cancel;
    uint8_t *in_level; /* by vertex of the scene */
    struct sample samples[SAMPLES];
    float errors[SAMPLES];
    uint32_t count;
    float most_m;
    struct gn_pose pose;
    bool has_pose;
};
struct grid { /* the triangles of a level, by cells that their boxes touch */
    const float *positions;
    const uint32_t *corners;
    vec3 origin, per_m; /* cells */
    float least_m;      /* side of a cell */
    int size[3];
    uint32_t *first, *triangles; /* by cell; of all */
};

static const float *position_of(const struct gn_scene *scene, uint32_t vertex) {
    return scene->buffers.positions + 3 * (size_t)vertex;
}

struct gn_level_measure *gn_level_measure_create(const struct gn_scene *scene,
                                                 const atomic_bool *cancel) {
    struct gn_level_measure *m = gn_xalloc(1, sizeof *m);
    m->scene = scene;
    m->cancel = cancel;
    m->in_level = gn_xalloc(scene->buffers.vertex_count, sizeof *m->in_level);
    return m;
}

void gn_level_measure_destroy(struct gn_level_measure *m) {
    if (!m) return;
    if (m->has_pose) gn_pose_finish(&m->pose);
    free(m->in_level);
    free(m);
}

/* ---- a grid ---- */

static int cell_of(const struct grid *g, float x, int axis) {
    const float cell = (x - g->origin[axis]) * g->per_m[axis];
    return cell < 1 ? 0 : cell >= (float)g->size[axis] ? g->size[axis] - 1 : (int)cell;
}

static size_t cell_index(const struct grid *g, const int cell[3]) {
    return ((size_t)cell[2] * (size_t)g->size[1] + (size_t)cell[1]) * (size_t)g->size[0] +
           (size_t)cell[0];
}

/* Counts triangles into first[cell + 1], or, once those are sums, puts them there. */
static void lay_triangles(struct grid *g, size_t count, bool puts) {
    for (uint32_t t = 0; t < count / 3; t++) {
        int from[3], to[3], at[3];
        for (int k = 0; k < 3; k++) {
            float least = FLT_MAX, most = -FLT_MAX;
            for (int c = 0; c < 3; c++) {
                const float x =
                    g->positions[3 * (size_t)g->corners[3 * t + (uint32_t)c] + (size_t)k];
                least = fminf(least, x);
                most = fmaxf(most, x);
            }
            from[k] = cell_of(g, least, k);
            to[k] = cell_of(g, most, k);
        }
        for (at[2] = from[2]; at[2] <= to[2]; at[2]++)
            for (at[1] = from[1]; at[1] <= to[1]; at[1]++)
                for (at[0] = from[0]; at[0] <= to[0]; at[0]++) {
                    uint32_t *first = &g->first[cell_index(g, at)];
                    if (puts)
                        g->triangles[first[0]++] = t;
                    else
                        first[1]++;
                }
    }
}

static void build_grid(struct grid *g, const struct gn_box *box, size_t count) {
    const float most = (float)CELLS_MOST;
    float widest = 0;
    for (int k = 0; k < 3; k++) widest = fmaxf(widest, box->max[k] - box->min[k]);
    const float cells = fminf(most, fmaxf(1, sqrtf((float)count / 6)));
    g->least_m = widest / cells;
    for (int k = 0; k < 3; k++) {
        g->origin[k] = box->min[k];
        g->per_m[k] = g->least_m > 0 ? 1 / g->least_m : 0;
        g->size[k] = 1 + (int)fminf(most, (box->max[k] - box->min[k]) * g->per_m[k]);
    }
    const size_t all = (size_t)g->size[0] * (size_t)g->size[1] * (size_t)g->size[2];
    g->first = gn_xalloc(all + 1, sizeof *g->first);
    lay_triangles(g, count, false);
    for (size_t i = 0; i < all; i++) g->first[i + 1] += g->first[i];
    g->triangles = gn_xalloc(g->first[all] + 1, sizeof *g->triangles);
    lay_triangles(g, count, true);
    memmove(g->first + 1, g->first, all * sizeof *g->first);
    g->first[0] = 0;
}

/* Shares of a triangle's corners at its place nearest to p: Ericson, Real-Time Collision Detection
 * (2005), 5.1.5. */
static void nearest_shares(const float *p, const float *a, const float *b, const float *c,
                           float out[3]) {
    vec3 ab, ac, ap, bp, cp;
    glm_vec3_sub((float *)b, (float *)a, ab);
    glm_vec3_sub((float *)c, (float *)a, ac);
    glm_vec3_sub((float *)p, (float *)a, ap);
    glm_vec3_sub((float *)p, (float *)b, bp);
    glm_vec3_sub((float *)p, (float *)c, cp);
    const float d1 = glm_vec3_dot(ab, ap), d2 = glm_vec3_dot(ac, ap), d3 = glm_vec3_dot(ab, bp),
                d4 = glm_vec3_dot(ac, bp), d5 = glm_vec3_dot(ab, cp), d6 = glm_vec3_dot(ac, cp);
    const float va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    float v = 0, w = 0;
    if (d1 <= 0 && d2 <= 0) {
    } else if (d3 >= 0 && d4 <= d3)
        v = 1;
    else if (vc <= 0 && d1 >= 0 && d3 <= 0)
        v = d1 / (d1 - d3);
    else if (d6 >= 0 && d5 <= d6)
        w = 1;
    else if (vb <= 0 && d2 >= 0 && d6 <= 0)
        w = d2 / (d2 - d6);
    else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        w = (d4 - d3) / ((d4 - d3) + (d5 - d6)), v = 1 - w;
    else if (va + vb + vc > 0)
        v = vb / (va + vb + vc), w = vc / (va + vb + vc);
    out[0] = 1 - v - w;
    out[1] = v;
    out[2] = w;
}

/* ---- what is different there ---- */

/* What of a vertex' values the corners do not have. */
static float difference(const struct sample *s, const float *values, int stride, int count) {
    float sum = 0;
    for (int k = 0; k < count; k++) {
        float d = values[(size_t)s->vertex * (size_t)stride + (size_t)k];
        for (int c = 0; c < 3; c++)
            d -= s->shares[c] * values[(size_t)s->corners[c] * (size_t)stride + (size_t)k];
        sum += d * d;
    }
    return sqrtf(sum);
}

static float color_difference(const struct sample *s, const uint8_t *colors) {
    float most = 0;
    for (size_t k = 0; k < 4; k++) {
        float d = colors[4 * (size_t)s->vertex + k];
        for (int c = 0; c < 3; c++)
            d -= s->shares[c] * (float)colors[4 * (size_t)s->corners[c] + k];
        most = fmaxf(most, fabsf(d) / 255);
    }
    return most;
}

/* How far a texture slides: metres of a unit of its coordinates, on this triangle. */
static float slide(const struct sample *s, const float *uv, float area) {
    const float *a = uv + 2 * (size_t)s->corners[0], *b = uv + 2 * (size_t)s->corners[1],
                *c = uv + 2 * (size_t)s->corners[2];
    const float apart = difference(s, uv, 2, 2),
                texels = .5f * fabsf((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    if (apart < 1e-6f) return 0;
    return texels > 0 ? apart * sqrtf(area / texels) : INFINITY;
}

/* place: of the vertex and the three corners; *moved: how far the vertex is from its place. From
 * `most` on it need not be exact. */
static float error_of(const struct gn_scene_buffers *b, const struct needs *needs,
                      const struct sample *s, float most, vec3 place[4], float *moved) {
    vec3 ab, ac, normal, there = {0};
    glm_vec3_sub(place[2], place[1], ab);
    glm_vec3_sub(place[3], place[1], ac);
    glm_vec3_cross(ab, ac, normal);
    for (int c = 0; c < 3; c++) glm_vec3_muladds(place[1 + c], s->shares[c], there);
    const float area = .5f * glm_vec3_norm(normal), width = sqrtf(area);
    float error = *moved = glm_vec3_distance(place[0], there);
    if (error >= most) return error;
    if (b->normals) error = fmaxf(error, width * difference(s, b->normals, 3, 3) / TURNS);
    if (needs->tangents && b->tangents)
        error = fmaxf(error, width * difference(s, b->tangents, 4, 4) / TURNS);
    if (needs->colors) error = fmaxf(error, width * color_difference(s, b->colors) / TURNS);
    if (needs->uv[0] && b->uv0) error = fmaxf(error, slide(s, b->uv0, area) / SLIDES);
    if (needs->uv[1] && b->uv1) error = fmaxf(error, slide(s, b->uv1, area) / SLIDES);
    return error;
}

/* ---- the place of a vertex ---- */

/* A place that is nearer than another, but of the other side of a seam, is not what the vertex was:
 * the least error counts. */
static void look_in_cell(const struct grid *g, const struct gn_scene *scene,
                         const struct needs *needs, const int cell[3], struct sample *s,
                         float *least) {
    const float *p = position_of(scene, s->vertex);
    const size_t at = cell_index(g, cell);
    vec3 place[4];
    for (uint32_t i = g->first[at]; i < g->first[at + 1]; i++) {
        const uint32_t *corner = g->corners + 3 * (size_t)g->triangles[i];
        const float *a = position_of(scene, corner[0]), *b = position_of(scene, corner[1]),
                    *c = position_of(scene, corner[2]);
        struct sample try = {.vertex = s->vertex, .corners = {corner[0], corner[1], corner[2]}};
        float moved;
        nearest_shares(p, a, b, c, try.shares);
        for (int k = 0; k < 4; k++)
            memcpy(place[k], k == 0 ? p : position_of(scene, corner[k - 1]), sizeof place[k]);
        const float error = error_of(&scene->buffers, needs, &try, *least, place, &moved);
        if (error >= *least) continue;
        *least = error;
        *s = try;
    }
}

/* Ring by ring of cells. */
static void find_nearest(const struct grid *g, const struct gn_scene *scene,
                         const struct needs *needs, float most_m, struct sample *s) {
    const float *p = position_of(scene, s->vertex);
    float least = most_m;
    int middle[3], at[3];
    for (int k = 0; k < 3; k++) middle[k] = cell_of(g, p[k], k);
    for (int ring = 0; ring <= CELLS_MOST; ring++) {
        const float reached = (float)(ring - 1) * g->least_m;
        if (reached >= least) break;
        for (at[2] = middle[2] - ring; at[2] <= middle[2] + ring; at[2]++)
            for (at[1] = middle[1] - ring; at[1] <= middle[1] + ring; at[1]++)
                for (at[0] = middle[0] - ring; at[0] <= middle[0] + ring; at[0]++) {
                    int off = 0;
                    bool inside = true;
                    for (int k = 0; k < 3; k++) {
                        off = abs(at[k] - middle[k]) > off ? abs(at[k] - middle[k]) : off;
                        inside &= at[k] >= 0 && at[k] < g->size[k];
                    }
                    if (off == ring && inside) look_in_cell(g, scene, needs, at, s, &least);
                }
    }
    s->lost = least >= most_m;
}

static int compare_floats(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* item: UINT32_MAX: mesh space; else where the pose has it. */
static float measure_samples(struct gn_level_measure *m, const struct needs *needs, uint32_t item) {
    float most = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        const struct sample *s = &m->samples[i];
        vec3 place[4];
        float moved;
        for (int k = 0; k < 4; k++) {
            const uint32_t vertex = k == 0 ? s->vertex : s->corners[k - 1];
            if (item == UINT32_MAX)
                memcpy(place[k], position_of(m->scene, vertex), sizeof place[k]);
            else
                gn_pose_corner(&m->pose, item, vertex, place[k]);
        }
        m->errors[i] = moved = item == UINT32_MAX ? m->most_m : INFINITY;
        if (!s->lost)
            m->errors[i] = error_of(&m->scene->buffers, needs, s, INFINITY, place, &moved);
        most = fmaxf(most, moved);
    }
    if (m->count == 0) return 0;
    qsort(m->errors, m->count, sizeof *m->errors, compare_floats);
    return fmaxf(most / FAR, m->errors[(uint32_t)((1 - OVER) * (float)(m->count - 1))]);
}

/* ---- samples, poses ---- */

static struct needs find_needs(const struct gn_scene *scene, uint32_t geometry, bool *deformed) {
    struct needs needs = {.colors =
                              gn_geometry_has(&scene->geometries[geometry], GN_ATTRIBUTE_COLOR) &&
                              scene->buffers.colors};
    *deformed = false;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        const struct gn_material *material = &scene->materials[item->material];
        if (item->geometry != geometry) continue;
        *deformed |= gn_item_is_deformed(item);
        for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
            if (material->textures[slot].texture >= 0)
                needs.uv[material->textures[slot].uv_set ? 1 : 0] = true;
        needs.tangents |= material->textures[GN_TEXTURE_NORMAL].texture >= 0;
    }
    return needs;
}

/* Even over the vertices that the level lacks. */
static void take_samples(struct gn_level_measure *m, const struct gn_geometry *geometry,
                         const struct needs *needs, const struct grid *grid, size_t count,
                         uint32_t most) {
    const uint32_t *whole = m->scene->buffers.indices + geometry->first_index;
    enum { UNSEEN, IN_LEVEL, LACKS };
    for (uint32_t i = 0; i < geometry->index_count; i++) m->in_level[whole[i]] = UNSEEN;
    for (size_t i = 0; i < count; i++) m->in_level[grid->corners[i]] = IN_LEVEL;
    uint32_t lacks = 0, seen = 0;
    for (uint32_t i = 0; i < geometry->index_count; i++)
        if (m->in_level[whole[i]] == UNSEEN) m->in_level[whole[i]] = LACKS, lacks++;
    const uint32_t step = lacks > most ? (lacks + most - 1) / most : 1;
    m->count = 0;
    for (uint32_t i = 0; i < geometry->index_count; i++) {
        if (m->in_level[whole[i]] != LACKS) continue;
        m->in_level[whole[i]] = UNSEEN;
        if (seen++ % step > 0) continue;
        struct sample *s = &m->samples[m->count];
        *s = (struct sample){.vertex = whole[i]};
        find_nearest(grid, m->scene, needs, m->most_m, s);
        m->count++;
    }
}

/* Each clip by itself, and those that play together. */
static float measure_poses(struct gn_level_measure *m, const struct needs *needs,
                           uint32_t geometry) {
    const struct gn_scene *scene = m->scene;
    const int clips = (int)scene->animation.clip_count;
    float most = 0;
    for (int clip = GN_POSE_NONE; clip < clips; clip++) {
        if (m->has_pose)
            gn_pose_choose(&m->pose, clip);
        else
            gn_pose_init(&m->pose, scene, clip);
        m->has_pose = true;
        for (int p = 0; p < (clip == GN_POSE_NONE ? 1 : POSES); p++) {
            if (m->cancel && atomic_load(m->cancel)) return INFINITY;
            gn_poses_step(&m->pose, p, POSES);
            for (uint32_t i = 0; i < scene->item_count; i++)
                if (scene->items[i].geometry == geometry && gn_item_is_deformed(&scene->items[i]))
                    most = fmaxf(most, measure_samples(m, needs, i));
        }
    }
    return most;
}

float gn_level_error(struct gn_level_measure *m, uint32_t number, const uint32_t *corners,
                     size_t count, float known_m, float most_m) {
    const struct gn_geometry *geometry = &m->scene->geometries[number];
    struct grid grid = {.positions = m->scene->buffers.positions, .corners = corners};
    bool deformed;
    const struct needs needs = find_needs(m->scene, number, &deformed);
    if (deformed && m->scene->animation.clip_count > CLIPS) return INFINITY;
    build_grid(&grid, &geometry->box, count);
    m->most_m = most_m;
    take_samples(m, geometry, &needs, &grid, count, deformed ? POSED_SAMPLES : SAMPLES);
    free(grid.first);
    free(grid.triangles);
    /* a pose may have any scale, so nothing of mesh space holds there */
    return deformed ? measure_poses(m, &needs, number)
                    : fmaxf(known_m, measure_samples(m, &needs, UINT32_MAX));
}
