#include "core/stop.h"

#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <stddef.h>
#include <sys/signalfd.h>
#include <time.h>
#include <unistd.h>

/* Both signals but those that are ignored: a blocked one would come in spite of that. */
static void set_stop_signals(sigset_t *signals) {
    static const int numbers[] = {SIGTERM, SIGINT};
    struct sigaction old;
    sigemptyset(signals);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (sigaction(numbers[i], NULL, &old) != 0 || old.sa_handler != SIG_IGN)
            sigaddset(signals, numbers[i]);
}

void gn_stop_block(void) {
    sigset_t signals;
    set_stop_signals(&signals);
    sigprocmask(SIG_BLOCK, &signals, NULL);
}

void gn_stop_signals(sigset_t *signals) {
    sigemptyset(signals);
    sigaddset(signals, SIGTERM);
    sigaddset(signals, SIGINT);
    sigaddset(signals, SIGHUP);
}

bool gn_stop_asked(void) {
    sigset_t pending;
    sigpending(&pending);
    return sigismember(&pending, SIGTERM) || sigismember(&pending, SIGINT);
}

/* ---- the thread that ends the process -------------------------------------------------------- */

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static const char *temporary_path; /* under the mutex, as are these two */
static void (*restore_call)(void *);
static void *restore_user;

void gn_stop_hold(void) { pthread_mutex_lock(&mutex); }

void gn_stop_release(const char *temporary) {
    temporary_path = temporary;
    pthread_mutex_unlock(&mutex);
}

void gn_stop_set_restore(void (*restore)(void *), void *user) {
    gn_stop_hold();
    restore_call = restore;
    restore_user = user;
    pthread_mutex_unlock(&mutex);
}

static _Noreturn void end_process(int status) {
    gn_stop_hold(); /* never released: nothing is renamed any more */
    if (temporary_path) unlink(temporary_path);
    if (restore_call) restore_call(restore_user);
    _exit(status);
}

static void *wait_for_signal(void *started) {
    sigset_t signals;
    int number = 0;
    set_stop_signals(&signals);
    sem_post(started);
    while (sigwait(&signals, &number) != 0) {
    }
    end_process(128 + number);
}

/* A thread without the process's stop signals that calls run(started), which posts started. */
static bool start_thread(void *(*run)(void *), sem_t *started) {
    enum { STACK_BYTES = 256 << 10 };
    pthread_t thread;
    pthread_attr_t attributes;
    sem_init(started, 0, 0);
    pthread_attr_init(&attributes);
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    const bool runs = pthread_create(&thread, &attributes, run, started) == 0;
    pthread_attr_destroy(&attributes);
    /* A child forked while the thread starts would inherit the locks that it holds then. */
    while (runs && sem_wait(started) != 0) {
    }
    return runs;
}

void gn_stop_end_process(void) {
    static sem_t started; /* static: the thread may still be in sem_post() when this returns */
    if (start_thread(wait_for_signal, &started)) return;
    sigset_t signals; /* without a thread the kernel ends the process, and the file stays */
    set_stop_signals(&signals);
    sigprocmask(SIG_UNBLOCK, &signals, NULL);
}

enum { LATE_STEP_NS = 50000000 };
static int64_t late_ns;

static void *wait_for_loop(void *started) {
    sigset_t signals;
    sigfillset(&signals); /* the loop blocks more than both, after this thread began */
    pthread_sigmask(SIG_SETMASK, &signals, NULL);
    set_stop_signals(&signals);
    /* readable while a signal is pending; never read: the loop takes it */
    struct pollfd pending = {.fd = signalfd(-1, &signals, SFD_CLOEXEC), .events = POLLIN};
    sem_post(started);
    while (pending.fd >= 0) {
        if (poll(&pending, 1, -1) < 1) continue;
        for (int64_t left_ns = late_ns; gn_stop_asked(); left_ns -= LATE_STEP_NS) {
            if (left_ns <= 0) end_process(0);
            nanosleep(&(struct timespec){.tv_nsec = LATE_STEP_NS}, NULL);
        }
    }
    return NULL;
}

/* Those that end a process by default and that nothing here sends. A driver or library that wants
 * one installs its handler later. */
static void ignore_other_signals(void) {
    static const int numbers[] = {SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO, SIGPWR};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) signal(numbers[i], SIG_IGN);
    for (int number = SIGRTMIN; number <= SIGRTMAX; number++) signal(number, SIG_IGN);
}

void gn_stop_end_late(int64_t after_ns) {
    static sem_t started;
    ignore_other_signals();
    late_ns = after_ns;
    start_thread(wait_for_loop, &started);
}
