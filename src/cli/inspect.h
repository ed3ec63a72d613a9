/* What is in a scene, what it costs and what is wrong with it, without a GPU. */
#ifndef GN_CLI_INSPECT_H
#define GN_CLI_INSPECT_H

#include <stdio.h>

#include "cli/inspect_time.h"
#include "cli/problem.h"
#include "core/err.h"
#include "core/warn.h"
#include "frame/frame.h"
#include "options/settings.h"
#include "scene/scene.h"

enum { GN_INSPECT_WIDTH_PX = 1280, GN_INSPECT_HEIGHT_PX = 720, GN_INSPECT_CAMERAS = 64 };

struct gn_scene_cost { /* of the default view: first camera, 1280x720, time 0, a GPU with all
                          capabilities */
    uint32_t passes, shadow_passes; /* a map of several tiles has a pass for each */
    uint32_t draws, shadow_draws, programs, culled;
    uint64_t triangles, shadow_triangles;
    uint64_t vertex_bytes, index_bytes, texture_bytes; /* on the GPU, with mip-maps */
    uint64_t map_bytes, target_bytes;                  /* shadow maps; the picture with its depth */
};

struct gn_inspection {
    const char *file; /* as in messages */
    const struct gn_scene *scene;
    const struct gn_warnings *warnings; /* of loading, and of a frame */
    const struct gn_settings *settings; /* for [light "NAME"], or NULL */
    char limits[400];                   /* as gn_scene_limits_print() makes them, or "" */
    struct gn_light made_light; /* as it is used, if the scene has one: last in the scene's list */
    struct gn_scene_cost cost;
    float depths_m[GN_INSPECT_CAMERAS][2]; /* of the first cameras: near and far plane, as drawn */
    struct gn_problem_list advice;
    const struct gn_inspect_time *time; /* of --for, or NULL */
};

/* All but `limits` and `settings` of it; file, scene and warnings must outlive it. shadow: NULL, or
 * the triangles of a frame at most, and the lights as the configuration and the environment have
 * them. Adds what a frame warns of: a light without the shadow it asks for. */
void gn_inspect_build(struct gn_inspection *in, const char *file, const struct gn_scene *scene,
                      const struct gn_frame_shadow_opts *shadow, struct gn_warnings *warnings);
/* Fills advice; the cost must be known. */
void gn_inspect_advise(struct gn_inspection *in);

/* Adds what baking the file would save; path: NULL, or any format. */
void gn_inspect_advise_bake(struct gn_inspection *in, const char *path,
                            const struct gn_scene_limits *limits);

void gn_inspect_print(const struct gn_inspection *in, FILE *to);
/* One object:
 * file, name, size_m [x, y, z],
 * counts {nodes, items, instances, batches, geometries, vertices, triangles, textures, skins,
 *     joints, targets} (targets: of all nodes; here and below without a made floor, and without
 *     the nodes of a made light and camera),
 * materials {count, opaque, mask, blend, unlit, double_sided} (glTF's default one counts),
 * floor_made (an unseen one, for shadows),
 * images [{width_px, height_px, alpha, bytes}],
 * lights [{name, type, intensity, unit, color, range_m|null, inner_deg|null, outer_deg|null,
 *     gnomon_shadow|null, gnomon_map_px|null, gnomon_radius, gnomon_shadow_strength,
 *     gnomon_slide|null, made, settings}] (settings: those of [light "NAME"], as text;
 *     intensity: of the strongest channel; made: not in the file),
 * cameras [{name, type, yfov_deg|null, half_height_m|null, near_m, far_m|null, drawn_near_m|null,
 *     made}] (drawn_near_m: near_m, or farther out; null: not known, of the 65th and later),
 * clips [{name, duration_s, channels, on}] (on: plays by default),
 * variants [name] (of materials),
 * hemisphere {sky, ground, background},
 * cost {width_px, height_px, passes, shadow_passes, draws, shadow_draws, programs, culled,
 *     triangles, shadow_triangles, vertex_bytes, index_bytes, texture_bytes, map_bytes,
 *     target_bytes, memory_bytes, loading_bytes (at most, while it was loaded)},
 * time (with --for, as gn_inspect_time_json() has it; else it is left out),
 * limits (text: NAME=VALUE, ..),
 * warnings [text], warnings_dropped, advice [{what, cure}], advice_dropped. */
bool gn_inspect_print_json(const struct gn_inspection *in, FILE *to, struct gn_err *err);

#endif
