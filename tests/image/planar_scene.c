#include "image/planar_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit/check.h"
#include "unit/gltf_maker.h"

/* Beside mesh 0, a square: mesh 1 is a cube, of 2 m as well, mesh 2 a square with square holes. */
static void add_meshes(struct gn_maker *m) {
    static const float uv[8] = {0, 0, 0, 1, 1, 1, 1, 0};
    gn_maker_cube(m);
    gn_maker_accessor(m, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    gn_maker_add(m, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':4},'indices':1,"
                 "'material':0}]}");
    gn_maker_set(m, "materials",
                 "[{'alphaMode':'MASK','doubleSided':true,'pbrMetallicRoughness':{"
                 "'metallicFactor':0,'baseColorTexture':{'index':0}}}]");
}

static void add_holes(struct gn_maker *m) {
    uint8_t texels[4 * 16];
    char image[80];
    memset(texels, 255, sizeof texels);
    for (int i = 0; i < 16; i++)
        if ((i + i / 4) % 2) texels[4 * i + 3] = 0;
    struct gn_made png = gn_maker_png(4, 4, texels);
    snprintf(image, sizeof image, "{'mimeType':'image/png','bufferView':%d}",
             gn_maker_view(m, png.data, png.size));
    free(png.data);
    gn_maker_add(m, "images", image);
    gn_maker_set(m, "samplers",
                 "[{'magFilter':9728,'minFilter':9728,'wrapS':33071,'wrapT':33071}]");
    gn_maker_set(m, "textures", "[{'source':0,'sampler':0}]");
}

const struct gn_planar_light gn_planar_lights[GN_PLANAR_LIGHTS] = {
    {"sun", GN_PLANAR_SUN, "'rotation':[-0.4334794,0.4272181,0.2454319,0.7545485]"},
    {"point", GN_PLANAR_POINT, "'translation':[-1,4,1.5]"},
    {"spot", GN_PLANAR_SPOT,
     "'translation':[-3,6,2],'rotation':[-0.4341391,-0.4106897,-0.2323442,0.7673808]"},
};

const struct gn_planar_turn gn_planar_turns[GN_PLANAR_TURNS] = {
    {"floor", "[0,0,0,1]"},
    {"tilted", "[0.2791983,0,0.1116793,0.953717]"},
    {"wall", "[0.7071068,0,0,0.7071068]"},
    {"ceiling", "[0,0,1,0]"}};

static struct gn_scene *make_scene(const char *turn, const struct gn_planar_light *light,
                                   const char *things, const char *named) {
    struct gn_maker m;
    struct gn_err err = {0};
    char json[4000], children[80] = "0";
    gn_maker_init(&m);
    gn_maker_square(&m);
    add_meshes(&m);
    add_holes(&m);
    int count = 1;
    for (const char *p = things; (p = strstr(p, ",{'mesh'")); p++)
        snprintf(children + strlen(children), sizeof children - strlen(children), ",%d", count++);
    snprintf(json, sizeof json,
             "[{'mesh':0,'scale':[5,1,5]%s}%s,{'children':[%s,%d,%d],"
             "'rotation':%s},{%s,'extensions':{'KHR_lights_punctual':{'light':0}}},{'camera':0,"
             "'translation':[3,11,7],'rotation':[-0.4546182,0.1781011,0.0933139,0.8676951]}]",
             named, things, children, count + 1, count + 2, turn, light->node);
    gn_maker_set(&m, "nodes", json);
    snprintf(json, sizeof json, "[{'nodes':[%d]}]", count);
    gn_maker_set(&m, "scenes", json);
    snprintf(json, sizeof json, "{'KHR_lights_punctual':{'lights':[%s]}}", light->light);
    gn_maker_set(&m, "extensions", json);
    gn_maker_set(&m, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&m, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.5,'zfar':40}}]");
    struct gn_scene *scene = gn_maker_load(&m, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

struct gn_scene *gn_planar_scene(const char *turn, const struct gn_planar_light *light,
                                 const char *things) {
    return make_scene(turn, light, things, ",'extras':{'gnomon_plane':true}");
}

struct gn_scene *gn_planar_room(const struct gn_planar_light *light) {
    static const char walls[] =
        ",{'mesh':0,'translation':[0,2.5,-4],'scale':[5,1,2.5],'rotation':[0.7071068,0,0,0.7071068]"
        "},{'mesh':0,'translation':[-4,2.5,0],'scale':[2.5,1,5],'rotation':[0,0,-0.7071068,"
        "0.7071068]}";
    char things[2000];
    snprintf(things, sizeof things, "%s%s", walls, gn_planar_things);
    return make_scene(gn_planar_turns[0].turn, light, things, "");
}

const char gn_planar_things[] =
    ",{'mesh':1,'translation':[-3,0.6,-2],'scale':[0.6,0.6,0.6]}"
    ",{'mesh':1,'translation':[-1.5,2,-3],'scale':[0.4,0.2,0.7],'rotation'"
    ":[0.2073116,0,0.0621935,0.976296]}"
    ",{'mesh':1,'translation':[2.5,0.3,-2.5],'scale':[0.7,0.8,0.5],'"
    "rotation':[0.2073116,0,0.0621935,0.976296]}"
    ",{'mesh':2,'translation':[1.5,1.2,1.5],'scale':[1.2,1,1.2],'rotation'"
    ":[0.2073116,0,0.0621935,0.976296]}"
    ",{'mesh':1,'translation':[-2.5,1,2.5],'scale':[0.05,1,0.05]}";
