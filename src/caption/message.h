/* A text in a buffer, drawn by the CPU in the captions' font: what a screen shows where there is no
 * picture. */
#ifndef GN_CAPTION_MESSAGE_H
#define GN_CAPTION_MESSAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gn_message_picture {
    uint8_t *pixels; /* 4 bytes a pixel, top row first; the fourth is not written */
    size_t stride;   /* bytes */
    uint32_t width_px, height_px;
    unsigned turn_deg; /* 0, 90, 180, 270: rotate the text clockwise */
    bool red_first;    /* bytes are red, green, blue; else blue, green, red, as XRGB8888 has them */
    const char *font;  /* as in struct gn_captions_opts */
};
/* Fills the buffer dark, with the text where GN_CAPTION_TEXT stands. False: the picture is too
 * small for one, and only dark. */
bool gn_message_draw(const struct gn_message_picture *picture, const char *text);

#endif
