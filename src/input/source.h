/* Sources of keys and edges. A file that defines gn_source_NAME and a row of the table add one. */
#ifndef GN_INPUT_SOURCE_H
#define GN_INPUT_SOURCE_H

#include "core/warn.h"
#include "input/input.h"

struct gn_input_world;

/* All may be NULL. A source's own state is input->states[GN_SOURCE_NAME]: NULL until its open makes
 * it, freed by its close. A source adds its descriptors to the input's loop and arms the input's
 * timer when one becomes readable; then read, step and check of all sources are called, in this
 * order. */
struct gn_input_source {
    void (*open)(struct gn_input *input, const struct gn_input_world *world, int64_t now_ns,
                 struct gn_warnings *warnings);
    void (*read)(struct gn_input *input, int64_t now_ns); /* takes events from before now_ns */
    void (*step)(struct gn_input *input,
                 int64_t now_ns); /* runs what is due, before the gestures */
    void (*check)(struct gn_input *input, int64_t now_ns); /* runs what depends on the gestures */
    int64_t (*deadline)(const struct gn_input *input);     /* of step and check; INT64_MAX: none */
    void (*close)(struct gn_input *input); /* legal when not open, and after a failed open */
};

/* In the order in which they are read. */
#define GN_SOURCE_TABLE(X)                                                                         \
    X(script)                                                                                      \
    X(lines)                                                                                       \
    X(devices)                                                                                     \
    X(terminal)

#define X(name) extern const struct gn_input_source gn_source_##name;
GN_SOURCE_TABLE(X)
#undef X
enum {
#define X(name) GN_SOURCE_##name,
    GN_SOURCE_TABLE(X)
#undef X
        GN_SOURCE_COUNT
};

#endif
