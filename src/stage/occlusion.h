/* Occlusion of a scene's parts that stay where they are, made for the light of an environment: at
 * once, or by a thread while frames go on; then it fades in. Kept in the folder for caches, by what
 * it is made of. */
#ifndef GN_STAGE_OCCLUSION_H
#define GN_STAGE_OCCLUSION_H

#include "environment/environment.h"
#include "frame/frame.h"
#include "truth/occlusion.h"

/* Luminance of an environment that is turned about +Y by so much. */
struct gn_sky gn_stage_sky(const struct gn_environment_light *light, float turn_rad);

/* What of the options' light is occluded; without an environment that is even. */
struct gn_sky gn_stage_sky_of(const struct gn_frame_environment_opts *environment);

/* Of one scene, which must outlive it. */
struct gn_occluder;
struct gn_occluder *gn_occluder_create(const struct gn_scene *scene);
/* Waits for a thread that still works, which takes the work of some milliseconds; NULL is legal. */
void gn_occluder_destroy(struct gn_occluder *occluder);
/* Fills in what a frame with opts->occlusion.on draws with, for its environment and for the clips
 * of the pose. now: what is not made for these yet is made before this returns, by all processors;
 * else by a thread, and until then there is what was there before, at first nothing. */
void gn_occluder_give(struct gn_occluder *occluder, const struct gn_pose *pose,
                      struct gn_frame_opts *opts, bool now);
/* Takes what the thread has made, and moves the fade to this time. */
void gn_occluder_step(struct gn_occluder *occluder, int64_t now_ns);
/* Something was taken, or fades: frames differ. NULL is legal for both. */
bool gn_occluder_fades(const struct gn_occluder *occluder);
/* A thread works: step again soon. */
bool gn_occluder_works(const struct gn_occluder *occluder);

#endif
