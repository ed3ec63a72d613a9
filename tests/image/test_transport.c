/* A transport of requests beside the control socket: each request is answered once, through who
 * brought it, though there is no socket; and not at all once its transport is gone. */
#include "unit/check.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/control/answer.h"
#include "kiosk/private.h"
#include "kiosk/screenshot.h"
#include "unit/show_help.h"

static const int64_t PATIENCE_NS = 60 * GN_NS_PER_S;

struct pigeon {
    struct gn_request request;
    int answers;
    json_t *reply; /* the last */
    struct gn_transport transport;
};

static void carry(void *self, const struct gn_request *request, json_t *reply) {
    struct pigeon *p = self;
    assert_ptr_equal(request, &p->request);
    assert_non_null(reply);
    json_decref(p->reply);
    p->reply = reply;
    p->answers++;
}

/* fd: passed along, or -1 */
static void ask_with(struct gn_show *show, struct pigeon *p, const char *line, int fd) {
    struct gn_err err = {0};
    if (!gn_request_parse(line, strlen(line), &p->request, &err)) fail_msg("%s", err.text);
    p->request.fd = fd;
    p->transport = (struct gn_transport){.self = p, .answer = carry};
    gn_show_take_request(show, &p->transport, &p->request);
}

static void ask(struct gn_show *show, struct pigeon *p, const char *line) {
    ask_with(show, p, line, -1);
}

static void ask_for_screenshot(struct gn_show *show, struct pigeon *p, int fd) {
    ask_with(show, p, "{\"cmd\":\"screenshot\",\"file\":\"/seen.png\"}", fd);
}

static void until_answered(struct gn_show *show, const struct pigeon *p, int answers) {
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (p->answers < answers) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_int_equal(p->answers, answers);
}

static const char *error_of(const struct pigeon *p) {
    const char *error = json_string_value(json_object_get(p->reply, "error"));
    return error ? error : "";
}

/* Without a socket: XDG_RUNTIME_DIR names no folder. */
static struct gn_show *open_show(void) {
    setenv("XDG_RUNTIME_DIR", "/nowhere", 1);
    struct gn_show *show = help_show(
        (const char *const[]){"--size", "64x64", "--no-animation", "--shadow", "none", NULL});
    const struct gn_part *control = show->parts.rows[GN_PART_control];
    assert_null(control->status(show->parts.of[GN_PART_control]));
    return show;
}

static void requests_are_answered_at_once_or_later(void **state) {
    (void)state;
    struct gn_show *show = open_show();
    struct pigeon one = {0}, other = {0};
    ask(show, &one, "{\"cmd\":\"status\"}");
    assert_int_equal(one.answers, 1);
    assert_non_null(json_object_get(one.reply, "mode"));
    ask(show, &one, "{\"cmd\":\"mode\",\"name\":\"no such one\"}");
    assert_int_equal(one.answers, 2);
    assert_true(error_of(&one)[0] && json_is_false(json_object_get(one.reply, "ok")));

    ask(show, &one, "{\"cmd\":\"reload\"}");
    assert_int_equal(one.answers, 2);
    ask(show, &other, "{\"cmd\":\"reload\"}"); /* which replaces that of the first */
    assert_int_equal(one.answers, 3);
    assert_string_equal(error_of(&one), "a later reload replaces this one");
    until_answered(show, &other, 1);
    assert_string_equal(error_of(&other), "");
    assert_int_equal(one.answers, 3);
    gn_show_close(show);
    json_decref(one.reply);
    json_decref(other.reply);
}

static void a_screenshot_comes_later_and_one_at_a_time(void **state) {
    (void)state;
    struct gn_show *show = open_show();
    struct pigeon one = {0}, other = {0};
    const int fd = memfd_create("seen", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    char begin[8] = "";
    assert_true(fd >= 0);
    ask_for_screenshot(show, &one, fd);
    assert_int_equal(one.answers, 0);
    ask_for_screenshot(show, &other, fd);
    assert_int_equal(other.answers, 1);
    assert_string_equal(error_of(&other), "busy");
    until_answered(show, &one, 1);
    assert_string_equal(error_of(&one), "");
    assert_int_equal(pread(fd, begin, 4, 0), 4);
    assert_memory_equal(begin, "\x89PNG", 4);
    gn_show_close(show);
    close(fd);
    json_decref(one.reply);
    json_decref(other.reply);
}

static void a_transport_that_is_gone_gets_no_answer(void **state) {
    (void)state;
    struct gn_show *show = open_show();
    struct pigeon gone = {0}, other = {0};
    const int fd = memfd_create("seen", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    assert_true(fd >= 0);
    ask(show, &gone, "{\"cmd\":\"reload\"}");
    gn_show_forget_requests(show, &other.transport); /* that of another one stays */
    gn_show_forget_requests(show, &gone.transport);
    ask_for_screenshot(show, &gone, fd);
    gn_show_forget_requests(show, &gone.transport);
    assert_true(!show->screenshot || !gn_screenshot_is_busy(show->screenshot));
    close(fd); /* nothing writes to it any more */
    const int next = memfd_create("next", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    ask_for_screenshot(show, &other, next);
    until_answered(show, &other, 1);
    assert_string_equal(error_of(&other), "");
    ask(show, &other, "{\"cmd\":\"reload\"}");
    until_answered(show, &other, 2);
    assert_int_equal(gone.answers, 0);
    close(next);
    gn_show_close(show);
    json_decref(other.reply);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(requests_are_answered_at_once_or_later),
        cmocka_unit_test(a_screenshot_comes_later_and_one_at_a_time),
        cmocka_unit_test(a_transport_that_is_gone_gets_no_answer),
    };
    return RUN(tests);
}
