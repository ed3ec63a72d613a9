/* The text of the information page (GN_CAPTION_INFO): a title, then rows of a label and a value. */
#ifndef GN_KIOSK_INFO_PAGE_H
#define GN_KIOSK_INFO_PAGE_H

#include "display/display.h"
#include "frame/caps.h"
#include "kiosk/problems.h"

struct gn_info {                        /* a field that is NULL or zero gets no line */
    const char *scene, *mode, *missing; /* missing: what the scene is shown without */
    const struct gn_screen *screen;
    const struct gn_caps *caps;
    int64_t uptime_ns;                      /* of this program */
    const struct gn_problem_words *problem; /* NULL: it runs well */
    const char *shown;                      /* what is to be said of that; NULL or "": no more */
    const char *board;                      /* what it suffers from */
    const char *sun;                        /* the moment for which it is shown, by two clocks */
    const char *root;                       /* a prefix of /sys, for tests; else "" or NULL */
};
struct gn_info_page { /* zeroed: no text yet */
    char text[1536];
    int64_t made_ns;
    uint64_t shown; /* the screen's count at that time */
    bool made;
};
/* Makes the text, at most once a second; true: it is a new one. The frame rate is that since the
 * previous text. Reads the network addresses and the temperature; does not block. */
bool gn_info_page_step(struct gn_info_page *page, const struct gn_info *info, int64_t now_ns);

#endif
