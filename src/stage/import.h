/* Scenes that are not glTF: gnomon-import, a program of its own, turns them into it, so that a
 * large importer and its bugs never run in this process. */
#ifndef GN_STAGE_IMPORT_H
#define GN_STAGE_IMPORT_H

#include <stdbool.h>

#include "scene/scene.h"

/* Does the name end as such a file's does (.obj .fbx .stl .ply .dae)? */
bool gn_import_wants(const char *path);
/* Runs gnomon-import on it and loads what that makes. The program is looked for beside our own, in
 * ../libexec from there, in PREFIX/libexec and PREFIX/bin, and in PATH. Its warnings become ours; a
 * crash of it, a timeout or want of memory is a failure like any other. Nothing is left on disk. */
struct gn_scene *gn_import_load(const char *path, const struct gn_scene_limits *limits,
                                struct gn_warnings *warnings, struct gn_err *err);

#endif
