#include "frame/private.h"

struct gn_frame_light_opts gn_frame_light_opts(const struct gn_frame_opts *opts, uint32_t light) {
    for (uint32_t i = 0; i < opts->shadow.light_count; i++)
        if (opts->shadow.lights[i].light == light) return opts->shadow.lights[i];
    return (struct gn_frame_light_opts){.light = light};
}

float gn_frame_filter_radius_px(const struct gn_frame_opts *opts,
                                const struct gn_frame_light_opts *one) {
    return one->given & GN_LIGHT_FILTER ? one->filter_radius_px : opts->shadow.filter_radius_px;
}
