/* Runs the gnomon under test as a user would, and takes what it leaves.
 * GNOMON names the program (build/release/gnomon), BUILD the folder for files that come and go
 * (build/release). */
#ifndef GN_IMAGE_SHOT_H
#define GN_IMAGE_SHOT_H

#include <stdbool.h>

#include "image/picture.h"

const char *gn_shot_program(void);
const char *gn_shot_build(void);
bool gn_shot_full(void); /* GN_FULL=1: every figure, not the quick form */

struct gn_run {
    int status;      /* exit status, 128 + signal, or 124 when it was killed for taking too long */
    char out[65536]; /* what it wrote, cut; always ends in a zero */
    char err[4096];
    double seconds;
};
/* argv ends with NULL; argv[0] is a path. timeout_s 0: 60. False only if it could not be started.
 */
bool gn_run(struct gn_run *run, const char *const argv[], int timeout_s, struct gn_err *err);

/* `gnomon render SCENE -o FILE ARGS..`, with --tone none, --msaa 0, --floor none and --environment
 * none unless ARGS have others; they
 * end with NULL. kind: "png" or "pfm". On failure the message holds the command, its status and
 * what it said; status (may be NULL) gets the status either way. */
bool gn_shot(struct gn_picture *picture, int *status, struct gn_err *err, const char *kind,
             const char *scene, const char *const args[]);
/* The same, leaving the bytes in a file of the caller's and reading nothing. */
bool gn_shot_file(const char *path, int *status, struct gn_err *err, const char *scene,
                  const char *const args[]);

#endif
