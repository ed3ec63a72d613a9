#include "core/text.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DISTANCE_MAX 31
#define ENDS_MIN     64 /* shorter buffers get only the beginning of a text */

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

void gn_text_clean(char *text) {
    char *to = text;
    for (const char *c = text; *c;) {
        const size_t length = control_length((const unsigned char *)c);
        if (length == 0) *to++ = *c;
        c += length > 0 ? length : 1;
    }
    *to = '\0';
}

void gn_text_print(const char *text, FILE *to) {
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        const size_t length = control_length(c);
        if (length == 0)
            putc(*c, to);
        else if (length == 1)
            fprintf(to, "\\u%04x", *c);
        else if (length == 2)
            fprintf(to, "\\u%04x", (c[0] & 0x1fu) << 6 | (c[1] & 0x3fu));
        else
            fprintf(to, "\\u%04x", (c[0] & 0xfu) << 12 | (c[1] & 0x3fu) << 6 | (c[2] & 0x3fu));
        c += length > 0 ? length : 1;
    }
}

void gn_text_vformat(char *out, size_t size, const char *format, va_list args) {
    va_list again;
    va_copy(again, args);
    int wanted = vsnprintf(out, size, format, args);
    if (wanted < 0) out[0] = '\0';
    if (wanted >= (int)size) {
        char *all = size >= ENDS_MIN ? malloc((size_t)wanted + 1) : NULL;
        if (all && vsnprintf(all, (size_t)wanted + 1, format, again) == wanted)
            join_ends(out, size, all, (size_t)wanted);
        else
            cut_at_character(out, strlen(out));
        free(all);
    }
    va_end(again);
    gn_text_clean(out);
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
