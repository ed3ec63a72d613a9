/* A request is the name with its zero byte; the reply is the reason why it is not opened with its
 * zero byte: "" comes with the descriptor. */
#include "core/opener.h"

#include <errno.h>
#include <limits.h>
#include <stdint.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include "core/file.h"

union passed { /* one descriptor beside a message, aligned */
    struct cmsghdr header;
    char bytes[CMSG_SPACE(sizeof(int))];
};

ssize_t gn_send_with(int socket, const void *data, size_t size, int fd, int flags) {
    union passed passed = {.header = {.cmsg_len = CMSG_LEN(sizeof fd),
                                      .cmsg_level = SOL_SOCKET,
                                      .cmsg_type = SCM_RIGHTS}};
    struct iovec piece = {(void *)(uintptr_t)data, size};
    struct msghdr message = {.msg_iov = &piece, .msg_iovlen = 1};
    if (fd >= 0) {
        memcpy(CMSG_DATA(&passed.header), &fd, sizeof fd);
        message.msg_control = &passed;
        message.msg_controllen = sizeof passed;
    }
    return sendmsg(socket, &message, flags);
}

void gn_opener_serve(const struct gn_opener *opener) {
    char name[PATH_MAX];
    struct gn_err why = {0};
    const ssize_t size = recv(opener->socket, name, sizeof name, MSG_DONTWAIT);
    if (size <= 0 || name[size - 1] != 0)
        return; /* none, or one that gn_opener_ask() cannot send */
    const int fd = name[0] ? gn_file_open_beneath(opener->folder, name, &why)
                           : gn_file_open(opener->file, &why);
    (void)!gn_send_with(opener->socket, why.text, strlen(why.text) + 1, fd,
                        MSG_DONTWAIT | MSG_NOSIGNAL);
    if (fd >= 0) close(fd);
}

int gn_opener_ask(int socket, const char *name, struct gn_err *err) {
    char why[sizeof err->text] = "";
    union passed passed;
    struct iovec piece = {why, sizeof why};
    struct msghdr message = {.msg_iov = &piece,
                             .msg_iovlen = 1,
                             .msg_control = &passed,
                             .msg_controllen = sizeof passed};
    const size_t size = strlen(name) + 1;
    ssize_t got;
    int fd = -1;
    errno = ENAMETOOLONG;
    if (size <= PATH_MAX && write(socket, name, size) == (ssize_t)size) {
        do got = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
        while (got < 0 && errno == EINTR);
        const struct cmsghdr *header = got > 0 ? CMSG_FIRSTHDR(&message) : NULL;
        if (header && header->cmsg_type == SCM_RIGHTS) memcpy(&fd, CMSG_DATA(header), sizeof fd);
        if (got == 0) errno = ECONNRESET;
    }
    why[sizeof why - 1] = 0;
    if (fd < 0) gn_fail(err, "%s", why[0] ? why : strerror(errno));
    return fd;
}
