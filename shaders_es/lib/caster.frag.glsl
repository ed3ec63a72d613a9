// Alpha-masked casters: discards fragments below the alpha cutoff. Blended casters, with ALPHA_DITHER: leaves the share of texels that
// alpha is, by a fixed pattern of the map.
#ifdef WITH_ALPHA_MASK
in vec2 v_uv;
in float v_alpha;
flat in float v_cutoff;
#ifdef WITH_BASE_TEXTURE
uniform sampler2D u_texture_base;
#endif
#ifdef WITH_TRANSMISSION_TEXTURE
in vec2 v_uv_transmission;
flat in float v_transmitted; // share of the light, times the texture
uniform sampler2D u_texture_transmission;
#endif
#endif

void cut_holes() {
#ifdef WITH_ALPHA_MASK
    float alpha = v_alpha;
#ifdef WITH_BASE_TEXTURE
    alpha *= texture(u_texture_base, v_uv).a;
#endif
#ifdef WITH_TRANSMISSION_TEXTURE
    alpha *= 1.0 - v_transmitted * texture(u_texture_transmission, v_uv_transmission).r;
#endif
    float least = v_cutoff;
    if (ALPHA_DITHER) // interleaved gradient noise, as in lib/noise.glsl
        least = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) + 0.001;
    if (alpha < least) discard;
#endif
}
