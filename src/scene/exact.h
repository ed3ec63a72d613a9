/* Transforms of nodes; in double precision where a scene lies so far from its file's origin that
 * floats lose what is small in it. Inside the scene room. */
#ifndef GN_SCENE_EXACT_H
#define GN_SCENE_EXACT_H

#include "scene/pose.h"

struct gn_exact { /* columns, as in a mat4 */
    double m[4][4];
};

/* In floats, without what the file has beyond them. */
void gn_node_local(const struct gn_node *node, mat4 parent_from_node);

struct gn_exact gn_exact_of(const struct gn_node *node); /* parent_from_node */
struct gn_exact gn_exact_mul(const struct gn_exact *a, const struct gn_exact *b);
struct gn_exact gn_exact_from(mat4 m);

/* Sets pose->exact and pose->world_from_node of a node whose parent has them. */
void gn_exact_step(struct gn_pose *pose, const struct gn_node *node, uint32_t i);
/* world_from_x, whose origin is the scene's: of what stands in a node by node_from_x (NULL: the
 * node itself), with x_origin taken off its positions (NULL: 0). */
void gn_exact_place(const struct gn_pose *pose, uint32_t node, vec4 *node_from_x,
                    const double *x_origin, mat4 world_from_x);
/* A place of this world as the translation of a node without parents: that adds the origin. */
void gn_exact_put(const struct gn_scene_place *place, const float *position_ws, vec3 translation,
                  vec3 rest);

#endif
