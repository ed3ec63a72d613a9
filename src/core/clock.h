/* Clocks. All times are integer nanoseconds. */
#ifndef GN_CORE_CLOCK_H
#define GN_CORE_CLOCK_H

#include <stdint.h>

#define GN_NS_PER_S INT64_C(1000000000)

int64_t gn_clock_monotonic_ns(void);
int64_t gn_clock_process_cpu_ns(void); /* CPU time of this process, all threads */
int64_t gn_clock_thread_cpu_ns(void);

#endif
