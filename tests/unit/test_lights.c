/* [light "NAME"] of a configuration, what belongs to lights, and the camera, applied to a scene. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "options/args.h"
#include "stage/lights.h"
#include "stage/stage.h"
#include "unit/gltf_maker.h"
#include "unit/light_help.h"
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
    char *argv[] = {"gnomon", "render",     "--environment", "none", "-c",
                    path,     (char *)flag, (char *)value,   NULL};
    gn_options_finish(&options);
    warnings = (struct gn_warnings){0};
    err = (struct gn_err){0};
    assert_true(gn_file_write(path, file, strlen(file), &err));
    if (!gn_args_parse(&options, flag ? 8 : 6, argv, &warnings, &err)) fail_msg("%s", err.text);
    return gn_stage_look_build(&look, options.settings, scene, &warnings, &err);
}

static const struct gn_light_opts *of_light(uint32_t light) {
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
    assert_int_equal(of_light(1)->given, GN_LIGHT_GIVEN(technique));
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
    assert_int_equal(of_light(1)->map_format, GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA16UI));
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
    const struct gn_light_opts *any = &look.frame_opts.shadow.any;
    assert_int_equal(any->given, GN_LIGHT_GIVEN(bias_texels) | GN_LIGHT_GIVEN(filter_radius_px));
    assert_true(any->bias_texels == 0.0f);
    assert_int_equal(of_light(0)->given,
                     GN_LIGHT_GIVEN(bias_texels) | GN_LIGHT_GIVEN(filter_radius_px));
    assert_true(of_light(0)->bias_texels < 0);
    assert_true(any->filter_radius_px == 2.0f);
    assert_true(of_light(0)->filter_radius_px < 0);
    assert_true(build_look("", NULL, NULL));
    assert_int_equal(any->given, 0);
}

static void a_flag_beats_it(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("[light \"Sun\"]\nshadow = none\nmap = 64\n", "--shadow", "hard"));
    assert_int_equal(of_light(0)->given, GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px));
    assert_int_equal(of_light(0)->technique, GN_TECHNIQUE_NONE); /* always holds */
    assert_true(build_look("[light \"Sun\"]\nshadow = pcf\nmap = 64\n", "--shadow", "hard"));
    assert_int_equal(of_light(0)->given, GN_LIGHT_GIVEN(map_px));
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

    /* by itself it is that of the environment's key */
    static const char *const automatic[] = {"", "[light]\nradius = auto\n",
                                            "[light \"key light\"]\nlight_radius = auto\n"};
    for (int i = 0; i < 3; i++) {
        const struct gn_environment_key key = {.color = {1, 1, 1}, .radius = .24f};
        struct gn_frame_shadow_opts *opts = &look.frame_opts.shadow;
        assert_true(build_look(automatic[i], NULL, NULL));
        *opts = (struct gn_frame_shadow_opts){0};
        gn_stage_set_key(opts, scene, &key, 1);
        gn_stage_set_lights(opts, options.settings, scene, &warnings);
        assert_true(of_light(0)->radius == .24f && GN_LIGHT_HAS(of_light(0), radius));
    }
}

static void assert_color(uint32_t light, float r, float g, float b) {
    const float expected[] = {r, g, b};
    const struct gn_light_opts holds = gn_light_held(scene, &look.frame_opts, light);
    for (int k = 0; k < 3; k++)
        if (!(fabsf(holds.color[k] - expected[k]) < 1e-4f))
            fail_msg("%g is not %g", (double)holds.color[k], (double)expected[k]);
}

static void a_light_has_a_colour_an_intensity_and_a_switch(void **state) {
    (void)state;
    make_scene(true);
    assert_true(build_look("[light \"Sun\"]\nintensity = 5\ncolor = #ff8000\n"
                           "[light \"Lamp\"]\non = no\n[light \"Bulb\"]\non = yes\n",
                           NULL, NULL));
    const float green = powf((128 / 255.0f + .055f) / 1.055f, 2.4f);
    assert_color(0, 5, 5 * green, 0);
    assert_int_equal(of_light(1)->given, GN_LIGHT_GIVEN(on));
    assert_false(of_light(1)->on);
    assert_int_equal(of_light(2)->given, GN_LIGHT_GIVEN(on));
    assert_true(of_light(2)->on);
    /* the order does not count, nor how bright the colour is; 1 is the file's intensity */
    assert_true(build_look("[light \"Sun\"]\ncolor = #404040\nintensity = 5\n"
                           "[light \"Lamp\"]\ncolor = #0000ff\n[light \"Bulb\"]\n"
                           "color = #ff0000\nintensity = 0\n",
                           NULL, NULL));
    assert_color(0, 5, 5, 5);
    assert_color(1, 0, 0, 1);
    assert_color(2, 0, 0, 0);
}

static void the_made_light_is_as_its_section_says(void **state) {
    (void)state;
    make_scene(false);
    assert_true(build_look("[light]\nlux = 5.6\nradius = 0.1\n", NULL, NULL));
    assert_color(0, 5.6f, 5.6f * .95f, 5.6f * .87f);
    assert_true(of_light(0)->radius == .1f);
    assert_true(build_look("[render]\nlight_lux = 5\n", "--light-color", "#ffffff"));
    assert_color(0, 5, 5, 5);
    assert_true(build_look("[light]\nlux = 5\n[light \"key light\"]\nintensity = 7\n"
                           "color = #ffffff\n",
                           NULL, NULL));
    assert_color(0, 7, 7, 7); /* that of the name beats the other; a flag beats both */
    assert_true(build_look("[light \"key light\"]\nintensity = 7\n", "--light-lux", "1"));
    assert_color(0, 1, .95f, .87f);
    gn_scene_destroy(scene);
    make_scene(true); /* which has lights: nothing of it is theirs */
    assert_true(build_look("[light]\nlux = 5\ncolor = #ff0000\nazimuth = 90\n", NULL, NULL));
    assert_int_equal(look.frame_opts.shadow.light_count, 0);
}

/* x, y, z: where it comes from. */
static void assert_from(const struct gn_frame_view_opts *view, float x, float y, float z) {
    const float expected[] = {x, y, z};
    struct gn_pose pose;
    vec3 place, along, up = {0, 1, 0}, seen;
    mat4 light_from_world;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    const struct gn_frame_opts frame_opts = {.view = *view};
    gn_stage_aim(&pose, &frame_opts, options.settings);
    gn_pose_choose(&pose, GN_POSE_NONE); /* which keeps it */
    gn_pose_light(&pose, scene->light_count - 1, place, along);
    for (int k = 0; k < 3; k++)
        if (!(fabsf(along[k] + expected[k]) < 1e-4f))
            fail_msg("%d: %g is not %g", k, (double)-along[k], (double)expected[k]);
    gn_pose_light_view(&pose, scene->light_count - 1, light_from_world);
    glm_mat4_mulv3(light_from_world, up, 0, seen);
    assert_true(fabsf(seen[0]) < 1e-4f && seen[1] > -1e-4f); /* not rolled */
    gn_pose_finish(&pose);
}

static void the_made_light_comes_from_where_it_is_set(void **state) {
    (void)state;
    struct gn_frame_view_opts view = {0};
    const float s = sqrtf(.5f), l = sqrtf(.04f + 1 + .36f);
    make_scene(false);
    assert_true(build_look("", NULL, NULL));
    assert_from(&view, .2f / l, 1 / l, .6f / l);
    assert_true(build_look("[light]\nazimuth = 0\n", "--light-elevation", "0"));
    assert_from(&view, 0, 0, 1); /* the front of glTF */
    assert_true(build_look("[light]\nazimuth = 90\n", "--light-elevation", "0"));
    assert_from(&view, 1, 0, 0);
    assert_true(build_look("[light]\nazimuth = -90\n", "--light-elevation", "45"));
    assert_from(&view, -s, s, 0);
    assert_true(build_look("[light]\nazimuth = 20\n", "--light-elevation", "90"));
    assert_from(&view, 0, 1, 0);
    assert_true(build_look("[light]\nazimuth = 0\n", NULL, NULL)); /* keeps its height */
    assert_from(&view, 0, 1 / l, hypotf(.2f, .6f) / l);
    view.turntable_rad = 1;
    assert_from(&view, 0, 1 / l, hypotf(.2f, .6f) / l); /* stands in the world */
    /* with the camera: at first as it stands in the world, then on the same side of the picture */
    view.turntable_rad = 0;
    assert_true(build_look("", "--light-follow", "camera"));
    assert_from(&view, .2f / l, 1 / l, .6f / l);
    view.turntable_rad = GLM_PI_2f;
    assert_from(&view, .6f / l, 1 / l, -.2f / l);
    view.orbit.yaw_rad = -GLM_PI_2f;
    assert_from(&view, .2f / l, 1 / l, .6f / l);
    assert_true(build_look("[light]\nazimuth = 0\nelevation = 0\n", "--light-follow", "camera"));
    const float c = hypotf(.55f, 1);
    assert_from(&view, .55f / c, 0, 1 / c); /* from the camera */
    view.turntable_rad = 0;
    assert_from(&view, -1 / c, 0, .55f / c);
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

static void the_camera_is_placed_as_its_section_says(void **state) {
    (void)state;
    make_scene(false);
    assert_true(build_look("", NULL, NULL));
    assert_int_equal(look.frame_opts.view.framing.given, 0);
    assert_true(build_look("[camera]\ntheta = 90\ntarget = 1,-2.5,3e1\n[render]\n"
                           "camera_phi_max = 90\n",
                           "--camera-fov", "60"));
    const struct gn_framing_opts *f = &look.frame_opts.view.framing;
    assert_int_equal(f->given, GN_FRAMING_THETA | GN_FRAMING_TARGET | GN_FRAMING_FOV);
    assert_true(fabsf(f->theta_rad - GLM_PI_2f) < 1e-6f &&
                fabsf(f->yfov_rad - GLM_PIf / 3) < 1e-6f);
    assert_true(f->target_ws[0] == 1 && f->target_ws[1] == -2.5f && f->target_ws[2] == 30);
    assert_true(fabsf(f->phi_max_rad - GLM_PI_2f) < 1e-6f && f->distance_max_m == 0);
    assert_true(
        build_look("[camera]\ntheta = 90\n[mode \"a\"]\ncamera_theta = auto\n", "--mode", "a"));
    assert_int_equal(look.frame_opts.view.framing.given, 0);
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

static void an_automatic_camera_is_the_first_if_it_sees_the_model(void **state) {
    (void)state;
    for (int away = 0; away < 2; away++) {
        struct gn_maker maker;
        gn_maker_init(&maker);
        gn_maker_square(&maker);
        gn_maker_set(&maker, "cameras",
                     "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}]");
        gn_maker_set(&maker, "nodes",
                     away ? "[{'mesh':0},{'camera':0,'translation':[0,1,-9]}]"
                          : "[{'mesh':0},{'camera':0,'translation':[0,1,9]}]");
        gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
        scene = gn_maker_load(&maker, NULL, &err);
        if (!scene) fail_msg("%s", err.text);
        assert_true(build_look("[scene]\ncamera = auto\n", NULL, NULL));
        assert_int_equal(look.frame_opts.view.camera, 0);
        assert_int_equal(look.frame_opts.view.framing.made_plus_1, away);
        assert_true(build_look("", NULL, NULL)); /* by itself it is that of the file */
        assert_int_equal(look.frame_opts.view.framing.made_plus_1, 0);
        if (away == 0) gn_scene_destroy(scene);
    }
    gn_scene_destroy(scene);
    make_scene(false); /* the made one is such a camera anyway */
    assert_true(build_look("", "--camera", "auto"));
    assert_int_equal(look.frame_opts.view.framing.made_plus_1, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_light_is_found_by_its_node_or_its_own_name, finish),
        cmocka_unit_test_teardown(automatic_of_one_beats_what_holds_for_all, finish),
        cmocka_unit_test_teardown(a_flag_beats_it, finish),
        cmocka_unit_test_teardown(a_name_that_no_light_has_is_one_warning, finish),
        cmocka_unit_test_teardown(an_automatic_camera_is_the_first_if_it_sees_the_model, finish),
        cmocka_unit_test_teardown(the_radius_of_all_is_that_of_the_made_light, finish),
        cmocka_unit_test_teardown(a_light_has_a_colour_an_intensity_and_a_switch, finish),
        cmocka_unit_test_teardown(the_made_light_is_as_its_section_says, finish),
        cmocka_unit_test_teardown(the_made_light_comes_from_where_it_is_set, finish),
        cmocka_unit_test_teardown(the_camera_is_placed_as_its_section_says, finish),
        cmocka_unit_test_teardown(a_camera_may_be_a_spot_or_a_directional_light, finish),
    };
    return cmocka_run_group_tests_name("lights", tests, make_path, remove_path);
}
