/* What is wrong with a scene or costs more than it must, each with its cure. None of this stops a
 * scene from being shown. */
#include "cli/inspect.h"

#include <cglm/cglm.h>
#include <string.h>

#include "cli/units.h"
#include "frame/plan.h"

enum { TEXTURE_MAX_PX = 4096, TRIANGLES_MAX = 500000, DRAWS_MAX = 500, TEXTURES_MAX_MB = 256 };
#define SIZE_MIN_M   0.05f
#define SIZE_MAX_M   2000.0f
#define CONE_MAX_DEG 80.0f
#define DEPTH_RATIO  3e4f

static void check_surfaces(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    for (uint32_t i = 0; i < s->pictures.image_count; i++) {
        const struct gn_image *image = &s->pictures.images[i];
        if (image->width_px > TEXTURE_MAX_PX || image->height_px > TEXTURE_MAX_PX)
            gn_problem_add(&in->advice, "make it 4096 at most: a Raspberry Pi draws no larger ones",
                           "image %u is %ux%u pixels", i, image->width_px, image->height_px);
    }
    uint32_t without = 0;
    for (uint32_t i = 0; i < s->geometry_count; i++)
        without += !gn_geometry_has(&s->geometries[i], GN_ATTRIBUTE_NORMAL);
    if (without)
        gn_problem_add(&in->advice, "export normals, unless facets are wanted",
                       "%u mesh%s %s no normals: facets show", without, without == 1 ? "" : "es",
                       without == 1 ? "has" : "have");
    for (uint32_t i = 0; i < s->material_count; i++) {
        const struct gn_material *m = &s->materials[i];
        const int32_t texture = m->textures[GN_TEXTURE_BASE].texture;
        const bool transparent =
            m->base_color[3] < 1.0f || s->buffers.colors ||
            (texture >= 0 && s->pictures.images[s->pictures.textures[texture].image].has_alpha);
        if (m->alpha == GN_ALPHA_MASK && !transparent)
            gn_problem_add(&in->advice, "make it opaque: it is drawn faster",
                           "material '%s' is masked, but nothing of it is transparent", m->name);
    }
    uint32_t count = 0, material = 0; /* blended items that should cast; the first one's */
    for (uint32_t i = 0; i < s->item_count; i++) {
        const struct gn_item *item = &s->items[i];
        if (!item->casts || !gn_material_is_clear(&s->materials[item->material])) continue;
        if (!count++) material = item->material;
    }
    if (count)
        gn_problem_add(&in->advice,
                       "use alpha mode MASK for leaves and lattices; for glass leave it so",
                       "%u blended thing%s (the first is of '%s') cast%s no shadow", count,
                       count == 1 ? "" : "s", s->materials[material].name, count == 1 ? "s" : "");
}

static void check_lights(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    uint32_t shadows = 0;
    for (uint32_t i = 0; i < s->light_count; i++) {
        const struct gn_light *light = &s->lights[i];
        const struct gn_light_type_row *type = &gn_light_types[light->type];
        enum gn_technique technique;
        if (light->color[0] + light->color[1] + light->color[2] <= 0.0f)
            gn_problem_add(&in->advice, "give it an intensity, or take it out",
                           "light '%s' is dark", light->name);
        if (type->has_cone && GN_DEG(light->outer_rad) > (double)CONE_MAX_DEG)
            gn_problem_add(&in->advice, "make the cone narrower, or use two spots",
                           "spot '%s' opens to %.0f degrees: beyond 80 its shadows end",
                           light->name, GN_DEG(light->outer_rad));
        const bool point = type->shines_around; /* three tiles lie side by side */
        if (light->map_px > (point ? TEXTURE_MAX_PX / 3 : TEXTURE_MAX_PX))
            gn_problem_add(
                &in->advice,
                point ? "set gnomon_map_px to 1365 at most: a Raspberry Pi draws no larger tiles"
                      : "set gnomon_map_px to 4096 at most: a Raspberry Pi draws no larger ones",
                "light '%s' asks for a map of %u pixels", light->name, light->map_px);
        const bool known =
            light->technique &&
            gn_technique_find(light->technique, strlen(light->technique), &technique);
        if (light->technique && !known)
            gn_problem_add(
                &in->advice, "choose one that --shadow knows, or none",
                "light '%s': gnomon_shadow '%s' is not a technique of this version: it gets pcf",
                light->name, light->technique);
        shadows += !known || technique != GN_TECHNIQUE_NONE;
    }
    if (shadows > GN_ALL_SHADOWS_MAX)
        gn_problem_add(&in->advice, "set gnomon_shadow to none on those that matter least",
                       "%u lights want shadows: the %d strongest get them", shadows,
                       GN_ALL_SHADOWS_MAX);
    if (s->light_count > GN_ALL_LIGHTS_MAX)
        gn_problem_add(&in->advice, "take out the weakest, or bake them",
                       "%u lights: the %d strongest are used", s->light_count, GN_ALL_LIGHTS_MAX);
    if (s->added.light)
        gn_problem_add(&in->advice,
                       "export lights (KHR_lights_punctual; Blender: Include > Punctual Lights)",
                       "the file has no light: it is shown in a studio");
}

/* Of a model with one camera, as Blender's own is that nobody moved to the model. One with a ground
 * of its own is a scene, whose camera somebody placed: its ground may lie far out of the picture.
 */
static void check_view(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;
    struct gn_pose pose;
    bool cuts;
    if (s->added.camera || s->camera_count != 1 || !s->item_count || !s->added.floor) return;
    gn_pose_init(&pose, s, GN_POSE_DEFAULT);
    const float share = gn_framing_share(&pose, 0, &cuts);
    gn_pose_finish(&pose);
    if (share < GN_FRAMING_LEAST_SHARE)
        gn_problem_add(&in->advice,
                       "--camera auto, or camera = auto in [scene], shows all of it; or turn the "
                       "camera to the model, or take it out of the file",
                       "camera '%s' sees %.0f %% of the model", s->cameras[0].name,
                       (double)(100 * share));
    else if (cuts)
        gn_problem_add(&in->advice,
                       "move the camera back, or take it out of the file: then one is made that "
                       "shows all of it",
                       "camera '%s' cuts the model at the border of the picture, or at its near or "
                       "far end",
                       s->cameras[0].name);
}

void gn_inspect_advise(struct gn_inspection *in) {
    const struct gn_scene *s = in->scene;

    /* the scene as a whole */
    float size = glm_vec3_distance((float *)s->box.min, (float *)s->box.max);
    if (!s->item_count)
        gn_problem_add(&in->advice, "export the meshes too, or check what was selected",
                       "there is nothing to draw");
    else if (size < SIZE_MIN_M)
        gn_problem_add(&in->advice, "lengths are metres: scale it up, or apply the scale on export",
                       "the whole scene is only %.3g m across", (double)size);
    else if (size > SIZE_MAX_M)
        gn_problem_add(&in->advice,
                       "lengths are metres: scale it down, or take away what lies far off",
                       "the scene is %.4g m across: shadow maps get coarse", (double)size);
    if (s->triangle_count > TRIANGLES_MAX)
        gn_problem_add(&in->advice, "simplify the densest meshes (Blender: Decimate)",
                       "%llu triangles are many for a small board",
                       (unsigned long long)s->triangle_count);
    if (in->cost.draws > DRAWS_MAX)
        gn_problem_add(&in->advice,
                       "join meshes, or let equal ones share their mesh (Blender: Alt+D)",
                       "%u draw calls in one picture", in->cost.draws);
    if (GN_MB(in->cost.texture_bytes) > TEXTURES_MAX_MB)
        gn_problem_add(&in->advice, "make the largest textures smaller",
                       "textures take %.0f MB of GPU memory", GN_MB(in->cost.texture_bytes));

    check_surfaces(in);
    check_lights(in);
    check_view(in);
    for (uint32_t i = 0; i < s->camera_count; i++) {
        const struct gn_camera *c = &s->cameras[i];
        const float *depths_m = in->depths_m[i < GN_INSPECT_CAMERAS ? i : 0];
        if (i < GN_INSPECT_CAMERAS && !c->orthographic && depths_m[1] / depths_m[0] > DEPTH_RATIO)
            gn_problem_add(&in->advice, "raise the near end (Blender: Clip Start)",
                           "camera '%s' sees from %g to %g m: far surfaces may flicker", c->name,
                           (double)depths_m[0], (double)depths_m[1]);
    }
    if (s->added.camera)
        gn_problem_add(&in->advice, "export a camera (Blender: Include > Cameras)",
                       "the file has no camera: one was made that frames the scene");
    for (uint32_t i = 0; i < s->animation.clip_count; i++)
        if (!s->animation.clips[i].on_by_default)
            gn_problem_add(&in->advice, "show it with --animation, or in a mode of its own",
                           "clip '%s' does not play: it moves what an earlier clip moves",
                           s->animation.clips[i].name);
}
