#include "gpus/scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit/gltf_maker.h"

enum { FLOATS = 5126, SHORTS = 5123, BYTES = 5121 };

/* Base, roughness, emission and occlusion are all read from one texture. */
static const char *const materials[] = {
    "{'name':'plain','pbrMetallicRoughness':{'roughnessFactor':0.5,'metallicFactor':0,"
    "'baseColorTexture':{'index':0}}}",
    "{'name':'matt','pbrMetallicRoughness':{'metallicFactor':0}}",
    "{'name':'rough','pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':1},"
    "'metallicRoughnessTexture':{'index':0,'texCoord':1}}}",
    "{'name':'lamp','emissiveFactor':[1,1,1],'emissiveTexture':{'index':0},"
    "'pbrMetallicRoughness':{'metallicFactor':0}}",
    "{'name':'corner','occlusionTexture':{'index':0},'pbrMetallicRoughness':{'metallicFactor':0}}",
    "{'name':'all','emissiveFactor':[1,1,1],'emissiveTexture':{'index':0,'texCoord':1},"
    "'occlusionTexture':{'index':0,'texCoord':1},'doubleSided':true,'alphaMode':'MASK',"
    "'pbrMetallicRoughness':{'baseColorTexture':{'index':0},'metallicRoughnessTexture':"
    "{'index':0}}}",
    "{'name':'embossed','normalTexture':{'index':0},'pbrMetallicRoughness':{'roughnessFactor':0.5,"
    "'metallicFactor':0,'baseColorTexture':{'index':0}}}",
    "{'name':'leaf','alphaMode':'MASK','doubleSided':true,'pbrMetallicRoughness':"
    "{'metallicFactor':0,'baseColorTexture':{'index':0}}}",
    "{'name':'glass','alphaMode':'BLEND','pbrMetallicRoughness':{'metallicFactor':0,"
    "'roughnessFactor':0.2,'baseColorFactor':[1,1,1,0.4]}}",
    "{'name':'sign','extensions':{'KHR_materials_unlit':{}}}",
    "{'name':'picture','extensions':{'KHR_materials_unlit':{}},'pbrMetallicRoughness':"
    "{'baseColorTexture':{'index':0}}}",
    "{'name':'paint','pbrMetallicRoughness':{'roughnessFactor':0.5,'metallicFactor':0,"
    "'baseColorTexture':{'index':0}},'extensions':{'KHR_materials_clearcoat':{'clearcoatFactor':1}"
    "}}",
    "{'name':'pane','pbrMetallicRoughness':{'roughnessFactor':0.1,'metallicFactor':0},"
    "'extensions':{'KHR_materials_transmission':{'transmissionFactor':1}}}",
    "{'name':'bottle','pbrMetallicRoughness':{'roughnessFactor':0.1,'metallicFactor':0,"
    "'baseColorTexture':{'index':0}},'extensions':{'KHR_materials_transmission':"
    "{'transmissionFactor':1,'transmissionTexture':{'index':0}},'KHR_materials_clearcoat':"
    "{'clearcoatFactor':1,'clearcoatTexture':{'index':0},'clearcoatRoughnessTexture':{'index':0}}}"
    "}",
    "{'name':'worn','pbrMetallicRoughness':{'baseColorTexture':{'index':0},"
    "'metallicRoughnessTexture':{'index':0}}}",
    "{'name':'engraved','normalTexture':{'index':0},'pbrMetallicRoughness':{'baseColorTexture':"
    "{'index':0},'metallicRoughnessTexture':{'index':0}}}",
};
enum {
    ALL = 5,
    GLASS = 8,
    SIGN = 9,
    PAINT = 11,
    LOOKS = 14,
    MATERIAL_COUNT = LOOKS + 2,
};
_Static_assert(MATERIAL_COUNT == sizeof materials / sizeof *materials, "materials");

static void add_texture(struct gn_maker *m) {
    static const uint8_t pixels[16] = {255, 255, 255, 255, 90,  90,  90,  255,
                                       90,  90,  90,  128, 255, 255, 255, 255};
    struct gn_made png = gn_maker_png(2, 2, pixels);
    char json[80];
    snprintf(json, sizeof json, "{'mimeType':'image/png','bufferView':%d}",
             gn_maker_view(m, png.data, png.size));
    free(png.data);
    gn_maker_add(m, "images", json);
    gn_maker_set(m, "textures", "[{'source':0}]");
}

/* A square of 2 m with all that a vertex can have, facing up; once more with colours. Returns the
 * accessors' names for a primitive, with or without colours. */
struct square {
    char plain[160], colored[200];
};

static struct square add_square(struct gn_maker *m) {
    static const float positions[] = {-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1};
    static const float normals[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    static const float uv[] = {0, 0, 0, 1, 1, 1, 1, 0};
    static const float colors[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    static const uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    struct square s;
    const int p = gn_maker_accessor(m, "VEC3", FLOATS, 4, positions, sizeof positions,
                                    "'min':[-1,0,-1],'max':[1,0,1]");
    const int n = gn_maker_accessor(m, "VEC3", FLOATS, 4, normals, sizeof normals, NULL);
    const int u = gn_maker_accessor(m, "VEC2", FLOATS, 4, uv, sizeof uv, NULL);
    const int c = gn_maker_accessor(m, "VEC3", FLOATS, 4, colors, sizeof colors, NULL);
    const int i = gn_maker_accessor(m, "SCALAR", SHORTS, 6, indices, sizeof indices, NULL);
    const char *const format = "'indices':%d,'attributes':{'POSITION':%d,'NORMAL':%d,"
                               "'TEXCOORD_0':%d,'TEXCOORD_1':%d";
    int used = snprintf(s.plain, sizeof s.plain, format, i, p, n, u, u);
    snprintf(s.colored, sizeof s.colored, "%s,'COLOR_0':%d}", s.plain, c);
    snprintf(s.plain + used, sizeof s.plain - (size_t)used, "}");
    return s;
}

static void add_card(struct gn_maker *m, const char *primitive, int material, float x, float y,
                     float side) {
    char json[320];
    snprintf(json, sizeof json, "{'primitives':[{%s,'material':%d}]}", primitive, material);
    const int mesh = gn_maker_add(m, "meshes", json);
    snprintf(json, sizeof json, "{'mesh':%d,'translation':[%g,%g,0],'scale':[%g,1,%g]}", mesh,
             (double)x, (double)y, (double)side, (double)side);
    gn_maker_add(m, "nodes", json);
}

/* Cards of material 0 that deform, each in another way. */
static void add_posed(struct gn_maker *m, const struct square *square) {
    static const uint8_t joints[16] = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
    static const float eighths[16] = {.125f, .125f, .125f, .125f, .125f, .125f, .125f, .125f,
                                      .125f, .125f, .125f, .125f, .125f, .125f, .125f, .125f};
    static const float lift[12] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    static const float times[2] = {0, 1}, places[6] = {0, 1, 0, 0, 1.5f, 0};
    char four[60], eight[120], target[60], json[500];
    const int j = gn_maker_accessor(m, "VEC4", BYTES, 4, joints, sizeof joints, NULL);
    const int w = gn_maker_accessor(m, "VEC4", FLOATS, 4, eighths, sizeof eighths, NULL);
    const int t = gn_maker_accessor(m, "VEC3", FLOATS, 4, lift, sizeof lift, NULL);
    const int joint = gn_maker_add(m, "nodes", "{'translation':[0,1,0]}");
    gn_maker_add(m, "nodes", "{'translation':[0,1.2,0]}");
    snprintf(json, sizeof json, "[{'joints':[%d,%d]}]", joint, joint + 1);
    gn_maker_set(m, "skins", json);
    snprintf(json, sizeof json,
             "[{'samplers':[{'input':%d,'output':%d}],"
             "'channels':[{'sampler':0,'target':{'node':%d,'path':'translation'}}]}]",
             gn_maker_accessor(m, "SCALAR", FLOATS, 2, times, sizeof times, "'min':[0],'max':[1]"),
             gn_maker_accessor(m, "VEC3", FLOATS, 2, places, sizeof places, NULL), joint);
    gn_maker_set(m, "animations", json);
    snprintf(four, sizeof four, ",'JOINTS_0':%d,'WEIGHTS_0':%d", j, w);
    snprintf(eight, sizeof eight, "%s,'JOINTS_1':%d,'WEIGHTS_1':%d", four, j, w);
    snprintf(target, sizeof target, ",'targets':[{'POSITION':%d,'NORMAL':%d}]", t, t);
    const char *const skins[] = {four, eight, "", four}, *const targets[] = {"", "", target,
                                                                             target};
    for (int i = 0; i < 4; i++) {
        snprintf(json, sizeof json, "{'primitives':[{%.*s%s}%s,'material':0}]}",
                 (int)strlen(square->plain) - 1, square->plain, skins[i], targets[i]);
        const int mesh = gn_maker_add(m, "meshes", json);
        snprintf(json, sizeof json, "{'mesh':%d%s%s,'translation':[0,1.5,0]}", mesh,
                 *skins[i] ? ",'skin':0" : "", *targets[i] ? ",'weights':[0.5]" : "");
        gn_maker_add(m, "nodes", json);
    }
}

static const char *const kinds[] = {
    [GN_LIGHT_DIRECTIONAL] = "'type':'directional','intensity':2",
    [GN_LIGHT_POINT] = "'type':'point','intensity':30",
    [GN_LIGHT_SPOT] = "'type':'spot','intensity':60,'spot':{'outerConeAngle':0.7}",
};

static void add_lamp(struct gn_maker *m, json_t *lights, enum gn_light_type type,
                     const char *extras, bool ranged, float x) {
    char json[300];
    json_error_t error;
    snprintf(json, sizeof json, "{%s%s%s%s}", kinds[type], extras ? ",'extras':" : "",
             extras ? extras : "", ranged ? ",'range':9" : "");
    for (char *c = json; *c; c++)
        if (*c == '\'') *c = '"';
    json_array_append_new(lights, json_loads(json, 0, &error));
    /* it looks down, from a little aside */
    snprintf(json, sizeof json,
             "{'translation':[%g,4,1],'rotation':[-0.64,0.2,0.18,0.72],"
             "'extensions':{'KHR_lights_punctual':{'light':%d}}}",
             (double)x, (int)json_array_size(lights) - 1);
    gn_maker_add(m, "nodes", json);
}

static void add_lights(struct gn_maker *m, enum gn_gpu_scene scene) {
    json_t *lights = json_array();
    switch (scene) {
    case GN_GPU_SUN:
    case GN_GPU_FEW_MATERIALS:
    case GN_GPU_POSED:
    case GN_GPU_MATERIALS: add_lamp(m, lights, GN_LIGHT_DIRECTIONAL, NULL, false, 0); break;
    case GN_GPU_POINT: add_lamp(m, lights, GN_LIGHT_POINT, NULL, false, 0); break;
    case GN_GPU_SPOT: add_lamp(m, lights, GN_LIGHT_SPOT, NULL, false, 0); break;
    case GN_GPU_SLIDE: add_lamp(m, lights, GN_LIGHT_SPOT, "{'gnomon_slide':0}", false, 0); break;
    case GN_GPU_FILM:
        add_lamp(m, lights, GN_LIGHT_SPOT, "{'gnomon_slide':0,'gnomon_slide_outside':'lit'}", false,
                 0);
        break;
    default:
        for (int i = 0; i < (scene == GN_GPU_CROWD ? 10 : 3); i++)
            add_lamp(m, lights, (enum gn_light_type)(i % 3), NULL, scene == GN_GPU_CROWD && i % 3,
                     (float)i - 5);
    }
    json_t *all = json_pack("{s{so}}", "KHR_lights_punctual", "lights", lights);
    json_object_set_new(m->root, "extensions", all);
    gn_maker_set(m, "extensionsUsed", "['KHR_lights_punctual','KHR_materials_unlit']");
}

/* Everything, near an eye that sees a part of the ground: the sun's map goes with it. */
static void add_scene(struct gn_maker *m) {
    gn_maker_add(m, "cameras", "{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}");
    gn_maker_add(m, "nodes", "{'camera':0,'translation':[0,3,9],'rotation':[-0.13,0,0,0.9915]}");
    json_t *nodes = json_array();
    const size_t count = json_array_size(json_object_get(m->root, "nodes"));
    for (size_t i = 0; i < count; i++) json_array_append_new(nodes, json_integer((json_int_t)i));
    json_object_set_new(m->root, "scenes",
                        json_pack("[{sos{s[fff]s[fff]}}]", "nodes", nodes, "extras", "gnomon_sky",
                                  .3, .4, .6, "gnomon_ground", .1, .1, .1));
    gn_maker_set(m, "scene", "0");
}

struct gn_scene *gn_gpu_scene_make(enum gn_gpu_scene scene) {
    struct gn_maker m;
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    gn_maker_init(&m);
    add_texture(&m);
    for (int i = 0; i < MATERIAL_COUNT; i++) gn_maker_add(&m, "materials", materials[i]);
    const struct square square = add_square(&m);
    const bool look = scene == GN_GPU_LOOK; /* which has the light and the floor that are made */
    if (!look) add_card(&m, square.plain, 0, 0, 0, 60);
    /* a row of them, longer than what an eye sees that is near: the sun's map goes with it */
    for (int i = -5; i <= 5 && !look; i++) add_card(&m, square.plain, 0, 3.3f * (float)i, 1, 1);
    for (int i = 1; i < MATERIAL_COUNT; i++) {
        const float x = (float)i - 5, y = 0.5f + 0.1f * (float)i;
        if (look && i >= LOOKS) add_card(&m, square.plain, i, x, y, 0.5f);
        if (i >= LOOKS) continue;
        const bool few = scene == GN_GPU_FEW_MATERIALS, all = scene == GN_GPU_MATERIALS;
        if (all || (few && (i == GLASS || i == SIGN || i >= PAINT)))
            add_card(&m, square.plain, i, x, y, 0.5f);
        if (all || (few && i == ALL)) add_card(&m, square.colored, i, x, y + 1.1f, 0.5f);
    }
    if (scene == GN_GPU_POSED) add_posed(&m, &square);
    if (scene == GN_GPU_CROWD) add_card(&m, square.plain, GLASS, 0, 2, 1);
    if (!look) add_lights(&m, scene);
    add_scene(&m);
    const struct gn_scene_limits limits = {.floor.kind = look ? GN_FLOOR_AUTO : GN_FLOOR_NONE};
    struct gn_made glb = gn_maker_glb(&m);
    struct gn_scene *made =
        gn_scene_load_bytes("gpus", glb.data, glb.size, &limits, &warnings, &err);
    free(glb.data);
    gn_maker_finish(&m);
    if (made && warnings.count == 0) return made;
    fprintf(stderr, "scene %d: %s\n", (int)scene, made ? warnings.text[0] : err.text);
    abort();
}
