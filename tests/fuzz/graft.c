/* Objects are added behind those that there are, so that the file's indices stay; and an array that
 * is no array stays, with what would have been added. Users come before what they use: a node of
 * each mesh that no node has, a material of each texture, a texture of each image and sampler, a
 * triangle of each material and accessor, an accessor of each view, a view of each buffer. */
#include "fuzz/graft.h"

#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "scene/gltf/json_text.h"

enum { HEADER = 12, CHUNK = 8 };

/* The valid triangle: positions, normals, weights 1 0 0 0, two times, and two translations. */
static const char valid_buffer[] =
    "{'byteLength':168,'uri':'data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAA"
    "AAAAAIA/AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA"
    "'}";

struct graft {
    json_t *root;
    json_int_t scene_node, position, joints, weights, times, moves, zeros, image, mesh;
};

static json_t *parse(const char *text) {
    char *copy = strdup(text);
    for (char *c = copy; *c; c++)
        if (*c == '\'') *c = '"';
    json_t *json = json_loads(copy, 0, NULL);
    free(copy);
    if (!json) abort();
    return json;
}

static json_t *array_of(struct graft *g, const char *key) {
    json_t *list = json_object_get(g->root, key);
    if (!list) json_object_set_new(g->root, key, list = json_array());
    return list;
}

/* Returns the index of what is added. */
static json_int_t add(struct graft *g, const char *array, json_t *what) {
    json_t *list = array_of(g, array);
    if (!json_is_array(list)) {
        json_decref(what);
        return 0;
    }
    json_array_append_new(list, what);
    return (json_int_t)json_array_size(list) - 1;
}

static json_int_t add_text(struct graft *g, const char *array, const char *text) {
    return add(g, array, parse(text));
}

/* Whether `index` is the value of a member of that name, or in its array, anywhere below. */
static bool uses(const json_t *json, const char *member, json_int_t index) {
    const char *key;
    json_t *value;
    size_t i;
    if (json_is_object(json)) json_object_foreach((json_t *)json, key, value) {
            const bool named = !strcmp(key, member);
            if (named && json_is_integer(value) && json_integer_value(value) == index) return true;
            for (size_t k = 0; named && k < json_array_size(value); k++)
                if (json_integer_value(json_array_get(value, k)) == index) return true;
            if (uses(value, member, index)) return true;
        }
    else if (json_is_array(json))
        json_array_foreach((json_t *)json, i, value) if (uses(value, member, index)) return true;
    return false;
}

/* Of the file's objects in an array, how many. */
static json_int_t count_of(const struct graft *g, const char *array) {
    const json_t *list = json_object_get(g->root, array);
    return json_is_array(list) ? (json_int_t)json_array_size(list) : 0;
}

static void show_mesh(struct graft *g, json_int_t mesh) {
    const json_int_t node = add(g, "nodes", json_pack("{s:I}", "mesh", mesh));
    json_t *scenes = array_of(g, "scenes"), *nodes;
    json_t *scene = json_array_get(scenes, 0);
    if (json_is_array(scenes) && !scene) json_array_append_new(scenes, scene = json_object());
    if (!json_is_object(scene)) return;
    if (!(nodes = json_object_get(scene, "nodes")))
        json_object_set_new(scene, "nodes", nodes = json_array());
    if (json_is_array(nodes)) json_array_append_new(nodes, json_integer(node));
}

/* A mesh of one triangle; takes `primitive`, whose POSITION it sets unless it has one. */
static json_int_t add_triangle(struct graft *g, json_t *primitive) {
    json_t *attributes = json_object_get(primitive, "attributes");
    if (!attributes) json_object_set_new(primitive, "attributes", attributes = json_object());
    if (!json_object_get(attributes, "POSITION"))
        json_object_set_new(attributes, "POSITION", json_integer(g->position));
    return add(g, "meshes", json_pack("{s:[o]}", "primitives", primitive));
}

static json_int_t add_part(struct graft *g, json_int_t buffer, int offset, int length,
                           int component, int count, const char *type) {
    const json_int_t view = add(
        g, "bufferViews",
        json_pack("{s:I,s:i,s:i}", "buffer", buffer, "byteOffset", offset, "byteLength", length));
    return add(g, "accessors",
               json_pack("{s:I,s:i,s:i,s:s}", "bufferView", view, "componentType", component,
                         "count", count, "type", type));
}

/* ---- users ---- */

static void use_as_attribute(struct graft *g, const char *semantic, json_int_t accessor) {
    show_mesh(g, add_triangle(g, json_pack("{s:{s:I}}", "attributes", semantic, accessor)));
}

/* Of copies of the valid triangle: any number will do. */
static void use_as_places(struct graft *g, json_int_t accessor) {
    show_mesh(g, g->mesh);
    json_t *nodes = json_object_get(g->root, "nodes");
    json_object_set_new(json_array_get(nodes, json_array_size(nodes) - 1), "extensions",
                        json_pack("{s:{s:{s:I}}}", "EXT_mesh_gpu_instancing", "attributes",
                                  "TRANSLATION", accessor));
}

static void use_accessor(struct graft *g, json_int_t i) {
    const json_t *a = json_array_get(json_object_get(g->root, "accessors"), (size_t)i);
    const char *type = json_string_value(json_object_get(a, "type"));
    const bool is_float = json_integer_value(json_object_get(a, "componentType")) == 5126;
    if (type && !strcmp(type, "VEC3") && is_float &&
        json_integer_value(json_object_get(a, "count")) < 3)
        use_as_places(g, i);
    else if (!type || !strcmp(type, "VEC3"))
        use_as_attribute(g, "POSITION", i);
    else if (!strcmp(type, "VEC2"))
        use_as_attribute(g, "TEXCOORD_0", i);
    else if (!strcmp(type, "VEC4"))
        use_as_attribute(g, "COLOR_0", i);
    else if (!strcmp(type, "SCALAR") && !is_float)
        show_mesh(g, add_triangle(g, json_pack("{s:I}", "indices", i)));
    else if (!strcmp(type, "SCALAR"))
        add(g, "animations",
            json_pack("{s:[{s:I,s:I}],s:[{s:i,s:{s:I,s:s}}]}", "samplers", "input", i, "output",
                      g->moves, "channels", "sampler", 0, "target", "node", g->scene_node, "path",
                      "translation"));
    else
        add(g, "skins",
            json_pack("{s:I,s:[I]}", "inverseBindMatrices", i, "joints", g->scene_node));
}

/* As positions; where it is too small, as the colour of one vertex, or indices by its stride. */
static void use_view(struct graft *g, json_int_t i) {
    const json_t *view = json_array_get(json_object_get(g->root, "bufferViews"), (size_t)i);
    const json_int_t size = json_integer_value(json_object_get(view, "byteLength"));
    json_t *accessor;
    if (json_object_get(view, "byteStride"))
        accessor = json_pack("{s:I,s:i,s:i,s:s}", "bufferView", i, "componentType", 5121, "count",
                             1, "type", "SCALAR");
    else if (size >= 36)
        accessor = json_pack("{s:I,s:i,s:I,s:s}", "bufferView", i, "componentType", 5126, "count",
                             size / 12, "type", "VEC3");
    else
        accessor =
            json_pack("{s:i,s:i,s:s,s:b,s:{s:i,s:{s:I,s:i},s:{s:I}}}", "componentType", 5121,
                      "count", 3, "type", "VEC4", "normalized", 1, "sparse", "count", 1, "indices",
                      "bufferView", g->zeros, "componentType", 5121, "values", "bufferView", i);
    add(g, "accessors", accessor);
}

static void use_buffer(struct graft *g, json_int_t i) {
    const json_t *buffer = json_array_get(json_object_get(g->root, "buffers"), (size_t)i);
    const json_int_t size = json_integer_value(json_object_get(buffer, "byteLength"));
    add(g, "bufferViews", json_pack("{s:I,s:I}", "buffer", i, "byteLength", size > 0 ? size : 1));
}

static void use_image(struct graft *g, json_int_t i) {
    add(g, "textures", json_pack("{s:I}", "source", i));
}

static void use_sampler(struct graft *g, json_int_t i) {
    add(g, "textures", json_pack("{s:I,s:I}", "source", g->image, "sampler", i));
}

static void use_texture(struct graft *g, json_int_t i) {
    add(g, "materials",
        json_pack("{s:{s:{s:I}}}", "pbrMetallicRoughness", "baseColorTexture", "index", i));
}

static void use_material(struct graft *g, json_int_t i) {
    show_mesh(g, add_triangle(g, json_pack("{s:I}", "material", i)));
}

static void use_skin(struct graft *g, json_int_t i) {
    show_mesh(g, add_triangle(g, json_pack("{s:{s:I,s:I}}", "attributes", "JOINTS_0", g->joints,
                                           "WEIGHTS_0", g->weights)));
    json_t *nodes = json_object_get(g->root, "nodes");
    json_object_set_new(json_array_get(nodes, json_array_size(nodes) - 1), "skin", json_integer(i));
}

static void use_camera(struct graft *g, json_int_t i) {
    show_mesh(g, add_triangle(g, json_object()));
    json_t *nodes = json_object_get(g->root, "nodes");
    json_object_set_new(json_array_get(nodes, json_array_size(nodes) - 1), "camera",
                        json_integer(i));
}

/* A node of the file that is nobody's child and in no scene. */
static void use_node(struct graft *g, json_int_t i) {
    json_t *nodes = json_object_get(json_array_get(array_of(g, "scenes"), 0), "nodes");
    if (json_is_array(nodes)) json_array_append_new(nodes, json_integer(i));
}

static const struct {
    const char *array, *member; /* of those who use it */
    void (*use)(struct graft *g, json_int_t index);
} users[] = {
    {"buffers", "buffer", use_buffer},       {"bufferViews", "bufferView", use_view},
    {"accessors", NULL, use_accessor},       {"samplers", "sampler", use_sampler},
    {"images", "source", use_image},         {"textures", "index", use_texture},
    {"materials", "material", use_material}, {"skins", "skin", use_skin},
    {"cameras", "camera", use_camera},       {"meshes", "mesh", show_mesh},
    {"nodes", "children", use_node},
};
enum { USERS = sizeof users / sizeof users[0] };

static bool accessor_is_used(const json_t *root, json_int_t i) {
    static const char *const members[] = {
        "POSITION", "NORMAL",    "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0",
        "JOINTS_0", "WEIGHTS_0", "indices", "input",      "output",     "inverseBindMatrices"};
    for (size_t k = 0; k < sizeof members / sizeof members[0]; k++)
        if (uses(root, members[k], i)) return true;
    return false;
}

/* The valid triangle, and what it takes to use others. */
static void add_valid(struct graft *g) {
    const json_int_t buffer = add(g, "buffers", parse(valid_buffer));
    g->position = add_part(g, buffer, 0, 36, 5126, 3, "VEC3");
    g->weights = add_part(g, buffer, 72, 48, 5126, 3, "VEC4");
    g->joints = add_part(g, buffer, 120, 12, 5121, 3, "VEC4");
    g->zeros = count_of(g, "bufferViews") - 1; /* of the joints */
    g->times = add_part(g, buffer, 136, 8, 5126, 2, "SCALAR");
    g->moves = add_part(g, buffer, 144, 24, 5126, 2, "VEC3");
    g->scene_node = count_of(g, "nodes");
    g->mesh = add_triangle(g, json_object());
    show_mesh(g, g->mesh);
}

/* What a node does is seen of a child with the valid triangle; lights are in nodes of their own. */
static void show_nodes(struct graft *g, json_int_t count) {
    json_t *lights = json_object_get(g->root, "extensions");
    lights = json_object_get(json_object_get(lights, "KHR_lights_punctual"), "lights");
    for (json_int_t i = 0; i < count; i++) {
        json_t *node = json_array_get(json_object_get(g->root, "nodes"), (size_t)i);
        if (!json_is_object(node) || json_object_get(node, "mesh") ||
            json_object_get(node, "children"))
            continue;
        const json_int_t child = add(g, "nodes", json_pack("{s:I}", "mesh", g->mesh));
        json_object_set_new(node, "children", json_pack("[I]", child));
    }
    for (size_t i = 0; i < json_array_size(lights); i++) {
        show_mesh(g, g->mesh);
        json_t *nodes = json_object_get(g->root, "nodes");
        json_object_set_new(json_array_get(nodes, json_array_size(nodes) - 1), "extensions",
                            json_pack("{s:{s:i}}", "KHR_lights_punctual", "light", (int)i));
    }
}

/* Buffers whose bytes are nowhere have zeros. */
static void fill_buffers(struct graft *g) {
    size_t i;
    json_t *buffer;
    json_array_foreach(json_object_get(g->root, "buffers"), i, buffer) {
        const json_int_t size = json_integer_value(json_object_get(buffer, "byteLength"));
        if (size < 1 || size > 1 << 16 || json_object_get(buffer, "uri")) continue;
        const size_t letters = (size_t)(size + 2) / 3 * 4;
        char *uri = gn_xalloc(letters + 100, 1);
        const int start = sprintf(uri, "data:application/octet-stream;base64,");
        memset(uri + start, 'A', letters);
        uri[(size_t)start + letters] = 0;
        for (json_int_t pad = 0; pad < (3 - size % 3) % 3; pad++)
            uri[(size_t)start + letters - 1 - (size_t)pad] = '=';
        json_object_set_new(buffer, "uri", json_string(uri));
        free(uri);
    }
}

/* References: below objects of `array`, members of that name, to objects of `to`. */
static const struct {
    const char *array, *member, *to;
} references[] = {
    {"bufferViews", "buffer", "buffers"},
    {"accessors", "bufferView", "bufferViews"},
    {"images", "bufferView", "bufferViews"},
    {"textures", "sampler", "samplers"},
    {"textures", "source", "images"},
    {"materials", "index", "textures"},
    {"meshes", "indices", "accessors"},
    {"meshes", "attributes", "accessors"},
    {"meshes", "targets", "accessors"},
    {"meshes", "material", "materials"},
    {"nodes", "mesh", "meshes"},
    {"nodes", "skin", "skins"},
    {"nodes", "camera", "cameras"},
    {"nodes", "children", "nodes"},
    {"scenes", "nodes", "nodes"},
    {"skins", "joints", "nodes"},
    {"skins", "skeleton", "nodes"},
    {"skins", "inverseBindMatrices", "accessors"},
    {"animations", "input", "accessors"},
    {"animations", "output", "accessors"},
    {"animations", "node", "nodes"},
};

/* Raises all numbers from `count` on by 1000. */
static void raise(json_t *json, json_int_t count) {
    const char *key;
    json_t *value;
    size_t i;
    if (json_is_integer(json) && json_integer_value(json) >= count)
        json_integer_set(json, json_integer_value(json) + 1000);
    json_object_foreach(json, key, value) raise(value, count);
    json_array_foreach(json, i, value) raise(value, count);
}

static void raise_below(json_t *json, const char *member, json_int_t count) {
    const char *key;
    json_t *value;
    size_t i;
    json_object_foreach(json, key, value) {
        if (!strcmp(key, member))
            raise(value, count);
        else
            raise_below(value, member, count);
    }
    json_array_foreach(json, i, value) raise_below(value, member, count);
}

/* What refers to nothing does not come to refer to what is added. */
static void keep_dangling(struct graft *g) {
    for (size_t i = 0; i < sizeof references / sizeof references[0]; i++)
        raise_below(json_object_get(g->root, references[i].array), references[i].member,
                    count_of(g, references[i].to));
    raise(json_object_get(g->root, "scene"), count_of(g, "scenes"));
}

static void graft_all(struct graft *g) {
    const json_int_t nodes = count_of(g, "nodes"); /* of the file's own */
    keep_dangling(g);
    g->image = count_of(g, "images");
    add_valid(g);
    show_nodes(g, nodes);
    if (count_of(g, "samplers"))
        add_text(g, "images",
                 "{'uri':'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAA"
                 "DElEQVQYV2P4z/AfAAQAAf+I0P3MAAAAAElFTkSuQmCC'}");
    for (int u = 0; u < USERS; u++) {
        const json_int_t count = users[u].use == use_node ? nodes : count_of(g, users[u].array);
        for (json_int_t i = 0; i < count; i++) {
            const bool used =
                users[u].member ? uses(g->root, users[u].member, i) : accessor_is_used(g->root, i);
            if (!used) users[u].use(g, i);
        }
    }
}

/* ---- files ---- */

static uint32_t word_at(const uint8_t *p) {
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static void put_word(uint8_t *p, uint32_t value) {
    for (int i = 0; i < 4; i++) p[i] = (uint8_t)(value >> 8 * i);
}

static char *graft_text(const char *json, size_t size, bool has_chunk) {
    static const char bom[] = "\xef\xbb\xbf";
    const size_t skip = size > 3 && memcmp(json, bom, 3) == 0 ? 3 : 0; /* it stays */
    json += skip;
    size -= skip;
    struct graft g = {.root = json_loadb(json, size, JSON_REJECT_DUPLICATES, NULL)};
    char *replaced = g.root ? NULL : gn_json_text_replace(json, size); /* numbers over 1e308 */
    if (replaced) g.root = json_loadb(replaced, size, JSON_REJECT_DUPLICATES, NULL);
    free(replaced);
    if (!json_is_object(g.root)) {
        json_decref(g.root);
        return NULL;
    }
    if (!has_chunk) fill_buffers(&g);
    graft_all(&g);
    char *dumped = json_dumps(g.root, JSON_COMPACT);
    char *text = gn_xalloc(strlen(dumped) + sizeof bom, 1);
    sprintf(text, "%s%s", skip ? bom : "", dumped);
    free(dumped);
    json_decref(g.root);
    return text;
}

struct gn_made gn_graft(const void *data, size_t size) {
    const uint8_t *bytes = data;
    if (size < 4 || memcmp(bytes, "glTF", 4) != 0) {
        char *text = graft_text(data, size, false);
        return (struct gn_made){(uint8_t *)text, text ? strlen(text) : 0};
    }
    const size_t at = HEADER + CHUNK;
    const uint32_t was = size > at ? word_at(bytes + HEADER) : 0;
    if (size < at || size - at < was) return (struct gn_made){NULL, 0};
    char *text = graft_text((const char *)bytes + at, was, true);
    if (!text) return (struct gn_made){NULL, 0};
    const size_t length = strlen(text), rest = size - at - was,
                 padded = length > was ? was + (length - was + 3) / 4 * 4 : was;
    struct gn_made made = {gn_xalloc(at + padded + rest, 1), at + padded + rest};
    memcpy(made.data, bytes, at);
    put_word(made.data + 8, word_at(bytes + 8) + (uint32_t)(padded - was));
    put_word(made.data + HEADER, (uint32_t)padded);
    memset(made.data + at, ' ', padded);
    memcpy(made.data + at, text, length);
    memcpy(made.data + at + padded, bytes + at + was, rest);
    free(text);
    return made;
}
