#include "stage/lights.h"

#include <assert.h>
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "core/text.h"
#include "options/value.h"

bool gn_light_section_is_of(const struct gn_named_section *section, const struct gn_scene *scene,
                            uint32_t light) {
    const struct gn_light *l = &scene->lights[light];
    return strcmp(section->name, scene->nodes[l->node].name) == 0 ||
           strcmp(section->name, l->name) == 0;
}

struct gn_light_opts *gn_stage_light_entry(struct gn_frame_shadow_opts *opts, uint32_t light) {
    uint32_t i = 0;
    while (i < opts->light_count && opts->lights[i].light != light) i++;
    if (i == GN_ALL_LIGHTS_MAX) return NULL;
    if (i == opts->light_count)
        opts->lights[opts->light_count++] = (struct gn_light_opts){.light = light};
    return &opts->lights[i];
}

static bool is_automatic(const struct gn_option_row *row, const void *value) {
    return (row->kind == GN_KIND_EV && isnan(*(const double *)value)) ||
           (row->kind == GN_KIND_COLOR && *(const int *)value < 0);
}

/* From a value of a setting, by the row's kind, to the field of an entry. */
static void set_entry(struct gn_light_opts *entry, const struct gn_option_row *row,
                      const void *value) {
    /* an automatic radius leaves that of the environment's key, which gn_stage_set_key() gave */
    if (row->target == offsetof(struct gn_light_opts, radius) && is_automatic(row, value)) return;
    union {
        float number;
        int whole;
    } field = {.whole = -1};
    switch (row->kind) {
    case GN_KIND_NUMBER:
    case GN_KIND_EV:
        field.number = is_automatic(row, value) ? -1 : (float)*(const double *)value;
        break;
    case GN_KIND_TECHNIQUES:
        field.whole = ((const struct gn_technique_list *)value)->items[0];
        break;
    case GN_KIND_FLAG: field.whole = *(const bool *)value; break;
    case GN_KIND_INT:
    case GN_KIND_CHOICE:
    case GN_KIND_COLOR: field.whole = *(const int *)value; break;
    default: assert(!"a kind of values that lights have");
    }
    memcpy((char *)entry + row->target, &field, sizeof field);
    entry->given |= 1u << row->target / sizeof field;
}

static bool is_of_made_light(const struct gn_option_row *row) {
    return gn_option_is_of(row, "light");
}

/* A mode, a flag or `ctl set` sets a key of [light] for the made light alone. */
static bool is_overruled(const struct gn_settings *settings, const struct gn_scene *scene,
                         uint32_t light, const struct gn_option_row *row) {
    bool overruled = false;
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        overruled |= gn_option_rows[i].target == row->target &&
                     is_of_made_light(&gn_option_rows[i]) && settings->source[i] >= GN_SOURCE_MODE;
    return overruled && scene->added.light && light + 1 == scene->light_count;
}

/* Settings without a light's name: of all lights, or of the made one. */
static void set_all(struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                    const struct gn_scene *scene) {
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        const void *value = gn_settings_value(settings, row);
        const bool of_made = is_of_made_light(row);
        if (!row->target || settings->source[i] == GN_SOURCE_DEFAULT || is_automatic(row, value) ||
            (of_made && !scene->added.light))
            continue;
        struct gn_light_opts *entry =
            of_made ? gn_stage_light_entry(opts, scene->light_count - 1) : &opts->any;
        if (entry) set_entry(entry, row, value);
    }
}

static void warn_of_name(const struct gn_named_section *section, const struct gn_scene *scene,
                         struct gn_warnings *warnings) {
    char names[120] = "";
    for (uint32_t i = 0; i < scene->light_count; i++)
        gn_text_add(names, sizeof names, "%s\"%.40s\"", i ? ", " : "", scene->lights[i].name);
    gn_warn(warnings, "%s: light \"%s\": the scene has none of that name; it has %s",
            section->label, section->name, names);
}

static bool is_moved(const struct gn_light_settings *s) {
    return !isnan(s->azimuth_deg) || !isnan(s->elevation_deg) || s->follows_camera;
}

/* To the key of the environment, or as it was made. */
static void aim_at_key(struct gn_pose *pose, const struct gn_frame_environment_opts *e) {
    gn_pose_aim(pose, pose->scene->light_count - 1, NULL);
    if (!e->of || !e->lights_key) return;
    const float *d = e->of->key.direction, c = cosf(e->turn_rad), s = sinf(e->turn_rad);
    const vec3 along = {-(c * d[0] + s * d[2]), -d[1], -(c * d[2] - s * d[0])};
    gn_pose_aim(pose, pose->scene->light_count - 1, along);
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
    gn_pose_aim(pose, pose->scene->light_count - 1, along);
}

void gn_stage_set_lights(struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                         const struct gn_scene *scene, struct gn_warnings *warnings) {
    set_all(opts, settings, scene);
    for (int s = 0; s < settings->light_count; s++) {
        const struct gn_named_section *section = &settings->lights[s];
        bool found = false;
        for (uint32_t i = 0; i < scene->light_count; i++) {
            if (!gn_light_section_is_of(section, scene, i)) continue;
            found = true;
            struct gn_light_opts *entry = gn_stage_light_entry(opts, i);
            if (!entry) {
                gn_warn(warnings, "%s: settings for more than %d lights: some do without",
                        section->label, GN_ALL_LIGHTS_MAX);
                return;
            }
            for (const struct gn_override *o = section->first; o; o = o->next)
                if (gn_settings_light_holds(settings, o) &&
                    !is_overruled(settings, scene, i, o->row))
                    set_entry(entry, o->row, o->value);
        }
        if (!found && !settings->several_scenes) warn_of_name(section, scene, warnings);
    }
}

void gn_stage_set_key(struct gn_frame_shadow_opts *opts, const struct gn_scene *scene,
                      const struct gn_environment_key *key, float strength) {
    struct gn_light_opts *entry = gn_stage_light_entry(opts, scene->light_count - 1);
    if (!entry) return;
    GN_LIGHT_SET(entry, radius, key->radius);
    entry->given |= GN_LIGHT_GIVEN(color);
    for (int k = 0; k < 3; k++) entry->color[k] = key->color[k] * strength;
}

bool gn_stage_keeps_key(const struct gn_frame_shadow_opts *opts, const struct gn_settings *settings,
                        const struct gn_scene *scene) {
    const uint32_t changing = GN_LIGHT_GIVEN(hue) | GN_LIGHT_GIVEN(intensity);
    bool keeps = false;
    for (uint32_t i = 0; i < opts->light_count; i++) {
        const struct gn_light_opts *entry = &opts->lights[i];
        if (entry->light != scene->light_count - 1) continue;
        keeps = !(entry->given & changing) && (entry->on || !GN_LIGHT_HAS(entry, on));
    }
    return keeps && !is_moved(&settings->light);
}

void gn_stage_print_light(const struct gn_settings *settings,
                          const struct gn_named_section *section, char *out, size_t size) {
    out[0] = '\0';
    for (const struct gn_override *o = section->first; o; o = o->next) {
        char key[64], text[80];
        if (!gn_settings_light_holds(settings, o)) continue;
        gn_value_text(o->row, o->value, text, sizeof text);
        gn_text_add(out, size, "%s%s = %s", out[0] ? ", " : "",
                    gn_option_key(o->row, key, sizeof key), text);
    }
}
