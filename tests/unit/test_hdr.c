/* Radiance pictures: all ways of writing rows give the same pixels; a broken file is refused in one
 * line. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/read.h"
#include "unit/check.h"

enum { W = 12, H = 3 };

struct bytes {
    uint8_t data[1024];
    size_t size;
};
struct seen {
    uint8_t rgbe[H][W][4];
    uint32_t rows;
    uint32_t width;
};

static void put(struct bytes *b, const void *data, size_t size) {
    memcpy(b->data + b->size, data, size);
    b->size += size;
}

static void put_header(struct bytes *b, const char *size) {
    char text[128];
    const int length = snprintf(
        text, sizeof text, "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n%s\n", size);
    *b = (struct bytes){0};
    put(b, text, (size_t)length);
}

/* The left half of a row is one colour, the right one changes. */
static void pixel(uint32_t x, uint32_t y, uint8_t out[4]) {
    out[0] = x < W / 2 ? 40 : (uint8_t)(100 + x);
    out[1] = (uint8_t)(50 + y);
    out[2] = x < W / 2 ? 60 : (uint8_t)(7 * x);
    out[3] = 129;
}

static void see_row(void *user, uint32_t y, const uint8_t *rgbe) {
    struct seen *seen = user;
    assert_int_equal(y, seen->rows);
    if (y < H) memcpy(seen->rgbe[y], rgbe, 4ul * (seen->width < W ? seen->width : W));
    seen->rows++;
}

static void check(const struct bytes *b) {
    struct gn_err err = {0};
    struct seen seen = {.width = W};
    uint32_t px[2];
    assert_true(gn_hdr_size(b->data, b->size, px, &err));
    assert_int_equal(px[0], W);
    assert_int_equal(px[1], H);
    if (!gn_hdr_read(b->data, b->size, see_row, &seen, &err)) fail_msg("%s", err.text);
    assert_int_equal(seen.rows, H);
    for (uint32_t y = 0; y < H; y++)
        for (uint32_t x = 0; x < W; x++) {
            uint8_t wanted[4];
            pixel(x, y, wanted);
            assert_memory_equal(seen.rgbe[y][x], wanted, 4);
        }
}

static void make_flat(struct bytes *b) {
    put_header(b, "-Y 3 +X 12");
    for (uint32_t y = 0; y < H; y++)
        for (uint32_t x = 0; x < W; x++) {
            uint8_t p[4];
            pixel(x, y, p);
            put(b, p, 4);
        }
}

static void make_old(struct bytes *b) {
    put_header(b, "-Y 3 +X 12");
    for (uint32_t y = 0; y < H; y++)
        for (uint32_t x = 0; x < W; x++) {
            uint8_t p[4];
            pixel(x, y, p);
            if (x > 0 && x < W / 2) continue;
            put(b, p, 4);
            if (x == 0) put(b, (uint8_t[]){1, 1, 1, W / 2 - 1}, 4);
        }
}

static void make_new(struct bytes *b) {
    put_header(b, "-Y 3 +X 12");
    for (uint32_t y = 0; y < H; y++) {
        put(b, (uint8_t[]){2, 2, 0, W}, 4);
        for (int channel = 0; channel < 4; channel++) {
            uint8_t p[4];
            pixel(0, y, p);
            put(b, (uint8_t[]){128 + W / 2, p[channel], W - W / 2}, 3);
            for (uint32_t x = W / 2; x < W; x++) {
                pixel(x, y, p);
                put(b, &p[channel], 1);
            }
        }
    }
}

static void test_rows_are_flat_or_runs_of_pixels_or_of_channels(void **state) {
    (void)state;
    struct bytes b;
    make_flat(&b);
    check(&b);
    make_old(&b);
    check(&b);
    make_new(&b);
    check(&b);
}

static void test_a_long_old_run_takes_several_counts(void **state) {
    (void)state;
    struct bytes b;
    struct gn_err err = {0};
    struct seen seen = {.width = W};
    put_header(&b, "-Y 1 +X 1000"); /* 1 + 231 + 3 x 256 */
    put(&b, (uint8_t[]){9, 8, 7, 128, 1, 1, 1, 231, 1, 1, 1, 3}, 12);
    if (!gn_hdr_read(b.data, b.size, see_row, &seen, &err)) fail_msg("%s", err.text);
    assert_int_equal(seen.rgbe[0][11][2], 7);
}

static void test_a_mantissa_of_128_and_an_exponent_of_129_is_one(void **state) {
    (void)state;
    float rgb[3];
    gn_hdr_color((uint8_t[]){128, 64, 255, 129}, rgb);
    assert_true(rgb[0] == 1.0f && rgb[1] == 0.5f && rgb[2] == 255.0f / 128.0f);
    gn_hdr_color((uint8_t[]){128, 64, 255, 0}, rgb);
    assert_true(rgb[0] == 0.0f && rgb[1] == 0.0f && rgb[2] == 0.0f);
}

static void refuse(const struct bytes *b, const char *why) {
    struct gn_err err = {0};
    struct seen seen = {.width = W};
    assert_false(gn_hdr_read(b->data, b->size, see_row, &seen, &err));
    if (!strstr(err.text, why)) fail_msg("\"%s\" instead of \"%s\"", err.text, why);
}

static void test_each_fault_has_its_line(void **state) {
    (void)state;
    struct bytes b = {.data = "P6 1 1 255\n", .size = 11};
    refuse(&b, "not a Radiance picture");
    put_header(&b, "+Y 3 +X 12");
    refuse(&b, "-Y HEIGHT +X WIDTH");
    put_header(&b, "-Y 3 +X 0");
    refuse(&b, "width or height is 0");
    put_header(&b, "-Y 99999999999999999999 +X 12");
    refuse(&b, "pixels; at most 16384");
    put_header(&b, "-Y 16384 +X 16384");
    refuse(&b, "and 33554432 in all");
    put_header(&b, "-Y 3 +X 12");
    b.size -= 1;
    refuse(&b, "truncated in its header");
    b = (struct bytes){0};
    put(&b, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", 46);
    refuse(&b, "only FORMAT=32-bit_rle_rgbe");
    make_new(&b);
    b.size -= 3;
    refuse(&b, "truncated in row 2");
    put_header(&b, "-Y 3 +X 12");
    put(&b, (uint8_t[]){2, 2, 0, W, 128 + W + 1, 9}, 6);
    refuse(&b, "a run over its end in row 0");
    put_header(&b, "-Y 3 +X 12");
    put(&b, (uint8_t[]){2, 2, 0, W, 0, 9}, 6);
    refuse(&b, "a run of 0 pixels");
    put_header(&b, "-Y 3 +X 12");
    put(&b, (uint8_t[]){2, 2, 0, W + 1, 0, 9}, 6);
    refuse(&b, "another width");
    put_header(&b, "-Y 3 +X 12");
    put(&b, (uint8_t[]){1, 1, 1, 1}, 4);
    refuse(&b, "without a pixel to repeat");
    put_header(&b, "-Y 3 +X 12");
    put(&b, (uint8_t[]){5, 5, 5, 5, 1, 1, 1, 255}, 8);
    refuse(&b, "a run over its end");
}

/* Bytes are changed, left out and repeated: an answer, and nothing that a sanitizer finds. */
static void test_mutations_are_read_or_refused(void **state) {
    (void)state;
    const int rounds = getenv("GN_FULL") ? 20000 : 2000;
    uint32_t seed = 1;
    int read = 0;
    for (int i = 0; i < rounds; i++) {
        struct bytes b;
        if (i % 3 == 0) make_flat(&b);
        if (i % 3 == 1) make_old(&b);
        if (i % 3 == 2) make_new(&b);
        for (int k = 0; k <= i % 4; k++) {
            seed = seed * 1664525u + 1013904223u;
            const size_t at = (seed >> 8) % b.size;
            if (seed >> 28 == 0)
                b.size = at + 1;
            else
                b.data[at] = (uint8_t)(seed >> 12 ^ seed >> 20);
        }
        uint8_t *copy = malloc(b.size); /* of its size, for sanitizers */
        struct gn_err err = {0};
        struct seen seen = {.width = 1};
        memcpy(copy, b.data, b.size);
        const bool ok = gn_hdr_read(copy, b.size, see_row, &seen, &err);
        read += ok;
        if (!ok && (strncmp(err.text, "HDR: ", 5) != 0 || strchr(err.text, '\n')))
            fail_msg("\"%s\"", err.text);
        free(copy);
    }
    assert_true(read > rounds / 10 && read < rounds * 9 / 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_are_flat_or_runs_of_pixels_or_of_channels),
        cmocka_unit_test(test_a_long_old_run_takes_several_counts),
        cmocka_unit_test(test_a_mantissa_of_128_and_an_exponent_of_129_is_one),
        cmocka_unit_test(test_each_fault_has_its_line),
        cmocka_unit_test(test_mutations_are_read_or_refused),
    };
    return RUN(tests);
}
