/* Programs by key (program.c). */
#ifndef GN_GL_PROGRAM_H
#define GN_GL_PROGRAM_H

#include "gl/table.h"

struct gn_gl_program {
    struct gn_program_key key;
    GLuint name;         /* 0: free slot, or dropped */
    bool dropped;        /* it was there once */
    bool kept;           /* see gn_gl_keep_programs() */
    bool drawn;          /* the driver has compiled what it leaves to the first draw */
    uint64_t bytes;      /* see gn_gl_program_took(); 0: unknown */
    uint64_t made, used; /* values of programs.made when it was made, of programs.runs when a
                            plan with it last ran; 0: none has */
    GLint u_pass, u_uv, u_factors; /* locations, or -1 */
    uint32_t attributes;           /* bit per location that it reads */
    uint32_t texture_slots;        /* bit per gn_texture_slot that it reads */
    uint64_t constants_hash;       /* of what u_pass holds; 0: nothing yet */
    uint32_t set; /* which of gl->scene.sets u_uv and u_factors hold; UINT32_MAX: none yet */
};
struct gn_gl_programs { /* open addressing, room is a power of two, at most half full */
    struct gn_gl_program *table;
    uint32_t room, count;              /* of slots; the slots of dropped programs are in use */
    uint64_t runs;                     /* plans that ran */
    uint64_t measured_bytes, measured; /* that so many programs took */
    uint64_t made;                     /* includes gn_gl_try_program() */
    uint64_t made_at_run; /* value of `made` when a plan last ran: many drivers compile at the first
                             draw */
};
struct gn_gl_program *gn_gl_program_find(struct gn_gl *gl, const struct gn_program_key *key);
/* It was made in this context, and dropped. */
bool gn_gl_program_is_dropped(struct gn_gl *gl, const struct gn_program_key *key);
bool gn_gl_program_ensure(struct gn_gl *gl, const struct gn_program_key *key, struct gn_err *err);
/* Making it, or the first draws with it, allocated so much, which is added to its bytes. */
void gn_gl_program_took(struct gn_gl *gl, struct gn_gl_program *program, uint64_t bytes);
void gn_gl_programs_finish(struct gn_gl *gl);
/* A vertex shader: one triangle over the whole target, of three vertices without attributes. */
extern const char gn_gl_whole_vertex[];
/* Compiles and links two sources; 0 and the driver's first line on failure. */
GLuint gn_gl_program_link(struct gn_gl *gl, const char *vertex, const char *fragment,
                          struct gn_err *err);

#endif
