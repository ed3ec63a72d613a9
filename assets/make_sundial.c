/* The default scene, a sundial in a walled court at three o'clock on an afternoon in August, 50
 * degrees north; and the scene of tests and measurements, which had its place up to 0.2. */
#include "garden.h"
#include "glb.h"

#include <stdio.h>
#include <string.h>

int main(int argc, char **argv) {
    const struct gn_garden_plan *plan = NULL;
    if (argc == 3 && strcmp(argv[1], "garden") == 0) plan = &gn_sundial;
    if (argc == 3 && strcmp(argv[1], "yard") == 0) plan = &gn_yard;
    if (!plan) {
        fprintf(stderr, "usage: make_sundial garden|yard OUT.glb\n");
        return 2;
    }
    struct gn_garden g;
    gn_garden_init(&g, gn_glb_create("gnomon assets", "CC0 1.0, the authors of gnomon"), plan);
    for (int i = 0; plan->parts[i]; i++) plan->parts[i](&g);
    bool ok = gn_glb_write(g.glb, argv[2]);
    gn_glb_destroy(g.glb);
    return ok ? 0 : 1;
}
