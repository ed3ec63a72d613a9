// Tone mapping: linear colour after exposure, 0 and above, to 0..1, still linear. One of TONE_NEUTRAL, TONE_ACES, TONE_AGX, or none.
// tests/image/test_tone.c has each in double precision.

#ifdef WITH_TONE_NEUTRAL
// Khronos PBR Neutral, without its branches: base colours up to .8 stay as they are but for the Fresnel offset, brighter ones are
// compressed by their largest channel, and towards white.
vec3 tone_mapped(vec3 color) {
    const float start = 0.8 - 0.04, desaturation = 0.15;
    float least = min(min(min(color.r, color.g), color.b), 0.08);
    color -= least - 6.25 * least * least;
    float peak = max(max(max(color.r, color.g), color.b), start);
    float over = peak - start;
    float lost = over * over / (over + (1.0 - start));
    float left = 1.0 / (desaturation * lost + 1.0);
    float target = peak - lost; // the colour at this brightness, and by the rest grey of it
    return color * (target / peak * left) + (target - target * left);
}

#elif defined WITH_TONE_ACES
// Stephen Hill's fit of ACES' reference rendering and sRGB output transform; .6: middle grey stays about as bright as without.
vec3 tone_mapped(vec3 color) {
    const mat3 rrt_from_srgb =
        mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777) * (1.0 / 0.6);
    const mat3 srgb_from_odt = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = rrt_from_srgb * color;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(srgb_from_odt * v, 0.0, 1.0);
}

#elif defined WITH_TONE_AGX
// Troy Sobotka's AgX by Benjamin Wrensch's polynomial; its result is encoded with a power of 2.2.
vec3 tone_mapped(vec3 color) {
    const float darkest = -12.47393, stops = 4.026069 + 12.47393;
    const mat3 inset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992, 0.878468636469772,
                            0.0784336, 0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 outset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368, 1.15190312990417,
                             -0.0980434501171241, -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    vec3 x = clamp(log2(max(inset * color, 1e-10)) * (1.0 / stops) - darkest / stops, 0.0, 1.0);
    x = (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
    return pow(clamp(outset * x, 0.0, 1.0), vec3(2.2));
}
#endif

#if defined(WITH_TONE_NEUTRAL) || defined(WITH_TONE_ACES) || defined(WITH_TONE_AGX)
#define WITH_TONE 1
#endif
