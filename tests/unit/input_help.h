/* What tests of an input ask of it. */
#ifndef GN_TESTS_UNIT_INPUT_HELP_H
#define GN_TESTS_UNIT_INPUT_HELP_H

#include <string.h>

#include "input/private.h"
#include "unit/check.h"

static struct gn_input *input;
static struct gn_loop *loop;

static inline void assert_nothing(void) {
    struct gn_gesture_event event;
    if (gn_input_next(input, &event)) fail_msg("%s", gn_gesture_names[event.gesture]);
}

static inline void assert_report(const char *says) {
    char text[GN_REPORT_SIZE];
    if (!gn_input_report(input, text, sizeof text)) fail_msg("nothing is said of %s", says);
    if (!strstr(text, says)) fail_msg("\"%s\" does not say %s", text, says);
}

#endif
