/* Sample positions for techniques that take many samples: points spread evenly in the unit disk,
 * each with its opposite, so that a shader transforms half of them and their mean is the disk's
 * centre. Pure. */
#ifndef GN_SHADOW_TAPS_H
#define GN_SHADOW_TAPS_H

enum gn_taps {
    GN_TAPS_NONE,
    GN_TAPS_DISK, /* uniform: radius by the square root, turned by the golden angle (Vogel 1979) */
    GN_TAPS_POISSON, /* no two closer than a distance: Bridson 2007, assets/make_poisson.c */
    GN_TAPS_RINGS,   /* rings of four, a quarter turn apart, which share arithmetic */
};
enum { GN_TAPS_MAX = 64, GN_TAPS_DEFAULT = 16, GN_RINGS_MAX = 4, GN_RINGS_DEFAULT = 3 };

/* The number of samples of that kind, at most GN_TAPS_MAX, if so many are wanted: a multiple of 4,
 * or 0 for the default. NONE: 0. */
int gn_taps_count(enum gn_taps kind, int wanted);
/* DISK, POISSON. count: a multiple of 4 to GN_TAPS_MAX. Fills out with half as many points. */
void gn_taps_build(enum gn_taps kind, int count, float (*out)[2]);
/* RINGS. Fills out with a point of each of 2 to GN_RINGS_MAX rings. */
void gn_taps_rings(int count, float (*out)[2]);

#endif
