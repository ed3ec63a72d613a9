/* The screens of `gnomon show` in every state that has a picture of its own, drawn by the kiosk. */
#ifndef GN_IMAGE_SCREENS_H
#define GN_IMAGE_SCREENS_H

#include <stdint.h>

#include "caption/run.h"

enum screen_state {
    SCREEN_NORMAL,
    SCREEN_MODE,
    SCREEN_INFORMATION,
    SCREEN_HELP,
    SCREEN_SPLIT,
    SCREEN_SPLIT_HELP,
    SCREEN_TRUTH,
    SCREEN_PROBLEM,
    SCREEN_PROBLEM_INFORMATION,
    SCREEN_LOADING,
    SCREEN_DARK,
    SCREEN_NO_CARD,
    SCREEN_NO_MONITOR,
    SCREEN_WRONG_KEY,
    SCREEN_WRONG_FILE,
    SCREEN_NO_SCENE,
    SCREEN_STICK_TAKEN,
    SCREEN_STICK_REFUSED,
    SCREEN_STATES,
};
extern const char *const screen_names[SCREEN_STATES];

struct screen_opts {
    const char *scene; /* a file */
    const char *size;  /* of the screen, before it is rotated: "1280x720" */
    const char *rotate;
    bool traces; /* the truth is waited for; else only its first frame is drawn */
};
struct screen_shown {
    enum screen_state state;
    uint32_t width_px, height_px;     /* upright */
    const uint8_t *rgba;              /* likewise, top row first; until the next picture */
    const struct gn_caption_run *run; /* what lies over the picture; NULL: nothing, or a message */
    const char *texts[GN_CAPTION_KIND_COUNT]; /* that it is made of; NULL: not known */
};
/* Calls take() for each state in turn. Skips the test where there is no EGL. */
void screens_draw(const struct screen_opts *opts, void (*take)(const struct screen_shown *shown));

#endif
