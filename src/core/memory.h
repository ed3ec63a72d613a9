/* The memory of this machine, from which limits get their defaults. */
#ifndef GN_CORE_MEMORY_H
#define GN_CORE_MEMORY_H

#include <stdint.h>

/* GN_LIMITS_MEMORY: RLIMIT_AS can bound this build. A sanitizer reserves more than any limit. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define GN_ADDRESS_SANITIZER
#endif
#endif
#if defined(GN_ADDRESS_SANITIZER) || defined(__SANITIZE_ADDRESS__)
enum { GN_LIMITS_MEMORY = 0 };
#else
enum { GN_LIMITS_MEMORY = 1 };
#endif

/* MemTotal of /proc/meminfo in 2^20 bytes, read once; 0: unknown. */
uint64_t gn_memory_total_mb(void);
/* Bytes that are allocated in this process now, by all threads, libraries and the driver. */
uint64_t gn_memory_allocated(void);
/* For tests: what gn_memory_total_mb() returns from now on. */
void gn_memory_pretend_mb(uint64_t mb);
/* The value of a line of /proc/meminfo, "MemTotal:", in 2^20 bytes; 0: there is none. */
uint64_t gn_memory_of_meminfo(const char *text, const char *key);

#endif
