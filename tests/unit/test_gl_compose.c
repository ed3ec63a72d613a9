#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl/private.h"
#include "unit/check.h"
#include "unit/gl_help.h"

static const char *folder;

static int set_up(void **state) {
    (void)state;
    folder = help_shaders();
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    help_remove(folder);
    return 0;
}

static struct gn_program_key lit_key(void) {
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = GN_PROGRAM_LIT;
    return key;
}

static char *compose(const struct gn_program_key *key, enum gn_gl_shader shader) {
    struct gn_gl_text text = {0};
    struct gn_err err = {0};
    if (!gn_gl_compose(folder, key, shader, &text, &err)) fail_msg("%s", err.text);
    return text.data;
}

static int count(const char *text, const char *what) {
    int n = 0;
    for (const char *at = text; (at = strstr(at, what)); at += strlen(what)) n++;
    return n;
}

static void has(const char *text, const char *what) {
    if (!strstr(text, what)) fail_msg("\"%s\" is not in\n%s", what, text);
}

static void test_constants(void **state) {
    (void)state;
    struct gn_program_key key = lit_key();
    key.features = GN_FEATURE(BASE_TEXTURE) | GN_FEATURE(PERSPECTIVE);
    key.light_count = 1;
    char *text = compose(&key, GN_GL_FRAGMENT);
    assert_int_equal(strncmp(text, "#version 300 es\n", 16), 0);
    has(text, "const bool BASE_TEXTURE = true;\n#define WITH_BASE_TEXTURE 1\n");
    has(text, "const bool PERSPECTIVE = true;\n");
    has(text, "const bool UNLIT = false;\n");
    has(text, "const int LIGHT_COUNT = 1;\nconst int SHADOW_COUNT = 0;\n");
    has(text, "const bool[1] LIGHT_RANGED = bool[1](false);\n");
    assert_null(strstr(text, "WITH_UNLIT"));
    assert_null(strstr(text, "WITH_SHADOWS"));
    assert_int_equal(count(text, "const bool "),
                     GN_FEATURE_COUNT + 2); /* and CUT_LAST, SHADOW_BACKS */
    free(text);
}

static void test_lights(void **state) {
    (void)state;
    struct gn_program_key key = lit_key();
    key.light_count = 4, key.shadow_count = 3;
    key.lights[0] = (struct gn_program_light){
        .type = GN_LIGHT_SPOT, .technique = GN_TECHNIQUE_HARD, .encoding = GN_ENCODING_R16F};
    key.lights[1] = (struct gn_program_light){
        .type = GN_LIGHT_DIRECTIONAL, .technique = GN_TECHNIQUE_PCF, .encoding = GN_ENCODING_DEPTH};
    key.lights[2] = (struct gn_program_light){
        .type = GN_LIGHT_DIRECTIONAL, .technique = GN_TECHNIQUE_HARD, .encoding = GN_ENCODING_R16F};
    key.lights[3] = (struct gn_program_light){.type = GN_LIGHT_POINT, .ranged = 1};
    char *text = compose(&key, GN_GL_FRAGMENT);
    has(text, "#define WITH_SHADOWS 1\n");
    has(text,
        "uniform sampler2D u_map_0;\nuniform sampler2DShadow u_map_1;\nuniform sampler2D u_map_2;");
    has(text, "#define EACH_SHADOWED_LIGHT(F)"
              " F(0, LIGHT_SPOT, true, shadow_visibility_0, u_map_0)"
              " F(1, LIGHT_DIRECTIONAL, false, shadow_visibility_1, u_map_1)"
              " F(2, LIGHT_DIRECTIONAL, false, shadow_visibility_0, u_map_2)\n");
    has(text, "#define EACH_OPEN_LIGHT(F) F(3, LIGHT_POINT)\n");
    has(text, "const bool[4] LIGHT_RANGED = bool[4](false, false, false, true);\n");
    has(text, "const bool[3] SHADOW_LINEAR = bool[3](false, true, true);\n");
    assert_int_equal(count(text, "#define tap tap_0\n"), 1);
    assert_int_equal(count(text, "#define tap tap_1\n"), 1);
    assert_int_equal(count(text, "#undef tap\n"), 2);
    assert_int_equal(count(text, "#undef MAP_SAMPLER\n"), 2);
    free(text);
    text = compose(&key, GN_GL_VERTEX);
    has(text, "#define EACH_SHADOWED_LIGHT_VERTEX(F) F(0)");
    assert_null(strstr(text, "u_map_0"));
    free(text);
}

static void test_slides_go_with_their_lights(void **state) {
    (void)state;
    help_write(folder, "lib/slide.glsl", "// slide\n");
    struct gn_program_key key = lit_key();
    key.light_count = 3, key.shadow_count = 1;
    key.lights[0] = (struct gn_program_light){
        .type = GN_LIGHT_SPOT, .technique = GN_TECHNIQUE_HARD, .encoding = GN_ENCODING_R16F};
    key.lights[1] = (struct gn_program_light){.type = GN_LIGHT_SPOT, .slide = GN_SLIDE_LIT};
    key.lights[2] =
        (struct gn_program_light){.type = GN_LIGHT_SPOT, .slide = GN_SLIDE_DARK, .slide_ends = 1};
    char *text = compose(&key, GN_GL_FRAGMENT);
    has(text, "uniform mediump sampler2D u_slide_0;\nuniform mediump sampler2D u_slide_1;\n");
    has(text, "#define WITH_SLIDES 1\n#define EACH_SLIDE(F)"
              " F(1, 0, true, false, u_slide_0) F(2, 1, false, true, u_slide_1)\n");
    assert_int_equal(count(text, "// slide\n"), 1);
    free(text);
    key.lights[1].slide = key.lights[2].slide = GN_SLIDE_NONE;
    text = compose(&key, GN_GL_FRAGMENT);
    assert_null(strstr(text, "slide"));
    free(text);
}

/* Of the shaders of the program: the folder of the others has no layers. */
static void test_layers_are_called_from_the_base_upwards(void **state) {
    (void)state;
    struct gn_program_key key = lit_key();
    struct gn_gl_text text = {0};
    struct gn_err err = {0};
    assert_true(gn_gl_compose(NULL, &key, GN_GL_FRAGMENT, &text, &err));
    has(text.data, "#define LAYERS_BEGIN(smooth_normal, s)\n");
    assert_null(strstr(text.data, "coat_begin("));
    gn_gl_text_finish(&text);
    key.features = GN_FEATURE(SPECULAR) | GN_FEATURE(COAT) | GN_FEATURE(TRANSMISSION) |
                   GN_FEATURE(COAT_TEXTURE);
    assert_true(gn_gl_compose(NULL, &key, GN_GL_FRAGMENT, &text, &err));
    has(text.data, "#define LAYERS_BEGIN(smooth_normal, s) transmission_begin(smooth_normal, s); "
                   "coat_begin(smooth_normal, s);\n");
    has(text.data, "void coat_end(surface s, inout vec3 color) {");
    has(text.data, "#define FACTOR_COAT_ROUGHNESS u_factors[1].z\n"); /* packed */
    has(text.data, "#define TEXEL_COAT texture(u_texture_coat, v_uv_coat)\n");
    has(text.data, "#define TEXEL_COAT_ROUGHNESS vec4(1.0)\n");
    gn_gl_text_finish(&text);
}

static void test_distance_has_its_encoding(void **state) {
    (void)state;
    struct gn_program_key key = lit_key();
    key.kind = GN_PROGRAM_DISTANCE;
    key.encoding = GN_ENCODING_R32UI;
    char *text = compose(&key, GN_GL_FRAGMENT);
    has(text, "uvec4 map_encode(float x)");
    free(text);
    text = compose(&key, GN_GL_VERTEX);
    assert_null(strstr(text, "map_encode"));
    free(text);
}

static void test_include_once(void **state) {
    (void)state;
    help_write(folder, "depth.frag",
               "#include \"lib/a.glsl\"\n  #include \"lib/b.glsl\"\nvoid main() {}");
    help_write(folder, "lib/a.glsl", "#include \"lib/b.glsl\"\nint a;\n");
    help_write(folder, "lib/b.glsl", "#include \"lib/a.glsl\"\nint b;\n");
    struct gn_program_key key = lit_key();
    key.kind = GN_PROGRAM_DEPTH;
    char *text = compose(&key, GN_GL_FRAGMENT);
    has(text, "int b;\nint a;\nvoid main() {}\n");
    assert_int_equal(count(text, "int a;"), 1);
    assert_int_equal(count(text, "#include"), 0);
    free(text);
}

static void fails(const char *with) {
    struct gn_program_key key = lit_key();
    key.kind = GN_PROGRAM_DEPTH;
    struct gn_gl_text text = {0};
    struct gn_err err = {0};
    assert_false(gn_gl_compose(folder, &key, GN_GL_FRAGMENT, &text, &err));
    has(err.text, with);
    gn_gl_text_finish(&text);
}

static void test_include_fails(void **state) {
    (void)state;
    help_write(folder, "depth.frag", "#include \"lib/missing.glsl\"\n");
    fails("missing.glsl");
    char name[32], text[64];
    for (int i = 0; i < 12; i++) {
        snprintf(name, sizeof name, "lib/deep%d.glsl", i);
        snprintf(text, sizeof text, "#include \"lib/deep%d.glsl\"\n", i + 1);
        help_write(folder, name, text);
    }
    help_write(folder, "depth.frag", "#include \"lib/deep0.glsl\"\n");
    fails("deep");
}

static void test_numbered(void **state) {
    (void)state;
    struct gn_gl_text text = {0};
    gn_gl_text_add(&text, "a\n\nb");
    char *numbered = gn_gl_text_numbered(&text);
    assert_string_equal(numbered, "   1  a\n   2  \n   3  b\n");
    free(numbered);
    gn_gl_text_finish(&text);
}

static void test_key_text(void **state) {
    (void)state;
    struct gn_program_key key = lit_key();
    char text[200];
    key.features = GN_FEATURE(UNLIT) | GN_FEATURE(ALPHA_MASK);
    key.light_count = 2, key.shadow_count = 1;
    key.lights[0] = (struct gn_program_light){
        .type = GN_LIGHT_SPOT, .technique = GN_TECHNIQUE_HARD, .encoding = GN_ENCODING_R16F};
    key.lights[1] = (struct gn_program_light){.type = GN_LIGHT_POINT};
    gn_gl_key_text(&key, text, sizeof text);
    assert_string_equal(text, "lit ALPHA_MASK|UNLIT, SPOT hard r16f, POINT");
    gn_gl_key_text(&key, text, 8);
    assert_string_equal(text, "lit ALP");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_constants),
        TEST(test_lights),
        TEST(test_layers_are_called_from_the_base_upwards),
        TEST(test_distance_has_its_encoding),
        TEST(test_include_once),
        TEST(test_include_fails),
        TEST(test_numbered),
        TEST(test_key_text),
        TEST(test_slides_go_with_their_lights),
    };
    return RUN(tests);
}
