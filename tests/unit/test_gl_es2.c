/* Alone in its process: a driver looks at the override once. */
#include <stdlib.h>
#include <string.h>

#include "unit/check.h"
#include "unit/gl_help.h"

static void test_es2(void **state) {
    (void)state;
    struct gn_display display;
    setenv("MESA_GLES_VERSION_OVERRIDE", "2.0", 1);
    help_open(&display, "egl");
    struct gn_err err = {0};
    struct gn_gl_opts opts = {.get_proc = gn_display_get_proc, .display = &display};
    struct gn_gl *gl = gn_gl_create(&opts, NULL, &err);
    if (gl)
        print_message("not Mesa: the override has no effect\n");
    else
        assert_non_null(strstr(err.text, " has only OpenGL ES 2.0; gnomon needs 3.0 (Pi 4/5,"));
    gn_gl_destroy(gl);
    gn_display_close(&display);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_es2)};
    return RUN(tests);
}
