#include "image/microfacets.h"

#include <math.h>

#include "image/dice.h"

enum { WALKS = 60000, MOST_HITS = 64 };

struct vector {
    double x, y, z; /* z: along the normal of the surface */
};

static double random_share(struct gn_dice *dice) { return gn_dice_between(dice, 1e-12, 1); }

/* Smith's Lambda. */
static double masking(struct vector w, double alpha) {
    const double slope = alpha * sqrt(1 - w.z * w.z) / w.z;
    return .5 * (copysign(sqrt(1 + slope * slope), w.z) - 1);
}

/* Height of the next facet in the direction w, of heights spread evenly over 0 to 1; above 1: none.
 */
static double next_height(struct vector w, double height, double alpha, double share) {
    if (w.z > .9999) return 2;
    if (w.z < -.9999) return share * height;
    if (fabs(w.z) < 1e-4) return height;
    const double lambda = masking(w, alpha);
    if (w.z > 0 && share > 1 - pow(height, lambda)) return 2;
    return fmin(height / pow(1 - share, 1 / lambda), 1);
}

/* A normal of a facet as the direction w sees them. Dupuy, Benyoub, "Sampling Visible GGX Normals
 * with Spherical Caps" (2023). */
static struct vector seen_facet(struct vector w, double alpha, struct gn_dice *dice) {
    const double length = sqrt(alpha * alpha * (w.x * w.x + w.y * w.y) + w.z * w.z);
    const struct vector s = {alpha * w.x / length, alpha * w.y / length, w.z / length};
    const double around = 2 * acos(-1) * random_share(dice);
    const double z = (1 - random_share(dice)) * (1 + s.z) - s.z, r = sqrt(fmax(1 - z * z, 0));
    struct vector m = {alpha * (r * cos(around) + s.x), alpha * (r * sin(around) + s.y), z + s.z};
    const double size = sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
    return (struct vector){m.x / size, m.y / size, m.z / size};
}

/* Share of the light that comes out again. */
static double walk(double f0, double alpha, double n_v, struct gn_dice *dice) {
    struct vector w = {-sqrt(1 - n_v * n_v), 0, -n_v};
    double share = 1, height = 1;
    for (int i = 0; i < MOST_HITS; i++) {
        height = next_height(w, height, alpha, random_share(dice));
        if (height > 1) return share;
        const struct vector back = {-w.x, -w.y, -w.z}, m = seen_facet(back, alpha, dice);
        const double along = fmax(back.x * m.x + back.y * m.y + back.z * m.z, 0);
        w = (struct vector){2 * along * m.x - back.x, 2 * along * m.y - back.y,
                            2 * along * m.z - back.z};
        share *= f0 + (1 - f0) * pow(1 - along, 5);
    }
    return share;
}

double gn_microfacets_return(double f0, double roughness, double n_v) {
    struct gn_dice dice = {1};
    double sum = 0;
    for (int i = 0; i < WALKS; i++) sum += walk(f0, roughness * roughness, n_v, &dice);
    return sum / WALKS;
}
