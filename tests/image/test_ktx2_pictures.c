/* Pictures with a KTX2 texture against those with its twin in PNG: of one colour, which the blocks
 * of ETC2 have exactly. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/ktx2.h"
#include "image/shot.h"
#include "unit/check.h"
#include "unit/ktx2_maker.h"

enum { SIDE = 64, WIDTH = 96, HEIGHT = 64 };
static const uint8_t COLOR[4] = {2 * 17 + 2, 7 * 17 + 2, 3 * 17 + 2, 255};

static struct gn_made make_png(void) {
    uint8_t *rgba = malloc(4ul * SIDE * SIDE);
    assert_non_null(rgba);
    for (size_t i = 0; i < SIDE * SIDE; i++) memcpy(rgba + 4 * i, COLOR, 4);
    struct gn_made png = gn_maker_png(SIDE, SIDE, rgba);
    free(rgba);
    return png;
}

static struct gn_made make_rgba8(uint32_t scheme) {
    const struct gn_ktx2_spec spec = {.vk = GN_VK_RGBA8,
                                      .px = {SIDE, SIDE},
                                      .scheme = scheme,
                                      .units = COLOR,
                                      .unit_bytes = 4,
                                      .unit_px = 1};
    return gn_maker_ktx2(&spec);
}

/* The square with that picture as its colour. */
static struct gn_picture draw(struct gn_made picture, const char *more[]) {
    static const float uv[] = {0, 0, 1, 0, 0, 1, 1, 1};
    struct gn_maker maker;
    struct gn_err err = {0};
    struct gn_picture drawn;
    char json[100], path[300];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    snprintf(json, sizeof json, "[{'bufferView':%d}]",
             gn_maker_view(&maker, picture.data, picture.size));
    free(picture.data);
    gn_maker_set(&maker, "images", json);
    gn_maker_set(&maker, "textures", "[{'source':0}]");
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0},'metallicFactor':0}}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':2},'indices':1,"
                 "'material':0}]}]");
    snprintf(path, sizeof path, "%s/ktx2-%d.glb", gn_shot_build(), (int)getpid());
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    const char *args[] = {"--size", "96x64", more ? more[0] : NULL, more ? more[1] : NULL, NULL};
    const bool done = gn_shot(&drawn, NULL, &err, "png", path, args);
    unlink(path);
    if (!done) fail_msg("%s", err.text);
    return drawn;
}

static bool same(struct gn_picture a, struct gn_picture b) {
    const size_t size = sizeof(float) * (size_t)(a.width_px * a.height_px * a.channels);
    const bool equal =
        a.width_px == WIDTH && a.height_px == HEIGHT && memcmp(a.data, b.data, size) == 0;
    gn_picture_finish(&a);
    gn_picture_finish(&b);
    return equal;
}

static void test_the_same_as_png(void **state) {
    (void)state;
    const uint32_t scheme = gn_zstd_is_built() ? GN_KTX2_ZSTD : GN_KTX2_ZLIB;
    assert_true(same(draw(make_png(), NULL), draw(make_rgba8(scheme), NULL)));
    assert_true(
        same(draw(make_png(), NULL), draw(gn_maker_ktx2_etc2(SIDE, SIDE, 1, scheme, 255), NULL)));
}

/* Smaller levels have other colours here, and the square is smaller than its picture. */
static void test_the_levels_of_the_file_are_seen(void **state) {
    (void)state;
    assert_false(same(draw(make_png(), NULL),
                      draw(gn_maker_ktx2_etc2(SIDE, SIDE, 7, GN_KTX2_PLAIN, 255), NULL)));
}

static void test_a_limit_shows_the_smaller_level(void **state) {
    (void)state;
    const char *limit[] = {"--texture-limit", "16"};
    struct gn_picture small = draw(gn_maker_ktx2_etc2(SIDE, SIDE, 7, GN_KTX2_PLAIN, 255), limit);
    struct gn_picture whole = draw(gn_maker_ktx2_etc2(SIDE, SIDE, 1, GN_KTX2_PLAIN, 255), NULL);
    assert_false(same(small, whole)); /* level 2 is more red */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_same_as_png),
        cmocka_unit_test(test_the_levels_of_the_file_are_seen),
        cmocka_unit_test(test_a_limit_shows_the_smaller_level),
    };
    return RUN(tests);
}
