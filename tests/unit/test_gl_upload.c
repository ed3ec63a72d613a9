#include "unit/gl_hand.h"

static void test_wide_indices(void **state) {
    (void)state;
    enum { FIRST = 70000 };
    struct gn_scene scene = help_scene;
    scene.buffers.vertex_count = FIRST + 4;
    scene.buffers.positions = calloc(scene.buffers.vertex_count, 3 * sizeof(float));
    scene.buffers.normals = calloc(scene.buffers.vertex_count, 3 * sizeof(float));
    scene.buffers.uv0 = NULL;
    scene.buffers.colors = calloc(scene.buffers.vertex_count, 4);
    memcpy(scene.buffers.positions + 3 * FIRST, help_scene.buffers.positions + 12,
           12 * sizeof(float));
    uint32_t indices[12];
    for (int i = 0; i < 12; i++) indices[i] = help_scene.buffers.indices[i] % 4 + FIRST;
    scene.buffers.indices = indices;
    assert_true(gn_gl_load(gl, &scene, &err));
    begin_plan(GN_OUTPUT_LINEAR8);
    s.plan.scene = &scene;
    add_draw(HELP_FAR, instance(0, 1, 0, 1));
    show();
    expect(0, 0, 0, 255, 0);
    free(scene.buffers.positions);
    free(scene.buffers.normals);
    free(scene.buffers.colors);
}

static void test_large_image(void **state) {
    (void)state;
    gl->caps.max_texture_px = 1;
    assert_true(gn_gl_load(gl, &help_scene, &err));
    assert_int_equal(warnings.count, 1);
    begin_plan(GN_OUTPUT_SRGB8);
    s.programs[0].features = GN_FEATURE(BASE_TEXTURE);
    add_draw(HELP_FAR, instance(1, 1, 1, 1))->material = 1;
    show();
    expect(8, 8, 188, 188, 188); /* the mean of light, not of codes */
}

/* The smallest level of a picture of four colours, made by us or by the driver: their mean. */
static void test_mipmaps(void **state) {
    (void)state;
    struct gn_scene scene = help_scene;
    struct gn_texture texture = {.image = 0, .mipmaps = true};
    struct gn_image image = help_scene.pictures.images[0];
    image.mipmaps = true;
    scene.pictures.images = &image;
    scene.pictures.textures = &texture;
    for (int software = 0; software < 2; software++) {
        gl->caps.software = software;
        assert_true(gn_gl_load(gl, &scene, &err));
        begin_plan(GN_OUTPUT_SRGB8);
        s.plan.scene = &scene;
        s.programs[0].features = GN_FEATURE(BASE_TEXTURE);
        add_draw(HELP_FAR, instance(1, 1, 1, 1))->material = 1;
        s.instances[0].world[0][0] = s.instances[0].world[1][1] = 0.0625f; /* a pixel */
        s.instances[0].world[0][3] = s.instances[0].world[1][3] = 0.0625f;
        show();
        expect(8, 7, 188, 188, 188);
    }
}

/* A texture costs time of its own, however small its picture is: 50,000 in a step of 1 MiB stopped
 * frames for seconds. */
static void test_small_pictures_are_uploaded_a_few_at_a_time(void **state) {
    (void)state;
    enum { COUNT = 1000 };
    struct gn_scene scene = help_scene;
    struct gn_image *images = calloc(COUNT, sizeof *images);
    struct gn_texture *textures = calloc(COUNT, sizeof *textures);
    struct gn_material *materials = calloc(COUNT, sizeof *materials);
    for (uint32_t i = 0; i < COUNT; i++) {
        images[i] = help_scene.pictures.images[0];
        textures[i] = help_scene.pictures.textures[0];
        textures[i].image = i;
        materials[i] = help_scene.materials[1];
        materials[i].textures[0].texture = (int32_t)i;
    }
    scene.pictures = (struct gn_scene_pictures){
        .images = images, .textures = textures, .image_count = COUNT, .texture_count = COUNT};
    scene.materials = materials;
    scene.material_count = COUNT;
    gn_gl_staged_begin(gl, &scene);
    bool whole = false;
    while (!whole) {
        const uint64_t before = gl->objects_created;
        assert_true(gn_gl_staged_step(gl, 1 << 20, &whole, &err));
        assert_true(gl->objects_created - before <= 65);
    }
    assert_int_equal(gl->staged->texture_bytes, COUNT * 16);
    gn_gl_staged_begin(gl, NULL);
    free(images);
    free(textures);
    free(materials);
}

/* A driver may compile for wrapping and mipmaps at the first draw with them. */
static void test_a_program_is_warmed_with_each_set_of_textures(void **state) {
    (void)state;
    struct gn_scene scene = help_scene;
    struct gn_texture textures[2] = {{.image = 0}, {.image = 0, .wrap_s = GN_WRAP_CLAMP}};
    struct gn_material materials[2] = {help_scene.materials[1], help_scene.materials[1]};
    materials[1].textures[0].texture = 1;
    scene.pictures.textures = textures;
    scene.pictures.texture_count = 2;
    scene.materials = materials;
    assert_true(gn_gl_load(gl, &scene, &err));
    for (int textured = 0; textured < 2; textured++) {
        begin_plan(GN_OUTPUT_SRGB8);
        s.plan.scene = &scene;
        if (textured) s.programs[0].features = GN_FEATURE(BASE_TEXTURE);
        for (int i = 0; i < 4; i++)
            add_draw(HELP_FAR, instance(1, 1, 1, 1))->material = (uint32_t)i / 2;
        const uint64_t before = gl->stats.draws;
        while (gn_gl_warm(gl, &s.plan, true, &err) == GN_GL_WARM_MORE) {
        }
        assert_int_equal(gl->stats.draws - before, textured ? 2 : 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_wide_indices),
        TEST(test_large_image),
        TEST(test_mipmaps),
        TEST(test_a_program_is_warmed_with_each_set_of_textures),
        TEST(test_small_pictures_are_uploaded_a_few_at_a_time),
    };
    return RUN(tests);
}
