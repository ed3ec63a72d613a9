/* The tree against every triangle in turn, and the triangle test against slipping through. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/dice.h"
#include "truth/bvh.h"
#include "unit/check.h"

static struct gn_dice dice;
static double between(double low, double high) { return gn_dice_between(&dice, low, high); }

static struct gn_bvh_triangle *random_triangles(uint32_t count, double size, bool flat) {
    struct gn_bvh_triangle *t = gn_xalloc(count, sizeof *t);
    for (uint32_t i = 0; i < count; i++) {
        double at[3] = {between(-1, 1), flat ? 0 : between(-1, 1), between(-1, 1)};
        t[i].index = i;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                t[i].p[c][k] = at[k] + (flat && k == 1 ? 0 : between(-size, size));
    }
    return t;
}

static bool odd_only(const void *context, const struct gn_bvh_triangle *t,
                     const struct gn_bvh_hit *hit) {
    (void)context;
    (void)hit;
    return t->index & 1;
}

static struct gn_ray random_ray(int i) {
    struct gn_ray ray = {.t_min = 0, .t_max = i % 3 ? INFINITY : between(0, 2)};
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = between(-2, 2);
        ray.direction[k] = between(-1, 1);
    }
    if (i % 5 == 0) ray.direction[i / 5 % 3] = 0; /* along a plane, and along an axis */
    if (i % 10 == 0) ray.direction[(i / 5 + 1) % 3] = 0;
    return ray;
}

static void test_tree_agrees_with_every_triangle(void **state) {
    (void)state;
    static const struct {
        uint32_t count;
        double size;
        bool flat;
    } cases[] = {
        {1, .5, false}, {5, .5, false}, {3000, .05, false}, {3000, .5, false}, {2000, .1, true}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct gn_bvh bvh;
        int hits = 0;
        gn_bvh_build(&bvh, random_triangles(cases[c].count, cases[c].size, cases[c].flat),
                     cases[c].count, NULL);
        for (int i = 0; i < 3000; i++) {
            struct gn_ray ray = random_ray(i);
            gn_bvh_accept accept = i & 1 ? odd_only : NULL;
            struct gn_bvh_hit fast, slow, some;
            bool found = gn_bvh_hit_slow(&bvh, &ray, accept, NULL, &slow);
            assert_int_equal(gn_bvh_hit(&bvh, &ray, false, accept, NULL, &fast), found);
            assert_int_equal(gn_bvh_hit(&bvh, &ray, true, accept, NULL, &some), found);
            if (!found) continue;
            assert_true(fast.t == slow.t);
            assert_true(some.t >= fast.t);
            hits++;
        }
        if (cases[c].count > 100) assert_true(hits > 100);
        gn_bvh_finish(&bvh);
    }
}

static void test_empty_tree_has_no_hit(void **state) {
    (void)state;
    struct gn_bvh bvh;
    struct gn_bvh_hit hit;
    struct gn_ray ray = random_ray(1);
    gn_bvh_build(&bvh, gn_xalloc(1, sizeof(struct gn_bvh_triangle)), 0, NULL);
    assert_false(gn_bvh_hit(&bvh, &ray, false, NULL, NULL, &hit));
    gn_bvh_finish(&bvh);
}

/* A closed surface of triangles with corners at odd places: rays at its very edges and corners must
 * not slip out. */
static void test_no_ray_slips_between_triangles(void **state) {
    (void)state;
    enum { RINGS = 12, SECTORS = 17 };
    double p[RINGS + 1][SECTORS][3];
    for (int r = 0; r <= RINGS; r++)
        for (int s = 0; s < SECTORS; s++) {
            double a = M_PI * r / RINGS, b = 2 * M_PI * s / SECTORS;
            double q[3] = {sin(a) * cos(b), cos(a), sin(a) * sin(b)};
            if (r == 0 || r == RINGS) q[0] = q[2] = 0;
            for (int k = 0; k < 3; k++) p[r][s][k] = q[k];
        }
    struct gn_bvh_triangle *t = gn_xalloc(2 * RINGS * SECTORS, sizeof *t);
    uint32_t count = 0;
    for (int r = 0; r < RINGS; r++)
        for (int s = 0; s < SECTORS; s++) {
            int n = (s + 1) % SECTORS;
            double *quad[4] = {p[r][s], p[r][n], p[r + 1][n], p[r + 1][s]};
            for (int half = 0; half < 2; half++, count++)
                for (int c = 0; c < 3; c++)
                    memcpy(t[count].p[c], quad[c == 0 ? 0 : c + half], 3 * sizeof(double));
        }
    struct gn_bvh bvh;
    gn_bvh_build(&bvh, t, count, NULL);
    for (int i = 0; i < 20000; i++) {
        struct gn_ray ray = {.origin = {.1, .2, -.05}, .t_max = INFINITY};
        int r = 1 + (int)between(0, RINGS - 1), s = (int)between(0, SECTORS);
        const double *a = p[r][s], *b = i % 3 ? p[r][(s + 1) % SECTORS] : p[r - 1][s];
        double f = i % 7 ? between(0, 1) : 0;
        for (int k = 0; k < 3; k++) ray.direction[k] = a[k] + f * (b[k] - a[k]) - ray.origin[k];
        struct gn_bvh_hit hit;
        assert_true(gn_bvh_hit(&bvh, &ray, false, NULL, NULL, &hit));
        assert_true(fabs(hit.t - 1) < 1e-9);
    }
    gn_bvh_finish(&bvh);
}

/* Rays from one point to a box of directions: none meets a triangle that was not gathered. */
static void test_a_beam_holds_all_that_its_rays_meet(void **state) {
    (void)state;
    enum { COUNT = 2000, MOST = 400 };
    struct gn_bvh bvh;
    int hits = 0, full = 0;
    gn_bvh_build(&bvh, random_triangles(COUNT, .05, false), COUNT, NULL);
    for (int i = 0; i < 2000; i++) {
        struct gn_ray middle = random_ray(i);
        struct gn_beam beam = {.t_max = middle.t_max};
        const double spread = i % 7 ? between(0, .2) : 0;
        uint32_t list[MOST], which;
        for (int k = 0; k < 3; k++) {
            beam.origin[k] = middle.origin[k];
            beam.low[k] = middle.direction[k] - spread;
            beam.high[k] = middle.direction[k] + spread;
        }
        const uint32_t found = gn_bvh_gather(&bvh, &beam, list, MOST);
        if (found > MOST) {
            full++;
            continue;
        }
        for (int r = 0; r < 20; r++) {
            struct gn_ray ray = middle;
            struct gn_bvh_hit hit;
            for (int k = 0; k < 3; k++) ray.direction[k] = between(beam.low[k], beam.high[k]);
            const bool meets = gn_bvh_hit(&bvh, &ray, true, NULL, NULL, &hit);
            assert_int_equal(gn_bvh_hit_some(&bvh, &ray, list, found, NULL, NULL, &which), meets);
            if (meets) assert_true(which < found);
            hits += meets;
        }
    }
    print_message("%d hits; %d beams with more than %d triangles\n", hits, full, MOST);
    assert_true(hits > 1000 && full < 1000);
    gn_bvh_finish(&bvh);
}

/* Each triangle a sixteenth as far away as the one before, so that a split parts only one. */
static void test_the_tree_of_a_geometric_row_is_not_too_deep(void **state) {
    (void)state;
    enum { COUNT = 500 };
    struct gn_bvh_triangle *t = gn_xalloc(COUNT, sizeof *t);
    struct gn_bvh bvh;
    for (int i = 0; i < COUNT; i++) {
        const double at = pow(.5, i);
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) t[i].p[c][k] = at * (1 + .01 * (c == k));
    }
    gn_bvh_build(&bvh, t, COUNT, NULL);
    for (int i = 0; i < 200; i++) {
        const struct gn_ray ray = {.origin = {2, 2, 2},
                                   .direction = {-1, -1 + 1e-4 * i, -1 - 1e-5 * i},
                                   .t_max = INFINITY};
        struct gn_bvh_hit a, b;
        const bool hit = gn_bvh_hit(&bvh, &ray, false, NULL, NULL, &a);
        assert_int_equal(hit, gn_bvh_hit_slow(&bvh, &ray, NULL, NULL, &b));
    }
    gn_bvh_finish(&bvh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tree_agrees_with_every_triangle),
        cmocka_unit_test(test_a_beam_holds_all_that_its_rays_meet),
        cmocka_unit_test(test_the_tree_of_a_geometric_row_is_not_too_deep),
        cmocka_unit_test(test_empty_tree_has_no_hit),
        cmocka_unit_test(test_no_ray_slips_between_triangles),
    };
    return cmocka_run_group_tests_name("bvh", tests, NULL, NULL);
}
