/* KTX2 pictures of a scene: what is read as it is, what falls back, what is refused. */
#include <stdlib.h>

#include "image/ktx2.h"
#include "unit/ktx2_maker.h"
#include "unit/scene_help.h"

#define TEXTURED "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}]"

static int setup_textured(void **state) {
    setup(state);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    gn_maker_set(&maker, "materials", TEXTURED);
    return 0;
}

static void add_image(struct gn_made made) {
    char json[80];
    snprintf(json, sizeof json, "{'bufferView':%d}", gn_maker_view(&maker, made.data, made.size));
    gn_maker_add(&maker, "images", json);
    free(made.data);
}

static void use_source(void) { gn_maker_set(&maker, "textures", "[{'source':0}]"); }

static void test_channels_become_rgba(void **state) {
    static const uint32_t formats[] = {9, 16, 23, 37, 15, 22, 29, 43};
    static const uint8_t texel[4] = {10, 20, 30, 40};
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t channels = i % 4 + 1;
        for (uint32_t scheme = 0; scheme <= GN_KTX2_ZLIB; scheme++) {
            if (scheme == GN_KTX2_BASIS_LZ || (scheme == GN_KTX2_ZSTD && !gn_zstd_is_built()))
                continue;
            setup_textured(state);
            add_image(gn_maker_ktx2(&(struct gn_ktx2_spec){.vk = formats[i],
                                                           .px = {3, 2},
                                                           .scheme = scheme,
                                                           .units = texel,
                                                           .unit_bytes = channels,
                                                           .unit_px = 1}));
            use_source();
            struct gn_scene *scene = load();
            assert_int_equal(warnings.count, 0);
            const struct gn_image *image = &scene->pictures.images[0];
            uint8_t expected[4] = {0, 0, 0, 255};
            memcpy(expected, texel, channels);
            assert_int_equal(image->width_px, 3);
            for (size_t k = 0; k < 6; k++) assert_memory_equal(image->rgba + 4 * k, expected, 4);
            assert_int_equal(image->has_alpha, channels == 4);
            assert_null(image->levels);
            gn_scene_destroy(scene);
        }
    }
}

static void test_blocks_keep_their_levels(void **state) {
    for (uint32_t scheme = 0; scheme <= GN_KTX2_ZLIB; scheme++) {
        if (scheme == GN_KTX2_BASIS_LZ || (scheme == GN_KTX2_ZSTD && !gn_zstd_is_built())) continue;
        setup_textured(state);
        add_image(gn_maker_ktx2_etc2(30, 64, 7, scheme, 128));
        gn_maker_set(&maker, "textures", "[{'extensions':{'KHR_texture_basisu':{'source':0}}}]");
        gn_maker_set(&maker, "extensionsRequired", "['KHR_texture_basisu']");
        struct gn_scene *scene = load();
        assert_int_equal(warnings.count, 0);
        const struct gn_image *image = &scene->pictures.images[0];
        assert_null(image->rgba);
        assert_int_equal(image->packing, GN_PACKING_ETC2_RGBA);
        assert_int_equal(image->level_count, 7);
        assert_true(image->has_alpha);
        /* 8 x 16, 4 x 8, 2 x 4, 1 x 2, and three of one block */
        assert_int_equal(gn_scene_image_bytes(image), 16 * (128 + 32 + 8 + 2 + 3));
        assert_int_equal(image->levels[8], 0x22);
        assert_int_equal(image->levels[16 * 128 + 8], 0x44);
        gn_scene_destroy(scene);
    }
}

static void test_opaque_blocks_have_no_alpha(void **state) {
    (void)state;
    add_image(gn_maker_ktx2_etc2(8, 8, 1, GN_KTX2_PLAIN, 255));
    use_source();
    struct gn_scene *scene = load();
    assert_false(scene->pictures.images[0].has_alpha);
    gn_scene_destroy(scene);
}

static void test_alpha_of_punched_blocks(void **state) {
    (void)state;
    /* texel (1, 2), number 6, has index 2; the block is not opaque */
    uint8_t block[8] = {0x40, 0x40, 0x40, 0, 0, 1 << 6, 0, 0};
    const uint32_t px[2] = {4, 4};
    for (uint32_t y = 0; y < 4; y++)
        for (uint32_t x = 0; x < 4; x++)
            assert_int_equal(gn_packing_alpha(GN_PACKING_ETC2_RGBA1, block, 4, x, y),
                             x == 1 && y == 2 ? 0 : 255);
    assert_true(gn_packing_has_alpha(GN_PACKING_ETC2_RGBA1, block, px));
    block[3] = 2; /* opaque */
    assert_false(gn_packing_has_alpha(GN_PACKING_ETC2_RGBA1, block, px));
    block[3] = 0;
    block[2] = 0xfb; /* blue 31 + 3: planar */
    assert_false(gn_packing_has_alpha(GN_PACKING_ETC2_RGBA1, block, px));
}

/* ---- Basis ---- */

static struct gn_made make_basis(bool uastc) {
    static const uint8_t block[16];
    return gn_maker_ktx2(&(struct gn_ktx2_spec){.vk = 0,
                                                .px = {4, 4},
                                                .levels = 1,
                                                .scheme = uastc ? GN_KTX2_ZSTD : GN_KTX2_BASIS_LZ,
                                                .units = block,
                                                .unit_bytes = 16,
                                                .unit_px = 4,
                                                .model = uastc ? 166 : 163});
}

static void test_basis_falls_back_to_the_source(void **state) {
    static const uint8_t rgba[] = {1, 2, 3, 255};
    for (int uastc = 0; uastc < 2; uastc++) {
        setup_textured(state);
        add_image(make_basis(uastc));
        add_image(gn_maker_png(1, 1, rgba));
        gn_maker_set(&maker, "textures",
                     "[{'source':1,'extensions':{'KHR_texture_basisu':{'source':0}}}]");
        gn_maker_set(&maker, "extensionsRequired", "['KHR_texture_basisu']");
        struct gn_scene *scene = load();
        assert_int_equal(warnings.count, 1);
        assert_non_null(strstr(warnings.text[0], "images[1] is shown instead"));
        assert_memory_equal(scene->pictures.images[0].rgba, rgba, 4);
        gn_scene_destroy(scene);
    }
}

static void test_basis_alone_is_refused_where_it_is_required(void **state) {
    for (int required = 0; required < 2; required++) {
        setup_textured(state);
        add_image(make_basis(true));
        gn_maker_set(&maker, "textures", "[{'extensions':{'KHR_texture_basisu':{'source':0}}}]");
        if (required) gn_maker_set(&maker, "extensionsRequired", "['KHR_texture_basisu']");
        struct gn_scene *scene = gn_maker_load(&maker, &warnings, &err);
        const char *line = required ? err.text : warnings.text[0];
        assert_int_equal(scene != NULL, !required);
        assert_non_null(strstr(line, "images[0]: KTX2 of Basis Universal is not read"));
        assert_non_null(strstr(line, "ktx extract --transcode rgba8"));
        gn_scene_destroy(scene);
    }
}

/* ---- the limit on textures ---- */

static void test_larger_levels_are_skipped(void **state) {
    (void)state;
    add_image(gn_maker_ktx2_etc2(64, 32, 7, GN_KTX2_PLAIN, 255));
    use_source();
    struct gn_made glb = gn_maker_glb(&maker);
    const struct gn_scene_limits limits = {.texture_px = 20};
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    assert_non_null(scene);
    const struct gn_image *image = &scene->pictures.images[0];
    assert_int_equal(image->width_px, 16);
    assert_int_equal(image->height_px, 8);
    assert_int_equal(image->level_count, 5);
    assert_int_equal(image->levels[8], 0x66); /* of level 2 */
    gn_scene_destroy(scene);
    free(glb.data);
    gn_maker_finish(&maker);
}

static void test_without_a_smaller_level_it_is_said(void **state) {
    (void)state;
    add_image(gn_maker_ktx2_etc2(64, 32, 1, GN_KTX2_PLAIN, 255));
    use_source();
    struct gn_made glb = gn_maker_glb(&maker);
    const struct gn_scene_limits limits = {.texture_px = 20};
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    assert_non_null(scene);
    assert_int_equal(scene->pictures.images[0].width_px, 64);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "images[0]: 64x32 pixels, and no smaller level"));
    gn_scene_destroy(scene);
    free(glb.data);
    gn_maker_finish(&maker);
}

static void test_larger_pictures_are_halved(void **state) {
    (void)state;
    uint8_t rgba[12 * 6 * 4];
    for (size_t i = 0; i < sizeof rgba; i++) rgba[i] = i % 4 == 3 ? 255 : i / 4 % 2 ? 255 : 0;
    add_image(gn_maker_png(12, 6, rgba));
    use_source();
    struct gn_made glb = gn_maker_glb(&maker);
    const struct gn_scene_limits limits = {.texture_px = 6};
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    assert_non_null(scene);
    const struct gn_image *image = &scene->pictures.images[0];
    assert_int_equal(image->width_px, 6);
    assert_int_equal(image->height_px, 3);
    for (size_t i = 0; i < 18; i++) assert_int_equal(image->rgba[4 * i], 188); /* half the light */
    gn_scene_destroy(scene);
    free(glb.data);
    gn_maker_finish(&maker);
}

/* ---- damage ---- */

static void expect_dropped(struct gn_made made, const char *why) {
    setup_textured(NULL);
    add_image(made);
    use_source();
    struct gn_scene *scene = load();
    assert_int_equal(scene->pictures.image_count, 0);
    if (warnings.count != 1 || !strstr(warnings.text[0], why))
        fail_msg("'%s', not '%s'", warnings.text[0], why);
    gn_scene_destroy(scene);
}

static struct gn_made patched(uint32_t scheme, size_t at, const char *bytes, size_t size) {
    struct gn_made made = gn_maker_ktx2_etc2(16, 16, 2, scheme, 255);
    memcpy(made.data + at, bytes, size);
    return made;
}

static void test_broken_files_cost_a_warning(void **state) {
    (void)state;
    struct gn_made cut = gn_maker_ktx2_etc2(16, 16, 2, GN_KTX2_PLAIN, 255);
    cut.size -= 1;
    expect_dropped(cut, "KTX2: level 1 lies outside");
    cut = gn_maker_ktx2_etc2(16, 16, 2, GN_KTX2_PLAIN, 255);
    cut.size = 60;
    expect_dropped(cut, "KTX2: truncated");
    expect_dropped(patched(0, 12, "\x91", 1), "vkFormat 145");
    expect_dropped(patched(0, 20, "\0", 1), "width or height is 0");
    expect_dropped(patched(0, 20, "\xff\xff\xff\xff", 4), "levels of 4294967295x16");
    expect_dropped(patched(0, 20, "\0\0\x0f\0", 4), "KTX2: level 0 of");
    expect_dropped(patched(0, 28, "\1", 1), "a volume, an array or a cube");
    expect_dropped(patched(0, 36, "\6", 1), "a volume, an array or a cube");
    expect_dropped(patched(0, 40, "\6", 1), "6 levels of 16x16");
    expect_dropped(patched(0, 40, "\xff\xff\xff\xff", 4), "4294967295 levels");
    expect_dropped(patched(0, 44, "\4", 1), "supercompression scheme 4");
    expect_dropped(patched(0, 80, "\xff\xff\xff\xff\xff\xff\xff\xff", 8), "lies outside");
    expect_dropped(patched(0, 88, "\xff\xff\xff\xff\xff\xff\xff\xff", 8), "lies outside");
    expect_dropped(patched(GN_KTX2_ZLIB, 96, "\xff\xff\xff\xff\xff\xff\xff\x7f", 8),
                   "KTX2: level 0 of");
    expect_dropped(patched(GN_KTX2_ZLIB, 80 + 48 + 44, "\xff", 1), "KTX2: zlib: damaged");
    if (!gn_zstd_is_built()) return;
    expect_dropped(patched(GN_KTX2_ZSTD, 80 + 48 + 44, "\xff", 1), "KTX2: zstd: ");
    expect_dropped(patched(GN_KTX2_ZSTD, 80 + 48 + 44 + 5, "\xff\xff\xff\x7f", 4), "KTX2: zstd: ");
}

static void test_levels_are_within_memory_mb(void **state) {
    (void)state;
    add_image(gn_maker_ktx2_etc2(4096, 4096, 1, GN_KTX2_ZLIB, 255)); /* 16 MB out of kilobytes */
    use_source();
    struct gn_made glb = gn_maker_glb(&maker);
    const struct gn_scene_limits limits = {.memory_mb = 24};
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    assert_non_null(scene);
    assert_int_equal(scene->pictures.image_count, 0);
    assert_non_null(strstr(warnings.text[0], "exceeds the limit memory_mb"));
    gn_scene_destroy(scene);
    const struct gn_scene_limits of_gpu = {.gpu_mb = 8}; /* there is no smaller level */
    assert_null(gn_scene_load_bytes("t", glb.data, glb.size, &of_gpu, &warnings, &err));
    assert_string_equal(err.text,
                        "t: textures of 16 MB and buffers of 1 MB are over the limit gpu_mb=8");
    free(glb.data);
    gn_maker_finish(&maker);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_channels_become_rgba),
        cmocka_unit_test(test_blocks_keep_their_levels),
        cmocka_unit_test_setup(test_opaque_blocks_have_no_alpha, setup_textured),
        cmocka_unit_test(test_alpha_of_punched_blocks),
        cmocka_unit_test(test_basis_falls_back_to_the_source),
        cmocka_unit_test(test_basis_alone_is_refused_where_it_is_required),
        cmocka_unit_test_setup(test_larger_levels_are_skipped, setup_textured),
        cmocka_unit_test_setup(test_without_a_smaller_level_it_is_said, setup_textured),
        cmocka_unit_test_setup(test_larger_pictures_are_halved, setup_textured),
        cmocka_unit_test(test_broken_files_cost_a_warning),
        cmocka_unit_test_setup(test_levels_are_within_memory_mb, setup_textured),
    };
    return RUN(tests);
}
