/* Clocks. All times are integer nanoseconds. */
#ifndef GN_CORE_CLOCK_H
#define GN_CORE_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#define GN_NS_PER_S INT64_C(1000000000)

int64_t gn_clock_monotonic_ns(void);
int64_t gn_clock_process_cpu_ns(void); /* CPU time of this process, all threads */
int64_t gn_clock_thread_cpu_ns(void);

/* The time of day: since 1970, UTC without leap seconds. Sensible once GN_CLOCK_PAST_S is over. */
int64_t gn_clock_day_ns(void);
/* For tests: gn_clock_day_ns() is *monotonic_ns + *ahead_ns from now on; NULL, NULL: the system's.
 */
void gn_clock_fake_day(const int64_t *monotonic_ns, const int64_t *ahead_ns);
/* Seconds of 1970: what is before (the end of 2023) is a clock that was never set; it shows 1970,
 * or when it was built. */
#define GN_CLOCK_PAST_S INT64_C(1704067200)
/* Whether the time of day comes from a clock that runs on a battery, or from the network's. */
bool gn_clock_was_set(void);

#endif
