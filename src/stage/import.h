/* Scenes in other formats: the program gnomon-import converts them to glTF, so that a large
 * importer and its bugs do not run in this process. */
#ifndef GN_STAGE_IMPORT_H
#define GN_STAGE_IMPORT_H

#include <stdbool.h>

#include "core/file.h"
#include "scene/scene.h"

/* Does the name have the suffix of such a format (.obj .fbx .stl .ply .dae)? */
bool gn_import_wants(const char *path);
/* Of a glTF file that gn_scene_load() has refused: are its meshes compressed by Draco? */
bool gn_import_wants_refused(const char *path, const struct gn_scene_limits *limits);
/* Runs gnomon-import on the file and loads its output. The program is searched beside our own, in
 * ../libexec from there, in PREFIX/libexec and PREFIX/bin, and in PATH. Its warnings become ours;
 * if it crashes, runs out of time or memory, the import fails. What it makes of a .glb that names
 * no other file is kept (kept.h), so that Draco's meshes are decompressed once. */
struct gn_scene *gn_import_load(const char *path, const struct gn_scene_limits *limits,
                                struct gn_warnings *warnings, struct gn_err *err);
/* The same, but the bytes of the .glb, which gn_bytes_finish() frees. */
bool gn_import_convert(const char *path, const struct gn_scene_limits *limits, struct gn_bytes *out,
                       struct gn_warnings *warnings, struct gn_err *err);

#endif
