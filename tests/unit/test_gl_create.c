#include <stdlib.h>
#include <string.h>

#include "gl/private.h"
#include "unit/check.h"
#include "unit/gl_help.h"

static struct gn_gl_opts opts_of(struct gn_display *display) {
    return (struct gn_gl_opts){
        .get_proc = gn_display_get_proc, .display = display, .desktop = display->ops->desktop};
}

/* All that Mesa's software drivers have is proved, on either backend. */
static void test_proved(void **state) {
    struct gn_display display;
    help_open(&display, *state);
    struct gn_gl *gl = help_gl(&display, NULL, NULL);
    const struct gn_caps *caps = gn_gl_caps(gl);
    assert_true(caps->max_texture_px >= 2048 && caps->max_texture_units >= 16);
    assert_true(*caps->vendor && *caps->renderer && *caps->version);
    if (caps->software) assert_int_equal(caps->has & 0x3f, 0x3f);
    gn_gl_destroy(gl);
    gn_display_close(&display);
}

/* ---- a driver that says more than it can ---- */

static PFNGLREADPIXELSPROC read_pixels;

/* Half floats come back as zeros. */
static void GL_APIENTRY read_no_halves(GLint x, GLint y, GLsizei width, GLsizei height,
                                       GLenum format, GLenum type, void *out) {
    read_pixels(x, y, width, height, format, type, out);
    if (type == GL_FLOAT) memset(out, 0, 16ul * (size_t)width * (size_t)height);
    if (type == GL_HALF_FLOAT) memset(out, 0, 8ul * (size_t)width * (size_t)height);
}

static gn_gl_proc get_liar(void *display, const char *name) {
    gn_gl_proc proc = gn_display_get_proc(display, name);
    if (strcmp(name, "glReadPixels") != 0) return proc;
    read_pixels = (PFNGLREADPIXELSPROC)proc;
    return (gn_gl_proc)read_no_halves;
}

/* A GPU that was reset, of which the driver says nothing: all memory is zeros. */
static bool was_reset;
static void GL_APIENTRY read_what_is_left(GLint x, GLint y, GLsizei width, GLsizei height,
                                          GLenum format, GLenum type, void *out) {
    read_pixels(x, y, width, height, format, type, out);
    if (was_reset) memset(out, 0, 4ul * (size_t)width * (size_t)height);
}

static gn_gl_proc get_reset(void *display, const char *name) {
    gn_gl_proc proc = gn_display_get_proc(display, name);
    if (strcmp(name, "glReadPixels") != 0) return proc;
    read_pixels = (PFNGLREADPIXELSPROC)proc;
    return (gn_gl_proc)read_what_is_left;
}

static void test_reset_without_a_word(void **state) {
    struct gn_display display;
    struct gn_err err = {0};
    help_open(&display, *state);
    struct gn_gl_opts opts = opts_of(&display);
    opts.get_proc = get_reset;
    struct gn_gl *gl = gn_gl_create(&opts, NULL, &err);
    assert_non_null(gl);
    for (int i = 0; i < 4; i++) {
        was_reset = i % 2;
        assert_false(gn_gl_is_lost(gl));
        assert_int_equal(gn_gl_draws_right(gl), !was_reset);
    }
    was_reset = false;
    gn_gl_destroy(gl);
    gn_display_close(&display);
}

static const uint32_t halves = 1u << GN_CAP_R16F | 1u << GN_CAP_RGBA16F;

static void test_liar(void **state) {
    struct gn_display display;
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    help_open(&display, *state);
    struct gn_gl_opts opts = opts_of(&display);
    opts.get_proc = get_liar;
    struct gn_gl *gl = gn_gl_create(&opts, &warnings, &err);
    assert_non_null(gl);
    const struct gn_caps *caps = gn_gl_caps(gl);
    assert_int_equal(caps->has & halves, 0);
    if (caps->software) assert_int_equal(caps->has & 0x3f, 0x3f & ~halves);
    assert_int_equal(warnings.count, 3); /* r16f, rgba16f, rg16f */
    assert_non_null(strstr(warnings.text[0], "r16f"));
    gn_gl_destroy(gl);
    gn_display_close(&display);
}

/* The same, found out when a plan first asks: the plan built after that has another map format. */
static void test_liar_found_late(void **state) {
    struct gn_display display;
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    help_open(&display, *state);
    struct gn_gl_opts opts = opts_of(&display);
    opts.get_proc = get_liar;
    opts.prove_later = true;
    struct gn_gl *gl = gn_gl_create(&opts, &warnings, &err);
    assert_non_null(gl);
    if (!gn_gl_caps(gl)->software) skip();
    assert_int_equal(gn_gl_caps(gl)->has & halves, halves);
    struct gn_pass pass = {.kind = GN_PASS_MAP,
                           .target = {.kind = GN_TARGET_SHADOW, .encoding = GN_ENCODING_R16F}};
    struct gn_plan plan = {.passes = &pass, .pass_count = 1, .output = GN_OUTPUT_SRGB8};
    assert_false(gn_gl_prove(gl, &plan));
    assert_int_equal(gn_gl_caps(gl)->has & halves, 1u << GN_CAP_RGBA16F);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "claims r16f but a test draw failed"));
    bool fell_back;
    const uint32_t encodings = gn_caps_encodings(gn_gl_caps(gl));
    pass.target.encoding =
        gn_encoding_choose(GN_TECHNIQUE_HARD, GN_ENCODING_AUTO, encodings, &fell_back);
    assert_int_equal(pass.target.encoding, GN_ENCODING_R32UI);
    assert_true(gn_gl_prove(gl, &plan));
    plan.output = GN_OUTPUT_FLOAT;
    assert_false(gn_gl_prove(gl, &plan));
    assert_int_equal(gn_gl_caps(gl)->has & halves, 0);
    assert_int_equal(warnings.count, 2);
    gn_gl_destroy(gl);
    gn_display_close(&display);
}

static void test_without(void **state) {
    struct gn_display display;
    help_open(&display, *state);
    struct gn_gl *gl = help_gl(&display, &(struct gn_gl_opts){.without = "r16f,srgb"}, NULL);
    assert_int_equal(gn_gl_caps(gl)->has & (1u << GN_CAP_R16F | 1u << GN_CAP_SRGB), 0);
    gn_gl_destroy(gl);
    struct gn_err err = {0};
    struct gn_gl_opts opts = opts_of(&display);
    opts.without = "r16f,wings";
    assert_null(gn_gl_create(&opts, NULL, &err));
    assert_int_equal(err.status, GN_EXIT_USAGE);
    assert_non_null(strstr(err.text, "\"wings\""));
    assert_non_null(strstr(err.text, "depth-compare, r32ui"));
    gn_display_close(&display);
}

static void test_failed_program(void **state) {
    struct gn_display display;
    help_open(&display, *state);
    const char *folder = help_shaders();
    help_write(folder, "depth.frag", "void main() {\n    nonsense(1);\n}\n");
    struct gn_gl *gl = help_gl(&display, &(struct gn_gl_opts){.shaders = folder}, NULL);
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = GN_PROGRAM_DEPTH;
    key.features = GN_FEATURE(UNLIT);
    struct gn_err err = {0};
    char *log = NULL;
    assert_false(gn_gl_try_program(gl, &key, &log, &err));
    assert_non_null(strstr(err.text, "shader program (depth UNLIT): fragment: "));
    assert_non_null(strstr(err.text, "nonsense"));
    assert_null(strchr(err.text, '\n'));
    assert_non_null(log);
    assert_non_null(strstr(log, "   1  #version 300 es\n"));
    assert_non_null(strstr(log, "nonsense(1);"));
    free(log);
    key.kind = GN_PROGRAM_LIT;
    assert_true(gn_gl_try_program(gl, &key, NULL, &err));
    gn_gl_destroy(gl);
    gn_display_close(&display);
    help_remove(folder);
}

/* A kiosk that is to end while its programs compile. */
static int programs_left;
static bool stop(void) { return programs_left-- <= 0; }

static void test_stopped_between_programs(void **state) {
    struct gn_display display;
    struct gn_err err = {0};
    help_open(&display, *state);
    struct gn_gl *gl = help_gl(&display, &(struct gn_gl_opts){.stop = stop}, NULL);
    struct gn_scene *scene = gn_scene_load("assets/sundial.glb", NULL, NULL, &err);
    if (!scene || !gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    struct gn_frame *frame = gn_frame_create(scene, gn_gl_caps(gl));
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    const struct gn_frame_opts opts = {.output.width_px = 64, .output.height_px = 36};
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    const int count = (int)plan->program_count;
    assert_true(count > 2);
    const uint64_t made = gl->programs.made;
    for (int i = 0; i < count - 1; i++) { /* one more each time */
        programs_left = 1;
        assert_false(gn_gl_prepare(gl, plan, &err));
        assert_string_equal(err.text, "interrupted while compiling programs");
        assert_int_equal(gl->programs.made, made + (uint64_t)i + 1);
    }
    programs_left = 1000;
    assert_true(gn_gl_prepare(gl, plan, &err));
    assert_int_equal(gl->programs.made, made + (uint64_t)count);
    programs_left = 1; /* drivers compile as they draw: so each first draw is asked for, too */
    assert_false(gn_gl_run(gl, plan, NULL, &err));
    programs_left = 1000;
    assert_true(gn_gl_run(gl, plan, NULL, &err));
    programs_left = 0; /* nothing is asked any more */
    assert_true(gn_gl_prepare(gl, plan, &err) && gn_gl_run(gl, plan, NULL, &err));
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_gl_destroy(gl);
    gn_scene_destroy(scene);
    gn_display_close(&display);
}

/* ---- a driver that gives functions of extensions that it has not, as EGL lets it ---- */

static int groups_pushed, groups_popped;
static void GL_APIENTRY push_group(GLenum source, GLuint id, GLsizei length, const GLchar *text) {
    (void)source, (void)id, (void)length, (void)text;
    groups_pushed++;
}
static void GL_APIENTRY pop_group(void) { groups_popped++; }

static gn_gl_proc get_groups(void *display, const char *name) {
    if (strncmp(name, "glPushDebugGroup", 16) == 0) return (gn_gl_proc)push_group;
    if (strncmp(name, "glPopDebugGroup", 15) == 0) return (gn_gl_proc)pop_group;
    return gn_display_get_proc(display, name);
}

static void draw_in_groups(struct gn_display *display, const char *without, bool *has_debug) {
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    struct gn_gl_opts opts = opts_of(display);
    opts.get_proc = get_groups;
    opts.debug = true;
    opts.without = without;
    struct gn_gl *gl = gn_gl_create(&opts, &warnings, &err);
    assert_non_null(gl);
    struct gn_scene *scene = gn_scene_load("assets/sundial.glb", NULL, NULL, &err);
    if (!scene || !gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    struct gn_frame *frame = gn_frame_create(scene, gn_gl_caps(gl));
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    const struct gn_frame_opts frame_opts = {.output.width_px = 64, .output.height_px = 36};
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &frame_opts, NULL);
    groups_pushed = groups_popped = 0;
    *has_debug = gn_gl_caps(gl)->has & 1u << GN_CAP_DEBUG;
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err))
        fail_msg("%s", err.text);
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_gl_destroy(gl);
    gn_scene_destroy(scene);
}

static void test_groups_only_by_the_extension(void **state) {
    struct gn_display display;
    bool has_debug;
    help_open(&display, *state);
    draw_in_groups(&display, "debug", &has_debug);
    assert_false(has_debug);
    assert_int_equal(groups_pushed + groups_popped, 0);
    draw_in_groups(&display, NULL, &has_debug);
    assert_int_equal(groups_pushed > 0, has_debug);
    assert_int_equal(groups_popped, groups_pushed);
    gn_display_close(&display);
}

static void test_destroy_null(void **state) {
    (void)state;
    gn_gl_destroy(NULL);
}

/* The shaders that the program holds: each kind compiles, with nothing on and with a light of each.
 */
static void test_embedded(void **state) {
    struct gn_display display;
    help_open(&display, *state);
    struct gn_gl *gl = help_gl(&display, NULL, NULL);
    for (int kind = 0; kind < GN_PROGRAM_KIND_COUNT; kind++) {
        struct gn_program_key key;
        memset(&key, 0, sizeof key);
        key.kind = (uint8_t)kind;
        key.encoding = kind == GN_PROGRAM_DISTANCE ? GN_ENCODING_R32UI : 0;
        key.aov = kind == GN_PROGRAM_AOV ? GN_AOV_NORMAL : 0;
        if (kind == GN_PROGRAM_FILTER) {
            key.technique = GN_TECHNIQUE_MSM;
            key.moments = GN_MOMENTS_RGBA16UI;
            key.encoding = GN_ENCODING_R32UI;
        }
        struct gn_err err = {0};
        char *log = NULL;
        if (!gn_gl_try_program(gl, &key, &log, &err)) fail_msg("%s\n%s", err.text, log);
    }
    gn_gl_destroy(gl);
    gn_display_close(&display);
}

#define TEST(name)                                                                                 \
    {#name " egl", name, NULL, NULL, "egl"}, { #name " osmesa", name, NULL, NULL, "osmesa" }

/* As Mesa's drivers and the makers' own name themselves. */
static void test_software_by_name(void **state) {
    (void)state;
    static const char *const gpus[] = {"V3D 4.2.14.0",
                                       "V3D 7.1.7.0",
                                       "Mali-G52 r1 (Panfrost)",
                                       "Mali-G610 (Panfrost)",
                                       "Mali-G610",
                                       "FD618",
                                       "Adreno (TM) 650",
                                       "PowerVR AXE-1-16M",
                                       "zink Vulkan 1.3(PowerVR B-Series BXS-4-64 (IMG))",
                                       "Mesa Intel(R) UHD Graphics 620 (KBL GT2)",
                                       "AMD Radeon RX 580 Series (polaris10)",
                                       "NVIDIA H200/PCIe/SSE2",
                                       "Vivante GC7000 rev 6214",
                                       "FDO"};
    static const char *const others[] = {
        "llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "virgl (llvmpipe)",
        "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)"};
    for (size_t i = 0; i < sizeof gpus / sizeof *gpus; i++)
        if (gn_gl_is_software(gpus[i])) fail_msg("%s", gpus[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!gn_gl_is_software(others[i])) fail_msg("%s", others[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_destroy_null),
        TEST(test_proved),
        TEST(test_without),
        TEST(test_liar),
        TEST(test_liar_found_late),
        TEST(test_reset_without_a_word),
        TEST(test_failed_program),
        TEST(test_stopped_between_programs),
        TEST(test_groups_only_by_the_extension),
        TEST(test_embedded),
        cmocka_unit_test(test_software_by_name),
    };
    return RUN(tests);
}
