/* Messages for the log, queued until they are read. */
#ifndef GN_INPUT_REPORT_H
#define GN_INPUT_REPORT_H

#include <stdbool.h>
#include <stddef.h>

enum { GN_REPORTS = 48, GN_REPORT_SIZE = 320 };

struct gn_reports { /* ready when zeroed */
    char text[GN_REPORTS][GN_REPORT_SIZE];
    unsigned begin, end;
    unsigned dropped; /* since the last one that was read */
};

/* Queues one line, without a newline; counts it as dropped if the queue is full. */
void gn_report(struct gn_reports *reports, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
bool gn_report_next(struct gn_reports *reports, char *out, size_t size);

#endif
