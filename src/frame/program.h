/* Programs, and the steps that a frame is built in: one row each. A new pass is a file with its
 * step, its program in shaders_es/, and its two rows here. */
#ifndef GN_FRAME_PROGRAM_H
#define GN_FRAME_PROGRAM_H

#include <stdint.h>

/* X(NAME, printed name, vertex stage, fragment stage, kind of the passes that draw with it, what it
 * reads). BARE: vertices without a geometry; ENCODING: the fragment stage includes the file of
 * gn_program_key.encoding (of FILTER the step says that). */
/* clang-format off */
#define GN_PROGRAM_TABLE(X) \
    X(DEPTH, "depth", "depth.vert", "depth.frag", MAP, 0)                               /* casters, no colour */ \
    X(DISTANCE, "distance", "distance.vert", "distance.frag", MAP, GN_PROGRAM_ENCODING) /* casters */ \
    X(FLAT, "flat", "flat.vert", "flat.frag", PICTURE, 0)                               /* casters projected onto the plane, no colour */ \
    X(LIT, "lit", "lit.vert", "lit.frag", PICTURE, 0)                                   /* items */ \
    X(AOV, "aov", "lit.vert", "aov.frag", PICTURE, 0)                                   /* what of them is in `aov` */ \
    X(MARK, "mark", "mark.vert", "mark.frag", PICTURE, GN_PROGRAM_BARE)                 /* gizmo of a light */ \
    X(PANEL, "panel", "panel.vert", "panel.frag", PICTURE, GN_PROGRAM_BARE | GN_PROGRAM_ENCODING) /* a map, on the picture */ \
    X(BACKDROP, "backdrop", "backdrop.vert", "backdrop.frag", PICTURE, GN_PROGRAM_BARE) /* the environment behind everything */ \
    X(FLOOR, "floor", "floor.vert", "floor.frag", PICTURE, GN_PROGRAM_BARE)             /* an unseen floor, by a texture of its alpha */ \
    X(ENCODE, "encode", "encode.vert", "encode.frag", PICTURE, GN_PROGRAM_BARE)         /* the linear picture, encoded */ \
    X(MEAN, "mean", "encode.vert", "mean.frag", PICTURE, GN_PROGRAM_BARE)               /* the picture to a mean, or that over the picture */ \
    X(CAPTION, "caption", "caption.vert", "caption.frag", PICTURE, GN_PROGRAM_BARE)     /* texts */ \
    X(FILTER, "filter", "encode.vert", NULL, FILTER, GN_PROGRAM_BARE)                   /* a map or moments to moments; gn_filter_steps has the fragment stages */
/* clang-format on */

/* X(name): gn_frame_add_name(), which appends passes to the plan, in this order. */
#define GN_FRAME_STEPS(X)                                                                          \
    X(maps)                                                                                        \
    X(picture)                                                                                     \
    X(backdrop)                                                                                    \
    X(blended)                                                                                     \
    X(overlay)                                                                                     \
    X(encode)                                                                                      \
    X(mean)                                                                                        \
    X(scale)                                                                                       \
    X(captions)

enum { GN_PROGRAM_BARE = 1, GN_PROGRAM_ENCODING = 2 };
enum gn_program_kind {
#define X(NAME, ...) GN_PROGRAM_##NAME,
    GN_PROGRAM_TABLE(X)
#undef X
        GN_PROGRAM_KIND_COUNT,
};
struct gn_program_row {
    const char *name, *vertex, *fragment;
    uint8_t pass; /* gn_pass_kind */
    uint8_t reads;
};
extern const struct gn_program_row gn_programs[GN_PROGRAM_KIND_COUNT];

#endif
