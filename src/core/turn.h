/* A picture that stands in another one, turned clockwise by 0, 90, 180 or 270 degrees. */
#ifndef GN_CORE_TURN_H
#define GN_CORE_TURN_H

#include <stdint.h>

struct gn_turned {
    unsigned deg;
    uint32_t width_px, height_px; /* of the one that it stands in */
};
struct gn_turned_size {
    uint32_t width_px, height_px;
};
/* Of the picture before it is turned. */
static inline struct gn_turned_size gn_turned_upright(unsigned deg, uint32_t width_px,
                                                      uint32_t height_px) {
    return deg % 180 == 0 ? (struct gn_turned_size){width_px, height_px}
                          : (struct gn_turned_size){height_px, width_px};
}
/* Where column u, row v of the upright picture is in it: to[0] to the right, to[1] down, rows of
 * both from the top. */
static inline void gn_turned_place(const struct gn_turned *turn, uint32_t u, uint32_t v,
                                   uint32_t to[2]) {
    const uint32_t right = turn->width_px - 1, bottom = turn->height_px - 1;
    const uint32_t at[4][2] = {{u, v}, {right - v, u}, {right - u, bottom - v}, {v, bottom - u}};
    to[0] = at[turn->deg / 90 % 4][0];
    to[1] = at[turn->deg / 90 % 4][1];
}

#endif
