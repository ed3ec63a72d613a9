/* What the files of this room share. */
#ifndef GN_DIAL_PRIVATE_H
#define GN_DIAL_PRIVATE_H

#include "dial/dial.h"

#define GN_DIAL_RADIANS 0.017453292519943295

static inline double gn_dial_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline void gn_dial_cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}
/* The celestial equator at an hour angle, and the north pole: unit vectors, world space. */
void gn_dial_equator(double latitude_deg, double hour_deg, double out[3]);
void gn_dial_pole(double latitude_deg, double out[3]);

/* Makes faces and sizes; fails for what cannot be. */
bool gn_dial_place_faces(struct gn_dial *dial, struct gn_err *err);
/* Draws: hours and rings, then the panel under them. */
void gn_dial_draw_hours(struct gn_dial *dial);
void gn_dial_draw_panel(struct gn_dial *dial);

/* ---- strokes.c ---- */

/* A stroke of these points, which are copied. */
void gn_dial_stroke(struct gn_dial *dial, struct gn_dial_stroke stroke, const double (*points)[2],
                    int count);
struct gn_dial_text {
    int face;
    enum gn_dial_role role;
    double at[2], up[2]; /* its centre, and the unit vector to its top */
    double height_m;
};
/* Capital letters, digits, + - . and * for degrees; others are left out. */
void gn_dial_write(struct gn_dial *dial, const struct gn_dial_text *how, const char *text);
double gn_dial_text_width(const char *text, double height_m);

#endif
