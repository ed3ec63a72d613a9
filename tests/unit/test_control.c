#include "unit/check.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "core/clock.h"
#include "unit/control_help.h"

/* ---- requests ------------------------------------------------------------------------------- */

static void each_line_has_its_reply_in_order(void **state) {
    (void)state;
    const int fd = enter_client();
    say(fd, "{\"cmd\":\"next\"}\n{\"cmd\":\"status\"}\nwhat\n{\"cmd\":\"pause\"}\n");
    assert_int_equal(serve(), 3);
    const char *text = heard(fd);
    assert_int_equal(count_lines(text), 4);
    const char *next = strstr(text, "{\"did\":\"next\",\"ok\":true}\n");
    const char *status = strstr(text, "\"status\",\"ok\":true}\n");
    const char *wrong = strstr(text, "\"ok\":false");
    const char *pause = strstr(text, "\"pause\"");
    assert_true(next && status && wrong && pause);
    assert_true(next < status && status < wrong && wrong < pause);
    close(fd);
}

static void a_line_may_come_in_pieces(void **state) {
    (void)state;
    static const char line[] = "{\"cmd\":\"mode\",\"name\":\"Soft\"}\n";
    const int fd = enter_client();
    for (const char *c = line; *c; c++) {
        assert_int_equal(send(fd, c, 1, 0), 1);
        assert_int_equal(serve(), *c == '\n');
    }
    assert_string_equal(heard(fd), "{\"did\":\"mode\",\"ok\":true}\n");
    close(fd);
}

static void the_last_line_needs_no_newline(void **state) {
    (void)state;
    const int fd = enter_client();
    say(fd, "{\"cmd\":\"next\"}\n{\"cmd\":\"prev\"}");
    shutdown(fd, SHUT_WR);
    assert_int_equal(serve(), 2);
    assert_int_equal(count_lines(heard(fd)), 2);
    assert_true(is_closed(fd));
    close(fd);
}

static void a_line_that_is_too_long_has_one_reply(void **state) {
    (void)state;
    char text[3 * GN_REQUEST_LINE_MAX];
    const int fd = enter_client();
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    say(fd, text);
    serve();
    say(fd, "\n{\"cmd\":\"next\"}\n");
    assert_int_equal(serve(), 1);
    const char *replies = heard(fd);
    assert_int_equal(count_lines(replies), 2);
    assert_non_null(strstr(replies, "longer than 4096 bytes"));
    assert_non_null(strstr(replies, "\"next\""));
    close(fd);
}

static void a_request_may_be_answered_later(void **state) {
    (void)state;
    const int slow = enter_client(), quick = enter_client();
    say(slow, "{\"cmd\":\"screenshot\",\"file\":\"/x.png\"}\n{\"cmd\":\"status\"}\n");
    step();
    const struct gn_request *later = gn_control_next(gn_ctl_test.control);
    assert_int_equal(later->command, GN_CTL_SCREENSHOT);
    say(quick, "{\"cmd\":\"status\"}\n");
    assert_int_equal(serve(), 1); /* the slow one's second waits behind its first */
    assert_int_equal(count_lines(heard(quick)), 1);
    assert_string_equal(later->words[0], "/x.png");
    gn_control_answer(gn_ctl_test.control, later, json_pack("{s:s}", "did", "it"));
    assert_int_equal(serve(), 1);
    assert_string_equal(heard(slow),
                        "{\"did\":\"it\",\"ok\":true}\n{\"did\":\"status\",\"ok\":true}\n");
    close(slow);
    close(quick);
}

static void who_has_gone_is_answered_in_vain(void **state) {
    (void)state;
    const int fd = enter_client();
    say(fd, "{\"cmd\":\"status\"}\n");
    step();
    const struct gn_request *r = gn_control_next(gn_ctl_test.control);
    close(fd);
    step();
    gn_control_answer(gn_ctl_test.control, r, json_object());
    serve();
    const int next = enter_client();
    say(next, "{\"cmd\":\"status\"}\n");
    assert_int_equal(serve(), 1);
    assert_int_equal(count_lines(heard(next)), 1);
    close(next);
}

/* ---- bounds --------------------------------------------------------------------------------- */

static void a_step_does_a_bounded_amount_of_work(void **state) {
    (void)state;
    char text[200 * 20] = "";
    const int fd = enter_client();
    for (int i = 0; i < 200; i++) strcat(text, "{}\n");
    say(fd, text);
    struct gn_control_counts before = gn_control_counts(gn_ctl_test.control);
    uint64_t most = 0;
    int steps = 0;
    for (; step(); steps++) {
        const struct gn_control_counts after = gn_control_counts(gn_ctl_test.control);
        if (after.requests - before.requests > most) most = after.requests - before.requests;
        before = after;
    }
    assert_int_equal(most, GN_CONTROL_PER_STEP);
    assert_in_range(steps, 200 / GN_CONTROL_PER_STEP, 40);
    assert_int_equal(count_lines(heard(fd)), 200);
    close(fd);
}

static void who_talks_all_the_time_keeps_nobody_waiting(void **state) {
    (void)state;
    char text[1000 * 4] = "";
    const int loud = enter_client(), quiet = enter_client();
    for (size_t i = 0; i < 999; i++) memcpy(text + 3 * i, "{}\n", 4);
    say(loud, text);
    step();
    say(quiet, "{\"cmd\":\"status\"}\n");
    for (int i = 0; i < 2; i++) step();
    const struct gn_request *r = gn_control_next(gn_ctl_test.control);
    assert_non_null(r);
    gn_control_answer(gn_ctl_test.control, r, json_object());
    assert_int_equal(count_lines(heard(quiet)), 1);
    int lines = 0;
    for (int i = 0; i < 100 && lines < 999; i++) {
        serve();
        lines += count_lines(heard(loud));
    }
    assert_int_equal(lines, 999);
    close(loud);
    close(quiet);
}

static void more_changes_than_a_frame_can_take_are_busy(void **state) {
    (void)state;
    const int fd = enter_client();
    for (int i = 0; i < 100; i++) say(fd, "{\"cmd\":\"next\"}\n");
    for (int i = 0; i < 50; i++) say(fd, "{\"cmd\":\"status\"}\n");
    assert_int_equal(serve(), GN_CONTROL_CHANGES_PER_S + 50);
    const char *text = heard(fd);
    assert_int_equal(count_lines(text), 150);
    assert_non_null(strstr(text, "{\"ok\":false,\"error\":\"busy\",\"status\":1}\n"));
    assert_int_equal(gn_control_counts(gn_ctl_test.control).busy, 100 - GN_CONTROL_CHANGES_PER_S);
    gn_ctl_test.now_ns += GN_NS_PER_S / 2;
    for (int i = 0; i < 100; i++) say(fd, "{\"cmd\":\"next\"}\n");
    assert_int_equal(serve(), GN_CONTROL_CHANGES_PER_S / 2);
    close(fd);
}

static void the_65th_client_is_told_so(void **state) {
    (void)state;
    const int places = GN_CONTROL_CLIENTS_MAX; /* of the kiosk's user */
    int fds[GN_CONTROL_CLIENTS_MAX + 1];
    for (int i = 0; i < places; i++) {
        fds[i] = enter_client();
        serve();
    }
    const int last = fds[places] = enter_client();
    serve();
    assert_string_equal(heard(last), "{\"ok\":false,\"error\":\"busy\",\"status\":1}\n");
    assert_true(is_closed(last));
    for (int i = 0; i < places; i++) say(fds[i], "{\"cmd\":\"status\"}\n");
    assert_int_equal(serve(), places);
    close(last);
    /* the one that has been silent for longest makes room */
    gn_ctl_test.now_ns += 31 * GN_NS_PER_S;
    for (int i = 1; i < places; i++) say(fds[i], "{\"cmd\":\"status\"}\n");
    serve();
    const int late = enter_client();
    say(late, "{\"cmd\":\"status\"}\n");
    assert_int_equal(serve(), 1);
    assert_int_equal(count_lines(heard(fds[0])), 1);
    assert_true(is_closed(fds[0]));
    for (int i = 0; i < places; i++) close(fds[i]);
    close(late);
}

/* As that user, in the socket's group. */
static int enter_as(uid_t uid) {
    assert_int_equal(seteuid(uid), 0);
    const int fd = enter_client();
    assert_int_equal(seteuid(0), 0);
    serve();
    return fd;
}

static bool is_answered(int fd) {
    if (send(fd, "{\"cmd\":\"status\"}\n", 17, MSG_NOSIGNAL) != 17) return false;
    serve();
    return strstr(heard(fd), "\"ok\":true") != NULL;
}

static void no_user_takes_the_places_of_others(void **state) {
    (void)state;
    enum { OTHERS = GN_CONTROL_CLIENTS_MAX - GN_CONTROL_KEPT };
    int fds[GN_CONTROL_CLIENTS_MAX];
    if (geteuid() != 0) skip();
    assert_int_equal(chmod(gn_ctl_test.folder, 0711), 0);
    for (int i = 0; i < OTHERS; i++) { /* each as many as he may have */
        const uid_t uid = (uid_t)(1001 + i / GN_CONTROL_USER_MAX);
        assert_true(is_answered(fds[i] = enter_as(uid)));
        if (i % GN_CONTROL_USER_MAX != GN_CONTROL_USER_MAX - 1) continue;
        const int more = enter_as(uid);
        assert_non_null(strstr(heard(more), "busy"));
        close(more);
    }
    const int more = enter_as(2000);
    assert_non_null(strstr(heard(more), "busy"));
    close(more);
    for (int i = OTHERS; i < GN_CONTROL_CLIENTS_MAX; i++)
        assert_true(is_answered(fds[i] = enter_as(0)));

    /* a user at his limit loses his own silent client, not another's */
    gn_ctl_test.now_ns += 31 * GN_NS_PER_S;
    for (int i = 2; i < GN_CONTROL_CLIENTS_MAX; i++)
        if (i != 20) assert_true(is_answered(fds[i]));
    const int late = enter_as(1002);
    assert_true(is_answered(late));
    assert_true(is_closed(fds[20]));
    assert_true(is_answered(fds[0]) && is_answered(fds[1]));
    close(late);
    for (int i = 0; i < GN_CONTROL_CLIENTS_MAX; i++) close(fds[i]);
}

static void others_use_up_no_changes_of_the_owner(void **state) {
    (void)state;
    if (geteuid() != 0) skip();
    assert_int_equal(chmod(gn_ctl_test.folder, 0711), 0);
    const int other = enter_as(1001), another = enter_as(1002), own = enter_as(0);
    for (int i = 0; i < 2 * GN_CONTROL_CHANGES_PER_S; i++)
        say(i % 2 ? other : another, "{\"cmd\":\"next\"}\n");
    assert_int_equal(serve(), GN_CONTROL_CHANGES_PER_S);
    for (int i = 0; i < 2 * GN_CONTROL_CHANGES_PER_S; i++) say(own, "{\"cmd\":\"next\"}\n");
    assert_int_equal(serve(), GN_CONTROL_CHANGES_PER_S);
    assert_non_null(strstr(heard(own), "\"next\",\"ok\":true"));
    close(other);
    close(another);
    close(own);
}

static void only_the_owner_names_a_scene_file(void **state) {
    (void)state;
    if (geteuid() != 0) skip();
    assert_int_equal(chmod(gn_ctl_test.folder, 0711), 0);
    const int other = enter_as(1001), own = enter_as(0);
    say(other, "{\"cmd\":\"scene\",\"file\":\"/x.glb\"}\n{\"cmd\":\"rollback\"}\n");
    say(own, "{\"cmd\":\"scene\",\"file\":\"/x.glb\"}\n");
    assert_int_equal(serve(), 2);
    const char *got = heard(other);
    assert_non_null(strstr(got, "permission denied"));
    assert_non_null(strstr(got, "\"rollback\",\"ok\":true"));
    assert_non_null(strstr(heard(own), "\"scene\",\"ok\":true"));
    close(other);
    close(own);
}

static void who_does_not_read_is_cut_off(void **state) {
    (void)state;
    const int fd = enter_client(), other = enter_client();
    int sent = 0;
    for (int rest = 1;
         rest;) { /* until its replies fill the socket, and the server stops reading */
        while (send(fd, "{}\n", 3, MSG_NOSIGNAL) == 3) sent++;
        const uint64_t before = gn_control_counts(gn_ctl_test.control).requests;
        serve();
        rest = gn_control_counts(gn_ctl_test.control).requests != before;
    }
    assert_int_equal(gn_control_counts(gn_ctl_test.control).cut, 0);
    assert_true(gn_control_counts(gn_ctl_test.control).requests < (uint64_t)sent);
    say(other, "{\"cmd\":\"status\"}\n");
    assert_int_equal(serve(), 1);
    gn_ctl_test.now_ns += 5 * GN_NS_PER_S;
    step();
    assert_int_equal(gn_control_counts(gn_ctl_test.control).cut, 1);
    assert_int_equal(count_lines(heard(other)), 1);
    close(fd);
    close(other);
}

/* Without a descriptor left the listener would be readable for ever. */
static void without_descriptors_nobody_spins(void **state) {
    (void)state;
    int hogs[100], count = 0;
    struct rlimit before;
    getrlimit(RLIMIT_NOFILE, &before);
    const struct rlimit few = {64, before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &few), 0);
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    while (count < 100 && (hogs[count] = open("/dev/null", O_RDONLY)) >= 0) count++;
    assert_in_range(count, 1, 64);
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(address.sun_path, sizeof address.sun_path, "%s", gn_ctl_test.path);
    assert_int_equal(connect(fd, (struct sockaddr *)&address, sizeof address), 0);
    serve();
    while (count) close(hogs[--count]);
    setrlimit(RLIMIT_NOFILE, &before);
    assert_non_null(strstr(heard(fd), "busy"));
    assert_true(is_closed(fd));
    close(fd);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, gn_ctl_test_open, gn_ctl_test_close)

int main(void) {
    signal(SIGPIPE, SIG_IGN);
    const struct CMUnitTest tests[] = {
        TEST(each_line_has_its_reply_in_order),
        TEST(a_line_may_come_in_pieces),
        TEST(the_last_line_needs_no_newline),
        TEST(a_line_that_is_too_long_has_one_reply),
        TEST(a_request_may_be_answered_later),
        TEST(who_has_gone_is_answered_in_vain),
        TEST(a_step_does_a_bounded_amount_of_work),
        TEST(who_talks_all_the_time_keeps_nobody_waiting),
        TEST(more_changes_than_a_frame_can_take_are_busy),
        TEST(the_65th_client_is_told_so),
        TEST(no_user_takes_the_places_of_others),
        TEST(others_use_up_no_changes_of_the_owner),
        TEST(only_the_owner_names_a_scene_file),
        TEST(who_does_not_read_is_cut_off),
        TEST(without_descriptors_nobody_spins),
    };
    return cmocka_run_group_tests(tests, gn_ctl_test_begin, gn_ctl_test_end);
}
