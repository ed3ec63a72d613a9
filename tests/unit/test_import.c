/* OBJ models, written here, through gnomon-import into a scene, and what is refused. Skipped (77)
 * where that program was not built. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "gltf_maker.h"
#include "import_help.h"
#include "stage/import.h"

/* ---- OBJ ---- */

#define SQUARE_OBJ                                                                                 \
    "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"           \
    "usemtl m\nf 1/1 2/2 3/3 4/4\n"

static void test_a_square_of_an_obj_stands_upright_with_its_picture(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ);
    help_import_put("a.mtl", "newmtl m\nKd 1 0.5 0.25\nmap_Kd a.png\n");
    help_import_put_picture("a.png", 255, 255, 255, 255);
    struct gn_scene *scene = help_import_load("a.obj");
    const struct gn_material *m = help_import_material(scene);
    help_import_box(scene, 0, 0, 0, 2, 1, 0);
    help_import_near(m->base_color[1], 0.5f);
    help_import_near(m->metalness, 0);
    help_import_near(m->roughness, 1);
    assert_true(m->alpha == GN_ALPHA_OPAQUE && m->double_sided);
    assert_int_equal(m->textures[GN_TEXTURE_BASE].texture, 0);
    assert_memory_equal(scene->pictures.images[0].rgba, "\xff\x00\x00\xff\x00\xff", 6);
    for (uint32_t i = 0; i < scene->buffers.vertex_count;
         i++) { /* v runs down from the picture's top */
        help_import_near(scene->buffers.uv0[2 * i], scene->buffers.positions[3 * i] / 2);
        help_import_near(scene->buffers.uv0[2 * i + 1], 1 - scene->buffers.positions[3 * i + 1]);
        help_import_near(scene->buffers.normals[3 * i + 2], 1);
    }
    assert_int_equal(help_import_warnings()->count, 0);
    gn_scene_destroy(scene);
}

static void test_phong_becomes_roughness_by_the_renderers_rule(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ);
    help_import_put("a.mtl", "newmtl m\nKd 0 0 0\nKs 0.5 0.5 0.5\nNs 30\n");
    struct gn_scene *scene = help_import_load("a.obj");
    float rough = help_import_material(scene)->roughness;
    help_import_near(2 / powf(rough, 4) - 2, 30);
    gn_scene_destroy(scene);
    help_import_put("a.mtl", "newmtl m\nKs 0 0 0\nNs 30\n"); /* an exponent without a highlight */
    scene = help_import_load("a.obj");
    help_import_near(help_import_material(scene)->roughness, 1);
    gn_scene_destroy(scene);
}

static void test_a_material_line_without_its_number_is_left_out_and_named(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ);
    help_import_put("a.mtl", "newmtl m\n\nKd red\naniso\nNs\nd 0.25\n");
    struct gn_scene *scene = help_import_load("a.obj");
    help_import_near(help_import_material(scene)->base_color[3], 0.25f);
    help_import_warned("a.mtl:3: Kd without a number; shown without this line and others like it");
    assert_int_equal(help_import_warnings()->count, 1);
    gn_scene_destroy(scene);
}

static void test_opacity_blends_and_none_at_all_is_not_believed(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ);
    help_import_put("a.mtl", "newmtl m\nKd 1 1 1\nd 0.25\n");
    struct gn_scene *scene = help_import_load("a.obj");
    assert_int_equal(help_import_material(scene)->alpha, GN_ALPHA_BLEND);
    help_import_near(help_import_material(scene)->base_color[3], 0.25f);
    gn_scene_destroy(scene);
    help_import_put("a.mtl", "newmtl m\nKd 1 1 1\nd 0\n");
    scene = help_import_load("a.obj");
    assert_int_equal(help_import_material(scene)->alpha, GN_ALPHA_OPAQUE);
    help_import_warned("opacity of 0");
    gn_scene_destroy(scene);
}

static enum gn_alpha alpha_with(uint8_t a0, uint8_t a1, uint8_t a2, uint8_t a3) {
    help_import_put_picture("a.png", a0, a1, a2, a3);
    struct gn_scene *scene = help_import_load("a.obj");
    enum gn_alpha alpha = help_import_material(scene)->alpha;
    gn_scene_destroy(scene);
    return alpha;
}

static void test_holes_in_a_picture_mask_and_glass_blends(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ);
    help_import_put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd a.png\n");
    assert_int_equal(alpha_with(255, 255, 255, 255), GN_ALPHA_OPAQUE);
    assert_int_equal(alpha_with(0, 255, 0, 255), GN_ALPHA_MASK);
    assert_int_equal(alpha_with(0, 128, 100, 255), GN_ALPHA_BLEND);
    assert_int_equal(alpha_with(100, 128, 200, 100), GN_ALPHA_BLEND);
}

static void test_an_opacity_picture_becomes_the_alpha(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ);
    help_import_put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd a.png\nmap_d holes.png\n");
    help_import_put_picture("a.png", 255, 255, 255, 255);
    help_import_put_picture("holes.png", 0, 255, 255, 0);
    struct gn_scene *scene = help_import_load("a.obj");
    assert_int_equal(help_import_material(scene)->alpha, GN_ALPHA_MASK);
    assert_int_equal(scene->pictures.image_count, 1);
    assert_memory_equal(scene->pictures.images[0].rgba + 4, "\x00\xff\x00\xff\x00\x00\xff\xff", 8);
    assert_int_equal(scene->pictures.images[0].rgba[3], 0);
    gn_scene_destroy(scene);
}

static void test_a_picture_is_there_once_however_it_is_repeated(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ "usemtl n\nf 1/1 2/2 3/3\nusemtl o\nf 1/1 3/3 4/4\n");
    help_import_put("a.mtl",
                    "newmtl m\nKd 1 1 1\nmap_Kd a.png\nnewmtl n\nKd 1 1 1\nmap_Kd -clamp on a.png\n"
                    "newmtl o\nKd 1 0 0\nmap_Kd a.png\n");
    help_import_put_picture("a.png", 255, 255, 255, 255);
    struct gn_scene *scene = help_import_load("a.obj");
    assert_int_equal(scene->item_count, 3);
    assert_int_equal(scene->pictures.image_count, 1);
    assert_int_equal(scene->pictures.texture_count, 2);
    int clamped = 0;
    for (uint32_t i = 0; i < 2; i++) clamped += scene->pictures.textures[i].wrap_s == GN_WRAP_CLAMP;
    assert_int_equal(clamped, 1);
    gn_scene_destroy(scene);
}

static void put_outside(const char *name, char *path, size_t size) {
    snprintf(path, size, "%s-%s", help_import_folder(), name);
    const uint8_t rgba[4] = {1, 2, 3, 255};
    struct gn_made png = gn_maker_png(1, 1, rgba);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(png.data, 1, png.size, file);
    fclose(file);
    free(png.data);
}

static void test_pictures_outside_the_folder_are_not_read(void **state) {
    (void)state;
    char outside[128], text[400];
    put_outside("secret.png", outside, sizeof outside);
    for (int i = 0; i < 3; i++) {
        static const char *const before[] = {"", "..", "x/../.."};
        snprintf(text, sizeof text, "newmtl m\nKd 0.1 0.2 0.3\nmap_Kd %s%s\n", before[i],
                 i == 0 ? outside : strrchr(outside, '/'));
        help_import_put("a.obj", SQUARE_OBJ);
        help_import_put("a.mtl", text);
        struct gn_scene *scene = help_import_load("a.obj");
        assert_int_equal(scene->pictures.image_count, 0);
        help_import_near(help_import_material(scene)->base_color[2], 0.3f);
        help_import_warned("not found in the model's folder; shown without it");
        gn_scene_destroy(scene);
    }
    assert_int_equal(symlink(outside, help_import_path("link.png")), 0);
    help_import_put("a.mtl", "newmtl m\nmap_Kd link.png\n");
    struct gn_scene *scene = help_import_load("a.obj");
    assert_int_equal(scene->pictures.image_count, 0);
    gn_scene_destroy(scene);
    unlink(outside);
}

static void test_a_path_of_another_machine_is_found_by_its_last_part(void **state) {
    (void)state;
    help_import_put("a.obj", SQUARE_OBJ);
    help_import_put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd C:\\Users\\me\\a.png\n");
    help_import_put_picture("a.png", 255, 255, 255, 255);
    struct gn_scene *scene = help_import_load("a.obj");
    assert_int_equal(scene->pictures.image_count, 1);
    gn_scene_destroy(scene);
}

static void test_missing_materials_are_told(void **state) {
    (void)state;
    help_import_put("b.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    struct gn_scene *scene = help_import_load("b.obj");
    help_import_warned("gone.mtl not found in the model's folder");
    gn_scene_destroy(scene);
}

/* Blender writes aniso; the others are in the format's specification. */
static void test_materials_have_lines_that_assimp_cannot_read(void **state) {
    (void)state;
    static const char *const lines[] = {
        "aniso 0.5",    "  anisor 0",  "Ka spectral a.rfl 1",
        "Ks xyz 1 1 1", "d -halo 0.5", "decal no.png",
        "Tf",           "a thing",     "Pcx 1",
    };
    help_import_put("n.obj", "mtllib n.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        char text[200];
        snprintf(text, sizeof text, "newmtl m\r\n%s\r\nKd 1 0 0.25\r\n", lines[i]);
        help_import_put("n.mtl", text);
        struct gn_scene *scene = help_import_load("n.obj");
        help_import_near(help_import_material(scene)->base_color[2], 0.25f);
        gn_scene_destroy(scene);
    }
}

/* The second is 0 then, as the format's specification has it. */
static void test_texture_coordinates_may_have_one_number(void **state) {
    (void)state;
    static const char *const lines[][3] = {
        {"vt 0.25 0\n", "vt 0.5 0\n", "vt 1 0\n"},
        {"vt .25\n", "vt\t0.5  # 1\r\n", "vt 1 # end\n"},
        {"vt 0.25 \\\n0\n", "vt 0.5 0 0\n", "vt 1#\n"},
    };
    float uv[3][6];
    for (size_t i = 0; i < 3; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "v 0 0 0\nv 1 0 0 # 1\nv 0 1 0\nvn 0 0 1\n%s%s%sf 1/1/1 2/2/1 3/3/1\nvt 2",
                 lines[i][0], lines[i][1], lines[i][2]);
        help_import_put("u.obj", text);
        struct gn_scene *scene = help_import_load("u.obj");
        assert_int_equal(scene->buffers.vertex_count, 3);
        assert_non_null(scene->buffers.uv0);
        memcpy(uv[i], scene->buffers.uv0, sizeof uv[i]);
        assert_memory_equal(uv[i], uv[0], sizeof uv[i]);
        gn_scene_destroy(scene);
    }
    help_import_near(uv[0][2], 0.5f);
}

/* ---- normals ---- */

/* Processor time of all importers so far. */
static long importer_cpu_s(void) {
    struct rusage usage;
    assert_int_equal(getrusage(RUSAGE_CHILDREN, &usage), 0);
    return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec;
}

/* Each face of the fan has another normal: 60,000 took 19 s. */
static void test_many_faces_around_a_point_get_normals_at_once(void **state) {
    (void)state;
    enum { COUNT = 60000, SIZE = 90 * COUNT };
    char *text = malloc(SIZE);
    size_t used = (size_t)sprintf(text, "v 0 0 0\n");
    for (int i = 0; i < COUNT; i++) {
        const double angle = 2 * 3.14159265358979 * i / COUNT;
        used += (size_t)snprintf(text + used, SIZE - used, "v %.5f %.5f %.5f\n", cos(angle),
                                 sin(angle), (i * 7919) % 1000 * .002 - 1);
    }
    for (int i = 0; i < COUNT; i++)
        used +=
            (size_t)snprintf(text + used, SIZE - used, "f 1 %d %d\n", i + 2, (i + 1) % COUNT + 2);
    help_import_put("fan.obj", text);
    free(text);
    const long start_s = importer_cpu_s();
    struct gn_scene *scene = help_import_load("fan.obj");
    assert_in_range(importer_cpu_s() - start_s, 0, 8);
    assert_int_equal(scene->triangle_count, COUNT);
    gn_scene_destroy(scene);
}

/* As many faces as are grouped by direction: a cone's tip is smooth, and flat faces stay flat. */
static void test_normals_of_a_cone_with_many_sides(void **state) {
    (void)state;
    enum { COUNT = 720, SIZE = 80 * COUNT };
    char *text = malloc(SIZE);
    size_t used = (size_t)sprintf(text, "v 0 0.1 0\n");
    for (int i = 0; i < COUNT; i++) {
        const double angle = 2 * 3.14159265358979 * i / COUNT;
        used +=
            (size_t)snprintf(text + used, SIZE - used, "v %.6f 0 %.6f\n", sin(angle), cos(angle));
    }
    for (int i = 0; i < COUNT; i++)
        used +=
            (size_t)snprintf(text + used, SIZE - used, "f 1 %d %d\n", i + 2, (i + 1) % COUNT + 2);
    help_import_put("cone.obj", text);
    free(text);
    struct gn_scene *scene = help_import_load("cone.obj");
    assert_int_equal(scene->buffers.vertex_count, COUNT + 1); /* the tip is one vertex */
    for (uint32_t i = 0; i < scene->buffers.vertex_count; i++)
        if (scene->buffers.positions[3 * i + 1] > .05f)
            help_import_near(scene->buffers.normals[3 * i + 1], 1);
    gn_scene_destroy(scene);
}

static void test_numbers_of_an_obj_may_begin_with_their_point(void **state) {
    (void)state;
    help_import_put("p.obj", "v .5 0 -.5\nv\t.25 .0 .5\nv 1. 2 +.5 \nvt .1 .2\nf 1/1 2/1 3/1");
    struct gn_scene *scene = help_import_load("p.obj");
    help_import_box(scene, 0.25f, 0, -0.5f, 1, 2, 0.5f);
    gn_scene_destroy(scene);
}

/* ---- refusals ---- */

static void test_what_is_no_model_is_refused_by_one_line(void **state) {
    (void)state;
    help_import_put("bad.fbx", "this is not one");
    help_import_refused("bad.fbx", "cannot be read as FBX");
    help_import_put("bad.dae", "<COLLADA>");
    help_import_refused("bad.dae", "cannot be read as Collada");
    help_import_put("empty.stl", "");
    help_import_refused("empty.stl", "cannot be read as STL");
    help_import_put("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n");
    help_import_refused("points.obj", "no triangles");
    help_import_put("lines.obj",
                    "v 0 0 0\nv 0.1 0.1 0.1\nv 0.3 0.3 0.3\nf 1 2 3\nf 1 1 2\nf 3 3 3\n");
    help_import_refused("lines.obj", "no triangle has an area");
    help_import_refused("gone.obj", "cannot open");
    assert_int_equal(mkdir(help_import_path("dir.ply"), 0700), 0);
    help_import_refused("dir.ply", "is a folder");
    assert_int_equal(mkfifo(help_import_path("fifo.obj"), 0600), 0);
    help_import_refused("fifo.obj", "is a FIFO");
}

static void test_names_are_known_by_their_ends(void **state) {
    (void)state;
    assert_true(gn_import_wants("a.OBJ") && gn_import_wants("/x.y/a.dae"));
    assert_false(gn_import_wants("a.glb") || gn_import_wants("obj") || gn_import_wants("a.obj/b"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_square_of_an_obj_stands_upright_with_its_picture),
        cmocka_unit_test(test_phong_becomes_roughness_by_the_renderers_rule),
        cmocka_unit_test(test_a_material_line_without_its_number_is_left_out_and_named),
        cmocka_unit_test(test_opacity_blends_and_none_at_all_is_not_believed),
        cmocka_unit_test(test_holes_in_a_picture_mask_and_glass_blends),
        cmocka_unit_test(test_an_opacity_picture_becomes_the_alpha),
        cmocka_unit_test(test_a_picture_is_there_once_however_it_is_repeated),
        cmocka_unit_test(test_pictures_outside_the_folder_are_not_read),
        cmocka_unit_test(test_a_path_of_another_machine_is_found_by_its_last_part),
        cmocka_unit_test(test_missing_materials_are_told),
        cmocka_unit_test(test_materials_have_lines_that_assimp_cannot_read),
        cmocka_unit_test(test_texture_coordinates_may_have_one_number),
        cmocka_unit_test(test_many_faces_around_a_point_get_normals_at_once),
        cmocka_unit_test(test_normals_of_a_cone_with_many_sides),
        cmocka_unit_test(test_numbers_of_an_obj_may_begin_with_their_point),
        cmocka_unit_test(test_what_is_no_model_is_refused_by_one_line),
        cmocka_unit_test(test_names_are_known_by_their_ends),
    };
    return help_import_run(tests, sizeof tests / sizeof *tests);
}
