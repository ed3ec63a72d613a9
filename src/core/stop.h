/* SIGTERM and SIGINT. main() blocks both before it does anything else, so that threads of libraries
 * and drivers never get them. Then either gn_stop_end_process() has a thread wait for them, which
 * ends the process at any time, or the kiosk's event loop takes them. */
#ifndef GN_CORE_STOP_H
#define GN_CORE_STOP_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

/* From now on both signals stay pending instead of ending the process. Threads made later inherit
 * this. A signal that the parent process set to be ignored stays ignored until gn_stop_signals().
 */
void gn_stop_block(void);
/* Both and SIGHUP, for gn_loop_add_signals(). */
void gn_stop_signals(sigset_t *signals);
/* Whether either is pending. Never waits. */
bool gn_stop_asked(void);

/* After gn_stop_block(): either signal now ends the process, whatever the other threads do (a
 * driver that compiles, a write to a FIFO without a reader), with exit status 128 + its number.
 * Buffered output is lost. */
void gn_stop_end_process(void);
/* For a program that takes the signals in a loop and runs for years: all others that would end it
 * and are no fault of its own are ignored. And if one is pending for longer than that, a thread
 * removes the temporary file, calls what gn_stop_set_restore() gave it, and ends the process with
 * exit status 0. A GPU may take minutes for a frame, and nothing can be done meanwhile. */
void gn_stop_end_late(int64_t after_ns);
/* What outlives the process and is not the kernel's to restore, as the mode of a console. Called in
 * another thread, beside whatever the others do. NULL: nothing. */
void gn_stop_set_restore(void (*restore)(void *user), void *user);
/* Between the two no signal ends the process. The file of that name is removed before one does;
 * NULL: none. One at a time; the name must stay valid until the next release. */
void gn_stop_hold(void);
void gn_stop_release(const char *temporary);

#endif
