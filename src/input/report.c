#include "input/report.h"

#include <stdio.h>

#include "core/text.h"

void gn_report(struct gn_reports *reports, const char *format, ...) {
    if (reports->end - reports->begin == GN_REPORTS) {
        reports->dropped++;
        return;
    }
    va_list args;
    va_start(args, format);
    gn_text_vformat(reports->text[reports->end++ % GN_REPORTS], GN_REPORT_SIZE, format, args);
    va_end(args);
}

bool gn_report_next(struct gn_reports *reports, char *out, size_t size) {
    if (reports->begin != reports->end) {
        snprintf(out, size, "%s", reports->text[reports->begin++ % GN_REPORTS]);
        return true;
    }
    if (!reports->dropped) return false;
    snprintf(out, size, "buttons: %u more messages dropped", reports->dropped);
    reports->dropped = 0;
    return true;
}
