// Attributes of vertices and instances, and functions of them that all vertex shaders share.
VERTEX_ATTRIBUTES // a_position, a_normal, a_uv0, a_uv1, a_color: the rows of src/scene/attribute.h; a_normal.w: spread
layout(location = 10) in vec4 a_world_0; // rows of world_from_item
layout(location = 11) in vec4 a_world_1;
layout(location = 12) in vec4 a_world_2;
layout(location = 13) in vec4 a_base_color; // linear
layout(location = 14) in vec4 a_surface;    // roughness, metalness, occlusion strength, alpha cutoff
layout(location = 15) in vec4 a_emissive;   // linear radiance; w: 1 = casts

uniform vec4 u_uv[2 * SLOT_COUNT]; // two rows per texture slot: uv_from_uv; w of SLOT_NORMAL's first: scale of the normal map

vec3 position_ws() {
    vec4 p = vec4(a_position, 1.0);
    return vec3(dot(a_world_0, p), dot(a_world_1, p), dot(a_world_2, p));
}

// Not of unit length. Normals transform by the inverse transpose, here the cofactor matrix, whose rows are cross products of the
// matrix's rows: correct for any scale. For mirroring transforms the sign of the determinant is removed.
vec3 normal_ws() {
    vec3 c0 = cross(a_world_1.xyz, a_world_2.xyz);
    vec3 c1 = cross(a_world_2.xyz, a_world_0.xyz);
    vec3 c2 = cross(a_world_0.xyz, a_world_1.xyz);
    vec3 n = vec3(dot(c0, a_normal.xyz), dot(c1, a_normal.xyz), dot(c2, a_normal.xyz));
    return dot(a_world_0.xyz, c0) < 0.0 ? -n : n;
}

// xyz: unit, times the scale of the normal map; w: sign of the bitangent, which mirroring transforms turn.
vec4 tangent_ws() {
    vec3 t = vec3(dot(a_world_0.xyz, a_tangent.xyz), dot(a_world_1.xyz, a_tangent.xyz), dot(a_world_2.xyz, a_tangent.xyz));
    float mirrors = dot(a_world_0.xyz, cross(a_world_1.xyz, a_world_2.xyz));
    return vec4(normalize(t) * u_uv[2 * SLOT_NORMAL].w, mirrors < 0.0 ? -a_tangent.w : a_tangent.w);
}

// Sine of the largest angle between the normal and those of the faces around the vertex. Scaling by different factors changes an
// angle by at most their ratio. Not more than 0.4: on coarser meshes shadows would be lost with the acne.
float normal_spread() {
    vec3 scale = a_world_0.xyz * a_world_0.xyz + a_world_1.xyz * a_world_1.xyz + a_world_2.xyz * a_world_2.xyz;
    float most = max(max(scale.x, scale.y), scale.z), least = min(min(scale.x, scale.y), scale.z);
    return min(a_normal.w * sqrt(most / max(least, 1e-12 * most)), 0.4);
}

// Texture coordinates of a slot (SLOT_BASE ..); second: from TEXCOORD_1.
vec2 slot_uv(const int slot, const bool second) {
    vec3 uv = vec3(second ? a_uv1 : a_uv0, 1.0);
    return vec2(dot(u_uv[2 * slot].xyz, uv), dot(u_uv[2 * slot + 1].xyz, uv));
}
