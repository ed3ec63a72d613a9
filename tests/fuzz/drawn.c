#include "drawn.h"

#include <cglm/cglm.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

struct corner {
    double position[3]; /* world space, less the scene's origin */
    double normal[3];   /* mesh space; posed by a skin, world space */
    float uv[2][2];
};
struct triangle {
    struct corner corners[3];
    double middle[3];
    uint32_t item;
};
/* Of an item: of what it is made of, and from world space to there. */
struct frame {
    double size, scale, mesh_from_world[3][3],
        largest; /* largest: coordinate in world space, for rounding */
};
struct drawn {
    const struct gn_scene *scene;
    struct gn_pose pose;
    struct triangle *triangles;
    struct frame *frames; /* by item */
    size_t count;
    bool posed;
};

/* ---- gathering ---- */

/* Mesh space. */
static void get_plain(const struct drawn *d, uint32_t item, uint32_t vertex, double out[3]) {
    const struct gn_geometry *g = &d->scene->geometries[d->scene->items[item].geometry];
    for (size_t k = 0; k < 3; k++)
        out[k] = (double)d->scene->buffers.positions[3 * (size_t)vertex + k] +
                 (g->origin ? g->origin[k] : 0);
}

/* Back to mesh space, of any length. */
static void unpose_normal(const mat4 world, double normal[3]) {
    double out[3] = {0};
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) out[c] += (double)world[c][r] * normal[r];
    memcpy(normal, out, sizeof out);
}

static void get_corner(const struct drawn *d, uint32_t item, uint32_t vertex, struct corner *out) {
    const struct gn_scene_buffers *b = &d->scene->buffers;
    const float *uvs[2] = {b->uv0, b->uv1};
    const bool deformed = gn_item_is_deformed(&d->scene->items[item]);
    gn_pose_vertex(&d->pose, item, vertex, out->position, out->normal);
    for (size_t k = 0; k < 3; k++) {
        out->position[k] += d->scene->place.origin[k];
        if (!deformed || !d->posed) out->normal[k] = (double)b->normals[3 * (size_t)vertex + k];
    }
    if (deformed && !d->posed) get_plain(d, item, vertex, out->position);
    if (deformed && d->posed && d->scene->items[item].skin < 0)
        unpose_normal(d->pose.items[item].world_from_item, out->normal);
    for (int set = 0; set < 2; set++)
        for (size_t k = 0; k < 2; k++)
            out->uv[set][k] = uvs[set] ? uvs[set][2 * (size_t)vertex + k] : 0;
}

static void add_item(struct drawn *d, uint32_t index) {
    const struct gn_item *item = &d->scene->items[index];
    const struct gn_geometry *g = &d->scene->geometries[item->geometry];
    if (!d->pose.items[index].visible || item->hidden_in & 1) return;
    for (uint32_t i = 0; i + 2 < g->index_count; i += 3) {
        struct triangle *t = &d->triangles[d->count++];
        *t = (struct triangle){.item = index};
        for (uint32_t c = 0; c < 3; c++) {
            get_corner(d, index, d->scene->buffers.indices[g->first_index + i + c], &t->corners[c]);
            for (int k = 0; k < 3; k++) t->middle[k] += t->corners[c].position[k] / 3;
        }
    }
}

static void gather(struct drawn *d, const struct gn_scene *scene, int64_t time_ns, bool posed) {
    size_t most = 0;
    d->scene = scene;
    d->posed = posed;
    gn_pose_init(&d->pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&d->pose, time_ns);
    for (uint32_t i = 0; i < scene->item_count; i++)
        most += scene->geometries[scene->items[i].geometry].index_count / 3;
    d->triangles = gn_xalloc(most + 1, sizeof *d->triangles);
    for (uint32_t i = 0; i < scene->item_count; i++) add_item(d, i);
}

/* ---- sizes ---- */

static void invert(const mat4 m, double out[3][3]) {
    double a[3][3], det = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) a[r][c] = (double)m[c][r];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            out[c][r] = a[(r + 1) % 3][(c + 1) % 3] * a[(r + 2) % 3][(c + 2) % 3] -
                        a[(r + 1) % 3][(c + 2) % 3] * a[(r + 2) % 3][(c + 1) % 3];
    for (int c = 0; c < 3; c++) det += a[0][c] * out[c][0];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) out[r][c] /= det;
}

static void widen(double low[3], double high[3], const double p[3]) {
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(low[k], p[k]);
        high[k] = fmax(high[k], p[k]);
    }
}

static void get_posed(const struct drawn *d, uint32_t item, uint32_t vertex,
                      double mesh_from_world[3][3], double out[3]) {
    double p[3];
    gn_pose_vertex(&d->pose, item, vertex, p, NULL);
    for (int r = 0; r < 3; r++)
        out[r] = mesh_from_world[r][0] * p[0] + mesh_from_world[r][1] * p[1] +
                 mesh_from_world[r][2] * p[2];
}

/* Of the drawn vertices of all items of a node and an instance, whose mesh is one: in its space; of
 * deformed ones as they are posed. */
static double measure_size(const struct drawn *d, uint32_t index, double mesh_from_world[3][3]) {
    const struct gn_scene *s = d->scene;
    const struct gn_item *of = &s->items[index];
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY},
           size = 0;
    for (uint32_t i = 0; i < s->item_count; i++) {
        const struct gn_geometry *g = &s->geometries[s->items[i].geometry];
        if (s->items[i].node != of->node || s->items[i].instance != of->instance) continue;
        for (uint32_t n = 0; n < g->index_count; n++) {
            const uint32_t v = s->buffers.indices[g->first_index + n];
            double p[3];
            if (gn_item_is_deformed(of) && d->posed)
                get_posed(d, i, v, mesh_from_world, p);
            else
                get_plain(d, i, v, p);
            widen(low, high, p);
        }
    }
    for (int k = 0; k < 3; k++) size = fmax(size, high[k] - low[k]);
    return size;
}

static void make_frames(struct drawn *d) {
    d->frames = gn_xalloc(d->scene->item_count + 1, sizeof *d->frames);
    for (uint32_t i = 0; i < d->scene->item_count; i++) {
        struct frame *f = &d->frames[i];
        const struct gn_item *item = &d->scene->items[i];
        const bool again =
            i > 0 && item[-1].node == item->node && item[-1].instance == item->instance;
        mat4 identity = GLM_MAT4_IDENTITY_INIT;
        const bool plain = gn_item_is_deformed(item) && (!d->posed || item->skin >= 0);
        vec4 *world = plain ? identity : d->pose.items[i].world_from_item;
        invert(world, f->mesh_from_world);
        f->size = again ? f[-1].size : measure_size(d, i, f->mesh_from_world);
        for (int c = 0; c < 3; c++)
            for (int r = 0; r < 3; r++) f->scale = fmax(f->scale, fabs((double)world[c][r]));
    }
    for (size_t i = 0; i < d->count; i++)
        for (int k = 0; k < 3; k++) {
            double *largest = &d->frames[d->triangles[i].item].largest;
            *largest = fmax(*largest, fabs(d->triangles[i].middle[k]) +
                                          d->frames[d->triangles[i].item].size *
                                              d->frames[d->triangles[i].item].scale);
        }
}

/* ---- a tree of the middles of triangles: the half before is not larger along the axis of its
 * depth, that behind not smaller ---- */

static int axis;
static int compare_middles(const void *a, const void *b) {
    const double x = ((const struct triangle *)a)->middle[axis],
                 y = ((const struct triangle *)b)->middle[axis];
    return (x > y) - (x < y);
}

static void make_tree(struct triangle *t, size_t count, int depth) {
    if (count < 2) return;
    axis = depth % 3;
    qsort(t, count, sizeof *t, compare_middles);
    make_tree(t, count / 2, depth + 1);
    make_tree(t + count / 2 + 1, count - count / 2 - 1, depth + 1);
}

struct search {
    const struct drawn *first, *second;
    const struct gn_drawn_promise *promise;
    const struct triangle *of;
    double radius, best;
    struct gn_drawn_promise errors;
    double tolerance[3]; /* of position, by axis of mesh space, beside the promise: what floats
                            round */
};

/* ---- comparing ---- */

static double angle_deg(const double a[3], const double b[3]) {
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    const double cross = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]),
                 dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return cross == 0 && dot == 0 ? 0 : atan2(cross, dot) * 180 / 3.14159265358979323846;
}

static double position_error(const struct search *s, const double a[3], const double b[3]) {
    const struct frame *f = &s->first->frames[s->of->item];
    double error = 0;
    for (int r = 0; r < 3; r++) {
        double moved = 0;
        for (int k = 0; k < 3; k++) moved += f->mesh_from_world[r][k] * (b[k] - a[k]);
        error = fmax(error, fmax(0, fabs(moved) - s->tolerance[r]));
    }
    return f->size > 0 ? error / f->size : error > 0 ? INFINITY : 0;
}

/* As the textures of the material read them: the length of the error, as a turned texture has it,
 * too, in that of (1, 1). */
static double uv_error(const struct search *s, const struct corner *a, const struct corner *b) {
    const struct gn_material *m =
        &s->first->scene->materials[s->first->scene->items[s->of->item].material];
    double largest = 0;
    for (int i = -2; i < GN_TEXTURE_SLOT_COUNT; i++) {
        static const float same[6] = {1, 0, 0, 1, 0, 0};
        const float *t = i < 0 ? same : m->textures[i].uv_from_uv;
        const int set = i < 0 ? i + 2 : m->textures[i].uv_set;
        double error[2];
        if (i >= 0 && m->textures[i].texture < 0) continue;
        for (int k = 0; k < 2; k++) {
            const double x[2] = {(double)t[k], (double)t[2 + k]};
            const double u = (double)a->uv[set][0], v = (double)a->uv[set][1];
            const double moved =
                x[0] * ((double)b->uv[set][0] - u) + x[1] * ((double)b->uv[set][1] - v);
            error[k] = fmax(0, fabs(moved) - 6e-8 * (fabs(x[0] * u) + fabs(x[1] * v)));
        }
        largest = fmax(largest, hypot(error[0], error[1]) / sqrt(2));
    }
    return largest;
}

static double share_of(const struct gn_drawn_promise *errors,
                       const struct gn_drawn_promise *promise) {
    return fmax(errors->position / promise->position,
                fmax(errors->normal_deg / promise->normal_deg, errors->uv / promise->uv));
}

static void try_triangle(struct search *s, const struct triangle *t) {
    const struct gn_item *item = &s->first->scene->items[s->of->item];
    const bool has_normals =
        gn_geometry_has(&s->first->scene->geometries[item->geometry], GN_ATTRIBUTE_NORMAL);
    if (s->second->scene->items[t->item].material != item->material) return;
    for (int turn = 0; turn < 3; turn++) {
        struct gn_drawn_promise e = {0};
        for (int c = 0; c < 3; c++) {
            const struct corner *a = &s->of->corners[c], *b = &t->corners[(c + turn) % 3];
            e.position = fmax(e.position, position_error(s, a->position, b->position));
            e.uv = fmax(e.uv, uv_error(s, a, b));
            if (has_normals) e.normal_deg = fmax(e.normal_deg, angle_deg(a->normal, b->normal));
        }
        if (share_of(&e, s->promise) >= s->best) continue;
        s->best = share_of(&e, s->promise);
        s->errors = e;
    }
}

static void search_tree(struct search *s, const struct triangle *t, size_t count, int depth) {
    const struct triangle *middle = t + count / 2;
    if (count == 0 || s->best <= .5) return;
    const double off = s->of->middle[depth % 3] - middle->middle[depth % 3];
    bool near = true;
    for (int k = 0; k < 3; k++) near &= fabs(s->of->middle[k] - middle->middle[k]) <= s->radius;
    if (near) try_triangle(s, middle);
    if (off <= s->radius) search_tree(s, t, count / 2, depth + 1);
    if (off >= -s->radius) search_tree(s, middle + 1, count - count / 2 - 1, depth + 1);
}

/* So thin that two of its corners may be the same where they are written. */
static bool is_flat(const struct triangle *t, double near) {
    bool flat = false;
    for (int c = 0; c < 3; c++) {
        double apart = 0;
        for (int k = 0; k < 3; k++)
            apart =
                fmax(apart, fabs(t->corners[c].position[k] - t->corners[(c + 1) % 3].position[k]));
        flat |= apart <= near;
    }
    return flat;
}

static void compare_triangle(struct search *s, struct gn_drawn_errors *out) {
    const struct frame *f = &s->first->frames[s->of->item];
    const double rounding = 4 * (double)FLT_EPSILON * f->largest,
                 allowed = 2 * f->scale * f->size * s->promise->position + rounding;
    for (int r = 0; r < 3; r++) {
        s->tolerance[r] = 0;
        for (int k = 0; k < 3; k++) s->tolerance[r] += fabs(f->mesh_from_world[r][k]) * rounding;
    }
    s->best = INFINITY;
    for (double wider = 2; wider <= 128 && s->best > 1; wider *= 8) {
        s->radius = wider * allowed;
        search_tree(s, s->second->triangles, s->second->count, 0);
    }
    out->triangles++;
    if (s->best > 1 && is_flat(s->of, 2 * allowed)) {
        out->flat++;
        return;
    }
    out->missing += s->best == INFINITY;
    out->share = fmax(out->share, s->best);
    if (s->best == INFINITY) return;
    out->largest.position = fmax(out->largest.position, s->errors.position);
    out->largest.normal_deg = fmax(out->largest.normal_deg, s->errors.normal_deg);
    out->largest.uv = fmax(out->largest.uv, s->errors.uv);
}

struct gn_drawn_errors gn_drawn_compare(const struct gn_scene *first, const struct gn_scene *second,
                                        int64_t time_ns, bool posed,
                                        const struct gn_drawn_promise *promise) {
    struct gn_drawn_errors out = {0};
    struct drawn a = {0}, b = {0};
    gather(&a, first, time_ns, posed);
    gather(&b, second, time_ns, posed);
    make_frames(&a);
    make_tree(b.triangles, b.count, 0);
    struct search s = {.first = &a, .second = &b, .promise = promise};
    for (size_t i = 0; i < a.count; i++) {
        s.of = &a.triangles[i];
        compare_triangle(&s, &out);
    }
    gn_pose_finish(&a.pose);
    gn_pose_finish(&b.pose);
    free(a.triangles);
    free(b.triangles);
    free(a.frames);
    return out;
}
