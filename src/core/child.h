/* Runs work that may crash or hang, such as loading a GPU driver, in a child process. Its standard
 * input and output are /dev/null; a crash or a hang is reported as an error. */
#ifndef GN_CORE_CHILD_H
#define GN_CORE_CHILD_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

struct gn_child {
    void (*work)(void *shared, const void *argument);  /* runs in the child */
    void (*watch)(void *shared, const void *argument); /* about ten times a second here; or NULL */
    int wake; /* a descriptor: when it has input, watch is called at once; 0: none */
    const atomic_bool *cancel; /* read as often; true kills the child; or NULL */
    const void *argument;
    const uint32_t *progress; /* counter in the shared memory; NULL: none. See stall_s */
    int stall_s;              /* seconds without progress until the child is killed; 0: 60 */
};

/* Zeroed memory that a child shares with its parent, or NULL. */
void *gn_child_share(size_t size, struct gn_err *err);
void gn_child_unshare(void *shared, size_t size);

/* Runs the work and waits for its end. False when it crashed, hung or could not be started; err has
 * the reason, worded to follow a name ("crashes (Segmentation fault)"). The shared memory keeps
 * what the child has written. */
bool gn_child_run(const struct gn_child *child, void *shared, struct gn_err *err);

#endif
