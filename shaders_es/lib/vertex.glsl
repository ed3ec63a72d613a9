// Attributes of vertices and instances, and functions of them that all vertex shaders share.
VERTEX_ATTRIBUTES // a_position, a_normal, a_uv0, a_uv1, a_color: the rows of src/scene/attribute.h; a_normal.w: spread
layout(location = 10) in vec4 a_world_0; // rows of world_from_item; of what is deformed as lib/deform.glsl has it
layout(location = 11) in vec4 a_world_1;
layout(location = 12) in vec4 a_world_2;
layout(location = 13) in vec4 a_base_color; // linear
layout(location = 14) in vec4 a_surface;    // roughness, metalness, occlusion strength, alpha cutoff
layout(location = 15) in vec4 a_emissive;   // linear radiance; w: 1 = casts

uniform vec4 u_uv[2 * SLOT_COUNT]; // two rows per texture slot: uv_from_uv; w of SLOT_NORMAL's first: scale of the normal map

#include "lib/deform.glsl"

#ifdef WITH_DEFORMATION
#define POSE_VERTEX deform();
#define POSITION mesh_position
#define NORMAL mesh_normal
#define TANGENT mesh_tangent
#define WORLD_0 world_0
#define WORLD_1 world_1
#define WORLD_2 world_2
#else
#define POSE_VERTEX
#define POSITION a_position
#define NORMAL a_normal.xyz
#define TANGENT a_tangent.xyz
#define WORLD_0 a_world_0
#define WORLD_1 a_world_1
#define WORLD_2 a_world_2
#endif

// Before the others: it poses what is deformed.
vec3 position_ws() {
    POSE_VERTEX
    vec4 p = vec4(POSITION, 1.0);
    return vec3(dot(WORLD_0, p), dot(WORLD_1, p), dot(WORLD_2, p));
}

// Not of unit length. Normals transform by the inverse transpose, here the cofactor matrix, whose rows are cross products of the
// matrix's rows: correct for any scale. For mirroring transforms the sign of the determinant is removed. Its length is the square of
// the scale, which is 1e-10 in quantised meshes of small models: times 1024, so that neither that square nor that of 1e8 is lost.
vec3 normal_ws() {
    vec3 c0 = cross(WORLD_1.xyz, WORLD_2.xyz);
    vec3 c1 = cross(WORLD_2.xyz, WORLD_0.xyz);
    vec3 c2 = cross(WORLD_0.xyz, WORLD_1.xyz);
    vec3 n = vec3(dot(c0, NORMAL), dot(c1, NORMAL), dot(c2, NORMAL));
    return n * (dot(WORLD_0.xyz, c0) < 0.0 ? -1024.0 : 1024.0);
}

// xyz: unit, times the scale of the normal map; w: sign of the bitangent, which mirroring transforms turn.
vec4 tangent_ws() {
    vec3 t = vec3(dot(WORLD_0.xyz, TANGENT), dot(WORLD_1.xyz, TANGENT), dot(WORLD_2.xyz, TANGENT));
    float mirrors = dot(WORLD_0.xyz, cross(WORLD_1.xyz, WORLD_2.xyz));
    return vec4(normalize(t) * u_uv[2 * SLOT_NORMAL].w, mirrors < 0.0 ? -a_tangent.w : a_tangent.w);
}

// Sine of the largest angle between the normal and those of the faces around the vertex. Scaling by different factors changes an
// angle by at most their ratio. Not more than 0.4: on coarser meshes shadows would be lost with the acne.
float normal_spread() {
    vec3 scale = WORLD_0.xyz * WORLD_0.xyz + WORLD_1.xyz * WORLD_1.xyz + WORLD_2.xyz * WORLD_2.xyz;
    float most = max(max(scale.x, scale.y), scale.z), least = min(min(scale.x, scale.y), scale.z);
    return min(a_normal.w * sqrt(most / max(least, 1e-12 * most)), 0.4);
}

// Texture coordinates of a slot (SLOT_BASE ..); second: from TEXCOORD_1.
vec2 slot_uv(const int slot, const bool second) {
    vec3 uv = vec3(second ? a_uv1 : a_uv0, 1.0);
    return vec2(dot(u_uv[2 * slot].xyz, uv), dot(u_uv[2 * slot + 1].xyz, uv));
}
