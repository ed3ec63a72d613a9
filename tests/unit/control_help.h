/* Both ends of a control socket in one process, with time in the test's hand. */
#ifndef GN_UNIT_CONTROL_HELP_H
#define GN_UNIT_CONTROL_HELP_H

#include <stdbool.h>

#include "kiosk/control/control.h"

extern struct gn_ctl_test {
    struct gn_loop *loop; /* now_ns is its clock */
    struct gn_control *control;
    int64_t now_ns;
    struct gn_err err;
    char folder[40], path[80];
} gn_ctl_test;

/* For cmocka: of the group, of a test. */
int gn_ctl_test_begin(void **state);
int gn_ctl_test_end(void **state);
int gn_ctl_test_open(void **state);
int gn_ctl_test_close(void **state);

int connect_to(const char *path); /* a descriptor that does not block, or -1 */
int enter_client(void);
bool is_readable(int fd);
bool step(void); /* of the loop; true: there was something to do */
/* As a kiosk does: steps while there is anything to do, and answers {"did":COMMAND}. How many.
 */
int serve(void);
void say(int fd, const char *text);
const char *heard(int fd); /* all that is there, until the next call */
bool is_closed(int fd);
int count_lines(const char *text);

#endif
