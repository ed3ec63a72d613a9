/* Threads of work beside the frames. */
#ifndef GN_CORE_THREAD_H
#define GN_CORE_THREAD_H

/* Starts a detached thread; returns 0 or an errno. */
int gn_thread_start_detached(void *(*run)(void *), void *argument);
/* Frames have priority: a thread lowers its own, which on Linux does not affect the others. */
void gn_thread_lower_priority(void);

#endif
