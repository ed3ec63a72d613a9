/* Models of other formats, written here, through gnomon-import into a scene. Skipped (77) where
 * that program was not built. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/import.h"
#include "gltf_maker.h"
#include "scene_check.h"

static char folder[64] = "/tmp/gnomon-import-XXXXXX";
static struct gn_warnings warnings;
static struct gn_err err;

static const char *in_folder(const char *name) {
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void put_bytes(const char *name, const void *data, size_t size) {
    FILE *file = fopen(in_folder(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static void put(const char *name, const char *text) { put_bytes(name, text, strlen(text)); }

/* 2 x 2: red and green above, blue and white below, with that alpha. */
static void put_picture(const char *name, uint8_t a0, uint8_t a1, uint8_t a2, uint8_t a3) {
    const uint8_t rgba[] = {255, 0, 0, a0, 0, 255, 0, a1, 0, 0, 255, a2, 255, 255, 255, a3};
    struct gn_made png = gn_maker_png(2, 2, rgba);
    put_bytes(name, png.data, png.size);
    free(png.data);
}

static struct gn_scene *load(const char *name) {
    const struct gn_scene_limits limits = {0};
    memset(&warnings, 0, sizeof warnings);
    struct gn_scene *scene = gn_import_load(in_folder(name), &limits, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    const char *wrong = gn_scene_check(scene);
    if (wrong) fail_msg("%s: %s", name, wrong);
    return scene;
}

static void assert_refused(const char *name, const char *why) {
    const struct gn_scene_limits limits = {0};
    memset(&err, 0, sizeof err);
    assert_null(gn_import_load(in_folder(name), &limits, &warnings, &err));
    const char *path = in_folder(name);
    if (strncmp(err.text, path, strlen(path)) != 0 || !strstr(err.text, why))
        fail_msg("\"%s\" does not say \"%s\"", err.text, why);
}

static void assert_warned(const char *what) {
    for (int i = 0; i < warnings.count; i++)
        if (strstr(warnings.text[i], what)) return;
    fail_msg("no warning of \"%s\"", what);
}

static void assert_near(float a, float b) {
    if (!(fabsf(a - b) < 1e-4f * fmaxf(1.0f, fabsf(b))))
        fail_msg("%g is not %g", (double)a, (double)b);
}

static void assert_box(const struct gn_scene *scene, float x0, float y0, float z0, float x1,
                       float y1, float z1) {
    const float low[] = {x0, y0, z0}, high[] = {x1, y1, z1};
    for (int k = 0; k < 3; k++) {
        assert_near(scene->box.min[k], low[k]);
        assert_near(scene->box.max[k], high[k]);
    }
}

/* ---- OBJ ---- */

#define SQUARE_OBJ                                                                                 \
    "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"           \
    "usemtl m\nf 1/1 2/2 3/3 4/4\n"

static const struct gn_material *only_material(const struct gn_scene *scene) {
    return &scene->materials[scene->items[0].material];
}

static void test_a_square_of_an_obj_stands_upright_with_its_picture(void **state) {
    (void)state;
    put("a.obj", SQUARE_OBJ);
    put("a.mtl", "newmtl m\nKd 1 0.5 0.25\nmap_Kd a.png\n");
    put_picture("a.png", 255, 255, 255, 255);
    struct gn_scene *scene = load("a.obj");
    const struct gn_material *m = only_material(scene);
    assert_box(scene, 0, 0, 0, 2, 1, 0);
    assert_near(m->base_color[1], 0.5f);
    assert_near(m->metalness, 0);
    assert_near(m->roughness, 1);
    assert_true(m->alpha == GN_ALPHA_OPAQUE && m->double_sided);
    assert_int_equal(m->textures[GN_TEXTURE_BASE].texture, 0);
    assert_memory_equal(scene->images[0].rgba, "\xff\x00\x00\xff\x00\xff", 6);
    for (uint32_t i = 0; i < scene->vertex_count; i++) { /* v runs down from the picture's top */
        assert_near(scene->uv0[2 * i], scene->positions[3 * i] / 2);
        assert_near(scene->uv0[2 * i + 1], 1 - scene->positions[3 * i + 1]);
        assert_near(scene->normals[3 * i + 2], 1);
    }
    assert_int_equal(warnings.count, 0);
    gn_scene_destroy(scene);
}

static void test_phong_becomes_roughness_by_the_renderers_rule(void **state) {
    (void)state;
    put("a.obj", SQUARE_OBJ);
    put("a.mtl", "newmtl m\nKd 0 0 0\nKs 0.5 0.5 0.5\nNs 30\n");
    struct gn_scene *scene = load("a.obj");
    float rough = only_material(scene)->roughness;
    assert_near(2 / powf(rough, 4) - 2, 30);
    gn_scene_destroy(scene);
    put("a.mtl", "newmtl m\nKs 0 0 0\nNs 30\n"); /* an exponent without a highlight */
    scene = load("a.obj");
    assert_near(only_material(scene)->roughness, 1);
    gn_scene_destroy(scene);
}

static void test_opacity_blends_and_none_at_all_is_not_believed(void **state) {
    (void)state;
    put("a.obj", SQUARE_OBJ);
    put("a.mtl", "newmtl m\nKd 1 1 1\nd 0.25\n");
    struct gn_scene *scene = load("a.obj");
    assert_int_equal(only_material(scene)->alpha, GN_ALPHA_BLEND);
    assert_near(only_material(scene)->base_color[3], 0.25f);
    gn_scene_destroy(scene);
    put("a.mtl", "newmtl m\nKd 1 1 1\nd 0\n");
    scene = load("a.obj");
    assert_int_equal(only_material(scene)->alpha, GN_ALPHA_OPAQUE);
    assert_warned("opacity of 0");
    gn_scene_destroy(scene);
}

static enum gn_alpha alpha_with(uint8_t a0, uint8_t a1, uint8_t a2, uint8_t a3) {
    put_picture("a.png", a0, a1, a2, a3);
    struct gn_scene *scene = load("a.obj");
    enum gn_alpha alpha = only_material(scene)->alpha;
    gn_scene_destroy(scene);
    return alpha;
}

static void test_holes_in_a_picture_mask_and_glass_blends(void **state) {
    (void)state;
    put("a.obj", SQUARE_OBJ);
    put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd a.png\n");
    assert_int_equal(alpha_with(255, 255, 255, 255), GN_ALPHA_OPAQUE);
    assert_int_equal(alpha_with(0, 255, 0, 255), GN_ALPHA_MASK);
    assert_int_equal(alpha_with(0, 128, 100, 255), GN_ALPHA_BLEND);
    assert_int_equal(alpha_with(100, 128, 200, 100), GN_ALPHA_BLEND);
}

static void test_an_opacity_picture_becomes_the_alpha(void **state) {
    (void)state;
    put("a.obj", SQUARE_OBJ);
    put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd a.png\nmap_d holes.png\n");
    put_picture("a.png", 255, 255, 255, 255);
    put_picture("holes.png", 0, 255, 255, 0);
    struct gn_scene *scene = load("a.obj");
    assert_int_equal(only_material(scene)->alpha, GN_ALPHA_MASK);
    assert_int_equal(scene->image_count, 1);
    assert_memory_equal(scene->images[0].rgba + 4, "\x00\xff\x00\xff\x00\x00\xff\xff", 8);
    assert_int_equal(scene->images[0].rgba[3], 0);
    gn_scene_destroy(scene);
}

static void test_a_picture_is_there_once_however_it_is_repeated(void **state) {
    (void)state;
    put("a.obj", SQUARE_OBJ "usemtl n\nf 1/1 2/2 3/3\nusemtl o\nf 1/1 3/3 4/4\n");
    put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd a.png\nnewmtl n\nKd 1 1 1\nmap_Kd -clamp on a.png\n"
                 "newmtl o\nKd 1 0 0\nmap_Kd a.png\n");
    put_picture("a.png", 255, 255, 255, 255);
    struct gn_scene *scene = load("a.obj");
    assert_int_equal(scene->item_count, 3);
    assert_int_equal(scene->image_count, 1);
    assert_int_equal(scene->texture_count, 2);
    int clamped = 0;
    for (uint32_t i = 0; i < 2; i++) clamped += scene->textures[i].wrap_s == GN_WRAP_CLAMP;
    assert_int_equal(clamped, 1);
    gn_scene_destroy(scene);
}

static void put_outside(const char *name, char *path, size_t size) {
    snprintf(path, size, "%s-%s", folder, name);
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
        put("a.obj", SQUARE_OBJ);
        put("a.mtl", text);
        struct gn_scene *scene = load("a.obj");
        assert_int_equal(scene->image_count, 0);
        assert_near(only_material(scene)->base_color[2], 0.3f);
        assert_warned("is not in its folder; shown without it");
        gn_scene_destroy(scene);
    }
    assert_int_equal(symlink(outside, in_folder("link.png")), 0);
    put("a.mtl", "newmtl m\nmap_Kd link.png\n");
    struct gn_scene *scene = load("a.obj");
    assert_int_equal(scene->image_count, 0);
    gn_scene_destroy(scene);
    unlink(outside);
}

static void test_a_path_of_another_machine_is_found_by_its_last_part(void **state) {
    (void)state;
    put("a.obj", SQUARE_OBJ);
    put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd C:\\Users\\me\\a.png\n");
    put_picture("a.png", 255, 255, 255, 255);
    struct gn_scene *scene = load("a.obj");
    assert_int_equal(scene->image_count, 1);
    gn_scene_destroy(scene);
}

static void test_missing_materials_are_told(void **state) {
    (void)state;
    put("b.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    struct gn_scene *scene = load("b.obj");
    assert_warned("gone.mtl are not in its folder");
    gn_scene_destroy(scene);
}

/* ---- normals ---- */

static const char box_ply[] = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty "
                              "float y\nproperty float z\n"
                              "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 3\n1 0 3\n1 1 3\n0 1 3\n"
                              "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

static void test_a_box_without_normals_gets_flat_ones_that_look_out(void **state) {
    (void)state;
    put("box.ply", box_ply);
    struct gn_scene *scene = load("box.ply");
    assert_box(scene, 0, 0, -1, 1, 3, 0); /* z up became y up */
    assert_int_equal(scene->vertex_count, 24);
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        const float *p = scene->positions + 3 * i, *n = scene->normals + 3 * i;
        float out[3] = {p[0] - 0.5f, p[1] - 0.5f, p[2] - 1.5f}; /* mesh space: still z up */
        int axis = fabsf(n[0]) > 0.9f ? 0 : fabsf(n[1]) > 0.9f ? 1 : 2;
        assert_near(fabsf(n[axis]), 1);
        assert_true(n[axis] * out[axis] > 0);
    }
    assert_true(scene->geometries[0].closed);
    gn_scene_destroy(scene);
}

static void test_a_cylinder_without_normals_is_smooth_round_and_sharp_at_its_rim(void **state) {
    (void)state;
    enum { SIDES = 16 };
    char text[4000];
    int n = 0;
    for (int i = 0; i < SIDES; i++) {
        double a = 2 * 3.14159265358979 * i / SIDES;
        n += sprintf(text + n, "v %.6f 0 %.6f\nv %.6f 1 %.6f\n", cos(a), -sin(a), cos(a), -sin(a));
    }
    for (int i = 0; i < SIDES; i++) {
        int a = 2 * i + 1, b = 2 * ((i + 1) % SIDES) + 1;
        n += sprintf(text + n, "f %d %d %d %d\n", a, b, b + 1, a + 1);
    }
    n += sprintf(text + n, "f");
    for (int i = 0; i < SIDES; i++) n += sprintf(text + n, " %d", 2 * i + 2);
    sprintf(text + n, "\n");
    put("c.obj", text);
    struct gn_scene *scene = load("c.obj");
    assert_int_equal(scene->vertex_count, 3 * SIDES);
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        const float *p = scene->positions + 3 * i, *normal = scene->normals + 3 * i;
        bool lid = fabsf(normal[1]) > 0.5f;
        assert_near(normal[0], lid ? 0 : p[0]);
        assert_near(normal[1], lid ? 1 : 0);
        assert_near(normal[2], lid ? 0 : p[2]);
    }
    gn_scene_destroy(scene);
}

/* Two halves of a roof, each with its own ridge, since their pictures differ: -0 in one of them. */
static void test_a_place_is_one_whatever_the_sign_of_its_zeros(void **state) {
    (void)state;
    put("roof.obj", "v -1 0 0\nv 0 0.1 0\nv 0 0.1 -1\nv -1 0 -1\nvt 0 0\nvt 1 1\n"
                    "v 1 0 0\nv -0 0.1 -0\nv -0 0.1 -1\nv 1 0 -1\n"
                    "f 1/1 2/1 3/1 4/1\nf 5/2 8/2 7/2 6/2\n");
    struct gn_scene *scene = load("roof.obj");
    int ridge = 0;
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        if (scene->positions[3 * i] != 0) continue;
        assert_near(scene->normals[3 * i], 0);
        assert_near(scene->normals[3 * i + 1], 1);
        ridge++;
    }
    assert_int_equal(ridge, 4);
    gn_scene_destroy(scene);
}

/* ---- STL, PLY ---- */

static void test_an_stl_has_z_up_in_either_form(void **state) {
    (void)state;
    put("a.stl", "solid s\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                 "vertex 0 0 3\nendloop\nendfacet\nendsolid s\n");
    struct gn_scene *scene = load("a.stl");
    assert_box(scene, 0, 0, 0, 1, 3, 0);
    gn_scene_destroy(scene);
    uint8_t stl[84 + 50] = {0};
    const float values[] = {0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3};
    stl[80] = 1;
    memcpy(stl + 84, values, sizeof values);
    put_bytes("b.stl", stl, sizeof stl);
    scene = load("b.stl");
    assert_box(scene, 0, 0, 0, 1, 3, 0);
    assert_near(scene->normals[1], -1); /* as the file has it; its node turns it */
    gn_scene_destroy(scene);
}

static void test_vertex_colours_become_linear_on_white(void **state) {
    (void)state;
    put("c.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0 255 188 0\n1 0 0 255 188 0\n0 0 1 255 188 0\n3 0 1 2\n");
    struct gn_scene *scene = load("c.ply");
    assert_int_equal(scene->colors[0], 255);
    assert_in_range(scene->colors[1], 127, 129); /* sRGB 188 is linear one half */
    assert_int_equal(scene->colors[2], 0);
    assert_near(only_material(scene)->base_color[0], 1);
    gn_scene_destroy(scene);
}

/* ---- Collada, FBX ---- */

static const char dae[] =
    "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
    "version='1.4.1'><asset><unit meter='0.01'/><up_axis>Z_UP</up_axis></asset><library_cameras>"
    "<camera id='c' name='c'><optics><technique_common><perspective><xfov>60</xfov><aspect_ratio>2"
    "</aspect_ratio><znear>1</znear><zfar>1000</zfar></perspective></technique_common></optics>"
    "</camera></library_cameras><library_lights><light id='sun'><technique_common><directional>"
    "<color>2 1 0</color></directional></technique_common></light><light id='spot'>"
    "<technique_common><spot><color>1 1 1</color><constant_attenuation>0</constant_attenuation>"
    "<linear_attenuation>0</linear_attenuation><quadratic_attenuation>1</quadratic_attenuation>"
    "<falloff_angle>40</falloff_angle></spot></technique_common></light></library_lights>"
    "<library_geometries><geometry id='g'><mesh><source id='p'><float_array id='a' count='9'>"
    "-100 0 0 100 0 0 0 0 100</float_array><technique_common><accessor source='#a' count='3' "
    "stride='3'><param name='X' type='float'/><param name='Y' type='float'/><param name='Z' "
    "type='float'/></accessor></technique_common></source><vertices id='v'><input "
    "semantic='POSITION' source='#p'/></vertices><triangles count='1'><input semantic='VERTEX' "
    "source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
    "<library_visual_scenes><visual_scene id='s'><node id='one' name='one'><instance_geometry "
    "url='#g'/></node><node id='two' name='two'><translate>0 500 0</translate><instance_geometry "
    "url='#g'/></node><node id='cam' name='cam'><translate>0 -300 0</translate>"
    "<rotate>1 0 0 90</rotate><instance_camera url='#c'/></node><node id='sunny' name='sunny'>"
    "<instance_light url='#sun'/></node><node id='spotty' name='spotty'><translate>0 0 700"
    "</translate><instance_light url='#spot'/></node></visual_scene></library_visual_scenes>"
    "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";

static void assert_along(const struct gn_scene *scene, uint32_t node, float x, float y, float z) {
    const float *back = scene->nodes[node].matrix[2]; /* things look along their -z */
    assert_near(back[0], -x);
    assert_near(back[1], -y);
    assert_near(back[2], -z);
    assert_near(glm_vec3_norm((float *)scene->nodes[node].matrix[0]), 1);
}

static void test_a_collada_scene_keeps_its_unit_axis_and_instances(void **state) {
    (void)state;
    put("a.dae", dae);
    struct gn_scene *scene = load("a.dae");
    assert_box(scene, -1, 0, -5, 1, 1, 0);
    assert_int_equal(scene->item_count, 2);
    assert_int_equal(scene->geometry_count, 1);
    gn_scene_destroy(scene);
}

static void test_lights_and_cameras_of_collada_stand_and_look_right(void **state) {
    (void)state;
    put("a.dae", dae);
    struct gn_scene *scene = load("a.dae");
    assert_int_equal(scene->light_count, 2);
    const struct gn_light *sun = &scene->lights[0], *spot = &scene->lights[1];
    assert_int_equal(sun->type, GN_LIGHT_DIRECTIONAL);
    assert_near(sun->color[0], 2 * GLM_PIf);
    assert_near(sun->color[1], GLM_PIf);
    assert_along(scene, sun->node, 0, -1, 0);
    assert_int_equal(spot->type, GN_LIGHT_SPOT);
    assert_near(spot->outer_rad, glm_rad(20));
    assert_near(scene->nodes[spot->node].matrix[3][1], 7);
    assert_near(spot->color[0], GLM_PIf * 1e-4f); /* pi / d^2 with d in the file's centimetres */
    assert_int_equal(scene->camera_count, 1);
    assert_along(scene, scene->cameras[0].node, 0, 0, -1);
    assert_near(scene->nodes[scene->cameras[0].node].matrix[3][2], 3);
    assert_near(tanf(scene->cameras[0].yfov_rad / 2), tanf(glm_rad(30)) / 2);
    gn_scene_destroy(scene);
}

static const char fbx[] =
    "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: "
    "7400\n"
    "}\nGlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n"
    "\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",2\n\t\tP: \"UpAxisSign\", \"int\", \"Integer\", "
    "\"\",1\n"
    "\t\tP: \"FrontAxis\", \"int\", \"Integer\", \"\",1\n"
    "\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",-1\n"
    "\t\tP: \"CoordAxis\", \"int\", \"Integer\", \"\",0\n"
    "\t\tP: \"CoordAxisSign\", \"int\", \"Integer\", \"\",1\n"
    "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",2.54\n\t}\n}\n"
    "Objects:  {\n\tGeometry: 10, \"Geometry::t\", \"Mesh\" {\n\t\tVertices: *9 {\n"
    "\t\t\ta: 0,0,0,100,0,0,0,200,300\n\t\t}\n\t\tPolygonVertexIndex: *3 {\n\t\t\ta: "
    "0,1,-3\n\t\t}\n"
    "\t\tGeometryVersion: 124\n\t}\n\tModel: 20, \"Model::t\", \"Mesh\" {\n\t\tVersion: "
    "232\n\t}\n}\n"
    "Connections:  {\n\tC: \"OO\",20,0\n\tC: \"OO\",10,20\n}\n";

static void test_an_fbx_in_inches_with_z_up_is_in_metres_with_y_up(void **state) {
    (void)state;
    put("a.fbx", fbx);
    struct gn_scene *scene = load("a.fbx");
    assert_box(scene, 0, 0, -5.08f, 2.54f, 7.62f, 0);
    gn_scene_destroy(scene);
}

/* ---- refusals ---- */

static void test_what_is_no_model_is_refused_by_one_line(void **state) {
    (void)state;
    put("bad.fbx", "this is not one");
    assert_refused("bad.fbx", "is not read as FBX");
    put("bad.dae", "<COLLADA>");
    assert_refused("bad.dae", "is not read as Collada");
    put("empty.stl", "");
    assert_refused("empty.stl", "is not read as STL");
    put("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n");
    assert_refused("points.obj", "no triangles");
    assert_refused("gone.obj", "cannot open");
    assert_int_equal(mkdir(in_folder("dir.ply"), 0700), 0);
    assert_refused("dir.ply", "is a folder");
    assert_int_equal(mkfifo(in_folder("fifo.obj"), 0600), 0);
    assert_refused("fifo.obj", "is a FIFO");
}

static void test_names_are_known_by_their_ends(void **state) {
    (void)state;
    assert_true(gn_import_wants("a.OBJ") && gn_import_wants("/x.y/a.dae"));
    assert_false(gn_import_wants("a.glb") || gn_import_wants("obj") || gn_import_wants("a.obj/b"));
}

/* ---- */

static bool find_program(void) {
    char path[4096], *slash;
    const char *gnomon = getenv("GNOMON");
    if (!realpath(gnomon ? gnomon : "build/release/gnomon", path)) return false;
    slash = strrchr(path, '/');
    strcpy(slash, "/gnomon-import");
    bool there = access(path, X_OK) == 0;
    *slash = 0;
    setenv("PATH", path, 1);
    return there;
}

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int leave(void **state) {
    char command[128];
    (void)state;
    snprintf(command, sizeof command, "/bin/rm -rf '%s'", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_square_of_an_obj_stands_upright_with_its_picture),
        cmocka_unit_test(test_phong_becomes_roughness_by_the_renderers_rule),
        cmocka_unit_test(test_opacity_blends_and_none_at_all_is_not_believed),
        cmocka_unit_test(test_holes_in_a_picture_mask_and_glass_blends),
        cmocka_unit_test(test_an_opacity_picture_becomes_the_alpha),
        cmocka_unit_test(test_a_picture_is_there_once_however_it_is_repeated),
        cmocka_unit_test(test_pictures_outside_the_folder_are_not_read),
        cmocka_unit_test(test_a_path_of_another_machine_is_found_by_its_last_part),
        cmocka_unit_test(test_missing_materials_are_told),
        cmocka_unit_test(test_a_box_without_normals_gets_flat_ones_that_look_out),
        cmocka_unit_test(test_a_cylinder_without_normals_is_smooth_round_and_sharp_at_its_rim),
        cmocka_unit_test(test_a_place_is_one_whatever_the_sign_of_its_zeros),
        cmocka_unit_test(test_an_stl_has_z_up_in_either_form),
        cmocka_unit_test(test_vertex_colours_become_linear_on_white),
        cmocka_unit_test(test_a_collada_scene_keeps_its_unit_axis_and_instances),
        cmocka_unit_test(test_lights_and_cameras_of_collada_stand_and_look_right),
        cmocka_unit_test(test_an_fbx_in_inches_with_z_up_is_in_metres_with_y_up),
        cmocka_unit_test(test_what_is_no_model_is_refused_by_one_line),
        cmocka_unit_test(test_names_are_known_by_their_ends),
    };
    if (!find_program()) {
        puts("gnomon-import was not built: it needs libassimp-dev (make deps)");
        return 77;
    }
    return cmocka_run_group_tests(tests, enter, leave);
}
