#include "core/clock.h"

#include <glob.h>
#include <stdio.h>
#include <sys/timex.h>
#include <time.h>
#include <unistd.h>

static int64_t read_ns(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec * GN_NS_PER_S + t.tv_nsec;
}

int64_t gn_clock_monotonic_ns(void) { return read_ns(CLOCK_MONOTONIC); }

int64_t gn_clock_process_cpu_ns(void) { return read_ns(CLOCK_PROCESS_CPUTIME_ID); }

int64_t gn_clock_thread_cpu_ns(void) { return read_ns(CLOCK_THREAD_CPUTIME_ID); }

static const int64_t *fake_monotonic_ns, *fake_ahead_ns;

int64_t gn_clock_day_ns(void) {
    return fake_ahead_ns ? *fake_monotonic_ns + *fake_ahead_ns : read_ns(CLOCK_REALTIME);
}

void gn_clock_fake_day(const int64_t *monotonic_ns, const int64_t *ahead_ns) {
    fake_monotonic_ns = monotonic_ns;
    fake_ahead_ns = ahead_ns;
}

/* The kernel set the clock from one that runs on a battery. */
static bool has_battery_clock(void) {
    glob_t found;
    bool sets = false;
    if (glob("/sys/class/rtc/*/hctosys", 0, NULL, &found) != 0) return false;
    for (size_t i = 0; i < found.gl_pathc && !sets; i++) {
        FILE *file = fopen(found.gl_pathv[i], "re");
        sets = file && fgetc(file) == '1';
        if (file) fclose(file);
    }
    globfree(&found);
    return sets;
}

/* A service may not ask the kernel (ProtectClock), but see what systemd-timesyncd leaves. */
static bool is_synchronised(void) {
    struct timex now = {0};
    return (adjtimex(&now) >= 0 && !(now.status & STA_UNSYNC)) ||
           access("/run/systemd/timesync/synchronized", F_OK) == 0;
}

bool gn_clock_was_set(void) { return has_battery_clock() || is_synchronised(); }
