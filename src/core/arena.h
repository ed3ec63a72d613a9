/* Memory by lifetime. An arena is grown block by block and freed in one call; a scene is one arena,
 * a frame another (reset, never freed). Blocks are zeroed. */
#ifndef GN_CORE_ARENA_H
#define GN_CORE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

struct gn_arena_block;
struct gn_arena {
    struct gn_arena_block *first, *current;
    size_t used;  /* bytes allocated since init or reset */
    size_t limit; /* maximum of used; 0 = no limit */
    size_t block; /* size of a block; 0 = 64 KiB */
};

/* Zeroed, 16-byte aligned memory for count elements of size bytes, or NULL if the product
 * overflows, the limit is passed or the system has no more: sizes read from a file fail, they do
 * not abort. count 0 gives a valid pointer. */
void *gn_arena_alloc(struct gn_arena *arena, size_t count, size_t size);
char *gn_arena_strdup(struct gn_arena *arena, const char *text);
/* Frees the last allocation; bytes is its size. */
void gn_arena_undo(struct gn_arena *arena, void *piece, size_t bytes);
/* Frees all allocations but keeps the blocks: no system memory is needed until the previous peak is
 * exceeded. */
void gn_arena_reset(struct gn_arena *arena);
/* Frees all; the arena may be used again. A zeroed arena may be finished. */
void gn_arena_finish(struct gn_arena *arena);

/* Zeroed memory of a size that the program chooses; aborts when there is none (the supervisor
 * restarts it). gn_xrealloc does not zero. */
void *gn_xalloc(size_t count, size_t size);
void *gn_xrealloc(void *old, size_t count, size_t size);

/* Number of system allocations through the functions above; tests that the frame loop makes none.
 */
unsigned long gn_alloc_count(void);
/* Tests only: let the nth request from now (1 = the next) of gn_arena_alloc fail; 0 = never. */
void gn_alloc_fail_at(unsigned long nth);

#endif
