#include <math.h>

#include "frame/plan.h"

#define REQUIRE(what)                                                                              \
    do {                                                                                           \
        if (!(what)) return #what;                                                                 \
    } while (0)

/* A draw, and what its program needs of the pass. */
static const char *check_draw(const struct gn_plan *plan, const struct gn_pass *pass,
                              const struct gn_draw *draw) {
    REQUIRE(draw->program < plan->program_count);
    const struct gn_program_key *key = &plan->programs[draw->program];
    const bool bare = gn_programs[key->kind].reads & GN_PROGRAM_BARE;
    REQUIRE(bare == (draw->geometry == GN_NO_GEOMETRY));
    REQUIRE(bare ? draw->vertex_count > 0 : draw->geometry < plan->scene->geometry_count);
    REQUIRE(bare || draw->material < plan->scene->material_count);
    REQUIRE(draw->instance_count > 0);
    if (!bare) { /* a bare draw reads no instances: its shader counts */
        REQUIRE(draw->first_instance <= plan->instance_count);
        REQUIRE(draw->instance_count <= plan->instance_count - draw->first_instance);
    }
    REQUIRE(draw->cull <= GN_CULL_FRONT);
    REQUIRE(gn_programs[key->kind].pass == pass->kind);
    if (key->kind == GN_PROGRAM_FILTER)
        REQUIRE(key->moments == gn_moments_of_programs(pass->target.moments));
    if (pass->kind != GN_PASS_PICTURE) return NULL;
    const struct gn_pass_picture *picture = &pass->picture;
    const bool adds = key->features & GN_FEATURE(ADDITIVE);
    const bool panel = key->kind == GN_PROGRAM_PANEL, caption = key->kind == GN_PROGRAM_CAPTION,
               mean = key->kind == GN_PROGRAM_MEAN;
    REQUIRE((key->kind == GN_PROGRAM_FLAT) == picture->only_stencil);
    REQUIRE(caption || mean ||
            (key->kind == GN_PROGRAM_ENCODE) == (pass->target.kind == GN_TARGET_ENCODED));
    REQUIRE(mean == gn_pass_is_mean(pass));
    REQUIRE(caption || !picture->reads_atlas);
    REQUIRE(adds == (picture->blend == GN_BLEND_ADD));
    const uint64_t tint = GN_FEATURE(TINTED) | GN_FEATURE(UNLIT);
    REQUIRE(((key->features & tint) == tint) == (picture->blend == GN_BLEND_TINT));
    REQUIRE(key->light_count <= picture->light_count);
    REQUIRE(key->shadow_count <= picture->shadow_count);
    uint32_t slides = 0;
    for (int i = 0; i < key->light_count; i++) slides += key->lights[i].slide != GN_SLIDE_NONE;
    REQUIRE(slides <= picture->slide_count);
    REQUIRE(panel == picture->reads_codes && (!panel || picture->shadow_count == 1));
    return NULL;
}

static const char *check_key(const struct gn_program_key *key) {
    REQUIRE(key->kind < GN_PROGRAM_KIND_COUNT);
    REQUIRE(key->light_count <= GN_LIGHTS_MAX);
    REQUIRE(key->shadow_count <= GN_SHADOWS_MAX);
    REQUIRE(key->shadow_count <= key->light_count);
    REQUIRE(key->encoding < GN_ENCODING_COUNT);
    REQUIRE(key->technique < GN_TECHNIQUE_ALL && key->step < GN_STEP_COUNT);
    REQUIRE(key->moments < GN_MOMENTS_ALL);
    REQUIRE((key->kind == GN_PROGRAM_FILTER) == (key->moments != GN_MOMENTS_NONE));
    REQUIRE(key->receiver <= GN_RECEIVES_ALL);
    REQUIRE((key->features & ~GN_FEATURES_ALL) == 0);
    for (int i = 0; i < key->light_count; i++) {
        REQUIRE((key->lights[i].technique != GN_TECHNIQUE_NONE) == (i < key->shadow_count));
        REQUIRE(key->lights[i].technique < GN_TECHNIQUE_ALL);
        REQUIRE(key->lights[i].taps ==
                gn_taps_count(gn_techniques[key->lights[i].technique].taps, key->lights[i].taps));
        REQUIRE(key->lights[i].taps % 4 == 0 && key->lights[i].taps <= GN_TAPS_MAX);
        REQUIRE(key->lights[i].encoding < GN_ENCODING_ALL);
        REQUIRE(gn_techniques[key->lights[i].technique].on_screen ==
                (key->lights[i].encoding == GN_ENCODING_SCREEN));
        REQUIRE(key->lights[i].moments < GN_MOMENTS_COUNT);
        REQUIRE(gn_technique_filters_map((enum gn_technique)key->lights[i].technique) ==
                (key->lights[i].moments != GN_MOMENTS_NONE));
        REQUIRE(key->lights[i].slide < GN_SLIDE_COUNT);
        REQUIRE(key->lights[i].type < GN_LIGHT_TYPE_COUNT);
        const struct gn_light_type_row *type = &gn_light_types[key->lights[i].type];
        REQUIRE(!key->lights[i].cascades || !type->has_position);
        REQUIRE(key->lights[i].slide == GN_SLIDE_NONE || type->has_cone);
    }
    return NULL;
}

static bool rect_is_inside(const struct gn_rect *rect, const struct gn_target *target) {
    return rect->x <= target->width_px && rect->width <= target->width_px - rect->x &&
           rect->y <= target->height_px && rect->height <= target->height_px - rect->y;
}

/* ---- passes, by kind ---- */

static const char *check_picture(const struct gn_plan *plan, const struct gn_pass *pass) {
    const struct gn_pass_picture *p = &pass->picture;
    const bool clears = pass->clear.area != GN_CLEAR_NOTHING;
    REQUIRE(pass->target.kind == GN_TARGET_OUTPUT || pass->target.kind == GN_TARGET_ENCODED ||
            pass->target.kind == GN_TARGET_MEAN || pass->target.kind == GN_TARGET_SCALED);
    const bool is_shown = pass->target.kind == GN_TARGET_SCALED;
    REQUIRE(pass->target.width_px == (is_shown ? plan->shown_width_px : plan->width_px));
    REQUIRE(pass->target.height_px == (is_shown ? plan->shown_height_px : plan->height_px));
    REQUIRE(!p->scales || (is_shown && pass->draw_count == 0));
    REQUIRE(p->mean_of <= GN_PLAN_VIEWS_MAX && p->mean_of != plan->view + 1);
    REQUIRE(pass->target.kind != GN_TARGET_MEAN || pass->target.index < 2);
    REQUIRE(!p->mean_of || (!pass->depth_write && !clears));
    REQUIRE(pass->clear.area != GN_CLEAR_RECT && pass->viewport.width == 0);
    REQUIRE(pass->content.hash == 0);
    if (p->reads_atlas) {
        REQUIRE(plan->atlas && plan->atlas->coverage);
        REQUIRE(p->blend == GN_BLEND_ALPHA && !pass->depth_write);
        REQUIRE(plan->output != GN_OUTPUT_AOV);
    }

    /* The lights, maps and slides that it reads. */
    REQUIRE(p->light_count <= GN_LIGHTS_MAX && p->first_light <= plan->light_count);
    REQUIRE(p->light_count <= plan->light_count - p->first_light);
    REQUIRE(p->shadow_count <= GN_SHADOWS_MAX && p->first_shadow <= plan->shadow_count);
    REQUIRE(p->shadow_count <= plan->shadow_count - p->first_shadow);
    REQUIRE(p->plane_count <= p->shadow_count && p->first_on_plane <= plan->shadow_count);
    REQUIRE(p->plane_count <= plan->shadow_count - p->first_on_plane);
    REQUIRE(p->slide_count <= GN_SLIDES_MAX);
    for (uint32_t i = 0; i < p->slide_count; i++)
        REQUIRE(p->slides[i] < plan->scene->pictures.texture_count);
    REQUIRE(p->blend != GN_BLEND_TINT || (!pass->depth_write && !clears));
    if (p->blend == GN_BLEND_ADD) { /* to surfaces that are in the depth buffer */
        REQUIRE(!pass->depth_write && !clears);
        REQUIRE(plan->output != GN_OUTPUT_LINEAR8 || !plan->encode_srgb);
    }

    const struct gn_stencil *s = &p->stencil;
    const bool stencil = s->reads || s->writes || pass->clear.stencil_bits;
    REQUIRE(!stencil || (plan->stencil && pass->target.kind == GN_TARGET_OUTPUT));
    REQUIRE((s->value & ~(s->reads | s->writes)) == 0);
    REQUIRE(!pass->clear.stencil_bits || !clears);
    if (p->only_stencil) {
        REQUIRE(s->writes && !pass->depth_write && !clears);
        REQUIRE(p->blend == GN_BLEND_OFF);
    }
    return NULL;
}

/* What is drawn into a shadow map completes one tile of it, and is cleared with it. */
static const char *check_tile(const struct gn_plan *plan, const struct gn_pass *pass) {
    REQUIRE(pass->target.slot < plan->shadow_count);
    const struct gn_shadow_view *view = &plan->shadows[pass->target.slot];
    REQUIRE(pass->content.tile < view->map.tile_count && pass->content.completes);
    REQUIRE(pass->content.hash == view->raster.tiles[pass->content.tile].content_hash);
    REQUIRE(pass->clear.area == (view->map.tile_count > 1 ? GN_CLEAR_RECT : GN_CLEAR_ALL));
    REQUIRE(pass->target.encoding != GN_ENCODING_STENCIL);
    REQUIRE(pass->target.moments == GN_MOMENTS_NONE);
    REQUIRE(!pass->discard_depth || !gn_encoding_is_depth(pass->target.encoding));
    return NULL;
}

static const char *check_map(const struct gn_plan *plan, const struct gn_pass *pass) {
    const bool backs = pass->target.kind == GN_TARGET_BACKS;
    const bool pages = pass->target.kind == GN_TARGET_PAGES || backs;
    REQUIRE(pages || pass->target.kind == GN_TARGET_SHADOW);
    REQUIRE(!backs || (pass->clear.area == GN_CLEAR_ALL && !pass->map.reads_backs));
    const bool is_mean = pass->target.encoding == GN_ENCODING_MEAN;
    REQUIRE(pass->map.point_count == 0 || is_mean);
    REQUIRE(!is_mean || pass->draw_count == 0 || pass->map.point_count > 0);
    REQUIRE(!is_mean || (pass->depth_write && !pages));
    REQUIRE(pass->map.point_count == 0 || pass->map.points);
    if (!pages) return check_tile(plan, pass);
    REQUIRE(pass->target.slot < plan->shadow_count);
    REQUIRE(!pass->content.completes);
    return NULL;
}

static const char *check_copy(const struct gn_plan *plan, const struct gn_pass *pass) {
    const struct gn_target *from = &pass->copy.from;
    REQUIRE(pass->target.kind == GN_TARGET_SHADOW && from->kind == GN_TARGET_PAGES);
    REQUIRE(from->slot == pass->target.slot);
    REQUIRE(from->encoding == pass->target.encoding);
    REQUIRE(pass->draw_count == 0);
    REQUIRE(pass->copy.count > 0 && pass->copy.count <= GN_SHADOW_PAGES_MAX);
    for (uint32_t i = 0; i < pass->copy.count; i++) {
        const struct gn_copy *copy = &pass->copy.copies[i];
        const struct gn_rect to = {copy->to_x, copy->to_y, copy->from.width, copy->from.height};
        REQUIRE(rect_is_inside(&copy->from, from));
        REQUIRE(rect_is_inside(&to, &pass->target));
    }
    return check_tile(plan, pass);
}

/* As large as the picture; each pixel has its own texel. */
static const char *check_given(const struct gn_plan *plan, const struct gn_pass *pass) {
    REQUIRE(pass->target.kind == GN_TARGET_SHADOW);
    REQUIRE(pass->target.encoding == GN_ENCODING_SCREEN && pass->draw_count == 0);
    REQUIRE(pass->target.width_px == plan->width_px && pass->target.height_px == plan->height_px);
    REQUIRE(plan->msaa < 2);
    return check_tile(plan, pass);
}

/* A filter step draws all of its target once, and does not read its target. */
static const char *check_filter(const struct gn_plan *plan, const struct gn_pass *pass) {
    const struct gn_target *to = &pass->target;
    REQUIRE(to->kind == GN_TARGET_MOMENTS && to->index < GN_FILTER_TEXTURES_MAX);
    REQUIRE(to->moments != GN_MOMENTS_NONE && to->moments < GN_MOMENTS_ALL);
    REQUIRE(to->slot < plan->shadow_count && plan->shadows[to->slot].moments == to->moments);
    REQUIRE(!pass->content.completes || to->index == 0);
    REQUIRE(pass->draw_count == 1 && pass->clear.area == GN_CLEAR_NOTHING && !pass->depth_write);
    for (int i = 0; i < GN_FILTER_FROM_MAX; i++) {
        const struct gn_read *read = &pass->filter.reads[i];
        if (read->kind != GN_READ_MOMENTS) continue;
        REQUIRE(read->index != to->index && read->index < GN_FILTER_TEXTURES_MAX);
        REQUIRE(read->width_px > 0 && read->height_px > 0);
    }
    return NULL;
}

static const char *check_pass(const struct gn_plan *plan, const struct gn_pass *pass) {
    REQUIRE(pass->target.width_px > 0 && pass->target.height_px > 0);
    REQUIRE(rect_is_inside(&pass->rect, &pass->target));
    REQUIRE(rect_is_inside(&pass->viewport, &pass->target));
    REQUIRE(pass->clear.area != GN_CLEAR_RECT || pass->viewport.width > 0);
    REQUIRE(pass->content.tile < GN_SHADOW_TILES_MAX);
    REQUIRE(pass->first_draw <= plan->draw_count);
    REQUIRE(pass->draw_count <= plan->draw_count - pass->first_draw);
    REQUIRE(pass->constants != NULL && pass->constant_count > 0);
    REQUIRE(pass->kind == GN_PASS_PICTURE ||
            (pass->content.hash != 0 && !pass->clear.stencil_bits));
    const char *broken = "a pass of no known kind";
    switch (pass->kind) {
    case GN_PASS_PICTURE: broken = check_picture(plan, pass); break;
    case GN_PASS_MAP: broken = check_map(plan, pass); break;
    case GN_PASS_COPY: broken = check_copy(plan, pass); break;
    case GN_PASS_FILTER: broken = check_filter(plan, pass); break;
    case GN_PASS_GIVEN: broken = check_given(plan, pass); break;
    }
    for (uint32_t i = 0; i < pass->draw_count && !broken; i++)
        broken = check_draw(plan, pass, &plan->draws[pass->first_draw + i]);
    return broken;
}

const char *gn_plan_check(const struct gn_plan *plan) {
    REQUIRE(plan->scene != NULL);
    REQUIRE(plan->view < GN_PLAN_VIEWS_MAX);
    REQUIRE(plan->width_px > 0 && plan->height_px > 0);
    REQUIRE(plan->pass_count > 0);
    REQUIRE(plan->shadow_count <= GN_ALL_SHADOWS_MAX);
    REQUIRE(plan->light_count <= GN_ALL_LIGHTS_MAX);
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        REQUIRE(plan->stencil || plan->shadows[i].encoding != GN_ENCODING_STENCIL);
    REQUIRE(isfinite(plan->exposure) && plan->exposure > 0.0f);
    const char *broken = NULL;
    for (uint32_t i = 0; i < plan->program_count && !broken; i++)
        broken = check_key(&plan->programs[i]);
    for (uint32_t i = 0; i < plan->pass_count && !broken; i++)
        broken = check_pass(plan, &plan->passes[i]);
    if (broken) return broken;

    /* The order: pages are cleared by the first pass to them, and copied by the pass after the
     * last. Far sides are read by the pass after theirs. Only the last pass to the output resolves
     * it. */
    const struct gn_pass *passes = plan->passes;
    uint32_t last = plan->pass_count;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &passes[i];
        const bool backs = pass->target.kind == GN_TARGET_BACKS;
        const bool reads_backs = pass->kind == GN_PASS_MAP && pass->map.reads_backs;
        REQUIRE(reads_backs == (i > 0 && passes[i - 1].target.kind == GN_TARGET_BACKS));
        if (backs) continue;
        const struct gn_pass *before = i > reads_backs ? pass - 1 - reads_backs : NULL;
        const bool to_pages = pass->target.kind == GN_TARGET_PAGES;
        const bool goes_on = before && before->target.kind == GN_TARGET_PAGES;
        if (pass->target.kind == GN_TARGET_OUTPUT) last = i;
        REQUIRE(goes_on || pass->kind != GN_PASS_COPY);
        if (to_pages) REQUIRE((pass->clear.area == GN_CLEAR_NOTHING) == goes_on);
        if (!goes_on) continue;
        REQUIRE(to_pages || pass->kind == GN_PASS_COPY);
        REQUIRE(pass->target.slot == before->target.slot);
        REQUIRE(pass->content.hash == before->content.hash);
    }
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (passes[i].kind == GN_PASS_PICTURE) REQUIRE(passes[i].picture.resolves == (i == last));
    REQUIRE(passes[0].clear.area != GN_CLEAR_NOTHING);
    REQUIRE(passes[plan->pass_count - 1].kind == GN_PASS_PICTURE);
    const enum gn_target_kind end = passes[plan->pass_count - 1].target.kind;
    REQUIRE((end == GN_TARGET_SCALED) == gn_plan_scales(plan));
    REQUIRE((end == GN_TARGET_ENCODED) == (plan->finishes && !gn_plan_scales(plan)));
    REQUIRE((end == GN_TARGET_MEAN) == plan->gathers);
    for (uint32_t i = 1; i < plan->pass_count; i++) { /* scaled once, before anything else is */
        const struct gn_pass *before = &passes[i - 1], *pass = &passes[i];
        if (pass->kind == GN_PASS_PICTURE && pass->target.kind == GN_TARGET_SCALED)
            REQUIRE(pass->picture.scales == (before->target.kind != GN_TARGET_SCALED));
    }
    REQUIRE(!plan->gathers || (!plan->finishes && plan->msaa == 0));
    REQUIRE(!(plan->finishes || plan->gathers) || plan->output == GN_OUTPUT_FLOAT);
    REQUIRE(plan->tone > GN_TONE_AUTO && plan->tone < GN_TONE_COUNT);
    return NULL;
}
