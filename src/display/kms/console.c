#include "display/kms/console.h"

#include <fcntl.h>
#include <linux/kd.h>
#include <linux/vt.h>
#include <signal.h>
#include <stddef.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/stop.h"

enum { LEAVE = SIGUSR1, ENTER = SIGUSR2 };

static bool is_console(int fd) {
    int mode;
    struct vt_mode vt;
    return ioctl(fd, KDGETMODE, &mode) == 0 && ioctl(fd, VT_GETMODE, &vt) == 0;
}

static void restore_text_mode(void *user) {
    const struct gn_console *c = user;
    struct vt_mode automatic = {.mode = VT_AUTO};
    ioctl(c->tty, VT_SETMODE, &automatic);
    ioctl(c->tty, KDSETMODE, KD_TEXT);
    ioctl(c->tty, KDSKBMODE, (long)c->keyboard);
}

/* Of several signals in one step, the last one counts. */
static void take_signal(void *user, int number) {
    struct gn_console *c = user;
    c->leaves = number == LEAVE;
    c->entered = number == ENTER;
    if (c->entered) ioctl(c->tty, VT_RELDISP, VT_ACKACQ);
}

/* One that was killed may have left it off. */
static void take_keyboard(struct gn_console *c, bool locked) {
    int mode = K_UNICODE;
    if (ioctl(c->tty, KDGKBMODE, &mode) != 0 || mode == K_OFF) mode = K_UNICODE;
    c->keyboard = mode;
    const bool set = ioctl(c->tty, KDSKBMODE, (long)(locked ? K_OFF : mode)) == 0;
    c->locks_keys = locked && set;
}

void gn_console_open(struct gn_console *c, struct gn_loop *loop, bool locked) {
    struct vt_mode mode = {.mode = VT_PROCESS, .relsig = LEAVE, .acqsig = ENTER};
    sigset_t both;
    /* the VT of standard input, else the controlling terminal */
    int tty = is_console(STDIN_FILENO) ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)
                                       : open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY);
    if (tty >= 0 && !is_console(tty)) {
        close(tty);
        tty = -1;
    }
    *c = (struct gn_console){.tty = tty};
    if (tty < 0) return;
    c->keyboard = K_UNICODE;
    sigemptyset(&both);
    sigaddset(&both, LEAVE);
    sigaddset(&both, ENTER);
    c->signals = (struct gn_signals){.call = take_signal, .user = c};
    if (!gn_loop_add_signals(loop, &c->signals, &both) || ioctl(tty, VT_SETMODE, &mode) != 0) {
        gn_console_close(c);
        return;
    }
    gn_stop_set_restore(restore_text_mode, c);
    ioctl(tty, KDSETMODE, KD_GRAPHICS);
    take_keyboard(c, locked);
}

void gn_console_let_go(struct gn_console *c) {
    c->leaves = false;
    ioctl(c->tty, VT_RELDISP, 1);
}

void gn_console_close(struct gn_console *c) {
    if (c->tty >= 0) {
        gn_stop_set_restore(NULL, NULL);
        restore_text_mode(c);
        close(c->tty);
    }
    gn_loop_remove_signals(&c->signals);
    *c = (struct gn_console){.tty = -1};
}
