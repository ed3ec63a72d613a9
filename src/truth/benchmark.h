/* The open benchmark (assets/benchmark): classes of scenes, the truth of a scene as a picture, and
 * how far another picture is from it. */
#ifndef GN_TRUTH_BENCHMARK_H
#define GN_TRUTH_BENCHMARK_H

#include "core/err.h"
#include "scene/scene.h"

enum gn_benchmark_class {
    GN_BENCHMARK_FIELD,   /* casters of all kinds on a ground, lit by a light without size */
    GN_BENCHMARK_COARSE,  /* coarse meshes with smooth normals, the same lights */
    GN_BENCHMARK_CONTACT, /* a box on a ground */
    GN_BENCHMARK_RODS,    /* casters of 3 cm in the light of a spot 12 m away */
    GN_BENCHMARK_SCALED,  /* boxes in nodes of mirrored, uneven scale */
    GN_BENCHMARK_SOFT,    /* penumbrae of a light with a size */
    GN_BENCHMARK_THIN,    /* thin blockers high above others */
    GN_BENCHMARK_CLASS_COUNT,
};
enum gn_benchmark_measure {
    GN_BENCHMARK_ACNE, /* the first six in per cent, as truth/mask.h has them */
    GN_BENCHMARK_DARKENING,
    GN_BENCHMARK_DARKENED,
    GN_BENCHMARK_LEAK,
    GN_BENCHMARK_GAP,
    GN_BENCHMARK_WRONG,
    GN_BENCHMARK_PENUMBRA, /* four, 0 to 1, as truth/penumbra.h has them */
    GN_BENCHMARK_REST,
    GN_BENCHMARK_BIAS,
    GN_BENCHMARK_GRAIN,
    GN_BENCHMARK_TEAR, /* the last two in per cent per pixel, as truth/tear.h has them, of
                          visibility alone: orientation and edges of things are not in a truth's
                          file */
    GN_BENCHMARK_PIXEL_GRAIN,
    GN_BENCHMARK_MEASURE_COUNT,
};
struct gn_benchmark_class_row {
    const char *name;
    int width_px, height_px;         /* of its pictures */
    bool soft;                       /* the truth is a share of the light; else 0 or 1 */
    enum gn_benchmark_measure merit; /* its figure of merit; less is better */
};
extern const struct gn_benchmark_class_row gn_benchmark_classes[GN_BENCHMARK_CLASS_COUNT];
/* As in files, before the unit. */
extern const char *const gn_benchmark_measures[GN_BENCHMARK_MEASURE_COUNT];

/* The parts of a scene's name: CLASS-LIGHT or CLASS-LIGHT-MORE, of a to z, 0 to 9 and '-'. */
struct gn_benchmark_name {
    enum gn_benchmark_class kind;
    char light[8]; /* sun, spot, point */
};
/* False: no scene can have that name. */
bool gn_benchmark_name_parse(const char *text, struct gn_benchmark_name *name);

/* Three values a pixel, row 0 on top, of a picture of the class' size, by camera 0 and light 0, at
 * time 0. The first is the visibility. Of a scene that is not soft the second is the distance to
 * the nearest edge (gn_mask_edges) divided by the width of edges there, which is two texels of a
 * map of 1024 and at least 2 pixels: over 1 is away from edges; the third is this distance in such
 * texels, each as long as it gets on a surface of that slant, 0 where it is under 5 pixels or the
 * cosine to the light is at most .25. Both are multiples of 1/256, so that they are the same with
 * any library of mathematics. Else they are 0. rgb: of gn_benchmark_pixels() x 3. */
bool gn_benchmark_make(const struct gn_scene *scene, enum gn_benchmark_class kind, float *rgb,
                       struct gn_err *err);
size_t gn_benchmark_pixels(enum gn_benchmark_class kind);

struct gn_benchmark_score {
    double of[GN_BENCHMARK_MEASURE_COUNT]; /* NAN: not measured in this class */
};
/* Of two such pictures. Of the shot the first value counts; what is no number is dark. Safely lit
 * pixels are at least reach_texels from edges: as wide as the shadow's filter is to each side. */
void gn_benchmark_compare(enum gn_benchmark_class kind, const float *truth, const float *shot,
                          double reach_texels, struct gn_benchmark_score *score);
/* The means of some; NAN where none is measured. */
void gn_benchmark_mean(const struct gn_benchmark_score *scores, size_t count,
                       struct gn_benchmark_score *mean);

#endif
