#include "display/kms/console.h"

#include <fcntl.h>
#include <linux/kd.h>
#include <linux/vt.h>
#include <signal.h>
#include <stddef.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

enum { LEAVE = SIGUSR1, ENTER = SIGUSR2 };

static bool is_console(int fd) {
    int mode;
    struct vt_mode vt;
    return ioctl(fd, KDGETMODE, &mode) == 0 && ioctl(fd, VT_GETMODE, &vt) == 0;
}

/* Ours: that of standard input, else the controlling one. */
static int find_tty(void) {
    int fd = is_console(STDIN_FILENO) ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)
                                      : open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY);
    if (fd < 0 || is_console(fd)) return fd;
    close(fd);
    return -1;
}

static int open_signals(void) {
    sigset_t both;
    sigemptyset(&both);
    sigaddset(&both, LEAVE);
    sigaddset(&both, ENTER);
    sigprocmask(SIG_BLOCK, &both, NULL);
    return signalfd(-1, &both, SFD_CLOEXEC | SFD_NONBLOCK);
}

void gn_console_open(struct gn_console *c) {
    struct vt_mode mode = {.mode = VT_PROCESS, .relsig = LEAVE, .acqsig = ENTER};
    *c = (struct gn_console){.tty = find_tty(), .signals = -1};
    if (c->tty < 0) return;
    c->signals = open_signals();
    if (c->signals < 0 || ioctl(c->tty, VT_SETMODE, &mode) != 0) {
        gn_console_close(c);
        return;
    }
    ioctl(c->tty, KDSETMODE, KD_GRAPHICS);
}

void gn_console_read(struct gn_console *c, bool *left, bool *entered) {
    struct signalfd_siginfo info;
    *left = *entered = false;
    while (c->signals >= 0 && read(c->signals, &info, sizeof info) == sizeof info) {
        *left = info.ssi_signo == LEAVE;
        *entered = info.ssi_signo == ENTER;
        if (*entered) ioctl(c->tty, VT_RELDISP, VT_ACKACQ);
    }
}

void gn_console_let_go(struct gn_console *c) { ioctl(c->tty, VT_RELDISP, 1); }

void gn_console_close(struct gn_console *c) {
    struct vt_mode automatic = {.mode = VT_AUTO};
    if (c->tty >= 0) {
        ioctl(c->tty, VT_SETMODE, &automatic);
        ioctl(c->tty, KDSETMODE, KD_TEXT);
        close(c->tty);
    }
    if (c->signals >= 0) close(c->signals);
    *c = (struct gn_console){-1, -1};
}
