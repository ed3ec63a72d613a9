/* What is counted for shadow maps, against what is allocated for them: for each technique, way to
 * store it and kind of light. */
#include <stdio.h>
#include <string.h>

#include "gl/private.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

static struct help_stage stage;

/* Of what this plan uses. */
static uint64_t allocated_bytes(const struct gn_plan *plan) {
    struct gn_err err = {0};
    uint64_t bytes = 0;
    stage.gl->targets.prepares++;
    if (!gn_gl_maps_ensure(stage.gl, plan, &err)) fail_msg("%s", err.text);
    for (int i = 0; i < GN_GL_MAPS_MAX; i++) {
        const struct gn_gl_map *map = &stage.gl->targets.maps[i];
        if (map->framebuffer && map->last_used == stage.gl->targets.prepares) bytes += map->bytes;
    }
    return bytes;
}

static uint64_t kept_bytes(void) {
    uint64_t bytes = 0;
    for (int i = 0; i < GN_GL_MAPS_MAX; i++) bytes += stage.gl->targets.maps[i].bytes;
    return bytes;
}

static void compare(const struct gn_frame_opts *opts) {
    const struct gn_light_opts *any = &opts->shadow.any;
    const enum gn_encoding encoding = GN_MAP_FORMAT_ENCODING(any->map_format);
    const struct gn_plan *plan = gn_frame_build(stage.frame, &stage.pose, opts, NULL);
    const uint64_t allocated = allocated_bytes(plan), counted = gn_plan_map_bytes(plan);
    if (allocated != counted)
        fail_msg("%s, %s, %s, %u px: %llu bytes allocated, %llu counted",
                 gn_techniques[any->technique].name,
                 encoding < GN_ENCODING_COUNT ? gn_encodings[encoding].name : "auto",
                 gn_moments[GN_MAP_FORMAT_MOMENTS(any->map_format)].name, any->map_px,
                 (unsigned long long)allocated, (unsigned long long)counted);
    assert_true(opts->shadow.maps_bytes == 0 || kept_bytes() <= opts->shadow.maps_bytes);
}

static void all_that_is_allocated_is_counted(void **state) {
    (void)state;
    static const unsigned sizes[] = {1024, 100, 0};
    static const uint64_t limits[] = {0, 1 << 20, 8 << 20};
    int cases = 0;
    for (int i = 0; i < 3; i++) {
        help_stage_open(&stage, gn_stage_scene_make, "egl", NULL, NULL);
        for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
            for (int e = 0; e <= GN_ENCODING_AUTO; e++)
                for (int m = 0; m < GN_MOMENTS_COUNT; m++)
                    for (int k = 0; k < 6; k++) {
                        struct gn_frame_opts opts = {
                            .output.width_px = 64,
                            .output.height_px = 64,
                            .shadow.any = {.given = GN_LIGHT_GIVEN(technique) |
                                                    (sizes[k % 3] ? GN_LIGHT_GIVEN(map_px) : 0) |
                                                    GN_LIGHT_GIVEN(faces) |
                                                    GN_LIGHT_GIVEN(map_format),
                                           .technique = (enum gn_technique)t,
                                           .map_px = sizes[k % 3],
                                           .faces = k % 2 ? 1 + GN_CAST_MIDDLE : 0,
                                           .map_format = GN_MAP_FORMAT((enum gn_encoding)e,
                                                                       (enum gn_moments)m)},
                            .shadow.planar_points = e == GN_ENCODING_MEAN ? 64 : 0,
                            .shadow.maps_bytes = limits[i],
                            .shadow.cascades = k / 3 ? 1 : 0};
                        const bool filters = gn_technique_filters_map(opts.shadow.any.technique);
                        if (e == GN_ENCODING_STENCIL || (filters && e != GN_ENCODING_AUTO) ||
                            (!filters && m != GN_MOMENTS_NONE))
                            continue;
                        compare(&opts);
                        cases++;
                    }
        help_stage_close(&stage);
    }
    assert_true(cases > 500);
}

/* As both sides of a split screen are drawn, by turns: at other samples and with other maps. */
static void views_keep_their_targets(void **state) {
    (void)state;
    help_stage_open(&stage, gn_stage_scene_make, "egl", NULL, NULL);
    struct gn_frame *const first = stage.frame,
                           *second = gn_frame_create(stage.scene, gn_gl_caps(stage.gl));
    uint64_t made[2];
    for (uint32_t apart = 0; apart < 2; apart++) {
        struct gn_frame_opts opts[2] = {
            {.output = {.width_px = 64, .height_px = 64, .msaa = 4}},
            {.output = {.width_px = 64, .height_px = 64}, .number = apart},
        };
        GN_LIGHT_SET(&opts[1].shadow.any, faces, 1 + GN_CAST_FRONT);
        for (int i = 0; i < 6; i++) {
            if (i == 2) made[apart] = gn_gl_stats(stage.gl).objects_created;
            stage.frame = i % 2 ? second : first;
            const struct gn_plan *plan = help_stage_draw(&stage, &opts[i % 2], NULL);
            const uint32_t skipped = gn_gl_stats(stage.gl).shadow_passes_skipped;
            if (apart && i >= 2) assert_true(plan->shadow_count > 0 && skipped > 0);
            if (!apart && i >= 2) assert_int_equal(skipped, 0);
        }
        made[apart] = gn_gl_stats(stage.gl).objects_created - made[apart];
    }
    assert_true(made[0] > 0); /* one output is made again for each frame */
    assert_int_equal(made[1], 0);
    const uint64_t both = kept_bytes();
    gn_gl_drop_view(stage.gl, 1);
    assert_true(kept_bytes() > 0 && kept_bytes() < both);
    gn_frame_destroy(second);
    stage.frame = first;
    help_stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_that_is_allocated_is_counted),
        cmocka_unit_test(views_keep_their_targets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
