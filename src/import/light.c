/* Lights and cameras, added at the root in world space: scale and axes of their nodes differ
 * between exporters, and nothing is animated. */
#include <math.h>
#include <string.h>

#include "import/private.h"

#define PI 3.14159265f

static const struct gn_import_node *find_node(const struct gn_import *import, const char *name) {
    for (size_t i = 0; i < import->node_count; i++)
        if (strcmp(import->nodes[i].node->mName.data, name) == 0) return &import->nodes[i];
    return NULL;
}

static struct aiVector3D transform_direction(const struct aiMatrix4x4 *m, struct aiVector3D v) {
    return (struct aiVector3D){m->a1 * v.x + m->a2 * v.y + m->a3 * v.z,
                               m->b1 * v.x + m->b2 * v.y + m->b3 * v.z,
                               m->c1 * v.x + m->c2 * v.y + m->c3 * v.z};
}

static float length_of(struct aiVector3D v) { return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z); }

static bool normalise_vector(struct aiVector3D *v) {
    float length = length_of(*v);
    if (!isfinite(length) || length < 1e-12f) return false;
    *v = (struct aiVector3D){v->x / length, v->y / length, v->z / length};
    return true;
}

static struct aiVector3D cross_product(struct aiVector3D a, struct aiVector3D b) {
    return (struct aiVector3D){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The node's world matrix for a local position and direction, with a scale of 1. */
static struct aiMatrix4x4 place_matrix(const struct gn_import_node *at, struct aiVector3D position,
                                       struct aiVector3D along, struct aiVector3D up) {
    const struct aiMatrix4x4 *m = &at->world_from_node;
    struct aiVector3D p = transform_direction(m, position), z = transform_direction(m, along),
                      y = transform_direction(m, up), x;
    if (!normalise_vector(&z)) z = (struct aiVector3D){0.0f, -1.0f, 0.0f};
    z = (struct aiVector3D){-z.x, -z.y, -z.z};
    x = cross_product(y, z);
    if (!normalise_vector(&x)) x = cross_product((struct aiVector3D){0.0f, 1.0f, 0.0f}, z);
    if (!normalise_vector(&x)) x = (struct aiVector3D){1.0f, 0.0f, 0.0f};
    y = cross_product(z, x);
    return (struct aiMatrix4x4){x.x, y.x, z.x, p.x + m->a4, x.y,  y.y,  z.y,  p.y + m->b4,
                                x.z, y.z, z.z, p.z + m->c4, 0.0f, 0.0f, 0.0f, 1.0f};
}

static json_t *add_node(struct gn_import *import, const char *name,
                        const struct aiMatrix4x4 *placed) {
    json_t *object =
        json_pack("{s:o,s:o}", "name", gn_glb_text(name), "matrix", gn_import_matrix(placed));
    int index = gn_glb_add(&import->glb, "nodes", object);
    json_t *scene = json_array_get(json_object_get(import->glb.root, "scenes"), 0);
    json_array_append_new(json_object_get(scene, "nodes"), json_integer(index));
    return object;
}

/* ---- lights ---- */

/* Metres per unit of the light's node. */
static float unit_of(const struct gn_import_node *at) {
    float unit =
        length_of(transform_direction(&at->world_from_node, (struct aiVector3D){1.0f, 0.0f, 0.0f}));
    return isfinite(unit) && unit > 0.0f ? unit : 1.0f;
}

/* Lux or candela per unit of colour. In other programs a light of intensity 1 shows white paper as
 * white: pi lux. Other falloffs become inverse-square with the file's intensity at the scene's
 * centre. */
static float strength_of(const struct gn_import *import, const struct aiLight *light,
                         const struct gn_import_node *at, const struct aiMatrix4x4 *placed) {
    if (light->mType == aiLightSource_DIRECTIONAL) return PI;
    struct aiVector3D to_centre = {placed->a4 - 0.5f * (import->low[0] + import->high[0]),
                                   placed->b4 - 0.5f * (import->low[1] + import->high[1]),
                                   placed->c4 - 0.5f * (import->low[2] + import->high[2])};
    float distance_m = length_of(to_centre);
    if (!isfinite(distance_m) || distance_m <= 1e-3f) distance_m = 1e-3f;
    float distance = distance_m / unit_of(at);
    float divisor = light->mAttenuationConstant + light->mAttenuationLinear * distance +
                    light->mAttenuationQuadratic * distance * distance;
    if (!isfinite(divisor) || divisor <= 0.0f) divisor = 1.0f;
    return PI * distance_m * distance_m / divisor;
}

void gn_import_lights(struct gn_import *import) {
    for (unsigned i = 0; i < import->scene->mNumLights; i++) {
        const struct aiLight *light = import->scene->mLights[i];
        const char *type =
            light->mType == aiLightSource_DIRECTIONAL ? "directional"
            : light->mType == aiLightSource_SPOT      ? "spot"
            : light->mType == aiLightSource_POINT || light->mType == aiLightSource_AREA
                ? "point"
                : NULL; /* ambient lights are ignored */
        const struct gn_import_node *at = find_node(import, light->mName.data);
        float rgb[3] = {light->mColorDiffuse.r, light->mColorDiffuse.g, light->mColorDiffuse.b};
        float most = fmaxf(fmaxf(rgb[0], rgb[1]), rgb[2]);
        if (!at || !type || !isfinite(rgb[0] + rgb[1] + rgb[2]) || most <= 0.0f) continue;
        struct aiMatrix4x4 placed =
            place_matrix(at, light->mPosition, light->mDirection, light->mUp);
        float strength = most * strength_of(import, light, at, &placed);
        if (!isfinite(strength)) continue;
        for (int k = 0; k < 3; k++) rgb[k] = fmaxf(rgb[k], 0.0f) / most;
        json_t *object =
            json_pack("{s:o,s:s,s:o,s:f}", "name", gn_glb_text(light->mName.data), "type", type,
                      "color", gn_glb_floats(rgb, 3), "intensity", (double)strength);
        if (light->mType == aiLightSource_SPOT) {
            /* assimp gives full cone angles; for Collada, which has one only, it invents the outer
             */
            float outer = 0.5f * light->mAngleOuterCone, inner = 0.5f * light->mAngleInnerCone;
            if (import->format == GN_MODEL_DAE || !(outer > 0.01f)) outer = inner;
            if (!(outer > 0.01f)) outer = 0.25f * PI;
            outer = fminf(outer, 0.5f * PI);
            if (!(inner >= 0.0f) || inner >= outer) inner = 0.85f * outer;
            json_object_set_new(object, "spot",
                                json_pack("{s:f,s:f}", "innerConeAngle", (double)inner,
                                          "outerConeAngle", (double)outer));
        }
        json_t *extension = gn_glb_extension(&import->glb, "KHR_lights_punctual");
        json_t *lights = json_object_get(extension, "lights");
        if (!lights) json_object_set_new(extension, "lights", lights = json_array());
        json_array_append_new(lights, object);
        json_object_set_new(add_node(import, light->mName.data, &placed), "extensions",
                            json_pack("{s:{s:i}}", "KHR_lights_punctual", "light",
                                      (int)json_array_size(lights) - 1));
    }
}

/* ---- cameras ---- */

void gn_import_cameras(struct gn_import *import) {
    /* exporters' near planes have no common unit; ours is placed where it cuts nothing */
    float near_m = 1e-3f * length_of((struct aiVector3D){import->high[0] - import->low[0],
                                                         import->high[1] - import->low[1],
                                                         import->high[2] - import->low[2]});
    if (!isfinite(near_m) || near_m <= 1e-5f) near_m = 1e-2f;
    for (unsigned i = 0; i < import->scene->mNumCameras; i++) {
        const struct aiCamera *camera = import->scene->mCameras[i];
        const struct gn_import_node *at = find_node(import, camera->mName.data);
        if (!at) continue;
        float aspect = camera->mAspect;
        if (!isfinite(aspect) || aspect <= 0.0f) aspect = 16.0f / 9.0f;
        float yfov = 2.0f * atanf(tanf(0.5f * camera->mHorizontalFOV) / aspect);
        if (!(yfov > 0.01f && yfov < 3.1f)) yfov = 0.7f;
        double half = (double)(camera->mOrthographicWidth * unit_of(at));
        json_t *object =
            camera->mOrthographicWidth > 0.0f
                ? json_pack("{s:s,s:{s:f,s:f,s:f,s:f}}", "type", "orthographic", "orthographic",
                            "xmag", half, "ymag", half / (double)aspect, "znear", (double)near_m,
                            "zfar", 4000.0 * (double)near_m)
                : json_pack("{s:s,s:{s:f,s:f}}", "type", "perspective", "perspective", "yfov",
                            (double)yfov, "znear", (double)near_m);
        json_object_set_new(object, "name", gn_glb_text(camera->mName.data));
        int index = gn_glb_add(&import->glb, "cameras", object);
        struct aiMatrix4x4 placed =
            place_matrix(at, camera->mPosition, camera->mLookAt, camera->mUp);
        json_object_set_new(add_node(import, camera->mName.data, &placed), "camera",
                            json_integer(index));
    }
}
