// Alpha-masked casters: discards fragments below the alpha cutoff.
#ifdef WITH_ALPHA_MASK
in vec2 v_uv;
in float v_alpha;
flat in float v_cutoff;
#ifdef WITH_BASE_TEXTURE
uniform sampler2D u_texture_base;
#endif
#endif

void cut_holes() {
#ifdef WITH_ALPHA_MASK
    float alpha = v_alpha;
#ifdef WITH_BASE_TEXTURE
    alpha *= texture(u_texture_base, v_uv).a;
#endif
    if (alpha < v_cutoff) discard;
#endif
}
