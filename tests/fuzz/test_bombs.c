/* Small files whose numbers are large (bombs.h), each read in a process of its own as a kiosk
 * would: loaded, posed, and its frame planned. Required: a scene or one line, within 10 s of
 * processor time, 1.2 times memory_mb of resident memory and 2 GB of address space; maps of the
 * plan within maps_mb; each pixel drawn no more often than 1.2 times overdraw.
 *
 *   test_bombs [FIRST [COUNT]]    GN_FULL=1: 4,000; a case that fails is left in bomb-N.glb */
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/child.h"
#include "core/file.h"
#include "core/memory.h"
#include "frame/frame.h"
#include "fuzz/bomb_pixels.h"
#include "fuzz/bombs.h"
#include "scene/pose.h"

enum { ADDRESSES_MB = 2048, SMALL_MB = 128, MAPS_MB = 64, OVERDRAW = 20 };
enum { SHOWN, REFUSED };

/* Sanitizers are slower, and keep what is freed for a while. */
enum { SECONDS = GN_LIMITS_MEMORY ? 10 : 60 };

static struct report { /* shared with the child */
    struct gn_err err;
    uint64_t map_bytes;
    double overdraw;
} * report;

static int64_t resident_kb(void) {
    long total = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file && fscanf(file, "%ld %ld", &total, &resident) != 2) resident = 0;
    if (file) fclose(file);
    return (int64_t)resident * sysconf(_SC_PAGESIZE) / 1024;
}

static int show_scene(const struct gn_scene *scene, const struct gn_scene_limits *limits) {
    const struct gn_caps caps = {
        .has = (1u << GN_CAP_COUNT) - 1, .max_texture_px = 16384, .max_texture_units = 16};
    const struct gn_frame_opts opts = {.shadow.maps_bytes = (uint64_t)MAPS_MB << 20,
                                       .shadow.triangles = limits->triangles_per_frame,
                                       .overdraw = limits->overdraw};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    struct gn_frame *frame = gn_frame_create(scene, &caps);
    for (int64_t i = 0; i < 3; i++) {
        gn_pose_step(&pose, i * 123456789);
        const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
        report->map_bytes = gn_plan_map_bytes(plan);
        report->overdraw = fmax(report->overdraw, gn_bomb_overdraw(plan));
    }
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    return SHOWN;
}

static int try_bomb(const struct gn_made *bomb, const struct gn_scene_limits *limits) {
    const struct rlimit seconds = {SECONDS, SECONDS + 1},
                        addresses = {(rlim_t)ADDRESSES_MB << 20, (rlim_t)ADDRESSES_MB << 20};
    setrlimit(RLIMIT_CPU, &seconds);
    if (GN_LIMITS_MEMORY) setrlimit(RLIMIT_AS, &addresses);
    struct gn_warnings warnings = {0};
    struct gn_scene *scene =
        gn_scene_load_bytes("b", bomb->data, bomb->size, limits, &warnings, &report->err);
    const struct gn_scene_limits all = gn_scene_limits_or_default(limits);
    return scene ? show_scene(scene, &all) : REFUSED;
}

/* ---- all of them ---- */

static int shown, refused, failures;
static double slowest_s, most_overdraw;
static int64_t largest_kb;

static void complain(uint64_t number, const char *kinds, const struct gn_made *bomb,
                     const char *what) {
    char path[40];
    snprintf(path, sizeof path, "bomb-%" PRIu64 ".glb", number);
    gn_file_write(path, bomb->data, bomb->size, NULL);
    printf("FAIL %" PRIu64 " (%s; %zu bytes, left in %s): %s\n", number, kinds, bomb->size, path,
           what);
    failures++;
}

static double seconds_of(const struct rusage *usage) {
    return (double)(usage->ru_utime.tv_sec + usage->ru_stime.tv_sec) +
           1e-6 * (double)(usage->ru_utime.tv_usec + usage->ru_stime.tv_usec);
}

static void run_bomb(uint64_t number) {
    char kinds[200], what[700];
    struct gn_made bomb = gn_bomb_make(number, kinds, sizeof kinds);
    const struct gn_scene_limits limits = {
        .memory_mb = number % 4 ? SMALL_MB : 0, .maps_mb = MAPS_MB, .overdraw = OVERDRAW};
    const int64_t most_kb =
        (int64_t)gn_scene_limits_or_default(&limits).memory_mb * 1024 * 12 / 10 + resident_kb();
    *report = (struct report){0};
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) _exit(try_bomb(&bomb, &limits));
    struct rusage usage = {0};
    int status = -1;
    wait4(child, &status, 0, &usage);
    const double took_s = seconds_of(&usage);
    if (took_s > slowest_s) slowest_s = took_s;
    if (usage.ru_maxrss > largest_kb) largest_kb = usage.ru_maxrss;
    if (report->overdraw > most_overdraw) most_overdraw = report->overdraw;
    const char *text = report->err.text;
    const bool done = WIFEXITED(status) && WEXITSTATUS(status) <= REFUSED;
    const bool is_shown = done && WEXITSTATUS(status) == SHOWN;
    *(is_shown ? &shown : &refused) += 1;
    if (getenv("GN_VERBOSE"))
        printf("%" PRIu64 " %.2f s %ld MB, overdraw %.1f, %zu bytes, %s: %s\n", number, took_s,
               usage.ru_maxrss / 1024, report->overdraw, bomb.size, kinds,
               is_shown ? "shown" : text);
    if (took_s > SECONDS || (!done && WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        snprintf(what, sizeof what, "takes %.1f s", took_s);
    else if (!done)
        snprintf(what, sizeof what, "ends with status %#x", (unsigned)status);
    else if (GN_LIMITS_MEMORY && usage.ru_maxrss > most_kb)
        snprintf(what, sizeof what, "takes %ld MB", usage.ru_maxrss / 1024);
    else if (is_shown && report->map_bytes > (uint64_t)MAPS_MB << 20)
        snprintf(what, sizeof what, "has maps of %" PRIu64 " MB", report->map_bytes >> 20);
    else if (is_shown && report->overdraw > 1.2 * OVERDRAW)
        snprintf(what, sizeof what, "draws each pixel %.0f times", report->overdraw);
    else if (!is_shown && (strncmp(text, "b: ", 3) != 0 || !text[3] || strchr(text, '\n')))
        snprintf(what, sizeof what, "is refused with \"%s\"", text);
    else
        what[0] = 0;
    if (what[0]) complain(number, kinds, &bomb, what);
    free(bomb.data);
}

int main(int argc, char **argv) {
    const uint64_t first = argc > 1 ? strtoull(argv[1], NULL, 10) : 0;
    const uint64_t count = argc > 2 ? strtoull(argv[2], NULL, 10) : getenv("GN_FULL") ? 4000 : 80;
    struct gn_err err = {0};
    report = gn_child_share(sizeof *report, &err);
    if (!report) {
        printf("%s\n", err.text);
        return 1;
    }
    for (uint64_t i = first; i < first + count; i++) run_bomb(i);
    printf("%" PRIu64 " bombs: %d shown, %d refused, %d wrong; slowest %.1f s, largest %" PRId64
           " MB, overdraw %.1f of %d\n",
           count, shown, refused, failures, slowest_s, largest_kb / 1024, most_overdraw, OVERDRAW);
    return failures > 0;
}
