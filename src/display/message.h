/* A line of text on a picture, by the CPU alone: what a screen says when GL cannot. ASCII, in a
 * built-in font of 5 x 7 dots; other characters become "?". */
#ifndef GN_DISPLAY_MESSAGE_H
#define GN_DISPLAY_MESSAGE_H

#include <stddef.h>
#include <stdint.h>

struct gn_message_picture {
    uint8_t *pixels; /* XRGB8888, top row first */
    size_t stride;   /* bytes */
    uint32_t width_px, height_px;
    unsigned turn_deg; /* 0, 90, 180, 270: the text stands turned clockwise */
};
/* Fills the picture: dark, with the text in its middle, broken between words, as large as a
 * twenty-fourth of the height allows; what has no room is cut. */
void gn_message_draw(const struct gn_message_picture *picture, const char *text);

#endif
