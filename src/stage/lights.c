#include "stage/lights.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/srgb.h"
#include "options/value.h"

bool gn_light_section_is_of(const struct gn_light_section *section, const struct gn_scene *scene,
                            uint32_t light) {
    const struct gn_light *l = &scene->lights[light];
    return strcmp(section->name, scene->nodes[l->node].name) == 0 ||
           strcmp(section->name, l->name) == 0;
}

/* The entry of that light; NULL: no room. */
static struct gn_frame_light_opts *find_entry(struct gn_frame_shadow_opts *opts, uint32_t light) {
    uint32_t i = 0;
    while (i < opts->light_count && opts->lights[i].light != light) i++;
    if (i == GN_ALL_LIGHTS_MAX) return NULL;
    if (i == opts->light_count)
        opts->lights[opts->light_count++] = (struct gn_frame_light_opts){.light = light};
    return &opts->lights[i];
}

static float strongest_of(const float color[3]) {
    return fmaxf(color[0], fmaxf(color[1], color[2]));
}

static void begin_color(struct gn_frame_light_opts *entry, const struct gn_light *light) {
    if (!(entry->given & GN_LIGHT_COLOR)) memcpy(entry->color, light->color, sizeof entry->color);
    entry->given |= GN_LIGHT_COLOR;
}

/* Intensity is the strongest channel of gn_light's colour, as inspect prints it. A colour keeps it:
 * how bright the colour is does not count. srgb: 0xRRGGBB; below 0: the light's own. */
static void set_color(struct gn_frame_light_opts *entry, int srgb, const struct gn_light *light) {
    begin_color(entry, light);
    const float intensity = strongest_of(entry->color);
    float hue[3];
    memcpy(hue, light->color, sizeof hue);
    for (int k = 0; k < 3 && srgb >= 0; k++) {
        hue[k] = gn_srgb_decode((float)(srgb >> (16 - 8 * k) & 0xff) / 255);
    }
    const float most = strongest_of(hue);
    for (int k = 0; k < 3; k++) entry->color[k] = intensity * (most > 0 ? hue[k] / most : 1);
}

static void set_intensity(struct gn_frame_light_opts *entry, double intensity,
                          const struct gn_light *light) {
    begin_color(entry, light);
    const float now = strongest_of(entry->color),
                to = isnan(intensity) ? strongest_of(light->color) : (float)intensity;
    for (int k = 0; k < 3; k++) entry->color[k] = now > 0 ? entry->color[k] * (to / now) : to;
}

static void set_entry(struct gn_frame_light_opts *entry, const struct gn_override *setting,
                      const struct gn_light *light) {
    const void *value = setting->value;
    const int *whole = value;
    switch (setting->row->offset) {
    case offsetof(struct gn_settings, render.shadow):
        entry->technique = (enum gn_technique)((const struct gn_technique_list *)value)->items[0];
        entry->given |= GN_LIGHT_TECHNIQUE;
        break;
    case offsetof(struct gn_settings, render.map_px):
        entry->map_px = (uint32_t)*whole;
        entry->given |= GN_LIGHT_MAP_PX;
        break;
    case offsetof(struct gn_settings, render.map_format):
        entry->encoding = GN_MAP_FORMAT_ENCODING(*whole);
        entry->moments = GN_MAP_FORMAT_MOMENTS(*whole);
        entry->given |= GN_LIGHT_FORMAT;
        break;
    case offsetof(struct gn_settings, render.taps):
        entry->taps = (uint32_t)*whole;
        entry->given |= GN_LIGHT_TAPS;
        break;
    case offsetof(struct gn_settings, render.cascades):
        entry->cascades = (uint32_t)*whole;
        entry->given |= GN_LIGHT_CASCADES;
        break;
    case offsetof(struct gn_settings, render.cast_faces):
        entry->faces = *whole;
        entry->given |= GN_LIGHT_FACES;
        break;
    case offsetof(struct gn_settings, render.slide_as_picture):
        entry->slide_as_picture = (uint32_t)*whole;
        entry->given |= GN_LIGHT_SLIDE;
        break;
    case offsetof(struct gn_settings, render.shadow_specular):
        entry->specular = isnan(*(const double *)value) ? -1.0f : (float)*(const double *)value;
        entry->given |= GN_LIGHT_SPECULAR;
        break;
    case offsetof(struct gn_settings, render.slide_far_m):
        entry->slide_far_m = isnan(*(const double *)value) ? -1.0f : (float)*(const double *)value;
        entry->given |= GN_LIGHT_SLIDE_FAR;
        break;
    case offsetof(struct gn_settings, render.bias_texels):
        entry->bias_texels = isnan(*(const double *)value) ? -1.0f : (float)*(const double *)value;
        entry->given |= GN_LIGHT_BIAS;
        break;
    case offsetof(struct gn_settings, render.filter_radius_px):
        entry->filter_radius_px =
            isnan(*(const double *)value) ? 0.0f : (float)*(const double *)value;
        entry->given |= GN_LIGHT_FILTER;
        break;
    case offsetof(struct gn_settings, render.shadow_strength):
        entry->strength = (float)*(const double *)value;
        entry->given |= GN_LIGHT_STRENGTH;
        break;
    case offsetof(struct gn_settings, light.radius):
        entry->radius = (float)*(const double *)value;
        entry->given |= GN_LIGHT_RADIUS;
        break;
    case offsetof(struct gn_settings, light.color): set_color(entry, *whole, light); break;
    case offsetof(struct gn_settings, light.intensity):
        set_intensity(entry, *(const double *)value, light);
        break;
    case offsetof(struct gn_settings, light.on):
        if (!*(const bool *)value) entry->given |= GN_LIGHT_OFF;
        break;
    }
}

/* What a mode, a flag or `ctl set` says in [light] is of the made light alone. */
static bool is_overruled(const struct gn_settings *settings, const struct gn_scene *scene,
                         uint32_t light, const struct gn_override *setting) {
    const size_t intensity = offsetof(struct gn_settings, light.intensity),
                 offset = setting->row->offset == intensity
                              ? offsetof(struct gn_settings, light.lux)
                              : setting->row->offset;
    const bool of_made_light =
        setting->row->offset == intensity ||
        (setting->row->section && strcmp(setting->row->section, "light") == 0);
    return of_made_light && scene->added.light && light + 1 == scene->light_count &&
           gn_settings_source(settings, offset) >= GN_SOURCE_MODE;
}

static bool is_given(const struct gn_settings *settings, size_t offset) {
    return gn_settings_source(settings, offset) != GN_SOURCE_DEFAULT;
}

/* What [light] says of the made light. */
static void set_made_light(struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                           const struct gn_scene *scene) {
    const struct gn_light_settings *s = &settings->light;
    const struct gn_light *light = &scene->lights[scene->light_count - 1];
    const bool has_radius = is_given(settings, offsetof(struct gn_settings, light.radius));
    if (!has_radius && s->color < 0 && isnan(s->lux)) return;
    struct gn_frame_light_opts *entry = find_entry(opts, scene->light_count - 1);
    if (!entry) return;
    if (has_radius) {
        entry->radius = (float)s->radius;
        entry->given |= GN_LIGHT_RADIUS;
    }
    if (s->color >= 0) set_color(entry, s->color, light);
    if (!isnan(s->lux)) set_intensity(entry, s->lux, light);
}

static void warn_of_name(const struct gn_light_section *section, const struct gn_scene *scene,
                         struct gn_warnings *warnings) {
    char names[120] = "";
    size_t used = 0;
    for (uint32_t i = 0; i < scene->light_count && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s\"%.40s\"", i ? ", " : "",
                                 scene->lights[i].name);
    gn_warn(warnings, "%s: light \"%s\": the scene has none of that name; it has %s",
            section->label, section->name, names);
}

static bool is_moved(const struct gn_light_settings *s) {
    return !isnan(s->azimuth_deg) || !isnan(s->elevation_deg) || s->follows_camera;
}

/* To the key of the environment, or as it was made. */
static void aim_at_key(struct gn_pose *pose, const struct gn_frame_environment_opts *e) {
    gn_pose_aim(pose, NULL);
    if (!e->of || !e->lights_key) return;
    const float *d = e->of->key.direction, c = cosf(e->turn_rad), s = sinf(e->turn_rad);
    const vec3 along = {-(c * d[0] + s * d[2]), -d[1], -(c * d[2] - s * d[0])};
    gn_pose_aim(pose, along);
}

void gn_stage_aim(struct gn_pose *pose, const struct gn_frame_opts *opts,
                  const struct gn_settings *settings) {
    const struct gn_light_settings *s = &settings->light;
    const struct gn_scene *scene = pose->scene;
    const struct gn_frame_environment_opts *e = &opts->environment;
    const bool moved = is_moved(s);
    if (!scene->added.light || !(moved || pose->aimed || (e->of && e->lights_key))) return;
    aim_at_key(pose, e);
    if (!moved) return;
    vec3 place, along, added = GN_FRAMING_ADDED_BACK;
    gn_pose_light(pose, scene->light_count - 1, place, along);
    float azimuth_rad = atan2f(-along[0], -along[2]), elevation_rad = asinf(-along[1]);
    if (s->follows_camera) azimuth_rad -= atan2f(added[0], added[2]);
    if (!isnan(s->azimuth_deg)) azimuth_rad = glm_rad((float)s->azimuth_deg);
    if (!isnan(s->elevation_deg)) elevation_rad = glm_rad((float)s->elevation_deg);
    if (s->follows_camera) azimuth_rad += gn_frame_camera_azimuth(pose, &opts->view);
    along[0] = -sinf(azimuth_rad) * cosf(elevation_rad);
    along[1] = -sinf(elevation_rad);
    along[2] = -cosf(azimuth_rad) * cosf(elevation_rad);
    gn_pose_aim(pose, along);
}

void gn_stage_set_lights(struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                         const struct gn_scene *scene, struct gn_warnings *warnings) {
    if (scene->added.light) set_made_light(opts, settings, scene);
    for (int s = 0; s < settings->light_count; s++) {
        const struct gn_light_section *section = &settings->lights[s];
        bool found = false;
        for (uint32_t i = 0; i < scene->light_count; i++) {
            if (!gn_light_section_is_of(section, scene, i)) continue;
            found = true;
            struct gn_frame_light_opts *entry = find_entry(opts, i);
            if (!entry) {
                gn_warn(warnings, "%s: settings for more than %d lights: some do without",
                        section->label, GN_ALL_LIGHTS_MAX);
                return;
            }
            for (const struct gn_override *o = section->first; o; o = o->next)
                if (gn_settings_light_holds(settings, o) && !is_overruled(settings, scene, i, o))
                    set_entry(entry, o, &scene->lights[i]);
        }
        if (!found && !settings->several_scenes) warn_of_name(section, scene, warnings);
    }
}

void gn_stage_set_key(struct gn_frame_shadow_opts *opts, const struct gn_scene *scene,
                      const struct gn_environment_key *key, float strength) {
    struct gn_frame_light_opts *entry = find_entry(opts, scene->light_count - 1);
    if (!entry) return;
    entry->radius = key->radius;
    for (int k = 0; k < 3; k++) entry->color[k] = key->color[k] * strength;
    entry->given |= GN_LIGHT_RADIUS | GN_LIGHT_COLOR;
}

bool gn_stage_keeps_key(const struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                        const struct gn_scene *scene, const struct gn_environment_key *key,
                        float strength) {
    bool keeps = false;
    for (uint32_t i = 0; i < opts->light_count; i++) {
        const struct gn_frame_light_opts *entry = &opts->lights[i];
        if (entry->light != scene->light_count - 1) continue;
        keeps = !(entry->given & GN_LIGHT_OFF);
        for (int k = 0; k < 3; k++) keeps &= entry->color[k] == key->color[k] * strength;
    }
    return keeps && !is_moved(&settings->light);
}

void gn_stage_print_light(const struct gn_settings *settings,
                          const struct gn_light_section *section, char *out, size_t size) {
    size_t used = 0;
    out[0] = '\0';
    for (const struct gn_override *o = section->first; o && used < size; o = o->next) {
        char key[64], text[80];
        if (!gn_settings_light_holds(settings, o)) continue;
        gn_value_text(o->row, o->value, text, sizeof text);
        used += (size_t)snprintf(out + used, size - used, "%s%s = %s", used ? ", " : "",
                                 gn_option_key(o->row, key, sizeof key), text);
    }
}
