/* The table of options. A row makes a flag, an INI key, a line of --help and of the man page, and
 * fills a field of struct gn_settings, where its value is read. */
#ifndef GN_OPTIONS_TABLE_H
#define GN_OPTIONS_TABLE_H

#include <stdbool.h>
#include <stddef.h>

enum gn_command {
#define GN_COMMAND(ID, ...) GN_COMMAND_##ID,
#include "options/command_rows.h"
#undef GN_COMMAND
    GN_COMMAND_COUNT,
};
#define GN_SCENES_MAX 16
enum { GN_WORDS_MAX = GN_SCENES_MAX, GN_COMMAND_EXAMPLES = 2 };
enum gn_words {                   /* what follows a command */
                GN_WORDS_SCENES,  /* of --scene; else they are the options' words: */
                GN_WORDS_FILES,   /* other files */
                GN_WORDS_REQUEST, /* a command of ctl, and its words, also numbers below 0 */
                GN_WORDS_LESSON,  /* a lesson, list or all */
};
enum gn_command_config {                     /* the configuration file, beside that of -c FILE */
                         GN_CONFIG_ASKED,    /* none */
                         GN_CONFIG_FOUND,    /* the first of gn_config_find(); bad: it fails */
                         GN_CONFIG_KIOSK,    /* likewise; runs without the lines that are bad */
                         GN_CONFIG_OPTIONAL, /* likewise; bad: does without it */
                         GN_CONFIG_LESSON,   /* what the lesson sets, in place of any file */
};
struct gn_command_row {
    const char *name;  /* NULL for the bare command */
    const char *usage; /* what follows `gnomon` */
    const char *what;  /* a sentence */
    const char *examples[GN_COMMAND_EXAMPLES];
    enum gn_words words;
    int least, most;             /* how many words */
    const char *expects, *takes; /* what fewer, and more of them, are told */
    const char *words_with;      /* the option without which there are none; or NULL */
    enum gn_command_config config;
    const char *config_unless; /* with this option no file is searched; or NULL */
    bool lays_content;         /* that of [kiosk] content over the file */
    bool handles_signals;      /* SIGTERM and SIGINT, by itself; else they end the process */
};
extern const struct gn_command_row gn_commands[GN_COMMAND_COUNT];

enum gn_option_kind {
    GN_KIND_FLAG,       /* bool; INI: yes or no */
    GN_KIND_INT,        /* int, min..max */
    GN_KIND_NUMBER,     /* double, min..max */
    GN_KIND_SECONDS,    /* int64_t nanoseconds; decimal seconds, min..max */
    GN_KIND_SIZE,       /* struct gn_size, each min..max */
    GN_KIND_MODE,       /* struct gn_display_mode: WxH or WxH@HZ, each side min..max */
    GN_KIND_EV,         /* double, min..max, or NAN for "auto" */
    GN_KIND_LEVEL,      /* double, min..max, NAN for "auto", INFINITY for "none" */
    GN_KIND_SHARE,      /* double, min..max, NAN for "auto", 0 for "full" */
    GN_KIND_CHOICE,     /* int: the value of a choice */
    GN_KIND_COLOR,      /* int: the value of a choice, below 0, or 0xRRGGBB of "#rrggbb", sRGB */
    GN_KIND_WORD,       /* const char *: the name of a choice; another room knows what it means */
    GN_KIND_TECHNIQUES, /* struct gn_technique_list: names, a comma between two */
    GN_KIND_TEXT,       /* const char *: anything but nothing */
    GN_KIND_MODELINE,   /* const char *: a mode as X's configuration has it, without its name */
    GN_KIND_PATH,       /* const char *: in an INI file seen from the file's folder; or a choice */
    GN_KIND_SCENES,     /* struct gn_scene_list: a path, given again it adds */
    GN_KIND_LIMIT,      /* struct gn_limits: NAME=VALUE, given again it adds */
    GN_KIND_POINT,      /* double[3], each min..max, or NAN for "auto"; "X,Y,Z" */
    GN_KIND_PLACE,      /* double[2], latitude and longitude, or NAN for "auto"; "LAT,LON" */
    GN_KIND_DATE,       /* const char *: "now", or what gn_date_parse() reads */
    GN_KIND_HOURS,      /* struct gn_schedule; the fallback is the word for no hours */
    GN_KIND_CAPS,       /* const char *: names of gn_cap, a comma between two */
    GN_KIND_MS,         /* int64_t nanoseconds; whole milliseconds, min..max */
    GN_KIND_LINE,       /* const char *: a GPIO line: its name, or label:LABEL/OFFSET */
    GN_KIND_KEYS,       /* const char *: names of keys (core/key.h), spaces between */
    GN_KIND_NAMES,      /* const char *: two or more names, spaces between */
    GN_KIND_ACTION,     /* struct gn_binding */
    GN_KIND_COUNT,
};
struct gn_choice { /* rows end with a NULL name */
    const char *name;
    int value;
};

enum gn_change {                  /* when another value takes effect in a kiosk that runs */
                 GN_CHANGE_NEVER, /* not an option of the kiosk's file */
                 GN_CHANGE_LIVE,  /* `ctl set`, or a reload */
                 GN_CHANGE_RELOAD,
                 GN_CHANGE_RESTART,
};

struct gn_option_row {
    const char *name;    /* --name; the INI key has _ for - */
    const char *key;     /* INI key where it is another one, else NULL */
    const char *section; /* title of its INI section (section.h); NULL: only a flag, or a key of a
                            section of many */
    char letter;         /* -x, or 0 */
    enum gn_option_kind kind;
    double min, max;
    const struct gn_choice *choices;
    const char *value;    /* how help names the value: "PX" */
    const char *unit;     /* "px", or NULL */
    const char *fallback; /* the default, as one would write it; NULL: unset (zero) */
    const char *help;     /* a phrase without full stop */
    unsigned commands;    /* bit (1 << gn_command) each that takes it; 0: only in the INI file */
    enum gn_change change;
    bool of_light; /* a key of [light "NAME"], too */
    size_t target; /* offset in struct gn_light_opts of the field that a light gets: every light, of
                      section "light" the made one, or that of [light "NAME"]; 0: none */
    bool unique;   /* of a section of many: no two may have the same value, or a word of it */
    bool reopens;  /* a reload that changes it opens the display again */
    size_t offset; /* of its field in struct gn_settings, or in that of a section of many */
};
enum {
    GN_OPTION_COUNT = 0
#define GN_OPTION(...) +1 /* NOLINT(bugprone-macro-parentheses) */
#include "options/rows.h"
#undef GN_OPTION
};
extern const struct gn_option_row gn_option_rows[GN_OPTION_COUNT];

const struct gn_option_row *gn_option_find(const char *name,
                                           size_t length); /* by --name, or NULL */
const struct gn_option_row *gn_option_find_letter(char letter);
/* Whether the text is one of its choices: of a path, a word in its place. */
bool gn_option_has_choice(const struct gn_option_row *row, const char *text);
/* Whether it is of the INI section of that title. */
bool gn_option_is_of(const struct gn_option_row *row, const char *section);
/* By the title of an INI section and its own key there, or NULL. See gn_section_find_key(). */
const struct gn_option_row *gn_option_find_key(const char *section, const char *key);
/* The INI key of a row. */
const char *gn_option_key(const struct gn_option_row *row, char *buffer, size_t size);

#endif
