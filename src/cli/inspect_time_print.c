#include <math.h>

#include "cli/inspect_time.h"
#include "cli/units.h"
#include "core/json.h"
#include "core/text.h"

enum { DEAREST = 5 }; /* that are printed */

static const char *const when_names[GN_COST_WHEN_COUNT] = {"each frame", "camera moves", "kept"};
static const char *const limit_names[GN_COST_LIMITS] = {"instructions", "fetches", "bytes"};

static bool is_used(const struct gn_frame_cost *cost, uint32_t program) {
    for (uint32_t i = 0; i < cost->plan->draw_count; i++)
        if (cost->plan->draws[i].program == program) return true;
    return false;
}

static double all_ms(const struct gn_frame_cost *cost) {
    return cost->ms[GN_COST_EACH_FRAME] + cost->ms[GN_COST_CAMERA_MOVES] + cost->ms[GN_COST_KEPT];
}

/* ---- for people ---- */

static double of_each(double amount, uint64_t count) {
    return count > 0 ? amount / (double)count : 0;
}

static void print_passes(const struct gn_frame_cost *cost, FILE *to) {
    gn_text_print_line(to, "%-28s %-12s %5s %9s %9s %10s %10s %6s %7s %7s %7s  %s", "pass", "drawn",
                       "draws", "triangles", "vertices", "pixels", "lanes", "instr.", "fetches",
                       "MB", "ms", "limit");
    for (uint32_t i = 0; i < cost->plan->pass_count; i++) {
        const struct gn_pass_cost *p = &cost->passes[i];
        if (p->ms <= 0) continue;
        gn_text_print_line(
            to, "%-28.28s %-12s %5llu %9llu %9llu %10llu %10llu %6.0f %7.1f %7.2f %7.2f  %s",
            cost->plan->passes[i].label, when_names[cost->when[i]], (unsigned long long)p->draws,
            (unsigned long long)p->triangles, (unsigned long long)p->vertices,
            (unsigned long long)p->pixels, (unsigned long long)p->lanes,
            of_each(p->instructions, p->lanes), of_each(p->fetches, p->lanes), GN_MB(p->bytes),
            p->ms, p->vertex_ms > 0.5 * p->ms ? "vertices" : limit_names[p->limit]);
    }
}

static void print_programs(const struct gn_frame_cost *cost, FILE *to) {
    gn_text_print_line(to,
                       "programs: instructions and fetches of a lane, instructions of a vertex");
    for (uint32_t i = 0; i < cost->plan->program_count; i++) {
        const struct gn_program_cost *p = &cost->programs[i];
        if (!is_used(cost, i)) continue;
        if (!cost->known[i])
            gn_text_print_line(to, "  not known              %s", cost->names[i]);
        else
            gn_text_print_line(to, "  %5.0f %5.1f %5.0f  %s%s", p->fragment, p->fetches, p->vertex,
                               p->estimated           ? "(estimated) "
                               : p->fetches_estimated ? "(fetches estimated) "
                                                      : "",
                               cost->names[i]);
        if (cost->known[i] && p->estimated)
            gn_text_print_line(to, "                       from %s", p->nearest);
    }
}

static void print_shares(const char *title, const struct gn_cost_share *shares, uint32_t count,
                         FILE *to) {
    for (uint32_t i = 0; i < count && i < DEAREST && shares[i].ms > 0; i++)
        gn_text_print_line(to, "%-11s %7.2f ms  %s", i == 0 ? title : "", shares[i].ms,
                           shares[i].name);
}

void gn_inspect_time_print(const struct gn_inspect_time *time, FILE *to) {
    const struct gn_frame_cost *cost = &time->frame.cost;
    const struct gn_plan *plan = cost->plan;
    const double each = cost->ms[GN_COST_EACH_FRAME], moves = cost->ms[GN_COST_CAMERA_MOVES];
    fprintf(to, "\nTime on %s at %ux%u with %u samples, at least\n", cost->gpu->what,
            plan->width_px, plan->height_px, plan->msaa);
    print_passes(cost, to);
    print_programs(cost, to);
    print_shares("materials", cost->materials, plan->scene->material_count, to);
    print_shares("lights", cost->lights, plan->light_count, to);
    gn_text_print_line(to, "%-11s %7.2f ms  at most %.0f frames a second", "each frame", each,
                       1000 / fmax(each, 1e-3));
    if (moves > 0)
        gn_text_print_line(to,
                           "%-11s %7.2f ms  at most %.0f frames a second while the camera moves",
                           "", each + moves, 1000 / fmax(each + moves, 1e-3));
    gn_text_print_line(
        to, "%-11s %7.2f ms  where all is drawn: the first picture, or light and casters move", "",
        all_ms(cost));
    gn_text_print_line(to, "%-11s %s: %g G instructions, %g G fetches, %g GB a second", "model",
                       cost->gpu->source, cost->gpu->instructions_g, cost->gpu->fetches_g,
                       cost->gpu->bytes_g);
    if (cost->gpu->error > 0)
        gn_text_print_line(to,
                           "%-11s %.0f %% off in fetches by a public measurement; the rest is not",
                           "calibrated", 100 * cost->gpu->error);
    else
        gn_text_print_line(to, "%-11s no: there is no public measurement of it", "calibrated");
    gn_text_print_line(to, "%-11s %s", "to change", time->advice);
}

/* ---- for programs -------------------------------------------------------------------------- */

static json_t *pass_json(const struct gn_frame_cost *cost, uint32_t i) {
    const struct gn_pass_cost *p = &cost->passes[i];
    return json_pack("{so ss so so so so so so so so so so so so so so ss}", "label",
                     gn_json_make_text(cost->plan->passes[i].label), "drawn",
                     when_names[cost->when[i]], "draws", gn_json_make_count(p->draws), "triangles",
                     gn_json_make_count(p->triangles), "vertices", gn_json_make_count(p->vertices),
                     "pixels", gn_json_make_count(p->pixels), "lanes", gn_json_make_count(p->lanes),
                     "instructions", gn_json_make_number(p->instructions), "fetches",
                     gn_json_make_number(p->fetches), "bytes", gn_json_make_number(p->bytes),
                     "vertex_instructions", gn_json_make_number(p->vertex_instructions),
                     "instructions_ms", gn_json_make_number(p->limit_ms[GN_COST_INSTRUCTIONS]),
                     "fetches_ms", gn_json_make_number(p->limit_ms[GN_COST_FETCHES]), "bytes_ms",
                     gn_json_make_number(p->limit_ms[GN_COST_BYTES]), "vertices_ms",
                     gn_json_make_number(p->vertex_ms), "ms", gn_json_make_number(p->ms), "limit",
                     limit_names[p->limit]);
}

static json_t *program_json(const struct gn_frame_cost *cost, uint32_t i) {
    const struct gn_program_cost *p = &cost->programs[i];
    return json_pack("{so so so so sb sb so}", "name", gn_json_make_text(cost->names[i]),
                     "instructions", gn_json_make_number(p->fragment), "vertex_instructions",
                     gn_json_make_number(p->vertex), "fetches", gn_json_make_number(p->fetches),
                     "estimated", p->estimated, "fetches_estimated", p->fetches_estimated,
                     "nearest", gn_json_make_text(p->nearest));
}

static json_t *shares_json(const struct gn_cost_share *shares, uint32_t count) {
    json_t *all = json_array();
    for (uint32_t i = 0; i < count && shares[i].ms > 0; i++)
        json_array_append_new(all, json_pack("{so so}", "name", gn_json_make_text(shares[i].name),
                                             "ms", gn_json_make_number(shares[i].ms)));
    return all;
}

json_t *gn_inspect_time_json(const struct gn_inspect_time *time) {
    const struct gn_frame_cost *cost = &time->frame.cost;
    const struct gn_plan *plan = cost->plan;
    const double each = cost->ms[GN_COST_EACH_FRAME];
    json_t *passes = json_array(), *programs = json_array();
    for (uint32_t i = 0; i < plan->pass_count; i++)
        json_array_append_new(passes, pass_json(cost, i));
    for (uint32_t i = 0; i < plan->program_count; i++)
        if (is_used(cost, i)) json_array_append_new(programs, program_json(cost, i));
    return json_pack(
        "{ss ss ss so so so so so so so so so so so so so}", "gpu", cost->gpu->name, "board",
        cost->gpu->what, "source", cost->gpu->source, "error",
        cost->gpu->error > 0 ? gn_json_make_number(cost->gpu->error) : json_null(), "width_px",
        gn_json_make_count(plan->width_px), "height_px", gn_json_make_count(plan->height_px),
        "msaa", gn_json_make_count(plan->msaa), "each_frame_ms", gn_json_make_number(each),
        "camera_moves_ms", gn_json_make_number(each + cost->ms[GN_COST_CAMERA_MOVES]), "all_ms",
        gn_json_make_number(all_ms(cost)), "frames_per_second",
        gn_json_make_number(1000 / fmax(each, 1e-3)), "passes", passes, "programs", programs,
        "materials", shares_json(cost->materials, plan->scene->material_count), "lights",
        shares_json(cost->lights, plan->light_count), "advice", gn_json_make_text(time->advice));
}
