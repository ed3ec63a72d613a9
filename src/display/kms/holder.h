/* Finds the process that has a card open. */
#ifndef GN_DISPLAY_KMS_HOLDER_H
#define GN_DISPLAY_KMS_HOLDER_H

#include <stdbool.h>
#include <stddef.h>

/* The first other process that has the node open, as "Xorg (pid 612)"; a session manager
 * (systemd-logind, seatd) only if there is no other. Only root sees processes of other users.
 * False: none found. */
bool gn_kms_find_holder(const char *node, char *out, size_t size);

#endif
