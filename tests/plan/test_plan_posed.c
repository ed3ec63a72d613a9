/* Plans of what deforms: its programs, one call for one mesh in several poses, and maps that are
 * drawn again when a joint or a weight moves, and only then. */
#include "plan/fixture.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* One mesh in two poses and, by its targets alone, a third time; on a ground, in a sun. Joint 2 and
 * the weights of the third move. */
static struct gn_scene *make_scene(void) {
    static const float times[] = {0, 1}, turns[] = {0, 0, 0, 1, 0, 0, .38268343f, .92387953f},
                       weights[] = {0, 0, 1, .5f};
    struct gn_maker m;
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    gn_maker_init(&m);
    gn_maker_posed_square(&m);
    gn_maker_accessor(&m, "SCALAR", 5126, 2, times, sizeof times, "'min':[0],'max':[1]"); /* 7 */
    gn_maker_accessor(&m, "VEC4", 5126, 2, turns, sizeof turns, NULL);
    gn_maker_accessor(&m, "SCALAR", 5126, 4, weights, sizeof weights, NULL);
    gn_maker_add(&m, "meshes", "{'primitives':[{'indices':1,'attributes':{'POSITION':0}}]}");
    gn_maker_set(&m, "skins",
                 "[{'joints':[1,2],'inverseBindMatrices':6},{'joints':[3,3],"
                 "'inverseBindMatrices':6}]");
    gn_maker_set(&m, "nodes",
                 "[{'name':'one','mesh':0,'skin':0},{'children':[2],'translation':[-1,1,0]},"
                 "{'translation':[2,0,0]},{'translation':[4,1,0]},"
                 "{'name':'other','mesh':0,'skin':1,'weights':[0.5,0]},"
                 "{'name':'targets','mesh':0,'translation':[-4,1,0]},"
                 "{'name':'ground','mesh':1,'scale':[9,1,9]},"
                 "{'translation':[0,4,9],'rotation':[-0.2,0,0,0.98],'camera':0},"
                 "{'rotation':[-0.64,0.2,0.18,0.72],'extensions':{'KHR_lights_punctual':"
                 "{'light':0}}}]");
    gn_maker_set(&m, "scenes", "[{'nodes':[0,1,3,4,5,6,7,8]}]");
    gn_maker_set(&m, "cameras", "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}]");
    gn_maker_set(&m, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&m, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','name':'Sun'}]}}");
    gn_maker_set(&m, "animations",
                 "[{'samplers':[{'input':7,'output':8},{'input':7,'output':9}],'channels':["
                 "{'sampler':0,'target':{'node':2,'path':'rotation'}},"
                 "{'sampler':1,'target':{'node':5,'path':'weights'}}]}]");
    struct gn_scene *scene = gn_maker_load(&m, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

static void begin(struct gn_plan_fixture *f) {
    const struct gn_caps caps = {
        .has = GN_EVERY_CAP, .max_texture_px = 4096, .max_texture_units = 16};
    *f = (struct gn_plan_fixture){.scene = make_scene()};
    gn_pose_init(&f->pose, f->scene, GN_POSE_DEFAULT);
    gn_pose_step(&f->pose, 500000000);
    f->frame = gn_frame_create(f->scene, &caps);
    GN_LIGHT_SET(&f->opts.shadow.any, technique, GN_TECHNIQUE_PCF);
}

static void test_posed_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f);
    gn_plan_expect(gn_plan_make(&f), "posed");
    gn_plan_end(&f);
}

static void test_a_map_is_drawn_again_when_a_pose_changes(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f);
    const uint64_t first = gn_plan_make(&f)->shadows[0].raster.tiles[0].content_hash;
    gn_pose_step(&f.pose, 500000000);
    assert_true(gn_plan_make(&f)->shadows[0].raster.tiles[0].content_hash == first);
    gn_pose_step(&f.pose, 501000000);
    assert_true(gn_plan_make(&f)->shadows[0].raster.tiles[0].content_hash != first);
    gn_plan_end(&f);
}

static void test_a_plan_carries_the_texels_of_the_pose(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f);
    assert_ptr_equal(gn_plan_make(&f)->pose_texels, f.pose.texels);
    gn_plan_end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_posed_plan),
        cmocka_unit_test(test_a_map_is_drawn_again_when_a_pose_changes),
        cmocka_unit_test(test_a_plan_carries_the_texels_of_the_pose),
    };
    return RUN(tests);
}
