/* New content from a folder that may go away at any moment: `gnomon/` of a USB stick or of a card's
 * FAT partition. It is copied into a version of its own, beside the one that is shown, and flushed
 * to the disk; the caller looks at the copy; then one rename of a link shows it. Whenever that
 * ends, by an error or without power, the link leads to the old version or to the new one, and both
 * are whole.
 *
 *     DIR/current            -> versions/12-0123456789abcdef: what is shown
 *     DIR/previous           -> versions/11-..: what was shown before
 *     DIR/versions/13.new    a copy that is not complete; removed when next DIR is opened
 *     DIR/lock               held by the process that changes DIR
 */
#ifndef GN_TAKE_TAKE_H
#define GN_TAKE_TAKE_H

#include <limits.h>
#include <stdint.h>

#include "core/disk.h"
#include "core/err.h"
#include "take/shown.h"

struct gn_take_limits {
    uint64_t bytes;      /* of all files; 0: 2 GB */
    uint64_t reserve;    /* bytes that stay free on the disk; 0: 64 MB */
    int files, depth;    /* how many, with folders, and those in each other; 0: 4096, 8 */
    int64_t patience_ns; /* how long to wait for another process; 0: a minute */
};

enum { GN_TAKE_NAME = 40 };
struct gn_take {
    const struct gn_disk *files;
    struct gn_take_limits limits;
    int folder, versions, lock; /* DIR, its versions, its lock; -1: not open */
    int from;                   /* the stick's folder gnomon; -1: none */
    char name[NAME_MAX + 1];    /* of that folder: "Gnomon" */
    /* "12-0123456789abcdef"; "": none */
    char shown[GN_TAKE_NAME], before[GN_TAKE_NAME];
    char fresh[GN_TAKE_NAME]; /* "13.new" */
    unsigned number;          /* of the next version */
    uint64_t hash, bytes;     /* of the stick's files, and how much they have */
    int count;                /* of them */
    char path[PATH_MAX];      /* of the copy */
};

/* Makes DIR if only that is missing, locks it, and removes what an earlier process has left. */
bool gn_take_open(struct gn_take *take, const struct gn_disk *files, const char *dir,
                  const struct gn_take_limits *limits, struct gn_err *err);
void gn_take_close(struct gn_take *take); /* legal after a failure to open */

enum gn_take_found {
    GN_TAKE_FAILED,  /* err */
    GN_TAKE_NOTHING, /* no folder gnomon, or nothing in it */
    GN_TAKE_SAME,    /* what is shown */
    GN_TAKE_BACK,    /* what was shown until gn_take_back(): it does not come again by itself */
    GN_TAKE_FRESH,
};
/* Reads the folder gnomon (in any case) of the stick once. Refused are links, devices, names that
 * are not UTF-8 or have control characters, what exceeds the limits, and more or less than one
 * scene where there is no kiosk.ini. Files whose names begin with a dot are left out, and those
 * that Windows makes by itself. */
enum gn_take_found gn_take_look(struct gn_take *take, const char *stick, struct gn_err *err);
/* Copies what was looked at into `path`. False: nothing has changed. */
bool gn_take_copy(struct gn_take *take, struct gn_err *err);
/* Shows the copy. False: what was shown still is, unless only its folder could not be flushed. */
bool gn_take_keep(struct gn_take *take, struct gn_err *err);
void gn_take_drop(struct gn_take *take); /* removes the copy */
/* Shows what was shown before; the next one goes forward again. */
bool gn_take_back(struct gn_take *take, struct gn_err *err);
/* What is shown cannot be: the same, if that goes to an older one, else nothing is shown. */
bool gn_take_give_up(struct gn_take *take, struct gn_err *err);

#endif
