/* Saves the state of the kiosk in a thread of its own, since a slow card may take seconds, while
 * frames go on. One save at a time. */
#ifndef GN_KIOSK_KEEPER_H
#define GN_KIOSK_KEEPER_H

#include "kiosk/state.h"

struct gn_keeper;
/* older: as gn_state_read() has it. The path is copied. NULL: fails. */
struct gn_keeper *gn_keeper_create(const struct gn_disk *disk, const char *path, int older,
                                   struct gn_err *err);
int gn_keeper_fd(const struct gn_keeper *keeper); /* readable when gn_keeper_take() has a result */
bool gn_keeper_is_busy(const struct gn_keeper *keeper); /* started, and not taken */
/* Not while it is busy. The state is copied. False: no thread. */
bool gn_keeper_start(struct gn_keeper *keeper, const struct gn_state *state, struct gn_err *err);
/* True: it is done, and *ok and err say how it ended. */
bool gn_keeper_take(struct gn_keeper *keeper, bool *ok, struct gn_err *err);
/* The last save, also while it is busy. The state is copied. False: no thread. */
bool gn_keeper_start_last(struct gn_keeper *keeper, const struct gn_state *state,
                          struct gn_err *err);
/* Waits so long at most for what is being saved, and frees the keeper, unless the disk has not
 * answered by then. False: that, or the last save failed. NULL is legal. */
bool gn_keeper_close(struct gn_keeper *keeper, int64_t wait_ns, struct gn_err *err);

#endif
