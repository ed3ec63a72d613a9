#include "unit/health_help.h"

#include <stdio.h>
#include <stdlib.h>

#include "unit/check.h"

static void run(const char *command) { assert_int_equal(system(command), 0); }

void health_write(const char *root, const char *path, const char *text) {
    char full[400], part[420], command[500];
    snprintf(full, sizeof full, "%s/%s", root, path);
    snprintf(command, sizeof command, "mkdir -p \"$(dirname '%s')\"", full);
    run(command);
    snprintf(part, sizeof part, "%s.part", full); /* a thread may read meanwhile */
    FILE *file = fopen(part, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(rename(part, full), 0);
}

void health_remove(const char *root, const char *path) {
    char command[500];
    snprintf(command, sizeof command, "rm -r '%s/%s'", root, path);
    run(command);
}

void health_pi4(const char *root) {
    health_write(root, "sys/class/hwmon/hwmon0/name", "cpu_thermal\n");
    health_write(root, "sys/class/hwmon/hwmon1/name", "rpi_volt\n");
    health_write(root, "sys/class/hwmon/hwmon1/in0_lcrit_alarm", "0\n");
    health_write(root, "sys/class/hwmon/hwmon2/name", "ina226\n"); /* another one's alarm */
    health_write(root, "sys/class/hwmon/hwmon2/in0_lcrit_alarm", "1\n");
    health_write(root, "sys/devices/platform/soc/soc:firmware/get_throttled", "0\n");
    health_write(root, "sys/class/thermal/thermal_zone0/temp", "48312\n");
    health_write(root, "proc/meminfo",
                 "MemTotal:        3884000 kB\nMemFree:         2400000 kB\n"
                 "MemAvailable:    3100000 kB\nCmaTotal:         524288 kB\n"
                 "CmaFree:          401408 kB\n");
    health_write(root, "proc/vmstat",
                 "nr_free_cma 100352\ncma_alloc_success 912\n"
                 "cma_alloc_fail 3\n");
}
