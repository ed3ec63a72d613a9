#include "kiosk/control/passed.h"

#include <fcntl.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/thread.h"

/* While more closing threads wait, descriptors are not received: then the kernel drops them, which
 * waits for nobody, since no process has had them. */
enum { THREADS_MAX = 4 };
static atomic_int threads;

static void *close_in_thread(void *user) {
    close((int)(intptr_t)user);
    atomic_fetch_sub(&threads, 1);
    return NULL;
}

static void close_aside(int fd) {
    void *argument = (void *)(intptr_t)fd;
    atomic_fetch_add(&threads, 1);
    if (gn_thread_start_detached(close_in_thread, argument) != 0) close_in_thread(argument);
}

void gn_passed_close(int fd) {
    enum { LARGE_BLOCKS = (16 << 20) / 512 };
    struct stat info;
    if (fstat(fd, &info) == 0 && info.st_blocks > LARGE_BLOCKS)
        close_aside(fd);
    else
        close(fd);
}

void gn_passed_close_socket(int socket) {
    char byte;
    if (atomic_load(&threads) < THREADS_MAX &&
        recv(socket, &byte, sizeof byte, MSG_PEEK | MSG_DONTWAIT) > 0)
        close_aside(socket);
    else
        close(socket);
}

/* Keeps the first memory file. Only those have seals. */
static int take_descriptors(struct msghdr *message) {
    int kept = -1;
    for (struct cmsghdr *c = CMSG_FIRSTHDR(message); c; c = CMSG_NXTHDR(message, c)) {
        if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_RIGHTS) continue;
        for (size_t at = CMSG_LEN(0); at + sizeof(int) <= c->cmsg_len; at += sizeof(int)) {
            int fd;
            memcpy(&fd, (const char *)c + at, sizeof fd);
            const int is_memory = fcntl(fd, F_GET_SEALS) >= 0;
            if (is_memory && kept < 0)
                kept = fd;
            else if (is_memory)
                gn_passed_close(fd);
            else
                close_aside(fd);
        }
    }
    return kept;
}

ssize_t gn_passed_receive(int socket, void *to, size_t room, int *passed) {
    union {
        struct cmsghdr header;
        char bytes[CMSG_SPACE(sizeof(int))];
    } control;
    struct iovec piece = {to, room};
    struct msghdr message = {.msg_iov = &piece, .msg_iovlen = 1};
    *passed = -1;
    if (atomic_load(&threads) < THREADS_MAX) {
        message.msg_control = &control;
        message.msg_controllen = sizeof control;
    }
    const ssize_t got = recvmsg(socket, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
    if (got >= 0) *passed = take_descriptors(&message);
    return got;
}
