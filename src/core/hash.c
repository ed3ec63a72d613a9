#include "core/hash.h"

#include <stdbool.h>
#include <string.h>
#include <sys/auxv.h>

static uint64_t mix_word(uint64_t h, uint64_t word) {
    h = (h ^ word) * UINT64_C(0xd6e8feb86659fd93);
    h ^= h >> 32;
    h *= UINT64_C(0xd6e8feb86659fd93);
    return h ^ (h >> 29);
}

uint64_t gn_hash(uint64_t h, const void *data, size_t size) {
    const unsigned char *at = data;
    uint64_t word;
    for (size_t left = size; left >= sizeof word; left -= sizeof word, at += sizeof word) {
        memcpy(&word, at, sizeof word);
        h = mix_word(h, word);
    }
    word = 0;
    if (size % sizeof word) memcpy(&word, at, size % sizeof word);
    return mix_word(h, word ^ ((uint64_t)size << 56 | (uint64_t)size << 24));
}

/* ---- SipHash-1-3: Aumasson and Bernstein, SipHash: a fast short-input PRF, 2012 ---- */

static uint64_t rotate_left(uint64_t word, int bits) { return word << bits | word >> (64 - bits); }

static void sip_rounds(uint64_t v[4], int count) {
    for (int i = 0; i < count; i++) {
        v[0] += v[1], v[1] = rotate_left(v[1], 13) ^ v[0], v[0] = rotate_left(v[0], 32);
        v[2] += v[3], v[3] = rotate_left(v[3], 16) ^ v[2];
        v[0] += v[3], v[3] = rotate_left(v[3], 21) ^ v[0];
        v[2] += v[1], v[1] = rotate_left(v[1], 17) ^ v[2], v[2] = rotate_left(v[2], 32);
    }
}

uint64_t gn_hash_keyed(const struct gn_hash_key *key, const void *data, size_t size) {
    uint64_t v[4] = {
        key->word[0] ^ UINT64_C(0x736f6d6570736575), key->word[1] ^ UINT64_C(0x646f72616e646f6d),
        key->word[0] ^ UINT64_C(0x6c7967656e657261), key->word[1] ^ UINT64_C(0x7465646279746573)};
    const unsigned char *at = data;
    for (size_t left = size;; left -= sizeof(uint64_t), at += sizeof(uint64_t)) {
        const bool is_last = left < sizeof(uint64_t);
        uint64_t word = 0;
        memcpy(&word, at, is_last ? left : sizeof word);
        if (is_last) word |= (uint64_t)size << 56;
        v[3] ^= word;
        sip_rounds(v, 1);
        v[0] ^= word;
        if (is_last) break;
    }
    v[2] ^= 0xff;
    sip_rounds(v, 3);
    return v[0] ^ v[1] ^ v[2] ^ v[3];
}

struct gn_hash_key gn_hash_key_make(void) {
    struct gn_hash_key key = {{0}};
    const void *random = (const void *)getauxval(AT_RANDOM); /* 16 bytes from the kernel */
    if (random) memcpy(&key, random, sizeof key);
    return key;
}
