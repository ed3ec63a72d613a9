#include "scene/material.h"

#include "scene/scene.h"

const struct gn_texture_slot_row gn_texture_slots[GN_TEXTURE_SLOT_COUNT] = {
#define GN_X(NAME, name, printed, path, texels, shading)                                           \
    [GN_TEXTURE_##NAME] = {#NAME, #name, path, GN_TEXELS_##texels, GN_SHADING_##shading},
    GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
};

float gn_material_least_alpha(const struct gn_material *m) {
    return m->alpha_cutoff > 1.0f ? m->alpha_cutoff : m->alpha_cutoff - 0.5f / 255.0f;
}

const struct gn_layer_row gn_layers[GN_LAYER_COUNT + 1] = {
#define GN_X(NAME, name, amount, reflects) {GN_FACTORS_OF_##NAME, amount, reflects},
    GN_LAYERS(GN_X, GN_LEAVE_OUT, GN_LEAVE_OUT)
#undef GN_X
        {GN_FACTORS_SIZE, 0, false},
};

bool gn_material_is_metal(const struct gn_material *m) {
    return m->metalness > 0.0f || m->moves & GN_MOVES_METAL;
}

bool gn_material_has_opaque_texels(const struct gn_material *m) {
    if (gn_material_is_transmissive(m))
        return m->alpha == GN_ALPHA_OPAQUE && m->textures[GN_TEXTURE_TRANSMISSION].texture >= 0;
    return m->alpha == GN_ALPHA_BLEND && !m->shadow_catcher &&
           (m->base_color[3] >= GN_OPAQUE_ALPHA || m->moves & GN_MOVES_BASE);
}

bool gn_material_has(const struct gn_material *m, enum gn_layer layer) {
    const struct gn_layer_row *row = &gn_layers[layer];
    bool has = m->moves >> layer & GN_MOVES_FIRST_LAYER;
    for (int i = 0; i < row->amount; i++) has |= m->factors[row->first + i] > 0.0f;
    return has;
}

/* Any layer; of those that reflect, or of all. */
static bool has_layers(const struct gn_material *m, bool all) {
    bool has = false;
    for (int i = 0; i < GN_LAYER_COUNT; i++)
        has |= (all || gn_layers[i].reflects) && gn_material_has(m, i);
    return has;
}

bool gn_material_is_transmissive(const struct gn_material *m) {
    return gn_material_has(m, GN_LAYER_TRANSMISSION);
}

bool gn_material_is_blended(const struct gn_material *m) {
    return m->alpha == GN_ALPHA_BLEND || gn_material_is_transmissive(m);
}

bool gn_material_is_clear(const struct gn_material *m) {
    return m->alpha == GN_ALPHA_BLEND ||
           (m->factors[GN_FACTOR_TRANSMISSION] > 0.5f && !(m->moves & GN_MOVES_TRANSMISSION) &&
            m->textures[GN_TEXTURE_TRANSMISSION].texture < 0);
}

bool gn_material_is_tinted(const struct gn_material *m) {
    return gn_material_is_transmissive(m) &&
           (m->textures[GN_TEXTURE_BASE].texture >= 0 || m->moves & GN_MOVES_BASE ||
            m->base_color[0] != m->base_color[1] || m->base_color[1] != m->base_color[2]);
}

bool gn_material_needs_reflections(const struct gn_material *m) {
    return !m->unlit && (gn_material_is_metal(m) || has_layers(m, false));
}

bool gn_material_has_f0(const struct gn_material *m) {
    return m->moves & GN_MOVES_F0 || m->f0[0] != GN_F0 || m->f0[1] != GN_F0 || m->f0[2] != GN_F0;
}

bool gn_material_is_specular(const struct gn_material *m) {
    if (gn_material_is_metal(m) || has_layers(m, true) || m->moves & GN_MOVES_F0) return true;
    if (m->f0[0] == 0 && m->f0[1] == 0 && m->f0[2] == 0) return false;
    return m->roughness < 1.0f || m->moves & GN_MOVES_ROUGH ||
           m->textures[GN_TEXTURE_ROUGHNESS].texture >= 0;
}

bool gn_material_is_emissive(const struct gn_material *m) {
    return m->moves & GN_MOVES_EMISSIVE || m->emissive[0] > 0.0f || m->emissive[1] > 0.0f ||
           m->emissive[2] > 0.0f;
}

bool gn_material_reads(const struct gn_material *m, enum gn_texture_slot slot) {
    const enum gn_shading shading = gn_texture_slots[slot].shading;
    switch (shading) {
    case GN_SHADING_COLOR: return true;
    case GN_SHADING_SPECULAR: return !m->unlit && gn_material_is_specular(m);
    case GN_SHADING_EMISSION: return !m->unlit && gn_material_is_emissive(m);
    case GN_SHADING_LIGHT:
    case GN_SHADING_AMBIENT: return !m->unlit;
    default: return gn_material_has(m, shading - GN_SHADING_LAYERS);
    }
}
