/* The true picture of a scene's hard shadow: what every pixel shows and whether the middle of the
 * light is seen from there, and how large a texel of a well-fitted shadow map is there.
 *
 * The texel is estimated without asking the renderer: the map is the smallest square, upright in
 * the light's plane, around (casters, as the light sees them) intersected with (places that the
 * picture shows, as the light sees them), for a spot within its cone. The light's plane has metres
 * (directional) or tangents (spot) as its unit. A real fit cannot know the picture, so its texels
 * are rather larger, and a measure in units of ours rather strict. Point lights have no such map:
 * their texel is that of a face of a cube, 2 / map. Slant is left out as well: no texel is
 * stretched over its surface. */
#ifndef GN_TRUTH_SIGHT_H
#define GN_TRUTH_SIGHT_H

#include "truth/mask.h"
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
    bool cached; /* it was read from a file, not made */
    void *memory;
};

struct gn_truth_opts {       /* zero means the default */
    int width_px, height_px; /* 640 x 480 */
    uint32_t camera, light;
    int threads;                /* 2 */
    bool no_cache;              /* of what keeps it in a file */
    const struct gn_pose *pose; /* NULL: at time 0, with the clips that are on by default. For
                                   gn_truth_make() and gn_truth_cast() only */
};

bool gn_truth_make(struct gn_truth *truth, const struct gn_scene *scene,
                   const struct gn_truth_opts *opts, struct gn_err *err);
void gn_truth_finish(struct gn_truth *truth);

/* The two halves of it: width x height pixels, which can be kept in a file, and the arrays. */
struct gn_truth_pixel {
    float normal_ws[3], distance_m;
    int32_t item; /* -1: background */
    uint32_t lit;
};
struct gn_truth_opts gn_truth_fill(const struct gn_truth_opts *opts); /* with its defaults */
bool gn_truth_cast(struct gn_truth_frame *frame, struct gn_truth_pixel *pixels,
                   const struct gn_scene *scene, const struct gn_truth_opts *opts,
                   struct gn_err *err);
void gn_truth_unpack(struct gn_truth *truth, const struct gn_truth_frame *frame,
                     const struct gn_truth_pixel *pixels);

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
/* Width in pixels, at pixel i, of such a texel on a surface that faces light and eye. */
double gn_truth_texel_px(const struct gn_truth *truth, double texel, size_t i);
/* Cosine of the angle between the normal and the direction to the light. */
double gn_truth_facing(const struct gn_truth *truth, size_t i);

#endif
