/* Memory of this process: private dirty pages, which are not shared and cannot be dropped; and the
 * part of it that an empty GL context takes. */
#ifndef GN_CLI_MEMORY_H
#define GN_CLI_MEMORY_H

#include <sys/types.h>

/* Megabytes (2^20 bytes) by /proc/self/smaps_rollup; NAN if the kernel has no such file. */
double gn_memory_private_dirty_mb(void);

/* A child that waits until it is asked, then opens the display, makes its context, measures itself
 * and ends. It is made while the process is small and has one thread, and costs nothing until it is
 * asked. Pages that it shares with its parent are not private to either while it lives: measure the
 * parent afterwards. */
struct gn_memory_probe {
    pid_t pid; /* 0: none */
    int fd;    /* -1: none */
};
/* backend, as in --backend, must live until the probe is closed. */
void gn_memory_probe_open(struct gn_memory_probe *probe, const char *backend);
/* Asks, and waits for the answer: private dirty megabytes of the empty context, NAN if there is no
 * answer. The child is gone afterwards. */
double gn_memory_probe_read(struct gn_memory_probe *probe);
void gn_memory_probe_close(struct gn_memory_probe *probe); /* a zeroed one may be closed */

#endif
