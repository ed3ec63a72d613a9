/* tool_tangents FOLDER: makes meshes, loads them as scenes with a normal map, and writes each as
 * FOLDER/NAME.bin: a count of corners (uint32), then by corner the position, normal, coordinates
 * and the tangent that was made at load, 12 floats. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/scene_help.h"

enum { SIDE = 24, ROW = SIDE + 1, POINTS = ROW * ROW, CORNERS = 6 * SIDE * SIDE };
struct mesh {
    float positions[POINTS][3], normals[POINTS][3], uv[POINTS][2];
    uint32_t corners[CORNERS];
};

/* The point at s, t of 0..1 of a lumpy sphere, or of a valley. */
static void place_point(double s, double t, bool sphere, float p[3]) {
    const double around = 2 * M_PI * s, down = M_PI * (0.05 + 0.9 * t);
    const double r = 1 + 0.15 * sin(3 * around) * sin(2 * down);
    p[0] = (float)(sphere ? r * sin(down) * cos(around) : 2 * s);
    p[1] = (float)(sphere ? r * cos(down) : 0.3 * sin(5 * s) * cos(4 * t));
    p[2] = (float)(sphere ? r * sin(down) * sin(around) : 2 * t);
}

/* Across the differences along s and t. */
static void make_normal(double s, double t, bool sphere, float n[3]) {
    const double h = 1e-3;
    float a[3], b[3], c[3], d[3];
    double u[3], v[3], length = 0;
    place_point(s - h, t, sphere, a);
    place_point(s + h, t, sphere, b);
    place_point(s, t - h, sphere, c);
    place_point(s, t + h, sphere, d);
    for (int k = 0; k < 3; k++)
        u[k] = (double)b[k] - (double)a[k], v[k] = (double)d[k] - (double)c[k];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (float)(v[i] * u[j] - v[j] * u[i]);
        length += (double)(n[k] * n[k]);
    }
    for (int k = 0; k < 3; k++) n[k] /= (float)sqrt(length);
}

static void make_grid(struct mesh *mesh, bool sphere) {
    uint32_t *to = mesh->corners;
    for (int i = 0; i < POINTS; i++) {
        const double s = (double)(i % ROW) / SIDE, t = (double)(i / ROW) / SIDE;
        place_point(s, t, sphere, mesh->positions[i]);
        make_normal(s, t, sphere, mesh->normals[i]);
        mesh->uv[i][0] = (float)(2 * s + 0.1 * t * t);
        mesh->uv[i][1] = (float)(t + 0.2 * s * s);
    }
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            const uint32_t a = y * ROW + x, b = a + 1, c = a + ROW, d = c + 1;
            const uint32_t quad[] = {a, b, c, b, d, c};
            memcpy(to, quad, sizeof quad);
            to += 6;
        }
}

/* The right half has the left one's picture, mirrored; a stripe has it upside down, too. */
static void mirror(struct mesh *mesh) {
    for (int i = 0; i < POINTS; i++) {
        if (i % ROW > SIDE / 2) mesh->uv[i][0] = mesh->uv[i - 2 * (i % ROW - SIDE / 2)][0];
        if (i / ROW > 2 * SIDE / 3) mesh->uv[i][1] = 1 - mesh->uv[i][1];
    }
}

/* Triangles without area, and without area in the picture. */
static void spoil(struct mesh *mesh) {
    for (int i = 0; i < CORNERS / 3; i++) {
        uint32_t *c = mesh->corners + 3 * (size_t)i;
        if (i % 19 == 5)
            memcpy(mesh->positions[c[1]], mesh->positions[c[0]], sizeof *mesh->positions);
        if (i % 23 == 7) memcpy(mesh->uv[c[2]], mesh->uv[c[0]], sizeof *mesh->uv);
    }
}

static struct gn_scene *load_mesh(const struct mesh *mesh) {
    static const uint8_t flat[] = {128, 128, 255, 255};
    char json[80];
    memset(&warnings, 0, sizeof warnings);
    gn_maker_init(&maker);
    struct gn_made png = gn_maker_png(1, 1, flat);
    snprintf(json, sizeof json, "[{'bufferView':%d}]", gn_maker_view(&maker, png.data, png.size));
    free(png.data);
    gn_maker_set(&maker, "images", json);
    gn_maker_set(&maker, "textures", "[{'source':0}]");
    gn_maker_set(&maker, "materials", "[{'normalTexture':{'index':0}}]");
    gn_maker_accessor(&maker, "VEC3", 5126, POINTS, mesh->positions, sizeof mesh->positions, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, POINTS, mesh->normals, sizeof mesh->normals, NULL);
    gn_maker_accessor(&maker, "VEC2", 5126, POINTS, mesh->uv, sizeof mesh->uv, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5125, CORNERS, mesh->corners, sizeof mesh->corners, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1,'TEXCOORD_0':2},"
                 "'indices':3,'material':0}]}]");
    gn_maker_set(&maker, "nodes", "[{'mesh':0}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0]}]");
    return gn_maker_load(&maker, &warnings, &err);
}

static bool write_mesh(const char *folder, const char *name, const struct mesh *mesh) {
    char path[1000];
    struct gn_scene *scene = load_mesh(mesh);
    if (!scene || scene->geometries[0].index_count != CORNERS || !scene->buffers.tangents) {
        fprintf(stderr, "tool_tangents: %s: %s\n", name, scene ? "no tangents" : err.text);
        return false;
    }
    snprintf(path, sizeof path, "%s/%s.bin", folder, name);
    FILE *file = fopen(path, "wb");
    const uint32_t count = CORNERS;
    bool ok = file && fwrite(&count, 4, 1, file) == 1;
    for (uint32_t i = 0; i < CORNERS && ok; i++) {
        const uint32_t v = mesh->corners[i];
        ok = fwrite(mesh->positions[v], 4, 3, file) == 3 &&
             fwrite(mesh->normals[v], 4, 3, file) == 3 && fwrite(mesh->uv[v], 4, 2, file) == 2 &&
             fwrite(scene->buffers.tangents + 4 * (size_t)scene->buffers.indices[i], 4, 4, file) ==
                 4;
    }
    gn_scene_destroy(scene);
    return file && fclose(file) == 0 && ok;
}

int main(int argc, char **argv) {
    static struct mesh mesh;
    if (argc != 2) return 2;
    make_grid(&mesh, true);
    bool ok = write_mesh(argv[1], "sphere", &mesh);
    mirror(&mesh);
    ok &= write_mesh(argv[1], "mirrored", &mesh);
    make_grid(&mesh, false);
    mirror(&mesh);
    spoil(&mesh);
    ok &= write_mesh(argv[1], "degenerate", &mesh);
    return !ok;
}
