#ifndef GN_TESTS_FUZZ_BOMB_PIXELS_H
#define GN_TESTS_FUZZ_BOMB_PIXELS_H

#include "frame/plan.h"

/* How often the picture's passes draw each pixel, on average, as limits count it (opaque ones a
 * quarter): of a sample of the triangles that they really have. Posed vertices are left out. */
double gn_bomb_overdraw(const struct gn_plan *plan);

#endif
