#include "image/large.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/gltf_maker.h"

/* A wavy square grid of side x side cells as the next mesh. */
static void add_mesh(struct gn_maker *maker, uint32_t side, int material) {
    const size_t across = side + 1, vertices = across * across, corners = 6ul * side * side;
    float *position = malloc(vertices * 12), *normal = malloc(vertices * 12),
          *uv = malloc(vertices * 8);
    uint32_t *index = malloc(corners * 4), *to = index;
    char json[300], min_max[100];
    if (!position || !normal || !uv || !index) abort();
    for (size_t i = 0; i < vertices; i++) {
        const float u = (float)(i % across) / (float)side, v = (float)(i / across) / (float)side;
        const float p[] = {u - 0.5f, 0.05f * sinf(40 * u) * cosf(30 * v), v - 0.5f};
        for (int k = 0; k < 3; k++) {
            position[3 * i + (size_t)k] = p[k];
            normal[3 * i + (size_t)k] = k == 1;
        }
        uv[2 * i] = u;
        uv[2 * i + 1] = v;
    }
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++) {
            const uint32_t a = y * (side + 1) + x, b = a + side + 1;
            const uint32_t two[] = {a, b, a + 1, a + 1, b, b + 1};
            for (int k = 0; k < 6; k++) *to++ = two[k];
        }
    snprintf(min_max, sizeof min_max, "'min':[-0.5,-0.05,-0.5],'max':[0.5,0.05,0.5]");
    const int p = gn_maker_accessor(maker, "VEC3", 5126, vertices, position, vertices * 12,
                                    min_max),
              n = gn_maker_accessor(maker, "VEC3", 5126, vertices, normal, vertices * 12, NULL),
              t = gn_maker_accessor(maker, "VEC2", 5126, vertices, uv, vertices * 8, NULL),
              i = gn_maker_accessor(maker, "SCALAR", 5125, corners, index, corners * 4, NULL);
    snprintf(json, sizeof json,
             "{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d,'TEXCOORD_0':%d},"
             "'indices':%d%s%d}]}",
             p, n, t, i, material < 0 ? ",'mode':" : ",'material':", material < 0 ? 4 : material);
    gn_maker_add(maker, "meshes", json);
    free(position);
    free(normal);
    free(uv);
    free(index);
}

/* A material with a picture of noise, which PNG cannot make small. */
static void add_material(struct gn_maker *maker, uint32_t px) {
    uint8_t *rgba = malloc(4ul * px * px);
    char json[120];
    if (!rgba) abort();
    for (size_t i = 0; i < 4ul * px * px; i++) rgba[i] = i % 4 == 3 ? 255 : (uint8_t)rand();
    struct gn_made png = gn_maker_png(px, px, rgba);
    snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/png'}",
             gn_maker_view(maker, png.data, png.size));
    const int image = gn_maker_add(maker, "images", json);
    snprintf(json, sizeof json, "{'source':%d}", image);
    const int texture = gn_maker_add(maker, "textures", json);
    snprintf(json, sizeof json, "{'pbrMetallicRoughness':{'baseColorTexture':{'index':%d}}}",
             texture);
    gn_maker_add(maker, "materials", json);
    free(png.data);
    free(rgba);
}

bool gn_large_write(const struct gn_large *large, const char *path, struct gn_err *err) {
    struct gn_maker maker;
    const uint32_t rows = (uint32_t)ceil(sqrt((double)large->nodes));
    const uint32_t side = (uint32_t)ceil(sqrt((double)large->triangles / large->nodes / 2));
    char json[200], *list = malloc(large->nodes * 8ul + 30), *to = list;
    if (!list) abort();
    srand(1);
    gn_maker_init(&maker);
    for (uint32_t i = 0; i < large->textures; i++) add_material(&maker, large->texture_px);
    to += sprintf(to, "[{'nodes':[");
    for (uint32_t i = 0; i < large->nodes; i++) {
        add_mesh(&maker, side, large->textures ? (int)(i % large->textures) : -1);
        snprintf(json, sizeof json, "{'mesh':%u,'translation':[%g,0,%g]}", i,
                 1.1 * (i % rows) - 0.55 * rows, 1.1 * (i / rows) - 0.55 * rows);
        gn_maker_add(&maker, "nodes", json);
        to += sprintf(to, "%s%u", i ? "," : "", i);
    }
    sprintf(to, "]}]");
    gn_maker_set(&maker, "scenes", list);
    free(list);
    return gn_maker_write(&maker, path, err);
}
