/* From a program key to the source of a shader. Key bits become `const bool`, used with plain `if`;
 * a WITH_ macro stands beside each that is set, for declarations. Every technique defines the same
 * function, but for one argument more where it reads two maps (add_filtered()), and so does every
 * encoding: the names that a file lists in its `//@ names` line get a suffix by macro while the
 * file is read, so that a program can have several. No GL. */
#include <stdio.h>
#include <string.h>

#include "gl/private.h"

static const char *const aov_names[GN_AOV_COUNT] = {
    [GN_AOV_COLOR] = "AOV_COLOR",         [GN_AOV_VISIBILITY] = "AOV_VISIBILITY",
    [GN_AOV_DISTANCE] = "AOV_DISTANCE",   [GN_AOV_NORMAL] = "AOV_NORMAL",
    [GN_AOV_OCCLUSION] = "AOV_OCCLUSION",
};
static const char *const taps_names[] = {
    [GN_TAPS_DISK] = "DISK", [GN_TAPS_POISSON] = "POISSON", [GN_TAPS_RINGS] = "RINGS"};

static bool compares_in_sampler(const struct gn_program_light *light) {
    return !gn_technique_replaces_map((enum gn_technique)light->technique) &&
           light->encoding == GN_ENCODING_DEPTH && !gn_techniques[light->technique].searches;
}

static bool reads_taps_file(const struct gn_technique_row *technique) {
    return technique->taps == GN_TAPS_DISK || technique->taps == GN_TAPS_POISSON;
}

static void add_constants(const struct gn_program_key *key, struct gn_gl_text *out) {
    gn_gl_text_add(out, "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                        "precision highp sampler2D;\nprecision highp sampler2DShadow;\n"
                        "precision highp usampler2D;\n");
    for (int i = 0; i < GN_FEATURE_COUNT; i++) {
        const char *name = gn_features[i].glsl;
        bool on = key->features >> i & 1;
        gn_gl_text_add(out, "const bool %s = %s;\n", name, on ? "true" : "false");
        if (on) gn_gl_text_add(out, "#define WITH_%s 1\n", name);
    }
    gn_gl_text_add(out, "const int DELTAS_WIDTH = %d;\n", GN_DELTAS_WIDTH);
    if (key->shadow_count) gn_gl_text_add(out, "#define WITH_SHADOWS 1\n");
    gn_gl_text_add(out, "const float ENVIRONMENT_ROUGHEST = %d.0;\n", GN_ENVIRONMENT_LEVELS - 1);
    gn_gl_text_add(out, "const float FLOOR_OCCLUDED = %.6f;\n", (double)GN_FLOOR_OCCLUDED);
    gn_gl_text_add(out, "const int LIGHT_COUNT = %d;\nconst int SHADOW_COUNT = %d;\n",
                   key->light_count, key->shadow_count);
    for (int i = 0; i < GN_LIGHT_TYPE_COUNT; i++)
        gn_gl_text_add(out, "const int %s = %d;\n", gn_light_types[i].glsl, i);
    for (int i = 0; i < GN_AOV_COUNT; i++)
        gn_gl_text_add(out, "const int %s = %d;\n", aov_names[i], i);
    gn_gl_text_add(out, "const int AOV = %d;\n", key->aov);
}

/* The rows of scene/material.h. EACH_TEXTURE(F) calls F(u_texture_name, v_uv_name, SLOT_NAME,
 * NAME_UV1) for each texture that the program has. TEXEL_NAME is a texel of one, or 1 without it,
 * and FACTOR_NAME a factor of a layer. */
static void add_material(const struct gn_program_key *key, struct gn_gl_text *out) {
    struct gn_gl_text each = {0};
    for (int i = 0; i < GN_TEXTURE_SLOT_COUNT; i++) {
        const char *glsl = gn_texture_slots[i].glsl, *name = gn_texture_slots[i].name;
        gn_gl_text_add(out, "const int SLOT_%s = %d;\n#define TEXEL_%s ", glsl, i, glsl);
        if (!(key->features >> (GN_FEATURE_FIRST_TEXTURE + i) & 1)) {
            gn_gl_text_add(out, "vec4(1.0)\n");
            continue;
        }
        gn_gl_text_add(out, "texture(u_texture_%s, v_uv_%s)\n", name, name);
        gn_gl_text_add(&each, " F(u_texture_%s, v_uv_%s, SLOT_%s, %s_UV1)", name, name, glsl, glsl);
    }
    gn_gl_text_add(out, "#define EACH_TEXTURE(F)");
    if (each.size > 0) gn_gl_text_add_bytes(out, each.data, each.size);
    gn_gl_text_finish(&each);
    gn_gl_text_add(out, "\nconst int SLOT_COUNT = %d;\nconst int FACTOR_VECTORS = %d;\n",
                   GN_TEXTURE_SLOT_COUNT, GN_FACTORS_VECTORS);
#define GN_X(LAYER, NAME, components, ...)                                                         \
    gn_gl_text_add(out, "#define FACTOR_%s u_factors[%d].%.*s\n", #NAME, 1 + GN_FACTOR_##NAME / 4, \
                   components, &"xyzw"[GN_FACTOR_##NAME % 4]);
    GN_LAYERS(GN_LEAVE_OUT, GN_X, GN_LEAVE_OUT)
#undef GN_X
}

/* Calls of the functions that each layer defines (lib/shade.glsl), from the base upwards; and the
 * files of the program's layers. */
static bool add_layers(struct gn_gl_source *source, const struct gn_program_key *key,
                       struct gn_gl_text *out, struct gn_err *err) {
    static const struct {
        uint64_t feature;
        const char *name, *file;
    } layers[GN_LAYER_COUNT] = {
#define GN_X(NAME, name, ...) {GN_FEATURE(NAME), name, "layer/" name ".glsl"},
        GN_LAYERS(GN_X, GN_LEAVE_OUT, GN_LEAVE_OUT)
#undef GN_X
    };
    static const char *const calls[][3] = {{"LAYERS_BEGIN", "begin", "(smooth_normal, s)"},
                                           {"LAYERS_AMBIENT", "ambient", "(s)"},
                                           {"LAYERS_LIGHT", "light", "(s, l, seen)"},
                                           {"LAYERS_END", "end", "(s, color)"}};
    for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
        gn_gl_text_add(out, "#define %s%s", calls[c][0], calls[c][2]);
        for (int i = 0; i < GN_LAYER_COUNT; i++)
            if (key->features & layers[i].feature)
                gn_gl_text_add(out, " %s_%s%s;", layers[i].name, calls[c][1], calls[c][2]);
        gn_gl_text_add(out, "\n");
    }
    for (int i = 0; i < GN_LAYER_COUNT; i++)
        if (key->features & layers[i].feature &&
            !gn_gl_source_add(source, layers[i].file, out, err))
            return false;
    return true;
}

/* A lookup is the code for one technique, encoding, moments, radius (set or compiled in) and taps.
 * Its number, the suffix, is that of the first light that has the same of them as light i. */
static int lookup_of(const struct gn_program_key *key, int i) {
    const struct gn_program_light *light = &key->lights[i];
    for (int first = 0;; first++) {
        const struct gn_program_light *other = &key->lights[first];
        if (other->technique == light->technique && other->encoding == light->encoding &&
            other->moments == light->moments && other->radius_set == light->radius_set &&
            other->taps == light->taps)
            return first;
    }
}

/* TAPS_DISK_8 and the like: the points of all counts that lights have, once. */
static void add_points(const struct gn_program_key *key, struct gn_gl_text *out) {
    bool any = false;
    for (int i = 0; i < key->shadow_count; i++) {
        const struct gn_program_light *light = &key->lights[i];
        const enum gn_taps kind = gn_techniques[light->technique].taps;
        bool known = false;
        for (int k = 0; k < i; k++)
            known |= gn_techniques[key->lights[k].technique].taps == kind &&
                     key->lights[k].taps == light->taps;
        if (kind == GN_TAPS_NONE || known) continue;
        if (!any)
            gn_gl_text_add(out, "const bool TAPS_TURN = %s;\n", key->taps_turn ? "true" : "false");
        any = true;
        float points[GN_TAPS_MAX / 2][2];
        /* rings of four share a point, opposites are computed */
        const int count = light->taps / (kind == GN_TAPS_RINGS ? 4 : 2);
        if (kind == GN_TAPS_RINGS)
            gn_taps_rings(count, points);
        else
            gn_taps_build(kind, light->taps, points);
        gn_gl_text_add(out, "const vec2 TAPS_%s_%d[%d] = vec2[%d](", taps_names[kind], light->taps,
                       count, count);
        for (int k = 0; k < count; k++)
            gn_gl_text_add(out, "%svec2(%.6f, %.6f)", k ? ", " : "", (double)points[k][0],
                           (double)points[k][1]);
        gn_gl_text_add(out, ");\n");
    }
}

static void add_middle(int technique, struct gn_gl_text *out) {
    gn_gl_text_add(out, "#define MOMENTS_MIDDLE %.1f\n",
                   (double)gn_techniques[technique].moments_middle);
}

static bool add_lookup(struct gn_gl_source *source, const struct gn_program_light *light,
                       int suffix, struct gn_gl_text *out, struct gn_err *err) {
    enum { LOOKUP_FILES = 5 };
    const struct gn_technique_row *technique = &gn_techniques[light->technique];
    const bool compares = compares_in_sampler(light);
    /* the files of the light's shadow, each after those that it uses */
    const char *files[LOOKUP_FILES] = {
        compares ? "lib/map_depth.glsl" : gn_encodings[light->encoding].file,
        compares ? NULL : "lib/map_lit.glsl", reads_taps_file(technique) ? "lib/taps.glsl" : NULL,
        technique->reads_both ? gn_moments[light->moments].file : NULL, technique->file};
    if (gn_technique_replaces_map((enum gn_technique)light->technique)) {
        files[0] = gn_moments[light->moments].file;
        files[1] = technique->moments;
    }
    if (light->taps)
        gn_gl_text_add(out, "#define TAPS %d\n#define RINGS %d\n#define SHADOW_TAPS TAPS_%s_%d\n",
                       light->taps, light->taps / 4, taps_names[technique->taps], light->taps);
    if (light->radius_set)
        gn_gl_text_add(out, "#define FILTER_RADIUS s.filter_radius\n");
    else if (technique->filter_radius_px > 0.0f)
        gn_gl_text_add(out, "#define FILTER_RADIUS %.1f\n", (double)technique->filter_radius_px);
    add_middle(light->technique, out);
    char names[LOOKUP_FILES][GN_GL_NAMES_MAX][64];
    int counts[LOOKUP_FILES] = {0};
    for (int i = 0; i < LOOKUP_FILES; i++) {
        if (!files[i]) continue;
        counts[i] = gn_gl_source_names(source, files[i], names[i], err);
        if (counts[i] < 0) return false;
        for (int n = 0; n < counts[i]; n++)
            gn_gl_text_add(out, "#define %s %s_%d\n", names[i][n], names[i][n], suffix);
    }
    for (int i = 0; i < LOOKUP_FILES; i++)
        if (files[i] && !gn_gl_source_add(source, files[i], out, err)) return false;
    for (int i = 0; i < LOOKUP_FILES; i++)
        for (int n = 0; n < counts[i]; n++) gn_gl_text_add(out, "#undef %s\n", names[i][n]);
    gn_gl_text_add(out, "#undef MAP_SAMPLER\n#undef MAP_OUT\n#undef TAPS\n#undef RINGS\n#undef "
                        "SHADOW_TAPS\n#undef FILTER_RADIUS\n"
                        "#undef MOMENTS_SAMPLER\n#undef MOMENTS_OUT\n#undef MOMENTS_MIDDLE\n"
                        "#undef MOMENTS\n");
    return true;
}

static const char *sampler_of_map(const struct gn_program_light *light) {
    const bool replaced = gn_technique_replaces_map((enum gn_technique)light->technique);
    if (compares_in_sampler(light)) return "sampler2DShadow";
    if (replaced) return gn_moments[light->moments].sampler;
    const bool integers =
        light->encoding == GN_ENCODING_R32UI || light->encoding == GN_ENCODING_SCREEN;
    return integers ? "usampler2D" : "sampler2D";
}

/* For a technique that reads the map of shader slot i and what it is filtered into: a function with
 * the arguments of all techniques, shadow_both_i(). */
static void add_filtered(const struct gn_program_light *light, int i, int suffix,
                         struct gn_gl_text *out) {
    gn_gl_text_add(out, "uniform %s u_filtered_%d;\n", gn_moments[light->moments].sampler, i);
    gn_gl_text_add(out,
                   "float shadow_both_%d(%s map, shadow_place s) {\n"
                   "    return shadow_visibility_%d(map, u_filtered_%d, s);\n}\n",
                   i, sampler_of_map(light), suffix, i);
}

/* One per light, at least one: shaders that use none declare them, too. */
static void add_flags(int lights, const char *name, uint32_t bits, struct gn_gl_text *out) {
    const int count = lights ? lights : 1;
    gn_gl_text_add(out, "const bool[%d] %s = bool[%d](", count, name, count);
    for (int i = 0; i < count; i++)
        gn_gl_text_add(out, "%s%s", i ? ", " : "", bits >> i & 1 ? "true" : "false");
    gn_gl_text_add(out, ");\n");
}

/* LIGHT_RANGED: the light ends at its range. SHADOW_LINEAR: the vertex shader computes where the
 * map is looked up; on a plane, with any light. SHADOW_PROJECTED: it computes a spot's projection,
 * and the fragment shader divides. SHADOW_SHARED: near the edge of a tile the pixels of a quad
 * sample different tiles and average the results (shaders_es/lib/shadow_tile.glsl).
 * SHADOW_CASCADES: the tiles are cascades; SHADOW_SPANS: each encodes distances of its own. Sharing
 * takes derivatives, which are undefined after a discard: CUT_LAST cuts holes last where a map is
 * shared, and first elsewhere, where that saves work. SHADOW_BACKS: visibility matters where a
 * surface is turned away from the light, too. SHADOW_SPREAD: the bias takes into account how far
 * faces are turned from their smooth normals; WITH_SPREAD: it does so in the fragment shader. In a
 * pose even the faces of a mesh without smooth normals are, so there it is for all techniques.
 * SHADOW_SMOOTH: the receiver's plane is that of the smooth normal, which takes no derivatives. */
static void add_light_flags(const struct gn_program_key *key, struct gn_gl_text *out) {
    /* a bit per light */
    uint32_t linear = 0, shared = 0, cascades = 0, spans = 0, spread = 0, smooth = 0, projected = 0;
    const bool deforms = key->features & GN_FEATURES_POSED;
    for (int i = 0; i < GN_SHADOWS_MAX; i++) {
        const struct gn_program_light *light = &key->lights[i];
        const struct gn_light_type_row *type = &gn_light_types[light->type];
        if ((!type->has_position && !light->cascades) || gn_techniques[light->technique].on_plane)
            linear |= 1u << i;
        else if (type->has_position && !type->shines_around)
            projected |= 1u << i;
        if ((type->shines_around || light->cascades) && gn_technique_shades(light->technique))
            shared |= 1u << i;
        if (light->cascades) cascades |= 1u << i;
        if (gn_techniques[light->technique].one_code || deforms) spread |= 1u << i;
        if (light->cascades && gn_technique_replaces_map((enum gn_technique)light->technique))
            spans |= 1u << i;
        if (gn_techniques[light->technique].reads_both) smooth |= 1u << i;
    }
    uint32_t ranged = 0;
    for (int i = 0; i < key->light_count; i++) ranged |= (uint32_t)key->lights[i].ranged << i;
    const uint32_t shadows = (1u << key->shadow_count) - 1;
    const bool cut_last = (shared | smooth) & shadows;
    gn_gl_text_add(out, "const bool SHADOW_BACKS = %s;\n",
                   key->kind == GN_PROGRAM_AOV ? "true" : "false");
    add_flags(key->light_count, "LIGHT_RANGED", ranged, out);
    add_flags(key->shadow_count, "SHADOW_LINEAR", linear, out);
    add_flags(key->shadow_count, "SHADOW_PROJECTED", projected, out);
    add_flags(key->shadow_count, "SHADOW_SHARED", shared, out);
    gn_gl_text_add(out, "const bool CUT_LAST = %s;\n", cut_last ? "true" : "false");
    add_flags(key->shadow_count, "SHADOW_CASCADES", cascades, out);
    add_flags(key->shadow_count, "SHADOW_SPANS", spans, out);
    add_flags(key->shadow_count, "SHADOW_SPREAD", spread, out);
    if (spread & ~linear & shadows) gn_gl_text_add(out, "#define WITH_SPREAD 1\n");
    add_flags(key->shadow_count, "SHADOW_SMOOTH", smooth, out);
}

/* Slide k is that of the k-th light that has one. */
static bool add_slides(struct gn_gl_source *source, const struct gn_program_key *key,
                       struct gn_gl_text *out, struct gn_err *err) {
    struct gn_gl_text each = {0};
    int count = 0;
    for (int i = 0; i < key->light_count; i++) {
        if (key->lights[i].slide == GN_SLIDE_NONE) continue;
        gn_gl_text_add(out, "uniform mediump sampler2D u_slide_%d;\n", count);
        gn_gl_text_add(&each, " F(%d, %d, %s, %s, u_slide_%d)", i, count,
                       key->lights[i].slide == GN_SLIDE_LIT ? "true" : "false",
                       key->lights[i].slide_ends ? "true" : "false", count);
        count++;
    }
    if (count) gn_gl_text_add(out, "#define WITH_SLIDES 1\n#define EACH_SLIDE(F)%s\n", each.data);
    gn_gl_text_finish(&each);
    return !count || gn_gl_source_add(source, "lib/slide.glsl", out, err);
}

/* What the fragment shaders of lit surfaces are made of: maps, taps, slides, and loops over them.
 */
static bool add_lights(struct gn_gl_source *source, const struct gn_program_key *key,
                       struct gn_gl_text *out, struct gn_err *err) {
    if (key->shadow_count && !gn_gl_source_add(source, "lib/shadow_place.glsl", out, err))
        return false;
    add_points(key, out);
    for (int i = 0; i < key->shadow_count; i++) {
        const char *sampler = sampler_of_map(&key->lights[i]);
        gn_gl_text_add(out, "uniform %s u_map_%d;\n", sampler, i);
    }
    for (int i = 0; i < key->shadow_count; i++) {
        const struct gn_program_light *light = &key->lights[i];
        if (lookup_of(key, i) == i && !add_lookup(source, light, i, out, err)) return false;
        if (gn_techniques[light->technique].reads_both)
            add_filtered(light, i, lookup_of(key, i), out);
    }
    if (!add_slides(source, key, out, err)) return false;
    gn_gl_text_add(out, "#define EACH_SHADOWED_LIGHT(F)");
    for (int i = 0; i < key->shadow_count; i++) {
        const struct gn_program_light *light = &key->lights[i];
        const struct gn_light_type_row *type = &gn_light_types[light->type];
        bool radial = type->has_position && light->encoding != GN_ENCODING_DEPTH;
        const bool both = gn_techniques[light->technique].reads_both;
        gn_gl_text_add(out, " F(%d, %s, %s, shadow_%s_%d, u_map_%d)", i, type->glsl,
                       radial ? "true" : "false", both ? "both" : "visibility",
                       both ? i : lookup_of(key, i), i);
    }
    gn_gl_text_add(out, "\n#define EACH_OPEN_LIGHT(F)");
    for (int i = key->shadow_count; i < key->light_count; i++)
        gn_gl_text_add(out, " F(%d, %s)", i, gn_light_types[key->lights[i].type].glsl);
    gn_gl_text_add(out, "\n");
    return true;
}

bool gn_gl_compose(const char *folder, const struct gn_program_key *key, enum gn_gl_shader shader,
                   struct gn_gl_text *out, struct gn_err *err) {
    struct gn_gl_source source = {.folder = folder};
    const struct gn_program_row *program = &gn_programs[key->kind];
    const bool fragment = shader == GN_GL_FRAGMENT;
    const bool lit = key->kind == GN_PROGRAM_LIT || key->kind == GN_PROGRAM_AOV;
    const bool filter = key->kind == GN_PROGRAM_FILTER && fragment;
    add_constants(key, out);
    add_material(key, out);
    if (!gn_gl_source_add(&source, "blocks.glsl", out, err)) return false;
    if (lit) add_light_flags(key, out);
    if (shader == GN_GL_VERTEX) {
        /* VERTEX_ATTRIBUTES declares the rows of scene/attribute.h; of four shorts all are read */
        gn_gl_text_add(out, "#define VERTEX_ATTRIBUTES");
        for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++)
            gn_gl_text_add(
                out, " layout(location = %d) in %svec%d a_%s;", i,
                gn_attributes[i].format == GN_ATTRIBUTE_UINT16 ? "u" : "",
                gn_attributes[i].format == GN_ATTRIBUTE_SNORM16 ? 4 : gn_attributes[i].components,
                gn_attributes[i].name);
        gn_gl_text_add(out, "\n");
    }
    if (lit && shader == GN_GL_VERTEX) {
        gn_gl_text_add(out, "#define EACH_SHADOWED_LIGHT_VERTEX(F)");
        for (int i = 0; i < key->shadow_count; i++) gn_gl_text_add(out, " F(%d)", i);
        gn_gl_text_add(out, "\n");
    }
    if (lit && fragment && !add_lights(&source, key, out, err)) return false;
    if (key->kind == GN_PROGRAM_LIT && fragment && !add_layers(&source, key, out, err))
        return false;
    if (program->reads & GN_PROGRAM_ENCODING && fragment &&
        !gn_gl_source_add(&source, gn_encodings[key->encoding].file, out, err))
        return false;
    const char *main_file = fragment ? program->fragment : program->vertex;
    if (filter) { /* how moments are stored, how the map is read, what moments a distance has */
        const struct gn_filter_step_row *step = &gn_filter_steps[key->step];
        add_middle(key->technique, out); /* 0 of NONE: moments are averaged as stored */
        if (!gn_gl_source_add(&source, gn_moments[key->moments].file, out, err)) return false;
        if (step->reads_map &&
            (!gn_gl_source_add(&source, gn_encodings[key->encoding].file, out, err) ||
             (gn_techniques[key->technique].moments &&
              !gn_gl_source_add(&source, gn_techniques[key->technique].moments, out, err))))
            return false;
        main_file = step->file;
    }
    return gn_gl_source_add(&source, main_file, out, err);
}

static void append_word(char *out, size_t size, const char *separator, const char *word) {
    size_t used = strlen(out);
    snprintf(out + used, size - used, "%s%s", separator, word);
}

void gn_gl_key_text(const struct gn_program_key *key, char *out, size_t size) {
    snprintf(out, size, "%s", gn_programs[key->kind].name);
    if (key->kind == GN_PROGRAM_AOV) append_word(out, size, " ", aov_names[key->aov]);
    if (gn_programs[key->kind].reads & GN_PROGRAM_ENCODING)
        append_word(out, size, " ", gn_encodings[key->encoding].name);
    if (key->kind == GN_PROGRAM_FILTER) {
        append_word(out, size, " ", gn_filter_steps[key->step].name);
        append_word(out, size, ", ", gn_techniques[key->technique].name);
        append_word(out, size, " ", gn_moments[key->moments].name);
    }
    const char *separator = " ";
    for (int i = 0; i < GN_FEATURE_COUNT; i++) {
        if (!(key->features >> i & 1)) continue;
        append_word(out, size, separator, gn_features[i].glsl);
        separator = "|";
    }
    for (int i = 0; i < key->light_count; i++) {
        const struct gn_program_light *light = &key->lights[i];
        append_word(out, size, ", ", gn_light_types[light->type].glsl + sizeof "LIGHT_" - 1);
        if (light->slide)
            append_word(out, size, " ", light->slide == GN_SLIDE_LIT ? "film" : "slide");
        if (light->slide_ends) append_word(out, size, " ", "far");
        if (light->ranged) append_word(out, size, " ", "ranged");
        if (i >= key->shadow_count) continue;
        append_word(out, size, " ", gn_techniques[light->technique].name);
        append_word(out, size, " ",
                    light->moments ? gn_moments[light->moments].name
                                   : gn_encodings[light->encoding].name);
        if (light->cascades) append_word(out, size, " ", "cascades");
        if (light->radius_set) append_word(out, size, " ", "radius");
    }
}
