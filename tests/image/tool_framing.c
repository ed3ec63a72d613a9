/* tool_framing FILE..: loads scenes and prints how far each clip reaches from the middle of
 * pictures of four shapes, where 1 is the border, and how long the load took. A file with a camera
 * of its own is not framed, one that cannot be loaded is named. Exit status 1: something is
 * outside. */
#include <math.h>
#include <stdio.h>

#include "core/clock.h"
#include "unit/framing_help.h"

static const float SHAPES[] = {9.0f / 16, 1, 16.0f / 9, 32.0f / 9};
enum { SHAPE_COUNT = 4 };

static bool print_clip(const struct gn_scene *scene, const char *path, int clips) {
    bool inside = true;
    printf("%s, %s:", path,
           clips >= 0              ? scene->animation.clips[clips].name
           : clips == GN_POSE_NONE ? "no animation"
                                   : "all");
    for (int i = 0; i < SHAPE_COUNT; i++) {
        const struct gn_framing_opts opts = {.aspect = SHAPES[i]};
        const float reach = help_framing_reach(scene, clips, &opts);
        inside &= reach <= 1;
        printf(" %.3f", (double)reach);
    }
    printf("%s\n", inside ? "" : " OUTSIDE");
    return inside;
}

int main(int argc, char **argv) {
    int views = 0, outside = 0;
    for (int i = 1; i < argc; i++) {
        struct gn_err err = {0};
        struct gn_warnings warnings = {0};
        const int64_t begun_ns = gn_clock_thread_cpu_ns();
        struct gn_scene *scene = gn_scene_load(argv[i], NULL, &warnings, &err);
        const double ms = (double)(gn_clock_thread_cpu_ns() - begun_ns) * 1e-6;
        if (!scene) {
            printf("not loaded: %s\n", err.text);
            continue;
        }
        if (scene->added.camera) {
            printf("%s: loaded in %.1f ms\n", argv[i], ms);
            for (int c = GN_POSE_NONE; c < (int)scene->animation.clip_count; c++, views++)
                outside += !print_clip(scene, argv[i], c);
        } else {
            printf("%s: has a camera\n", argv[i]);
        }
        gn_scene_destroy(scene);
    }
    printf("%d clips, %d of them outside\n", views, outside);
    return views == 0 || outside > 0;
}
