/* The curve of sRGB (IEC 61966-2-1), from a code of 0 to 1 to linear light, and back. */
#ifndef GN_CORE_SRGB_H
#define GN_CORE_SRGB_H

float gn_srgb_decode(float code);
float gn_srgb_encode(float linear); /* clamped to 0 to 1 */

/* Of linear red, green and blue (Rec. 709). */
static inline float gn_luminance(const float c[3]) {
    return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

#endif
