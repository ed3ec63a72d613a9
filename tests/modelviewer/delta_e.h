/* How different colours look. */
#ifndef GN_TESTS_DELTA_E_H
#define GN_TESTS_DELTA_E_H

/* CIELAB of a colour in sRGB (0..1, encoded), of D65 with the 2 degree observer. */
void gn_lab_from_srgb(const float srgb[3], double lab[3]);
/* CIEDE2000 with all weights 1: 1 is about what can just be seen, black and white differ by 100.
 * CIE 142-2001; Sharma, Wu, Dalal, "The CIEDE2000 Color-Difference Formula: Implementation Notes,
 * Supplementary Test Data, and Mathematical Observations" (2005). Symmetric. */
double gn_delta_e_2000(const double a[3], const double b[3]);

#endif
