/* Occlusion of a model in pictures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/occlusion.h"
#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

static char path[600];

static void shoot(struct gn_picture *picture, const char *const more[]) {
    const char *args[24] = {"--backend", "egl", "--size", "120x120"};
    struct gn_err err = {0};
    int count = 4;
    for (int i = 0; more[i]; i++) args[count++] = more[i];
    if (!gn_shot(picture, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
}

static void write_scene(enum gn_occlusion_scene which) {
    struct gn_err err = {0};
    snprintf(path, sizeof path, "%.500s/occlusion-%s.glb", gn_shot_build(),
             gn_occlusion_names[which]);
    if (!gn_occlusion_write(which, path, &err)) fail_msg("%s", err.text);
}

/* Root mean square, and the largest by which a is more than b. */
static double differ(const struct gn_picture *a, const struct gn_picture *b, double *most) {
    const size_t count = (size_t)a->width_px * (size_t)a->height_px * (size_t)a->channels;
    double sum = 0;
    *most = 0;
    for (size_t i = 0; i < count; i++) {
        const double d = (double)(a->data[i] - b->data[i]);
        sum += d * d;
        *most = fmax(*most, d);
    }
    return sqrt(sum / (double)count);
}

static void the_gpu_reads_what_rays_see(void **state) {
    static const enum gn_occlusion_scene scenes[] = {GN_OCCLUSION_PAVILION, GN_OCCLUSION_ROOM};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct gn_picture read, truth, none;
        double most;
        write_scene(scenes[i]);
        shoot(&read, (const char *const[]){"--aov", "occlusion", NULL});
        shoot(&none, (const char *const[]){"--aov", "occlusion", "--occlusion", "none", NULL});
        shoot(&truth, (const char *const[]){"--aov", "occlusion", "--shadow", "truth", "--samples",
                                            "128", NULL});
        const double off = differ(&read, &truth, &most), without = differ(&none, &truth, &most);
        print_message("%s: %.4f, without %.4f\n", gn_occlusion_names[scenes[i]], off, without);
        if (!(off < .04) || !(off < without / 3)) fail_msg("%g off, of %g", off, without);
        gn_picture_finish(&read);
        gn_picture_finish(&truth);
        gn_picture_finish(&none);
    }
}

static void it_takes_ambient_light_alone(void **state) {
    static const char *const lux[] = {"0", "3"}, *const on[] = {"none", "auto"};
    struct gn_picture pictures[2][2];
    double most;
    (void)state;
    write_scene(GN_OCCLUSION_PAVILION);
    for (int k = 0; k < 2; k++)
        for (int o = 0; o < 2; o++)
            shoot(&pictures[k][o], (const char *const[]){"--environment", "studio", "--light-lux",
                                                         lux[k], "--occlusion", on[o], NULL});
    assert_true(differ(&pictures[0][0], &pictures[0][1], &most) > .02);
    assert_true(most > .1);
    differ(&pictures[0][1], &pictures[0][0], &most);
    assert_true(most < .03);      /* lighter nowhere */
    for (int k = 0; k < 2; k++) { /* what the key adds is the same */
        struct gn_picture *without = &pictures[0][k], *with = &pictures[1][k];
        const size_t count = (size_t)(120 * 120 * with->channels);
        for (size_t i = 0; i < count; i++) with->data[i] -= without->data[i];
    }
    assert_true(differ(&pictures[1][0], &pictures[1][1], &most) < .004);
    assert_true(most < .01);
    for (int k = 0; k < 4; k++) gn_picture_finish(&pictures[k / 2][k % 2]);
}

static void without_an_environment_there_is_none(void **state) {
    struct gn_picture a, b;
    double most;
    (void)state;
    write_scene(GN_OCCLUSION_TABLE);
    shoot(&a, (const char *const[]){NULL});
    shoot(&b, (const char *const[]){"--occlusion", "none", NULL});
    assert_true(differ(&a, &b, &most) == 0);
    gn_picture_finish(&a);
    gn_picture_finish(&b);
}

static void it_is_the_same_each_time(void **state) {
    struct gn_picture a, b;
    double most;
    (void)state;
    write_scene(GN_OCCLUSION_TABLE);
    shoot(&a, (const char *const[]){"--environment", "studio", NULL});
    shoot(&b, (const char *const[]){"--environment", "studio", NULL});
    assert_true(differ(&a, &b, &most) == 0);
    gn_picture_finish(&a);
    gn_picture_finish(&b);
}

/* A plate whose occlusion picture says .3: its light comes back by bounces, and not twice. */
static void the_smaller_of_picture_and_volume_counts(void **state) {
    static const uint8_t texel[4] = {77, 77, 77, 255};
    static const float uv[4][2] = {{0}};
    struct gn_picture pictures[2];
    struct gn_err err = {0};
    struct gn_maker maker;
    char json[300];
    (void)state;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    struct gn_made png = gn_maker_png(1, 1, texel);
    const int view = gn_maker_view(&maker, png.data, png.size);
    const int at = gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    free(png.data);
    snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/png'}", view);
    gn_maker_add(&maker, "images", json);
    gn_maker_add(&maker, "textures", "{'source':0}");
    gn_maker_add(&maker, "materials",
                 "{'occlusionTexture':{'index':0},'pbrMetallicRoughness':{'metallicFactor':0,"
                 "'roughnessFactor':1,'baseColorFactor':[0.5,0.5,0.5,1]}}");
    snprintf(json, sizeof json,
             "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':%d},'indices':1,"
             "'material':0}]}]",
             at);
    gn_maker_set(&maker, "meshes", json);
    snprintf(path, sizeof path, "%.500s/occlusion-plate.glb", gn_shot_build());
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    for (int o = 0; o < 2; o++)
        shoot(&pictures[o],
              (const char *const[]){"--environment", "studio", "--light-lux", "0", "--background",
                                    "#000000", "--occlusion", o ? "auto" : "none", NULL});
    const double without = (double)*gn_picture_at(&pictures[0], 60, 60),
                 with = (double)*gn_picture_at(&pictures[1], 60, 60);
    /* .302 / (1 - .5 (1 - .302)) of what is there without any, in place of .302 of it */
    if (!(fabs(with / without - 1 / (1 - .5 * (1 - .302))) < .03))
        fail_msg("%g times as much", with / without);
    gn_picture_finish(&pictures[0]);
    gn_picture_finish(&pictures[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_gpu_reads_what_rays_see),
        cmocka_unit_test(it_takes_ambient_light_alone),
        cmocka_unit_test(without_an_environment_there_is_none),
        cmocka_unit_test(it_is_the_same_each_time),
        cmocka_unit_test(the_smaller_of_picture_and_volume_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
