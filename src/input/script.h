/* What buttons and keys do, and when, as a text: tests that need no fingers. Pure.
 *
 *   # a comment
 *   0.5 click next          down, and up again GN_SCRIPT_CLICK_NS later (a key: at once)
 *   2.25 down space         seconds since the start, never less than the line before
 *   3 up space */
#ifndef GN_INPUT_SCRIPT_H
#define GN_INPUT_SCRIPT_H

#include <stdint.h>

#include "core/arena.h"
#include "core/err.h"

#define GN_SCRIPT_CLICK_NS INT64_C(60000000)

enum gn_script_what { GN_SCRIPT_DOWN, GN_SCRIPT_UP, GN_SCRIPT_CLICK };
struct gn_script_line {
    int64_t time_ns; /* since the start */
    enum gn_script_what what;
    const char *name; /* of a button or key, resolved by the caller */
    int number;       /* line number, from 1 */
};
struct gn_script {
    const struct gn_script_line *lines; /* in time order */
    int count;
};

/* Fails with a usage error that begins with "path:line: ". All memory is the arena's. */
bool gn_script_parse(const char *text, size_t size, const char *path, struct gn_arena *arena,
                     struct gn_script *out, struct gn_err *err);

#endif
