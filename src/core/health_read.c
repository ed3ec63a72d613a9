/* Where the kernel reports it:
 * /sys/class/hwmon: rpi_volt (drivers/hwmon/raspberrypi-hwmon.c) asks the firmware every 2 s and
 * keeps its answer, so reading it does not wait.
 * soc:firmware/get_throttled: Raspberry Pi's kernels only (drivers/firmware/raspberrypi.c there);
 * the answer that rpi_volt's driver got; the first read leaves a warning in the kernel's log.
 * /sys/class/thermal: cooling devices of other boards that lower a clock; fans are none.
 * /proc/meminfo and, since Linux 5.13, cma_alloc_fail of /proc/vmstat. */
#include <glob.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "core/file.h"
#include "core/health.h"

enum { FILE_MAX = 65536, FOUND_MAX = 64 };

/* As text, "" if it cannot be read; to be finished. */
static const char *read_file(const char *path, struct gn_bytes *bytes) {
    *bytes = (struct gn_bytes){0};
    return gn_file_read(path, FILE_MAX, bytes, NULL) ? (const char *)bytes->data : "";
}

static int64_t read_number(const char *path, int base) {
    char text[64];
    gn_file_read_text(path, text, sizeof text);
    return gn_health_parse_number(text, base);
}

static void read_word(const char *path, char *out, size_t size) {
    gn_file_read_text(path, out, size);
    out[strcspn(out, " \t\n")] = 0;
}

/* Calls `take` with each folder that the pattern has, and a path in it has room for a name. */
static void each_folder(const char *root, const char *pattern, struct gn_health *h,
                        void (*take)(struct gn_health *h, const char *folder)) {
    char path[PATH_MAX];
    glob_t found;
    snprintf(path, sizeof path, "%s%s", root, pattern);
    if (glob(path, GLOB_NOSORT, NULL, &found) != 0) return;
    for (size_t i = 0; i < found.gl_pathc && i < FOUND_MAX; i++)
        if (strlen(found.gl_pathv[i]) < PATH_MAX - 64) take(h, found.gl_pathv[i]);
    globfree(&found);
}

static const char *path_in(const char *folder, const char *name, char out[PATH_MAX]) {
    snprintf(out, PATH_MAX, "%.*s/%s", PATH_MAX - 64, folder, name);
    return out;
}

static void take_hwmon(struct gn_health *h, const char *folder) {
    char path[PATH_MAX], name[32];
    read_word(path_in(folder, "name", path), name, sizeof name);
    if (strcmp(name, "rpi_volt") != 0) return;
    const int64_t alarm = read_number(path_in(folder, "in0_lcrit_alarm", path), 10);
    h->undervoltage = alarm == 0 || alarm == 1 ? (int)alarm : -1;
}

static void take_firmware(struct gn_health *h, const char *folder) {
    char path[PATH_MAX];
    h->firmware = read_number(path_in(folder, "get_throttled", path), 16);
}

static void take_zone(struct gn_health *h, const char *folder) {
    char path[PATH_MAX];
    const int64_t mc = read_number(path_in(folder, "temp", path), 10);
    if (mc > h->hottest_mc && mc < 1000000) h->hottest_mc = (int)mc;
}

static void take_cooling(struct gn_health *h, const char *folder) {
    char path[PATH_MAX], type[sizeof h->cooling];
    read_word(path_in(folder, "type", path), type, sizeof type);
    if (!strstr(type, "cpufreq") && !strstr(type, "devfreq")) return;
    const int64_t state = read_number(path_in(folder, "cur_state", path), 10);
    if (state < 0) return;
    if (h->cooled < 0) h->cooled = 0;
    if (state == 0) return;
    h->cooled++;
    memcpy(h->cooling, type, sizeof h->cooling);
}

int gn_health_read_hottest_mc(const char *root) {
    struct gn_health health = {0};
    each_folder(root, "/sys/class/thermal/thermal_zone*", &health, take_zone);
    return health.hottest_mc;
}

void gn_health_read(struct gn_health *h, const char *root) {
    struct gn_bytes bytes;
    char path[PATH_MAX];
    *h = (struct gn_health){.undervoltage = -1, .firmware = -1, .cooled = -1};
    each_folder(root, "/sys/class/hwmon/hwmon*", h, take_hwmon);
    each_folder(root, "/sys/devices/platform/soc*/soc*:firmware", h, take_firmware);
    h->hottest_mc = gn_health_read_hottest_mc(root);
    each_folder(root, "/sys/class/thermal/cooling_device*", h, take_cooling);

    const char *text = read_file(path_in(root, "proc/meminfo", path), &bytes);
    h->cma_kb = gn_health_parse_line(text, "CmaTotal:");
    h->cma_free_kb = gn_health_parse_line(text, "CmaFree:");
    h->memory_kb = gn_health_parse_line(text, "MemTotal:");
    h->available_kb = gn_health_parse_line(text, "MemAvailable:");
    gn_bytes_finish(&bytes);
    text = read_file(path_in(root, "proc/vmstat", path), &bytes);
    h->cma_failed = gn_health_parse_line(text, "cma_alloc_fail");
    gn_bytes_finish(&bytes);
}
