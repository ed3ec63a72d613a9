#include "scene/property.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#define FLOATS(record, field) (offsetof(struct gn_##record##_record, field) / sizeof(float))
#define COUNT(rows)           (sizeof(rows) / sizeof *(rows))
#define UV_MOST               1e6f /* of offset, scale and rotation of a texture that clips move */

static const struct gn_property properties[] = {
#define GN_X(THING, path, record, field, components, least, most)                                  \
    {GN_THING_##THING, path, FLOATS(record, field), components, 0, 0, least, most},
    GN_PROPERTIES(GN_X)
#undef GN_X
};

const struct gn_property gn_material_properties[] = {
#define GN_X(path, field, components, MOVES, ...)                                                  \
    {GN_THING_MATERIAL, path, FLOATS(material, field), components, GN_MOVES_##MOVES, __VA_ARGS__},
    GN_MATERIAL_PROPERTIES(GN_X)
#undef GN_X
#define GN_X(LAYER, NAME, components, path, ...)                                                   \
    {GN_THING_MATERIAL, path,       FLOATS(material, factors) + GN_FACTOR_##NAME, components,      \
     GN_MOVES_##LAYER,  __VA_ARGS__},
        GN_LAYERS(GN_LEAVE_OUT, GN_X, GN_LEAVE_OUT)
#undef GN_X
};
const size_t gn_material_property_count = COUNT(gn_material_properties);

static float clamp(float x, float least, float most) { return fminf(fmaxf(x, least), most); }

/* ---- finding ---- */

/* The rest of the pointer behind a path, whose dots are slashes; NULL: it has another one, or there
 * is none. */
static const char *behind(const char *pointer, const char *path) {
    if (!pointer || *pointer++ != '/') return NULL;
    for (; *path; path++, pointer++)
        if (*pointer != (*path == '.' ? '/' : *path)) return NULL;
    return pointer;
}

static bool find_property(const struct gn_property *rows, size_t count, enum gn_thing thing,
                          const char *pointer, struct gn_property *out) {
    for (size_t i = 0; i < count; i++) {
        const char *end = rows[i].thing == thing ? behind(pointer, rows[i].path) : NULL;
        if (!end || *end) continue;
        *out = rows[i];
        return true;
    }
    return false;
}

bool gn_property_find(enum gn_thing thing, const char *pointer, struct gn_property *out) {
    static const struct gn_property transform[] = {
#define GN_X(path, field, components)                                                              \
    {GN_THING_MATERIAL, path,   FLOATS(material, uv[0].field), components, GN_MOVES_UV, 0,         \
     -UV_MOST,          UV_MOST}
        GN_X("offset", offset, 2), GN_X("scale", scale, 2), GN_X("rotation", rotation_rad, 1)};
#undef GN_X
    if (find_property(properties, COUNT(properties), thing, pointer, out) ||
        find_property(gn_material_properties, gn_material_property_count, thing, pointer, out))
        return true;
    for (uint32_t slot = 0; thing == GN_THING_MATERIAL && slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        const char *rest = behind(behind(pointer, gn_texture_slots[slot].path),
                                  "extensions.KHR_texture_transform");
        if (!find_property(transform, COUNT(transform), thing, rest, out)) continue;
        out->first += slot * (sizeof(struct gn_uv_record) / sizeof(float));
        return true;
    }
    return false;
}

uint32_t gn_record_size(enum gn_thing thing) {
    static const size_t sizes[] = {[GN_THING_LIGHT] = sizeof(struct gn_light_record),
                                   [GN_THING_CAMERA] = sizeof(struct gn_camera_record),
                                   [GN_THING_MATERIAL] = sizeof(struct gn_material_record),
                                   [GN_THING_NODE] = sizeof(struct gn_node_record)};
    return (uint32_t)(sizes[thing] / sizeof(float));
}

/* ---- making ---- */

/* A cubic may swing beyond its keys, so all are clamped at each time. */
void gn_light_make(const struct gn_light_record *r, struct gn_light *light) {
    for (int k = 0; k < 3; k++)
        light->color[k] = fminf(fmaxf(r->color[k], 0) * fmaxf(r->intensity, 0), 1e18f);
    if (light->range_moves) light->range_m = clamp(r->range_m, 1e-6f, 1e18f);
    if (!gn_light_types[light->type].has_cone) return;
    light->outer_rad = clamp(r->outer_rad, 1e-3f, GLM_PI_2f);
    light->inner_rad = fmaxf(r->inner_rad, 0);
    if (light->inner_rad >= light->outer_rad) light->inner_rad = .99f * light->outer_rad;
}

void gn_camera_make(const struct gn_camera_record *r, struct gn_camera *camera) {
    camera->near_m = clamp(r->near_m, camera->orthographic ? 0 : 1e-6f, 1e15f);
    camera->far_m = 0; /* infinite */
    if (r->far_m != 0) camera->far_m = fmaxf(r->far_m, camera->near_m * 1.001f + 1e-6f);
    if (camera->orthographic) {
        camera->xmag_m = clamp(fabsf(r->xmag_m), 1e-6f, 1e15f);
        camera->ymag_m = clamp(fabsf(r->ymag_m), 1e-6f, 1e15f);
    } else {
        camera->yfov_rad = clamp(r->yfov_rad, 1.1e-3f, 3.14f);
        if (r->aspect != 0) camera->aspect = clamp(r->aspect, 1e-3f, 1e3f);
    }
}

void gn_material_record_init(struct gn_material_record *record) {
    *record = (struct gn_material_record){.tint = {1, 1, 1}};
    for (size_t i = 0; i < gn_material_property_count; i++)
        for (uint32_t k = 0; k < gn_material_properties[i].components; k++)
            ((float *)record)[gn_material_properties[i].first + k] =
                gn_material_properties[i].fallback;
}

/* An affine map; the rotation is clockwise, since v points down. */
void gn_uv_make(const struct gn_uv_record *r, float m[6]) {
    const float c = cosf(r->rotation_rad), s = sinf(r->rotation_rad);
    m[0] = c * r->scale[0];
    m[1] = -s * r->scale[0];
    m[2] = s * r->scale[1];
    m[3] = c * r->scale[1];
    memcpy(m + 4, r->offset, sizeof r->offset);
    for (int i = 0; i < 6; i++) m[i] += 0; /* no -0: transforms are compared as bytes */
}

static float f0_of_ior(float ior) {
    const float r = (ior - 1) / (ior + 1);
    return fabsf(ior - 1.5f) < 1e-6f ? GN_F0 : r * r; /* 0 stands for a mirror: 1 */
}

static struct gn_material_record clamped(const struct gn_material_record *record) {
    struct gn_material_record r = *record;
    for (size_t i = 0; i < gn_material_property_count; i++) {
        const struct gn_property *p = &gn_material_properties[i];
        float *x = (float *)&r + p->first;
        for (uint32_t k = 0; k < p->components; k++) x[k] = clamp(x[k], p->least, p->most);
    }
    for (float *uv = (float *)r.uv; uv < (float *)(&r.uv + 1); uv++)
        *uv = clamp(*uv, -UV_MOST, UV_MOST);
    return r;
}

void gn_material_make(const struct gn_material_record *record, uint32_t moves,
                      struct gn_material *m) {
    const struct gn_material_record r = clamped(record);
    if (moves & GN_MOVES_METAL) m->metalness = r.metalness;
    if (moves & GN_MOVES_ROUGH) m->roughness = r.roughness;
    if (moves & GN_MOVES_CUTOFF) m->alpha_cutoff = r.alpha_cutoff;
    if (moves & GN_MOVES_NORMAL) m->normal_scale = r.normal_scale;
    if (moves & GN_MOVES_OCCLUSION) m->occlusion_strength = r.occlusion_strength;
    for (int k = 0; k < GN_LAYER_COUNT; k++)
        for (int i = gn_layers[k].first;
             moves >> k & GN_MOVES_FIRST_LAYER && i < gn_layers[k + 1].first; i++)
            m->factors[i] = r.factors[i];
    for (int k = 0; k < 3; k++) {
        if (moves & GN_MOVES_EMISSIVE)
            m->emissive[k] = fminf(r.emissive[k] * r.emissive_strength, 1e9f);
        if (moves & GN_MOVES_F0)
            m->f0[k] = fminf(f0_of_ior(r.ior) * r.specular_color[k], 1) * r.specular;
        if (moves & (GN_MOVES_BASE | GN_MOVES_TRANSMISSION))
            m->base_color[k] =
                r.base_color[k] * glm_lerp(1, r.tint[k], m->factors[GN_FACTOR_TRANSMISSION]);
    }
    if (moves & GN_MOVES_BASE) m->base_color[3] = fminf(r.base_color[3], 1);
    for (int slot = 0; moves & GN_MOVES_UV && slot < GN_TEXTURE_SLOT_COUNT; slot++)
        gn_uv_make(&r.uv[slot], m->textures[slot].uv_from_uv);
}
