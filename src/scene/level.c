#include "scene/level.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "scene/gltf/meshopt.h"

/* Errors of levels, in diagonals of the mesh: a tenth of a pixel of a mesh of 1,000, and so on. */
#define FIRST_ERROR 1e-4f
#define NEXT_ERROR  2.0f
#define MOST_ERROR  0.013f
/* A level that is measured to be further off than this many of its own is none. */
#define MEASURED    8.0f
/* Of what it is made of, a level keeps no more triangles than this. */
#define KEPT        .85f

struct maker {
    const struct gn_scene *scene;
    struct gn_detail *detail;
    struct gn_level_measure *measure;
    uint32_t *local;   /* by vertex of the scene: its number among those of the mesh; UINT32_MAX */
    uint32_t *global;  /* back */
    float *positions;  /* of those */
    uint32_t *corners; /* of the level that is being made */
    bool *blends;      /* by geometry: its triangles keep their order */
    uint32_t room;
};

/* Renumbers a mesh's vertices, whose range it may share with a thousand others. */
static uint32_t gather_vertices(struct maker *m, const uint32_t *index, uint32_t count) {
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *local = &m->local[index[i]];
        if (*local == UINT32_MAX) {
            memcpy(m->positions + 3 * (size_t)used,
                   m->scene->buffers.positions + 3 * (size_t)index[i], 3 * sizeof(float));
            m->global[used] = index[i];
            *local = used++;
        }
        m->corners[i] = *local;
    }
    for (uint32_t i = 0; i < used; i++) m->local[m->global[i]] = UINT32_MAX;
    return used;
}

static uint32_t count_vertices(struct maker *m, const uint32_t *index, uint32_t count) {
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++)
        if (m->local[index[i]] == UINT32_MAX) m->local[index[i]] = used++;
    for (uint32_t i = 0; i < count; i++) m->local[index[i]] = UINT32_MAX;
    return used;
}

/* Of which geometries some item is blended. */
static void find_blended(const struct gn_scene *scene, bool *blends) {
    for (uint32_t i = 0; i < scene->item_count; i++)
        blends[scene->items[i].geometry] |=
            gn_material_is_blended(&scene->materials[scene->items[i].material]);
}

/* The corners of a level, in the scene's numbers, behind those that there are. */
static const uint32_t *store(struct maker *m, uint32_t count, struct gn_level *level) {
    struct gn_detail *d = m->detail;
    if (d->index_count + count > m->room) {
        m->room = 2 * (d->index_count + count);
        d->indices = gn_xrealloc(d->indices, m->room, sizeof *d->indices);
    }
    uint32_t *out = d->indices + d->index_count;
    for (uint32_t i = 0; i < count; i++) out[i] = m->global[m->corners[i]];
    *level = (struct gn_level){.first_index = d->index_count,
                               .index_count = count,
                               .vertex_count = count_vertices(m, out, count)};
    return out;
}

/* Takes the level, whose corners are the last, in place of those that have more triangles and are
 * not nearer. */
static void append(struct gn_detail *detail, struct gn_levels *levels, struct gn_level level) {
    const uint32_t *corners = detail->indices + level.first_index;
    while (levels->count > 0 && levels->at[levels->count - 1].error_m >= level.error_m)
        detail->index_count = level.first_index = levels->at[--levels->count].first_index;
    memmove(detail->indices + level.first_index, corners, level.index_count * sizeof *corners);
    detail->index_count += level.index_count;
    levels->at[levels->count++] = level;
}

static void make_levels(struct maker *m, uint32_t number, const atomic_bool *cancel) {
    const struct gn_geometry *geometry = &m->scene->geometries[number];
    const struct gn_box *box = &geometry->box;
    struct gn_levels *levels = &m->detail->geometries[number];
    const float size = glm_vec3_distance((float *)box->min, (float *)box->max);
    uint32_t count = geometry->index_count, kept = count; /* of the last level */
    float before = 0; /* what the quadrics of the level that this one is made of do not know */
    if (count < 3 * GN_LEVEL_TRIANGLES || m->blends[number]) return;
    const uint32_t vertices =
        gather_vertices(m, m->scene->buffers.indices + geometry->first_index, count);
    for (float error = FIRST_ERROR; error <= MOST_ERROR && levels->count < GN_LEVELS_MAX;
         error *= NEXT_ERROR) {
        if (cancel && atomic_load(cancel)) return;
        float moved = error * size;
        count = (uint32_t)gn_meshopt_simplify(m->corners, m->corners, count, m->positions, vertices,
                                              &moved);
        before += moved;
        if (count == 0) return;
        if ((float)count > KEPT * (float)kept) continue;
        struct gn_level *level = &levels->at[levels->count];
        const uint32_t *corners = store(m, count, level);
        level->error_m =
            gn_level_error(m->measure, number, corners, count, before, MEASURED * error * size);
        if (!isfinite(level->error_m)) return;
        kept = count;
        append(m->detail, levels, *level);
    }
}

struct gn_detail *gn_detail_make(const struct gn_scene *scene, const atomic_bool *cancel) {
    static atomic_uint_fast64_t last_id;
    const struct gn_scene_buffers *b = &scene->buffers;
    uint32_t most = 0;
    for (uint32_t i = 0; i < scene->geometry_count; i++)
        if (scene->geometries[i].index_count > most) most = scene->geometries[i].index_count;
    if (most < 3 * GN_LEVEL_TRIANGLES || !gn_meshopt_is_read()) return NULL;
    struct maker m = {.scene = scene,
                      .detail = gn_xalloc(1, sizeof *m.detail),
                      .measure = gn_level_measure_create(scene, cancel),
                      .local = gn_xalloc(b->vertex_count, sizeof *m.local),
                      .global = gn_xalloc(most, sizeof *m.global),
                      .positions = gn_xalloc(most, 3 * sizeof *m.positions),
                      .corners = gn_xalloc(most, sizeof *m.corners),
                      .blends = gn_xalloc(scene->geometry_count, sizeof *m.blends)};
    m.detail->geometries = gn_xalloc(scene->geometry_count, sizeof *m.detail->geometries);
    m.detail->id = atomic_fetch_add(&last_id, 1) + 1;
    memset(m.local, 0xff, b->vertex_count * sizeof *m.local);
    find_blended(scene, m.blends);
    for (uint32_t i = 0; i < scene->geometry_count; i++)
        if (!(cancel && atomic_load(cancel))) make_levels(&m, i, cancel);
    gn_level_measure_destroy(m.measure);
    free(m.local);
    free(m.global);
    free(m.positions);
    free(m.corners);
    free(m.blends);
    if (m.detail->index_count > 0 && !(cancel && atomic_load(cancel))) return m.detail;
    gn_detail_destroy(m.detail);
    return NULL;
}

void gn_detail_destroy(struct gn_detail *detail) {
    if (!detail) return;
    free(detail->geometries);
    free(detail->indices);
    free(detail);
}
