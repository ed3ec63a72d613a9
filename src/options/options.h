/* The one table of options. A row makes a flag, an INI key, a line of --help and of the man page,
 * and a field of struct gn_options; whoever needs the value reads the field. */
#ifndef GN_OPTIONS_OPTIONS_H
#define GN_OPTIONS_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/arena.h"
#include "core/err.h"
#include "options/binding.h"

enum gn_command {
    GN_COMMAND_AUTO, /* bare `gnomon [SCENE]` */
    GN_COMMAND_SHOW,
    GN_COMMAND_RENDER,
    GN_COMMAND_BENCH,
    GN_COMMAND_INSPECT,
    GN_COMMAND_DOCTOR,
    GN_COMMAND_CTL,
    GN_COMMAND_COUNT,
};
struct gn_command_row {
    const char *name;  /* NULL for the bare command */
    const char *usage; /* what follows `gnomon` */
    const char *what;  /* a sentence */
};
extern const struct gn_command_row gn_commands[GN_COMMAND_COUNT];

/* ---- values -------------------------------------------------------------------------------- */

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
    struct gn_limit items[GN_LIMITS_MAX];
};
#define GN_SCENES_MAX 16
struct gn_scene_list {
    const char *paths[GN_SCENES_MAX]; /* [0] NULL: the default scene inside the program */
    int count;
};
enum gn_picture { GN_PICTURE_SRGB, GN_PICTURE_LINEAR }; /* --output */

enum gn_option_kind {
    GN_KIND_FLAG,       /* bool; INI: yes or no */
    GN_KIND_INT,        /* int, min..max */
    GN_KIND_NUMBER,     /* double, min..max */
    GN_KIND_SECONDS,    /* int64_t nanoseconds; decimal seconds, min..max */
    GN_KIND_SIZE,       /* struct gn_size, each min..max */
    GN_KIND_MODE,       /* struct gn_display_mode: WxH or WxH@HZ, each side min..max */
    GN_KIND_EV,         /* double, min..max, or NAN for "auto" */
    GN_KIND_CHOICE,     /* int: the value of a choice */
    GN_KIND_WORD,       /* const char *: the name of a choice; another room knows what it means */
    GN_KIND_TECHNIQUES, /* const char *: names of shadow techniques, a comma between two */
    GN_KIND_TEXT,       /* const char *: anything but nothing */
    GN_KIND_MODELINE,   /* const char *: a mode as X's configuration has it, without its name */
    GN_KIND_PATH,       /* const char *: in an INI file seen from the file's folder */
    GN_KIND_SCENES,     /* struct gn_scene_list: a path, given again it adds */
    GN_KIND_LIMIT,      /* struct gn_limits: NAME=VALUE, given again it adds */
    GN_KIND_CAPS,       /* const char *: names of gn_cap, a comma between two */
    GN_KIND_COUNT,
};
struct gn_choice { /* rows end with a NULL name */
    const char *name;
    int value;
};

/* ---- the table ----------------------------------------------------------------------------- */

struct gn_option_row {
    const char *name;    /* --name; the INI key has _ for - */
    const char *key;     /* INI key where it is another one, else NULL */
    const char *section; /* of the INI file: "display", "scene", "render", "kiosk"; NULL: only a
                            flag */
    char letter;         /* -x, or 0 */
    enum gn_option_kind kind;
    double min, max;
    const struct gn_choice *choices;
    const char *value;    /* how help names the value: "PX" */
    const char *unit;     /* "px", or NULL */
    const char *fallback; /* the default, as one would write it; NULL: unset (zero) */
    const char *help;     /* a phrase without full stop */
    unsigned commands;    /* bit (1 << gn_command) each that takes it; 0: only in the INI file */
    size_t offset;        /* of its field in struct gn_options */
};
enum { GN_OPTION_COUNT = 57 };
extern const struct gn_option_row gn_option_rows[GN_OPTION_COUNT];

const struct gn_option_row *gn_option_find(const char *name,
                                           size_t length); /* by --name, or NULL */
const struct gn_option_row *gn_option_find_letter(char letter);
/* By INI section and key; NULL section: any of scene and render, as in [mode "NAME"]. */
const struct gn_option_row *gn_option_find_key(const char *section, const char *key);
const char *gn_option_key(const struct gn_option_row *row, char *buffer, size_t size);

/* ---- what was asked for -------------------------------------------------------------------- */

enum gn_source {
    GN_SOURCE_DEFAULT,
    GN_SOURCE_INI,
    GN_SOURCE_MODE,
    GN_SOURCE_FLAG,
    GN_SOURCE_SET, /* while running; a reload forgets it */
};                 /* later ones win */

struct gn_setting { /* of a mode: read once, applied whenever the mode is */
    const struct gn_option_row *row;
    const void *value; /* as in the field */
    const char *label; /* "kiosk.ini:31: camera" */
    int line;
};
struct gn_mode {
    const char *name;
    int line, count;
    struct gn_setting settings[GN_OPTION_COUNT];
};
#define GN_MODES_MAX 32

struct gn_options {
    enum gn_command command;

    /* [scene] */
    union {
        const char *scene;           /* NULL: the default scene inside the program */
        struct gn_scene_list scenes; /* that one, and what `show` goes on to */
    };
    const char *camera, *animation; /* NAME or number; NULL: the first; animation may be "none" */
    bool no_animation;
    int64_t time_ns;
    double turntable_deg_s;

    /* [render] */
    struct gn_size size;
    const char *shadow; /* technique; a comma list for bench. Given (see below) it beats what a
                           light says */
    int map_px;         /* given it beats what a light says */
    const char *map_format;
    int planar_in_stencil; /* 0, 1 */
    int taps;
    bool taps_fixed;
    double filter_budget;   /* million texels; 0: no end */
    double shadow_strength; /* given it beats what a light says */
    bool show_lights, show_maps;
    int light; /* number of the light that --aov visibility and map show */
    int aov;   /* enum gn_aov, or GN_AOV_COUNT: the light's map */
    enum gn_picture output;
    double exposure_ev; /* NAN: automatic */
    int msaa;           /* samples: 0, 2 or 4 */
    const char *font;   /* of texts on the picture: a file; NULL: the first of the usual ones */
    const char *shaders, *without;
    struct gn_limits limits;

    /* [display] */
    const char *backend, *card, *render_node, *connector;
    struct gn_display_mode display_mode; /* 0x0: the display's */
    struct gn_display_mode max_mode;
    const char *modeline;
    int rotate_deg, max_fps; /* 0: as fast as the display */
    bool legacy;

    /* [kiosk] */
    int idle; /* enum gn_idle */
    int64_t idle_after_ns, fade_ns;
    const char *socket; /* NULL: see gn_control_path() */
    bool captions;
    int64_t caption_ns;

    /* the command's own */
    const char *input_script;
    const char *config, *mode, *out;
    const char *check;        /* a configuration file that is only looked at, or NULL */
    const char *const *words; /* of ctl: its command and what follows; they are argv's */
    int word_count;
    const char *caption; /* text on the picture, or NULL */
    int frames;
    double fps;
    bool plan, json, self_test, stats, verbose, version, help;

    /* bookkeeping */
    uint8_t source[GN_OPTION_COUNT];    /* enum gn_source of each row */
    const char *label[GN_OPTION_COUNT]; /* see gn_options_label(); NULL: at its default */
    const struct gn_mode *modes;        /* of the INI file, in its order */
    int mode_count;
    const struct gn_buttons *buttons; /* of the INI file; NULL: it has none */
    const char *mode_now;             /* the mode that is applied, or NULL */
    const char *config_path;          /* the INI file that was read, or NULL */
    const char
        *config_error; /* `show` runs on with the defaults when that file is bad: why, or NULL */
    int argc;          /* as main() has them: to read all of it again */
    char *const *argv;
    struct gn_options *base;    /* as before any mode; private */
    struct gn_changes *changes; /* private; NULL: none */
    struct gn_arena arena;      /* all texts */
};

/* Every field at its default. */
void gn_options_init(struct gn_options *options);
void gn_options_finish(struct gn_options *options);

/* Sets one option from text if nothing stronger has set it. `label` is how a message names it:
 * "--size", "kiosk.ini:3: size". */
bool gn_options_set(struct gn_options *options, const struct gn_option_row *row, const char *text,
                    enum gn_source source, const char *label, struct gn_err *err);
/* The same from a value that has been read before; the label must outlive the options. */
void gn_options_put(struct gn_options *options, const struct gn_option_row *row, const void *value,
                    enum gn_source source, const char *label);
/* Sets one option of a running kiosk, as GN_SOURCE_SET. What belongs to the display, or is read
 * only as the kiosk starts, cannot be: a failure that says why. The value before lives until the
 * next change of the same option but one; whoever keeps more than a pass through the loop copies.
 */
bool gn_options_change(struct gn_options *options, const struct gn_option_row *row,
                       const char *text, struct gn_err *err);
void gn_options_finish_changes(struct gn_options *options); /* private: gn_options_finish() does */
/* Takes back the last change of that option, as if it had not been; with no mode applied since. */
void gn_options_change_back(struct gn_options *options, const struct gn_option_row *row);
/* A row by key as `ctl set` has it, with _ or -, with or without its section: "shadow",
 * "render.shadow", "scene.file", "scene". NULL, and a usage error that names the nearest. */
const struct gn_option_row *gn_options_find_change(const char *key, struct gn_err *err);
/* Where a field's value comes from, by the field: gn_options_source(o, offsetof(struct gn_options,
 * shadow)). */
enum gn_source gn_options_source(const struct gn_options *options, size_t offset);
/* How a message names a field, by where its value comes from: "--camera", "kiosk.ini:9: camera". */
const char *gn_options_label_at(const struct gn_options *options, size_t offset);
#define gn_options_label(options, field)                                                           \
    gn_options_label_at(options, offsetof(struct gn_options, field))
#define gn_options_given(options, field)                                                           \
    (gn_options_source(options, offsetof(struct gn_options, field)) != GN_SOURCE_DEFAULT)

/* Undoes the mode before and applies the one of that name; flags stay stronger. Where the INI file
 * has no modes, or there is none, the modes are the techniques. A name that is not there is a usage
 * error that lists those that are, and the mode stays as it was. The name must outlive the options;
 * nothing is allocated after the first call. */
bool gn_options_apply_mode(struct gn_options *options, const char *name, struct gn_err *err);
/* As before any mode. */
void gn_options_drop_mode(struct gn_options *options);

#endif
