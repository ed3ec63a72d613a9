/* Whole files. They are read, not mapped (truncating a mapped file raises SIGBUS); output is
 * written to a temporary file and renamed, so that a reader sees the old file or the new one. */
#ifndef GN_CORE_FILE_H
#define GN_CORE_FILE_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/disk.h"
#include "core/err.h"

struct gn_bytes {
    uint8_t *data; /* malloc'ed, one zero byte follows the last; gn_bytes_finish frees it */
    size_t size;
};

/* Four of them as a number, the least significant first. */
static inline uint32_t gn_u32_at(const uint8_t *p) {
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* Reads a regular file of at most limit bytes (0 = no limit). Refuses directories, devices, FIFOs
 * and sockets (without blocking on one); the error has the path and the reason. */
bool gn_file_read(const char *path, size_t limit, struct gn_bytes *out, struct gn_err *err);
/* The same, and while it reads the share that is read goes into *permille, from 0 to `whole`, for
 * another thread to see. */
bool gn_file_read_progress(const char *path, size_t limit, atomic_uint *permille, unsigned whole,
                           struct gn_bytes *out, struct gn_err *err);
/* Opens a file that a model names, of its folder or below, so that its first bytes can be looked at
 * before it is read; -1 with the reason if there is none, if it is no regular file, or if the path
 * or a link leads outside; see gn_open_beneath(). */
int gn_file_open_beneath(const char *folder, const char *name, struct gn_err *err);
/* Opens a regular file for reading; -1 with the reason if it is none. */
int gn_file_open(const char *path, struct gn_err *err);
/* Reads a file that is open, from the descriptor's position; closes it. path is for err. */
bool gn_file_read_fd(int fd, const char *path, size_t limit, struct gn_bytes *out,
                     struct gn_err *err);
void gn_bytes_finish(struct gn_bytes *bytes);
/* The first bytes of a small file, such as one of the kernel's, as a text that ends with a zero
 * byte; without blocking. False: it cannot be read, or is empty: "". */
bool gn_file_read_text(const char *path, char *out, size_t size);
const char *gn_file_name(const char *path); /* its last part */

/* Writes path atomically: a temporary file in the same folder, fsync'd and renamed, removed on
 * failure; a file that exists keeps its permissions. A symbolic link is refused: whoever may write
 * to the folder could have made it. A device, a FIFO and anything in /proc or /dev but not
 * /dev/shm, such as /dev/stdout, is written directly: through the descriptor that it names, at its
 * offset; a regular file behind it is truncated after the data. */
bool gn_file_write(const char *path, const void *data, size_t size, struct gn_err *err);

/* The same for a path from an untrusted source: replaces a regular file or creates one; refuses
 * everything else. */
bool gn_file_replace(const char *path, const void *data, size_t size, struct gn_err *err);

/* The same, by the system calls of that disk, and the folder is flushed, too: once it has returned,
 * the file outlasts a loss of power. */
bool gn_file_keep(const struct gn_disk *disk, const char *path, const void *data, size_t size,
                  struct gn_err *err);

/* Opens /dev/null as each of the descriptors 0, 1 and 2 that is closed: otherwise the next file
 * opened would get that number, and libraries print to it. */
void gn_file_fill_standard(void);
/* Flushes standard output; fails if some output was lost. A reader that closed its end (`| head`)
 * is no failure. */
bool gn_file_flush_output(struct gn_err *err);

#endif
