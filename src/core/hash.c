#include "core/hash.h"

#include <string.h>

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
