/* Makes the Poisson disks of `--shadow poisson`: points in the unit disk and their opposites, with
 * the largest possible minimum distance. Bridson, "Fast Poisson Disk Sampling in Arbitrary
 * Dimensions", SIGGRAPH 2007: new points are tried in a ring of one to two distances around
 * existing ones, until none fits. The distance is found by bisection; then the points are scaled to
 * the mean square radius of the disk, so that filters keep their width. Prints a C table of one
 * point of each pair. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { POINTS_MAX = 64 /* pairs */, TRIES = 30, SEEDS = 64, FEW_SEEDS = 8 };

struct disk {
    int count;
    double at[POINTS_MAX][2];
};

static double dice(uint64_t *state) { /* 0 <= x < 1; splitmix64 */
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static bool fits_point(const struct disk *disk, const double p[2], double apart) {
    double radius = hypot(p[0], p[1]);
    if (radius > 1 || 2 * radius < apart) return false;
    for (int i = 0; i < disk->count; i++)
        for (int side = -1; side <= 1; side += 2)
            if (hypot(p[0] - side * disk->at[i][0], p[1] - side * disk->at[i][1]) < apart)
                return false;
    return true;
}

static void add_point(struct disk *disk, const double p[2]) {
    memcpy(disk->at[disk->count++], p, sizeof disk->at[0]);
}

/* Adds a neighbour of the point, if one fits. */
static bool neighbour(struct disk *disk, const double from[2], double apart, uint64_t *state) {
    for (int i = 0; i < TRIES; i++) {
        double angle = 2 * M_PI * dice(state), radius = apart * sqrt(1 + 3 * dice(state));
        double p[2] = {from[0] + radius * cos(angle), from[1] + radius * sin(angle)};
        if (!fits_point(disk, p, apart)) continue;
        add_point(disk, p);
        return true;
    }
    return false;
}

static void fill_disk(struct disk *disk, double apart, uint64_t state) {
    int active[POINTS_MAX], active_count = 1;
    double first[2];
    disk->count = 0;
    do {
        double radius = sqrt(dice(&state)), angle = 2 * M_PI * dice(&state);
        first[0] = radius * cos(angle), first[1] = radius * sin(angle);
    } while (!fits_point(disk, first, apart));
    add_point(disk, first);
    active[0] = 0;
    while (active_count > 0 && disk->count < POINTS_MAX) {
        int pick = (int)(dice(&state) * active_count);
        if (neighbour(disk, disk->at[active[pick]], apart, &state))
            active[active_count++] = disk->count - 1;
        else
            active[pick] = active[--active_count];
    }
}

/* The disk of exactly `count` pairs with the largest distance over all seeds; of many pairs over a
 * few, which are as good as each other and take long. */
static struct disk widest_disk(int count) {
    struct disk best = {0}, disk;
    double best_apart = 0;
    for (uint64_t seed = 1; seed <= (count > 16 ? FEW_SEEDS : SEEDS); seed++) {
        double low = 0.3 / sqrt(count), high = 1.9 / sqrt(count);
        for (int step = 0; step < 20; step++) {
            double apart = 0.5 * (low + high);
            fill_disk(&disk, apart, seed);
            if (disk.count == count && apart > best_apart) best = disk, best_apart = apart;
            if (disk.count >= count)
                low = apart;
            else
                high = apart;
        }
    }
    return best;
}

static void scale_disk(struct disk *disk) {
    double square = 0;
    for (int i = 0; i < disk->count; i++)
        for (int k = 0; k < 2; k++) square += disk->at[i][k] * disk->at[i][k] / disk->count;
    for (int i = 0; i < disk->count; i++)
        for (int k = 0; k < 2; k++) disk->at[i][k] *= sqrt(0.5 / square);
}

int main(void) {
    printf("/* made by assets/make_poisson.c: disks of 4, 8, 12 .. 64 points, a pair's first */\n");
    printf("static const float poisson_disks[][2] = {\n");
    for (int count = 4; count <= 64; count += 4) {
        struct disk disk = widest_disk(count / 2);
        if (disk.count != count / 2) return 1;
        scale_disk(&disk);
        for (int k = 0; k < disk.count; k++)
            printf("    {%.6ff, %.6ff},\n", disk.at[k][0], disk.at[k][1]);
    }
    printf("};\n");
    return 0;
}
