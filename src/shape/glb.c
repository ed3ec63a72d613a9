#include "shape/glb.h"

#include "shape/shapes.h"

#include <assert.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "glTF buffers are little endian");

enum { FLOAT = 5126, U16 = 5123, U32 = 5125, VERTICES = 34962, INDICES = 34963 };

struct attributes { /* of one geometry: accessor indices, -1 where absent */
    int position, normal, uv, indices;
};

struct gn_glb {
    unsigned char *bin;
    size_t bin_size, bin_room;
    struct attributes *geometries;
    size_t geometry_count;
    json_t *accessors, *views, *images, *samplers, *textures, *materials, *meshes, *cameras,
        *lights, *nodes, *animations, *extensions;
    json_t *roots, *scene_extras;
    char *generator, *copyright; /* copyright may be NULL */
};

/* ---- JSON ---- */

/* The shortest decimal that reads back as the same float; jansson prints exactly these digits. */
static json_t *number(float value) {
    assert(isfinite(value));
    char text[32];
    for (int digits = 1; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) break;
    }
    double shortest = strtod(text, NULL);
    bool whole = shortest == floor(shortest) && fabs(shortest) < 1e9;
    return whole ? json_integer((json_int_t)shortest) : json_real(shortest);
}

static json_t *numbers(const float *values, int count) {
    json_t *array = json_array();
    for (int i = 0; i < count; i++) json_array_append_new(array, number(values[i]));
    return array;
}

static bool any_nonzero(const float *values, int count) {
    for (int i = 0; i < count; i++)
        if (values[i] != 0) return true;
    return false;
}

static void set_member(json_t *object, const char *key, json_t *value) {
    int failed = json_object_set_new(object, key, value);
    assert(!failed);
    (void)failed;
}

static void set_text(json_t *object, const char *key, const char *text) {
    if (text) set_member(object, key, json_string(text));
}

static void set_handle(json_t *object, const char *key, int handle) {
    if (handle) set_member(object, key, json_integer(handle - 1));
}

static void set_json(json_t *object, const char *key, const char *text) {
    if (text) set_member(object, key, json_loads(text, 0, NULL));
}

static int append_item(json_t *array, json_t *value) {
    json_array_append_new(array, value);
    return (int)json_array_size(array);
}

static void use_extension(struct gn_glb *glb, const char *name) {
    for (size_t i = 0; i < json_array_size(glb->extensions); i++)
        if (!strcmp(json_string_value(json_array_get(glb->extensions, i)), name)) return;
    append_item(glb->extensions, json_string(name));
}

/* ---- the binary chunk ---- */

static size_t append_bytes(struct gn_glb *glb, const void *bytes, size_t size) {
    size_t start = (glb->bin_size + 3) & ~(size_t)3;
    if (start + size > glb->bin_room) {
        glb->bin_room = 2 * (start + size);
        glb->bin = realloc(glb->bin, glb->bin_room);
        if (!glb->bin) abort();
    }
    memset(glb->bin + glb->bin_size, 0, start - glb->bin_size);
    memcpy(glb->bin + start, bytes, size);
    glb->bin_size = start + size;
    return start;
}

static int add_view(struct gn_glb *glb, const void *bytes, size_t size, int target) {
    json_t *view =
        json_pack("{s:i,s:I,s:I}", "buffer", 0, "byteOffset",
                  (json_int_t)append_bytes(glb, bytes, size), "byteLength", (json_int_t)size);
    if (target) set_member(view, "target", json_integer(target));
    return append_item(glb->views, view) - 1;
}

static void set_bounds(json_t *accessor, const float *values, size_t count, int width) {
    float low[4], high[4];
    for (int c = 0; c < width; c++) low[c] = high[c] = values[c];
    for (size_t i = 0; i < count * (size_t)width; i++) {
        int c = (int)(i % (size_t)width);
        low[c] = fminf(low[c], values[i]);
        high[c] = fmaxf(high[c], values[i]);
    }
    set_member(accessor, "min", numbers(low, width));
    set_member(accessor, "max", numbers(high, width));
}

static int add_floats(struct gn_glb *glb, const float *values, size_t count, int width,
                      int target) {
    static const char *const type[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    int view = add_view(glb, values, count * (size_t)width * sizeof *values, target);
    json_t *accessor = json_pack("{s:i,s:i,s:I,s:s}", "bufferView", view, "componentType", FLOAT,
                                 "count", (json_int_t)count, "type", type[width]);
    set_bounds(accessor, values, count, width);
    return append_item(glb->accessors, accessor) - 1;
}

static int add_indices(struct gn_glb *glb, const struct gn_shape *shape) {
    bool narrow = shape->vertex_count <= 65535;
    uint16_t *halves = calloc(shape->index_count, sizeof *halves);
    if (!halves) abort();
    for (size_t i = 0; i < shape->index_count; i++) halves[i] = (uint16_t)shape->indices[i];
    int view = narrow ? add_view(glb, halves, shape->index_count * sizeof *halves, INDICES)
                      : add_view(glb, shape->indices, shape->index_count * sizeof *shape->indices,
                                 INDICES);
    free(halves);
    return append_item(glb->accessors,
                       json_pack("{s:i,s:i,s:I,s:s}", "bufferView", view, "componentType",
                                 narrow ? U16 : U32, "count", (json_int_t)shape->index_count,
                                 "type", "SCALAR")) -
           1;
}

static int add_attribute(struct gn_glb *glb, const struct gn_shape *shape, size_t offset,
                         int width) {
    float *values = calloc(shape->vertex_count * (size_t)width, sizeof *values);
    if (!values) abort();
    for (size_t i = 0; i < shape->vertex_count; i++)
        memcpy(values + i * (size_t)width, (const char *)&shape->vertices[i] + offset,
               (size_t)width * sizeof *values);
    int accessor = add_floats(glb, values, shape->vertex_count, width, VERTICES);
    free(values);
    return accessor;
}

int gn_glb_geometry(struct gn_glb *glb, const struct gn_shape *shape) {
    assert(shape->vertex_count && shape->index_count);
    glb->geometries = realloc(glb->geometries, (glb->geometry_count + 1) * sizeof *glb->geometries);
    if (!glb->geometries) abort();
    glb->geometries[glb->geometry_count] = (struct attributes){
        .position = add_attribute(glb, shape, offsetof(struct gn_vertex, position), 3),
        .normal = add_attribute(glb, shape, offsetof(struct gn_vertex, normal), 3),
        .uv = shape->uv_per_m != 0 ? add_attribute(glb, shape, offsetof(struct gn_vertex, uv), 2)
                                   : -1,
        .indices = add_indices(glb, shape),
    };
    return (int)++glb->geometry_count;
}

/* ---- materials ---- */

int gn_glb_picture(struct gn_glb *glb, const char *name, const void *png, size_t size,
                   enum gn_glb_wrap wrap) {
    static const int modes[] = {
        [GN_GLB_REPEAT] = 10497, [GN_GLB_CLAMP] = 33071, [GN_GLB_MIRROR] = 33648};
    int view = add_view(glb, png, size, 0);
    int source = append_item(glb->images, json_pack("{s:s,s:s,s:i}", "name", name, "mimeType",
                                                    "image/png", "bufferView", view));
    int sampler =
        append_item(glb->samplers, json_pack("{s:i,s:i,s:i,s:i}", "magFilter", 9729, "minFilter",
                                             9987, "wrapS", modes[wrap], "wrapT", modes[wrap]));
    return append_item(glb->textures, json_pack("{s:s,s:i,s:i}", "name", name, "sampler",
                                                sampler - 1, "source", source - 1));
}

static void set_texture(json_t *object, const char *key, int texture) {
    if (texture) set_member(object, key, json_pack("{s:i}", "index", texture - 1));
}

static json_t *surface(const struct gn_glb_material *m) {
    float rgba[4] = {m->rgba[0], m->rgba[1], m->rgba[2], m->rgba[3] != 0 ? m->rgba[3] : 1};
    json_t *object = json_object();
    set_member(object, "baseColorFactor", numbers(rgba, 4));
    set_member(object, "metallicFactor", number(m->metal));
    set_member(object, "roughnessFactor", number(m->rough));
    set_texture(object, "baseColorTexture", m->texture);
    set_texture(object, "metallicRoughnessTexture", m->rough_texture);
    return object;
}

/* Adds material extension `name` with its one or two numbers, where the first is not 0. */
static void set_extension(struct gn_glb *glb, json_t *material, const char *name,
                          const char *const keys[2], const float values[2]) {
    if (values[0] == 0) return;
    json_t *extensions = json_object_get(material, "extensions"), *object = json_object();
    if (!extensions) set_member(material, "extensions", extensions = json_object());
    for (int i = 0; i < 2; i++)
        if (keys[i] && values[i] != 0) set_member(object, keys[i], number(values[i]));
    set_member(extensions, name, object);
    use_extension(glb, name);
}

static void set_extensions(struct gn_glb *glb, json_t *object, const struct gn_glb_material *m) {
    set_extension(glb, object, "KHR_materials_clearcoat",
                  (const char *const[2]){"clearcoatFactor", "clearcoatRoughnessFactor"},
                  (float[2]){m->coat, m->coat_rough});
    set_extension(glb, object, "KHR_materials_transmission",
                  (const char *const[2]){"transmissionFactor"}, (float[2]){m->transmission});
    set_extension(glb, object, "KHR_materials_ior", (const char *const[2]){"ior"},
                  (float[2]){m->ior});
    set_extension(glb, object, "KHR_materials_emissive_strength",
                  (const char *const[2]){"emissiveStrength"}, (float[2]){m->glow});
}

int gn_glb_material(struct gn_glb *glb, const struct gn_glb_material *material) {
    json_t *object = json_object();
    set_text(object, "name", material->name);
    set_member(object, "pbrMetallicRoughness", surface(material));
    if (any_nonzero(material->emissive, 3))
        set_member(object, "emissiveFactor", numbers(material->emissive, 3));
    set_texture(object, "emissiveTexture", material->emissive_texture);
    set_texture(object, "normalTexture", material->normal_texture);
    set_texture(object, "occlusionTexture", material->occlusion_texture);
    set_extensions(glb, object, material);
    if (material->alpha == GN_GLB_MASK) set_text(object, "alphaMode", "MASK");
    if (material->alpha == GN_GLB_BLEND) set_text(object, "alphaMode", "BLEND");
    if (material->double_sided) set_member(object, "doubleSided", json_true());
    return append_item(glb->materials, object);
}

/* ---- meshes, cameras, lights ---- */

static json_t *primitive(const struct gn_glb *glb, int geometry, int material) {
    assert(geometry > 0 && (size_t)geometry <= glb->geometry_count);
    const struct attributes *a = &glb->geometries[geometry - 1];
    json_t *attributes = json_pack("{s:i,s:i}", "POSITION", a->position, "NORMAL", a->normal);
    if (a->uv >= 0) set_member(attributes, "TEXCOORD_0", json_integer(a->uv));
    json_t *object = json_pack("{s:o,s:i}", "attributes", attributes, "indices", a->indices);
    set_handle(object, "material", material);
    return object;
}

int gn_glb_mesh(struct gn_glb *glb, const char *name, int geometry, int material) {
    json_t *object = json_object();
    set_text(object, "name", name);
    set_member(object, "primitives", json_pack("[o]", primitive(glb, geometry, material)));
    return append_item(glb->meshes, object);
}

void gn_glb_mesh_add(struct gn_glb *glb, int mesh, int geometry, int material) {
    json_t *primitives =
        json_object_get(json_array_get(glb->meshes, (size_t)mesh - 1), "primitives");
    append_item(primitives, primitive(glb, geometry, material));
}

int gn_glb_camera(struct gn_glb *glb, const struct gn_glb_camera *camera) {
    bool perspective = camera->yfov > 0;
    const char *type = perspective ? "perspective" : "orthographic";
    json_t *lens = json_object(), *object = json_object();
    if (perspective) {
        if (camera->aspect > 0) set_member(lens, "aspectRatio", number(camera->aspect));
        set_member(lens, "yfov", number(camera->yfov));
    } else {
        set_member(lens, "xmag", number(camera->xmag));
        set_member(lens, "ymag", number(camera->ymag));
    }
    set_member(lens, "znear", number(camera->znear));
    if (camera->zfar > 0) set_member(lens, "zfar", number(camera->zfar));
    set_text(object, "name", camera->name);
    set_text(object, "type", type);
    set_member(object, type, lens);
    return append_item(glb->cameras, object);
}

int gn_glb_light(struct gn_glb *glb, const struct gn_glb_light *light) {
    static const char *const types[] = {"directional", "point", "spot"};
    json_t *object = json_object();
    use_extension(glb, "KHR_lights_punctual");
    set_text(object, "name", light->name);
    set_text(object, "type", types[light->kind]);
    if (any_nonzero(light->rgb, 3)) set_member(object, "color", numbers(light->rgb, 3));
    set_member(object, "intensity", number(light->intensity));
    if (light->range > 0) set_member(object, "range", number(light->range));
    if (light->kind == GN_GLB_SPOT)
        set_member(object, "spot",
                   json_pack("{s:o,s:o}", "innerConeAngle", number(light->inner), "outerConeAngle",
                             number(light->outer)));
    set_json(object, "extras", light->extras);
    return append_item(glb->lights, object);
}

/* ---- nodes ---- */

static void set_placement(json_t *object, const struct gn_glb_node *node) {
    if (node->matrix) {
        set_member(object, "matrix", numbers(node->matrix, 16));
        return;
    }
    if (any_nonzero(node->move, 3)) set_member(object, "translation", numbers(node->move, 3));
    if (any_nonzero(node->turn, 4)) set_member(object, "rotation", numbers(node->turn, 4));
    if (any_nonzero(node->scale, 3)) set_member(object, "scale", numbers(node->scale, 3));
}

static void add_child(struct gn_glb *glb, int parent, int child) {
    json_t *list = glb->roots;
    if (parent) {
        json_t *node = json_array_get(glb->nodes, (size_t)parent - 1);
        assert(node);
        if (!json_object_get(node, "children")) set_member(node, "children", json_array());
        list = json_object_get(node, "children");
    }
    append_item(list, json_integer(child - 1));
}

int gn_glb_node(struct gn_glb *glb, const struct gn_glb_node *node) {
    json_t *object = json_object();
    set_text(object, "name", node->name);
    set_placement(object, node);
    set_handle(object, "mesh", node->mesh);
    set_handle(object, "camera", node->camera);
    if (node->light)
        set_member(object, "extensions",
                   json_pack("{s:{s:i}}", "KHR_lights_punctual", "light", node->light - 1));
    set_json(object, "extras", node->extras);
    int handle = append_item(glb->nodes, object);
    add_child(glb, node->parent, handle);
    return handle;
}

/* ---- animation ---- */

int gn_glb_animation(struct gn_glb *glb, const char *name) {
    json_t *object = json_pack("{s:[],s:[]}", "channels", "samplers");
    set_text(object, "name", name);
    return append_item(glb->animations, object);
}

void gn_glb_channel(struct gn_glb *glb, int animation, const struct gn_glb_channel *channel) {
    static const char *const paths[] = {"translation", "rotation", "scale"};
    static const char *const kinds[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    json_t *object = json_array_get(glb->animations, (size_t)animation - 1);
    int width = channel->path == GN_GLB_ROTATION ? 4 : 3;
    size_t keys = (size_t)channel->keys;
    size_t values = channel->interpolation == GN_GLB_CUBICSPLINE ? 3 * keys : keys;
    int input = add_floats(glb, channel->times, keys, 1, 0);
    int output = add_floats(glb, channel->values, values, width, 0);
    int sampler = append_item(json_object_get(object, "samplers"),
                              json_pack("{s:i,s:s,s:i}", "input", input, "interpolation",
                                        kinds[channel->interpolation], "output", output));
    append_item(json_object_get(object, "channels"),
                json_pack("{s:i,s:{s:i,s:s}}", "sampler", sampler - 1, "target", "node",
                          channel->node - 1, "path", paths[channel->path]));
}

/* ---- the file ---- */

void gn_glb_scene_extras(struct gn_glb *glb, const char *json) {
    json_decref(glb->scene_extras);
    glb->scene_extras = json_loads(json, 0, NULL);
    assert(glb->scene_extras);
}

struct gn_glb *gn_glb_create(const char *generator, const char *copyright) {
    struct gn_glb *glb = calloc(1, sizeof *glb);
    if (!glb) abort();
    json_t **arrays[] = {&glb->accessors, &glb->views,     &glb->images,     &glb->samplers,
                         &glb->textures,  &glb->materials, &glb->meshes,     &glb->cameras,
                         &glb->lights,    &glb->nodes,     &glb->animations, &glb->roots,
                         &glb->extensions};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) *arrays[i] = json_array();
    glb->generator = strdup(generator);
    glb->copyright = copyright ? strdup(copyright) : NULL;
    return glb;
}

void gn_glb_destroy(struct gn_glb *glb) {
    if (!glb) return;
    enum { COUNT = 14 };
    json_t *arrays[COUNT] = {glb->accessors,    glb->views,     glb->images,     glb->samplers,
                             glb->textures,     glb->materials, glb->meshes,     glb->cameras,
                             glb->lights,       glb->nodes,     glb->animations, glb->roots,
                             glb->scene_extras, glb->extensions};
    for (int i = 0; i < COUNT; i++) json_decref(arrays[i]);
    free(glb->geometries);
    free(glb->generator);
    free(glb->copyright);
    free(glb->bin);
    free(glb);
}

static void set_filled(json_t *root, const char *key, json_t *array) {
    if (json_array_size(array)) json_object_set(root, key, array);
}

static json_t *document(struct gn_glb *glb) {
    json_t *scene = json_object(), *root = json_object();
    json_object_set(scene, "nodes", glb->roots);
    if (glb->scene_extras) json_object_set(scene, "extras", glb->scene_extras);
    set_member(root, "asset",
               json_pack("{s:s,s:s,s:s*}", "version", "2.0", "generator", glb->generator,
                         "copyright", glb->copyright));
    set_filled(root, "extensionsUsed", glb->extensions);
    if (json_array_size(glb->lights))
        set_member(root, "extensions",
                   json_pack("{s:{s:O}}", "KHR_lights_punctual", "lights", glb->lights));
    set_member(root, "scene", json_integer(0));
    set_member(root, "scenes", json_pack("[o]", scene));
    set_filled(root, "nodes", glb->nodes);
    set_filled(root, "cameras", glb->cameras);
    set_filled(root, "meshes", glb->meshes);
    set_filled(root, "materials", glb->materials);
    set_filled(root, "textures", glb->textures);
    set_filled(root, "samplers", glb->samplers);
    set_filled(root, "images", glb->images);
    set_filled(root, "animations", glb->animations);
    set_filled(root, "accessors", glb->accessors);
    set_filled(root, "bufferViews", glb->views);
    set_member(root, "buffers", json_pack("[{s:I}]", "byteLength", (json_int_t)glb->bin_size));
    return root;
}

static uint8_t *put_chunk(uint8_t *at, const char kind[4], const void *bytes, size_t size,
                          char pad) {
    const uint32_t length = (uint32_t)((size + 3) & ~(size_t)3);
    memcpy(at, &length, sizeof length);
    memcpy(at + 4, kind, 4);
    memset(at + 8, pad, length);
    memcpy(at + 8, bytes, size);
    return at + 8 + length;
}

void gn_glb_build(struct gn_glb *glb, struct gn_bytes *out) {
    json_t *root = document(glb);
    char *text = json_dumps(root, JSON_COMPACT | JSON_REAL_PRECISION(9));
    json_decref(root);
    assert(text);
    const size_t text_size = strlen(text);
    out->size = 12 + 8 + ((text_size + 3) & ~(size_t)3) + 8 + ((glb->bin_size + 3) & ~(size_t)3);
    const uint32_t head[2] = {2, (uint32_t)out->size};
    out->data = calloc(1, out->size + 1);
    if (!out->data) abort();
    memcpy(out->data, "glTF", 4);
    memcpy(out->data + 4, head, sizeof head);
    uint8_t *at = put_chunk(out->data + 12, "JSON", text, text_size, ' ');
    put_chunk(at, "BIN\0", glb->bin, glb->bin_size, 0);
    free(text);
}
