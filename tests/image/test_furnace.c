/* Environments in pictures. In a uniform one white surfaces of any roughness, metal or not, reflect
 * all that arrives: a sphere loses at most 3 % and gains nothing. A file's result is kept, and made
 * again where what was kept is broken. */
#include <dirent.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "environment/environment.h"
#include "image/ball.h"
#include "image/microfacets.h"
#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { ROUGHNESSES = 9, WIDTH = 480, HEIGHT = 120, FINE = 3 };

enum { ROWS = 6, GREY = ROWS, BLACK, SCENES };
static char folder[512], scenes[SCENES][600], uniform[600], half[600];

/* A row of spheres of rising roughness, white or grey. light: one of its own, unlike any other. */
static void write_spheres(const char *path, double metalness, double base, const char *more,
                          bool light) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_ball_add(&maker, 0.45f);
    char text[400], nodes[200] = "";
    for (int i = 0; i < ROUGHNESSES; i++) {
        snprintf(text, sizeof text,
                 "{%s'pbrMetallicRoughness':{'baseColorFactor':[%g,%g,%g,1],'metallicFactor':%g,"
                 "'roughnessFactor':%g}}",
                 more, base, base, base, metalness, i / (ROUGHNESSES - 1.0));
        gn_maker_add(&maker, "materials", text);
        snprintf(text, sizeof text,
                 "{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2,"
                 "'material':%d}]}",
                 i);
        gn_maker_add(&maker, "meshes", text);
        snprintf(text, sizeof text, "{'mesh':%d,'translation':[%d,0,0]}", i, i - ROUGHNESSES / 2);
        gn_maker_add(&maker, "nodes", text);
        snprintf(nodes + strlen(nodes), sizeof nodes - strlen(nodes), "%d,", i);
    }
    gn_maker_add(
        &maker, "cameras",
        "{'type':'orthographic','orthographic':{'xmag':5,'ymag':1.25,'znear':1,'zfar':9}}");
    gn_maker_add(&maker, "nodes", "{'camera':0,'translation':[0,0,5]}");
    if (light) {
        gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
        gn_maker_set(&maker, "extensions",
                     "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':1}]}}");
        gn_maker_add(&maker, "nodes", "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
    }
    snprintf(text, sizeof text, "{'nodes':[%s%d%s]}", nodes, ROUGHNESSES, light ? ",10" : "");
    gn_maker_add(&maker, "scenes", text);
    gn_maker_set(&maker, "scene", "0");
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
}

static struct gn_picture draw_at(int scale, const char *scene, const char *environment,
                                 const char *more, const char *value) {
    struct gn_err err = {0};
    struct gn_picture picture;
    char size[40];
    snprintf(size, sizeof size, "%dx%d", scale * WIDTH, scale * HEIGHT);
    const char *const args[] = {
        "--environment", environment, "--output", "linear", "--size", size, more, value, NULL};
    if (!gn_shot(&picture, NULL, &err, "pfm", scene, args)) fail_msg("%s", err.text);
    return picture;
}

static struct gn_picture draw(const char *scene, const char *environment, const char *more,
                              const char *value) {
    return draw_at(1, scene, environment, more, value);
}

/* Of the pixels of sphere i that are wholly inside its outline. */
static void range_of(const struct gn_picture *picture, int i, float range[2]) {
    const int x0 = WIDTH / 2 + (i - ROUGHNESSES / 2) * WIDTH / 10, y0 = HEIGHT / 2, r = 20;
    range[0] = INFINITY, range[1] = -INFINITY;
    for (int y = -r; y <= r; y++)
        for (int x = -r; x <= r; x++) {
            if (x * x + y * y > r * r) continue;
            const float *p = gn_picture_at(picture, x0 + x, y0 + y);
            for (int k = 0; k < 3; k++) {
                range[0] = fminf(range[0], p[k]);
                range[1] = fmaxf(range[1], p[k]);
            }
        }
}

static void check_uniform(const struct gn_picture *picture, float wanted, const char *what) {
    for (int i = 0; i < ROUGHNESSES; i++) {
        float range[2];
        range_of(picture, i, range);
        if (range[0] < 0.97f * wanted || range[1] > 1.001f * wanted)
            fail_msg("%s, roughness %.3f: %.4f to %.4f instead of %.2f", what,
                     i / (ROUGHNESSES - 1.0), range[0], range[1], wanted);
    }
}

static void test_white_spheres_lose_nothing_in_uniform_light(void **state) {
    (void)state;
    static const char *const what[ROWS] = {
        "white", "metal", "double sided", "coated", "coated by half, rough", "coated metal"};
    for (int s = 0; s < ROWS; s++) {
        struct gn_picture picture = draw(scenes[s], uniform, "--environment-turn", "0");
        check_uniform(&picture, 1.0f, what[s]);
        gn_picture_finish(&picture);
    }
}

/* By what light loses between microfacets, from the front to the rim. */
static void test_grey_metals_return_what_microfacets_do(void **state) {
    (void)state;
    static const double cosines[] = {0.99, 0.7, 0.5, 0.3};
    struct gn_picture picture = draw_at(4, scenes[GREY], uniform, "--occlusion", "none");
    for (int i = 2; i < ROUGHNESSES; i += 2)
        for (int k = 0; k < 4; k++) {
            const double n_v = cosines[k], roughness = i / (ROUGHNESSES - 1.0);
            const double middle = 4 * (WIDTH / 2 + (i - ROUGHNESSES / 2) * (WIDTH / 10.0)),
                         beside = 4 * 0.45 * WIDTH / 10 * sqrt(1 - n_v * n_v);
            const double here =
                             (double)*gn_picture_at(&picture, (int)(middle - beside), 2 * HEIGHT),
                         wanted = gn_microfacets_return(0.5, roughness, n_v);
            print_message("roughness %.2f, cosine %.2f: %.4f, by a walk %.4f\n", roughness, n_v,
                          here, wanted);
            if (fabs(here - wanted) > 0.05 * wanted) fail_msg("%.4f", here / wanted);
        }
    gn_picture_finish(&picture);
}

/* Share of white light from all sides that a surface of the reflectance 0.04 returns, as a sphere
 * shows it: the mean over its pixels but for the rim, from this cosine on. Single scattering of
 * GGX, by importance: Karis, "Real Shading in Unreal Engine 4" (2013); masking after Heitz,
 * "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (2014). */
#define LEAST 0.3
static double returned_by(double roughness) {
    enum { COSINES = 32, SIDE = 48 };
    const double a2 = pow(roughness, 4), pi = acos(-1);
    double sum = 0, area = 0;
    for (int k = 0; k < COSINES; k++) {
        const double n_v = LEAST + (1 - LEAST) * (k + .5) / COSINES;
        area += n_v;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const double at = (i / SIDE + .5) / SIDE;
            const double n_h = sqrt((1 - at) / (1 + (a2 - 1) * at)),
                         around = 2 * pi * (i % SIDE + .5) / SIDE;
            const double v_h = sqrt((1 - n_v * n_v) * (1 - n_h * n_h)) * cos(around) + n_v * n_h;
            const double n_l = 2 * v_h * n_h - n_v;
            if (n_l <= 0) continue;
            const double light = n_v * sqrt(n_l * n_l * (1 - a2) + a2),
                         eye = n_l * sqrt(n_v * n_v * (1 - a2) + a2);
            const double fresnel = 0.04 + 0.96 * pow(1 - fmax(v_h, 0), 5);
            sum += n_v * fresnel * 2 * n_l * v_h / ((light + eye) * n_h) / (SIDE * SIDE);
        }
    }
    return sum / area;
}

static void test_black_spheres_reflect_what_microfacets_do(void **state) {
    (void)state;
    struct gn_picture picture = draw(scenes[BLACK], uniform, NULL, NULL);
    for (int i = 1; i < ROUGHNESSES; i++) {
        const double roughness = i / (ROUGHNESSES - 1.0), wanted = returned_by(roughness);
        const int middle = WIDTH / 2 + (i - ROUGHNESSES / 2) * WIDTH / 10, r = WIDTH / 20;
        const double within = (1 - LEAST * LEAST) * pow(0.45 * WIDTH / 10, 2);
        double sum = 0, count = 0;
        for (int y = -r; y < r; y++)
            for (int x = -r; x < r; x++) {
                if ((x + .5) * (x + .5) + (y + .5) * (y + .5) > within) continue;
                sum += (double)*gn_picture_at(&picture, middle + x, HEIGHT / 2 + y);
                count++;
            }
        const double here = sum / count;
        print_message("roughness %.3f: %.4f, by GGX %.4f\n", roughness, here, wanted);
        if (fabs(here - wanted) > 0.12 * wanted) fail_msg("%.4f", here / wanted);
    }
    gn_picture_finish(&picture);
}

static int count_bright(const struct gn_picture *picture) {
    int count = 0;
    const int x0 = FINE * (WIDTH / 2 - ROUGHNESSES / 2 * WIDTH / 10), r = FINE * 20;
    for (int y = -r; y <= r; y++)
        for (int x = -r; x <= r; x++)
            count += *gn_picture_at(picture, x0 + x, FINE * HEIGHT / 2 + y) > 8;
    return count;
}

/* So large that a highlight is wider than a pixel, which no highlight is narrower than.
 * The studio's first box has the radiance 17; all others 3 at most. A light that was moved is no
 * longer the box: then the mirror shows as much of it as of the others, and a small highlight. */
static void test_a_mirror_shows_the_key_as_the_environment_has_it(void **state) {
    (void)state;
    struct gn_picture kept = draw_at(FINE, scenes[1], "studio", NULL, NULL),
                      moved = draw_at(FINE, scenes[1], "studio", "--light-elevation", "30");
    const int there = count_bright(&kept), elsewhere = count_bright(&moved);
    print_message("%d pixels of a mirror show the key, %d if the light is elsewhere\n", there,
                  elsewhere);
    assert_true(there >= 8 * FINE * FINE && elsewhere <= 2 * FINE * FINE);
    gn_picture_finish(&kept);
    gn_picture_finish(&moved);
}

static void test_strength_and_exposure_are_factors(void **state) {
    (void)state;
    struct gn_picture picture = draw(scenes[1], uniform, "--environment-strength", "0.25");
    check_uniform(&picture, 0.25f, "strength 1/4");
    gn_picture_finish(&picture);
    picture = draw(scenes[0], half, "--exposure", "-1");
    check_uniform(&picture, 0.25f, "half of 1/2");
    gn_picture_finish(&picture);
}

/* The studio is not symmetric; a turn of 360 degrees is none, one of 90 is another picture. */
static void test_the_environment_turns(void **state) {
    (void)state;
    struct gn_picture none = draw(scenes[1], "studio", "--environment-turn", "0"),
                      whole = draw(scenes[1], "studio", "--environment-turn", "360"),
                      quarter = draw(scenes[1], "studio", "--environment-turn", "90");
    double differs[2] = {0};
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
        differs[0] += fabsf(none.data[i] - whole.data[i]);
        differs[1] += fabsf(none.data[i] - quarter.data[i]);
    }
    assert_true(differs[0] < 1e-3 * differs[1] && differs[1] > 100);
    gn_picture_finish(&none);
    gn_picture_finish(&whole);
    gn_picture_finish(&quarter);
}

/* ---- as the background ---- */

/* A camera that looks along -Z with 90 degrees; behind it a square, or before it one of metal that
 * is a mirror and fills the picture. */
static void write_view(const char *path, bool mirror) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_add(&maker, "materials", "{'pbrMetallicRoughness':{'roughnessFactor':0}}");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    gn_maker_set(&maker, "nodes",
                 mirror ? "[{'mesh':0,'translation':[0,0,-2],'scale':[5,5,5],"
                          "'rotation':[0.7071068,0,0,0.7071068]},{'camera':0}]"
                        : "[{'mesh':0,'translation':[0,0,9]},{'camera':0}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    gn_maker_add(&maker, "cameras",
                 "{'type':'perspective','perspective':{'yfov':1.5707963,'znear':1}}");
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
}

/* Red above the horizon, green from -Z to +X: the second quarter of each row. */
static void write_quarters(const char *path) {
    FILE *file = fopen(path, "wb");
    fputs("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 128 +X 256\n", file);
    for (int i = 0; i < 128 * 256; i++) {
        const int x = i % 256, y = i / 256;
        fwrite((uint8_t[]){y < 64 ? 128 : 1, x >= 64 && x < 128 ? 128 : 1, 128, 129}, 4, 1, file);
    }
    fclose(file);
}

/* Away from the borders of the quarters the pixel has what lies in its direction. */
static void check_quarters(const char *scene, const char *hdr, const char *const more[2],
                           bool green_on_the_right) {
    struct gn_picture picture;
    struct gn_err err = {0};
    const char *const args[] = {"--environment", hdr,        "--environment-show",
                                "yes",           "--output", "linear",
                                "--size",        "120x120",  more[0],
                                more[1],         NULL};
    if (!gn_shot(&picture, NULL, &err, "pfm", scene, args)) fail_msg("%s", err.text);
    for (int y = 2; y < 118; y++)
        for (int x = 2; x < 118; x++) {
            if (abs(x - 60) < 6 || abs(y - 60) < 6) continue;
            const float *p = gn_picture_at(&picture, x, y);
            const bool right = x > 60, above = y < 60;
            const bool green = right == green_on_the_right;
            if (fabsf(p[0] - (above ? 1 : 0)) > .05f || fabsf(p[1] - (green ? 1 : 0)) > .05f ||
                fabsf(p[2] - 1) > .05f)
                fail_msg("%s %s: %d, %d: %.2f %.2f %.2f", more[0], more[1], x, y, (double)p[0],
                         (double)p[1], (double)p[2]);
        }
    gn_picture_finish(&picture);
}

static void test_it_is_seen_where_it_is(void **state) {
    (void)state;
    char scene[600], hdr[600];
    snprintf(scene, sizeof scene, "%s/view.glb", folder);
    snprintf(hdr, sizeof hdr, "%s/quarters.hdr", folder);
    write_view(scene, false);
    write_quarters(hdr);
    check_quarters(scene, hdr, (const char *[]){"--time", "0"}, true);
    check_quarters(scene, hdr, (const char *[]){"--environment-turn", "90"}, false);
    /* reflected in a mirror, +Z is before the camera */
    write_view(scene, true);
    check_quarters(scene, hdr, (const char *[]){"--environment-turn", "180"}, false);
    check_quarters(scene, hdr, (const char *[]){"--environment-turn", "270"}, true);
    unlink(scene);
    unlink(hdr);
}

static void test_it_is_as_bright_as_in_reflections(void **state) {
    (void)state;
    char scene[600];
    snprintf(scene, sizeof scene, "%s/view.glb", folder);
    write_view(scene, false);
    static const char *const ways[] = {"yes", "blur"};
    for (int i = 0; i < 2; i++) {
        struct gn_picture picture;
        struct gn_err err = {0};
        const char *const args[] = {"--environment",
                                    half,
                                    "--environment-show",
                                    ways[i],
                                    "--environment-strength",
                                    "0.5",
                                    "--output",
                                    "linear",
                                    "--exposure",
                                    "1",
                                    "--size",
                                    "40x30",
                                    NULL};
        if (!gn_shot(&picture, NULL, &err, "pfm", scene, args)) fail_msg("%s", err.text);
        for (int k = 0; k < 40 * 30 * 3; k++) assert_true(fabsf(picture.data[k] - .5f) < .01f);
        gn_picture_finish(&picture);
    }
    unlink(scene);
}

/* ---- what is kept ---- */

/* Of environments: how many, and the path of one. */
static int list_kept(char path[700]) {
    static const char prefix[] = "environment-";
    char cache[560];
    int count = 0;
    snprintf(cache, sizeof cache, "%s/gnomon", folder);
    DIR *dir = opendir(cache);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        if (strncmp(entry->d_name, prefix, sizeof prefix - 1) != 0) continue;
        snprintf(path, 700, "%s/%s", cache, entry->d_name);
        count++;
    }
    if (dir) closedir(dir);
    return count;
}

static void forget_kept(void) {
    char path[700];
    while (list_kept(path) > 0)
        if (unlink(path) < 0) fail_msg("%s", path);
}

static void test_a_file_is_kept_and_a_broken_one_is_renewed(void **state) {
    (void)state;
    char path[700];
    struct stat info;
    forget_kept();
    struct gn_picture picture = draw(scenes[1], uniform, NULL, NULL);
    gn_picture_finish(&picture);
    assert_int_equal(list_kept(path), 1);
    assert_true(stat(path, &info) == 0 && info.st_size == GN_ENVIRONMENT_FILE_BYTES + 8);
    for (int cut = 0; cut < 2; cut++) {
        FILE *file = fopen(path, "r+b");
        fseek(file, 5000, SEEK_SET);
        fputs("something else", file);
        fclose(file);
        if (cut) assert_int_equal(truncate(path, 100), 0);
        picture = draw(scenes[1], uniform, NULL, NULL);
        check_uniform(&picture, 1.0f, "beside a broken file");
        gn_picture_finish(&picture);
        assert_true(stat(path, &info) == 0 && info.st_size == GN_ENVIRONMENT_FILE_BYTES + 8);
    }
}

static void test_kept_files_are_used_and_few(void **state) {
    (void)state;
    char path[700], more[640];
    forget_kept();
    /* what is kept of the one in the place of the other shows that it is read */
    struct gn_picture picture = draw(scenes[1], uniform, NULL, NULL);
    gn_picture_finish(&picture);
    assert_int_equal(list_kept(path), 1);
    char first[700];
    memcpy(first, path, sizeof first);
    snprintf(more, sizeof more, "%s/aside", folder);
    assert_int_equal(rename(first, more), 0);
    picture = draw(scenes[1], half, NULL, NULL);
    gn_picture_finish(&picture);
    assert_int_equal(list_kept(path), 1);
    assert_int_equal(rename(path, first), 0);
    picture = draw(scenes[1], uniform, NULL, NULL);
    check_uniform(&picture, 0.5f, "kept");
    gn_picture_finish(&picture);
    unlink(more);
    if (!gn_shot_full()) return;
    for (int i = 0; i < 18; i++) {
        snprintf(more, sizeof more, "%s/%d.hdr", folder, i);
        gn_uniform_write(more, i - 29);
        picture = draw(scenes[1], more, NULL, NULL);
        gn_picture_finish(&picture);
        unlink(more);
    }
    assert_int_equal(list_kept(path), 16);
}

static void test_a_bad_file_is_one_line(void **state) {
    (void)state;
    char bad[640], out[640];
    struct gn_run run;
    struct gn_err err = {0};
    snprintf(bad, sizeof bad, "%s/bad.hdr", folder);
    snprintf(out, sizeof out, "%s/bad.png", folder);
    FILE *file = fopen(bad, "wb");
    fputs("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\nshort", file);
    fclose(file);
    const char *const argv[] = {
        gn_shot_program(), "render", scenes[0], "--environment", bad, "-o", out, NULL};
    if (!gn_run(&run, argv, 0, &err)) fail_msg("%s", err.text);
    assert_int_equal(run.status, 1);
    if (!strstr(run.err, "bad.hdr: HDR: truncated in row 0\n") ||
        strchr(run.err, '\n') != run.err + strlen(run.err) - 1)
        fail_msg("\"%s\"", run.err);
}

#define COAT(factor, roughness)                                                                    \
    "'extensions':{'KHR_materials_clearcoat':{'clearcoatFactor':" factor                           \
    ",'clearcoatRoughnessFactor':" roughness "}},"

static int set_up(void **state) {
    (void)state;
    char build[PATH_MAX]; /* whole: relative folders for caches are ignored */
    if (!realpath(gn_shot_build(), build)) return 1;
    snprintf(folder, sizeof folder, "%.400s/furnace.%d", build, (int)getpid());
    mkdir(folder, 0700);
    setenv("XDG_CACHE_HOME", folder, 1);
    for (int i = 0; i < SCENES; i++) snprintf(scenes[i], sizeof scenes[i], "%s/%d.glb", folder, i);
    snprintf(uniform, sizeof uniform, "%s/uniform.hdr", folder);
    snprintf(half, sizeof half, "%s/half.hdr", folder);
    write_spheres(scenes[0], 0, 1, "", false);
    write_spheres(scenes[1], 1, 1, "", false);
    write_spheres(scenes[2], 0, 1, "'doubleSided':true,", false);
    write_spheres(scenes[3], 0, 1, COAT("1", "0"), false);
    write_spheres(scenes[4], 0, 1, COAT("0.5", "0.7"), false);
    write_spheres(scenes[5], 1, 1, COAT("1", "0.2"), false);
    write_spheres(scenes[GREY], 1, 0.5, "", false);
    write_spheres(scenes[BLACK], 0, 0, "", false);
    return gn_uniform_write(uniform, 0) && gn_uniform_write(half, -1) ? 0 : 1;
}

static int tear_down(void **state) {
    (void)state;
    char command[600];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) != 0; /* NOLINT: a path of our own */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_white_spheres_lose_nothing_in_uniform_light),
        cmocka_unit_test(test_grey_metals_return_what_microfacets_do),
        cmocka_unit_test(test_black_spheres_reflect_what_microfacets_do),
        cmocka_unit_test(test_a_mirror_shows_the_key_as_the_environment_has_it),
        cmocka_unit_test(test_strength_and_exposure_are_factors),
        cmocka_unit_test(test_the_environment_turns),
        cmocka_unit_test(test_it_is_seen_where_it_is),
        cmocka_unit_test(test_it_is_as_bright_as_in_reflections),
        cmocka_unit_test(test_a_file_is_kept_and_a_broken_one_is_renewed),
        cmocka_unit_test(test_kept_files_are_used_and_few),
        cmocka_unit_test(test_a_bad_file_is_one_line),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
