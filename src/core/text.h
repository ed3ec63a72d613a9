/* Short texts for messages: one line, whole UTF-8 characters, no control characters. */
#ifndef GN_CORE_TEXT_H
#define GN_CORE_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Formats into out (size > 0 bytes with the ending zero): one line, whose control characters are
 * escaped as gn_text_print() does; tabs and ends of lines become spaces. Shortens a text that does
 * not fit, at whole UTF-8 characters: in the middle ("..."), since the reason stands at the end,
 * behind names that can be long; at the end where size is under 64 bytes. */
void gn_text_vformat(char *out, size_t size, const char *format, va_list args);
void gn_text_format(char *out, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Prints a text from elsewhere on one line. What would move the cursor or turn a line round is
 * printed as \u001b: C0, DEL and C1 control characters, separators of lines and paragraphs, and
 * bidirectional controls. */
void gn_text_print(const char *text, FILE *to);

/* Prints a line of a report, indented by two; as gn_text_format() makes it, of 511 bytes at most.
 */
void gn_text_print_line(FILE *to, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Appends to the text in out, of size bytes with the ending zero; what does not fit is cut. */
void gn_text_add(char *out, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for a line and its end; one for which there is no room is left out. */
void gn_text_add_line(char *out, size_t size, const char *end, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Copies the next word of *at, of those with spaces or tabs between, and moves *at behind it.
 * False: there are no more. A longer word is cut. */
bool gn_text_word(const char **at, char *word, size_t size);

/* How many edits of a character (insert, delete, replace, swap with the next) turn a into b; texts
 * beyond 31 characters are cut. */
int gn_text_distance(const char *a, const char *b);

/* "Did you mean": the nearest of the names that were tried, within edits of a third of the word's
 * length. Zero it, try each name, read name; NULL: none is near. The first of equals wins. */
struct gn_text_guess {
    const char *name;
    int distance;
};
void gn_text_guess(struct gn_text_guess *guess, const char *word, const char *name);

#endif
