/* The builder of frame plans (frame/plan.h). */
#ifndef GN_FRAME_FRAME_H
#define GN_FRAME_FRAME_H

#include "frame/orbit.h"
#include "frame/plan.h"

/* In all options zero means the default written beside. */

/* What holds for one light, whatever options say of all and the scene says of it. */
enum gn_light_given {
    GN_LIGHT_TECHNIQUE = 1,
    GN_LIGHT_FORMAT = 2, /* encoding and moments */
    GN_LIGHT_MAP_PX = 4,
    GN_LIGHT_STRENGTH = 8,
    GN_LIGHT_RADIUS = 16,
    GN_LIGHT_CASCADES = 32,
    GN_LIGHT_FACES = 64,
    GN_LIGHT_SLIDE = 128,
    GN_LIGHT_SPECULAR = 256,
    GN_LIGHT_BIAS = 512,
    GN_LIGHT_FILTER = 1024,
    GN_LIGHT_TAPS = 2048,
    GN_LIGHT_SLIDE_FAR = 4096,
    GN_LIGHT_COLOR = 8192,
    GN_LIGHT_OFF = 16384, /* it does not shine */
};
struct gn_frame_light_opts { /* all of 4 bytes: hashed */
    uint32_t light;          /* index in the scene */
    uint32_t given;          /* bits: enum gn_light_given */
    enum gn_technique technique;
    enum gn_encoding encoding;
    enum gn_moments moments;
    uint32_t map_px;
    float strength;
    float specular;    /* below 0: as much as of the rest */
    float radius;      /* as in gn_light */
    uint32_t cascades; /* as cascade_count */
    int faces;         /* as below, and the next */
    uint32_t slide_as_picture;
    float slide_far_m;      /* as in gn_light; below 0: the scene's */
    float bias_texels;      /* below 0: the technique's */
    float filter_radius_px; /* 0: the technique's */
    uint32_t taps;          /* as below */
    float color[3];         /* as in gn_light; does not change an automatic exposure */
};

struct gn_frame_shadow_opts { /* overrides of what lights ask for, and limits */
    bool technique_given; /* `technique` overrides the lights' own and the default pcf; a light's
                             own none holds */
    enum gn_technique technique;
    enum gn_encoding encoding; /* GN_ENCODING_AUTO must be set for the automatic choice */
    enum gn_moments moments;   /* of techniques that filter their map; NONE: the automatic choice */
    uint32_t map_px;           /* 0: the light's, else the technique's */
    uint32_t cascades;         /* limit per light; 4 */
    uint32_t cascade_count; /* so many of each light that can have them; 0: as few as are enough */
    uint64_t filter_texels; /* of filtered maps that one frame makes again, if that is more than one
                               map; others stay as they are for a while. 0: all are made */
    uint64_t maps_bytes; /* limit on what shadows take on the GPU: maps, their pages, what they are
                            filtered into. Maps over it are made smaller. 0: none */
    uint64_t triangles;  /* limit on what a frame draws, maps included; the weakest lights cast no
                            shadow where it is more. 0: none */
    bool planar_in_stencil; /* planar lights have no map: casters go into the picture's stencil */
    uint32_t planar_points; /* else 0: shadows of a point; or of so many points of the lamp (16 to
                               256, a power of two), their mean */
    uint32_t gather_points; /* of them, that one frame adds to a mask; 0: all. A mask has as many
                               when something moves that it shows, and more with each frame in
                               which nothing does */
    unsigned taps;          /* a multiple of 4 to GN_TAPS_MAX; cone: 8 to 16; 0: 16, cone 12 */
    bool taps_fixed;        /* the same for every pixel */
    int faces; /* which faces of all casters go into maps: 0: as the scene says of each, else 1 +
                  enum gn_cast_faces. Not of planar lights */
    bool bias_given;
    float bias_texels;      /* in place of the techniques' */
    float filter_radius_px; /* radius of filters that can have another one; 0: the techniques' */
    bool clears_near;       /* maps are cleared to the wrong end, for the lesson about it; far */
    bool slide_as_picture;  /* a slide without a size has the shape of its picture; square */
    bool slide_far_given;
    float slide_far_m; /* overrides gnomon_slide_far_m of lights */
    bool strength_given;
    float strength; /* overrides the lights' gnomon_shadow_strength */
    bool specular_given;
    float specular; /* share of highlights that shadows leave; below 0: as much as of the rest */
    struct gn_frame_light_opts lights[GN_ALL_LIGHTS_MAX]; /* each light once */
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
};

struct gn_frame_debug_opts { /* what is drawn instead of the picture, or over it */
    enum gn_aov aov;         /* GN_AOV_COLOR: the picture */
    int light;        /* for visibility: index in the scene; out of range: everything is lit */
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
    float strength;                /* factor on its radiance; must be set */
};

struct gn_frame_output_opts {     /* what the picture is drawn to: assigned whole */
    uint32_t width_px, height_px; /* 1280 x 720 */
    unsigned turn_deg;            /* 0, 90, 180, 270: the picture stands in the output turned
                                     clockwise by this; by 90 it is height_px wide */
    uint32_t msaa;
    bool unencoded;      /* its framebuffer does not encode: shaders do */
    bool linear, floats; /* it stores linear bytes, or half floats */
    bool keeps_alpha;    /* alpha has a meaning there: a file */
};
struct gn_frame_cover_opts {               /* what lies over the finished picture */
    const struct gn_caption_run *captions; /* of a picture of this size; none. Colour only */
    bool captions_later;                   /* include their program even without captions */
    float dimmed; /* share of its light that the picture loses, captions too; 0: none */
};

struct gn_frame_opts {
    struct gn_frame_shadow_opts shadow;
    struct gn_frame_environment_opts environment;
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
    bool all_seen;     /* no culling: for programs that will be needed later */
};

/* What options say of that light of the scene alone; nothing given: no such options. */
struct gn_frame_light_opts gn_frame_light_opts(const struct gn_frame_opts *opts, uint32_t light);
/* eye.c: on which side of the scene's centre the camera looks from, about the vertical axis: 0 from
 * +Z, towards +X. Moved by the user and by the turntable; never that of a light. */
float gn_frame_camera_azimuth(const struct gn_pose *pose, const struct gn_frame_view_opts *view);
/* The camera of a picture of this shape, which plans and rays both are of: moved by the user and
 * the turntable, its near and far planes around the scene, its orthographic half-sizes those of the
 * picture. */
void gn_frame_camera(const struct gn_pose *pose, const struct gn_frame_view_opts *view,
                     float aspect, struct gn_framing *framing);

struct gn_frame; /* the builder: keeps its memory from frame to frame, allocates only while growing
                  */
struct gn_frame *gn_frame_create(const struct gn_scene *scene, const struct gn_caps *caps);
void gn_frame_destroy(struct gn_frame *frame);
/* Builds the plan of this pose. Never fails: what cannot be is left out with a warning, which a
 * builder gives once, and once more when options change. */
const struct gn_plan *gn_frame_build(struct gn_frame *frame, const struct gn_pose *pose,
                                     const struct gn_frame_opts *opts,
                                     struct gn_warnings *warnings);

#endif
