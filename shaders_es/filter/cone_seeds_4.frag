#define SIDE 4
#include "lib/cone_seeds.glsl"
