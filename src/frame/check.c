#include <math.h>

#include "frame/plan.h"

#define REQUIRE(what)                                                                              \
    do {                                                                                           \
        if (!(what)) return #what;                                                                 \
    } while (0)

static const char *check_draw(const struct gn_plan *plan, const struct gn_draw *draw) {
    REQUIRE(draw->program < plan->program_count);
    const bool bare = plan->programs[draw->program].kind > GN_PROGRAM_AOV;
    REQUIRE(bare == (draw->geometry == GN_NO_GEOMETRY));
    REQUIRE(bare ? draw->vertex_count > 0 : draw->geometry < plan->scene->geometry_count);
    REQUIRE(bare || draw->material < plan->scene->material_count);
    REQUIRE(draw->instance_count > 0);
    REQUIRE(draw->first_instance <= plan->instance_count);
    REQUIRE(draw->instance_count <= plan->instance_count - draw->first_instance);
    REQUIRE(draw->cull <= GN_CULL_FRONT);
    return NULL;
}

static const char *check_key(const struct gn_program_key *key) {
    REQUIRE(key->kind < GN_PROGRAM_KIND_COUNT);
    REQUIRE(key->light_count <= GN_LIGHTS_MAX);
    REQUIRE(key->shadow_count <= GN_SHADOWS_MAX);
    REQUIRE(key->shadow_count <= key->light_count);
    REQUIRE(key->encoding < GN_ENCODING_COUNT);
    REQUIRE(key->technique < GN_TECHNIQUE_COUNT && key->step < GN_STEP_COUNT);
    REQUIRE(key->moments < GN_MOMENTS_COUNT);
    REQUIRE((key->kind == GN_PROGRAM_FILTER) == (key->moments != GN_MOMENTS_NONE));
    REQUIRE(key->taps == 0 || key->taps == 8 || key->taps == 16 || key->taps == 32);
    REQUIRE(key->receiver <= GN_RECEIVES_ALL);
    REQUIRE((key->features & ~gn_features_all()) == 0);
    for (int i = 0; i < key->light_count; i++) {
        REQUIRE((key->lights[i].technique != GN_TECHNIQUE_NONE) == (i < key->shadow_count));
        REQUIRE(key->lights[i].technique < GN_TECHNIQUE_COUNT);
        REQUIRE(key->lights[i].encoding < GN_ENCODING_COUNT);
        REQUIRE(key->lights[i].moments < GN_MOMENTS_COUNT);
        REQUIRE(gn_technique_filters_map((enum gn_technique)key->lights[i].technique) ==
                (key->lights[i].moments != GN_MOMENTS_NONE));
        REQUIRE(key->lights[i].slide < GN_SLIDE_COUNT);
        REQUIRE(!key->lights[i].cascades || key->lights[i].type == GN_LIGHT_DIRECTIONAL);
        REQUIRE(key->lights[i].slide == GN_SLIDE_NONE || key->lights[i].type == GN_LIGHT_SPOT);
    }
    return NULL;
}

static uint32_t slide_count(const struct gn_program_key *key) {
    uint32_t count = 0;
    for (int i = 0; i < key->light_count; i++) count += key->lights[i].slide != GN_SLIDE_NONE;
    return count;
}

/* What a program needs of the pass that draws with it. */
static const char *check_use(const struct gn_pass *pass, const struct gn_program_key *key) {
    const bool adds = key->features & GN_FEATURE(ADDITIVE);
    const bool panel = key->kind == GN_PROGRAM_PANEL;
    REQUIRE((key->kind < GN_PROGRAM_FLAT) == gn_target_is_map(&pass->target));
    REQUIRE((key->kind == GN_PROGRAM_FLAT) == pass->only_stencil);
    REQUIRE((key->kind == GN_PROGRAM_FILTER) == (pass->target.kind == GN_TARGET_MOMENTS));
    REQUIRE(key->kind != GN_PROGRAM_FILTER || key->moments == pass->target.moments);
    const bool caption = key->kind == GN_PROGRAM_CAPTION;
    REQUIRE(key->kind != GN_PROGRAM_ENCODE || pass->target.kind == GN_TARGET_ENCODED);
    REQUIRE(key->kind == GN_PROGRAM_ENCODE || caption || pass->target.kind != GN_TARGET_ENCODED);
    REQUIRE(caption == pass->reads_atlas);
    REQUIRE(adds == (pass->blend == GN_BLEND_ADD));
    REQUIRE(key->light_count <= pass->light_count);
    REQUIRE(key->shadow_count <= pass->shadow_count);
    REQUIRE(slide_count(key) <= pass->slide_count);
    REQUIRE(panel == pass->reads_codes && (!panel || pass->shadow_count == 1));
    return NULL;
}

static bool rect_is_inside(const struct gn_rect *rect, const struct gn_target *target) {
    return rect->x <= target->width_px && rect->width <= target->width_px - rect->x &&
           rect->y <= target->height_px && rect->height <= target->height_px - rect->y;
}

/* The lights and maps that a pass reads; what is added finds the depth of what it is added to. */
static const char *check_lights(const struct gn_plan *plan, const struct gn_pass *pass) {
    REQUIRE(pass->light_count <= GN_LIGHTS_MAX && pass->first_light <= plan->light_count);
    REQUIRE(pass->light_count <= plan->light_count - pass->first_light);
    REQUIRE(pass->shadow_count <= GN_SHADOWS_MAX && pass->first_shadow <= plan->shadow_count);
    REQUIRE(pass->shadow_count <= plan->shadow_count - pass->first_shadow);
    REQUIRE(pass->slide_count <= GN_SLIDES_MAX);
    for (uint32_t i = 0; i < pass->slide_count; i++)
        REQUIRE(pass->slides[i] < plan->scene->texture_count);
    REQUIRE(pass->blend != GN_BLEND_ADD || (!pass->depth_write && !pass->clear));
    REQUIRE(pass->blend != GN_BLEND_ADD || plan->output != GN_OUTPUT_LINEAR8 || !plan->encode_srgb);
    return NULL;
}

/* What stencil a pass may use; where it is all that is drawn to. */
static const char *check_stencil(const struct gn_plan *plan, const struct gn_pass *pass) {
    const struct gn_stencil *s = &pass->stencil;
    const bool used = s->reads || s->writes || s->clears;
    REQUIRE(!used || (plan->stencil && pass->target.kind == GN_TARGET_OUTPUT));
    REQUIRE((s->value & ~(s->reads | s->writes)) == 0);
    REQUIRE(!s->clears || !pass->clear);
    REQUIRE(!pass->only_stencil || (s->writes && !pass->depth_write && !pass->clear));
    REQUIRE(!pass->only_stencil || pass->blend == GN_BLEND_OFF);
    return NULL;
}

static bool shares_map(const struct gn_pass *a, const struct gn_pass *b) {
    return gn_target_is_map(&a->target) && gn_target_is_map(&b->target) &&
           a->target.slot == b->target.slot;
}

/* Pages are cleared by the first of them, and put together by the pass after the last. */
static const char *check_pages(const struct gn_plan *plan, const struct gn_pass *pass) {
    const struct gn_pass *before = pass > plan->passes ? pass - 1 : NULL,
                         *after = pass + 1 < plan->passes + plan->pass_count ? pass + 1 : NULL;
    const bool goes_on = before && before->target.kind == GN_TARGET_PAGES;
    const bool page = pass->target.kind == GN_TARGET_PAGES;
    REQUIRE(!page || (after && shares_map(pass, after)));
    REQUIRE(!page || after->content_hash == pass->content_hash);
    REQUIRE(!page || pass->clear != goes_on);
    REQUIRE(page || goes_on == (pass->copy_count > 0));
    REQUIRE(pass->copy_count <= GN_SHADOW_PAGES_MAX);
    REQUIRE(!pass->copy_count || pass->draw_count == 0);
    for (uint32_t i = 0; i < pass->copy_count; i++) {
        const struct gn_copy *copy = &pass->copies[i];
        const struct gn_rect to = {copy->to_x, copy->to_y, copy->from.width, copy->from.height};
        REQUIRE(rect_is_inside(&copy->from, &pass->target));
        REQUIRE(rect_is_inside(&to, &pass->target));
    }
    return NULL;
}

/* A filter of a map draws all of its target once, and reads nothing that it draws to. */
static const char *check_filter(const struct gn_plan *plan, const struct gn_pass *pass) {
    const bool filters = pass->target.kind == GN_TARGET_MOMENTS;
    const enum gn_moments moments = pass->target.moments;
    REQUIRE(filters == (moments != GN_MOMENTS_NONE) && moments < GN_MOMENTS_COUNT);
    REQUIRE(filters || !pass->completes);
    for (int i = 0; i < GN_FILTER_FROM_MAX; i++) {
        const struct gn_read *read = &pass->reads[i];
        REQUIRE(filters || read->kind == GN_READ_NOTHING);
        if (read->kind != GN_READ_MOMENTS) continue;
        REQUIRE(read->index != pass->target.index && read->index < GN_FILTER_TEXTURES_MAX);
        REQUIRE(read->width_px > 0 && read->height_px > 0);
    }
    if (!filters) return NULL;
    REQUIRE(pass->target.index < GN_FILTER_TEXTURES_MAX);
    REQUIRE(pass->target.slot < plan->shadow_count && pass->content_hash != 0);
    REQUIRE(plan->shadows[pass->target.slot].moments == moments);
    REQUIRE(!pass->completes || pass->target.index == 0);
    REQUIRE(pass->draw_count == 1 && !pass->clear && !pass->depth_write);
    return NULL;
}

static const char *check_pass(const struct gn_plan *plan, const struct gn_pass *pass) {
    REQUIRE(pass->target.width_px > 0 && pass->target.height_px > 0);
    const bool shadow = gn_target_is_map(&pass->target);
    REQUIRE(!shadow || pass->target.slot < plan->shadow_count);
    REQUIRE(!shadow || pass->content_hash != 0);
    REQUIRE(pass->target.kind != GN_TARGET_SHADOW || pass->clear);
    REQUIRE(!shadow || pass->target.encoding != GN_ENCODING_STENCIL);
    REQUIRE(!pass->reads_atlas || (plan->atlas && plan->atlas->coverage));
    REQUIRE(!pass->reads_atlas || (pass->blend == GN_BLEND_ALPHA && !pass->depth_write));
    REQUIRE(!pass->reads_atlas || plan->output != GN_OUTPUT_AOV);
    REQUIRE(rect_is_inside(&pass->rect, &pass->target));
    REQUIRE(rect_is_inside(&pass->viewport, &pass->target));
    REQUIRE(pass->tile < GN_SHADOW_TILES_MAX);
    REQUIRE(pass->first_draw <= plan->draw_count);
    REQUIRE(pass->draw_count <= plan->draw_count - pass->first_draw);
    REQUIRE(pass->constants != NULL && pass->constant_count > 0);
    const char *broken = check_lights(plan, pass);
    if (!broken) broken = check_stencil(plan, pass);
    if (!broken) broken = check_pages(plan, pass);
    if (!broken) broken = check_filter(plan, pass);
    for (uint32_t i = 0; i < pass->draw_count && !broken; i++) {
        const struct gn_draw *draw = &plan->draws[pass->first_draw + i];
        broken = check_draw(plan, draw);
        if (!broken) broken = check_use(pass, &plan->programs[draw->program]);
    }
    return broken;
}

const char *gn_plan_check(const struct gn_plan *plan) {
    REQUIRE(plan->scene != NULL);
    REQUIRE(plan->width_px > 0 && plan->height_px > 0);
    REQUIRE(plan->pass_count > 0);
    REQUIRE(plan->shadow_count <= GN_ALL_SHADOWS_MAX);
    REQUIRE(plan->light_count <= GN_ALL_LIGHTS_MAX);
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        REQUIRE(plan->stencil || plan->shadows[i].encoding != GN_ENCODING_STENCIL);
    REQUIRE((plan->passes[plan->pass_count - 1].target.kind == GN_TARGET_ENCODED) ==
            (plan->encode_srgb && plan->output == GN_OUTPUT_FLOAT));
    REQUIRE(plan->passes[0].clear);
    REQUIRE(isfinite(plan->exposure) && plan->exposure > 0.0f);
    const char *broken = NULL;
    for (uint32_t i = 0; i < plan->program_count && !broken; i++)
        broken = check_key(&plan->programs[i]);
    for (uint32_t i = 0; i < plan->pass_count && !broken; i++)
        broken = check_pass(plan, &plan->passes[i]);
    return broken;
}
