/* What is wrong with a scene, or dearer than it need be, each with its cure: one function for each
 * thing to look at. None of this stops a scene from being shown. */
#include <stdarg.h>

#include "cli/inspect.h"
#include "cli/units.h"
#include "core/text.h"
#include "frame/plan.h"

enum { TEXTURE_MAX_PX = 4096, TRIANGLES_MAX = 500000, DRAWS_MAX = 500, TEXTURES_MAX_MB = 256 };
#define SIZE_MIN_M   0.05f
#define SIZE_MAX_M   2000.0f
#define CONE_MAX_DEG 80.0f
#define DEPTH_RATIO  1e6f
#define PLURAL(n)    ((n) == 1 ? "" : "s")

__attribute__((format(printf, 3, 4))) static void advise(struct gn_inspection *in, const char *cure,
                                                         const char *what, ...) {
    if (in->advice_count == GN_INSPECT_ADVICE) {
        in->advice_dropped++;
        return;
    }
    struct gn_advice *advice = &in->advice[in->advice_count++];
    va_list args;
    va_start(args, what);
    gn_text_vformat(advice->what, sizeof advice->what, what, args);
    va_end(args);
    snprintf(advice->cure, sizeof advice->cure, "%s", cure);
}

/* ---- the whole ----------------------------------------------------------------------------- */

static void check_size(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    if (!s->item_count) {
        advise(in, "export the meshes too, or check what was selected", "there is nothing to draw");
        return;
    }
    float size = glm_vec3_distance((float *)s->box.min, (float *)s->box.max);
    if (size < SIZE_MIN_M)
        advise(in, "lengths are metres: scale it up, or apply the scale on export",
               "the whole scene is only %.3g m across", (double)size);
    else if (size > SIZE_MAX_M)
        advise(in, "lengths are metres: scale it down, or take away what lies far off",
               "the scene is %.4g m across: shadow maps get coarse", (double)size);
}

static void check_amounts(struct gn_inspection *in) {
    if (in->scene->triangle_count > TRIANGLES_MAX)
        advise(in, "simplify the densest meshes (Blender: Decimate)",
               "%llu triangles are many for a small board",
               (unsigned long long)in->scene->triangle_count);
    if (in->cost.draws > DRAWS_MAX)
        advise(in, "join meshes, or let equal ones share their mesh (Blender: Alt+D)",
               "%u draw calls in one picture", in->cost.draws);
    if (GN_MB(in->cost.texture_bytes) > TEXTURES_MAX_MB)
        advise(in, "make the largest textures smaller", "textures take %.0f MB of GPU memory",
               GN_MB(in->cost.texture_bytes));
}

static void check_clips(struct gn_inspection *in) {
    for (uint32_t i = 0; i < in->scene->animation.clip_count; i++)
        if (!in->scene->animation.clips[i].on_by_default)
            advise(in, "show it with --animation, or in a mode of its own",
                   "clip '%s' does not play: it moves what an earlier clip moves",
                   in->scene->animation.clips[i].name);
}

/* ---- surfaces ------------------------------------------------------------------------------ */

static void check_images(struct gn_inspection *in) {
    for (uint32_t i = 0; i < in->scene->pictures.image_count; i++) {
        const struct gn_image *image = &in->scene->pictures.images[i];
        if (image->width_px > TEXTURE_MAX_PX || image->height_px > TEXTURE_MAX_PX)
            advise(in, "make it 4096 at most: a Raspberry Pi draws no larger ones",
                   "image %u is %ux%u pixels", i, image->width_px, image->height_px);
    }
}

static void check_normals(struct gn_inspection *in) {
    uint32_t without = 0;
    for (uint32_t i = 0; i < in->scene->geometry_count; i++)
        without += !gn_geometry_has(&in->scene->geometries[i], GN_ATTRIBUTE_NORMAL);
    if (without)
        advise(in, "export normals, unless facets are wanted",
               "%u mesh%s %s no normals: facets show", without, without == 1 ? "" : "es",
               without == 1 ? "has" : "have");
}

static bool is_transparent(const struct gn_scene *scene, const struct gn_material *m) {
    int32_t texture = m->textures[GN_TEXTURE_BASE].texture;
    return m->base_color[3] < 1.0f || scene->buffers.colors ||
           (texture >= 0 &&
            scene->pictures.images[scene->pictures.textures[texture].image].has_alpha);
}

static void check_alpha(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    for (uint32_t i = 0; i < s->material_count; i++) {
        const struct gn_material *m = &s->materials[i];
        if (m->alpha != GN_ALPHA_OPAQUE && !is_transparent(s, m))
            advise(in, "make it opaque: it is drawn faster, and casts",
                   "material '%s' is %s, but nothing of it is transparent", m->name,
                   m->alpha == GN_ALPHA_MASK ? "masked" : "blended");
    }
}

static void check_blend_casters(struct gn_inspection *in) {
    uint32_t count = 0, material = 0;
    for (uint32_t i = 0; i < in->scene->item_count; i++) {
        const struct gn_item *item = &in->scene->items[i];
        if (!item->casts || in->scene->materials[item->material].alpha != GN_ALPHA_BLEND) continue;
        if (!count++) material = item->material;
    }
    if (count)
        advise(in, "use alpha mode MASK for leaves and lattices; for glass leave it so",
               "%u blended thing%s (the first is of '%s') cast%s no shadow", count, PLURAL(count),
               in->scene->materials[material].name, count == 1 ? "s" : "");
}

/* ---- lights and cameras -------------------------------------------------------------------- */

static bool wants_shadow(const struct gn_light *light) {
    enum gn_technique technique;
    return !light->technique || !gn_technique_find(light->technique, &technique, NULL) ||
           technique != GN_TECHNIQUE_NONE;
}

static void check_light(struct gn_inspection *in, const struct gn_light *light) {
    enum gn_technique technique;
    if (light->color[0] + light->color[1] + light->color[2] <= 0.0f)
        advise(in, "give it an intensity, or take it out", "light '%s' is dark", light->name);
    if (gn_light_types[light->type].has_cone && GN_DEG(light->outer_rad) > (double)CONE_MAX_DEG)
        advise(in, "make the cone narrower, or use two spots",
               "spot '%s' opens to %.0f degrees: beyond 80 its shadows end", light->name,
               GN_DEG(light->outer_rad));
    bool point = gn_light_types[light->type].shines_around; /* three tiles lie side by side */
    if (light->map_px > (point ? TEXTURE_MAX_PX / 3 : TEXTURE_MAX_PX))
        advise(in,
               point ? "set gnomon_map_px to 1365 at most: a Raspberry Pi draws no larger tiles"
                     : "set gnomon_map_px to 4096 at most: a Raspberry Pi draws no larger ones",
               "light '%s' asks for a map of %u pixels", light->name, light->map_px);
    if (light->technique && !gn_technique_find(light->technique, &technique, NULL))
        advise(in, "choose one that --shadow knows, or none",
               "light '%s': gnomon_shadow '%s' is not a technique of this version: it gets pcf",
               light->name, light->technique);
}

static void check_lights(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    uint32_t shadows = 0;
    for (uint32_t i = 0; i < s->light_count; i++) {
        check_light(in, &s->lights[i]);
        shadows += wants_shadow(&s->lights[i]);
    }
    if (shadows > GN_ALL_SHADOWS_MAX)
        advise(in, "set gnomon_shadow to none on those that matter least",
               "%u lights want shadows: the %d strongest get them", shadows, GN_ALL_SHADOWS_MAX);
    if (s->light_count > GN_ALL_LIGHTS_MAX)
        advise(in, "take out the weakest, or bake them", "%u lights: the %d strongest are used",
               s->light_count, GN_ALL_LIGHTS_MAX);
    if (s->added.light)
        advise(in, "export lights (KHR_lights_punctual; Blender: Include > Punctual Lights)",
               "the file has no light: a sun was made");
}

static void check_cameras(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    for (uint32_t i = 0; i < s->camera_count; i++) {
        const struct gn_camera *c = &s->cameras[i];
        if (!c->orthographic && c->far_m > 0 && c->far_m / c->near_m > DEPTH_RATIO)
            advise(in, "raise the near end (Blender: Clip Start)",
                   "camera '%s' sees from %g to %g m: far surfaces may flicker", c->name,
                   (double)c->near_m, (double)c->far_m);
    }
    if (s->added.camera)
        advise(in, "export a camera (Blender: Include > Cameras)",
               "the file has no camera: one was made that frames the scene");
}

void gn_inspect_advise(struct gn_inspection *in) {
    static void (*const checks[])(struct gn_inspection *) = {
        check_size,          check_amounts, check_images,  check_normals, check_alpha,
        check_blend_casters, check_lights,  check_cameras, check_clips,
    };
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) checks[i](in);
}
