/* The files that are shown: waits until one of them has changed and is written to the end. Their
 * folders are watched by inotify, so that a file that is replaced by rename is noticed; what
 * inotify does not see (a folder replaced, a link turned, a network's files) is within two seconds.
 * A file has settled when nothing has happened to it for half a second and its size and time are
 * still the same. */
#ifndef GN_KIOSK_CONTENT_H
#define GN_KIOSK_CONTENT_H

#include "core/loop.h"

enum { GN_CONTENT_FILES_MAX = 256 };
struct gn_content_file;
struct gn_contents {
    struct gn_watch watch; /* inotify; fd -1: not open */
    struct gn_timer timer;
    struct gn_content_file *files;
    int count;
    bool changed; /* one has changed and settled; the caller takes it back */
};
/* Zeroed with watch.fd -1 before, or closed. False: errno. It must not move until it is closed. */
bool gn_content_open(struct gn_contents *content, struct gn_loop *loop);
void gn_content_close(struct gn_contents *content); /* legal when not open */
/* Waits for these files from now on, and for those that a .gltf of them refers to. NULL and ""
 * among them are left out. Of a file that was waited for already what was known stays. missed: a
 * load of them failed; a file that is new here counts as changed then, since it may have been
 * completed between that load and this call. */
void gn_content_follow(struct gn_contents *content, const char *const *paths, int count,
                       bool missed);

#endif
