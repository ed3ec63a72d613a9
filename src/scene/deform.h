/* The part of a pose that deforms: the matrices of joints and the weights of targets, as texels
 * that vertex shaders fetch, and the bounds of what they move. Inside the scene room. */
#ifndef GN_SCENE_DEFORM_H
#define GN_SCENE_DEFORM_H

#include "scene/pose.h"

#define GN_POSE_LIMIT 1e18f /* the square of a larger number overflows */
#define GN_BOX_EMPTY                                                                               \
    (struct gn_box) {                                                                              \
        {INFINITY, INFINITY, INFINITY}, { -INFINITY, -INFINITY, -INFINITY }                        \
    }

void gn_box_join(struct gn_box *box, const struct gn_box *other);
/* Arvo, Transforming axis-aligned bounding boxes, Graphics Gems, 1990. */
struct gn_box gn_box_transform(mat4 m, const struct gn_box *box);

struct gn_deformer {
    float *weights;                 /* deformation.weight_count, with the clips applied */
    bool *skin_moves, *morph_moves; /* by skin, by morph: a channel changes it */
    struct gn_deformed_skin {
        uint64_t hash;
        bool mirrored, finite; /* most of its joints turn faces inside out; all are usable */
    } * skins;
    uint64_t *morph_hashes;
};

void gn_deformer_init(struct gn_deformer *deformer, struct gn_pose *pose);
void gn_deformer_finish(struct gn_deformer *deformer);
/* Takes the weights of the file. */
void gn_deformer_rest(struct gn_deformer *deformer, const struct gn_pose *pose);
/* The same, and forgets what moves. */
void gn_deformer_reset(struct gn_deformer *deformer, const struct gn_pose *pose);
/* When it is known which nodes move: which skins do. */
void gn_deformer_choose(struct gn_deformer *deformer, const struct gn_pose *pose);
bool gn_deformer_moves(const struct gn_deformer *deformer, const struct gn_item *item);
/* Where a channel writes its weights; NULL: it is of another kind. */
float *gn_deformer_weights(struct gn_deformer *deformer, const struct gn_pose *pose,
                           const struct gn_channel *channel);
/* After the nodes: writes the texels, of all skins and lists or of those that move. */
void gn_deformer_step(struct gn_deformer *deformer, struct gn_pose *pose, bool moving_only);
/* Sets box and world_from_item of an item with a skin, mirrored, visible; the box of one with
 * targets; and writes the matrix of one without a skin. */
void gn_deform_item(struct gn_deformer *deformer, struct gn_pose *pose, uint32_t item);
uint64_t gn_deform_hash(const struct gn_deformer *deformer, const struct gn_item *item,
                        uint64_t hash);

#endif
