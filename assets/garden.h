/* Shared by the parts of the sundial scene: textures, materials, placement of objects. +x is east,
 * -z north; the court is a circle of 7 m about the origin. */
#ifndef GN_ASSETS_GARDEN_H
#define GN_ASSETS_GARDEN_H

#include "shape/shapes.h"

#define GN_RADIANS  (float)(3.14159265358979 / 180)
#define GN_LATITUDE 50.0f /* degrees north */
#define GN_COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

enum gn_picture {
    NO_PICTURE,
    GRAIN,
    PAVING,
    TIMBER,
    BUSH,
    LATTICE,
    BRANCH,
    WINDOW,
    GRASS,
    SKYLINE,
    PICTURES
};
enum gn_surface {
    COURT,
    LAWN,
    STONE,
    MARBLE,
    LIME,
    BRONZE,
    INLAY,
    WOOD,
    BARK,
    HEDGE,
    SCREEN,
    LEAVES,
    IRON,
    GLASS,
    PANE,
    GLOW,
    GULL,
    VISTA,
    SURFACES
};

struct gn_glb;
struct gn_glb_camera;
struct gn_image;
struct gn_garden;

struct gn_place {
    float x, y, z; /* metres */
    float yaw;     /* degrees about +y */
};

/* A surface that looks otherwise in a scene. */
struct gn_tint {
    enum gn_surface surface;
    float rgba[4], metal, rough;
    enum gn_picture picture;
};

/* Of a scene: what is in it, and where. */
struct gn_garden_plan {
    void (*parts[32])(struct gn_garden *); /* in the order of the file; NULL ends them */
    struct gn_tint tints[8];               /* roughness 0 ends them */
    struct gn_place lamp; /* the middle of the lantern, and where its post stands */
    float slide[3];       /* where the window falls that the lantern projects */
    struct gn_place columns[4], globe, armillary, arches, bench, screen, hoop, urns[2], trees[3];
    float column_scale;    /* 0 means 1 */
    float cypresses[8][3]; /* x, z, scale; 0 ends them */
    float lap;             /* of the gull: the fraction of it at the start */
    bool vista;            /* it has the pictures and the surface of the landscape */
};
extern const struct gn_garden_plan gn_sundial, gn_yard;

struct gn_garden {
    struct gn_glb *glb;
    const struct gn_garden_plan *plan;
    int pictures[PICTURES], surfaces[SURFACES]; /* handles in glb */
};

/* Adds the textures and materials to garden->glb. */
void gn_garden_init(struct gn_garden *garden, struct gn_glb *glb,
                    const struct gn_garden_plan *plan);

/* An empty shape whose UVs suit the surface. */
struct gn_shape gn_garden_begin(enum gn_surface surface);
/* Makes a mesh of the shape and frees the shape. */
int gn_garden_mesh(struct gn_garden *garden, const char *name, struct gn_shape *shape,
                   enum gn_surface surface);
/* Adds a node with the mesh; `extras` is a JSON object or NULL. Returns the node. */
int gn_garden_stand(struct gn_garden *garden, const char *name, int mesh, struct gn_place at,
                    const char *extras);
/* Adds a mesh and a node for a shape that is already in scene coordinates. Frees the shape. */
void gn_garden_put(struct gn_garden *garden, const char *name, struct gn_shape *shape,
                   enum gn_surface surface);

/* court.c: walls, the dial, the lamp post, lights and views */
void gn_garden_add_wall(struct gn_garden *garden);
void gn_garden_add_hedge(struct gn_garden *garden);
void gn_garden_add_gate(struct gn_garden *garden);
void gn_garden_add_plinth(struct gn_garden *garden);
void gn_garden_add_dial(struct gn_garden *garden);
void gn_garden_add_lamp_post(struct gn_garden *garden);
void gn_garden_add_lights(struct gn_garden *garden);
void gn_garden_add_view(struct gn_garden *garden, const struct gn_glb_camera *lens,
                        const float eye[3], const float target[3]);

/* landscape.c: lawn, hills and sky. It casts no shadow, and only the lawn receives any. */
void gn_garden_add_landscape(struct gn_garden *garden);
/* Its picture, 60 degrees of it, to be repeated. */
void gn_garden_paint_vista(struct gn_image *image);

/* ornaments.c: static objects */
void gn_garden_add_portico(struct gn_garden *garden);
void gn_garden_add_bench(struct gn_garden *garden);
void gn_garden_add_urns(struct gn_garden *garden);
void gn_garden_add_balls(struct gn_garden *garden);
void gn_garden_add_globe(struct gn_garden *garden);
void gn_garden_add_armillary(struct gn_garden *garden);
void gn_garden_add_arches(struct gn_garden *garden);
void gn_garden_add_canes(struct gn_garden *garden);
void gn_garden_add_fence(struct gn_garden *garden);
void gn_garden_add_screen(struct gn_garden *garden);
void gn_garden_add_trees(struct gn_garden *garden);
void gn_garden_add_cypresses(struct gn_garden *garden);

/* movers.c: animated objects, with a period of twelve seconds */
void gn_garden_add_hoop(struct gn_garden *garden);
void gn_garden_add_gull(struct gn_garden *garden);

#endif
