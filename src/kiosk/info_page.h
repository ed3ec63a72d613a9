/* What a kiosk says of itself on its screen when it is asked: a text for a GN_CAPTION_INFO. */
#ifndef GN_KIOSK_INFO_PAGE_H
#define GN_KIOSK_INFO_PAGE_H

#include "display/display.h"
#include "frame/caps.h"

struct gn_info { /* what is NULL, or zero, has no line */
    const char *scene, *mode;
    const struct gn_screen *screen;
    const struct gn_caps *caps;
    int64_t uptime_ns; /* of this program */
    const char *root;  /* before /sys: "" or NULL but in tests */
};
struct gn_info_page { /* zeroed: none yet */
    char text[1536];
    int64_t made_ns;
    uint64_t shown; /* counts of the screen then */
    bool made;
};
/* Makes the text, once a second at most; true: it was made anew. Frames a second are those since
 * the time before. Reads the interfaces' addresses and the temperature; never waits for anything.
 */
bool gn_info_page_step(struct gn_info_page *page, const struct gn_info *info, int64_t now_ns);

#endif
