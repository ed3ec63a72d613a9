/* The folder of --shaders: waiting for its files to change. */
#ifndef GN_KIOSK_SHADERS_H
#define GN_KIOSK_SHADERS_H

#include "core/loop.h"

struct gn_shader_files {
    struct gn_watch watch; /* inotify; fd -1: there is no folder */
    struct gn_timer timer; /* a moment after the last change: an editor writes several files */
    bool changed;          /* set then; the caller takes it back */
};
/* Zeroed before, or closed. folder NULL: waits for nothing. False: the folder cannot be watched,
 * and nothing is waited for. It must not move until it is closed. */
bool gn_shader_files_open(struct gn_shader_files *files, const char *folder, struct gn_loop *loop,
                          struct gn_err *err);
void gn_shader_files_close(struct gn_shader_files *files);

#endif
