#include "unit/check.h"

#include <stdlib.h>
#include <string.h>

#include "core/hash.h"

static void equal_bytes_hash_equally(void **state) {
    (void)state;
    char a[33] = "the shadow of a gnomon tells time", b[34];
    memcpy(b + 1, a, sizeof a); /* at another alignment */
    for (size_t size = 0; size <= sizeof a; size++)
        assert_true(gn_hash(GN_HASH_INIT, a, size) == gn_hash(GN_HASH_INIT, b + 1, size));
}

static void the_length_counts(void **state) {
    (void)state;
    const char zeros[64] = {0};
    uint64_t seen[64];
    for (size_t i = 0; i < 64; i++) {
        seen[i] = gn_hash(GN_HASH_INIT, zeros, i);
        for (size_t k = 0; k < i; k++) assert_true(seen[k] != seen[i]);
    }
}

static void the_order_of_a_chain_counts(void **state) {
    (void)state;
    uint64_t ab = gn_hash(gn_hash(GN_HASH_INIT, "a", 1), "b", 1);
    uint64_t ba = gn_hash(gn_hash(GN_HASH_INIT, "b", 1), "a", 1);
    assert_true(ab != ba);
    assert_true(ab != gn_hash(GN_HASH_INIT, "b", 1));
}

static int compare(const void *a, const void *b) {
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Any two of these 66,000 hashes collide with a chance of 1e-10; a weak mix collides at once. */
static void every_bit_counts(void **state) {
    enum { BYTES = 32, ROUNDS = 257 };
    (void)state;
    static uint64_t seen[BYTES * 8 * ROUNDS];
    size_t count = 0;
    for (int round = 0; round < ROUNDS; round++) {
        unsigned char data[BYTES] = {0};
        data[0] = (unsigned char)round;
        data[9] = (unsigned char)(round >> 8);
        for (int bit = 0; bit < BYTES * 8; bit++) {
            if (bit < 8 || (bit >= 72 && bit < 80)) continue;
            data[bit / 8] ^= (unsigned char)(1 << bit % 8);
            seen[count++] = gn_hash(GN_HASH_INIT, data, sizeof data);
            data[bit / 8] ^= (unsigned char)(1 << bit % 8);
        }
    }
    qsort(seen, count, sizeof seen[0], compare);
    for (size_t i = 1; i < count; i++) assert_true(seen[i - 1] != seen[i]);
}

static void one_bit_flips_half_of_the_bits(void **state) {
    (void)state;
    unsigned char data[24] = {0};
    uint64_t before = gn_hash(GN_HASH_INIT, data, sizeof data);
    int flips = 0;
    for (int bit = 0; bit < 192; bit++) {
        data[bit / 8] ^= (unsigned char)(1 << bit % 8);
        flips += __builtin_popcountll(before ^ gn_hash(GN_HASH_INIT, data, sizeof data));
        data[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    assert_in_range(flips / 192, 28, 36);
}

/* The reference implementation's vector for no bytes under the key 00 01 .. 0f. */
static void the_keyed_hash_is_siphash_1_3(void **state) {
    (void)state;
    const struct gn_hash_key key = {{UINT64_C(0x0706050403020100), UINT64_C(0x0f0e0d0c0b0a0908)}};
    assert_true(gn_hash_keyed(&key, "", 0) == UINT64_C(0xabac0158050fc4dc));
}

static void bytes_length_and_key_count(void **state) {
    (void)state;
    const struct gn_hash_key mine = gn_hash_key_make(), other = {{1, 2}};
    const char zeros[24] = {0}, text[] = "the shadow of a gnomon";
    uint64_t seen[24];
    for (size_t i = 0; i < sizeof zeros; i++) {
        seen[i] = gn_hash_keyed(&mine, zeros, i);
        for (size_t k = 0; k < i; k++) assert_true(seen[k] != seen[i]);
    }
    for (size_t i = 0; i < sizeof text; i++) {
        char copy[sizeof text];
        memcpy(copy, text, sizeof text);
        assert_true(gn_hash_keyed(&mine, copy, i) == gn_hash_keyed(&mine, text, i));
        copy[i] ^= 1;
        assert_true(gn_hash_keyed(&mine, copy, i + 1) != gn_hash_keyed(&mine, text, i + 1));
    }
    assert_true(gn_hash_keyed(&mine, text, 8) != gn_hash_keyed(&other, text, 8));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_bytes_hash_equally),
        cmocka_unit_test(the_length_counts),
        cmocka_unit_test(the_order_of_a_chain_counts),
        cmocka_unit_test(every_bit_counts),
        cmocka_unit_test(one_bit_flips_half_of_the_bits),
        cmocka_unit_test(the_keyed_hash_is_siphash_1_3),
        cmocka_unit_test(bytes_length_and_key_count),
    };
    return RUN(tests);
}
