/* SIGTERM and SIGINT as a wish to stop, asked for between pieces of work: whoever calls
 * gn_stop_block() ends with 0, leaves no half-written file behind, and finishes what it is at. */
#ifndef GN_CLI_STOP_H
#define GN_CLI_STOP_H

#include <signal.h>
#include <stdbool.h>

/* From now on, and for good, both signals wait instead of ending the process. Threads made later
 * inherit it. The set, if not NULL, gets the two. */
void gn_stop_block(sigset_t *signals);
/* Has either come? Never waits. */
bool gn_stop_asked(void);

#endif
