// Draws casters into a depth map.
#include "lib/caster.vert.glsl"

void main() { place_caster(position_ws()); }
