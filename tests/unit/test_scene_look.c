/* Materials, textures, pictures, batches. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/read.h"
#include "unit/scene_help.h"
#include "unit/webp_bytes.h"

static int setup_with_material(void **state) {
    setup(state);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    return 0;
}

static void add_picture(const void *data, size_t size) {
    char json[80];
    snprintf(json, sizeof json, "{'bufferView':%d}", gn_maker_view(&maker, data, size));
    int image = gn_maker_add(&maker, "images", json);
    snprintf(json, sizeof json, "{'source':%d}", image);
    gn_maker_add(&maker, "textures", json);
}

#define BASE_TEXTURE "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}]"

/* ---- materials ---- */

static void test_factors(void **state) {
    (void)state;
    gn_maker_set(&maker, "materials",
                 "[{'name':'m','alphaMode':'MASK','alphaCutoff':0.25,'doubleSided':true,'"
                 "emissiveFactor':[1,0.5,0],"
                 "'extensions':{'KHR_materials_emissive_strength':{'emissiveStrength':4},'KHR_"
                 "materials_unlit':{}},"
                 "'pbrMetallicRoughness':{'baseColorFactor':[0.1,0.2,0.3,0.4],'metallicFactor':0.5,"
                 "'roughnessFactor':7}}]");
    struct gn_scene *scene = load();
    const struct gn_material *m = &scene->materials[0];
    assert_int_equal(scene->material_count, 2);
    assert_string_equal(m->name, "m");
    assert_true(m->alpha == GN_ALPHA_MASK && m->double_sided && m->unlit);
    assert_near(m->alpha_cutoff, .25f);
    assert_near(m->emissive[1], 2);
    assert_near(m->base_color[3], .4f);
    assert_near(m->metalness, .5f);
    assert_near(m->roughness, 1);
    assert_near(scene->materials[1].metalness, 1); /* glTF's default */
    gn_scene_destroy(scene);
}

/* The extension's own example: the lower left quadrant, turned. */
static void test_texture_transform(void **state) {
    (void)state;
    static const uint8_t red[] = {255, 0, 0, 255};
    struct gn_made png = gn_maker_png(1, 1, red);
    add_picture(png.data, png.size);
    free(png.data);
    gn_maker_set(
        &maker, "materials",
        "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':0,'extensions':"
        "{'KHR_texture_transform':{'offset':[0,1],'rotation':1.5707963,'scale':[0.5,0.5],'texCoord'"
        ":1}}}},"
        "'emissiveTexture':{'index':0,'texCoord':3},'occlusionTexture':{'index':0,'texCoord':2}}]");
    struct gn_scene *scene = load();
    const struct gn_texture_ref *ref = &scene->materials[0].textures[GN_TEXTURE_BASE];
    const float *m = ref->uv_from_uv;
    assert_int_equal(ref->uv_set, 0); /* the first of the two that are read: TEXCOORD_1 */
    assert_near(m[0] * 1 + m[2] * 0 + m[4], 0);
    assert_near(m[1] * 1 + m[3] * 0 + m[5], .5f);
    assert_near(m[0] * 0 + m[2] * 1 + m[4], .5f);
    assert_int_equal(scene->materials[0].textures[GN_TEXTURE_OCCLUSION].texture, -1);
    assert_string_equal(warnings.text[0],
                        "t: materials[0].occlusionTexture: texCoord 2: the material reads sets 1 "
                        "and 3, and no third; shown without this texture");
    gn_scene_destroy(scene);
}

static void test_samplers(void **state) {
    (void)state;
    static const uint8_t red[] = {255, 0, 0, 255};
    struct gn_made png = gn_maker_png(1, 1, red);
    add_picture(png.data, png.size);
    free(png.data);
    gn_maker_set(&maker, "textures", "[{'source':0,'sampler':0},{'source':0}]");
    gn_maker_set(&maker, "samplers",
                 "[{'magFilter':9728,'minFilter':9729,'wrapS':33071,'wrapT':33648}]");
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},'emissiveTexture':{'"
                 "index':1}}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->pictures.image_count, 1);
    const struct gn_texture *t = scene->pictures.textures;
    assert_true(t[0].mag_nearest && !t[0].mipmaps && !t[0].min_nearest);
    assert_true(t[0].wrap_s == GN_WRAP_CLAMP && t[0].wrap_t == GN_WRAP_MIRROR);
    assert_true(!t[1].mag_nearest && t[1].mipmaps && !t[1].mip_nearest &&
                t[1].wrap_s == GN_WRAP_REPEAT);
    gn_scene_destroy(scene);
}

/* ---- pictures ---- */

static void test_png_rgba(void **state) {
    (void)state;
    static const uint8_t rgba[] = {1, 2, 3, 4, 5, 6, 7, 255, 9, 10, 11, 255, 13, 14, 15, 255};
    struct gn_made png = gn_maker_png(2, 2, rgba);
    add_picture(png.data, png.size);
    free(png.data);
    gn_maker_set(&maker, "materials", BASE_TEXTURE);
    struct gn_scene *scene = load();
    assert_memory_equal(scene->pictures.images[0].rgba, rgba, sizeof rgba);
    assert_true(scene->pictures.images[0].has_alpha);
    gn_scene_destroy(scene);
}

static void test_png_of_16_bits(void **state) {
    (void)state;
    static const uint16_t grey[] = {0, 65535, 32896, 257};
    struct gn_made png = gn_maker_png_grey16(4, 1, grey);
    add_picture(png.data, png.size);
    free(png.data);
    gn_maker_set(&maker, "materials", BASE_TEXTURE);
    struct gn_scene *scene = load();
    static const uint8_t wanted[] = {0,   0,   0,   255, 255, 255, 255, 255,
                                     128, 128, 128, 255, 1,   1,   1,   255};
    assert_memory_equal(scene->pictures.images[0].rgba, wanted, sizeof wanted);
    assert_false(scene->pictures.images[0].has_alpha);
    gn_scene_destroy(scene);
}

static void test_jpeg(void **state) {
    (void)state;
    uint8_t rgb[8 * 8 * 3];
    for (size_t i = 0; i < sizeof rgb; i++) rgb[i] = (uint8_t)(i % 3 == 0 ? 200 : 40);
    struct gn_made jpeg = gn_maker_jpeg(8, 8, rgb);
    add_picture(jpeg.data, jpeg.size);
    free(jpeg.data);
    gn_maker_set(&maker, "materials", BASE_TEXTURE);
    struct gn_scene *scene = load();
    assert_true(abs(scene->pictures.images[0].rgba[0] - 200) < 4 &&
                abs(scene->pictures.images[0].rgba[1] - 40) < 4);
    assert_int_equal(scene->pictures.images[0].rgba[3], 255);
    gn_scene_destroy(scene);
}

static void test_webp(void **state) {
    (void)state;
    if (!gn_webp_is_read()) skip();
    add_picture(gn_webp_lossless, sizeof gn_webp_lossless);
    gn_maker_add(&maker, "images", "{'uri':'a copy as PNG, which is not read.png'}");
    gn_maker_set(&maker, "textures",
                 "[{'source':1,'extensions':{'EXT_texture_webp':{'source':0}}}]");
    gn_maker_set(&maker, "extensionsRequired", "['EXT_texture_webp']");
    gn_maker_set(&maker, "materials", BASE_TEXTURE);
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 0);
    const uint8_t expected[16] = {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 64, 9, 8, 7, 255};
    assert_int_equal(scene->pictures.images[0].width_px, 2);
    assert_memory_equal(scene->pictures.images[0].rgba, expected, sizeof expected);
    gn_scene_destroy(scene);
}

static void test_lossy_webp_with_alpha(void **state) {
    (void)state;
    if (!gn_webp_is_read()) skip();
    add_picture(gn_webp_lossy, sizeof gn_webp_lossy);
    gn_maker_set(&maker, "materials", BASE_TEXTURE);
    struct gn_scene *scene = load();
    const uint8_t *rgba = scene->pictures.images[0].rgba;
    assert_true(abs(rgba[0] - 200) < 6 && abs(rgba[1] - 40) < 6 && abs(rgba[2] - 60) < 6);
    assert_int_equal(rgba[4 * 7 + 3], 255);
    assert_int_equal(rgba[4 * 8 + 3], 0);
    assert_true(scene->pictures.images[0].has_alpha);
    gn_scene_destroy(scene);
}

static void expect_dropped(const void *data, size_t size, const char *why) {
    setup_with_material(NULL);
    add_picture(data, size);
    gn_maker_set(&maker, "materials", BASE_TEXTURE);
    struct gn_scene *scene = load();
    assert_int_equal(scene->pictures.image_count, 0);
    assert_int_equal(scene->materials[0].textures[GN_TEXTURE_BASE].texture, -1);
    if (warnings.count != 1 || !strstr(warnings.text[0], why))
        fail_msg("'%s', not '%s'", warnings.text[0], why);
    assert_non_null(strstr(warnings.text[0], "t: images[0]: "));
    gn_scene_destroy(scene);
}

static void test_broken_pictures_cost_a_warning(void **state) {
    (void)state;
    gn_maker_finish(&maker);
    uint8_t rgba[64 * 64 * 4];
    for (size_t i = 0; i < sizeof rgba; i++) rgba[i] = (uint8_t)(i * 2654435761U >> 24);
    struct gn_made png = gn_maker_png(64, 64, rgba);
    expect_dropped("GIF89a", 6, "neither PNG, JPEG, WebP nor KTX2");
    expect_dropped("RIFF\x10\0\0\0WAVEfmt ", 16, "neither PNG, JPEG, WebP nor KTX2");
    expect_dropped(gn_webp_lossless, 11, "neither PNG, JPEG, WebP nor KTX2");
    expect_dropped(gn_webp_lossless, sizeof gn_webp_lossless - 9, "WebP");
    expect_dropped(png.data, 20, "PNG: truncated");
    expect_dropped(png.data, png.size / 2, "PNG: truncated");
    uint8_t claims[80]; /* a chunk of 2 GB before the pixels */
    memcpy(claims, png.data, 33);
    memcpy(claims + 33, "\x7f\xff\xff\xfezTXt", 8);
    memset(claims + 41, 'x', sizeof claims - 41);
    expect_dropped(claims, sizeof claims, "PNG: truncated");
    png.data[16] = 0x10; /* 268 million wide */
    expect_dropped(png.data, png.size, "truncated");
    expect_dropped("\xff\xd8\xff\xe0 no jpeg", 12, "JPEG:");
    free(png.data);
}

/* 4 MB each, once decoded, and 5.3 with mip-maps for the GPU: of 12 there is room for one alone. */
static void test_broken_pictures_keep_no_memory(void **state) {
    (void)state;
    uint8_t *rgba = calloc(1024 * 1024, 4);
    struct gn_made png = gn_maker_png(1024, 1024, rgba);
    for (int i = 0; i < 4; i++) add_picture(png.data, i < 3 ? png.size - 30 : png.size);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0},"
                 "'metallicRoughnessTexture':{'index':1}},'emissiveTexture':{'index':2},"
                 "'emissiveFactor':[1,1,1],'occlusionTexture':{'index':3}}]");
    struct gn_made glb = gn_maker_glb(&maker);
    const struct gn_scene_limits limits = {.memory_mb = 12};
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    for (int i = 0; i < warnings.count; i++)
        assert_non_null(strstr(warnings.text[i], "PNG: truncated"));
    assert_int_equal(scene->pictures.image_count, 1);
    gn_scene_destroy(scene);
    gn_maker_finish(&maker);
    free(glb.data);
    free(png.data);
    free(rgba);
}

/* A picture of 512 x 512 with its mipmaps, once for each way in which it is read. */
static void test_textures_are_within_gpu_mb(void **state) {
    (void)state;
    enum { SIDE = 512 };
    uint8_t *rgba = calloc(SIDE * SIDE, 4);
    struct gn_made png = gn_maker_png(SIDE, SIDE, rgba);
    add_picture(png.data, png.size);
    for (int both = 0; both < 2; both++) {
        gn_maker_set(&maker, "materials",
                     both ? "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},"
                            "'occlusionTexture':{'index':0}}]"
                          : BASE_TEXTURE);
        struct gn_made glb = gn_maker_glb(&maker);
        struct gn_scene_limits limits = {.gpu_mb = (uint64_t)both + 2};
        struct gn_scene *scene =
            gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
        if (!scene) fail_msg("%s", err.text);
        const uint64_t bytes = gn_scene_image_bytes(&scene->pictures.images[0]);
        assert_int_equal(bytes, (both + 1) * (SIDE * SIDE * 4 * 4 / 3));
        gn_scene_destroy(scene);
        limits.gpu_mb--;
        scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
        if (!scene) fail_msg("%s", err.text);
        assert_int_equal(scene->pictures.images[0].width_px, SIDE / 2);
        assert_string_equal(warnings.text[0],
                            both ? "t: its pictures are over the limit gpu_mb=2: the largest are "
                                   "halved until no side is longer than 256 pixels"
                                 : "t: its pictures are over the limit gpu_mb=1: the largest are "
                                   "halved until no side is longer than 256 pixels");
        assert_int_equal(warnings.count, 1);
        warnings.count = 0;
        gn_scene_destroy(scene);
        free(glb.data);
    }
    gn_maker_finish(&maker);
    free(png.data);
    free(rgba);
}

/* Two pictures of 4 MB each, what libpng takes, and a small one, which stays as it is. */
static void test_the_largest_pictures_are_halved_until_all_fit(void **state) {
    (void)state;
    uint8_t *rgba = calloc(1024 * 1024, 4);
    struct gn_made png = gn_maker_png(1024, 1024, rgba), small = gn_maker_png(128, 64, rgba);
    for (int i = 0; i < 2; i++) add_picture(png.data, png.size);
    add_picture(small.data, small.size);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0},"
                 "'metallicRoughnessTexture':{'index':1}},'emissiveTexture':{'index':2}}]");
    struct gn_made glb = gn_maker_glb(&maker);
    static const struct {
        const char *limit;
        uint64_t mb;
        uint32_t px;
    } cases[] = {{"decoded_mb", 9, 1024}, {"decoded_mb", 8, 512}, {"decoded_mb", 3, 512},
                 {"decoded_mb", 2, 256},  {"decoded_mb", 1, 256}, {"memory_mb", 24, 1024},
                 {"memory_mb", 16, 512},  {"memory_mb", 9, 512},  {"memory_mb", 3, 256}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct gn_scene_limits limits = {0};
        char said[200];
        gn_scene_limits_set(&limits, cases[i].limit, cases[i].mb, NULL);
        warnings.count = 0;
        struct gn_scene *scene =
            gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
        if (!scene) fail_msg("%s", err.text);
        const struct gn_scene_pictures *p = &scene->pictures;
        const bool smaller = cases[i].px < 1024;
        assert_int_equal(p->image_count, 3);
        assert_int_equal(p->images[0].width_px, cases[i].px);
        assert_int_equal(p->images[p->image_count - 1].width_px, 128);
        snprintf(said, sizeof said,
                 "t: its pictures are over the limit %s=%u: the largest are halved until no side "
                 "is longer than %u pixels",
                 cases[i].limit, (unsigned)cases[i].mb, (unsigned)cases[i].px);
        assert_int_equal(warnings.count, smaller);
        if (smaller) assert_string_equal(warnings.text[0], said);
        gn_scene_destroy(scene);
    }
    gn_maker_finish(&maker);
    free(glb.data);
    free(png.data);
    free(small.data);
    free(rgba);
}

/* Two images in one bufferView: the second is not decoded again. */
static void test_a_damaged_view_is_decoded_once(void **state) {
    (void)state;
    uint8_t rgba[16 * 16 * 4] = {0};
    struct gn_made png = gn_maker_png(16, 16, rgba);
    add_picture(png.data, png.size - 30);
    free(png.data);
    const int view = (int)json_array_size(json_object_get(maker.root, "bufferViews")) - 1;
    char json[80];
    snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/png'}", view);
    gn_maker_add(&maker, "images", json);
    gn_maker_add(&maker, "textures", "{'source':1}");
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},"
                 "'emissiveTexture':{'index':1},'emissiveFactor':[1,1,1]}]");
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 2);
    assert_non_null(strstr(warnings.text[0], "images[0]: PNG: "));
    assert_non_null(strstr(warnings.text[1], "images[1]: the same picture as images[0]; "));
    gn_scene_destroy(scene);
}

static void test_missing_picture_file(void **state) {
    (void)state;
    gn_maker_set(&maker, "images", "[{'uri':'gone.png'},{'uri':'also.png'}]");
    gn_maker_set(&maker, "textures", "[{'source':0},{'source':1}]");
    gn_maker_set(&maker, "materials",
                 "["
                 "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}},"
                 "{'emissiveTexture':{'index':1}}]");
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 1); /* nothing uses the other */
    assert_non_null(strstr(warnings.text[0], "images[0]: 'gone.png'"));
    gn_scene_destroy(scene);
}

static void test_later_work_is_named_once(void **state) {
    (void)state;
    gn_maker_set(&maker, "materials",
                 "[{'extensions':{'KHR_materials_sheen':{}}},"
                 "{'extensions':{'KHR_materials_sheen':{}}}]");
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.text[0], "t: shown without sheen: not supported yet");
    gn_scene_destroy(scene);
}

static void test_each_extension_that_no_reader_knows_is_named(void **state) {
    (void)state;
    gn_maker_set(&maker, "extensionsUsed",
                 "['KHR_interactivity','KHR_texture_transform','KHR_xmp_json_ld',"
                 "'KHR_materials_sheen','KHR_interactivity','EXT_\\u0001one']");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0,"
                 "'targets':[{'POSITION':0,'TEXCOORD_0':0}]}]}]");
    gn_maker_set(&maker, "materials", "[{}]");
    struct gn_scene *scene = load();
    assert_string_equal(scene->missing, "morphs of colours and texture coordinates, "
                                        "KHR_interactivity, EXT_?one");
    gn_scene_destroy(scene);
}

/* ---- batches ---- */

static uint32_t batches_of(const char *materials) {
    setup_with_material(NULL);
    gn_maker_set(&maker, "materials", materials);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0},"
                 "{'attributes':{'POSITION':0},'indices':1,'material':1}]}]");
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'extras':{'gnomon_plane':false}}]");
    struct gn_scene *scene = load();
    uint32_t count = scene->batch_count;
    gn_scene_destroy(scene);
    return count;
}

static void test_batches(void **state) {
    (void)state;
    gn_maker_finish(&maker);
    assert_int_equal(batches_of("[{'pbrMetallicRoughness':{'baseColorFactor':[1,0,0,1]}},{}]"), 1);
    assert_int_equal(batches_of("[{'emissiveFactor':[1,0,0]},{'emissiveFactor':[0,1,0]}]"), 1);
    assert_int_equal(batches_of("[{'emissiveFactor':[1,0,0]},{}]"), 2);
    assert_int_equal(batches_of("[{'pbrMetallicRoughness':{'metallicFactor':0}},{}]"), 2);
    assert_int_equal(batches_of("[{'pbrMetallicRoughness':{'metallicFactor':0.5}},{}]"), 1);
    assert_int_equal(
        batches_of("[{'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':0.5}"
                   "},{}]"),
        2);
    assert_int_equal(batches_of("[{'doubleSided':true},{}]"), 2);
    assert_int_equal(batches_of("[{'alphaMode':'MASK','alphaCutoff':0.2},{'alphaMode':'MASK'}]"),
                     1);
    assert_int_equal(batches_of("[{'alphaMode':'BLEND'},{}]"), 1); /* nothing of it is clear */
    assert_int_equal(batches_of("[{'alphaMode':'BLEND','pbrMetallicRoughness':{"
                                "'baseColorFactor':[1,1,1,0.5]}},{}]"),
                     2);
    assert_int_equal(batches_of("[{'extensions':{'KHR_materials_unlit':{}}},{}]"), 2);
}

/* As files have it: a cutoff in as many digits as an exporter writes. */
static void test_an_alpha_equal_to_the_cutoff_is_opaque(void **state) {
    (void)state;
    for (int alpha = 1; alpha < 256; alpha++)
        for (int digits = 3; digits < 9; digits++) {
            char text[16];
            snprintf(text, sizeof text, "%.*f", digits, alpha / 255.0);
            const struct gn_material m = {.alpha_cutoff = strtof(text, NULL)};
            const float least = gn_material_least_alpha(&m);
            if (least > alpha / 255.0 || least <= (alpha - 1) / 255.0) fail_msg("%s", text);
        }
    const struct gn_material nothing = {.alpha_cutoff = 1.001f};
    assert_true(gn_material_least_alpha(&nothing) > 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_alpha_equal_to_the_cutoff_is_opaque),
        cmocka_unit_test_setup(test_factors, setup_with_material),
        cmocka_unit_test_setup(test_texture_transform, setup_with_material),
        cmocka_unit_test_setup(test_samplers, setup_with_material),
        cmocka_unit_test_setup(test_png_rgba, setup_with_material),
        cmocka_unit_test_setup(test_png_of_16_bits, setup_with_material),
        cmocka_unit_test_setup(test_jpeg, setup_with_material),
        cmocka_unit_test_setup(test_webp, setup_with_material),
        cmocka_unit_test_setup(test_lossy_webp_with_alpha, setup_with_material),
        cmocka_unit_test_setup(test_broken_pictures_cost_a_warning, setup_with_material),
        cmocka_unit_test_setup(test_broken_pictures_keep_no_memory, setup_with_material),
        cmocka_unit_test_setup(test_textures_are_within_gpu_mb, setup_with_material),
        cmocka_unit_test_setup(test_the_largest_pictures_are_halved_until_all_fit,
                               setup_with_material),
        cmocka_unit_test_setup(test_a_damaged_view_is_decoded_once, setup_with_material),
        cmocka_unit_test_setup(test_missing_picture_file, setup_with_material),
        cmocka_unit_test_setup(test_later_work_is_named_once, setup_with_material),
        cmocka_unit_test_setup(test_each_extension_that_no_reader_knows_is_named,
                               setup_with_material),
        cmocka_unit_test_setup(test_batches, setup_with_material),
    };
    return RUN(tests);
}
