/* What programs cost: read from the table, and estimated where they are not in it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/embedded.h"
#include "cost/program.h"
#include "unit/check.h"

static const char text[] = "program\tfetches\tpi4\tg31\n"
                           "depth\t0\t6\t118\t2\t30\n"
                           "lit BASE_TEXTURE, SPOT\t1\t50\t60\t40\t50\n"
                           "lit BASE_TEXTURE, SPOT pcf depth\t5\t90\t80\t-1\t-1\n"
                           "lit BASE_TEXTURE, POINT\t1\t55\t60\t45\t55\n"
                           "lit SPECULAR, SPOT\t-1\t70\t60\t60\t50\n";

static struct gn_program_cost find(const struct gn_cost_table *table, const char *name) {
    struct gn_program_cost cost;
    assert_true(gn_cost_table_find(table, name, -1, &cost));
    return cost;
}

static void test_known(void **state) {
    (void)state;
    struct gn_cost_table *pi4 = gn_cost_table_create(text, "pi4"),
                         *g31 = gn_cost_table_create(text, "g31");
    assert_null(gn_cost_table_create(text, "pi"));
    assert_null(gn_cost_table_create(text, "fetches"));
    assert_int_equal(gn_cost_table_count(pi4), 5);
    assert_int_equal(gn_cost_table_count(g31), 4);
    const struct gn_program_cost cost = find(pi4, "lit BASE_TEXTURE, SPOT pcf depth");
    assert_true(cost.fragment == 90 && cost.vertex == 80 && cost.fetches == 5);
    assert_false(cost.estimated || cost.fetches_estimated);
    assert_true(find(g31, "depth").vertex == 30);
    struct gn_program_cost none;
    assert_false(gn_cost_table_find(pi4, "caption", -1, &none));
    assert_false(gn_cost_table_find(pi4, "li BASE_TEXTURE", -1, &none));
    gn_cost_table_destroy(pi4);
    gn_cost_table_destroy(g31);
}

/* The nearest, and what the words cost that differ. */
static void test_estimated(void **state) {
    (void)state;
    struct gn_cost_table *pi4 = gn_cost_table_create(text, "pi4");
    struct gn_program_cost cost = find(pi4, "lit SPECULAR, SPOT");
    assert_true(cost.fragment == 70 && !cost.estimated && cost.fetches_estimated);
    cost = find(pi4, "lit BASE_TEXTURE, POINT pcf depth");
    assert_true(cost.estimated && cost.nearest);
    assert_true(cost.fragment > 80 && cost.fragment < 105);
    assert_true(cost.fetches > 4 && cost.fetches < 5.5);
    /* a texture that no program has is one fetch */
    const double one = find(pi4, "lit BASE_TEXTURE|SPECULAR, SPOT").fetches;
    cost = find(pi4, "lit BASE_TEXTURE|SPECULAR|EMISSIVE_TEXTURE, SPOT");
    assert_true(cost.estimated && cost.fetches >= one);
    gn_cost_table_destroy(pi4);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Fetches of programs as scenes have them: a texture each, and those of the technique; dear ones of
 * other techniques change nothing. */
static void test_fetches(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double fetches;
    } wanted[] = {
        {"lit SPECULAR|HEMISPHERE, DIRECTIONAL pcf depth", 4},
        {"lit BASE_TEXTURE|NORMAL_TEXTURE|SPECULAR|HEMISPHERE, DIRECTIONAL pcf depth cascades", 6},
        {"lit EMISSIVE_TEXTURE|EMISSIVE|HEMISPHERE, POINT pcf depth", 5},
        {"lit BASE_TEXTURE|ROUGHNESS_TEXTURE|OCCLUSION_TEXTURE|NORMAL_TEXTURE|SPECULAR|METAL|"
         "TONE_NEUTRAL|ENVIRONMENT|ENVIRONMENT_DIFFUSE|OCCLUDED, DIRECTIONAL cone rg16f",
         20},
    };
    struct gn_cost_table *table =
        gn_cost_table_create((const char *)gn_embedded_find("programs.cost")->data, "pi4");
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        const double fetches = find(table, wanted[i].name).fetches;
        if (fabs(fetches - wanted[i].fetches) > 0.75)
            fail_msg("%s: %g fetches, not %g", wanted[i].name, fetches, wanted[i].fetches);
    }
    gn_cost_table_destroy(table);
}

/* The embedded table has all GPUs; each lit program, estimated by the others, is near what it is.
 */
static void test_embedded(void **state) {
    (void)state;
    const struct gn_embedded *file = gn_embedded_find("programs.cost");
    assert_non_null(file);
    for (int gpu = 0; gpu < GN_COST_GPU_COUNT; gpu++) {
        struct gn_cost_table *table =
            gn_cost_table_create((const char *)file->data, gn_cost_gpus[gpu].name);
        assert_non_null(table);
        double errors[400];
        int count = 0;
        for (int i = gpu % 3; i < gn_cost_table_count(table) && count < 400; i += 3) {
            const char *name = gn_cost_table_name(table, i);
            struct gn_program_cost estimated;
            if (strncmp(name, "lit ", 4) != 0) continue;
            assert_true(gn_cost_table_find(table, name, i, &estimated) && estimated.estimated);
            errors[count++] = fabs(estimated.fragment / find(table, name).fragment - 1);
        }
        assert_true(count > 60);
        qsort(errors, (size_t)count, sizeof *errors, compare);
        if (errors[count / 2] > .1 || errors[count * 9 / 10] > .4)
            fail_msg("%s: %g in the median, %g of nine tenths", gn_cost_gpus[gpu].name,
                     errors[count / 2], errors[count * 9 / 10]);
        gn_cost_table_destroy(table);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known),
        cmocka_unit_test(test_estimated),
        cmocka_unit_test(test_fetches),
        cmocka_unit_test(test_embedded),
    };
    return RUN(tests);
}
