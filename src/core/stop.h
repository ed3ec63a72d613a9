/* SIGTERM and SIGINT as a wish to stop, which ends with 0. Whoever writes files or has something to
 * finish calls gn_stop_block() and asks between pieces of work; for all others gn_stop_at_once(),
 * which main() calls, is enough, and ends them also while a driver hangs. */
#ifndef GN_CORE_STOP_H
#define GN_CORE_STOP_H

#include <signal.h>
#include <stdbool.h>

/* From now on either ends the process on the spot, unless whoever started it has it ignored. What
 * has not been printed yet is not. */
void gn_stop_at_once(void);
/* From now on, and for good, both signals wait instead of ending the process. Threads made later
 * inherit it. The set, if not NULL, gets the two. */
void gn_stop_block(sigset_t *signals);
/* Both and SIGHUP, for gn_loop_add_signals(). */
void gn_stop_signals(sigset_t *signals);
/* Has either come? Never waits. */
bool gn_stop_asked(void);

#endif
