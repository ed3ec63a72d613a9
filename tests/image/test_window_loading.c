/* A window while a large file loads: a bar says how far it is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after what it needs */
#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/clock.h"
#include "image/in_window.h"
#include "image/shot.h"

/* A binary file of that many meshes of a million vertices each, 12 zero bytes a vertex, which take
 * no space on the disk. */
static void write_large(const char *path, uint32_t meshes) {
    enum { VERTICES = 999999 };
    static char json[20000];
    const uint32_t bytes = meshes * VERTICES * 12;
    size_t used = (size_t)snprintf(
        json, sizeof json,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"buffers\":[{\"byteLength\":%u}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%u}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[",
        bytes, bytes);
    for (uint32_t i = 0; i < meshes; i++)
        used += (size_t)snprintf(json + used, sizeof json - used,
                                 "%s{\"attributes\":{\"POSITION\":%u}}", i ? "," : "", i);
    used += (size_t)snprintf(json + used, sizeof json - used, "]}],\"accessors\":[");
    for (uint32_t i = 0; i < meshes; i++)
        used += (size_t)snprintf(
            json + used, sizeof json - used,
            "%s{\"bufferView\":0,\"byteOffset\":%u,\"componentType\":5126,\"count\":%d,"
            "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[0,0,0]}",
            i ? "," : "", i * VERTICES * 12, VERTICES);
    used += (size_t)snprintf(json + used, sizeof json - used, "]}");
    while (used % 4) json[used++] = ' ';
    const uint32_t head[5] = {0x46546c67, 2, (uint32_t)(28 + used) + bytes, (uint32_t)used,
                              0x4e4f534a};
    const uint32_t next[2] = {bytes, 0x004e4942};
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(head, sizeof head, 1, file);
    fwrite(json, used, 1, file);
    fwrite(next, sizeof next, 1, file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(truncate(path, (off_t)head[2]), 0);
}

/* How much of the bar in the lower half is filled: its upper rows are white, to some column. 0: no
 * bar. */
static double bar_of(const struct gn_picture *p) {
    for (int y = p->height_px / 2; y < p->height_px; y++) {
        int first = p->width_px, last = -1;
        for (int x = 0; x < p->width_px; x++) {
            const bool white = gn_picture_at(p, x, y)[1] == 1.0f;
            if (white && x < first) first = x;
            if (white && x == (last < 0 ? first : last + 1)) last = x;
        }
        if (last - first > 10) return (double)(last + 1) / p->width_px;
    }
    return 0;
}

static int64_t cpu_ms_of_first_thread(pid_t pid) {
    char path[64];
    unsigned long user = 0, system = 0;
    snprintf(path, sizeof path, "/proc/%d/task/%d/stat", (int)pid, (int)pid);
    FILE *file = fopen(path, "r");
    if (!file) return 0;
    const int got = fscanf(file, "%*d (%*[^)]) %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu",
                           &user, &system);
    fclose(file);
    return got == 2 ? (int64_t)(user + system) * 1000 / sysconf(_SC_CLK_TCK) : 0;
}

/* In the window of the first load, then under a scene that stays until the dropped one is there. */
static void test_a_large_file_shows_a_bar_that_fills(void **state) {
    (void)state;
    struct window_shown s;
    char path[400];
    snprintf(path, sizeof path, "%s/viewer-large.glb", gn_shot_build());
    write_large(path, 20);
    char *large = realpath(path, NULL);
    for (int drops = 0; drops < 2; drops++) {
        double least = 2, most = 0;
        const int64_t begun_ns = gn_clock_monotonic_ns();
        int64_t seen_ns = 0, drawing_ms = 0;
        const char *args[] = {"show",           drops ? window_scene : large,
                              "--backend",      "window",
                              "--size",         "320x240",
                              "--limit",        "seconds=600",
                              "--no-animation", NULL};
        window_start(&s, args);
        window_find(&s);
        if (drops) window_assert_becomes_render(&s, "320x240", "window-before-large");
        if (drops) assert_true(gn_xserver_drop(window_server, s.window, large));
        for (int i = 0; i < 1000 && most - least < .1; i++) {
            struct gn_picture now = {0};
            if (gn_xserver_grab(window_server, s.window, &now)) {
                const double bar = bar_of(&now);
                if (bar > 0 && !seen_ns) {
                    seen_ns = gn_clock_monotonic_ns() - begun_ns;
                    drawing_ms = cpu_ms_of_first_thread(s.pid);
                }
                if (bar > 0 && bar < least) least = bar;
                if (bar > most) most = bar;
                gn_picture_finish(&now);
            }
            usleep(10000);
        }
        printf("a bar after %.0f ms, %d of the processor, %.2f to %.2f of the width\n",
               (double)seen_ns * 1e-6, (int)drawing_ms, least, most);
        assert_true(most - least >= .1);
        kill(s.pid, SIGTERM);
        assert_int_equal(window_end_of(&s), 0);
        unlink(s.said);
    }
    unlink(path);
    free(large);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_a_large_file_shows_a_bar_that_fills, window_clear_up),
    };
    setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
    window_server = gn_xserver_start();
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    gn_xserver_stop(window_server);
    return failures;
}
