/* Scenes 100 km from the origin of their file: within the limits of the origin against truth, and
 * the picture of the origin, without shadows, within 2 codes where the file itself has lost
 * nothing. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/file.h"
#include "image/shot.h"
#include "image/table.h"
#include "scene/scene.h"

#define AWAY_M 100000.0                         /* along x and z */
#define MORE   0.02                             /* per cent of the pixels; .8 % of acne before */
static const int SCENES[] = {1, 8, 13, 25, 31}; /* sun, spots, a point light, a smooth mesh */
enum { SCENE_COUNT = sizeof SCENES / sizeof *SCENES };

enum how { BY_ROOT, BY_NODES, BY_CHAIN, BY_VERTICES, WAYS };
static const char *const names[WAYS] = {"root", "nodes", "chain", "vertices"};

struct model {
    json_t *root;
    uint8_t *bin;
    uint32_t bin_size;
};

static bool read_model(struct model *m, const char *path, struct gn_err *err) {
    struct gn_bytes file;
    uint32_t size;
    if (!gn_file_read(path, 0, &file, err)) return false;
    const uint8_t *data = file.data;
    memcpy(&size, data + 12, 4);
    m->root = json_loadb((const char *)data + 20, size, 0, NULL);
    memcpy(&m->bin_size, data + 20 + size, 4);
    m->bin = malloc(m->bin_size);
    if (!m->bin) abort();
    memcpy(m->bin, data + 28 + size, m->bin_size);
    gn_bytes_finish(&file);
    return m->root != NULL;
}

static bool write_model(struct model *m, const char *path) {
    char *text = json_dumps(m->root, JSON_COMPACT | JSON_REAL_PRECISION(17));
    const uint32_t length = (uint32_t)strlen(text), padded = (length + 3) / 4 * 4;
    const uint32_t head[] = {0x46546c67, 2, 28 + padded + m->bin_size, padded, 0x4e4f534a};
    const uint32_t bin_head[] = {m->bin_size, 0x004e4942};
    FILE *f = fopen(path, "wb");
    if (!f) return false;
    fwrite(head, sizeof head, 1, f);
    fprintf(f, "%s%.*s", text, (int)(padded - length), "   ");
    fwrite(bin_head, sizeof bin_head, 1, f);
    fwrite(m->bin, m->bin_size, 1, f);
    free(text);
    free(m->bin);
    json_decref(m->root);
    return fclose(f) == 0;
}

static json_t *translation(double x, double y, double z) { return json_pack("[f,f,f]", x, y, z); }

static void move_node(json_t *node, double by) {
    double at[3] = {0};
    const json_t *old = json_object_get(node, "translation");
    for (size_t k = 0; k < 3; k++) at[k] = json_number_value(json_array_get(old, k));
    json_object_set_new(node, "translation", translation(at[0] + by, at[1], at[2] + by));
}

/* All roots under a new one. */
static void add_root(struct model *m, json_t *node) {
    json_t *nodes = json_object_get(m->root, "nodes");
    json_t *scene = json_array_get(json_object_get(m->root, "scenes"), 0);
    json_object_set(node, "children", json_object_get(scene, "nodes"));
    json_object_set_new(scene, "nodes", json_pack("[i]", (int)json_array_size(nodes)));
    json_array_append_new(nodes, node);
}

/* v turned back by a rotation: xyzw, the inverse. */
static void turn_back(const double q[4], double v[3]) {
    const double u[3] = {-q[0], -q[1], -q[2]};
    double t[3], s[3];
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        t[k] = 2 * (u[a] * v[b] - u[b] * v[a]);
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        s[k] = v[k] + q[3] * t[k] + (u[a] * t[b] - u[b] * t[a]);
    }
    memcpy(v, s, sizeof s);
}

/* The positions of a node's mesh, so that they stand 100 km off in the world. */
static void move_vertices(struct model *m, json_t *node) {
    const json_t *mesh = json_array_get(json_object_get(m->root, "meshes"),
                                        (size_t)json_number_value(json_object_get(node, "mesh")));
    double q[4] = {0, 0, 0, 1}, by[3] = {AWAY_M, 0, AWAY_M};
    const json_t *rotation = json_object_get(node, "rotation"), *primitive;
    for (size_t k = 0; k < json_array_size(rotation); k++)
        q[k] = json_number_value(json_array_get(rotation, k));
    turn_back(q, by);
    size_t i;
    json_array_foreach(json_object_get(mesh, "primitives"), i, primitive) {
        const json_t *index = json_object_get(json_object_get(primitive, "attributes"), "POSITION");
        json_t *a =
            json_array_get(json_object_get(m->root, "accessors"), (size_t)json_number_value(index));
        const json_t *view =
            json_array_get(json_object_get(m->root, "bufferViews"),
                           (size_t)json_number_value(json_object_get(a, "bufferView")));
        uint8_t *at = m->bin + (size_t)json_number_value(json_object_get(view, "byteOffset"));
        const size_t count = (size_t)json_number_value(json_object_get(a, "count"));
        json_object_del(a, "min");
        json_object_del(a, "max");
        for (size_t k = 0; k < 3 * count; k++) {
            float x;
            memcpy(&x, at + 4 * k, 4);
            x = (float)((double)x + by[k % 3]);
            memcpy(at + 4 * k, &x, 4);
        }
    }
}

static void move_model(struct model *m, enum how how) {
    json_t *node, *nodes = json_object_get(m->root, "nodes");
    size_t i;
    if (how == BY_ROOT)
        add_root(m, json_pack("{so}", "translation", translation(AWAY_M, 0, AWAY_M)));
    else if (how == BY_CHAIN) { /* back again: a root far off, its children as far from it */
        json_array_foreach(nodes, i, node) move_node(node, -AWAY_M);
        add_root(m, json_pack("{so}", "translation", translation(AWAY_M, 0, AWAY_M)));
    } else
        json_array_foreach(nodes, i, node) {
            if (how == BY_VERTICES && json_object_get(node, "mesh"))
                move_vertices(m, node);
            else
                move_node(node, AWAY_M);
        }
}

static bool make_scene(const char *from, const char *folder, int number, enum how how,
                       struct gn_err *err) {
    struct model m;
    char path[700];
    snprintf(path, sizeof path, "%s/truth-%02d.glb", from, number);
    if (!read_model(&m, path, err)) return false;
    move_model(&m, how);
    snprintf(path, sizeof path, "%s/truth-%02d.glb", folder, number);
    return write_model(&m, path) || gn_fail(err, "%s cannot be written", path);
}

static const char *const techniques[] = {"hard", "pcf", "cone"};
enum { ROWS = sizeof techniques / sizeof *techniques };

static void measure_faults(struct gn_table *table, const char *folder, const char *title) {
    *table = (struct gn_table){.folder = folder, .title = title};
    for (int i = 0; i < SCENE_COUNT; i++) table->scenes[SCENES[i]] = true;
    for (int i = 0; i < ROWS; i++)
        gn_table_add(table, techniques[i], i < 2 ? "depth" : "auto", 1024);
    gn_table_run(table);
    gn_table_print(table, stdout);
}

/* Faults that are more than at the origin: the grids of the maps lie otherwise, no more. */
static int count_worse(const struct gn_table *near, const struct gn_table *far, double more) {
    int wrong = far->failures;
    for (int i = 0; i < ROWS; i++)
        for (int fault = 0; fault < GN_FAULT_COUNT; fault++) {
            const double at = gn_table_sum(&near->rows[i], (enum gn_fault)fault).mean;
            const double away = gn_table_sum(&far->rows[i], (enum gn_fault)fault).mean;
            if (away <= at + more) continue;
            printf("%s, fault %d: %.4f %%, at the origin %.4f %%\n", techniques[i], fault, away,
                   at);
            wrong++;
        }
    return wrong;
}

/* Largest difference in codes, and how many channels differ by over 2. */
static bool compare_shots(const char *near, const char *far, double *most, size_t *over,
                          struct gn_err *err) {
    static const char *const args[] = {"--size", "320x240", "--shadow", "none", NULL};
    struct gn_picture a = {0}, b = {0};
    *most = 0;
    *over = 0;
    const bool ok =
        gn_shot(&a, NULL, err, "png", near, args) && gn_shot(&b, NULL, err, "png", far, args);
    for (int i = 0; ok && i < a.width_px * a.height_px * a.channels; i++) {
        const double d = fabs((double)a.data[i] - (double)b.data[i]) * 255;
        *most = fmax(*most, d);
        *over += d > 2.5;
    }
    gn_picture_finish(&a);
    gn_picture_finish(&b);
    return ok;
}

static int check_pictures(const char *from, const char *folder, enum how how) {
    int wrong = 0;
    for (int i = 0; i < SCENE_COUNT; i++) {
        char near[700], far[700];
        double most;
        size_t over;
        struct gn_err err = {0};
        snprintf(near, sizeof near, "%s/truth-%02d.glb", from, SCENES[i]);
        snprintf(far, sizeof far, "%s/truth-%02d.glb", folder, SCENES[i]);
        if (!compare_shots(near, far, &most, &over, &err)) {
            printf("%s\n", err.text);
            wrong++;
            continue;
        }
        printf("%s %02d: picture differs by %.0f codes, %zu channels by over 2\n", names[how],
               SCENES[i], most, over);
        wrong += over > 0;
    }
    return wrong;
}

/* What is said in the file's coordinates is met there: a target and a floor. */
static int check_coordinates(const char *near, const char *far) {
    static const char *const here[] = {
        "--camera-target", "0,0.5,0", "--camera-distance", "6", "--floor", "-1", NULL};
    static const char *const there[] = {
        "--camera-target", "100000,0.5,100000", "--camera-distance", "6", "--floor", "-1", NULL};
    struct gn_picture a = {0}, b = {0};
    struct gn_err err = {0};
    size_t over = 0;
    bool ok =
        gn_shot(&a, NULL, &err, "png", near, here) && gn_shot(&b, NULL, &err, "png", far, there);
    if (!ok) printf("%s\n", err.text);
    for (int i = 0; ok && i < a.width_px * a.height_px * a.channels; i++)
        over += fabs((double)a.data[i] - (double)b.data[i]) * 255 > 2.5;
    if (over > 0) printf("a target and a floor in the file's coordinates: %zu differ\n", over);
    gn_picture_finish(&a);
    gn_picture_finish(&b);
    return !ok || over > 0;
}

int main(void) {
    struct gn_err err = {0};
    static struct gn_table near_faults, far_faults;
    int wrong = 0;
    char *from = gn_table_scenes(false, &err), folder[WAYS][600];
    if (from) measure_faults(&near_faults, from, "origin");
    for (int how = 0; from && how < WAYS; how++) {
        snprintf(folder[how], sizeof folder[how], "%s/far-%s", gn_shot_build(), names[how]);
        mkdir(folder[how], 0777);
        for (int i = 0; i < SCENE_COUNT; i++)
            if (!make_scene(from, folder[how], SCENES[i], (enum how)how, &err)) wrong++;
        if (wrong) break;
        measure_faults(&far_faults, folder[how], names[how]);
        /* positions that the file itself has 100 km off lie on a grid of 8 mm */
        wrong += count_worse(&near_faults, &far_faults, how == BY_VERTICES ? .06 : MORE);
        if (how != BY_VERTICES) wrong += check_pictures(from, folder[how], (enum how)how);
    }
    if (!from || err.text[0]) {
        printf("%s\n", err.text);
        return 1;
    }
    char near[700], far[700];
    snprintf(near, sizeof near, "%s/truth-01.glb", from);
    snprintf(far, sizeof far, "%s/truth-01.glb", folder[BY_ROOT]);
    wrong += check_coordinates(near, far);
    free(from);
    return wrong ? 1 : 0;
}
