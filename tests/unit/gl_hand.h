/* For tests that draw plans made by hand: what each such program has of its own. */
#ifndef GN_TESTS_GL_HAND_H
#define GN_TESTS_GL_HAND_H

#include <stdlib.h>
#include <string.h>

#include "gl/private.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { SIDE = 16, MAP = 8 };

static const char *shaders;
static struct gn_display display;
static struct gn_gl *gl;
static struct gn_warnings warnings;
static struct gn_err err;

static inline void open_backend(const char *name) {
    help_open(&display, name);
    memset(&warnings, 0, sizeof warnings);
    gl = help_gl(&display, &(struct gn_gl_opts){.shaders = shaders}, &warnings);
    if (!gn_gl_load(gl, &help_scene, &err)) fail_msg("%s", err.text);
}

static inline int open_egl(void **state) {
    (void)state;
    shaders = help_shaders();
    open_backend("egl");
    return 0;
}

static inline int open_osmesa(void **state) {
    (void)state;
    shaders = help_shaders();
    open_backend("osmesa");
    return 0;
}

static inline int close_all(void **state) {
    (void)state;
    gn_gl_destroy(gl);
    gn_display_close(&display);
    gl = NULL;
    help_remove(shaders);
    return 0;
}

/* ---- plans by hand ---- */

static struct scratch {
    struct gn_plan plan;
    struct gn_pass passes[4];
    struct gn_draw draws[4];
    struct gn_instance instances[4];
    struct gn_program_key programs[2];
    struct gn_shadow_view shadows[1];
    float constants[2][2][4];
} s;

static inline struct gn_instance instance(float r, float g, float b, float a) {
    return (struct gn_instance){.world = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}},
                                .base_color = {r, g, b, a}};
}

static inline void begin_plan(enum gn_output_format output) {
    memset(&s, 0, sizeof s);
    s.plan = (struct gn_plan){.width_px = SIDE,
                              .shown_width_px = SIDE,
                              .shown_height_px = SIDE,
                              .height_px = SIDE,
                              .output = output,
                              .finished = output,
                              .tone = GN_TONE_NONE,
                              .scene = &help_scene,
                              .passes = s.passes,
                              .draws = s.draws,
                              .instances = s.instances,
                              .programs = s.programs,
                              .shadows = s.shadows,
                              .pass_count = 1,
                              .program_count = 1,
                              .exposure = 1};
    s.passes[0] = (struct gn_pass){.label = "opaque",
                                   .target = {.width_px = SIDE, .height_px = SIDE},
                                   .clear.area = GN_CLEAR_ALL,
                                   .depth_write = true,
                                   .discard_depth = true,
                                   .picture.resolves = true,
                                   .constants = (const float(*)[4])s.constants[0],
                                   .constant_count = 2};
    s.programs[0].kind = output == GN_OUTPUT_AOV ? GN_PROGRAM_AOV : GN_PROGRAM_LIT;
}

static inline struct gn_draw *add_draw(uint32_t geometry, struct gn_instance what) {
    uint32_t i = s.plan.draw_count++;
    s.instances[s.plan.instance_count++] = what;
    s.draws[i] = (struct gn_draw){
        .geometry = geometry, .first_instance = i, .instance_count = 1, .cull = GN_CULL_BACK};
    s.passes[0].draw_count = s.plan.draw_count;
    return &s.draws[i];
}

static inline void prepare(void) {
    if (!gn_gl_prepare(gl, &s.plan, &err)) fail_msg("%s", err.text);
}

static inline void run(void) {
    if (!gn_gl_run(gl, &s.plan, NULL, &err)) fail_msg("%s", err.text);
}

static uint8_t picture[SIDE][SIDE][4];

static inline void show(void) {
    prepare();
    run();
    if (!gn_gl_read_rgba8(gl, &picture[0][0][0], &err)) fail_msg("%s", err.text);
}

static inline void expect(int x, int y, int r, int g, int b) {
    const uint8_t *p = picture[y][x];
    if (abs(p[0] - r) > 1 || abs(p[1] - g) > 1 || abs(p[2] - b) > 1)
        fail_msg("pixel %d,%d is %d %d %d, not %d %d %d", x, y, p[0], p[1], p[2], r, g, b);
}

#define TEST(name)                                                                                 \
    {#name " egl", name, open_egl, close_all, NULL}, {                                             \
#name " osmesa", name, open_osmesa, close_all, NULL                                        \
    }

#endif
