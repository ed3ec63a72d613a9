#include "input/terminal.h"

#include <errno.h>
#include <linux/kd.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "core/arena.h"
#include "input/private.h"

/* Signals that end the process before the terminal is closed. */
enum { ENDS = 6 };
static const int ends[ENDS] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGQUIT};

/* State of the signal handlers, which take no argument. All functions that they call are
 * async-signal-safe. */
static struct {
    volatile sig_atomic_t open, raw; /* raw: the terminal has our settings */
    int fd, wake_fd;
    struct termios saved, ours;
    struct sigaction old_stop, old_continue, old_ends[ENDS];
} own;

/* A terminal that is not our controlling one cannot stop us. */
static bool is_foreground(int fd) {
    const pid_t group = tcgetpgrp(fd);
    return group == getpgrp() || (group < 0 && errno == ENOTTY);
}

static void set_raw(bool raw) {
    /* in the background SIGTTOU would stop us, and the shell has set the terminal up */
    if ((!raw && !own.raw) || !is_foreground(own.fd)) return;
    if (tcsetattr(own.fd, TCSANOW, raw ? &own.ours : &own.saved) == 0) own.raw = raw;
}

static void on_continue(int signal) {
    const int error = errno;
    const uint64_t one = 1;
    (void)signal;
    if (own.open) {
        set_raw(true);
        (void)!write(own.wake_fd, &one, sizeof one);
    }
    errno = error;
}

static void on_stop(int number) {
    const int error = errno;
    struct sigaction mine, plain = {.sa_handler = SIG_DFL};
    sigset_t stop, mask;
    if (own.open) set_raw(false);
    sigaction(number, &plain, &mine);
    sigemptyset(&stop);
    sigaddset(&stop, number);
    raise(number);
    sigprocmask(SIG_UNBLOCK, &stop, &mask); /* stopped here until continued */
    sigprocmask(SIG_SETMASK, &mask, NULL);
    sigaction(number, &mine, NULL);
    errno = error;
}

/* Re-raises the signal with its default action; a fault recurs by itself. */
static void on_end(int number, siginfo_t *info, void *context) {
    (void)context;
    gn_terminal_leave();
    for (int i = 0; i < ENDS; i++)
        if (ends[i] == number) sigaction(number, &own.old_ends[i], NULL);
    if (info->si_code <= 0 || number == SIGQUIT) raise(number);
}

static void on_readable(void *user, int64_t now_ns) {
    struct gn_terminal *t = user;
    t->readable = true;
    t->timer->due_ns = now_ns;
}

static void on_resumed(void *user, int64_t now_ns) {
    struct gn_terminal *t = user;
    t->resumed = true;
    t->timer->due_ns = now_ns;
}

static void watch_fd(struct gn_terminal *t, bool on) {
    if (t->reading == on) return;
    if (!on) gn_loop_remove(&t->watch);
    t->reading = on && gn_loop_add(t->loop, &t->watch);
}

void gn_terminal_leave(void) {
    if (own.open) set_raw(false);
}

/* ---- the source ---- */

static void resume_terminal(struct gn_terminal *t) {
    uint64_t count;
    t->resumed = false;
    (void)!read(t->wake_fd, &count, sizeof count);
    set_raw(true);
    watch_fd(t, is_foreground(t->fd));
}

/* Does nothing if standard input is no terminal, or another input has one open. */
static void open_terminal(struct gn_input *input, const struct gn_input_world *world,
                          int64_t now_ns, struct gn_warnings *warnings) {
    struct gn_loop *loop = input->opts.loop;
    const int fd = world->terminal ? *world->terminal : STDIN_FILENO;
    (void)now_ns, (void)warnings;
    if (!input->opts.terminal || own.open || !isatty(fd) || tcgetattr(fd, &own.saved)) return;
    struct gn_terminal *t = input->states[GN_SOURCE_terminal] = gn_xalloc(1, sizeof *t);
    *t = (struct gn_terminal){.fd = fd, .loop = loop, .timer = &input->timer};
    t->watch = (struct gn_watch){.fd = fd, .events = EPOLLIN, .call = on_readable, .user = t};
    t->wake_fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    t->wake = (struct gn_watch){.fd = t->wake_fd, .events = EPOLLIN, .call = on_resumed, .user = t};
    gn_loop_add(loop, &t->wake);
    own.fd = fd;
    own.wake_fd = t->wake_fd;
    own.raw = false;
    own.ours = own.saved;
    own.ours.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    own.ours.c_cc[VMIN] = 1;
    own.ours.c_cc[VTIME] = 0;
    struct sigaction end = {.sa_sigaction = on_end, .sa_flags = SA_SIGINFO | SA_ONSTACK};
    struct sigaction stop = {.sa_handler = on_stop, .sa_flags = SA_RESTART};
    struct sigaction resume = {.sa_handler = on_continue, .sa_flags = SA_RESTART};
    sigaction(SIGTSTP, NULL, &own.old_stop);
    if (own.old_stop.sa_handler != SIG_IGN) sigaction(SIGTSTP, &stop, NULL);
    sigaction(SIGCONT, &resume, &own.old_continue);
    for (int i = 0; i < ENDS; i++) {
        sigaction(ends[i], NULL, &own.old_ends[i]);
        if (own.old_ends[i].sa_handler != SIG_IGN) sigaction(ends[i], &end, NULL);
    }
    own.open = true;
    resume_terminal(t);
}

static void click_key(struct gn_input *input, unsigned key, int64_t now_ns) {
    const struct gn_terminal *t = input->states[GN_SOURCE_terminal];
    char type;
    if (key == GN_KEY_NONE) return;
    /* on a text console the terminal and the input device report the same key */
    if (gn_devices_have(&input->devices, key) && ioctl(t->fd, KDGKBTYPE, &type) == 0) return;
    gn_keys_click(&input->keys, key, now_ns);
}

static void read_terminal(struct gn_input *input, int64_t now_ns) {
    struct gn_terminal *t = input->states[GN_SOURCE_terminal];
    uint8_t bytes[256];
    if (!t) return;
    if (t->resumed) resume_terminal(t);
    if (!t->readable) return;
    t->readable = false;
    if (!is_foreground(t->fd)) { /* reading would stop us; SIGCONT reports the return */
        watch_fd(t, false);
        return;
    }
    const ssize_t count = read(t->fd, bytes, sizeof bytes);
    if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) watch_fd(t, false);
    for (ssize_t i = 0; i < count; i++)
        click_key(input, gn_terminal_keys_step(&t->keys, bytes[i], now_ns), now_ns);
}

static void step_terminal(struct gn_input *input, int64_t now_ns) {
    struct gn_terminal *t = input->states[GN_SOURCE_terminal];
    if (t) click_key(input, gn_terminal_keys_wait(&t->keys, now_ns), now_ns);
}

static int64_t terminal_deadline(const struct gn_input *input) {
    const struct gn_terminal *t = input->states[GN_SOURCE_terminal];
    return t ? gn_terminal_keys_deadline(&t->keys) : INT64_MAX;
}

static void close_terminal(struct gn_input *input) {
    struct gn_terminal *t = input->states[GN_SOURCE_terminal];
    if (!t) return;
    watch_fd(t, false);
    gn_loop_remove(&t->wake);
    set_raw(false);
    own.open = false;
    sigaction(SIGTSTP, &own.old_stop, NULL);
    sigaction(SIGCONT, &own.old_continue, NULL);
    for (int i = 0; i < ENDS; i++) sigaction(ends[i], &own.old_ends[i], NULL);
    if (t->wake_fd >= 0) close(t->wake_fd);
    free(t);
    input->states[GN_SOURCE_terminal] = NULL;
}

const struct gn_input_source gn_source_terminal = {
    .open = open_terminal,
    .read = read_terminal,
    .step = step_terminal,
    .deadline = terminal_deadline,
    .close = close_terminal,
};
