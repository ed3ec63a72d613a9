/* What the filters of equal weights do, and settings that are there for comparison: README of
 * src/shadow has these figures. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/table.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

enum { WIDTH_PX = 640, HEIGHT_PX = 32, PIXELS = WIDTH_PX * HEIGHT_PX };
#define VIEW_M     0.8    /* of the ground, that a row shows */
#define SUN_COSINE 0.8944 /* to the ground's normal */

/* The edge of a sheet 1 m up, along z, whose shadow is seen from above beside it. */
static struct gn_scene *make_edge(void) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[5,1,5]},{'mesh':0,'translation':[-1,1,0],'scale':[1,1,2]},"
                 "{'rotation':[-0.63246,-0.31623,0,0.70711],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}},"
                 "{'camera':0,'translation':[0.5,3,0],'rotation':[-0.70710678,0,0,0.70710678]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':0.4,'ymag':0.02,'znear':0.1,"
                 "'zfar':10}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    struct gn_scene *scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Where a row from dark to lit passes that visibility, pixels. */
static double place_of(const float *row, double visibility) {
    int x = 1;
    while (x < WIDTH_PX - 1 && (double)row[4 * x] < visibility) x++;
    const double before = (double)row[4 * (x - 1)], after = (double)row[4 * x];
    return x - (after > before ? (after - visibility) / (after - before) : 0);
}

/* Across an edge along the map's axis a box is a ramp as wide as itself, of one slope; of which a
 * fiftieth is cut at both ends. */
static void test_a_box_is_a_straight_ramp(void **state) {
    (void)state;
    static const struct {
        enum gn_technique technique;
        double texels;
    } boxes[] = {{GN_TECHNIQUE_BOX3, 3}, {GN_TECHNIQUE_BOX5, 5}};
    static float aov[4 * PIXELS];
    struct help_stage stage;
    struct gn_err err = {0};
    help_stage_open(&stage, make_edge, "egl", NULL, NULL);
    for (int i = 0; i < 2; i++) {
        const struct gn_frame_opts opts = {
            .output.width_px = WIDTH_PX,
            .output.height_px = HEIGHT_PX,
            .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                           .technique = boxes[i].technique,
                           .map_px = 32},
            .debug.aov = GN_AOV_VISIBILITY};
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        if (!gn_gl_read_f32(stage.gl, aov, &err)) fail_msg("%s", err.text);
        const double px = (double)plan->shadows[0].lookup.texel / SUN_COSINE * WIDTH_PX / VIEW_M;
        double at[5];
        for (int k = 0; k < 5; k++) at[k] = place_of(aov, .1 + .2 * k) / px;
        const double width = (at[4] - at[0]) / .8 * 1.04;
        printf("%s: a ramp of %.3f texels, its fifths", gn_techniques[boxes[i].technique].name,
               width);
        for (int k = 0; k < 4; k++) printf(" %.3f", at[k + 1] - at[k]);
        printf("\n");
        assert_true(fabs(width - boxes[i].texels) <= .03 * boxes[i].texels);
        for (int k = 0; k < 4; k++)
            assert_true(fabs(at[k + 1] - at[k] - width / 1.04 / 5) <= .05 * width / 5);
    }
    help_stage_close(&stage);
}

/* Beside an edge, of pixels between .1 and .9 as the mean of their column is: how far they are from
 * that, root mean square; how far a pixel tells what the next one is, 0 to 1; how far the columns
 * are from those of another picture. */
struct noise {
    double rms, correlation, off;
};
static struct noise noise_of(const float *aov, const float *other) {
    struct noise noise = {0};
    double squares = 0, products = 0, before[HEIGHT_PX] = {0};
    int count = 0;
    for (int x = 0; x < WIDTH_PX; x++) {
        double mean = 0, mean_other = 0;
        for (int y = 0; y < HEIGHT_PX; y++) {
            mean += (double)aov[4 * (y * WIDTH_PX + x)] / HEIGHT_PX;
            mean_other += (double)other[4 * (y * WIDTH_PX + x)] / HEIGHT_PX;
        }
        if (mean < .1 || mean > .9) continue;
        for (int y = 0; y < HEIGHT_PX; y++) {
            const double off = (double)aov[4 * (y * WIDTH_PX + x)] - mean;
            squares += off * off;
            products += off * before[y];
            before[y] = off;
        }
        noise.off += fabs(mean - mean_other);
        count++;
    }
    if (count <= 50) fail_msg("%d columns of a penumbra", count);
    noise.rms = sqrt(squares / (count * HEIGHT_PX));
    noise.correlation = squares > 0 ? products / squares : 1;
    noise.off /= count;
    return noise;
}

/* Random taps have the disk's mean; what a pixel is off tells nothing about the next one, and is
 * that of 16 independent taps. */
static void test_white_noise_is_white(void **state) {
    (void)state;
    static float white[4 * PIXELS], disk[4 * PIXELS], fixed[4 * PIXELS];
    struct help_stage stage;
    struct gn_err err = {0};
    float *const pictures[] = {white, disk, fixed};
    help_stage_open(&stage, make_edge, "egl", NULL, NULL);
    for (int i = 0; i < 3; i++) {
        const struct gn_frame_opts opts = {
            .output.width_px = WIDTH_PX,
            .output.height_px = HEIGHT_PX,
            .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                           .technique = i == 1 ? GN_TECHNIQUE_DISK : GN_TECHNIQUE_WHITE,
                           .map_px = 24},
            .shadow.taps_fixed = i == 2,
            .debug.aov = GN_AOV_VISIBILITY};
        help_stage_draw(&stage, &opts, NULL);
        if (!gn_gl_read_f32(stage.gl, pictures[i], &err)) fail_msg("%s", err.text);
    }
    help_stage_close(&stage);
    const struct noise of_white = noise_of(white, disk), of_disk = noise_of(disk, white);
    printf("white: noise %.3f, correlation %.3f, columns off by %.3f; disk: noise %.3f, "
           "correlation %.3f\n",
           of_white.rms, of_white.correlation, of_white.off, of_disk.rms, of_disk.correlation);
    assert_true(of_white.rms > .08 && of_white.rms < .125);
    assert_true(of_disk.rms < .75 * of_white.rms);
    assert_true(fabs(of_white.correlation) < .05);
    assert_true(of_white.off < .03);
    assert_true(noise_of(fixed, disk).rms < .001); /* the same in every pixel */
}

/* From visibility .1 to .9, texels: the mean over maps of several sizes, whose mipmaps lie
 * otherwise beside the edge. */
static double width_of_vsm(struct help_stage *stage, enum gn_moments moments, int *filters) {
    enum { SIZES = 12 };
    static float aov[4 * PIXELS];
    struct gn_err err = {0};
    double sum = 0;
    for (uint32_t i = 0; i < SIZES; i++) {
        const struct gn_frame_opts opts = {
            .output.width_px = WIDTH_PX,
            .output.height_px = HEIGHT_PX,
            .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                    GN_LIGHT_GIVEN(map_format),
                           .technique = GN_TECHNIQUE_VSM,
                           .map_px = 64 + 5 * i,
                           .map_format = GN_MAP_FORMAT(GN_ENCODING_AUTO, moments)},
            .debug.aov = GN_AOV_VISIBILITY};
        const struct gn_plan *plan = help_stage_draw(stage, &opts, NULL);
        if (!gn_gl_read_f32(stage->gl, aov, &err)) fail_msg("%s", err.text);
        const double px = (double)plan->shadows[0].lookup.texel / SUN_COSINE * WIDTH_PX / VIEW_M;
        assert_int_equal(plan->shadows[0].moments, moments);
        *filters = 0;
        for (uint32_t k = 0; k < plan->pass_count; k++)
            *filters += plan->passes[k].kind == GN_PASS_FILTER;
        sum += (place_of(aov, .9) - place_of(aov, .1)) / px / SIZES;
    }
    printf("vsm %s: from .1 to .9 in %.2f texels, %d passes\n", gn_moments[moments].name, sum,
           *filters);
    return sum;
}

/* Mipmaps average about as widely as the blur does that they take the place of, in one pass. */
static void test_mipmaps_are_as_wide_as_the_blur(void **state) {
    (void)state;
    struct help_stage stage;
    int blurs, mips;
    help_stage_open(&stage, make_edge, "egl", NULL, NULL);
    const double blur = width_of_vsm(&stage, GN_MOMENTS_RGBA16F, &blurs),
                 mipmap = width_of_vsm(&stage, GN_MOMENTS_RGBA16F_MIPS, &mips);
    help_stage_close(&stage);
    assert_true(mipmap > .75 * blur && mipmap < 1.33 * blur);
    assert_int_equal(blurs, 2);
    assert_int_equal(mips, 1);
}

/* The limits of the project, over two scenes of each kind of light, and one of each other kind. */
static void test_them_against_truth(void **state) {
    (void)state;
    static const int scenes[] = {2, 7, 14, 19, 25, 28, 31, 34, 37, 40, 43};
    static struct gn_table table;
    struct gn_err err = {0};
    char *folder = gn_table_scenes(false, &err);
    if (!folder) fail_msg("%s", err.text);
    for (int kind = 0; kind < GN_TABLE_KINDS; kind++) {
        table = (struct gn_table){.folder = folder};
        for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) table.scenes[scenes[i]] = true;
        gn_table_add(&table, "box3", "depth", 1024);
        gn_table_add(&table, "box5", "depth", 1024);
        gn_table_add(&table, "vsm", "rgba16f-mips", 1024);
        gn_table_keep(&table, (enum gn_table_kind)kind);
        gn_table_run(&table);
        gn_table_print(&table, stdout);
        assert_int_equal(gn_table_check(&table, stdout), 0);
    }
    free(folder);
}

/* ---- which faces cast ---- */

/* A cube on the ground and one over it, under a light of that type. */
static enum gn_light_type light_type;
static struct gn_scene *make_cubes(void) {
    static const char *const lights[GN_LIGHT_TYPE_COUNT] = {
        [GN_LIGHT_DIRECTIONAL] = "'directional','intensity':3",
        [GN_LIGHT_SPOT] = "'spot','intensity':300,'spot':{'outerConeAngle':0.9}",
        [GN_LIGHT_POINT] = "'point','intensity':300"};
    struct gn_maker maker;
    struct gn_err err = {0};
    char extensions[256];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[5,1,5]},"
                 "{'mesh':1,'translation':[-1,0.5,0],'scale':[0.5,0.5,0.5]},"
                 "{'mesh':1,'translation':[1,1.5,0.2],'rotation':[0.28,0.36,0.1,0.884],"
                 "'scale':[0.5,0.3,0.5]},"
                 "{'translation':[0.3,5,0.5],'rotation':[-0.70710678,0,0,0.70710678],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}},"
                 "{'camera':0,'translation':[0,5,9],'rotation':[-0.2588,0,0,0.9659]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.75,'znear':0.1,'zfar':40}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    snprintf(extensions, sizeof extensions, "{'KHR_lights_punctual':{'lights':[{'type':%s}]}}",
             lights[light_type]);
    gn_maker_set(&maker, "extensions", extensions);
    struct gn_scene *scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

enum { MAP_PX = 256, TEXELS_MAX = 6 * MAP_PX * MAP_PX };

static struct gn_frame_opts map_opts(enum gn_encoding encoding) {
    return (struct gn_frame_opts){
        .output.width_px = 160,
        .output.height_px = 120,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = GN_TECHNIQUE_HARD,
                       .map_px = MAP_PX,
                       .map_format = GN_MAP_FORMAT(encoding, GN_MOMENTS_NONE)},
        .shadow.cascades = 1};
}

/* The distances or depths that the map holds, metres; INFINITY: nothing. */
static uint32_t read_distances(struct help_stage *stage, enum gn_encoding encoding,
                               enum gn_cast_faces faces, float *to) {
    struct gn_err err = {0};
    struct gn_frame_opts opts = map_opts(encoding);
    GN_LIGHT_SET(&opts.shadow.any, faces, 1 + (int)faces);
    const struct gn_shadow_view *view = help_stage_draw(stage, &opts, NULL)->shadows;
    assert_int_equal(view->encoding, encoding);
    if (!gn_gl_read_map(stage->gl, 0, to, &err)) fail_msg("%s", err.text);
    const uint32_t count = view->map.width_px * view->map.height_px;
    for (uint32_t i = 0; i < count; i++) {
        const float code = to[i];
        if (code >= view->code.far_end)
            to[i] = INFINITY;
        else if (!gn_encoding_is_depth(encoding))
            to[i] = (code - view->code.offset) / view->code.scale;
        else
            to[i] = view->perspective
                        ? view->lookup.depth_code[1] / (code - view->lookup.depth_code[0])
                        : code * view->code.far_m;
    }
    return count;
}

/* Half-way between first and second depth, in each texel and encoding; and where there is no back
 * face (of the ground, which is open) what is there. */
static void test_the_middle_lies_between_front_and_back(void **state) {
    (void)state;
    static const enum gn_encoding encodings[] = {GN_ENCODING_DEPTH, GN_ENCODING_R32UI,
                                                 GN_ENCODING_R16F, GN_ENCODING_RGBA8,
                                                 GN_ENCODING_DEPTH16};
    static float front[TEXELS_MAX], back[TEXELS_MAX], middle[TEXELS_MAX];
    for (int type = 0; type < GN_LIGHT_TYPE_COUNT; type++)
        for (int e = 0; e < 5; e++) {
            struct help_stage stage;
            light_type = (enum gn_light_type)type;
            help_stage_open(&stage, make_cubes, "egl", NULL, NULL);
            read_distances(&stage, encodings[e], GN_CAST_FRONT, front);
            read_distances(&stage, encodings[e], GN_CAST_BACK, back);
            const uint32_t count = read_distances(&stage, encodings[e], GN_CAST_MIDDLE, middle);
            int compared = 0, off = 0;
            double thickest = 0, worst = 0;
            for (uint32_t i = 0; i < count; i++) {
                const double depth = (double)back[i] - (double)front[i];
                if (!isfinite(back[i]) || !isfinite(front[i])) continue;
                const double error =
                    fabs((double)middle[i] - 0.5 * ((double)front[i] + (double)back[i]));
                compared++;
                off += error > .004;
                worst = fmax(worst, error);
                thickest = fmax(thickest, depth);
            }
            printf("%s %s: %d texels, up to %.2f m thick, middle off by %.5f m at most, %d by more "
                   "than 4 mm\n",
                   gn_light_types[type].name, gn_encodings[encodings[e]].name, compared, thickest,
                   worst, off);
            assert_true(compared > 1000 && thickest > .5);
            assert_true(off == 0);
            help_stage_close(&stage);
        }
}

/* A map of 16 bits holds multiples of a step that one of 24 bits does not. */
static void test_sixteen_bits_are_sixteen(void **state) {
    (void)state;
    static const enum gn_encoding encodings[] = {GN_ENCODING_DEPTH, GN_ENCODING_DEPTH16};
    static float map[TEXELS_MAX];
    struct help_stage stage;
    light_type = GN_LIGHT_SPOT;
    help_stage_open(&stage, make_cubes, "egl", NULL, NULL);
    for (int i = 0; i < 2; i++) {
        struct gn_frame_opts opts = map_opts(encodings[i]);
        struct gn_err err = {0};
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        if (!gn_gl_read_map(stage.gl, 0, map, &err)) fail_msg("%s", err.text);
        int odd = 0;
        for (int k = 0; k < MAP_PX * MAP_PX; k++) {
            const double steps = (double)map[k] * 65535;
            odd += fabs(steps - round(steps)) > .02;
        }
        printf("%s: %d of %d texels between steps of 16 bits, %llu bytes\n",
               gn_encodings[encodings[i]].name, odd, MAP_PX * MAP_PX,
               (unsigned long long)gn_plan_map_bytes(plan));
        assert_true(encodings[i] == GN_ENCODING_DEPTH ? odd > 1000 : odd == 0);
        assert_int_equal(gn_plan_map_bytes(plan),
                         MAP_PX * MAP_PX * (encodings[i] == GN_ENCODING_DEPTH ? 4 : 2));
    }
    help_stage_close(&stage);
}

/* Mipmaps would mix the tiles of a point light: those are blurred. */
static void test_tiles_have_no_mipmaps(void **state) {
    (void)state;
    for (int type = 0; type < GN_LIGHT_TYPE_COUNT; type++) {
        struct help_stage stage;
        struct gn_warnings warnings = {0};
        struct gn_frame_opts opts = map_opts(GN_ENCODING_AUTO);
        GN_LIGHT_SET(&opts.shadow.any, technique, GN_TECHNIQUE_VSM);
        GN_LIGHT_SET(&opts.shadow.any, map_format,
                     GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA16F_MIPS));
        light_type = (enum gn_light_type)type;
        help_stage_open(&stage, make_cubes, "egl", NULL, NULL);
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, &warnings);
        assert_int_equal(plan->shadows[0].moments,
                         type == GN_LIGHT_POINT ? GN_MOMENTS_RGBA16F : GN_MOMENTS_RGBA16F_MIPS);
        assert_int_equal(warnings.count, type == GN_LIGHT_POINT ? 1 : 0);
        help_stage_close(&stage);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_box_is_a_straight_ramp),
        cmocka_unit_test(test_white_noise_is_white),
        cmocka_unit_test(test_mipmaps_are_as_wide_as_the_blur),
        cmocka_unit_test(test_them_against_truth),
        cmocka_unit_test(test_sixteen_bits_are_sixteen),
        cmocka_unit_test(test_tiles_have_no_mipmaps),
        cmocka_unit_test(test_the_middle_lies_between_front_and_back),
    };
    return cmocka_run_group_tests_name("filters", tests, NULL, NULL);
}
