/* Curved meshes: surfaces given by a function, smooth profiles, boxes with round edges. */
#ifndef GN_ASSETS_FORM_H
#define GN_ASSETS_FORM_H

struct gn_shape;

/* A point of a surface; u and v from 0 to 1, and a little beyond for the normals. */
typedef void gn_surface_fn(float u, float v, const void *what, float out[3]);

struct gn_surface {
    gn_surface_fn *at;
    const void *what;
    int across, up; /* cells in u and v */
    float uv[2];    /* texture extent of the whole surface, metres */
};
/* The outside is where u turns into v counter-clockwise. */
void gn_shape_surface(struct gn_shape *shape, const struct gn_surface *surface);

/* A box centred on the pen with edges of that radius; `steps` cells per quarter of the circle. */
void gn_shape_soft_box(struct gn_shape *shape, const float size[3], float radius, int steps);

/* Round bar through the points like gn_shape_tube, smoothed by Catmull-Rom splines, whose radius
 * goes from `from` to `to`. */
void gn_shape_vine(struct gn_shape *shape, const float (*points)[3], int count, float from,
                   float to, int section);

/* Puts `steps` points on each span of the profile, on Catmull-Rom splines through its points; a
 * point given twice is a corner. Returns the count, at most `room`. */
int gn_profile_smooth(const float (*points)[2], int count, int steps, float (*out)[2], int room);

#endif
