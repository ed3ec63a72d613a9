#include "unit/check.h"

#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/clock.h"
#include "core/file.h"
#include "image/picture.h"
#include "kiosk/screenshot.h"
#include "unit/folder.h"

static char folder[] = "/tmp/gnomon-shot-XXXXXX", path[100];
static struct gn_err err;
static struct gn_screenshot *shot;
static struct gn_loop *loop;
static bool is_told; /* by the loop, that a screenshot can be taken */

static const char *in_folder(const char *name) {
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* Waits for the thread; what it says. */
static bool finish(void) {
    bool ok = false;
    is_told = false;
    gn_loop_step(loop, gn_loop_now_ns(loop) + 10 * GN_NS_PER_S);
    assert_true(is_told);
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
        gn_screenshot_ask(shot, in_folder("a.png"), -1);
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

/* In the captions' font, on the ground of messages: in the font inside the program, of two colours,
 * which are unlike in all channels. */
static void a_text_takes_the_place_of_a_frame(void **state) {
    (void)state;
    struct gn_picture picture = {0};
    int ink = 0;
    gn_screenshot_ask(shot, in_folder("a.png"), -1);
    assert_true(gn_screenshot_say(shot, 90, 40, "", "it is off", &err));
    if (!finish()) fail_msg("%s", err.text);
    if (!gn_picture_read(&picture, in_folder("a.png"), &err)) fail_msg("%s", err.text);
    assert_int_equal(picture.width_px, 90);
    assert_int_equal(picture.height_px, 40);
    for (int i = 0; i < 90 * 40; i++) {
        const float *pixel = gn_picture_at(&picture, i % 90, i / 90);
        const bool is_ink = pixel[0] > 0.5f;
        const int expected[2][3] = {{0x20, 0x24, 0x28}, {0xe8, 0xe8, 0xe8}};
        for (int k = 0; k < 3; k++) assert_int_equal(lrintf(pixel[k] * 255), expected[is_ink][k]);
        ink += is_ink;
    }
    assert_in_range(ink, 50, 150); /* seven letters of 35 dots, about a third of each */
    gn_picture_finish(&picture);
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

static void fill(unsigned value) {
    uint8_t *rgba = gn_screenshot_begin(shot, 2, 2, 0, &err);
    assert_non_null(rgba);
    memset(rgba, (int)value, 16);
    assert_true(gn_screenshot_start(shot, &err));
}

static void a_client_gets_it_in_its_memory_file(void **state) {
    (void)state;
    char memory[40], target[PATH_MAX];
    struct gn_picture picture = {0};
    const int fd = memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    assert_true(gn_screenshot_permits("/any/where.png", fd, NULL, target, &err));
    gn_screenshot_ask(shot, in_folder("none.png"), fd);
    fill(51);
    if (!finish()) fail_msg("%s", err.text);
    assert_int_equal(access(path, F_OK), -1);
    snprintf(memory, sizeof memory, "/proc/self/fd/%d", fd);
    if (!gn_picture_read(&picture, memory, &err)) fail_msg("%s", err.text);
    assert_int_equal(lrintf(gn_picture_at(&picture, 1, 1)[0] * 255), 51);
    gn_picture_finish(&picture);

    /* one that cannot be written is the client's mistake */
    assert_int_equal(fcntl(fd, F_ADD_SEALS, F_SEAL_WRITE), 0);
    gn_screenshot_ask(shot, path, fd);
    fill(52);
    assert_false(finish());
    assert_non_null(strstr(err.text, "client's memory file"));
    close(fd);
}

static void no_other_descriptor_is_written_to(void **state) {
    (void)state;
    char target[PATH_MAX];
    int pipes[2];
    assert_int_equal(pipe(pipes), 0);
    const int fds[] = {pipes[1], open("/dev/null", O_RDWR), socket(AF_UNIX, SOCK_STREAM, 0),
                       open("/proc/self/stat", O_RDONLY), open("/tmp", O_PATH)};
    for (size_t i = 0; i < sizeof fds / sizeof fds[0]; i++) {
        assert_true(fds[i] >= 0);
        assert_false(gn_screenshot_permits("/tmp/x.png", fds[i], "/tmp", target, &err));
        assert_non_null(strstr(err.text, "no writable memory file"));
        close(fds[i]);
    }
    close(pipes[0]);
}

static void the_kiosk_writes_into_the_configured_folder_only(void **state) {
    (void)state;
    static const char *const outside[] = {"shots/a/x.png", "shots/../x.png", "shotsx/x.png",
                                          "x.png",         "way/x.png",      "shots/./x.png"};
    char shots[100], link[100], target[PATH_MAX], wanted[PATH_MAX];
    assert_int_equal(mkdir(in_folder("shots"), 0700), 0);
    snprintf(shots, sizeof shots, "%s", path);
    assert_int_equal(mkdir(in_folder("shots/a"), 0700), 0);
    assert_int_equal(mkdir(in_folder("shotsx"), 0700), 0);
    snprintf(link, sizeof link, "%s", in_folder("way"));
    assert_int_equal(symlink(shots, link), 0);
    assert_non_null(realpath(shots, wanted));
    strcat(wanted, "/x.png");
    assert_true(gn_screenshot_permits(in_folder("shots/x.png"), -1, shots, target, &err));
    assert_string_equal(target, wanted);
    assert_true(gn_screenshot_permits(path, -1, strcat(shots, "//"), target, &err));
    assert_string_equal(target, wanted);
    assert_true(gn_screenshot_permits(path, -1, link, target, &err));
    assert_string_equal(target, wanted);
    assert_true(gn_screenshot_permits(in_folder("way/x.png"), -1, link, target, &err));
    assert_string_equal(target, wanted);
    assert_true(gn_screenshot_permits("/x.png", -1, "/", target, &err));
    assert_string_equal(target, "/x.png");
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        assert_false(gn_screenshot_permits(in_folder(outside[i]), -1, shots, target, &err));
        assert_non_null(strstr(err.text, "is not in /"));
    }
    assert_false(gn_screenshot_permits("/tmp/x.png", -1, NULL, target, &err));
    assert_non_null(strstr(err.text, "screenshots in [kiosk]"));
}

/* The kiosk may see more than its client. */
static void a_client_does_not_learn_what_is_elsewhere(void **state) {
    (void)state;
    char target[PATH_MAX], shots[100], before[sizeof err.text];
    snprintf(shots, sizeof shots, "%s/shots", folder);
    in_folder("is.png");
    for (int i = 0; i < 2; i++) {
        const char *configured = i ? shots : NULL;
        assert_false(gn_screenshot_permits(path, -1, configured, target, &err));
        memcpy(before, err.text, sizeof before);
        assert_int_equal(mkdir(path, 0700), 0);
        assert_false(gn_screenshot_permits(path, -1, configured, target, &err));
        assert_string_equal(err.text, before);
        assert_int_equal(rmdir(path), 0);
    }
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
    gn_screenshot_ask(shot, in_folder("no/such.png"), -1);
    assert_non_null(gn_screenshot_begin(shot, 2, 2, 0, &err));
    assert_true(gn_screenshot_start(shot, &err));
    assert_false(finish());
    assert_non_null(strstr(err.text, "no/such.png: cannot write"));
}

static void what_fails_is_taken_with_its_reason(void **state) {
    (void)state;
    struct gn_err why = {0};
    bool ok = true;
    gn_screenshot_ask(shot, in_folder("b.png"), -1);
    assert_non_null(gn_screenshot_begin(shot, 1000, 1000, 0, &err));
    assert_false(gn_screenshot_take(shot, &ok, &err));
    gn_fail(&why, "no frame came");
    gn_screenshot_fail(shot, &why);
    assert_false(gn_screenshot_is_asked(shot));
    assert_false(finish());
    assert_string_equal(err.text, "no frame came");
    assert_false(gn_screenshot_take(shot, &ok, &err));
    gn_screenshot_ask(shot, path, -1);
    assert_non_null(gn_screenshot_begin(shot, 1000, 1000, 0, &err));
    assert_true(gn_screenshot_start(shot, &err)); /* the end waits for it */
}

static void note_told(void *user, int64_t now_ns) {
    (void)now_ns;
    *(bool *)user = true;
}

static int begin(void **state) {
    (void)state;
    err = (struct gn_err){0};
    loop = gn_loop_open(&err);
    shot = loop ? gn_screenshot_create(loop, note_told, &is_told, &err) : NULL;
    return shot ? 0 : -1;
}

static int end(void **state) {
    (void)state;
    gn_screenshot_destroy(shot);
    gn_loop_close(loop);
    return 0;
}

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int leave(void **state) {
    (void)state;
    return gn_test_remove_folder(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_turned_screen_gives_an_upright_picture, begin, end),
        cmocka_unit_test_setup_teardown(a_text_takes_the_place_of_a_frame, begin, end),
        cmocka_unit_test(a_name_that_is_not_fit_is_refused_before),
        cmocka_unit_test_setup_teardown(a_client_gets_it_in_its_memory_file, begin, end),
        cmocka_unit_test(no_other_descriptor_is_written_to),
        cmocka_unit_test(the_kiosk_writes_into_the_configured_folder_only),
        cmocka_unit_test(a_client_does_not_learn_what_is_elsewhere),
        cmocka_unit_test_setup_teardown(nothing_but_a_file_is_written_over, begin, end),
        cmocka_unit_test_setup_teardown(what_fails_is_taken_with_its_reason, begin, end),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
