/* Writes the composed sources of the programs whose cost is worth knowing, for offline compilers:
 * DIR/NAME.vert and NAME.frag.
 * "//@" comments say what an offline compiler has to bind: formats of maps and of the target. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "gl/private.h"
#include "image/map_format.h"

static struct gn_program_key lit(uint64_t features, enum gn_light_type type, const char *technique,
                                 const char *encoding) {
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = GN_PROGRAM_LIT;
    key.features = features;
    key.light_count = 1;
    key.lights[0].type = (uint8_t)type;
    enum gn_technique t = GN_TECHNIQUE_NONE;
    enum gn_encoding e = GN_ENCODING_DEPTH;
    gn_technique_find(technique, strlen(technique), &t);
    if (gn_techniques[t].on_plane)
        e = strcmp(encoding, "stencil") == 0 ? GN_ENCODING_STENCIL
            : strcmp(encoding, "mean") == 0  ? GN_ENCODING_MEAN
                                             : GN_ENCODING_MASK;
    else
        find_encoding(encoding, &e);
    if (gn_technique_filters_map(t)) {
        enum gn_moments moments = (enum gn_moments)gn_techniques[t].stores[0];
        find_moments(encoding, &moments);
        key.lights[0].moments = (uint8_t)moments;
        e = gn_techniques[t].reads_both ? GN_ENCODING_DEPTH : GN_ENCODING_R32UI;
    }
    key.shadow_count = t != GN_TECHNIQUE_NONE;
    key.lights[0].technique = (uint8_t)t;
    key.lights[0].encoding = (uint8_t)e;
    key.lights[0].taps = (uint8_t)gn_taps_count(gn_techniques[t].taps, 0);
    key.taps_turn = key.lights[0].taps > 0;
    return key;
}

static struct gn_program_key with_slide(struct gn_program_key key, enum gn_slide slide) {
    key.lights[0].slide = (uint8_t)slide;
    return key;
}

static struct gn_program_key with_rings(struct gn_program_key key, uint8_t rings) {
    key.lights[0].taps = (uint8_t)(4 * rings);
    return key;
}

static struct gn_program_key with_cascades(struct gn_program_key key) {
    key.lights[0].cascades = 1;
    return key;
}

static struct gn_program_key caster(enum gn_program_kind kind, uint64_t features,
                                    enum gn_encoding encoding) {
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = (uint8_t)kind;
    key.features = features;
    key.encoding = (uint8_t)encoding;
    return key;
}

static struct gn_program_key filter(enum gn_technique technique, enum gn_filter_step step) {
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = GN_PROGRAM_FILTER;
    key.step = (uint8_t)step;
    key.moments = gn_techniques[technique].stores[0];
    if (!gn_filter_steps[step].reads_map) return key;
    key.technique = (uint8_t)technique;
    key.encoding = gn_techniques[technique].reads_both ? GN_ENCODING_DEPTH : GN_ENCODING_R32UI;
    return key;
}

static struct gn_program_key floor_alpha(void) {
    struct gn_program_key key = filter(GN_TECHNIQUE_FLOOR, GN_STEP_FLOOR);
    key.encoding = GN_ENCODING_MEAN;
    key.features = GN_FEATURE(OCCLUSION_TEXTURE);
    return key;
}

static const char *const moments_formats[GN_MOMENTS_COUNT] = {
    [GN_MOMENTS_RG32UI] = "RG32UI",           [GN_MOMENTS_RGBA16UI] = "RGBA16UI",
    [GN_MOMENTS_RGBA16F] = "RGBA16F",         [GN_MOMENTS_RGBA16F_MIPS] = "RGBA16F",
    [GN_MOMENTS_RGBA32F_BITS] = "RGBA32UI",   [GN_MOMENTS_RGBA32F_SHARE] = "RGBA32UI",
    [GN_MOMENTS_TABLE_RGBA32UI] = "RGBA32UI", [GN_MOMENTS_CONE_RG16F] = "RG16F",
    [GN_MOMENTS_CONE_BITS] = "R32UI",         [GN_MOMENTS_CONE_BYTES] = "RGBA8",
};

static const char *target_of(const struct gn_program_key *key) {
    if (key->kind == GN_PROGRAM_FILTER) return moments_formats[key->moments];
    static const char *const maps[GN_ENCODING_COUNT] = {"none",  "R32UI", "R16F", "R16F",
                                                        "RGBA8", "none",  "R8",   "R8"};
    if (key->kind == GN_PROGRAM_DEPTH) return "none";
    return key->kind == GN_PROGRAM_DISTANCE ? maps[key->encoding] : "SRGB8A8";
}

static bool write(const char *folder, const char *name, const struct gn_program_key *key,
                  struct gn_err *err) {
    static const char *const formats[GN_ENCODING_COUNT] = {"D24",   "R32UI", "R16F", "R16F",
                                                           "RGBA8", "D16",   "R8",   "R8"};
    static const char *const endings[] = {"vert", "frag"};
    for (int shader = GN_GL_VERTEX; shader <= GN_GL_FRAGMENT; shader++) {
        struct gn_gl_text text = {0};
        char path[1024], head[256];
        if (!gn_gl_compose("shaders_es", key, (enum gn_gl_shader)shader, &text, err)) return false;
        char *rest = strchr(text.data, '\n') + 1; /* after #version */
        snprintf(head, sizeof head, "%.*s//@ target %s\n", (int)(rest - text.data), text.data,
                 target_of(key));
        if (key->shadow_count && key->lights[0].encoding != GN_ENCODING_STENCIL)
            snprintf(head + strlen(head), sizeof head - strlen(head), "//@ tex u_map_0 %s\n",
                     gn_technique_replaces_map((enum gn_technique)key->lights[0].technique)
                         ? moments_formats[key->lights[0].moments]
                         : formats[key->lights[0].encoding]);
        if (gn_techniques[key->lights[0].technique].reads_both)
            snprintf(head + strlen(head), sizeof head - strlen(head), "//@ tex u_filtered_0 %s\n",
                     moments_formats[key->lights[0].moments]);
        if (key->kind == GN_PROGRAM_FILTER)
            snprintf(head + strlen(head), sizeof head - strlen(head), "//@ tex u_map_0 %s\n",
                     gn_filter_steps[key->step].reads_map ? formats[key->encoding]
                                                          : moments_formats[key->moments]);
        if (key->kind == GN_PROGRAM_FILTER) /* not all read two */
            snprintf(head + strlen(head), sizeof head - strlen(head), "//@ tex u_map_1 %s\n",
                     moments_formats[key->moments]);
        if (key->lights[0].slide)
            snprintf(head + strlen(head), sizeof head - strlen(head),
                     "//@ tex u_slide_0 SRGB8A8\n");
        if (strstr(rest, "uniform sampler2D u_pose;"))
            snprintf(head + strlen(head), sizeof head - strlen(head),
                     "//@ tex u_pose RGBA32F\n//@ tex u_deltas RGBA32F\n");
        size_t size = strlen(head) + strlen(rest);
        char *whole = malloc(size + 1);
        if (!whole) abort();
        snprintf(whole, size + 1, "%s%s", head, rest);
        snprintf(path, sizeof path, "%s/%s.%s", folder, name, endings[shader]);
        bool ok = gn_file_write(path, whole, size, err);
        free(whole);
        free(text.data);
        if (!ok) return false;
    }
    return true;
}

/* The shader that the figures are about: base texture, hemisphere, Blinn-Phong, an sRGB target. */
#define DIFFUSE (GN_FEATURE(BASE_TEXTURE) | GN_FEATURE(HEMISPHERE))
#define FULL    (DIFFUSE | GN_FEATURE(SPECULAR))
/* The whole look of a material in an environment. */
#define LOOK                                                                                       \
    (GN_FEATURE(BASE_TEXTURE) | GN_FEATURE(SPECULAR) | GN_FEATURE(ENVIRONMENT) |                   \
     GN_FEATURE(ENVIRONMENT_DIFFUSE) | GN_FEATURE(TONE_NEUTRAL))
#define LOOK_METAL (LOOK | GN_FEATURE(METAL) | GN_FEATURE(ROUGHNESS_TEXTURE))
#define GLASS      (GN_FEATURE(TRANSMISSION) | GN_FEATURE(TINTED))

static struct gn_program_key tint(void) {
    struct gn_program_key key = {.kind = GN_PROGRAM_LIT,
                                 .features = GN_FEATURE(BASE_TEXTURE) | GN_FEATURE(SPECULAR) |
                                             GN_FEATURE(UNLIT) | GLASS};
    return key;
}

/* All techniques of the table, as TECHNIQUE-LIGHT-FORMAT: each with every type of light and the
 * encoding of `auto`, hard with all encodings. */
static bool write_all(const char *folder, struct gn_err *err) {
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++)
        for (int type = 0; type < GN_LIGHT_TYPE_COUNT; type++) {
            const char *light = type == GN_LIGHT_DIRECTIONAL ? "sun" : gn_light_types[type].name;
            if (gn_technique_filters_map((enum gn_technique)t)) {
                const char *moments = gn_moments[gn_techniques[t].stores[0]].name;
                char name[80];
                snprintf(name, sizeof name, "%s-%s-%s", gn_techniques[t].name, light, moments);
                struct gn_program_key key = lit(FULL, type, gn_techniques[t].name, moments);
                if (!write(folder, name, &key, err)) return false;
                continue;
            }
            for (int e = 0; e < GN_ENCODING_COUNT; e++) {
                bool fell_back;
                enum gn_encoding own = gn_encoding_choose((enum gn_technique)t, GN_ENCODING_AUTO,
                                                          UINT32_MAX, &fell_back);
                bool by_hand = gn_techniques[t].on_plane
                                   ? e > GN_ENCODING_MASK
                                   : t == GN_TECHNIQUE_HARD && e < GN_ENCODING_DEPTH16;
                if (e != (int)own && !by_hand) continue;
                char name[80];
                snprintf(name, sizeof name, "%s-%s-%s", gn_techniques[t].name, light,
                         gn_encodings[e].name);
                struct gn_program_key key =
                    lit(FULL, type, gn_techniques[t].name, gn_encodings[e].name);
                if (!write(folder, name, &key, err)) return false;
            }
        }
    return true;
}

/* The passes of all filters, as TECHNIQUE-PASS; those that techniques share once. */
static bool write_filters(const char *folder, struct gn_err *err) {
    uint64_t written[GN_MOMENTS_COUNT] = {0}; /* bits of steps that read moments alone */
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        const struct gn_filter_row *row = &gn_filters[gn_techniques[t].filter];
        for (uint32_t i = 0; i < row->count; i++) {
            const enum gn_filter_step step = (enum gn_filter_step)row->stages[i].step;
            const struct gn_program_key key = filter((enum gn_technique)t, step);
            char name[80];
            if (written[key.moments] >> step & 1) continue;
            if (!gn_filter_steps[step].reads_map) written[key.moments] |= UINT64_C(1) << step;
            snprintf(name, sizeof name, "%s-%s", gn_techniques[t].name, gn_filter_steps[step].name);
            for (char *c = name; *c; c++)
                if (*c == ' ') *c = '-';
            if (!write(folder, name, &key, err)) return false;
        }
    }
    return true;
}

/* What a model by itself is drawn with, without and with its occlusion. */
static bool write_occluded(const char *folder, struct gn_err *err) {
    static const struct {
        const char *name;
        uint64_t features;
    } looks[] = {
        {"own-diffuse",
         GN_FEATURE(BASE_TEXTURE) | GN_FEATURE(ENVIRONMENT_DIFFUSE) | GN_FEATURE(TONE_NEUTRAL)},
        {"own-look", LOOK},
        {"own-metal", LOOK_METAL | GN_FEATURE(ENVIRONMENT_KEY)},
        {"own-helmet", LOOK_METAL | GN_FEATURE(ENVIRONMENT_KEY) | GN_FEATURE(NORMAL_TEXTURE) |
                           GN_FEATURE(OCCLUSION_TEXTURE)},
        {"own-coat", LOOK_METAL | GN_FEATURE(ENVIRONMENT_KEY) | GN_FEATURE(COAT)},
    };
    for (size_t i = 0; i < 2 * (sizeof looks / sizeof looks[0]); i++) {
        char name[80];
        const struct gn_program_key key =
            lit(looks[i / 2].features | (i % 2 ? GN_FEATURE(OCCLUDED) : 0), GN_LIGHT_DIRECTIONAL,
                "cone", "rg16f");
        snprintf(name, sizeof name, "%s%s", looks[i / 2].name, i % 2 ? "-occluded" : "");
        if (!write(folder, name, &key, err)) return false;
    }
    return true;
}

/* Those that no loop over a table makes. */
static bool write_rest(const char *folder, struct gn_err *err) {
    const struct {
        const char *name;
        struct gn_program_key key;
    } programs[] = {
        {"none", lit(FULL, GN_LIGHT_DIRECTIONAL, "none", "depth")},
        {"pcf-normal-map",
         lit(FULL | GN_FEATURE(NORMAL_TEXTURE), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"pcf-skin", lit(FULL | GN_FEATURE(SKIN), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"pcf-skin-8", lit(FULL | GN_FEATURE(SKIN_8), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"pcf-morph", lit(FULL | GN_FEATURE(MORPH), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"map-depth-skin", caster(GN_PROGRAM_DEPTH, GN_FEATURE(SKIN), GN_ENCODING_DEPTH)},
        {"pcf-diffuse", lit(DIFFUSE, GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"pcf-encode", lit(FULL | GN_FEATURE(ENCODE_SRGB), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"pcf-neutral", lit(FULL | GN_FEATURE(TONE_NEUTRAL), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"pcf-aces", lit(FULL | GN_FEATURE(TONE_ACES), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"pcf-agx", lit(FULL | GN_FEATURE(TONE_AGX), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look", lit(LOOK, GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-metal", lit(LOOK_METAL, GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-metal-key",
         lit(LOOK_METAL | GN_FEATURE(ENVIRONMENT_KEY), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-coat", lit(LOOK | GN_FEATURE(COAT), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-normal-map",
         lit(LOOK | GN_FEATURE(NORMAL_TEXTURE), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-normal-map-coat", lit(LOOK | GN_FEATURE(NORMAL_TEXTURE) | GN_FEATURE(COAT),
                                     GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-glass", lit(LOOK | GN_FEATURE(TRANSMISSION), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-glass-tinted", lit(LOOK | GLASS, GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"look-glass-tint", tint()},
        {"pcf-coat", lit(FULL | GN_FEATURE(COAT), GN_LIGHT_DIRECTIONAL, "pcf", "depth")},
        {"hard-cascades", with_cascades(lit(FULL, GN_LIGHT_DIRECTIONAL, "hard", "r16f"))},
        {"pcf-cascades", with_cascades(lit(FULL, GN_LIGHT_DIRECTIONAL, "pcf", "depth"))},
        {"pcf-cascades-mask",
         with_cascades(lit(FULL | GN_FEATURE(ALPHA_MASK), GN_LIGHT_DIRECTIONAL, "pcf", "depth"))},
        {"pcf3-cascades", with_cascades(lit(FULL, GN_LIGHT_DIRECTIONAL, "pcf3", "depth"))},
        {"pcss-cascades", with_cascades(lit(FULL, GN_LIGHT_DIRECTIONAL, "pcss", "r16f"))},
        {"disk-depth", lit(FULL, GN_LIGHT_DIRECTIONAL, "disk", "depth")},
        {"pcss-depth", lit(FULL, GN_LIGHT_DIRECTIONAL, "pcss", "depth")},
        {"pcf-r16f", lit(FULL, GN_LIGHT_DIRECTIONAL, "pcf", "r16f")},
        {"pcf-spot-slide", with_slide(lit(FULL, GN_LIGHT_SPOT, "pcf", "depth"), GN_SLIDE_DARK)},
        {"none-spot", lit(FULL, GN_LIGHT_SPOT, "none", "depth")},
        {"none-spot-slide", with_slide(lit(FULL, GN_LIGHT_SPOT, "none", "depth"), GN_SLIDE_DARK)},
        {"map-depth", caster(GN_PROGRAM_DEPTH, 0, GN_ENCODING_DEPTH)},
        {"map-depth-middle", caster(GN_PROGRAM_DEPTH, GN_FEATURE(MIDDLE), GN_ENCODING_DEPTH)},
        {"map-r16f", caster(GN_PROGRAM_DISTANCE, 0, GN_ENCODING_R16F)},
        {"map-r16f-spot", caster(GN_PROGRAM_DISTANCE, GN_FEATURE(PERSPECTIVE), GN_ENCODING_R16F)},
        {"map-rgba8", caster(GN_PROGRAM_DISTANCE, 0, GN_ENCODING_RGBA8)},
        {"cone-8", with_rings(lit(FULL, GN_LIGHT_DIRECTIONAL, "cone", "rg16f"), 2)},
        {"cone-16", with_rings(lit(FULL, GN_LIGHT_DIRECTIONAL, "cone", "rg16f"), 4)},
        {"cone-cascades", with_cascades(lit(FULL, GN_LIGHT_DIRECTIONAL, "cone", "rg16f"))},
        {"map-mask", caster(GN_PROGRAM_DISTANCE, 0, GN_ENCODING_MASK)},
        {"map-mean", caster(GN_PROGRAM_DISTANCE, 0, GN_ENCODING_MEAN)},
        {"floor-alpha", floor_alpha()},
        {"floor", caster(GN_PROGRAM_FLOOR, 0, GN_ENCODING_DEPTH)},
        {"mean", caster(GN_PROGRAM_MEAN, 0, GN_ENCODING_DEPTH)},
    };
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++)
        if (!write(folder, programs[i].name, &programs[i].key, err)) return false;
    return true;
}

int main(int argc, char **argv) {
    struct gn_err err = {0};
    if (argc != 2) {
        fprintf(stderr, "usage: tool_shaders DIR\n");
        return 2;
    }
    if (write_all(argv[1], &err) && write_filters(argv[1], &err) && write_occluded(argv[1], &err) &&
        write_rest(argv[1], &err))
        return 0;
    fprintf(stderr, "tool_shaders: %s\n", err.text);
    return 1;
}
