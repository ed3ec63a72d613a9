#include "cli/stop.h"

#include <stddef.h>

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

bool gn_stop_asked(void) {
    sigset_t pending;
    sigpending(&pending);
    return sigismember(&pending, SIGTERM) || sigismember(&pending, SIGINT);
}
