/* A folder that is taken over from a stick, on a disk that loses its power: below are the real
 * calls in a temporary folder, but what was not flushed can be lost. Before each call the power is
 * cut, or the stick is pulled, or that one call fails; what is shown is then the old version or the
 * new one, whole, and the next run works. */
#include "unit/check.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/clock.h"
#include "take/take.h"
#include "unit/cut_disk.h"

static char top[] = "/tmp/gn-test-take-XXXXXX", dir[64], stick[64], trash[64];
static struct gn_err err;

/* ---- sticks --------------------------------------------------------------------------------- */

static void write_file(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static const char *on_stick(const char *name) {
    static char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/gnomon/%s", stick, name);
    return path;
}

static void clear_stick(void) {
    gn_cut_remove(stick);
    assert_int_equal(mkdir(stick, 0755), 0);
    assert_int_equal(mkdir(on_stick(""), 0755), 0);
}

/* Each file of a version has its name in it. */
static void fill_stick(const char *version) {
    clear_stick();
    write_file(on_stick("KIOSK.ini"), version);
    write_file(on_stick("a.glb"), version);
    write_file(on_stick(".Trashes"), "of a Mac");
    assert_int_equal(mkdir(on_stick("parts"), 0755), 0);
    write_file(on_stick("parts/b.bin"), version);
}

static void check_text(const char *folder, const char *name, const char *version) {
    char path[2 * PATH_MAX], text[100] = "";
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(text, version);
}

static int count_names(const char *path) {
    DIR *stream = opendir(path);
    assert_non_null(stream);
    int count = -2;
    while (readdir(stream)) count++;
    closedir(stream);
    return count;
}

/* Which of both is shown, whole; it is nothing else. */
static const char *shown(const char *a, const char *b) {
    struct gn_take_shown now;
    char text[100] = "";
    assert_true(gn_take_shown(dir, &now));
    FILE *file = fopen(now.ini, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    const char *version = strcmp(text, a) == 0 ? a : b;
    check_text(now.folder, "kiosk.ini", version);
    check_text(now.folder, "a.glb", version);
    check_text(now.folder, "parts/b.bin", version);
    char parts[PATH_MAX + 8];
    snprintf(parts, sizeof parts, "%s/parts", now.folder);
    assert_int_equal(count_names(now.folder), 3);
    assert_int_equal(count_names(parts), 1);
    return version;
}

static bool take_with(const struct gn_disk *files, const struct gn_take_limits *limits) {
    struct gn_take take;
    err = (struct gn_err){0};
    bool ok = gn_take_open(&take, files, dir, limits, &err);
    const enum gn_take_found found = ok ? gn_take_look(&take, stick, &err) : GN_TAKE_FAILED;
    if (found == GN_TAKE_FRESH) ok = gn_take_copy(&take, &err) && gn_take_keep(&take, &err);
    if (found == GN_TAKE_FAILED) ok = false;
    gn_take_close(&take);
    assert_int_equal(ok, !err.text[0]);
    return ok;
}

static bool take_back(const struct gn_disk *files) {
    struct gn_take take;
    err = (struct gn_err){0};
    const bool ok = gn_take_open(&take, files, dir, NULL, &err) && gn_take_back(&take, &err);
    gn_take_close(&take);
    return ok;
}

static enum gn_take_found look(void) {
    struct gn_take take;
    err = (struct gn_err){0};
    assert_true(gn_take_open(&take, &gn_disk, dir, NULL, &err));
    const enum gn_take_found found = gn_take_look(&take, stick, &err);
    gn_take_close(&take);
    return found;
}

static const char *versions_path(void) {
    static char path[80];
    snprintf(path, sizeof path, "%s/versions", dir);
    return path;
}

/* "older" is the version before, "old" is shown, "new" is on the stick. */
static void prepare(void) {
    gn_cut_start(); /* which never waits for a real disk */
    gn_cut_remove(dir);
    fill_stick("older");
    assert_true(take_with(&gn_cut_files, NULL));
    fill_stick("old");
    assert_true(take_with(&gn_cut_files, NULL));
    fill_stick("new");
    gn_cut_start();
}

/* The next run, with a disk that is well, shows the new version and leaves nothing behind. */
static void check_next_run(void) {
    gn_cut_start();
    assert_true(take_with(&gn_cut_files, NULL));
    assert_string_equal(shown("new", "new"), "new");
    assert_true(count_names(versions_path()) <= 2);
    assert_int_equal(count_names(dir), count_names(versions_path()) == 2 ? 4 : 3);
}

/* ---- tests ---------------------------------------------------------------------------------- */

static void test_a_cut_of_the_power_leaves_the_old_version_or_the_new_one(void **state) {
    int old = 0, fresh = 0;
    (void)state;
    for (int loss = 0; loss < GN_CUT_LOSSES; loss++)
        for (int cut = 0;; cut++) {
            prepare();
            gn_cut_disk.cut_at = cut;
            const bool ok = take_with(&gn_cut_files, NULL);
            const bool was_cut = gn_cut_disk.dead;
            gn_cut_lose(loss);
            const bool is_new = strcmp(shown("old", "new"), "new") == 0;
            if (ok) assert_true(is_new);
            old += !is_new;
            fresh += is_new;
            check_next_run();
            if (!was_cut) break;
        }
    assert_true(old > 100);
    assert_true(fresh > 10); /* cuts while older versions are removed */
}

static void test_the_first_version_is_there_whole_or_not_at_all(void **state) {
    (void)state;
    for (int loss = 0; loss < GN_CUT_LOSSES; loss++)
        for (int cut = 0;; cut++) {
            struct gn_take_shown now;
            gn_cut_remove(dir);
            fill_stick("new");
            gn_cut_start();
            gn_cut_disk.cut_at = cut;
            take_with(&gn_cut_files, NULL);
            const bool was_cut = gn_cut_disk.dead;
            gn_cut_lose(loss);
            if (gn_take_shown(dir, &now)) assert_string_equal(shown("new", "new"), "new");
            check_next_run();
            if (!was_cut) break;
        }
}

static void test_a_pulled_stick_leaves_what_is_shown(void **state) {
    int failures = 0;
    (void)state;
    for (int pull = 0;; pull++) {
        prepare();
        gn_cut_disk.pull_at = pull;
        const bool ok = take_with(&gn_cut_files, NULL);
        if (!gn_cut_disk.pulled) break;
        assert_string_equal(shown("old", "new"), ok ? "new" : "old");
        assert_int_equal(count_names(versions_path()), 2); /* no half copy */
        failures += !ok;
        check_next_run();
    }
    assert_true(failures > 20);
}

static void test_a_call_that_fails_leaves_the_old_version_or_the_new_one(void **state) {
    static const int reasons[] = {ENOSPC, EIO};
    int failures = 0;
    (void)state;
    for (int r = 0; r < 2; r++)
        for (int fail = 0;; fail++) {
            prepare();
            gn_cut_disk.fail_at = fail;
            gn_cut_disk.reason = reasons[r];
            const bool ok = take_with(&gn_cut_files, NULL);
            const bool failed = gn_cut_disk.calls > fail;
            const char *version = shown("old", "new");
            if (ok) assert_string_equal(version, "new");
            failures += !ok;
            check_next_run();
            if (!failed) break;
        }
    assert_true(failures > 50);
}

static void test_going_back_is_whole_too(void **state) {
    (void)state;
    for (int way = 0; way < 2; way++)
        for (int loss = 0; loss < GN_CUT_LOSSES; loss++)
            for (int cut = 0;; cut++) {
                prepare();
                gn_cut_disk.keeps_names = way == 1;
                gn_cut_disk.cut_at = cut;
                const bool ok = take_back(&gn_cut_files);
                const bool was_cut = gn_cut_disk.dead;
                gn_cut_lose(loss);
                const char *version = shown("old", "older");
                if (ok) assert_string_equal(version, "older");
                check_next_run();
                if (!was_cut) break;
            }
}

static void test_what_was_gone_back_from_does_not_come_again(void **state) {
    (void)state;
    prepare();
    assert_true(take_with(&gn_disk, NULL));
    assert_int_equal(look(), GN_TAKE_SAME);
    assert_true(take_back(&gn_disk));
    assert_string_equal(shown("old", "new"), "old");
    assert_int_equal(look(), GN_TAKE_BACK);
    assert_true(take_back(&gn_disk));
    assert_string_equal(shown("old", "new"), "new");
    fill_stick("old"); /* an older one may come back from another stick */
    assert_int_equal(look(), GN_TAKE_FRESH);
    assert_true(take_with(&gn_disk, NULL));
    assert_string_equal(shown("old", "new"), "old");
    assert_true(take_back(&gn_disk));
    fill_stick("third");
    assert_true(take_with(&gn_disk, NULL));
    assert_string_equal(shown("third", "new"), "third");
    assert_int_equal(count_names(versions_path()), 2);
}

static void test_without_a_version_before_there_is_no_way_back(void **state) {
    (void)state;
    gn_cut_remove(dir);
    assert_false(take_back(&gn_disk));
    fill_stick("new");
    assert_true(take_with(&gn_disk, NULL));
    assert_false(take_back(&gn_disk));
    assert_string_equal(shown("new", "new"), "new");
}

static void change_stick(void) { write_file(on_stick("a.glb"), "changed"); }

static void test_a_stick_that_changes_while_it_is_copied_is_refused(void **state) {
    struct gn_take take;
    (void)state;
    prepare();
    assert_true(gn_take_open(&take, &gn_disk, dir, NULL, &err));
    assert_int_equal(gn_take_look(&take, stick, &err), GN_TAKE_FRESH);
    change_stick();
    assert_false(gn_take_copy(&take, &err));
    assert_non_null(strstr(err.text, "has changed while it was copied"));
    gn_take_close(&take);
    assert_string_equal(shown("old", "new"), "old");
}

static void test_links_of_others_are_left_alone(void **state) {
    char path[80];
    (void)state;
    prepare();
    snprintf(path, sizeof path, "%s/current", dir);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(symlink("/srv/mine", path), 0);
    assert_false(take_with(&gn_disk, NULL));
    assert_non_null(strstr(err.text, "not those of gnomon take"));
    assert_int_equal(count_names(versions_path()), 2);
}

static void test_two_at_once_wait_for_each_other(void **state) {
    struct gn_take take;
    const struct gn_take_limits hasty = {.patience_ns = GN_NS_PER_S / 10};
    (void)state;
    prepare();
    assert_true(gn_take_open(&take, &gn_disk, dir, NULL, &err));
    assert_false(take_with(&gn_disk, &hasty));
    assert_non_null(strstr(err.text, "another gnomon take is at work"));
    gn_take_close(&take);
    assert_true(take_with(&gn_disk, &hasty));
}

/* ---- what is refused ------------------------------------------------------------------------ */

static void check_refused(const char *why) {
    err = (struct gn_err){0};
    assert_int_equal(look(), GN_TAKE_FAILED);
    if (!strstr(err.text, why)) fail_msg("\"%s\" has no \"%s\"", err.text, why);
}

static void test_what_is_no_file_is_refused(void **state) {
    (void)state;
    prepare();
    assert_int_equal(symlink("/etc/passwd", on_stick("link.png")), 0);
    check_refused("gnomon/link.png: is a symbolic link");
    fill_stick("new");
    assert_int_equal(symlink("/etc", on_stick("link")), 0);
    check_refused("gnomon/link: is a symbolic link");
    fill_stick("new");
    assert_int_equal(mkfifo(on_stick("parts/pipe"), 0600), 0);
    check_refused("gnomon/parts/pipe: is neither a file nor a folder");
}

static void test_names_that_are_no_text_are_refused(void **state) {
    static const char *const names[] = {
        "a\nb",    "\xff",         "\xc0\xaf",         "\xe2\x80\xae.glb",
        "\x1b[2J", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xc2\x85"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        fill_stick("new");
        write_file(on_stick(names[i]), "x");
        check_refused("not UTF-8, or has control characters");
    }
    fill_stick("new");
    write_file(on_stick("\xc3\xa4 \xe2\x82\xac \xf0\x9f\x8c\x9e ...png"), "x");
    assert_int_equal(look(), GN_TAKE_FRESH);
}

static void test_too_much_is_refused(void **state) {
    (void)state;
    prepare();
    assert_false(take_with(&gn_disk, &(struct gn_take_limits){.files = 2}));
    assert_non_null(strstr(err.text, "more than 2 files"));
    assert_false(take_with(&gn_disk, &(struct gn_take_limits){.bytes = 5}));
    assert_non_null(strstr(err.text, "more than 0 MB"));
    assert_true(take_with(&gn_disk, &(struct gn_take_limits){.files = 4, .bytes = 9}));
    fill_stick("fourth");
    assert_false(take_with(&gn_disk, &(struct gn_take_limits){.reserve = UINT64_C(1) << 62}));
    assert_non_null(strstr(err.text, "MB free"));
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s", on_stick("1"));
    for (int i = 0; i < 9; i++) {
        assert_int_equal(mkdir(path, 0755), 0);
        snprintf(path + strlen(path), sizeof path - strlen(path), "/1");
    }
    check_refused("more than 8 folders in each other");
}

static void test_one_scene_needs_no_kiosk_ini(void **state) {
    struct gn_take_shown now;
    (void)state;
    prepare();
    clear_stick();
    assert_int_equal(look(), GN_TAKE_NOTHING);
    write_file(on_stick("gnomon-status.txt"), "ours");
    assert_int_equal(look(), GN_TAKE_NOTHING);
    write_file(on_stick("a.bin"), "x");
    check_refused("neither a kiosk.ini nor a scene");
    write_file(on_stick("A.GLB"), "x");
    assert_true(take_with(&gn_disk, NULL));
    assert_true(gn_take_shown(dir, &now));
    assert_string_equal(now.ini, "");
    assert_string_equal(strrchr(now.scene, '/'), "/A.GLB");
    write_file(on_stick("b.obj"), "x");
    check_refused("2 scenes (A.GLB, b.obj), and no kiosk.ini");
    write_file(on_stick("kiosk.ini"), "x");
    assert_int_equal(look(), GN_TAKE_FRESH);
    write_file(on_stick("Kiosk.ini"), "x");
    assert_false(take_with(&gn_disk, NULL));
    assert_non_null(strstr(err.text, "differs from it only in capitals"));
    assert_int_equal(count_names(versions_path()), 2);
}

static void test_the_folder_is_found_in_any_case(void **state) {
    char from[80], to[80];
    (void)state;
    prepare();
    snprintf(from, sizeof from, "%s/gnomon", stick);
    snprintf(to, sizeof to, "%s/GnoMon", stick);
    assert_int_equal(rename(from, to), 0);
    assert_true(take_with(&gn_disk, NULL));
    assert_string_equal(shown("old", "new"), "new");
    gn_cut_remove(to);
    assert_int_equal(look(), GN_TAKE_NOTHING);
    write_file(to, "a file");
    assert_int_equal(look(), GN_TAKE_NOTHING);
}

static void test_a_folder_called_current_is_not_a_link(void **state) {
    struct gn_take_shown now;
    (void)state;
    prepare();
    assert_int_equal(mkdir(on_stick("current"), 0755), 0);
    write_file(on_stick("current/kiosk.ini"), "another");
    assert_true(gn_take_shown(on_stick(""), &now));
    assert_null(strstr(now.ini, "current"));
}

static int make_top(void **state) {
    (void)state;
    if (!mkdtemp(top)) return -1;
    snprintf(dir, sizeof dir, "%s/content", top);
    snprintf(stick, sizeof stick, "%s/stick", top);
    snprintf(trash, sizeof trash, "%s/trash", top);
    gn_cut_disk.dir = dir;
    gn_cut_disk.stick = stick;
    gn_cut_disk.trash = trash;
    return 0;
}

static int remove_top(void **state) {
    (void)state;
    gn_cut_start();
    gn_cut_remove(top);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_cut_of_the_power_leaves_the_old_version_or_the_new_one),
        cmocka_unit_test(test_the_first_version_is_there_whole_or_not_at_all),
        cmocka_unit_test(test_a_pulled_stick_leaves_what_is_shown),
        cmocka_unit_test(test_a_call_that_fails_leaves_the_old_version_or_the_new_one),
        cmocka_unit_test(test_going_back_is_whole_too),
        cmocka_unit_test(test_what_was_gone_back_from_does_not_come_again),
        cmocka_unit_test(test_without_a_version_before_there_is_no_way_back),
        cmocka_unit_test(test_a_stick_that_changes_while_it_is_copied_is_refused),
        cmocka_unit_test(test_links_of_others_are_left_alone),
        cmocka_unit_test(test_two_at_once_wait_for_each_other),
        cmocka_unit_test(test_what_is_no_file_is_refused),
        cmocka_unit_test(test_names_that_are_no_text_are_refused),
        cmocka_unit_test(test_too_much_is_refused),
        cmocka_unit_test(test_one_scene_needs_no_kiosk_ini),
        cmocka_unit_test(test_the_folder_is_found_in_any_case),
        cmocka_unit_test(test_a_folder_called_current_is_not_a_link),
    };
    return cmocka_run_group_tests(tests, make_top, remove_top);
}
