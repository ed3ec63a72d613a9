/* The one configuration file: where it is and what its settings mean. */
#ifndef GN_OPTIONS_FILE_H
#define GN_OPTIONS_FILE_H

#include "core/warn.h"
#include "options/ini.h"
#include "options/options.h"

/* The first that exists of $XDG_CONFIG_HOME/gnomon/kiosk.ini (~/.config without it) and
 * /etc/gnomon/kiosk.ini. */
bool gn_config_find(char *path, size_t size);

/* Of a file that is laid over another one: which keys it may not set. */
struct gn_config_over {
    /* The reason, with which a warning names the line, and nothing is read of it; NULL: it may. */
    const char *(*why_not)(const struct gn_options *options, const struct gn_option_row *row,
                           const struct gn_ini_line *line);
    struct gn_warnings *warnings;
};

/* Puts the settings of a file into options; over: NULL, or it is laid over them. A file that cannot
 * be read is a runtime error, bad content a usage error: file, line, key, and what was expected. */
bool gn_config_load(struct gn_options *options, const char *path, const struct gn_config_over *over,
                    struct gn_err *err);
/* The same of a text in memory; path is its name in messages. */
bool gn_config_load_text(struct gn_options *options, const char *path, const char *text,
                         size_t size, struct gn_err *err);

#endif
