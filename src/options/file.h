/* The one configuration file: where it is and what its settings mean. */
#ifndef GN_OPTIONS_FILE_H
#define GN_OPTIONS_FILE_H

#include "options/options.h"

/* The first that exists of $XDG_CONFIG_HOME/gnomon/kiosk.ini (~/.config without it) and
 * /etc/gnomon/kiosk.ini. */
bool gn_config_find(char *path, size_t size);

/* Puts the settings of a file into options. A file that cannot be read is a runtime error, bad
 * content a usage error: file, line, key, and what was expected. */
bool gn_config_load(struct gn_options *options, const char *path, struct gn_err *err);
/* The same of a text in memory; path is its name in messages. */
bool gn_config_load_text(struct gn_options *options, const char *path, const char *text,
                         size_t size, struct gn_err *err);

#endif
