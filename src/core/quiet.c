#include "core/quiet.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

int gn_quiet_begin(void) {
    int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    int kept = nothing < 0 ? -1 : fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    fflush(stderr);
    if (kept >= 0) dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) close(nothing);
    return kept;
}

void gn_quiet_end(int kept) {
    if (kept < 0) return;
    dup2(kept, STDERR_FILENO);
    close(kept);
}
