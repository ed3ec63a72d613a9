/* Summed-area tables as the GPU makes them: against sums in double precision, against the loops
 * that a first attempt at one has, and made again only when their map was. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/arena.h"
#include "gl/private.h"
#include "image/shot.h"
#include "plan/field_scene.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

static struct help_stage stage;
static struct gn_warnings warnings;
static struct gn_err err;

static void open_with(const char *backend, const char *without) {
    memset(&warnings, 0, sizeof warnings);
    help_stage_open(&stage, gn_stage_scene_make, backend, without, &warnings);
    gn_pose_step(&stage.pose, 0);
}

HELP_OPENS(open_egl, "egl", NULL)
HELP_OPENS(open_osmesa, "osmesa", NULL)

static int open_field(void **state) {
    (void)state;
    help_stage_open(&stage, gn_field_scene_make, "egl", NULL, NULL);
    return 0;
}

static int close_all(void **state) {
    (void)state;
    help_stage_close(&stage);
    return 0;
}

static const struct gn_plan *draw(enum gn_technique technique, uint32_t map_px) {
    const struct gn_frame_opts opts = {
        .output.width_px = 64,
        .output.height_px = 48,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = technique,
                       .map_px = map_px}};
    return help_stage_draw(&stage, &opts, &warnings);
}

/* ---- reading and filling ---- */

static uint32_t *read_texels(const struct gn_gl_map *map) {
    uint32_t *out = gn_xalloc((size_t)map->width_px * map->height_px, 4 * sizeof *out);
    gn_gl_bind_framebuffer(stage.gl, map->framebuffer);
    GL(stage.gl, ReadPixels)
    (0, 0, (GLsizei)map->width_px, (GLsizei)map->height_px, GL_RGBA_INTEGER, GL_UNSIGNED_INT, out);
    return out;
}

static uint32_t seed;
static double dice(void) {
    seed = seed * 1664525u + 1013904223u;
    return (seed >> 8) / 16777216.0;
}

/* Factor and sum that make 0..1 of what a tile's table spans of codes. */
static void code_of(const struct gn_shadow_view *view, uint32_t tile, float code[2]) {
    code[0] = 1.0f;
    code[1] = 0.0f;
    if (view->map.cascade_count == 0 || view->raster.tiles[tile].empty) return;
    code[0] = view->code.far_m / view->cascades[tile].span;
    code[1] = -view->cascades[tile].nearest / view->cascades[tile].span;
}

static uint32_t tile_at(const struct gn_shadow_view *view, size_t texel) {
    const uint32_t x = (uint32_t)(texel % view->map.width_px),
                   y = (uint32_t)(texel / view->map.width_px);
    for (uint32_t i = 0; i < view->map.tile_count; i++)
        if (x - view->raster.tiles[i].x_px < view->map.tile_px &&
            y - view->raster.tiles[i].y_px < view->map.tile_px)
            return i;
    return 0;
}

/* Other codes in the place of those of a map, as far as its tables know drawn so, all over what
 * they span; 1: clear. What tables make of them. */
static float *fill(const struct gn_plan *plan, uint32_t slot) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    struct gn_gl_map *map = gn_gl_view_find(stage.gl, view, slot, false);
    struct gn_gl_map *table = gn_gl_view_find(stage.gl, view, slot, true);
    const size_t count = (size_t)map->width_px * map->height_px;
    float *codes = gn_xalloc(count, sizeof *codes), *known = gn_xalloc(count, sizeof *known);
    assert_int_equal(map->encoding, GN_ENCODING_R32UI);
    for (size_t i = 0; i < count; i++) {
        float code[2];
        code_of(view, tile_at(view, i), code);
        const bool clear = dice() < 0.3;
        codes[i] = clear ? 1.0f : ((float)(0.999 * dice()) - code[1]) / code[0];
        known[i] = clear ? 1.0f : codes[i] * code[0] + code[1];
        assert_true(code[0] + code[1] > 0.9999f); /* what is clear is so for tables, too */
    }
    gn_gl_work_on_texture(stage.gl, map->texture);
    GL(stage.gl, TexSubImage2D)
    (GL_TEXTURE_2D, 0, 0, 0, (GLsizei)map->width_px, (GLsizei)map->height_px, GL_RED_INTEGER,
     GL_UNSIGNED_INT, codes);
    free(codes);
    memset(table->content_hash, 0, sizeof table->content_hash);
    return known;
}

static void run(const struct gn_plan *plan) {
    if (!gn_gl_run(stage.gl, plan, NULL, &err)) fail_msg("%s", err.text);
}

/* ---- against double ---- */

struct sums {
    const uint32_t *texels; /* four each */
    const float *codes;
    uint32_t width_px, x_px, y_px, side_px; /* of all; a tile */
    double scale;
};

/* Mean of moment m over a square whose lower left texel is x, y of the tile, 1 at least. */
static double mean_of(const struct sums *s, int m, uint32_t x, uint32_t y, uint32_t side) {
    const uint32_t low = (s->y_px + y - 1) * s->width_px, high = low + side * s->width_px,
                   left = s->x_px + x - 1, right = left + side;
    const uint32_t *t = s->texels + m;
    const uint32_t sum =
        t[4 * (high + right)] - t[4 * (high + left)] - t[4 * (low + right)] + t[4 * (low + left)];
    return sum / s->scale / side / side;
}

/* Of the casters alone, and their share. */
static double variance_of(const struct sums *s, uint32_t x, uint32_t y, uint32_t side,
                          double *share) {
    double sum = 0, square = 0, n = 0;
    for (uint32_t j = y; j < y + side; j++)
        for (uint32_t i = x; i < x + side; i++) {
            const double c = (double)s->codes[(s->y_px + j) * s->width_px + s->x_px + i];
            if (c >= 1) continue;
            sum += c;
            square += c * c;
            n++;
        }
    assert_true(n > 0);
    *share = n / side / side;
    return square / n - sum / n * (sum / n);
}

/* Of variances times shares, and of shares. */
static double worst_variance(const struct sums *s, uint32_t side) {
    double worst = 0;
    for (int i = 0; i < 3000; i++) {
        const uint32_t x = 1 + (uint32_t)(dice() * (s->side_px - side - 1)),
                       y = 1 + (uint32_t)(dice() * (s->side_px - side - 1));
        const double w = mean_of(s, 3, x, y, side), m = mean_of(s, 0, x, y, side) / w;
        const double v = m * (1 - m) - 0.25 * mean_of(s, 1, x, y, side) / w;
        double share;
        const double right = variance_of(s, x, y, side, &share);
        worst = fmax(worst, fmax(share * fabs(v - right), fabs(w - share)));
    }
    return worst;
}

/* All tiles of a light's table. */
static void check_table(const struct gn_plan *plan, uint32_t slot) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    float *codes = fill(plan, slot);
    run(plan);
    uint32_t *texels = read_texels(gn_gl_view_find(stage.gl, view, slot, true));
    for (uint32_t tile = 0; tile < view->map.tile_count; tile++) {
        const float side = 2 * view->lookup.reach_px + 2;
        const struct sums s = {.texels = texels,
                               .codes = codes,
                               .width_px = view->map.width_px,
                               .x_px = view->raster.tiles[tile].x_px,
                               .y_px = view->raster.tiles[tile].y_px,
                               .side_px = view->map.tile_px,
                               .scale = (double)(4294966272.0f / (side * side) - 1.0f)};
        const double worst = worst_variance(&s, 9);
        print_message("%u x %u, tile %u: variance over 9 x 9 at most %.2g off\n", view->map.tile_px,
                      view->map.tile_px, tile, worst);
        assert_true(worst < 1e-6);
        if (side < (float)view->map.tile_px)
            assert_true(worst_variance(&s, (uint32_t)side - 2) < 1e-6);
    }
    free(texels);
    free(codes);
}

/* 1000 and 129 are no whole number of blocks. */
static void test_tables_are_right(void **state) {
    (void)state;
    static const uint32_t sizes[] = {1024, 1000, 129};
    for (int i = 0; i < 3; i++) {
        const struct gn_plan *plan = draw(GN_TECHNIQUE_VSSM, sizes[i]);
        for (uint32_t slot = 0; slot < plan->shadow_count; slot++)
            if (i == 2 || plan->shadows[slot].map.tile_count == 1) check_table(plan, slot);
    }
}

static void test_tables_of_cascades_are_right(void **state) {
    (void)state;
    const struct gn_plan *plan = draw(GN_TECHNIQUE_VSSM, 300);
    assert_true(plan->shadows[0].map.cascade_count > 1);
    check_table(plan, 0);
}

/* ---- how often ---- */

static void test_a_still_scene_makes_no_table(void **state) {
    (void)state;
    const enum gn_technique both[] = {GN_TECHNIQUE_VSSM, GN_TECHNIQUE_SMSM};
    for (int i = 0; i < 2; i++) {
        const struct gn_plan *plan = draw(both[i], 128);
        assert_true(gn_gl_stats(stage.gl).shadow_draws > 0);
        run(plan);
        assert_int_equal(gn_gl_stats(stage.gl).shadow_draws, 0);
        gn_pose_step(&stage.pose, 20000000); /* a box has moved by 2 cm */
        draw(both[i], 128);
        assert_true(gn_gl_stats(stage.gl).shadow_draws > 0);
        gn_pose_step(&stage.pose, 0);
    }
}

/* ---- numbers ---- */

enum { WIDTH = 64, HEIGHT = 48 };

static void check_frame(enum gn_technique technique, int light) {
    static float picture[WIDTH * HEIGHT][4];
    const struct gn_frame_opts opts = {
        .output.width_px = WIDTH,
        .output.height_px = HEIGHT,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = technique,
                       .map_px = 48},
        .debug.aov = GN_AOV_VISIBILITY,
        .debug.light = light,
        .view.turntable_rad = (float)(6.28 * dice())};
    gn_pose_step(&stage.pose, (int64_t)(dice() * 6e9));
    help_stage_draw(&stage, &opts, &warnings);
    if (!gn_gl_read_f32(stage.gl, picture[0], &err)) fail_msg("%s", err.text);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        if (!(picture[i][0] >= 0 && picture[i][0] <= 1)) /* nor is it no number */
            fail_msg("%s, light %d: pixel %d,%d is %g", gn_techniques[technique].name, light,
                     i % WIDTH, i / WIDTH, (double)picture[i][0]);
}

static void test_every_pixel_is_a_share_of_light(void **state) {
    (void)state;
    const int frames = gn_shot_full() ? 1000 : 60;
    for (int i = 0; i < frames; i++)
        check_frame(i % 2 ? GN_TECHNIQUE_VSSM : GN_TECHNIQUE_SMSM, i / 2 % 3);
}

/* ---- how fast ---- */

static double cpu_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* What a table costs when each texel adds up all before it, along rows and then along columns. */
static const char loop_vertex[] = "#version 300 es\n"
                                  "void main() {\n"
                                  "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, "
                                  "gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
                                  "}\n";
static const char loop_rows[] =
    "#version 300 es\n"
    "precision highp float;\nprecision highp int;\nprecision highp usampler2D;\n"
    "uniform usampler2D u_map_0;\n"
    "layout(location = 0) out uvec4 o_sum;\n"
    "void main() {\n"
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
    "    uvec4 sum = uvec4(0u);\n"
    "    for (int x = 0; x <= at.x; x++) {\n"
    "        float z = uintBitsToFloat(texelFetch(u_map_0, ivec2(x, at.y), 0).r);\n"
    "        sum += uvec4(vec4(z, z * z, 0.0, 0.0) * 254141.0 + 0.5);\n"
    "    }\n"
    "    o_sum = sum;\n"
    "}\n";
static const char loop_columns[] =
    "#version 300 es\n"
    "precision highp float;\nprecision highp int;\nprecision highp usampler2D;\n"
    "uniform usampler2D u_map_0;\n"
    "layout(location = 0) out uvec4 o_sum;\n"
    "void main() {\n"
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
    "    uvec4 sum = uvec4(0u);\n"
    "    for (int y = 0; y <= at.y; y++) sum += texelFetch(u_map_0, ivec2(at.x, y), 0);\n"
    "    o_sum = sum;\n"
    "}\n";

static void loop_pass(GLuint program, const struct gn_gl_map *from, const struct gn_gl_map *to) {
    struct gn_gl *gl = stage.gl;
    gn_gl_bind_framebuffer(gl, to->framebuffer);
    gn_gl_set_viewport(gl,
                       (struct gn_gl_rect){0, 0, (GLsizei)to->width_px, (GLsizei)to->height_px});
    gn_gl_set_scissor(gl, NULL);
    gn_gl_set_depth(gl, false, false);
    gn_gl_set_blend(gl, GN_BLEND_OFF);
    gn_gl_set_cull(gl, GN_CULL_NONE, false);
    gn_gl_use_program(gl, program);
    const GLint u_map = GL(gl, GetUniformLocation)(program, "u_map_0");
    GL(gl, Uniform1i)(u_map, GN_GL_UNIT_WORK);
    gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, from->texture,
                       gl->targets.map_samplers[GN_GL_MAP_NEAREST]);
    GL(gl, DrawArrays)(GL_TRIANGLES, 0, 3);
    GL(gl, Finish)();
}

/* By loops, into the same two textures. */
static double loops_ms(const struct gn_plan *plan, uint32_t slot) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    struct gn_gl *gl = stage.gl;
    const struct gn_target scratch = {.kind = GN_TARGET_MOMENTS,
                                      .slot = slot,
                                      .width_px = view->map.width_px,
                                      .height_px = view->map.height_px,
                                      .moments = view->moments,
                                      .index = 1};
    const struct gn_gl_map *map = gn_gl_view_find(gl, view, slot, false),
                           *table = gn_gl_view_find(gl, view, slot, true),
                           *between = gn_gl_target_find(gl, &scratch);
    GLuint rows = gn_gl_program_link(gl, loop_vertex, loop_rows, &err),
           columns = gn_gl_program_link(gl, loop_vertex, loop_columns, &err);
    assert_true(rows && columns && map && table && between);
    GLuint array = gn_gl_object_create(gl, GN_GL_VERTEX_ARRAY);
    double best = INFINITY;
    gn_gl_bind_vertex_array(gl, array);
    for (int i = 0; i < 2; i++) { /* compiled at the first draw */
        const double start = cpu_ms();
        loop_pass(rows, map, between);
        loop_pass(columns, between, table);
        best = fmin(best, cpu_ms() - start);
    }
    gn_gl_object_destroy(gl, GN_GL_VERTEX_ARRAY, &array);
    gn_gl_use_program(gl, 0);
    GL(gl, DeleteProgram)(rows);
    GL(gl, DeleteProgram)(columns);
    return best;
}

static double frame_ms(const struct gn_plan *plan) {
    const double start = cpu_ms();
    run(plan);
    GL(stage.gl, Finish)();
    return cpu_ms() - start;
}

/* Of a frame, what making its table again adds: the least of both kinds, by turns, since a machine
 * is now faster, now slower. */
static double blocks_ms(const struct gn_plan *plan, uint32_t slot) {
    struct gn_gl_map *table = gn_gl_view_find(stage.gl, &plan->shadows[slot], slot, true);
    double without = INFINITY, with = INFINITY;
    for (int i = 0; i < 7; i++) {
        without = fmin(without, frame_ms(plan));
        memset(table->content_hash, 0, sizeof table->content_hash);
        with = fmin(with, frame_ms(plan));
    }
    return with - without;
}

static void test_blocks_take_an_eighth_of_the_time_of_loops(void **state) {
    (void)state;
    const struct gn_plan *plan = draw(GN_TECHNIQUE_VSSM, 512);
    uint32_t slot = 0;
    while (plan->shadows[slot].map.tile_count > 1) slot++;
    const double blocks = blocks_ms(plan, slot), loops = loops_ms(plan, slot);
    print_message("a table of 512: %.2f ms in blocks, %.2f ms by loops, 1/%.1f (CPU)\n", blocks,
                  loops, loops / blocks);
    assert_true(blocks > 0);
    assert_true(blocks <= loops / 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tables_are_right),
        cmocka_unit_test(test_a_still_scene_makes_no_table),
        cmocka_unit_test(test_every_pixel_is_a_share_of_light),
        cmocka_unit_test(test_blocks_take_an_eighth_of_the_time_of_loops),
    };
    const struct CMUnitTest field[] = {cmocka_unit_test(test_tables_of_cascades_are_right)};
    return cmocka_run_group_tests_name("tables, egl", tests, open_egl, close_all) +
           cmocka_run_group_tests_name("tables, osmesa", tests, open_osmesa, close_all) +
           cmocka_run_group_tests_name("tables, field", field, open_field, close_all);
}
