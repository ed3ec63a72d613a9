/* The command line and the configuration file, read: the settings of each mode, the modes, the
 * buttons. */
#ifndef GN_OPTIONS_OPTIONS_H
#define GN_OPTIONS_OPTIONS_H

#include "core/arena.h"
#include "core/err.h"
#include "options/binding.h"
#include "options/settings.h"

struct gn_options {
    const struct gn_settings *settings; /* those of --mode, or without any; in `all` */
    struct gn_settings
        *all; /* [0] without any mode; then one for each mode, see gn_options_resolve() */
    int all_count;

    const struct gn_named_section *modes; /* of the INI file, in its order */
    int mode_count;
    const char *home; /* the mode that a kiosk begins in and returns to, whichever is shown; NULL:
                         the one without settings of its own */
    const char *resumes; /* the same of modes that are made of the scene once it is there (kiosk);
                            NULL: the first; in the arena */
    bool is_lesson;      /* the modes are its steps */
    const struct gn_buttons *buttons; /* of the INI file; NULL: it has none */
    const char *config_path;          /* the INI file that was read, or NULL */
    const char *content; /* the folder that was laid over it (content.h), without links; or NULL */
    const char *base_path; /* over this INI file, if config_path is that folder's own; or NULL */
    /* The first line of the file that `show` runs without, or why it runs with the defaults, or
     * NULL. In a kiosk that runs it is also why it could not be used in a reload, or another
     * lasting problem (gn_show_report_error()). */
    const char *config_error;
    const char *config_shown; /* what the screen says of that; "" or NULL: what it says of any */

    struct gn_errors *errors; /* while a file is read to its end, and with --check: all of it */

    const char *const
        *words; /* of ctl: its command and arguments; of compare and score: files; argv's */
    int word_count;
    int argc; /* of main(): a reload parses them again */
    char *const *argv;
    struct gn_arena arena; /* all texts */
};

/* Every setting at its default, of this command. */
void gn_options_init(struct gn_options *options, enum gn_command command);
void gn_options_finish(struct gn_options *options);

/* Reads one value, for this command: only bench takes a list of techniques. Texts are kept in the
 * arena. See gn_value_parse(). */
bool gn_options_parse(const struct gn_options *options, const struct gn_option_row *row,
                      const char *text, void *value, struct gn_arena *arena, const char *label,
                      struct gn_err *err);
/* Sets one option from text, before the modes are resolved, unless a stronger source has set it.
 * `label` names it in messages: "--size", "kiosk.ini:3: size". */
bool gn_options_set(struct gn_options *options, const struct gn_option_row *row, const char *text,
                    enum gn_source source, const char *label, struct gn_err *err);

/* Makes the settings of each mode, once all else is set: those without a mode, with what the mode
 * overrides where no flag does. Where the INI file has no modes, or there is none, they are here
 * the techniques, in the order of their table. */
void gn_options_resolve(struct gn_options *options);
/* Whether a kiosk's modes are what its scene offers: that is the user's own, and neither the file,
 * --mode nor a button names a mode. */
bool gn_options_leave_modes(const struct gn_options *options);
/* The place in `all` of the mode of that name; 0: there is none. */
int gn_options_find_mode(const struct gn_options *options, const char *name);
/* The modes of the INI file for a message: ' "Day", "Night"'; "" without any. */
void gn_options_list_modes(const struct gn_options *options, char *out, size_t size);
/* Makes `settings` those of that mode. An unknown name is a usage error that lists the known
 * ones. */
bool gn_options_choose(struct gn_options *options, const char *name, struct gn_err *err);
/* Changes the command of all settings. */
void gn_options_run_as(struct gn_options *options, enum gn_command command);

#endif
