/* The window that a map must hold. A shadow needs a pair: a caster, and a receiver behind it that
 * the eye sees. The window is the intersection of the regions that visible receivers and casters
 * cover in plane coordinates, narrowed twice, since each limits the other; near and far are those
 * of the casters alone and do not depend on the eye (a receiver beyond the last caster compares
 * against the far end). A large flat caster with nothing behind it, such as the ground, is left
 * out: it shadows nothing, and what is not in the map can neither shadow itself nor cost
 * resolution. What lies beyond the light's range is left out too: nothing is lit there, and it is
 * in front of nothing that is. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "shadow/private.h"
#include "shadow/region.h"

enum { MOST_LOOKS = 1 << 20 /* box tests in all walks of caster_region() */ };

static bool item_receives(const struct gn_fitter *f, uint32_t item) {
    return gn_shadow_item_receives(f->pose, item, f->view);
}

/* The region of a caster; of a large flat one only the part with a receiver behind its plane, seen
 * or not. That is a walk over all items, done while `looks` lasts: in a scene with thousands of
 * flat casters the rest count whole. */
static struct gn_shadow_region caster_region(const struct gn_fitter *f, uint32_t item,
                                             uint32_t *looks) {
    const struct gn_shadow_region *whole = gn_fitter_whole(f, item);
    const struct gn_geometry *g = &f->pose->scene->geometries[f->pose->scene->items[item].geometry];
    const struct gn_box *box = &f->pose->items[item].box_ws;
    if (region_is_empty(whole) || *looks < f->memory->item_count || !g->flat ||
        !(glm_vec3_distance((float *)box->min, (float *)box->max) > 0.25f * f->scene_size_m))
        return *whole;
    *looks -= f->memory->item_count;

    /* its plane in world space, positive on the light's side; whole if the light sees it edge-on */
    vec4 plane;
    gn_pose_plane(f->pose, item, plane);
    const float towards = f->view->perspective
                              ? glm_vec3_dot(plane, f->view->light_ws) + plane[3]
                              : glm_vec3_dot(plane, f->view->to_light_ws) * f->scene_size_m;
    if (towards < 0.0f) glm_vec4_negate(plane);
    if (!(fabsf(towards) > 1e-4f * f->scene_size_m)) return *whole;

    struct gn_shadow_region behind = nothing;
    for (uint32_t i = 0; i < f->pose->scene->item_count; i++) {
        if (i == item || !item_receives(f, i)) continue;
        if (gn_box_least(plane, &f->pose->items[i].box_ws) >= -1e-4f * f->scene_size_m) continue;
        unite(&behind, gn_fitter_whole(f, i));
    }
    const struct gn_shadow_region r = intersect(whole, &behind);
    return region_is_empty(&r) ? nothing : r;
}

float gn_fitter_spread(const struct gn_fitter *f, float near, float far) {
    if (far <= near) return 0.0f;
    return f->view->perspective ? 1.0f / most(near, f->near_m) - 1.0f / far : far - near;
}

/* The radius in plane units of the penumbra of a caster at `near` on a receiver at `far`. */
static float penumbra_reach(const struct gn_fitter *f, float near, float far) {
    if (!gn_techniques[f->view->technique].soft) return 0.0f;
    return f->light_radius * gn_fitter_spread(f, near, far);
}

/* The region of a receiver that the eye sees, or all of it; NULL: none. */
static const struct gn_shadow_region *receiver_region(const struct gn_fitter *f, uint32_t item,
                                                      bool everything) {
    if (!item_receives(f, item)) return NULL;
    const struct gn_shadow_region *r = everything ? gn_fitter_whole(f, item)
                                       : f->memory->seen[item] == GN_SEEN_NOT
                                           ? NULL
                                           : gn_fitter_seen(f, item);
    return r && !region_is_empty(r) ? r : NULL;
}

bool gn_window_is_all(const struct gn_fitter *f) {
    for (uint32_t i = 0; i < f->memory->item_count; i++)
        if (item_receives(f, i) && f->memory->seen[i] != GN_SEEN_WHOLE) return false;
    return true;
}

/* Unites the casters that matter for those receivers, and marks them. */
static struct gn_shadow_region unite_casters(const struct gn_fitter *f,
                                             const struct gn_shadow_region *receivers,
                                             struct gn_shadow_region *depths) {
    struct gn_shadow_region casters = nothing;
    uint8_t *casts = f->memory->casts;
    uint32_t looks = MOST_LOOKS;
    const bool near_counts = (gn_techniques[f->view->technique].soft && !f->view->perspective) ||
                             (f->is_cascade && gn_technique_replaces_map(f->view->technique));

    /* World space planes round all places whose penumbra under a directional light reaches those
     * receivers: the nearer to the light, the farther aside. */
    enum { REACH_PLANES = 5 };
    const float reach = gn_techniques[f->view->technique].soft ? f->light_radius : 0.0f,
                far = receivers->far;
    vec4 planes[REACH_PLANES],
        of_light[REACH_PLANES] = {{1, 0, reach, reach * far - receivers->min[0]},
                                  {-1, 0, reach, reach * far + receivers->max[0]},
                                  {0, 1, reach, reach * far - receivers->min[1]},
                                  {0, -1, reach, reach * far + receivers->max[1]},
                                  {0, 0, 1, far}};
    for (int i = 0; i < REACH_PLANES; i++)
        for (int c = 0; c < 4; c++) /* planes are transformed by the transpose */
            planes[i][c] = glm_vec4_dot(of_light[i], (float *)f->tile->light_from_world[c]);

    *depths = nothing;
    memset(casts, 0, f->memory->item_count);
    for (uint32_t i = 0; i < f->memory->item_count; i++) {
        if (!f->pose->items[i].visible || !gn_shadow_item_casts(f->pose->scene, i)) continue;
        struct gn_shadow_region r = caster_region(f, i, &looks);
        if (region_is_empty(&r)) continue;
        unite(depths, &r);
        struct gn_shadow_region reached =
            grown(receivers, penumbra_reach(f, r.near, receivers->far));
        bool matters = regions_meet(&r, &reached) && r.near <= receivers->far;
        /* The content of a whole tile or page does not depend on the eye. */
        casts[i] = matters || f->view->map.tile_count > 1 || !f->view->perspective;
        if (!matters) continue;
        const bool is_long = r.min[0] < receivers->min[0] || r.max[0] > receivers->max[0] ||
                             r.min[1] < receivers->min[1] || r.max[1] > receivers->max[1];
        r = intersect(&r, &reached);
        if (near_counts && is_long) { /* not all of it is as near */
            const struct gn_shadow_region part = gn_fitter_within(f, i, planes, REACH_PLANES);
            r = intersect(&part, &r);
        }
        unite(&casters, &r);
    }
    return casters;
}

/* Adds places beside the casters: those receivers are looked up there, too. */
static void add_penumbrae(const struct gn_fitter *f, const struct gn_shadow_region *receivers,
                          const struct gn_shadow_region *all, struct gn_window *found) {
    struct gn_shadow_region *const regions[] = {&found->window, &found->most};
    const struct gn_shadow_region *const within[] = {receivers, all};
    for (int i = 0; i < 2; i++) {
        struct gn_shadow_region r = grown(
            regions[i], penumbra_reach(f, found->window.near, most(found->window.far, all->far)));
        r = intersect(&r, within[i]);
        for (int k = 0; k < 2; k++) {
            regions[i]->min[k] = least(regions[i]->min[k], r.min[k]);
            regions[i]->max[k] = most(regions[i]->max[k], r.max[k]);
        }
    }
}

bool gn_window_find(const struct gn_fitter *f, bool everything, struct gn_window *found) {
    /* receivers: the parts that count, and all of them */
    struct gn_shadow_region receivers = nothing, all = nothing, again = nothing;
    for (uint32_t i = 0; i < f->memory->item_count; i++) {
        const struct gn_shadow_region *seen = receiver_region(f, i, everything);
        if (seen) unite(&receivers, seen);
        if (seen != gn_fitter_whole(f, i) && item_receives(f, i))
            unite(&all, gn_fitter_whole(f, i));
    }
    unite(&all, &receivers);

    /* bounds of any eye's window: all casters and all receivers */
    const struct gn_shadow_region casters = unite_casters(f, &receivers, &found->depths);
    if (region_is_empty(&casters)) return false;
    const struct gn_shadow_region all_reached =
        grown(&all, penumbra_reach(f, found->depths.near, all.far));
    found->most = intersect(&found->depths, &all_reached);

    /* receivers again, now that the casters are known */
    for (uint32_t i = 0; i < f->memory->item_count; i++) {
        const struct gn_shadow_region *seen = receiver_region(f, i, everything);
        if (!seen) continue;
        const struct gn_shadow_region *whole = gn_fitter_whole(f, i);
        struct gn_shadow_region reached = grown(whole, penumbra_reach(f, casters.near, whole->far));
        if (!regions_meet(&reached, &casters)) continue;
        if (seen->far < casters.near) continue;
        reached = grown(seen, penumbra_reach(f, casters.near, seen->far));
        if (!regions_meet(&reached, &casters)) continue;
        struct gn_shadow_region r = intersect(&reached, &casters);
        unite(&again, &r);
    }
    found->window = intersect(&casters, &again);
    found->window.far = again.far;
    if (region_is_empty(&found->window)) return false;
    if (gn_techniques[f->view->technique].filter == GN_FILTER_CONE && !f->is_cascade)
        add_penumbrae(f, &receivers, &all, found);
    return true;
}
