/* What shadow maps take on the GPU, and keeping that within a limit: tiles are halved until all
 * maps of the frame fit. The largest tiles go first, whatever light they are of: the eye sees the
 * coarse shadow beside a fine one, not the last doubling of a fine one. Of equal tiles those of the
 * map with the most bytes go first, a point light's six before a spot's one. Neither the pose nor
 * the camera decides, so that sizes stay while things move. */
#include "frame/private.h"
#include "shadow/cascade.h"

enum { LEAST_PX = 16 }; /* as of --map */

static uint64_t filter_bytes(const struct gn_map_need *need, uint32_t texture) {
    uint32_t size_px[2];
    gn_frame_filter_size(need->technique, &need->map, texture, size_px);
    return (uint64_t)size_px[0] * size_px[1] * gn_moments[need->moments].texel_bytes;
}

static uint64_t own_bytes(const struct gn_map_need *need) {
    const uint64_t texels = (uint64_t)need->map.width_px * need->map.height_px;
    const bool mipmaps = gn_moments[need->moments].mipmaps && need->map.tile_count == 1;
    const uint64_t filtered = need->moments ? filter_bytes(need, 0) : 0;
    return texels * gn_encodings[need->encoding].texel_bytes + filtered +
           (mipmaps ? filtered / 3 : 0);
}

/* Of the texture of far sides: beside the pages, or the map. */
static void set_backs_size(const struct gn_map_need *need, uint32_t size_px[2]) {
    size_px[0] = need->paged ? need->map.tile_px : need->map.width_px;
    size_px[1] = need->paged ? need->map.tile_px : need->map.height_px;
}

/* Lights share pages of one kind, far sides, and the textures between the steps of a filter. */
static uint64_t bytes_of(const struct gn_map_need *needs, uint32_t count) {
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct gn_map_need *need = &needs[i];
        const struct gn_filter_row *filter = gn_technique_filter(need->technique, need->moments);
        const uint64_t tile_px = need->map.tile_px;
        const unsigned texel_bytes = gn_encodings[need->encoding].texel_bytes;
        const uint64_t page_bytes = tile_px * tile_px * texel_bytes;
        uint64_t pages = need->paged ? page_bytes : 0;
        uint64_t backs = 0;
        uint32_t backs_px[2];
        set_backs_size(need, backs_px);
        if (need->backs) backs = (uint64_t)backs_px[0] * backs_px[1] * texel_bytes;
        uint64_t steps = 0; /* the textures that the filter has beside the light's own one */
        uint32_t seen = 1;  /* bits of textures */
        for (uint32_t k = 0; need->moments && k < filter->count; k++) {
            const uint32_t to = filter->stages[k].to;
            if (!(seen >> to & 1)) steps += filter_bytes(need, to);
            seen |= 1u << to;
        }
        for (const struct gn_map_need *other = needs; other < need; other++) {
            if (other->moments == need->moments &&
                gn_techniques[other->technique].filter == gn_techniques[need->technique].filter &&
                other->map.width_px == need->map.width_px &&
                other->map.height_px == need->map.height_px &&
                other->map.cell_px == need->map.cell_px &&
                other->map.tile_count == need->map.tile_count)
                steps = 0; /* the two use the same textures between the steps */
            if (other->paged && need->paged && other->encoding == need->encoding &&
                other->map.tile_px == need->map.tile_px)
                pages = 0;
            uint32_t others_px[2];
            set_backs_size(other, others_px);
            if (other->backs && need->backs && other->encoding == need->encoding &&
                others_px[0] == backs_px[0] && others_px[1] == backs_px[1])
                backs = 0;
        }
        bytes += own_bytes(need) + steps + pages + backs;
    }
    return bytes;
}

uint64_t gn_plan_map_bytes(const struct gn_plan *plan) {
    struct gn_map_need needs[GN_ALL_SHADOWS_MAX];
    for (uint32_t i = 0; i < plan->shadow_count; i++) {
        const struct gn_shadow_view *view = &plan->shadows[i];
        needs[i] = (struct gn_map_need){.technique = view->technique,
                                        .encoding = view->encoding,
                                        .moments = view->moments,
                                        .map = view->map,
                                        .paged = (view->map.cascade_count > 0 && !view->empty) ||
                                                 view->raster.drawn.paged};
    }
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (plan->passes[i].target.kind == GN_TARGET_BACKS)
            needs[plan->passes[i].target.slot].backs = true;
    return bytes_of(needs, plan->shadow_count);
}

/* ---- the limit ---- */

static void set_size(enum gn_light_type type, const struct gn_shadow_opts *opts,
                     struct gn_map_need *need) {
    uint32_t size_px[2];
    const bool cascades = opts->cascades > 1;
    if (cascades)
        gn_cascade_map_size(opts->cascades, opts->map_px, size_px);
    else
        gn_shadow_map_size(type, opts->technique, opts->map_px, size_px);
    need->map = (struct gn_shadow_map){.tile_px = opts->map_px,
                                       .width_px = size_px[0],
                                       .height_px = size_px[1],
                                       .tile_count =
                                           cascades ? (opts->cascades > 2 ? 4 : 2)
                                                    : gn_shadow_tile_count(type, opts->technique)};
    need->map.cell_px = gn_technique_cell_px(opts->technique, opts->map_px,
                                             opts->moves && need->map.tile_count == 1);
}

void gn_frame_shrink_maps(struct gn_frame *frame, uint64_t most_bytes, struct gn_shadow_opts *maps,
                          struct gn_warnings *warnings) {
    struct gn_map_need needs[GN_ALL_SHADOWS_MAX];
    uint32_t asked_px = 0, least_px = UINT32_MAX;
    if (most_bytes == 0) return;
    for (uint32_t i = 0; i < frame->view_count; i++) {
        const enum gn_light_type type =
            frame->scene->lights[gn_frame_light_of_slot(frame, i)->light].type;
        needs[i] = (struct gn_map_need){
            .technique = maps[i].technique,
            .encoding = maps[i].encoding,
            .moments = maps[i].moments,
            /* counted whether this eye needs them or not */
            .paged =
                !gn_light_types[type].has_position && !gn_techniques[maps[i].technique].on_plane,
            .backs = gn_frame_has_middle(frame, maps[i].technique, maps[i].light.faces)};
        set_size(type, &maps[i], &needs[i]);
    }
    while (bytes_of(needs, frame->view_count) > most_bytes) {
        uint32_t slot = frame->view_count; /* of the map whose tiles are halved next */
        for (uint32_t i = 0; i < frame->view_count; i++) {
            if (needs[i].map.tile_px < 2 * LEAST_PX) continue;
            if (slot == frame->view_count || needs[i].map.tile_px > needs[slot].map.tile_px ||
                (needs[i].map.tile_px == needs[slot].map.tile_px &&
                 own_bytes(&needs[i]) >= own_bytes(&needs[slot])))
                slot = i;
        }
        if (slot == frame->view_count) break;
        struct gn_frame_light *light = gn_frame_light_of_slot(frame, slot);
        if (maps[slot].map_px > asked_px) asked_px = maps[slot].map_px;
        /* smaller tiles of cascades have no room for gutters: one map takes their place */
        if (maps[slot].cascades > 1 && maps[slot].map_px / 2 < GN_CASCADE_LEAST_PX)
            light->cascades = maps[slot].cascades = 1;
        else
            maps[slot].map_px = gn_technique_map_px(maps[slot].technique, maps[slot].map_px / 2);
        if (maps[slot].map_px < least_px) least_px = maps[slot].map_px;
        set_size(frame->scene->lights[light->light].type, &maps[slot], &needs[slot]);
    }
    if (asked_px > 0 && gn_frame_notice(&frame->notes.said, GN_NOTICE_MAPS_MB, warnings))
        gn_warn(warnings,
                "shadow maps exceed the limit maps_mb=%llu: tiles of up to %u px are reduced, the "
                "smallest to %u px",
                (unsigned long long)(most_bytes >> 20), asked_px, least_px);
}
