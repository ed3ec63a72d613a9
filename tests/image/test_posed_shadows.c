/* Hard shadows of what is posed, against rays: with the limits that test_truth has for what stands
 * still. The rays' triangles are first compared with a skinning that shares no code with the pose
 * (posed.h). At two times of the first clip, GN_FULL=1: at ten of every clip. Models of
 * ../shared/assets are skipped aloud where they are not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "image/character.h"
#include "image/drawer.h"
#include "image/posed.h"
#include "image/shot.h"
#include "image/table.h"
#include "truth/raycast.h"
#include "unit/check.h"

enum { WIDTH = 640, HEIGHT = 480, PIXELS = WIDTH * HEIGHT, MAP_PX = 1024, TIMES_MAX = 10 };
#define MOST_OFF 1e-4 /* of the size: how far the rays' corners may be from the skinning's */

static float rgba[4 * PIXELS], normals[4 * PIXELS], edges[PIXELS];
static char character[300];

/* ---- the rays' triangles ------------------------------------------------------------------- */

static double corners_off(const struct gn_bvh_triangle *a, const struct gn_bvh_triangle *b) {
    double worst = 0;
    for (int c = 0; c < 9; c++) worst = fmax(worst, fabs(a->p[c / 3][c % 3] - b->p[c / 3][c % 3]));
    return worst;
}

/* Every triangle of the rays has its like in the skinning, and there are as many. Both keep the
 * file's order within a primitive, so the search goes on where it ended. */
static double compare_triangles(const struct gn_pose *pose, const struct gn_posed *posed) {
    struct gn_raycast rays;
    double worst = 0;
    uint32_t at = 0, count = 0;
    gn_raycast_init(&rays, pose->scene, pose, NULL);
    for (uint32_t i = 0; i < rays.bvh.triangle_count; i++) {
        const struct gn_bvh_triangle *t = &rays.bvh.triangles[i];
        const struct gn_item *item = &pose->scene->items[t->item];
        double off = INFINITY;
        if (pose->scene->materials[item->material].shadow_catcher) continue; /* no floor in files */
        for (uint32_t k = 0; k < posed->count && off > MOST_OFF * posed->size; k++) {
            at = (at + 1) % posed->count;
            off = fmin(off, corners_off(t, &posed->triangles[at]));
        }
        worst = fmax(worst, off / posed->size);
        count++;
    }
    gn_raycast_finish(&rays);
    assert_int_equal(count, posed->count);
    return worst;
}

/* ---- shadows ------------------------------------------------------------------------------- */

static void draw(struct gn_drawer *drawer, int clip, const char *aov, float *out) {
    struct gn_err err = {0};
    char number[16];
    snprintf(number, sizeof number, "%d", clip);
    const char *const args[] = {"--aov",  aov,    "--light",      "0",     "--size",      "640x480",
                                "--map",  "1024", "--map-format", "depth", "--animation", number,
                                "--tone", "none", "--shadow",     "hard",  NULL};
    if (!gn_drawer_draw(drawer, args, out, &err)) fail_msg("%s", err.text);
}

static void save(const char *path, int clip, int time, const struct gn_truth *truth) {
    char name[100];
    struct gn_picture shot;
    gn_picture_init(&shot, WIDTH, HEIGHT, 4);
    memcpy(shot.data, rgba, sizeof rgba);
    snprintf(name, sizeof name, "posed-%.20s-%d-%d", strrchr(path, '/') + 1, clip, time);
    gn_mask_save(NULL, name, &truth->mask, &shot);
    gn_picture_finish(&shot);
}

/* Where the surface's normal is turned away from the light no light arrives that a shadow could
 * take, whatever the map says, though the face may see the light: there the picture is right. */
static void clear_unlit(const struct gn_truth *truth) {
    const struct gn_ray_lamp *lamp = &truth->frame.lamp;
    assert_int_equal(lamp->type, GN_LIGHT_DIRECTIONAL);
    for (int i = 0; i < PIXELS; i++) {
        double along = 0;
        for (int k = 0; k < 3; k++) along += (double)normals[4 * i + k] * lamp->direction_ws[k];
        if (truth->mask.item[i] >= 0 && along >= 0) rgba[4 * i] = truth->mask.lit[i];
    }
}

/* Of the picture that was drawn last. */
static struct gn_mask_score score_of(const struct gn_pose *pose, struct gn_truth *truth) {
    struct gn_err err = {0};
    struct gn_mask_score score = {0};
    const struct gn_truth_opts opts = {.width_px = WIDTH, .height_px = HEIGHT, .pose = pose};
    if (!gn_truth_make(truth, pose->scene, &opts, &err)) fail_msg("%s", err.text);
    gn_truth_band(truth, MAP_PX);
    gn_truth_safe(truth, MAP_PX, 1);
    gn_mask_edges(&truth->mask, edges);
    clear_unlit(truth);
    gn_mask_compare_by(&truth->mask, edges, rgba, 4, &score);
    return score;
}

struct sum {
    double mean, worst;
};

static bool is_over(enum gn_fault fault, const struct sum *sum, bool single) {
    struct gn_table_row row = {.technique = "hard", .format = "depth", .map_px = MAP_PX};
    row.measured[0] = true;
    const struct gn_limit_row limit = gn_table_limit(&row, fault);
    if (single && isfinite(limit.worst)) return sum->worst > limit.worst;
    return sum->mean > limit.mean || sum->worst > limit.worst;
}

/* Prints them with their means and worst, but of a single time nothing. */
static bool judge(const char *path, int clip, int times,
                  const struct gn_mask_score scores[TIMES_MAX]) {
    static const struct {
        const char *name;
        enum gn_fault fault;
        double (*of)(const struct gn_mask_score *);
    } faults[] = {{"acne", GN_FAULT_ACNE, gn_mask_acne},
                  {"leak", GN_FAULT_LEAK, gn_mask_leak},
                  {"gap", GN_FAULT_GAP, gn_mask_gap},
                  {"wrong", GN_FAULT_WRONG, gn_mask_wrong}};
    const bool quiet = times == 1;
    bool over = false;
    if (!quiet) printf("%s, clip %d:", strrchr(path, '/') + 1, clip);
    for (size_t f = 0; f < sizeof faults / sizeof *faults; f++) {
        struct sum sum = {0, 0};
        for (int i = 0; i < times; i++) {
            sum.mean += faults[f].of(&scores[i]) / times;
            sum.worst = fmax(sum.worst, faults[f].of(&scores[i]));
        }
        const bool is = is_over(faults[f].fault, &sum, quiet);
        if (!quiet) printf(" %s %.3f (%.3f)%s", faults[f].name, sum.mean, sum.worst, is ? "!" : "");
        over |= is;
    }
    return over;
}

/* Returns how many clips the file has. */
static int check_clip(const char *path, int clip) {
    const int times = gn_shot_full() ? TIMES_MAX : 2;
    struct gn_mask_score scores[TIMES_MAX];
    struct gn_posed posed;
    double off = 0;
    assert_true(gn_posed_read(&posed, path, clip, 0));
    const double last_s = posed.last_s;
    const int clips = posed.clips;
    gn_posed_finish(&posed);
    struct gn_drawer *drawer = gn_drawer_create(path);
    for (int i = 0; i < times; i++) {
        const double time_s = last_s * (i + .37) / times;
        struct gn_truth truth;
        gn_drawer_set_time(drawer, (int64_t)(time_s * 1e9));
        draw(drawer, clip, "normal", normals);
        draw(drawer, clip, "visibility", rgba);
        const struct gn_pose *pose = gn_drawer_pose(drawer);
        assert_true(gn_posed_read(&posed, path, clip, time_s));
        off = fmax(off, compare_triangles(pose, &posed));
        gn_posed_finish(&posed);
        scores[i] = score_of(pose, &truth);
        assert_true(scores[i].dark > PIXELS / 100);
        if (judge(path, clip, 1, &scores[i])) save(path, clip, i, &truth);
        gn_truth_finish(&truth);
    }
    const bool over = judge(path, clip, times, scores);
    printf(" %%; rays off by %.2g of the size\n", off);
    gn_drawer_destroy(drawer);
    assert_true(off <= MOST_OFF);
    assert_false(over);
    return clips;
}

static void check_model(const char *path) {
    if (access(path, R_OK) != 0) {
        print_message("SKIPPED: no %s\n", path);
        return;
    }
    const int clips = check_clip(path, 0);
    for (int clip = 1; clip < clips && gn_shot_full(); clip++) check_clip(path, clip);
}

static void test_shadows_of_a_made_character(void **state) {
    (void)state;
    check_model(character);
}

static void test_shadows_of_models(void **state) {
    (void)state;
    const char *shared = getenv("GNOMON_SHARED");
    static const char *const models[] = {"Fox.glb", "robot.glb"};
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        char path[600];
        snprintf(path, sizeof path, "%s/assets/gltf/%s", shared ? shared : "../shared", models[i]);
        check_model(path);
    }
}

int main(void) {
    struct gn_err err = {0};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shadows_of_a_made_character),
        cmocka_unit_test(test_shadows_of_models),
    };
    setvbuf(stdout, NULL, _IOLBF, 0);
    snprintf(character, sizeof character, "%s/character-shadows.glb", gn_shot_build());
    if (!gn_character_write(character, &err)) {
        fprintf(stderr, "%s\n", err.text);
        return 1;
    }
    return RUN(tests);
}
