#include "core/arena.h"

#include <assert.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Under ASan a poisoned red zone follows each allocation, so that an overrun inside a block is
 * reported. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define POISON
#endif
#endif
#if defined(POISON) || defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#define RED_ZONE         16
#define FORBID(at, size) __asan_poison_memory_region(at, size)
#define ALLOW(at, size)  __asan_unpoison_memory_region(at, size)
#else
#define RED_ZONE         0
#define FORBID(at, size) ((void)(at), (void)(size))
#define ALLOW(at, size)  ((void)(at), (void)(size))
#endif

#define ALIGNMENT     16
#define DEFAULT_BLOCK (64 * 1024)

struct gn_arena_block {
    struct gn_arena_block *next;
    size_t size, used; /* bytes of data */
    _Alignas(ALIGNMENT) unsigned char data[];
};

static _Atomic unsigned long requests;
static unsigned long fail_countdown;

/* Puts a new block after the current one. */
static struct gn_arena_block *add_block(struct gn_arena *arena, size_t least) {
    size_t size = arena->block ? arena->block : DEFAULT_BLOCK;
    if (size < least) size = least;
    if (size > SIZE_MAX - sizeof(struct gn_arena_block)) return NULL;
    requests++;
    struct gn_arena_block *block = calloc(1, sizeof *block + size);
    if (!block) return NULL;
    block->size = size;
    FORBID(block->data, size);
    struct gn_arena_block **link = arena->current ? &arena->current->next : &arena->first;
    block->next = *link;
    *link = block;
    return block;
}

/* Makes a block with room current: the current one, an empty one behind it, where a reset leaves
 * them, or a new one. */
static bool find_room(struct gn_arena *arena, size_t size) {
    struct gn_arena_block *current = arena->current, *found = NULL;
    if (current && current->size - current->used >= size) return true;
    struct gn_arena_block **link = current ? &current->next : NULL;
    while (link && *link && (*link)->size < size) link = &(*link)->next;
    if (link && *link) { /* moved to behind the current one */
        found = *link;
        *link = found->next;
        found->next = current->next;
        current->next = found;
    }
    if (!found) found = add_block(arena, size);
    if (found) arena->current = found;
    return found != NULL;
}

static size_t padded_size(size_t bytes) {
    return (bytes + RED_ZONE + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

void *gn_arena_alloc(struct gn_arena *arena, size_t count, size_t size) {
    size_t bytes;
    if (fail_countdown > 0 && --fail_countdown == 0) return NULL;
    if (__builtin_mul_overflow(count, size, &bytes)) return NULL;
    if (bytes > SIZE_MAX / 2 || (arena->limit && bytes > arena->limit - arena->used)) return NULL;
    if (!find_room(arena, padded_size(bytes))) return NULL;
    unsigned char *data = arena->current->data + arena->current->used;
    arena->current->used += padded_size(bytes);
    arena->used += bytes;
    ALLOW(data, bytes);
    return data;
}

char *gn_arena_strdup(struct gn_arena *arena, const char *text) {
    size_t size = strlen(text) + 1;
    char *copy = gn_arena_alloc(arena, size, 1);
    return copy ? memcpy(copy, text, size) : NULL;
}

/* Frees the block if it is then empty: it was allocated for this piece and may be large. */
void gn_arena_undo(struct gn_arena *arena, void *piece, size_t bytes) {
    struct gn_arena_block *block = arena->current, *before = NULL;
    block->used -= padded_size(bytes);
    arena->used -= bytes;
    assert(piece == block->data + block->used);
    if (block->used > 0) {
        memset(piece, 0, bytes);
        FORBID(piece, bytes);
        return;
    }
    for (struct gn_arena_block *at = arena->first; at != block; at = at->next) before = at;
    *(before ? &before->next : &arena->first) = block->next;
    arena->current = before ? before : arena->first;
    ALLOW(block->data, block->size);
    free(block);
}

void gn_arena_reset(struct gn_arena *arena) {
    for (struct gn_arena_block *block = arena->first; block; block = block->next) {
        ALLOW(block->data, block->used);
        memset(block->data, 0, block->used);
        FORBID(block->data, block->used);
        block->used = 0;
    }
    arena->current = arena->first;
    arena->used = 0;
}

void gn_arena_finish(struct gn_arena *arena) {
    for (struct gn_arena_block *block = arena->first, *next; block; block = next) {
        next = block->next;
        ALLOW(block->data, block->size);
        free(block);
    }
    arena->first = arena->current = NULL;
    arena->used = 0;
}

static void *or_abort(void *memory) {
    if (memory) return memory;
    fputs("gnomon: out of memory\n", stderr);
    abort();
}

void *gn_xalloc(size_t count, size_t size) {
    requests++;
    return or_abort(calloc(count ? count : 1, size ? size : 1));
}

void *gn_xrealloc(void *old, size_t count, size_t size) {
    size_t bytes;
    requests++;
    if (__builtin_mul_overflow(count, size, &bytes)) return or_abort(NULL);
    return or_abort(realloc(old, bytes ? bytes : 1));
}

unsigned long gn_alloc_count(void) { return requests; }

void gn_alloc_fail_at(unsigned long nth) { fail_countdown = nth; }
