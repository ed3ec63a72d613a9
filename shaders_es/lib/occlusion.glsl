// Ambient occlusion of what stands still: a volume over the scene, fitted to what rays measure on its surfaces (src/truth/occlusion.h).
#ifdef WITH_OCCLUDED
in vec3 v_cell; // in the volume, 0..1
uniform mediump sampler3D u_occlusion;

// Share of the light from all around that arrives at this fragment, 0 to about 1; normal: of the mesh, towards the viewer.
float occlusion_at(vec3 normal) {
    vec4 o = texture(u_occlusion, v_cell);
    return max(dot(o.xyz, normal) + o.w, 0.0);
}
#endif
