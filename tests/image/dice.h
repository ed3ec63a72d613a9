/* Random numbers for tests, the same every time (splitmix64). */
#ifndef GN_IMAGE_DICE_H
#define GN_IMAGE_DICE_H

#include <stdint.h>

struct gn_dice {
    uint64_t state;
};

static inline uint64_t gn_dice_next(struct gn_dice *dice) {
    uint64_t z = (dice->state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static inline double gn_dice_between(struct gn_dice *dice, double low, double high) {
    return low + (high - low) * (double)(gn_dice_next(dice) >> 11) / 9007199254740992.0;
}

#endif
