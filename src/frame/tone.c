/* The tone of the picture: which operator maps its radiance, after exposure and before sRGB is
 * encoded. Surfaces are mapped as they are drawn, blended ones before they are blended; but where
 * groups of lights are added, the last pass maps their sum. The background is shown as it is. */
#include "frame/private.h"

/* What the scene's maker chose to see is left alone: lights of its own at their exposure. What is
 * lit by a light or an environment that gnomon made has highlights that its author has not seen. */
static enum gn_tone tone_of_scene(const struct gn_scene *scene,
                                  const struct gn_frame_environment_opts *environment) {
    return scene->added.light || (environment->of && !environment->reflected_only) ? GN_TONE_NEUTRAL
                                                                                   : GN_TONE_NONE;
}

void gn_frame_choose_tone(struct gn_frame *frame, const struct gn_frame_opts *opts,
                          struct gn_warnings *warnings) {
    const bool measured =
        opts->debug.aov != GN_AOV_COLOR || opts->output.linear || opts->output.floats;
    frame->plan.tone = measured ? GN_TONE_NONE
                       : opts->tone != GN_TONE_AUTO
                           ? opts->tone
                           : tone_of_scene(frame->scene, &opts->environment);
    if (frame->plan.tone == GN_TONE_NONE || frame->group_count < 2 ||
        frame->caps.has & 1u << GN_CAP_RGBA16F)
        return;
    frame->plan.tone = GN_TONE_NONE;
    if (gn_frame_notice(&frame->notes.said, GN_NOTICE_TONE, warnings))
        gn_warn(warnings, "this GPU cannot add lights in half floats: no tone mapping");
}

uint64_t gn_frame_tone_feature(const struct gn_frame *frame) {
    static const uint64_t features[GN_TONE_COUNT] = {
        [GN_TONE_NEUTRAL] = GN_FEATURE(TONE_NEUTRAL),
        [GN_TONE_ACES] = GN_FEATURE(TONE_ACES),
        [GN_TONE_AGX] = GN_FEATURE(TONE_AGX),
    };
    return features[frame->plan.tone];
}
