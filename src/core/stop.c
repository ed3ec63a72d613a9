#include "core/stop.h"

#include <stddef.h>
#include <unistd.h>

#include "core/err.h"

static void set_stop_signals(sigset_t *signals) {
    sigemptyset(signals);
    sigaddset(signals, SIGTERM);
    sigaddset(signals, SIGINT);
}

void gn_stop_block(sigset_t *signals) {
    sigset_t both;
    set_stop_signals(&both);
    sigprocmask(SIG_BLOCK, &both, NULL);
    if (signals) *signals = both;
}

void gn_stop_signals(sigset_t *signals) {
    set_stop_signals(signals);
    sigaddset(signals, SIGHUP);
}

static void exit_at_once(int signal) {
    (void)signal;
    _exit(GN_EXIT_OK);
}

void gn_stop_at_once(void) {
    static const int signals[] = {SIGTERM, SIGINT};
    struct sigaction old, now = {.sa_handler = exit_at_once};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN)
            sigaction(signals[i], &now, NULL);
}

bool gn_stop_asked(void) {
    sigset_t pending;
    sigpending(&pending);
    return sigismember(&pending, SIGTERM) || sigismember(&pending, SIGINT);
}
