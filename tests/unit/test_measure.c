/* Pictures that are read to be compared, good ones and hostile ones, and the measures. */
#include "image/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "image/write.h"
#include "unit/check.h"
#include "unit/folder.h"

static void test_measures_of_a_known_difference(void **state) {
    (void)state;
    const float a[] = {0, 0, 0, 1, 1, 1}, b[] = {0, 0, .5f, 1, 1, 1};
    struct gn_measure m;
    gn_measure(a, b, 2, 1, 3, .4, &m);
    assert_float_equal(m.max, .5, 0);
    assert_float_equal(m.share, .5, 0);
    assert_float_equal(m.rmse, sqrt(.25 / 6), 1e-12);
    assert_float_equal(gn_measure_psnr_db(&m), 10 * log10(24), 1e-9);
    assert_int_equal(m.worst_x, 0);
    gn_measure(a, b, 2, 1, 3, .5, &m);
    assert_float_equal(m.share, 0, 0);
}

static void test_nan_differs_from_all_but_nan(void **state) {
    (void)state;
    const float a[] = {NAN, INFINITY, 0}, b[] = {NAN, INFINITY, 0}, c[] = {0, INFINITY, NAN};
    struct gn_measure m;
    gn_measure(a, b, 3, 1, 1, 0, &m);
    assert_true(m.max == 0 && m.rmse == 0 && isinf(gn_measure_psnr_db(&m)));
    gn_measure(a, c, 3, 1, 1, 0, &m);
    assert_true(isinf(m.max) && isinf(m.rmse));
    assert_float_equal(m.share, 2.0 / 3, 1e-12);
}

static void test_what_is_written_is_read(void **state) {
    const char *folder = *state;
    struct gn_err err = {0};
    struct gn_pixels p;
    char path[300];
    const float grey[] = {0, .25f, .5f, 1, 3e-5f, 2}, rgb[] = {0, -1, 1e9f, INFINITY, .5f, 3};
    snprintf(path, sizeof path, "%s/grey.png", folder);
    assert_true(gn_picture_write_png16_grey(path, grey, 3, 2, &err));
    assert_true(gn_pixels_load(&p, path, &err));
    assert_true(p.width_px == 3 && p.height_px == 2);
    for (int i = 0; i < 18; i++) assert_float_equal(p.rgb[i], fminf(grey[i / 3], 1), .5001 / 65535);
    gn_pixels_finish(&p);

    snprintf(path, sizeof path, "%s/rgb.pfm", folder);
    assert_true(gn_picture_write_pfm(path, rgb, 3, 1, 2, &err));
    assert_true(gn_pixels_load(&p, path, &err));
    assert_memory_equal(p.rgb, rgb, sizeof rgb);
    gn_pixels_finish(&p);

    const uint8_t bytes[] = {0, 1, 254, 255, 7, 77, 177, 0};
    snprintf(path, sizeof path, "%s/bytes.png", folder);
    assert_true(gn_picture_write_png8(path, bytes, 2, 1, true, &err));
    assert_true(gn_pixels_load(&p, path, &err));
    for (int i = 0; i < 6; i++) assert_true(p.rgb[i] == (float)bytes[i / 3 * 4 + i % 3] / 255.0f);
    gn_pixels_finish(&p);
}

static void refuses(const char *folder, const void *data, size_t size, const char *why) {
    struct gn_err err = {0};
    struct gn_pixels p;
    char path[300];
    snprintf(path, sizeof path, "%s/bad", folder);
    assert_true(gn_file_write(path, data, size, &err));
    if (gn_pixels_load(&p, path, &err)) fail_msg("read: %s", (const char *)data);
    assert_non_null(strstr(err.text, path));
    assert_null(p.rgb);
    if (!strstr(err.text, why)) fail_msg("%s, not %s", err.text, why);
}

static void test_hostile_headers_are_refused(void **state) {
    static const char *const headers[] = {"Pf",
                                          "PF\n",
                                          "Pf\n1 1",
                                          "Pf\n1 1\n-1",
                                          "Pf\n0 1\n-1\n",
                                          "Pf\n-1 1\n1\n",
                                          "Pf\n1.5 1\n-1\n",
                                          "Pf\nnan 1\n-1\n",
                                          "Pf\n1 1\n0\nabcd",
                                          "Pf\n1 1\ninf\nabcd",
                                          "Pf\n1 99999\n1\n",
                                          "Pf11\n-1\nabcd",
                                          "Pf\n1 1x-1\nabcd"};
    const char *folder = *state;
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++)
        refuses(folder, headers[i], strlen(headers[i]), "bad header");
    refuses(folder, "Pf\n1 1\n-1\nabc", 13, "3 bytes of pixels, not the 4");
    refuses(folder, "Pf\n1 1\n-1\nabcde", 15, "5 bytes of pixels, not the 4");
    refuses(folder, "PF\n32768 32768\n-1\n", 18, "0 bytes of pixels");
    refuses(folder, "", 0, "neither PNG nor PFM");
    refuses(folder, "P6\n1 1\n255\n...", 14, "neither PNG nor PFM");
    refuses(folder, "\x89PNG\r\n\x1a\n", 8, "PNG: truncated");
}

/* Every prefix, and every byte changed: a failure of one line, or a picture of a sane size. */
static void test_damaged_files_do_no_harm(void **state) {
    static const char *const names[] = {"a.png", "a.pfm"};
    const char *folder = *state;
    const uint8_t rgba[16] = {9, 99, 199, 255, 3, 33, 133, 255, 0, 1, 2, 255, 4, 5, 6, 255};
    const float values[4] = {0, 1, .5f, 2};
    struct gn_err err = {0};
    char path[300], bad[300];
    snprintf(bad, sizeof bad, "%s/bad", folder);
    for (int kind = 0; kind < 2; kind++) {
        struct gn_bytes file;
        snprintf(path, sizeof path, "%s/%s", folder, names[kind]);
        assert_true(kind == 0 ? gn_picture_write_png8(path, rgba, 2, 2, true, &err)
                              : gn_picture_write_pfm(path, values, 1, 2, 2, &err));
        assert_true(gn_file_read(path, 0, &file, &err));
        for (size_t i = 0; i < 2 * file.size; i++) {
            struct gn_pixels p;
            uint8_t *data = malloc(file.size);
            memcpy(data, file.data, file.size);
            if (i >= file.size) data[i - file.size] ^= (uint8_t)(1 + i * 37);
            assert_true(gn_file_write(bad, data, i < file.size ? i : file.size, &err));
            free(data);
            if (gn_pixels_load(&p, bad, &err)) assert_true(p.width_px * p.height_px <= 64);
            gn_pixels_finish(&p);
        }
        gn_bytes_finish(&file);
    }
}

static int make_folder(void **state) {
    static char folder[] = "/tmp/gnomon-measure-XXXXXX";
    *state = mkdtemp(folder);
    return *state ? 0 : -1;
}

static int remove_folder(void **state) { return gn_test_remove_folder(*state); }

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_measures_of_a_known_difference),
        cmocka_unit_test(test_nan_differs_from_all_but_nan),
        cmocka_unit_test(test_what_is_written_is_read),
        cmocka_unit_test(test_hostile_headers_are_refused),
        cmocka_unit_test(test_damaged_files_do_no_harm),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
