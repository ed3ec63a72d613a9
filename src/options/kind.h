/* What the functions of a kind of value get, inside this room: the table is in value.c. */
#ifndef GN_OPTIONS_KIND_H
#define GN_OPTIONS_KIND_H

#include "options/value.h"

enum { GN_KIND_WRONG = 32 };
struct gn_kind_input {
    const struct gn_option_row *row;
    const char *text;
    struct gn_arena *arena; /* keeps texts */
    struct gn_err *err;     /* not NULL */
    char *wrong;            /* gets the first wrong name of a list, of GN_KIND_WRONG bytes */
};
struct gn_kind_output {
    const struct gn_option_row *row;
    char *out; /* "" at first */
    size_t size;
};

/* Makes the field, a const char *, a copy of the text. */
static inline bool gn_kind_keep(const struct gn_kind_input *in, void *field) {
    const char *kept = gn_arena_strdup(in->arena, in->text);
    if (!kept) return gn_fail(in->err, "no memory left");
    *(const char **)field = kept;
    return true;
}

/* kind_number.c: a decimal number as in the C locale, all of the text, without inf and nan; one in
 * the row's range; several with commas between them, or auto; a date */
bool gn_kind_read_number(const char *text, double *out);
bool gn_kind_parse_number(const struct gn_option_row *row, const char *text, double *field);
bool gn_kind_parse_point(struct gn_kind_input *in, void *field);
void gn_kind_print_point(const void *field, const struct gn_kind_output *to);
bool gn_kind_parse_place(struct gn_kind_input *in, void *field);
void gn_kind_print_place(const void *field, const struct gn_kind_output *to);
bool gn_kind_parse_date(struct gn_kind_input *in, void *field);

/* kind_button.c: a line, keys, names of buttons, an action */
bool gn_kind_parse_line(struct gn_kind_input *in, void *field);
bool gn_kind_parse_keys(struct gn_kind_input *in, void *field);
bool gn_kind_parse_names(struct gn_kind_input *in, void *field);
bool gn_kind_parse_action(struct gn_kind_input *in, void *field);
void gn_kind_print_action(const void *field, const struct gn_kind_output *to);

#endif
