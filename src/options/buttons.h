/* [button "NAME"] of the configuration file: the source of a button and its actions. */
#ifndef GN_OPTIONS_BUTTONS_H
#define GN_OPTIONS_BUTTONS_H

#include "options/binding.h"
#include "options/ini.h"
#include "options/options.h"

struct gn_button_key_row {
    const char *name;  /* "hold_ms" */
    const char *value; /* how the manual names the value: "MS" */
    const char *help;  /* a phrase without full stop */
};
enum { GN_BUTTON_KEY_COUNT = 15 };
const struct gn_button_key_row *gn_button_key(int index); /* below GN_BUTTON_KEY_COUNT */

struct gn_config_buttons {
    struct gn_buttons *buttons; /* in the options' arena */
    struct gn_arena *arena;     /* keeps the texts */
    struct {
        int section, keys[GN_BUTTON_KEY_COUNT]; /* lines of the file; 0: not there */
    } lines[GN_BUTTONS_MAX];
};

/* Begins a section; sets a key of the last one. Texts are copied. Usage errors: file, line, key,
 * and what was expected. */
bool gn_config_button_open(struct gn_config_buttons *config, const struct gn_ini_line *line,
                           struct gn_err *err);
bool gn_config_button_set(struct gn_config_buttons *config, const struct gn_ini_line *line,
                          struct gn_err *err);
/* Checks that need the whole file: modes and buttons that do not exist, buttons without a source or
 * an action. `path` is for messages. */
bool gn_config_button_check(const struct gn_config_buttons *config,
                            const struct gn_options *options, const char *path, struct gn_err *err);

#endif
