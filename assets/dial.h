/* A horizontal sundial that shows the time: hour lines, numerals and the gnomon, computed for a
 * latitude.
 *
 * The plate lies in the pen's xz plane with its surface at y = 0, north towards -z, east towards
 * +x. The shadow's edge of the hour angle h makes with the noon line an angle whose tangent is
 * sin(latitude) tan(h). */
#ifndef GN_ASSETS_DIAL_H
#define GN_ASSETS_DIAL_H

struct gn_shape;

struct gn_dial {
    float latitude;  /* degrees north */
    float radius;    /* of the plate, metres */
    float centre;    /* where the style meets the plate: metres south of the plate's middle */
    float length;    /* of the gnomon's foot, metres */
    float thickness; /* of the gnomon, metres; the noon line is as wide */
};

/* Rings, hour lines from five to seven and their numerals: thin strips that stand 4 to 7 mm proud.
 */
void gn_dial_inlay(struct gn_shape *shape, const struct gn_dial *dial);
/* A plate whose upper edge is parallel to the earth's axis, scalloped at the back, pierced by a
 * star. */
void gn_dial_gnomon(struct gn_shape *shape, const struct gn_dial *dial);
/* Unit vector towards the sun; `declination` in degrees, `hour` in true solar time, 12 at noon. */
void gn_dial_sun(const struct gn_dial *dial, float declination, float hour, float out[3]);

#endif
