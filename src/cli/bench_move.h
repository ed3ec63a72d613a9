/* What --move-lights and --move-casters of `gnomon bench` do: small circles, so that maps are drawn
 * again in each frame while the picture stays much the same. */
#ifndef GN_CLI_BENCH_MOVE_H
#define GN_CLI_BENCH_MOVE_H

#include "scene/pose.h"

struct gn_bench_move {
    bool lights, casters;
    mat4 *nodes, *items;          /* where the clips do not move them: as the pose had them */
    struct gn_box *boxes, box_ws; /* of the items, of all */
};
/* Takes a pose that nothing was moved in. Zeroed lights and casters: does nothing, as below. */
void gn_bench_move_init(struct gn_bench_move *move, const struct gn_pose *pose);
void gn_bench_move_finish(struct gn_bench_move *move);
/* Moves them in a pose of that scene that was just stepped, by the number of the frame: those that
 * shine from a place by a hundredth of the scene's size, others by a degree; casters, but planes,
 * by a five hundredth. Allocates nothing. */
void gn_bench_move_step(const struct gn_bench_move *move, struct gn_pose *pose, uint32_t frame);

#endif
