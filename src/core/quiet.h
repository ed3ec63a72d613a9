/* Silences stderr while a library prints to it: an error is one line, printed by main(). */
#ifndef GN_CORE_QUIET_H
#define GN_CORE_QUIET_H

/* Redirects stderr to /dev/null. Returns a copy of the old descriptor for gn_quiet_end(), or -1 if
 * stderr was left unchanged. */
int gn_quiet_begin(void);
/* Restores stderr; -1 is legal. */
void gn_quiet_end(int kept);

#endif
