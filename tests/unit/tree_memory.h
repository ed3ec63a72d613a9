/* The memory of a process and of all that it has started, as the kernel counts it. */
#ifndef GN_TESTS_TREE_MEMORY_H
#define GN_TESTS_TREE_MEMORY_H

#include <stdint.h>
#include <sys/types.h>

/* In 1024 bytes: pages that are no file's, and files in memory that one of them has open, each
 * once. 0: there is no such process. */
int64_t gn_tree_memory_kb(pid_t pid);

#endif
