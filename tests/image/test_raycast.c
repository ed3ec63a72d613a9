/* The oracle against what can be written down: boxes by intervals, disks by segments of a circle,
 * holes by arithmetic. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/dice.h"
#include "truth/raycast.h"
#include "unit/check.h"

static struct gn_dice dice;
static double between(double low, double high) { return gn_dice_between(&dice, low, high); }

/* --- a scene in memory --- */

enum { THINGS = 8, VERTICES = 24 * THINGS, INDICES = 36 * THINGS };
struct small {
    struct gn_scene scene;
    struct gn_pose pose;
    struct gn_item items[THINGS];
    struct gn_pose_item posed[THINGS];
    struct gn_geometry geometries[THINGS];
    struct gn_material materials[THINGS];
    struct gn_image image;
    struct gn_texture texture;
    float positions[3 * VERTICES], uv[2 * VERTICES];
    uint8_t colors[4 * VERTICES];
    uint32_t indices[INDICES];
};

static void small_init(struct small *s) {
    memset(s, 0, sizeof *s);
    s->scene = (struct gn_scene){.buffers.positions = s->positions,
                                 .buffers.uv0 = s->uv,
                                 .buffers.colors = s->colors,
                                 .buffers.indices = s->indices,
                                 .items = s->items,
                                 .geometries = s->geometries,
                                 .materials = s->materials,
                                 .pictures.images = &s->image,
                                 .pictures.textures = &s->texture};
    s->pose =
        (struct gn_pose){.scene = &s->scene, .items = s->posed, .materials = s->scene.materials};
}

/* Starts an item of its own geometry and material; quads are added to the last one. */
static struct gn_material *small_item(struct small *s) {
    uint32_t i = s->scene.item_count++;
    s->items[i] = (struct gn_item){.geometry = i,
                                   .material = i,
                                   .instance = -1,
                                   .skin = -1,
                                   .morph = -1,
                                   .casts = true,
                                   .receives = true};
    s->geometries[i] = (struct gn_geometry){.first_vertex = s->scene.buffers.vertex_count,
                                            .first_index = s->scene.buffers.index_count};
    s->materials[i] = (struct gn_material){.base_color = {1, 1, 1, 1}, .alpha_cutoff = .5f};
    s->materials[i].textures[GN_TEXTURE_BASE] =
        (struct gn_texture_ref){.texture = -1, .uv_from_uv = {1, 0, 0, 1, 0, 0}};
    s->posed[i].visible = true;
    glm_mat4_identity(s->posed[i].world_from_item);
    return &s->materials[i];
}

/* Corners a, a + u, a + u + v, a + v; front towards u x v; texture coordinates 0..1 along u and v.
 */
static void small_quad(struct small *s, const float a[3], const float u[3], const float v[3]) {
    static const int order[6] = {0, 1, 2, 0, 2, 3};
    struct gn_geometry *g = &s->geometries[s->scene.item_count - 1];
    for (int c = 0; c < 4; c++) {
        float along = c == 1 || c == 2, up = c >= 2;
        uint32_t vertex = s->scene.buffers.vertex_count + c;
        for (int k = 0; k < 3; k++) s->positions[3 * vertex + k] = a[k] + along * u[k] + up * v[k];
        s->uv[2 * vertex] = along;
        s->uv[2 * vertex + 1] = up;
        memset(&s->colors[4 * vertex], 255, 4);
    }
    for (int i = 0; i < 6; i++)
        s->indices[s->scene.buffers.index_count++] = s->scene.buffers.vertex_count + order[i];
    s->scene.buffers.vertex_count += 4;
    g->vertex_count += 4;
    g->index_count += 6;
}

static void small_ground(struct small *s, float half) {
    small_item(s);
    small_quad(s, (float[]){-half, 0, half}, (float[]){2 * half, 0, 0}, (float[]){0, 0, -2 * half});
}

static void small_box(struct small *s, const float low[3], const float high[3]) {
    float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    small_item(s);
    small_quad(s, low, (float[]){x, 0, 0}, (float[]){0, 0, z});
    small_quad(s, low, (float[]){0, 0, z}, (float[]){0, y, 0});
    small_quad(s, low, (float[]){0, y, 0}, (float[]){x, 0, 0});
    small_quad(s, high, (float[]){-x, 0, 0}, (float[]){0, 0, -z});
    small_quad(s, high, (float[]){0, -y, 0}, (float[]){0, 0, -z});
    small_quad(s, high, (float[]){-x, 0, 0}, (float[]){0, -y, 0});
}

static struct gn_ray_surface on_ground(double x, double z) {
    return (struct gn_ray_surface){
        .point_ws = {x, 0, z}, .normal_ws = {0, 1, 0}, .item = GN_RAY_NO_ITEM};
}

static struct gn_ray_lamp sun(double x, double y, double z) {
    double length = sqrt(x * x + y * y + z * z);
    return (struct gn_ray_lamp){.type = GN_LIGHT_DIRECTIONAL,
                                .direction_ws = {x / length, y / length, z / length},
                                .range_m = INFINITY};
}

/* Looks along -Z from (0, 0, 5); the pixel is 2 mm at distance 1. */
static const struct gn_ray_eye front_eye = {.position_ws = {0, 0, 5},
                                            .right = {1, 0, 0},
                                            .up = {0, 1, 0},
                                            .forward = {0, 0, -1},
                                            .half_width = .1,
                                            .half_height = .1,
                                            .near_m = .01,
                                            .far_m = INFINITY,
                                            .width_px = 100,
                                            .height_px = 100};

/* --- what the eye sees --- */

/* A quad at z = 0 that fills the view, its front towards the eye unless turned; a wall at z = -1
 * behind it. */
static uint32_t item_in_view(bool turned, bool mirrored, bool double_sided, enum gn_alpha alpha) {
    struct small s;
    small_init(&s);
    struct gn_material *material = small_item(&s);
    material->double_sided = double_sided;
    material->alpha = alpha;
    if (turned)
        small_quad(&s, (float[]){1, -1, 0}, (float[]){-2, 0, 0}, (float[]){0, 2, 0});
    else
        small_quad(&s, (float[]){-1, -1, 0}, (float[]){2, 0, 0}, (float[]){0, 2, 0});
    if (mirrored) {
        s.posed[0].world_from_item[0][0] = -1;
        s.posed[0].mirrored = true;
    }
    small_item(&s);
    small_quad(&s, (float[]){-9, -9, -1}, (float[]){18, 0, 0}, (float[]){0, 18, 0});
    struct gn_raycast rays;
    struct gn_ray_surface seen;
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    assert_true(gn_raycast_eye(&rays, &front_eye, 40, 60, &seen));
    assert_true(seen.normal_ws[2] == 1);
    gn_raycast_finish(&rays);
    return seen.item;
}

static void test_eye_culls_as_gltf_has_it(void **state) {
    (void)state;
    assert_int_equal(item_in_view(false, false, false, GN_ALPHA_OPAQUE), 0);
    assert_int_equal(item_in_view(true, false, false, GN_ALPHA_OPAQUE), 1);
    assert_int_equal(item_in_view(true, false, true, GN_ALPHA_OPAQUE), 0);
    assert_int_equal(item_in_view(false, true, false, GN_ALPHA_OPAQUE), 0);
    assert_int_equal(item_in_view(true, true, false, GN_ALPHA_OPAQUE), 1);
    assert_int_equal(item_in_view(false, false, true, GN_ALPHA_BLEND), 1);
    assert_int_equal(item_in_view(false, false, false, GN_ALPHA_MASK), 0);
}

static void test_eye_looks_through_the_middle_of_pixels(void **state) {
    (void)state;
    struct small s;
    struct gn_raycast rays;
    struct gn_ray_surface seen;
    small_init(&s);
    small_item(&s);
    small_quad(&s, (float[]){-9, -9, 0}, (float[]){18, 0, 0}, (float[]){0, 18, 0});
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    assert_true(gn_raycast_eye(&rays, &front_eye, 0, 0, &seen)); /* top left */
    assert_true(fabs(seen.point_ws[0] + .99 * .1 * 5) < 1e-12);
    assert_true(fabs(seen.point_ws[1] - .99 * .1 * 5) < 1e-12);
    assert_true(fabs(seen.distance_m - 5 * sqrt(1 + 2 * .099 * .099)) < 1e-12);
    assert_true(fabs(gn_ray_eye_pixel_m(&front_eye, seen.point_ws) - .01) < 1e-12);
    struct gn_ray_eye flat = front_eye;
    flat.orthographic = true;
    assert_true(gn_raycast_eye(&rays, &flat, 99, 99, &seen)); /* bottom right */
    assert_true(fabs(seen.point_ws[0] - .099) < 1e-12);
    assert_true(fabs(seen.point_ws[1] + .099) < 1e-12);
    flat.near_m = 5.5;
    assert_false(gn_raycast_eye(&rays, &flat, 50, 50, &seen));
    flat.near_m = .1;
    flat.far_m = 4.5;
    assert_false(gn_raycast_eye(&rays, &flat, 50, 50, &seen));
    gn_raycast_finish(&rays);
}

/* --- holes --- */

struct hole_case {
    enum gn_wrap wrap;
    bool nearest;
    double cutoff, u;
    bool opaque;
};

/* A texture of two texels, opaque and clear, on a quad of texture coordinates -2 .. 2 (scale 4,
 * offset -2). */
static bool is_opaque(const struct hole_case *hole) {
    static const uint8_t texels[8] = {0, 0, 0, 255, 0, 0, 0, 0};
    struct small s;
    small_init(&s);
    s.image = (struct gn_image){.width_px = 2, .height_px = 1, .rgba = texels, .has_alpha = true};
    s.texture = (struct gn_texture){
        .wrap_s = hole->wrap, .wrap_t = hole->wrap, .mag_nearest = hole->nearest};
    struct gn_material *material = small_item(&s);
    material->alpha = GN_ALPHA_MASK;
    material->alpha_cutoff = (float)hole->cutoff;
    material->textures[GN_TEXTURE_BASE] =
        (struct gn_texture_ref){.texture = 0, .uv_from_uv = {4, 0, 0, 1, -2, 0}};
    small_quad(&s, (float[]){-2, 1, 2}, (float[]){4, 0, 0}, (float[]){0, 0, -4});
    struct gn_raycast rays;
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    struct gn_ray_surface below = on_ground(hole->u, 0);
    struct gn_ray_lamp lamp = sun(0, -1, 0);
    bool dark = !gn_raycast_visible(&rays, &lamp, &below);
    gn_raycast_finish(&rays);
    return dark;
}

static void test_masked_surfaces_cast_their_holes(void **state) {
    (void)state;
    static const struct hole_case cases[] = {
        {GN_WRAP_REPEAT, true, .5, .49, true},    {GN_WRAP_REPEAT, true, .5, .51, false},
        {GN_WRAP_REPEAT, true, .5, 1.25, true},   {GN_WRAP_REPEAT, true, .5, -.25, false},
        {GN_WRAP_CLAMP, true, .5, 1.25, false},   {GN_WRAP_CLAMP, true, .5, -.25, true},
        {GN_WRAP_MIRROR, true, .5, 1.25, false},  {GN_WRAP_MIRROR, true, .5, 1.75, true},
        {GN_WRAP_MIRROR, true, .5, -.25, true},   {GN_WRAP_MIRROR, true, .5, -.75, false},
        {GN_WRAP_CLAMP, false, .5, .49, true},    {GN_WRAP_CLAMP, false, .5, .51, false},
        {GN_WRAP_CLAMP, false, .25, .615, true},  {GN_WRAP_CLAMP, false, .25, .635, false},
        {GN_WRAP_REPEAT, false, .5, -.01, false}, {GN_WRAP_REPEAT, false, .5, .01, true},
        {GN_WRAP_REPEAT, false, .25, -.1, true},  {GN_WRAP_REPEAT, false, .25, -.15, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (is_opaque(&cases[i]) != cases[i].opaque) fail_msg("case %zu", i);
}

static void test_vertex_alpha_makes_holes(void **state) {
    (void)state;
    struct small s;
    small_init(&s);
    small_item(&s)->alpha = GN_ALPHA_MASK;
    small_quad(&s, (float[]){-2, 1, 2}, (float[]){4, 0, 0}, (float[]){0, 0, -4});
    s.geometries[0].attributes = 1u << GN_ATTRIBUTE_COLOR;
    s.colors[4 * 1 + 3] = s.colors[4 * 2 + 3] = 0; /* opaque at x = -2, clear at x = 2 */
    struct gn_raycast rays;
    struct gn_ray_lamp lamp = sun(0, -1, 0);
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    struct gn_ray_surface left = on_ground(-.01, .3), right = on_ground(.01, .3);
    assert_int_equal(gn_raycast_visible(&rays, &lamp, &left), 0);
    assert_int_equal(gn_raycast_visible(&rays, &lamp, &right), 1);
    gn_raycast_finish(&rays);
}

/* --- shadows --- */

/* Keeps of lo..hi the t at which a + b t lies in min..max. */
static void slab(double a, double b, double min, double max, double *lo, double *hi) {
    double s = (min - a) / b, t = (max - a) / b;
    *lo = fmax(*lo, fmin(s, t));
    *hi = fmin(*hi, fmax(s, t));
}

/* How far the way from the ground to the light runs within the box 0 .. 1 high: < 0 is clear of it.
 * Light at w = 1, or towards it at w = 0. */
static double in_box(double x, double z, const double light[4], const float low[3],
                     const float high[3]) {
    double lo = 0, hi = light[3] > 0 ? 1 : 1e9;
    slab(x, light[0] - light[3] * x, low[0], high[0], &lo, &hi);
    slab(0, light[1], low[1], high[1], &lo, &hi);
    slab(z, light[2] - light[3] * z, low[2], high[2], &lo, &hi);
    return hi - lo;
}

static void check_box_shadow(const struct gn_ray_lamp *lamp, const double light[4],
                             float ground_m) {
    static const float low[3] = {-.5f, 0, -.25f}, high[3] = {.5f, 1, .75f};
    struct small s;
    struct gn_raycast rays;
    small_init(&s);
    small_ground(&s, ground_m);
    small_box(&s, low, high);
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    int dark = 0, lit = 0;
    for (int i = 0; i < 20000; i++) {
        struct gn_ray_surface p = on_ground(between(-4, 4), between(-4, 4));
        double inside = in_box(p.point_ws[0], p.point_ws[2], light, low, high);
        if (fabs(inside) < 2e-5) continue; /* nearer than the lift */
        p.item = 0;
        assert_int_equal(gn_raycast_visible(&rays, lamp, &p), inside < 0);
        dark += inside > 0;
        lit += inside < 0;
    }
    assert_true(dark > 200 && lit > 10000);
    gn_raycast_finish(&rays);
}

static void test_box_shadow_by_formula(void **state) {
    (void)state;
    for (int i = 0; i < 12; i++) {
        double high = (20 + 5 * i) * M_PI / 180, around = 2.1 * i + .3;
        double to[4] = {cos(high) * cos(around), sin(high), cos(high) * sin(around), 0};
        struct gn_ray_lamp lamp = sun(-to[0], -to[1], -to[2]);
        check_box_shadow(&lamp, to, 20);
        check_box_shadow(&lamp, to,
                         1e5f); /* 200 km: the answer does not depend on the scene's size */
        double at[4] = {3 * to[0], 3 * to[1] + .5, 3 * to[2], 1};
        lamp = (struct gn_ray_lamp){
            .type = GN_LIGHT_POINT, .position_ws = {at[0], at[1], at[2]}, .range_m = INFINITY};
        check_box_shadow(&lamp, at, 20);
        check_box_shadow(&lamp, at, 1e5f);
    }
}

static void test_spot_is_cut_by_cone_and_range(void **state) {
    (void)state;
    struct small s;
    struct gn_raycast rays;
    small_init(&s);
    small_ground(&s, 20);
    small_box(&s, (float[]){-9, 1, -9}, (float[]){9, 1.5f, 9}); /* a lid over everything */
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    struct gn_ray_lamp lamp = {.type = GN_LIGHT_SPOT,
                               .position_ws = {0, 2, 0},
                               .direction_ws = {0, -1, 0},
                               .range_m = 2.2,
                               .cos_cone = cos(.6)};
    double rim = 2 * tan(.6), reach = sqrt(2.2 * 2.2 - 4);
    for (int i = -40; i <= 40; i++) {
        struct gn_ray_surface p = on_ground(.05 * i + .013, 0);
        double x = fabs(p.point_ws[0]);
        assert_int_equal(gn_raycast_visible(&rays, &lamp, &p), x >= fmin(rim, reach));
    }
    lamp.range_m = INFINITY;
    struct gn_ray_surface p = on_ground(1.2, 0);
    assert_int_equal(gn_raycast_visible(&rays, &lamp, &p), 0); /* 1.2 < rim = 1.37 */
    lamp.direction_ws[1] = 1;                                  /* behind the light */
    assert_int_equal(gn_raycast_visible(&rays, &lamp, &p), 1);
    gn_raycast_finish(&rays);
}

static void test_who_casts(void **state) {
    (void)state;
    struct gn_ray_lamp lamp = sun(.1, -1, .2);
    for (int i = 0; i < 16; i++) {
        bool turned = i & 1, double_sided = i & 2, out = i & 4, blend = i & 8;
        struct small s;
        struct gn_raycast rays;
        small_init(&s);
        small_ground(&s, 5);
        struct gn_material *material = small_item(&s);
        material->double_sided = double_sided;
        material->alpha = blend ? GN_ALPHA_BLEND : GN_ALPHA_OPAQUE;
        s.items[1].casts = !out;
        small_quad(&s, (float[]){-1, 1, turned ? -1 : 1}, (float[]){2, 0, 0},
                   (float[]){0, 0, turned ? 2 : -2});
        gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
        struct gn_ray_surface p = on_ground(0, 0);
        assert_int_equal(gn_raycast_visible(&rays, &lamp, &p), out || blend);
        gn_raycast_finish(&rays);
    }
}

/* Seen from the side turned away from the light, a surface is dark if it casts; a grazing ray must
 * not get past its rim. */
static void test_turned_away_is_dark(void **state) {
    (void)state;
    struct small s;
    struct gn_raycast rays;
    small_init(&s);
    small_ground(&s, 5);
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    for (int i = 0; i < 2; i++) {
        s.items[0].casts = i == 0;
        if (i) {
            gn_raycast_finish(&rays);
            gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
        }
        struct gn_ray_surface below = {
            .point_ws = {4.9999, 0, 0}, .normal_ws = {0, -1, 0}, .item = 0};
        for (double slope = 1e-9; slope < 10; slope *= 10) {
            struct gn_ray_lamp lamp = sun(-1, -slope, 0);
            assert_int_equal(gn_raycast_visible(&rays, &lamp, &below), i);
        }
    }
    gn_raycast_finish(&rays);
}

/* --- area lights --- */

/* Share of a unit disk left of x = cut. */
static double left_of(double cut) {
    if (cut <= -1) return 0;
    if (cut >= 1) return 1;
    return 1 - (acos(cut) - cut * sqrt(1 - cut * cut)) / M_PI;
}

/* A half-plane x > 0 at height 2 over the ground. */
static void test_share_of_a_disk_behind_a_half_plane(void **state) {
    (void)state;
    struct small s;
    struct gn_raycast rays;
    small_init(&s);
    small_item(&s);
    small_quad(&s, (float[]){0, 2, 100}, (float[]){100, 0, 0}, (float[]){0, 0, -200});
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    double worst = 0;
    for (int i = -30; i <= 30; i++) {
        double x = i * .017;
        struct gn_ray_surface p = on_ground(x, .3);
        struct gn_ray_lamp lamp = sun(0, -1, 0);
        lamp.radius = .2; /* at height 2 a circle of .4 */
        worst = fmax(worst, fabs(gn_raycast_share(&rays, &lamp, &p, 1024) - left_of(-x / .4)));
        lamp = (struct gn_ray_lamp){.type = GN_LIGHT_POINT,
                                    .position_ws = {x, 6, .3},
                                    .range_m = INFINITY,
                                    .radius = 1.2}; /* the circle again is of .4 */
        worst = fmax(worst, fabs(gn_raycast_share(&rays, &lamp, &p, 1024) - left_of(-x / .4)));
    }
    print_message("largest error of a share, 1024 samples: %.4f\n", worst);
    assert_true(worst < .008);
    gn_raycast_finish(&rays);
}

/* A disk half below the horizon is half seen, even with nothing in the way. */
static void test_share_ends_at_the_horizon(void **state) {
    (void)state;
    struct small s;
    struct gn_raycast rays;
    small_init(&s);
    small_ground(&s, 5);
    gn_raycast_init(&rays, &s.scene, &s.pose, NULL);
    struct gn_ray_surface p = on_ground(0, 0);
    p.item = 0;
    for (int i = -4; i <= 4; i++) {
        double sink = .03 * i; /* of the middle, for a radius of .1 */
        struct gn_ray_lamp lamp = sun(1, -sink, 0);
        lamp.radius = .1;
        double seen = left_of(sink / .1 / 1); /* the disk stands upright but for a cosine */
        assert_true(fabs(gn_raycast_share(&rays, &lamp, &p, 1024) - seen) < .01);
    }
    gn_raycast_finish(&rays);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_eye_culls_as_gltf_has_it),
        cmocka_unit_test(test_eye_looks_through_the_middle_of_pixels),
        cmocka_unit_test(test_masked_surfaces_cast_their_holes),
        cmocka_unit_test(test_vertex_alpha_makes_holes),
        cmocka_unit_test(test_box_shadow_by_formula),
        cmocka_unit_test(test_spot_is_cut_by_cone_and_range),
        cmocka_unit_test(test_who_casts),
        cmocka_unit_test(test_turned_away_is_dark),
        cmocka_unit_test(test_share_of_a_disk_behind_a_half_plane),
        cmocka_unit_test(test_share_ends_at_the_horizon),
    };
    return cmocka_run_group_tests_name("raycast", tests, NULL, NULL);
}
