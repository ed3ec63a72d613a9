/* What vertex shaders read of skins and morph targets: the texels of the pose, in a ring so that a
 * frame does not wait for the one before, and the deltas of all targets. */
#include "core/hash.h"
#include "gl/private.h"

static GLuint make_texels(struct gn_gl *gl, uint32_t width, uint32_t height) {
    gl->scene.texture_bytes += (uint64_t)width * height * sizeof(vec4);
    return gn_gl_texture_make(gl, 1, GL_RGBA32F, width, height);
}

/* Texels first .. first + count, row after row. */
static void send_texels(struct gn_gl *gl, uint32_t first, uint64_t count, const vec4 *texels) {
    while (count > 0) {
        const uint32_t x = first % GN_DELTAS_WIDTH, y = first / GN_DELTAS_WIDTH;
        uint32_t width = GN_DELTAS_WIDTH - x, rows = 1;
        if (count < width) width = (uint32_t)count;
        if (x == 0 && count >= GN_DELTAS_WIDTH) rows = (uint32_t)(count / GN_DELTAS_WIDTH);
        GL(gl, TexSubImage2D)
        (GL_TEXTURE_2D, 0, (GLint)x, (GLint)y, (GLsizei)width, (GLsizei)rows, GL_RGBA, GL_FLOAT,
         texels);
        first += width * rows;
        texels += width * rows;
        count -= (uint64_t)width * rows;
    }
}

bool gn_gl_deltas_step(struct gn_gl *gl, size_t bytes) {
    const struct gn_scene *scene = gl->scene.scene;
    const struct gn_scene_deformation *d = &scene->deformation;
    uint32_t *next = &gl->scene.upload.first;
    if (d->width == 0) return true;
    if (*next == 0 && gl->scene.upload.texel == 0) {
        const uint64_t rows = (d->delta_texels + GN_DELTAS_WIDTH - 1) / GN_DELTAS_WIDTH;
        for (int i = 0; i < GN_GL_INSTANCE_RING; i++)
            gl->scene.deformation.pose[i] = make_texels(gl, d->width, d->height);
        if (rows > 0)
            gl->scene.deformation.deltas = make_texels(gl, GN_DELTAS_WIDTH, (uint32_t)rows);
    }
    uint32_t *sent = &gl->scene.upload.texel;
    for (size_t left = bytes / sizeof(vec4); *next < scene->geometry_count && left > 0;) {
        const struct gn_geometry *geometry = &scene->geometries[*next];
        const struct gn_targets *targets = geometry->targets;
        uint64_t count = 0;
        if (targets) {
            count = (uint64_t)targets->count * targets->parts * geometry->vertex_count - *sent;
            if (count > left) count = left;
            gn_gl_work_on_texture(gl, gl->scene.deformation.deltas);
            send_texels(gl, targets->first_texel + *sent, count, targets->deltas + *sent);
            *sent += (uint32_t)count;
            left -= count;
        }
        if (left == 0) break; /* it may have more */
        *sent = 0;
        ++*next;
    }
    return *next == scene->geometry_count;
}

void gn_gl_deformation_finish(struct gn_gl *gl) {
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &gl->scene.deformation.deltas);
    for (int i = 0; i < GN_GL_INSTANCE_RING; i++)
        gn_gl_object_destroy(gl, GN_GL_TEXTURE, &gl->scene.deformation.pose[i]);
}

void gn_gl_pose_upload(struct gn_gl *gl, const struct gn_plan *plan) {
    const struct gn_scene_deformation *d = &plan->scene->deformation;
    const GLuint nearest = gl->targets.map_samplers[GN_GL_MAP_NEAREST];
    const size_t size = (size_t)d->width * d->height * sizeof *plan->pose_texels;
    if (size == 0) return;
    const uint64_t hash = gn_hash(GN_HASH_INIT, plan->pose_texels, size);
    if (gl->scene.deformation.hash != hash) {
        gl->scene.deformation.hash = hash;
        gl->scene.deformation.current = (gl->scene.deformation.current + 1) % GN_GL_INSTANCE_RING;
        gn_gl_work_on_texture(gl, gl->scene.deformation.pose[gl->scene.deformation.current]);
        GL(gl, TexSubImage2D)
        (GL_TEXTURE_2D, 0, 0, 0, (GLsizei)d->width, (GLsizei)d->height, GL_RGBA, GL_FLOAT,
         plan->pose_texels);
    }
    gn_gl_bind_texture(gl, GN_GL_UNIT_POSE,
                       gl->scene.deformation.pose[gl->scene.deformation.current], nearest);
    if (gl->scene.deformation.deltas)
        gn_gl_bind_texture(gl, GN_GL_UNIT_DELTAS, gl->scene.deformation.deltas, nearest);
}
