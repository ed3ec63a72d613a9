/* Without modes in kiosk.ini the buttons of a running kiosk go through what the scene offers: each
 * press is another picture with its caption, also after a reload and in another scene. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

enum { SIDE = 64, PIXELS = SIDE * SIDE };
static const int64_t PATIENCE_NS = 60 * GN_NS_PER_S;

/* A red triangle, or by variant a blue one, seen by each camera at another place. */
static const char head[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,"
    "\"extensionsUsed\":[\"KHR_materials_unlit\",\"KHR_materials_variants\"],"
    "\"materials\":[{\"doubleSided\":true,\"extensions\":{\"KHR_materials_unlit\":{}},"
    "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0,1]}},"
    "{\"doubleSided\":true,\"extensions\":{\"KHR_materials_unlit\":{}},"
    "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,1,1]}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0%s}]}],"
    "\"buffers\":[{\"byteLength\":68,\"uri\":\"data:;base64,"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA"  /* (0, 0, 0), (0, 0, 1), (1, 0, 0) */
    "AAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAA=\"}]," /* 0 s, 1 s; two translations */
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,"
    "\"byteLength\":8},{\"buffer\":0,\"byteOffset\":44,\"byteLength\":24}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,0,1]},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\",\"min\":[0],"
    "\"max\":[1]},{\"bufferView\":2,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}]%s}";
static const char cameras[] =
    ",\"cameras\":[{\"type\":\"perspective\",\"name\":\"Near\",\"perspective\":{\"yfov\":1,"
    "\"znear\":0.1}},{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}}],"
    "\"scenes\":[{\"nodes\":[0,1,2]}],\"nodes\":[{\"mesh\":0,\"rotation\":[0.7071068,0,0,0.7071068]"
    "},"
    "{\"camera\":0,\"translation\":[0,0,3]},{\"camera\":1,\"translation\":[0.5,0,6]}]";
static const char mappings[] =
    ",\"extensions\":{\"KHR_materials_variants\":{\"mappings\":[{\"material\":0,\"variants\":[0]},"
    "{\"material\":1,\"variants\":[1]}]}}";
static const char variants[] =
    ",\"extensions\":{\"KHR_materials_variants\":{\"variants\":[{\"name\":\"red\"},{\"name\":"
    "\"blue\"}]}}";
static const char one_node[] =
    ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"rotation\":[0.7071068,0,0,0.7071068]}]";
static const char clip[] =
    ",\"animations\":[{\"name\":\"Rise\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,"
    "\"path\":\"translation\"}}],\"samplers\":[{\"input\":1,\"output\":2}]}]";

static char folder[64];

static const char *write_scene(const char *name, const char *primitive, const char *a,
                               const char *b, const char *c) {
    static char paths[4][200];
    static unsigned turn;
    char text[6000], rest[3000], *path = paths[turn++ % 4];
    snprintf(rest, sizeof rest, "%s%s%s", a, b, c);
    snprintf(text, sizeof text, head, primitive, rest);
    help_write(folder, name, text);
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

#define OPEN(...) help_show((const char *const[]){"--size", "64x64", __VA_ARGS__, NULL})

static void until_shown(struct gn_show *show) {
    const uint64_t before = show->counts.frames;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    show->screen.changed = true;
    while (gn_kiosk_waits(&show->screen.kiosk) || show->wants_reload || show->reload.options ||
           show->counts.frames == before || show->screen.changed) {
        help_show_step(show);
        if (gn_clock_monotonic_ns() - begun_ns > PATIENCE_NS) fail_msg("nothing is shown");
    }
}

static void press(struct gn_show *show, enum gn_action_kind kind) {
    gn_show_act(&show->screen, &(struct gn_action){.kind = kind, .pressed = true},
                gn_clock_monotonic_ns());
    until_shown(show);
}

static const char *mode_of(const struct gn_show *show) {
    return show->modes.names[show->screen.drawn.mode];
}

/* Without captions: they are for what is read. */
static void read_picture(struct gn_show *show, uint8_t out[4 * PIXELS]) {
    struct gn_err err = {0};
    show->screen.kiosk.caption = GN_KIOSK_CAPTION_NONE;
    gn_captions_set(show->screen.text.captions, GN_CAPTION_MODE, NULL, 0); /* it need not fall */
    until_shown(show);
    if (!gn_gl_read_rgba8(show->screen.stage.gl, out, &err)) fail_msg("%s", err.text);
}

/* Red and blue of all pixels, whatever is behind. */
static void count_colors(struct gn_show *show, unsigned *red, unsigned *blue) {
    static uint8_t p[4 * PIXELS];
    read_picture(show, p);
    *red = *blue = 0;
    for (int i = 0; i < 4 * PIXELS; i += 4) {
        *red += p[i] > 200 && p[i + 2] < 60;
        *blue += p[i + 2] > 200 && p[i] < 60;
    }
}

static void cameras_are_gone_through(void **state) {
    (void)state;
    struct gn_show *show = OPEN(write_scene("c.gltf", "", cameras, "", ""));
    unsigned near, far, none;
    count_colors(show, &near, &none);
    assert_string_equal(mode_of(show), "Near");
    press(show, GN_ACTION_NEXT);
    assert_string_equal(mode_of(show), "Camera 2");
    assert_string_equal(show->screen.text.change, "Camera 2");
    count_colors(show, &far, &none);
    if (!(near > 2 * far && far > 0)) fail_msg("%u and %u pixels", near, far);
    press(show, GN_ACTION_NEXT);
    assert_string_equal(mode_of(show), "Near");
    press(show, GN_ACTION_PREV);
    show->wants_reload = true; /* it stays where it is */
    until_shown(show);
    assert_string_equal(mode_of(show), "Camera 2");
    count_colors(show, &none, &near);
    assert_int_equal(none, far);
    assert_int_equal(show->modes.count, 2);
    gn_show_close(show);
}

static void variants_are_gone_through(void **state) {
    (void)state;
    struct gn_show *show = OPEN(write_scene("v.gltf", mappings, variants, one_node, ""));
    unsigned red, blue;
    count_colors(show, &red, &blue);
    assert_true(red > 0 && blue == 0);
    press(show, GN_ACTION_NEXT);
    assert_string_equal(show->screen.text.change, "blue");
    count_colors(show, &red, &blue);
    assert_true(red == 0 && blue > 0);
    gn_show_close(show);
}

/* And another scene has cameras of its own. */
static void scenes_follow_the_last_camera(void **state) {
    (void)state;
    static const char *const names[] = {"one", "Near", "Camera 2", "one"};
    const char *one = write_scene("one.gltf", "", one_node, "", ""),
               *two = write_scene("two.gltf", "", cameras, "", "");
    char config[500];
    snprintf(config, sizeof config, "[scene]\nfile = %s\nfile = %s\n", one, two);
    struct gn_show *show = help_show_of(config, (const char *const[]){NULL});
    until_shown(show);
    for (int i = 0; i < 4; i++, press(show, GN_ACTION_NEXT))
        if (strcmp(mode_of(show), names[i]) != 0) fail_msg("%d: %s", i, mode_of(show));
    press(show, GN_ACTION_PREV); /* from the other scene's first camera */
    assert_string_equal(mode_of(show), "one");
    press(show, GN_ACTION_PREV);
    assert_string_equal(mode_of(show), "Near");
    press(show, GN_ACTION_NEXT_SCENE);
    assert_string_equal(mode_of(show), "one");
    gn_show_close(show);
}

static void a_press_plays_the_clip(void **state) {
    (void)state;
    struct gn_show *show =
        OPEN("--animation-loop", "once", write_scene("a.gltf", "", one_node, clip, ""));
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (show->screen.kiosk.scene_ns < 2 * GN_NS_PER_S) { /* it is over */
        help_show_step(show);
        show->screen.changed = true;
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_int_equal(show->screen.drawn.clips_begun_ns, 0);
    press(show, GN_ACTION_NEXT);
    assert_string_equal(show->screen.text.change, "Rise");
    assert_true(show->screen.drawn.clips_begun_ns >= 2 * GN_NS_PER_S);
    gn_show_close(show);
}

static void a_scene_with_nothing_turns_and_stands(void **state) {
    (void)state;
    static uint8_t before[4 * PIXELS], after[4 * PIXELS];
    struct gn_show *show = OPEN(write_scene("n.gltf", "", one_node, "", ""));
    read_picture(show, before);
    show->screen.kiosk.scene_ns = 3630 * GN_NS_PER_S; /* half a turn and more */
    press(show, GN_ACTION_NEXT);
    assert_string_equal(show->screen.text.change, "Turning");
    assert_true(show->screen.stage.settings->scene.turntable_deg_s == GN_OFFER_TURNTABLE_DEG_S);
    const float angle = show->screen.stage.shown.opts.view.turntable_rad;
    if (!(angle < .5f)) fail_msg("it begins at %g", (double)angle);
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (show->screen.stage.shown.opts.view.turntable_rad < .05f) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    press(show, GN_ACTION_NEXT);
    read_picture(show, after);
    assert_memory_equal(before, after, sizeof before);
    gn_show_close(show);
}

/* The sundial, and whoever names a technique. */
static void techniques_stay_where_they_are_named(void **state) {
    (void)state;
    const char *path = write_scene("c.gltf", "", cameras, "", "");
    struct gn_show *show = OPEN("--size", "64x64");
    assert_false(show->modes.offered);
    assert_true(gn_show_find_mode(&show->modes, "vsm") >= 0);
    gn_show_close(show);
    show = OPEN("--mode", "vsm", path);
    assert_string_equal(show->modes.names[show->modes.first], "vsm");
    gn_show_close(show);
    show = help_show_of("[button \"b\"]\nkeys = a\npress = mode vsm\n",
                        (const char *const[]){path, NULL});
    assert_true(gn_show_find_mode(&show->modes, "vsm") >= 0);
    gn_show_close(show);
    show = help_show_of("[mode \"Mine\"]\nshadow = vsm\n", (const char *const[]){path, NULL});
    assert_int_equal(show->modes.count, 1);
    assert_string_equal(show->modes.names[0], "Mine");
    gn_show_close(show);
}

static int setup(void **state) {
    (void)state;
    snprintf(folder, sizeof folder, "%s", help_folder());
    return 0;
}

static int teardown(void **state) {
    (void)state;
    help_remove(folder);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_are_gone_through),
        cmocka_unit_test(variants_are_gone_through),
        cmocka_unit_test(scenes_follow_the_last_camera),
        cmocka_unit_test(a_press_plays_the_clip),
        cmocka_unit_test(a_scene_with_nothing_turns_and_stands),
        cmocka_unit_test(techniques_stay_where_they_are_named),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
