/* A band of a sphere with a normal map made from a finer, embossed one, against that one: what the
 * map leaves of the difference to the smooth band. Also mirrored, by its node and by its picture's
 * coordinates. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { COARSE = 96, FINE = 768, MAP_WIDTH = 2048, MAP_HEIGHT = 512 };
static const double HEIGHT = 0.004, TOP = 1.1; /* of the bumps; the band's latitude, radians */

struct band {
    int columns; /* around; the rows are a quarter */
    bool embossed, mapped;
    bool folded;      /* u runs there and back: half of the picture, mirrored */
    const char *node; /* more keys */
};

/* Radius at u, v of 0..1; symmetric about u = 1/2, so that half of the map is enough. */
static double radius_at(double u, double v) {
    return 1 + HEIGHT * cos(2 * M_PI * 24 * u) * sin(2 * M_PI * 8 * v);
}

static void point_at(double u, double v, bool embossed, double p[3]) {
    const double around = 2 * M_PI * u, up = TOP * (1 - 2 * v);
    const double r = embossed ? radius_at(u, v) : 1;
    p[0] = r * cos(up) * sin(around);
    p[1] = r * sin(up);
    p[2] = r * cos(up) * cos(around);
}

/* Outward, by differences. */
static void normal_at(double u, double v, bool embossed, double n[3]) {
    const double h = 1e-5;
    double a[3], b[3], c[3], d[3], s[3], t[3];
    point_at(u - h, v, embossed, a);
    point_at(u + h, v, embossed, b);
    point_at(u, v - h, embossed, c);
    point_at(u, v + h, embossed, d);
    for (int k = 0; k < 3; k++) {
        s[k] = b[k] - a[k];
        t[k] = c[k] - d[k]; /* upwards */
    }
    n[0] = s[1] * t[2] - s[2] * t[1];
    n[1] = s[2] * t[0] - s[0] * t[2];
    n[2] = s[0] * t[1] - s[1] * t[0];
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) n[k] /= length;
}

static struct gn_made make_map(bool folded) {
    uint8_t *rgba = malloc(4ul * MAP_WIDTH * MAP_HEIGHT);
    assert_non_null(rgba);
    for (int y = 0; y < MAP_HEIGHT; y++)
        for (int x = 0; x < MAP_WIDTH; x++) {
            const double u = (x + .5) / MAP_WIDTH * (folded ? .5 : 1), v = (y + .5) / MAP_HEIGHT;
            const double around = 2 * M_PI * u;
            double n[3], up[3], m[3];
            const double along[3] = {cos(around), 0, -sin(around)};
            normal_at(u, v, false, up);
            normal_at(u, v, true, n);
            const double across[3] = {up[1] * along[2] - up[2] * along[1],
                                      up[2] * along[0] - up[0] * along[2],
                                      up[0] * along[1] - up[1] * along[0]};
            m[0] = n[0] * along[0] + n[1] * along[1] + n[2] * along[2];
            m[1] = n[0] * across[0] + n[1] * across[1] + n[2] * across[2];
            m[2] = n[0] * up[0] + n[1] * up[1] + n[2] * up[2];
            uint8_t *texel = rgba + 4ul * (size_t)(y * MAP_WIDTH + x);
            for (int k = 0; k < 3; k++) texel[k] = (uint8_t)lrint((m[k] * .5 + .5) * 255);
            texel[3] = 255;
        }
    struct gn_made png = gn_maker_png(MAP_WIDTH, MAP_HEIGHT, rgba);
    free(rgba);
    return png;
}

static void add_band(struct gn_maker *maker, const struct band *band) {
    const int columns = band->columns, rows = columns / 4, width = columns + 1;
    const size_t vertices = (size_t)width * (size_t)(rows + 1);
    float *p = calloc(3 * vertices, sizeof *p), *n = calloc(3 * vertices, sizeof *n);
    float *uv = calloc(2 * vertices, sizeof *uv);
    uint32_t *corners = calloc(6ul * (size_t)(columns * rows), sizeof *corners), *c = corners;
    for (int y = 0; y <= rows; y++)
        for (int x = 0; x <= columns; x++) {
            const size_t i = (size_t)(y * width + x);
            const double u = (double)x / columns, v = (double)y / rows;
            double point[3], normal[3];
            point_at(u, v, band->embossed, point);
            normal_at(u, v, band->embossed, normal);
            for (int k = 0; k < 3; k++) {
                p[3 * i + (size_t)k] = (float)point[k];
                n[3 * i + (size_t)k] = (float)normal[k];
            }
            uv[2 * i] = (float)(band->folded ? 1 - fabs(1 - 2 * u) : u);
            uv[2 * i + 1] = (float)v;
        }
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < columns; x++) {
            const uint32_t a = (uint32_t)(y * width + x), b = a + (uint32_t)width;
            const uint32_t quad[] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(c, quad, sizeof quad);
            c += 6;
        }
    gn_maker_accessor(maker, "VEC3", 5126, vertices, p, 12 * vertices, NULL);
    gn_maker_accessor(maker, "VEC3", 5126, vertices, n, 12 * vertices, NULL);
    gn_maker_accessor(maker, "VEC2", 5126, vertices, uv, 8 * vertices, NULL);
    gn_maker_accessor(maker, "SCALAR", 5125, (size_t)(c - corners), corners,
                      sizeof *corners * (size_t)(c - corners), NULL);
    free(p);
    free(n);
    free(uv);
    free(corners);
    gn_maker_set(maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1,'TEXCOORD_0':2},"
                 "'indices':3,'material':0}]}]");
}

static struct gn_picture draw(const struct band *band) {
    struct gn_maker maker;
    struct gn_picture picture;
    struct gn_err err = {0};
    char path[300], node[200];
    gn_maker_init(&maker);
    add_band(&maker, band);
    if (band->mapped) {
        char json[80];
        struct gn_made png = make_map(band->folded);
        snprintf(json, sizeof json, "[{'bufferView':%d}]",
                 gn_maker_view(&maker, png.data, png.size));
        free(png.data);
        gn_maker_set(&maker, "images", json);
        gn_maker_set(&maker, "textures", "[{'source':0}]");
    }
    snprintf(node, sizeof node, "{'mesh':0%s}", band->node ? band->node : "");
    gn_maker_add(&maker, "nodes", node);
    gn_maker_add(&maker, "nodes", "{'camera':0,'translation':[0,0,4]}");
    gn_maker_add(&maker, "nodes",
                 "{'rotation':[-0.35,0.42,0.1,0.83],'extensions':{'KHR_lights_punctual':"
                 "{'light':0}}}");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.5,'znear':1,'zfar':9}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    gn_maker_set(&maker, "materials",
                 band->mapped ? "[{'normalTexture':{'index':0},'pbrMetallicRoughness':"
                                "{'roughnessFactor':0.5,'metallicFactor':0}}]"
                              : "[{'pbrMetallicRoughness':{'roughnessFactor':0.5,"
                                "'metallicFactor':0}}]");
    snprintf(path, sizeof path, "%s/normal-map-%d.glb", gn_shot_build(), (int)getpid());
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    const char *const args[] = {"--size", "400x400", "--shadow", "none", "--msaa", "0", NULL};
    const bool drawn = gn_shot(&picture, NULL, &err, "pfm", path, args);
    unlink(path);
    if (!drawn) fail_msg("%s", err.text);
    return picture;
}

/* Mean difference over what both show of the band, away from its outline. */
static double difference(const struct gn_picture *a, const struct gn_picture *b) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < a->height_px; y++)
        for (int x = 0; x < a->width_px; x++) {
            const double dx = x - 199.5, dy = y - 199.5;
            if (dx * dx + dy * dy > 150 * 150) continue;
            for (int k = 0; k < 3; k++)
                sum += fabs((double)gn_picture_at(a, x, y)[k] - (double)gn_picture_at(b, x, y)[k]);
            count += 3;
        }
    return sum / count;
}

/* Of the difference that the bumps make, at most so much is left. */
static void check(bool folded, const char *node) {
    const struct band smooth = {.columns = COARSE, .node = node};
    const struct band mapped = {.columns = COARSE, .mapped = true, .folded = folded, .node = node};
    const struct band fine = {.columns = FINE, .embossed = true, .node = node};
    struct gn_picture s = draw(&smooth), m = draw(&mapped), f = draw(&fine);
    const double bumps = difference(&s, &f), left = difference(&m, &f);
    print_message("%s%s: bumps %.4f, left %.4f (%.1f %%)\n", folded ? "folded" : "plain",
                  node ? node : "", bumps, left, 100 * left / bumps);
    assert_true(bumps > 0.03);
    assert_true(left < 0.12 * bumps);
    gn_picture_finish(&s);
    gn_picture_finish(&m);
    gn_picture_finish(&f);
}

static void test_a_map_of_a_finer_sphere(void **state) {
    (void)state;
    check(false, NULL);
}

static void test_a_mirrored_map(void **state) {
    (void)state;
    check(true, ",'rotation':[0,1,0,0]"); /* its fold faces the camera */
}

static void test_a_mirrored_node(void **state) {
    (void)state;
    check(false, ",'scale':[-1,1,1]");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_map_of_a_finer_sphere),
        cmocka_unit_test(test_a_mirrored_map),
        cmocka_unit_test(test_a_mirrored_node),
    };
    return RUN(tests);
}
