/* Takes rights away from a process that handles hostile input with a library that may have holes:
 * what it can do afterwards is to compute, and to read and write descriptors that it has. Other
 * files it gets through core/opener.h. For a process of one thread; there is no way back. */
#ifndef GN_CORE_SANDBOX_H
#define GN_CORE_SANDBOX_H

#include "core/err.h"

enum {                          /* what the kernel and the build have */
       GN_SANDBOX_LANDLOCK = 1, /* no file can be opened, made or removed, no program run */
       GN_SANDBOX_FILTER = 2,   /* of system calls, by libseccomp: the same, no process, socket,
                                   signal or code besides */
};

/* Closes all descriptors but 0, 1, 2 and the two (-1: none). Returns what is in force, or -1 if
 * something that this machine has cannot be used. In any case there are no capabilities and no
 * programs with more rights, and root becomes nobody; with neither layer a user keeps the rest of
 * the rights, on files above all. */
int gn_sandbox_enter(const int kept[2], struct gn_err *err);

#endif
