#include "seeds.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit/ktx2_maker.h"
#include "unit/meshopt_bytes.h"
#include "unit/webp_bytes.h"

/* ---- ingredients ---- */

static void add_picture(struct gn_maker *m, const char *type, const void *data, size_t size) {
    char json[100];
    snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/%s'}",
             gn_maker_view(m, data, size), type);
    const int image = gn_maker_add(m, "images", json);
    snprintf(json, sizeof json, "{'source':%d,'sampler':0}", image);
    gn_maker_add(m, "textures", json);
}

static void add_pictures(struct gn_maker *m) {
    static const uint8_t rgba[] = {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 0, 9, 9, 9, 255};
    static const uint8_t rgb[8 * 8 * 3] = {200, 100, 50};
    static const uint16_t grey[] = {0, 32768, 65535, 1000};
    struct gn_made pictures[] = {gn_maker_png(2, 2, rgba), gn_maker_png_grey16(2, 2, grey),
                                 gn_maker_jpeg(8, 8, rgb)};
    for (size_t i = 0; i < 3; i++) {
        add_picture(m, i < 2 ? "png" : "jpeg", pictures[i].data, pictures[i].size);
        free(pictures[i].data);
    }
    add_picture(m, "webp", gn_webp_lossless, sizeof gn_webp_lossless);
    add_picture(m, "webp", gn_webp_lossy, sizeof gn_webp_lossy);
    gn_maker_add(m, "samplers", "{'magFilter':9728,'minFilter':9985,'wrapS':33071,'wrapT':33648}");
}

static void add_materials(struct gn_maker *m) {
    gn_maker_set(m, "extensionsUsed",
                 "['KHR_texture_transform','KHR_materials_unlit','KHR_materials_emissive_strength',"
                 "'KHR_materials_clearcoat','KHR_materials_transmission','KHR_materials_volume']");
    gn_maker_add(
        m, "materials",
        "{'name':'all','alphaMode':'MASK','alphaCutoff':0.3,'doubleSided':true,'emissiveFactor':[1,"
        "0.5,0],"
        "'emissiveTexture':{'index':1,'texCoord':1},'occlusionTexture':{'index':2,'strength':0.5},"
        "'extensions':{'KHR_materials_emissive_strength':{'emissiveStrength':3}},"
        "'pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5],'metallicFactor':0.1,'"
        "roughnessFactor':0.4,"
        "'baseColorTexture':{'index':0,'extensions':{'KHR_texture_transform':{'offset':[0.1,0.2],"
        "'rotation':0.3,'scale':[2,3]}}},'metallicRoughnessTexture':{'index':3}}}");
    gn_maker_add(m, "materials",
                 "{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorTexture':{'index':4}},"
                 "'extensions':{'KHR_materials_unlit':{}}}");
    gn_maker_add(m, "materials",
                 "{'extensions':{'KHR_materials_pbrSpecularGlossiness':{'glossinessFactor':0.5,"
                 "'diffuseFactor':[1,0.5,0.2,1],'specularFactor':[0.5,0.4,0.3],"
                 "'specularGlossinessTexture':{'index':0}}}}");
    gn_maker_add(
        m, "materials",
        "{'extensions':{'KHR_materials_clearcoat':{'clearcoatFactor':0.9,"
        "'clearcoatRoughnessFactor':0.2,'clearcoatTexture':{'index':0},'clearcoatRoughnessTexture':"
        "{'index':1,'texCoord':1}},"
        "'KHR_materials_transmission':{'transmissionFactor':0.7,'transmissionTexture':{'index':0}},"
        "'KHR_materials_volume':{'thicknessFactor':0,'attenuationDistance':2,"
        "'attenuationColor':[0.5,0.6,1]},'KHR_materials_ior':{'ior':1.4},'KHR_materials_specular':"
        "{'specularFactor':0.5,'specularColorFactor':[1,2,0.5]}}}");
}

/* A mesh of one textured square with normals, two UV sets and colours of three kinds. */
static void add_rich_mesh(struct gn_maker *m) {
    static const float normals[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    static const uint8_t uv8[] = {0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0, 255, 255, 0, 0};
    static const uint16_t uv16[] = {0, 0, 65535, 0, 0, 65535, 65535, 65535};
    static const uint8_t colors[] = {255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 9, 9, 9, 0};
    gn_maker_square(m);
    int normal = gn_maker_accessor(m, "VEC3", 5126, 4, normals, sizeof normals, NULL);
    int uv = gn_maker_accessor(m, "VEC2", 5121, 4, uv8, sizeof uv8, "'normalized':true");
    json_t *view = json_array_get(json_object_get(m->root, "bufferViews"),
                                  json_array_size(json_object_get(m->root, "bufferViews")) - 1);
    json_object_set_new(view, "byteStride", json_integer(4));
    int second = gn_maker_accessor(m, "VEC2", 5123, 4, uv16, sizeof uv16, "'normalized':true");
    int color = gn_maker_accessor(m, "VEC4", 5121, 4, colors, sizeof colors, "'normalized':true");
    char json[500];
    snprintf(json, sizeof json,
             "[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':%d,'TEXCOORD_0':%d,'TEXCOORD_1':"
             "%d,'COLOR_0':%d},"
             "'indices':1,'material':0},{'attributes':{'POSITION':0},'mode':5,'material':1},"
             "{'attributes':{'POSITION':0},'mode':6},{'attributes':{'POSITION':0,'NORMAL':%d,"
             "'TEXCOORD_0':%d,'TEXCOORD_1':%d},'indices':1,'material':3},"
             "{'attributes':{'POSITION':0,'TEXCOORD_0':%d},'indices':1,'material':2}]}]",
             normal, uv, second, color, normal, uv, second, uv);
    gn_maker_set(m, "meshes", json);
}

/* ---- the seeds ---- */

static void seed_plain(struct gn_maker *m) { gn_maker_square(m); }

static void seed_rich(struct gn_maker *m) {
    add_rich_mesh(m);
    add_pictures(m);
    add_materials(m);
}

static void seed_lights(struct gn_maker *m) {
    gn_maker_square(m);
    add_pictures(m);
    gn_maker_set(m, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(
        m, "extensions",
        "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3,'color':[1,0.9,0.8]}"
        ","
        "{'type':'point','range':9,'name':'lamp'},{'type':'spot','spot':{'innerConeAngle':0.1,"
        "'outerConeAngle':0.6},'extras':{'gnomon_slide':1,'gnomon_slide_size_m':[2,1],"
        "'gnomon_slide_distance_m':0.5,'gnomon_slide_far_m':4,'gnomon_slide_outside':'lit','gnomon_"
        "shadow':'pcss'}}]}}");
    gn_maker_set(m, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.7,'znear':0.1,'zfar':50,'"
                 "aspectRatio':1.5}},"
                 "{'type':'orthographic','orthographic':{'xmag':2,'ymag':2,'znear':0,'zfar':9},'"
                 "name':'Top'}]");
    gn_maker_set(
        m, "nodes",
        "[{'mesh':0,'children':[1,2,3],'extras':{'gnomon_plane':true,'gnomon_cast':false,'gnomon_"
        "receive':1,"
        "'gnomon_cast_faces':'back'}},{'extensions':{'KHR_lights_punctual':{'light':0}},'camera':0}"
        ","
        "{'extensions':{'KHR_lights_punctual':{'light':1}},'camera':1,'translation':[0,2,0],"
        "'extras':{'gnomon_radius':0.2,'gnomon_map_px':512,'gnomon_shadow_strength':0.7}},"
        "{'extensions':{'KHR_lights_punctual':{'light':2}},'rotation':[-0.7071068,0,0,0.7071068],'"
        "children':[4]},"
        "{'mesh':0,'matrix':[1,0,0,0,0,1,0,0,0,0,-1,0,0,3,0,1]}]");
    gn_maker_set(m, "scenes",
                 "[{'nodes':[0],'extras':{'gnomon_sky':[0.1,0.1,0.2],'gnomon_ground':0.03,'gnomon_"
                 "background':[0,0,0,1]}}]");
}

static void seed_animated(struct gn_maker *m) {
    static const float times[] = {0, 0.5f, 1.25f};
    static const float moves[] = {0, 0, 0, 1, 2, 3, 0, 0, 0};
    static const float spline[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0,
                                   0, 0, 0, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0};
    static const int16_t turns[] = {0, 0, 0, 32767, 0, 23170, 0, 23170, 0, 32767, 0, 0};
    gn_maker_square(m);
    int input =
        gn_maker_accessor(m, "SCALAR", 5126, 3, times, sizeof times, "'min':[0],'max':[1.25]");
    int move = gn_maker_accessor(m, "VEC3", 5126, 3, moves, sizeof moves, NULL);
    int cubic = gn_maker_accessor(m, "VEC3", 5126, 9, spline, sizeof spline, NULL);
    int turn = gn_maker_accessor(m, "VEC4", 5122, 3, turns, sizeof turns, "'normalized':true");
    char json[600];
    gn_maker_set(m, "nodes",
                 "[{'children':[1]},{'mesh':0,'children':[2]},{'mesh':0,'translation':[0,1,0]}]");
    for (int i = 0; i < 2; i++) {
        snprintf(json, sizeof json,
                 "{'name':'clip%d','samplers':[{'input':%d,'output':%d},{'input':%d,'output':%d,"
                 "'interpolation':'CUBICSPLINE'},{'input':%d,'output':%d,'interpolation':'%s'}],"
                 "'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}},"
                 "{'sampler':1,'target':{'node':1,'path':'scale'}},{'sampler':2,'target':{'node':1,"
                 "'path':'rotation'}}]}",
                 i, input, move, input, cubic, input, turn, i ? "STEP" : "LINEAR");
        gn_maker_add(m, "animations", json);
    }
    gn_maker_set(m, "extensions", "{'KHR_lights_punctual':{'lights':[{'type':'spot'}]}}");
    gn_maker_set(m, "materials", "[{'emissiveFactor':[1,0,0]}]");
    static const char *const pointers[] = {"extensions/KHR_lights_punctual/lights/0/color",
                                           "materials/0/emissiveFactor",
                                           "nodes/2/extensions/KHR_node_visibility/visible"};
    for (int i = 0; i < 3; i++) {
        snprintf(json, sizeof json,
                 "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{'path':"
                 "'pointer','extensions':{'KHR_animation_pointer':{'pointer':'/%s'}}}}]}",
                 input, i == 2 ? input : move, pointers[i]);
        gn_maker_add(m, "animations", json);
    }
}

static void seed_sparse(struct gn_maker *m) {
    static const uint8_t at[] = {1, 3};
    static const float values[] = {-1, 2, 1, 1, 2, -1};
    gn_maker_square(m);
    int indices = gn_maker_view(m, at, sizeof at), data = gn_maker_view(m, values, sizeof values);
    for (int with_base = 0; with_base < 2; with_base++) {
        char more[300];
        snprintf(more, sizeof more,
                 "%s'sparse':{'count':2,'indices':{'bufferView':%d,'componentType':5121},'values':{"
                 "'bufferView':%d}}",
                 with_base ? "'bufferView':0," : "", indices, data);
        int position = gn_maker_accessor(m, "VEC3", 5126, 4, NULL, 0, more);
        char json[120];
        snprintf(json, sizeof json, "{'primitives':[{'attributes':{'POSITION':%d},'indices':1}]}",
                 position);
        int mesh = gn_maker_add(m, "meshes", json);
        snprintf(json, sizeof json, "{'mesh':%d}", mesh);
        snprintf(json, sizeof json, "{'nodes':[0,%d]}", gn_maker_add(m, "nodes", json));
        gn_maker_set(m, "scenes", "[]");
        gn_maker_add(m, "scenes", json);
    }
}

static void seed_quantized(struct gn_maker *m) {
    static const int16_t positions[] = {-100, 0, -100, 0, -100, 0, 100,  0,
                                        100,  0, 100,  0, 100,  0, -100, 0};
    static const int8_t normals[] = {0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0};
    gn_maker_square(m);
    gn_maker_set(m, "extensionsUsed", "['KHR_mesh_quantization']");
    gn_maker_set(m, "extensionsRequired", "['KHR_mesh_quantization']");
    int position = gn_maker_accessor(m, "VEC3", 5122, 4, positions, sizeof positions, NULL);
    int normal =
        gn_maker_accessor(m, "VEC3", 5120, 4, normals, sizeof normals, "'normalized':true");
    json_t *views = json_object_get(m->root, "bufferViews");
    json_object_set_new(json_array_get(views, 2), "byteStride", json_integer(8));
    json_object_set_new(json_array_get(views, 3), "byteStride", json_integer(4));
    char json[160];
    snprintf(json, sizeof json,
             "[{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d},'indices':1}]}]", position,
             normal);
    gn_maker_set(m, "meshes", json);
    gn_maker_set(m, "nodes", "[{'mesh':0,'scale':[0.01,0.01,0.01]}]");
}

static void seed_instanced(struct gn_maker *m) {
    static const float places[] = {0, 0, 0, 3, 0, 0, 0, 0, 3};
    static const int8_t turns[] = {0, 0, 0, 127, 0, 90, 0, 90, 0, 127, 0, 0};
    static const float sizes[] = {1, 1, 1, 2, 2, 2, 1, 3, 1};
    gn_maker_square(m);
    gn_maker_set(m, "extensionsUsed", "['EXT_mesh_gpu_instancing']");
    gn_maker_set(m, "extensionsRequired", "['EXT_mesh_gpu_instancing']");
    int place = gn_maker_accessor(m, "VEC3", 5126, 3, places, sizeof places, NULL);
    int turn = gn_maker_accessor(m, "VEC4", 5120, 3, turns, sizeof turns, "'normalized':true");
    int size = gn_maker_accessor(m, "VEC3", 5126, 3, sizes, sizeof sizes, NULL);
    char json[240];
    snprintf(json, sizeof json,
             "[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':%d,'"
             "ROTATION':%d,"
             "'SCALE':%d}}}}]",
             place, turn, size);
    gn_maker_set(m, "nodes", json);
}

static const struct compressed {
    const uint8_t *data;
    size_t size;
    const char *view, *how, *accessor;
} compressed[] = {
    {gn_meshopt_square, sizeof gn_meshopt_square, "'byteLength':48",
     "'byteStride':12,'count':4,'mode':'ATTRIBUTES'", "'VEC3','componentType':5126,'count':4"},
    {gn_meshopt_exponential, sizeof gn_meshopt_exponential, "'byteLength':48",
     "'byteStride':12,'count':4,'mode':'ATTRIBUTES','filter':'EXPONENTIAL'",
     "'VEC3','componentType':5126,'count':4"},
    {gn_meshopt_normals, sizeof gn_meshopt_normals, "'byteLength':16,'byteStride':4",
     "'byteStride':4,'count':4,'mode':'ATTRIBUTES','filter':'OCTAHEDRAL'",
     "'VEC3','componentType':5120,'normalized':true,'count':4"},
    {gn_meshopt_triangles, sizeof gn_meshopt_triangles, "'byteLength':12",
     "'byteStride':2,'count':6,'mode':'TRIANGLES'", "'SCALAR','componentType':5123,'count':6"},
    {gn_meshopt_sequence, sizeof gn_meshopt_sequence, "'byteLength':12",
     "'byteStride':2,'count':6,'mode':'INDICES'", "'SCALAR','componentType':5123,'count':6"},
};

/* A view of those bytes, and an accessor on it. */
static void add_compressed(struct gn_maker *m, const struct compressed *c) {
    const int bytes = gn_maker_view(m, c->data, c->size);
    json_t *at = json_array_get(json_object_get(m->root, "bufferViews"), (size_t)bytes);
    char json[300];
    snprintf(json, sizeof json,
             "{'buffer':1,%s,'extensions':{'EXT_meshopt_compression':{'buffer':0,"
             "'byteOffset':%d,'byteLength':%zu,%s}}}",
             c->view, (int)json_integer_value(json_object_get(at, "byteOffset")), c->size, c->how);
    const int view = gn_maker_add(m, "bufferViews", json);
    snprintf(json, sizeof json, "{'bufferView':%d,'type':%s}", view, c->accessor);
    gn_maker_add(m, "accessors", json);
}

static void seed_compressed(struct gn_maker *m) {
    gn_maker_square(m);
    gn_maker_set(m, "extensionsRequired", "['EXT_meshopt_compression','KHR_mesh_quantization']");
    gn_maker_add(m, "buffers", "{'byteLength':60}");
    for (size_t i = 0; i < sizeof compressed / sizeof compressed[0]; i++)
        add_compressed(m, &compressed[i]);
    gn_maker_set(m, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':2,'NORMAL':4},'indices':5},"
                 "{'attributes':{'POSITION':3},'indices':6}]}]");
}

static void seed_posed(struct gn_maker *m) {
    static const float times[] = {0, 1}, turns[] = {0, 0, 0, 1, 0, 0, .6f, .8f};
    static const float weights[] = {0, 0, 1, -1};
    gn_maker_posed_square(m);
    const int input = gn_maker_accessor(m, "SCALAR", 5126, 2, times, sizeof times, NULL);
    const int turn = gn_maker_accessor(m, "VEC4", 5126, 2, turns, sizeof turns, NULL);
    const int weight = gn_maker_accessor(m, "SCALAR", 5126, 4, weights, sizeof weights, NULL);
    char json[300];
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d},{'input':%d,'output':%d}],'channels':["
             "{'sampler':0,'target':{'node':2,'path':'rotation'}},"
             "{'sampler':1,'target':{'node':0,'path':'weights'}}]}",
             input, turn, input, weight);
    gn_maker_add(m, "animations", json);
}

static void seed_ktx2(struct gn_maker *m) {
    static const uint8_t grey[] = {90, 60};
    add_rich_mesh(m);
    /* the first one as pixels: a texture of glossiness is read on the CPU */
    struct gn_made pictures[] = {gn_maker_ktx2(&(struct gn_ktx2_spec){.vk = GN_VK_R8,
                                                                      .px = {6, 5},
                                                                      .levels = 2,
                                                                      .scheme = GN_KTX2_ZLIB,
                                                                      .units = grey,
                                                                      .unit_bytes = 1,
                                                                      .unit_px = 1}),
                                 gn_maker_ktx2_etc2(16, 8, 4, GN_KTX2_ZSTD, 99),
                                 gn_maker_ktx2_etc2(8, 8, 1, GN_KTX2_PLAIN, 255)};
    for (size_t i = 0; i < 3; i++) {
        add_picture(m, "ktx2", pictures[i].data, pictures[i].size);
        free(pictures[i].data);
    }
    gn_maker_add(m, "samplers", "{}");
    for (int i = 0; i < 2; i++)
        gn_maker_add(m, "textures",
                     "{'source':0,'extensions':{'KHR_texture_basisu':{'source':1}}}");
    add_materials(m);
}

/* Everything that can stand beside each other, as .gltf with a data URI. */
static void seed_text(struct gn_maker *m) { seed_rich(m); }

struct gn_made gn_seed_make(int number) {
    static void (*const make[GN_SEED_COUNT])(struct gn_maker *) = {
        seed_plain,     seed_rich,       seed_lights, seed_animated, seed_sparse, seed_quantized,
        seed_instanced, seed_compressed, seed_posed,  seed_ktx2,     seed_text};
    struct gn_maker maker;
    gn_maker_init(&maker);
    make[number](&maker);
    struct gn_made made =
        number == GN_SEED_COUNT - 1 ? gn_maker_gltf(&maker) : gn_maker_glb(&maker);
    gn_maker_finish(&maker);
    return made;
}
