/* The scene's vertices on the GPU: one set of buffers for all of it. Positions have a buffer of
 * their own, so that shadow passes fetch nothing else; indices have 16 bits where that is enough.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "gl/private.h"

enum { PIECE = 1024 };

/* How a format reaches the GPU. */
static const struct gl_format {
    GLint size; /* 0: the row's components */
    GLenum type;
} gl_formats[GN_ATTRIBUTE_FORMAT_COUNT] = {
    [GN_ATTRIBUTE_FLOAT] = {0, GL_FLOAT},
    [GN_ATTRIBUTE_SNORM16] = {4, GL_SHORT},
    [GN_ATTRIBUTE_UNORM8] = {4, GL_UNSIGNED_BYTE},
    [GN_ATTRIBUTE_UINT16] = {4, GL_UNSIGNED_SHORT},
    [GN_ATTRIBUTE_UNORM16] = {4, GL_UNSIGNED_SHORT},
};

static GLuint make_buffer(struct gn_gl *gl, GLenum target, const void *data, size_t size) {
    GLuint name = gn_gl_object_create(gl, GN_GL_BUFFER);
    GL(gl, BindBuffer)(target, name); /* of the vertex array bound now, if an index buffer */
    GL(gl, BufferData)(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    gl->scene.buffer_bytes += size;
    return name;
}

static GLuint make_vertex_buffer(struct gn_gl *gl, const void *data, size_t size) {
    GLuint name = make_buffer(gl, GL_ARRAY_BUFFER, data, size);
    gl->state.array_buffer = name;
    return name;
}

static void pack_vertex(const struct gn_gl_scene *s, uint32_t vertex, uint8_t *out) {
    for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++) {
        const struct gn_attribute_row *row = &gn_attributes[i];
        if (s->attribute_at[i] < 0) continue;
        const uint8_t *from =
            (const uint8_t *)s->scene->buffers.attributes[i] + (size_t)vertex * row->bytes;
        if (row->format == GN_ATTRIBUTE_SNORM16) {
            int16_t packed[4] = {0};
            for (int k = 0; k < row->components; k++) {
                const float x = ((const float *)(const void *)from)[k];
                packed[k] = (int16_t)lrintf(fmaxf(-1, fminf(1, x)) * 32767);
            }
            if (i == GN_ATTRIBUTE_NORMAL && s->scene->buffers.spreads)
                packed[3] = s->scene->buffers.spreads[vertex];
            memcpy(out + s->attribute_at[i], packed, sizeof packed);
        } else
            memcpy(out + s->attribute_at[i], from, row->bytes);
    }
}

/* How many items of `each` bytes fit into `bytes`: at least one, at most `left`. */
static uint32_t portion(size_t bytes, size_t each, uint32_t left) {
    const size_t count = bytes / each > 0 ? bytes / each : 1;
    return count < left ? (uint32_t)count : left;
}

static bool send_positions(struct gn_gl *gl, size_t bytes) {
    struct gn_gl_scene *s = &gl->scene;
    const size_t each = 3 * sizeof(float);
    const uint32_t first = s->upload.first, all = s->scene->buffers.vertex_count;
    if (first == 0) s->positions = make_vertex_buffer(gl, NULL, all * each);
    const uint32_t n = portion(bytes, each, all - first);
    gn_gl_bind_array_buffer(gl, s->positions);
    if (n > 0) GL(gl, BufferSubData)
    (GL_ARRAY_BUFFER, (GLintptr)(first * each), (GLsizeiptr)(n * each),
     s->scene->buffers.positions + 3 * (size_t)first);
    s->upload.first += n;
    return s->upload.first == all;
}

/* Packed and sent in pieces, so that a large scene needs no second copy of itself. */
static bool send_attributes(struct gn_gl *gl, size_t bytes) {
    uint8_t packed[PIECE * GN_ATTRIBUTES_GPU_BYTES];
    struct gn_gl_scene *s = &gl->scene;
    const uint32_t all = s->scene->buffers.vertex_count;
    const size_t stride = (size_t)s->attribute_stride;
    if (s->upload.first == 0) s->attributes = make_vertex_buffer(gl, NULL, all * stride);
    gn_gl_bind_array_buffer(gl, s->attributes);
    const uint32_t end = s->upload.first + portion(bytes, stride, all - s->upload.first);
    while (s->upload.first < end) {
        const uint32_t first = s->upload.first, n = end - first < PIECE ? end - first : PIECE;
        for (uint32_t i = 0; i < n; i++) pack_vertex(s, first + i, packed + i * stride);
        GL(gl, BufferSubData)
        (GL_ARRAY_BUFFER, (GLintptr)(first * stride), (GLsizeiptr)(n * stride), packed);
        s->upload.first += n;
    }
    return end == all;
}

/* Into the buffer that is bound, from index `at` on. */
static void put_indices(struct gn_gl *gl, const uint32_t *indices, uint32_t count, uint32_t at) {
    const size_t each = gl->scene.index_size;
    if (each == sizeof *indices && count > 0) GL(gl, BufferSubData)
    (GL_ELEMENT_ARRAY_BUFFER, (GLintptr)(at * each), (GLsizeiptr)(count * each), indices);
    for (uint32_t i = 0; each != sizeof *indices && i < count; i += PIECE) {
        uint16_t narrow[PIECE];
        const uint32_t n = count - i < PIECE ? count - i : PIECE;
        for (uint32_t k = 0; k < n; k++) narrow[k] = (uint16_t)indices[i + k];
        GL(gl, BufferSubData)
        (GL_ELEMENT_ARRAY_BUFFER, (GLintptr)((at + i) * each), (GLsizeiptr)(n * each), narrow);
    }
}

static bool send_indices(struct gn_gl *gl, size_t bytes) {
    struct gn_gl_scene *s = &gl->scene;
    const uint32_t all = s->scene->buffers.index_count, first = s->upload.first;
    const bool wide = s->scene->buffers.vertex_count > 65536;
    s->index_type = wide ? GL_UNSIGNED_INT : GL_UNSIGNED_SHORT;
    s->index_size = wide ? sizeof(uint32_t) : sizeof(uint16_t);
    gn_gl_bind_vertex_array(gl, 0);
    if (first == 0)
        s->indices = make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, NULL, all * s->index_size);
    GL(gl, BindBuffer)(GL_ELEMENT_ARRAY_BUFFER, s->indices);
    const uint32_t count = portion(bytes, s->index_size, all - first);
    put_indices(gl, s->scene->buffers.indices + first, count, first);
    s->upload.first = first + count;
    return s->upload.first == all;
}

/* All in one frame: for a million triangles, 12 MB, that frame is late. The buffer keeps its name,
 * which vertex arrays have. */
void gn_gl_detail_upload(struct gn_gl *gl, const struct gn_plan *plan) {
    struct gn_gl_scene *s = &gl->scene;
    const struct gn_detail *detail = plan->detail;
    const uint32_t whole = s->scene->buffers.index_count;
    s->detail = detail;
    if (!detail || detail->id == s->detail_id) return;
    gn_gl_bind_vertex_array(gl, 0);
    GL(gl, BindBuffer)(GL_ELEMENT_ARRAY_BUFFER, s->indices);
    GL(gl, BufferData)
    (GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((whole + detail->index_count) * s->index_size), NULL,
     GL_STATIC_DRAW);
    put_indices(gl, s->scene->buffers.indices, whole, 0);
    put_indices(gl, detail->indices, detail->index_count, whole);
    if (s->detail_id == 0) s->buffer_bytes += detail->index_count * s->index_size;
    s->detail_id = detail->id;
}

uint32_t gn_gl_first_index(const struct gn_gl *gl, const struct gn_draw *draw) {
    const struct gn_gl_scene *s = &gl->scene;
    if (draw->level == 0) return s->scene->geometries[draw->geometry].first_index;
    return s->scene->buffers.index_count +
           s->detail->geometries[draw->geometry].at[draw->level - 1].first_index;
}

/* No program has uniforms of this scene's materials yet. */
static void forget_sets(struct gn_gl *gl) {
    for (uint32_t i = 0; i < gl->programs.room; i++) gl->programs.table[i].set = UINT32_MAX;
}

/* What uniforms have of a material. */
static void fill_set(const struct gn_material *m, float (*set)[4]) {
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        const float *uv = m->textures[slot].uv_from_uv;
        const bool scaled = slot == GN_TEXTURE_NORMAL && m->textures[slot].texture >= 0;
        const float scale = scaled ? m->normal_scale : 0.0f;
        const float both[8] = {uv[0], uv[2], uv[4], scale, uv[1], uv[3], uv[5], 0};
        memcpy(set[2 * slot], both, sizeof both);
    }
    float *factors = set[GN_GL_TRANSFORMS];
    memcpy(factors, m->f0, sizeof(vec3));
    factors[3] = m->lightmap_intensity;
    memcpy(factors + 4, m->factors, sizeof m->factors);
}

/* Materials with equal transforms, as nearly all have, share one set, so that a program keeps its
 * uniforms. One that clips move has its own. */
static void share_sets(struct gn_gl_scene *s) {
    const struct gn_scene *scene = s->scene;
    uint32_t last_moving = 0; /* sets before it are not shared */
    s->sets = gn_xalloc(scene->material_count + 1, sizeof *s->sets);
    s->material_sets = gn_xalloc(scene->material_count + 1, sizeof *s->material_sets);
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const bool moves = scene->materials[i].moves;
        fill_set(&scene->materials[i], s->sets[s->set_count]);
        uint32_t same = s->set_count > 8 ? s->set_count - 8 : 0; /* look at the last few only */
        if (same < last_moving) same = last_moving;
        if (moves) same = s->set_count;
        while (same < s->set_count &&
               memcmp(s->sets[same], s->sets[s->set_count], sizeof *s->sets) != 0)
            same++;
        s->material_sets[i] = same;
        s->set_count += same == s->set_count;
        if (moves) last_moving = s->set_count;
    }
}

void gn_gl_materials_update(struct gn_gl *gl, const struct gn_plan *plan) {
    const struct gn_scene *scene = gl->scene.scene;
    if (plan->materials == scene->materials) return;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        float set[GN_GL_SET_VECTORS][4];
        const uint32_t number = gl->scene.material_sets[i];
        if (!scene->materials[i].moves) continue;
        fill_set(&plan->materials[i], set);
        if (memcmp(gl->scene.sets[number], set, sizeof set) == 0) continue;
        memcpy(gl->scene.sets[number], set, sizeof set);
        for (uint32_t k = 0; k < gl->programs.room; k++)
            if (gl->programs.table[k].set == number) gl->programs.table[k].set = UINT32_MAX;
    }
}

void gn_gl_scene_begin(struct gn_gl *gl, const struct gn_scene *scene) {
    gn_gl_scene_finish(gl);
    gl->scene.scene = scene;
    /* Positions have a buffer of their own; the other attributes are interleaved. */
    for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++) {
        const bool here = scene->buffers.attributes[i] && i != GN_ATTRIBUTE_POSITION;
        gl->scene.attribute_at[i] = here ? gl->scene.attribute_stride : -1;
        if (here) gl->scene.attribute_stride += gn_attributes[i].gpu_bytes;
    }

    share_sets(&gl->scene);
    forget_sets(gl);
}

/* Runs one phase, for as many bytes as wanted; for SIZE_MAX all phases. */
bool gn_gl_scene_step(struct gn_gl *gl, size_t bytes, bool *done, struct gn_err *err) {
    static bool (*const sends[])(struct gn_gl *, size_t) = {
        [GN_GL_UPLOAD_POSITIONS] = send_positions,     [GN_GL_UPLOAD_ATTRIBUTES] = send_attributes,
        [GN_GL_UPLOAD_INDICES] = send_indices,         [GN_GL_UPLOAD_DELTAS] = gn_gl_deltas_step,
        [GN_GL_UPLOAD_PICTURES] = gn_gl_textures_step,
    };
    struct gn_gl_upload *u = &gl->scene.upload;
    do {
        if (!sends[u->phase](gl, bytes)) break;
        u->phase++;
        u->first = 0;
    } while (bytes == SIZE_MAX && u->phase < GN_GL_UPLOAD_DONE);
    *done = u->phase == GN_GL_UPLOAD_DONE;
    if (u->no_memory)
        gn_fail(err, "uploading the scene: out of memory for its pictures");
    else if (gn_gl_error_check(gl, "uploading the scene", err))
        return true;
    gn_gl_scene_finish(gl);
    return false;
}

void gn_gl_scene_finish(struct gn_gl *gl) {
    struct gn_gl_scene *s = &gl->scene;
    for (uint32_t i = 0; i < s->vertices_count; i++)
        gn_gl_object_destroy(gl, GN_GL_VERTEX_ARRAY, &s->vertices[i].name);
    gn_gl_object_destroy(gl, GN_GL_BUFFER, &s->positions);
    gn_gl_object_destroy(gl, GN_GL_BUFFER, &s->attributes);
    gn_gl_object_destroy(gl, GN_GL_BUFFER, &s->indices);
    gn_gl_textures_finish(gl);
    gn_gl_deformation_finish(gl);
    free(s->sets);
    free(s->material_sets);
    *s = (struct gn_gl_scene){0};
}

/* ---- the staged scene ---- */

void gn_gl_staged_swap(struct gn_gl *gl) {
    const struct gn_gl_scene shown = gl->scene;
    gl->scene = *gl->staged;
    *gl->staged = shown;
    forget_sets(gl);
}

void gn_gl_staged_begin(struct gn_gl *gl, const struct gn_scene *scene) {
    if (gl->staged) {
        gn_gl_staged_swap(gl);
        gn_gl_scene_finish(gl);
        gn_gl_staged_swap(gl);
        free(gl->staged);
        gl->staged = NULL;
    }
    if (!scene) return;
    gl->staged = gn_xalloc(1, sizeof *gl->staged);
    gn_gl_staged_swap(gl);
    gn_gl_scene_begin(gl, scene);
    gn_gl_staged_swap(gl);
}

bool gn_gl_staged_step(struct gn_gl *gl, size_t bytes, bool *whole, struct gn_err *err) {
    *whole = gl->staged && gl->staged->upload.phase == GN_GL_UPLOAD_DONE;
    if (*whole) return true;
    if (!gl->staged || !gl->staged->scene) return gn_fail(err, "no scene is staged");
    gn_gl_staged_swap(gl);
    const bool ok = gn_gl_scene_step(gl, bytes, whole, err);
    gn_gl_staged_swap(gl);
    return ok;
}

void gn_gl_staged_show(struct gn_gl *gl) {
    gn_gl_staged_swap(gl);
    gn_gl_staged_begin(gl, NULL);
    gn_gl_targets_forget(gl);
}

/* ---- vertex arrays ---- */

static bool reads_location(uint32_t attributes, int location) { return attributes >> location & 1; }

static void point_attribute(struct gn_gl *gl, GLuint location, GLint size, GLenum type,
                            GLsizei stride, size_t offset) {
    const GLboolean normalized = type != GL_FLOAT;
    GL(gl, VertexAttribPointer)(location, size, type, normalized, stride, (const void *)offset);
}

static struct gn_gl_vertices *find_vertices(struct gn_gl_scene *s, uint32_t attributes) {
    for (uint32_t i = 0; i < s->vertices_count; i++)
        if (s->vertices[i].attributes == attributes) return &s->vertices[i];
    return NULL;
}

bool gn_gl_vertices_known(struct gn_gl *gl, uint32_t attributes) {
    return find_vertices(&gl->scene, attributes);
}

bool gn_gl_vertices_ensure(struct gn_gl *gl, uint32_t attributes, struct gn_err *err) {
    struct gn_gl_scene *s = &gl->scene;
    if (find_vertices(s, attributes)) return true;
    if (s->vertices_count == GN_GL_VERTICES_MAX)
        return gn_fail(err, "more than %d sets of vertex attributes", GN_GL_VERTICES_MAX);
    struct gn_gl_vertices *v = &s->vertices[s->vertices_count++];
    v->attributes = attributes;
    v->name = gn_gl_object_create(gl, GN_GL_VERTEX_ARRAY);
    gn_gl_bind_vertex_array(gl, v->name);
    GL(gl, BindBuffer)(GL_ELEMENT_ARRAY_BUFFER, s->indices);
    gn_gl_bind_array_buffer(gl, s->positions);
    GL(gl, EnableVertexAttribArray)(GN_ATTRIBUTE_POSITION);
    point_attribute(gl, GN_ATTRIBUTE_POSITION, 3, GL_FLOAT, 0, 0);
    gn_gl_bind_array_buffer(gl, s->attributes);
    for (GLuint i = GN_ATTRIBUTE_POSITION + 1; i < GN_ATTRIBUTE_COUNT; i++) {
        const struct gn_attribute_row *row = &gn_attributes[i];
        const struct gl_format *format = &gl_formats[row->format];
        if (!reads_location(attributes, (int)i)) continue;
        if (s->attribute_at[i] >= 0) {
            const size_t at = (size_t)s->attribute_at[i];
            GL(gl, EnableVertexAttribArray)(i);
            if (row->format == GN_ATTRIBUTE_UINT16) GL(gl, VertexAttribIPointer)
            (i, format->size, format->type, s->attribute_stride, (const void *)at);
            else point_attribute(gl, i, format->size ? format->size : row->components, format->type,
                                 s->attribute_stride, at);
        } else if (row->missing_is_1)
            GL(gl, VertexAttrib4f)(i, 1.0f, 1.0f, 1.0f, 1.0f);
    }
    for (int i = GN_GL_WORLD; i < GN_GL_LOCATION_COUNT; i++) {
        if (!reads_location(attributes, i)) continue;
        GL(gl, EnableVertexAttribArray)((GLuint)i);
        GL(gl, VertexAttribDivisor)((GLuint)i, 1);
    }
    return true;
}

/* ES 3.0 has no base instance: the attribute pointers change instead. */
void gn_gl_vertices_bind(struct gn_gl *gl, uint32_t attributes, uint32_t first_instance) {
    struct gn_gl_vertices *v = find_vertices(&gl->scene, attributes);
    const GLuint buffer = gl->instances.buffers[gl->instances.current];
    const size_t offset = first_instance * sizeof(struct gn_instance);
    gn_gl_bind_vertex_array(gl, v->name);
    if (v->instances == buffer && v->offset == offset) return;
    v->instances = buffer;
    v->offset = offset;
    gn_gl_bind_array_buffer(gl, buffer);
    for (int i = GN_GL_WORLD; i < GN_GL_LOCATION_COUNT; i++)
        if (reads_location(attributes, i))
            point_attribute(gl, (GLuint)i, 4, GL_FLOAT, sizeof(struct gn_instance),
                            offset + (size_t)(i - GN_GL_WORLD) * 4 * sizeof(float));
}

_Static_assert(sizeof(struct gn_instance) ==
                   (GN_GL_LOCATION_COUNT - GN_GL_WORLD) * 4 * sizeof(float),
               "locations 10..15 are the members of gn_instance, a vec4 each");

void gn_gl_instances_upload(struct gn_gl *gl, const struct gn_instance *instances, size_t count) {
    struct gn_gl_instances *ring = &gl->instances;
    const size_t size = count * sizeof *instances;
    const uint64_t hash = gn_hash(GN_HASH_INIT ^ size, instances, size);
    if (ring->hash == hash) return;
    ring->hash = hash;
    ring->current = (ring->current + 1) % GN_GL_INSTANCE_RING;
    gn_gl_bind_array_buffer(gl, ring->buffers[ring->current]);
    if (ring->room[ring->current] < size) {
        ring->room[ring->current] = size + size / 2;
        GL(gl, BufferData)
        (GL_ARRAY_BUFFER, (GLsizeiptr)ring->room[ring->current], NULL, GL_STREAM_DRAW);
    }
    GL(gl, BufferSubData)(GL_ARRAY_BUFFER, 0, (GLsizeiptr)size, instances);
}
