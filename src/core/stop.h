/* SIGTERM and SIGINT as a request to stop, with exit status 0. Code that writes files or has
 * something to finish calls gn_stop_block() and polls gn_stop_asked() between pieces of work. For
 * everything else gn_stop_at_once(), which main() calls, is enough; it works while a driver hangs,
 * too. */
#ifndef GN_CORE_STOP_H
#define GN_CORE_STOP_H

#include <signal.h>
#include <stdbool.h>

/* From now on either signal ends the process at once, unless the parent process set it to be
 * ignored. Buffered output is lost. */
void gn_stop_at_once(void);
/* From now on both signals stay pending instead of ending the process. Threads made later inherit
 * this. The set, if not NULL, gets the two. */
void gn_stop_block(sigset_t *signals);
/* Both and SIGHUP, for gn_loop_add_signals(). */
void gn_stop_signals(sigset_t *signals);
/* Whether either is pending. Never waits. */
bool gn_stop_asked(void);

#endif
