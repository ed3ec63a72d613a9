/* What a rough metal returns, by a random walk between its microfacets. */
#ifndef GN_IMAGE_MICROFACETS_H
#define GN_IMAGE_MICROFACETS_H

/* Share of white light from all sides that a metal of GGX's microfacets returns to an eye at the
 * cosine n_v, above 0 and below 1; f0: reflectance of a facet at normal incidence, with Schlick's
 * rise. Within .003, the same at each call. Heitz and others, "Multiple-Scattering Microfacet BSDFs
 * with the Smith Model" (2016). */
double gn_microfacets_return(double f0, double roughness, double n_v);

#endif
