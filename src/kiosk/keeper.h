/* Saves the state of the kiosk in a thread, since a slow card may take seconds while frames go on.
 */
#ifndef GN_KIOSK_KEEPER_H
#define GN_KIOSK_KEEPER_H

#include "kiosk/state.h"

struct gn_keeper;
/* older: as gn_state_read() has it. The path is copied. NULL: fails. */
struct gn_keeper *gn_keeper_open(const struct gn_disk *disk, const char *path, int older,
                                 struct gn_err *err);
int gn_keeper_fd(const struct gn_keeper *keeper); /* readable when gn_keeper_take() has a result */
/* The state is copied. It replaces one that is not being saved yet. */
void gn_keeper_save(struct gn_keeper *keeper, const struct gn_state *state);
bool gn_keeper_is_busy(const struct gn_keeper *keeper); /* the result is not taken yet */
/* True: what was asked for last is done, and *ok and err have the result. */
bool gn_keeper_take(struct gn_keeper *keeper, bool *ok, struct gn_err *err);
/* Waits at most so long for what is being saved. False: it is not done yet, or failed. NULL is
 * legal. */
bool gn_keeper_close(struct gn_keeper *keeper, int64_t wait_ns, struct gn_err *err);

#endif
