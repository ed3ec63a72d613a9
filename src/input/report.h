/* Lines for the log, from the moment when something changes until somebody reads them. */
#ifndef GN_INPUT_REPORT_H
#define GN_INPUT_REPORT_H

#include <stdbool.h>
#include <stddef.h>

enum { GN_REPORTS = 48, GN_REPORT_SIZE = 320 };

struct gn_reports { /* zeroed is ready */
    char text[GN_REPORTS][GN_REPORT_SIZE];
    unsigned begin, end;
    unsigned dropped; /* since the last one that was read */
};

/* One line, without a newline; one too many is counted, and said. */
void gn_report(struct gn_reports *reports, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
bool gn_report_next(struct gn_reports *reports, char *out, size_t size);

#endif
