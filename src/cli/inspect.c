#include <stdio.h>

#include "cli/commands.h"
#include "cli/stage.h"

bool gn_cli_inspect(const struct gn_options *options, struct gn_warnings *warnings,
                    struct gn_err *err) {
    struct gn_scene *scene = gn_stage_scene(options, warnings, err);
    if (!scene) return false;
    printf("nodes %u, meshes %u, instances %u, lights %u, cameras %u, clips %u\n", scene->node_count,
           scene->geometry_count, scene->instance_count, scene->light_count, scene->camera_count,
           scene->clip_count);
    printf("triangles %llu, vertices %u, materials %u, textures %u, memory %zu bytes\n",
           (unsigned long long)scene->triangle_count, scene->vertex_count, scene->material_count,
           scene->texture_count, scene->bytes);
    gn_scene_destroy(scene);
    return true;
}
