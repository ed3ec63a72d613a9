/* A model looks the same however small it is: of meshes with coordinates of 16 bits and nodes that
 * scale them by 1e-10 and less, as gnomon bake writes micrometres. */
#include <stdio.h>
#include <stdlib.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* A turned and a mirrored cube over a floor, all `size` times as large; its coordinates are those
 * of a cube of +-32767. */
static char *write_scene(const char *name, double size) {
    struct gn_maker maker;
    struct gn_err err = {0};
    float at[72], normals[72] = {0};
    uint16_t indices[36];
    char text[900], *path = malloc(300);
    int n = 0;
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2)
            for (int i = 0; i < 4; i++, n++) {
                at[3 * n + axis] = (float)(32767 * side);
                at[3 * n + (axis + 1) % 3] = (float)((i == 1 || i == 2 ? 32767 : -32767) * side);
                at[3 * n + (axis + 2) % 3] = i > 1 ? 32767 : -32767;
                normals[3 * n + axis] = (float)side;
            }
    for (int i = 0; i < 36; i++)
        indices[i] = (uint16_t)(4 * (i / 6) + (const int[]){0, 1, 2, 0, 2, 3}[i % 6]);
    snprintf(path, 300, "%s/tiny_%s.glb", gn_shot_build(), name);
    gn_maker_init(&maker);
    const int p = gn_maker_accessor(&maker, "VEC3", 5126, 24, at, sizeof at,
                                    "'min':[-32767,-32767,-32767],'max':[32767,32767,32767]");
    const int nn = gn_maker_accessor(&maker, "VEC3", 5126, 24, normals, sizeof normals, NULL);
    const int ii = gn_maker_accessor(&maker, "SCALAR", 5123, 36, indices, sizeof indices, NULL);
    snprintf(text, sizeof text,
             "[{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d},'indices':%d}]}]", p, nn,
             ii);
    gn_maker_set(&maker, "meshes", text);
    snprintf(text, sizeof text,
             "[{'type':'perspective','perspective':{'yfov':0.7,'znear':%g,'zfar':%g}}]", size,
             40 * size);
    gn_maker_set(&maker, "cameras", text);
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    const double one = size / 32767;
    snprintf(
        text, sizeof text,
        "[{'mesh':0,'translation':[0,%g,0],'scale':[%g,%g,%g],'rotation':[0,0.3826834,0,"
        "0.9238795]},{'mesh':0,'translation':[%g,%g,0],'scale':[%g,%g,%g]},"
        "{'mesh':0,'translation':[0,%g,0],'scale':[%g,%g,%g]},"
        "{'camera':0,'translation':[0,%g,%g],'rotation':[-0.2588190,0,0,0.9659258]},"
        "{'rotation':[-0.6,0.2,0,0.7745967],'extensions':{'KHR_lights_punctual':{'light':0}}}]",
        1.2 * size, one, one, one, 2 * size, size, -one * .5, one * .7, one * .5, -.1 * size,
        5 * one, one * .1, 5 * one, 6 * size, 8 * size);
    gn_maker_set(&maker, "nodes", text);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4]}]");
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static struct gn_picture shoot(const char *name, double size) {
    struct gn_picture shot;
    struct gn_err err = {0};
    char *path = write_scene(name, size);
    const char *const args[] = {"--size", "160x120", "--shadow", "none", NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    free(path);
    return shot;
}

static void test_a_model_looks_the_same_however_small(void **state) {
    (void)state;
    static const double sizes[] = {1e-3, 1e-5, 1e-6};
    struct gn_picture large = shoot("large", 1);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct gn_picture small = shoot("small", sizes[i]);
        int differ = 0, pixels = small.width_px * small.height_px;
        for (int k = 0; k < pixels; k++) {
            const float a = large.data[large.channels * k], b = small.data[small.channels * k];
            differ += !(a - b < .02f && b - a < .02f);
        }
        print_message("%g m: %d of %d pixels differ\n", sizes[i], differ, pixels);
        assert_true(differ < pixels / 200);
        gn_picture_finish(&small);
    }
    gn_picture_finish(&large);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_model_looks_the_same_however_small),
    };
    return RUN(tests);
}
