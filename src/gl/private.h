/* What the files of this room share. GL names (GLuint) live here and nowhere else. */
#ifndef GN_GL_PRIVATE_H
#define GN_GL_PRIVATE_H

#include "gl/table.h"

/* ---- text and sources (compose.c, source.c): no GL ---- */

struct gn_gl_text { /* grows; zeroed is empty; always ends in a zero byte once something is in it */
    char *data;
    size_t size, room;
};
void gn_gl_text_add(struct gn_gl_text *text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void gn_gl_text_add_bytes(struct gn_gl_text *text, const char *data, size_t size);
void gn_gl_text_finish(struct gn_gl_text *text);
/* The same text with a number before each line and ? for control characters; malloc'ed. */
char *gn_gl_text_numbered(const struct gn_gl_text *text);

/* Adds the shader file `name` (a path below shaders_es), from the folder or, if that is NULL, from
 * those embedded, with its #include "name" lines resolved: each included file once per source, one
 * added here whenever it is. */
struct gn_gl_source {
    const char *folder;
    char seen[32][64]; /* included so far */
    unsigned seen_count;
};
bool gn_gl_source_add(struct gn_gl_source *source, const char *name, struct gn_gl_text *out,
                      struct gn_err *err);
/* The words of its `//@ names a b c` lines, zero-separated in `names`; the count, or -1. */
enum { GN_GL_NAMES_MAX = 32 };
int gn_gl_source_names(const struct gn_gl_source *source, const char *name,
                       char names[GN_GL_NAMES_MAX][64], struct gn_err *err);

/* The whole source of one stage of a variant. */
enum gn_gl_stage { GN_GL_VERTEX, GN_GL_FRAGMENT };
bool gn_gl_compose(const char *folder, const struct gn_program_key *key, enum gn_gl_stage stage,
                   struct gn_gl_text *out, struct gn_err *err);
/* A key for people: "lit BASE_TEXTURE|HEMISPHERE, spot pcf depth, point". */
void gn_gl_key_text(const struct gn_program_key *key, char *out, size_t size);

/* ---- attributes, texture units ---- */

enum gn_gl_location { /* of inputs in shaders: a vertex's have the numbers of gn_attribute */
                      GN_GL_WORLD = 10, /* an instance's: three rows */
                      GN_GL_BASE_COLOR = GN_GL_WORLD + 3,
                      GN_GL_SURFACE,
                      GN_GL_EMISSIVE,
                      GN_GL_LOCATION_COUNT,
};
_Static_assert((int)GN_ATTRIBUTE_COUNT <= (int)GN_GL_WORLD && GN_GL_LOCATION_COUNT <= 16,
               "ES 3.0 promises 16");
enum { /* texture units: maps first, then one a gn_texture_slot, then slides; the last is for work
          of our own. ES 3.0 promises 16. */
       GN_GL_UNIT_MAP = 0,
       GN_GL_UNIT_TEXTURE = GN_SHADOWS_MAX,
       GN_GL_UNIT_SLIDE = GN_GL_UNIT_TEXTURE + GN_TEXTURE_SLOT_COUNT,
       GN_GL_UNIT_WORK = GN_GL_UNIT_SLIDE + GN_SLIDES_MAX,
       GN_GL_UNIT_COUNT,
};
_Static_assert(GN_GL_UNIT_COUNT <= 16, "texture units that ES 3.0 promises");

/* ---- the state cache (state.c): diffed, never restored ---- */

struct gn_gl_rect {
    GLint x, y;
    GLsizei width, height;
};
struct gn_gl_state {
    GLuint framebuffer, program, vertex_array, array_buffer;
    struct gn_gl_rect viewport, scissor;
    bool scissor_on, depth_on, depth_write, blend_on, cull_on, mirrored, stencil_on, color_write;
    struct gn_stencil stencil; /* `clears` unused */
    uint8_t cull;              /* gn_cull, when on */
    GLuint unit;               /* the active one */
    GLuint textures[GN_GL_UNIT_COUNT], samplers[GN_GL_UNIT_COUNT];
    float clear_color[4];
};
void gn_gl_state_init(struct gn_gl *gl); /* what every pass has in common; the cache is made true */
void gn_gl_bind_framebuffer(struct gn_gl *gl, GLuint name);
void gn_gl_bind_vertex_array(struct gn_gl *gl, GLuint name);
void gn_gl_bind_array_buffer(struct gn_gl *gl, GLuint name);
void gn_gl_bind_texture(struct gn_gl *gl, GLuint unit, GLuint texture, GLuint sampler);
/* Calls that name no texture are about this one from now on, even where it was bound already. */
void gn_gl_work_on_texture(struct gn_gl *gl, GLuint texture);
void gn_gl_use_program(struct gn_gl *gl, GLuint name);
void gn_gl_set_viewport(struct gn_gl *gl, struct gn_gl_rect rect);
void gn_gl_set_scissor(struct gn_gl *gl, const struct gn_gl_rect *rect); /* NULL: off */
void gn_gl_set_depth(struct gn_gl *gl, bool test, bool write);
void gn_gl_set_blend(struct gn_gl *gl, enum gn_blend blend);
void gn_gl_set_cull(struct gn_gl *gl, enum gn_cull cull, bool mirrored);
void gn_gl_set_color_write(struct gn_gl *gl, bool write); /* clears heed it, too */
void gn_gl_set_stencil(struct gn_gl *gl, const struct gn_stencil *stencil);
void gn_gl_set_stencil_writes(struct gn_gl *gl, uint8_t bits); /* for clears */
void gn_gl_set_clear_color(struct gn_gl *gl, const float rgba[4]);

/* ---- objects: made here, so that they are counted ---- */

enum gn_gl_object {
    GN_GL_BUFFER,
    GN_GL_FRAMEBUFFER,
    GN_GL_RENDERBUFFER,
    GN_GL_SAMPLER,
    GN_GL_TEXTURE,
    GN_GL_VERTEX_ARRAY,
};
GLuint gn_gl_object_create(struct gn_gl *gl, enum gn_gl_object kind);
/* Also clears *name and what the state cache knows of it; 0 is legal. */
void gn_gl_object_destroy(struct gn_gl *gl, enum gn_gl_object kind, GLuint *name);

/* ---- programs (program.c) ---- */

struct gn_gl_program {
    struct gn_program_key key;
    GLuint name;             /* 0: an empty place of the table */
    GLint u_pass, u_uv;      /* locations, or -1 */
    uint32_t attributes;     /* bit per location that it reads */
    uint32_t texture_slots;  /* bit per gn_texture_slot that it reads */
    uint64_t constants_hash; /* of what u_pass holds; 0: nothing yet */
    uint32_t uv;             /* which row of gl->scene.uv u_uv holds; UINT32_MAX: none yet */
};
struct gn_gl_programs { /* open addressing, room is a power of two, at most half full */
    struct gn_gl_program *table;
    uint32_t room, count;
};
struct gn_gl_program *gn_gl_program_find(struct gn_gl *gl, const struct gn_program_key *key);
bool gn_gl_program_ensure(struct gn_gl *gl, const struct gn_program_key *key, struct gn_err *err);
void gn_gl_programs_finish(struct gn_gl *gl);
/* Compiles and links two sources; 0 and the driver's first line on failure. */
GLuint gn_gl_program_link(struct gn_gl *gl, const char *vertex, const char *fragment,
                          struct gn_err *err);

/* ---- the scene on the GPU (upload.c, texture.c) ---- */

struct gn_gl_curve {   /* sRGB by table (mipmap.c) */
    float decode[256]; /* of a byte: its light, in quarter steps of encode */
    uint8_t encode[8192];
};
void gn_gl_curve_init(struct gn_gl_curve *curve);
/* Makes *image half as large, in new memory that is also returned: the caller frees it. */
uint8_t *gn_gl_image_halve(const struct gn_gl_curve *curve, struct gn_image *image, bool srgb);
/* The same row by row: the size of the half, then some of its rows. */
struct gn_image gn_gl_image_half(const struct gn_image *image);
void gn_gl_image_halve_rows(const struct gn_gl_curve *curve, const struct gn_image *image,
                            uint32_t first, uint32_t count, bool srgb, uint8_t *out);

struct gn_gl_vertices { /* one vertex array per set of attributes in use */
    GLuint name;
    uint32_t attributes;
    GLuint instances; /* the buffer and the byte that its instance attributes point to */
    size_t offset;
};
enum { GN_GL_VERTICES_MAX = 32, GN_GL_INSTANCE_RING = 3, GN_GL_SAMPLER_KINDS = 144 };
struct gn_gl_picture { /* one that is being sent, a few rows at a time */
    struct gn_image image;
    uint8_t *owned; /* its pixels, if they are ours; freed when it is sent */
    bool open, srgb, mipmaps;
    GLint level;
    GLsizei levels;
    uint32_t row; /* of the level: sent so far */
    struct gn_image half;
    uint8_t *half_owned; /* the next level, as far as it is made */
};
enum gn_gl_upload_phase {
    GN_GL_UPLOAD_POSITIONS,
    GN_GL_UPLOAD_ATTRIBUTES,
    GN_GL_UPLOAD_INDICES,
    GN_GL_UPLOAD_PICTURES,
    GN_GL_UPLOAD_DONE,
};
struct gn_gl_upload {
    enum gn_gl_upload_phase phase;
    uint32_t first; /* vertex, index or use of a texture that comes next */
    struct gn_gl_curve *curve;
    struct gn_gl_picture picture;
};
struct gn_gl_scene {
    const struct gn_scene *scene;
    struct gn_gl_upload upload;
    GLuint positions, attributes, indices;
    GLenum index_type;
    size_t index_size;
    GLsizei attribute_stride;
    GLint attribute_at[GN_ATTRIBUTE_COUNT]; /* byte offsets; -1: no such in this scene, or the
                                               position */
    uint32_t image_count;                   /* kept: the scene may be gone when we finish */
    GLuint *images[2];                      /* by image: linear, sRGB; 0 where not used so */
    GLuint samplers[GN_GL_SAMPLER_KINDS];
    float (*uv)[2 * GN_TEXTURE_SLOT_COUNT][4]; /* different sets of transforms */
    uint32_t *material_uv;                     /* by material: index into uv */
    uint32_t uv_count;
    uint64_t buffer_bytes, texture_bytes;
    struct gn_gl_vertices vertices[GN_GL_VERTICES_MAX];
    uint32_t vertices_count;
};
void gn_gl_scene_begin(struct gn_gl *gl, const struct gn_scene *scene);
/* Sends about so many bytes; *done: that was all of it. After a failure nothing is left. */
bool gn_gl_scene_step(struct gn_gl *gl, size_t bytes, bool *done, struct gn_err *err);
/* The staged scene and the one that is shown change places. */
void gn_gl_stage_swap(struct gn_gl *gl);
void gn_gl_scene_finish(struct gn_gl *gl);
/* The vertex array for a set of attributes, made if need be; false when there are too many. */
bool gn_gl_vertices_ensure(struct gn_gl *gl, uint32_t attributes, struct gn_err *err);
bool gn_gl_vertices_known(struct gn_gl *gl, uint32_t attributes);
void gn_gl_vertices_bind(struct gn_gl *gl, uint32_t attributes, uint32_t first_instance);
/* Sends about so many bytes; true: that was all of it. */
bool gn_gl_textures_step(struct gn_gl *gl, size_t bytes);
void gn_gl_textures_finish(struct gn_gl *gl);
void gn_gl_texture_bind(struct gn_gl *gl, uint32_t slot, const struct gn_texture_ref *ref);
void gn_gl_slide_bind(struct gn_gl *gl, uint32_t slide, uint32_t texture);

struct gn_gl_instances { /* a ring, so that a frame does not wait for the one before */
    GLuint buffers[GN_GL_INSTANCE_RING];
    size_t room[GN_GL_INSTANCE_RING];
    uint32_t current;
    uint64_t hash; /* of what the current one holds */
};
void gn_gl_instances_upload(struct gn_gl *gl, const struct gn_instance *instances, size_t count);

/* ---- targets (target.c) ---- */

struct gn_gl_output {
    uint32_t width_px, height_px, msaa, msaa_wanted;
    enum gn_output_format format;
    bool made;
    bool window;  /* the finished picture goes to the display's framebuffer, whose name is 0 */
    bool encodes; /* a last pass does */
    bool stencil; /* beside the depth, in `depth` */
    GLuint framebuffer, color, depth;
    GLuint resolved, resolved_color; /* without msaa the same as framebuffer, and 0 */
    /* Of a linear picture that is encoded at the end: itself, to be read by a shader, and its
     * bytes. */
    GLuint texture, encoded, encoded_color;
    uint64_t bytes;
};
struct gn_gl_map { /* or what one is filtered into */
    uint32_t slot;
    enum gn_encoding encoding; /* without moments */
    enum gn_moments moments;   /* then it has no depth */
    uint32_t index;            /* of those with moments */
    bool mipmaps;              /* as in gn_target */
    uint32_t width_px, height_px;
    GLuint framebuffer, texture, depth;
    uint64_t content_hash[GN_SHADOW_TILES_MAX]; /* of each tile; 0: nothing */
    bool cleared; /* all of it, before the tiles that are being drawn */
    uint64_t bytes, last_used;
};
enum { /* kept: plans that take turns find their maps again, until they are too much */
       GN_GL_MAPS_MAX = 8 * GN_ALL_SHADOWS_MAX,
       GN_GL_MAPS_MB = 256,
       GN_GL_SLOT_PAGES = GN_ALL_SHADOWS_MAX, /* whose pages all maps of its kind share */
};
enum gn_gl_map_sampler {
    GN_GL_MAP_NEAREST,
    GN_GL_MAP_LINEAR,
    GN_GL_MAP_TRILINEAR,
    GN_GL_MAP_COMPARE,
    GN_GL_MAP_COMPARE_LINEAR,
    GN_GL_MAP_SAMPLER_COUNT,
};
struct gn_gl_targets {
    struct gn_gl_output output;
    struct gn_gl_map maps[GN_GL_MAPS_MAX];
    GLuint map_samplers[GN_GL_MAP_SAMPLER_COUNT];
    uint64_t prepares;
    bool wants_stencil;        /* some plan will: the output is not made twice for it */
    struct gn_gl_output pixel; /* 1 x 1, else as a plan's output: what warm draws go to */
};
bool gn_gl_targets_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* The maps of a plan alone, for one that is not drawn yet. */
bool gn_gl_maps_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* gl->targets.pixel as the plan's output. */
bool gn_gl_pixel_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* Where the finished picture is to be read, and what of. */
GLuint gn_gl_output_finished(const struct gn_gl_output *output);
enum gn_output_format gn_gl_output_format(const struct gn_gl_output *output);
/* What a target that is no picture is drawn to, the pages of a map among them; NULL: not made. */
struct gn_gl_map *gn_gl_target_find(struct gn_gl *gl, const struct gn_target *target);
/* Its smaller levels, if it has such, after the largest was drawn. */
void gn_gl_target_reduce(struct gn_gl *gl, const struct gn_gl_map *map);
/* What shaders read of a light: moments of the map, or the map itself. */
struct gn_gl_map *gn_gl_view_find(struct gn_gl *gl, const struct gn_shadow_view *view,
                                  uint32_t slot, bool moments);
struct gn_gl_map *gn_gl_map_of_slot(struct gn_gl *gl, uint32_t slot); /* used last; NULL if none */
void gn_gl_targets_forget(struct gn_gl *gl); /* maps hold nothing any more */
uint64_t gn_gl_targets_bytes(const struct gn_gl *gl);
void gn_gl_targets_init(struct gn_gl *gl);
void gn_gl_targets_finish(struct gn_gl *gl);
/* The framebuffer that is bound; false if the driver will not have it. */
bool gn_gl_framebuffer_check(struct gn_gl *gl, const char *what, struct gn_err *err);

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
/* What the driver said since the last time; true when nothing. */
bool gn_gl_error_check(struct gn_gl *gl, const char *what, struct gn_err *err);
/* Takes a pending error out of the driver's hands, for the next gn_gl_error_check: what GetError
 * says then is about what comes between. */
void gn_gl_error_keep(struct gn_gl *gl);

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
    bool desktop, debug, robust; /* robust: it tells when the GPU was reset */
    uint32_t probed;             /* gn_cap bits that were tried: caps holds how it ended */
    char *shaders;               /* folder, or NULL */
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
    uint8_t *read_buffer;       /* of gn_gl_read_xrgb8888() */
    size_t read_size;
    struct gn_gl_program **plan_programs; /* of the plan that runs; room grows in prepare */
    uint32_t plan_programs_room;
    struct gn_gl_stats stats;
    uint64_t objects_created;
    uint64_t programs_made; /* tried ones too */
    uint64_t
        programs_run;     /* of them, when a plan had run last: many drivers compile as they draw */
    bool (*stop)(void);   /* see gn_gl_opts */
    char debug_text[256]; /* the driver's first complaint since the last check */
    char *failed_source;  /* see gn_gl_failed_source() */
};

#define GL(gl, name) ((gl)->calls++, (gl)->fn.name)

#endif
