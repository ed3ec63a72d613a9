/* What inspect says a load takes at most, against what the system counted for a process that loads
 * it. */
#include "unit/check.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/memory.h"
#include "image/large.h"
#include "scene/scene.h"
#include "unit/gl_help.h"

#define MB      (1024.0 * 1024.0)
#define REST_MB 6.0 /* pages of the program and of libraries, the allocator's own */
#define OVER    1.5 /* JSON is counted by its text, at the most that it can take */
#define UNDER   1.1 /* pieces that the allocator keeps between pictures */

struct peak {
    double said_mb, gpu_mb, measured_mb; /* gpu_mb, of what is said: not taken by a load alone */
};

static double status_mb(const char *key) {
    char text[4096] = "";
    FILE *file = fopen("/proc/self/status", "r");
    if (!file) return 0;
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    const char *line = strstr(text, key);
    return line ? strtod(line + strlen(key), NULL) / 1024.0 : 0;
}

/* In a process of its own: the most that this process took before is no longer counted. */
static struct peak load(const char *path) {
    struct peak peak = {0};
    malloc_trim(0);
    FILE *file = fopen("/proc/self/clear_refs", "w");
    if (file) fputs("5", file), fclose(file);
    const double before_mb = status_mb("VmRSS:");
    struct gn_err err = {0};
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene) return peak;
    peak.measured_mb = status_mb("VmHWM:") - before_mb;
    peak.said_mb = (double)scene->memory.loading_bytes / MB;
    for (uint32_t i = 0; i < scene->pictures.image_count; i++)
        peak.gpu_mb += (double)gn_scene_image_bytes(&scene->pictures.images[i]) / MB;
    gn_scene_destroy(scene);
    return peak;
}

static struct peak peak_of(const char *path) {
    int ends[2];
    struct peak peak = {0};
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        peak = load(path);
        _exit(write(ends[1], &peak, sizeof peak) == sizeof peak ? 0 : 1);
    }
    assert_int_equal(read(ends[0], &peak, sizeof peak), sizeof peak);
    close(ends[0]);
    close(ends[1]);
    waitpid(child, NULL, 0);
    return peak;
}

static void a_load_takes_what_inspect_says(void **state) {
    (void)state;
    static const struct gn_large rows[] = {
        {.triangles = 400000, .nodes = 1},
        {.triangles = 200000, .nodes = 1024},
        {.triangles = 20000, .nodes = 100, .textures = 100, .texture_px = 256},
    };
    const char *folder = help_folder();
    char path[200];
    snprintf(path, sizeof path, "%s/large.glb", folder);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct gn_err err = {0};
        if (!gn_large_write(&rows[i], path, &err)) fail_msg("%s", err.text);
        const struct peak p = peak_of(path);
        const double load_mb = p.said_mb - p.gpu_mb;
        printf("%u triangles, %u nodes, %u textures: said %.1f MB with %.1f of the GPU's, "
               "measured %.1f MB\n",
               rows[i].triangles, rows[i].nodes, rows[i].textures, p.said_mb, p.gpu_mb,
               p.measured_mb);
        assert_true(load_mb > 1 && p.gpu_mb >= 0);
        if (!GN_LIMITS_MEMORY) continue; /* a sanitizer's own memory is counted, too */
        assert_true(p.measured_mb > 0 && p.measured_mb < load_mb * UNDER + REST_MB);
        assert_true(load_mb < p.measured_mb * OVER + REST_MB);
    }
    help_remove(folder);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_load_takes_what_inspect_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
