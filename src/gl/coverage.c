#include "gl/coverage.h"

#include <math.h>
#include <string.h>

enum {
    STEPS = 1024, /* of alpha, in which samples are counted */
    POINTS = 192, /* samples along a side of the whole picture, at most */
    FIT_POINTS = 64,
    PER_TEXEL = 4, /* samples along a side of a texel, at most */
    FITS = 6,
};
#define CLOSE 0.02f /* share of a share */

/* Where between 0 and 1 a sample lies in its cell, so that no regular mask hides between samples
 * (Wellons' integer hash). */
static float jitter(uint32_t n) {
    n = (n ^ n >> 16) * 0x7feb352du;
    n = (n ^ n >> 15) * 0x846ca68bu;
    return (float)((n ^ n >> 16) >> 8) / 16777216.0f;
}

/* Alpha of the surface between texels, which repeats. */
static float sample_alpha(const struct gn_coverage_level *l, float s, float t) {
    const float x = s * (float)l->px[0], y = t * (float)l->px[1];
    const uint32_t left = (uint32_t)x % l->px[0], top = (uint32_t)y % l->px[1];
    const uint32_t right = (left + 1) % l->px[0], below = (top + 1) % l->px[1];
    const uint8_t *row = l->rgba + 4 * (size_t)top * l->px[0] + 3,
                  *next = l->rgba + 4 * (size_t)below * l->px[0] + 3;
    float at[4] = {row[4 * left], row[4 * right], next[4 * left], next[4 * right]};
    for (int i = 0; i < 4 && l->alpha; i++) at[i] = l->alpha[(int)at[i]];
    const float u = x - floorf(x), v = y - floorf(y);
    const float a = at[0] + u * (at[1] - at[0]), b = at[2] + u * (at[3] - at[2]);
    return (a + v * (b - a)) / 255.0f;
}

/* Counts by alpha up to most x most samples of a level, and of what is halfway between it and
 * `larger`, unless that is NULL; returns how many there are in all. */
static uint32_t count_samples(const struct gn_coverage_level *larger,
                              const struct gn_coverage_level *level, uint32_t most,
                              uint32_t counts[STEPS + 1]) {
    uint32_t n[2];
    for (int k = 0; k < 2; k++)
        n[k] = level->px[k] < most / PER_TEXEL ? PER_TEXEL * level->px[k] : most;
    memset(counts, 0, (STEPS + 1) * sizeof *counts);
    for (uint32_t j = 0; j < n[1]; j++)
        for (uint32_t i = 0; i < n[0]; i++) {
            const uint32_t number = 2 * (j * n[0] + i);
            const float s = ((float)i + jitter(number)) / (float)n[0],
                        t = ((float)j + jitter(number + 1)) / (float)n[1];
            const float alpha = sample_alpha(level, s, t);
            counts[(int)(alpha * STEPS + 0.5f)]++;
            if (!larger) continue;
            /* the middles of texels of both, by half a texel of each */
            const float before = sample_alpha(
                larger, s + 0.5f / (float)level->px[0] - 0.5f / (float)larger->px[0] + 1.0f,
                t + 0.5f / (float)level->px[1] - 0.5f / (float)larger->px[1] + 1.0f);
            counts[(int)(0.5f * (alpha + before) * STEPS + 0.5f)]++;
        }
    return (larger ? 2 : 1) * n[0] * n[1];
}

static float share_over(const uint32_t counts[STEPS + 1], uint32_t all, float cutoff) {
    uint32_t over = 0;
    for (int k = STEPS; k >= (int)(cutoff * STEPS + 0.5f); k--) over += counts[k];
    return (float)over / (float)all;
}

struct gn_coverage gn_coverage_measure(float cutoff, const struct gn_coverage_level *whole) {
    uint32_t counts[STEPS + 1];
    const uint32_t all = count_samples(NULL, whole, POINTS, counts);
    return (struct gn_coverage){.cutoff = cutoff, .share = share_over(counts, all, cutoff)};
}

/* The alpha that so many samples reach. */
static float find_quantile(const uint32_t counts[STEPS + 1], float samples) {
    float over = 0.0f;
    int k = STEPS;
    while (k > 1 && over + (float)counts[k] < samples) over += (float)counts[k--];
    /* within the step: as if its samples lay evenly in it */
    const float part = counts[k] > 0 ? (samples - over) / (float)counts[k] : 0.0f;
    return ((float)k + 0.5f - fminf(part, 1.0f)) / STEPS;
}

static void scale_alpha(float scale, uint8_t alpha[256]) {
    for (int i = 0; i < 256; i++) alpha[i] = (uint8_t)fminf(scale * (float)i + 0.5f, 255.0f);
}

void gn_coverage_fit(const struct gn_coverage *c, const struct gn_coverage_level *larger,
                     const struct gn_coverage_level *level, uint8_t alpha[256]) {
    struct gn_coverage_level scaled = *level;
    uint32_t counts[STEPS + 1];
    uint8_t tried[256];
    float scale = 1.0f, least = INFINITY;
    scale_alpha(scale, alpha);
    scaled.alpha = tried;
    if (c->share <= 0.0f || c->share >= 1.0f) return;
    /* Again after the scale, since alpha ends at 1; and the best of all, since a picture of few
     * alphas has shares by leaps. */
    for (int fit = 0; fit < FITS && least > CLOSE; fit++) {
        scale_alpha(scale, tried);
        const uint32_t all = count_samples(larger, &scaled, FIT_POINTS, counts);
        const float off = fabsf(share_over(counts, all, c->cutoff) / c->share - 1.0f);
        if (off < least) memcpy(alpha, tried, sizeof tried);
        least = fminf(least, off);
        scale *= c->cutoff / find_quantile(counts, c->share * (float)all);
    }
}
