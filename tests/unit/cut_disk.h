/* A disk that loses its power and a stick that is pulled, for tests of src/take/: the real calls in
 * a temporary folder, but what was not flushed can be lost. */
#ifndef GN_TEST_CUT_DISK_H
#define GN_TEST_CUT_DISK_H

#include <limits.h>
#include <stdbool.h>

#include "core/disk.h"

enum { GN_CUT_CHANGES = 256, GN_CUT_DIRTY = 64 };
struct gn_cut_disk {
    const char *dir, *stick, *trash; /* the folder of versions; the stick's; one for what is lost */
    int calls, cut_at, pull_at, fail_at, reason; /* numbers of calls; -1: not */
    bool dead, pulled;
    bool keeps_names;      /* it cannot exchange two names */
    struct gn_cut_change { /* of a folder since that was flushed */
        enum { GN_CUT_MADE, GN_CUT_MOVED, GN_CUT_EXCHANGED, GN_CUT_GONE } kind;
        int folder; /* our own; AT_FDCWD */
        char name[NAME_MAX + 1], other[NAME_MAX + 1];
        int kept; /* number in the trash of what was there before; -1: nothing was */
    } changes[GN_CUT_CHANGES];
    int change_count, trash_count;
    struct gn_cut_dirty { /* a file since it was flushed */
        int fd, own;      /* as the program has it, -1: no more; our own, which outlives that */
    } dirty[GN_CUT_DIRTY];
    int dirty_count;
};
extern struct gn_cut_disk gn_cut_disk;
extern const struct gn_disk gn_cut_files; /* the calls on it */

/* All is well, and everything is flushed. The three folders must be set. */
void gn_cut_start(void);

/* What a cut of the power takes away: of files, half of what was not flushed; of folders, what was
 * not flushed, or nothing, or all but what concerns the links in `dir`. */
enum gn_cut_loss { GN_CUT_ALL, GN_CUT_NOTHING, GN_CUT_ALL_BUT_LINKS, GN_CUT_LOSSES };
void gn_cut_lose(enum gn_cut_loss loss);

void gn_cut_remove(const char *folder); /* with all that is in it; it may be missing */

#endif
