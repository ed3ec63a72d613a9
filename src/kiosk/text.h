/* Texts on the picture: captions.c. */
#ifndef GN_KIOSK_TEXT_H
#define GN_KIOSK_TEXT_H

#include "caption/captions.h"
#include "kiosk/info_page.h"
#include "kiosk/machine.h"

struct gn_show_screen;

struct gn_show_text {
    struct gn_captions *captions;
    struct gn_info_page page;
    int bar;                   /* percent of a load, as the last frame showed it; -1: none */
    char card[400];            /* of the problem that lasts; "": none */
    char help[1536];           /* in place of the information page; "": none */
    struct gn_kiosk_view view; /* that the last caption is about, */
    int64_t since_ns;          /* and since when */
    char change[160];          /* the caption of a mode or a scene */
};

/* With the font of the settings; called again after a reload. A font that cannot be used is an
 * error that lasts. */
void gn_show_open_captions(struct gn_show_screen *screen);
/* Sets the texts of the frame of that view. */
void gn_show_write_captions(struct gn_show_screen *screen, const struct gn_kiosk_view *view,
                            int64_t now_ns);
/* To be drawn before there are texts, so that the first of them does not wait for a compiler. */
const struct gn_caption_run *gn_show_sample_captions(const struct gn_show_screen *screen);
/* The last part of a path; NULL: the built-in scene. */
const char *gn_show_path_name(const char *path);
/* When the texts need another frame; 0: at once, INT64_MAX: never. */
int64_t gn_show_captions_due_ns(const struct gn_show_screen *screen);
/* The bar of a load wants another frame; when to ask again (INT64_MAX: nothing loads,
 * or the screen is dark or has no monitor). */
bool gn_show_bar_moves(const struct gn_show_screen *screen);
int64_t gn_show_bar_due_ns(const struct gn_show_screen *screen);

#endif
