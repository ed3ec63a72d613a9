/* What lies beyond the court: the lawn, and from there to the zenith one picture with fields,
 * trees, hills and clouds. The sun lights it as it lights the lawn: all of it faces up, so that
 * there is no seam at the horizon, and the sky is dark when the light is out. */
#include "garden.h"
#include "glb.h"
#include "paint.h"

#include <math.h>

enum { WIDTH = 512, ROWS = 160, PERIODS = 6, AROUND = 36 };

/* Of the mesh, outwards and up; `row` of the picture. Rows of the ground are by the logarithm of
 * the radius. */
static const struct ring {
    float radius, height, row;
} rings[] = {{20, -.02f, 150},  {54, -.02f, 135.4f}, {147, -.02f, 120.7f},
             {400, -.02f, 106}, {399, 22.3f, 70},    {380, 70, 42},
             {300, 120, 20},    {150, 150, 6},       {0, 160, 1.5f}};
enum { HORIZON = 3, TOP = GN_COUNT(rings) - 1 };

/* ---- the picture: colours as they look in the sun, but for a tenth ---- */

static float mix(float a, float b, float t) { return a + (b - a) * t; }

static void lay(float rgb[3], const float over[3], float alpha) {
    for (int c = 0; c < 3; c++) rgb[c] = mix(rgb[c], over[c], alpha);
}

static float elevation_deg(int ring) {
    return atan2f(rings[ring].height, rings[ring].radius) / GN_RADIANS;
}

static float elevation_at(float row) {
    int i = HORIZON;
    while (i + 1 < TOP && rings[i + 1].row > row) i++;
    const float t = (rings[i].row - row) / (rings[i].row - rings[i + 1].row);
    return mix(elevation_deg(i), elevation_deg(i + 1), fminf(t, 1));
}

static void paint_sky(float u, float elevation, float rgb[3]) {
    static const float zenith[3] = {.33f, .56f, .86f}, haze[3] = {.90f, .945f, .97f};
    static const float cloud[3] = {1, 1, 1};
    const float up = 1 - expf(-elevation / 13);
    const float far = .3f / (tanf(elevation * GN_RADIANS) + .07f);
    const float thick = gn_paint_fractal(u, far, 3, 4, 40);
    for (int c = 0; c < 3; c++) rgb[c] = mix(haze[c], zenith[c], up);
    lay(rgb, cloud,
        .8f * gn_paint_ramp(.46f, .74f, thick) * gn_paint_ramp(1.5f, 5, elevation) *
            (1 - gn_paint_ramp(20, 45, elevation)));
}

/* Ridges, from the farthest to the nearest: their heights are in degrees. */
static void paint_ridges(float u, float elevation, float rgb[3]) {
    static const struct {
        float rgb[3], least, more;
        int cells, octaves;
    } ridges[] = {{{.70f, .79f, .88f}, 1.0f, 2.4f, 3, 2},
                  {{.55f, .67f, .72f}, .7f, 1.5f, 5, 3},
                  {{.40f, .52f, .47f}, .25f, 1.0f, 10, 4},
                  {{.30f, .41f, .28f}, -.1f, .75f, 24, 3}};
    for (int i = 0; i < GN_COUNT(ridges); i++) {
        const float height =
            ridges[i].least + ridges[i].more * gn_paint_fractal(u, .37f, ridges[i].cells,
                                                                ridges[i].octaves,
                                                                60u + (unsigned)i);
        lay(rgb, ridges[i].rgb, gn_paint_ramp(-.06f, .06f, height - elevation));
    }
}

/* The lawn goes over into fields, whose edges have hedges. */
static void paint_fields(float u, float away, float rgb[3]) {
    static const float crops[][3] = {
        {.44f, .53f, .30f}, {.36f, .47f, .25f}, {.60f, .59f, .38f}, {.40f, .49f, .27f}};
    static const float hedge[3] = {.29f, .38f, .25f};
    static const float edges[] = {.46f, .62f, .76f, .87f, 1.1f};
    for (int i = 0; i + 1 < GN_COUNT(edges); i++) {
        const float end = edges[i] + .05f * (gn_paint_noise(u, .1f, 4, 90u + (unsigned)i) - .5f);
        const float x = u * (float)(4 + i) + .8f * away + gn_paint_hash(i, 3, 91);
        const int field = (int)floorf(x) % (4 + i);
        const float side = fminf(x - floorf(x), ceilf(x) - x) / (float)(4 + i);
        lay(rgb, crops[(int)(gn_paint_hash(field, i, 92) * 3.99f)],
            gn_paint_ramp(0, .02f, away - end));
        const float near_edge = fminf(fabsf(away - end - .01f) / 2, away > end ? side : 1);
        lay(rgb, hedge, .8f * gn_paint_ramp(.008f, .003f, near_edge));
    }
}

static void paint_ground(float u, float row, float rgb[3]) {
    static const float near[3] = {.35f, .45f, .235f}, distant[3] = {.52f, .62f, .52f};
    const float away = fmaxf(0, (rings[0].row - row) / (rings[0].row - rings[HORIZON].row));
    const float patch = gn_paint_fractal(u, .7f * away, 14, 4, 80) - .5f;
    lay(rgb, near, 1);
    paint_fields(u, away, rgb);
    lay(rgb, distant, .6f * away * away * away);
    for (int c = 0; c < 3; c++) rgb[c] *= 1 + .5f * away * (1.3f - away) * patch;
}

static void vista_at(float u, float v, const void *what, float out[4]) {
    (void)what;
    const float row = v * ROWS, elevation = elevation_at(row);
    if (row > rings[HORIZON].row) {
        paint_ground(u, row, out);
        return;
    }
    paint_sky(u, elevation, out);
    paint_ridges(u, elevation, out);
}

void gn_garden_paint_vista(struct gn_image *image) {
    gn_paint_fill(image, WIDTH, ROWS, 3, vista_at, NULL);
}

/* ---- the mesh ---- */

static void add_rings(struct gn_garden *g, const char *name, int first, int last,
                      const char *extras) {
    struct gn_shape shape = gn_garden_begin(VISTA);
    for (int i = first; i <= last; i++)
        for (int k = 0; k <= AROUND; k++) {
            const float angle = 360 * GN_RADIANS * (float)k / AROUND;
            const float at[3] = {rings[i].radius * cosf(angle), rings[i].height,
                                 -rings[i].radius * sinf(angle)};
            const float uv[2] = {(float)(PERIODS * k) / AROUND, rings[i].row / ROWS};
            const uint32_t v = gn_shape_vertex(&shape, at, (float[3]){0, 1, 0}, uv);
            if (i == first || k == 0) continue;
            const uint32_t below = v - AROUND - 1;
            gn_shape_triangle(&shape, below - 1, v, below);
            if (i < TOP) gn_shape_triangle(&shape, below - 1, v - 1, v);
        }
    gn_garden_stand(g, name, gn_garden_mesh(g, name, &shape, VISTA), (struct gn_place){0}, extras);
}

void gn_garden_add_landscape(struct gn_garden *g) {
    struct gn_shape lawn = gn_garden_begin(LAWN);
    gn_shape_at(&lawn, 0, rings[0].height, 0);
    gn_shape_ring(&lawn, 7.0f, rings[0].radius, 36);
    gn_garden_stand(g, "Lawn", gn_garden_mesh(g, "lawn", &lawn, LAWN), (struct gn_place){0},
                    "{\"gnomon_cast\":false}");
    add_rings(g, "Meadow", 0, HORIZON, "{\"gnomon_cast\":false}");
    add_rings(g, "Sky", HORIZON, TOP, "{\"gnomon_cast\":false,\"gnomon_receive\":false}");
}
