/* Fits a shadow view: chooses the way, and finishes the result. */
#include "shadow/fit.h"

#include <assert.h>
#include <cglm/cglm.h>
#include <math.h>

#include "shadow/cascade.h"
#include "shadow/planar.h"
#include "shadow/private.h"

uint32_t gn_shadow_tile_count(enum gn_light_type type, enum gn_technique technique) {
    return gn_light_types[type].shines_around && !gn_techniques[technique].on_plane
               ? GN_SHADOW_TILES_MAX
               : 1;
}

void gn_shadow_map_size(enum gn_light_type type, enum gn_technique technique, uint32_t map_px,
                        uint32_t size_px[2]) {
    const bool atlas = gn_shadow_tile_count(type, technique) > 1;
    size_px[0] = atlas ? 3 * map_px : map_px;
    size_px[1] = atlas ? 2 * map_px : map_px;
}

/* The filter's radius, the bias, and the margin that they need: not all of a small map. A filter
 * that compares with one code needs a bias as wide as it is. */
static void set_filter(const struct gn_shadow_opts *opts, struct gn_shadow_view *view) {
    const struct gn_technique_row *row = &gn_techniques[opts->technique];
    struct gn_shadow_lookup *lookup = &view->lookup;
    const float tile_px = (float)opts->map_px;
    lookup->bias_texels = row->bias_texels;
    lookup->margin_px = row->radius_texels;
    const float set_px = fmaxf(opts->light.filter_radius_px, 0.0f);
    if (row->filter == GN_FILTER_BLUR) {
        lookup->filter_radius_px = set_px;
    } else if (set_px > 0.0f && row->filter_radius_px > 0.0f) {
        const float most = fmaxf(fminf(row->filter_most, tile_px / 16.0f), row->filter_radius_px);
        lookup->filter_radius_px = fminf(set_px, most);
        const float further = ceilf(lookup->filter_radius_px) - ceilf(row->filter_radius_px);
        if (further > 0.0f) lookup->margin_px += (uint32_t)further;
        if (row->one_code) lookup->bias_texels *= lookup->filter_radius_px / row->filter_radius_px;
    }
    const float bias = GN_LIGHT_HAS(&opts->light, bias_texels) ? opts->light.bias_texels : -1.0f;
    if (bias < 0.0f || row->on_plane) return;
    const float own = lookup->bias_texels, most = fmaxf(tile_px / 8.0f, own);
    lookup->bias_texels = fminf(bias, most);
    lookup->margin_px += (uint32_t)ceilf(fmaxf(lookup->bias_texels - own, 0.0f));
}

/* The whole map is cleared to the far end, so all lookups are lit. Techniques also use derivatives
 * of the map's coordinates, so the matrix must not be singular: it is the light's frame, one unit
 * wide, with a code of 0 everywhere. */
static void make_view_empty(struct gn_shadow_view *view) {
    mat4 m;
    gn_shadow_look(view, m);
    for (int c = 0; c < 4; c++) {
        vec4 column = {m[c][0], m[c][1], 0.0f, view->perspective ? -m[c][2] : c == 3};
        glm_vec4_copy(column, view->lookup.map_from_world[c]);
    }
    for (int k = 0; k < 2; k++)
        view->lookup.tangent_uv[k] = 1.0f, view->lookup.depth_code[k] = 0.0f;
    view->code.scale = view->code.offset = 0.0f;
    view->lookup.texel = view->lookup.normal_offset = view->lookup.slope_offset = 0.0f;
    view->code.ulp_m = 0.0f;
    view->penumbra = (struct gn_shadow_penumbra){.nearest = -1.0f, .growth = -1.0f, .bias = 1.0f};
    view->code.far_end = view->encoding == GN_ENCODING_RGBA8 ? GN_RGBA8_FAR : 1.0f;
    view->empty = true;
    view->lamp.count = 0;
    if (gn_techniques[view->technique].filter == GN_FILTER_BLUR)
        view->penumbra.blur_px = GN_BLUR_LEAST_PX;
    for (uint32_t i = 0; i < view->map.tile_count; i++) {
        view->raster.tiles[i].empty = true;
        view->raster.tiles[i].content_hash = 1;
    }
    for (uint32_t i = 0; i < view->map.cascade_count; i++) view->cascades[i].drawn.page_count = 0;
}

/* Normal offset and slope follow the width that the technique averages over; the factors are
 * measured by `make truth`. A spot's and a point light's slope moves no lookup, and costs no width
 * of a shadow: their bias is mostly slope, but that of blurred maps, whose contacts would be lit.
 */
static void set_bias(struct gn_shadow_view *view) {
    struct gn_shadow_lookup *lookup = &view->lookup;
    const bool is_blurred = gn_techniques[view->technique].filter == GN_FILTER_BLUR;
    static const struct factors {
        float normal, slope, slope_max;
    } sun = {1.0f, 0.7f, 4.0f}, spot = {0.3f, 1.35f, 6.3f}, blurred = {0.7f, 1.05f, 8.0f};
    const struct factors *f = !view->perspective ? &sun : is_blurred ? &blurred : &spot;
    lookup->normal_offset = f->normal * lookup->bias_texels;
    lookup->slope_offset = f->slope * lookup->bias_texels;
    lookup->slope_max = f->slope_max;
}

/* What does not depend on casters and receivers. */
static void begin_view(const struct gn_shadow_opts *opts, uint32_t light, enum gn_light_type type,
                       struct gn_shadow_view *view) {
    const struct gn_technique_row *row = &gn_techniques[opts->technique];
    const int faces = opts->light.faces;
    uint32_t size_px[2];
    gn_shadow_map_size(type, opts->technique, opts->map_px, size_px);
    *view =
        (struct gn_shadow_view){.light = light,
                                .technique = opts->technique,
                                .encoding = opts->encoding,
                                .moments = opts->moments,
                                .plane = opts->plane ? opts->plane : 1,
                                .all_receive = opts->all_receive,
                                .whole = opts->whole,
                                .but_floor = opts->but_floor,
                                .fixed = opts->fixed && opts->cascades <= 1,
                                .square = opts->square,
                                .faces_given = faces > 0 && !row->on_plane,
                                .faces = (enum gn_cast_faces)(faces > 0 ? faces - 1 : 0),
                                .perspective = gn_light_types[type].has_position,
                                .map = {.tile_px = opts->map_px,
                                        .width_px = size_px[0],
                                        .height_px = size_px[1],
                                        .tile_count = gn_shadow_tile_count(type, opts->technique)}};
    set_filter(opts, view);
    view->map.cell_px =
        gn_technique_cell_px(opts->technique, opts->map_px,
                             opts->moves && opts->cascades <= 1 && view->map.tile_count == 1);
    if (row->filter == GN_FILTER_TABLE) view->lookup.reach_px = GN_TABLE_REACH_PX;
    if (opts->cascades > 1 && !view->perspective && !row->on_plane)
        gn_cascades_lay(opts->cascades, view);
}

bool gn_shadow_fit(const struct gn_pose *pose, uint32_t light, const struct gn_eye *eye,
                   const struct gn_shadow_opts *opts, struct gn_shadow_memory *memory,
                   struct gn_shadow_view *view) {
    assert(opts->technique != GN_TECHNIQUE_NONE);
    const struct gn_technique_row *row = &gn_techniques[opts->technique];
    const struct gn_light *l = &pose->lights[light];

    vec3 direction;
    begin_view(opts, light, l->type, view);
    gn_pose_light(pose, light, view->light_ws, direction);
    glm_vec3_negate_to(direction, view->to_light_ws);

    struct gn_fitter f = {.pose = pose,
                          .eye = eye,
                          .memory = memory,
                          .view = view,
                          .tile = view->raster.tiles,
                          .scene_size_m = gn_scene_size_m(pose),
                          .light_radius =
                              GN_LIGHT_HAS(&opts->light, radius) ? opts->light.radius : l->radius,
                          .range_m = l->range_m > 0.0f ? l->range_m : INFINITY};
    const bool found = row->on_plane                 ? gn_planar_fit(&f, opts->points)
                       : view->map.cascade_count > 0 ? gn_cascades_fit(&f)
                       : view->map.tile_count > 1    ? gn_cube_fit(&f)
                                                     : gn_single_fit(&f);
    if (!found) make_view_empty(view);
    if (!found || row->on_plane) return found;

    set_bias(view);
    /* cascades have hashed theirs */
    for (uint32_t i = 0; i < view->map.tile_count && view->map.cascade_count == 0; i++)
        view->raster.tiles[i].content_hash =
            gn_shadow_hash(pose, view, &view->raster.tiles[i], memory[i].casts);
    return true;
}
