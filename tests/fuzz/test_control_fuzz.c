/* The control socket and whoever hates it: random bytes, lines in pieces, floods, clients that hang
 * up, never read or come in hordes. What must hold: the server answers every line of those who
 * behave with one line, in order, and neither crashes nor blocks nor keeps anything. The seed is
 * printed; GN_SEED=N repeats it. */
#include "unit/check.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/clock.h"
#include "image/shot.h"
#include "unit/control_help.h"

static uint64_t random_state;

static uint32_t roll(void) { /* xorshift64*, Vigna 2014 */
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return (uint32_t)(random_state * UINT64_C(2685821657736338717) >> 32);
}
static uint32_t below(uint32_t n) { return roll() % n; }

static int rounds(int quick) { return gn_shot_full() ? 8 * quick : quick; }

/* ---- lines ---------------------------------------------------------------------------------- */

static const char *const good[] = {
    "{\"cmd\":\"status\"}",
    "{\"cmd\":\"mode\",\"name\":\"Soft \\u00e9\"}",
    "{\"cmd\":\"set\",\"key\":\"exposure\",\"value\":-2.5}",
    " { \"cmd\" : \"quit\" } ",
    "{\"cmd\":\"get\",\"key\":\"shadow\"}",
    "{\"cmd\":\"screenshot\",\"file\":\"/x.png\"}",
};
enum { GOOD = sizeof good / sizeof good[0] };

/* A line without a newline in it, of at most `most` bytes: a good one, a spoilt one, or noise. */
static size_t make_line(char *out, size_t most) {
    const uint32_t kind = below(4);
    size_t length = 0;
    if (kind < 3) {
        const char *from = good[below(GOOD)];
        length = strlen(from);
        memcpy(out, from, length);
        for (uint32_t i = kind == 0 ? 0 : 1 + below(4); i > 0; i--) {
            const size_t at = below((uint32_t)length);
            switch (below(3)) {
            case 0: out[at] = (char)roll(); break;
            case 1: memmove(out + at, out + at + 1, --length - at); break;
            default: out[at] = "{}[]\",:\\\0\xff"[below(10)];
            }
        }
    } else {
        length = below((uint32_t)most);
        for (size_t i = 0; i < length; i++) out[i] = (char)roll();
    }
    for (size_t i = 0; i < length; i++)
        if (out[i] == '\n') out[i] = ' ';
    return length;
}

/* ---- one client, many lines ----------------------------------------------------------------- */

struct talk {
    int fd;
    char *out;
    size_t size, sent;
    int lines, replies;
    bool bad; /* a reply that is none */
};

static void make_talk(struct talk *t, int lines, size_t most) {
    t->fd = enter_client();
    t->out = malloc((size_t)lines * (most + 64));
    t->size = t->sent = 0;
    t->lines = lines;
    t->replies = 0;
    t->bad = false;
    for (int i = 0; i < lines; i++) {
        t->size += make_line(t->out + t->size, most);
        t->out[t->size++] = '\n';
    }
}

static void send_piece(struct talk *t) {
    const size_t left = t->size - t->sent, piece = 1 + below(below(2) ? 7 : 9000);
    const ssize_t sent =
        send(t->fd, t->out + t->sent, piece < left ? piece : left, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) t->sent += (size_t)sent;
}

/* Whole lines of the reply are JSON objects with "ok". */
static void read_replies(struct talk *t) {
    static char text[65536];
    const ssize_t got = recv(t->fd, text, sizeof text, MSG_DONTWAIT | MSG_PEEK);
    if (got <= 0) return;
    size_t used = 0;
    for (char *line = text; line < text + got;) {
        char *newline = memchr(line, '\n', (size_t)(text + got - line));
        if (!newline) break;
        json_t *reply = json_loadb(line, (size_t)(newline - line), 0, NULL);
        t->bad |= !json_is_boolean(json_object_get(reply, "ok"));
        json_decref(reply);
        t->replies++;
        line = newline + 1;
        used = (size_t)(line - text);
    }
    assert_int_equal(recv(t->fd, text, used, 0), used);
}

static void every_line_has_one_reply_whatever_is_in_it(void **state) {
    (void)state;
    for (int round = 0; round < rounds(40); round++) {
        struct talk talks[8];
        const int count = 1 + (int)below(8);
        bool done = false;
        for (int i = 0; i < count; i++) make_talk(&talks[i], 1 + (int)below(60), 3000);
        for (int step = 0; step < 200000 && !done; step++) {
            struct talk *t = &talks[below((uint32_t)count)];
            send_piece(t);
            serve();
            read_replies(t);
            done = true;
            for (int i = 0; i < count; i++) done &= talks[i].replies == talks[i].lines;
        }
        for (int i = 0; i < count; i++) {
            assert_int_equal(talks[i].replies, talks[i].lines);
            assert_false(talks[i].bad);
            close(talks[i].fd);
            free(talks[i].out);
        }
        gn_ctl_test.now_ns = gn_clock_monotonic_ns();
        serve();
    }
    assert_int_equal(gn_control_counts(gn_ctl_test.control).cut, 0);
}

/* ---- those who do not behave ---------------------------------------------------------------- */

static int count_descriptors(void) {
    int count = 0;
    DIR *folder = opendir("/proc/self/fd");
    while (folder && readdir(folder)) count++;
    if (folder) closedir(folder);
    return count;
}

/* With so many descriptors of /dev/null. */
static ssize_t send_with(int fd, void *data, size_t size, int count) {
    union {
        struct cmsghdr header;
        char bytes[CMSG_SPACE(8 * sizeof(int))];
    } control = {.header = {.cmsg_len = CMSG_LEN((size_t)count * sizeof(int)),
                            .cmsg_level = SOL_SOCKET,
                            .cmsg_type = SCM_RIGHTS}};
    const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
    for (int i = 0; i < count; i++)
        memcpy(CMSG_DATA(&control.header) + (size_t)i * sizeof null, &null, sizeof null);
    struct iovec piece = {data, size};
    struct msghdr message = {.msg_iov = &piece, .msg_iovlen = 1};
    if (count) message.msg_control = &control;
    if (count) message.msg_controllen = CMSG_SPACE((size_t)count * sizeof(int));
    const ssize_t sent = sendmsg(fd, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    const int reason = errno;
    close(null);
    errno = reason;
    return sent;
}

/* They send anything, descriptors too, in pieces, close in the middle, shut one direction, never
 * read; among them one that behaves, and is answered. */
static void one_who_behaves_is_answered_amid_those_who_do_not(void **state) {
    enum { HORDE = 90 };
    int horde[HORDE];
    char noise[20000];
    (void)state;
    const int before = count_descriptors();
    memset(horde, -1, sizeof horde);
    const int fd = enter_client();
    serve();
    for (int round = 0; round < rounds(3000); round++) {
        int *one = &horde[below(HORDE)];
        const uint32_t what = below(10);
        if (*one < 0) {
            *one = connect_to(gn_ctl_test.path);
        } else if (what < 6) {
            const size_t size = below(what ? 300 : sizeof noise);
            for (size_t i = 0; i < size; i++)
                noise[i] = below(20) ? (char)roll() : "\n{}\"[]"[below(6)];
            if (send_with(*one, noise, size, below(4) ? 0 : 1 + (int)below(8)) < 0 &&
                errno == EPIPE) {
                close(*one);
                *one = -1;
            }
        } else if (what == 6) {
            shutdown(*one, below(2) ? SHUT_WR : SHUT_RD);
        } else if (what == 7) {
            if (recv(*one, noise, sizeof noise, MSG_DONTWAIT) < 0) continue;
        } else {
            close(*one);
            *one = -1;
        }
        if (below(3)) serve();
        if (round % 50) continue;
        say(fd, "{\"cmd\":\"status\"}\n");
        serve();
        assert_string_equal(heard(fd), "{\"did\":\"status\",\"ok\":true}\n");
    }
    for (int i = 0; i < HORDE; i++)
        if (horde[i] >= 0) close(horde[i]);
    close(fd);
    serve();
    for (int i = 0; i < 100 && count_descriptors() != before; i++) usleep(20000); /* in threads */
    assert_int_equal(count_descriptors(), before);
}

/* A flood that nobody reads takes a bounded amount of memory and ends when it is cut. */
static void a_flood_is_held_back_and_cut(void **state) {
    enum { FLOODS = 16 };
    int fds[FLOODS];
    char block[65536];
    uint64_t pushed = 0;
    (void)state;
    for (size_t i = 0; i < sizeof block; i++) block[i] = i % 3 == 2 ? '\n' : '{';
    for (int i = 0; i < FLOODS; i++) fds[i] = enter_client();
    for (int round = 0; round < rounds(50); round++) {
        for (int i = 0; i < FLOODS; i++) {
            const ssize_t sent = send(fds[i], block, sizeof block, MSG_NOSIGNAL | MSG_DONTWAIT);
            if (sent > 0) pushed += (uint64_t)sent;
        }
        serve();
    }
    /* what is on its way is in the sockets alone: each holds some hundred kilobytes */
    assert_true(pushed < (uint64_t)FLOODS * 2 * 1024 * 1024);
    gn_ctl_test.now_ns += 6 * GN_NS_PER_S;
    step();
    assert_int_equal(gn_control_counts(gn_ctl_test.control).cut, FLOODS);
    for (int i = 0; i < FLOODS; i++) close(fds[i]);
    gn_ctl_test.now_ns = gn_clock_monotonic_ns();
    const int fd = enter_client();
    say(fd, "{\"cmd\":\"status\"}\n");
    serve();
    assert_string_equal(heard(fd), "{\"did\":\"status\",\"ok\":true}\n");
    close(fd);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, gn_ctl_test_open, gn_ctl_test_close)

int main(void) {
    const char *seed = getenv("GN_SEED");
    random_state = seed ? strtoull(seed, NULL, 10) : (uint64_t)gn_clock_monotonic_ns() | 1;
    printf("GN_SEED=%llu\n", (unsigned long long)random_state);
    fflush(stdout);
    signal(SIGPIPE, SIG_IGN);
    const struct CMUnitTest tests[] = {
        TEST(every_line_has_one_reply_whatever_is_in_it),
        TEST(one_who_behaves_is_answered_amid_those_who_do_not),
        TEST(a_flood_is_held_back_and_cut),
    };
    return cmocka_run_group_tests(tests, gn_ctl_test_begin, gn_ctl_test_end);
}
