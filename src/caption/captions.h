/* The texts that are on the screen now. */
#ifndef GN_CAPTION_CAPTIONS_H
#define GN_CAPTION_CAPTIONS_H

#include "caption/run.h"
#include "core/err.h"
#include "core/warn.h"

#define GN_CAPTION_MODE_NS INT64_C(2000000000) /* how long a mode's name is shown at least */
#define GN_CAPTION_CARD_NS INT64_C(30000000000)

struct gn_captions;
struct gn_captions_opts { /* zero means the default written beside */
    const char
        *font; /* file; NULL: the first found in the folders of packages; "": the built-in font */
    struct gn_warnings
        *warnings;    /* receives a warning when a font is not used, or one is missing; none */
    int64_t least_ns; /* GN_CAPTION_MODE_NS: how long GN_CAPTION_MODE is shown at least */
    bool rises;       /* texts rise, and fall when they are removed; else they come and go at once:
                         for a single picture */
};
/* Reads nothing yet: the font is opened when a text is first laid out. The texts in opts must
 * outlive it. */
struct gn_captions *gn_captions_create(const struct gn_captions_opts *opts);
void gn_captions_destroy(struct gn_captions *captions); /* NULL is legal */
/* Opens the font now. False: the file in opts cannot be used, and the built-in font is. */
bool gn_captions_open_font(struct gn_captions *captions, struct gn_err *err);

/* Replaces the text of that kind (copied, cut at 2 kB); NULL or "" removes it. GN_CAPTION_MODE is
 * shown as long as gn_caption_read_ns() of caption/fade.h has it, GN_CAPTION_CARD for its time,
 * others until they are removed. Equal text: its time starts again, if it has one, else nothing
 * changes. */
void gn_captions_set(struct gn_captions *captions, enum gn_caption_kind kind, const char *text,
                     int64_t now_ns);
/* As in struct gn_captions_opts, for texts that are set from now on. */
void gn_captions_set_least(struct gn_captions *captions, int64_t least_ns);
/* A bar under GN_CAPTION_TEXT, or alone where that has no text, filled to that share, 0 to 1; below
 * 0, as at first: no bar. */
void gn_captions_set_bar(struct gn_captions *captions, double share, int64_t now_ns);
/* The line of a split screen at that share of the width, with its handle; below 0, as at first:
 * none, and GN_CAPTION_LEFT and GN_CAPTION_RIGHT are not shown. */
void gn_captions_set_split(struct gn_captions *captions, double at);

/* The captions on a picture of that size (before rotation) at that time; NULL: none. Valid until
 * the next call of this or set. Allocates, reads the font and lays out text only when text or size
 * changed. */
const struct gn_caption_run *gn_captions_run(struct gn_captions *captions, uint32_t width_px,
                                             uint32_t height_px, int64_t now_ns);
/* A pixel on a picture of that size, from the atlas as it is, for a draw ahead of the first text:
 * what a driver has not drawn before it compiles then. Never NULL, valid until the next call; opens
 * the font. */
const struct gn_caption_run *gn_captions_sample(struct gn_captions *captions, uint32_t width_px,
                                                uint32_t height_px);
/* What this machine lacks to draw the texts so far: as gn_shape_find_missing() writes it; "":
 * nothing.
 */
const char *gn_captions_missing(const struct gn_captions *captions);
/* When captions next change the picture since the last run: a time, 0 for at once, INT64_MAX for
 * never. */
int64_t gn_captions_next_ns(const struct gn_captions *captions);

#endif
