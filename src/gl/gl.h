/* The only room that calls GL: it loads a scene, makes programs and targets, runs plans and reads
 * back. One context, one gn_gl; GL names never leave the room. Everything on the GPU can be made
 * again from the scene. */
#ifndef GN_GL_GL_H
#define GN_GL_GL_H

#include "core/err.h"
#include "core/warn.h"
#include "frame/plan.h"

typedef void (*gn_gl_proc)(void);
typedef gn_gl_proc (*gn_gl_get_proc)(void *display, const char *name);

struct gn_gl_opts {
    gn_gl_get_proc get_proc; /* of the display whose context is current */
    void *display;           /* its argument */
    const char *shaders;     /* folder to read shaders from; NULL: those embedded */
    const char *without; /* comma list of capabilities to pretend missing, or NULL; unknown names
                            are a usage error */
    bool desktop;        /* a desktop GL context (OSMesa): switch GL_FRAMEBUFFER_SRGB on */
    bool (*stop)(void);  /* asked before each program is made, and before each draw of a plan that
                            runs first with one: true breaks off, and that is a failure; or NULL */
    bool prove_later;    /* leave proofs to gn_gl_prove(): a faster start */
    bool debug;          /* KHR_debug messages become errors that gn_gl_error() reports, and the
                            source of a program that fails is kept */
};

struct gn_gl;
/* Loads the function table, learns and proves what the GPU can do (by a draw and a read-back,
 * unless that comes later), makes what every plan needs. A capability that the driver claims and
 * that fails is missing from then on, with a warning. NULL when the context is not OpenGL ES 3.0 or
 * later: the error names the GPU and its version. */
struct gn_gl *gn_gl_create(const struct gn_gl_opts *opts, struct gn_warnings *warnings,
                           struct gn_err *err);
void gn_gl_destroy(struct gn_gl *gl);
const struct gn_caps *gn_gl_caps(const struct gn_gl *gl);
/* Whether the GPU was reset: this object and its context are unusable then. */
bool gn_gl_is_lost(struct gn_gl *gl);
/* Draws known values and reads them back. False: wrong results, possibly from a GPU that hung
 * without the driver reporting it. Waits for the GPU, and compiles a program. */
bool gn_gl_draws_right(struct gn_gl *gl);

/* Uploads a scene, replacing the one before. The scene must outlive its use here. */
bool gn_gl_load(struct gn_gl *gl, const struct gn_scene *scene, struct gn_err *err);
/* Uploads a second scene in pieces while the first is shown. begin(): NULL drops the staged
 * scene. step() uploads about so many bytes, and sets *whole when the upload is complete. show()
 * replaces the first scene, which is freed; only when whole. */
void gn_gl_staged_begin(struct gn_gl *gl, const struct gn_scene *scene);
bool gn_gl_staged_step(struct gn_gl *gl, size_t bytes, bool *whole, struct gn_err *err);
void gn_gl_staged_show(struct gn_gl *gl);

/* Tests the capabilities that the plan needs and that were not tested yet. False when one fails:
 * gn_gl_caps() no longer has it, and the plan must be built again with what is left. */
bool gn_gl_prove(struct gn_gl *gl, const struct gn_plan *plan);
/* Makes the programs and targets that a plan needs, if they do not exist: after this gn_gl_run() of
 * the plan, and of plans with the same keys and sizes, allocates nothing and makes no GL object.
 */
bool gn_gl_prepare(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* The same, one step per call, for a plan that is needed later, of the current scene or of a staged
 * one that is whole. The current picture must be drawn again before it is shown again. One program
 * per call, or its first draw, to maps of a few texels. Build the plan with all_seen. again: what
 * was dropped is made again; without, the driver's cache on disk is enough. */
enum gn_gl_warmth {
    GN_GL_WARM_FAILED,  /* err says why */
    GN_GL_WARM_MORE,    /* call again */
    GN_GL_WARM_DONE,    /* nothing was left to do */
    GN_GL_WARM_REBUILD, /* a capability failed: build the plan again with what is left */
};
enum gn_gl_warmth gn_gl_warm(struct gn_gl *gl, const struct gn_plan *plan, bool again,
                             struct gn_err *err);
/* Warm-up is done: releases the driver's compiler. */
void gn_gl_warm_end(struct gn_gl *gl);

/* Makes all programs again from the files of opts.shaders; what was drawn with them before is drawn
 * again. One that fails stays as it was: then false, and the first failure. */
bool gn_gl_renew_programs(struct gn_gl *gl, struct gn_err *err);
/* Programs are there until they are dropped: each takes 1 to 5 MB in Mesa's drivers. Those of this
 * plan are kept from now on; all others are idle, later ones too. */
void gn_gl_keep_programs(struct gn_gl *gl, const struct gn_plan *plan);
/* The memory that idle programs take, by what making them allocated; other threads may have added
 * to it. */
struct gn_gl_idle {
    uint64_t bytes, ahead_bytes; /* of all; of those that never ran */
};
struct gn_gl_idle gn_gl_idle_programs(const struct gn_gl *gl);
/* Drops idle programs until they take at most so much: first those that never ran, then those that
 * ran longest ago. The one that was used last stays. False: none was dropped. */
bool gn_gl_drop_programs(struct gn_gl *gl, const struct gn_gl_idle *most);
/* All programs of the plan are there. */
bool gn_gl_has_programs(struct gn_gl *gl, const struct gn_plan *plan);
/* The composed source of the shader that failed last in a program of gn_gl_prepare(), its lines
 * numbered as the driver counts them; NULL when none did, or without `debug`. */
const char *gn_gl_failed_source(const struct gn_gl *gl);
/* The window: the framebuffer that the display gives the context. A picture of its size is drawn to
 * it, with several samples after they are resolved off screen; all others are drawn off screen.
 * NULL: no window. */
struct gn_gl_window {
    uint32_t width_px, height_px;
    bool srgb; /* it encodes; else a plan must be unencoded to go there */
};
void gn_gl_set_window(struct gn_gl *gl, const struct gn_gl_window *window);

/* Frees the output and the maps of a view of plans; a plan of it needs to be prepared again. */
void gn_gl_drop_view(struct gn_gl *gl, uint32_t view);

/* Fills the map of a slot of encoding SCREEN of a prepared plan: a value for each pixel, the lowest
 * row first. It stays until the next call. */
void gn_gl_give(struct gn_gl *gl, const struct gn_plan *plan, uint32_t slot, const float *values);
/* A long frame is drawn in pieces, each of about a tenth of a second at most, and so are the first
 * ones of a scene, until it is known that they are short. pause() is called while the GPU draws a
 * piece, every few milliseconds, and after it, with how many were drawn so far, of all frames, and
 * for how long this run goes on; also after each program that gn_gl_prepare() makes, and its first
 * draw, as if those were pieces. It may call nothing that draws. False ends gn_gl_run() or
 * gn_gl_prepare(), which fail with its *err. NULL, as at first: frames are drawn whole. */
typedef bool gn_gl_pause(void *user, uint64_t pieces, int64_t run_ns, struct gn_err *err);
void gn_gl_set_pause(struct gn_gl *gl, gn_gl_pause *pause, void *user);
/* The last frame took long until it was presented: if it was drawn whole, the next is not. */
void gn_gl_frame_was_long(struct gn_gl *gl);
/* Draws. Shadow passes whose target holds their content.hash are skipped. pass_ms, if not NULL,
 * gets the time of each pass (CPU wall clock around the pass and a 1-pixel read-back: slow, for
 * bench). */
bool gn_gl_run(struct gn_gl *gl, const struct gn_plan *plan, double *pass_ms, struct gn_err *err);

/* Keeps a copy of the last picture, 8 bits per channel, to be blended over later ones: call it
 * between gn_gl_run() and presenting. prepare() makes its objects, for a picture of that size in
 * the format of the last one. */
bool gn_gl_keep_prepare(struct gn_gl *gl, uint32_t width_px, uint32_t height_px,
                        struct gn_err *err);
bool gn_gl_keep(struct gn_gl *gl, struct gn_err *err);
/* Blends the kept picture over the current one. share: its weight, 0..1. No effect if sizes differ.
 */
void gn_gl_lay_over(struct gn_gl *gl, float share);
/* Copies a part of the kept picture over the current one. No effect if sizes differ. */
void gn_gl_lay_part(struct gn_gl *gl, const struct gn_rect *part);
/* Fills a part of the current picture with a grey: 0 black, 1 white. */
void gn_gl_fill(struct gn_gl *gl, const struct gn_rect *part, float grey);
/* Clears the window to black instead of running a plan. */
void gn_gl_black(struct gn_gl *gl);

/* The last picture, top row first. rgba8: what is stored (sRGB-encoded for GN_OUTPUT_SRGB8). f32:
 * RGBA floats from GN_OUTPUT_FLOAT or GN_OUTPUT_AOV. The buffer holds width x height x 4. */
bool gn_gl_read_rgba8(struct gn_gl *gl, uint8_t *out, struct gn_err *err);
bool gn_gl_read_f32(struct gn_gl *gl, float *out, struct gn_err *err);
/* The means of a view whose last plan gathers, RGBA, top row first, as large as its pictures: reads
 * that of a part, and replaces that of all, which other views lay over theirs. */
bool gn_gl_read_part(struct gn_gl *gl, uint32_t view, float *out, struct gn_err *err);
bool gn_gl_give_mean(struct gn_gl *gl, uint32_t view, float *rgba, struct gn_err *err);
/* The same picture as XRGB8888, top row first, `stride` bytes from row to row. */
bool gn_gl_read_xrgb8888(struct gn_gl *gl, uint8_t *out, size_t stride, struct gn_err *err);
void gn_gl_finish_frame(struct gn_gl *gl); /* a 1-pixel read-back: ends a timed frame */
/* A shadow map as encoded distances (metres for r32ui and r16f-raw, -1..1 for r16f, 0..1
 * else), width_px x height_px floats of the view, first row at v = 0. For tests and --aov map. */
bool gn_gl_read_map(struct gn_gl *gl, uint32_t slot, float *out, struct gn_err *err);

struct gn_gl_stats { /* of the last frame, except the last three */
    uint32_t gl_calls, draws, shadow_draws, shadow_passes_skipped;
    uint64_t triangles;
    uint64_t objects_created; /* GL objects made since create */
    uint64_t target_bytes;    /* colour, depth and map targets now */
    uint64_t buffer_bytes, texture_bytes;
};
struct gn_gl_stats gn_gl_stats(const struct gn_gl *gl);

/* Compiles the program of one key; tests use it to try every key. The source that was tried,
 * numbered, goes into *log (malloc'ed, the caller frees) on failure, if log is not NULL. */
bool gn_gl_try_program(struct gn_gl *gl, const struct gn_program_key *key, char **log,
                       struct gn_err *err);

#endif
