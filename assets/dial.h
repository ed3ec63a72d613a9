/* A horizontal sundial that shows the time: hour lines, numerals and the gnomon, computed for a
 * latitude.
 *
 * The plate lies in the pen's xz plane with its surface at y = 0, north towards -z, east towards
 * +x. At hour angle h the edge of the shadow makes an angle with the noon line whose tangent is
 * sin(latitude) tan(h). */
#ifndef GN_ASSETS_DIAL_H
#define GN_ASSETS_DIAL_H

struct gn_shape;

struct gn_dial {
    float latitude; /* degrees north */
    float radius;   /* of the plate, metres */
    float centre; /* distance from the plate's centre, south, to where the style meets it, metres */
    float length; /* of the gnomon's foot, metres */
    float thickness; /* of the gnomon and width of the noon line, metres */
};

/* Rings, hour lines from five to seven and their numerals: thin strips, raised by 4 to 7 mm. */
void gn_dial_inlay(struct gn_shape *shape, const struct gn_dial *dial);
/* Gnomon: an upright plate whose upper edge is parallel to the earth's axis, with a curved back
 * edge and a star-shaped hole. */
void gn_dial_gnomon(struct gn_shape *shape, const struct gn_dial *dial);
/* Unit vector towards the sun; `declination` in degrees, `hour` in true solar time, 12 is noon. */
void gn_dial_sun(const struct gn_dial *dial, float declination, float hour, float out[3]);

#endif
