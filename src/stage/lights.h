/* Settings of the lights of a scene: of all lights, of the made light (the key light of the
 * manuals) ([light] of the configuration) and of one light ([light "NAME"]). */
#ifndef GN_STAGE_LIGHTS_H
#define GN_STAGE_LIGHTS_H

#include "core/warn.h"
#include "frame/frame.h"
#include "options/settings.h"

/* Whether the section is of that light: by the name of its node, or its own. */
bool gn_light_section_is_of(const struct gn_named_section *section, const struct gn_scene *scene,
                            uint32_t light);
/* The entry of that light in opts->lights, made where there is none; NULL: no room. */
struct gn_light_opts *gn_stage_light_entry(struct gn_frame_shadow_opts *opts, uint32_t light);
/* Fills opts->any and opts->lights, by the rows of the table that have a target. A section that is
 * of no light gives a warning, unless there are other scenes.
 */
void gn_stage_set_lights(struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                         const struct gn_scene *scene, struct gn_warnings *warnings);
/* Turns the light that the loader added as [light] says, for the camera as it stands now. Without
 * that it shines as it was made, or as the key of the environment. */
void gn_stage_aim(struct gn_pose *pose, const struct gn_frame_opts *opts,
                  const struct gn_settings *settings);
/* Before that: the light made for a scene without any is the key of its environment, unless
 * settings change it. */
void gn_stage_set_key(struct gn_frame_shadow_opts *opts, const struct gn_scene *scene,
                      const struct gn_environment_key *key, float strength);
/* After both: whether settings leave the direction and colour of that light. */
bool gn_stage_keeps_key(const struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                        const struct gn_scene *scene);
/* What holds of a section, as "shadow = pcss, map = 512"; "" if that is nothing. */
void gn_stage_print_light(const struct gn_settings *settings,
                          const struct gn_named_section *section, char *out, size_t size);

#endif
