#define SIDE 8
#include "lib/cone_seeds.glsl"
