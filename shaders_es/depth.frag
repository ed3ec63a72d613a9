#include "lib/caster.frag.glsl"
#ifdef WITH_MIDDLE
#include "lib/middle.glsl"
uniform sampler2D u_map_0;
#endif

void main() {
    cut_holes();
#ifdef WITH_MIDDLE
    float second = texelFetch(u_map_0, ivec2(gl_FragCoord.xy), 0).r;
    gl_FragDepth = PERSPECTIVE ? middle_depth(gl_FragCoord.z, second) : middle_code(gl_FragCoord.z, second);
#endif
}
