#include "core/thread.h"

#include <pthread.h>
#include <sys/resource.h>

int gn_thread_start_detached(void *(*run)(void *), void *argument) {
    pthread_t thread;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    const int error = pthread_create(&thread, &attributes, run, argument);
    pthread_attr_destroy(&attributes);
    return error;
}

void gn_thread_lower_priority(void) { setpriority(PRIO_PROCESS, 0, 10); }
