// Vertices of skins and of meshes with morph targets. position_ws() of lib/vertex.glsl calls deform(), which sets what the other
// functions there read. The pose writes u_pose (src/scene/deform.c): a joint is a row of three texels, the rows of world_from_mesh;
// a list has a texel (weight, number of the target) a row. An item without a skin has its own matrix there, as if of one joint.
// a_world_0: where the joints begin, where the list does. a_world_1: length of the list; texel of u_deltas of the first target and of
// vertex 0; vertices; parts of a target: 1 positions, 2 and normals, 3 and tangents.
#if defined(WITH_SKIN) || defined(WITH_SKIN_8) || defined(WITH_MORPH)
#define WITH_DEFORMATION 1
uniform sampler2D u_pose;
vec4 world_0, world_1, world_2; // rows of world_from_mesh, of this vertex
vec3 mesh_position, mesh_normal, mesh_tangent;

#ifdef WITH_MORPH
uniform sampler2D u_deltas;

vec3 delta_at(int texel) {
    return texelFetch(u_deltas, ivec2(texel % DELTAS_WIDTH, texel / DELTAS_WIDTH), 0).xyz;
}

void add_targets() {
    ivec2 list = ivec2(a_world_0.zw);
    int count = int(a_world_1.x), first = int(a_world_1.y) + gl_VertexID, vertices = int(a_world_1.z), parts = int(a_world_1.w);
    for (int i = 0; i < count; i++) {
        vec2 target = texelFetch(u_pose, list + ivec2(0, i), 0).xy;
        int texel = first + int(target.y) * parts * vertices;
        mesh_position += target.x * delta_at(texel);
#ifndef POSITION_ONLY
        if (parts > 1) mesh_normal += target.x * delta_at(texel + vertices);
        if (parts > 2) mesh_tangent += target.x * delta_at(texel + 2 * vertices);
#endif
    }
}
#endif

void add_joint(uint joint, float weight) {
    ivec2 at = ivec2(a_world_0.xy) + ivec2(0, int(joint));
    world_0 += weight * texelFetch(u_pose, at, 0);
    world_1 += weight * texelFetch(u_pose, at + ivec2(1, 0), 0);
    world_2 += weight * texelFetch(u_pose, at + ivec2(2, 0), 0);
}

void add_joints(uvec4 joints, vec4 weights) {
    add_joint(joints.x, weights.x);
    add_joint(joints.y, weights.y);
    if (weights.z + weights.w > 0.0) { // between branches compilers fetch less at once, in fewer registers
        add_joint(joints.z, weights.z);
        add_joint(joints.w, weights.w);
    }
}

void deform() {
    mesh_position = a_position;
    mesh_normal = a_normal.xyz;
    mesh_tangent = a_tangent.xyz;
    world_0 = world_1 = world_2 = vec4(0.0);
#ifdef WITH_MORPH
    add_targets();
#endif
#if defined(WITH_SKIN) || defined(WITH_SKIN_8)
    add_joints(a_joints0, a_weights0);
#ifdef WITH_SKIN_8
    if (a_weights1.x + a_weights1.y + a_weights1.z + a_weights1.w > 0.0) add_joints(a_joints1, a_weights1);
#endif
#else
    add_joint(0u, 1.0);
#endif
}
#endif
