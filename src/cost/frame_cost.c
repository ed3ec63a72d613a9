#include "cost/frame_cost.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

#define GIGA_MS          1e6 /* of 1e9 a second in a millisecond */
#define TAP_INSTRUCTIONS 8.0

/* ---- memory ---- */

static double texel_bytes(const struct gn_target *target) {
    if (target->kind == GN_TARGET_MOMENTS) return gn_moments[target->moments].texel_bytes;
    return gn_encodings[target->encoding].texel_bytes;
}

static double area_of(const struct gn_pass *pass) {
    const struct gn_rect *r = &pass->viewport;
    return r->width > 0 ? (double)r->width * r->height
                        : (double)pass->target.width_px * pass->target.height_px;
}

/* What is stored of its target, and loaded of others of its size. Tiling GPUs store a picture once,
 * after its last pass. */
static double target_bytes(const struct gn_plan *plan, const struct gn_pass *pass) {
    const double pixel = plan->output == GN_OUTPUT_FLOAT ? 8 : 4;
    switch (pass->kind) {
    case GN_PASS_PICTURE:
        if (pass->target.kind == GN_TARGET_ENCODED) return area_of(pass) * (pixel + 4);
        if (pass->picture.scales)
            return 4.0 * (area_of(pass) + (double)plan->width_px * plan->height_px);
        if (pass->target.kind == GN_TARGET_MEAN) return area_of(pass) * 2 * pixel;
        return pass->picture.resolves ? area_of(pass) * pixel : 0;
    case GN_PASS_COPY: return area_of(pass) * 2 * texel_bytes(&pass->target);
    case GN_PASS_FILTER: return area_of(pass) * 2 * texel_bytes(&pass->target);
    case GN_PASS_MAP: return area_of(pass) * texel_bytes(&pass->target);
    default: return 0;
    }
}

/* Each pixel reads about one texel of each texture that nobody read before, of its mip-maps, and of
 * each map. */
static double read_bytes(const struct gn_plan *plan, const struct gn_draw *draw, uint64_t pixels) {
    const struct gn_program_key *key = &plan->programs[draw->program];
    const struct gn_scene *scene = plan->scene;
    const double maps = key->shadow_count + (key->kind == GN_PROGRAM_FLOOR);
    double bytes = 4.0 * (double)pixels * maps;
    for (int slot = 0; draw->geometry != GN_NO_GEOMETRY && slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        const int32_t texture = plan->materials[draw->material].textures[slot].texture;
        if (texture < 0 || !(key->features >> (GN_FEATURE_FIRST_TEXTURE + slot) & 1)) continue;
        const struct gn_image *image =
            &scene->pictures.images[scene->pictures.textures[texture].image];
        const double all = (double)gn_scene_image_bytes(image),
                     texels = (double)image->width_px * image->height_px;
        bytes += fmin(all, (double)pixels * all / texels);
    }
    return bytes;
}

static double vertex_bytes(const struct gn_plan *plan, const struct gn_draw *draw) {
    const struct gn_corners g = gn_draw_corners(plan->scene, plan->detail, draw);
    return draw->instance_count *
           ((double)g.vertex_count * gn_scene_vertex_bytes(plan->scene) + 4.0 * g.count);
}

/* ---- passes ---- */

static uint64_t vertices_of(const struct gn_plan *plan, const struct gn_pass *pass,
                            const struct gn_draw *draw) {
    const uint64_t points =
        pass->kind == GN_PASS_MAP && pass->map.point_count > 0 ? pass->map.point_count : 1;
    if (draw->geometry == GN_NO_GEOMETRY) return draw->vertex_count * points;
    return (uint64_t)gn_draw_corners(plan->scene, plan->detail, draw).vertex_count *
           draw->instance_count * points;
}

static void add_draw(struct gn_frame_cost *cost, const struct gn_pass *pass,
                     const struct gn_draw *draw, const struct gn_raster_count *count,
                     struct gn_pass_cost *out) {
    const struct gn_program_cost *program = &cost->programs[draw->program];
    const uint64_t vertices = vertices_of(cost->plan, pass, draw);
    const double lanes = (double)count->lanes;
    out->draws++;
    out->triangles += count->triangles;
    out->vertices += vertices;
    out->pixels += count->pixels;
    out->lanes += count->lanes;
    out->instructions += lanes * program->fragment;
    out->fetches += lanes * program->fetches;
    out->vertex_instructions += (double)vertices * program->vertex;
    out->bytes += read_bytes(cost->plan, draw, count->pixels);
    if (draw->geometry != GN_NO_GEOMETRY) out->bytes += vertex_bytes(cost->plan, draw);
}

static void bound_pass(const struct gn_cost_gpu *gpu, struct gn_pass_cost *pass) {
    const double amounts[] = {pass->instructions, pass->fetches, pass->bytes},
                 rates[] = {gpu->instructions_g, gpu->fetches_g, gpu->bytes_g};
    for (int i = 0; i < GN_COST_LIMITS; i++) {
        pass->limit_ms[i] = amounts[i] / rates[i] / GIGA_MS;
        if (pass->limit_ms[i] > pass->limit_ms[pass->limit]) pass->limit = (enum gn_cost_limit)i;
    }
    pass->vertex_ms = pass->vertex_instructions / gpu->instructions_g / GIGA_MS;
    pass->ms = pass->limit_ms[pass->limit] + pass->vertex_ms;
}

/* ---- who costs most ---- */

/* Of a lane in a program: instructions or fetches, whichever take longer. */
static double lane_ms(const struct gn_cost_gpu *gpu, const struct gn_program_cost *program) {
    return fmax(program->fragment / gpu->instructions_g, program->fetches / gpu->fetches_g) /
           GIGA_MS;
}

static double draw_ms(const struct gn_frame_cost *cost, const struct gn_pass *pass,
                      const struct gn_draw *draw, const struct gn_raster_count *count) {
    const struct gn_program_cost *program = &cost->programs[draw->program];
    return (double)count->lanes * lane_ms(cost->gpu, program) +
           (double)vertices_of(cost->plan, pass, draw) * program->vertex /
               cost->gpu->instructions_g / GIGA_MS;
}

/* The name without its light of that number. */
static void leave_light_out(const char *name, uint32_t light, char out[GN_PROGRAM_NAME]) {
    const char *at = strstr(name, ", ");
    for (; at && light > 0; light--) at = strstr(at + 2, ", ");
    const char *rest = at ? strstr(at + 2, ", ") : NULL;
    snprintf(out, GN_PROGRAM_NAME, "%.*s%s", at ? (int)(at - name) : GN_PROGRAM_NAME, name,
             rest ? rest : "");
}

/* What the lights of a program cost in its lanes: by how much it is dearer than without each. */
static void add_lights(struct gn_frame_cost *cost, const struct gn_cost_table *table,
                       const struct gn_pass *pass, const struct gn_draw *draw, double lanes) {
    const struct gn_program_key *key = &cost->plan->programs[draw->program];
    for (uint32_t i = 0; i < key->light_count && i < pass->picture.light_count; i++) {
        struct gn_program_cost without;
        char name[GN_PROGRAM_NAME];
        leave_light_out(cost->names[draw->program], i, name);
        if (!gn_cost_table_find(table, name, -1, &without)) continue;
        const double all = lane_ms(cost->gpu, &cost->programs[draw->program]),
                     rest = lane_ms(cost->gpu, &without);
        cost->lights[pass->picture.first_light + i].ms += lanes * fmax(all - rest, 0);
    }
}

static void share_pass(struct gn_frame_cost *cost, const struct gn_cost_table *table,
                       const struct gn_pass *pass, double pass_ms,
                       const struct gn_raster_count *counts) {
    const struct gn_plan *plan = cost->plan;
    for (uint32_t k = 0; k < pass->draw_count && pass->kind == GN_PASS_PICTURE; k++) {
        const struct gn_draw *draw = &plan->draws[pass->first_draw + k];
        const struct gn_raster_count *count = &counts[pass->first_draw + k];
        if (draw->geometry == GN_NO_GEOMETRY) continue;
        cost->materials[draw->material].ms += draw_ms(cost, pass, draw, count);
        if (plan->programs[draw->program].kind == GN_PROGRAM_LIT)
            add_lights(cost, table, pass, draw, (double)count->lanes);
    }
    if (pass->kind == GN_PASS_PICTURE) return;
    for (uint32_t i = 0; i < plan->light_count; i++)
        if (plan->lights[i] == plan->shadows[pass->target.slot].light)
            cost->lights[i].ms += pass_ms;
}

static int compare_shares(const void *a, const void *b) {
    const double x = ((const struct gn_cost_share *)a)->ms,
                 y = ((const struct gn_cost_share *)b)->ms;
    return (x < y) - (x > y);
}

/* ---- the frame ---- */

/* More taps than a technique has by itself, or fewer: budgets are of those. Each is one fetch, and
 * one more where blockers are searched with as many; between 8 and 16 taps of cone compilers take
 * 8.6 instructions for each on V3D, 8.5 on Mali-G52, 2.1 on Adreno 618. */
static void add_taps(const struct gn_program_key *key, struct gn_program_cost *program) {
    for (uint32_t i = 0; i < key->light_count; i++) {
        const struct gn_technique_row *technique = &gn_techniques[key->lights[i].technique];
        if (technique->taps == GN_TAPS_NONE || key->lights[i].taps == 0) continue;
        const int more = (int)key->lights[i].taps - gn_taps_count(technique->taps, 0),
                  reads = technique->searches ? 2 : 1;
        program->fetches = fmax(program->fetches + more * reads, 0);
        program->fragment = fmax(program->fragment + TAP_INSTRUCTIONS * more * reads, 1);
    }
}

/* Mali's compilers fold a read at a plain varying into the load of that varying, and do not count
 * it: the one of the floor's map. */
static void find_programs(struct gn_frame_cost *cost, const struct gn_cost_table *table) {
    for (uint32_t i = 0; i < cost->plan->program_count; i++) {
        struct gn_program_cost *program = &cost->programs[i];
        cost->known[i] = gn_cost_table_find(table, cost->names[i], -1, program);
        add_taps(&cost->plan->programs[i], program);
        if (cost->plan->programs[i].kind == GN_PROGRAM_FLOOR)
            program->fetches = fmax(program->fetches, 1);
    }
}

static void name_shares(struct gn_frame_cost *cost) {
    const struct gn_scene *scene = cost->plan->scene;
    for (uint32_t i = 0; i < scene->material_count; i++)
        cost->materials[i].name = scene->materials[i].name;
    for (uint32_t i = 0; i < cost->plan->light_count; i++)
        cost->lights[i].name = scene->lights[cost->plan->lights[i]].name;
}

void gn_frame_cost_build(struct gn_frame_cost *cost, const struct gn_plan *plan,
                         const struct gn_cost_gpu *gpu, const struct gn_cost_table *table,
                         char (*names)[GN_PROGRAM_NAME], const struct gn_raster_count *counts,
                         enum gn_cost_when *when) {
    *cost = (struct gn_frame_cost){.plan = plan, .gpu = gpu, .names = names, .when = when};
    cost->programs = gn_xalloc(plan->program_count + 1, sizeof *cost->programs);
    cost->known = gn_xalloc(plan->program_count + 1, sizeof *cost->known);
    cost->passes = gn_xalloc(plan->pass_count + 1, sizeof *cost->passes);
    cost->materials = gn_xalloc(plan->scene->material_count + 1, sizeof *cost->materials);
    cost->lights = gn_xalloc(plan->light_count + 1, sizeof *cost->lights);
    find_programs(cost, table);
    name_shares(cost);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        struct gn_pass_cost *out = &cost->passes[i];
        for (uint32_t k = 0; k < pass->draw_count; k++)
            add_draw(cost, pass, &plan->draws[pass->first_draw + k], &counts[pass->first_draw + k],
                     out);
        out->bytes += target_bytes(plan, pass);
        if (pass->kind == GN_PASS_PICTURE && pass->picture.scales) { /* one texel, filtered */
            out->pixels = out->lanes = (uint64_t)area_of(pass);
            out->fetches = (double)out->lanes;
        }
        bound_pass(gpu, out);
        cost->ms[when[i]] += out->ms;
        if (when[i] == GN_COST_EACH_FRAME) share_pass(cost, table, pass, out->ms, counts);
    }
    qsort(cost->materials, plan->scene->material_count, sizeof *cost->materials, compare_shares);
    qsort(cost->lights, plan->light_count, sizeof *cost->lights, compare_shares);
}

void gn_frame_cost_finish(struct gn_frame_cost *cost) {
    free(cost->programs);
    free(cost->known);
    free(cost->passes);
    free(cost->materials);
    free(cost->lights);
    *cost = (struct gn_frame_cost){0};
}
