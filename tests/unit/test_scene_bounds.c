/* Small files that ask for memory, or for work in a frame, of which the size of nothing in the file
 * tells: a pose and a plan of a million instances, the maps of sixteen lights, a JPEG's
 * coefficients. */
#include <stdlib.h>
#include <turbojpeg.h>

#include "frame/frame.h"
#include "fuzz/bomb_pictures.h"
#include "scene/pose.h"
#include "unit/scene_help.h"

static struct gn_scene *load_within(uint64_t memory_mb) {
    const struct gn_scene_limits limits = {.memory_mb = memory_mb};
    struct gn_made glb = gn_maker_glb(&maker);
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    free(glb.data);
    return scene;
}

/* count instances without data */
static void add_instances(int count) {
    char json[120];
    snprintf(json, sizeof json, "{'componentType':5126,'count':%d,'type':'VEC3'}", count);
    const int where = gn_maker_add(&maker, "accessors", json);
    snprintf(
        json, sizeof json,
        "{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':%d}}}}",
        where);
    gn_maker_set(&maker, "nodes", "[]");
    gn_maker_add(&maker, "nodes", json);
}

static void test_what_draws_the_items_counts_as_memory(void **state) {
    (void)state;
    add_instances(300000);
    assert_null(load_within(160));
    assert_string_equal(err.text, "t: nodes: 300000 items: out of memory, or over the limit "
                                  "memory_mb=160");
    struct gn_scene *scene = load_within(256);
    assert_non_null(scene);
    assert_int_equal(scene->item_count, 300000);
    gn_scene_destroy(scene);
    gn_maker_finish(&maker);
}

/* 1024 x 1024 with mipmaps is 9.3 MB, the coefficients of its three colours are 6 MB beside 4: it
 * is halved, unless there is no room for these alone. */
static void test_coefficients_of_a_progressive_jpeg_count_as_memory(void **state) {
    (void)state;
    char json[80];
    struct gn_made jpeg = gn_bomb_jpeg_progressive(1024, 1024, TJSAMP_444);
    snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/jpeg'}",
             gn_maker_view(&maker, jpeg.data, jpeg.size));
    gn_maker_add(&maker, "images", json);
    gn_maker_add(&maker, "textures", "{'source':0}");
    gn_maker_set(&maker, "materials", "[{'emissiveTexture':{'index':0}}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    struct gn_scene *scene = load_within(6);
    assert_non_null(scene);
    assert_int_equal(scene->pictures.image_count, 0);
    assert_non_null(strstr(warnings.text[0], "images[0]: exceeds the limit memory_mb"));
    gn_scene_destroy(scene);
    scene = load_within(10);
    assert_int_equal(scene->pictures.images[0].width_px, 512);
    gn_scene_destroy(scene);
    scene = load_within(12);
    assert_int_equal(scene->pictures.image_count, 1);
    gn_scene_destroy(scene);
    gn_maker_finish(&maker);
    free(jpeg.data);
}

/* 10,000 items count as 100 triangles each: two point lights draw them twelve times. */
static void test_maps_are_within_triangles_per_frame(void **state) {
    (void)state;
    add_instances(10000);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'point','intensity':9,'name':'strong'},"
                 "{'type':'point','intensity':1,'name':'weak'}]}}");
    for (int i = 0; i < 2; i++)
        gn_maker_add(
            &maker, "nodes",
            i ? "{'translation':[0,2,0],'extensions':{'KHR_lights_punctual':{'light':1}}}"
              : "{'translation':[0,2,0],'extensions':{'KHR_lights_punctual':{'light':0}}}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    struct gn_scene *scene = load();
    const struct gn_caps caps = {
        .has = (1u << GN_CAP_COUNT) - 1, .max_texture_px = 4096, .max_texture_units = 16};
    for (uint32_t shadows = 0; shadows <= 2; shadows++) {
        const struct gn_frame_opts opts = {.shadow.triangles =
                                               UINT64_C(1000000) * (1 + 6 * shadows)};
        memset(&warnings, 0, sizeof warnings);
        struct gn_pose pose;
        gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
        struct gn_frame *frame = gn_frame_create(scene, &caps);
        const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, &warnings);
        assert_int_equal(plan->shadow_count, shadows);
        assert_int_equal(warnings.count, 2 - (int)shadows);
        if (shadows < 2)
            assert_non_null(strstr(warnings.text[0], "light 'weak' casts no shadow: its maps are "
                                                     "over the limit triangles_per_frame="));
        gn_frame_destroy(frame);
        gn_pose_finish(&pose);
    }
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_what_draws_the_items_counts_as_memory, setup),
        cmocka_unit_test_setup(test_coefficients_of_a_progressive_jpeg_count_as_memory, setup),
        cmocka_unit_test_setup(test_maps_are_within_triangles_per_frame, setup),
    };
    return RUN(tests);
}
