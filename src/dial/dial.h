/* Sundials by formulas: where the hour lines of a plate run, what is drawn on it, its model and its
 * pattern for cutting. Pure: no clock, no files.
 *
 * World space is that of scenes: +x east, +y up, -z north, metres. Points on a face are (right, up)
 * from the centre of its ring, seen from its front, metres. Hour angles are in degrees, 0 at the
 * sun's noon, positive in the afternoon, 15 an hour.
 *
 * Sources: A. E. Waugh, Sundials: Their Theory and Construction (1973); R. R. J. Rohr, Sundials:
 * History, Theory, and Practice (1970). */
#ifndef GN_DIAL_DIAL_H
#define GN_DIAL_DIAL_H

#include <stdbool.h>
#include <stddef.h>

#include "core/err.h"
#include "core/file.h"

#define GN_DIAL_OBLIQUITY_DEG 23.44 /* largest declination of the sun */

/* X(NAME, name) of each kind. */
#define GN_DIAL_KINDS(X)                                                                           \
    X(HORIZONTAL, "horizontal")                                                                    \
    X(VERTICAL, "vertical")                                                                        \
    X(EQUATORIAL, "equatorial")                                                                    \
    X(ANALEMMATIC, "analemmatic")
enum gn_dial_kind {
#define X(NAME, name) GN_DIAL_##NAME,
    GN_DIAL_KINDS(X)
#undef X
        GN_DIAL_KIND_COUNT
};

struct gn_dial_opts {
    enum gn_dial_kind kind;
    double latitude_deg; /* -90 to 90, positive to the north */
    double wall_deg;     /* vertical: where the wall faces, 0 south, 90 west, -90 east, 180 north */
    double shift_deg; /* longitude less that of the meridian whose mean time the dial shows; 0: it
                       * shows the sun's time at its place */
    double size_m;    /* width of the plate; 0: .3 */
    double sun_deg;   /* declination of the model's sun, and of its pin (analemmatic) */
    double sun_hour_deg; /* its hour angle */
};

/* A side of the plate. */
struct gn_dial_face {
    double right[3], up[3], normal[3]; /* unit vectors, world space */
    double centre[3];                  /* of the ring, world space */
    double style[3];                   /* unit vector along the style, away from the face */
    double along[2]; /* unit vector of the style's foot on the face (the substyle); 0, 0: a rod
                      * that is perpendicular to the face, or a pin */
    double foot[2];  /* where the middle of the style meets the face */
    double rise_deg; /* angle between style and face */
};

enum gn_dial_role {
    GN_DIAL_HOUR,
    GN_DIAL_HALF,
    GN_DIAL_QUARTER,
    GN_DIAL_RING,
    GN_DIAL_NUMERAL,
    GN_DIAL_YEAR, /* equation of time, or dates */
    GN_DIAL_ROLE_COUNT
};

/* A line of some width; it is closed when its ends are the same point. */
struct gn_dial_stroke {
    size_t first; /* of its points in gn_dial.points */
    int count;
    int face;
    enum gn_dial_role role;
    double width_m;
    double hour; /* of hour lines and ticks: by the clock, 0 to 23.75; else -1 */
};

struct gn_dial {
    struct gn_dial_opts opts;
    int face_count; /* 2: equatorial, whose first one faces the pole over the horizon */
    struct gn_dial_face faces[2];
    double low[2], high[2]; /* corners of the plate on its first face; the second has low[0] and
                             * high[0] the other way round, which are alike */
    double ring_m;      /* radius of the outer ring; analemmatic: the ellipse's semi-major axis */
    double thickness_m; /* of the gnomon's sheet: its two edges are style edges; rods: diameter */
    double style_m;     /* length of the style, or height of the pin */
    double plate_m;     /* thickness of the plate */
    struct gn_dial_stroke *strokes;
    double (*points)[2];
    size_t stroke_count, stroke_room, point_count, point_room;
};

struct gn_dial_ray {
    double from[2], along[2]; /* along is a unit vector */
    int edge; /* of the sheet, that casts it: 1 to the left of the foot's direction, -1 to the
               * right; 0: both, where the shadow is no wider than the sheet, or a rod */
};

/* Makes the dial and all that is drawn on it. Fails (usage) with one line for what cannot be: a
 * style nearly parallel to its face, an ellipse that is nearly a line. gn_dial_finish frees it,
 * also after a failure. */
bool gn_dial_build(struct gn_dial *dial, const struct gn_dial_opts *opts, struct gn_err *err);
void gn_dial_finish(struct gn_dial *dial);

/* Unit vector to the sun, world space. */
void gn_dial_to_sun(double latitude_deg, double declination_deg, double hour_deg, double out[3]);
/* Where the outer edge of the style's shadow falls on the face at that hour angle, whatever the
 * sun's declination; not for analemmatic dials. */
struct gn_dial_ray gn_dial_hour_ray(const struct gn_dial *dial, int face, double hour_deg);
/* Analemmatic: the point of an hour angle on the ellipse. */
void gn_dial_hour_point(const struct gn_dial *dial, double hour_deg, double out[2]);
/* Analemmatic: how far up the pin stands when the sun has that declination. */
double gn_dial_pin(const struct gn_dial *dial, double declination_deg);
/* Whether the sun shines on the face at that hour angle on some day of the year. */
bool gn_dial_sees(const struct gn_dial *dial, int face, double hour_deg);
/* The hour angle at an hour of the clock, without the equation of time. */
double gn_dial_hour_angle(const struct gn_dial *dial, double hour);
/* A point of a face, `height_m` before it, in world space. */
void gn_dial_place(const struct gn_dial *dial, int face, const double at[2], double height_m,
                   double out[3]);
/* Side view of the gnomon's sheet: along its foot, and away from the face, counter-clockwise from
 * the foot of the style; the style is its last edge. Returns the count of points, at most 24, or 0
 * where it is a rod or a pin. */
int gn_dial_sheet(const struct gn_dial *dial, double (*out)[2]);

/* A scene: the dial on a stand, cameras Dial, Face (straight at the first face) and, of an
 * equatorial one, Back, a sun. Of what
 * is drawn, the tops lie GN_DIAL_RELIEF of the width before the face. gn_bytes_finish frees it. */
#define GN_DIAL_RELIEF 0.0008
void gn_dial_model(const struct gn_dial *dial, struct gn_bytes *out);
/* A pattern in millimetres, 1:1: plate, lines, gnomon. */
void gn_dial_svg(const struct gn_dial *dial, struct gn_bytes *out);

#endif
