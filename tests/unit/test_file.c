#include "unit/check.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include "core/file.h"
#include "unit/folder.h"

static char folder[] = "/tmp/gnomon-file-XXXXXX";

static const char *in_folder(const char *name) {
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state) {
    (void)state;
    return gn_test_remove_folder(folder);
}

static int files_here(void) {
    int count = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *e; (e = readdir(dir));)
        count += strcmp(e->d_name, ".") && strcmp(e->d_name, "..");
    closedir(dir);
    return count;
}

static void assert_holds(const char *path, const char *text) {
    struct gn_bytes bytes;
    struct gn_err err = {0};
    assert_true(gn_file_read(path, 0, &bytes, &err));
    assert_int_equal(bytes.size, strlen(text));
    assert_string_equal((char *)bytes.data, text);
    gn_bytes_finish(&bytes);
}

static void assert_refused(const char *path, const char *why) {
    struct gn_bytes bytes;
    struct gn_err err = {0};
    assert_false(gn_file_read(path, 0, &bytes, &err));
    assert_null(bytes.data);
    assert_non_null(strstr(err.text, path));
    if (!strstr(err.text, why)) fail_msg("\"%s\" does not say \"%s\"", err.text, why);
}

static void what_was_written_is_read(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_true(gn_file_write(in_folder("a"), "sun", 3, &err));
    assert_holds(in_folder("a"), "sun");
    assert_true(gn_file_write(in_folder("a"), "", 0, &err));
    assert_holds(in_folder("a"), "");
    assert_true(gn_file_write("relative", "x", 1, &err));
    assert_holds(in_folder("relative"), "x");
}

static void a_file_of_many_megabytes_is_whole(void **state) {
    (void)state;
    struct gn_err err = {0};
    size_t size = 5 * 1024 * 1024 + 3;
    char *data = malloc(size);
    for (size_t i = 0; i < size; i++) data[i] = (char)(i * 31 >> 3);
    assert_true(gn_file_write("large", data, size, &err));
    struct gn_bytes bytes;
    assert_true(gn_file_read("large", size, &bytes, &err));
    assert_int_equal(bytes.size, size);
    assert_memory_equal(bytes.data, data, size);
    gn_bytes_finish(&bytes);
    assert_false(gn_file_read("large", size - 1, &bytes, &err));
    assert_non_null(strstr(err.text, "limit"));
    free(data);
}

static void files_that_hide_their_size_are_read(void **state) {
    (void)state;
    struct gn_bytes bytes;
    struct gn_err err = {0};
    assert_true(gn_file_read("/proc/self/status", 0, &bytes, &err));
    assert_true(bytes.size > 100);
    gn_bytes_finish(&bytes);
    assert_false(gn_file_read("/proc/self/status", 100, &bytes, &err));
    assert_null(bytes.data);
}

static void the_start_of_a_small_file_is_a_text(void **state) {
    (void)state;
    char text[5] = "old";
    const char *path = in_folder("small");
    assert_true(gn_file_write(path, "abcdefg", 7, NULL));
    assert_true(gn_file_read_text(path, text, sizeof text));
    assert_string_equal(text, "abcd");
    assert_true(gn_file_write(path, "", 0, NULL));
    assert_false(gn_file_read_text(path, text, sizeof text));
    assert_string_equal(text, "");
    assert_int_equal(unlink(path), 0);
    const char *const others[] = {path, folder};
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text, "old");
        assert_false(gn_file_read_text(others[i], text, sizeof text));
        assert_string_equal(text, "");
    }
    assert_int_equal(mkfifo(path, 0600), 0); /* without a writer: it does not wait */
    assert_false(gn_file_read_text(path, text, sizeof text));
    assert_int_equal(unlink(path), 0);
}

static void what_is_no_file_is_refused_at_once(void **state) {
    (void)state;
    struct sockaddr_un address = {.sun_family = AF_UNIX, .sun_path = "socket"};
    mkfifo("fifo", 0600);
    int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_int_equal(bind(fd, (struct sockaddr *)&address, sizeof address), 0);
    close(fd);
    assert_refused("fifo", "FIFO");
    assert_refused("socket", "socket");
    assert_refused("/dev/zero", "device");
    assert_refused(folder, "folder");
    assert_refused("nowhere", "No such file");
    assert_refused("", "cannot open");
}

static void a_failed_write_leaves_nothing(void **state) {
    (void)state;
    struct gn_err err = {0};
    int before = files_here();
    assert_false(gn_file_write("no/such/folder", "x", 1, &err));
    assert_false(gn_file_write(folder, "x", 1, &err));
    assert_false(gn_file_write("", "x", 1, &err));
    assert_false(gn_file_write("/dev/full", "x", 1, &err));
    assert_non_null(strstr(err.text, "/dev/full"));
    assert_int_equal(files_here(), before);
}

static void a_write_leaves_no_other_file(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_true(gn_file_write("only", "x", 1, &err));
    int before = files_here();
    assert_true(gn_file_write("only", "y", 1, &err));
    assert_int_equal(files_here(), before);
}

static void an_older_file_behind_a_descriptor_keeps_no_tail(void **state) {
    (void)state;
    static const char *const names[] = {"/dev/fd/%d", "/proc/self/fd/%d"};
    struct gn_err err = {0};
    for (int i = 0; i < 2; i++) {
        char path[64];
        struct gn_bytes bytes;
        assert_true(gn_file_write("tail", "something long", 14, &err));
        int fd = open("tail", O_RDWR);
        snprintf(path, sizeof path, names[i], fd);
        assert_true(gn_file_write(path, "short", 5, &err));
        assert_true(gn_file_write(path, "er", 2, &err)); /* where the first ended */
        close(fd);
        assert_true(gn_file_read("tail", 0, &bytes, &err));
        assert_string_equal((char *)bytes.data, "shorter");
        gn_bytes_finish(&bytes);
    }
}

static void a_file_in_shared_memory_is_a_file(void **state) {
    (void)state;
    struct gn_err err = {0};
    char path[64];
    if (access("/dev/shm", W_OK) != 0) skip();
    snprintf(path, sizeof path, "/dev/shm/gnomon-test-%ld", (long)getpid());
    assert_true(gn_file_write(path, "long", 4, &err));
    assert_true(gn_file_write(path, "abc", 3, &err));
    assert_holds(path, "abc");
    unlink(path);
}

static void an_old_reader_keeps_the_old_file(void **state) {
    (void)state;
    struct gn_err err = {0};
    char text[4] = "";
    assert_true(gn_file_write("old", "old", 3, &err));
    int fd = open("old", O_RDONLY);
    assert_true(gn_file_write("old", "new", 3, &err));
    assert_int_equal(read(fd, text, 3), 3);
    close(fd);
    assert_string_equal(text, "old");
    assert_holds("old", "new");
}

static void the_mode_of_a_file_stays(void **state) {
    (void)state;
    struct gn_err err = {0};
    struct stat info;
    assert_true(gn_file_write("mode", "x", 1, &err));
    chmod("mode", 0640);
    assert_true(gn_file_write("mode", "y", 1, &err));
    stat("mode", &info);
    assert_int_equal(info.st_mode & 07777, 0640);
}

/* fs.protected_symlinks is of the same mind, but about folders that all may write to only. */
static void no_link_is_written_through(void **state) {
    (void)state;
    static const char *const links[][2] = {
        {"target", "link"}, {"later", "dangling"}, {"/dev/null", "device"}, {"fifo", "to-fifo"}};
    struct stat info;
    struct gn_err err = {0};
    assert_true(gn_file_write("target", "x", 1, &err));
    for (size_t i = 0; i < sizeof links / sizeof links[0]; i++) {
        err = (struct gn_err){0};
        assert_int_equal(symlink(links[i][0], links[i][1]), 0);
        assert_false(gn_file_write(links[i][1], "y", 1, &err));
        assert_non_null(strstr(err.text, "refusing to overwrite a symbolic link"));
        lstat(links[i][1], &info);
        assert_true(S_ISLNK(info.st_mode));
    }
    assert_holds("target", "x");
    assert_int_equal(access("later", F_OK), -1);
}

static void a_link_to_a_folder_may_be_in_the_path(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_int_equal(mkdir("away", 0700), 0);
    assert_int_equal(symlink("away", "folder-link"), 0);
    assert_true(gn_file_write("folder-link/file", "z", 1, &err));
    assert_holds("away/file", "z");
}

/* In place of libc's: the mode that the new file had until now. */
static mode_t mode_before;
int fchmod(int fd, mode_t mode) {
    struct stat info;
    fstat(fd, &info);
    mode_before = info.st_mode & 07777;
    return (int)syscall(SYS_fchmod, fd, mode);
}

static void a_private_file_is_private_at_all_times(void **state) {
    (void)state;
    struct gn_err err = {0};
    struct stat info;
    const mode_t mask = umask(0);
    assert_true(gn_file_write("private", "x", 1, &err));
    stat("private", &info);
    assert_int_equal(info.st_mode & 07777, 0666);
    chmod("private", 04600);
    assert_true(gn_file_write("private", "y", 1, &err));
    stat("private", &info);
    assert_int_equal(mode_before, 0600);
    assert_int_equal(info.st_mode & 07777, 0600); /* no set-user-ID bit for new content */
    umask(mask);
}

static void a_pipe_is_written_to_directly(void **state) {
    (void)state;
    struct gn_err err = {0};
    char text[4] = "", path[32];
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    snprintf(path, sizeof path, "/dev/fd/%d", ends[1]);
    assert_true(gn_file_write(path, "sun", 3, &err));
    assert_int_equal(read(ends[0], text, 3), 3);
    assert_string_equal(text, "sun");
    close(ends[0]);
    close(ends[1]);
    assert_true(gn_file_write("/dev/null", "x", 1, &err));
}

/* ---- what a killed process left ---- */

static int make_old(const char *name, int64_t age_s) {
    const struct timespec times[2] = {{.tv_sec = time(NULL) - age_s},
                                      {.tv_sec = time(NULL) - age_s}};
    const int fd = open(in_folder(name), O_RDWR | O_CREAT, 0600);
    assert_true(fd >= 0 && futimens(fd, times) == 0);
    return fd;
}

static void temporary_files_of_the_dead_are_removed(void **state) {
    (void)state;
    static const char *const kept[] = {".gnomon-2-0", ".gnomon-3-0", ".gnomon-x-0", ".gnomon-4-",
                                       ".gnomon-5-0"};
    struct gn_err err = {0};
    assert_int_equal(mkdir("sweep", 0700), 0);
    assert_int_equal(chdir("sweep"), 0);
    close(make_old("sweep/.gnomon-1-0", 100));
    close(make_old("sweep/.gnomon-2-0", 10));
    const int held = make_old("sweep/.gnomon-3-0", 100);
    assert_int_equal(flock(held, LOCK_EX), 0);
    close(make_old("sweep/.gnomon-x-0", 100));
    close(make_old("sweep/.gnomon-4-", 100));
    assert_int_equal(symlink(".gnomon-2-0", ".gnomon-5-0"), 0);
    assert_true(gn_file_write("a", "b", 1, &err));
    assert_int_not_equal(access(".gnomon-1-0", F_OK), 0);
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++)
        if (faccessat(AT_FDCWD, kept[i], F_OK, AT_SYMLINK_NOFOLLOW) != 0) fail_msg("%s", kept[i]);
    close(held);
    assert_int_equal(chdir(".."), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_written_is_read),
        cmocka_unit_test(a_file_of_many_megabytes_is_whole),
        cmocka_unit_test(files_that_hide_their_size_are_read),
        cmocka_unit_test(the_start_of_a_small_file_is_a_text),
        cmocka_unit_test(what_is_no_file_is_refused_at_once),
        cmocka_unit_test(a_failed_write_leaves_nothing),
        cmocka_unit_test(a_write_leaves_no_other_file),
        cmocka_unit_test(an_older_file_behind_a_descriptor_keeps_no_tail),
        cmocka_unit_test(a_file_in_shared_memory_is_a_file),
        cmocka_unit_test(an_old_reader_keeps_the_old_file),
        cmocka_unit_test(the_mode_of_a_file_stays),
        cmocka_unit_test(no_link_is_written_through),
        cmocka_unit_test(a_link_to_a_folder_may_be_in_the_path),
        cmocka_unit_test(a_private_file_is_private_at_all_times),
        cmocka_unit_test(a_pipe_is_written_to_directly),
        cmocka_unit_test(temporary_files_of_the_dead_are_removed),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
