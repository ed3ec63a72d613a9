/* Environments against sums without a tree, without harmonics, and against energy that is known. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "environment/private.h"
#include "unit/check.h"

#define PI 3.14159265358979f
enum { PX_W = 256, PX_H = 128 };

/* A sky, a ground, a warm window and a lamp of 8 degrees that is 400 times as bright. */
static void radiance_of(const float d[3], float rgb[3]) {
    const float window[3] = {0.6f, 0.0f, 0.8f}, lamp[3] = {-0.48f, 0.8f, -0.36f};
    const float up = 0.5f + 0.5f * d[1];
    for (int k = 0; k < 3; k++) rgb[k] = 0.2f + up * (0.3f + 0.1f * (float)k);
    if (gn_dot(d, window) > 0.95f) rgb[0] = 3.0f, rgb[1] = 2.5f, rgb[2] = 1.5f;
    if (gn_dot(d, lamp) > 0.9975f) rgb[0] = rgb[1] = rgb[2] = 200.0f;
}

static struct gn_sphere *make_sphere(void (*of)(const float d[3], float rgb[3])) {
    struct gn_sphere *sphere = gn_sphere_create();
    const uint32_t px[2] = {PX_W, PX_H};
    static float row[PX_W][3];
    for (uint32_t y = 0; y < PX_H; y++) {
        const float down = PI * ((float)y + 0.5f) / PX_H;
        for (uint32_t x = 0; x < PX_W; x++) {
            const float around = 2 * PI * ((float)x + 0.5f) / PX_W - PI;
            const float d[3] = {sinf(down) * cosf(around), cosf(down), sinf(down) * sinf(around)};
            of(d, row[x]);
        }
        gn_sphere_add_row(sphere, y, px, (const float(*)[3])row);
    }
    return sphere;
}

static void uniform(const float d[3], float rgb[3]) {
    (void)d;
    rgb[0] = rgb[1] = rgb[2] = 1.0f;
}

static struct gn_environment made;

static void test_uniform_light_stays_exactly_uniform(void **state) {
    (void)state;
    struct gn_sphere *sphere = make_sphere(uniform);
    gn_environment_make(sphere, 2, &made);
    gn_sphere_destroy(sphere);
    for (int i = 0; i < GN_ENVIRONMENT_TEXELS; i++) {
        float rgb[3];
        gn_environment_unpack(made.whole.texels[i], rgb);
        for (int k = 0; k < 3; k++) assert_true(rgb[k] == 1.0f);
    }
    for (int face = 0; face < 6; face++) {
        float n[3], rgb[3];
        gn_environment_direction(face, 0.3f, -0.7f, n);
        gn_environment_diffuse(&made.whole, n, rgb);
        for (int k = 0; k < 3; k++) assert_true(fabsf(rgb[k] - 1.0f) < 0.002f);
    }
    assert_true(made.key.color[1] < 0.001f);
}

/* GGX over all leaves, with the full formula. */
static void brute_force(const struct gn_sphere *sphere, const float n[3], float roughness,
                        float rgb[3]) {
    double sum[3] = {0}, weights = 0;
    const double a2 = pow(roughness, 4);
    const struct gn_sphere_node *leaves = sphere->levels[GN_SPHERE_LEVELS - 1];
    for (int i = 0; i < GN_SPHERE_LEAVES; i++) {
        const float *l = leaves[i].direction;
        const double n_l = gn_dot(n, l);
        if (n_l <= 0) continue;
        double h[3], length = 0, n_h = 0, v_h = 0;
        for (int k = 0; k < 3; k++) h[k] = n[k] + l[k], length += h[k] * h[k];
        for (int k = 0; k < 3; k++) n_h += n[k] * h[k] / sqrt(length);
        v_h = n_h; /* the view is along the normal */
        const double q = n_h * n_h * (a2 - 1) + 1, d = a2 / (PI * q * q);
        const double weight = d * n_h / (4 * v_h) * n_l;
        for (int k = 0; k < 3; k++) sum[k] += weight * leaves[i].sum[k];
        weights += weight * leaves[i].solid_angle;
    }
    for (int k = 0; k < 3; k++) rgb[k] = (float)(sum[k] / weights);
}

static void test_the_tree_sums_what_brute_force_sums(void **state) {
    (void)state;
    struct gn_sphere *sphere = make_sphere(radiance_of);
    gn_sphere_complete(sphere);
    for (int i = 0; i < 60; i++) {
        const float roughness = 0.25f * (float)(1 + i % 4), s = (float)(i * 37 % 61) / 30.5f - 1.0f,
                    t = (float)(i * 17 % 59) / 29.5f - 1.0f;
        float n[3], by_tree[3], all[3];
        gn_environment_direction(i % 6, s, t, n);
        gn_sphere_reflect(sphere, n, roughness, by_tree);
        brute_force(sphere, n, roughness, all);
        for (int k = 0; k < 3; k++)
            if (fabsf(by_tree[k] - all[k]) > 0.02f * all[k])
                fail_msg("roughness %.2f: %f instead of %f", roughness, by_tree[k], all[k]);
    }
    gn_sphere_destroy(sphere);
}

static void test_harmonics_are_near_the_cosine_integral(void **state) {
    (void)state;
    struct gn_sphere *sphere = make_sphere(radiance_of);
    gn_environment_make(sphere, 1, &made); /* the sphere is without its key now */
    const struct gn_sphere_node *leaves = sphere->levels[GN_SPHERE_LEVELS - 1];
    double errors = 0;
    for (int i = 0; i < 48; i++) {
        float n[3], by_harmonics[3];
        gn_environment_direction(i % 6, (float)(i * 7 % 13) / 6.5f - 1.0f,
                                 (float)(i * 5 % 11) / 5.5f - 1.0f, n);
        gn_environment_diffuse(&made.rest, n, by_harmonics);
        double sum[3] = {0};
        for (int l = 0; l < GN_SPHERE_LEAVES; l++)
            for (int k = 0; k < 3; k++)
                sum[k] += fmax(gn_dot(n, leaves[l].direction), 0) * leaves[l].sum[k] / (double)PI;
        for (int k = 0; k < 3; k++) {
            errors += fabs(by_harmonics[k] - sum[k]) / sum[k];
            if (fabs(by_harmonics[k] - sum[k]) > 0.06 * sum[k])
                fail_msg("%f instead of %f", by_harmonics[k], sum[k]);
        }
    }
    assert_true(errors < 0.015 * 48 * 3);
    gn_sphere_destroy(sphere);
}

static void test_the_key_is_the_lamp_and_rest_lacks_its_light(void **state) {
    (void)state;
    struct gn_sphere *sphere = make_sphere(radiance_of);
    const float lamp[3] = {-0.48f, 0.8f, -0.36f};
    gn_environment_make(sphere, 2, &made);
    gn_sphere_destroy(sphere);
    assert_true(gn_dot(made.key.direction, lamp) > 0.9999f);
    /* a disc whose rim has the cosine .9975: the excess over the window, pi sin^2 in projection */
    const float sine2 = 1.0f - 0.9975f * 0.9975f,
                window = 0.2126f * 3 + 0.7152f * 2.5f + 0.0722f * 1.5f;
    const float lux = (200.0f - window) * PI * sine2;
    assert_true(fabsf(made.key.color[1] - lux) < 0.05f * lux);
    assert_true(fabsf(made.key.radius - sqrtf(sine2) / 0.9975f) < 0.1f * sqrtf(sine2));
    /* of a surface that faces the lamp: harmonics keep band 0 to 2 of its light: 1/4 + 1/2 + 5/16
     */
    float whole[3], rest[3];
    gn_environment_diffuse(&made.whole, lamp, whole);
    gn_environment_diffuse(&made.rest, lamp, rest);
    const float taken = (whole[1] - rest[1]) * PI / (0.25f + 0.5f + 0.3125f);
    assert_true(fabsf(taken - made.key.color[1]) < 0.02f * lux);
}

/* Level by level: what the highlight of the key lacks of it is in the reflections. */
static void test_shown_and_highlight_have_all_of_the_key(void **state) {
    (void)state;
    struct gn_sphere *sphere = make_sphere(radiance_of);
    gn_environment_make(sphere, 2, &made);
    gn_sphere_destroy(sphere);
    assert_memory_equal(made.shown.harmonics, made.rest.harmonics, sizeof made.rest.harmonics);
    double mixed = 0;
    for (int level = 0, i = 0; level < GN_ENVIRONMENT_LEVELS; level++) {
        const int side = GN_ENVIRONMENT_PX >> level;
        const double share = (double)(level * level) / 16; /* of the highlight: roughness squared */
        for (const int end = i + 6 * side * side; i < end; i++) {
            float whole[3], rest[3], shown[3];
            gn_environment_unpack(made.whole.texels[i], whole);
            gn_environment_unpack(made.rest.texels[i], rest);
            gn_environment_unpack(made.shown.texels[i], shown);
            const double key = (double)whole[1] - (double)rest[1],
                         sum = (double)shown[1] + share * key;
            mixed += level > 0 && level < 4 ? fabs(key) : 0;
            assert_true(fabs(sum - (double)whole[1]) <= (double)shown[1] / 64);
        }
    }
    assert_true(mixed > 100);
}

static void test_threads_change_no_bit(void **state) {
    (void)state;
    static struct gn_environment alone;
    struct gn_sphere *sphere = make_sphere(radiance_of);
    gn_environment_make(sphere, 1, &alone);
    gn_sphere_destroy(sphere);
    sphere = make_sphere(radiance_of);
    gn_environment_make(sphere, 2, &made);
    gn_sphere_destroy(sphere);
    assert_memory_equal(&alone, &made, sizeof made);
}

static void test_texels_are_rounded_and_keep_powers_of_two(void **state) {
    (void)state;
    const float values[] = {0.0f,    1.0f,    0.5f,     3.0f,  1000.0f,  0.001f,
                            6.1e-5f, 2.0e-6f, 65024.0f, 1e30f, INFINITY, -4.0f};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        const float in[3] = {values[i], values[i], values[i]},
                    most[3] = {65024.0f, 65024.0f, 64512.0f};
        float out[3];
        gn_environment_unpack(gn_environment_pack(in), out);
        for (int k = 0; k < 3; k++) {
            const float wanted = fmaxf(fminf(values[i], most[k]), 0.0f);
            assert_true(fabsf(out[k] - wanted) <=
                        (k == 2 ? 1 / 64.0f : 1 / 128.0f) * wanted + 1e-6f);
        }
    }
}

static void test_a_kept_file_is_whole_or_refused(void **state) {
    (void)state;
    static struct gn_environment again;
    static uint8_t file[GN_ENVIRONMENT_FILE_BYTES];
    gn_environment_write(&made, file);
    assert_true(gn_environment_read(file, sizeof file, &again));
    assert_memory_equal(&again, &made, sizeof made);
    assert_false(gn_environment_read(file, sizeof file - 1, &again));
    for (size_t at = 0; at < sizeof file; at += 1009) {
        file[at] ^= 4;
        assert_false(gn_environment_read(file, sizeof file, &again));
        file[at] ^= 4;
    }
}

static void test_1024_by_512_is_quick(void **state) {
    (void)state;
    struct gn_sphere *sphere = gn_sphere_create();
    const uint32_t px[2] = {1024, 512};
    static float row[1024][3];
    for (int x = 0; x < 1024; x++)
        for (int k = 0; k < 3; k++) row[x][k] = x % 300 < 4 ? 50.0f : 0.3f;
    const int64_t start_ns = gn_clock_process_cpu_ns();
    for (uint32_t y = 0; y < 512; y++) gn_sphere_add_row(sphere, y, px, (const float(*)[3])row);
    const int64_t added_ns = gn_clock_process_cpu_ns();
    gn_environment_make(sphere, 2, &made);
    const int64_t ns = gn_clock_process_cpu_ns() - start_ns;
    gn_sphere_destroy(sphere);
    print_message("gathered in %.0f ms, made in %.0f ms of processor time\n",
                  (double)(added_ns - start_ns) * 1e-6,
                  (double)(ns - (added_ns - start_ns)) * 1e-6);
    if (!getenv("GN_SLOW"))
        assert_true(ns < 10 * GN_NS_PER_S); /* sanitizers; the figure is printed */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniform_light_stays_exactly_uniform),
        cmocka_unit_test(test_the_tree_sums_what_brute_force_sums),
        cmocka_unit_test(test_harmonics_are_near_the_cosine_integral),
        cmocka_unit_test(test_the_key_is_the_lamp_and_rest_lacks_its_light),
        cmocka_unit_test(test_shown_and_highlight_have_all_of_the_key),
        cmocka_unit_test(test_threads_change_no_bit),
        cmocka_unit_test(test_texels_are_rounded_and_keep_powers_of_two),
        cmocka_unit_test(test_a_kept_file_is_whole_or_refused),
        cmocka_unit_test(test_1024_by_512_is_quick),
    };
    return RUN(tests);
}
