/* Runtime errors: one line with what failed, where, and what to do.
 * A function that can fail returns false or NULL and fills `err`; its caller returns it, perhaps
 * with a prefix, and main() prints it once. Bugs are assert(); out of memory aborts (gn_xalloc in
 * arena.h). */
#ifndef GN_CORE_ERR_H
#define GN_CORE_ERR_H

#include <stdbool.h>

enum gn_exit {
    GN_EXIT_OK = 0,
    GN_EXIT_RUNTIME = 1,  /* runtime error: bad file, driver, device or scene */
    GN_EXIT_USAGE = 2,    /* usage error: unknown option, value out of range */
    GN_EXIT_DIFFER = 3,   /* compare: the pictures differ; doctor --compare: worse */
    GN_EXIT_DISPLAY = 70, /* the display is lost: the supervisor restarts the program */
};

struct gn_err {
    char text[512];      /* one line, no newline at its end, cut at a whole UTF-8 character */
    char shown[192];     /* what a screen in a public place says of it, set after the failure: no
                            paths, no names of techniques, no texts of the system; "": nothing */
    enum gn_exit status; /* GN_EXIT_RUNTIME unless gn_fail_usage() made it */
};

/* Both write the text, drop control characters, and return false, so that `return gn_fail(err, ..)`
 * is one line. err may be NULL. */
bool gn_fail(struct gn_err *err, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool gn_fail_usage(struct gn_err *err, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Puts "prefix: " before a callee's message; returns false. */
bool gn_fail_prefix(struct gn_err *err, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* All errors of what is checked to its end, instead of the first alone. */
enum { GN_ERRORS_MAX = 64 };
struct gn_errors {
    int count, dropped; /* dropped: beyond GN_ERRORS_MAX */
    struct gn_err items[GN_ERRORS_MAX];
};
/* Moves the error into the list, where equal ones are kept once, clears it and returns true: its
 * finder goes on. errors NULL: leaves it where it is and returns false. */
bool gn_errors_take(struct gn_errors *errors, struct gn_err *err);

#endif
