#include <jansson.h>
#include <math.h>
#include <stdio.h>

#include "cli/inspect.h"
#include "cli/units.h"
#include "core/json.h"
#include "core/text.h"
#include "options/date.h"
#include "stage/lights.h"
#include "stage/sun.h"

static double max_channel(const struct gn_light *light) {
    return (double)fmaxf(light->color[0], fmaxf(light->color[1], light->color[2]));
}

static bool is_made(bool made, uint32_t i, uint32_t count) { return made && i + 1 == count; }

/* As it is used, if it is made. */
static const struct gn_light *light_of(const struct gn_inspection *in, uint32_t i) {
    const struct gn_scene *s = in->scene;
    return is_made(s->added.light, i, s->light_count) ? &in->made_light : &s->lights[i];
}

/* What the configuration says of that light: of each section that is of it. */
static void print_settings(const struct gn_inspection *in, uint32_t light, char *out, size_t size) {
    const struct gn_settings *s = in->settings;
    out[0] = '\0';
    for (int i = 0; s && i < s->light_count; i++) {
        char text[300];
        if (!gn_light_section_is_of(&s->lights[i], in->scene, light)) continue;
        gn_stage_print_light(s, &s->lights[i], text, sizeof text);
        if (text[0]) gn_text_add(out, size, "%s%s", out[0] ? ", " : "", text);
    }
}

/* What the file has, without the floor, the light and the camera that are made. */
struct counts {
    uint32_t nodes, items, batches, geometries, vertices, textures, images;
    uint64_t triangles;
};

/* The made floor has one item, geometry and node, and a texture if it is occluded: its last. */
static struct counts count_parts(const struct gn_scene *s) {
    const uint32_t floor = s->added.floor;
    uint32_t occluded = 0;
    for (uint32_t i = 0; i < s->material_count; i++)
        occluded |= s->materials[i].shadow_catcher &&
                    s->materials[i].textures[GN_TEXTURE_OCCLUSION].texture >= 0;
    return (struct counts){
        .nodes = s->node_count - floor - s->added.light - s->added.camera,
        .items = s->item_count - floor,
        .batches = s->batch_count - floor,
        .geometries = s->geometry_count - floor,
        .vertices = s->buffers.vertex_count - 4 * floor,
        .triangles = s->triangle_count - 2 * floor,
        .textures = s->pictures.texture_count - occluded,
        .images = s->pictures.image_count - occluded,
    };
}

struct kinds {
    uint32_t all, alpha[3], unlit, double_sided;
};

static struct kinds count_kinds(const struct gn_scene *scene) {
    struct kinds k = {.all = scene->material_count - scene->added.floor};
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (scene->materials[i].shadow_catcher) continue;
        k.alpha[scene->materials[i].alpha]++;
        k.unlit += scene->materials[i].unlit;
        k.double_sided += scene->materials[i].double_sided;
    }
    return k;
}

static void get_scene_size(const struct gn_scene *scene, vec3 out) {
    for (int k = 0; k < 3; k++) out[k] = fmaxf(0.0f, scene->box.max[k] - scene->box.min[k]);
}

/* ---- for people ---------------------------------------------------------------------------- */

static void print_image(FILE *to, uint32_t i, const struct gn_image *image) {
    char packed[48] = "";
    if (image->levels)
        snprintf(packed, sizeof packed, ", %s, %u level%s", gn_packing_names[image->packing],
                 image->level_count, image->level_count == 1 ? "" : "s");
    gn_text_print_line(to, "%-3u %ux%u%s%s, %.2f MB", i, image->width_px, image->height_px,
                       image->has_alpha ? " with alpha" : "", packed,
                       GN_MB(gn_scene_image_bytes(image)));
}

/* "10:09 to 16:06" by the clock of time_zone; "" without a place. */
static void print_day(const struct gn_settings *o, double utc_s, char *out, size_t size) {
    static const char *const kinds[] = {
        [GN_SUN_STAYS_UP] = ", up all day", [GN_SUN_STAYS_DOWN] = ", down all day"};
    struct gn_place place;
    char rise[64] = "", set[64] = "";
    if (!gn_stage_sun_place(o, &place)) return;
    const struct gn_sun_day day = gn_sun_day(utc_s, &place);
    if (!isnan(day.rise_s)) gn_date_print(day.rise_s, o->sun.time_zone, rise, sizeof rise);
    if (!isnan(day.set_s)) gn_date_print(day.set_s, o->sun.time_zone, set, sizeof set);
    if (day.kind != GN_SUN_RISES)
        snprintf(out, size, "%s", kinds[day.kind]);
    else
        snprintf(out, size, "%s%s%s%s", rise[0] ? ", rises " : "", rise, set[0] ? ", sets " : "",
                 set);
}

static void print_sun(const struct gn_inspection *in, FILE *to) {
    const struct gn_settings *o = in->settings;
    char moment[96] = "", day[160] = "";
    double utc_s;
    struct gn_err err = {0};
    if (!o || !gn_stage_sun_is_set(o) || !gn_stage_sun_time(o, &utc_s, &err)) return;
    const int light = gn_stage_sun_light(in->scene);
    const struct gn_sun_view view = gn_stage_sun_view(o, utc_s);
    gn_stage_sun_print(o, utc_s, moment, sizeof moment);
    print_day(o, utc_s, day, sizeof day);
    fprintf(to, "\nSun\n");
    gn_text_print_line(to, "    %s%sazimuth %.2f, altitude %.2f degrees%s%s%s", moment,
                       moment[0] ? ": " : "", view.azimuth_deg, view.altitude_deg, day,
                       light < 0 ? "; no light can be it" : "; it is the light ",
                       light < 0 ? "" : in->scene->lights[light].name);
}

static void print_clips(const struct gn_scene *s, FILE *to) {
    if (s->animation.clip_count) fprintf(to, "\nClips\n");
    for (uint32_t i = 0; i < s->animation.clip_count; i++) {
        gn_text_print_line(to, "%-3u %s: %.3f s, %u channel%s, %s", i, s->animation.clips[i].name,
                           (double)s->animation.clips[i].duration_ns * 1e-9,
                           s->animation.clips[i].channel_count,
                           s->animation.clips[i].channel_count == 1 ? "" : "s",
                           s->animation.clips[i].on_by_default ? "on" : "off");
        const struct gn_channel *channel =
            &s->animation.channels[s->animation.clips[i].first_channel];
        for (uint32_t k = 0; k < s->animation.clips[i].channel_count; k++, channel++)
            if (channel->path == GN_ANIM_RECORD)
                gn_text_print_line(to, "    moves %s", channel->pointer);
    }
}

static void print_lists(const struct gn_inspection *in, FILE *to) {
    const struct gn_scene *s = in->scene;
    const struct counts n = count_parts(s);
    if (n.images) fprintf(to, "\nTextures: %u of %u images\n", n.textures, n.images);
    for (uint32_t i = 0; i < n.images; i++) print_image(to, i, &s->pictures.images[i]);
    fprintf(to, "\nLights\n");
    for (uint32_t i = 0; i < s->light_count; i++) {
        const struct gn_light *light = light_of(in, i);
        char cone[64] = "", range[32] = "", map[32] = "", slide[32] = "";
        if (gn_light_types[light->type].has_cone)
            snprintf(cone, sizeof cone, ", cone %.3g to %.3g degrees", GN_DEG(light->inner_rad),
                     GN_DEG(light->outer_rad));
        if (light->range_m > 0)
            snprintf(range, sizeof range, ", range %.4g m", (double)light->range_m);
        if (light->map_px) snprintf(map, sizeof map, ", map %u px", light->map_px);
        if (light->slide >= 0) snprintf(slide, sizeof slide, ", slide texture %d", light->slide);
        gn_text_print_line(
            to, "%-3u %s: %s, %.4g %s%s%s, shadow %s%s, radius %.3g, strength %.3g%s%s", i,
            light->name, gn_light_types[light->type].name, max_channel(light),
            gn_light_types[light->type].unit, cone, range,
            light->technique ? light->technique : "by mode", map, (double)light->radius,
            (double)light->shadow_strength, slide,
            is_made(s->added.light, i, s->light_count) ? " (made: the file has none)" : "");
        char own[320];
        print_settings(in, i, own, sizeof own);
        if (own[0]) gn_text_print_line(to, "    by the configuration: %s", own);
    }
    print_sun(in, to);
    fprintf(to, "\nCameras\n");
    for (uint32_t i = 0; i < s->camera_count; i++) {
        const struct gn_camera *c = &s->cameras[i];
        char lens[64], far[32] = "infinity", drawn[80] = "";
        if (c->orthographic)
            snprintf(lens, sizeof lens, "orthographic, %.4g m high", 2 * (double)c->ymag_m);
        else
            snprintf(lens, sizeof lens, "perspective, %.3g degrees high", GN_DEG(c->yfov_rad));
        if (c->far_m > 0) snprintf(far, sizeof far, "%.4g m", (double)c->far_m);
        if (i < GN_INSPECT_CAMERAS && in->depths_m[i][0] > c->near_m)
            snprintf(drawn, sizeof drawn, ", near plane at %.4g m: nothing is nearer in view",
                     (double)in->depths_m[i][0]);
        gn_text_print_line(
            to, "%-3u %s: %s, from %.4g m to %s%s%s", i, c->name, lens, (double)c->near_m, far,
            drawn,
            is_made(s->added.camera, i, s->camera_count) ? " (made: the file has none)" : "");
    }
    print_clips(s, to);
    if (s->variants.count) fprintf(to, "\nVariants of materials\n");
    for (uint32_t i = 0; i < s->variants.count; i++)
        gn_text_print_line(to, "%-3u %s", i, s->variants.names[i]);
}

static void print_scene(const struct gn_inspection *in, FILE *to) {
    const struct gn_scene *s = in->scene;
    const struct kinds k = count_kinds(s);
    const struct counts n = count_parts(s);
    vec3 size;
    get_scene_size(s, size);
    fprintf(to, "Scene\n");
    gn_text_print_line(to, "%-11s %s", "file", in->file);
    if (s->name && s->name[0]) gn_text_print_line(to, "%-11s %s", "name", s->name);
    gn_text_print_line(to, "%-11s %.4g x %.4g x %.4g m", "size", (double)size[0], (double)size[1],
                       (double)size[2]);
    const double *origin = s->place.origin;
    if (origin[0] != 0 || origin[1] != 0 || origin[2] != 0)
        gn_text_print_line(to, "%-11s far from the file's: drawn around %.10g %.10g %.10g", "place",
                           origin[0], origin[1], origin[2]);
    gn_text_print_line(to, "%-11s %u", "nodes", n.nodes);
    gn_text_print_line(to, "%-11s %u in %u batches, %u of them instances", "items", n.items,
                       n.batches, s->instance_count);
    gn_text_print_line(to, "%-11s %u geometries, %u vertices, %llu triangles in all items",
                       "meshes", n.geometries, n.vertices, (unsigned long long)n.triangles);
    if (s->deformation.width > 0)
        gn_text_print_line(to, "%-11s %u skins, %u joints, %u morph targets, %.2f MB of deltas",
                           "posed", s->deformation.skin_count, s->deformation.joint_count,
                           s->deformation.weight_count, GN_MB(gn_scene_deformation_bytes(s)));
    gn_text_print_line(to, "%-11s %u: %u opaque, %u mask, %u blend; %u unlit, %u double-sided",
                       "materials", k.all, k.alpha[GN_ALPHA_OPAQUE], k.alpha[GN_ALPHA_MASK],
                       k.alpha[GN_ALPHA_BLEND], k.unlit, k.double_sided);
    if (s->added.floor)
        gn_text_print_line(to, "%-11s unseen, for shadows (made: the file has none)", "floor");
    if (s->missing && s->missing[0]) gn_text_print_line(to, "%-11s %s", "missing", s->missing);
    const float *colors[] = {s->environment.sky, s->environment.ground, s->environment.background};
    static const char *const names[] = {"sky", "ground", "background"};
    for (int i = 0; i < 3; i++)
        gn_text_print_line(to, "%-11s %.3g %.3g %.3g", names[i], (double)colors[i][0],
                           (double)colors[i][1], (double)colors[i][2]);
}

static void print_cost(const struct gn_inspection *in, FILE *to) {
    const struct gn_scene_memory *memory = &in->scene->memory;
    const struct gn_scene_cost *c = &in->cost;
    fprintf(to, "\nCost at %dx%d through the first camera\n", GN_INSPECT_WIDTH_PX,
            GN_INSPECT_HEIGHT_PX);
    gn_text_print_line(to, "%-11s %u passes, %u draw calls, %llu triangles; %u items out of sight",
                       "picture", c->passes, c->draws, (unsigned long long)c->triangles, c->culled);
    gn_text_print_line(to, "%-11s %u passes, %u draw calls, %llu triangles, when something moves",
                       "shadows", c->shadow_passes, c->shadow_draws,
                       (unsigned long long)c->shadow_triangles);
    gn_text_print_line(to, "%-11s %u", "programs", c->programs);
    gn_text_print_line(
        to, "%-11s %.2f MB vertices, %.2f indices, %.2f textures, %.2f maps, %.2f picture",
        "GPU memory", GN_MB(c->vertex_bytes), GN_MB(c->index_bytes), GN_MB(c->texture_bytes),
        GN_MB(c->map_bytes), GN_MB(c->target_bytes));
    gn_text_print_line(to, "%-11s %.2f MB, while it is loaded up to %.2f MB", "memory",
                       GN_MB(memory->bytes), GN_MB(memory->loading_bytes));
    if (in->limits[0]) gn_text_print_line(to, "%-11s %s", "limits", in->limits);
}

static void print_problems(const struct gn_inspection *in, FILE *to) {
    const int warnings = in->warnings ? in->warnings->count : 0;
    fprintf(to, "\nProblems\n");
    if (!warnings && !in->advice.count) gn_text_print_line(to, "nothing");
    for (int i = 0; i < warnings; i++) gn_text_print_line(to, "- %s", in->warnings->text[i]);
    if (warnings && in->warnings->dropped)
        gn_text_print_line(to, "- and %d more like these", in->warnings->dropped);
    for (uint32_t i = 0; i < in->advice.count; i++) {
        gn_text_print_line(to, "- %s", in->advice.items[i].what);
        gn_text_print_line(to, "  cure: %s", in->advice.items[i].cure);
    }
    if (in->advice.dropped) gn_text_print_line(to, "- and %u more like these", in->advice.dropped);
}

void gn_inspect_print(const struct gn_inspection *in, FILE *to) {
    print_scene(in, to);
    print_lists(in, to);
    print_cost(in, to);
    if (in->time) gn_inspect_time_print(in->time, to);
    print_problems(in, to);
}

/* ---- for programs -------------------------------------------------------------------------- */

static json_t *number_or_null(bool present, double value) {
    return present ? gn_json_make_number(value) : json_null();
}
static json_t *vector_json(const float *v) {
    return json_pack("[ooo]", gn_json_make_number((double)v[0]), gn_json_make_number((double)v[1]),
                     gn_json_make_number((double)v[2]));
}

static json_t *light_json(const struct gn_inspection *in, uint32_t i) {
    const struct gn_scene *s = in->scene;
    char own[320];
    print_settings(in, i, own, sizeof own);
    const struct gn_light *l = light_of(in, i);
    double strongest = max_channel(l);
    bool spot = gn_light_types[l->type].has_cone;
    vec3 color;
    for (int k = 0; k < 3; k++) color[k] = strongest > 0 ? l->color[k] / (float)strongest : 0.0f;
    return json_pack("{so ss so ss so so so so so so so so so sb so}", "name",
                     gn_json_make_text(l->name), "type", gn_light_types[l->type].name, "intensity",
                     gn_json_make_number(strongest), "unit", gn_light_types[l->type].unit, "color",
                     vector_json(color), "range_m", number_or_null(l->range_m > 0, l->range_m),
                     "inner_deg", number_or_null(spot, GN_DEG(l->inner_rad)), "outer_deg",
                     number_or_null(spot, GN_DEG(l->outer_rad)), "gnomon_shadow",
                     gn_json_make_text(l->technique), "gnomon_map_px",
                     l->map_px ? gn_json_make_count(l->map_px) : json_null(), "gnomon_radius",
                     gn_json_make_number(l->radius), "gnomon_shadow_strength",
                     gn_json_make_number(l->shadow_strength), "gnomon_slide",
                     l->slide >= 0 ? gn_json_make_count((uint64_t)l->slide) : json_null(), "made",
                     is_made(s->added.light, i, s->light_count), "settings",
                     gn_json_make_text(own[0] ? own : NULL));
}

/* The description in inspect.h up to the materials. */
static json_t *content_json(const struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    const struct kinds k = count_kinds(s);
    const struct counts n = count_parts(s);
    vec3 size;
    get_scene_size(s, size);
    json_t *counts = json_pack(
        "{so so so so so so so so so so so}", "nodes", gn_json_make_count(n.nodes), "items",
        gn_json_make_count(n.items), "instances", gn_json_make_count(s->instance_count), "batches",
        gn_json_make_count(n.batches), "geometries", gn_json_make_count(n.geometries), "vertices",
        gn_json_make_count(n.vertices), "triangles", gn_json_make_count(n.triangles), "textures",
        gn_json_make_count(n.textures), "skins", gn_json_make_count(s->deformation.skin_count),
        "joints", gn_json_make_count(s->deformation.joint_count), "targets",
        gn_json_make_count(s->deformation.weight_count));
    json_t *materials =
        json_pack("{so so so so so so}", "count", gn_json_make_count(k.all), "opaque",
                  gn_json_make_count(k.alpha[GN_ALPHA_OPAQUE]), "mask",
                  gn_json_make_count(k.alpha[GN_ALPHA_MASK]), "blend",
                  gn_json_make_count(k.alpha[GN_ALPHA_BLEND]), "unlit", gn_json_make_count(k.unlit),
                  "double_sided", gn_json_make_count(k.double_sided));
    return json_pack("{so so so so so sb}", "file", gn_json_make_text(in->file), "name",
                     gn_json_make_text(s->name), "size_m", vector_json(size), "counts", counts,
                     "materials", materials, "floor_made", s->added.floor);
}

static void add_lists(json_t *all, const struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    json_t *images = json_array(), *lights = json_array(), *cameras = json_array();
    json_t *clips = json_array(), *variants = json_array();
    for (uint32_t i = 0; i < count_parts(s).images; i++) {
        const struct gn_image *image = &s->pictures.images[i];
        json_array_append_new(images, json_pack("{so so sb so ss so}", "width_px",
                                                gn_json_make_count(image->width_px), "height_px",
                                                gn_json_make_count(image->height_px), "alpha",
                                                image->has_alpha, "bytes",
                                                gn_json_make_count(gn_scene_image_bytes(image)),
                                                "format", gn_packing_names[image->packing],
                                                "levels", gn_json_make_count(image->level_count)));
    }
    for (uint32_t i = 0; i < s->light_count; i++) json_array_append_new(lights, light_json(in, i));
    for (uint32_t i = 0; i < s->camera_count; i++) {
        const struct gn_camera *c = &s->cameras[i];
        json_array_append_new(
            cameras, json_pack("{so ss so so so so so sb}", "name", gn_json_make_text(c->name),
                               "type", c->orthographic ? "orthographic" : "perspective", "yfov_deg",
                               number_or_null(!c->orthographic, GN_DEG(c->yfov_rad)),
                               "half_height_m", number_or_null(c->orthographic, c->ymag_m),
                               "near_m", gn_json_make_number(c->near_m), "far_m",
                               number_or_null(c->far_m > 0, c->far_m), "drawn_near_m",
                               number_or_null(i < GN_INSPECT_CAMERAS,
                                              in->depths_m[i < GN_INSPECT_CAMERAS ? i : 0][0]),
                               "made", is_made(s->added.camera, i, s->camera_count)));
    }
    for (uint32_t i = 0; i < s->animation.clip_count; i++) {
        const struct gn_clip *c = &s->animation.clips[i];
        json_array_append_new(
            clips, json_pack("{so so so sb}", "name", gn_json_make_text(c->name), "duration_s",
                             gn_json_make_number((double)c->duration_ns * 1e-9), "channels",
                             gn_json_make_count(c->channel_count), "on", c->on_by_default));
    }
    json_object_set_new(all, "images", images);
    json_object_set_new(all, "lights", lights);
    json_object_set_new(all, "cameras", cameras);
    json_object_set_new(all, "clips", clips);
    for (uint32_t i = 0; i < s->variants.count; i++)
        json_array_append_new(variants, gn_json_make_text(s->variants.names[i]));
    json_object_set_new(all, "variants", variants);
}

bool gn_inspect_print_json(const struct gn_inspection *in, FILE *to, struct gn_err *err) {
    const struct gn_scene *s = in->scene;
    const struct gn_scene_cost *c = &in->cost;
    json_t *all = content_json(in);
    add_lists(all, in);
    json_object_set_new(all, "hemisphere",
                        json_pack("{so so so}", "sky", vector_json(s->environment.sky), "ground",
                                  vector_json(s->environment.ground), "background",
                                  vector_json(s->environment.background)));
    json_t *cost = json_pack(
        "{si si so so so so so so so so so so so so so so so}", "width_px", GN_INSPECT_WIDTH_PX,
        "height_px", GN_INSPECT_HEIGHT_PX, "passes", gn_json_make_count(c->passes), "shadow_passes",
        gn_json_make_count(c->shadow_passes), "draws", gn_json_make_count(c->draws), "shadow_draws",
        gn_json_make_count(c->shadow_draws), "programs", gn_json_make_count(c->programs), "culled",
        gn_json_make_count(c->culled), "triangles", gn_json_make_count(c->triangles),
        "shadow_triangles", gn_json_make_count(c->shadow_triangles), "vertex_bytes",
        gn_json_make_count(c->vertex_bytes), "index_bytes", gn_json_make_count(c->index_bytes),
        "texture_bytes", gn_json_make_count(c->texture_bytes), "map_bytes",
        gn_json_make_count(c->map_bytes), "target_bytes", gn_json_make_count(c->target_bytes),
        "memory_bytes", gn_json_make_count(s->memory.bytes), "loading_bytes",
        gn_json_make_count(s->memory.loading_bytes));
    json_object_set_new(all, "cost", cost);
    if (in->time) json_object_set_new(all, "time", gn_inspect_time_json(in->time));
    json_object_set_new(all, "limits", gn_json_make_text(in->limits));
    json_object_set_new(all, "missing", gn_json_make_text(s->missing));

    json_t *warnings = json_array();
    for (int i = 0; in->warnings && i < in->warnings->count; i++)
        json_array_append_new(warnings, gn_json_make_text(in->warnings->text[i]));
    json_object_set_new(all, "warnings", warnings);
    json_object_set_new(all, "warnings_dropped",
                        json_integer(in->warnings ? in->warnings->dropped : 0));
    json_object_set_new(all, "advice", gn_problem_json(&in->advice));
    json_object_set_new(all, "advice_dropped", gn_json_make_count(in->advice.dropped));
    return gn_json_print(all, 7, to, err);
}
