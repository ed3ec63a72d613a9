/* When captions are seen, and how much. */
#include <math.h>

#include "caption/captions.h"
#include "caption/fade.h"
#include "unit/check.h"

enum { WIDTH = 640, HEIGHT = 480 };
#define MS INT64_C(1000000)

static struct gn_captions *captions;

static const struct gn_caption_run *run_at(int64_t now_ns) {
    return gn_captions_run(captions, WIDTH, HEIGHT, now_ns);
}

static void test_a_text_is_shown_as_long_as_it_takes_to_read(void **state) {
    (void)state;
    assert_true(gn_caption_read_ns("", 2000 * MS) == 2000 * MS);
    assert_true(gn_caption_read_ns("Soft", 2000 * MS) == 2000 * MS);
    assert_true(gn_caption_read_ns("Soft", 0) == 1350 * MS);
    assert_true(gn_caption_read_ns(" Soft \n shadows\tof the sun ", 0) == 2750 * MS);
    assert_true(gn_caption_read_ns("Soft shadows of the sun", 9000 * MS) == 9000 * MS);
    assert_true(gn_caption_read_ns("日時計の", 0) == 1700 * MS); /* two words */
    assert_true(gn_caption_read_ns("日時 sun", 0) == 1700 * MS);
}

static void test_a_text_rises_stands_and_falls(void **state) {
    (void)state;
    const struct gn_caption_fade none = {0}, f = gn_caption_begin(&none, 2000 * MS, 1000 * MS);
    assert_true(gn_caption_alpha(&none, 0) == 0.0f && gn_caption_alpha(&none, INT64_MAX) == 0.0f);
    assert_true(gn_caption_alpha(&f, 0) == 0.0f);
    assert_true(gn_caption_alpha(&f, 1000 * MS) == 0.0f);
    assert_true(gn_caption_alpha(&f, 1075 * MS) == 0.5f);
    assert_true(gn_caption_alpha(&f, 1150 * MS) == 1.0f);
    assert_true(gn_caption_alpha(&f, 2600 * MS) == 1.0f);
    assert_true(gn_caption_alpha(&f, 2800 * MS) == 0.5f);
    assert_true(gn_caption_alpha(&f, 3000 * MS) == 0.0f);
    assert_true(gn_caption_alpha(&f, INT64_MAX) == 0.0f);
    for (int64_t ms = 900; ms <= 3100; ms++) {
        const float step = gn_caption_alpha(&f, (ms + 1) * MS) - gn_caption_alpha(&f, ms * MS);
        assert_true(step <= 0.01f && step >= -0.01f);
    }
}

static void test_opacity_never_leaps(void **state) {
    (void)state;
    const int64_t at[] = {1030 * MS, 1075 * MS, 1500 * MS, 2800 * MS, 2990 * MS};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++)
        for (int64_t lasts_ns = 0; lasts_ns <= 2000 * MS; lasts_ns += 2000 * MS) {
            const struct gn_caption_fade none = {0},
                                         f = gn_caption_begin(&none, lasts_ns, 1000 * MS),
                                         ends = gn_caption_end(&f, at[i]),
                                         other = gn_caption_begin(&f, 0, at[i]);
            const float alpha = gn_caption_alpha(&f, at[i]);
            assert_true(fabsf(gn_caption_alpha(&ends, at[i]) - alpha) < 1e-6f);
            assert_true(fabsf(gn_caption_alpha(&other, at[i]) - alpha) < 1e-6f);
            assert_true(gn_caption_alpha(&ends, at[i] + 400 * MS) == 0.0f);
            assert_true(gn_caption_alpha(&other, at[i] + 150 * MS) == 1.0f);
            const struct gn_caption_fade again = gn_caption_end(&ends, at[i] + 10 * MS);
            assert_true(again.ends_ns == ends.ends_ns);
        }
}

/* ---- of the captions ---- */

static void begin_rising(void) {
    gn_captions_destroy(captions);
    captions = gn_captions_create(&(struct gn_captions_opts){.font = "", .rises = true});
}

static float opacity_at(enum gn_caption_kind kind, int64_t now_ns) {
    const struct gn_caption_run *run = run_at(now_ns);
    return run ? run->alpha[kind] : 0.0f;
}

static void test_what_stays_is_opaque(void **state) {
    (void)state;
    static const enum gn_caption_kind kinds[] = {GN_CAPTION_INFO, GN_CAPTION_TEXT, GN_CAPTION_MARK};
    const int64_t year_ns = MS * 1000 * 86400 * 365;
    begin_rising();
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        gn_captions_set(captions, kinds[i], "Hi", 0);
        assert_true(opacity_at(kinds[i], 10 * year_ns) == 1.0f);
    }
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
}

static void test_what_stays_rises_and_falls(void **state) {
    (void)state;
    static const enum gn_caption_kind kinds[] = {GN_CAPTION_INFO, GN_CAPTION_TEXT, GN_CAPTION_CARD};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        begin_rising();
        gn_captions_set(captions, kinds[i], "Hi", 1000 * MS);
        assert_true(opacity_at(kinds[i], 1000 * MS) == 0.0f);
        assert_true(gn_captions_next_ns(captions) == 0);
        assert_true(opacity_at(kinds[i], 1075 * MS) == 0.5f);
        gn_captions_set(captions, kinds[i], "Ho", 1075 * MS); /* goes on from there */
        assert_true(fabsf(opacity_at(kinds[i], 1090 * MS) - 0.6f) < 1e-3f);
        assert_true(opacity_at(kinds[i], 2000 * MS) == 1.0f);
        gn_captions_set(captions, kinds[i], NULL, 3000 * MS);
        assert_true(gn_captions_next_ns(captions) == 0);
        assert_true(opacity_at(kinds[i], 3200 * MS) == 0.5f);
        gn_captions_set(captions, kinds[i], NULL, 3200 * MS); /* nothing changes */
        assert_true(opacity_at(kinds[i], 3300 * MS) == 0.25f);
        assert_null(run_at(3400 * MS));
        assert_true(gn_captions_next_ns(captions) == INT64_MAX);
    }
}

static void test_a_text_that_falls_rises_again(void **state) {
    (void)state;
    begin_rising();
    gn_captions_set(captions, GN_CAPTION_INFO, "Hi", 0);
    gn_captions_set(captions, GN_CAPTION_INFO, NULL, 1000 * MS);
    gn_captions_set(captions, GN_CAPTION_INFO, "Hi", 1200 * MS);
    assert_true(opacity_at(GN_CAPTION_INFO, 1200 * MS) == 0.5f);
    assert_true(opacity_at(GN_CAPTION_INFO, 9000 * MS) == 1.0f);
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
}

/* It is as high as before while it falls. */
static void test_a_bar_falls_with_its_text(void **state) {
    (void)state;
    for (int has_text = 0; has_text < 2; has_text++) {
        begin_rising();
        for (int64_t ms = 0; ms <= 1000; ms += 100) {
            gn_captions_set(captions, GN_CAPTION_TEXT, has_text ? "Loading" : "", ms * MS);
            gn_captions_set_bar(captions, (double)ms / 1000, ms * MS);
            assert_true(opacity_at(GN_CAPTION_TEXT, ms * MS) ==
                        (ms >= 200 ? 1.0f : (float)ms / 150));
        }
        const uint32_t quads = run_at(1000 * MS)->quad_count;
        for (int64_t ms = 1100; ms < 1500; ms += 100) {
            gn_captions_set(captions, GN_CAPTION_TEXT, NULL, ms * MS);
            gn_captions_set_bar(captions, -1, ms * MS);
            assert_int_equal(run_at(ms * MS)->quad_count, quads);
        }
        assert_true(opacity_at(GN_CAPTION_TEXT, 1400 * MS) == 0.25f);
        assert_null(run_at(1500 * MS));
        gn_captions_set(captions, GN_CAPTION_TEXT, "Hi", 1600 * MS); /* without a bar */
        assert_true(opacity_at(GN_CAPTION_TEXT, 2000 * MS) == 1.0f);
        assert_true(run_at(2000 * MS)->quad_count < quads);
    }
}

static int32_t mode_top(int64_t now_ns) {
    const struct gn_caption_run *run = run_at(now_ns);
    int32_t top = HEIGHT;
    for (uint32_t i = 0; run && i < run->quad_count; i++)
        if (run->quads[i].caption == GN_CAPTION_MODE && run->quads[i].y < top)
            top = run->quads[i].y;
    return top;
}

/* What has gone leaves its place to others. */
static void test_a_card_that_has_fallen_takes_no_room(void **state) {
    (void)state;
    begin_rising();
    gn_captions_set(captions, GN_CAPTION_MODE, "Hi", 0);
    const int32_t low = mode_top(200 * MS);
    gn_captions_set(captions, GN_CAPTION_CARD, "Wrong\nLine 3", 0);
    assert_true(mode_top(200 * MS) < low);
    gn_captions_set(captions, GN_CAPTION_MODE, "Hi", 30000 * MS);
    assert_int_equal(mode_top(30200 * MS), low);
}

static int leave(void **state) {
    (void)state;
    gn_captions_destroy(captions);
    captions = NULL;
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_a_text_is_shown_as_long_as_it_takes_to_read, leave),
        cmocka_unit_test_teardown(test_a_text_rises_stands_and_falls, leave),
        cmocka_unit_test_teardown(test_opacity_never_leaps, leave),
        cmocka_unit_test_teardown(test_what_stays_is_opaque, leave),
        cmocka_unit_test_teardown(test_what_stays_rises_and_falls, leave),
        cmocka_unit_test_teardown(test_a_text_that_falls_rises_again, leave),
        cmocka_unit_test_teardown(test_a_bar_falls_with_its_text, leave),
        cmocka_unit_test_teardown(test_a_card_that_has_fallen_takes_no_room, leave),
    };
    return RUN(tests);
}
