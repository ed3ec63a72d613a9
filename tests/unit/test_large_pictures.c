/* Pictures of many texels in a few bytes are shown, halved, within memory_mb: what really is
 * resident is measured in a process of its own. And a smaller picture that was read by rows is the
 * one of all its texels. */
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <turbojpeg.h>
#include <unistd.h>

#include "core/child.h"
#include "core/memory.h"
#include "fuzz/bomb_pictures.h"
#include "image/format.h"
#include "unit/scene_help.h"

static void add_picture(struct gn_made picture) {
    char json[100];
    snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/png'}",
             gn_maker_view(&maker, picture.data, picture.size));
    const int image = gn_maker_add(&maker, "images", json);
    snprintf(json, sizeof json, "{'source':%d}", image);
    const int texture = gn_maker_add(&maker, "textures", json);
    snprintf(json, sizeof json, "[{'emissiveTexture':{'index':%d}}]", texture);
    gn_maker_set(&maker, "materials", json);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    free(picture.data);
}

struct result { /* shared with the child */
    uint32_t px[2];
    int warning_count;
    char warning[200];
};

static void load_in_child(const struct gn_made *glb, uint64_t memory_mb, struct result *result) {
    const struct gn_scene_limits limits = {.memory_mb = memory_mb};
    struct gn_scene *scene =
        gn_scene_load_bytes("t", glb->data, glb->size, &limits, &warnings, &err);
    *result = (struct result){.warning_count = scene ? warnings.count : -1};
    snprintf(result->warning, sizeof result->warning, "%s", warnings.text[0]);
    if (!scene || scene->pictures.image_count == 0) return;
    result->px[0] = scene->pictures.images[0].width_px;
    result->px[1] = scene->pictures.images[0].height_px;
}

/* Loads the scene of the maker; resident megabytes at the most beyond those of this process. */
static int64_t load_within(uint64_t memory_mb, struct result *result) {
    struct gn_made glb = gn_maker_glb(&maker);
    struct result *shared = gn_child_share(sizeof *shared, &err);
    struct rusage before = {0}, after = {0};
    const pid_t idle = fork();
    if (idle == 0) _exit(0);
    wait4(idle, NULL, 0, &before);
    const pid_t child = fork();
    if (child == 0) {
        load_in_child(&glb, memory_mb, shared);
        _exit(0);
    }
    int status = -1;
    wait4(child, &status, 0, &after);
    assert_int_equal(status, 0);
    *result = *shared;
    free(glb.data);
    return (after.ru_maxrss - before.ru_maxrss) / 1024;
}

static void expect_halved(struct gn_made picture, uint32_t px, bool lossless) {
    add_picture(picture);
    for (uint64_t mb = lossless ? 512 : 32; mb <= 512; mb *= 4) {
        struct result result;
        const int64_t took_mb = load_within(mb, &result);
        if (result.px[0] == 0) fail_msg("%llu MB: %s", (unsigned long long)mb, result.warning);
        if (GN_LIMITS_MEMORY) assert_in_range(took_mb, 0, mb * 12 / 10);
        assert_true(result.px[0] < px && result.px[0] >= (mb == 32 ? 1024u : 2048u));
        assert_int_equal(result.warning_count, 1);
        assert_non_null(strstr(result.warning, "the largest are halved until no side is longer"));
    }
    gn_maker_finish(&maker);
}

static void test_png_is_halved_within_memory_mb(void **state) {
    (void)state;
    expect_halved(gn_bomb_png_make(&(struct gn_bomb_png){
                      .width_px = 8192, .height_px = 8192, .depth = 1, .interlaced = false}),
                  8192, false);
}

static void test_png_of_16_bits_is_halved_within_memory_mb(void **state) {
    (void)state;
    expect_halved(gn_bomb_png_make(&(struct gn_bomb_png){
                      .width_px = 8192, .height_px = 8192, .depth = 16, .interlaced = false}),
                  8192, false);
}

static void test_interlaced_png_is_halved_within_memory_mb(void **state) {
    (void)state;
    expect_halved(gn_bomb_png_make(&(struct gn_bomb_png){
                      .width_px = 8192, .height_px = 8192, .depth = 1, .interlaced = true}),
                  8192, false);
}

static void test_jpeg_is_halved_within_memory_mb(void **state) {
    (void)state;
    expect_halved(gn_bomb_jpeg_arithmetic(8192, 8192, 3, false), 8192, false);
}

static void test_ktx2_is_halved_within_memory_mb(void **state) {
    (void)state;
    expect_halved(gn_bomb_ktx2(8192, 8192, 1), 8192, false);
}

/* libwebp keeps a lossless picture whole. */
static void test_webp_is_halved_within_memory_mb(void **state) {
    (void)state;
    if (!gn_webp_is_read()) skip();
    expect_halved(gn_bomb_webp(8192, 8192), 8192, true);
}

/* What a decoder keeps whole, at any size, is named. */
static void test_what_no_decoder_makes_small_is_named(void **state) {
    (void)state;
    struct result result;
    add_picture(gn_bomb_jpeg_arithmetic(8192, 8192, 3, true)); /* one scan */
    const int64_t took_mb = load_within(256, &result);
    assert_int_equal(result.px[0], 0);
    assert_non_null(strstr(result.warning, "images[0]: exceeds the limit memory_mb: at any size, "
                                           "decoding it takes 38"));
    if (GN_LIMITS_MEMORY) assert_in_range(took_mb, 0, 32);
    gn_maker_finish(&maker);
}

static void test_a_picture_over_the_limit_on_texels_is_halved(void **state) {
    (void)state;
    struct result result;
    add_picture(gn_bomb_png_make(&(struct gn_bomb_png){
        .width_px = 16384, .height_px = 8192, .depth = 1, .interlaced = false}));
    const int64_t took_mb = load_within(512, &result);
    assert_true(result.px[0] == 8192 && result.px[1] == 4096);
    assert_int_equal(result.warning_count, 1);
    assert_non_null(strstr(result.warning, "16384x8192 is over the limit texels=67108864: halved"));
    if (GN_LIMITS_MEMORY) assert_in_range(took_mb, 0, 160);
    gn_maker_finish(&maker);
}

/* ---- the time ---- */

/* Each with a place, a material and a primitive of its own. */
static void add_copies(struct gn_made picture, int count) {
    char json[120];
    gn_maker_set(&maker, "meshes", "[{'primitives':[]}]");
    json_t *primitives =
        json_object_get(json_array_get(json_object_get(maker.root, "meshes"), 0), "primitives");
    for (int i = 0; i < count; i++) {
        snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/png'}",
                 gn_maker_view(&maker, picture.data, picture.size));
        snprintf(json, sizeof json, "{'source':%d}", gn_maker_add(&maker, "images", json));
        snprintf(json, sizeof json, "{'emissiveTexture':{'index':%d}}",
                 gn_maker_add(&maker, "textures", json));
        const int material = gn_maker_add(&maker, "materials", json);
        json_array_append_new(primitives, json_pack("{s:{s:i},s:i,s:i}", "attributes", "POSITION",
                                                    0, "indices", 1, "material", material));
    }
    free(picture.data);
}

static struct gn_scene *load_copies(uint64_t texels) {
    const struct gn_scene_limits limits = {.texels = texels};
    struct gn_made glb = gn_maker_glb(&maker);
    memset(&warnings, 0, sizeof warnings);
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    free(glb.data);
    gn_maker_finish(&maker);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Of 1024 x 1024 and a value, as many as take twice the time: none is left out. */
static void expect_all_in_part(bool interlaced) {
    enum { COUNT = 20, PX = 1024, VALUE = 0 };
    struct gn_made png = gn_bomb_png_make(&(struct gn_bomb_png){
        .width_px = PX, .height_px = PX, .depth = 8, .interlaced = interlaced});
    add_copies(png, COUNT);
    struct gn_scene *scene = load_copies(PX * PX);
    assert_int_equal(scene->pictures.image_count, COUNT);
    int parts = 0;
    for (int i = 0; i < COUNT; i++) {
        const struct gn_image *image = &scene->pictures.images[i];
        parts += interlaced && image->width_px == PX / 8 && image->height_px == PX / 8;
        for (size_t k = 0; k < (size_t)image->width_px * image->height_px; k++)
            assert_true(image->rgba[4 * k] == VALUE && image->rgba[4 * k + 3] == 255);
    }
    assert_int_equal(parts, interlaced ? warnings.count + warnings.dropped : 0);
    assert_in_range(warnings.count + warnings.dropped, COUNT / 2, COUNT);
    assert_non_null(strstr(warnings.text[0], interlaced ? "an eighth of its rows and columns"
                                                        : "of 1024 rows, and their mean below"));
    gn_scene_destroy(scene);
}

static void test_a_png_that_takes_too_long_has_some_of_its_rows(void **state) {
    (void)state;
    expect_all_in_part(false);
}

static void test_an_interlaced_one_has_its_first_passes(void **state) {
    (void)state;
    expect_all_in_part(true);
}

/* Files with as many texels that are large, as of photographs, are read. */
static void test_time_goes_by_the_bytes_too(void **state) {
    (void)state;
    enum { COUNT = 20, PX = 256 };
    uint8_t *rgba = malloc(4 * PX * PX);
    for (uint32_t i = 0, dice = 1; i < 4 * PX * PX; i++) {
        dice = dice * 1664525 + 1013904223;
        rgba[i] = (uint8_t)(dice >> 24);
    }
    add_copies(gn_maker_png(PX, PX, rgba), COUNT);
    struct gn_scene *scene = load_copies(PX * PX);
    assert_int_equal(scene->pictures.image_count, COUNT);
    assert_int_equal(warnings.count, 0);
    assert_memory_equal(scene->pictures.images[COUNT - 1].rgba, rgba, 4 * PX * PX);
    free(rgba);
    gn_scene_destroy(scene);
}

static void test_rows_that_are_not_read_have_the_mean_of_those_that_are(void **state) {
    (void)state;
    enum { PX = 64, ROWS = 16 };
    uint8_t rgba[4 * PX * PX], out[4 * PX * PX];
    const uint32_t to[] = {PX, PX};
    for (int i = 0; i < 4 * PX * PX; i++) /* columns of 0 and 200, and below of 77 */
        rgba[i] = i % 4 == 3 ? 255 : i / 4 >= PX * ROWS ? 77 : (uint8_t)(i / 4 % 2 * 200);
    struct gn_made png = gn_maker_png(PX, PX, rgba);
    struct gn_picture_file file = {
        .kind = GN_FORMAT_PNG, .data = png.data, .size = png.size, .rows = ROWS};
    assert_true(gn_picture_size(&file, &err) && gn_picture_can_stop(&file));
    assert_true(gn_picture_decode(&file, 0, GN_SCALE_DATA, out, to, &err));
    assert_memory_equal(out, rgba, 4 * PX * ROWS);
    for (int i = PX * ROWS; i < PX * PX; i++)
        assert_memory_equal(out + 4 * i, "\x64\x64\x64\xff", 4);
    free(png.data);
}

/* ---- the texels ---- */

enum { WIDTH = 37, HEIGHT = 23 };

static void fill(uint8_t *rgba) {
    uint32_t dice = 1;
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        dice = dice * 1664525 + 1013904223;
        rgba[i] = (uint8_t)(dice >> 24);
    }
}

static void test_rows_give_the_average_of_all_texels(void **state) {
    (void)state;
    static const uint32_t from[] = {WIDTH, HEIGHT}, to[] = {WIDTH / 2, HEIGHT / 2};
    uint8_t rgba[WIDTH * HEIGHT * 4], whole[WIDTH * HEIGHT * 4], rows[WIDTH * HEIGHT * 4];
    fill(rgba);
    struct gn_made png = gn_maker_png(WIDTH, HEIGHT, rgba);
    struct gn_picture_file file = {.kind = GN_FORMAT_PNG, .data = png.data, .size = png.size};
    assert_true(gn_picture_size(&file, &err));
    for (enum gn_scale_kind kind = GN_SCALE_COLOR; kind <= GN_SCALE_NORMALS; kind++) {
        struct gn_scaler scaler;
        assert_true(gn_scaler_init(&scaler, from, kind, whole, to));
        for (int y = 0; y < HEIGHT; y++) gn_scaler_row(&scaler, rgba + 4 * WIDTH * y);
        gn_scaler_finish(&scaler);
        assert_true(gn_picture_decode(&file, 0, kind, rows, to, &err));
        assert_memory_equal(whole, rows, 4 * to[0] * to[1]);
    }
    free(png.data);
}

/* By the definition: the mean of four values of linear light. */
static void test_halves_are_averaged_in_linear_light(void **state) {
    (void)state;
    static const uint32_t from[] = {2, 2}, to[] = {1, 1};
    uint8_t out[4];
    struct gn_scaler scaler;
    for (int i = 0; i < 256; i++) {
        const uint8_t v = (uint8_t)i, row[] = {v, v, v, v, v, v, v, v};
        assert_true(gn_scaler_init(&scaler, from, GN_SCALE_COLOR, out, to));
        gn_scaler_row(&scaler, row);
        gn_scaler_row(&scaler, row);
        gn_scaler_finish(&scaler);
        assert_true(out[0] == v && out[1] == v && out[2] == v && out[3] == v);
    }
}

/* Of grey v = x: the first passes have every second column. */
static void test_a_shrunk_interlaced_png_has_its_first_passes(void **state) {
    (void)state;
    const struct gn_bomb_png shape = {
        .width_px = 21, .height_px = 13, .depth = 8, .ramp = true, .interlaced = true};
    struct gn_made png = gn_bomb_png_make(&shape);
    const uint32_t px[] = {21, 13};
    uint8_t rgba[21 * 13 * 4];
    for (uint32_t shrink = 0; shrink <= GN_SHRINK_MOST; shrink++) {
        assert_true(gn_png_read(png.data, png.size, px, shrink, rgba, &err));
        for (uint32_t y = 0; y < gn_shrunk_px(13, shrink); y++)
            for (uint32_t x = 0; x < gn_shrunk_px(21, shrink); x++)
                assert_int_equal(rgba[4 * (y * gn_shrunk_px(21, shrink) + x)], x << shrink);
    }
    free(png.data);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_png_is_halved_within_memory_mb, setup),
        cmocka_unit_test_setup(test_png_of_16_bits_is_halved_within_memory_mb, setup),
        cmocka_unit_test_setup(test_interlaced_png_is_halved_within_memory_mb, setup),
        cmocka_unit_test_setup(test_jpeg_is_halved_within_memory_mb, setup),
        cmocka_unit_test_setup(test_ktx2_is_halved_within_memory_mb, setup),
        cmocka_unit_test_setup(test_webp_is_halved_within_memory_mb, setup),
        cmocka_unit_test_setup(test_what_no_decoder_makes_small_is_named, setup),
        cmocka_unit_test_setup(test_a_picture_over_the_limit_on_texels_is_halved, setup),
        cmocka_unit_test_setup(test_a_png_that_takes_too_long_has_some_of_its_rows, setup),
        cmocka_unit_test_setup(test_an_interlaced_one_has_its_first_passes, setup),
        cmocka_unit_test_setup(test_time_goes_by_the_bytes_too, setup),
        cmocka_unit_test(test_rows_that_are_not_read_have_the_mean_of_those_that_are),
        cmocka_unit_test(test_rows_give_the_average_of_all_texels),
        cmocka_unit_test(test_halves_are_averaged_in_linear_light),
        cmocka_unit_test(test_a_shrunk_interlaced_png_has_its_first_passes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
