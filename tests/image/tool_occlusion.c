/* The volume of occlusion against rays: tool_occlusion [-s SIDE_PX] [-r RAYS] [-m MILLIONS]
 * [-c] [FILE].., with so many millions of rays to make it; without clips, with those that play by
 * default, -c: with each. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/embedded.h"
#include "environment/environment.h"
#include "image/occlusion.h"
#include "stage/occlusion.h"

static uint32_t own_rays; /* 0: as frames have them */
static bool all_clips;

static void print_scene(const char *name, const struct gn_scene *scene, int side_px,
                        uint32_t rays) {
    static struct gn_environment studio;
    const struct gn_embedded *file = gn_embedded_find("studio.env");
    struct gn_sky skies[2] = {{.turn = {1, 0}}};
    if (file && gn_environment_read(file->data, file->size, &studio))
        skies[1] = gn_stage_sky(&studio.rest, 0);
    for (int i = 0; i < 4 + 2 * (all_clips ? (int)scene->animation.clip_count : 0); i++) {
        const struct gn_occlusion_work work = {.rays = own_rays, .threads = 1};
        const struct gn_sky *sky = &skies[i & 1];
        const int clips = i < 2 ? GN_POSE_NONE : i < 4 ? GN_POSE_DEFAULT : i / 2 - 2;
        if (i == 2 && scene->animation.clip_count == 0) break;
        const int64_t begun_ns = gn_clock_thread_cpu_ns();
        struct gn_occlusion_made made = gn_occlusion_make(scene, clips, sky, &work);
        const double seconds = (double)(gn_clock_thread_cpu_ns() - begun_ns) * 1e-9;
        const struct gn_occlusion_score score =
            gn_occlusion_measure(scene, clips, sky, (const int8_t(*)[4])made.texels, side_px, rays);
        printf("%-24.24s %8llu %-7s %-7s %2ux%2ux%2u %5.2f s fit %.3f none %.3f rmse %.4f p95 %.3f "
               "p99.9 %.3f bias %+.4f %s\n",
               i ? "" : name, (unsigned long long)scene->triangle_count,
               i & 1 ? "studio" : "uniform", i < 2 ? "" : "clips", scene->occlusion.size[0],
               scene->occlusion.size[1], scene->occlusion.size[2], seconds, (double)made.error,
               score.none, made.texels ? score.rmse : -1.0, score.p95, score.p999, score.bias,
               clips >= 0 ? scene->animation.clips[clips].name : "");
        fflush(stdout);
        free(made.texels);
    }
}

int main(int argc, char **argv) {
    int side_px = 120;
    uint32_t rays = 256;
    struct gn_err err = {0};
    bool any = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "-s") == 0 && i + 1 < argc)
            side_px = atoi(argv[++i]);
        else if (strcmp(argv[i], "-r") == 0 && i + 1 < argc)
            rays = (uint32_t)atoi(argv[++i]);
        else if (strcmp(argv[i], "-c") == 0)
            all_clips = true;
        else if (strcmp(argv[i], "-m") == 0 && i + 1 < argc)
            own_rays = (uint32_t)atoi(argv[++i]) << 20;
        else {
            struct gn_scene_limits limits = {.floor.kind = GN_FLOOR_AUTO};
            struct gn_scene *scene = gn_scene_load(argv[i], &limits, NULL, &err);
            const char *slash = strrchr(argv[i], '/');
            any = true;
            if (!scene) fprintf(stderr, "%s\n", err.text);
            if (scene) print_scene(slash ? slash + 1 : argv[i], scene, side_px, rays);
            gn_scene_destroy(scene);
        }
    }
    for (int i = 0; i < GN_OCCLUSION_SCENES && !any; i++) {
        struct gn_scene *scene = gn_occlusion_scene(i, &err);
        if (!scene) return fprintf(stderr, "%s\n", err.text), 1;
        print_scene(gn_occlusion_names[i], scene, side_px, rays);
        gn_scene_destroy(scene);
    }
    return 0;
}
