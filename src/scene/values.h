/* The part of a pose that is no transform: lights, cameras and materials as clips make them, and
 * what is hidden. Costs nothing where no clip names any. Inside the scene room. */
#ifndef GN_SCENE_VALUES_H
#define GN_SCENE_VALUES_H

#include "scene/pose.h"

struct gn_values {
    float *now;   /* animation.records with the clips applied; NULL: there are none */
    float *shown; /* mixed with those kept, by the pose's fade */
    float *kept;
    struct gn_light *lights; /* the pose's own; NULL: the scene's are enough */
    struct gn_camera *cameras;
    struct gn_material *materials;
    bool *flickers; /* by node: a clip that is on may hide it; NULL as pose->node_hidden */
    bool moves;     /* a clip that is on moves some, or one did that fades */
};

void gn_values_init(struct gn_values *values, struct gn_pose *pose);
void gn_values_finish(struct gn_values *values, struct gn_pose *pose);
/* Keeps what is shown now, for a fade. */
void gn_values_keep(struct gn_values *values, const struct gn_pose *pose);
/* Takes the numbers of the file, and forgets what moves unless it fades on. */
void gn_values_reset(struct gn_values *values, const struct gn_pose *pose, bool fades);
/* A clip that is on has this channel. */
void gn_values_mark(struct gn_values *values, const struct gn_pose *pose,
                    const struct gn_channel *channel);
/* When all are marked: nodes below others do as those. */
void gn_values_choose(struct gn_values *values, const struct gn_pose *pose);
/* Whether they change what is seen of the item, or where light passes it. */
bool gn_values_move_item(const struct gn_values *values, const struct gn_pose *pose,
                         const struct gn_item *item);
/* After the channels: makes the things, before items are posed. */
void gn_values_apply(struct gn_values *values, struct gn_pose *pose);
/* Of a caster whose holes may move. */
uint64_t gn_values_hash(const struct gn_pose *pose, const struct gn_item *item, uint64_t hash);

#endif
