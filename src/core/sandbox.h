/* Takes rights away from a process that handles hostile input with a library that may have holes:
 * what it can do afterwards is to compute, to read the files of one folder, and to write to
 * descriptors that it has. For a process of one thread; there is no way back. */
#ifndef GN_CORE_SANDBOX_H
#define GN_CORE_SANDBOX_H

#include "core/err.h"

struct gn_sandbox {
    const char *folder; /* its files and those below can be read */
    const char *file;   /* so can this one, wherever it lies; the rights of its owner are kept */
    int output;         /* a descriptor that stays open; all others but 0, 1 and 2 are closed */
};

enum {                          /* what the kernel and the build have */
       GN_SANDBOX_LANDLOCK = 1, /* without it other files can be read, too */
       GN_SANDBOX_FILTER = 2,   /* of system calls, by libseccomp */
};

/* Returns what is in force, or -1 if something that this machine has cannot be used. In any case
 * there are no capabilities and no programs with more rights. */
int gn_sandbox_enter(const struct gn_sandbox *sandbox, struct gn_err *err);

#endif
