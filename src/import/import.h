/* Shared by the files of one conversion. All of it runs in a child of gnomon-import that may crash
 * at any time: worker.c sets its limits, and its result goes into struct gn_import_report. What
 * knows assimp includes private.h instead. */
#ifndef GN_IMPORT_IMPORT_H
#define GN_IMPORT_IMPORT_H

#include <limits.h>

#include "config.h"
#include "core/err.h"
#include "core/file.h"
#include "core/model.h"
#include "core/warn.h"
#include "import/glb.h"

enum gn_import_up { GN_IMPORT_UP_AUTO, GN_IMPORT_UP_Y, GN_IMPORT_UP_Z };
struct gn_import_opts {
    const char *model, *out; /* out NULL: the model's name with .glb */
    enum gn_import_up up;
    int memory_mb, time_s, file_mb; /* limits: address space with the .glb beside it, CPU and wall
                                       time, size of a file */
    bool time_by_size;              /* less processor time where little is read */
};

struct gn_import_report { /* shared between the child and its parent */
    bool done;            /* the .glb is complete */
    int time_s;           /* the limit on processor time, which the parent enforces */
    int pid;              /* of the child */
    struct gn_err err;    /* the reason if not */
    struct gn_warnings warnings;
};

struct gn_import {
    const struct gn_import_opts *opts;
    struct gn_import_report *report;
    uint64_t read_bytes;         /* of the model and its files */
    uint64_t read_texels;        /* of pictures that were decoded */
    int opener;                  /* to the parent, which opens files: core/opener.h */
    enum gn_model_format format; /* GN_MODEL_FORMAT_COUNT: glTF */
    char folder[PATH_MAX];       /* real path of the model's folder; "" for "/" */
    char name[PATH_MAX];         /* path given to assimp: folder/name */
    const struct aiScene *scene; /* assimp's; of .glb and .gltf NULL */
    struct gn_glb glb;
    struct gn_warnings *warnings;
    struct gn_err *err;
    bool warned_materials; /* warned of a missing material file */
    bool has_area;         /* some triangle has one */
    json_t **primitives;   /* per aiMesh: its primitive, JSON null if empty, NULL if not made yet */
    int *meshes;           /* per aiMesh: glTF mesh of nodes with only this one, -1 if empty, or
                              GN_IMPORT_UNSEEN */
    int *materials;        /* per aiMaterial: glTF index, or GN_IMPORT_UNSEEN */
    struct gn_import_texture *textures;
    size_t texture_count;
    struct gn_import_node *nodes;
    size_t node_count, node_room;
    float low[3], high[3]; /* world-space bounding box */
};

/* ---- worker.c ---- */

/* Runs in the child: sets limits, gives up its rights, converts into fd, fills the report. opener:
 * a socket to the parent, see core/opener.h. */
void gn_import_work(const struct gn_import_opts *opts, int fd, int opener,
                    struct gn_import_report *report);

/* ---- memory.c ---- */

/* Sets the limits and the report used by the functions below. */
void gn_import_memory_begin(const struct gn_import_opts *opts, struct gn_import_report *report);
/* Returns size bytes, zeroed, or reports the failure and exits. */
void *gn_import_alloc(size_t size);
void *gn_import_grow(void *old, size_t size); /* as realloc */
/* Keeps so much of the limit free for what lies outside of the process, or exits as they do. */
void gn_import_reserve(size_t size);
void gn_import_no_memory(void) __attribute__((noreturn));

/* ---- folder.c ---- */

/* So many bytes were read: where the limit on time goes by them, processor time for them. */
void gn_import_extend_time(struct gn_import *import, size_t bytes);
/* Fills folder and name. Needs access to files. */
bool gn_import_folder_find(struct gn_import *import);
/* Reads the model itself. */
bool gn_import_model_read(struct gn_import *import, struct gn_bytes *bytes, struct gn_err *err);
/* Reads a file that the model names, by its path if that lies in the folder, else by its base name.
 * Returns false without a message if there is none. */
bool gn_import_folder_read(struct gn_import *import, const char *name, struct gn_bytes *bytes);
/* The name relative to the folder where it begins with it, without "./" and "file://". */
const char *gn_import_relative_name(const struct gn_import *import, const char *name);
/* ---- the scene ---- */

/* scene.c: of a format of assimp, into import->glb; scene_none.c in builds without it. */
bool gn_import_scene_build(struct gn_import *import);
/* gltf.c: a glTF file whose Draco-compressed meshes become plain ones. */
bool gn_import_gltf_build(struct gn_import *import);

#endif
