/* A gnomon in a window, and what is seen in it. A test sets the server first. */
#ifndef GN_IMAGE_IN_WINDOW_H
#define GN_IMAGE_IN_WINDOW_H

#include "image/picture.h"
#include "image/xserver.h"

extern struct gn_xserver *window_server;
extern const char window_scene[];
extern const char *window_folder; /* where the program runs; NULL: here */

struct window_shown {
    pid_t pid;
    gn_xwindow window;
    char said[400]; /* the file with what it says */
};

/* The program with these arguments; window_find() waits for its window. */
void window_start(struct window_shown *s, const char *const args[]);
void window_find(struct window_shown *s);
/* The scene at that size, without animation. */
void window_show(struct window_shown *s, const char *size);
void window_read_said(const struct window_shown *s, char *out, size_t size);
/* Its exit status; 124 when it did not end by itself. */
int window_end_of(struct window_shown *s);
void window_assert_ends_well(struct window_shown *s); /* with status 0 and without a word */
void window_stop(struct window_shown *s);
int window_clear_up(void **state); /* kills what a test that fails leaves behind */

/* Becomes such a picture before patience ends; with differ, any other one. */
void window_assert_becomes(struct window_shown *s, const struct gn_picture *expected, bool differ,
                           const char *name);
/* The scene as render draws it. */
void window_render(struct gn_picture *picture, const char *size, const char *option,
                   const char *value);
void window_assert_becomes_render(struct window_shown *s, const char *size, const char *name);

#endif
