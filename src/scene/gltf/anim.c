/* Reads animations as clips. A channel that cannot be played is dropped with a warning; clips keep
 * their numbers. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct sampler {
    const struct gn_accessor *input, *output;
    int32_t input_index;
    enum gn_anim_interpolation interpolation;
};

/* ---- samplers ---- */

static bool read_sampler(struct gn_gltf *g, const struct gn_at *at, struct sampler *sampler) {
    static const char *const names[] = {
        [GN_ANIM_LINEAR] = "LINEAR", [GN_ANIM_STEP] = "STEP", [GN_ANIM_CUBIC] = "CUBICSPLINE"};
    int32_t output = gn_at_ref(g, at, "output", g->file.accessor_count, "accessors");
    sampler->input_index = gn_at_ref(g, at, "input", g->file.accessor_count, "accessors");
    const char *name = gn_at_text(g, at, "interpolation");
    int word = gn_json_word(gn_at_any(at, "interpolation").json, names, 3);
    if (word >= 0)
        sampler->interpolation = (enum gn_anim_interpolation)word;
    else if (name)
        gn_gltf_warn(g, at, "interpolation '%.20s' is unknown; taken as LINEAR", name);
    sampler->input = gn_gltf_accessor(g, sampler->input_index);
    sampler->output = gn_gltf_accessor(g, output);
    if (g->failed) return false;
    if (!sampler->input || !sampler->output) return gn_gltf_fail(g, at, "needs input and output");
    return true;
}

/* Into the scene's memory. NULL: some are not finite, or the load failed. */
static const float *read_values(struct gn_gltf *g, const struct gn_accessor *a, bool rotates) {
    const size_t components = a->components;
    float *values =
        gn_gltf_alloc(g, g->memory.scene, (uint64_t)a->count * components, sizeof *values);
    if (!values) return NULL;
    struct gn_accessor copy = *a;
    if (rotates) copy.normalized = true; /* integers are always normalised */
    gn_accessor_floats(&copy, components, values);
    for (size_t i = 0; i < a->count * components; i++)
        if (!(fabsf(values[i]) < 1e18f)) return NULL;
    return values;
}

/* Times as floats, ascending, from before 0 where an exporter has them so; read once for all
 * channels that share them. NULL: invalid, or failed. */
static const float *read_times(struct gn_gltf *g, const struct sampler *sampler) {
    const struct gn_accessor *a = sampler->input;
    if (a->components != 1) return NULL;
    if (g->file.key_times[sampler->input_index]) return g->file.key_times[sampler->input_index];
    const float *times = read_values(g, a, false);
    if (!times) return NULL;
    for (size_t i = 0; i < a->count; i++)
        if (!(times[i] >= (i > 0 ? times[i - 1] : -1e9f) && times[i] <= 1e9f)) return NULL;
    g->file.key_times[sampler->input_index] = times;
    return times;
}

/* ---- channels ---- */

static const char *const path_names[] = {[GN_ANIM_TRANSLATION] = "translation",
                                         [GN_ANIM_ROTATION] = "rotation",
                                         [GN_ANIM_SCALE] = "scale",
                                         [GN_ANIM_WEIGHTS] = "weights"};

/* What a channel moves. */
struct target {
    int32_t node; /* of the scene; -1: none */
    enum gn_anim_path path;
    const char *pointer; /* of RECORD */
    struct gn_property property;
    uint32_t record; /* as in gn_channel */
};

static void read_property(struct gn_gltf *g, const struct gn_at *target, const char *pointer,
                          struct target *out) {
    uint32_t index;
    if (gn_gltf_find_property(g, pointer, &out->property, &index)) {
        out->pointer = pointer;
        out->path = GN_ANIM_RECORD;
        out->record = g->to_scene.record[out->property.thing][index] - 1 + out->property.first;
        out->node = out->property.thing == GN_THING_NODE ? g->to_scene.node[index] : 0;
    } else if (!g->failed) {
        g->is_missing[GN_MISSING_POINTERS] = true;
        gn_gltf_warn(g, target, "animation of '%.100s' is not supported; not played",
                     pointer ? pointer : "");
    }
}

/* KHR_animation_pointer: "/nodes/3/rotation" is a plain channel; others are properties, or named by
 * a warning. */
static void read_pointer(struct gn_gltf *g, const struct gn_at *target, struct target *out) {
    static const char nodes[] = "/nodes/";
    const char *pointer = gn_at_text(g, target, "extensions.KHR_animation_pointer.pointer");
    if (g->failed) return;
    const bool of_node = pointer && strncmp(pointer, nodes, sizeof nodes - 1) == 0;
    const char *digits = of_node ? pointer + sizeof nodes - 1 : "";
    const size_t length = strspn(digits, "0123456789");
    for (size_t i = 0; length > 0 && length < 10 && i < 4; i++)
        if (digits[length] == '/' && strcmp(digits + length + 1, path_names[i]) == 0) {
            const unsigned long node = strtoul(digits, NULL, 10);
            out->path = (enum gn_anim_path)i;
            if (node >= g->file.node_count) continue;
            out->node = g->to_scene.node[node];
            return;
        }
    read_property(g, target, pointer, out);
}

/* False: it moves nothing of the scene, or what is not supported. */
static bool read_target(struct gn_gltf *g, const struct gn_at *at, struct target *out) {
    struct gn_at target = gn_at_object(g, at, "target");
    int32_t node = gn_at_ref(g, &target, "node", g->file.node_count, "nodes");
    const char *name = gn_at_text(g, &target, "path");
    *out = (struct target){.node = -1};
    if (g->failed || !name) return false;
    int word = gn_json_word(gn_at_any(&target, "path").json, path_names, 4);
    if (word >= 0) {
        out->path = (enum gn_anim_path)word;
        out->node = node < 0 ? -1 : g->to_scene.node[node];
    } else if (strcmp(name, "pointer") == 0)
        read_pointer(g, &target, out);
    else
        gn_gltf_warn(g, &target, "path '%.20s' is unknown; ignored", name);
    return out->node >= 0 && !g->failed;
}

/* Decomposes a matrix, which cannot be animated, into translation, rotation and scale. */
static void use_trs(struct gn_node *node) {
    if (!node->has_matrix) return;
    node->has_matrix = false;
    glm_vec3_copy(node->matrix[3], node->translation);
    mat3 axes;
    glm_mat4_pick3(node->matrix, axes);
    for (int k = 0; k < 3; k++) {
        node->scale[k] = glm_vec3_norm(axes[k]);
        if (node->scale[k] > 0) glm_vec3_scale(axes[k], 1 / node->scale[k], axes[k]);
    }
    if (glm_mat3_det(axes) < 0) {
        node->scale[0] = -node->scale[0];
        glm_vec3_negate(axes[0]);
    }
    if (node->scale[0] != 0 && node->scale[1] != 0 && node->scale[2] != 0)
        glm_mat3_quat(axes, node->rotation);
    glm_quat_normalize(node->rotation);
}

/* Says where numbers of a property will be clamped. A flag has no values between. */
static void check_property(struct gn_gltf *g, const struct gn_at *at, const struct target *target,
                           struct gn_channel *channel) {
    const struct gn_property *p = &target->property;
    const uint32_t count = channel->components * channel->key_count;
    bool outside = false;
    channel->record = target->record;
    channel->pointer = gn_gltf_strdup(g, target->pointer);
    if (p->thing == GN_THING_NODE) channel->interpolation = GN_ANIM_STEP;
    for (uint32_t i = 0; i < count && channel->interpolation != GN_ANIM_CUBIC; i++)
        outside |= channel->values[i] < p->least - 1e-3f || channel->values[i] > p->most * 1.0001f;
    if (outside)
        gn_gltf_warn(g, at, "values of '%.100s' outside %g to %g; clamped", target->pointer,
                     (double)p->least, (double)p->most);
}

/* Floats of a value. */
static uint32_t count_components(const struct gn_gltf *g, const struct target *target,
                                 int32_t morph) {
    if (target->path == GN_ANIM_RECORD) return target->property.components;
    if (target->path == GN_ANIM_WEIGHTS) return g->scene->deformation.morphs[morph].weight_count;
    return target->path == GN_ANIM_ROTATION ? 4 : 3;
}

static bool read_channel(struct gn_gltf *g, const struct gn_at *at, const struct gn_at *samplers,
                         struct gn_channel *channel) {
    struct target target;
    const bool found = read_target(g, at, &target);
    int32_t index = gn_at_ref(g, at, "sampler", gn_at_size(samplers), "samplers");
    struct sampler sampler = {0};
    if (g->failed || !found) return false;
    channel->path = target.path;
    struct gn_at place = gn_at_any(at, "sampler");
    if (index < 0) return gn_gltf_fail(g, &place, "missing");
    struct gn_at sampler_at = gn_at_item(g, samplers, (size_t)index);
    if (g->failed || !read_sampler(g, &sampler_at, &sampler)) return false;
    const bool of_weights = channel->path == GN_ANIM_WEIGHTS;
    channel->morph = of_weights ? g->placed[target.node].morph : -1;
    if (of_weights && channel->morph < 0) return false; /* its mesh has no targets */
    channel->components = count_components(g, &target, channel->morph);
    const bool of_record = channel->path == GN_ANIM_RECORD;
    const size_t elements = of_weights ? channel->components : 1; /* of a value */
    const size_t per_key = elements * (sampler.interpolation == GN_ANIM_CUBIC ? 3 : 1);
    bool fits = sampler.output->components * elements == channel->components &&
                sampler.output->count % per_key == 0 &&
                sampler.output->count / per_key == sampler.input->count &&
                !(of_record && target.property.thing == GN_THING_NODE && per_key == 3);
    g->key_total += fits ? sampler.output->count : 0;
    if (g->key_total > g->limits.keys) {
        gn_gltf_fail(g, at, "more animation keys than the limit keys=%" PRIu64, g->limits.keys);
        g->failed_part = false;
        return false;
    }
    channel->node = (uint32_t)target.node;
    channel->interpolation = sampler.interpolation;
    channel->key_count = (uint32_t)sampler.input->count;
    channel->times_s = fits ? read_times(g, &sampler) : NULL;
    channel->values =
        channel->times_s ? read_values(g, sampler.output, channel->path == GN_ANIM_ROTATION) : NULL;
    if (g->failed) return false;
    if (!channel->values) {
        gn_gltf_warn(g, &sampler_at, "%s; channel not played",
                     !fits               ? "input and output do not fit each other"
                     : !channel->times_s ? "times must ascend"
                                         : "values that are not finite");
        return false;
    }
    if (of_record)
        check_property(g, &sampler_at, &target, channel);
    else if (!of_weights)
        use_trs(&g->scene->nodes[target.node]);
    return true;
}

/* ---- clips ---- */

/* What earlier clips move: per node a bit for each path; per number of a record. */
struct claims {
    uint8_t *nodes;
    bool *records;
};

static bool is_claimed(const struct claims *claims, const struct gn_channel *channel) {
    if (channel->path == GN_ANIM_RECORD) return claims->records[channel->record];
    return claims->nodes[channel->node] & 1U << channel->path;
}

static void claim(struct claims *claims, const struct gn_channel *channel) {
    if (channel->path == GN_ANIM_RECORD)
        claims->records[channel->record] = true;
    else
        claims->nodes[channel->node] |= (uint8_t)(1U << channel->path);
}

bool gn_gltf_animations(struct gn_gltf *g) {
    struct gn_scene_animation *animation = &g->scene->animation;
    struct gn_at root = gn_at_root(g), array = gn_at_array(g, &root, "animations");
    size_t count = gn_at_size(&array), channel_count = 0;
    for (size_t i = 0; i < count && !g->failed; i++) {
        struct gn_at at = gn_at_element(&array, i), list = gn_at_array(g, &at, "channels");
        gn_gltf_spare(g, "not played");
        channel_count += gn_at_size(&list);
    }
    GN_NEW(g, g->memory.scene, animation->clips, count);
    GN_NEW(g, g->memory.scene, animation->channels, channel_count);
    struct claims claims = {gn_gltf_alloc(g, &g->memory.load, g->scene->node_count, 1),
                            gn_gltf_alloc(g, &g->memory.load, animation->record_floats, 1)};
    for (size_t i = 0; i < count && !g->failed; i++) {
        struct gn_at at = gn_at_element(&array, i);
        struct gn_clip *clip = &animation->clips[animation->clip_count++];
        struct gn_at samplers = gn_at_array(g, &at, "samplers"), list = gn_at_any(&at, "channels");
        float last_s = 0;
        gn_gltf_spare(g, "not played");
        clip->name = gn_gltf_strdup(g, gn_at_name(g, &at));
        gn_gltf_check_time(g);
        clip->first_channel = animation->channel_count;
        clip->on_by_default = true;
        for (size_t k = 0; k < gn_at_size(&list) && !g->failed; k++) {
            struct gn_at channel_at = gn_at_item(g, &list, k);
            struct gn_channel *channel = &animation->channels[animation->channel_count];
            const bool read = !g->failed && read_channel(g, &channel_at, &samplers, channel);
            if (gn_gltf_spare(g, "not played") || !read) continue;
            const float *times_s = channel->times_s;
            if (times_s) last_s = fmaxf(last_s, times_s[channel->key_count - 1]);
            if (is_claimed(&claims, channel)) clip->on_by_default = false;
            animation->channel_count++;
        }
        clip->channel_count = animation->channel_count - clip->first_channel;
        clip->duration_ns = llround((double)last_s * 1e9);
        for (uint32_t k = clip->first_channel; k < animation->channel_count; k++)
            claim(&claims, &animation->channels[k]);
    }
    return !g->failed;
}
