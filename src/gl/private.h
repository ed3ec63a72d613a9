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
/* Fails with the first driver error since the last check; true: none. */
bool gn_gl_error_check(struct gn_gl *gl, const char *what, struct gn_err *err);
/* Stores a pending error for the next gn_gl_error_check, so that GetError reports only later errors
 * until then. */
void gn_gl_error_keep(struct gn_gl *gl);

/* ---- the glyphs of captions (atlas.c) ---- */

struct gn_gl_atlas {
    GLuint texture;
    uint32_t width_px, height_px;
    uint64_t generation; /* of its content; 0: none */
};
/* Uploads the glyph atlas of the plan's captions if it changed; NULL: no captions. */
bool gn_gl_atlas_ensure(struct gn_gl *gl, const struct gn_caption_atlas *atlas, struct gn_err *err);
bool gn_gl_atlas_holds(const struct gn_gl *gl, const struct gn_caption_atlas *atlas);
void gn_gl_atlas_finish(struct gn_gl *gl);

/* ---- the environment (environment.c) ---- */

struct gn_gl_environment {
    GLuint texture, sampler;
    uint64_t id; /* of its content; 0: none */
};
/* Uploads the cube of the plan's environment if it is another one; none is legal. */
bool gn_gl_environment_ensure(struct gn_gl *gl, const struct gn_plan_environment *environment,
                              struct gn_err *err);
bool gn_gl_environment_holds(const struct gn_gl *gl, const struct gn_plan_environment *environment);
void gn_gl_environment_finish(struct gn_gl *gl);

/* ---- ambient occlusion (occlusion.c) ---- */

struct gn_gl_occlusion {
    GLuint texture, sampler; /* a volume */
    uint32_t size[3];
    uint64_t id; /* of its content; 0: nothing is occluded */
};
/* Makes the volume of the plan's scene, and uploads its content if that is another one. */
bool gn_gl_occlusion_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
bool gn_gl_occlusion_holds(const struct gn_gl *gl, const struct gn_plan *plan);
void gn_gl_occlusion_finish(struct gn_gl *gl);

/* ---- one pass (pass.c, draw.c) ---- */

/* Binds the target and sets the state of a pass. area: what to clear, of pass->clear or less. */
void gn_gl_pass_begin(struct gn_gl *gl, const struct gn_pass *pass, GLuint framebuffer,
                      enum gn_clear_area area);
/* Copies pages into the map; their contents are invalidated afterwards. */
void gn_gl_pages_copy(struct gn_gl *gl, const struct gn_pass *pass);
/* Invalidates the depth (and stencil) of the target that is bound. */
void gn_gl_depth_discard(struct gn_gl *gl, const struct gn_pass *pass);
/* Averages samples in linear light, in an off-screen target: a multisampled window would average
 * encoded values. */
void gn_gl_output_resolve(struct gn_gl *gl);
/* The picture so far, to the size that is shown. */
void gn_gl_output_scale(struct gn_gl *gl);
/* Binds what a pass reads besides material textures. */
void gn_gl_sources_bind(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass);
/* constants_hash: of pass->constants. first, count: of the draw's indices, or bare vertices. */
void gn_gl_draw(struct gn_gl *gl, const struct gn_pass *pass, const struct gn_draw *d,
                uint64_t constants_hash, uint32_t first, uint32_t count);

/* ---- a long frame in pieces (piece.c) ---- */

enum { GN_GL_PACES = 4 };
struct gn_gl_pieces {
    gn_gl_pause *pause; /* NULL: frames are whole */
    void *user;
    const struct gn_scene *of;   /* what was learned is of this scene: */
    double most_px[GN_GL_PACES]; /* a piece of a kind of pass */
    double used;                 /* part of the piece that is being drawn */
    uint64_t done, done_before;  /* pieces of all frames; before the last one */
    int64_t begun_ns, run_ns;    /* that piece, and the run, began then */
};
void gn_gl_pieces_begin(struct gn_gl *gl, const struct gn_scene *scene); /* a frame begins */
/* All of a draw. False: the pause ended the frame. */
bool gn_gl_draw_in_pieces(struct gn_gl *gl, const struct gn_pass *pass, const struct gn_draw *d,
                          uint64_t constants_hash, struct gn_err *err);

/* A pause, if what began then took long: a program, or its first draw, where drivers compile. It
 * counts as a piece. False: it ended the frame. */
bool gn_gl_pause_after(struct gn_gl *gl, int64_t begun_ns, struct gn_err *err);

/* ---- running and reading (run.c, read.c) ---- */

/* Draws one triangle on one pixel with a program, in each pass of the plan that uses it and with
 * each set of textures, up to 32. Maps drawn to this way lose their content. */
bool gn_gl_touch(struct gn_gl *gl, const struct gn_plan *plan, uint32_t program,
                 struct gn_err *err);
bool gn_gl_program_prepare(struct gn_gl *gl, const struct gn_program_key *key, struct gn_err *err);
/* Waits until the GPU has finished all draws, maps included. */
void gn_gl_wait(struct gn_gl *gl);
/* RGBA of the framebuffer that is bound, half floats or floats. out: 4 x width x height. */
void gn_gl_read_floats(struct gn_gl *gl, uint32_t width, uint32_t height, float *out);

/* ---- capabilities (caps.c, probe.c) ---- */

/* False, and a line that names the GPU, when the context is too old. Needs no table. */
bool gn_gl_version_check(const struct gn_gl_opts *opts, struct gn_err *err);
/* By GL_RENDERER. */
bool gn_gl_is_software(const char *renderer);
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
    bool desktop, robust; /* robust: reset notification */
    struct {
        bool on;
        char text[256];      /* the first driver error since the last check */
        char *failed_source; /* see gn_gl_failed_source() */
    } debug;
    uint32_t probed; /* gn_cap bits that were tested; caps holds the result */
    char *shaders;   /* folder, or NULL */
    struct gn_warnings *warnings;
    struct gn_caps caps;
    struct gn_gl_state state;
    struct gn_gl_programs programs;
    struct gn_gl_scene scene, *staged; /* staged: NULL, or the next scene */
    struct gn_gl_instances instances;
    struct gn_gl_targets targets;
    struct gn_gl_kept kept;
    struct gn_gl_atlas atlas;
    struct gn_gl_environment environment;
    struct gn_gl_occlusion occlusion;
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
    struct gn_gl_pieces pieces;
};

#define GL(gl, name) ((gl)->calls++, (gl)->fn.name)

#endif
