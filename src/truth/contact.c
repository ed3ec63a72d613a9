#include "truth/contact.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"

static double apart(const float *a, const float *b) {
    return sqrt((double)(a[0] - b[0]) * (a[0] - b[0]) + (double)(a[1] - b[1]) * (a[1] - b[1]) +
                (double)(a[2] - b[2]) * (a[2] - b[2]));
}

/* Next to each other on the screen and, except for slant, in the world: within six pixels' size. */
static bool is_contact(const struct gn_truth *truth, int x, int y) {
    const struct gn_mask_truth *m = &truth->mask;
    static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    size_t i = (size_t)y * m->width_px + x;
    if (m->item[i] < 0 || m->lit[i] || gn_truth_facing(truth, i) <= 0) return false;
    const float *f = &m->point_ws[3 * i];
    double near = 6 * gn_ray_eye_pixel_m(&truth->frame.eye, (double[3]){f[0], f[1], f[2]});
    for (int n = 0; n < 4; n++) {
        int u = x + step[n][0], v = y + step[n][1];
        if (u < 0 || v < 0 || u >= m->width_px || v >= m->height_px) continue;
        size_t j = (size_t)v * m->width_px + u;
        if (m->item[j] >= 0 && gn_truth_facing(truth, j) < 0 &&
            apart(f, &m->point_ws[3 * j]) < near)
            return true;
    }
    return false;
}

/* Where the shot is dark as it should be, on surfaces that face the light: in the light's plane,
 * with the item. */
struct shade {
    double at[2];
    int32_t item;
};

static size_t find_shades(const struct gn_truth *truth, const float *shot, int channels,
                          struct shade *out) {
    const struct gn_mask_truth *m = &truth->mask;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)m->width_px * m->height_px; i++) {
        if (m->item[i] < 0 || m->lit[i] || gn_truth_facing(truth, i) <= 0) continue;
        if (shot[i * (size_t)channels] >= .5f) continue;
        out[count].item = m->item[i];
        count += gn_truth_plane(&truth->frame, &m->point_ws[3 * i], out[count].at);
    }
    return count;
}

static double contact_gap(const struct gn_truth *truth, const struct shade *shades, size_t count,
                          size_t i) {
    double at[2], best = INFINITY;
    if (!gn_truth_plane(&truth->frame, &truth->mask.point_ws[3 * i], at)) return 0;
    for (size_t j = 0; j < count; j++)
        if (shades[j].item == truth->mask.item[i])
            best = fmin(best, hypot(shades[j].at[0] - at[0], shades[j].at[1] - at[1]));
    return best;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void gn_contact_compare(const struct gn_truth *truth, const float *shot, int channels,
                        unsigned map_px, struct gn_contact *contact) {
    const struct gn_mask_truth *m = &truth->mask;
    size_t count = (size_t)m->width_px * m->height_px;
    double *gaps = gn_xalloc(count, sizeof *gaps), texel = gn_truth_texel(truth, map_px), sum = 0;
    struct shade *shades = gn_xalloc(count, sizeof *shades);
    size_t shade_count = find_shades(truth, shot, channels, shades);
    *contact = (struct gn_contact){0};
    for (size_t i = 0; i < count; i++) {
        if (!is_contact(truth, (int)(i % m->width_px), (int)(i / m->width_px))) continue;
        bool shown = shot[i * (size_t)channels] >= .5f;
        double gap = shown ? contact_gap(truth, shades, shade_count, i) / texel : 0;
        gaps[contact->contacts++] = gap;
        sum += gap;
    }
    if (contact->contacts) {
        qsort(gaps, contact->contacts, sizeof *gaps, by_size);
        contact->mean = sum / contact->contacts;
        contact->p99 = gaps[(int)(.99 * (contact->contacts - 1) + .5)];
        contact->worst = gaps[contact->contacts - 1];
    }
    free(shades);
    free(gaps);
}
