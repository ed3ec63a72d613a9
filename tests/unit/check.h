/* What every cmocka program includes, in the order that cmocka wants. */
#ifndef GN_UNIT_CHECK_H
#define GN_UNIT_CHECK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define RUN(tests) cmocka_run_group_tests(tests, NULL, NULL)

#endif
