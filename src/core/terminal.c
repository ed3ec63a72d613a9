#include "core/terminal.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/text.h"

enum { COLUMNS = 80, LEAST = 40 };

int gn_terminal_columns(FILE *to) {
    struct winsize window = {0};
    if (!isatty(fileno(to))) return 0;
    const int columns = ioctl(fileno(to), TIOCGWINSZ, &window) == 0 ? window.ws_col : 0;
    return columns == 0 ? COLUMNS : columns < LEAST ? LEAST : columns;
}

bool gn_terminal_has_colours(FILE *to) {
    const char *none = getenv("NO_COLOR"), *kind = getenv("TERM");
    return isatty(fileno(to)) && !(none && *none) && kind && *kind && strcmp(kind, "dumb") != 0;
}

static const char *const tints[] = {[GN_TINT_NONE] = "\33[m",
                                    [GN_TINT_BOLD] = "\33[1m",
                                    [GN_TINT_RED] = "\33[31m",
                                    [GN_TINT_GREEN] = "\33[32m",
                                    [GN_TINT_YELLOW] = "\33[33m"};

const char *gn_terminal_tint(FILE *to, enum gn_tint tint) {
    return gn_terminal_has_colours(to) ? tints[tint] : "";
}

void gn_terminal_write_bar(char *out, size_t size, int done, int all, double spent_s) {
    static const char full[] = "####################", empty[] = "....................";
    const int most = sizeof full - 1, filled = (int)((double)most * done / all);
    const double left_s = done > 0 ? spent_s / done * (all - done) : 0;
    snprintf(out, size, "[%.*s%.*s] %d of %d", filled, full, most - filled, empty, done, all);
    if (done > 0) gn_text_add(out, size, ", %.0f s left", left_s);
}

/* ---- a report ------------------------------------------------------------------------------- */

/* Bytes of UTF-8 that are no character of their own. */
static bool goes_on(char c) { return ((unsigned char)c & 0xc0) == 0x80; }

static int count_characters(const char *begin, const char *end) {
    int count = 0;
    for (; begin < end; begin++) count += !goes_on(*begin);
    return count;
}

/* Where a line's last column begins: behind its label and two spaces, or behind "1. "; else that of
 * the line before, if the line is as long. */
static int find_column(const char *line, const char *end, int before) {
    const char *text = line + strspn(line, " "), *first = text;
    while (isdigit((unsigned char)*text)) text++;
    if (text > first && text[0] == '.' && text[1] == ' ') return (int)(text - line) + 2;
    for (const char *at = text = first; at + 1 < end; at++)
        if (at[0] == ' ' && at[1] == ' ') text = at + strspn(at, " ");
    const bool has_label = text > first && text < end;
    if (has_label) return count_characters(line, text);
    return first == line + 2 && before > 2 && line + before < end && line[before - 1] == ' '
               ? before
               : (int)(first - line);
}

/* Returns its column. */
static int print_line(const char *line, const char *end, int columns, int before, FILE *to) {
    const int column = find_column(line, end, before), indent = column > columns / 2 ? 2 : column;
    int room = columns;
    while (columns > 0 && count_characters(line, end) > room) {
        const char *at = line, *space = NULL;
        for (int used = 0; at < end && used <= room; used += !goes_on(*++at))
            if (*at == ' ' && at - line >= (room == columns ? indent : 1)) space = at;
        if (!space) break; /* one word */
        fprintf(to, "%.*s\n%*s", (int)(space - line), line, indent, "");
        line = space + strspn(space, " ");
        room = columns - indent;
    }
    fprintf(to, "%.*s", (int)(end - line), line);
    return column;
}

void gn_terminal_format(const char *text, int columns, bool colours, FILE *to) {
    bool after_empty = true, problems = false;
    int column = 0;
    for (const char *end; *text; text = end + (*end == '\n')) {
        end = text + strcspn(text, "\n");
        const bool heading = after_empty && end > text && *text != ' ' && end[-1] != '.';
        enum gn_tint tint = heading ? GN_TINT_BOLD : GN_TINT_NONE;
        if (heading) problems = end - text == 8 && strncmp(text, "Problems", 8) == 0;
        if (problems && strncmp(text, "  ", 2) == 0 && text[2] != ' ')
            tint = isdigit((unsigned char)text[2]) ? GN_TINT_RED : GN_TINT_GREEN;
        const bool tints_line = colours && tint != GN_TINT_NONE;
        if (tints_line) fputs(tints[tint], to);
        column = print_line(text, end, columns, column, to);
        if (tints_line) fputs(tints[GN_TINT_NONE], to);
        if (*end) fputc('\n', to);
        after_empty = end == text;
    }
}

FILE *gn_terminal_begin(struct gn_terminal *t, FILE *to) {
    *t = (struct gn_terminal){.to = to, .report = to};
    FILE *report = isatty(fileno(to)) ? open_memstream(&t->text, &t->size) : NULL;
    if (report) t->report = report;
    return t->report;
}

void gn_terminal_end(struct gn_terminal *t) {
    if (t->report == t->to) return;
    fclose(t->report);
    gn_terminal_format(t->text, gn_terminal_columns(t->to), gn_terminal_has_colours(t->to), t->to);
    free(t->text);
}
