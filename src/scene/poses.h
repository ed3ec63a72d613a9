/* The clips of a pose as some poses, even over their time. */
#ifndef GN_SCENE_POSES_H
#define GN_SCENE_POSES_H

#include "scene/pose.h"

/* How many, a power of 2: `most`, but so few that they have 400,000 triangles at most; 1 where
 * nothing moves. triangles: of one of them, 0 if those that matter do not move. */
int gn_poses_count(const struct gn_pose *pose, uint64_t triangles, int most);
/* Moves it to pose `at` of so many; the first is time 0. */
void gn_poses_step(struct gn_pose *pose, int at, int count);

struct gn_poses_place {
    struct gn_box box; /* over all of them, world space */
    float widest_m[3]; /* of the box in any one of them, along each axis */
    bool stays;        /* set by gn_poses_occlusion() */
};
/* Finds, of each item, its place; it leaves the pose at the last. */
void gn_poses_find_places(struct gn_pose *pose, int count, struct gn_poses_place *places);
/* Along that axis the item is where it was: its box over all poses is at most half as long again as
 * in one of them. */
bool gn_poses_stays(const struct gn_poses_place *place, int axis);

/* occlusion.c: how many poses a volume of occlusion is made of, and places of all items; of those
 * that take part in it over the clips of this pose, which it moves, `stays` is set. */
int gn_poses_occlusion(struct gn_pose *pose, struct gn_poses_place *places);

#endif
