#include "unit/check.h"

#include <string.h>

#include "core/arena.h"

static void pieces_are_zeroed_aligned_and_apart(void **state) {
    (void)state;
    struct gn_arena arena = {.block = 256};
    unsigned char *pieces[100];
    for (int i = 0; i < 100; i++) {
        size_t size = (size_t)(i * 7 % 40);
        pieces[i] = gn_arena_alloc(&arena, size, 1);
        assert_non_null(pieces[i]);
        assert_int_equal((uintptr_t)pieces[i] % 16, 0);
        for (size_t k = 0; k < size; k++) assert_int_equal(pieces[i][k], 0);
        memset(pieces[i], i, size);
    }
    for (int i = 0; i < 100; i++)
        for (size_t k = 0; k < (size_t)(i * 7 % 40); k++) assert_int_equal(pieces[i][k], i);
    gn_arena_finish(&arena);
}

static void a_piece_may_be_larger_than_a_block(void **state) {
    (void)state;
    struct gn_arena arena = {.block = 64};
    char *large = gn_arena_alloc(&arena, 1000, 100);
    assert_non_null(large);
    large[99999] = 1;
    assert_int_equal(arena.used, 100000);
    gn_arena_finish(&arena);
}

static void a_product_that_overflows_fails(void **state) {
    (void)state;
    struct gn_arena arena = {0};
    assert_null(gn_arena_alloc(&arena, SIZE_MAX / 2, 3));
    assert_null(gn_arena_alloc(&arena, SIZE_MAX, 1));
    assert_null(gn_arena_alloc(&arena, SIZE_MAX - 40, 1));
    assert_int_equal(arena.used, 0);
    gn_arena_finish(&arena);
}

static void the_limit_is_exact(void **state) {
    (void)state;
    struct gn_arena arena = {.limit = 100};
    assert_non_null(gn_arena_alloc(&arena, 60, 1));
    assert_null(gn_arena_alloc(&arena, 41, 1));
    assert_non_null(gn_arena_alloc(&arena, 40, 1));
    assert_null(gn_arena_alloc(&arena, 1, 1));
    gn_arena_finish(&arena);
}

static void use_like_a_frame(struct gn_arena *arena) {
    for (int i = 0; i < 50; i++) {
        unsigned char *piece = gn_arena_alloc(arena, (size_t)(1 + i * 13 % 300), 1);
        assert_int_equal(piece[0], 0);
        piece[0] = 0xff;
    }
}

static void after_a_reset_nothing_is_allocated_and_all_is_zero(void **state) {
    (void)state;
    struct gn_arena arena = {.block = 512};
    use_like_a_frame(&arena);
    unsigned long count = gn_alloc_count();
    for (int frame = 0; frame < 5; frame++) {
        gn_arena_reset(&arena);
        assert_int_equal(arena.used, 0);
        use_like_a_frame(&arena);
    }
    assert_int_equal(gn_alloc_count(), count);
    gn_arena_finish(&arena);
}

static void a_larger_block_behind_is_used_again(void **state) {
    (void)state;
    struct gn_arena arena = {.block = 64};
    gn_arena_alloc(&arena, 40, 1);
    gn_arena_alloc(&arena, 5000, 1);
    gn_arena_reset(&arena);
    unsigned long count = gn_alloc_count();
    assert_non_null(gn_arena_alloc(&arena, 5000, 1));
    assert_int_equal(gn_alloc_count(), count);
    gn_arena_finish(&arena);
}

static void the_last_piece_can_be_taken_back(void **state) {
    (void)state;
    struct gn_arena arena = {.limit = 6000, .block = 256};
    char *kept = gn_arena_strdup(&arena, "sun");
    for (size_t size = 100; size < 5000; size += 300) { /* in the block, and in one of its own */
        unsigned char *piece = gn_arena_alloc(&arena, size, 1);
        for (size_t i = 0; i < size; i++) assert_int_equal(piece[i], 0);
        memset(piece, 1, size);
        gn_arena_undo(&arena, piece, size);
        assert_int_equal(arena.used, 4);
    }
    assert_string_equal(kept, "sun");
    gn_arena_finish(&arena);
    gn_arena_undo(&arena, gn_arena_alloc(&arena, 5000, 1), 5000);
    assert_non_null(gn_arena_alloc(&arena, 6000, 1));
    gn_arena_finish(&arena);
}

static void the_nth_request_can_be_made_to_fail(void **state) {
    (void)state;
    struct gn_arena arena = {0};
    gn_alloc_fail_at(2);
    assert_non_null(gn_arena_alloc(&arena, 1, 1));
    assert_null(gn_arena_strdup(&arena, "x"));
    assert_non_null(gn_arena_alloc(&arena, 1, 1));
    gn_alloc_fail_at(1);
    gn_alloc_fail_at(0);
    assert_non_null(gn_arena_alloc(&arena, 1, 1));
    gn_arena_finish(&arena);
}

static void a_finished_arena_may_be_used_again(void **state) {
    (void)state;
    struct gn_arena arena = {0};
    gn_arena_finish(&arena);
    assert_string_equal(gn_arena_strdup(&arena, "sun"), "sun");
    gn_arena_finish(&arena);
    gn_arena_finish(&arena);
    assert_string_equal(gn_arena_strdup(&arena, ""), "");
    gn_arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_zeroed_aligned_and_apart),
        cmocka_unit_test(a_piece_may_be_larger_than_a_block),
        cmocka_unit_test(a_product_that_overflows_fails),
        cmocka_unit_test(the_limit_is_exact),
        cmocka_unit_test(after_a_reset_nothing_is_allocated_and_all_is_zero),
        cmocka_unit_test(a_larger_block_behind_is_used_again),
        cmocka_unit_test(the_last_piece_can_be_taken_back),
        cmocka_unit_test(the_nth_request_can_be_made_to_fail),
        cmocka_unit_test(a_finished_arena_may_be_used_again),
    };
    return RUN(tests);
}
