/* What tests of plans share: a builder over the scene of stage_scene.h, and goldens. */
#ifndef GN_TESTS_PLAN_FIXTURE_H
#define GN_TESTS_PLAN_FIXTURE_H

#include "frame/frame.h"

#define GN_EVERY_CAP ((1u << GN_CAP_COUNT) - 1)

struct gn_plan_fixture {
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_frame *frame;
    struct gn_frame_opts opts;
};

/* At 0 s, on a GPU with those capabilities. */
void gn_plan_begin(struct gn_plan_fixture *f, uint32_t caps);
void gn_plan_end(struct gn_plan_fixture *f);
/* The plan of what the fixture holds by now, warnings dropped. */
const struct gn_plan *gn_plan_make(struct gn_plan_fixture *f);
/* Compares with tests/plan/golden/NAME.txt; GN_UPDATE=1 writes that. */
void gn_plan_expect(const struct gn_plan *plan, const char *name);
/* Gives it `lights`, its own and ten more spots and bulbs along a row, most of them of short range;
 * the bulbs cast nothing. */
void gn_plan_add_lights(struct gn_plan_fixture *f, struct gn_light lights[13]);

#endif
