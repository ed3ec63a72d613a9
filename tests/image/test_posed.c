/* Skins and morph targets: what the GPU draws is where a skinning in double precision that shares
 * no code with the loader has it (posed.h), and the shadows are those of that mesh. Models of
 * ../shared/assets are skipped aloud where they are not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/character.h"
#include "image/posed.h"
#include "image/shot.h"
#include "truth/raycast.h"
#include "unit/check.h"

enum { WIDTH = 128, HEIGHT = 96, TIMES = 10 };
#define MOST_OFF  1e-4 /* of the size of the posed mesh */
#define MOST_EDGE .01  /* share of its pixels on an edge, where a GPU may take the other side */
#define EDGE_PX   .02  /* GPUs put corners on a grid of 1/256 of a pixel */
#define CLOSE     1e-3 /* of the size: of surfaces behind each other a depth buffer may show either */

static char character[300];

static struct gn_ray_eye eye_of(const char *path, int clip, double time_s) {
    struct gn_err err = {0};
    struct gn_pose pose;
    struct gn_ray_eye eye;
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, clip < 0 ? GN_POSE_NONE : clip);
    gn_pose_step(&pose, (int64_t)(time_s * 1e9));
    gn_ray_eye_init(&eye, &pose, 0, WIDTH, HEIGHT);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    return eye;
}

static struct gn_picture shoot(const char *path, int clip, double time_s,
                               const char *const more[]) {
    char time[40], number[16];
    struct gn_err err = {0};
    struct gn_picture shot;
    snprintf(time, sizeof time, "%.9f", time_s);
    snprintf(number, sizeof number, "%d", clip);
    const char *args[24] = {
        "--size", "128x96", "--backend", "egl",         "--floor",
        "none",   "--time", time,        "--animation", clip < 0 ? "none" : number};
    for (int i = 10; *more; i++) args[i] = *more++;
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    return shot;
}

static struct gn_ray ray_of(const struct gn_ray_eye *eye, double x_px, double y_px) {
    const double x = (2 * x_px / WIDTH - 1) * eye->half_width,
                 y = (1 - 2 * y_px / HEIGHT) * eye->half_height;
    struct gn_ray ray = {.t_max = INFINITY};
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = eye->position_ws[k];
        ray.direction[k] = eye->forward[k] + x * eye->right[k] + y * eye->up[k];
    }
    return ray;
}

/* Cosine between the ray and the normal of the triangle. */
static double cosine_of(const struct gn_bvh_triangle *t, const double d[3]) {
    double u[3], v[3], n[3], dot = 0, nn = 0, dd = 0;
    for (int k = 0; k < 3; k++) {
        u[k] = t->p[1][k] - t->p[0][k];
        v[k] = t->p[2][k] - t->p[0][k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    for (int k = 0; k < 3; k++) {
        dot += n[k] * d[k];
        nn += n[k] * n[k];
        dd += d[k] * d[k];
    }
    return fabs(dot) / sqrt(nn * dd);
}

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static bool is_seen(const void *context, const struct gn_bvh_triangle *t,
                    const struct gn_bvh_hit *hit) {
    (void)context;
    return !t->flags || hit->facing > 0;
}

/* How far a pixel's distance is off the surface, across it, as a share of the size; 0: both see
 * nothing, 1: one of them does. */
static double off_at(const struct gn_bvh *bvh, const struct gn_ray_eye *eye, double x_px,
                     double y_px, double drawn, double size) {
    struct gn_ray ray = ray_of(eye, x_px, y_px);
    struct gn_bvh_hit hit;
    const double length = length_of(ray.direction);
    double off = 1;
    if (!gn_bvh_hit(bvh, &ray, false, is_seen, NULL, &hit)) return isinf(drawn) ? 0 : 1;
    ray.t_max = hit.t + CLOSE * size / length;
    while (!isinf(drawn) && gn_bvh_hit(bvh, &ray, false, is_seen, NULL, &hit)) {
        off = fmin(off, fabs(hit.t * length - drawn) *
                            cosine_of(&bvh->triangles[hit.triangle], ray.direction) / size);
        ray.t_min = hit.t;
    }
    return off;
}

/* Compares distances at a time; *worst: largest error. Where surfaces meet along an edge, a pixel
 * may show either. Returns how many pixels show the model. */
static int compare_at(const char *path, int clip, double time_s, double *worst, double *edges) {
    struct gn_posed posed;
    struct gn_bvh bvh;
    assert_true(gn_posed_read(&posed, path, clip, time_s));
    const struct gn_ray_eye eye = eye_of(path, clip, time_s);
    struct gn_picture shot =
        shoot(path, clip, time_s, (const char *const[]){"--aov", "distance", NULL});
    gn_bvh_build(&bvh, posed.triangles, posed.count, NULL); /* owns them now */
    int seen = 0, on_edge = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double x = i % WIDTH + .5, y = i / WIDTH + .5, drawn = (double)shot.data[i];
        const double middle = off_at(&bvh, &eye, x, y, drawn, posed.size);
        double off = middle;
        for (int k = 0; k < 27 && middle > MOST_OFF; k++) {
            const double step =
                EDGE_PX / (1 << k / 9); /* what is left is as far as the next step */
            off = fmin(off, off_at(&bvh, &eye, x + step * (k % 3 - 1), y + step * (k / 3 % 3 - 1),
                                   drawn, posed.size));
        }
        seen += !isinf(drawn);
        on_edge += middle > MOST_OFF;
        *worst = fmax(*worst, off);
        if (off > MOST_OFF)
            print_message("%s at %g s: pixel %d %d is at %g, off by %.2g\n", path, time_s,
                          i % WIDTH, i / WIDTH, drawn, off);
    }
    *edges = fmax(*edges, (double)on_edge / fmax(seen, 1));
    gn_picture_finish(&shot);
    gn_bvh_finish(&bvh);
    return seen;
}

/* At ten times of each clip, or at three of the first two. */
static void compare_clips(const char *path, double most_edge) {
    struct gn_posed posed;
    const bool full = gn_shot_full();
    assert_true(gn_posed_read(&posed, path, 0, 0));
    const int clips = posed.clips, times = full ? TIMES : 3;
    gn_posed_finish(&posed);
    for (int clip = clips ? 0 : -1; clip < (full || clips < 2 ? clips : 2); clip++) {
        double worst = 0, edges = 0;
        int seen = 0;
        assert_true(gn_posed_read(&posed, path, clip, 0));
        const double last_s = posed.last_s;
        gn_posed_finish(&posed);
        for (int i = 0; i < times; i++)
            seen += compare_at(path, clip, last_s * (i + .37) / times, &worst, &edges);
        print_message("%s, clip %d: off by %.2g of its size, %.2g %% on edges\n",
                      strrchr(path, '/') + 1, clip, worst, 100 * edges);
        assert_true(seen > 300 * times); /* the framing is for the clip: SimpleMorph begins small */
        assert_true(worst < MOST_OFF);
        assert_true(edges <= most_edge);
        if (clip < 0) break;
    }
}

static void test_a_made_character_is_where_it_should_be(void **state) {
    (void)state;
    compare_clips(character, MOST_EDGE);
}

static void test_1024_joints_are_where_they_should_be(void **state) {
    (void)state;
    struct gn_err err = {0};
    char path[300];
    double worst = 0, edges = 0;
    snprintf(path, sizeof path, "%s/joints.glb", gn_shot_build());
    if (!gn_many_joints_write(path, &err)) fail_msg("%s", err.text);
    const int seen = compare_at(path, -1, 0, &worst, &edges);
    print_message("1024 joints: off by %.2g of its size, %d pixels\n", worst, seen);
    assert_true(seen > 1000);
    assert_true(worst < MOST_OFF);
}

static void test_models_are_where_they_should_be(void **state) {
    (void)state;
    static const char *const models[] = {"gltf/Fox.glb",
                                         "gltf/robot.glb",
                                         "gltf/SimpleSkin.gltf",
                                         "gltf/kenney_alien.glb",
                                         "gltf/AnimatedMorphCube/AnimatedMorphCube.gltf",
                                         "gltf/MorphStressTest.gltf",
                                         "gltf/SimpleMorph/SimpleMorph.gltf",
                                         "derived/Fox_quantized.glb",
                                         "derived/MorphStressTest_sparse_glb.glb"};
    const char *shared = getenv("GNOMON_SHARED");
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        char path[600];
        snprintf(path, sizeof path, "%s/assets/%s", shared ? shared : "../shared", models[i]);
        if (access(path, R_OK) != 0)
            print_message("SKIPPED: no %s\n", path);
        else
            compare_clips(path, MOST_EDGE);
    }
}

/* Share of pixels whose visibility is more than half off the true one. */
static double wrong_share(const char *path, int clip, double time_s, const char *technique,
                          const char *faces) {
    struct gn_picture truth = shoot(
        path, clip, time_s,
        (const char *const[]){"--aov", "visibility", "--shadow", "truth", "--samples", "1", NULL});
    struct gn_picture shot =
        shoot(path, clip, time_s,
              (const char *const[]){"--aov", "visibility", "--shadow", technique, "--cast-faces",
                                    faces, "--light-radius", "0", NULL});
    int wrong = 0, dark = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        dark += truth.data[i] < .5f;
        wrong += fabsf(truth.data[i] - shot.data[i]) > .5f;
    }
    assert_true(dark > 200);
    gn_picture_finish(&truth);
    gn_picture_finish(&shot);
    return (double)wrong / (WIDTH * HEIGHT);
}

static void test_shadows_are_those_of_the_posed_mesh(void **state) {
    (void)state;
    static const struct {
        const char *technique, *faces;
        double most;
    } cases[] = {{"hard", "both", .01}, {"hard", "back", .02}, {"pcf", "both", .01},
                 {"pcss", "both", .01}, {"cone", "both", .02}, {"msm", "both", .02}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int t = 0; t < 2; t++) {
            const double wrong =
                wrong_share(character, 0, t ? 1.1 : .4, cases[i].technique, cases[i].faces);
            print_message("%s %s at %d: %.2g %% wrong\n", cases[i].technique, cases[i].faces, t,
                          100 * wrong);
            assert_true(wrong < cases[i].most);
        }
}

int main(void) {
    struct gn_err err = {0};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_made_character_is_where_it_should_be),
        cmocka_unit_test(test_1024_joints_are_where_they_should_be),
        cmocka_unit_test(test_models_are_where_they_should_be),
        cmocka_unit_test(test_shadows_are_those_of_the_posed_mesh),
    };
    snprintf(character, sizeof character, "%s/character.glb", gn_shot_build());
    if (!gn_character_write(character, &err)) {
        fprintf(stderr, "%s\n", err.text);
        return 1;
    }
    return RUN(tests);
}
