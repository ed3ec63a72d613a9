/* Writes the crowds that the cost of skins is measured with: DIR/crowd.glb, and
 * DIR/crowd_still.glb, whose figures are not posed. Then `gnomon bench` of both. */
#include <stdio.h>

#include "image/character.h"

int main(int argc, char **argv) {
    struct gn_err err = {0};
    char path[1000];
    for (int i = 0; argc == 2 && i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s.glb", argv[1], i ? "crowd_still" : "crowd");
        if (gn_crowd_write(path, i == 0, &err)) continue;
        fprintf(stderr, "tool_crowd: %s\n", err.text);
        return 1;
    }
    if (argc != 2) fprintf(stderr, "usage: tool_crowd DIR\n");
    return argc == 2 ? 0 : 2;
}
