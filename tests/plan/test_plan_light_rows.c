/* Each row of the table of options that has a target in struct gn_light_opts, from the text of a
 * configuration to the plan: set for one light it changes what the plan has of that light, set for
 * all it changes all lights that it is of. A new row needs a value here. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "blocks.glsl"
#include "core/file.h"
#include "core/hash.h"
#include "options/args.h"
#include "plan/fixture.h"
#include "stage/stage.h"
#include "unit/options_help.h"

enum { SUN, OTHER_SUN, SPOT, OTHER_SPOT, LIGHTS };
enum { SUNS = 1 << SUN | 1 << OTHER_SUN, SPOTS = 1 << SPOT | 1 << OTHER_SPOT, ALL = SUNS | SPOTS };
static const char *const names[LIGHTS] = {"Sun A", "Sun B", "Spot A", "Spot B"};
static char path[] = "/tmp/gnomon-light-rows-XXXXXX";

/* A value that is not the default, and the lights that have such a setting. In the scene all have
 * technique disk, a share of highlights and a far plane of slides of their own. */
static const struct {
    const char *row, *value;
    unsigned lights;
    const char *technique; /* in place of disk */
} values[] = {
    {"shadow", "hard", ALL, NULL},
    {"map", "256", ALL, NULL},
    {"map-format", "rgba8", ALL, NULL},
    {"cascades", "3", SUNS, NULL},
    {"cast-faces", "back", ALL, NULL},
    {"taps", "24", ALL, NULL},
    {"shadow-strength", "0.5", ALL, NULL},
    {"shadow-specular", "0.25", ALL, NULL},
    {"bias", "5", ALL, NULL},
    {"filter-radius", "5", ALL, NULL},
    {"slide-aspect", "picture", SPOTS, NULL},
    {"slide-far", "4", SPOTS, NULL},
    {"light-color", "#ff8000", ALL, NULL},
    {"light-radius", "0.25", ALL, "pcss"},
    {"light-lux", "7", ALL, NULL},
    {"light-intensity", "7", ALL, NULL},
    {"light-on", "no", ALL, NULL},
};
enum { VALUES = sizeof values / sizeof *values };

/* The stage with two suns and two spots that have a slide; or with a sun alone, made for it. */
static void begin(struct gn_plan_fixture *f, struct gn_light lights[LIGHTS], bool made,
                  const char *technique) {
    static struct gn_image image = {.width_px = 300, .height_px = 200};
    static struct gn_texture texture;
    gn_plan_begin(f, GN_EVERY_CAP);
    for (int i = 0; i < LIGHTS; i++) {
        lights[i] = f->scene->lights[i / 2];
        lights[i].name = names[i];
        lights[i].technique = technique;
        lights[i].shadow_specular = 0.75f;
        lights[i].slide_far_m = 6.0f;
        if (1 << i & SPOTS) lights[i].slide = 0;
    }
    f->scene->lights = lights;
    f->pose.lights = lights;
    f->scene->light_count = made ? 1 : LIGHTS;
    f->scene->added.light = made;
    f->scene->pictures.images = &image;
    f->scene->pictures.textures = &texture;
    f->scene->pictures.image_count = f->scene->pictures.texture_count = 1;
}

static uint64_t hash_rows(uint64_t hash, const float (*rows)[4], uint32_t count) {
    return gn_hash(hash, rows, count * sizeof *rows);
}

/* What the plan has of a light: its shadow, and what the programs of the picture know of it. */
static uint64_t hash_light(const struct gn_plan *plan, uint32_t light) {
    const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
    const float(*c)[4] = last->constants;
    uint32_t at = 0, slide = 0;
    assert_int_equal(last->kind, GN_PASS_PICTURE);
    for (; at < plan->light_count && plan->lights[at] != light; at++)
        slide += plan->scene->lights[plan->lights[at]].slide >= 0;
    if (at == plan->light_count) return 0;
    uint64_t hash = hash_rows(GN_HASH_INIT, c + PASS_LIGHTS + at * LIGHT_SIZE, LIGHT_SIZE);
    if (plan->scene->lights[light].slide >= 0)
        hash = hash_rows(hash, c + PASS_SLIDES + slide * SLIDE_SIZE, SLIDE_SIZE);
    for (uint32_t i = 0; i < plan->program_count; i++)
        if (plan->programs[i].kind == GN_PROGRAM_LIT)
            hash = gn_hash(hash, &plan->programs[i].lights[at], sizeof plan->programs[i].lights[0]);
    if (at >= plan->shadow_count) return hash;
    const struct gn_shadow_map *map = &plan->shadows[at].map;
    const uint32_t view[] = {map->tile_px, map->cascade_count, plan->shadows[at].encoding,
                             plan->shadows[at].faces_given, plan->shadows[at].faces};
    assert_int_equal(plan->shadows[at].light, light);
    hash = gn_hash(hash, view, sizeof view);
    if (map->cascade_count > 0)
        hash = hash_rows(hash, c + PASS_CASCADES + at * CASCADES_SIZE, CASCADES_SIZE);
    return hash_rows(hash, c + PASS_SHADOWS + at * SHADOW_SIZE, SHADOW_SIZE);
}

/* Of each light, in a plan of the scene with that configuration. */
static void hash_lights(bool made, const char *technique, const char *setting,
                        uint64_t hashes[LIGHTS]) {
    char text[256];
    char *argv[] = {"gnomon", "render", "-c", path};
    struct gn_plan_fixture f;
    struct gn_light lights[LIGHTS];
    struct gn_stage_look look;
    snprintf(text, sizeof text, "[render]\nenvironment = none\n%s", setting);
    begin(&f, lights, made, technique);
    assert_true(gn_file_write(path, text, strlen(text), &err));
    if (!gn_args_parse(&options, 4, argv, &warnings, &err) ||
        !gn_stage_look_build(&look, options.settings, f.scene, &warnings, &err))
        fail_msg("%s: %s", setting, err.text);
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &look.frame_opts, &warnings);
    for (uint32_t i = 0; i < f.scene->light_count; i++) hashes[i] = hash_light(plan, i);
    if (warnings.count > 0) fail_msg("%s: %s", setting, warnings.text[0]);
    gn_plan_end(&f);
    gn_options_finish(&options);
}

/* A setting must change those lights (a bit each) and no other one. */
static void expect_change(bool made, const char *technique, const char *setting, unsigned lights) {
    uint64_t before[LIGHTS], after[LIGHTS];
    hash_lights(made, technique, "", before);
    hash_lights(made, technique, setting, after);
    for (int i = 0; i < (made ? 1 : LIGHTS); i++)
        if ((before[i] != after[i]) != (lights >> i & 1))
            fail_msg("%s: the plan has %s of %s", setting,
                     lights >> i & 1 ? "nothing new" : "something else", names[i]);
}

static void each_row_of_a_light_changes_what_the_plan_has_of_it(void **state) {
    (void)state;
    int found = 0;
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        char key[64], setting[128];
        int v = 0;
        if (!row->target && !row->of_light) continue;
        while (v < VALUES && strcmp(values[v].row, row->name) != 0) v++;
        if (v == VALUES) fail_msg("--%s is of lights and has no value here", row->name);
        const char *technique = values[v].technique ? values[v].technique : "disk";
        const bool of_made = row->section && strcmp(row->section, "light") == 0;
        gn_option_key(row, key, sizeof key);
        found++;
        for (int l = 0; l < LIGHTS && row->of_light; l++) {
            snprintf(setting, sizeof setting, "[light \"%s\"]\n%s = %s\n", names[l], key,
                     values[v].value);
            expect_change(false, technique, setting, values[v].lights & 1u << l);
            if (l == SUN) expect_change(true, technique, setting, values[v].lights & 1u << l);
        }
        if (!row->section) continue;
        /* [render] is of all lights, [light] of the made light alone */
        snprintf(setting, sizeof setting, "%s%s = %s\n", of_made ? "[light]\n" : "", key,
                 values[v].value);
        expect_change(false, technique, setting, of_made ? 0 : values[v].lights);
        expect_change(true, technique, setting, values[v].lights & 1 << SUN);
    }
    assert_int_equal(found, VALUES);
}

static int make_path(void **state) {
    const int file = mkstemp(path);
    return file < 0 || close(file) != 0 || without_home(state);
}

static int remove_path(void **state) {
    (void)state;
    return unlink(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(each_row_of_a_light_changes_what_the_plan_has_of_it, clean),
    };
    return cmocka_run_group_tests_name("plan light rows", tests, make_path, remove_path);
}
