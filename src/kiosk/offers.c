#include "kiosk/offers.h"

#include <string.h>

#include "core/file.h"
#include "core/text.h"

/* From the command line or `ctl set`: it beats what a mode says. A scene of `ctl scene` has taken
 * the value, not the source. */
static bool is_fixed(const struct gn_settings *s, const char *value, size_t offset) {
    return value && gn_settings_source(s, offset) >= GN_SOURCE_FLAG;
}
static bool has_fixed_camera(const struct gn_settings *s) {
    return is_fixed(s, s->scene.camera, offsetof(struct gn_settings, scene.camera));
}
static bool has_fixed_variant(const struct gn_settings *s) {
    return is_fixed(s, s->scene.variant, offsetof(struct gn_settings, scene.variant));
}

/* ---- the list ---- */

static bool has_name(const struct gn_offers *out, const char *name) {
    for (int i = 0; i < out->count; i++)
        if (strcmp(out->items[i].name, name) == 0) return true;
    return false;
}

/* Without a name, or with one that another has: by kind and number, from 1. */
static struct gn_offer *add_offer(struct gn_offers *out, const char *name, const char *kind,
                                  int number) {
    static struct gn_offer none;
    if (out->count == GN_KIOSK_MODES_MAX) return &none;
    struct gn_offer *c = &out->items[out->count];
    *c = (struct gn_offer){.camera = -1, .variant = -1, .scene = -1};
    if (name && *name)
        gn_text_format(c->name, sizeof c->name, "%.60s", name);
    else
        gn_text_format(c->name, sizeof c->name, "%s %d", kind, number);
    while (has_name(out, c->name)) {
        char taken[sizeof c->name];
        memcpy(taken, c->name, sizeof taken);
        gn_text_format(c->name, sizeof c->name, "%.48s (%d)", taken, number);
    }
    out->count++;
    return c;
}

/* The file's name without its last dot and what follows. */
static struct gn_offer *add_scene(struct gn_offers *out, const struct gn_offers_of *of, int place) {
    char name[64];
    const char *path = of->paths[place];
    gn_text_format(name, sizeof name, "%.60s", path ? gn_file_name(path) : "default scene");
    char *dot = strrchr(name, '.');
    if (dot && dot > name) *dot = '\0';
    return add_offer(out, name, "Scene", place + 1);
}

/* ---- cameras ---- */

/* The number of the camera that the settings name; -1: they name a view that no camera has. */
static int find_first_camera(const struct gn_offers_of *of) {
    const char *name = of->settings->scene.camera;
    if (name && strcmp(name, "auto") == 0) return -1;
    const int found = gn_scene_find_camera(of->scene, name, NULL);
    if (found >= 0) return found;
    return strncmp(name, "light:", 6) == 0 ? -1 : 0;
}

static void add_cameras(struct gn_offers *out, const struct gn_offers_of *of) {
    const int first = find_first_camera(of);
    if (first < 0) add_scene(out, of, of->shown);
    for (int i = 0; i < (int)of->scene->camera_count && out->count < GN_KIOSK_MODES_MAX; i++) {
        if (i == first) out->first = out->count;
        add_offer(out, of->scene->cameras[i].name, "Camera", i + 1)->camera = i;
    }
}

/* ---- scenes ---- */

/* From the one that is shown round to the one before it, so that both directions are right. */
static void add_scenes(struct gn_offers *out, const struct gn_offers_of *of) {
    if (out->count == 0) add_scene(out, of, of->shown);
    out->home = out->first;
    for (int i = 1; i < of->path_count && out->count < GN_KIOSK_MODES_MAX; i++) {
        const int place = (of->shown + i) % of->path_count;
        if (place == 0) out->home = out->count;
        add_scene(out, of, place)->scene = place;
    }
}

/* ---- variants ---- */

/* The variant that looks as the file does without any; -1: none does. */
static int find_plain_variant(const struct gn_scene *scene) {
    for (uint32_t v = 0; v < scene->variants.count; v++) {
        bool same = true;
        for (uint32_t i = 0; same && i < scene->item_count; i++) {
            const uint64_t hidden_in = scene->items[i].hidden_in;
            same = (hidden_in & 1) == (hidden_in >> (v + 1) & 1);
        }
        if (same) return (int)v;
    }
    return -1;
}

static void add_variants(struct gn_offers *out, const struct gn_offers_of *of) {
    const char *name = of->settings->scene.variant;
    const bool named = name && strcmp(name, "auto") != 0;
    int first = named ? gn_scene_find_variant(of->scene, name, NULL) : -1;
    if (first < 0) first = find_plain_variant(of->scene);
    if (first < 0) add_scene(out, of, of->shown);
    for (int i = 0; i < (int)of->scene->variants.count && out->count < GN_KIOSK_MODES_MAX; i++) {
        if (i == first) out->first = out->count;
        add_offer(out, of->scene->variants.names[i], "Variant", i + 1)->variant = i;
    }
}

/* ---- clip, turntable ---- */

static void add_clip(struct gn_offers *out, const struct gn_offers_of *of) {
    const struct gn_scene *scene = of->scene;
    const int clip = scene->animation.clip_count == 1 ? 0 : of->clips;
    const char *name = clip >= 0 ? scene->animation.clips[clip].name : "";
    if (name[0])
        add_offer(out, name, "Clip", clip + 1);
    else
        add_scene(out, of, of->shown);
    out->replays = true;
}

static void add_turntable(struct gn_offers *out, const struct gn_settings *settings) {
    const bool turns = settings->scene.turntable_deg_s != 0.0;
    add_offer(out, turns ? "turning" : "still", "", 0);
    add_offer(out, turns ? "still" : "turning", "", 0)->turns = true;
}

void gn_offers_build(const struct gn_offers_of *of, struct gn_offers *out) {
    const struct gn_settings *settings = of->settings;
    *out = (struct gn_offers){0};
    if (of->scene->camera_count > 1 && !has_fixed_camera(settings)) add_cameras(out, of);
    if (of->path_count > 1) {
        add_scenes(out, of);
        return;
    }
    if (out->count == 0 && of->scene->variants.count > 1 && !has_fixed_variant(settings))
        add_variants(out, of);
    if (out->count == 0 && of->scene->animation.clip_count > 0 && of->clips != GN_POSE_NONE)
        add_clip(out, of);
    if (out->count == 0 && gn_settings_from(settings, scene.turntable_deg_s) < GN_SOURCE_FLAG)
        add_turntable(out, settings);
    if (out->count == 0) add_scene(out, of, of->shown);
    out->home = out->first;
}

const char *gn_offer_title(const struct gn_offer *offer) {
    if (strcmp(offer->name, "turning") == 0) return "Turning";
    return strcmp(offer->name, "still") == 0 ? "Standing still" : offer->name;
}

void gn_offer_apply(const struct gn_offer *offer, const struct gn_settings *settings,
                    const struct gn_scene *scene, struct gn_stage_look *look) {
    struct gn_frame_view_opts *view = &look->frame_opts.view;
    if (offer->camera >= 0 && offer->camera < (int)scene->camera_count &&
        !has_fixed_camera(settings)) {
        view->camera = offer->camera;
        view->light_plus_1 = 0;
        view->framing.made_plus_1 = 0;
    }
    if (offer->variant >= 0 && offer->variant < (int)scene->variants.count &&
        !has_fixed_variant(settings))
        look->variant = offer->variant;
}
