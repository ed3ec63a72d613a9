/* The gnomon_ keys in the extras of nodes, lights and the scene. They come from hand-made custom
 * properties, so nothing here fails: an invalid value gives a warning and the default is kept. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <float.h>
#include <math.h>
#include <string.h>

static struct gn_at extras_of(const struct gn_at *holder) { return gn_at_any(holder, "extras"); }

static void warn_wanted(struct gn_gltf *g, const struct gn_at *at, const char *wanted) {
    gn_gltf_warn(g, at, "must be %s; ignored", wanted);
}

/* ---- values ---- */

static void take_float(struct gn_gltf *g, const struct gn_at *extras, const char *key, float most,
                       float *out) {
    struct gn_at at = gn_at_any(extras, key);
    double value;
    char wanted[48];
    if (!at.json) return;
    if (gn_json_number(at.json, &value) && value >= 0 && value <= (double)most) {
        *out = (float)value;
        return;
    }
    snprintf(wanted, sizeof wanted,
             most < FLT_MAX ? "a number from 0 to %g" : "a number, 0 or more", (double)most);
    warn_wanted(g, &at, wanted);
}

static void take_degrees(struct gn_gltf *g, const struct gn_at *extras, const char *key,
                         float *out) {
    struct gn_at at = gn_at_any(extras, key);
    double value;
    if (!at.json) return;
    if (gn_json_number(at.json, &value) && fabs(value) <= 360)
        *out = (float)value;
    else
        warn_wanted(g, &at, "a number of degrees from -360 to 360");
}

/* true, false, or 1 and 0, which older exporters write. */
static bool take_flag(struct gn_gltf *g, const struct gn_at *extras, const char *key, bool *out) {
    struct gn_at at = gn_at_any(extras, key);
    int64_t value = 0;
    if (!at.json) return false;
    if (json_is_boolean(at.json))
        *out = json_is_true(at.json);
    else if (gn_json_whole(at.json, &value) && (value == 0 || value == 1))
        *out = value == 1;
    else {
        warn_wanted(g, &at, "true or false");
        return false;
    }
    return true;
}

/* One of names, whose number is returned; -1 if absent or wrong. */
static int take_word(struct gn_gltf *g, const struct gn_at *extras, const char *key,
                     const char *const *names, int count) {
    struct gn_at at = gn_at_any(extras, key);
    int word = gn_json_word(at.json, names, count);
    if (word >= 0) return word;
    char wanted[64] = "one of";
    for (int i = 0; i < count; i++)
        snprintf(wanted + strlen(wanted), sizeof wanted - strlen(wanted), " %s", names[i]);
    if (at.json) warn_wanted(g, &at, wanted);
    return -1;
}

static bool take_pair(struct gn_gltf *g, const struct gn_at *extras, const char *key,
                      float out[2]) {
    struct gn_at at = gn_at_any(extras, key);
    double w = 0, h = 0;
    if (!at.json) return false;
    if (json_array_size(at.json) == 2 && gn_json_number(json_array_get(at.json, 0), &w) &&
        gn_json_number(json_array_get(at.json, 1), &h) && w > 0 && h > 0 && w < 1e6 && h < 1e6) {
        out[0] = (float)w;
        out[1] = (float)h;
        return true;
    }
    warn_wanted(g, &at, "two numbers over 0: [width, height]");
    return false;
}

/* Three numbers (the fourth of Blender's colours is ignored), or one number for grey. */
static bool take_color(struct gn_gltf *g, const struct gn_at *extras, const char *key, vec3 out) {
    struct gn_at at = gn_at_any(extras, key);
    if (!at.json) return false;
    double c[3];
    size_t n = json_array_size(at.json);
    bool right = n == 3 || n == 4 || json_is_number(at.json);
    for (size_t i = 0; i < 3 && right; i++) {
        const json_t *part = n > 0 ? json_array_get(at.json, i) : at.json;
        right = gn_json_number(part, &c[i]) && c[i] >= 0 && c[i] <= 1e6;
    }
    if (!right) {
        warn_wanted(g, &at, "a colour: [r, g, b], linear, 0 or more");
        return false;
    }
    for (int i = 0; i < 3; i++) out[i] = (float)c[i];
    return true;
}

static void take_whole(struct gn_gltf *g, const struct gn_at *extras, const char *key,
                       int64_t least, int64_t most, int64_t *out) {
    struct gn_at at = gn_at_any(extras, key);
    int64_t value = 0;
    char wanted[64];
    if (!at.json) return;
    if (gn_json_whole(at.json, &value) && value >= least && value <= most) {
        *out = value;
        return;
    }
    snprintf(wanted, sizeof wanted, "a whole number from %lld to %lld", (long long)least,
             (long long)most);
    warn_wanted(g, &at, wanted);
}

/* ---- holders ---- */

void gn_extras_node(struct gn_gltf *g, const struct gn_at *node, struct gn_placed *placed) {
    static const char *const faces[] = {[GN_CAST_BOTH] = "both",
                                        [GN_CAST_FRONT] = "front",
                                        [GN_CAST_BACK] = "back",
                                        [GN_CAST_AUTO] = "auto",
                                        [GN_CAST_MIDDLE] = "middle"};
    placed->casts = placed->receives = true;
    struct gn_at extras = extras_of(node);
    if (!json_is_object(extras.json)) return;
    take_flag(g, &extras, "gnomon_cast", &placed->casts);
    take_flag(g, &extras, "gnomon_cast_alpha", &placed->casts_alpha);
    take_flag(g, &extras, "gnomon_receive", &placed->receives);
    bool plane = false;
    if (take_flag(g, &extras, "gnomon_plane", &plane)) placed->plane = plane ? GN_YES : GN_NO;
    int word = take_word(g, &extras, "gnomon_cast_faces", faces, 5);
    if (word >= 0) placed->cast_faces = (enum gn_cast_faces)word;
}

void gn_extras_light(struct gn_gltf *g, const struct gn_at *holder, struct gn_light *light) {
    static const char *const outside[] = {"dark", "lit"};
    struct gn_at extras = extras_of(holder);
    if (!json_is_object(extras.json)) return;
    take_float(g, &extras, "gnomon_radius", FLT_MAX, &light->radius);
    take_float(g, &extras, "gnomon_shadow_strength", 1, &light->shadow_strength);
    take_float(g, &extras, "gnomon_shadow_specular", 1, &light->shadow_specular);
    if (light->type == GN_LIGHT_DIRECTIONAL)
        take_flag(g, &extras, "gnomon_sun", &light->is_sun);
    else if (gn_at_any(&extras, "gnomon_sun").json)
        gn_gltf_warn(g, &extras, "gnomon_sun: only a directional light can be the sun; ignored");
    int64_t px = light->map_px;
    take_whole(g, &extras, "gnomon_map_px", 16, 16384, &px);
    light->map_px = (uint32_t)px;
    struct gn_at technique = gn_at_any(&extras, "gnomon_shadow");
    const char *name = json_string_value(technique.json);
    if (name)
        light->technique = gn_gltf_strdup(g, name);
    else if (technique.json)
        warn_wanted(g, &technique, "the name of a technique, or none");

    bool has_slide = gn_at_any(&extras, "gnomon_slide").json != NULL;
    if (!gn_light_types[light->type].has_cone) {
        if (has_slide)
            gn_gltf_warn(g, &extras, "gnomon_slide: only a spot can project a slide; ignored");
        return;
    }
    int64_t slide = -1;
    if (g->file.texture_count > 0)
        take_whole(g, &extras, "gnomon_slide", 0, (int64_t)g->file.texture_count - 1, &slide);
    else if (has_slide)
        gn_gltf_warn(g, &extras, "gnomon_slide: the file has no textures; ignored");
    if (slide >= 0) light->slide = gn_gltf_texture(g, (int32_t)slide, GN_SCALE_COLOR);
    take_pair(g, &extras, "gnomon_slide_size_m", light->slide_size_m);
    take_float(g, &extras, "gnomon_slide_distance_m", 1e6f, &light->slide_distance_m);
    take_float(g, &extras, "gnomon_slide_far_m", 1e6f, &light->slide_far_m);
    int word = take_word(g, &extras, "gnomon_slide_outside", outside, 2);
    if (word >= 0) light->slide_lit_outside = word == 1;
}

void gn_extras_material(struct gn_gltf *g, const struct gn_at *material, int lightmap_set,
                        struct gn_material *m) {
    struct gn_at extras = extras_of(material);
    struct gn_texture_ref *ref = &m->textures[GN_TEXTURE_LIGHTMAP];
    int64_t texture = -1;
    if (!json_is_object(extras.json)) return;
    const bool has_map = gn_at_any(&extras, "gnomon_lightmap").json != NULL;
    if (g->file.texture_count > 0)
        take_whole(g, &extras, "gnomon_lightmap", 0, (int64_t)g->file.texture_count - 1, &texture);
    else if (has_map)
        gn_gltf_warn(g, &extras, "gnomon_lightmap: the file has no textures; ignored");
    take_float(g, &extras, "gnomon_lightmap_intensity", 1e9f, &m->lightmap_intensity);
    if (texture < 0 || ref->texture >= 0) return;
    if (lightmap_set < 0)
        gn_gltf_warn(g, &extras,
                     "gnomon_lightmap: the material reads two other sets of coordinates; ignored");
    else
        ref->texture = gn_gltf_texture(g, (int32_t)texture, GN_SCALE_COLOR);
    ref->uv_set = lightmap_set > 0 ? (uint8_t)lightmap_set : 0;
}

void gn_extras_scene(struct gn_gltf *g, const struct gn_at *scene) {
    struct gn_scene *s = g->scene;
    glm_vec3_copy((vec3){.08f, .08f, .08f}, s->environment.sky);
    glm_vec3_copy((vec3){.04f, .04f, .04f}, s->environment.ground);
    struct gn_at extras = scene->json ? extras_of(scene) : (struct gn_at){0};
    if (json_is_object(extras.json)) {
        take_color(g, &extras, "gnomon_sky", s->environment.sky);
        take_color(g, &extras, "gnomon_ground", s->environment.ground);
        take_degrees(g, &extras, "gnomon_north", &s->environment.north_deg);
    }
    glm_vec3_lerp(s->environment.sky, s->environment.ground, .5f, s->environment.background);
    if (json_is_object(extras.json))
        s->environment.has_background =
            take_color(g, &extras, "gnomon_background", s->environment.background);
}
