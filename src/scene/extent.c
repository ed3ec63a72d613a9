/* What a scene takes up over whole animations, as few points: of all that is drawn, the farthest in
 * each of 128 directions that are spread evenly over the sphere. A direction between them loses at
 * most 2 % of the radius of what is round there; framing leaves a margin of 8 %.
 *
 * Blocks of triangles, and items, are tested by their boxes first: only directions in which a box
 * reaches farther than all before it look at its points. The number of poses is bounded, whatever
 * the scene: LOOKS in all. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/pose.h"

enum {
    DIRECTIONS = 128,
    BLOCK = 192,     /* indices that share a box */
    POSES = 256,     /* of one choice of clips, at most */
    EVEN_POSES = 64, /* of these, at least so many evenly over its time */
    FEW_POSES = 16,
    LOOKS = 1 << 20,    /* nodes and items that are posed, for all choices of clips together */
    VERTICES = 1 << 18, /* that are deformed, for all choices of clips together */
    REPEATS = 4,        /* times that the longest clip is played, where clips last differently */
};

struct hull {
    float reach[DIRECTIONS]; /* along each direction; -INFINITY: nothing yet */
    vec3 points[DIRECTIONS];
};
struct directions {
    float x[DIRECTIONS], y[DIRECTIONS], z[DIRECTIONS]; /* unit vectors */
};
struct shape { /* of a geometry, its own space */
    vec3 *points;
    uint32_t count;     /* 0: not measured yet */
    uint32_t *vertices; /* of one that is deformed: each that a triangle has, once */
    uint32_t vertex_count;
};
struct measure { /* of a scene */
    struct gn_gltf *g;
    const struct gn_scene *scene;
    struct directions towards;
    struct shape *shapes;   /* of each geometry */
    uint64_t vertices_left; /* of deformed items, that may still be posed */
    uint32_t choices_left;  /* of clips, this one among them: each has its share of these */
};

/* Spiral of Fibonacci: equal steps of height, the golden angle between two. */
static void spread_directions(struct directions *to) {
    for (int k = 0; k < DIRECTIONS; k++) {
        const double height = 1 - (2 * k + 1) / (double)DIRECTIONS, turn = 2.399963229728653 * k;
        const double aside = sqrt(1 - height * height);
        to->x[k] = (float)(aside * cos(turn));
        to->y[k] = (float)height;
        to->z[k] = (float)(aside * sin(turn));
    }
}

static void clear_hull(struct hull *hull) {
    for (int k = 0; k < DIRECTIONS; k++) hull->reach[k] = -INFINITY;
}

/* The directions in which the box reaches farther than the hull; returns how many. */
static int find_exceeded(const struct hull *hull, const struct directions *to,
                         const struct gn_box *box, uint8_t *exceeded) {
    vec3 c, h;
    float reach[DIRECTIONS];
    int count = 0;
    glm_vec3_center((float *)box->min, (float *)box->max, c);
    glm_vec3_sub((float *)box->max, c, h);
    for (int k = 0; k < DIRECTIONS; k++)
        reach[k] = c[0] * to->x[k] + c[1] * to->y[k] + c[2] * to->z[k] + h[0] * fabsf(to->x[k]) +
                   h[1] * fabsf(to->y[k]) + h[2] * fabsf(to->z[k]);
    for (int k = 0; k < DIRECTIONS; k++)
        if (reach[k] > hull->reach[k]) exceeded[count++] = (uint8_t)k;
    return count;
}

static void add_point(struct hull *hull, const struct directions *to, const uint8_t *exceeded,
                      int count, const float *p) {
    for (int i = 0; i < count; i++) {
        const int k = exceeded[i];
        const float reach = p[0] * to->x[k] + p[1] * to->y[k] + p[2] * to->z[k];
        if (reach <= hull->reach[k]) continue;
        hull->reach[k] = reach;
        glm_vec3_copy((float *)p, hull->points[k]);
    }
}

/* Each point once; returns how many. */
static uint32_t list_points(const struct hull *hull, vec3 *out) {
    uint32_t count = 0;
    for (int k = 0; k < DIRECTIONS; k++) {
        uint32_t i = 0;
        if (!isfinite(hull->reach[k])) continue;
        while (i < count && memcmp(out[i], hull->points[k], sizeof(vec3)) != 0) i++;
        if (i == count) glm_vec3_copy((float *)hull->points[k], out[count++]);
    }
    return count;
}

static void measure_shape(struct measure *m, const struct gn_geometry *g, struct shape *shape) {
    const float *positions = m->scene->buffers.positions;
    const uint32_t *indices = m->scene->buffers.indices + g->first_index;
    uint8_t exceeded[DIRECTIONS];
    struct hull hull;
    vec3 points[DIRECTIONS];
    clear_hull(&hull);
    for (uint32_t first = 0; first < g->index_count; first += BLOCK) {
        const uint32_t end = g->index_count - first < BLOCK ? g->index_count : first + BLOCK;
        struct gn_box box;
        glm_aabb_invalidate((vec3 *)&box);
        for (uint32_t i = first; i < end; i++) {
            const float *p = positions + 3 * (size_t)indices[i];
            glm_vec3_minv(box.min, (float *)p, box.min);
            glm_vec3_maxv(box.max, (float *)p, box.max);
        }
        const int count = find_exceeded(&hull, &m->towards, &box, exceeded);
        for (uint32_t i = first; count > 0 && i < end; i++)
            add_point(&hull, &m->towards, exceeded, count, positions + 3 * (size_t)indices[i]);
    }
    const uint32_t count = list_points(&hull, points);
    shape->points = gn_gltf_alloc(m->g, &m->g->memory.step, count, sizeof *points);
    if (m->g->failed) return;
    memcpy(shape->points, points, count * sizeof *points);
    shape->count = count;
}

static void list_vertices(struct measure *m, const struct gn_geometry *g, struct shape *shape) {
    uint32_t *vertices = gn_gltf_alloc(m->g, &m->g->memory.step, g->index_count, sizeof *vertices);
    if (m->g->failed) return;
    memcpy(vertices, m->scene->buffers.indices + g->first_index, g->index_count * sizeof *vertices);
    qsort(vertices, g->index_count, sizeof *vertices, gn_compare_indices);
    for (uint32_t i = 0; i < g->index_count; i++)
        if (i == 0 || vertices[i] != vertices[i - 1]) vertices[shape->vertex_count++] = vertices[i];
    shape->vertices = vertices;
}

/* Vertex by vertex while that is not too much work, else the corners of the box. */
static void add_deformed(struct measure *m, const struct gn_pose *pose, uint32_t item,
                         const uint8_t *exceeded, int count, struct hull *hull) {
    const uint32_t geometry = m->scene->items[item].geometry;
    const struct gn_box *box = &pose->items[item].box_ws;
    struct shape *shape = &m->shapes[geometry];
    if (!shape->vertices) list_vertices(m, &m->scene->geometries[geometry], shape);
    if (!shape->vertices) return;
    const bool exact = shape->vertex_count <= m->vertices_left;
    vec3 p;
    if (exact) m->vertices_left -= shape->vertex_count;
    for (uint32_t i = 0; exact && i < shape->vertex_count; i++) {
        gn_pose_corner(pose, item, shape->vertices[i], p);
        add_point(hull, &m->towards, exceeded, count, p);
    }
    for (int i = 0; !exact && i < 8; i++) {
        for (int k = 0; k < 3; k++) p[k] = i >> k & 1 ? box->max[k] : box->min[k];
        add_point(hull, &m->towards, exceeded, count, p);
    }
}

/* Adds the items of this pose: those that move, or those that do not. */
static void add_items(struct measure *m, const struct gn_pose *pose, bool moving,
                      struct hull *hull) {
    uint8_t exceeded[DIRECTIONS];
    for (uint32_t i = 0; i < m->scene->item_count && !m->g->failed; i++) {
        const struct gn_pose_item *item = &pose->items[i];
        const uint32_t geometry = m->scene->items[i].geometry;
        struct shape *shape = &m->shapes[geometry];
        if (!item->visible || item->moves != moving) continue;
        const int count = find_exceeded(hull, &m->towards, &item->box_ws, exceeded);
        if (gn_item_is_deformed(&m->scene->items[i])) {
            if (count > 0) add_deformed(m, pose, i, exceeded, count, hull);
            continue;
        }
        if (count > 0 && shape->count == 0)
            measure_shape(m, &m->scene->geometries[geometry], shape);
        for (uint32_t k = 0; count > 0 && k < shape->count; k++) {
            vec3 p;
            glm_mat4_mulv3((vec4 *)item->world_from_item, shape->points[k], 1, p);
            add_point(hull, &m->towards, exceeded, count, p);
        }
    }
}

/* ---- times --------------------------------------------------------------------------------- */

/* Nodes, items and channels that a step of the pose goes through. */
static uint64_t count_moving(const struct gn_pose *pose) {
    const struct gn_scene *scene = pose->scene;
    uint64_t count = 1;
    for (uint32_t i = 0; i < scene->node_count; i++) count += pose->node_moves[i];
    for (uint32_t i = 0; i < scene->item_count; i++) count += pose->items[i].moves;
    for (uint32_t i = 0; i < pose->playing_count; i++)
        count += scene->animation.clips[pose->playing[i]].channel_count;
    return count;
}

int64_t gn_scene_period_ns(const struct gn_pose *pose) {
    int64_t longest_ns = 0;
    bool differ = false;
    for (uint32_t i = 0; i < pose->playing_count; i++) {
        const int64_t ns = pose->scene->animation.clips[pose->playing[i]].duration_ns;
        if (ns == 0) continue;
        differ |= longest_ns > 0 && llabs(ns - longest_ns) > 1000000;
        if (ns > longest_ns) longest_ns = ns;
    }
    return differ ? REPEATS * longest_ns : longest_ns;
}

/* Times at which to look, one for each cell of the period: of a key, where extremes are, else some
 * in the middle of a cell. -1: none. */
static void choose_times(const struct gn_pose *pose, int64_t period_ns, int cells, int64_t *times) {
    const struct gn_scene_animation *animation = &pose->scene->animation;
    const double cell_s = (double)period_ns * 1e-9 / cells;
    const int step = cells > EVEN_POSES ? cells / EVEN_POSES : 1;
    for (int i = 0; i < cells; i++) times[i] = -1;
    for (uint32_t c = 0; c < pose->playing_count; c++) {
        const struct gn_clip *clip = &animation->clips[pose->playing[c]];
        for (uint32_t i = 0; i < clip->channel_count; i++) {
            const struct gn_channel *channel = &animation->channels[clip->first_channel + i];
            if (channel->path == GN_ANIM_RECORD && !gn_channel_hides(pose->scene, channel))
                continue; /* nothing moves by it */
            for (uint32_t k = 0; k < channel->key_count; k++) {
                if (channel->times_s[k] < 0) continue;
                const int cell = (int)((double)channel->times_s[k] / cell_s);
                if (cell >= 0 && cell < cells && times[cell] < 0)
                    times[cell] = (int64_t)((double)channel->times_s[k] * 1e9);
            }
        }
    }
    for (int i = 0; i < cells; i += step)
        if (times[i] < 0) times[i] = period_ns / cells * i + period_ns / cells / 2;
}

/* Poses that this choice's share of the vertices allows. */
static int count_deformed_poses(struct measure *m) {
    uint64_t vertices = 0;
    for (uint32_t i = 0; i < m->scene->item_count && !m->g->failed; i++) {
        struct shape *shape = &m->shapes[m->scene->items[i].geometry];
        if (!gn_item_is_deformed(&m->scene->items[i])) continue;
        if (!shape->vertices)
            list_vertices(m, &m->scene->geometries[m->scene->items[i].geometry], shape);
        vertices += shape->vertex_count;
    }
    const uint64_t poses = vertices ? m->vertices_left / m->choices_left / vertices : POSES;
    return poses < FEW_POSES ? FEW_POSES : poses < POSES ? (int)poses : POSES;
}

/* Of the clips that the pose plays; *left: what may still be posed. */
static void add_clips(struct measure *m, struct gn_pose *pose, uint64_t *left, struct hull *hull) {
    const uint64_t moving = count_moving(pose), poses = *left / moving;
    const int64_t period_ns = gn_scene_period_ns(pose);
    const int most = count_deformed_poses(m);
    const int cells = poses > (uint64_t)most ? most : poses > FEW_POSES ? (int)poses : FEW_POSES;
    int64_t times[POSES];
    add_items(m, pose, false, hull);
    choose_times(pose, period_ns > 0 ? period_ns : 1, cells, times);
    for (int i = 0; i < cells; i++) {
        if (times[i] < 0) continue;
        gn_pose_step(pose, times[i]);
        add_items(m, pose, true, hull);
        *left -= *left > moving ? moving : *left;
    }
    if (period_ns == 0) return;
    gn_pose_step(pose, period_ns - 1); /* the last key, just before the clip begins again */
    add_items(m, pose, true, hull);
}

/* ---- extents ------------------------------------------------------------------------------- */

static void keep_extent(struct gn_gltf *g, const struct hull *hull, struct gn_extent *extent) {
    vec3 points[DIRECTIONS];
    const struct gn_box *box = &g->scene->box;
    uint32_t count = list_points(hull, points);
    for (uint32_t i = 0; count == 0 && i < 8; i++) /* nothing can be seen */
        for (int k = 0; k < 3; k++) points[i][k] = i >> k & 1 ? box->max[k] : box->min[k];
    if (count == 0) count = 8;
    GN_NEW(g, g->memory.scene, extent->points, count);
    if (g->failed) return;
    memcpy(extent->points, points, count * sizeof *points);
    extent->count = count;
}

bool gn_scene_measure(struct gn_gltf *g, struct gn_pose *pose) {
    struct gn_scene *scene = g->scene;
    const struct gn_scene_animation *animation = &scene->animation;
    const int clip_count = (int)animation->clip_count;
    struct measure m = {.g = g, .scene = scene, .vertices_left = VERTICES};
    GN_NEW(g, &g->memory.step, m.shapes, scene->geometry_count);
    GN_NEW(g, g->memory.scene, scene->extents, (uint64_t)(clip_count - GN_POSE_NONE));
    spread_directions(&m.towards);
    uint64_t left = LOOKS;
    for (int clips = GN_POSE_NONE; clips < clip_count && !g->failed; clips++) {
        struct gn_extent *extent = &scene->extents[clips - GN_POSE_NONE];
        m.choices_left = (uint32_t)(clip_count - clips);
        /* the only clip, played by default; or there was enough to do */
        if (clips >= 0 && (left == 0 || (clip_count == 1 && animation->clips[0].on_by_default))) {
            *extent = scene->extents[GN_POSE_DEFAULT - GN_POSE_NONE];
            continue;
        }
        const uint64_t work = (uint64_t)scene->node_count + scene->item_count;
        if (clips >= 0) left -= left > work ? work : left;
        gn_pose_choose(pose, clips);
        if (clips > GN_POSE_NONE && !pose->animated) {
            *extent = scene->extents[0];
            continue;
        }
        struct hull hull;
        clear_hull(&hull);
        if (clips == GN_POSE_NONE)
            add_items(&m, pose, false, &hull);
        else
            add_clips(&m, pose, &left, &hull);
        keep_extent(g, &hull, extent);
    }
    return !g->failed;
}
