#include "core/stop.h"

#include <stddef.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "core/err.h"

static void ends(sigset_t *signals) {
    sigemptyset(signals);
    sigaddset(signals, SIGTERM);
    sigaddset(signals, SIGINT);
}

void gn_stop_block(sigset_t *signals) {
    sigset_t both;
    ends(&both);
    sigprocmask(SIG_BLOCK, &both, NULL);
    if (signals) *signals = both;
}

int gn_stop_open(void) {
    sigset_t all;
    ends(&all);
    sigaddset(&all, SIGHUP);
    sigprocmask(SIG_BLOCK, &all, NULL);
    return signalfd(-1, &all, SFD_CLOEXEC | SFD_NONBLOCK);
}

int gn_stop_read(int fd) {
    struct signalfd_siginfo info;
    return read(fd, &info, sizeof info) == sizeof info ? (int)info.ssi_signo : 0;
}

static void end(int signal) {
    (void)signal;
    _exit(GN_EXIT_OK);
}

void gn_stop_at_once(void) {
    static const int signals[] = {SIGTERM, SIGINT};
    struct sigaction old, now = {.sa_handler = end};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN)
            sigaction(signals[i], &now, NULL);
}

bool gn_stop_asked(void) {
    sigset_t pending;
    sigpending(&pending);
    return sigismember(&pending, SIGTERM) || sigismember(&pending, SIGINT);
}
