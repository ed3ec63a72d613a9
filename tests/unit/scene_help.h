/* What tests of the loader stand on: a maker, and what loading from it says. */
#ifndef GN_TESTS_UNIT_SCENE_HELP_H
#define GN_TESTS_UNIT_SCENE_HELP_H

#include <math.h>
#include <string.h>

#include "unit/check.h"
#include "unit/gltf_maker.h"

static struct gn_maker maker;
static struct gn_err err;
static struct gn_warnings warnings;

/* A setup: the square of gn_maker_square(). */
static inline int setup(void **state) {
    (void)state;
    memset(&warnings, 0, sizeof warnings);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    return 0;
}

static inline struct gn_scene *load(void) {
    struct gn_scene *scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

static inline void assert_near(float a, float b) {
    if (!(fabsf(a - b) < 1e-5f)) fail_msg("%g is not %g", (double)a, (double)b);
}

#endif
