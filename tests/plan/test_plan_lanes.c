/* What is counted of whole scenes, against another rasteriser (unit/plain_raster.h) over the same
 * plan: of the passes that draw surfaces into the picture. Holes of masks are not in that one:
 * in the sundial's leaves they are most of what differs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "blocks.glsl"
#include "cost/drawn.h"
#include "frame/frame.h"
#include "plan/fixture.h"
#include "unit/check.h"
#include "unit/plain_raster.h"

static void place(const struct gn_plan *plan, const struct gn_pass *pass,
                  const struct gn_instance *instance, uint32_t vertex, double clip[4]) {
    const float *p = plan->scene->buffers.positions + 3 * (size_t)vertex;
    double at[4] = {0, 0, 0, 1};
    for (int row = 0; row < 3; row++) {
        const float *w = instance->world[row];
        at[row] = (double)w[0] * (double)p[0] + (double)w[1] * (double)p[1] +
                  (double)w[2] * (double)p[2] + (double)w[3];
    }
    for (int k = 0; k < 4; k++) {
        clip[k] = 0;
        for (int i = 0; i < 4; i++) clip[k] += (double)pass->constants[PASS_CLIP + i][k] * at[i];
    }
}

static void draw_plain(struct gn_plain_raster *raster, const struct gn_plan *plan,
                       const struct gn_pass *pass, const struct gn_draw *draw) {
    const struct gn_geometry *geometry = &plan->scene->geometries[draw->geometry];
    for (uint32_t n = 0; n < draw->instance_count; n++)
        for (uint32_t i = 0; i < geometry->index_count; i += 3) {
            const uint32_t *index =
                plan->scene->buffers.indices + geometry->first_index + (size_t)i;
            double clip[3][4];
            for (int k = 0; k < 3; k++) /* a mirrored one winds the other way */
                place(plan, pass, &plan->instances[draw->first_instance + n],
                      index[draw->mirrored ? 2 - k : k], clip[k]);
            gn_plain_triangle(raster, (const double(*)[4])clip, (int)draw->cull, pass->depth_write);
        }
}

static bool is_surfaces(const struct gn_pass *pass) {
    return pass->kind == GN_PASS_PICTURE && pass->target.kind == GN_TARGET_OUTPUT &&
           (strcmp(pass->label, "opaque") == 0 || strcmp(pass->label, "blend") == 0);
}

/* Within 3 % of the lanes and of the pixels of each pass that has many. */
static void compare(struct gn_plan_fixture *f, uint32_t samples) {
    f->opts.output.width_px = GN_PLAIN_WIDTH;
    f->opts.output.height_px = GN_PLAIN_HEIGHT;
    f->opts.output.msaa = samples;
    const struct gn_plan *plan = gn_plan_make(f);
    struct gn_raster_count *counts = calloc(plan->draw_count + 1, sizeof *counts);
    struct gn_plain_raster *raster = gn_plain_create(samples > 1 ? (int)samples : 1);
    uint64_t all = 0;
    gn_cost_count(plan, &f->pose, counts);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        uint64_t pixels = 0, lanes = 0;
        if (!is_surfaces(pass)) continue;
        raster->pixels = raster->lanes = 0;
        for (uint32_t k = 0; k < pass->draw_count; k++) {
            const struct gn_draw *draw = &plan->draws[pass->first_draw + k];
            if (draw->geometry == GN_NO_GEOMETRY) continue;
            draw_plain(raster, plan, pass, draw);
            pixels += counts[pass->first_draw + k].pixels;
            lanes += counts[pass->first_draw + k].lanes;
        }
        print_message("%s, %u samples: %g pixels, %g there; %g lanes, %g there\n", pass->label,
                      samples, (double)pixels, (double)raster->pixels, (double)lanes,
                      (double)raster->lanes);
        all += lanes;
        assert_true(fabs((double)pixels - (double)raster->pixels) <=
                    .03 * (double)raster->pixels + 2);
        assert_true(fabs((double)lanes - (double)raster->lanes) <= .03 * (double)raster->lanes + 4);
    }
    assert_true(all > 1000);
    free(raster);
    free(counts);
}

static void compare_scene(struct gn_scene *scene) {
    struct gn_plan_fixture f = {.scene = scene};
    const struct gn_caps caps = {
        .has = GN_EVERY_CAP, .max_texture_px = 4096, .max_texture_units = 16};
    gn_pose_init(&f.pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&f.pose, 0);
    f.frame = gn_frame_create(scene, &caps);
    for (uint32_t samples = 0; samples <= 4; samples += 4) compare(&f, samples);
    gn_plan_end(&f);
}

static void test_the_stage(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    compare(&f, 0);
    compare(&f, 4);
    gn_plan_end(&f);
}

static void test_scenes_of_the_project(void **state) {
    (void)state;
    static const char *const paths[] = {"assets/bench/yard.glb", "assets/bench/s1.glb",
                                        "assets/bench/s2.glb"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        struct gn_err err = {0};
        struct gn_scene *scene = gn_scene_load(paths[i], NULL, NULL, &err);
        if (!scene) fail_msg("%s", err.text);
        print_message("%s\n", paths[i]);
        compare_scene(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_stage),
        cmocka_unit_test(test_scenes_of_the_project),
    };
    return RUN(tests);
}
