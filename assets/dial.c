#include "dial.h"

#include "shape/outline.h"
#include "shape/shapes.h"

#include <math.h>
#include <string.h>

#define RADIANS (float)(M_PI / 180)

static const float BURIED = 0.006f; /* depth of strips inside the plate, metres */

/* ---- strips ---- */

struct strip {
    float from[2], to[2]; /* (x, z) */
    float width, height;
};

static void add_strip(struct gn_shape *shape, const struct strip *s) {
    struct gn_pen pen = shape->pen;
    float dx = s->to[0] - s->from[0], dz = s->to[1] - s->from[1];
    gn_shape_move(shape, (s->from[0] + s->to[0]) / 2, -BURIED, (s->from[1] + s->to[1]) / 2);
    gn_shape_turn(shape, 'y', atan2f(-dz, dx) / RADIANS);
    gn_shape_block(shape, hypotf(dx, dz), s->height + BURIED, s->width);
    shape->pen = pen;
}

static void add_ring(struct gn_shape *shape, float radius, float width) {
    float inner = radius - width / 2, outer = radius + width / 2, top = 0.005f;
    const float profile[][2] = {{outer, -BURIED}, {outer, top}, {inner, top}, {inner, -BURIED}};
    gn_shape_lathe(shape, profile, 4, 48);
}

/* ---- numerals ---- */

/* Strokes of a letter in a cell of height 1: x0, y0, x1, y1, width. */
struct letter {
    char name;
    float advance;
    int count;
    float strokes[2][5];
};

static const struct letter letters[] = {
    {'I', 0.30f, 1, {{0.15f, 0, 0.15f, 1, 0.13f}}},
    {'V', 0.68f, 2, {{0.08f, 1, 0.34f, 0.02f, 0.14f}, {0.60f, 1, 0.37f, 0.02f, 0.07f}}},
    {'X', 0.68f, 2, {{0.08f, 1, 0.60f, 0, 0.14f}, {0.60f, 1, 0.08f, 0, 0.07f}}},
};

static const struct letter *letter_of(char name) {
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (letters[i].name == name) return &letters[i];
    return &letters[0];
}

static float width_of(const char *numeral) {
    float width = 0;
    for (; *numeral; numeral++) width += letter_of(*numeral)->advance;
    return width;
}

/* Centred on the pen, its top towards the pen's -z; `size` is its height in metres. */
static void add_numeral(struct gn_shape *shape, const char *numeral, float size) {
    float x = -width_of(numeral) / 2;
    for (; *numeral; numeral++) {
        const struct letter *letter = letter_of(*numeral);
        for (int i = 0; i < letter->count; i++) {
            const float *s = letter->strokes[i];
            add_strip(shape, &(struct strip){.from = {(x + s[0]) * size, (0.5f - s[1]) * size},
                                             .to = {(x + s[2]) * size, (0.5f - s[3]) * size},
                                             .width = s[4] * size,
                                             .height = i ? 0.007f : 0.0045f});
        }
        x += letter->advance;
    }
}

/* ---- hour lines ---- */

struct ray { /* hour line on the plate: start (the foot of the style) and direction, (x, z) */
    float from[2], along[2];
};

static struct ray hour_ray(const struct gn_dial *dial, float hour) {
    float h = (hour - 12) * 15 * RADIANS;
    float angle = atan2f(sinf(dial->latitude * RADIANS) * sinf(h), cosf(h));
    /* The eastern edge casts the outer shadow in the afternoon; while the sun is in the half of the
     * sky at the pole, before 6 and after 18 h, it is the other one. */
    float side = (hour > 12) == (cosf(h) > -1e-6f) ? 1 : -1;
    return (struct ray){{side * dial->thickness / 2, dial->centre}, {sinf(angle), -cosf(angle)}};
}

/* Distance along the ray to the circle around the plate's centre. */
static float reach(const struct ray *ray, float radius) {
    float b = ray->from[0] * ray->along[0] + ray->from[1] * ray->along[1];
    float c = ray->from[0] * ray->from[0] + ray->from[1] * ray->from[1] - radius * radius;
    return -b + sqrtf(b * b - c);
}

static void point_on(const struct ray *ray, float t, float out[2]) {
    for (int i = 0; i < 2; i++) out[i] = ray->from[i] + t * ray->along[i];
}

static void add_line(struct gn_shape *shape, const struct ray *ray, float from, float to,
                     float width) {
    struct strip strip = {.width = width, .height = 0.004f};
    point_on(ray, from, strip.from);
    point_on(ray, to, strip.to);
    add_strip(shape, &strip);
}

static void add_hour(struct gn_shape *shape, const struct gn_dial *dial, int hour) {
    static const char *const names[] = {"XII", "I",   "II",   "III", "IV", "V",
                                        "VI",  "VII", "VIII", "IX",  "X",  "XI"};
    float at[2], middle = hour == 12 ? 0 : (float)hour;
    struct ray ray = hour_ray(dial, hour == 12 ? 12.0001f : (float)hour);
    add_line(shape, &ray, 0.34f * dial->radius, reach(&ray, 0.755f * dial->radius),
             0.011f * dial->radius);
    point_on(&ray, reach(&ray, 0.865f * dial->radius), at);
    if (middle == 0) {
        struct ray morning = hour_ray(dial, 11.9999f);
        add_line(shape, &morning, 0.34f * dial->radius, reach(&morning, 0.755f * dial->radius),
                 0.011f * dial->radius);
        at[0] = 0;
    }
    struct gn_pen pen = shape->pen;
    gn_shape_move(shape, at[0], 0, at[1]);
    gn_shape_turn(shape, 'y', -atan2f(at[0], -at[1]) / RADIANS);
    add_numeral(shape, names[hour % 12], 0.13f * dial->radius);
    shape->pen = pen;
}

static void add_half_hour(struct gn_shape *shape, const struct gn_dial *dial, float hour) {
    struct ray ray = hour_ray(dial, hour);
    add_line(shape, &ray, reach(&ray, 0.69f * dial->radius), reach(&ray, 0.755f * dial->radius),
             0.008f * dial->radius);
}

void gn_dial_inlay(struct gn_shape *shape, const struct gn_dial *dial) {
    add_ring(shape, 0.77f * dial->radius, 0.012f * dial->radius);
    add_ring(shape, 0.955f * dial->radius, 0.02f * dial->radius);
    for (int hour = 5; hour <= 19; hour++) add_hour(shape, dial, hour);
    for (int hour = 5; hour < 19; hour++) add_half_hour(shape, dial, (float)hour + 0.5f);
}

/* ---- gnomon and sun ---- */

enum { RAYS = 12, SCALLOP = 14 };

static void star(float x, float y, float radius, float (*out)[2]) {
    for (int i = 0; i < 2 * RAYS; i++) {
        float angle = (float)M_PI * (float)i / RAYS, r = i % 2 ? 0.58f * radius : radius;
        out[i][0] = x + r * cosf(angle);
        out[i][1] = y + r * sinf(angle);
    }
}

void gn_dial_gnomon(struct gn_shape *shape, const struct gn_dial *dial) {
    float slope = tanf(dial->latitude * RADIANS), length = dial->length, height = length * slope;
    float points[SCALLOP + 2][2] = {{-0.02f / slope, -0.02f}}, hole[2 * RAYS][2];
    for (int i = 0; i <= SCALLOP; i++) { /* a quadratic curve from the foot's end to the tip */
        float t = (float)i / SCALLOP, a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
        points[1 + i][0] = length * (0.98f * a + 0.70f * b + c);
        points[1 + i][1] = -0.02f * a + height * (0.42f * b + c);
    }
    star(0.56f * length, 0.255f * height, 0.185f * length, hole);
    struct gn_pen pen = shape->pen;
    gn_shape_move(shape, 0, 0, dial->centre);
    gn_shape_turn(shape, 'y', 90);
    gn_shape_extrude(shape,
                     &(struct gn_outline){.points = (const float(*)[2])points,
                                          .count = SCALLOP + 2,
                                          .hole = (const float(*)[2])hole,
                                          .hole_count = 2 * RAYS},
                     dial->thickness);
    shape->pen = pen;
}

void gn_dial_sun(const struct gn_dial *dial, float declination, float hour, float out[3]) {
    float lat = dial->latitude * RADIANS, dec = declination * RADIANS,
          h = (hour - 12) * 15 * RADIANS;
    out[0] = -cosf(dec) * sinf(h);
    out[1] = sinf(lat) * sinf(dec) + cosf(lat) * cosf(dec) * cosf(h);
    out[2] = sinf(lat) * cosf(dec) * cosf(h) - cosf(lat) * sinf(dec);
}
