#include "core/text.h"

#include <stdlib.h>
#include <string.h>

#define DISTANCE_MAX 31
#define ENDS_MIN     64 /* shorter buffers get only the beginning of a text */
#define ESCAPE_BYTES 6  /* "\u001b" */

static void cut_at_character(char *text, size_t length) {
    size_t start = length;
    while (start > 0 && length - start < 4 && ((unsigned char)text[start - 1] & 0xc0) == 0x80)
        start--;
    if (start == 0) return;
    const unsigned char lead = (unsigned char)text[start - 1];
    const size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
    if (start - 1 + bytes > length) text[start - 1] = '\0';
}

/* Fills out with the beginning and the end of text. */
static void join_ends(char *out, size_t size, const char *text, size_t length) {
    static const char gap[] = "...";
    memcpy(out, text, size / 2);
    out[size / 2] = '\0';
    cut_at_character(out, size / 2);
    size_t start = strlen(out), room = size - 1 - start - strlen(gap);
    const char *end = text + length - room;
    while (((unsigned char)*end & 0xc0) == 0x80) end++;
    snprintf(out + start, size - start, "%s%s", gap, end);
}

/* The bytes of the control character at c, or 0. */
static size_t control_length(const unsigned char *c) {
    if (*c < 0x20 || *c == 0x7f) return 1;
    if (c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0) return 2; /* U+0080 to U+009F */
    if (c[0] == 0xd8 && c[1] == 0x9c) return 2;                /* U+061C */
    if (c[0] != 0xe2) return 0;
    if (c[1] == 0x80 && (c[2] == 0x8e || c[2] == 0x8f)) return 3; /* U+200E, U+200F */
    if (c[1] == 0x80 && c[2] >= 0xa8 && c[2] <= 0xae) return 3;   /* U+2028 to U+202E */
    if (c[1] == 0x81 && c[2] >= 0xa6 && c[2] <= 0xa9) return 3;   /* U+2066 to U+2069 */
    return 0;
}

/* Writes the control character of so many bytes at c as \u001b; returns the end. */
static char *write_escape(char *to, const unsigned char *c, size_t length) {
    const unsigned code = length == 1 ? *c
                          : length == 2
                              ? (c[0] & 0x1fu) << 6 | (c[1] & 0x3fu)
                              : (c[0] & 0xfu) << 12 | (c[1] & 0x3fu) << 6 | (c[2] & 0x3fu);
    return to + snprintf(to, ESCAPE_BYTES + 1, "\\u%04x", code);
}

void gn_text_print_line(FILE *to, const char *format, ...) {
    char text[512];
    va_list args;
    va_start(args, format);
    gn_text_vformat(text, sizeof text, format, args);
    va_end(args);
    fprintf(to, "  %s\n", text);
}

void gn_text_add(char *out, size_t size, const char *format, ...) {
    const size_t used = strlen(out);
    va_list args;
    va_start(args, format);
    vsnprintf(out + used, size - used, format, args);
    va_end(args);
}

void gn_text_add_line(char *out, size_t size, const char *end, const char *format, ...) {
    const size_t used = strlen(out), room = size - used;
    va_list args;
    va_start(args, format);
    const int length = vsnprintf(out + used, room, format, args);
    va_end(args);
    if (length >= 0 && (size_t)length + strlen(end) < room)
        memcpy(out + used + length, end, strlen(end) + 1);
    else
        out[used] = '\0';
}

bool gn_text_word(const char **at, char *word, size_t size) {
    *at += strspn(*at, " \t");
    const size_t length = strcspn(*at, " \t");
    snprintf(word, size, "%.*s", (int)length, *at);
    *at += length;
    return length > 0;
}

void gn_text_print(const char *text, FILE *to) {
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        const size_t length = control_length(c);
        char escape[ESCAPE_BYTES + 1];
        if (length == 0)
            putc(*c, to);
        else
            fwrite(escape, 1, (size_t)(write_escape(escape, c, length) - escape), to);
        c += length > 0 ? length : 1;
    }
}

/* The same into out, which has room for ESCAPE_BYTES times as much; returns the length. Tabs and
 * ends of lines become spaces, or nothing at the end of the text. */
static size_t escape_controls(const char *text, char *out) {
    char *to = out, *end = out;
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        const size_t length = control_length(c);
        if (*c >= '\t' && *c <= '\r') {
            *to++ = ' ';
        } else {
            if (length == 0)
                *to++ = (char)*c;
            else
                to = write_escape(to, c, length);
            end = to;
        }
        c += length > 0 ? length : 1;
    }
    *end = '\0';
    return (size_t)(end - out);
}

static bool is_clean(const char *text) {
    while (*text && control_length((const unsigned char *)text) == 0) text++;
    return !*text;
}

void gn_text_vformat(char *out, size_t size, const char *format, va_list args) {
    va_list again;
    va_copy(again, args);
    const int wanted = vsnprintf(out, size, format, args);
    const size_t length = wanted > 0 ? (size_t)wanted : 0;
    if (wanted < 0) out[0] = '\0';
    if (length >= size || !is_clean(out)) {
        char *all = malloc((ESCAPE_BYTES + 1) * (length + 1)), *escaped = all + length + 1;
        if (all && vsnprintf(all, length + 1, format, again) == wanted) {
            const size_t long_length = escape_controls(all, escaped);
            if (long_length >= size && size >= ENDS_MIN) {
                join_ends(out, size, escaped, long_length);
            } else {
                snprintf(out, size, "%s", escaped);
                if (long_length >= size) cut_at_character(out, strlen(out));
            }
        } else { /* no memory */
            cut_at_character(out, strlen(out));
            for (char *c = out; *c; c++)
                if (control_length((const unsigned char *)c)) *c = '?';
        }
        free(all);
    }
    va_end(again);
}

void gn_text_format(char *out, size_t size, const char *format, ...) {
    va_list args;
    va_start(args, format);
    gn_text_vformat(out, size, format, args);
    va_end(args);
}

static int least_of_three(int a, int b, int c) {
    int m = a < b ? a : b;
    return m < c ? m : c;
}

/* Optimal string alignment: Levenshtein's distance, and two neighbours that changed places are one
 * edit. Three rows of the table: i - 2, i - 1 and i. */
int gn_text_distance(const char *a, const char *b) {
    int rows[3][DISTANCE_MAX + 1];
    const int a_length = (int)strnlen(a, DISTANCE_MAX), b_length = (int)strnlen(b, DISTANCE_MAX);
    for (int j = 0; j <= b_length; j++) rows[0][j] = j;
    for (int i = 1; i <= a_length; i++) {
        int *row = rows[i % 3];
        const int *above = rows[(i + 2) % 3], *above_that = rows[(i + 1) % 3];
        row[0] = i;
        for (int j = 1; j <= b_length; j++) {
            row[j] =
                least_of_three(above[j - 1] + (a[i - 1] != b[j - 1]), above[j] + 1, row[j - 1] + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least_of_three(row[j], above_that[j - 2] + 1, row[j]);
        }
    }
    return rows[a_length % 3][b_length];
}

void gn_text_guess(struct gn_text_guess *guess, const char *word, const char *name) {
    const int third = ((int)strlen(word) + 1) / 3, most = third > 1 ? third : 1;
    const int distance = gn_text_distance(word, name);
    if (distance > most || (guess->name && distance >= guess->distance)) return;
    *guess = (struct gn_text_guess){.name = name, .distance = distance};
}
