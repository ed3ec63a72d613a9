/* Points of a lamp that has a size: evenly spread, in an order whose first few represent the lamp,
 * too. Pure.
 *
 * Seen from anywhere a spherical lamp is a disk of equal brightness. Points in a ball of density
 * 1 / sqrt(1 - r^2) are that from all sides at once: they are uniform on the sphere S^3, and of
 * that any two coordinates are uniform in a disk (Archimedes' theorem, one dimension up). So one
 * set of points serves all receivers. Along z it is Vogel's spiral ("A Better Way to Construct the
 * Sunflower Head", 1979), which suits half-planes best; z itself is chosen so that the views up to
 * 70 degrees aside are as even as they can be. */
#ifndef GN_SHADOW_LAMP_H
#define GN_SHADOW_LAMP_H

#include <stdbool.h>
#include <stdint.h>

/* Counts of points are powers of two: their weights and the sums of those are whole bytes. */
enum { GN_LAMP_POINTS_MIN = 16, GN_LAMP_POINTS_MAX = 256 };

bool gn_lamp_has_count(uint32_t count);

/* Point `index` of `count` in the ball of radius 1; x and y alone: in the disk. */
void gn_lamp_point(uint32_t index, uint32_t count, float out[3]);

#endif
