#include "cli/wake.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
enum { CRASHES = sizeof crashes / sizeof *crashes };

static int heard = STDERR_FILENO; /* where our own line goes */

static void say_and_end(int signal) {
    static const char line[] = "gnomon: the graphics driver crashes as it starts; gnomon doctor "
                               "tells which do, --backend chooses one\n";
    (void)signal;
    if (write(heard, line, sizeof line - 1) < 0) _exit(GN_EXIT_WORLD);
    _exit(GN_EXIT_WORLD);
}

/* The descriptor that stderr had, or -1 if it was left as it is. */
static int silence(void) {
    int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    int kept = nothing < 0 ? -1 : fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    fflush(stderr);
    if (kept >= 0) dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) close(nothing);
    return kept;
}

static void listen_again(int kept) {
    if (kept < 0) return;
    dup2(kept, STDERR_FILENO);
    close(kept);
}

bool gn_wake_display(struct gn_display *display, const struct gn_options *options,
                     struct gn_warnings *warnings, struct gn_err *err) {
    const struct sigaction now = {.sa_handler = say_and_end};
    struct sigaction old[CRASHES];
    int kept = options->verbose ? -1 : silence();
    heard = kept >= 0 ? kept : STDERR_FILENO;
    for (int i = 0; i < CRASHES; i++) sigaction(crashes[i], &now, &old[i]);
    bool ok = gn_display_open(display, options->backend, warnings, err);
    for (int i = 0; i < CRASHES; i++) sigaction(crashes[i], &old[i], NULL);
    listen_again(kept);
    return ok;
}
