/* What gnomon bake leaves as it is, since no grid would do. tests/fuzz/test_bake_error measures
 * what it moves. */
#include <stdlib.h>
#include <string.h>

#include "bake/bake.h"
#include "scene/document.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* Into out: count x components floats of the attribute of mesh 0 in the baked file. Finishes the
 * maker. */
static void bake_attribute(struct gn_maker *m, const char *semantic, size_t components,
                           float *out) {
    const struct gn_bake_opts opts = {.path = "t", .share = 1, .texture_limit_px = 16};
    struct gn_made made = gn_maker_glb(m);
    struct gn_bytes bytes = {0};
    struct gn_bake_report report;
    struct gn_err err = {0};
    if (!gn_bake(&opts, made.data, made.size, &bytes, &report, NULL, &err))
        fail_msg("%s", err.text);
    struct gn_document *d = gn_document_open("b", bytes.data, bytes.size, NULL, NULL, &err);
    assert_non_null(d);
    const json_t *mesh = json_array_get(json_object_get(gn_document_json(d), "meshes"), 0),
                 *primitive = json_array_get(json_object_get(mesh, "primitives"), 0),
                 *attributes = json_object_get(primitive, "attributes");
    const size_t accessor = (size_t)json_number_value(json_object_get(attributes, semantic));
    struct gn_elements e;
    assert_true(gn_document_accessor(d, accessor, &e));
    assert_int_equal(e.component, GN_COMPONENT_F32);
    assert_int_equal(e.count, 3);
    gn_document_floats(d, accessor, components, out);
    gn_document_close(d);
    gn_bytes_finish(&bytes);
    free(made.data);
    gn_maker_finish(m);
}

static void make_triangle(struct gn_maker *m, const float positions[9], const float uvs[6],
                          const char *more) {
    char mesh[300];
    gn_maker_init(m);
    gn_maker_accessor(m, "VEC3", 5126, 3, positions, 9 * sizeof *positions, NULL);
    gn_maker_accessor(m, "VEC2", 5126, 3, uvs, 6 * sizeof *uvs, NULL);
    snprintf(mesh, sizeof mesh, "{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':1}%s}]}",
             more);
    gn_maker_add(m, "meshes", mesh);
    gn_maker_set(m, "nodes", "[{'mesh':0}]");
    gn_maker_set(m, "scenes", "[{'nodes':[0]}]");
}

static const float uvs[6] = {.1f, .2f, .3f, .4f, .5f, .7f};

/* A nanometre wide, 10,000 km off: a place in steps of its grid would have 72 bits. */
static void test_a_place_too_far_for_its_size(void **state) {
    static const float positions[9] = {0, 1e7f, 0, 1e-9f, 1e7f, 0, 0, 1e7f, 1e-9f};
    struct gn_maker m;
    float got[9];
    (void)state;
    make_triangle(&m, positions, uvs, "");
    bake_attribute(&m, "POSITION", 3, got);
    for (int corner = 0; corner < 3; corner++) { /* in any order */
        bool found = false;
        for (int i = 0; i < 3; i++) found |= memcmp(got + 3 * i, positions + 3 * corner, 12) == 0;
        assert_true(found);
    }
}

/* By how much a clip may enlarge a texture is not known before it does. */
static void test_coordinates_whose_scale_a_clip_moves(void **state) {
    static const float positions[9] = {0, 0, 0, 0, 0, 1, 1, 0, 0}, times[2] = {0, 1},
                       scales[4] = {1, 1, 1000, 1000};
    struct gn_maker m;
    float got[6];
    (void)state;
    make_triangle(&m, positions, uvs, ",'material':0");
    const int input = gn_maker_accessor(&m, "SCALAR", 5126, 2, times, sizeof times, NULL),
              output = gn_maker_accessor(&m, "VEC2", 5126, 2, scales, sizeof scales, NULL);
    char clip[500];
    snprintf(clip, sizeof clip,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{'path':"
             "'pointer','extensions':{'KHR_animation_pointer':{'pointer':'/materials/0/"
             "pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale'}}}}]}",
             input, output);
    gn_maker_add(&m, "animations", clip);
    gn_maker_add(&m, "materials",
                 "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'extensions':{"
                 "'KHR_texture_transform':{'scale':[1,1]}}}}}");
    gn_maker_set(&m, "extensionsUsed", "['KHR_texture_transform','KHR_animation_pointer']");
    bake_attribute(&m, "TEXCOORD_0", 2, got);
    for (int corner = 0; corner < 3; corner++) {
        bool found = false;
        for (int i = 0; i < 3; i++) found |= memcmp(got + 2 * i, uvs + 2 * corner, 8) == 0;
        assert_true(found);
    }
}

int main(void) {
    if (!gn_bake_is_built()) return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_place_too_far_for_its_size),
        cmocka_unit_test(test_coordinates_whose_scale_a_clip_moves),
    };
    return RUN(tests);
}
