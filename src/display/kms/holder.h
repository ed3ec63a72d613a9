/* Who has a card open. */
#ifndef GN_DISPLAY_KMS_HOLDER_H
#define GN_DISPLAY_KMS_HOLDER_H

#include <stdbool.h>
#include <stddef.h>

/* The first other process that has the node open, as "Xorg (pid 612)", one that keeps it for others
 * (systemd-logind, seatd) only if there is no other. Other users' processes can
 * be seen by root alone. False: none is seen. */
bool gn_kms_find_holder(const char *node, char *out, size_t size);

#endif
