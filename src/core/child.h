/* Work that may not end well, such as waking up a driver, is done by a child: what the libraries
 * say there is not heard, and a crash or a hang is an answer like any other. */
#ifndef GN_CORE_CHILD_H
#define GN_CORE_CHILD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

struct gn_child {
    void (*work)(void *shared, const void *argument);  /* runs in the child */
    void (*watch)(void *shared, const void *argument); /* about ten times a second here; or NULL */
    bool (*stop)(void); /* asked as often; true: the child is killed; or NULL */
    const void *argument;
    const uint32_t *progress; /* inside shared; NULL: none. See stall_s */
    int stall_s;              /* killed when so many seconds brought no progress; 0: 60 */
};

/* Zeroed memory that a child shares with its parent, or NULL. */
void *gn_child_share(size_t size, struct gn_err *err);
void gn_child_unshare(void *shared, size_t size);

/* Runs the work and waits for its end. False when it crashed, hung or could not be started: err
 * says which, in words that follow a name ("crashes (Segmentation fault)"); what it had left in the
 * shared memory until then is there. */
bool gn_child_run(const struct gn_child *child, void *shared, struct gn_err *err);

#endif
