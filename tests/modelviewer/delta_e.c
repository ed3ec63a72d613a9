#include "modelviewer/delta_e.h"

#include <math.h>

#define DEGREES (M_PI / 180)

/* ---- CIELAB: IEC 61966-2-1, then CIE 15 ---- */

static double linear_of(float srgb) {
    const double s = fmin(fmax((double)srgb, 0), 1);
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

static double lab_root(double t) {
    const double d = 6.0 / 29;
    return t > d * d * d ? cbrt(t) : t / (3 * d * d) + 4.0 / 29;
}

void gn_lab_from_srgb(const float srgb[3], double lab[3]) {
    static const double xyz_from_rgb[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                                              {0.2126729, 0.7151522, 0.0721750},
                                              {0.0193339, 0.1191920, 0.9503041}};
    double f[3];
    for (int row = 0; row < 3; row++) {
        double sum = 0, white = 0; /* white is (1, 1, 1) */
        for (int k = 0; k < 3; k++) {
            sum += xyz_from_rgb[row][k] * linear_of(srgb[k]);
            white += xyz_from_rgb[row][k];
        }
        f[row] = lab_root(sum / white);
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

/* ---- CIEDE2000; names as in the paper ---- */

static double hue_of(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double h = atan2(b, a) / DEGREES;
    return h < 0 ? h + 360 : h;
}

static double power7_share(double c) { /* c^7 over c^7 and 25^7 */
    const double c7 = pow(c, 7);
    return sqrt(c7 / (c7 + pow(25, 7)));
}

/* Of two hues, the shorter way around. Grey has none: then the sum, which is that of the other. */
static double mean_hue(double h1, double h2, double chroma) {
    if (chroma == 0) return h1 + h2;
    if (fabs(h1 - h2) <= 180) return (h1 + h2) / 2;
    return h1 + h2 < 360 ? (h1 + h2 + 360) / 2 : (h1 + h2 - 360) / 2;
}

double gn_delta_e_2000(const double a[3], const double b[3]) {
    const double g =
        0.5 * (1 - power7_share((hypot(a[1], a[2]) + hypot(b[1], b[2])) / 2)); /* of the mean */
    const double a1 = (1 + g) * a[1], a2 = (1 + g) * b[1];
    const double c1 = hypot(a1, a[2]), c2 = hypot(a2, b[2]);
    const double h1 = hue_of(a1, a[2]), h2 = hue_of(a2, b[2]);
    double turn = c1 * c2 == 0 ? 0 : h2 - h1;
    if (turn > 180) turn -= 360;
    if (turn < -180) turn += 360;
    const double dl = b[0] - a[0], dc = c2 - c1;
    const double dh = 2 * sqrt(c1 * c2) * sin(turn / 2 * DEGREES);

    const double l = (a[0] + b[0]) / 2, c = (c1 + c2) / 2, h = mean_hue(h1, h2, c1 * c2);
    const double t = 1 - 0.17 * cos((h - 30) * DEGREES) + 0.24 * cos(2 * h * DEGREES) +
                     0.32 * cos((3 * h + 6) * DEGREES) - 0.20 * cos((4 * h - 63) * DEGREES);
    const double off = (h - 275) / 25, l50 = (l - 50) * (l - 50);
    const double rotation = -2 * power7_share(c) * sin(60 * exp(-off * off) * DEGREES);
    const double sl = 1 + 0.015 * l50 / sqrt(20 + l50), sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
    const double x = dl / sl, y = dc / sc, z = dh / sh;
    return sqrt(fmax(x * x + y * y + z * z + rotation * y * z, 0));
}
