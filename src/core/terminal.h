/* Texts for people, as wide as a terminal and with colours there. What goes elsewhere stays as it
 * is. */
#ifndef GN_CORE_TERMINAL_H
#define GN_CORE_TERMINAL_H

#include <stdbool.h>
#include <stdio.h>

/* Characters of a line of the terminal that it leads to, 80 where that is not known; 0: to none. */
int gn_terminal_columns(FILE *to);
/* It leads to a terminal, TERM is neither "dumb" nor missing, and NO_COLOR (no-color.org) is not
 * set. */
bool gn_terminal_has_colours(FILE *to);
/* What goes before a text of that colour, and behind it; "": no colours. */
enum gn_tint { GN_TINT_NONE, GN_TINT_BOLD, GN_TINT_RED, GN_TINT_GREEN, GN_TINT_YELLOW };
const char *gn_terminal_tint(FILE *to, enum gn_tint tint);

/* "[#####.....] 5 of 10, 3 s left", of what has taken so long: what is left takes as long each. */
void gn_terminal_write_bar(char *out, size_t size, int done, int all, double spent_s);

/* A report for `to`, written into the stream that begin() returns and printed by end(). */
struct gn_terminal {
    FILE *to, *report; /* the same, unless it leads to a terminal */
    char *text;
    size_t size;
};
FILE *gn_terminal_begin(struct gn_terminal *terminal, FILE *to);
void gn_terminal_end(struct gn_terminal *terminal);
/* Breaks lines of more than `columns` characters between words; they go on below their last column,
 * which begins behind two spaces. columns 0: as they are. colours: headings, which are not indented
 * and follow an empty line, are bold; below "Problems" what is numbered is red, and what is not,
 * green. */
void gn_terminal_format(const char *text, int columns, bool colours, FILE *to);

#endif
