#include "scene/poses.h"

#include <math.h>

#include "scene/deform.h"
#include "scene/private.h"

enum { POSED = 400000 }; /* triangles */
#define STAYS 1.5f

int gn_poses_count(const struct gn_pose *pose, uint64_t triangles, int most) {
    while (most > 1 && (uint64_t)most * triangles > POSED) most /= 2;
    return triangles > 0 && gn_scene_period_ns(pose) > 0 ? most : 1;
}

void gn_poses_step(struct gn_pose *pose, int at, int count) {
    gn_pose_step(pose, gn_scene_period_ns(pose) / count * at);
}

void gn_poses_find_places(struct gn_pose *pose, int count, struct gn_poses_place *places) {
    const uint32_t items = pose->scene->item_count;
    for (uint32_t i = 0; i < items; i++) places[i] = (struct gn_poses_place){.box = GN_BOX_EMPTY};
    for (int p = 0; p < count; p++) {
        gn_poses_step(pose, p, count);
        for (uint32_t i = 0; i < items; i++) {
            const struct gn_box *box = &pose->items[i].box_ws;
            gn_box_join(&places[i].box, box);
            for (int k = 0; k < 3; k++)
                places[i].widest_m[k] = fmaxf(places[i].widest_m[k], box->max[k] - box->min[k]);
        }
    }
}

bool gn_poses_stays(const struct gn_poses_place *place, int axis) {
    return place->box.max[axis] - place->box.min[axis] <= STAYS * place->widest_m[axis];
}
