/* What the driver's compiler says about the programs that it makes: Mesa tells it by KHR_debug. */
#ifndef GN_TESTS_GPUS_COST_H
#define GN_TESTS_GPUS_COST_H

#include "gl/private.h"

enum { GN_COST_STAGES = 6, GN_COST_UNKNOWN = -1 };
struct gn_cost_stage {
    char name[16]; /* fragment, vertex, binning, position, varying */
    unsigned instructions, spills;
    int fetches; /* of texels; GN_COST_UNKNOWN: the compiler does not say */
};
struct gn_cost { /* of a program */
    struct gn_cost_stage stages[GN_COST_STAGES];
    int count;
};
struct gn_listener {
    struct gn_gl *gl;
    struct gn_cost *into; /* NULL: what is compiled is of no program of ours */
    unsigned errors;
    unsigned framebuffers, incomplete; /* every one that is asked about */
};
/* From now on the listener hears what the driver says, and counts framebuffers; one at a time.
 * Errors still reach gn_gl_error_check(). */
void gn_cost_listen(struct gn_listener *listener, struct gn_gl *gl);
/* Whether both of its stages were compiled for the GPU. */
bool gn_cost_is_whole(const struct gn_cost *cost);
/* One line of the driver's, "FRAGMENT shader: 22 inst, .., 0:0 spills:fills"; false: it is none. A
 * stage that is told of again is the later one: drivers compile once more for what is bound. */
bool gn_cost_read(struct gn_cost *cost, const char *line);
/* Deletes all programs, so that each is compiled again when it is needed. */
void gn_cost_forget_programs(struct gn_gl *gl);
/* Links program `index` of the plan and draws with it wherever the plan does, and hears what that
 * cost. `name` is for errors: a program that does not link or draw, a stage that was not compiled.
 */
bool gn_cost_compile(struct gn_listener *listener, const struct gn_plan *plan, uint32_t index,
                     const char *name, struct gn_cost *cost, struct gn_err *err);
/* Of all that a driver compiles by: the program's name, its sources, and the picture's form. False:
 * no sources. */
bool gn_cost_hash(const struct gn_gl *gl, const struct gn_plan *plan,
                  const struct gn_program_key *key, const char *name, uint64_t *out);
/* What a file of an earlier run has of the program with that hash; path may be NULL. */
bool gn_cost_find(const char *path, uint64_t hash, struct gn_cost *cost);

/* Keys of programs; it grows, and is never freed. */
struct gn_keys {
    struct gn_program_key *at;
    uint32_t count, room;
};
bool gn_keys_have(const struct gn_keys *keys, const struct gn_program_key *key);
void gn_keys_add(struct gn_keys *keys, const struct gn_program_key *key);

#endif
