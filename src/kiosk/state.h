/* What outlasts a restart of a kiosk, as a text of two generations: FILE and FILE.2. A save
 * replaces the older one by gn_file_keep() and does not touch the newer one. So whenever the power
 * is cut, one of them is whole, on FAT and on a card that damages a sector, too; its checksum shows
 * it. */
#ifndef GN_KIOSK_STATE_H
#define GN_KIOSK_STATE_H

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

#include "core/disk.h"
#include "core/err.h"

/* Counters over all starts. A start that follows one without an end is a restart if the machine has
 * not been started since (a crash, the watchdog), else a cut of the power. */
#define GN_STATE_COUNTS(X) X(starts) X(restarts) X(cuts) X(frames) X(presses) X(seconds)

struct gn_state {
    uint64_t sequence;                    /* of the save, from 1 */
    char mode[128];                       /* its name; "": none */
    char scene[PATH_MAX], past[PATH_MAX]; /* shown last, and the one before; "": the default one */
    char listed[PATH_MAX];                /* the place in the list of next-scene, as its path */
    bool given;    /* `scene` is that of ctl scene, for all modes; else the configuration's */
    bool runs;     /* it was saved by a program that had not ended */
    char boot[40]; /* the machine's boot_id then */
    struct gn_state_counts {
#define X(id) uint64_t id;
        GN_STATE_COUNTS(X)
#undef X
    } counts;
};
enum { GN_STATE_TEXT_MAX = 3 * PATH_MAX + 1024 };

/* One line for each key, the last a CRC-32 of those before it. A text that has a line end in it is
 * left out. Returns its length. */
size_t gn_state_print(const struct gn_state *state, char out[GN_STATE_TEXT_MAX]);
/* False: cut short, changed, or of another version. Unknown keys are passed over. */
bool gn_state_parse(const char *text, size_t size, struct gn_state *out, struct gn_err *err);

enum gn_state_found {
    GN_STATE_NONE, /* there is no file yet */
    GN_STATE_READ,
    GN_STATE_BROKEN, /* there are files, but none that can be used; err says why */
};
/* Reads the newer of both. *older is which one the next save replaces, 0 or 1. */
enum gn_state_found gn_state_read(const struct gn_disk *disk, const char *path,
                                  struct gn_state *out, int *older, struct gn_err *err);
/* Writes it in the place of that one. False: both are as they were. */
bool gn_state_save(const struct gn_disk *disk, const char *path, int older,
                   const struct gn_state *state, struct gn_err *err);

#endif
