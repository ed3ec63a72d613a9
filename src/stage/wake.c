#include "stage/wake.h"

#include <unistd.h>

#include "core/quiet.h"
#include "input/terminal.h"
#include "stage/driver_cache.h"

static const int crashes[GN_WAKE_CRASHES] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

static int error_fd = STDERR_FILENO; /* for our own line */

static void report_crash(int signal) {
    static const char line[] =
        "gnomon: the graphics driver crashed while starting; run gnomon doctor "
        "to find one that works, choose it with --backend\n";
    (void)signal;
    gn_terminal_leave();
    if (write(error_fd, line, sizeof line - 1) < 0) _exit(GN_EXIT_RUNTIME);
    _exit(GN_EXIT_RUNTIME);
}

void gn_wake_begin(struct gn_wake *wake, const struct gn_settings *settings) {
    const struct sigaction now = {.sa_handler = report_crash};
    gn_driver_cache_reserve(&wake->no_cache);
    wake->kept = settings->run.verbose ? -1 : gn_quiet_begin();
    error_fd = wake->kept >= 0 ? wake->kept : STDERR_FILENO;
    for (int i = 0; i < GN_WAKE_CRASHES; i++) sigaction(crashes[i], &now, &wake->old[i]);
}

void gn_wake_end(struct gn_wake *wake) {
    for (int i = 0; i < GN_WAKE_CRASHES; i++) sigaction(crashes[i], &wake->old[i], NULL);
    gn_quiet_end(wake->kept);
}

bool gn_wake_display(struct gn_display *display, const struct gn_settings *settings,
                     struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_wake wake = {0};
    gn_wake_begin(&wake, settings);
    if (wake.no_cache.text[0]) gn_warn(warnings, "%s", wake.no_cache.text);
    bool ok = gn_display_open(display, settings->display.backend, warnings, err);
    gn_wake_end(&wake);
    return ok;
}
