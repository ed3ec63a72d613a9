/* Lessons: what goes wrong with shadows, and what cures it. A row of lesson_rows.h each: a scene
 * inside the program and steps, which are settings; `gnomon lesson` shows them as modes, or draws
 * and measures them. */
#ifndef GN_OPTIONS_LESSON_H
#define GN_OPTIONS_LESSON_H

#include "options/options.h"

/* What is measured against rays, of light 0. */
enum gn_figure {
    GN_FIGURE_NONE,
    GN_FIGURE_DARKENING, /* of pixels that are safely lit; mean, per cent */
    GN_FIGURE_GAP,       /* between a contact and its shadow; mean, texels */
    GN_FIGURE_LEAK,      /* pixels away from edges that are dark, but shown lit; per cent */
    GN_FIGURE_GLOW,      /* light in pixels that are safely dark; the most, per cent */
    GN_FIGURE_WRONG,     /* pixels that are lit instead of dark or the reverse; per cent */
    GN_FIGURE_PENUMBRA,  /* root mean square error in penumbrae */
    GN_FIGURE_COUNT,
};
struct gn_figure_row {
    const char *name; /* of its column, and in JSON */
    const char *unit; /* "%"; "" */
    const char *what; /* a phrase */
};
extern const struct gn_figure_row gn_figures[GN_FIGURE_COUNT];

enum { GN_LESSON_STEPS_MAX = 8 };
struct gn_lesson_step {
    const char *name;     /* NULL: no more steps. At most 48 characters: a mode's name */
    const char *set;      /* what it changes: lines of [mode] in kiosk.ini; NULL: nothing */
    enum gn_figure fault; /* this step shows a fault, which that figure measures; NONE: it shows the
                             cure, with less of the figure of every fault */
};
struct gn_lesson {
    const char *name, *title;
    const char *teaches; /* sentences */
    const char *scene;   /* made by assets/make_lessons.c */
    const char *set;     /* what all steps set, as theirs; NULL: nothing */
    struct gn_lesson_step steps[GN_LESSON_STEPS_MAX];
};
extern const struct gn_lesson gn_lessons[];
extern const int gn_lesson_count;

int gn_lesson_steps(const struct gn_lesson *lesson); /* how many */
/* The figures of its faults: bits 1 << enum gn_figure. */
unsigned gn_lesson_figures(const struct gn_lesson *lesson);
/* By name. NULL: a usage error that says what to do. */
const struct gn_lesson *gn_lesson_find(const char *name, struct gn_err *err);
/* A step's options as they are written on a command line: " --shadow hard --map 256". */
void gn_lesson_flags(const struct gn_lesson *lesson, int step, char *out, size_t size);
/* Puts the lesson into options as a configuration file would be: its scene, and a mode for each
 * step. */
bool gn_lesson_load(struct gn_options *options, const struct gn_lesson *lesson, struct gn_err *err);

#endif
