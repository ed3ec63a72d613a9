/* The part of a pose that goes from what was shown to what other clips make of it. */
#ifndef GN_SCENE_FADE_H
#define GN_SCENE_FADE_H

#include "scene/deform.h"
#include "scene/pose.h"

struct gn_fade {
    struct gn_fade_node { /* as it was shown */
        vec3 translation, scale;
        versor rotation;
        bool moves;
    } * nodes;         /* scene->node_count */
    float *weights;    /* deformation.weight_count */
    bool *morph_moves; /* deformation.morph_count */
};

void gn_fade_init(struct gn_fade *fade, const struct gn_scene *scene);
void gn_fade_finish(struct gn_fade *fade);
/* Keeps what pose->at.fade shows now of the locals and the weights, and what moves; in pose->before
 * by what clips. */
void gn_fade_keep(struct gn_fade *fade, struct gn_pose *pose, const struct gn_node *local,
                  const struct gn_deformer *deformer);
/* What moved moves on, towards what is chosen now. */
void gn_fade_mark(const struct gn_fade *fade, struct gn_pose *pose, struct gn_deformer *deformer);
/* A node that moves, as it is shown. */
struct gn_node gn_fade_node(const struct gn_fade *fade, const struct gn_pose *pose,
                            const struct gn_node *local, uint32_t i);
/* Weights: those of the clips, in `deformer`, to those that are shown. */
void gn_fade_weights(const struct gn_fade *fade, const struct gn_pose *pose,
                     struct gn_deformer *deformer);

#endif
