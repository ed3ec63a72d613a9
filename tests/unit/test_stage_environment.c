/* Which environment a scene gets by itself, and the light that is made as its key. */
#include <math.h>
#include <string.h>

#include "options/args.h"
#include "stage/stage.h"
#include "unit/gltf_maker.h"
#include "unit/light_help.h"
#include "unit/options_help.h"

static struct gn_scene *scene;
static struct gn_stage_look look;

/* The square, of that material and with another that nothing has; with a sun. */
static void make_scene(const char *material, bool lit) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_add(&maker, "materials", material);
    gn_maker_add(&maker, "materials", "{'pbrMetallicRoughness':{'metallicFactor':1}}");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual','KHR_materials_unlit']");
    if (lit) {
        gn_maker_set(&maker, "extensions",
                     "{'KHR_lights_punctual':{'lights':[{'type':'directional'}]}}");
        gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
        gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    }
    gn_scene_destroy(scene);
    scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
}

static const struct gn_frame_environment_opts *build_look(const char *flag, const char *value) {
    char *argv[] = {"gnomon", "render", (char *)flag, (char *)value, NULL};
    gn_options_finish(&options);
    err = (struct gn_err){0};
    if (!gn_args_parse(&options, flag ? 4 : 2, argv, &warnings, &err)) fail_msg("%s", err.text);
    if (!gn_stage_look_build(&look, options.settings, scene, &warnings, &err))
        fail_msg("%s", err.text);
    return &look.frame_opts.environment;
}

static const char matt[] = "{'pbrMetallicRoughness':{'metallicFactor':0}}",
                  shiny[] = "{'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':0.1}}",
                  metal[] = "{'pbrMetallicRoughness':{'metallicFactor':0.5}}",
                  sign[] = "{'extensions':{'KHR_materials_unlit':{}}}";

static void a_scene_without_lights_gets_the_studio(void **state) {
    (void)state;
    static const char *const materials[] = {matt, metal, sign};
    for (int i = 0; i < 3; i++) {
        make_scene(materials[i], false);
        const struct gn_frame_environment_opts *e = build_look(NULL, NULL);
        assert_true(e->of && e->lights_key && !e->reflected_only);
        assert_int_equal(e->id, build_look("--environment", "studio")->id);
    }
    assert_null(build_look("--environment", "none")->of);
    assert_null(build_look("--environment-strength", "0")->of);
    assert_int_equal(look.frame_opts.shadow.light_count, 0); /* and the light is as it was made */
}

static void a_scene_with_lights_gets_reflections_in_metal_alone(void **state) {
    (void)state;
    static const char *const others[] = {matt, shiny, sign};
    for (int i = 0; i < 3; i++) { /* that another material is metal does not count: none has it */
        make_scene(others[i], true);
        assert_null(build_look(NULL, NULL)->of);
    }
    make_scene(metal, true);
    assert_true(build_look(NULL, NULL)->of && look.frame_opts.environment.reflected_only);
    assert_false(look.frame_opts.environment.lights_key);
    assert_int_equal(look.frame_opts.shadow.light_count, 0);
    assert_null(build_look("--environment", "none")->of);
    /* who asks for one gets all of it */
    assert_true(build_look("--environment", "studio")->of);
    assert_false(look.frame_opts.environment.reflected_only);
}

static void the_made_light_is_the_key(void **state) {
    (void)state;
    make_scene(matt, false);
    const struct gn_environment_key key = build_look(NULL, NULL)->of->key;
    const struct gn_light_opts *light = &look.frame_opts.shadow.lights[0];
    assert_int_equal(look.frame_opts.shadow.light_count, 1);
    assert_int_equal(light->given, GN_LIGHT_GIVEN(color) | GN_LIGHT_GIVEN(radius));
    assert_memory_equal(light->color, key.color, sizeof key.color);
    assert_true(light->radius == key.radius && key.radius > 0.0f);
    build_look("--environment-strength", "2");
    assert_true(light->color[1] == 2 * key.color[1]);
    /* what is said of it holds; the rest stays that of the key */
    build_look("--light-radius", "0.5");
    assert_true(light->radius == 0.5f && light->color[1] == key.color[1]);
    build_look("--light-lux", "7");
    const float most = fmaxf(key.color[0], fmaxf(key.color[1], key.color[2]));
    assert_true(light->radius == key.radius);
    const struct gn_light_opts holds = gn_light_held(scene, &look.frame_opts, 0);
    for (int k = 0; k < 3; k++)
        assert_true(fabsf(holds.color[k] - 7 * key.color[k] / most) < 1e-4f);
}

static int finish(void **state) {
    gn_scene_destroy(scene);
    scene = NULL;
    return clean(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_scene_without_lights_gets_the_studio, finish),
        cmocka_unit_test_teardown(a_scene_with_lights_gets_reflections_in_metal_alone, finish),
        cmocka_unit_test_teardown(the_made_light_is_the_key, finish),
    };
    return cmocka_run_group_tests_name("stage environment", tests, NULL, NULL);
}
