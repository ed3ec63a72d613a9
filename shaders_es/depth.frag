#include "lib/caster.frag.glsl"

void main() { cut_holes(); }
