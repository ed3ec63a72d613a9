/* The view of each light that has shadows: how large its map is, how many cascades it has. */
#include "core/hash.h"
#include "frame/private.h"
#include "shadow/cascade.h"

/* The view of a light that has a value for each pixel instead of a map. */
static void lay_screen(const struct gn_frame *frame, uint32_t light, struct gn_shadow_view *view) {
    *view = (struct gn_shadow_view){
        .light = light,
        .technique = GN_TECHNIQUE_TRUTH,
        .encoding = GN_ENCODING_SCREEN,
        .perspective = gn_light_types[frame->scene->lights[light].type].has_position,
        .map = {.width_px = frame->plan.width_px,
                .height_px = frame->plan.height_px,
                .tile_count = 1},
        .raster.tiles[0].content_hash = 1,
    };
}

/* The lesson about clearing: the near end's code stands where nothing is drawn. What is drawn is
 * the same, so the hash has to differ. */
static void set_clear(struct gn_shadow_view *view, bool near_end) {
    struct gn_shadow_code *code = &view->code;
    code->clear = near_end ? code->scale * code->near_m + code->offset : code->far_end;
    for (uint32_t i = 0; near_end && i < view->map.tile_count; i++) {
        uint64_t *hash = &view->raster.tiles[i].content_hash;
        *hash = gn_hash(*hash, &code->clear, sizeof code->clear) | 1;
    }
}

/* Mipmaps would mix the tiles of a map: those are blurred instead. */
static void take_mipmaps(struct gn_frame *frame, struct gn_frame_light *light,
                         struct gn_shadow_opts *shadow, struct gn_warnings *warnings) {
    const struct gn_light *l = &frame->scene->lights[light->light];
    const bool tiles = shadow->cascades > 1 || gn_shadow_tile_count(l->type, light->technique) > 1;
    if (shadow->moments != GN_MOMENTS_RGBA16F_MIPS || !tiles) return;
    light->moments = shadow->moments = GN_MOMENTS_RGBA16F;
    if (gn_frame_notice(&frame->notes.lights.at[light->light].said, GN_NOTICE_ENCODING, warnings))
        gn_warn(warnings, "light '%s': its map has tiles, which %s would mix; using %s", l->name,
                gn_moments[GN_MOMENTS_RGBA16F_MIPS].name, gn_moments[light->moments].name);
}

/* What options and the scene want the map of a slot to be; map_px: its side, or that of each of its
 * tiles. */
static struct gn_shadow_opts wanted_map(struct gn_frame *frame, const struct gn_frame_opts *opts,
                                        uint32_t slot) {
    const struct gn_frame_light *light = gn_frame_light_of_slot(frame, slot);
    uint32_t px = light->opts.map_px;
    if (!px) px = gn_techniques[light->technique].map_px;
    if (!px) px = 1024;
    if (light->encoding == GN_ENCODING_STENCIL) px = 0; /* no map */
    return (struct gn_shadow_opts){.technique = light->technique,
                                   .encoding = light->encoding,
                                   .moments = light->moments,
                                   .map_px = gn_technique_map_px(light->technique, px),
                                   .plane = gn_frame_plane_of_slot(frame, slot),
                                   .points = opts->shadow.planar_points,
                                   .all_receive = opts->debug.aov == GN_AOV_VISIBILITY,
                                   .but_floor = frame->floor.is_apart,
                                   .light = light->opts,
                                   .cascades = opts->shadow.cascades ? opts->shadow.cascades
                                                                     : GN_CASCADES_MAX};
}

void gn_frame_fit_shadows(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts, struct gn_warnings *warnings) {
    struct gn_shadow_opts maps[GN_ALL_SHADOWS_MAX];
    for (uint32_t slot = 0; slot < frame->view_count; slot++) {
        /* how large the light's map is wanted, as far as this GPU's textures go */
        struct gn_frame_light *light = gn_frame_light_of_slot(frame, slot);
        if (frame->floor.is_apart && slot == frame->floor.slot) {
            maps[slot] = wanted_map(frame, opts, slot);
            gn_frame_want_floor(frame, pose, &maps[slot]);
            gn_frame_make_memories(frame, slot, 1);
            continue;
        }
        maps[slot] =
            (struct gn_shadow_opts){.technique = light->technique, .encoding = light->encoding};
        light->cascades = 1;
        if (gn_techniques[light->technique].on_screen) continue;
        const struct gn_light *l = &frame->scene->lights[light->light];
        struct gn_shadow_opts *shadow = &maps[slot];
        *shadow = wanted_map(frame, opts, slot);
        const uint32_t asked = shadow->map_px, most = gn_frame_most_px(frame, light, 1);
        if (asked > most) shadow->map_px = most;
        gn_frame_make_memories(frame, slot, gn_shadow_tile_count(l->type, light->technique));
        const bool can = gn_cascade_can(l, &frame->eye, shadow);
        if (light->opts.cascades > 0) shadow->cascades = can ? light->opts.cascades : 1;
        if (light->opts.cascades <= 1) gn_frame_choose_map(frame, pose, opts, slot, shadow);
        light->cascades = shadow->cascades;
        take_mipmaps(frame, light, shadow, warnings);
        if (shadow->cascades > 1) gn_frame_make_memories(frame, slot, GN_CASCADE_MEMORIES);
        const uint32_t most_each = gn_frame_most_px(frame, light, shadow->cascades);
        if (shadow->map_px > most_each) shadow->map_px = most_each;
        shadow->map_px = gn_technique_map_px(light->technique, shadow->map_px);
        if (shadow->map_px < asked &&
            gn_frame_notice(&frame->notes.lights.at[light->light].said, GN_NOTICE_MAP_PX, warnings))
            gn_warn(
                warnings,
                "light '%s': map tiles of %u px exceed the texture size of this GPU; using %u px",
                l->name, asked, shadow->map_px);
    }
    gn_frame_shrink_maps(frame, opts->shadow.maps_bytes, maps, warnings);
    /* An empty view keeps its slot: programs do not depend on what is visible. */
    for (uint32_t i = 0; i < frame->view_count; i++) {
        const uint32_t light = gn_frame_light_of_slot(frame, i)->light;
        if (gn_techniques[maps[i].technique].on_screen)
            lay_screen(frame, light, &frame->shadows[i]);
        else
            gn_shadow_fit(pose, light, &frame->eye, &maps[i], frame->memory[i], &frame->shadows[i]);
        set_clear(&frame->shadows[i], opts->shadow.clears_near);
    }
}
