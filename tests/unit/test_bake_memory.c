/* gnomon bake holds no more than memory_mb, whatever a small file asks for. */
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

#include "bake/bake.h"
#include "fuzz/bomb_pictures.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

struct baked {
    struct gn_bake_report report;
    struct gn_warnings warnings;
    struct gn_err err;
};

/* Finishes the maker. */
static bool bake_within(struct gn_maker *m, uint64_t memory_mb, struct baked *out) {
    const struct gn_scene_limits limits = {.memory_mb = memory_mb};
    const struct gn_bake_opts opts = {
        .path = "t", .share = 1, .texture_limit_px = 16, .limits = &limits};
    struct gn_made made = gn_maker_glb(m);
    struct gn_bytes bytes = {0};
    *out = (struct baked){0};
    const bool done =
        gn_bake(&opts, made.data, made.size, &bytes, &out->report, &out->warnings, &out->err);
    gn_bytes_finish(&bytes);
    free(made.data);
    gn_maker_finish(m);
    return done;
}

/* Vertices at one place, with 16 targets that the file does not hold: 5.5 MB of .4 MB. */
static void make_empty_targets(struct gn_maker *m) {
    enum { COUNT = 30000, TARGETS = 16 };
    static const float zeros[COUNT][3];
    char text[400];
    gn_maker_init(m);
    const int p = gn_maker_accessor(m, "VEC3", 5126, COUNT, zeros, sizeof zeros, NULL);
    snprintf(text, sizeof text, "{'componentType':5126,'count':%d,'type':'VEC3'}", COUNT);
    gn_maker_add(m, "accessors", text);
    int n =
        snprintf(text, sizeof text, "{'primitives':[{'attributes':{'POSITION':%d},'targets':[", p);
    for (int i = 0; i < TARGETS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "%s{'POSITION':%d}", i ? "," : "", p + 1);
    snprintf(text + n, sizeof text - (size_t)n, "]}]}");
    gn_maker_add(m, "meshes", text);
    gn_maker_set(m, "nodes", "[{'mesh':0}]");
    gn_maker_set(m, "scenes", "[{'nodes':[0]}]");
}

static void test_data_that_is_not_in_the_file_counts(void **state) {
    (void)state;
    struct baked b;
    struct gn_maker m;
    make_empty_targets(&m);
    assert_false(bake_within(&m, 3, &b));
    if (!strstr(b.err.text, "over the limit memory_mb=3")) fail_msg("%s", b.err.text);
    make_empty_targets(&m);
    if (!bake_within(&m, 64, &b)) fail_msg("%s", b.err.text);
}

/* 1024 x 1024 texels are 4 MB, of which PNG has a row at a time and a progressive JPEG 6 MB of
 * coefficients. */
static void test_a_picture_that_does_not_fit_stays_as_it_is(void **state) {
    (void)state;
    uint8_t *rgba = calloc(1024 * 1024, 4);
    struct gn_made pictures[] = {gn_maker_png(1024, 1024, rgba),
                                 gn_bomb_jpeg_progressive(1024, 1024, TJSAMP_444)};
    for (int i = 0; i < 2; i++) {
        struct gn_maker m;
        struct baked b;
        char image[80];
        make_empty_targets(&m);
        gn_maker_set(&m, "nodes", "[{}]");
        gn_maker_set(&m, "meshes", "[]");
        snprintf(image, sizeof image, "{'mimeType':'image/png','bufferView':%d}",
                 gn_maker_view(&m, pictures[i].data, pictures[i].size));
        gn_maker_add(&m, "images", image);
        if (!bake_within(&m, 3, &b)) fail_msg("%s", b.err.text);
        assert_int_equal(b.report.scaled_images, i == 0);
        if (i == 1) assert_non_null(strstr(b.warnings.text[0], "memory_mb; kept as it is"));
        free(pictures[i].data);
    }
    free(rgba);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_data_that_is_not_in_the_file_counts),
        cmocka_unit_test(test_a_picture_that_does_not_fit_stays_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
