#include "unit/check.h"

#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"
#include "image/picture.h"
#include "kiosk/screenshot.h"

static char folder[] = "/tmp/gnomon-shot-XXXXXX", path[100];
static struct gn_err err;
static struct gn_screenshot *shot;

static const char *in_folder(const char *name) {
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* Waits for the thread; what it says. */
static bool finish(void) {
    struct pollfd p = {.fd = gn_screenshot_fd(shot), .events = POLLIN};
    bool ok = false;
    assert_int_equal(poll(&p, 1, 10000), 1);
    assert_true(gn_screenshot_take(shot, &ok, &err));
    return ok;
}

/* An upright picture of 3 x 2, each pixel of its own red, as a screen that is turned clockwise
 * shows it: written down by hand, row by row. */
static const struct {
    unsigned turn_deg;
    uint32_t width_px, height_px;
    uint8_t red[6];
} screens[] = {
    {0, 3, 2, {1, 2, 3, 4, 5, 6}},
    {90, 2, 3, {4, 1, 5, 2, 6, 3}},
    {180, 3, 2, {6, 5, 4, 3, 2, 1}},
    {270, 2, 3, {3, 6, 2, 5, 1, 4}},
};

static void a_turned_screen_gives_an_upright_picture(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof screens / sizeof screens[0]; i++) {
        struct gn_picture picture = {0};
        gn_screenshot_ask(shot, in_folder("a.png"));
        uint8_t *rgba = gn_screenshot_begin(shot, screens[i].width_px, screens[i].height_px,
                                            screens[i].turn_deg, &err);
        assert_non_null(rgba);
        for (int k = 0; k < 6; k++)
            memcpy(rgba + 4 * k, (uint8_t[]){(uint8_t)(screens[i].red[k] * 40), 7, 9, 0}, 4);
        assert_true(gn_screenshot_is_asked(shot) && gn_screenshot_start(shot, &err));
        assert_false(gn_screenshot_is_asked(shot));
        if (!finish()) fail_msg("%s", err.text);
        if (!gn_picture_read(&picture, in_folder("a.png"), &err)) fail_msg("%s", err.text);
        assert_int_equal(picture.width_px, 3);
        assert_int_equal(picture.height_px, 2);
        for (int k = 0; k < 6; k++) {
            const float *pixel = gn_picture_at(&picture, k % 3, k / 3);
            assert_int_equal(lrintf(pixel[0] * 255), (k + 1) * 40);
            assert_int_equal(lrintf(pixel[1] * 255), 7);
            assert_int_equal(lrintf(pixel[2] * 255), 9);
        }
        gn_picture_finish(&picture);
    }
}

static void a_name_that_is_not_fit_is_refused_before(void **state) {
    (void)state;
    assert_true(gn_screenshot_check("/tmp/x.png", &err));
    assert_false(gn_screenshot_check("x.png", &err));
    assert_int_equal(err.status, GN_EXIT_USAGE);
    assert_false(gn_screenshot_check("/tmp/x.jpg", &err));
    assert_false(gn_screenshot_check("/tmp/.png", &err));
    assert_false(gn_screenshot_check("", &err));
    assert_false(gn_screenshot_check("/dev/null", &err));
    assert_int_equal(symlink("/etc/passwd", in_folder("link.png")), 0);
    assert_false(gn_screenshot_check(path, &err));
    assert_non_null(strstr(err.text, "not replacing it"));
    assert_int_equal(mkdir(in_folder("folder.png"), 0700), 0);
    assert_false(gn_screenshot_check(path, &err));
    assert_int_equal(mkfifo(in_folder("fifo.png"), 0600), 0);
    assert_false(gn_screenshot_check(path, &err));
}

/* Whatever comes there after the check. */
static void nothing_but_a_file_is_written_over(void **state) {
    (void)state;
    char victim[100], link[100];
    struct stat info;
    snprintf(victim, sizeof victim, "%s/victim", folder);
    snprintf(link, sizeof link, "%s/later.png", folder);
    assert_true(gn_file_write(victim, "kept", 4, &err));
    assert_int_equal(symlink(victim, link), 0);
    assert_false(gn_file_replace(link, "x", 1, &err));
    assert_non_null(strstr(err.text, "refusing to overwrite a symbolic link"));
    assert_int_equal(stat(victim, &info), 0);
    assert_int_equal(info.st_size, 4);
    assert_int_equal(lstat(link, &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_false(gn_file_replace("/dev/null", "x", 1, &err));
    assert_false(gn_file_replace(folder, "x", 1, &err));
    assert_false(gn_file_replace(in_folder("no/such.png"), "x", 1, &err));
    assert_true(gn_file_replace(victim, "new", 3, &err));
    assert_int_equal(stat(victim, &info), 0);
    assert_int_equal(info.st_size, 3);
    gn_screenshot_ask(shot, in_folder("no/such.png"));
    assert_non_null(gn_screenshot_begin(shot, 2, 2, 0, &err));
    assert_true(gn_screenshot_start(shot, &err));
    assert_false(finish());
    assert_non_null(strstr(err.text, "no/such.png: cannot write"));
}

static void what_fails_is_taken_with_its_reason(void **state) {
    (void)state;
    struct gn_err why = {0};
    bool ok = true;
    gn_screenshot_ask(shot, in_folder("b.png"));
    assert_non_null(gn_screenshot_begin(shot, 1000, 1000, 0, &err));
    assert_false(gn_screenshot_take(shot, &ok, &err));
    gn_fail(&why, "no frame came");
    gn_screenshot_fail(shot, &why);
    assert_false(gn_screenshot_is_asked(shot));
    assert_false(finish());
    assert_string_equal(err.text, "no frame came");
    assert_false(gn_screenshot_take(shot, &ok, &err));
    gn_screenshot_ask(shot, path);
    assert_non_null(gn_screenshot_begin(shot, 1000, 1000, 0, &err));
    assert_true(gn_screenshot_start(shot, &err)); /* the end waits for it */
}

static int begin(void **state) {
    (void)state;
    err = (struct gn_err){0};
    shot = gn_screenshot_create(&err);
    return shot ? 0 : -1;
}

static int end(void **state) {
    (void)state;
    gn_screenshot_destroy(shot);
    return 0;
}

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int leave(void **state) {
    char command[100];
    (void)state;
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_turned_screen_gives_an_upright_picture, begin, end),
        cmocka_unit_test(a_name_that_is_not_fit_is_refused_before),
        cmocka_unit_test_setup_teardown(nothing_but_a_file_is_written_over, begin, end),
        cmocka_unit_test_setup_teardown(what_fails_is_taken_with_its_reason, begin, end),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
