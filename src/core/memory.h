/* The memory of this machine, from which limits get their defaults. */
#ifndef GN_CORE_MEMORY_H
#define GN_CORE_MEMORY_H

#include <stdint.h>

/* MemTotal of /proc/meminfo in 2^20 bytes, read once; 0: unknown. */
uint64_t gn_memory_total_mb(void);
/* For tests: what gn_memory_total_mb() returns from now on. */
void gn_memory_pretend_mb(uint64_t mb);
/* The value of a line of /proc/meminfo, "MemTotal:", in 2^20 bytes; 0: there is none. */
uint64_t gn_memory_of_meminfo(const char *text, const char *key);

#endif
