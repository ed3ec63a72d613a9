#include "stage/sun_gather.h"

#include <cglm/cglm.h>
#include <stdlib.h>
#include <string.h>

#include "core/srgb.h"
#include "core/turn.h"
#include "image/write.h"
#include "stage/hours_picture.h"

/* ---- what is drawn ---- */

void gn_sun_gather_share(const struct gn_sun_gather *g, struct gn_view *view,
                         const struct gn_view *shown, enum gn_sun_look look) {
    const uint32_t in_part = g->drawn - g->added;
    struct gn_frame_output_opts *output = &view->opts.output;
    gn_view_share(view, GN_VIEW_STILL, shown, &shown->opts);
    gn_sun_hours_look(&view->opts, g->hours.light, look);
    output->keeps_alpha = false;
    if (output->scale > 0.0f && output->scale < 1.0f) { /* as large as what it lies over */
        output->width_px = gn_frame_scaled_px(output->width_px, output->scale);
        output->height_px = gn_frame_scaled_px(output->height_px, output->scale);
        output->scale = 0.0f;
    }
    view->opts.gather.sums = true;
    if (look == GN_SUN_VISIBILITY) view->opts.gather.part = 1.0f / (float)(in_part + 1);
}

static bool draw(struct gn_view *view, struct gn_gl *gl, struct gn_err *err) {
    const struct gn_plan *plan = gn_view_plan(view, gl, NULL, err);
    return plan && gn_gl_run(gl, plan, NULL, err);
}

/* ---- upright, and as the output has it ---- */

static bool lies(const struct gn_sun_gather *g) { return g->turn_deg / 90 % 2; }
static uint32_t upright_width(const struct gn_sun_gather *g) {
    return lies(g) ? g->height_px : g->width_px;
}
static uint32_t upright_height(const struct gn_sun_gather *g) {
    return lies(g) ? g->width_px : g->height_px;
}

/* The pixel of the output at that one of the upright picture. */
static size_t place_of(const struct gn_sun_gather *g, uint32_t u, uint32_t v) {
    const struct gn_turned turn = {g->turn_deg, g->width_px, g->height_px};
    uint32_t to[2];
    gn_turned_place(&turn, u, v, to);
    return (size_t)to[1] * g->width_px + to[0];
}

/* ---- gathering ---- */

static bool make_room(struct gn_sun_gather *g, struct gn_err *err) {
    const size_t pixels = (size_t)g->width_px * g->height_px;
    g->rgba = gn_picture_alloc(pixels, 4 * sizeof *g->rgba, err);
    g->bytes = g->rgba ? gn_picture_alloc(pixels, 4, err) : NULL;
    g->seen.hours = g->bytes ? gn_picture_alloc(pixels, sizeof *g->seen.hours, err) : NULL;
    g->seen.normal_ws =
        g->seen.hours ? gn_picture_alloc(pixels, sizeof *g->seen.normal_ws, err) : NULL;
    return g->seen.normal_ws;
}

/* Bits of the number in reverse, so that each half of the order is spread over the day. */
static void choose_order(struct gn_sun_gather *g) {
    enum { BITS = 10 };
    _Static_assert(1 << BITS >= GN_SUN_POSITIONS, "bits of a position");
    uint32_t n = 0;
    for (uint32_t i = 0; i < 1u << BITS; i++) {
        uint32_t reversed = 0;
        for (int bit = 0; bit < BITS; bit++) reversed |= (i >> bit & 1) << (BITS - 1 - bit);
        if (reversed < g->hours.count) g->order[n++] = reversed;
    }
}

static void keep_surfaces(struct gn_sun_gather *g) {
    const uint32_t width = upright_width(g), height = upright_height(g);
    for (uint32_t v = 0; v < height; v++)
        for (uint32_t u = 0; u < width; u++) {
            const size_t at = (size_t)v * width + u;
            memcpy(g->seen.normal_ws[at], g->rgba + 4 * place_of(g, u, v), sizeof(float[4]));
            const bool none = glm_vec3_norm2(g->seen.normal_ws[at]) < 0.25f;
            g->seen.hours[at] = none ? GN_SUN_HOURS_NONE : 0.0f;
        }
}

bool gn_sun_gather_begin(struct gn_sun_gather *g, struct gn_view *view, const struct gn_view *shown,
                         const struct gn_settings *settings, struct gn_gl *gl, struct gn_err *err) {
    gn_sun_gather_finish(g);
    if (!gn_sun_hours_build_day(&g->hours, settings, shown->pose->scene, shown->opts.view.sun_utc_s,
                                err))
        return false;
    choose_order(g);
    gn_sun_gather_share(g, view, shown, GN_SUN_NORMAL);
    g->width_px = view->opts.output.width_px;
    g->height_px = view->opts.output.height_px;
    g->turn_deg = view->opts.output.turn_deg;
    if (!make_room(g, err) || !draw(view, gl, err) || !gn_gl_read_f32(gl, g->rgba, err))
        return false;
    keep_surfaces(g);
    return true;
}

static bool add_part(struct gn_sun_gather *g, const struct gn_view *view, struct gn_gl *gl,
                     struct gn_err *err) {
    const uint32_t width = upright_width(g), height = upright_height(g);
    const float day_h = (float)(g->hours.count * g->hours.step_h), count = (float)g->drawn,
                more = (float)(g->drawn - g->added); /* of count */
    if (!gn_gl_read_part(gl, view->opts.number, g->rgba, err)) return false;
    for (uint32_t v = 0; v < height; v++)
        for (uint32_t u = 0; u < width; u++) {
            float *hours = &g->seen.hours[(size_t)v * width + u];
            const float seen = g->rgba[4 * place_of(g, u, v)];
            if (*hours >= 0.0f) *hours += (day_h * seen - more * *hours) / count;
        }
    g->added = g->drawn;
    return true;
}

bool gn_sun_gather_add(struct gn_sun_gather *g, struct gn_view *view, const struct gn_view *shown,
                       struct gn_gl *gl, struct gn_err *err) {
    vec3 aim;
    glm_vec3_copy(shown->pose->aim_ws, aim);
    gn_sun_gather_share(g, view, shown, GN_SUN_VISIBILITY);
    gn_sun_hours_aim(&g->hours, shown->pose, g->order[g->drawn]);
    const bool drawn = draw(view, gl, err);
    gn_pose_aim(shown->pose, g->hours.light, aim);
    if (!drawn) return false;
    g->drawn++;
    const bool ends = g->drawn - g->added == GN_SUN_PART || g->drawn == g->hours.count;
    return !ends || add_part(g, view, gl, err);
}

/* ---- the picture ---- */

bool gn_sun_gather_may_paint(const struct gn_sun_gather *g) {
    return g->added > g->painted && (g->added >= 2 * g->painted || g->added == g->hours.count);
}

bool gn_sun_gather_paint(struct gn_sun_gather *g, const struct gn_view *view,
                         const struct gn_settings *settings, struct gn_gl *gl,
                         struct gn_warnings *warnings, struct gn_err *err) {
    const uint32_t width = upright_width(g), height = upright_height(g);
    float linear[256];
    for (int i = 0; i < 256; i++) linear[i] = gn_srgb_decode((float)i / 255);
    gn_hours_picture_draw(&g->hours, &g->seen, settings, g->bytes, (int)width, (int)height,
                          warnings);
    for (uint32_t v = 0; v < height; v++)
        for (uint32_t u = 0; u < width; u++) {
            const uint8_t *from = g->bytes + 4 * ((size_t)v * width + u);
            float *to = g->rgba + 4 * place_of(g, u, v);
            for (int k = 0; k < 3; k++) to[k] = linear[from[k]];
            to[3] = 1.0f;
        }
    g->painted = g->added;
    return gn_gl_give_mean(gl, view->opts.number, g->rgba, err);
}

void gn_sun_gather_finish(struct gn_sun_gather *g) {
    gn_sun_hours_finish(&g->seen);
    free(g->rgba);
    free(g->bytes);
    *g = (struct gn_sun_gather){0};
}
