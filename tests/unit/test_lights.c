/* [light "NAME"] of a configuration, and what belongs to lights, applied to a scene. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "options/args.h"
#include "stage/stage.h"
#include "unit/gltf_maker.h"
#include "unit/options_help.h"

static char path[] = "/tmp/gnomon-lights-XXXXXX";
static struct gn_scene *scene;
static struct gn_stage_look look;

/* The square, with a sun "Sun" and a spot whose node is "Lamp", and without any light. */
static void make_scene(bool with_lights) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    if (with_lights) {
        gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
        gn_maker_set(&maker, "extensions",
                     "{'KHR_lights_punctual':{'lights':[{'type':'directional'},"
                     "{'type':'spot','name':'Spot light'},{'type':'point'}]}}");
        gn_maker_set(&maker, "nodes",
                     "[{'mesh':0},{'name':'Sun','extensions':{'KHR_lights_punctual':{'light':0}}},"
                     "{'name':'Lamp','extensions':{'KHR_lights_punctual':{'light':1}}},"
                     "{'name':'Bulb','extensions':{'KHR_lights_punctual':{'light':2}}}]");
        gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    }
    scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
}

static bool build_look(const char *file, const char *flag, const char *value) {
    char *argv[] = {"gnomon", "render", "-c", path, (char *)flag, (char *)value, NULL};
    gn_options_finish(&options);
    warnings = (struct gn_warnings){0};
    err = (struct gn_err){0};
    assert_true(gn_file_write(path, file, strlen(file), &err));
    if (!gn_args_parse(&options, flag ? 6 : 4, argv, &warnings, &err)) fail_msg("%s", err.text);
    return gn_stage_look_build(&look, options.settings, scene, &warnings, &err);
}

static const struct gn_frame_light_opts *of_light(uint32_t light) {
    for (uint32_t i = 0; i < look.frame_opts.shadow.light_count; i++)
        if (look.frame_opts.shadow.lights[i].light == light)
            return &look.frame_opts.shadow.lights[i];
    return NULL;
}

static void a_light_is_found_by_its_node_or_its_own_name(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("[light \"Lamp\"]\nshadow = pcss\n", NULL, NULL));
    assert_int_equal(look.frame_opts.shadow.light_count, 1);
    assert_int_equal(of_light(1)->given, GN_LIGHT_TECHNIQUE);
    assert_int_equal(of_light(1)->technique, GN_TECHNIQUE_PCSS);
    assert_true(build_look("[light \"Lamp\"]\nshadow = pcss\n[light \"Spot light\"]\nmap = 64\n"
                           "cascades = 2\ncast_faces = middle\nslide_aspect = "
                           "picture\nshadow_specular = 0.25\nbias = 2.5\nfilter_radius = 5\ntaps = "
                           "44\nslide_far = 3\nmap_format = "
                           "rgba16ui\nshadow_strength = 0.5\nlight_radius = 0.25\n",
                           NULL, NULL));
    assert_int_equal(look.frame_opts.shadow.light_count, 1);
    assert_int_equal(of_light(1)->map_px, 64);
    assert_int_equal(of_light(1)->cascades, 2);
    assert_int_equal(of_light(1)->slide_as_picture, 1);
    assert_true(of_light(1)->specular == 0.25f);
    assert_true(of_light(1)->bias_texels == 2.5f);
    assert_true(of_light(1)->filter_radius_px == 5.0f);
    assert_int_equal(of_light(1)->taps, 44);
    assert_true(of_light(1)->slide_far_m == 3.0f);
    assert_int_equal(of_light(1)->faces, 1 + GN_CAST_MIDDLE);
    assert_int_equal(of_light(1)->encoding, GN_ENCODING_AUTO);
    assert_int_equal(of_light(1)->moments, GN_MOMENTS_RGBA16UI);
    assert_true(of_light(1)->strength == 0.5f);
    assert_true(of_light(1)->radius == 0.25f);
    assert_int_equal(warnings.count, 0);
}

static void automatic_of_one_beats_what_holds_for_all(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("[render]\nbias = 0\nfilter_radius = 2\n[light \"Sun\"]\nbias = auto\n"
                           "filter_radius = auto\n",
                           NULL, NULL));
    assert_true(look.frame_opts.shadow.bias_given && look.frame_opts.shadow.bias_texels == 0.0f);
    assert_int_equal(of_light(0)->given, GN_LIGHT_BIAS | GN_LIGHT_FILTER);
    assert_true(of_light(0)->bias_texels < 0);
    assert_true(look.frame_opts.shadow.filter_radius_px == 2.0f);
    assert_true(of_light(0)->filter_radius_px == 0.0f);
    assert_true(build_look("", NULL, NULL));
    assert_false(look.frame_opts.shadow.bias_given);
    assert_true(look.frame_opts.shadow.filter_radius_px == 0.0f);
}

static void a_flag_beats_it(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("[light \"Sun\"]\nshadow = none\nmap = 64\n", "--shadow", "hard"));
    assert_int_equal(of_light(0)->given, GN_LIGHT_TECHNIQUE | GN_LIGHT_MAP_PX);
    assert_int_equal(of_light(0)->technique, GN_TECHNIQUE_NONE); /* always holds */
    assert_true(build_look("[light \"Sun\"]\nshadow = pcf\nmap = 64\n", "--shadow", "hard"));
    assert_int_equal(of_light(0)->given, GN_LIGHT_MAP_PX);
}

static void a_name_that_no_light_has_is_one_warning(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("[light \"Lantern\"]\nshadow = pcss\n", NULL, NULL));
    assert_int_equal(look.frame_opts.shadow.light_count, 0);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], ":1: light \"Lantern\": "));
    assert_non_null(strstr(warnings.text[0], "it has \"Sun\", \"Spot light\", \"Bulb\""));
    assert_true(build_look("[scene]\nfile = a.glb\nfile = b.glb\n[light \"Lantern\"]\nmap = 64\n",
                           NULL, NULL));
    assert_int_equal(warnings.count, 0); /* the other scene may have one */
}

static void the_radius_of_all_is_that_of_the_made_light(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("[light \"Sun\"]\nlight_radius = 0.1\n", "--light-radius", "0.2"));
    assert_int_equal(look.frame_opts.shadow.light_count, 1);
    assert_true(of_light(0)->radius == 0.1f);
    gn_scene_destroy(scene);
    make_scene(false);
    assert_true(build_look("", NULL, NULL));
    assert_int_equal(look.frame_opts.shadow.light_count, 0);
    assert_true(build_look("[light \"key light\"]\nlight_radius = 0.1\n", NULL, NULL));
    assert_true(of_light(0)->radius == 0.1f);
    assert_true(build_look("[light \"key light\"]\nlight_radius = 0.1\n", "--light-radius", "0.2"));
    assert_true(of_light(0)->radius == 0.2f);
}

static void a_camera_may_be_a_spot_or_a_directional_light(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("", "--camera", "light:Lamp"));
    assert_int_equal(look.frame_opts.view.light_plus_1, 2);
    assert_true(build_look("", "--camera", "light:0"));
    assert_int_equal(look.frame_opts.view.light_plus_1, 1);
    assert_false(build_look("", "--camera", "light:Bulb"));
    assert_string_equal(err.text, "--camera: light 'Bulb' shines in all directions: only a spot or "
                                  "a directional light can be looked from");
    assert_false(build_look("", "--camera", "light:Lantern"));
    assert_non_null(strstr(err.text, "no light named 'Lantern'; available: 0 'Sun', 1 'Spot"));
    assert_false(build_look("", "--camera", "lamp"));
    assert_non_null(strstr(err.text, "no camera named 'lamp'"));
    assert_int_equal(look.frame_opts.view.light_plus_1, 0);
}

static int make_path(void **state) {
    const int fd = mkstemp(path);
    (void)state;
    return fd >= 0 ? close(fd) : -1;
}

static int remove_path(void **state) {
    (void)state;
    return unlink(path);
}

static int finish(void **state) {
    gn_scene_destroy(scene);
    scene = NULL;
    return clean(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_light_is_found_by_its_node_or_its_own_name, finish),
        cmocka_unit_test_teardown(automatic_of_one_beats_what_holds_for_all, finish),
        cmocka_unit_test_teardown(a_flag_beats_it, finish),
        cmocka_unit_test_teardown(a_name_that_no_light_has_is_one_warning, finish),
        cmocka_unit_test_teardown(the_radius_of_all_is_that_of_the_made_light, finish),
        cmocka_unit_test_teardown(a_camera_may_be_a_spot_or_a_directional_light, finish),
    };
    return cmocka_run_group_tests_name("lights", tests, make_path, remove_path);
}
