#include "plan/fixture.h"

#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "plan/stage_scene.h"
#include "unit/check.h"

void gn_plan_begin(struct gn_plan_fixture *f, uint32_t caps) {
    f->scene = gn_stage_scene_make();
    gn_pose_init(&f->pose, f->scene, GN_POSE_DEFAULT);
    gn_pose_step(&f->pose, 0);
    struct gn_caps all = {.has = caps, .max_texture_px = 4096, .max_texture_units = 16};
    f->frame = gn_frame_create(f->scene, &all);
    f->opts = (struct gn_frame_opts){0};
}

void gn_plan_end(struct gn_plan_fixture *f) {
    gn_frame_destroy(f->frame);
    gn_pose_finish(&f->pose);
    gn_scene_destroy(f->scene);
}

const struct gn_plan *gn_plan_make(struct gn_plan_fixture *f) {
    return gn_frame_build(f->frame, &f->pose, &f->opts, NULL);
}

static char *print(const struct gn_plan *plan, size_t *size) {
    char *text = NULL;
    FILE *to = open_memstream(&text, size);
    gn_plan_print(plan, to);
    fclose(to);
    return text;
}

void gn_plan_expect(const struct gn_plan *plan, const char *name) {
    char path[256];
    snprintf(path, sizeof path, "tests/plan/golden/%s.txt", name);
    size_t size;
    char *text = print(plan, &size);
    struct gn_err err = {0};
    struct gn_bytes golden = {0};
    if (getenv("GN_UPDATE")) assert_true(gn_file_write(path, text, size, &err));
    if (!gn_file_read(path, 0, &golden, &err)) fail_msg("%s", err.text);
    bool same = golden.size == size && memcmp(golden.data, text, size) == 0;
    gn_bytes_finish(&golden);
    if (!same) print_message("%s differs from this plan (GN_UPDATE=1 accepts it):\n%s", path, text);
    free(text);
    assert_true(same);
}

void gn_plan_add_lights(struct gn_plan_fixture *f, struct gn_light lights[13]) {
    static const char *const names[] = {"Lamp 1", "Lamp 2", "Lamp 3", "Lamp 4", "Lamp 5",
                                        "Lamp 6", "Lamp 7", "Lamp 8", "Lamp 9", "Lamp 10"};
    memcpy(lights, f->scene->lights, 3 * sizeof *lights);
    lights[2].technique = "none";
    for (int i = 0; i < 10; i++) {
        lights[3 + i] = lights[i % 2 ? 1 : 2];
        lights[3 + i].name = names[i];
        lights[3 + i].range_m = i < 2 ? 0.0f : i % 2 ? 5.5f : 0.8f + 0.1f * (float)i;
    }
    for (int i = 5; i < 13; i++) lights[i].outer_rad = 0.25f, lights[i].inner_rad = 0.2f;
    f->scene->lights = lights;
    f->pose.lights = lights;
    f->scene->light_count = 13;
}
