/* What the files of this room share. GL names (GLuint) live here and nowhere else. */
#ifndef GN_GL_PRIVATE_H
#define GN_GL_PRIVATE_H

#include "gl/program.h"
#include "gl/scene.h"
#include "gl/source.h"
#include "gl/state.h"
#include "gl/target.h"

/* ---- errors (error.c) ---- */

/* Collects KHR_debug messages from now on, if the context has them. */
void gn_gl_debug_start(struct gn_gl *gl);
/* What the driver said since the last time; true when nothing. */
bool gn_gl_error_check(struct gn_gl *gl, const char *what, struct gn_err *err);
/* Takes a pending error out of the driver's hands, for the next gn_gl_error_check: what GetError
 * says then is about what comes between. */
void gn_gl_error_keep(struct gn_gl *gl);

/* ---- the glyphs of captions (atlas.c) ---- */

struct gn_gl_atlas {
    GLuint texture;
    uint32_t width_px, height_px;
    uint64_t generation; /* of what it holds; 0: nothing */
};
/* Sends what the plan's captions read, if it is not there; NULL: they read nothing. */
bool gn_gl_atlas_ensure(struct gn_gl *gl, const struct gn_caption_atlas *atlas, struct gn_err *err);
bool gn_gl_atlas_holds(const struct gn_gl *gl, const struct gn_caption_atlas *atlas);
void gn_gl_atlas_finish(struct gn_gl *gl);

/* ---- running and reading (run.c, read.c) ---- */

/* Draws once, a triangle on one pixel, with a program of the plan wherever the plan does. What maps
 * hold is forgotten where that was in one. */
bool gn_gl_touch(struct gn_gl *gl, const struct gn_plan *plan, uint32_t program,
                 struct gn_err *err);
bool gn_gl_program_prepare(struct gn_gl *gl, const struct gn_program_key *key, struct gn_err *err);
/* Waits until all is drawn, maps too. */
void gn_gl_wait(struct gn_gl *gl);
/* RGBA of the framebuffer that is bound, half floats or floats. out: 4 x width x height. */
void gn_gl_read_floats(struct gn_gl *gl, uint32_t width, uint32_t height, float *out);

/* ---- capabilities (caps.c, probe.c) ---- */

/* False, and a line that names the GPU, when the context is too old. Needs no table. */
bool gn_gl_version_check(const struct gn_gl_opts *opts, struct gn_err *err);
/* By GL_RENDERER. */
bool gn_gl_is_tiler(const char *renderer);
bool gn_gl_caps_learn(struct gn_gl *gl, const struct gn_gl_opts *opts, struct gn_err *err);
/* gn_cap bits of what the driver calls complete: no proof, but what to start from. */
uint32_t gn_gl_probe_claims(struct gn_gl *gl);
/* Of the gn_cap bits wanted, those that a draw and a read-back prove. A proof compiles a program:
 * 5-10 ms each with software drivers. */
uint32_t gn_gl_probe(struct gn_gl *gl, uint32_t wanted);

/* ---- a picture that is kept (fade.c) ---- */

struct gn_gl_kept {
    uint32_t width_px, height_px;
    bool srgb;
    GLuint framebuffer, texture, vertices, program;
    GLint u_share;
};
void gn_gl_kept_finish(struct gn_gl *gl);

struct gn_gl {
    struct gn_gl_table fn;
    uint32_t calls;
    bool desktop, robust; /* robust: it tells when the GPU was reset */
    struct {
        bool on;
        char text[256];      /* the driver's first complaint since the last check */
        char *failed_source; /* see gn_gl_failed_source() */
    } debug;
    uint32_t probed; /* gn_cap bits that were tried: caps holds how it ended */
    char *shaders;   /* folder, or NULL */
    struct gn_warnings *warnings;
    struct gn_caps caps;
    struct gn_gl_state state;
    struct gn_gl_programs programs;
    struct gn_gl_scene scene, *staged; /* staged: NULL, or one beside it */
    struct gn_gl_instances instances;
    struct gn_gl_targets targets;
    struct gn_gl_kept kept;
    struct gn_gl_atlas atlas;
    struct gn_gl_window window; /* width 0: none */
    struct {
        uint8_t *data; /* of gn_gl_read_xrgb8888() */
        size_t size;
    } read_buffer;
    struct {
        struct gn_gl_program **at; /* grows in prepare */
        uint32_t room;
    } plan_programs; /* of the plan that runs */
    struct gn_gl_stats stats;
    uint64_t objects_created;
    bool (*stop)(void); /* see gn_gl_opts */
};

#define GL(gl, name) ((gl)->calls++, (gl)->fn.name)

#endif
