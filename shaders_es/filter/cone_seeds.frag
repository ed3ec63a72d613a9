#define SIDE 2
#include "lib/cone_seeds.glsl"
