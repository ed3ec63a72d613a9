/* Bounds how often a frame draws each pixel: a file of a few hundred bytes can put a million
 * surfaces on one another. By an estimate: the area of an instance's triangles at the distance of
 * its nearest point, and at most as often as they lie on one another (gn_geometry.layers). Only
 * where that is over the limit are the triangles of posed meshes looked at, since joints may spread
 * what lies together at rest. Instances over the limit are left out, the farthest first. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"

/* The cost of a pixel, of that of a blended one: most opaque ones fail the depth test, as they are
 * sorted, and a map's have no colour. */
#define COST_OPAQUE 0.25
/* Of many maps each may cost this part of the limit; of a few their equal parts. */
#define LEAST_SHARE 0.25

enum { SAMPLES = 128 }; /* triangles of a posed mesh that are looked at */

struct bounds {
    struct gn_frame *frame;
    const struct gn_pose *pose;
    bool samples; /* of posed meshes, in place of their boxes */
};

static bool is_blended(const struct gn_pass *pass) {
    return pass->kind == GN_PASS_PICTURE && pass->picture.blend != GN_BLEND_OFF;
}

/* Of all pixels of its target, drawn once. The points of a lamp are bounded by gather.c. */
static double cost_of(const struct gn_pass *pass) { return is_blended(pass) ? 1.0 : COST_OPAQUE; }

static bool is_posed(const struct bounds *b, const struct gn_draw *draw) {
    return b->frame->programs.at[draw->program].features & GN_FEATURES_POSED;
}

static uint32_t item_of(const struct gn_instance *posed) {
    uint32_t item;
    memcpy(&item, &posed->world[2][0], sizeof item);
    return item;
}

/* ---- estimates ---- */

/* By how much a length in the world is scaled along this row of clip_from_world, at most. */
static double row_length(const float (*clip)[4], int row) {
    return sqrt((double)clip[0][row] * (double)clip[0][row] +
                (double)clip[1][row] * (double)clip[1][row] +
                (double)clip[2][row] * (double)clip[2][row]);
}

static double row_at(const float (*clip)[4], int row, const float *point) {
    double sum = (double)clip[3][row];
    for (int k = 0; k < 3; k++) sum += (double)clip[k][row] * (double)point[k];
    return sum;
}

/* The most of a geometry's layers along any direction. Posed vertices without area at rest may lie
 * anywhere. */
static double layers_of(const struct bounds *b, const struct gn_draw *draw) {
    const struct gn_geometry *geometry = &b->frame->scene->geometries[draw->geometry];
    const double most =
        (double)fmaxf(fmaxf(geometry->layers[0], geometry->layers[1]), geometry->layers[2]);
    const uint32_t triangles = geometry->index_count / 3;
    return is_posed(b, draw) && most == 0 ? triangles : most;
}

/* Where an instance lies, world space, and the area of its triangles as seen at most: along each
 * axis of its box, or, if it is posed, of a square around that. */
struct place {
    vec3 centre;
    double radius, area;
};

static struct place place_of(const struct bounds *b, const struct gn_draw *draw,
                             const struct gn_instance *instance) {
    const struct gn_geometry *geometry = &b->frame->scene->geometries[draw->geometry];
    struct place place = {{0}, 0, 0};
    vec3 centre, side[3];
    if (is_posed(b, draw)) {
        float *least = b->pose->items[item_of(instance)].box_ws.min,
              *most = b->pose->items[item_of(instance)].box_ws.max;
        glm_vec3_center(least, most, place.centre);
        place.radius = 0.5 * (double)glm_vec3_distance(least, most);
        place.area = 4 * layers_of(b, draw) * place.radius * place.radius;
        return place;
    }
    for (int k = 0; k < 3; k++) centre[k] = 0.5f * (geometry->box.min[k] + geometry->box.max[k]);
    for (int row = 0; row < 3; row++) {
        const float *world = instance->world[row];
        place.centre[row] = glm_vec3_dot((float *)world, centre) + world[3];
        for (int k = 0; k < 3; k++)
            side[k][row] = world[k] * (geometry->box.max[k] - geometry->box.min[k]);
    }
    for (int k = 0; k < 3; k++) {
        vec3 face;
        glm_vec3_cross(side[(k + 1) % 3], side[(k + 2) % 3], face);
        place.area += (double)geometry->layers[k] * (double)glm_vec3_norm(face);
        place.radius += 0.5 * (double)glm_vec3_norm(side[k]);
    }
    return place;
}

/* The part of the target that a triangle covers; all of it, if it passes the eye. */
static double share_of(const float (*clip)[4], vec3 corner[3]) {
    double at[3][2];
    int behind = 0, outside[2][2] = {{0}};
    for (int i = 0; i < 3; i++) {
        const double w = row_at(clip, 3, corner[i]);
        behind += !(w > 0);
        for (int k = 0; k < 2; k++) {
            at[i][k] = row_at(clip, k, corner[i]) / w;
            outside[k][0] += at[i][k] < -1;
            outside[k][1] += at[i][k] > 1;
        }
    }
    if (behind > 0) return behind < 3;
    for (int k = 0; k < 2; k++)
        if (outside[k][0] == 3 || outside[k][1] == 3) return 0;
    const double twice = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                         (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]);
    return fmin(fabs(twice) / 8, 1); /* of a square of side 2 */
}

static double sample_posed(const struct bounds *b, const float (*clip)[4],
                           const struct gn_draw *draw, uint32_t item) {
    const struct gn_scene *scene = b->frame->scene;
    const struct gn_geometry *geometry = &scene->geometries[draw->geometry];
    const uint32_t triangles = geometry->index_count / 3, step = 1 + triangles / SAMPLES;
    double share = 0;
    for (uint32_t first = 0; first < triangles; first += step) {
        /* one of each `step`, at no period: every n-th may have no area */
        const uint32_t rest = triangles - first,
                       t = first + (first * 2654435761u >> 16) % (rest < step ? rest : step);
        const uint32_t *index = scene->buffers.indices + geometry->first_index + 3 * (size_t)t;
        vec3 corner[3];
        for (int k = 0; k < 3; k++) gn_pose_corner(b->pose, item, index[k], corner[k]);
        share += step * share_of(clip, corner);
    }
    return share;
}

/* How many pixels of the target the instance draws, over all that the target has. */
static double estimate(const struct bounds *b, const float (*clip)[4], const struct gn_draw *draw,
                       const struct gn_instance *instance) {
    if (b->samples && is_posed(b, draw)) return sample_posed(b, clip, draw, item_of(instance));
    const struct place place = place_of(b, draw, instance);
    const double layers = layers_of(b, draw),
                 w = row_at(clip, 3, place.centre) - row_length(clip, 3) * place.radius;
    if (!(w > 0)) return layers; /* w: of its nearest point */
    return fmin(layers, place.area * row_length(clip, 0) * row_length(clip, 1) / (4 * w * w));
}

/* ---- bounds ---- */

/* What a pass costs; whole: if each instance covered all of the target, which is quickly known. */
static double sum_of(const struct bounds *b, const struct gn_pass *pass, bool whole) {
    double layers = 0;
    for (uint32_t i = 0; i < pass->draw_count; i++) {
        const struct gn_draw *draw = &b->frame->draws.at[pass->first_draw + i];
        if (draw->geometry == GN_NO_GEOMETRY) continue;
        if (whole) layers += layers_of(b, draw) * draw->instance_count;
        for (uint32_t k = 0; k < draw->instance_count && !whole; k++)
            layers += estimate(b, pass->constants + PASS_CLIP, draw,
                               &b->frame->instances.at[draw->first_instance + k]);
    }
    return layers * cost_of(pass);
}

/* Whether passes of a kind cost more than that. */
static bool are_over(const struct bounds *b, const struct gn_pass *passes, uint32_t count,
                     enum gn_pass_kind kind, double most) {
    bool over = true;
    for (int whole = 1; whole >= 0 && over; whole--) {
        double cost = 0;
        for (uint32_t i = 0; i < count; i++)
            if (passes[i].kind == kind) cost += sum_of(b, &passes[i], whole);
        over = cost > most;
    }
    return over;
}

/* Takes from *left what the draw costs, by its nearest instances; returns how many are over it. */
static uint32_t bound_draw(const struct bounds *b, const struct gn_pass *pass, struct gn_draw *draw,
                           double *left) {
    const bool from_end = is_blended(pass); /* sorted farthest first */
    uint32_t fit = 0;
    if (draw->geometry == GN_NO_GEOMETRY) return 0;
    for (; fit < draw->instance_count; fit++) {
        const uint32_t i = from_end ? draw->instance_count - 1 - fit : fit;
        const double cost =
            cost_of(pass) * estimate(b, pass->constants + PASS_CLIP, draw,
                                     &b->frame->instances.at[draw->first_instance + i]);
        if (!(cost <= *left)) break;
        *left -= cost;
    }
    const uint32_t over = draw->instance_count - fit;
    if (from_end) draw->first_instance += over;
    draw->instance_count = fit;
    return over;
}

/* Returns how many instances of a pass are left out. */
static uint32_t bound_pass(const struct bounds *b, struct gn_pass *pass, double *left) {
    struct gn_draw *draws = b->frame->draws.at + pass->first_draw;
    uint32_t over = 0, kept = 0;
    for (uint32_t k = 0; k < pass->draw_count; k++)
        over += bound_draw(b, pass, &draws[is_blended(pass) ? pass->draw_count - 1 - k : k], left);
    for (uint32_t i = 0; i < pass->draw_count; i++)
        if (draws[i].instance_count > 0) draws[kept++] = draws[i];
    pass->draw_count = kept;
    return over;
}

void gn_frame_bound_overdraw(struct gn_frame *frame, const struct gn_pose *pose, uint64_t most,
                             struct gn_warnings *warnings) {
    const struct bounds b = {frame, pose, false}, sampled = {frame, pose, true};
    const uint32_t count = most > 0 ? frame->passes.count : 0;
    struct gn_pass *passes = frame->passes.at;
    const bool is_over = are_over(&b, passes, count, GN_PASS_PICTURE, (double)most);
    double left = (double)most;
    uint32_t maps = 0, over = 0;
    for (uint32_t i = 0; i < count; i++) maps += passes[i].kind == GN_PASS_MAP;
    for (uint32_t i = 0; i < count; i++) { /* the picture's opaque ones, and each map by itself */
        double of_map = (double)most * fmax(1.0 / maps, LEAST_SHARE);
        if (passes[i].kind == GN_PASS_MAP && are_over(&b, &passes[i], 1, GN_PASS_MAP, of_map))
            over += bound_pass(&sampled, &passes[i], &of_map);
        if (passes[i].kind == GN_PASS_PICTURE && !is_blended(&passes[i]) && is_over)
            over += bound_pass(&sampled, &passes[i], &left);
    }
    for (uint32_t i = is_over ? count : 0; i-- > 0;) /* blended ones: nearest first */
        if (is_blended(&passes[i])) over += bound_pass(&sampled, &passes[i], &left);
    if (over > 0 && gn_frame_notice(&frame->notes.said, GN_NOTICE_OVERDRAW, warnings))
        gn_warn(warnings,
                "%u instances are not drawn: with them each pixel is drawn more often than the "
                "limit overdraw=%llu",
                over, (unsigned long long)most);
}
