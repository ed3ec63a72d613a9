
#include "frame/plan.h"

static const char *const outputs[] = {[GN_OUTPUT_SRGB8] = "srgb8",
                                      [GN_OUTPUT_LINEAR8] = "linear8",
                                      [GN_OUTPUT_FLOAT] = "float",
                                      [GN_OUTPUT_AOV] = "bits"};
static const char *const aovs[GN_AOV_COUNT] = {"color", "visibility", "distance", "normal",
                                               "occlusion"};
static const char *const receivers[] = {[GN_RECEIVES_MAPS] = "",
                                        [GN_RECEIVES_NOTHING] = ", receives nothing",
                                        [GN_RECEIVES_ALL] = ", receives all"};
static const char *const slides[GN_SLIDE_COUNT] = {
    [GN_SLIDE_NONE] = "", [GN_SLIDE_DARK] = "+slide", [GN_SLIDE_LIT] = "+film"};
static const char *const tones[GN_TONE_COUNT] = {
    [GN_TONE_NEUTRAL] = "neutral", [GN_TONE_ACES] = "aces", [GN_TONE_AGX] = "agx"};
static const char *const culls[] = {
    [GN_CULL_NONE] = "none", [GN_CULL_BACK] = "back", [GN_CULL_FRONT] = "front"};

/* Of a light with a map: what is kept for it. */
static const char *format_of(int encoding, int moments) {
    return moments ? gn_moments[moments].name : gn_encodings[encoding].name;
}

static void print_key(const struct gn_program_key *key, FILE *to) {
    fprintf(to, "%s", gn_programs[key->kind].name);
    if (key->kind == GN_PROGRAM_AOV) fprintf(to, " %s", aovs[key->aov]);
    if (gn_programs[key->kind].reads & GN_PROGRAM_ENCODING)
        fprintf(to, " %s", gn_encodings[key->encoding].name);
    if (key->kind == GN_PROGRAM_FILTER) {
        const struct gn_filter_step_row *step = &gn_filter_steps[key->step];
        fprintf(to, " %s", step->name);
        if (step->reads_map)
            fprintf(to, ", %s of %s", gn_techniques[key->technique].name,
                    gn_encodings[key->encoding].name);
        fprintf(to, ", %s", gn_moments[key->moments].name);
    }
    for (int i = 0; i < GN_FEATURE_COUNT; i++)
        if (key->features >> i & 1) fprintf(to, " +%s", gn_features[i].name);
    for (int i = 0; i < key->light_count; i++) {
        const struct gn_program_light *light = &key->lights[i];
        fprintf(to, " %s", gn_light_types[light->type].name);
        if (i < key->shadow_count)
            fprintf(to, ":%s/%s%s", gn_techniques[light->technique].name,
                    format_of(light->encoding, light->moments), light->cascades ? "+cascades" : "");
        fprintf(to, "%s%s", slides[light->slide], light->ranged ? "+range" : "");
    }
    fprintf(to, "%s\n", receivers[key->receiver]);
}

static void print_shadow(const struct gn_plan *plan, uint32_t slot, FILE *to) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    fprintf(to, "shadow %u: light %u '%s' %s %s/%s", slot, view->light,
            plan->scene->lights[view->light].name,
            gn_light_types[plan->scene->lights[view->light].type].name,
            gn_techniques[view->technique].name, format_of(view->encoding, view->moments));
    if (view->encoding == GN_ENCODING_SCREEN) {
        fprintf(to, ", a value for each pixel\n");
        return;
    }
    const bool has_map = view->encoding != GN_ENCODING_STENCIL;
    if (has_map) fprintf(to, " %u px", view->map.tile_px);
    if (has_map && view->map.tile_count > 1)
        fprintf(to,
                view->map.cascade_count > 0 ? " x %u cascades, gutters %u px"
                                            : " x %u, gutters %u px",
                view->map.cascade_count > 0 ? view->map.cascade_count : view->map.tile_count,
                view->map.gutter_px);
    if (has_map && view->penumbra.blur_px > 0.0f)
        fprintf(to, ", blur %.3g px", 2.0 * (double)view->penumbra.blur_px);
    if (view->empty)
        fprintf(to, ", empty: it darkens nothing in view\n");
    else if (gn_techniques[view->technique].on_plane && has_map) {
        if (view->plane > 1) fprintf(to, ", plane %u", view->plane);
        fprintf(to, ", texel %.4g m", (double)view->lookup.texel);
        if (view->lamp.count > 0)
            fprintf(to, ", %u of %u points of the lamp", view->lamp.drawn, view->lamp.count);
        fprintf(to, "\n");
    } else if (!has_map)
        fprintf(to, ", from %.4g m to %.4g m over the plane\n", (double)view->code.near_m,
                (double)view->code.far_m);
    else
        fprintf(to, ", texel %.4g %s, near %.4g m, far %.4g m\n", (double)view->lookup.texel,
                view->perspective ? "m per metre" : "m", (double)view->code.near_m,
                (double)view->code.far_m);
    for (uint32_t i = 0; !view->empty && i < view->map.cascade_count; i++) {
        const struct gn_shadow_cascade *c = &view->cascades[i];
        fprintf(to, "    cascade %u: from %.4g m to %.4g m", i + 1, (double)c->begin_m,
                (double)c->end_m);
        if (view->raster.tiles[i].empty) {
            fprintf(to, ", empty\n");
            continue;
        }
        fprintf(to, ", texel %.4g m, %u pages", (double)c->texel, c->drawn.page_count);
        if (c->blur_px > 0.0f) fprintf(to, ", blur %.3g px", 2.0 * (double)c->blur_px);
        fprintf(to, "\n");
    }
}

static void print_target(const struct gn_pass *pass, FILE *to) {
    fprintf(to, "pass '%s' -> ", pass->label);
    switch (pass->target.kind) {
    case GN_TARGET_OUTPUT: fprintf(to, "picture"); break;
    case GN_TARGET_ENCODED: fprintf(to, "picture in bytes"); break;
    case GN_TARGET_SCALED: fprintf(to, "picture as shown"); break;
    case GN_TARGET_MEAN: fprintf(to, "mean %u", pass->target.index); break;
    case GN_TARGET_SHADOW:
        fprintf(to, "map %u (%s, rim %u px)", pass->target.slot,
                gn_encodings[pass->target.encoding].name,
                pass->kind == GN_PASS_MAP ? pass->map.border_px : 0);
        break;
    case GN_TARGET_PAGES:
        fprintf(to, "pages of map %u (%s)", pass->target.slot,
                gn_encodings[pass->target.encoding].name);
        break;
    case GN_TARGET_BACKS:
        fprintf(to, "far sides of map %u (%s)", pass->target.slot,
                gn_encodings[pass->target.encoding].name);
        break;
    case GN_TARGET_MOMENTS:
        fprintf(to, "moments %u of map %u (%s)", pass->target.index, pass->target.slot,
                gn_moments[pass->target.moments].name);
        break;
    }
}

static void print_within(const struct gn_rect *rect, FILE *to) {
    if (rect->width > 0)
        fprintf(to, ", within %u x %u at %u, %u", rect->width, rect->height, rect->x, rect->y);
}

static void print_picture(const struct gn_plan *plan, const struct gn_pass *pass, FILE *to) {
    const struct gn_pass_picture *p = &pass->picture;
    const float *color = pass->clear.color;
    if (pass->clear.area != GN_CLEAR_NOTHING)
        fprintf(to, ", clear %.3f %.3f %.3f", (double)color[0], (double)color[1], (double)color[2]);
    for (uint32_t i = 0; i < p->slide_count; i++)
        fprintf(to, ", slide %u: texture %u", i, p->slides[i]);
    if (p->blend == GN_BLEND_ALPHA) fprintf(to, ", blend");
    if (p->blend == GN_BLEND_TINT) fprintf(to, ", multiplies");
    if (p->plane_count > 0 &&
        p->first_on_plane != p->first_shadow + p->shadow_count - p->plane_count)
        fprintf(to, ", planar maps from %u", p->first_on_plane);
    if (p->reads_codes) fprintf(to, ", shows map %u", p->first_shadow);
    if (p->mean_of) fprintf(to, ", mean of view %u", p->mean_of - 1);
    if (p->reads_atlas)
        fprintf(to, ", atlas %u x %u", plan->atlas->width_px, plan->atlas->height_px);
    for (uint32_t i = 0; p->blend == GN_BLEND_ADD && i < p->light_count; i++) {
        const uint32_t light = plan->lights[p->first_light + i];
        fprintf(to, "%s'%s'", i ? " " : ", adds ", plan->scene->lights[light].name);
        if (i < p->shadow_count) fprintf(to, " (map %u)", p->first_shadow + i);
    }
    print_within(&pass->rect, to);
    const struct gn_stencil *s = &p->stencil;
    if (p->only_stencil) fprintf(to, ", no colour, no depth");
    if (pass->clear.stencil_bits) fprintf(to, ", clears stencil %02x", pass->clear.stencil_bits);
    if (s->reads) fprintf(to, ", where stencil %02x of %02x", s->value & s->reads, s->reads);
    if (s->writes) fprintf(to, ", sets stencil %02x of %02x", s->value & s->writes, s->writes);
}

static void print_pass(const struct gn_plan *plan, const struct gn_pass *pass, FILE *to) {
    const bool map = pass->kind == GN_PASS_MAP || pass->kind == GN_PASS_COPY;
    print_target(pass, to);
    if (map && pass->clear.area != GN_CLEAR_NOTHING)
        fprintf(to, ", clear %.4g", (double)pass->clear.color[0]);
    if (pass->kind == GN_PASS_MAP && pass->map.point_count > 0)
        fprintf(to, ", points up to %u, each less %.4g", pass->map.point_count,
                (double)pass->map.points[GN_POINT_CONSTANTS - 1][0]);
    if (pass->kind == GN_PASS_MAP && pass->map.reads_backs) fprintf(to, ", reads far sides");
    if (pass->kind == GN_PASS_PICTURE)
        print_picture(plan, pass, to);
    else
        print_within(&pass->rect, to);
    for (uint32_t i = 0; pass->kind == GN_PASS_COPY && i < pass->copy.count; i++) {
        const struct gn_copy *copy = &pass->copy.copies[i];
        fprintf(to, "%s%u x %u from %u, %u to %u, %u", i ? "; " : ", copies ", copy->from.width,
                copy->from.height, copy->from.x, copy->from.y, copy->to_x, copy->to_y);
    }
    for (int i = 0; pass->kind == GN_PASS_FILTER && i < GN_FILTER_FROM_MAX; i++) {
        const struct gn_read *read = &pass->filter.reads[i];
        if (read->kind == GN_READ_MAP) fprintf(to, ", reads the map");
        if (read->kind == GN_READ_MOMENTS) fprintf(to, ", reads moments %u", read->index);
    }
    const bool only_stencil = pass->kind == GN_PASS_PICTURE && pass->picture.only_stencil;
    if (!pass->depth_write && !only_stencil && pass->kind != GN_PASS_FILTER)
        fprintf(to, ", depth read-only");
    if (pass->discard_depth) fprintf(to, ", depth discarded");
    fprintf(to, "\n");
    for (uint32_t i = 0; i < pass->draw_count; i++) {
        const struct gn_draw *draw = &plan->draws[pass->first_draw + i];
        if (draw->geometry == GN_NO_GEOMETRY) {
            fprintf(to, "    draw program %u, %u vertices x %u\n", draw->program,
                    draw->vertex_count, draw->instance_count);
            continue;
        }
        fprintf(
            to,
            "    draw program %u, geometry %u (%u triangles) x %u, material %u '%s', cull %s%s\n",
            draw->program, draw->geometry,
            gn_draw_corners(plan->scene, plan->detail, draw).count / 3, draw->instance_count,
            draw->material, plan->scene->materials[draw->material].name, culls[draw->cull],
            draw->mirrored ? ", mirrored" : "");
    }
}

void gn_plan_print(const struct gn_plan *plan, FILE *to) {
    fprintf(to, "plan %u x %u, %s %s%s, msaa %u, exposure %.4g, %u items culled\n", plan->width_px,
            plan->height_px, aovs[plan->aov], outputs[plan->output],
            plan->stencil ? " + stencil" : "", plan->msaa, (double)plan->exposure, plan->culled);
    if (gn_plan_scales(plan))
        fprintf(to, "scaled to %u x %u\n", plan->shown_width_px, plan->shown_height_px);
    if (plan->tone != GN_TONE_NONE)
        fprintf(to, "tone %s%s\n", tones[plan->tone], plan->finishes ? ", by the last pass" : "");
    for (uint32_t i = 0; i < plan->program_count; i++) {
        fprintf(to, "program %u: ", i);
        print_key(&plan->programs[i], to);
    }
    for (uint32_t i = 0; i < plan->shadow_count; i++) print_shadow(plan, i, to);
    for (uint32_t i = 0; i < plan->pass_count; i++) print_pass(plan, &plan->passes[i], to);
}
