/* Small models of each format that ask for much, through gnomon-import into a scene: shown, or
 * refused by one line that says what to do, within 1.2 times memory_mb in all processes together
 * and 10 s of processor time. Skipped (77) where that program was not built. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/child.h"
#include "core/memory.h"
#include "fuzz/bomb_pictures.h"
#include "import_help.h"
#include "stage/stage.h"
#include "tree_memory.h"
#include "unit/gltf_maker.h"

enum { MEMORY_MB = 128, MOST_S = 10 };

struct report { /* shared with the process that imports */
    bool shown;
    struct gn_err err;
};

static void import_in_child(const char *name, struct report *report) {
    const struct gn_scene_limits limits = {.memory_mb = MEMORY_MB};
    struct gn_warnings warnings = {0};
    struct gn_scene *scene =
        gn_stage_read(help_import_path(name), &limits, &warnings, &report->err);
    report->shown = scene;
    _exit(0);
}

/* Shown, or refused with `why`; NULL: either. */
static void try_bomb(const char *name, bool shown, const char *why) {
    struct gn_err err = {0};
    struct report *report = gn_child_share(sizeof *report, &err);
    assert_non_null(report);
    const int64_t before_kb = gn_tree_memory_kb(getpid());
    const pid_t pid = fork();
    if (pid == 0) import_in_child(name, report);
    struct rusage usage = {0};
    int64_t most_kb = 0;
    int status = -1;
    while (wait4(pid, &status, WNOHANG, &usage) == 0) {
        const int64_t kb = gn_tree_memory_kb(pid);
        if (kb > most_kb) most_kb = kb;
        usleep(2000);
    }
    const double took_s = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                          1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    most_kb -= before_kb;
    printf("%-14s %4d MB, %4.1f s, %s\n", name, (int)(most_kb / 1024), took_s,
           report->shown ? "shown" : report->err.text);
    assert_int_equal(status, 0);
    if (most_kb > MEMORY_MB * 1024 * 12 / 10)
        fail_msg("%s takes %d MB", name, (int)(most_kb / 1024));
    if (took_s > MOST_S) fail_msg("%s takes %.1f s", name, took_s);
    assert_int_equal(report->shown, shown);
    if (why && !strstr(report->err.text, why)) fail_msg("%s: %s", name, report->err.text);
    if (!shown) assert_null(strchr(report->err.text, '\n'));
    gn_child_unshare(report, sizeof *report);
}

static void try_large(const char *name) {
    try_bomb(name, false, "needs more than 128 MB of memory; raise the limit: gnomon --limit");
}

static FILE *begin_file(const char *name) {
    FILE *file = fopen(help_import_path(name), "w");
    assert_non_null(file);
    return file;
}

/* ---- nodes and instances ---- */

/* A node for each level, which instantiates the one below so many times. */
static void put_collada(const char *name, int levels, int times, const char *leaf) {
    FILE *file = begin_file(name);
    fputs("<?xml version=\"1.0\"?><COLLADA "
          "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>"
          "<unit meter=\"1\"/><up_axis>Y_UP</up_axis></asset><library_geometries>"
          "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"9\">0 0 0 1 0 0 "
          "0 1 0</float_array><technique_common><accessor source=\"#a\" count=\"3\" stride=\"3\">"
          "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
          "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
          "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
          "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
          "<p>0 1 2</p></triangles></mesh></geometry></library_geometries><library_nodes>",
          file);
    for (int i = 0; i < levels; i++) {
        fprintf(file, "<node id=\"n%d\">", i);
        for (int k = 0; k < times && i > 0; k++)
            fprintf(file, "<instance_node url=\"#n%d\"/>", i - 1);
        fputs(i == 0 ? leaf : "", file);
        fputs("</node>", file);
    }
    fprintf(file,
            "</library_nodes><library_visual_scenes><visual_scene id=\"s\"><node id=\"r\">"
            "<instance_node url=\"#n%d\"/></node></visual_scene></library_visual_scenes><scene>"
            "<instance_visual_scene url=\"#s\"/></scene></COLLADA>",
            levels - 1);
    fclose(file);
}

static void test_nested_nodes_of_collada(void **state) {
    static const char leaf[] = "<instance_geometry url=\"#g\"/>";
    char many[20 * sizeof leaf] = "";
    (void)state;
    for (size_t i = 0; i < 20; i++) memcpy(many + i * (sizeof leaf - 1), leaf, sizeof leaf);
    put_collada("ten.dae", 8, 10, leaf);
    put_collada("two.dae", 25, 2, leaf);
    put_collada("empty.dae", 8, 10, "");
    put_collada("meshes.dae", 6, 10, many);
    try_large("ten.dae");
    try_large("two.dae");
    try_large("empty.dae");
    try_large("meshes.dae");
    put_collada("few.dae", 3, 10, leaf);
    try_bomb("few.dae", true, NULL);
}

/* Each model is the child of both models above it: 2^24 in all. */
static void test_models_of_fbx_with_several_parents(void **state) {
    enum { LEVELS = 24 };
    (void)state;
    FILE *file = begin_file("dag.fbx");
    fputs("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n"
          "\tFBXVersion: 7400\n}\nGlobalSettings:  {\n\tVersion: 1000\n}\nDocuments:  {\n\tCount: "
          "1\n}\nDefinitions:  {\n\tVersion: 100\n}\nObjects:  {\n\tGeometry: 10, "
          "\"Geometry::g\", \"Mesh\" {\n\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
          "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n",
          file);
    for (int i = 0; i < 2 * LEVELS; i++)
        fprintf(file, "\tModel: %d, \"Model::m\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n", 100 + i);
    fputs("}\nConnections:  {\n", file);
    fprintf(file, "\tC: \"OO\",10,%d\n\tC: \"OO\",100,0\n\tC: \"OO\",101,0\n", 98 + 2 * LEVELS);
    for (int i = 2; i < 2 * LEVELS; i++)
        for (int k = 0; k < 2; k++)
            fprintf(file, "\tC: \"OO\",%d,%d\n", 100 + i, 98 + i / 2 * 2 + k);
    fputs("}\n", file);
    fclose(file);
    try_large("dag.fbx");
}

/* ---- faces ---- */

static void test_faces_of_obj(void **state) {
    enum { FACES = 600000, CORNERS = 60000 };
    (void)state;
    FILE *file = begin_file("faces.obj");
    fputs("v 0 0 0\nv 1 0 0\nv 0 1 0\n", file);
    for (int i = 0; i < FACES; i++) fputs("f 1 2 3\n", file);
    fclose(file);
    try_large("faces.obj");
    file = begin_file("star.obj"); /* assimp's time grows with the square of a polygon's corners */
    for (int i = 0; i < CORNERS; i++)
        fprintf(file, "v %d %d 0\n", (int)(999 * cos(i * 1e-4) * (1 + i % 2)),
                (int)(999 * sin(i * 1e-4) * (1 + i % 2)));
    fputs("f", file);
    for (int i = 1; i <= CORNERS; i++) fprintf(file, " %d", i);
    fclose(file);
    try_bomb("star.obj", false, "s; raise the limit: gnomon --limit seconds=N");
}

static void test_numbers_of_ply_that_nothing_follows(void **state) {
    static const char *const elements[][3] = {
        {"4000000000", "1", "uchar"}, {"3", "4000000000", "uchar"}, {"3", "1", "uint"}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex %s\nproperty float x\nproperty float y\n"
                 "property float z\nelement face %s\nproperty list %s int vertex_indices\n"
                 "end_header\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n",
                 elements[i][0], elements[i][1], elements[i][2]);
        help_import_put("claim.ply", text);
        try_bomb("claim.ply", false, "claim.ply: ");
    }
}

/* ---- pictures ---- */

/* 64 million texels each, in .3 MB: of all, as many are decoded as of ten. */
static void test_pictures_of_obj(void **state) {
    enum { PICTURES = 24 };
    (void)state;
    const struct gn_bomb_png png = {.width_px = 8192, .height_px = 8192, .depth = 32};
    struct gn_made made = gn_bomb_png_make(&png);
    FILE *model = begin_file("clear.obj"), *materials = begin_file("clear.mtl");
    fputs("mtllib clear.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n", model);
    for (int i = 0; i < PICTURES; i++) {
        char name[20];
        snprintf(name, sizeof name, "p%d.png", i);
        help_import_put_bytes(name, made.data, made.size);
        fprintf(model, "usemtl m%d\nf 1/1 2/2 3/3\n", i);
        fprintf(materials, "newmtl m%d\nKd 1 1 1\nmap_Kd p%d.png\n", i, i);
        if (i < 2) fprintf(materials, "map_d p%d.png\n", PICTURES - 1); /* both become one */
    }
    fclose(model);
    fclose(materials);
    free(made.data);
    try_bomb("clear.obj", true, NULL);
}

/* ---- glTF ---- */

/* A file that is there once and named by each buffer. */
static void test_buffers_of_one_file(void **state) {
    enum { BYTES = 4000000, BUFFERS = 200 };
    (void)state;
    char *zeros = calloc(1, BYTES);
    help_import_put_bytes("zeros.bin", zeros, BYTES);
    free(zeros);
    FILE *file = begin_file("buffers.gltf");
    fputs("{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_draco_mesh_compression\"],"
          "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"buffers\":[",
          file);
    for (int i = 0; i < BUFFERS; i++)
        fprintf(file, "%s{\"uri\":\"zeros.bin\",\"byteLength\":%d}", i ? "," : "", BYTES);
    fputs("]}", file);
    fclose(file);
    try_large("buffers.gltf");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nested_nodes_of_collada),
        cmocka_unit_test(test_models_of_fbx_with_several_parents),
        cmocka_unit_test(test_faces_of_obj),
        cmocka_unit_test(test_numbers_of_ply_that_nothing_follows),
        cmocka_unit_test(test_pictures_of_obj),
        cmocka_unit_test(test_buffers_of_one_file),
    };
    if (!GN_LIMITS_MEMORY) {
        puts("a sanitizer: memory has no limit");
        return 77;
    }
    return help_import_run(tests, sizeof tests / sizeof *tests);
}
