/* What a running kiosk can be asked over its socket: one table for the server, the client, --help
 * and the manual. */
#ifndef GN_OPTIONS_COMMAND_H
#define GN_OPTIONS_COMMAND_H

#include <stdbool.h>
#include <stddef.h>

enum gn_ctl { /* those of an action are called as it is */
              GN_CTL_NEXT,
              GN_CTL_PREV,
              GN_CTL_MODE,
              GN_CTL_NEXT_SCENE,
              GN_CTL_NEXT_CAMERA,
              GN_CTL_PAUSE,
              GN_CTL_BLANK,
              GN_CTL_INFO,
              GN_CTL_SET,
              GN_CTL_GET,
              GN_CTL_STATUS,
              GN_CTL_SCREENSHOT,
              GN_CTL_RELOAD,
              GN_CTL_QUIT,
              GN_CTL_COUNT,
};
enum { GN_CTL_WORDS_MAX = 2 };
struct gn_ctl_row {
    const char *name;
    const char *members[GN_CTL_WORDS_MAX]; /* of the request, beside "cmd"; NULL: none */
    const char *words;                     /* how they are written on a command line: "KEY VALUE" */
    const char *what;                      /* a phrase */
    bool changes; /* it may cost a frame: at most GN_CONTROL_CHANGES_PER_S of those a second */
};
extern const struct gn_ctl_row gn_ctl_rows[GN_CTL_COUNT];

int gn_ctl_find(const char *name);                  /* enum gn_ctl, or -1 */
int gn_ctl_words(enum gn_ctl command);              /* how many words it takes */
void gn_ctl_list(char *out, size_t size);           /* " next, prev, mode NAME, .." */
const char *gn_ctl_nearest(const char *misspelled); /* or NULL */

#endif
