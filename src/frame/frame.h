/* The builder of frame plans (frame/plan.h). */
#ifndef GN_FRAME_FRAME_H
#define GN_FRAME_FRAME_H

#include "frame/orbit.h"
#include "frame/plan.h"
#include "shadow/light_opts.h"

/* In all options zero means the default written beside. */

struct gn_frame_shadow_opts { /* limits, and what is set for lights */
    uint32_t cascades;        /* limit per light; 4 */
    uint64_t filter_texels; /* of filtered maps that one frame makes again, if that is more than one
                               map; others stay as they are for a while. 0: all are made */
    uint64_t maps_bytes; /* limit on what shadows take on the GPU: maps, their pages, what they are
                            filtered into. Maps over it are made smaller. 0: none */
    uint64_t triangles;  /* limit on what a frame draws, maps included; the weakest lights cast no
                            shadow where it is more. 0: none */
    bool planar_in_stencil;   /* planar lights have no map: casters go into the picture's stencil */
    uint32_t planar_points;   /* else 0: shadows of a point; or of so many points of the lamp (16 to
                                 256, a power of two), their mean */
    uint32_t gather_points;   /* of them, that one frame adds to a mask; 0: all. A mask has as many
                                 when something moves that it shows, and more with each frame in
                                 which nothing does */
    bool taps_fixed;          /* the same for every pixel */
    bool clears_near;         /* maps are cleared to the wrong end, for the lesson about it; far */
    struct gn_light_opts any; /* of all lights; `light` has no meaning */
    struct gn_light_opts lights[GN_ALL_LIGHTS_MAX]; /* of one light; each light once */
    uint32_t light_count;
};

struct gn_frame_view_opts {
    int camera;            /* 0; of the scene, there */
    uint32_t light_plus_1; /* the view of that light, a spot or a directional one, in place of the
                              camera's; 0: none */
    struct gn_orbit orbit; /* the camera moved by the user */
    struct gn_framing_opts framing; /* but its aspect, which is that of the picture */
    float turntable_rad; /* the camera is rotated about +Y through the scene's centre by this */
    int shift_px[2]; /* scene and captions stand so far to the right and up in the picture; captions
                        no further than its edge */
    float aside_px[2]; /* the same of the scene alone: parts of a pixel */
    double sun_utc_s;  /* of the sun (stage/sun.h), which is in the pose and the lights: frames do
                          not  read it */
};

struct gn_frame_debug_opts { /* what is drawn instead of the picture, or over it */
    enum gn_aov aov;         /* GN_AOV_COLOR: the picture */
    int light;        /* for visibility: index in the scene; out of range: everything is lit */
    bool faced;       /* visibility: dark, too, where a surface is turned away from the light, even
                         if it casts no shadow */
    bool show_lights; /* draw a gizmo at each light */
    bool show_maps;   /* draw the maps as panels along the lower edge */
};

enum gn_environment_show { /* as the background */
                           GN_ENVIRONMENT_SHOW_NO,
                           GN_ENVIRONMENT_SHOW_SHARP, /* as in a mirror */
                           GN_ENVIRONMENT_SHOW_BLUR,
};
struct gn_frame_environment_opts {
    const struct gn_environment *of; /* NULL: none; must stay as it is while plans use it */
    uint64_t id;                     /* of its content */
    bool lights_key;     /* the light that was made for the scene is its key: only the rest is the
                            environment. Its colour and radius are among shadow.lights, its
                            direction is in the pose */
    bool shows_key;      /* with lights_key: the light has the key's place and colour, so that
                            smooth surfaces may reflect the key as the environment has it */
    bool reflected_only; /* in materials that need reflections alone; the hemispheres stay */
    enum gn_environment_show show; /* in place of opts->background, unless that is transparent */
    float turn_rad;                /* about +Y */
    float strength;                /* factor on its radiance; 0: it gives no light */
    bool is_sky;                   /* the sun's (stage/sun.h), made again as that moves */
};

struct gn_frame_occlusion_opts { /* ambient occlusion of what stays where it is, on diffuse light of
                                    an environment and on reflections beside it */
    bool on;                     /* programs are made for it, also before there are texels */
    const int8_t (*texels)[4]; /* of the scene's grid (scene.h), times 127; NULL: none is occluded.
                                  Must stay as they are while plans use them */
    uint64_t id;               /* of their content, of all scenes; 0: NULL */
};

struct gn_frame_detail_opts {   /* levels of detail in place of whole meshes */
    const struct gn_detail *of; /* of the scene; NULL: meshes are whole. Must stay as it is while
                                   plans use it */
    float px;                   /* error that is allowed, pixels; 0: 1 */
};

struct gn_frame_output_opts {     /* what the picture is drawn to: assigned whole */
    uint32_t width_px, height_px; /* 1280 x 720 */
    unsigned turn_deg;            /* 0, 90, 180, 270: the picture stands in the output turned
                                     clockwise by this; by 90 it is height_px wide */
    float scale;       /* of colour: the scene is drawn at this share of that width and height, and
                          scaled, captions are not; 0: 1 */
    bool scaled_later; /* by the display: the picture stays as it is drawn. It has no captions then,
                          and is not dimmed */
    uint32_t msaa;
    bool unencoded;      /* its framebuffer does not encode: shaders do */
    bool linear, floats; /* it stores linear bytes, or half floats */
    bool keeps_alpha;    /* alpha has a meaning there: a file */
};
struct gn_frame_cover_opts {               /* what lies over the finished picture */
    const struct gn_caption_run *captions; /* of a picture of this size; none. Colour only */
    float dimmed;     /* share of its light that the picture loses, captions too; 0: none */
    float mean;       /* share of a mean of pictures that lies over the picture, below captions */
    uint32_t mean_of; /* the number of the view that gathered it */
};

struct gn_frame_opts {
    struct gn_frame_shadow_opts shadow;
    struct gn_frame_environment_opts environment;
    struct gn_frame_occlusion_opts occlusion;
    struct gn_frame_detail_opts detail;
    struct gn_frame_view_opts view;
    struct gn_frame_debug_opts debug;
    struct gn_frame_output_opts output;
    struct gn_frame_cover_opts cover;
    enum gn_background {
        GN_BACKGROUND_SCENE, /* as the scene has it */
        GN_BACKGROUND_SKY,   /* the hemisphere's horizon, whatever the scene has */
        GN_BACKGROUND_COLOR,
        GN_BACKGROUND_TRANSPARENT, /* where the output keeps alpha; else black */
    } background;
    float background_color[3]; /* linear */
    enum gn_tone tone;         /* AUTO: as gn_frame_choose_tone() decides */
    bool exposure_given;
    float exposure_ev; /* stops, when given; else automatic */
    uint64_t overdraw; /* limit on how often a frame draws a pixel, on average: opaque ones and
                          those of a map count a quarter. Instances over it, by an estimate, are
                          left out with a warning. 0: none */
    bool all_seen;     /* no culling: for programs that will be needed later */
    uint32_t number;   /* as gn_plan.view */
    struct {
        float part, whole;
        bool sums;
    } gather; /* This picture goes into a mean of some, with the weight `part`, 1: the first; that
                 then into the view's mean, with the weight `whole`, 0: not yet, 1: the first. 0, 0:
                 it is a picture. sums: the part is their sum, which half floats have exactly where
                 pictures are 0 or 1. Needs rgba16f targets, and a tone that is mapped as surfaces
                 are drawn: else plan.gathers is false */
};

/* How many of the pixels of a side are drawn at that scale; even, as displays want them. */
uint32_t gn_frame_scaled_px(uint32_t px, float scale);
/* overlay.c: where a rectangle of a picture of that size, before it is turned, is in the output
 * that has it turned clockwise by 0, 90, 180 or 270 degrees. */
struct gn_rect gn_frame_turned_rect(unsigned turn_deg, uint32_t width_px, uint32_t height_px,
                                    struct gn_rect rect);

/* eye.c: on which side of the scene's centre the camera looks from, about the vertical axis: 0 from
 * +Z, towards +X. Moved by the user and by the turntable; never that of a light. */
float gn_frame_camera_azimuth(const struct gn_pose *pose, const struct gn_frame_view_opts *view);
/* The camera of a picture of this shape, which plans and rays both are of: moved by the user and
 * the turntable, its near and far planes around the scene, the near one as far out as the nearest
 * box of an item in view allows, its orthographic half-sizes those of the picture. */
void gn_frame_camera(const struct gn_pose *pose, const struct gn_frame_view_opts *view,
                     float aspect, struct gn_framing *framing);

struct gn_frame; /* the builder: keeps its memory from frame to frame, allocates only while growing
                  */
struct gn_frame *gn_frame_create(const struct gn_scene *scene, const struct gn_caps *caps);
void gn_frame_destroy(struct gn_frame *frame);
/* opts.c: what holds for a light once a plan was built: its own options, else those of all lights
 * (but a light that casts no shadow in the scene casts none), else the scene at this pose. A field
 * that none of them has is zero, or automatic. */
struct gn_light_opts gn_frame_light_opts(const struct gn_frame *frame, const struct gn_pose *pose,
                                         const struct gn_frame_opts *opts, uint32_t light);
/* Builds the plan of this pose. Never fails: what cannot be is left out with a warning, which a
 * builder gives once, and once more when options change. */
const struct gn_plan *gn_frame_build(struct gn_frame *frame, const struct gn_pose *pose,
                                     const struct gn_frame_opts *opts,
                                     struct gn_warnings *warnings);

/* Lux by a light of that colour on a surface at the scene's centre that faces it; ignores cones. */
float gn_frame_illuminance(const struct gn_pose *pose, uint32_t light, const float color[3]);

#endif
