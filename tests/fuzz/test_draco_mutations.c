/* Files with meshes that Draco compressed, with bytes of the stream changed: gnomon-import ends
 * with a scene or one line, and never takes gnomon along.
 *
 *   test_draco_mutations [FIRST [COUNT]]    GN_FULL=1: 3,000 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "image/dice.h"
#include "stage/stage.h"
#include "unit/check.h"
#include "unit/draco_help.h"
#include "unit/import_help.h"
#include "unit/scene_check.h"

enum { SECONDS = 2, STREAM_BYTES = 121 };
static uint64_t first = 1, count = 150;

/* One to four bytes of the stream, at its head twice as often, as that names methods and counts. */
static void mutate_stream(struct gn_maker *maker, struct gn_dice *dice) {
    for (uint64_t n = 1 + gn_dice_next(dice) % 4; n > 0; n--) {
        const size_t room = gn_dice_next(dice) % 2 ? 24 : STREAM_BYTES;
        maker->bin[gn_dice_next(dice) % room] = (uint8_t)gn_dice_next(dice);
    }
}

static void put_mutant(uint64_t number) {
    struct gn_dice dice = {.state = number};
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_draco(&maker, true);
    mutate_stream(&maker, &dice);
    struct gn_made glb = gn_maker_glb(&maker);
    help_import_put_bytes("m.glb", glb.data, glb.size);
    free(glb.data);
    gn_maker_finish(&maker);
}

static void test_mutants_are_shown_or_refused_by_one_line(void **state) {
    (void)state;
    const struct gn_scene_limits limits = {.memory_mb = 128};
    uint64_t shown = 0, refused = 0;
    int64_t slowest_ns = 0;
    for (uint64_t i = first; i < first + count; i++) {
        put_mutant(i);
        struct gn_err err = {0};
        struct gn_warnings warnings = {0};
        const int64_t start_ns = gn_clock_monotonic_ns();
        struct gn_scene *scene = gn_stage_read(help_import_path("m.glb"), &limits, &warnings, &err);
        const int64_t took_ns = gn_clock_monotonic_ns() - start_ns;
        if (took_ns > slowest_ns) slowest_ns = took_ns;
        if (!scene && strstr(err.text, "built without libdraco")) skip();
        const char *wrong = scene ? gn_scene_check(scene) : NULL;
        if (wrong || (!scene && (!err.text[0] || strchr(err.text, '\n'))))
            fail_msg("mutant %llu: %s", (unsigned long long)i, wrong ? wrong : err.text);
        *(scene ? &shown : &refused) += 1;
        gn_scene_destroy(scene);
    }
    printf("%llu mutants: %llu shown, %llu refused; slowest %lld ms\n", (unsigned long long)count,
           (unsigned long long)shown, (unsigned long long)refused,
           (long long)(slowest_ns / 1000000));
    assert_true(shown > 0 && refused > 0);
    assert_true(slowest_ns < 10 * SECONDS * GN_NS_PER_S); /* a busy machine is slow, too */
}

int main(int argc, char **argv) {
    if (getenv("GN_FULL")) count = 3000;
    if (argc > 1) first = strtoull(argv[1], NULL, 10), count = 1;
    if (argc > 2) count = strtoull(argv[2], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mutants_are_shown_or_refused_by_one_line),
    };
    return help_import_run(tests, 1);
}
