/* [sun]: which light becomes the sun, where it stands, and what it shines with. */
#include <math.h>
#include <string.h>
#include <time.h>

#include "core/sun.h"
#include "options/args.h"
#include "stage/stage.h"
#include "stage/sun.h"
#include "unit/gltf_maker.h"
#include "unit/options_help.h"

static struct gn_scene *scene;
static struct gn_stage_look look;
static struct gn_pose pose;

#define NODE "{'extensions':{'KHR_lights_punctual':{'light':%d}}}"

/* The square, and lights as the file has them (NULL: none), a node of each. */
static void make_scene(const char *lights, int count, const char *extras) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "meshes", "[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}]");
    if (lights) {
        char text[400];
        gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
        snprintf(text, sizeof text, "{'KHR_lights_punctual':{'lights':[%s]}}", lights);
        gn_maker_set(&maker, "extensions", text);
        for (int i = 0; i < count; i++) {
            snprintf(text, sizeof text, NODE, i);
            gn_maker_add(&maker, "nodes", text);
        }
        snprintf(text, sizeof text, "[{'nodes':[0,1,2,3],'extras':%s}]", extras);
        gn_maker_set(&maker, "scenes", text);
    }
    if (scene) gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
}

static bool try_command(char *command, int argc, const char *const *flags) {
    char *argv[12] = {"gnomon", command};
    for (int i = 0; i < argc; i++) argv[2 + i] = (char *)flags[i];
    gn_options_finish(&options);
    err = (struct gn_err){0};
    if (!gn_args_parse(&options, 2 + argc, argv, &warnings, &err)) fail_msg("%s", err.text);
    return gn_stage_look_build(&look, options.settings, scene, &warnings, &err);
}
#define LOOK(...)                                                                                  \
    try_command("render", (int)(sizeof(const char *[]){__VA_ARGS__} / sizeof(char *)),             \
                (const char *[]){__VA_ARGS__})

static void aim(void) { gn_stage_aim_lights(&pose, &look.frame_opts, options.settings); }

/* The unit vector to the sun, as the pose has it. */
static void assert_sun_at(double azimuth_deg, double altitude_deg, double north_deg) {
    vec3 place, along;
    float to_ws[3];
    const int light = gn_stage_sun_light(scene);
    gn_pose_light(&pose, (uint32_t)light, place, along);
    gn_sun_direction(azimuth_deg, altitude_deg, north_deg, to_ws);
    for (int k = 0; k < 3; k++)
        if (fabsf(along[k] + to_ws[k]) > 1e-5f)
            fail_msg("along %c: %g, not %g", "xyz"[k], (double)-along[k], (double)to_ws[k]);
}

static const struct gn_light_opts *sun_entry(void) {
    const struct gn_frame_shadow_opts *s = &look.frame_opts.shadow;
    for (uint32_t i = 0; i < s->light_count; i++)
        if ((int)s->lights[i].light == gn_stage_sun_light(scene)) return &s->lights[i];
    return NULL;
}

static const char lamp[] = "{'type':'point'}", plain[] = "{'type':'directional'}",
                  marked[] = "{'type':'directional','extras':{'gnomon_sun':true}}";

static void lights_of(const char *a, const char *b, const char *c, const char *extras) {
    char text[300];
    snprintf(text, sizeof text, "%s,%s,%s", a, b, c);
    make_scene(text, 3, extras);
}

static void the_marked_light_is_the_sun_else_the_first_directional_one(void **state) {
    (void)state;
    lights_of(lamp, plain, marked, "{}");
    assert_int_equal(gn_stage_sun_light(scene), 2);
    lights_of(lamp, plain, plain, "{}");
    assert_int_equal(gn_stage_sun_light(scene), 1);
    lights_of(lamp, lamp, lamp, "{}");
    assert_int_equal(gn_stage_sun_light(scene), -1);
    make_scene(NULL, 0, NULL);
    assert_true(scene->added.light);
    assert_int_equal(gn_stage_sun_light(scene), (int)scene->light_count - 1);
}

static void the_light_stands_where_the_sun_does(void **state) {
    (void)state;
    static const struct gn_place berlin = {52.5, 13.4};
    const struct gn_sun_view view = gn_sun_view(1782036000, &berlin);
    for (int made = 0; made < 2; made++) {
        if (made)
            make_scene(NULL, 0, NULL);
        else
            lights_of(lamp, plain, marked, "{}");
        assert_true(LOOK("--sun", "52.5,13.4", "--date", "2026-06-21T12:00", "--sun-time-zone",
                         "Europe/Berlin"));
        aim();
        assert_sun_at(view.azimuth_deg, view.altitude_deg, 0);
        look.frame_opts.view.sun_utc_s += 3 * 3600;
        const struct gn_sun_view later = gn_sun_view(1782036000 + 3 * 3600, &berlin);
        aim();
        assert_sun_at(later.azimuth_deg, later.altitude_deg, 0);
        assert_true(sun_entry() && fabsf(sun_entry()->radius - 0.00465f) < 1e-6f);
        assert_true(sun_entry()->color[0] > 1 && sun_entry()->color[2] < sun_entry()->color[0]);
        assert_true(look.frame_opts.exposure_given && look.frame_opts.exposure_ev == 0);
    }
}

static void azimuth_and_altitude_are_by_hand_and_north_is_the_scenes(void **state) {
    (void)state;
    lights_of(plain, lamp, lamp, "{'gnomon_north':90}");
    assert_true(LOOK("--sun-azimuth", "135", "--sun-altitude", "30"));
    aim();
    assert_sun_at(135, 30, 90);
    assert_true(LOOK("--sun-altitude", "10"));
    aim();
    assert_sun_at(180, 10, 90);
}

static void the_sun_that_has_set_gives_no_light_and_the_sky_some(void **state) {
    (void)state;
    lights_of(plain, lamp, lamp, "{}");
    assert_true(LOOK("--sun-altitude", "-4"));
    aim();
    assert_true(sun_entry() && sun_entry()->color[0] == 0);
    assert_sun_at(180, 0, 0);
    const struct gn_frame_environment_opts *e = &look.frame_opts.environment;
    assert_true(e->of && !e->lights_key && !e->reflected_only && e->of->whole.harmonics[0][2] > 0);
    const uint64_t id = e->id;
    assert_true(LOOK("--sun-altitude", "-4"));
    aim();
    assert_int_equal(look.frame_opts.environment.id, id);
    assert_true(LOOK("--sun-altitude", "-4.1"));
    aim();
    assert_true(look.frame_opts.environment.id != id);
}

/* A kiosk keeps the sky that it has while a thread makes that of the sun's next place; one that is
 * far away is made at once, and so is each of `render`. */
static void a_kiosk_waits_for_no_sky_that_is_near(void **state) {
    (void)state;
    const struct gn_frame_environment_opts *e = &look.frame_opts.environment;
    make_scene(NULL, 0, NULL);
    assert_true(try_command("show", 2, (const char *const[]){"--sun-altitude", "20"}));
    aim();
    const struct gn_environment *first = e->of;
    assert_true(try_command("show", 2, (const char *const[]){"--sun-altitude", "21"}));
    aim();
    assert_ptr_equal(e->of, first);
    for (int i = 0; i < 1000 && e->of == first; i++) {
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
        aim();
    }
    assert_ptr_not_equal(e->of, first);
    const uint64_t id = e->id;
    assert_true(LOOK("--sun-altitude", "40"));
    assert_true(LOOK("--sun-altitude", "21"));
    aim();
    assert_int_equal(e->id, id); /* the same picture */
    first = e->of;
    assert_true(try_command("show", 2, (const char *const[]){"--sun-altitude", "50"}));
    aim();
    assert_ptr_not_equal(e->of, first);
}

static void an_environment_that_is_named_stays(void **state) {
    (void)state;
    make_scene(NULL, 0, NULL);
    assert_true(LOOK("--sun-altitude", "40", "--environment", "none"));
    aim();
    assert_null(look.frame_opts.environment.of);
    assert_true(LOOK("--sun-altitude", "40", "--environment", "studio"));
    aim();
    assert_true(look.frame_opts.environment.of && look.frame_opts.environment.lights_key);
    assert_sun_at(180, 40, 0);
}

static void without_the_section_nothing_is_set(void **state) {
    (void)state;
    lights_of(lamp, plain, marked, "{'gnomon_north':45}");
    assert_true(LOOK("--date", "2026-06-21"));
    aim();
    assert_false(pose.aimed);
    assert_null(sun_entry());
    assert_false(look.frame_opts.exposure_given);
}

static void a_wrong_time_zone_is_a_usage_error(void **state) {
    (void)state;
    make_scene(NULL, 0, NULL);
    assert_false(LOOK("--sun", "0,0", "--date", "2026-06-21", "--sun-time-zone", "Mars/Olympus"));
    assert_non_null(strstr(err.text, "--sun-time-zone: there is no time zone \"Mars/Olympus\""));
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_marked_light_is_the_sun_else_the_first_directional_one),
        cmocka_unit_test(the_light_stands_where_the_sun_does),
        cmocka_unit_test(azimuth_and_altitude_are_by_hand_and_north_is_the_scenes),
        cmocka_unit_test(the_sun_that_has_set_gives_no_light_and_the_sky_some),
        cmocka_unit_test(a_kiosk_waits_for_no_sky_that_is_near),
        cmocka_unit_test(an_environment_that_is_named_stays),
        cmocka_unit_test(without_the_section_nothing_is_set),
        cmocka_unit_test(a_wrong_time_zone_is_a_usage_error),
    };
    const int failed = RUN(tests);
    if (scene) gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    gn_options_finish(&options);
    return failed;
}
