#include <math.h>

#include "frame/plan.h"

#define REQUIRE(what)                                                                              \
    do {                                                                                           \
        if (!(what)) return #what;                                                                 \
    } while (0)

static const char *check_draw(const struct gn_plan *plan, const struct gn_draw *draw) {
    REQUIRE(draw->program < plan->program_count);
    REQUIRE(draw->geometry < plan->scene->geometry_count);
    REQUIRE(draw->material < plan->scene->material_count);
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
    REQUIRE(key->taps == 0 || key->taps == 8 || key->taps == 16 || key->taps == 32);
    REQUIRE(key->features < 1u << GN_FEATURE_BITS);
    for (int i = 0; i < key->light_count; i++) {
        REQUIRE((key->lights[i].technique != GN_TECHNIQUE_NONE) == (i < key->shadow_count));
        REQUIRE(key->lights[i].technique < GN_TECHNIQUE_COUNT);
        REQUIRE(key->lights[i].encoding < GN_ENCODING_COUNT);
    }
    return NULL;
}

static const char *check_pass(const struct gn_plan *plan, const struct gn_pass *pass) {
    REQUIRE(pass->target.width_px > 0 && pass->target.height_px > 0);
    REQUIRE(pass->target.kind == GN_TARGET_OUTPUT || pass->target.slot < plan->shadow_count);
    REQUIRE(pass->target.kind == GN_TARGET_OUTPUT || (pass->clear && pass->content_hash != 0));
    REQUIRE(pass->first_draw <= plan->draw_count);
    REQUIRE(pass->draw_count <= plan->draw_count - pass->first_draw);
    REQUIRE(pass->constants != NULL && pass->constant_count > 0);
    for (uint32_t i = 0; i < pass->draw_count; i++) {
        const struct gn_draw *draw = &plan->draws[pass->first_draw + i];
        const char *broken = check_draw(plan, draw);
        if (broken) return broken;
        bool caster = plan->programs[draw->program].kind <= GN_PROGRAM_DISTANCE;
        REQUIRE(caster == (pass->target.kind == GN_TARGET_SHADOW));
    }
    return NULL;
}

const char *gn_plan_check(const struct gn_plan *plan) {
    REQUIRE(plan->scene != NULL);
    REQUIRE(plan->width_px > 0 && plan->height_px > 0);
    REQUIRE(plan->pass_count > 0);
    REQUIRE(plan->shadow_count <= GN_SHADOWS_MAX);
    REQUIRE(plan->passes[0].clear);
    REQUIRE(isfinite(plan->exposure) && plan->exposure > 0.0f);
    const char *broken = NULL;
    for (uint32_t i = 0; i < plan->program_count && !broken; i++)
        broken = check_key(&plan->programs[i]);
    for (uint32_t i = 0; i < plan->pass_count && !broken; i++)
        broken = check_pass(plan, &plan->passes[i]);
    return broken;
}
