/* Writes a large scene: tool_large FILE.glb TRIANGLES NODES [TEXTURES PX]. */
#include <stdio.h>
#include <stdlib.h>

#include "image/large.h"

int main(int argc, char **argv) {
    struct gn_err err = {0};
    if (argc != 4 && argc != 6) {
        fprintf(stderr, "usage: tool_large FILE.glb TRIANGLES NODES [TEXTURES PX]\n");
        return 2;
    }
    const struct gn_large large = {.triangles = (uint32_t)strtoul(argv[2], NULL, 10),
                                   .nodes = (uint32_t)strtoul(argv[3], NULL, 10),
                                   .textures = argc > 4 ? (uint32_t)strtoul(argv[4], NULL, 10) : 0,
                                   .texture_px =
                                       argc > 4 ? (uint32_t)strtoul(argv[5], NULL, 10) : 0};
    if (large.triangles > 0 && large.nodes > 0 && gn_large_write(&large, argv[1], &err)) return 0;
    fprintf(stderr, "tool_large: %s\n", err.text);
    return 1;
}
