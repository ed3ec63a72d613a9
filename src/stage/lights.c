#include "stage/lights.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

static void set_entry(struct gn_frame_light_opts *entry, const struct gn_override *setting) {
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
    case offsetof(struct gn_settings, render.light_radius):
        entry->radius = (float)*(const double *)value;
        entry->given |= GN_LIGHT_RADIUS;
        break;
    }
}

/* The radius of a mode, a flag or `ctl set` is that of the made light alone. */
static bool is_overruled(const struct gn_settings *settings, const struct gn_scene *scene,
                         uint32_t light, const struct gn_override *setting) {
    const size_t radius = offsetof(struct gn_settings, render.light_radius);
    return setting->row->offset == radius && scene->added.light &&
           light + 1 == scene->light_count &&
           gn_settings_source(settings, radius) >= GN_SOURCE_MODE;
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

void gn_stage_set_lights(struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                         const struct gn_scene *scene, struct gn_warnings *warnings) {
    if (scene->added.light && gn_settings_given(settings, render.light_radius))
        opts->lights[opts->light_count++] =
            (struct gn_frame_light_opts){.light = scene->light_count - 1,
                                         .given = GN_LIGHT_RADIUS,
                                         .radius = (float)settings->render.light_radius};
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
                    set_entry(entry, o);
        }
        if (!found && !settings->several_scenes) warn_of_name(section, scene, warnings);
    }
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
