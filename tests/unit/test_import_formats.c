/* PLY, STL, Collada and FBX, written here, through gnomon-import into a scene. Skipped (77) where
 * that program was not built. */
#include "check.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import_help.h"

/* ---- normals ---- */

static const char box_ply[] = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty "
                              "float y\nproperty float z\n"
                              "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 3\n1 0 3\n1 1 3\n0 1 3\n"
                              "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

static void test_a_box_without_normals_gets_flat_ones_that_look_out(void **state) {
    (void)state;
    help_import_put("box.ply", box_ply);
    struct gn_scene *scene = help_import_load("box.ply");
    help_import_box(scene, 0, 0, -1, 1, 3, 0); /* z up became y up */
    assert_int_equal(scene->buffers.vertex_count, 24);
    for (uint32_t i = 0; i < scene->buffers.vertex_count; i++) {
        const float *p = scene->buffers.positions + 3 * i, *n = scene->buffers.normals + 3 * i;
        float out[3] = {p[0] - 0.5f, p[1] - 0.5f, p[2] - 1.5f}; /* mesh space: still z up */
        int axis = fabsf(n[0]) > 0.9f ? 0 : fabsf(n[1]) > 0.9f ? 1 : 2;
        help_import_near(fabsf(n[axis]), 1);
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
    help_import_put("c.obj", text);
    struct gn_scene *scene = help_import_load("c.obj");
    assert_int_equal(scene->buffers.vertex_count, 3 * SIDES);
    for (uint32_t i = 0; i < scene->buffers.vertex_count; i++) {
        const float *p = scene->buffers.positions + 3 * i, *normal = scene->buffers.normals + 3 * i;
        bool lid = fabsf(normal[1]) > 0.5f;
        help_import_near(normal[0], lid ? 0 : p[0]);
        help_import_near(normal[1], lid ? 1 : 0);
        help_import_near(normal[2], lid ? 0 : p[2]);
    }
    gn_scene_destroy(scene);
}

/* Two halves of a roof, each with its own ridge, since their pictures differ: -0 in one of them. */
static void test_a_place_is_one_whatever_the_sign_of_its_zeros(void **state) {
    (void)state;
    help_import_put("roof.obj", "v -1 0 0\nv 0 0.1 0\nv 0 0.1 -1\nv -1 0 -1\nvt 0 0\nvt 1 1\n"
                                "v 1 0 0\nv -0 0.1 -0\nv -0 0.1 -1\nv 1 0 -1\n"
                                "f 1/1 2/1 3/1 4/1\nf 5/2 8/2 7/2 6/2\n");
    struct gn_scene *scene = help_import_load("roof.obj");
    int ridge = 0;
    for (uint32_t i = 0; i < scene->buffers.vertex_count; i++) {
        if (scene->buffers.positions[3 * i] != 0) continue;
        help_import_near(scene->buffers.normals[3 * i], 0);
        help_import_near(scene->buffers.normals[3 * i + 1], 1);
        ridge++;
    }
    assert_int_equal(ridge, 4);
    gn_scene_destroy(scene);
}

/* ---- STL, PLY ---- */

/* A line feed is the first byte of one file in 256. */
static void test_a_binary_ply_may_begin_with_any_byte(void **state) {
    (void)state;
    static const char *const ends[] = {"\n", "\r\n"};
    for (int i = 0; i < 4; i++) {
        static const char *const orders[] = {"little", "big"};
        static const uint8_t body[] = {
            '\n', 0,   0, 0, 0, 0, 0,   0,   0,   0,   0,   0, /* about 0 0 0 */
            0,    0,   0, 0, 0, 0, 0,   0,   '@', '@', '@', '@', '@', '@',
            '@',  '@', 0, 0, 0, 0, '@', '@', '@', '@', 3,   0,   1,   2};
        char data[400];
        const char *end = ends[i / 2];
        const int size = snprintf(
            data, sizeof data - sizeof body,
            "ply%sformat binary_%s_endian 1.0%selement vertex 3%sproperty float x%sproperty float "
            "y%sproperty float z%selement face 1%sproperty list uchar uchar vertex_indices%s"
            "end_header%s",
            end, orders[i % 2], end, end, end, end, end, end, end, end);
        memcpy(data + size, body, sizeof body);
        help_import_put_bytes("f.ply", data, (size_t)size + sizeof body);
        struct gn_scene *scene = help_import_load("f.ply");
        help_import_box(scene, 0, 0, 0, 3.0039f, 3.0039f, 0);
        gn_scene_destroy(scene);
    }
}

static void test_an_stl_has_z_up_in_either_form(void **state) {
    (void)state;
    help_import_put("a.stl",
                    "solid s\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                    "vertex 0 0 3\nendloop\nendfacet\nendsolid s\n");
    struct gn_scene *scene = help_import_load("a.stl");
    help_import_box(scene, 0, 0, 0, 1, 3, 0);
    gn_scene_destroy(scene);
    uint8_t stl[84 + 50] = {0};
    const float values[] = {0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3};
    stl[80] = 1;
    memcpy(stl + 84, values, sizeof values);
    help_import_put_bytes("b.stl", stl, sizeof stl);
    scene = help_import_load("b.stl");
    help_import_box(scene, 0, 0, 0, 1, 3, 0);
    help_import_near(scene->buffers.normals[1], -1); /* as the file has it; its node turns it */
    gn_scene_destroy(scene);
}

static void test_vertex_colours_become_linear_on_white(void **state) {
    (void)state;
    help_import_put(
        "c.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0 255 188 0\n1 0 0 255 188 0\n0 0 1 255 188 0\n3 0 1 2\n");
    struct gn_scene *scene = help_import_load("c.ply");
    assert_int_equal(scene->buffers.colors[0], 255);
    assert_in_range(scene->buffers.colors[1], 127, 129); /* sRGB 188 is linear one half */
    assert_int_equal(scene->buffers.colors[2], 0);
    help_import_near(help_import_material(scene)->base_color[0], 1);
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
    help_import_near(back[0], -x);
    help_import_near(back[1], -y);
    help_import_near(back[2], -z);
    help_import_near(glm_vec3_norm((float *)scene->nodes[node].matrix[0]), 1);
}

static void test_a_collada_scene_keeps_its_unit_axis_and_instances(void **state) {
    (void)state;
    help_import_put("a.dae", dae);
    struct gn_scene *scene = help_import_load("a.dae");
    help_import_box(scene, -1, 0, -5, 1, 1, 0);
    assert_int_equal(scene->item_count, 2);
    assert_int_equal(scene->geometry_count, 1);
    gn_scene_destroy(scene);
}

static void test_lights_and_cameras_of_collada_stand_and_look_right(void **state) {
    (void)state;
    help_import_put("a.dae", dae);
    struct gn_scene *scene = help_import_load("a.dae");
    assert_int_equal(scene->light_count, 2);
    const struct gn_light *sun = &scene->lights[0], *spot = &scene->lights[1];
    assert_int_equal(sun->type, GN_LIGHT_DIRECTIONAL);
    help_import_near(sun->color[0], 2 * GLM_PIf);
    help_import_near(sun->color[1], GLM_PIf);
    assert_along(scene, sun->node, 0, -1, 0);
    assert_int_equal(spot->type, GN_LIGHT_SPOT);
    help_import_near(spot->outer_rad, glm_rad(20));
    help_import_near(scene->nodes[spot->node].matrix[3][1], 7);
    help_import_near(spot->color[0],
                     GLM_PIf * 1e-4f); /* pi / d^2 with d in the file's centimetres */
    assert_int_equal(scene->camera_count, 1);
    assert_along(scene, scene->cameras[0].node, 0, 0, -1);
    help_import_near(scene->nodes[scene->cameras[0].node].matrix[3][2], 3);
    help_import_near(tanf(scene->cameras[0].yfov_rad / 2), tanf(glm_rad(30)) / 2);
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
    help_import_put("a.fbx", fbx);
    struct gn_scene *scene = help_import_load("a.fbx");
    help_import_box(scene, 0, 0, -5.08f, 2.54f, 7.62f, 0);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_box_without_normals_gets_flat_ones_that_look_out),
        cmocka_unit_test(test_a_cylinder_without_normals_is_smooth_round_and_sharp_at_its_rim),
        cmocka_unit_test(test_a_place_is_one_whatever_the_sign_of_its_zeros),
        cmocka_unit_test(test_a_binary_ply_may_begin_with_any_byte),
        cmocka_unit_test(test_an_stl_has_z_up_in_either_form),
        cmocka_unit_test(test_vertex_colours_become_linear_on_white),
        cmocka_unit_test(test_a_collada_scene_keeps_its_unit_axis_and_instances),
        cmocka_unit_test(test_lights_and_cameras_of_collada_stand_and_look_right),
        cmocka_unit_test(test_an_fbx_in_inches_with_z_up_is_in_metres_with_y_up),
    };
    return help_import_run(tests, sizeof tests / sizeof *tests);
}
