/* Settings: a value for each option of the table, resolved, and where each comes from. They are
 * made once, as the configuration is read (options.h): one for each mode, one without. Drawing
 * never changes them, and entering a mode is choosing a pointer; `ctl set` replaces them by others
 * (change.h), and the kiosk puts other scenes in their place (kiosk/begin.c, reload.c, offers.c).
 */
#ifndef GN_OPTIONS_SETTINGS_H
#define GN_OPTIONS_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "options/schedule.h"
#include "options/table.h"
#include "scene/scene.h"
#include "shadow/light_opts.h"
#include "shadow/technique.h"

struct gn_size {
    int width_px, height_px;
};
struct gn_display_mode {
    int width_px, height_px;
    double hz; /* 0: any */
};
#define GN_LIMITS_MAX 16
struct gn_limit {
    const char *name;
    int64_t value;
};
struct gn_limits {
    int count;
    struct gn_limit items[GN_LIMITS_MAX]; /* as they were given */
    struct gn_scene_limits all;           /* what they make */
};
/* What the path of a lesson's scene inside the program begins with: "lesson:solids". */
#define GN_SCENE_LESSON "lesson:"
struct gn_scene_list {
    const char *paths[GN_SCENES_MAX]; /* [0] NULL: the default scene inside the program */
    int count;
};
struct gn_technique_list { /* each once */
    int count;
    uint8_t items[GN_TECHNIQUE_COUNT + 1]; /* enum gn_technique */
};
enum { GN_MSAA_AUTO = -1 };
enum { GN_SHOW_SCENE = -1, GN_SHOW_TRANSPARENT = -2, GN_SHOW_SKY = -3 }; /* --background */
enum gn_picture { GN_PICTURE_SRGB, GN_PICTURE_LINEAR };                  /* --output */

enum gn_source {
    GN_SOURCE_DEFAULT,
    GN_SOURCE_INI,
    GN_SOURCE_MODE,
    GN_SOURCE_FLAG,
    GN_SOURCE_SET, /* by `ctl set`, until a reload */
};                 /* later ones override earlier ones */

struct gn_override { /* one setting of a section of many, as the file has it */
    const struct gn_option_row *row;
    void *value;       /* as in the field */
    const char *label; /* "kiosk.ini:31: camera" */
    int line;
    struct gn_override *next;
};
struct gn_named_section { /* one of many: [mode "NAME"], [light "NAME"], [button "NAME"] */
    const char *name;
    const char *label; /* "kiosk.ini:31" */
    int line;
    struct gn_override *first; /* in the order of the file; NULL: it sets nothing */
};

/* The setting of a row, or NULL. */
const struct gn_override *gn_section_setting(const struct gn_named_section *section,
                                             const struct gn_option_row *row);
/* Copies what it sets into the struct in which its rows have their offsets. */
void gn_section_fill(const struct gn_named_section *section, void *out);

struct gn_scene_settings {
    union {
        const char *path;          /* list.paths[0]; NULL: the default scene inside the program */
        struct gn_scene_list list; /* that one, and those of next-scene */
    };
    const char *camera, *animation; /* NAME or number; NULL: the first; animation may be "none" */
    const char *variant;            /* NAME or number; "auto" or NULL: none */
    bool no_animation;
    int animation_turns; /* enum gn_pose_turns */
    double animation_speed;
    int64_t animation_start_ns;
    bool animation_restart;
    int64_t time_ns;
    double turntable_deg_s;
    int64_t turntable_rest_ns;
    double floor_m;          /* y of the shadow catcher; NAN: automatic, INFINITY: none */
    double texture_limit_px; /* NAN: automatic, INFINITY: none */
};
enum gn_occlusion_setting { GN_OCCLUSION_AUTO, GN_OCCLUSION_NONE };
enum gn_gather_setting { GN_GATHER_AUTO, GN_GATHER_NONE, GN_GATHER_ALWAYS };
/* --aov of what is no picture of one light: the light's map; hours of sun */
#define GN_AOV_MAP       GN_AOV_COUNT
#define GN_AOV_SUN_HOURS (GN_AOV_COUNT + 1)
enum gn_planar { GN_PLANAR_MASK, GN_PLANAR_STENCIL, GN_PLANAR_SOFT };
struct gn_render_settings {
    struct gn_size size;
    struct gn_technique_list shadow; /* one; for bench any number. Set (gn_settings_given()) it
                                        overrides what lights of the scene name; against [light
                                        "NAME"]: gn_settings_light_holds() */
    int map_px;                      /* likewise */
    int map_format;                  /* GN_MAP_FORMAT() */
    int map_clears_near;             /* 0, 1 */
    int planar;                      /* enum gn_planar */
    int planar_points;
    int cascades;            /* 0: automatic */
    int cast_faces;          /* 0: as the scene says, else 1 + enum gn_cast_faces */
    double bias_texels;      /* NAN: automatic */
    double filter_radius_px; /* likewise */
    int slide_as_picture;    /* 0, 1 */
    double slide_far_m;      /* NAN: as the scene says */
    int taps;
    bool taps_fixed;
    double filter_budget;    /* million texels; 0: no limit */
    double shadow_strength;  /* as shadow */
    double shadow_specular;  /* NAN: as the scene says */
    const char *environment; /* "auto", "studio", "none" or a file; NULL: auto */
    double environment_turn_deg, environment_strength;
    int environment_show; /* enum gn_environment_show */
    int occlusion;        /* enum gn_occlusion_setting */
    int gather;           /* enum gn_gather_setting */
    double detail_px;     /* NAN: automatic, 0: full */
    bool show_lights, show_maps;
    int light; /* number of the light that --aov visibility and map show */
    int aov;   /* enum gn_aov, or one of those below */
    enum gn_picture output;
    double exposure_ev; /* NAN: automatic */
    int tone;           /* enum gn_tone */
    int background;     /* 0xRRGGBB, or below 0: as above */
    int msaa;           /* samples: 0, 2 or 4; GN_MSAA_AUTO: see gn_stage_msaa() */
    const char *font;   /* file, for captions; NULL: the first usual one that exists */
    const char *shaders, *without;
    struct gn_limits limits;
};
struct gn_camera_settings { /* NAN: as the camera has it */
    double theta_deg, phi_deg, distance_m, target_m[3], fov_deg;
    double phi_min_deg, phi_max_deg, distance_min_m, distance_max_m; /* of what the user moves */
};
struct gn_light_settings {             /* of the light made for a scene without any */
    double azimuth_deg, elevation_deg; /* of where it comes from; NAN: as it was made */
    int follows_camera;                /* 0, 1: the azimuth is relative to the camera's */
    int color;                         /* 0xRRGGBB, sRGB; -1: as it is */
    double lux;                        /* NAN: as it is */
    double radius;                     /* as in gn_light */
    double intensity;                  /* only in sections of one light; NAN: as it is */
    bool on;                           /* likewise */
};
struct gn_sun_settings {
    double place_deg[2];                /* latitude, longitude, of the flag; NAN: as below */
    double latitude_deg, longitude_deg; /* NAN: none */
    const char *date;                   /* "now", or what gn_date_parse() reads */
    const char *time_zone;              /* NULL: the system's */
    double speed;
    double azimuth_deg, altitude_deg; /* NAN: by place and date */
    double turbidity;
    bool caption; /* of the moment */
    bool hours;   /* of sun, in false colours */
};
struct gn_display_settings {
    const char *backend, *card, *render_node, *connector;
    struct gn_display_mode mode; /* 0x0: the display's preferred one */
    struct gn_display_mode max_mode;
    const char *modeline;
    int rotate_deg, max_fps; /* 0: as fast as the display */
    int touch_rotate_deg;
    int pixel_shift_px; /* 0: none */
    double scale;       /* of the scene's width and height; NAN: by what the GPU can do */
    bool legacy;
    int range;          /* enum gn_screen_range */
    int console_locked; /* 0, 1 */
};
struct gn_kiosk_settings {
    int idle;        /* enum gn_idle */
    int pointer;     /* enum gn_pointers */
    int plays_alone; /* buttons do nothing while a clip plays once */
    int64_t idle_after_ns, fade_ns, clip_fade_ns;
    const char *socket;      /* NULL: see gn_listen_default() */
    const char *screenshots; /* folder; NULL: none */
    bool watch;
    const char *state;   /* file; "no": none */
    const char *content; /* folder of gnomon take; "no": none */
    bool captions;
    int64_t caption_ns;
};
enum { GN_OFF_BLACK = 1, GN_OFF_CEC = 2 }; /* bits: black, not switched off; the television, too */
struct gn_schedule_settings {
    struct gn_schedule on, dim;
    double dim_to;
    int off;                /* of GN_OFF_.. */
    const char *cec_device; /* NULL: the adapter is found */
    int clock_trusted;      /* 0, 1 */
    int64_t wake_ns;
};
struct gn_run_settings { /* of this run of the program: flags only */
    enum gn_command command;
    const char *input_script;
    const char *config, *mode, *out;
    int topic;           /* of help: of gn_topics, plus 1; 0: none */
    const char *check;   /* a configuration file that is only checked, or NULL */
    bool here;           /* check: on this machine, too */
    const char *caption; /* text on the picture, or NULL */
    int frames;
    double fps;
    const char *from, *to;   /* of hours of sun: as gn_date_parse() reads them, or NULL */
    int samples;             /* points of a light, of technique truth */
    const char *diff;        /* of compare: a file for the difference, or NULL */
    double tolerance, share; /* of compare */
    struct {
        bool measure;
        const char *normal, *distance; /* files, or NULL */
        double to_light[3];            /* any length; NAN: auto */
    } shadows;                         /* of compare */
    const char *truth, *benchmark;     /* of score: a scene's name, or NULL; the folder of scenes */
    double reach;                      /* of score: of a filter, texels */
    bool make_truth;                   /* of score */
    double simplify;                   /* of bake: share of the triangles */
    struct {
        int kind; /* enum gn_dial_kind */
        double latitude_deg, longitude_deg, meridian_deg, wall_deg, width_m;
    } dial;                              /* of dial */
    bool rollback;                       /* of take */
    int on_gpu;                          /* of inspect --for: 1 + enum gn_cost_gpu_id, or 0 */
    bool csv, move_lights, move_casters; /* of bench */
    bool report, compare_reports;        /* of doctor */
    bool plan, json, self_test, stats, verbose, version, help, help_all;
};
struct gn_settings {
    const char *mode; /* the name of their mode, or NULL */
    struct gn_scene_settings scene;
    struct gn_render_settings render;
    struct gn_camera_settings camera;
    struct gn_light_settings light;
    struct gn_sun_settings sun;
    struct gn_display_settings display;
    struct gn_kiosk_settings kiosk;
    struct gn_schedule_settings schedule;
    struct gn_run_settings run;
    const struct gn_named_section *lights; /* [light "NAME"] of the file, the same in every mode */
    int light_count;
    bool several_scenes;                /* some mode or next-scene shows another one */
    uint8_t source[GN_OPTION_COUNT];    /* enum gn_source of each row */
    const char *label[GN_OPTION_COUNT]; /* see gn_settings_label(); NULL: at its default */
};

/* Used while settings are made: sets a value unless a stronger source has set it. The label must
 * outlive the settings. */
void gn_settings_put(struct gn_settings *settings, const struct gn_option_row *row,
                     const void *value, enum gn_source source, const char *label);

const void *gn_settings_value(const struct gn_settings *settings, const struct gn_option_row *row);
/* As it is written in a file: "pcf", "1280x720", "auto". */
void gn_settings_text(const struct gn_settings *settings, const struct gn_option_row *row,
                      char *out, size_t size);

/* The source of a field's value: gn_settings_from(s, render.shadow). */
enum gn_source gn_settings_source(const struct gn_settings *settings, size_t offset);
#define gn_settings_from(settings, field)                                                          \
    gn_settings_source(settings, offsetof(struct gn_settings, field))
/* The name of a field in messages, by its source: "--camera", "kiosk.ini:9: camera". */
const char *gn_settings_label_at(const struct gn_settings *settings, size_t offset);
#define gn_settings_label(settings, field)                                                         \
    gn_settings_label_at(settings, offsetof(struct gn_settings, field))
/* Whether a setting of a light section holds: it beats the scene and the sections without a name,
 * not a mode, a flag or `ctl set`. A light that is to cast no shadow (none) never does; those of
 * [light] are of the made light (stage/lights.h). */
bool gn_settings_light_holds(const struct gn_settings *settings,
                             const struct gn_override *override);
#define gn_settings_given(settings, field) (gn_settings_from(settings, field) != GN_SOURCE_DEFAULT)

#endif
