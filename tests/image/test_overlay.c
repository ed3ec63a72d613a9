/* Marks of lights and panels of maps: what they show is true, and the picture under them is as it
 * was. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame.h"
#include "plan/field_scene.h"
#include "plan/stage_scene.h"
#include "shadow/grey.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH = 640, HEIGHT = 512, PIXELS = WIDTH * HEIGHT, MAP = 120 };

static struct help_stage stage;
static struct gn_frame_opts opts;
static struct gn_err err;
static uint8_t bare[HEIGHT][WIDTH][4], shown[HEIGHT][WIDTH][4];

static struct gn_scene *make_scene(void) {
    struct gn_scene *scene = gn_stage_scene_make();
    struct gn_light *bulb = &scene->lights[2];
    glm_vec3_copy((vec3){-2, 3, 3}, scene->nodes[bulb->node].translation); /* in view */
    bulb->technique = "none"; /* two maps are enough here */
    return scene;
}

static void open_scene(struct gn_scene *(*make)(void), const char *backend, const char *without) {
    help_stage_open(&stage, make, backend, without, NULL);
    opts = (struct gn_frame_opts){.output.width_px = WIDTH,
                                  .output.height_px = HEIGHT,
                                  .shadow.any = {.given = GN_LIGHT_GIVEN(map_px), .map_px = MAP},
                                  .shadow.cascades =
                                      1}; /* texel by texel an atlas is larger than a panel */
}

static void open_with(const char *backend, const char *without) {
    open_scene(make_scene, backend, without);
}

HELP_OPENS(open_egl, "egl", NULL)
HELP_OPENS(open_osmesa, "osmesa", NULL)
HELP_OPENS(open_egl_without_srgb, "egl", "srgb")

/* One map is too coarse for it. */
static int open_field(void **state) {
    (void)state;
    open_scene(gn_field_scene_make, "egl", NULL);
    return 0;
}

static int close_all(void **state) {
    (void)state;
    help_stage_close(&stage);
    return 0;
}

static const struct gn_plan *draw(uint8_t picture[HEIGHT][WIDTH][4]) {
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (!gn_gl_read_rgba8(stage.gl, &picture[0][0][0], &err)) fail_msg("%s", err.text);
    return plan;
}

static const struct gn_pass *pass_called(const struct gn_plan *plan, const char *label) {
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (strncmp(plan->passes[i].label, label, strlen(label)) == 0) return &plan->passes[i];
    fail_msg("no pass '%s'", label);
    return NULL;
}

static bool differs(int x, int y) { return memcmp(bare[y][x], shown[y][x], 3) != 0; }

/* ---- maps ---- */

/* A panel as large as its map shows it texel by texel, inside its frame. */
static void expect_map(const struct gn_plan *plan, uint32_t slot, const struct gn_rect *r) {
    static float codes[MAP][MAP];
    if (!gn_gl_read_map(stage.gl, slot, &codes[0][0], &err)) fail_msg("%s", err.text);
    const struct gn_shadow_grey grey = gn_shadow_grey_of(&plan->shadows[slot]);
    int least = 255, most = 0;
    assert_true(r->width == MAP && r->height == MAP);
    for (int y = 4; y < MAP - 4; y++)
        for (int x = 4; x < MAP - 4; x++) {
            const uint8_t *p = shown[HEIGHT - 1 - ((int)r->y + y)][(int)r->x + x];
            int expected = (int)lrintf(255 * gn_shadow_grey_at(&grey, codes[y][x]));
            if (abs(p[0] - expected) > 1 || p[1] != p[0] || p[2] != p[0])
                fail_msg("%s map, %d, %d: %d %d %d, not %d",
                         gn_encodings[plan->shadows[slot].encoding].name, x, y, p[0], p[1], p[2],
                         expected);
            least = expected < least ? expected : least;
            most = expected > most ? expected : most;
        }
    assert_true(most == 255 && least < 200); /* there is something in it */
}

static void test_panels_show_the_maps(void **state) {
    (void)state;
    static const char *const labels[] = {"panel 0 Sun", "panel 1 Spot"};
    opts.debug.show_maps = true;
    for (int encoding = 0; encoding < GN_ENCODING_MASK; encoding++) {
        GN_LIGHT_SET(&opts.shadow.any, map_format,
                     GN_MAP_FORMAT((enum gn_encoding)encoding, GN_MOMENTS_NONE));
        const struct gn_plan *plan = draw(shown);
        assert_int_equal(plan->shadow_count, 2);
        for (uint32_t slot = 0; slot < 2; slot++) {
            assert_int_equal(plan->shadows[slot].encoding, encoding);
            expect_map(plan, slot, &pass_called(plan, labels[slot])->rect);
        }
    }
}

static void test_only_the_panels_change_the_picture(void **state) {
    (void)state;
    draw(bare);
    opts.debug.show_maps = true;
    const struct gn_plan *plan = draw(shown);
    const struct gn_rect *a = &pass_called(plan, "panel 0")->rect,
                         *b = &pass_called(plan, "panel 1")->rect;
    assert_true(a->x + a->width < b->x);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            int row = HEIGHT - 1 - y;
            bool in_a = x >= (int)a->x && x < (int)(a->x + a->width) && row >= (int)a->y &&
                        row < (int)(a->y + a->height);
            bool in_b = x >= (int)b->x && x < (int)(b->x + b->width) && row >= (int)b->y &&
                        row < (int)(b->y + b->height);
            if (!in_a && !in_b) assert_false(differs(x, y));
        }
}

/* The least number of passes that their tiles take. */
static void expect_kept_maps(uint32_t least) {
    opts.shadow.cascades = 4;
    draw(bare);
    opts.debug.show_maps = true;
    const struct gn_plan *plan = draw(shown);
    uint32_t passes = 0;
    for (uint32_t i = 0; i < plan->shadow_count; i++) passes += plan->shadows[i].map.tile_count;
    assert_true(passes >= least);
    assert_int_equal(gn_gl_stats(stage.gl).shadow_passes_skipped, passes);
    const uint64_t objects = gn_gl_stats(stage.gl).objects_created;
    draw(shown);
    assert_int_equal(gn_gl_stats(stage.gl).objects_created, objects);
}

static void test_maps_are_not_drawn_again_for_panels(void **state) {
    (void)state;
    expect_kept_maps(2); /* sun and spot */
}

static void test_cascades_are_not_drawn_again_for_panels(void **state) {
    (void)state;
    expect_kept_maps(4);
}

/* ---- marks ---- */

/* Where a place in the world is in the picture; false: not in it. */
static bool project(const struct gn_plan *plan, const vec3 place, int pixel[2]) {
    vec4 p = {place[0], place[1], place[2], 1};
    const float(*c)[4] = plan->passes[plan->pass_count - 1].constants; /* clip_from_world */
    mat4 clip_from_world;
    memcpy(clip_from_world, c, sizeof clip_from_world);
    glm_mat4_mulv(clip_from_world, p, p);
    pixel[0] = (int)((0.5f * p[0] / p[3] + 0.5f) * WIDTH);
    pixel[1] = (int)((0.5f - 0.5f * p[1] / p[3]) * HEIGHT);
    return p[3] > 0 && pixel[0] >= 0 && pixel[0] < WIDTH && pixel[1] >= 0 && pixel[1] < HEIGHT;
}

static void light_place(uint32_t light, vec3 place) {
    vec3 direction;
    gn_pose_light(&stage.pose, light, place, direction);
}

static void test_marks_stand_where_lights_do(void **state) {
    (void)state;
    vec3 place;
    int p[2];
    stage.scene->lights[2].color[0] = 0; /* the bulb: blue-green */
    draw(bare);
    opts.debug.show_lights = true;
    const struct gn_plan *plan = draw(shown);
    assert_string_equal(plan->passes[plan->pass_count - 1].label, "marks of lights");
    light_place(2, place);
    assert_true(project(plan, place, p));
    const uint8_t *c = shown[p[1]][p[0]];
    assert_true(c[0] < 5 && c[1] > 250 && c[2] > 250);
    int changed = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) changed += differs(x, y);
    assert_in_range(changed, 300, PIXELS / 10);
}

static void test_a_hidden_mark_is_pale(void **state) {
    (void)state;
    vec3 place;
    int p[2];
    stage.scene->lights[2].color[1] = stage.scene->lights[2].color[2] = 0;
    for (uint32_t i = 0; i < stage.scene->item_count; i++) /* in the middle of a box: hidden */
        if (strcmp(stage.scene->nodes[stage.scene->items[i].node].name, "A") == 0)
            stage.scene->lights[2].node = stage.scene->items[i].node;
    draw(bare);
    opts.debug.show_lights = true;
    const struct gn_plan *plan = draw(shown);
    light_place(2, place);
    assert_true(project(plan, place, p));
    const uint8_t *b = bare[p[1]][p[0]], *c = shown[p[1]][p[0]];
    assert_true(c[0] > b[0]); /* it shines through */
    assert_true(c[0] < 250 || b[0] > 200);
    assert_true(c[2] > b[2] / 2); /* and the box is still there */
}

static void test_a_range_is_a_ring(void **state) {
    (void)state;
    vec3 place, at;
    int p[2];
    stage.scene->lights[2].range_m = 1.0f;
    draw(bare);
    opts.debug.show_lights = true;
    const struct gn_plan *plan = draw(shown);
    light_place(2, place);
    glm_vec3_add(place, (vec3){0, -1.0f, 0}, at); /* its foot, on two of the circles */
    assert_true(project(plan, at, p));
    bool found = false;
    for (int y = p[1] - 2; y <= p[1] + 2; y++) found = found || (y >= 0 && differs(p[0], y));
    assert_true(found);
}

static void test_other_pictures_have_neither(void **state) {
    (void)state;
    opts.debug.show_lights = opts.debug.show_maps = true;
    opts.debug.aov = GN_AOV_NORMAL;
    const struct gn_plan *plan = gn_frame_build(stage.frame, &stage.pose, &opts, NULL);
    assert_int_equal(plan->pass_count, 1);
}

#define ON(name, open)                                                                             \
    { #name " " #open, name, open, close_all, NULL }
#define TEST(name) ON(name, open_egl), ON(name, open_osmesa)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_panels_show_the_maps),
        ON(test_panels_show_the_maps, open_egl_without_srgb),
        TEST(test_only_the_panels_change_the_picture),
        ON(test_maps_are_not_drawn_again_for_panels, open_egl),
        ON(test_cascades_are_not_drawn_again_for_panels, open_field),
        TEST(test_marks_stand_where_lights_do),
        ON(test_marks_stand_where_lights_do, open_egl_without_srgb),
        TEST(test_a_hidden_mark_is_pale),
        TEST(test_a_range_is_a_ring),
        ON(test_other_pictures_have_neither, open_egl),
    };
    return RUN(tests);
}
