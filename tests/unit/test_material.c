/* Extensions of materials: what they become, and what is named as missing. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/property.h"
#include "unit/scene_help.h"

static int setup_with_material(void **state) {
    setup(state);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    return 0;
}

static struct gn_scene *load_material(const char *material) {
    char json[600];
    setup_with_material(NULL);
    snprintf(json, sizeof json, "[{%s}]", material);
    gn_maker_set(&maker, "materials", json);
    return load();
}

static void assert_f0(const char *material, float r, float g, float b) {
    struct gn_scene *scene = load_material(material);
    const float wanted[] = {r, g, b};
    for (int k = 0; k < 3; k++) assert_near(scene->materials[0].f0[k], wanted[k]);
    assert_int_equal(gn_material_has_f0(&scene->materials[0]),
                     r != GN_F0 || g != GN_F0 || b != GN_F0);
    gn_scene_destroy(scene);
}

#define EXTENSIONS(text) "'extensions':{" text "}"

static void test_reflectance(void **state) {
    (void)state;
    assert_f0("", .04f, .04f, .04f);
    assert_f0(EXTENSIONS("'KHR_materials_ior':{}"), .04f, .04f, .04f);
    assert_f0(EXTENSIONS("'KHR_materials_ior':{'ior':1.5}"), .04f, .04f, .04f);
    assert_f0(EXTENSIONS("'KHR_materials_ior':{'ior':2}"), 1.0f / 9, 1.0f / 9, 1.0f / 9);
    assert_f0(EXTENSIONS("'KHR_materials_ior':{'ior':1}"), 0, 0, 0);
    assert_f0(EXTENSIONS("'KHR_materials_ior':{'ior':0}"), 1, 1, 1);
    assert_f0(EXTENSIONS("'KHR_materials_specular':{'specularFactor':0.5}"), .02f, .02f, .02f);
    assert_f0(EXTENSIONS("'KHR_materials_specular':{'specularColorFactor':[1,0.5,100]}"), .04f,
              .02f, 1);
    assert_f0(EXTENSIONS("'KHR_materials_specular':{'specularFactor':0.5,'specularColorFactor':"
                         "[100,1,1]},'KHR_materials_ior':{'ior':2}"),
              .5f, .5f / 9, .5f / 9); /* cut to 1 before the factor */
    assert_f0(EXTENSIONS("'KHR_materials_specular':{'specularFactor':-3}"), 0, 0, 0);
    assert_f0(EXTENSIONS("'KHR_materials_ior':{'ior':1e30}"), .99960f, .99960f, .99960f);
}

static void test_without_reflectance_there_is_no_highlight(void **state) {
    (void)state;
    struct gn_scene *scene = load_material(
        "'pbrMetallicRoughness':{'roughnessFactor':0.2,'metallicFactor':0}," EXTENSIONS(
            "'KHR_materials_specular':{'specularFactor':0}"));
    assert_false(gn_material_is_specular(&scene->materials[0]));
    gn_scene_destroy(scene);
}

static void test_specular_glossiness(void **state) {
    (void)state;
    struct gn_scene *scene = load_material(
        EXTENSIONS("'KHR_materials_pbrSpecularGlossiness':{'diffuseFactor':[0.5,1,0.25,0.75],"
                   "'specularFactor':[0.2,0.1,0],'glossinessFactor':0.7}"));
    const struct gn_material *m = &scene->materials[0];
    assert_int_equal(warnings.count, 0);
    assert_near(m->base_color[0], .4f); /* what is reflected is not diffuse */
    assert_near(m->base_color[1], .8f);
    assert_near(m->base_color[2], .2f);
    assert_near(m->base_color[3], .75f);
    assert_near(m->f0[0], .2f);
    assert_near(m->f0[1], .1f);
    assert_near(m->f0[2], 0);
    assert_near(m->roughness, .3f);
    assert_near(m->metalness, 0);
    gn_scene_destroy(scene);
}

static void test_what_is_missing_is_named(void **state) {
    (void)state;
    struct gn_scene *scene = load_material(EXTENSIONS(
        "'KHR_materials_sheen':{},'KHR_materials_volume':{'thicknessFactor':1},"
        "'KHR_materials_transmission':{'transmissionFactor':1},'KHR_materials_clearcoat':"
        "{'clearcoatFactor':1,'clearcoatNormalTexture':{'index':0}},'EXT_unknown':{},"
        "'KHR_materials_specular':{'specularTexture':{'index':0}}"));
    assert_string_equal(scene->missing, "normal maps of clear coat, refraction in volumes, sheen, "
                                        "textures of KHR_materials_specular");
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.text[0],
                        "t: shown without normal maps of clear coat, refraction in volumes, sheen, "
                        "textures of KHR_materials_specular: not supported yet");
    gn_scene_destroy(scene);
    scene = load_material("");
    assert_string_equal(scene->missing, "");
    gn_scene_destroy(scene);
}

static void test_materials_that_nothing_shows_miss_nothing(void **state) {
    (void)state;
    setup_with_material(NULL);
    gn_maker_set(&maker, "materials", "[{},{'extensions':{'KHR_materials_sheen':{}}}]");
    struct gn_scene *scene = load();
    assert_string_equal(scene->missing, "");
    assert_int_equal(warnings.count, 0);
    gn_scene_destroy(scene);
}

/* The material is shown without what is wrong, which a warning names. */
static void spare(const char *material, const char *message) {
    char json[600];
    snprintf(json, sizeof json, "'doubleSided':true,%s", material);
    struct gn_scene *scene = load_material(json);
    bool said = false;
    for (int i = 0; i < warnings.count; i++) said |= strstr(warnings.text[i], message) != NULL;
    if (!said) fail_msg("%s, not %s", warnings.text[0], message);
    assert_true(scene->materials[0].double_sided);
    for (int i = 0; i < GN_TEXTURE_SLOT_COUNT; i++)
        assert_int_equal(scene->materials[0].textures[i].texture, -1);
    gn_scene_destroy(scene);
}

static void test_clear_coat(void **state) {
    (void)state;
    struct gn_scene *scene =
        load_material(EXTENSIONS("'KHR_materials_clearcoat':{'clearcoatFactor':0.75,"
                                 "'clearcoatRoughnessFactor':0.25}"));
    const struct gn_material *m = &scene->materials[0];
    assert_int_equal(warnings.count, 0);
    assert_near(m->factors[GN_FACTOR_COAT], .75f);
    assert_near(m->factors[GN_FACTOR_COAT_ROUGHNESS], .25f);
    assert_true(gn_material_has(m, GN_LAYER_COAT) && gn_material_is_specular(m));
    assert_true(gn_material_needs_reflections(m));
    assert_false(gn_material_is_blended(m));
    gn_scene_destroy(scene);
    scene = load_material(EXTENSIONS("'KHR_materials_clearcoat':{'clearcoatFactor':7,"
                                     "'clearcoatRoughnessFactor':-1e30}"));
    assert_near(scene->materials[0].factors[GN_FACTOR_COAT], 1);
    assert_near(scene->materials[0].factors[GN_FACTOR_COAT_ROUGHNESS], 0);
    gn_scene_destroy(scene);
    scene = load_material(
        "'pbrMetallicRoughness':{'metallicFactor':0}," EXTENSIONS("'KHR_materials_clearcoat':{}"));
    assert_false(
        gn_material_has(&scene->materials[0], GN_LAYER_COAT)); /* 0 where nothing is said */
    assert_false(gn_material_needs_reflections(&scene->materials[0]));
    gn_scene_destroy(scene);
}

/* A material whose JSON has the property's factors, all of them that number. */
static struct gn_scene *load_factor(const struct gn_property *p, float value, const char *more) {
    const char *extension = p->path + strlen("extensions."), *key = strchr(extension, '.') + 1;
    char numbers[100] = "", json[400];
    for (uint32_t k = 0; k < p->components; k++)
        snprintf(numbers + strlen(numbers), sizeof numbers - strlen(numbers), "%s%g", k ? "," : "",
                 (double)value);
    snprintf(json, sizeof json, p->components > 1 ? "'%s':[%s]" : "'%s':%s", key, numbers);
    snprintf(numbers, sizeof numbers, "%s", json);
    snprintf(json, sizeof json, "'extensions':{%s'%.*s':{%s}}", more, (int)(key - 1 - extension),
             extension, numbers);
    return load_material(json);
}

static void assert_factors(const struct gn_scene *scene, int first, uint32_t count, float wanted) {
    for (uint32_t k = 0; k < count; k++)
        assert_near(scene->materials[0].factors[(uint32_t)first + k], wanted);
}

/* A factor of a layer is named by pointers, loaded, kept within its bounds, and 0 of what is unlit.
 */
static void check_factor(const char *path, enum gn_layer layer, int first) {
    char pointer[200];
    struct gn_property p;
    snprintf(pointer, sizeof pointer, "/%s", path);
    for (char *dot = pointer; (dot = strchr(dot, '.'));) *dot = '/';
    assert_true(gn_property_find(GN_THING_MATERIAL, pointer, &p));
    assert_int_equal(p.moves, GN_MOVES_FIRST_LAYER << layer);

    const float middle = p.least + (p.most - p.least) / 4;
    struct gn_scene *scene = load_factor(&p, middle, "");
    assert_factors(scene, first, p.components, middle);
    if (first == gn_layers[layer].first) assert_true(gn_material_has(&scene->materials[0], layer));
    gn_scene_destroy(scene);
    scene = load_factor(&p, p.most + 1, "");
    assert_factors(scene, first, p.components, p.most);
    gn_scene_destroy(scene);
    scene = load_factor(&p, middle, "'KHR_materials_unlit':{},");
    assert_factors(scene, first, p.components, 0);
    gn_scene_destroy(scene);
    scene = load_material("");
    assert_factors(scene, first, p.components, p.fallback);
    assert_false(gn_material_has(&scene->materials[0], layer));
    gn_scene_destroy(scene);
}

static void test_every_factor_of_a_layer_is_read_and_animated(void **state) {
    (void)state;
#define GN_X(LAYER, NAME, components, path, ...)                                                   \
    check_factor(path, GN_LAYER_##LAYER, GN_FACTOR_##NAME);
    GN_LAYERS(GN_LEAVE_OUT, GN_X, GN_LEAVE_OUT)
#undef GN_X
}

#define GLASS(factor) "'KHR_materials_transmission':{'transmissionFactor':" factor "}"

static void test_transmission(void **state) {
    (void)state;
    struct gn_scene *scene = load_material(EXTENSIONS(GLASS("0.8")));
    const struct gn_material *m = &scene->materials[0];
    assert_int_equal(warnings.count, 0);
    assert_near(m->factors[GN_FACTOR_TRANSMISSION], .8f);
    assert_int_equal(m->alpha, GN_ALPHA_OPAQUE);
    assert_true(gn_material_is_blended(m) && gn_material_is_clear(m));
    assert_false(gn_material_is_tinted(m) || gn_material_has_opaque_texels(m));
    gn_scene_destroy(scene);
    scene = load_material(
        "'pbrMetallicRoughness':{'baseColorFactor':[1,0.5,0.5,1]}," EXTENSIONS(GLASS("0.4")));
    m = &scene->materials[0];
    assert_true(gn_material_is_blended(m) && gn_material_is_tinted(m));
    assert_false(gn_material_is_clear(m)); /* less than half */
    gn_scene_destroy(scene);
    scene = load_material(EXTENSIONS(GLASS("-1")));
    assert_false(gn_material_is_blended(&scene->materials[0]));
    gn_scene_destroy(scene);
    scene = load_material(EXTENSIONS(GLASS("1") ",'KHR_materials_unlit':{},"
                                                "'KHR_materials_clearcoat':{'clearcoatFactor':1}"));
    m = &scene->materials[0];
    assert_false(gn_material_is_transmissive(m) || gn_material_has(m, GN_LAYER_COAT));
    gn_scene_destroy(scene);
}

static void assert_volume(const char *volume, const char *transmission, bool refracts, float r,
                          float g) {
    char text[400];
    snprintf(text, sizeof text,
             "'pbrMetallicRoughness':{'baseColorFactor':[0.5,1,1,1]},'extensions':{"
             "'KHR_materials_volume':{%s},'KHR_materials_transmission':{'transmissionFactor':%s}}",
             volume, transmission);
    struct gn_scene *scene = load_material(text);
    assert_near(scene->materials[0].base_color[0], r);
    assert_near(scene->materials[0].base_color[1], g);
    assert_string_equal(scene->missing, refracts ? "refraction in volumes" : "");
    gn_scene_destroy(scene);
}

static void test_a_volume_tints(void **state) {
    (void)state;
#define COLOR "'attenuationColor':[1,0.25,1],'attenuationDistance':2,'thicknessFactor':"
    assert_volume(COLOR "1", "1", true, .5f, .5f); /* half of the distance: its root */
    assert_volume(COLOR "2", "1", true, .5f, .25f);
    assert_volume(COLOR "1000", "1", true, .5f, .25f); /* not more than once */
    assert_volume(COLOR "1", "0.5", true, .5f, .75f); /* what is not transmitted keeps its colour */
    assert_volume(COLOR "0", "1", false, .5f, 1);
    assert_volume("'attenuationColor':[0,0,0],'thicknessFactor':3", "1", true, .5f,
                  1); /* infinitely far */
    assert_volume("'attenuationColor':[0,0,0],'attenuationDistance':-1,'thicknessFactor':3", "1",
                  true, .5f, 1);
    assert_volume("'attenuationColor':[-9,0,9],'attenuationDistance':1,'thicknessFactor':1", "1",
                  true, 0, 0);
}

static void test_wrong_types_cost_themselves_alone(void **state) {
    (void)state;
    spare(EXTENSIONS("'KHR_materials_ior':{'ior':'glass'}"),
          "t: materials[0].extensions.KHR_materials_ior.ior: must be a number, is a string");
    spare(EXTENSIONS("'KHR_materials_specular':{'specularColorFactor':[1,1]}"),
          "t: materials[0].extensions.KHR_materials_specular.specularColorFactor: must have 3 "
          "numbers, has 2");
    spare(EXTENSIONS("'KHR_materials_pbrSpecularGlossiness':{'diffuseTexture':{'index':7}}"),
          "t: materials[0].extensions.KHR_materials_pbrSpecularGlossiness.diffuseTexture.index: "
          "index 7, but there are 0 textures");
    spare(EXTENSIONS("'KHR_materials_clearcoat':{'clearcoatFactor':[1]}"),
          "t: materials[0].extensions.KHR_materials_clearcoat.clearcoatFactor: must be a number, "
          "is an array");
    spare(EXTENSIONS("'KHR_materials_clearcoat':{'clearcoatTexture':{'index':-3}}"),
          "t: materials[0].extensions.KHR_materials_clearcoat.clearcoatTexture.index: index "
          "-3, but there are 0 textures");
    spare(EXTENSIONS("'KHR_materials_clearcoat':{'clearcoatFactor':1,'clearcoatRoughnessTexture':"
                     "{'index':4}}"),
          "t: materials[0].extensions.KHR_materials_clearcoat.clearcoatRoughnessTexture.index: "
          "index 4, but there are 0 textures");
    spare(EXTENSIONS("'KHR_materials_transmission':7"),
          "t: materials[0].extensions.KHR_materials_transmission: must be an object, is a "
          "number");
    spare(EXTENSIONS("'KHR_materials_transmission':{'transmissionFactor':1,'transmissionTexture':"
                     "{}}"),
          "t: materials[0].extensions.KHR_materials_transmission.transmissionTexture.index: "
          "missing");
    spare(EXTENSIONS("'KHR_materials_volume':{'attenuationColor':[1]}"),
          "t: materials[0].extensions.KHR_materials_volume.attenuationColor: must have 3 numbers, "
          "has 1");
}

static void add_textures(void) {
    static const uint8_t red[] = {255, 0, 0, 255};
    char json[80];
    struct gn_made png = gn_maker_png(1, 1, red);
    snprintf(json, sizeof json, "[{'bufferView':%d}]", gn_maker_view(&maker, png.data, png.size));
    free(png.data);
    gn_maker_set(&maker, "images", json);
    gn_maker_set(&maker, "textures", "[{'source':0},{'source':0}]");
}

static const struct gn_texture_ref *lightmap_of(const struct gn_scene *scene) {
    return &scene->materials[0].textures[GN_TEXTURE_LIGHTMAP];
}

static struct gn_scene *load_textured(const char *material) {
    char json[600];
    setup_with_material(NULL);
    add_textures();
    snprintf(json, sizeof json, "[{%s}]", material);
    gn_maker_set(&maker, "materials", json);
    return load();
}

static void test_light_maps(void **state) {
    (void)state;
    struct gn_scene *scene =
        load_textured(EXTENSIONS("'MOZ_lightmap':{'index':1,'texCoord':1,'intensity':2.5}"));
    assert_int_equal(lightmap_of(scene)->texture, 0); /* the scene's number */
    assert_int_equal(lightmap_of(scene)->uv_set, 1);
    assert_near(scene->materials[0].lightmap_intensity, 2.5f);
    assert_int_equal(warnings.count, 0);
    gn_scene_destroy(scene);
    scene = load_textured("'extras':{'gnomon_lightmap':1,'gnomon_lightmap_intensity':3}");
    assert_true(lightmap_of(scene)->texture >= 0);
    assert_int_equal(lightmap_of(scene)->uv_set, 1);
    assert_near(scene->materials[0].lightmap_intensity, 3);
    gn_scene_destroy(scene);
    scene = load_textured("'extras':{'gnomon_lightmap':2}");
    assert_int_equal(lightmap_of(scene)->texture, -1);
    assert_int_equal(warnings.count, 1);
    gn_scene_destroy(scene);
}

static void test_textures_of_coat_and_transmission(void **state) {
    (void)state;
    struct gn_scene *scene = load_textured(
        EXTENSIONS("'KHR_materials_clearcoat':{'clearcoatFactor':1,'clearcoatTexture':{'index':0},"
                   "'clearcoatRoughnessTexture':{'index':1,'texCoord':1}},"
                   "'KHR_materials_transmission':{'transmissionFactor':1,"
                   "'transmissionTexture':{'index':1}}"));
    const struct gn_material *m = &scene->materials[0];
    assert_int_equal(warnings.count, 0);
    assert_true(m->textures[GN_TEXTURE_COAT].texture >= 0);
    assert_true(m->textures[GN_TEXTURE_TRANSMISSION].texture >= 0);
    assert_int_equal(m->textures[GN_TEXTURE_COAT_ROUGHNESS].uv_set, 1);
    assert_true(gn_material_has_opaque_texels(m)); /* where the texture is 0 */
    assert_false(gn_material_is_clear(m));
    assert_true(scene->pictures.images[0].as_data && !scene->pictures.images[0].as_color);
    gn_scene_destroy(scene);
    /* nothing of a coat of 0: its texture is not even read */
    scene = load_textured(EXTENSIONS("'KHR_materials_clearcoat':{'clearcoatTexture':{'index':0}}"));
    assert_int_equal(scene->materials[0].textures[GN_TEXTURE_COAT].texture, -1);
    assert_int_equal(scene->pictures.image_count, 0);
    gn_scene_destroy(scene);
}

static void test_too_many_textures(void **state) {
    (void)state;
    setup_with_material(NULL);
    add_textures();
    gn_maker_set(
        &maker, "materials",
        "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0},'metallicRoughnessTexture':"
        "{'index':0}},'emissiveTexture':{'index':0},'occlusionTexture':{'index':0},"
        "'normalTexture':{'index':0},'extensions':{'MOZ_lightmap':{'index':0},"
        "'KHR_materials_clearcoat':{'clearcoatFactor':1,'clearcoatTexture':{'index':0},"
        "'clearcoatRoughnessTexture':{'index':1}},'KHR_materials_transmission':"
        "{'transmissionFactor':1,'transmissionTexture':{'index':1}}}}]");
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 3); /* the first: no coordinates for its normal map */
    assert_string_equal(warnings.text[1], "t: materials[0]: more than 7 textures; shown without "
                                          "the clearcoatTexture");
    assert_string_equal(warnings.text[2], "t: materials[0]: more than 7 textures; shown without "
                                          "the clearcoatRoughnessTexture");
    assert_int_equal(scene->material_textures, GN_MATERIAL_TEXTURES_MAX);
    gn_scene_destroy(scene);
}

/* What is read of a texture: roughness is 1 - factor x alpha, texel by texel; the colour's mean, of
 * red (1) and black, is the reflectance. */
static void test_a_glossiness_texture_becomes_one_of_roughness(void **state) {
    (void)state;
    static const uint8_t two[] = {255, 0, 0, 255, 0, 0, 0, 51};
    char json[900];
    setup_with_material(NULL);
    struct gn_made png = gn_maker_png(2, 1, two);
    snprintf(json, sizeof json, "[{'bufferView':%d}]", gn_maker_view(&maker, png.data, png.size));
    free(png.data);
    gn_maker_set(&maker, "images", json);
    gn_maker_set(&maker, "textures", "[{'source':0}]");
#define GLOSSY(factor)                                                                             \
    "{" EXTENSIONS("'KHR_materials_pbrSpecularGlossiness':{'specularFactor':[0.8,1,1],"            \
                   "'glossinessFactor':" factor ",'specularGlossinessTexture':{'index':0}}") "}"
    gn_maker_set(&maker, "materials", "[" GLOSSY("0.5") "," GLOSSY("0.5") "," GLOSSY("1") "]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0},"
                 "{'attributes':{'POSITION':0},'indices':1,'material':1},"
                 "{'attributes':{'POSITION':0},'indices':1,'material':2}]}]");
    struct gn_scene *scene = load();
    const struct gn_material *m = &scene->materials[0];
    const int32_t texture = m->textures[GN_TEXTURE_ROUGHNESS].texture;
    assert_true(texture >= 0);
    const struct gn_image *image = &scene->pictures.images[scene->pictures.textures[texture].image];
    assert_near(m->roughness, 1);
    assert_near(m->metalness, 0);
    assert_in_range(image->rgba[1], 127, 128);
    assert_in_range(image->rgba[5], 229, 230); /* 255 - 51 / 2 */
    assert_int_equal(image->rgba[6], 0);
    assert_true(image->as_data && !scene->pictures.images[0].as_color);
    assert_near(m->f0[0], .4f);
    assert_near(m->f0[1], 0);
    assert_near(m->base_color[1], .6f);
    assert_int_equal(scene->materials[1].textures[GN_TEXTURE_ROUGHNESS].texture, texture);
    /* made once: not with another factor */
    assert_int_equal(scene->materials[2].textures[GN_TEXTURE_ROUGHNESS].texture, -1);
    assert_string_equal(scene->missing, "a specular-glossiness texture with two factors");
    gn_scene_destroy(scene);
}

static void test_sets_beyond_the_first_two(void **state) {
    (void)state;
    static const float uv[8] = {0, 0, 5, 0, 5, 5, 0, 5}, other[8] = {0, 0, 7, 0, 7, 7, 0, 7};
    setup_with_material(NULL);
    add_textures();
    gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    gn_maker_accessor(&maker, "VEC2", 5126, 4, other, sizeof other, NULL);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':2}},"
                 "'normalTexture':{'index':1,'texCoord':7}}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_2':2,'TEXCOORD_7':3},"
                 "'indices':1,'material':0}]}]");
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 0);
    assert_int_equal(scene->materials[0].textures[GN_TEXTURE_BASE].uv_set, 0);
    assert_int_equal(scene->materials[0].textures[GN_TEXTURE_NORMAL].uv_set, 1);
    assert_near(scene->buffers.uv0[2 * scene->buffers.indices[2] + 1], 5);
    assert_near(scene->buffers.uv1[2 * scene->buffers.indices[2] + 1], 7);
    assert_true(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_TANGENT));
    gn_scene_destroy(scene);
}

static void test_materials_of_other_reflectance_share_no_call(void **state) {
    (void)state;
    setup_with_material(NULL);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'roughnessFactor':0.2,'metallicFactor':0}},"
                 "{'pbrMetallicRoughness':{'roughnessFactor':0.2,'metallicFactor':0},"
                 "'extensions':{'KHR_materials_ior':{'ior':1.8}}}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0},"
                 "{'attributes':{'POSITION':0},'indices':1,'material':1}]}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->items[1].batch, 1);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reflectance),
        cmocka_unit_test(test_without_reflectance_there_is_no_highlight),
        cmocka_unit_test(test_specular_glossiness),
        cmocka_unit_test(test_what_is_missing_is_named),
        cmocka_unit_test(test_materials_that_nothing_shows_miss_nothing),
        cmocka_unit_test(test_every_factor_of_a_layer_is_read_and_animated),
        cmocka_unit_test(test_clear_coat),
        cmocka_unit_test(test_transmission),
        cmocka_unit_test(test_a_volume_tints),
        cmocka_unit_test(test_wrong_types_cost_themselves_alone),
        cmocka_unit_test(test_light_maps),
        cmocka_unit_test(test_textures_of_coat_and_transmission),
        cmocka_unit_test(test_too_many_textures),
        cmocka_unit_test(test_a_glossiness_texture_becomes_one_of_roughness),
        cmocka_unit_test(test_sets_beyond_the_first_two),
        cmocka_unit_test(test_materials_of_other_reflectance_share_no_call),
    };
    return RUN(tests);
}
