#include "unit/gl_help.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "unit/check.h"
#include "unit/folder.h"

void help_open(struct gn_display *display, const char *name) {
    struct gn_err err = {0};
    if (gn_display_open(display, name, NULL, &err)) return;
    print_message("%s\n", err.text);
    skip();
}

struct gn_gl *help_gl(struct gn_display *display, const struct gn_gl_opts *extra,
                      struct gn_warnings *warnings) {
    struct gn_gl_opts opts = extra ? *extra : (struct gn_gl_opts){0};
    struct gn_err err = {0};
    opts.get_proc = gn_display_get_proc;
    opts.display = display;
    opts.desktop = display->ops->desktop;
    opts.debug = true;
    struct gn_gl *gl = gn_gl_create(&opts, warnings, &err);
    if (!gl) fail_msg("%s", err.text);
    return gl;
}

void help_stage_open(struct help_stage *stage, struct gn_scene *(*make)(void), const char *backend,
                     const char *without, struct gn_warnings *warnings) {
    struct gn_err err = {0};
    *stage = (struct help_stage){0};
    help_open(&stage->display, backend);
    stage->gl = help_gl(&stage->display, &(struct gn_gl_opts){.without = without}, warnings);
    stage->scene = make();
    stage->lights = stage->scene->lights;
    if (!gn_gl_load(stage->gl, stage->scene, &err)) fail_msg("%s", err.text);
    gn_pose_init(&stage->pose, stage->scene, GN_POSE_DEFAULT);
    stage->frame = gn_frame_create(stage->scene, gn_gl_caps(stage->gl));
}

void help_stage_light(struct help_stage *stage, struct gn_light *lights, uint32_t count) {
    stage->scene->lights = lights ? lights : stage->lights;
    stage->pose.lights = stage->scene->lights;
    stage->scene->light_count = count;
}

void help_stage_close(struct help_stage *stage) {
    help_stage_light(stage, NULL, stage->scene->light_count);
    gn_frame_destroy(stage->frame);
    gn_pose_finish(&stage->pose);
    gn_gl_destroy(stage->gl);
    gn_scene_destroy(stage->scene);
    gn_display_close(&stage->display);
}

const struct gn_plan *help_stage_draw(struct help_stage *stage, const struct gn_frame_opts *opts,
                                      struct gn_warnings *warnings) {
    struct gn_err err = {0};
    const struct gn_plan *plan = gn_frame_build(stage->frame, &stage->pose, opts, warnings);
    const char *broken = gn_plan_check(plan);
    if (broken) fail_msg("plan: %s", broken);
    if (!gn_gl_prepare(stage->gl, plan, &err) || !gn_gl_run(stage->gl, plan, NULL, &err))
        fail_msg("%s", err.text);
    return plan;
}

const char *help_folder(void) {
    static char path[64];
    snprintf(path, sizeof path, "/tmp/gnomon-test-XXXXXX");
    assert_non_null(mkdtemp(path));
    return path;
}

void help_write(const char *folder, const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *slash = strrchr(path, '/');
    *slash = 0;
    mkdir(path, 0700);
    *slash = '/';
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

void help_remove(const char *folder) { assert_int_equal(gn_test_remove_folder(folder), 0); }

void help_write_huge(const char *folder, int vertices) {
    const int bytes = 12 * vertices;
    char path[256], text[700];
    help_write(folder, "huge.bin", "");
    snprintf(path, sizeof path, "%s/huge.bin", folder);
    assert_int_equal(truncate(path, bytes), 0);
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"buffers\":[{\"byteLength\":%d,\"uri\":\"huge.bin\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[2,0,2]}]}",
        bytes, bytes, vertices);
    help_write(folder, "huge.gltf", text);
}

static float positions[] = {
    -0.5f, -1, -0.5f, 0.5f, -1, -0.5f, 0.5f, 1, -0.5f, -0.5f, 1, -0.5f, /* near, half as wide */
    -1,    -1, 0.5f,  1,    -1, 0.5f,  1,    1, 0.5f,  -1,    1, 0.5f,  /* far */
};
static float normals[8 * 3];
static float uv0[] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1};
static uint32_t indices[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
static struct gn_geometry geometries[] = {
    [HELP_NEAR] = {.first_vertex = 0, .vertex_count = 4, .first_index = 0, .index_count = 6},
    [HELP_FAR] = {.first_vertex = 4, .vertex_count = 4, .first_index = 6, .index_count = 6},
};
#define UNTRANSFORMED   .uv_from_uv = {1, 0, 0, 1, 0, 0}
#define GN_X(NAME, ...) [GN_TEXTURE_##NAME] = {.texture = -1, UNTRANSFORMED},
#define GN_Y(NAME, ...)                                                                            \
    [GN_TEXTURE_##NAME] = {.texture = GN_TEXTURE_##NAME == 0 ? 0 : -1, UNTRANSFORMED},
static struct gn_material materials[] = {
    {.name = "plain", .textures = {GN_TEXTURE_SLOTS(GN_X)}},
    {.name = "textured", .textures = {GN_TEXTURE_SLOTS(GN_Y)}},
};
#undef GN_X
#undef GN_Y
static const uint8_t pixels[] = {255, 0, 0,   255, 0,   255, 0,   255,
                                 0,   0, 255, 255, 255, 255, 255, 255};
static struct gn_image images[] = {{.width_px = 2, .height_px = 2, .rgba = pixels}};
static struct gn_texture textures[] = {{.image = 0, .mag_nearest = true, .min_nearest = true}};

const struct gn_scene help_scene = {
    .name = "squares",
    .buffers = {.positions = positions,
                .normals = normals,
                .uv0 = uv0,
                .indices = indices,
                .vertex_count = 8,
                .index_count = 12},
    .geometries = geometries,
    .geometry_count = 2,
    .materials = materials,
    .material_count = 2,
    .pictures = {.images = images, .textures = textures, .image_count = 1, .texture_count = 1},
};

static const char vertex[] =
    "layout(location = 0) in vec3 a_position;\n"
    "layout(location = 2) in vec2 a_uv0;\n"
    "layout(location = 10) in vec4 a_world_0;\n"
    "layout(location = 11) in vec4 a_world_1;\n"
    "layout(location = 12) in vec4 a_world_2;\n"
    "layout(location = 13) in vec4 a_base_color;\n"
    "uniform vec4 u_uv[8];\n"
    "out vec4 v_color;\n"
    "out vec2 v_uv;\n"
    "void main() {\n"
    "    vec4 p = vec4(a_position, 1.0);\n"
    "    v_color = a_base_color;\n"
    "    v_uv = vec2(dot(u_uv[0].xyz, vec3(a_uv0, 1.0)), dot(u_uv[1].xyz, vec3(a_uv0, 1.0)));\n"
    "    gl_Position = vec4(dot(a_world_0, p), dot(a_world_1, p), dot(a_world_2, p), 1.0);\n"
    "}\n";
static const char lit[] = "uniform vec4 u_pass[PASS_SIZE];\n"
                          "in vec4 v_color;\n"
                          "in vec2 v_uv;\n"
                          "#ifdef WITH_BASE_TEXTURE\n"
                          "uniform sampler2D u_texture_base;\n"
                          "#endif\n"
                          "layout(location = 0) out vec4 o_color;\n"
                          "#define SEE(slot, type, radial, see, map) o_color *= see(map);\n"
                          "void main() {\n"
                          "    o_color = v_color + u_pass[0];\n"
                          "#ifdef WITH_BASE_TEXTURE\n"
                          "    o_color *= texture(u_texture_base, v_uv);\n"
                          "#endif\n"
                          "    EACH_SHADOWED_LIGHT(SEE)\n"
                          "}\n";
static const char aov[] = "uniform vec4 u_pass[PASS_SIZE];\n"
                          "in vec4 v_color;\n"
                          "layout(location = 0) out uvec4 o_bits;\n"
                          "void main() { o_bits = floatBitsToUint(v_color + u_pass[0]); }\n";
static const char distance_stage[] = "uniform vec4 u_pass[PASS_SIZE];\n"
                                     "layout(location = 0) out MAP_OUT o_code;\n"
                                     "void main() { o_code = map_encode(u_pass[0].x); }\n";

const char *help_shaders(void) {
    const char *folder = help_folder();
    help_write(folder, "blocks.glsl", "#define PASS_SIZE 2\n");
    help_write(folder, "lit.vert", vertex);
    help_write(folder, "lit.frag", lit);
    help_write(folder, "aov.frag", aov);
    help_write(folder, "depth.vert", vertex);
    help_write(folder, "depth.frag", "void main() {}\n");
    help_write(folder, "flat.vert", vertex);
    help_write(folder, "flat.frag", "void main() {}\n");
    help_write(folder, "distance.vert", vertex);
    help_write(folder, "distance.frag", distance_stage);
    help_write(folder, "lib/map_depth.glsl",
               "//@ names tap\n#define MAP_SAMPLER sampler2DShadow\n"
               "float tap(MAP_SAMPLER map) { return texture(map, vec3(0.5)); }\n");
    help_write(folder, "lib/map_r16f.glsl",
               "//@ names tap map_encode\n#define MAP_SAMPLER sampler2D\n#define MAP_OUT vec4\n"
               "vec4 map_encode(float x) { return vec4(x, 0.0, 0.0, 1.0); }\n"
               "float tap(MAP_SAMPLER map) { return texture(map, vec2(0.5)).r; }\n");
    help_write(
        folder, "lib/map_rgba8.glsl",
        "//@ names tap map_encode\n#define MAP_SAMPLER sampler2D\n#define MAP_OUT vec4\n"
        "vec4 map_encode(float x) { return vec4(floor(x * 256.0) / 255.0, 0.0, 0.0, 0.0); }\n"
        "float tap(MAP_SAMPLER map) { return texture(map, vec2(0.5)).r; }\n");
    help_write(
        folder, "lib/map_r32ui.glsl",
        "//@ names tap map_encode\n#define MAP_SAMPLER usampler2D\n#define MAP_OUT uvec4\n"
        "uvec4 map_encode(float x) { return uvec4(floatBitsToUint(x), 0u, 0u, 1u); }\n"
        "float tap(MAP_SAMPLER map) { return uintBitsToFloat(texture(map, vec2(0.5)).r); }\n");
    help_write(folder, "lib/shadow_place.glsl", "");
    help_write(folder, "lib/map_lit.glsl", "");
    help_write(folder, "shadow/hard.glsl",
               "//@ names shadow_visibility\n"
               "float shadow_visibility(MAP_SAMPLER map) { return tap(map); }\n");
    help_write(folder, "shadow/pcf.glsl",
               "//@ names shadow_visibility\n"
               "float shadow_visibility(MAP_SAMPLER map) { return tap(map); }\n");
    return folder;
}
