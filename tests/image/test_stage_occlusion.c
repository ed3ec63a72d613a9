/* Occlusion made beside the frames. */
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/clock.h"
#include "core/file.h"
#include "core/hash.h"
#include "image/occlusion.h"
#include "stage/occlusion.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

static struct gn_scene *scene;
static struct gn_pose pose;
static struct gn_frame_opts opts;
static const struct gn_sky even = {.turn = {1, 0}};

static int setup(void **state) {
    struct gn_err err = {0};
    (void)state;
    opts = (struct gn_frame_opts){.occlusion.on = true};
    scene = gn_occlusion_scene(GN_OCCLUSION_PAVILION, &err);
    if (!scene) return -1;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    return 0;
}

/* Frames at one time of the kiosk, until the thread is done. */
static void wait_for_thread(struct gn_occluder *o, int64_t now_ns) {
    const struct timespec little = {.tv_nsec = 2000000};
    while (gn_occluder_works(o)) {
        nanosleep(&little, NULL);
        gn_occluder_step(o, now_ns);
        gn_occluder_give(o, &pose, &opts, false);
    }
}

static size_t texel_bytes(void) {
    const uint32_t *size = scene->occlusion.size;
    return 4ul * size[0] * size[1] * size[2];
}

/* The largest change of a texel. */
static int largest_step(const int8_t *a, const int8_t *b) {
    int most = 0;
    for (size_t i = 0; i < texel_bytes(); i++)
        most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    return most;
}

static void now_it_is_complete(void **state) {
    struct gn_occluder *o = gn_occluder_create(scene);
    (void)state;
    gn_occluder_give(o, &pose, &opts, true);
    assert_non_null(opts.occlusion.texels);
    assert_true(opts.occlusion.id > 0);
    assert_false(gn_occluder_works(o));
    assert_false(gn_occluder_fades(o));
    const uint64_t id = opts.occlusion.id;
    gn_occluder_give(o, &pose, &opts, true); /* it is made once */
    assert_true(opts.occlusion.id == id);
    gn_occluder_destroy(o);
}

static void a_thread_makes_the_same_and_it_fades_in(void **state) {
    struct gn_occluder *now = gn_occluder_create(scene), *o = gn_occluder_create(scene);
    struct gn_frame_opts complete = opts;
    (void)state;
    gn_occluder_give(now, &pose, &complete, true);
    gn_occluder_give(o, &pose, &opts, false);
    assert_null(opts.occlusion.texels); /* no frame waits for it */
    assert_true(opts.occlusion.id == 0);
    assert_true(gn_occluder_works(o));
    wait_for_thread(o, 5 * GN_NS_PER_S);
    assert_true(gn_occluder_fades(o));

    int8_t *before = malloc(texel_bytes());
    if (!before) abort();
    memcpy(before, opts.occlusion.texels, texel_bytes());
    uint64_t id = opts.occlusion.id;
    int frames = 0;
    for (; gn_occluder_fades(o); frames++) {
        gn_occluder_step(o, 5 * GN_NS_PER_S + frames * GN_NS_PER_S / 60);
        gn_occluder_give(o, &pose, &opts, false);
        const int8_t *texels = opts.occlusion.texels[0];
        assert_true(opts.occlusion.id != id); /* GL sends it again */
        assert_true(largest_step(before, texels) <= 4);
        memcpy(before, texels, texel_bytes());
        id = opts.occlusion.id;
    }
    assert_true(frames > 60);
    assert_memory_equal(opts.occlusion.texels, complete.occlusion.texels, texel_bytes());
    gn_occluder_step(o, 9 * GN_NS_PER_S);
    gn_occluder_give(o, &pose, &opts, false);
    assert_true(opts.occlusion.id == id);
    free(before);
    gn_occluder_destroy(now);
    gn_occluder_destroy(o);
}

static void another_environment_is_made_anew(void **state) {
    static struct gn_environment side;
    struct gn_occluder *o = gn_occluder_create(scene);
    (void)state;
    for (int k = 0; k < 3; k++) {
        side.whole.harmonics[0][k] = 1;
        side.whole.harmonics[3][k] = .4f;
    }
    gn_occluder_give(o, &pose, &opts, true);
    int8_t *before = malloc(texel_bytes());
    if (!before) abort();
    memcpy(before, opts.occlusion.texels, texel_bytes());
    opts.environment.of = &side;
    gn_occluder_give(o, &pose, &opts, false);
    assert_memory_equal(opts.occlusion.texels, before, texel_bytes()); /* until it is there */
    wait_for_thread(o, GN_NS_PER_S);
    gn_occluder_step(o, GN_NS_PER_S);
    gn_occluder_step(o, 4 * GN_NS_PER_S);
    gn_occluder_give(o, &pose, &opts, false);
    assert_true(largest_step(before, opts.occlusion.texels[0]) > 6);

    /* changed while a thread works on the one before: that is not shown */
    opts.environment.turn_rad = 1;
    gn_occluder_give(o, &pose, &opts, false);
    opts.environment = (struct gn_frame_environment_opts){0};
    gn_occluder_give(o, &pose, &opts, false);
    wait_for_thread(o, 5 * GN_NS_PER_S);
    gn_occluder_step(o, 9 * GN_NS_PER_S);
    gn_occluder_step(o, 12 * GN_NS_PER_S);
    gn_occluder_give(o, &pose, &opts, false);
    assert_memory_equal(opts.occlusion.texels, before, texel_bytes());
    free(before);
    gn_occluder_destroy(o);
}

/* A plate under a blade that its clip turns. */
static void load_turning(void) {
    static const float times[3] = {0, 1, 2},
                       turns[3][4] = {{0, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 0, -1}};
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    struct gn_maker maker;
    char json[200];
    teardown(NULL);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_add(&maker, "nodes", "{'mesh':0,'translation':[0,0.4,0],'scale':[0.9,1,0.4]}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    const int time =
        gn_maker_accessor(&maker, "SCALAR", 5126, 3, times, sizeof times, "'min':[0],'max':[2]");
    const int turn = gn_maker_accessor(&maker, "VEC4", 5126, 3, turns, sizeof turns, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':"
             "{'node':1,'path':'rotation'}}]}",
             time, turn);
    gn_maker_add(&maker, "animations", json);
    scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
}

/* Neither when a clip begins nor when it ends is there a step. */
static void other_clips_are_faded_to(void **state) {
    (void)state;
    load_turning();
    struct gn_occluder *o = gn_occluder_create(scene);
    int8_t *before = malloc(texel_bytes()), *first = malloc(texel_bytes());
    if (!before || !first) abort();
    gn_occluder_give(o, &pose, &opts, true);
    memcpy(first, opts.occlusion.texels, texel_bytes());
    for (int i = 0; i < 2; i++) {
        const int64_t begun_ns = (5 + 5 * i) * GN_NS_PER_S;
        gn_pose_choose(&pose, i ? GN_POSE_DEFAULT : GN_POSE_NONE);
        gn_occluder_give(o, &pose, &opts, false);
        memcpy(before, opts.occlusion.texels, texel_bytes());
        wait_for_thread(o, begun_ns);
        int frames = 0;
        for (; gn_occluder_fades(o); frames++) {
            gn_occluder_step(o, begun_ns + frames * GN_NS_PER_S / 60);
            gn_occluder_give(o, &pose, &opts, false);
            assert_true(largest_step(before, opts.occlusion.texels[0]) <= 4);
            memcpy(before, opts.occlusion.texels, texel_bytes());
        }
        assert_true(frames > 60);
        const int off = largest_step(first, opts.occlusion.texels[0]);
        assert_true(i ? off == 0 : off > 6);
    }
    gn_pose_step(&pose, GN_NS_PER_S / 2); /* the time alone changes nothing */
    gn_occluder_give(o, &pose, &opts, false);
    assert_false(gn_occluder_works(o));
    assert_true(gn_occlusion_key(scene, GN_POSE_NONE, &even) !=
                gn_occlusion_key(scene, GN_POSE_DEFAULT, &even));
    free(before);
    free(first);
    gn_occluder_destroy(o);
}

static void it_ends_while_a_thread_works(void **state) {
    struct gn_occluder *o = gn_occluder_create(scene);
    (void)state;
    gn_occluder_give(o, &pose, &opts, false);
    assert_true(gn_occluder_works(o));
    const struct timespec little = {.tv_nsec = 30000000};
    nanosleep(&little, NULL);
    const clock_t begun = clock(); /* of all threads, whatever else the machine does */
    gn_occluder_destroy(o);
    assert_true(clock() - begun < CLOCKS_PER_SEC / 4); /* of about 1 s */
    gn_occluder_destroy(NULL);
}

/* ---- kept on the disk ---- */

/* The path of the one file that is kept in a folder; false: there is none. */
static bool find_kept(const char *folder, char path[300]) {
    int count = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *entry; dir && (entry = readdir(dir));)
        if (entry->d_name[0] != '.' && ++count)
            snprintf(path, 300, "%s/%.200s", folder, entry->d_name);
    if (dir) closedir(dir);
    assert_true(count <= 1);
    return count == 1;
}

/* Complete, by an occluder of its own. */
static int8_t *make_complete(void) {
    struct gn_occluder *o = gn_occluder_create(scene);
    int8_t *texels = malloc(texel_bytes());
    if (!texels) abort();
    gn_occluder_give(o, &pose, &opts, true);
    memcpy(texels, opts.occlusion.texels, texel_bytes());
    gn_occluder_destroy(o);
    return texels;
}

static void what_was_made_is_read_again_unless_it_is_damaged(void **state) {
    const char *folder = help_folder();
    char path[300];
    struct gn_err err = {0};
    struct gn_bytes file = {0};
    (void)state;
    setenv("CACHE_DIRECTORY", folder, 1);
    struct gn_occluder *o = gn_occluder_create(scene);
    gn_occluder_give(o, &pose, &opts, false);
    gn_occluder_destroy(o);
    assert_false(find_kept(folder, path)); /* it was not done */
    int8_t *made = make_complete();
    assert_true(find_kept(folder, path));
    if (!gn_file_read(path, 1 << 24, &file, &err)) fail_msg("%s", err.text);

    uint8_t *bytes = (uint8_t *)(uintptr_t)file.data;
    assert_int_equal(file.size, 8 + texel_bytes());
    assert_memory_equal(bytes, made, texel_bytes());
    bytes[0] ^= 1; /* a file of a damaged disk */
    assert_true(gn_file_replace(path, bytes, file.size, &err));
    int8_t *again = make_complete();
    assert_memory_equal(again, made, texel_bytes());
    free(again);
    const uint64_t hash = gn_hash(GN_HASH_INIT, bytes, texel_bytes());
    memcpy(bytes + texel_bytes(), &hash, sizeof hash); /* that which is whole is what is shown */
    assert_true(gn_file_replace(path, bytes, file.size, &err));
    again = make_complete();
    assert_int_equal(largest_step(again, made), 1);
    free(again);

    scene->buffers.positions[0] += .125f; /* another scene: another file */
    gn_file_replace(path, "short", 5, &err);
    again = make_complete();
    free(again);
    DIR *dir = opendir(folder);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(dir));) count += entry->d_name[0] != '.';
    closedir(dir);
    assert_int_equal(count, 2);
    setenv("CACHE_DIRECTORY", "/dev/null/none", 1);
    gn_bytes_finish(&file);
    free(made);
    help_remove(folder);
}

static uint64_t key(void) { return gn_occlusion_key(scene, GN_POSE_NONE, &even); }

#define ASSERT_MATTERS(place, value)                                                               \
    do {                                                                                           \
        const __typeof__(place) was = (place);                                                     \
        const uint64_t before = key();                                                             \
        (place) = (value);                                                                         \
        assert_true(key() != before);                                                              \
        (place) = was;                                                                             \
        assert_true(key() == before);                                                              \
    } while (0)

static void all_that_it_is_made_of_is_in_its_key(void **state) {
    static uint8_t rgba[16];
    struct gn_image image = {.width_px = 2, .height_px = 2, .rgba = rgba};
    struct gn_texture texture = {.wrap_s = GN_WRAP_REPEAT};
    struct gn_material *m = &scene->materials[scene->items[0].material];
    struct gn_texture_ref *holes = &m->textures[GN_TEXTURE_BASE];
    (void)state;
    const uint64_t first = key();
    teardown(NULL);
    setup(NULL);
    assert_true(key() == first); /* the same scene, in other memory */
    m = &scene->materials[scene->items[0].material];
    holes = &m->textures[GN_TEXTURE_BASE];
    ASSERT_MATTERS(scene->buffers.positions[3], 77);
    ASSERT_MATTERS(scene->buffers.normals[3], 77);
    ASSERT_MATTERS(scene->buffers.indices[3], scene->buffers.indices[3] + 1);
    ASSERT_MATTERS(scene->nodes[scene->items[0].node].translation[1], 77);
    ASSERT_MATTERS(scene->items[0].stays, !scene->items[0].stays);
    ASSERT_MATTERS(scene->items[0].casts, !scene->items[0].casts);
    ASSERT_MATTERS(scene->items[0].hidden_in, 1);
    ASSERT_MATTERS(scene->occlusion.cell_m, 77);
    ASSERT_MATTERS(m->double_sided, !m->double_sided);
    ASSERT_MATTERS(m->unlit, !m->unlit);
    ASSERT_MATTERS(m->alpha, GN_ALPHA_MASK);
    const struct gn_scene_pictures pictures = scene->pictures;
    scene->pictures = (struct gn_scene_pictures){&image, &texture, 1, 1};
    m->alpha = GN_ALPHA_MASK;
    ASSERT_MATTERS(m->alpha_cutoff, .25f);
    ASSERT_MATTERS(holes->texture, 0);
    holes->texture = 0;
    ASSERT_MATTERS(rgba[7], 9);
    ASSERT_MATTERS(holes->uv_from_uv[4], .5f);
    ASSERT_MATTERS(texture.mag_nearest, true);
    m->alpha = GN_ALPHA_OPAQUE;
    holes->texture = -1;
    scene->pictures = pictures;

    struct gn_sky other = {.turn = {1, 0}, .radiance = {1}};
    assert_true(gn_occlusion_key(scene, GN_POSE_NONE, &other) != first);
}

static void a_sky_has_the_radiance_of_its_harmonics(void **state) {
    static struct gn_environment_light light;
    (void)state;
    for (int k = 0; k < 3; k++) { /* diffuse light of the radiance 1 + y + xy */
        light.harmonics[0][k] = 1;
        light.harmonics[1][k] = 2 / 3.0f;
        light.harmonics[4][k] = .25f;
    }
    const struct gn_sky sky = gn_stage_sky(&light, 0);
    static const float expected[GN_SKY_TERMS] = {1, 1, 0, 0, 1};
    for (int i = 0; i < GN_SKY_TERMS; i++)
        assert_true(fabsf(sky.radiance[i] - expected[i]) < 1e-5f);
    assert_true(sky.turn[0] == 1 && sky.turn[1] == 0);
}

int main(void) {
    setenv("CACHE_DIRECTORY", "/dev/null/none", 1); /* nothing is kept of earlier runs */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(now_it_is_complete, setup, teardown),
        cmocka_unit_test_setup_teardown(a_thread_makes_the_same_and_it_fades_in, setup, teardown),
        cmocka_unit_test_setup_teardown(another_environment_is_made_anew, setup, teardown),
        cmocka_unit_test_setup_teardown(other_clips_are_faded_to, setup, teardown),
        cmocka_unit_test_setup_teardown(it_ends_while_a_thread_works, setup, teardown),
        cmocka_unit_test_setup_teardown(what_was_made_is_read_again_unless_it_is_damaged, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(all_that_it_is_made_of_is_in_its_key, setup, teardown),
        cmocka_unit_test(a_sky_has_the_radiance_of_its_harmonics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
