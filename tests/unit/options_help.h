/* What tests of the options work on. */
#ifndef GN_TESTS_UNIT_OPTIONS_HELP_H
#define GN_TESTS_UNIT_OPTIONS_HELP_H

#include <stdlib.h>

#include "core/warn.h"
#include "options/options.h"
#include "unit/check.h"

static struct gn_options options;
static struct gn_warnings warnings;
static struct gn_err err;

static inline void assert_shadow(const char *name) {
    const struct gn_technique_list *list = &options.settings->render.shadow;
    assert_int_equal(list->count, 1);
    assert_string_equal(gn_techniques[list->items[0]].name, name);
}

/* A teardown. */
static inline int clean(void **state) {
    (void)state;
    gn_options_finish(&options);
    return 0;
}

/* Of a group: no file of the user's is found. */
static inline int without_home(void **state) {
    (void)state;
    unsetenv("HOME");
    setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
    return 0;
}

#endif
