#include "cost/drawn.h"

#include <string.h>

#include "blocks.glsl"
#include "core/arena.h"
#include "truth/raycast.h"

struct counter {
    const struct gn_plan *plan;
    const struct gn_pose *pose;
    struct gn_raster raster;
    struct gn_target target; /* that its depth is of */
    bool any;
    const struct gn_material *material; /* of the draw */
};

/* ---- targets ---- */

static bool is_same_target(const struct gn_target *a, const struct gn_target *b) {
    return a->kind == b->kind && a->slot == b->slot && a->index == b->index &&
           a->width_px == b->width_px && a->height_px == b->height_px;
}

static struct gn_raster_rect rect_of(const struct gn_rect *r, const struct gn_target *target) {
    if (r->width == 0)
        return (struct gn_raster_rect){0, 0, (int)target->width_px, (int)target->height_px};
    return (struct gn_raster_rect){(int)r->x, (int)r->y, (int)r->width, (int)r->height};
}

/* What is outside the target is never drawn. */
static void bound_rect(struct gn_raster_rect *r, const struct gn_target *target) {
    const int right = r->x + r->width, top = r->y + r->height;
    const int width = (int)target->width_px, height = (int)target->height_px;
    r->width = (right < width ? right : width) - r->x;
    r->height = (top < height ? top : height) - r->y;
}

static void begin_pass(struct counter *c, const struct gn_pass *pass) {
    struct gn_raster *r = &c->raster;
    const bool picture = pass->kind == GN_PASS_PICTURE;
    const bool output = picture && pass->target.kind == GN_TARGET_OUTPUT;
    if (!c->any || !is_same_target(&c->target, &pass->target)) {
        if (c->any) gn_raster_destroy(r);
        gn_raster_create(r, (int)pass->target.width_px, (int)pass->target.height_px,
                         output && c->plan->msaa > 1 ? (int)c->plan->msaa : 1);
        c->target = pass->target;
        c->any = true;
    }
    r->viewport = rect_of(&pass->viewport, &pass->target);
    r->scissor = rect_of(&pass->rect, &pass->target);
    bound_rect(&r->scissor, &pass->target);
    if (pass->clear.area == GN_CLEAR_ALL)
        gn_raster_clear(r, &(struct gn_raster_rect){0, 0, r->width_px, r->height_px});
    if (pass->clear.area == GN_CLEAR_RECT) gn_raster_clear(r, &r->viewport);
    r->tests_depth =
        output ? !pass->picture.only_stencil && !gn_pass_is_mean(pass) : pass->kind == GN_PASS_MAP;
    r->writes_depth = pass->depth_write;
}

/* ---- vertices ---- */

static void transform(const float (*m)[4], const float p[3], double out[4]) {
    for (int k = 0; k < 4; k++)
        out[k] = (double)(m[0][k] * p[0] + m[1][k] * p[1] + m[2][k] * p[2] + m[3][k]);
}

static void place(const struct counter *c, const struct gn_instance *instance, bool posed,
                  uint32_t vertex, float out[3]) {
    const float *p = c->plan->scene->buffers.positions + 3 * (size_t)vertex;
    if (posed) {
        uint32_t item; /* frame/draws.c */
        memcpy(&item, &instance->world[2][0], sizeof item);
        gn_pose_corner(c->pose, item, vertex, out);
        return;
    }
    for (int row = 0; row < 3; row++) {
        const float *w = instance->world[row];
        out[row] = w[0] * p[0] + w[1] * p[1] + w[2] * p[2] + w[3];
    }
}

/* Texture coordinates of the base texture, and the vertex' alpha times the instance's. */
static void set_attributes(const struct counter *c, const struct gn_draw *draw,
                           const struct gn_instance *instance, uint32_t vertex, double out[3]) {
    const struct gn_scene *scene = c->plan->scene;
    const struct gn_texture_ref *ref = &c->material->textures[GN_TEXTURE_BASE];
    const float *set = ref->uv_set ? scene->buffers.uv1 : scene->buffers.uv0, *m = ref->uv_from_uv;
    const double u = set ? (double)set[2 * (size_t)vertex] : 0,
                 v = set ? (double)set[2 * (size_t)vertex + 1] : 0;
    out[0] = (double)m[0] * u + (double)m[2] * v + (double)m[4];
    out[1] = (double)m[1] * u + (double)m[3] * v + (double)m[5];
    out[2] = (double)instance->base_color[3];
    if (gn_geometry_has(&scene->geometries[draw->geometry], GN_ATTRIBUTE_COLOR) &&
        scene->buffers.colors)
        out[2] *= (double)scene->buffers.colors[4 * (size_t)vertex + 3] / 255.0;
}

static bool is_hole(const void *context, const double attributes[3]) {
    const struct counter *c = context;
    const int32_t texture = c->material->textures[GN_TEXTURE_BASE].texture;
    const struct gn_scene *scene = c->plan->scene;
    double alpha = attributes[2];
    if (texture >= 0)
        alpha *= gn_ray_sample_alpha(scene, &scene->pictures.textures[texture], attributes[0],
                                     attributes[1]);
    return alpha < (double)gn_material_least_alpha(c->material);
}

/* ---- draws ---- */

static void draw_instance(struct counter *c, const struct gn_pass *pass, const struct gn_draw *draw,
                          const struct gn_instance *instance) {
    const struct gn_scene *scene = c->plan->scene;
    const struct gn_corners corners_of = gn_draw_corners(scene, c->plan->detail, draw);
    const bool posed = c->plan->programs[draw->program].features & GN_FEATURES_POSED;
    const bool flat = c->plan->programs[draw->program].kind == GN_PROGRAM_FLAT;
    const float(*clip)[4] =
        pass->kind == GN_PASS_MAP && pass->map.point_count > 0 ? pass->map.points : pass->constants;
    for (uint32_t i = 0; i < corners_of.count; i += 3) {
        const uint32_t *index = corners_of.indices + i;
        struct gn_raster_vertex corners[3];
        for (int k = 0; k < 3; k++) {
            float p[3];
            place(c, instance, posed, index[k], p);
            transform(clip + PASS_CLIP, p, corners[k].clip);
            if (flat) corners[k].clip[2] = 0;
            if (c->raster.is_hole)
                set_attributes(c, draw, instance, index[k], corners[k].attributes);
        }
        gn_raster_triangle(&c->raster, corners);
    }
}

/* The whole target, or the part of the floor that has shadows, at the depth of their shaders. */
static void draw_bare(struct counter *c, const struct gn_pass *pass, enum gn_program_kind kind) {
    struct gn_raster_vertex v[4] = {
        {{-1, -1, 0, 1}, {0}}, {{3, -1, 0, 1}, {0}}, {{-1, 3, 0, 1}, {0}}};
    for (int i = 0; kind == GN_PROGRAM_BACKDROP && i < 3; i++) v[i].clip[2] = 1;
    for (int i = 0; kind == GN_PROGRAM_FLOOR && i < 4; i++) {
        const float *shown = pass->constants[FLOOR_SHOWN];
        const float u = shown[i % 2 ? 2 : 0], w = shown[i / 2 ? 3 : 1];
        for (int k = 0; k < 4; k++)
            v[i].clip[k] =
                (double)(pass->constants[FLOOR_PLACE][k] + u * pass->constants[FLOOR_PLACE + 1][k] +
                         w * pass->constants[FLOOR_PLACE + 2][k]);
    }
    gn_raster_triangle(&c->raster, v);
    if (kind == GN_PROGRAM_FLOOR) gn_raster_triangle(&c->raster, v + 1);
}

static void count_draw(struct counter *c, const struct gn_pass *pass, const struct gn_draw *draw) {
    const struct gn_program_key *key = &c->plan->programs[draw->program];
    const enum gn_program_kind kind = key->kind;
    struct gn_raster *r = &c->raster;
    r->count = (struct gn_raster_count){0};
    r->cull = (enum gn_raster_cull)draw->cull;
    r->mirrored = draw->mirrored;
    r->is_hole = NULL;
    if (draw->geometry == GN_NO_GEOMETRY) {
        r->cull = GN_RASTER_BOTH;
        if (kind != GN_PROGRAM_MARK && kind != GN_PROGRAM_PANEL && kind != GN_PROGRAM_CAPTION)
            draw_bare(c, pass, kind);
        return;
    }
    c->material = &c->plan->materials[draw->material];
    r->context = c;
    if (key->features & GN_FEATURE(ALPHA_MASK) && !(key->features & GN_FEATURE(ALPHA_DITHER)))
        r->is_hole = is_hole;
    for (uint32_t i = 0; i < draw->instance_count; i++)
        draw_instance(c, pass, draw, &c->plan->instances[draw->first_instance + i]);
}

void gn_cost_count(const struct gn_plan *plan, const struct gn_pose *pose,
                   struct gn_raster_count *counts) {
    struct counter c = {.plan = plan, .pose = pose};
    memset(counts, 0, plan->draw_count * sizeof *counts);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        const uint64_t points =
            pass->kind == GN_PASS_MAP && pass->map.point_count > 0 ? pass->map.point_count : 1;
        if (pass->draw_count > 0 || pass->clear.area != GN_CLEAR_NOTHING) begin_pass(&c, pass);
        for (uint32_t k = 0; k < pass->draw_count; k++) {
            const uint32_t draw = pass->first_draw + k;
            count_draw(&c, pass, &plan->draws[draw]);
            counts[draw] = (struct gn_raster_count){c.raster.count.triangles * points,
                                                    c.raster.count.pixels * points,
                                                    c.raster.count.lanes * points};
        }
    }
    if (c.any) gn_raster_destroy(&c.raster);
}
