/* When a text is seen: it rises, stands and falls. Pure: times come from the caller. */
#ifndef GN_CAPTION_FADE_H
#define GN_CAPTION_FADE_H

#include <stdint.h>

#define GN_CAPTION_RISE_NS INT64_C(150000000)
#define GN_CAPTION_FALL_NS INT64_C(400000000)

struct gn_caption_fade { /* zeroed: it was never there */
    int64_t begun_ns;    /* it begins to rise */
    int64_t ends_ns;     /* it has fallen; INT64_MAX: it stays */
};

/* How long a text is to be read: 1 s, .35 s for each word of it, and at least that long. Two
 * characters of a script without spaces between words count as a word. */
int64_t gn_caption_read_ns(const char *text, int64_t least_ns);

/* One that is shown from now on for that long (0: it stays), and goes on from the opacity of the
 * one that it replaces. */
struct gn_caption_fade gn_caption_begin(const struct gn_caption_fade *before, int64_t lasts_ns,
                                        int64_t now_ns);
/* Falls from now on, if it does not fall yet. */
struct gn_caption_fade gn_caption_end(const struct gn_caption_fade *fade, int64_t now_ns);
/* Its opacity, 0 to 1. */
float gn_caption_alpha(const struct gn_caption_fade *fade, int64_t now_ns);
/* When it first differs from that at shown_ns; 0: at once, INT64_MAX: never. */
int64_t gn_caption_next_ns(const struct gn_caption_fade *fade, int64_t shown_ns);

#endif
