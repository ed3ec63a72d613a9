/* Values of options from text and to text, per kind of option. */
#ifndef GN_OPTIONS_VALUE_H
#define GN_OPTIONS_VALUE_H

#include "core/arena.h"
#include "core/err.h"
#include "options/settings.h"

/* Parses text into the field (of gn_value_size bytes); all of text must be the value. Texts are
 * kept in the arena. GN_KIND_SCENES and GN_KIND_LIMIT add to what is in the field. A failure is a
 * usage error: `LABEL: "TEXT" is not EXPECTED`, or `LABEL: ` and the message of the room that knows
 * such names.
 */
bool gn_value_parse(const struct gn_option_row *row, const char *text, void *field,
                    struct gn_arena *arena, const char *label, struct gn_err *err);
size_t gn_value_size(enum gn_option_kind kind);

/* The value as it is written in a file: "pcf", "1280x720", "auto"; "" for a text that is NULL. */
void gn_value_text(const struct gn_option_row *row, const void *field, char *out, size_t size);

/* A word that the value may be, by its index from 0: a choice, a technique; NULL: no more. */
const char *gn_value_word(const struct gn_option_row *row, int index);

/* Whether two fields have the same value or, of names of keys, one in common; out gets it, as the
 * first field has it. */
bool gn_value_shared(const struct gn_option_row *row, const void *a, const void *b, char *out,
                     size_t size);
/* Whether two fields have the same value. Not for limits and lists of scenes. */
bool gn_value_same(const struct gn_option_row *row, const void *a, const void *b);

/* A decimal number as in the C locale, all of text, without hex or leading space. */
bool gn_parse_int(const char *text, int64_t *out);

#endif
