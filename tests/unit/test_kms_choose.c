#include <stdio.h>
#include <string.h>

#include "display/kms/card.h"
#include "unit/check.h"

static drmModeModeInfo mode(unsigned w, unsigned h, unsigned hz, uint32_t type, uint32_t flags) {
    drmModeModeInfo m = {.hdisplay = (uint16_t)w,
                         .vdisplay = (uint16_t)h,
                         .htotal = (uint16_t)(w + 100),
                         .vtotal = (uint16_t)(h + 40),
                         .vrefresh = hz,
                         .type = type,
                         .flags = flags};
    m.clock = (w + 100) * (h + 40) * hz / (flags & DRM_MODE_FLAG_INTERLACE ? 2000 : 1000);
    return m;
}

static struct gn_kms_connector *add(struct gn_kms_card *card, const char *name, bool connected) {
    struct gn_kms_connector *c = &card->connectors[card->connector_count++];
    c->id = (uint32_t)(30 + card->connector_count);
    snprintf(c->name, sizeof c->name, "%s", name);
    c->connected = connected;
    c->crtcs = 3;
    c->crtc = -1;
    c->modes[c->mode_count++] = mode(1280, 720, 60, DRM_MODE_TYPE_PREFERRED, 0);
    return c;
}

static struct gn_kms_card card; /* large */

static int set_up(void **state) {
    (void)state;
    memset(&card, 0, sizeof card);
    card.crtc_count = 2;
    card.crtcs[0].id = 50;
    card.crtcs[1].id = 51;
    return 0;
}

static void test_the_first_connected_one(void **state) {
    (void)state;
    add(&card, "HDMI-A-1", false);
    assert_int_equal(gn_kms_choose_connector(&card, NULL), -1);
    assert_int_equal(gn_kms_card_score(&card, NULL), 0);
    add(&card, "Composite-1", false)->unknown = true;
    assert_int_equal(gn_kms_choose_connector(&card, NULL), 1);
    add(&card, "HDMI-A-2", true);
    assert_int_equal(gn_kms_choose_connector(&card, NULL), 2);
    assert_int_equal(gn_kms_choose_connector(&card, "HDMI-A-1"), -1);
    assert_int_equal(gn_kms_choose_connector(&card, "HDMI-A-2"), 2);
}

static void test_without_modes_or_crtc_it_is_none(void **state) {
    (void)state;
    add(&card, "HDMI-A-1", true)->mode_count = 0;
    add(&card, "HDMI-A-2", true)->crtcs = 0;
    assert_int_equal(gn_kms_choose_connector(&card, NULL), -1);
}

static void test_the_crtc_that_is_lit(void **state) {
    (void)state;
    struct gn_kms_connector *c = add(&card, "HDMI-A-1", true);
    assert_int_equal(gn_kms_choose_crtc(&card, 0), 0);
    card.crtcs[0].lit = true; /* by another connector */
    assert_int_equal(gn_kms_choose_crtc(&card, 0), 1);
    c->crtcs = 1;
    assert_int_equal(gn_kms_choose_crtc(&card, 0), 0);
    c->crtc = 1;
    assert_int_equal(gn_kms_choose_crtc(&card, 0), 1);
}

static void expect_ladder(const struct gn_screen_opts *opts, const char *wanted) {
    drmModeModeInfo out[GN_KMS_CANDIDATES_MAX];
    char text[200] = "";
    const int crtc = gn_kms_choose_crtc(&card, 0);
    const int count = gn_kms_mode_candidates(&card, 0, crtc, opts, out);
    for (int i = 0; i < count; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%ux%u%s%u", i ? " " : "",
                 out[i].hdisplay, out[i].vdisplay,
                 out[i].flags & DRM_MODE_FLAG_INTERLACE ? "i" : "@",
                 (gn_kms_mode_mhz(&out[i]) + 500) / 1000);
    assert_string_equal(text, wanted);
}

static void set_modes(struct gn_kms_connector *c) {
    c->mode_count = 0;
    c->modes[c->mode_count++] = mode(3840, 2160, 60, DRM_MODE_TYPE_PREFERRED, 0);
    c->modes[c->mode_count++] = mode(1920, 1080, 60, 0, DRM_MODE_FLAG_INTERLACE);
    c->modes[c->mode_count++] = mode(1920, 1080, 24, 0, 0);
    c->modes[c->mode_count++] = mode(1920, 1080, 50, 0, 0);
    c->modes[c->mode_count++] = mode(1920, 1080, 60, 0, 0);
    c->modes[c->mode_count++] = mode(1280, 720, 60, 0, 0);
    c->modes[c->mode_count++] = mode(640, 480, 60, 0, 0);
}

static void test_the_largest_within_the_cap(void **state) {
    (void)state;
    set_modes(add(&card, "HDMI-A-1", true));
    expect_ladder(&(struct gn_screen_opts){0}, "1920x1080@60 1280x720@60 640x480@60 3840x2160@60");
    expect_ladder(&(struct gn_screen_opts){.cap_width = 3840, .cap_height = 2160},
                  "3840x2160@60 1920x1080@60 1280x720@60 640x480@60");
}

static void test_a_cap_of_few_refreshes(void **state) {
    (void)state;
    struct gn_kms_connector *c = add(&card, "HDMI-A-1", true);
    set_modes(c);
    c->modes[c->mode_count++] = mode(3840, 2160, 30, 0, 0);
    c->modes[c->mode_count++] = mode(3840, 2160, 24, 0, 0);
    const struct gn_screen_opts opts = {.cap_width = 3840, .cap_height = 2160, .cap_hz = 30};
    expect_ladder(&opts, "3840x2160@30 1920x1080@60 1280x720@60 640x480@60 3840x2160@60");
}

static void test_a_cap_of_many_refreshes(void **state) {
    (void)state;
    struct gn_kms_connector *c = add(&card, "DP-1", true);
    c->modes[0] = mode(1920, 1080, 144, DRM_MODE_TYPE_PREFERRED, 0);
    c->modes[c->mode_count++] = mode(1920, 1080, 60, 0, 0);
    expect_ladder(&(struct gn_screen_opts){.cap_hz = 144}, "1920x1080@144 1920x1080@60");
    expect_ladder(&(struct gn_screen_opts){.cap_hz = 75}, "1920x1080@60 1920x1080@144");
}

static void test_a_cap_below_all(void **state) {
    (void)state;
    set_modes(add(&card, "HDMI-A-1", true));
    expect_ladder(&(struct gn_screen_opts){.cap_width = 1280, .cap_height = 720},
                  "1280x720@60 640x480@60 3840x2160@60");
    expect_ladder(&(struct gn_screen_opts){.cap_width = 320, .cap_height = 240},
                  "3840x2160@60 640x480@60");
}

static void test_the_current_mode_is_kept(void **state) {
    (void)state;
    struct gn_kms_connector *c = add(&card, "HDMI-A-1", true);
    set_modes(c);
    c->crtc = 1;
    card.crtcs[1].lit = true;
    card.crtcs[1].mode = c->modes[5];
    expect_ladder(&(struct gn_screen_opts){0}, "1280x720@60 1920x1080@60 640x480@60 3840x2160@60");
    card.crtcs[1].mode = c->modes[0]; /* too large */
    expect_ladder(&(struct gn_screen_opts){0}, "1920x1080@60 1280x720@60 640x480@60 3840x2160@60");
}

static void test_what_was_asked_for_goes_first(void **state) {
    (void)state;
    set_modes(add(&card, "HDMI-A-1", true));
    expect_ladder(&(struct gn_screen_opts){.mode_width = 1920, .mode_height = 1080, .mode_hz = 24},
                  "1920x1080@24 1920x1080@60 1280x720@60 640x480@60 3840x2160@60");
    expect_ladder(&(struct gn_screen_opts){.mode_width = 3840, .mode_height = 2160},
                  "3840x2160@60 1920x1080@60 1280x720@60 640x480@60");
    expect_ladder(&(struct gn_screen_opts){.mode_width = 800, .mode_height = 600},
                  "800x600@60 1920x1080@60 1280x720@60 640x480@60 3840x2160@60");
}

static void test_interlaced_only_when_nothing_else_is(void **state) {
    (void)state;
    struct gn_kms_connector *c = add(&card, "HDMI-A-1", true);
    c->modes[0] = mode(1920, 1080, 60, DRM_MODE_TYPE_PREFERRED, DRM_MODE_FLAG_INTERLACE);
    expect_ladder(&(struct gn_screen_opts){0}, "1920x1080i60");
    c->modes[c->mode_count++] = mode(720, 576, 50, 0, 0);
    expect_ladder(&(struct gn_screen_opts){0}, "720x576@50");
    expect_ladder(&(struct gn_screen_opts){.mode_width = 1920, .mode_height = 1080},
                  "1920x1080i60 720x576@50");
}

/* What the cap saves is pixels in a second. */
static void test_a_small_monitor_may_be_faster(void **state) {
    (void)state;
    struct gn_kms_connector *c = add(&card, "HDMI-A-1", true);
    c->modes[0] = mode(1280, 1024, 75, DRM_MODE_TYPE_PREFERRED, 0);
    c->modes[c->mode_count++] = mode(1920, 1080, 60, 0, 0);
    expect_ladder(&(struct gn_screen_opts){0}, "1280x1024@75 1920x1080@60");
    c->modes[0] = mode(1920, 1080, 144, DRM_MODE_TYPE_PREFERRED, 0);
    expect_ladder(&(struct gn_screen_opts){0}, "1920x1080@60 1920x1080@144");
}

static void test_a_panel_on_its_side_is_within(void **state) {
    (void)state;
    struct gn_kms_connector *c = add(&card, "DSI-1", true);
    c->modes[0] = mode(1080, 1920, 60, DRM_MODE_TYPE_PREFERRED, 0);
    expect_ladder(&(struct gn_screen_opts){0}, "1080x1920@60");
}

/* cvt -r 1920 1080 60 prints this line. */
static void test_cvt(void **state) {
    (void)state;
    drmModeModeInfo line;
    assert_true(gn_kms_modeline_parse(
        "138.50 1920 1968 2000 2080 1080 1083 1088 1111 +hsync -vsync", &line));
    const drmModeModeInfo made = gn_kms_mode_cvt(1920, 1080, 60);
    assert_true(gn_kms_mode_equal(&line, &made));
    assert_int_equal(made.vrefresh, 60);
}

static void test_bad_modelines(void **state) {
    (void)state;
    static const char *const bad[] = {
        "",
        "138.5",
        "138.50 1920 1968 2000 2080 1080 1083 1088",
        "138.50 1920 1900 2000 2080 1080 1083 1088 1111",
        "138.50 1920 1968 2000 2080 1080 1083 1088 1111 +sync",
        "-1 1920 1968 2000 2080 1080 1083 1088 1111",
        "1 1920 1968 2000 70000 1080 1083 1088 1111",
    };
    drmModeModeInfo out;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(gn_kms_modeline_parse(bad[i], &out));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_the_first_connected_one, set_up),
        cmocka_unit_test_setup(test_without_modes_or_crtc_it_is_none, set_up),
        cmocka_unit_test_setup(test_the_crtc_that_is_lit, set_up),
        cmocka_unit_test_setup(test_the_largest_within_the_cap, set_up),
        cmocka_unit_test_setup(test_a_cap_of_few_refreshes, set_up),
        cmocka_unit_test_setup(test_a_cap_of_many_refreshes, set_up),
        cmocka_unit_test_setup(test_a_cap_below_all, set_up),
        cmocka_unit_test_setup(test_the_current_mode_is_kept, set_up),
        cmocka_unit_test_setup(test_what_was_asked_for_goes_first, set_up),
        cmocka_unit_test_setup(test_interlaced_only_when_nothing_else_is, set_up),
        cmocka_unit_test_setup(test_a_small_monitor_may_be_faster, set_up),
        cmocka_unit_test_setup(test_a_panel_on_its_side_is_within, set_up),
        cmocka_unit_test(test_cvt),
        cmocka_unit_test(test_bad_modelines),
    };
    return RUN(tests);
}
