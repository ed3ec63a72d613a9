/* The comparison must see what it is for, and must not see what it is not for. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/compare.h"
#include "image/dice.h"
#include "image/shot.h"
#include "unit/check.h"

enum { W = 60, H = 40 };

/* A floor seen from above, 1 m a pixel; the left 20 columns lie in shadow; item 7 covers the
 * right 10. */
struct flat {
    uint8_t lit[W * H];
    int32_t item[W * H];
    float point[3 * W * H], normal[3 * W * H], distance[W * H], band[W * H];
    struct gn_mask_truth truth;
    struct gn_picture shot; /* perfect until a test spoils it */
};

static int setup(void **state) {
    struct flat *f = calloc(1, sizeof *f);
    gn_picture_init(&f->shot, W, H, 1);
    for (int i = 0; i < W * H; i++) {
        f->lit[i] = i % W >= 20;
        f->item[i] = i % W >= 50 ? 7 : 1;
        f->point[3 * i] = (float)(i % W);
        f->point[3 * i + 2] = (float)(i / W);
        f->normal[3 * i + 1] = 1;
        f->distance[i] = 50;
        f->shot.data[i] = f->lit[i];
    }
    f->truth =
        (struct gn_mask_truth){W, H, f->lit, f->item, f->point, f->normal, f->distance, NULL, NULL};
    *state = f;
    return 0;
}

static int teardown(void **state) {
    struct flat *f = *state;
    gn_picture_finish(&f->shot);
    free(f);
    return 0;
}

static struct gn_mask_score score_of(const struct flat *f) {
    struct gn_mask_score score;
    gn_mask_compare(&f->truth, f->shot.data, f->shot.channels, &score);
    return score;
}

static void test_perfect_mask_has_no_fault(void **state) {
    struct gn_mask_score s = score_of(*state);
    assert_int_equal(s.acne + s.leak + s.gap + s.wrong, 0);
    assert_int_equal(s.pixels, W * H);
    assert_int_equal(s.dark, 20 * H);
    /* edges are columns 19, 20, 49, 50; away are those more than 2 from them */
    assert_int_equal(s.away_dark, 17 * H);
    assert_int_equal(s.away_lit, (47 - 23 + 60 - 53) * H);
}

static void test_each_fault_is_counted_where_it_belongs(void **state) {
    struct flat *f = *state;
    f->shot.data[5 * W + 30] = 0;    /* acne */
    f->shot.data[5 * W + 31] = .49f; /* acne */
    f->shot.data[5 * W + 32] = .5f;  /* lit */
    f->shot.data[5 * W + 33] = NAN;  /* acne: nothing is not light */
    f->shot.data[5 * W + 3] = 1;     /* leak */
    f->shot.data[5 * W + 18] = 1;    /* on the edge: a gap only */
    f->shot.data[5 * W + 21] = 0;    /* on the edge: wrong only */
    f->shot.data[5 * W + 48] = 0;    /* next to the outline of item 7: wrong only */
    struct gn_mask_score s = score_of(f);
    assert_int_equal(s.acne, 3);
    assert_int_equal(s.leak, 1);
    assert_int_equal(s.gap, 2);
    assert_int_equal(s.wrong, 7);
    assert_true(fabs(gn_mask_gap(&s) - 100.0 * 2 / (20 * H)) < 1e-9);
    assert_true(fabs(gn_mask_wrong(&s) - 100.0 * 7 / (W * H)) < 1e-9);
}

static void test_band_widens_edges_and_never_narrows_them(void **state) {
    struct flat *f = *state;
    f->truth.band_px = f->band;
    f->shot.data[5 * W + 26] = 0; /* 6 from the edge column 20 */
    for (int i = 0; i < W * H; i++) f->band[i] = 5.9f;
    assert_int_equal(score_of(f).acne, 1);
    f->band[5 * W + 26] = 6;
    assert_int_equal(score_of(f).acne, 0);
    for (int i = 0; i < W * H; i++) f->band[i] = 0;
    f->shot.data[5 * W + 22] = 0;
    assert_int_equal(score_of(f).acne, 1); /* column 22 is still within 2 */
}

/* Edges are columns 19, 20, 49, 50: columns 25..44 and 55..59 are safely lit. */
static void test_faint_acne_is_measured_where_light_is_safe(void **state) {
    struct flat *f = *state;
    assert_int_equal(score_of(f).safe, 25 * H);
    f->shot.data[5 * W + 24] = 0;    /* 4 from an edge */
    f->shot.data[5 * W + 25] = .96f; /* darkened by less than 5 % */
    f->shot.data[5 * W + 30] = .9f;
    f->shot.data[5 * W + 31] = NAN;
    f->shot.data[5 * W + 32] = 1.5f; /* not less than nothing */
    struct gn_mask_score s = score_of(f);
    assert_int_equal(s.darkened, 2);
    assert_true(fabs(gn_mask_darkened(&s) - 100.0 * 2 / (25 * H)) < 1e-9);
    assert_true(fabs(gn_mask_darkening(&s) - 100 * 1.14 / (25 * H)) < 1e-6);
    assert_int_equal(s.acne, 2); /* columns 24 and 31 */
    f->truth.safe_px = f->band;
    for (int i = 0; i < W * H; i++) f->band[i] = i % W < 40 ? INFINITY : 8;
    assert_int_equal(score_of(f).safe, (42 - 40 + 60 - 58) * H);
}

static void test_steps_and_folds_are_edges(void **state) {
    struct flat *f = *state;
    float edges[W * H];
    for (int i = 0; i < W * H; i++) {
        f->lit[i] = 1;
        f->item[i] = 1;
    }
    gn_mask_edges(&f->truth, edges);
    assert_true(isinf(edges[0]));
    for (int y = 0; y < H; y++) /* a roof's two sides, 60 degrees each way */
        for (int x = 0; x < W; x++) {
            f->normal[3 * (y * W + x)] = x < 40 ? -.8660254f : .8660254f;
            f->normal[3 * (y * W + x) + 1] = .5f;
            f->point[3 * (y * W + x) + 1] = (float)(1.7320508 * -fabs(x - 39.5));
        }
    gn_mask_edges(&f->truth, edges);
    assert_true(edges[39] == 0 && edges[40] == 0 && edges[38] == 1 && edges[45] == 5);
    for (int i = 0; i < W * H; i++) { /* flat, with a step of 2 m seen from 50 */
        f->normal[3 * i] = 0;
        f->normal[3 * i + 1] = 1;
        f->point[3 * i + 1] = i % W < 10 ? 0 : 2;
    }
    gn_mask_edges(&f->truth, edges);
    assert_true(edges[9] == 0 && edges[10] == 0 && edges[11] == 1 && edges[39] == 29);
    for (int i = 0; i < W * H; i++) f->item[i] = -1; /* background has no shape */
    gn_mask_edges(&f->truth, edges);
    assert_true(isinf(edges[0]));
}

static void test_distance_to_edges_is_exact(void **state) {
    struct flat *f = *state;
    struct gn_dice dice = {3};
    float edges[W * H];
    for (int i = 0; i < W * H; i++) {
        f->lit[i] = gn_dice_between(&dice, 0, 1) > .01;
        f->item[i] = 1;
    }
    gn_mask_edges(&f->truth, edges);
    for (int i = 0; i < W * H; i += 7) {
        float best = INFINITY;
        for (int j = 0; j < W * H; j++)
            if (edges[j] == 0) best = fminf(best, hypotf(i % W - j % W, i / W - j / W));
        assert_true(fabsf(edges[i] - best) < 1e-4f);
    }
}

static void test_colours_by_tolerance_and_share(void **state) {
    (void)state;
    struct gn_picture a, b, c;
    struct gn_difference d;
    gn_picture_init(&a, 10, 10, 3);
    gn_picture_init(&b, 10, 10, 3);
    gn_picture_init(&c, 10, 9, 3);
    assert_true(gn_compare(&a, &b, 0, &d));
    assert_true(d.max == 0 && d.share == 0);
    gn_picture_at(&b, 4, 7)[2] = .25f;
    gn_picture_at(&b, 5, 7)[0] = .125f;
    assert_true(gn_compare(&a, &b, .2, &d));
    assert_true(d.max == .25 && d.share == .01 && d.worst_x == 4 && d.worst_y == 7);
    gn_picture_at(&a, 0, 0)[1] = NAN;
    assert_true(gn_compare(&a, &b, .2, &d));
    assert_true(isinf(d.max) && d.share == .02);
    assert_false(gn_compare(&a, &c, 1, &d));
    assert_true(isinf(d.share));
    gn_picture_finish(&a);
    gn_picture_finish(&b);
    gn_picture_finish(&c);
}

/* --- pictures on disk --- */

static const char *scratch(const char *name) {
    static char path[300];
    snprintf(path, sizeof path, "%s/compare-%d-%s", gn_shot_build(), (int)getpid(), name);
    return path;
}

static bool read_bytes(struct gn_picture *picture, const void *bytes, size_t size) {
    const char *path = scratch("picture");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    struct gn_err err = {0};
    bool ok = gn_picture_read(picture, path, &err);
    assert_true(ok || err.text[0]);
    unlink(path);
    return ok;
}

static void test_pfm_in_both_byte_orders(void **state) {
    (void)state;
    struct gn_picture p;
    static const char little[] = "Pf\n1 2\n-1.0\n\0\0\x80\x3f\0\0\0\x40";
    assert_true(read_bytes(&p, little, sizeof little - 1));
    assert_true(p.channels == 1 && p.width_px == 1 && p.height_px == 2);
    assert_true(p.data[0] == 2 && p.data[1] == 1); /* the bottom row comes first in the file */
    gn_picture_finish(&p);
    static const char big[] = "PF 1 1 1\n\x3f\x80\0\0\x7f\x80\0\0\xbf\0\0\0";
    assert_true(read_bytes(&p, big, sizeof big - 1));
    assert_true(p.channels == 3 && p.data[0] == 1 && isinf(p.data[1]) && p.data[2] == -.5f);
    gn_picture_finish(&p);
    assert_false(read_bytes(&p, big, sizeof big - 2));
    assert_false(read_bytes(&p, big, sizeof big)); /* one byte too many */
    assert_false(read_bytes(&p, "PF 0 1 1\n", 9));
    assert_false(read_bytes(&p, "GIF89a", 6));
    assert_false(read_bytes(&p, "", 0));
}

/* 1x2, 16-bit grey: 0x8000 above 0xffff; made once by hand. */
static const uint8_t png16[] = {
    0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a, 0, 0,  0, 13, 'I', 'H', 'D',
    'R',  0,   0,   0,   1,    0,    0,    0,    2, 16, 0, 0,  0,   0,
};

static uint32_t crc(const uint8_t *bytes, size_t size) {
    uint32_t c = ~0u;
    for (size_t i = 0; i < size; i++) {
        c ^= bytes[i];
        for (int k = 0; k < 8; k++) c = c & 1 ? c >> 1 ^ 0xedb88320 : c >> 1;
    }
    return ~c;
}

static size_t put32(uint8_t *out, uint32_t v) {
    for (int k = 0; k < 4; k++) out[k] = (uint8_t)(v >> (24 - 8 * k));
    return 4;
}

static size_t make_png16(uint8_t *out) {
    /* zlib stream of one stored block: two rows of filter byte 0 and a sample; adler32 at the end
     */
    static const uint8_t rows[6] = {0, 0x80, 0x00, 0, 0xff, 0xff};
    uint32_t a = 1, b = 0;
    for (int i = 0; i < 6; i++) a = (a + rows[i]) % 65521, b = (b + a) % 65521;
    size_t n = sizeof png16, start;
    memcpy(out, png16, n);
    n += put32(out + n, crc(out + 12, 17));
    n += put32(out + n, 17);
    start = n;
    memcpy(out + n, "IDAT\x78\x01\x01\x06\x00\xf9\xff", 11);
    memcpy(out + n + 11, rows, 6);
    n += 17 + put32(out + n + 17, b << 16 | a);
    n += put32(out + n, crc(out + start, n - start));
    n += put32(out + n, 0);
    memcpy(out + n, "IEND", 4);
    n += 4;
    return n + put32(out + n, crc(out + n - 4, 4));
}

static void test_png_of_16_and_8_bits(void **state) {
    (void)state;
    uint8_t bytes[128];
    struct gn_picture p, q;
    struct gn_err err = {0};
    assert_true(read_bytes(&p, bytes, make_png16(bytes)));
    assert_true(p.channels == 1 && p.width_px == 1 && p.height_px == 2);
    assert_true(p.data[0] == 32768.f / 65535 && p.data[1] == 1);
    gn_picture_finish(&p);
    assert_false(read_bytes(&p, bytes, make_png16(bytes) - 30));

    gn_picture_init(&p, 5, 3, 3);
    for (int i = 0; i < 45; i++) p.data[i] = (float)i / 44;
    p.data[3] = INFINITY;
    p.data[4] = -1;
    const char *path = scratch("eight.png");
    assert_true(gn_picture_write_png(&p, path, &err));
    assert_true(gn_picture_read(&q, path, &err));
    unlink(path);
    p.data[3] = 1;
    p.data[4] = 0;
    struct gn_difference d;
    assert_true(gn_compare(&p, &q, .5001 / 255, &d));
    assert_true(d.share == 0);
    gn_picture_finish(&p);
    gn_picture_finish(&q);
}

static void test_failure_leaves_three_pictures(void **state) {
    struct flat *f = *state;
    f->shot.data[5 * W + 30] = 0;
    f->shot.data[5 * W + 3] = 1;
    char folder[300], path[400];
    snprintf(folder, sizeof folder, "%s", scratch("failures/deep"));
    gn_mask_save(folder, "spoilt", &f->truth, &f->shot);
    static const char *const kinds[3] = {"shot", "truth", "diff"};
    for (int i = 0; i < 3; i++) {
        struct gn_picture p;
        struct gn_err err = {0};
        snprintf(path, sizeof path, "%s/spoilt-%s.png", folder, kinds[i]);
        assert_true(gn_picture_read(&p, path, &err));
        assert_int_equal(p.width_px, W);
        if (i == 2) {
            const float *acne = gn_picture_at(&p, 30, 5), *leak = gn_picture_at(&p, 3, 5);
            assert_true(acne[0] == 1 && acne[2] == 0 && leak[0] == 0 && leak[2] == 1);
        }
        gn_picture_finish(&p);
        unlink(path);
    }
    rmdir(folder);
    rmdir(scratch("failures"));
}

/* --- running programs --- */

static void test_runs_programs(void **state) {
    (void)state;
    struct gn_run *run = calloc(1, sizeof *run);
    struct gn_err err = {0};
    assert_true(gn_run(run, (const char *[]){"/bin/sh", "-c", "echo a; echo b >&2; exit 3", NULL},
                       0, &err));
    assert_int_equal(run->status, 3);
    assert_string_equal(run->out, "a\n");
    assert_string_equal(run->err, "b\n");
    assert_true(gn_run(run, (const char *[]){"/bin/sh", "-c", "kill -6 $$", NULL}, 0, &err));
    assert_int_equal(run->status, 134);
    assert_true(gn_run(run, (const char *[]){"/bin/sh", "-c", "exec sleep 9", NULL}, 1, &err));
    assert_int_equal(run->status, 124);
    assert_true(run->seconds < 5);
    /* more than the texts hold must neither hang nor spill */
    assert_true(gn_run(
        run,
        (const char *[]){"/bin/sh", "-c", "head -c 300000 /dev/zero | tr '\\0' x; exit 0", NULL}, 0,
        &err));
    assert_int_equal(run->status, 0);
    assert_int_equal(strlen(run->out), sizeof run->out - 1);
    assert_false(gn_run(run, (const char *[]){"/nonexistent/gnomon", NULL}, 0, &err));
    assert_true(err.text[0]);
    free(run);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_perfect_mask_has_no_fault, setup, teardown),
        cmocka_unit_test_setup_teardown(test_each_fault_is_counted_where_it_belongs, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_band_widens_edges_and_never_narrows_them, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_faint_acne_is_measured_where_light_is_safe, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_steps_and_folds_are_edges, setup, teardown),
        cmocka_unit_test_setup_teardown(test_distance_to_edges_is_exact, setup, teardown),
        cmocka_unit_test(test_colours_by_tolerance_and_share),
        cmocka_unit_test(test_pfm_in_both_byte_orders),
        cmocka_unit_test(test_png_of_16_and_8_bits),
        cmocka_unit_test_setup_teardown(test_failure_leaves_three_pictures, setup, teardown),
        cmocka_unit_test(test_runs_programs),
    };
    return cmocka_run_group_tests_name("compare", tests, NULL, NULL);
}
