/* Files of models that gnomon does not read itself: gnomon-import makes .glb files of them. */
#ifndef GN_CORE_MODEL_H
#define GN_CORE_MODEL_H

enum gn_model_format {
    GN_MODEL_OBJ,
    GN_MODEL_FBX,
    GN_MODEL_STL,
    GN_MODEL_PLY,
    GN_MODEL_DAE,
    GN_MODEL_FORMAT_COUNT
};

struct gn_model_row {
    const char *name;   /* for people: "Collada" */
    const char *suffix; /* of their files: ".dae" */
};
extern const struct gn_model_row gn_model_formats[GN_MODEL_FORMAT_COUNT];

/* By the end of the name, in capitals or not; GN_MODEL_FORMAT_COUNT if it is none of them. */
enum gn_model_format gn_model_format_of(const char *path);

#endif
