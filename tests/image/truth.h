/* The true picture of a scene's shadow: what the ray caster says of every pixel, kept in
 * build/truth-cache under the hash of the scene file, and how large a texel of a well-fitted shadow
 * map is there.
 *
 * The texel is estimated without asking the renderer: the map is the smallest square, upright in
 * the light's plane, around (casters, as the light sees them) intersected with (places that the
 * picture shows, as the light sees them), for a spot within its cone. The light's plane has metres
 * (directional) or tangents (spot) as its unit. A real fit cannot know the picture, so its texels
 * are rather larger, and a measure in units of ours rather strict. Point lights have no such map:
 * their texel is that of a face of a cube, 2 / map. Slant is left out as well: no texel is
 * stretched over its surface. */
#ifndef GN_IMAGE_TRUTH_H
#define GN_IMAGE_TRUTH_H

#include "image/compare.h"
#include "truth/raycast.h"

struct gn_truth_frame { /* where everything was */
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    double right_ws[3], up_ws[3]; /* axes of the light's plane */
    double extent;                /* side of the map in plane units; 0: nothing to show */
};

struct gn_truth {
    struct gn_mask_truth mask; /* its arrays belong to this */
    struct gn_truth_frame frame;
    bool cached; /* it was read, not made */
    void *memory;
};

struct gn_truth_opts {       /* zero means the default */
    int width_px, height_px; /* 640 x 480 */
    uint32_t camera, light;
    int threads; /* 2 */
    bool no_cache;
};

/* At time 0, with the clips that are on by default. */
bool gn_truth_load(struct gn_truth *truth, const char *scene_path, const struct gn_truth_opts *opts,
                   struct gn_err *err);
/* The same of a scene in memory, never cached. */
bool gn_truth_make(struct gn_truth *truth, const struct gn_scene *scene,
                   const struct gn_truth_opts *opts, struct gn_err *err);
void gn_truth_finish(struct gn_truth *truth);

/* One texel in plane units, for a map of so many pixels. */
double gn_truth_texel(const struct gn_truth *truth, unsigned map_px);
/* A point in the light's plane; false behind a spot. */
bool gn_truth_plane(const struct gn_truth_frame *frame, const float point_ws[3], double out[2]);
/* Fills mask.band_px with two texels of that map in pixels, at least 2; returns the mean over what
 * is not background. */
double gn_truth_band(struct gn_truth *truth, unsigned map_px);
/* Fills mask.safe_px: 5, or so many texels of that map where they are more, as long as a texel can
 * get on a surface of that slant; nowhere where the cosine to the light is at most .25. */
void gn_truth_safe(struct gn_truth *truth, unsigned map_px, double reach_texels);

/* The gap at contacts. A contact is a dark pixel on a surface that faces the light, next to (and
 * not merely in front of) a surface that turns away from it: the foot of a wall on its shadow side.
 * Its gap is the way, as the light sees it, to the nearest dark pixel of the shot on the same item.
 */
struct gn_contact {
    int contacts;            /* pixels */
    double mean, p99, worst; /* texels */
};
void gn_truth_contact(const struct gn_truth *truth, const struct gn_picture *shot, unsigned map_px,
                      struct gn_contact *contact);

#endif
