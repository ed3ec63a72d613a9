/* Radiance pictures, broken at random: sizes at the edges of their types, runs of other lengths,
 * flipped bytes, cut ends. What comes out is one line or all rows, in time.
 *
 *   test_hdr_mutations [FIRST [COUNT]]    GN_FULL=1: 20,000 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "environment/environment.h"
#include "image/dice.h"
#include "image/read.h"
#include "unit/check.h"

enum { W = 16, H = 8, SEEDS = 3, ROOM = 2048, SECONDS = 2, PREFILTERED_EVERY = 400 };
static uint64_t first = 1, count = 2000;

static const struct gn_environment_work one_thread = {.threads = 1};

struct picture {
    uint8_t data[ROOM];
    size_t size;
};

static void put(struct picture *p, const void *data, size_t size) {
    memcpy(p->data + p->size, data, size);
    p->size += size;
}

/* ---- seeds: as plain pixels, with old runs, with new ones ---- */

static void put_new_row(struct picture *p) {
    put(p, (uint8_t[]){2, 2, 0, W}, 4);
    for (int channel = 0; channel < 4; channel++) {
        put(p, (uint8_t[]){128 + W / 2, (uint8_t)(channel < 3 ? 50 : 129), W / 2}, 3);
        for (int x = 0; x < W / 2; x++)
            put(p, (uint8_t[]){(uint8_t)(channel < 3 ? 9 * x : 128 + x % 3)}, 1);
    }
}

static void put_row(struct picture *p, int seed, int y) {
    if (seed == 2) {
        put_new_row(p);
        return;
    }
    for (int x = 0; x < (seed == 1 ? 1 : W); x++)
        put(p, (uint8_t[]){(uint8_t)(20 + x), (uint8_t)(30 * y), 9, 130}, 4);
    if (seed == 1) put(p, (uint8_t[]){1, 1, 1, W - 1}, 4);
}

static struct picture make_seed(int seed) {
    struct picture p = {.size = 0};
    const char *head =
        seed == 0 ? "#?RGBE\n\n" : "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n";
    put(&p, head, strlen(head));
    char size[40];
    put(&p, size, (size_t)snprintf(size, sizeof size, "-Y %d +X %d\n", H, W));
    for (int y = 0; y < H; y++) put_row(&p, seed, y);
    return p;
}

/* ---- mutations ---- */

static size_t below(struct gn_dice *dice, size_t n) { return (size_t)(gn_dice_next(dice) % n); }

static void write_size(struct picture *p, struct gn_dice *dice) {
    static const char *const numbers[] = {"0",
                                          "1",
                                          "7",
                                          "8",
                                          "16384",
                                          "16385",
                                          "32767",
                                          "4294967295",
                                          "4294967296",
                                          "99999999999999999999",
                                          "-1",
                                          "1e9",
                                          ""};
    const struct picture old = *p;
    char *line = strstr((char *)p->data, "-Y ");
    const char *rest = line ? strchr(line, '\n') : NULL;
    if (!rest) return;
    const size_t start = (size_t)(line - (char *)p->data), end = (size_t)(rest - (char *)p->data);
    char size[100];
    const size_t n = sizeof numbers / sizeof numbers[0];
    p->size = start;
    put(p, size,
        (size_t)snprintf(size, sizeof size, "-Y %s +X %s", numbers[below(dice, n)],
                         below(dice, 2) ? numbers[below(dice, n)] : "16"));
    put(p, old.data + end, old.size - end);
}

static struct picture make_mutant(uint64_t number) {
    struct gn_dice dice = {.state = number};
    struct picture p = make_seed((int)below(&dice, SEEDS));
    if (below(&dice, 4) == 0) write_size(&p, &dice);
    for (size_t n = below(&dice, 6); n > 0; n--) {
        const size_t at = below(&dice, p.size);
        p.data[at] =
            below(&dice, 2) ? (uint8_t)gn_dice_next(&dice) : p.data[at] ^ 1 << below(&dice, 8);
    }
    if (below(&dice, 4) == 0) p.size = below(&dice, p.size + 1);
    return p;
}

/* ---- what must hold ---- */

struct seen {
    uint32_t rows, width;
    uint64_t sum; /* every byte is read: sanitizers see where it lies */
};

static void see_row(void *user, uint32_t y, const uint8_t *rgbe) {
    struct seen *seen = user;
    assert_int_equal(y, seen->rows++);
    for (uint32_t i = 0; i < 4 * seen->width; i++) seen->sum += rgbe[i];
}

static void check_line(const struct gn_err *err, uint64_t number) {
    if (strncmp(err->text, "HDR: ", 5) != 0 || strchr(err->text, '\n'))
        fail_msg("mutant %llu: \"%s\"", (unsigned long long)number, err->text);
}

static void check_environment(const struct picture *p, uint64_t number) {
    static struct gn_environment environment;
    struct gn_err err = {0};
    if (!gn_environment_read_hdr(p->data, p->size, &one_thread, &environment, &err))
        check_line(&err, number);
    else
        for (int i = 0; i < 3; i++) assert_true(isfinite(environment.key.color[i]));
}

static void test_mutants_give_all_rows_or_one_line(void **state) {
    (void)state;
    uint64_t read = 0, refused = 0;
    int64_t slowest_ns = 0;
    for (uint64_t i = first; i < first + count; i++) {
        const struct picture made = make_mutant(i);
        uint8_t *exact = malloc(made.size + 1); /* so that what lies behind its end is found out */
        assert_non_null(exact);
        memcpy(exact, made.data, made.size);
        struct gn_err err = {0};
        struct seen seen = {0};
        uint32_t px[2] = {0};
        const int64_t start_ns = gn_clock_thread_cpu_ns();
        bool ok = gn_hdr_size(exact, made.size, px, &err);
        seen.width = px[0];
        ok = ok && gn_hdr_read(exact, made.size, see_row, &seen, &err);
        const int64_t took_ns = gn_clock_thread_cpu_ns() - start_ns;
        if (took_ns > slowest_ns) slowest_ns = took_ns;
        if (ok)
            assert_int_equal(seen.rows, px[1]);
        else
            check_line(&err, i);
        *(ok ? &read : &refused) += 1;
        if (i % PREFILTERED_EVERY == 0) check_environment(&made, i);
        free(exact);
    }
    printf("%llu mutants: %llu read, %llu refused; slowest %lld ms\n", (unsigned long long)count,
           (unsigned long long)read, (unsigned long long)refused,
           (long long)(slowest_ns / 1000000));
    assert_true(count < 100 || (read > count / 20 && refused > count / 20));
    assert_true(slowest_ns < SECONDS * GN_NS_PER_S);
}

/* One that is kept in a file is read as it was written, or not at all. */
static void test_a_broken_kept_environment_is_not_read(void **state) {
    (void)state;
    static struct gn_environment environment, again;
    static uint8_t file[GN_ENVIRONMENT_FILE_BYTES];
    const struct picture seed = make_seed(2);
    struct gn_err err = {0};
    assert_true(gn_environment_read_hdr(seed.data, seed.size, &one_thread, &environment, &err));
    gn_environment_write(&environment, file);
    assert_true(gn_environment_read(file, sizeof file, &again));
    struct gn_dice dice = {.state = first};
    for (int i = 0; i < 200; i++) {
        const size_t at = below(&dice, sizeof file);
        const uint8_t bit = (uint8_t)(1 << below(&dice, 8));
        file[at] ^= bit;
        if (gn_environment_read(file, sizeof file, &again))
            fail_msg("byte %zu is not looked at", at);
        file[at] ^= bit;
        assert_false(gn_environment_read(file, below(&dice, sizeof file), &again));
    }
}

int main(int argc, char **argv) {
    if (getenv("GN_FULL")) count = 20000;
    if (argc > 1) first = strtoull(argv[1], NULL, 10), count = 1;
    if (argc > 2) count = strtoull(argv[2], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mutants_give_all_rows_or_one_line),
        cmocka_unit_test(test_a_broken_kept_environment_is_not_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
