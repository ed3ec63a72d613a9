/* Private dirty pages, and the driver's cache as a folder. */

#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/memory.h"
#include "stage/driver_cache.h"
#include "unit/check.h"

static void test_what_is_written_to_is_counted(void **state) {
    (void)state;
    size_t size = (size_t)16 << 20;
    double before = gn_memory_private_dirty_mb();
    void *pages = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_ptr_not_equal(pages, MAP_FAILED);
    double reserved = gn_memory_private_dirty_mb();
    memset(pages, 1, size);
    double written = gn_memory_private_dirty_mb();
    munmap(pages, size);
    if (isnan(before)) skip();
    assert_true(reserved - before < 1);
    assert_true(fabs(written - reserved - 16) < 1);
}

static void test_a_probe_that_is_never_asked_ends(void **state) {
    (void)state;
    struct gn_memory_probe probe;
    gn_memory_probe_open(&probe, "egl");
    gn_memory_probe_close(&probe);
    assert_int_equal(probe.pid, 0);
    gn_memory_probe_close(&probe);
    assert_true(isnan(gn_memory_probe_read(&probe)));
}

static void test_a_probe_without_a_display_has_no_answer(void **state) {
    (void)state;
    struct gn_memory_probe probe;
    gn_memory_probe_open(&probe, "no such display");
    assert_true(isnan(gn_memory_probe_read(&probe)));
    assert_int_equal(probe.pid, 0);
}

static void test_a_zeroed_probe_may_be_closed(void **state) {
    (void)state;
    struct gn_memory_probe probe = {0};
    gn_memory_probe_close(&probe);
}

/* ---- the cache ---- */

static char cache_dir[] = "/tmp/gn-cache-XXXXXX";
static char cache_path[3][64];

static int make_cache(void **state) {
    (void)state;
    if (!mkdtemp(cache_dir)) return -1;
    snprintf(cache_path[0], sizeof cache_path[0], "%s/mesa_shader_cache", cache_dir);
    snprintf(cache_path[1], sizeof cache_path[1], "%s/a1", cache_path[0]);
    snprintf(cache_path[2], sizeof cache_path[2], "%s/f", cache_path[1]);
    unsetenv("MESA_SHADER_CACHE_DISABLE");
    return setenv("MESA_SHADER_CACHE_DIR", cache_dir, 1) || mkdir(cache_path[0], 0700) ||
           mkdir(cache_path[1], 0700);
}

static int remove_cache(void **state) {
    (void)state;
    unlink(cache_path[2]);
    rmdir(cache_path[1]);
    rmdir(cache_path[0]);
    return rmdir(cache_dir);
}

static void append(const char *path) {
    FILE *file = fopen(path, "a");
    assert_non_null(file);
    fputs("bytes", file);
    fclose(file);
}

static void test_a_cache_that_gains_is_cold_and_then_warm(void **state) {
    (void)state;
    struct gn_driver_cache empty = gn_driver_cache_read();
    assert_int_equal(empty.files, 0);
    append(cache_path[2]);
    struct gn_driver_cache one = gn_driver_cache_read();
    assert_int_equal(one.files, 1);
    assert_int_equal(one.bytes, 5);
    append(cache_path[2]);
    struct gn_driver_cache longer = gn_driver_cache_read();
    assert_false(gn_driver_cache_warm(&empty, &empty));
    assert_false(gn_driver_cache_warm(&empty, &one));
    assert_false(gn_driver_cache_warm(&one, &longer));
    assert_true(gn_driver_cache_warm(&longer, &longer));
}

static void test_a_cache_switched_off_holds_nothing(void **state) {
    (void)state;
    append(cache_path[2]);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    assert_int_equal(gn_driver_cache_read().files, 0);
    setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
    assert_int_equal(gn_driver_cache_read().files, 1);
    unsetenv("MESA_SHADER_CACHE_DISABLE");
}

/* In a child with a disk of its own of so many bytes: 0 reserved, 1 refused and switched off, 77 it
 * cannot have one. */
static int reserve_on_disk_of(const char *bytes) {
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        char opts[40];
        struct gn_err err = {0};
        struct stat info;
        snprintf(opts, sizeof opts, "size=%s", bytes);
        if (unshare(CLONE_NEWNS | (geteuid() ? CLONE_NEWUSER : 0)) != 0 ||
            mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0 ||
            mount("tmpfs", cache_dir, "tmpfs", 0, opts) != 0)
            _exit(77);
        const bool ok = gn_driver_cache_reserve(&err);
        const char *off = getenv("MESA_SHADER_CACHE_DISABLE");
        char path[80];
        snprintf(path, sizeof path, "%s/index", cache_path[0]);
        const bool has_index = stat(path, &info) == 0 && info.st_size == 1310728 &&
                               info.st_blocks * 512 >= info.st_size;
        _exit(ok && !off && has_index                                                       ? 0
              : !ok && off && strcmp(off, "true") == 0 && strstr(err.text, "no space left") ? 1
                                                                                            : 2);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* Mesa maps its index: a page of it for which the disk has no room would end the process. */
static void test_the_index_has_its_place_on_the_disk_or_there_is_no_cache(void **state) {
    (void)state;
    const int roomy = reserve_on_disk_of("16m");
    if (roomy == 77) skip();
    assert_int_equal(roomy, 0);
    assert_int_equal(reserve_on_disk_of("64k"), 1);
    assert_int_equal(reserve_on_disk_of("4m"), 1); /* for the index alone */
}

int main(void) {
    const struct CMUnitTest memory[] = {
        cmocka_unit_test(test_what_is_written_to_is_counted),
        cmocka_unit_test(test_a_probe_that_is_never_asked_ends),
        cmocka_unit_test(test_a_probe_without_a_display_has_no_answer),
        cmocka_unit_test(test_a_zeroed_probe_may_be_closed),
    };
    const struct CMUnitTest cache[] = {
        cmocka_unit_test(test_a_cache_that_gains_is_cold_and_then_warm),
        cmocka_unit_test(test_a_cache_switched_off_holds_nothing),
        cmocka_unit_test(test_the_index_has_its_place_on_the_disk_or_there_is_no_cache),
    };
    return cmocka_run_group_tests(memory, NULL, NULL) +
           cmocka_run_group_tests(cache, make_cache, remove_cache);
}
