/* Whole files. They are read, not mapped (a file cut short under a mapping is a SIGBUS); output is
 * written beside its target and renamed, so a reader sees the old file or the new one. */
#ifndef GN_CORE_FILE_H
#define GN_CORE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

struct gn_bytes {
    uint8_t *data; /* malloc'ed, one zero byte follows the last; gn_bytes_finish frees it */
    size_t size;
};

/* Reads a regular file of at most limit bytes (0 = no limit). Refuses directories, devices, FIFOs
 * and sockets (without ever blocking on one), and says the path and the reason. */
bool gn_file_read(const char *path, size_t limit, struct gn_bytes *out, struct gn_err *err);
void gn_bytes_finish(struct gn_bytes *bytes);

/* Writes path atomically: a temporary file in the same folder, fsync'd and renamed; nothing is left
 * behind on failure. What is a device or a FIFO, or lies in /proc or /dev (but not in /dev/shm),
 * such as /dev/stdout, is written to directly: through the descriptor that it names, from where
 * that stands, and a file behind it ends there. */
bool gn_file_write(const char *path, const void *data, size_t size, struct gn_err *err);

/* The same for a path that somebody else names: written to is a regular file or nothing at all.
 * What is a link, a folder or a device stays what it is, and where a link leads nothing is written.
 */
bool gn_file_replace(const char *path, const void *data, size_t size, struct gn_err *err);

/* Opens /dev/null on those of the descriptors 0, 1 and 2 that are closed: one would be given to the
 * next file that is opened, and libraries print there. */
void gn_file_fill_standard(void);
/* Flushes standard output; fails if not all that was printed has arrived. A reader that had enough
 * (`| head`) is no failure. */
bool gn_file_flush_output(struct gn_err *err);

#endif
