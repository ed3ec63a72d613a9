/* What libraries say on stderr, kept from people: they get one line, and it is ours. */
#ifndef GN_CORE_QUIET_H
#define GN_CORE_QUIET_H

/* From now on stderr leads nowhere. The descriptor that it had, to be given to gn_quiet_end(), or
 * -1 where it was left as it is. */
int gn_quiet_begin(void);
/* -1 is legal. */
void gn_quiet_end(int kept);

#endif
