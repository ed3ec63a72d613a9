#include "stage/sky.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "core/hash.h"
#include "core/sun.h"
#include "core/thread.h"
#include "environment/environment.h"

#define CELL_ALTITUDE_DEG 0.5
#define CELL_AZIMUTH_DEG  2.0
/* SKIES: of the sides of a split screen, or of two modes, and the one that is being made. */
enum { THREADS = 2, SKIES = 3, NEAR_CELLS = 15, CELLS_AROUND = (int)(360 / CELL_AZIMUTH_DEG) };

struct cell {
    int altitude, azimuth;
    double turbidity;
    float north_deg;
};
static struct sky {
    bool made;
    uint64_t used; /* when it was shown last, counted in calls */
    struct cell cell;
    double base_strength, strength; /* of the light as it was made, as it is now */
    uint64_t id;
    struct gn_environment base, now;
} skies[SKIES];
static struct {
    struct sky *sky; /* that the thread makes; NULL: there is no thread */
    pthread_t thread;
    atomic_bool done;
} making;
static uint64_t calls;

/* ---- making ---- */

static void make_sky(struct sky *sky, int threads) {
    const struct cell *cell = &sky->cell;
    struct gn_daylight daylight;
    float to_sun[3];
    gn_daylight_build(cell->altitude * CELL_ALTITUDE_DEG, cell->turbidity, &daylight);
    gn_sun_direction(cell->azimuth * CELL_AZIMUTH_DEG, fmax(daylight.altitude_deg, 0),
                     (double)cell->north_deg, to_sun);
    gn_environment_make_sky(&daylight, to_sun, threads, &sky->base);
    sky->base_strength = daylight.strength;
    sky->strength = NAN;
}

static void *make_in_thread(void *user) {
    gn_thread_lower_priority();
    make_sky(user, 1);
    atomic_store(&making.done, true);
    return NULL;
}

static void take_made(bool waits) {
    if (!making.sky || !(waits || atomic_load(&making.done))) return;
    pthread_join(making.thread, NULL);
    making.sky->made = true;
    making.sky = NULL;
}

/* False: there is no thread, and the sky is not made. */
static bool begin_making(struct sky *sky) {
    atomic_store(&making.done, false);
    if (pthread_create(&making.thread, NULL, make_in_thread, sky) != 0) return false;
    making.sky = sky;
    return true;
}

/* ---- which ---- */

static bool is_same_light(const struct cell *a, const struct cell *b) {
    return a->turbidity == b->turbidity && a->north_deg == b->north_deg;
}

static int distance_of(const struct cell *a, const struct cell *b) {
    const int around = abs(a->azimuth - b->azimuth) % CELLS_AROUND,
              up = abs(a->altitude - b->altitude);
    const int azimuth = around < CELLS_AROUND - around ? around : CELLS_AROUND - around;
    return azimuth > up ? azimuth : up;
}

/* Of those that are made, and not further away than that. */
static struct sky *find_nearest(const struct cell *cell, int most) {
    struct sky *nearest = NULL;
    for (int i = 0; i < SKIES; i++) {
        struct sky *sky = &skies[i];
        if (!sky->made || !is_same_light(&sky->cell, cell)) continue;
        const int distance = distance_of(&sky->cell, cell);
        if (distance > most) continue;
        nearest = sky;
        most = distance - 1;
    }
    return nearest;
}

/* The one that was shown before all others. */
static struct sky *take_oldest(const struct cell *cell) {
    struct sky *oldest = &skies[0];
    for (int i = 1; i < SKIES; i++)
        if (skies[i].used < oldest->used) oldest = &skies[i];
    oldest->made = false;
    oldest->cell = *cell;
    return oldest;
}

static struct sky *find_sky(const struct cell *cell, bool behind) {
    take_made(false);
    struct sky *sky = find_nearest(cell, 0);
    struct sky *near = behind ? find_nearest(cell, NEAR_CELLS) : NULL;
    if (sky) return sky;
    if (near && making.sky) return near;
    if (near) {
        near->used = ++calls; /* it stays */
        if (begin_making(take_oldest(cell))) return near;
    }
    take_made(true);
    sky = take_oldest(cell);
    make_sky(sky, THREADS);
    sky->made = true;
    return sky;
}

void gn_stage_sky_set(struct gn_frame_environment_opts *e, const struct gn_daylight *daylight,
                      double azimuth_deg, float north_deg, bool behind) {
    const struct cell cell = {.altitude = (int)lround(daylight->altitude_deg / CELL_ALTITUDE_DEG),
                              .azimuth = (int)lround(azimuth_deg / CELL_AZIMUTH_DEG),
                              .turbidity = daylight->turbidity,
                              .north_deg = north_deg};
    struct sky *sky = find_sky(&cell, behind);
    sky->used = ++calls;
    if (sky->strength != daylight->strength) {
        sky->strength = daylight->strength;
        gn_environment_scale(&sky->base.whole, (float)(sky->strength / sky->base_strength),
                             &sky->now.whole);
        sky->id =
            (gn_hash(GN_HASH_INIT, &sky->now.whole, sizeof sky->now.whole) | 4) & ~UINT64_C(3);
    }
    e->of = &sky->now;
    e->id = sky->id;
    e->lights_key = e->shows_key = e->reflected_only = false;
}
