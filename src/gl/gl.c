#include "gl/gl.h"

#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "gl/private.h"

struct gn_gl *gn_gl_create(const struct gn_gl_opts *opts, struct gn_warnings *warnings,
                           struct gn_err *err) {
    struct gn_gl *gl = gn_xalloc(1, sizeof *gl);
    gl->desktop = opts->desktop;
    gl->debug.on = opts->debug;
    gl->stop = opts->stop;
    gl->warnings = warnings;
    gl->shaders = opts->shaders ? strdup(opts->shaders) : NULL;
    if (!gn_gl_version_check(opts, err) || !gn_gl_table_load(&gl->fn, opts, err)) goto fail;
    gn_gl_state_init(gl);
    gn_gl_targets_init(gl);
    for (int i = 0; i < GN_GL_INSTANCE_RING; i++)
        gl->instances.buffers[i] = gn_gl_object_create(gl, GN_GL_BUFFER);
    if (!gn_gl_caps_learn(gl, opts, err)) goto fail;
    if (gl->debug.on) gn_gl_debug_start(gl);
    return gl;
fail:
    gn_gl_destroy(gl);
    return NULL;
}

void gn_gl_destroy(struct gn_gl *gl) {
    if (!gl) return;
    if (gl->fn.Viewport) { /* the last of the table: it was loaded */
        gn_gl_staged_begin(gl, NULL);
        gn_gl_scene_finish(gl);
        gn_gl_kept_finish(gl);
        gn_gl_programs_finish(gl);
        gn_gl_targets_finish(gl);
        gn_gl_atlas_finish(gl);
        gn_gl_environment_finish(gl);
        gn_gl_occlusion_finish(gl);
        for (int i = 0; i < GN_GL_INSTANCE_RING; i++)
            gn_gl_object_destroy(gl, GN_GL_BUFFER, &gl->instances.buffers[i]);
        if (gl->debug.on && gl->caps.has & 1u << GN_CAP_DEBUG)
            GL(gl, DebugMessageCallback)(NULL, NULL);
    }
    free(gl->plan_programs.at);
    free(gl->shaders);
    free(gl->debug.failed_source);
    free(gl->read_buffer.data);
    free(gl);
}

const struct gn_caps *gn_gl_caps(const struct gn_gl *gl) { return &gl->caps; }
bool gn_gl_is_lost(struct gn_gl *gl) {
    return gl->robust && GL(gl, GetGraphicsResetStatus)() != GL_NO_ERROR;
}

/* A format that all of OpenGL ES 3.0 draws to. */
bool gn_gl_draws_right(struct gn_gl *gl) {
    const uint32_t known = 1u << GN_CAP_R32UI;
    return gn_gl_probe(gl, known) == known;
}

const char *gn_gl_failed_source(const struct gn_gl *gl) { return gl->debug.failed_source; }

bool gn_gl_load(struct gn_gl *gl, const struct gn_scene *scene, struct gn_err *err) {
    bool done = false;
    gn_gl_targets_forget(gl);
    gn_gl_scene_begin(gl, scene);
    return gn_gl_scene_step(gl, SIZE_MAX, &done, err);
}

struct gn_gl_stats gn_gl_stats(const struct gn_gl *gl) {
    struct gn_gl_stats stats = gl->stats;
    stats.objects_created = gl->objects_created;
    stats.target_bytes = gn_gl_targets_bytes(gl);
    stats.texture_bytes =
        gl->scene.texture_bytes + (uint64_t)gl->atlas.width_px * gl->atlas.height_px;
    stats.buffer_bytes = gl->scene.buffer_bytes;
    for (int i = 0; i < GN_GL_INSTANCE_RING; i++) stats.buffer_bytes += gl->instances.room[i];
    return stats;
}
