/* The whole way of the oracle, from the bytes of a file to a mask, against formulas. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/truth.h"
#include "unit/check.h"

/* A ground of 20 m, a unit cube standing on it, a camera on (0, 6, 0) that looks straight down, a
 * sun from +X, 45 degrees high. Positions are 8-bit so that the buffer is short: the ground's 4
 * corners, then the cube's 8. */
static const char cube_scene[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3]}],"
    "\"extensionsUsed\":[\"KHR_lights_punctual\",\"KHR_mesh_quantization\"],"
    "\"extensionsRequired\":[\"KHR_mesh_quantization\"],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"directional\"}]}},"
    "\"nodes\":[{\"mesh\":0,\"scale\":[10,1,10]},{\"mesh\":1,\"translation\":[0,0.5,0],"
    "\"scale\":[0.5,0.5,0.5]},{\"camera\":0,\"translation\":[0,6,0],"
    "\"rotation\":[-0.70710678,0,0,0.70710678]},{\"rotation\":[-0.27059805,0.65328148,"
    "0.27059805,0.65328148],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.9272952180016122,"
    "\"znear\":0.1}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2}]},"
    "{\"primitives\":[{\"attributes\":{\"POSITION\":1},\"indices\":3}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5120,\"count\":4,\"type\":\"VEC3\","
    "\"min\":[-1,0,-1],\"max\":[1,0,1]},{\"bufferView\":0,\"byteOffset\":16,"
    "\"componentType\":5120,\"count\":8,\"type\":\"VEC3\",\"min\":[-1,-1,-1],\"max\":[1,1,1]},"
    "{\"bufferView\":1,\"componentType\":5121,\"count\":6,\"type\":\"SCALAR\"},"
    "{\"bufferView\":1,\"byteOffset\":6,\"componentType\":5121,\"count\":36,\"type\":\"SCALAR\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48,\"byteStride\":4,\"target\":34962},"
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":42,\"target\":34963}],"
    "\"buffers\":[{\"byteLength\":90,\"uri\":\"data:application/octet-stream;base64,%s\"}]}";

static void base64(const uint8_t *in, int size, char *out) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < size; i += 3) { /* size is a multiple of 3 */
        uint32_t v = (uint32_t)in[i] << 16 | (uint32_t)in[i + 1] << 8 | in[i + 2];
        for (int k = 18; k >= 0; k -= 6) *out++ = digits[v >> k & 63];
    }
    *out = 0;
}

static struct gn_scene *load_cube(void) {
    static const int8_t ground[4][2] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
    static const uint8_t faces[42] = {0, 1, 2, 0, 2, 3, /* ground, up */
                                      0, 4, 6, 0, 6, 2, /* -x; corner = x + 2 y + 4 z */
                                      1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7,
                                      2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    uint8_t bytes[90] = {0};
    for (int i = 0; i < 4; i++) {
        bytes[4 * i] = (uint8_t)ground[i][0];
        bytes[4 * i + 2] = (uint8_t)ground[i][1];
    }
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) bytes[16 + 4 * i + k] = i >> k & 1 ? 1 : 255;
    memcpy(bytes + 48, faces, 42);
    char data[128], text[4096];
    base64(bytes, 90, data);
    int size = snprintf(text, sizeof text, cube_scene, data);
    struct gn_err err = {{0}, GN_EXIT_WORLD};
    struct gn_scene *scene = gn_scene_load_bytes("cube", text, (size_t)size, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* From above, 6 m up with a tangent of .5 at the top of the picture: the cube's roof is 1 m wide at
 * 5 m, its shadow reaches 1 m out to -X; everything else is lit. */
static void test_truth_of_a_cube_from_a_file(void **state) {
    (void)state;
    struct gn_scene *scene = load_cube();
    struct gn_truth truth;
    struct gn_err err = {{0}, GN_EXIT_WORLD};
    struct gn_truth_opts opts = {.width_px = 320, .height_px = 240};
    assert_true(gn_truth_make(&truth, scene, &opts, &err));
    int dark = 0;
    for (int i = 0; i < 320 * 240; i++) {
        double sx = (i % 320 + .5 - 160) / 240, sy = (119.5 - i / 320) / 240;
        double x = 6 * sx, z = -6 * sy; /* on the ground */
        bool roof = fabs(5 * sx) < .5 && fabs(5 * sy) < .5;
        bool shadow = !roof && x > -1.5 && x < -.5 && fabs(z) < .5;
        double margin = fmin(fabs(fabs(z) - .5), fmin(fabs(x + 1.5), fabs(x + .5)));
        if (margin < 1e-3) continue;
        assert_int_equal(truth.mask.lit[i], !shadow);
        double away = (roof ? 5 : 6) * sqrt(1 + sx * sx + sy * sy);
        assert_true(fabs(truth.mask.distance_m[i] - away) < 1e-4);
        assert_true(fabs(truth.mask.normal_ws[3 * i + 1] - 1) < 1e-6);
        dark += shadow;
    }
    assert_true(dark > 500);
    /* Casters: the ground, 20 m. Seen: 8 x 6 m of ground, a little more by the roof. As the sun
     * sees it, 8 m lie in 8 sin 45 = 5.7 m, across them 6 m (5 for the roof): the square is 6 m. */
    assert_true(fabs(truth.frame.extent - 6) < .05);
    gn_truth_finish(&truth);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_truth_of_a_cube_from_a_file),
    };
    return cmocka_run_group_tests_name("cube", tests, NULL, NULL);
}
