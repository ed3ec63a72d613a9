#include "core/memory.h"

#include <malloc.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Loader threads ask, too. 0: not read yet. */
static _Atomic uint64_t known_mb;

uint64_t gn_memory_of_meminfo(const char *text, const char *key) {
    const char *at = strstr(text, key);
    return at ? strtoull(at + strlen(key), NULL, 10) / 1024 : 0;
}

uint64_t gn_memory_total_mb(void) {
    uint64_t mb = atomic_load(&known_mb);
    if (mb > 0) return mb;
    char text[512]; /* MemTotal is the first line */
    FILE *file = fopen("/proc/meminfo", "re");
    if (!file) return 0;
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    mb = gn_memory_of_meminfo(text, "MemTotal:");
    atomic_store(&known_mb, mb);
    return mb;
}

uint64_t gn_memory_allocated(void) {
    const struct mallinfo2 now = mallinfo2();
    return now.uordblks + now.hblkhd;
}

void gn_memory_pretend_mb(uint64_t mb) { atomic_store(&known_mb, mb); }
