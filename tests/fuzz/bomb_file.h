/* A .glb as text: its arrays grow side by side, and bin is buffer 0. */
#ifndef GN_TESTS_FUZZ_BOMB_FILE_H
#define GN_TESTS_FUZZ_BOMB_FILE_H

#include <stdio.h>

#include "image/dice.h"
#include "unit/gltf_maker.h"

enum gn_bomb_array {
    GN_BOMB_ACCESSORS,
    GN_BOMB_ANIMATIONS,
    GN_BOMB_BUFFERS,
    GN_BOMB_VIEWS,
    GN_BOMB_CAMERAS,
    GN_BOMB_IMAGES,
    GN_BOMB_LIGHTS,
    GN_BOMB_MATERIALS,
    GN_BOMB_MESHES,
    GN_BOMB_NODES,
    GN_BOMB_SAMPLERS,
    GN_BOMB_SCENES,
    GN_BOMB_TEXTURES,
    GN_BOMB_ARRAY_COUNT
};
struct gn_bomb {
    struct gn_dice dice;
    struct gn_bomb_text {
        char *data;
        size_t size;
        FILE *file;
        int count;
    } arrays[GN_BOMB_ARRAY_COUNT], more; /* more: members of the root */
    uint8_t *bin;
    size_t bin_size;
    int most; /* elements that a kind adds at most: the size of the file */
};

/* A number below n. */
uint64_t gn_bomb_below(struct gn_bomb *b, uint64_t n);
/* Between 1 and most, each magnitude as likely as another. */
uint64_t gn_bomb_magnitude(struct gn_bomb *b, double most);

/* Text in which ' stands for ". */
void gn_bomb_put(struct gn_bomb_text *text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Begins an element, which gn_bomb_put() to the array continues. Returns its index. */
int gn_bomb_begin(struct gn_bomb *b, enum gn_bomb_array array);
/* A bufferView of these bytes; stride 0: none. */
int gn_bomb_view(struct gn_bomb *b, const void *data, size_t size, size_t stride);
/* view -1: without data. */
int gn_bomb_accessor(struct gn_bomb *b, int view, const char *type, int component, uint64_t count);

void gn_bomb_open(struct gn_bomb *b);
/* The file; closes what was opened. */
struct gn_made gn_bomb_close(struct gn_bomb *b);

#endif
