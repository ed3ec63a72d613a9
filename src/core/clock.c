#include "core/clock.h"

#include <time.h>

static int64_t read_ns(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec * GN_NS_PER_S + t.tv_nsec;
}

int64_t gn_clock_monotonic_ns(void) { return read_ns(CLOCK_MONOTONIC); }

int64_t gn_clock_process_cpu_ns(void) { return read_ns(CLOCK_PROCESS_CPUTIME_ID); }

int64_t gn_clock_thread_cpu_ns(void) { return read_ns(CLOCK_THREAD_CPUTIME_ID); }
