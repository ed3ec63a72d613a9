/* Requests to a running kiosk over its socket: one table for the server, the client, --help
 * and the manual. */
#ifndef GN_OPTIONS_COMMAND_H
#define GN_OPTIONS_COMMAND_H

#include <stddef.h>

#include "options/action.h"

/* The commands that are not actions: X(ID, id, name, arguments, flags, help, members..). A row and
 * the function answer_<id> of kiosk/control/answer.c make a command. */
/* clang-format off */
#define GN_REQUESTS(X)                                                                             \
    X(SET, set, "set", "KEY VALUE", GN_CTL_CHANGES,                                                \
      "change an option until reload; overrides modes and flags",       \
      "key", "value")                                                                              \
    X(GET, get, "get", "KEY", 0, "print an option's value and where it comes from", "key")         \
    X(STATUS, status, "status", "", 0, "print the state of the kiosk", NULL)                       \
    X(SCREENSHOT, screenshot, "screenshot", "FILE", GN_CTL_CHANGES | GN_CTL_SLOW | GN_CTL_FILE,    \
      "write the next frame as a .png", "file")                                                    \
    X(RELOAD, reload, "reload", "", GN_CTL_CHANGES | GN_CTL_SLOW,                                  \
      "read the configuration and the scene again", NULL)                                          \
    X(SCENE, scene, "scene", "FILE", GN_CTL_CHANGES | GN_CTL_SLOW | GN_CTL_OWNER,                  \
      "show that file in all modes, once it is loaded", "file")                                    \
    X(ROLLBACK, rollback, "rollback", "", GN_CTL_CHANGES | GN_CTL_SLOW,                            \
      "go back to what was shown before the last scene FILE", NULL)                                \
    X(QUIT, quit, "quit", "", 0, "end the kiosk", NULL)
/* clang-format on */

enum {                     /* flags */
       GN_CTL_CHANGES = 1, /* it may cost a frame: at most GN_CONTROL_CHANGES_PER_S a second */
       GN_CTL_SLOW = 2,    /* the reply comes when it is done, which may take seconds */
       GN_CTL_FILE = 4,    /* the client passes a memory file, and the kiosk writes into it */
       GN_CTL_OWNER = 8,   /* of root and the kiosk's own user: the kiosk opens a file they name */
};
enum gn_ctl { /* first the actions, in their order: gn_ctl_action() */
#define X(ID, ...) GN_CTL_##ID,
              GN_ACTIONS(X) GN_REQUESTS(X)
#undef X
                  GN_CTL_COUNT,
};
enum { GN_CTL_WORDS_MAX = 2 };
struct gn_ctl_row {
    const char *name;
    const char *words; /* how arguments are written on a command line: "KEY VALUE" */
    unsigned flags;
    const char *what;                      /* a phrase */
    const char *members[GN_CTL_WORDS_MAX]; /* of the request, beside "cmd"; NULL: none */
};
extern const struct gn_ctl_row gn_ctl_rows[GN_CTL_COUNT];

enum gn_action_kind gn_ctl_action(enum gn_ctl command); /* GN_ACTION_NONE: it is not an action */
int gn_ctl_find(const char *name);                      /* enum gn_ctl, or -1 */
int gn_ctl_words(enum gn_ctl command);                  /* how many words it takes, */
int gn_ctl_words_least(enum gn_ctl command);            /* and without those in brackets */
void gn_ctl_list(char *out, size_t size);               /* " next, prev, mode NAME, .." */
const char *gn_ctl_nearest(const char *misspelled);     /* or NULL */

#endif
