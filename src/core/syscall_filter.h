/* A filter of system calls (seccomp), for gn_sandbox_enter(). */
#ifndef GN_CORE_SYSCALL_FILTER_H
#define GN_CORE_SYSCALL_FILTER_H

#include "core/err.h"

/* Leaves what computing, and reading and writing open descriptors needs; all else fails with
 * ENOSYS, for which libc has a second way where a call is only newer than another. No file is
 * opened, no signal but to itself, no process, no socket, no new executable memory. 1: in force; 0:
 * neither the build nor the kernel has it; -1: failed. */
int gn_syscall_filter(struct gn_err *err);

#endif
