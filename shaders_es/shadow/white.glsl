//@ names shadow_visibility white_next
// PCF with independent random taps over a disk of FILTER_RADIUS texels, other ones in each pixel: white noise, as in textbooks (stochastic
// sampling: Cook, "Stochastic Sampling in Computer Graphics", 1986). Uniform in area: radius by the square root. Each tap is compared
// with the receiver's plane at the tap. The same in every pixel if TAPS_TURN is false.

// A hash of two integers, to two: pcg2d of Jarzynski, Olano, "Hash Functions for GPU Rendering", JCGT 9 (3), 2020.
uvec2 white_next(uvec2 v) {
    v = v * 1664525u + 1013904223u;
    v += v.yx * 1664525u;
    v ^= v >> 16;
    v += v.yx * 1664525u;
    return v ^ v >> 16;
}

float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    uvec2 random = TAPS_TURN ? uvec2(gl_FragCoord.xy) : uvec2(0u);
    float lit = 0.0;
    for (int i = 0; i < TAPS; i++) {
        random = white_next(random);
        vec2 u = vec2(random >> 8) * (1.0 / 16777216.0);
        float angle = 6.2831853 * u.y;
        vec2 d = FILTER_RADIUS * sqrt(u.x) * vec2(cos(angle), sin(angle)) * s.size.zw;
        lit += map_lit(map, s.at + vec3(d, dot(s.slope, d)), s);
    }
    return lit * (1.0 / float(TAPS));
}
