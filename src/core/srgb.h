/* The curve of sRGB (IEC 61966-2-1), from a code of 0 to 1 to linear light, and back. */
#ifndef GN_CORE_SRGB_H
#define GN_CORE_SRGB_H

float gn_srgb_decode(float code);
float gn_srgb_encode(float linear); /* clamped to 0 to 1 */

#endif
