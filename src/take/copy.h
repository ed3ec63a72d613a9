/* A folder of a stick, read and perhaps copied, in the order of the names. */
#ifndef GN_TAKE_COPY_H
#define GN_TAKE_COPY_H

#include "take/take.h"

struct gn_take_walk {
    const struct gn_disk *files;
    struct gn_take_limits limits; /* none is 0 */
    uint64_t hash, bytes;         /* of names and contents; so far */
    int entries, count, scenes;   /* files and folders; files; scenes directly in the folder */
    bool has_ini;                 /* kiosk.ini does */
    char names[200];              /* of those scenes */
    char path[PATH_MAX];          /* what is read, for messages */
};
/* Hashes the folder `from` and what is in it, and copies it into the folder `to` unless that is -1,
 * flushed to the disk. The message begins with "gnomon/": the stick's folder. */
bool gn_take_walk(struct gn_take_walk *walk, int from, int to, struct gn_err *err);

/* A folder of ours with all that is in it. Goes on after an error; false: not all is gone. */
bool gn_take_remove(const struct gn_disk *files, int folder, const char *name);

#endif
