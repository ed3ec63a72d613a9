/* Makes glTF files in memory for tests: JSON written with ' for ", and a growing buffer 0. */
#ifndef GN_TESTS_UNIT_GLTF_MAKER_H
#define GN_TESTS_UNIT_GLTF_MAKER_H

#include <jansson.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

struct gn_maker {
    json_t *root;
    uint8_t *bin;
    size_t size;
};

struct gn_made {
    uint8_t *data; /* free() it */
    size_t size;
};

/* asset 2.0, no more. */
void gn_maker_init(struct gn_maker *maker);
void gn_maker_finish(struct gn_maker *maker);

/* Sets or replaces a key of the root. */
void gn_maker_set(struct gn_maker *maker, const char *key, const char *json);
/* Adds to an array of the root ("nodes", ..), which is made; returns the index. */
int gn_maker_add(struct gn_maker *maker, const char *array, const char *json);
/* A bufferView of these bytes, aligned to 4; returns its index. */
int gn_maker_view(struct gn_maker *maker, const void *data, size_t size);
/* A view and an accessor on it; `more` is JSON members to add ("'normalized':true") or NULL. */
int gn_maker_accessor(struct gn_maker *maker, const char *type, int component, size_t count,
                      const void *data, size_t size, const char *more);
/* The only clip: the node goes from one place to another in so many seconds. */
void gn_maker_move(struct gn_maker *maker, int node, float seconds, const float from[3],
                   const float to[3]);
/* So many directional lights from above, of so many lux each, some hundredths of a radian apart,
 * with a node each: the file's only ones. */
void gn_maker_suns(struct gn_maker *maker, int count, double lux);
/* The only scene: all nodes that there are, with a background of that grey or colour, JSON; NULL:
 * without. */
void gn_maker_show_all(struct gn_maker *maker, const char *background);
/* A 2 x 2 square in y = 0, facing up, as mesh 0 (accessors 0 and 1, no normals), node 0 with it,
 * and a scene. */
void gn_maker_square(struct gn_maker *maker);
/* The square with a skin and two targets: joint 0 (node 1) has the corners at x = -1, joint 1 (its
 * child, node 2, 2 to the right) those at x = 1; the targets lift all corners by 1, and move the
 * first by 1 along x. Accessor 2: joints, 3: weights, 4 and 5: targets, 6: bind matrices. */
void gn_maker_posed_square(struct gn_maker *maker);
/* Triangles of these vertices, as mesh 0, with a skin of the nodes that there are, which count as
 * many: four joints and weights a vertex. Adds its node and a scene of all nodes. */
void gn_maker_skinned(struct gn_maker *maker, int nodes, size_t vertices,
                      const float (*positions)[3], const uint16_t (*joints)[4],
                      const float (*weights)[4]);
/* A cube from -1 to 1 as the next mesh: closed, flat normals left to the loader. */
void gn_maker_cube(struct gn_maker *maker);

struct gn_made gn_maker_glb(struct gn_maker *maker);
/* Buffer 0 as a data URI. */
struct gn_made gn_maker_gltf(struct gn_maker *maker);
/* As .glb, into that file; finishes the maker. */
bool gn_maker_write(struct gn_maker *maker, const char *path, struct gn_err *err);
/* As .glb, called "t" in messages; finishes the maker. A scene has passed gn_scene_check. */
struct gn_scene *gn_maker_load(struct gn_maker *maker, struct gn_warnings *warnings,
                               struct gn_err *err);

/* A PNG of width x height in RGBA, or grey of 16 bits; and a JPEG. */
struct gn_made gn_maker_png(uint32_t width, uint32_t height, const uint8_t *rgba);
struct gn_made gn_maker_png_grey16(uint32_t width, uint32_t height, const uint16_t *grey);
struct gn_made gn_maker_jpeg(int width, int height, const uint8_t *rgb);

#endif
