/* A text in a buffer, drawn by the CPU: what a screen shows when GL does not work. ASCII in a
 * built-in 5 x 7 font; other characters become "?". */
#ifndef GN_DISPLAY_MESSAGE_H
#define GN_DISPLAY_MESSAGE_H

#include <stddef.h>
#include <stdint.h>

struct gn_message_picture {
    uint8_t *pixels; /* XRGB8888, top row first */
    size_t stride;   /* bytes */
    uint32_t width_px, height_px;
    unsigned turn_deg; /* 0, 90, 180, 270: rotate the text clockwise */
};
/* Fills the buffer dark with the text centred, wrapped between words, one twenty-fourth of the
 * height per line at most; excess text is cut. */
void gn_message_draw(const struct gn_message_picture *picture, const char *text);

#endif
