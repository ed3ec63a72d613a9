/* Numbers, kinds of several with commas between them, and dates. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "options/date.h"
#include "options/kind.h"

bool gn_kind_read_number(const char *text, double *out) {
    char *end;
    if (!text[0] || text[strspn(text, "+-.0123456789eE")] || !strpbrk(text, "0123456789"))
        return false;
    *out = strtod(text, &end);
    return *end == '\0' && isfinite(*out);
}

bool gn_kind_parse_number(const struct gn_option_row *row, const char *text, double *field) {
    double value;
    if (!gn_kind_read_number(text, &value) || value < row->min || value > row->max) return false;
    *field = value;
    return true;
}

/* So many numbers, or auto: NAN. */
static bool parse_numbers(const struct gn_kind_input *in, double *numbers, int count) {
    char part[32];
    const char *text = in->text;
    const bool automatic = strcmp(text, "auto") == 0;
    for (int k = 0; k < count; k++) numbers[k] = NAN;
    for (int k = 0; k < count && !automatic; k++) {
        const size_t length = strcspn(text, ",");
        if (length >= sizeof part || (text[length] == ',') != (k < count - 1)) return false;
        snprintf(part, sizeof part, "%.*s", (int)length, text);
        if (!gn_kind_parse_number(in->row, part, &numbers[k])) return false;
        text += length + (k < count - 1);
    }
    return true;
}

static void print_numbers(const double *numbers, int count, const struct gn_kind_output *to) {
    if (isnan(numbers[0])) gn_text_add(to->out, to->size, "auto");
    for (int k = 0; k < count && !isnan(numbers[0]); k++)
        gn_text_add(to->out, to->size, "%s%.9g", k ? "," : "", numbers[k]);
}

bool gn_kind_parse_point(struct gn_kind_input *in, void *field) {
    double point[3];
    if (!parse_numbers(in, point, 3)) return false;
    memcpy(field, point, sizeof point);
    return true;
}

void gn_kind_print_point(const void *field, const struct gn_kind_output *to) {
    print_numbers(field, 3, to);
}

bool gn_kind_parse_place(struct gn_kind_input *in, void *field) {
    double place[2];
    if (!parse_numbers(in, place, 2) || fabs(place[0]) > 90) return false;
    memcpy(field, place, sizeof place);
    return true;
}

void gn_kind_print_place(const void *field, const struct gn_kind_output *to) {
    print_numbers(field, 2, to);
}

bool gn_kind_parse_date(struct gn_kind_input *in, void *field) {
    struct gn_date date;
    const bool ok = strcmp(in->text, "now") == 0 || gn_date_parse(in->text, &date);
    return ok && gn_kind_keep(in, field);
}
