/* What `gnomon lesson` draws and measures. */
#ifndef GN_CLI_LESSON_H
#define GN_CLI_LESSON_H

#include "core/warn.h"
#include "options/lesson.h"

struct gn_lesson_result {
    const struct gn_lesson *lesson;
    double figures[GN_LESSON_STEPS_MAX][GN_FIGURE_COUNT]; /* NAN: not measured in this lesson */
};
struct gn_lesson_opts {
    const struct gn_options *options; /* with the lesson loaded; sizes: 480x360 unless given */
    const char *folder; /* for pictures: NAME-1.png, its difference NAME-1-diff.png, ..,
                           NAME-truth.png. NULL: none */
};
/* Draws the steps and the truth and fills the figures of the lesson's faults. */
bool gn_lesson_measure(const struct gn_lesson *lesson, const struct gn_lesson_opts *opts,
                       struct gn_lesson_result *result, struct gn_warnings *warnings,
                       struct gn_err *err);
/* FOLDER/index.html: the pictures beside their figures. */
bool gn_lesson_write_page(const struct gn_lesson_result *results, int count, const char *folder,
                          struct gn_err *err);

#endif
