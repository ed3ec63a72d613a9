/* What the kiosk tells of itself as a table: of each value its name, unit and help, and its place
 * in a struct. The status of `gnomon ctl` is printed from such tables. */
#ifndef GN_KIOSK_METRIC_H
#define GN_KIOSK_METRIC_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* By the type of the value; an unknown one is null in JSON. */
enum gn_metric_kind {
    GN_METRIC_SWITCH,  /* bool */
    GN_METRIC_KNOWN,   /* int8_t: 0, 1; -1: unknown */
    GN_METRIC_INT,     /* int */
    GN_METRIC_UINT,    /* uint32_t */
    GN_METRIC_AMOUNT,  /* int64_t; negative: unknown */
    GN_METRIC_COUNTER, /* uint64_t, which only grows */
    GN_METRIC_NUMBER,  /* double; NaN: unknown */
    GN_METRIC_TEXT,    /* const char *; NULL: none */
    GN_METRIC_CHARS,   /* an array of char */
    GN_METRIC_JSON,    /* json_t *, a reference that is taken; NULL: the value is left out */
};
struct gn_metric {
    const char *name; /* "group.name" is a member of the object "group" */
    enum gn_metric_kind kind;
    size_t offset;
    const char *unit; /* "": none */
    const char *help;
    bool brief; /* it is in the reply to an action, too */
};
#define GN_METRIC(type, member, its_name, its_unit, its_help, ...)                                      \
    {                                                                                                   \
        .name = its_name,                                                                             \
     .kind = _Generic(((type *)0)->member,                                                         \
         bool: GN_METRIC_SWITCH,                                                                   \
         int8_t: GN_METRIC_KNOWN,                                                                  \
         int: GN_METRIC_INT, \
         uint32_t: GN_METRIC_UINT,                                                                       \
         int64_t: GN_METRIC_AMOUNT,                                                                \
         uint64_t: GN_METRIC_COUNTER,                                                              \
         double: GN_METRIC_NUMBER,                                                                 \
         const char *: GN_METRIC_TEXT, \
         char *: GN_METRIC_CHARS,                                                             \
         json_t *: GN_METRIC_JSON),                                                                \
     .offset = offsetof(type, member),                                                             \
     .unit = its_unit,                                                                             \
     .help = its_help,                                                                             \
     __VA_ARGS__ \
    }

/* Adds the values in `of` to the object, or only the brief ones. */
void gn_metrics_put(const struct gn_metric *metrics, int count, const void *of, bool brief,
                    json_t *into);

#endif
