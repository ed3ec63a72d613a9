/* The scene of a dial: plate, lines, gnomon, what it stands on, cameras, a sun. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "config.h"
#include "dial/private.h"
#include "shape/glb.h"
#include "shape/outline.h"
#include "shape/shapes.h"

enum material { BRONZE, INLAY, BRASS, STONE, MATERIALS };

struct scene {
    const struct gn_dial *dial;
    struct gn_glb *glb;
    int materials[MATERIALS];
};

static void set_pen(struct gn_shape *shape, const double x[3], const double y[3], const double z[3],
                    const double at[3]) {
    for (int i = 0; i < 3; i++) {
        shape->pen.x[i] = (float)x[i];
        shape->pen.y[i] = (float)y[i];
        shape->pen.z[i] = (float)z[i];
        shape->pen.at[i] = (float)at[i];
    }
}

/* The pen's xy plane lies `height` before the face, its origin at the ring's centre. */
static void set_pen_on(struct gn_shape *shape, const struct gn_dial *d, int face, double height) {
    const struct gn_dial_face *f = &d->faces[face];
    double at[3];
    gn_dial_place(d, face, (double[2]){0, 0}, height, at);
    set_pen(shape, f->right, f->up, f->normal, at);
}

static void put_node(struct scene *s, const char *name, struct gn_shape *shape,
                     enum material material, const char *extras) {
    const struct gn_glb_node node = {
        .name = name,
        .mesh = gn_glb_mesh(s->glb, name, gn_glb_geometry(s->glb, shape), s->materials[material]),
        .extras = extras};
    gn_glb_node(s->glb, &node);
    gn_shape_finish(shape);
}

/* ---- strokes ---- */

/* Unit direction from one point to the next. */
static void direction(const double a[2], const double b[2], double out[2]) {
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    for (int i = 0; i < 2; i++) out[i] = length > 0 ? (b[i] - a[i]) / length : 0;
}

/* From point i of a stroke to its left edge: half its width, and more at corners. */
static void half_across(const double (*p)[2], int count, int i, double width, double out[2]) {
    const bool closed = p[0][0] == p[count - 1][0] && p[0][1] == p[count - 1][1];
    const int before = i > 0    ? i - 1
                       : closed ? count - 2
                                : -1,
              after = i + 1 < count ? i + 1
                      : closed      ? 1
                                    : -1;
    double last[2] = {0}, next[2] = {0};
    if (before >= 0) direction(p[before], p[i], last);
    if (after >= 0) direction(p[i], p[after], next);
    if (before < 0) memcpy(last, next, sizeof last);
    if (after < 0) memcpy(next, last, sizeof next);
    const double along = fmax(1 + last[0] * next[0] + last[1] * next[1], 0.12);
    out[0] = -(last[1] + next[1]) / along * width / 2;
    out[1] = (last[0] + next[0]) / along * width / 2;
}

/* One side wall of the stroke, down into the plate; `side` 1 is its left. */
static void add_wall(struct gn_shape *shape, const double (*p)[2], int count, double width,
                     double side, double deep) {
    const uint32_t first = (uint32_t)shape->vertex_count;
    for (int i = 0; i < count; i++) {
        double half[2];
        half_across(p, count, i, width, half);
        const double length = hypot(half[0], half[1]);
        const float normal[3] = {(float)(side * half[0] / length),
                                 (float)(side * half[1] / length)};
        for (int low = 0; low < 2; low++)
            gn_shape_vertex(shape,
                            (float[3]){(float)(p[i][0] + side * half[0]),
                                       (float)(p[i][1] + side * half[1]), low ? (float)-deep : 0},
                            normal, (float[2]){0, 0});
    }
    for (uint32_t k = first; k + 3 < first + 2 * (uint32_t)count; k += 2) {
        const uint32_t a = side > 0 ? k + 2 : k, b = side > 0 ? k : k + 2;
        gn_shape_triangle(shape, a, a + 1, b);
        gn_shape_triangle(shape, b, a + 1, b + 1);
    }
}

/* The stroke as a raised strip, its top in the pen's xy plane. */
static void add_stroke(struct gn_shape *shape, const double (*p)[2], int count, double width,
                       double deep) {
    const uint32_t first = (uint32_t)shape->vertex_count;
    for (int i = 0; i < count; i++) {
        double half[2];
        half_across(p, count, i, width, half);
        for (int side = 1; side >= -1; side -= 2)
            gn_shape_vertex(
                shape,
                (float[3]){(float)(p[i][0] + side * half[0]), (float)(p[i][1] + side * half[1]), 0},
                (float[3]){0, 0, 1}, (float[2]){0, 0});
    }
    for (uint32_t k = first; k + 3 < first + 2 * (uint32_t)count; k += 2) {
        gn_shape_triangle(shape, k, k + 1, k + 2);
        gn_shape_triangle(shape, k + 2, k + 1, k + 3);
    }
    add_wall(shape, p, count, width, 1, deep);
    add_wall(shape, p, count, width, -1, deep);
}

static void add_lines(struct scene *s) {
    const struct gn_dial *d = s->dial;
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    for (size_t i = 0; i < d->stroke_count; i++) {
        const struct gn_dial_stroke *stroke = &d->strokes[i];
        const double relief = GN_DIAL_RELIEF * d->opts.size_m;
        set_pen_on(&shape, d, stroke->face, relief);
        add_stroke(&shape, (const double(*)[2])(d->points + stroke->first), stroke->count,
                   stroke->width_m, 2 * relief);
    }
    put_node(s, "Lines", &shape, INLAY, "{\"gnomon_cast\":false}");
}

/* ---- plate ---- */

enum { CORNER = 6, CORNERS = 4 * (CORNER + 1) };

/* A rectangle with round corners, counter-clockwise. */
static void round_rectangle(const double low[2], const double high[2], double radius,
                            float (*out)[2]) {
    for (int i = 0; i < CORNERS; i++) {
        const int corner = i / (CORNER + 1), step = i % (CORNER + 1);
        const double angle = M_PI / 2 * (corner + (double)step / CORNER);
        const double x = corner == 1 || corner == 2 ? low[0] + radius : high[0] - radius,
                     y = corner >= 2 ? low[1] + radius : high[1] - radius;
        out[i][0] = (float)(x + radius * cos(angle));
        out[i][1] = (float)(y + radius * sin(angle));
    }
}

/* A slab with round edges whose front is `front` before the first face. */
static void add_slab(struct gn_shape *shape, const struct gn_dial *d, double border, double front,
                     double depth) {
    float points[CORNERS][2];
    const double low[2] = {d->low[0] - border, d->low[1] - border},
                 high[2] = {d->high[0] + border, d->high[1] + border};
    round_rectangle(low, high, 0.05 * d->opts.size_m, points);
    set_pen_on(shape, d, 0, front - depth / 2);
    gn_shape_bevel(shape,
                   &(struct gn_outline){.points = (const float(*)[2])points, .count = CORNERS},
                   (float)depth, (float)fmin(0.006 * d->opts.size_m, depth / 3), 2);
}

/* A screw with a round head in each corner. */
static void add_screws(struct gn_shape *shape, const struct gn_dial *d) {
    static const float head[][2] = {
        {.0125f, -.002f}, {.0125f, .002f}, {.010f, .0048f}, {.0055f, .0062f}, {0, .0066f}};
    float profile[5][2];
    const double inset = 0.042 * d->opts.size_m;
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 2; k++) profile[i][k] = head[i][k] * (float)d->opts.size_m;
    for (int i = 0; i < 4; i++) {
        set_pen_on(shape, d, 0, 0);
        gn_shape_move(shape, (float)(i % 2 ? d->high[0] - inset : d->low[0] + inset),
                      (float)(i / 2 ? d->high[1] - inset : d->low[1] + inset), 0);
        gn_shape_turn(shape, 'x', 90);
        gn_shape_lathe(shape, (const float(*)[2])profile, 5, 12);
    }
}

static void add_plate(struct scene *s) {
    struct gn_shape plate, screws;
    gn_shape_init(&plate, 0);
    gn_shape_init(&screws, 0);
    add_slab(&plate, s->dial, 0, 0, s->dial->plate_m);
    put_node(s, "Plate", &plate, BRONZE, NULL);
    if (s->dial->opts.kind != GN_DIAL_EQUATORIAL) {
        add_screws(&screws, s->dial);
        put_node(s, "Screws", &screws, BRASS, "{\"gnomon_cast\":false}");
    }
}

/* ---- gnomon ---- */

enum { SHEET = 24, HOLE = 24 };

/* The sheet stands on the plate, sunk a little; a round hole makes it lighter. */
static void add_sheet(struct gn_shape *shape, const struct gn_dial *d) {
    const struct gn_dial_face *f = &d->faces[0];
    double side[SHEET][2], along[3], across[3], foot[3];
    float points[SHEET][2], hole[HOLE][2];
    const int count = gn_dial_sheet(d, side);
    const double sunk = 0.002 * d->opts.size_m, rise = f->rise_deg * GN_DIAL_RADIANS;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) points[i][k] = (float)side[i][k];
    points[0][0] = (float)(-sunk / tan(rise));
    points[0][1] = points[1][1] = (float)-sunk;
    const double tip[2] = {side[count - 1][0], side[count - 1][1]};
    const double radius = 0.15 * fmin(tip[0], tip[1]);
    for (int i = 0; i < HOLE; i++) {
        const double angle = 2 * M_PI * i / HOLE;
        hole[i][0] = (float)(0.58 * tip[0] + radius * cos(angle));
        hole[i][1] = (float)(0.27 * tip[1] + radius * sin(angle));
    }
    const bool has_hole = radius > 0.02 * d->opts.size_m;
    for (int i = 0; i < 3; i++) along[i] = f->along[0] * f->right[i] + f->along[1] * f->up[i];
    gn_dial_cross(along, f->normal, across);
    gn_dial_place(d, 0, f->foot, 0, foot);
    set_pen(shape, along, f->normal, across, foot);
    gn_shape_extrude(shape,
                     &(struct gn_outline){.points = (const float(*)[2])points,
                                          .count = count,
                                          .hole = has_hole ? (const float(*)[2])hole : NULL,
                                          .hole_count = has_hole ? HOLE : 0},
                     (float)d->thickness_m);
}

static void add_rod(struct gn_shape *shape, const struct gn_dial *d, int face, const double at[2],
                    double length) {
    double from[3], to[3];
    gn_dial_place(d, face, at, -0.5 * d->plate_m, from);
    gn_dial_place(d, face, at, length, to);
    gn_shape_home(shape);
    gn_shape_rod(shape, (float[3]){(float)from[0], (float)from[1], (float)from[2]},
                 (float[3]){(float)to[0], (float)to[1], (float)to[2]}, (float)d->thickness_m / 2,
                 20);
}

/* Length of the rod below the lower face: to the ground, if it is not far. */
static double lower_rod(const struct gn_dial *d) {
    const double ground =
        (d->faces[1].centre[1] - 0.08 * d->opts.size_m) / fmax(-d->faces[1].normal[1], 1e-6);
    return fmin(ground, 2 * d->style_m);
}

static void add_gnomon(struct scene *s) {
    const struct gn_dial *d = s->dial;
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    if (d->opts.kind == GN_DIAL_ANALEMMATIC)
        add_rod(&shape, d, 0, (double[2]){0, gn_dial_pin(d, d->opts.sun_deg)}, d->style_m);
    else if (d->opts.kind == GN_DIAL_EQUATORIAL) {
        add_rod(&shape, d, 0, (double[2]){0, 0}, d->style_m);
        add_rod(&shape, d, 1, (double[2]){0, 0}, lower_rod(d));
    } else
        add_sheet(&shape, d);
    put_node(s, "Gnomon", &shape, BRASS, NULL);
}

/* ---- stand ---- */

/* Under a level plate a slab of stone, behind a vertical one a wall, and for an equatorial one a
 * base that its lower rim and its rod stand on. */
static void add_stand(struct scene *s) {
    const struct gn_dial *d = s->dial;
    const double w = d->opts.size_m;
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    if (d->opts.kind == GN_DIAL_EQUATORIAL) {
        const struct gn_dial_face *lower = &d->faces[1];
        double rim[3], foot[3];
        gn_dial_place(d, 1, (double[2]){0, d->low[1]}, 0, rim);
        gn_dial_place(d, 1, (double[2]){0, 0}, lower_rod(d), foot);
        const double front = fmax(rim[2], fmax(foot[2], lower->centre[2])) + 0.12 * w,
                     back = fmin(rim[2], fmin(foot[2], lower->centre[2])) - 0.12 * w;
        gn_shape_at(&shape, 0, (float)(0.045 * w), (float)((front + back) / 2));
        gn_shape_box(&shape, (float)(1.1 * w), (float)(0.09 * w), (float)(front - back));
        const double top = rim[1] + 0.008 * w; /* a block that holds the rim */
        gn_shape_at(&shape, 0, (float)(top / 2), (float)rim[2]);
        gn_shape_box(&shape, (float)(0.5 * w), (float)top, (float)(0.09 * w));
    } else {
        const double border = d->opts.kind == GN_DIAL_VERTICAL ? 0.15 * w : 0.06 * w;
        add_slab(&shape, d, border, -0.9 * d->plate_m, 0.09 * w);
    }
    put_node(s, "Stand", &shape, STONE, NULL);
}

/* ---- cameras, sun, materials ---- */

static void put_camera(struct scene *s, const struct gn_glb_camera *lens, const double x[3],
                       const double y[3], const double z[3], const double at[3]) {
    float matrix[16] = {0};
    for (int i = 0; i < 3; i++) {
        matrix[i] = (float)x[i];
        matrix[4 + i] = (float)y[i];
        matrix[8 + i] = (float)z[i];
        matrix[12 + i] = (float)at[i];
    }
    matrix[15] = 1;
    const struct gn_glb_node node = {
        .name = lens->name, .camera = gn_glb_camera(s->glb, lens), .matrix = matrix};
    gn_glb_node(s->glb, &node);
}

/* Where a camera sees the face from: before it, from above and from the right; a lower face from
 * near the ground. */
static void find_eye(const struct gn_dial *d, int face, const double target[3], double at[3]) {
    const struct gn_dial_face *f = &d->faces[face];
    const double w = d->opts.size_m, back = (d->face_count > 1 ? 2.4 : 2.0) * w;
    const double level = 1 - fabs(f->normal[1]); /* 1: the face is vertical */
    const bool is_lower = face > 0;
    const double share[3] = {0.42, is_lower ? 0 : 0.75 * level - 0.75,
                             is_lower ? 1 / hypot(f->normal[0], f->normal[2])
                                      : 0.72 + 0.25 * level};
    for (int i = 0; i < 3; i++)
        at[i] = target[i] +
                back * (share[0] * f->right[i] + share[1] * f->up[i] + share[2] * f->normal[i]);
    if (level > 0.3) at[1] += 0.35 * w * level;
    if (is_lower) at[1] = 0.2 * w;
}

static void add_view(struct scene *s, const char *name, int face) {
    const struct gn_dial *d = s->dial;
    const double w = d->opts.size_m, middle = (d->low[1] + d->high[1]) / 2;
    const double level = 1 - fabs(d->faces[face].normal[1]);
    double at[3], target[3];
    gn_dial_place(d, face, (double[2]){0, middle + (level - 0.5) * 0.1 * w}, 0.04 * w, target);
    find_eye(d, face, target, at);
    float eye[3], to[3];
    for (int i = 0; i < 3; i++) eye[i] = (float)at[i], to[i] = (float)target[i];
    struct gn_glb_camera lens = {.name = name,
                                 .aspect = 1.25f,
                                 .yfov = (float)(36 * GN_DIAL_RADIANS),
                                 .znear = (float)(0.1 * w),
                                 .zfar = (float)(20 * w)};
    struct gn_glb_node node = {
        .name = name, .camera = gn_glb_camera(s->glb, &lens), .move = {eye[0], eye[1], eye[2]}};
    gn_glb_look(eye, to, node.turn);
    gn_glb_node(s->glb, &node);
}

static void add_cameras(struct scene *s) {
    const struct gn_dial *d = s->dial;
    const double w = d->opts.size_m, half = fmax(w, d->high[1] - d->low[1]) / 2 + 0.09 * w;
    add_view(s, "Dial", 0);
    if (d->face_count > 1 && fabs(d->faces[1].normal[1]) < 0.98) add_view(s, "Back", 1);
    double at[3];
    const struct gn_dial_face *f = &d->faces[0];
    gn_dial_place(d, 0, (double[2]){0, (d->low[1] + d->high[1]) / 2}, 2 * w, at);
    const struct gn_glb_camera lens = {.name = "Face",
                                       .xmag = (float)half,
                                       .ymag = (float)half,
                                       .znear = (float)(0.1 * w),
                                       .zfar = (float)(4 * w)};
    put_camera(s, &lens, f->right, f->up, f->normal, at);
}

static void add_sun(struct scene *s) {
    const struct gn_dial_opts *opts = &s->dial->opts;
    double to_sun[3];
    gn_dial_to_sun(opts->latitude_deg, opts->sun_deg, opts->sun_hour_deg, to_sun);
    const struct gn_glb_light light = {.name = "Sun",
                                       .kind = GN_GLB_DIRECTIONAL,
                                       .rgb = {1, .95f, .86f},
                                       .intensity = 3,
                                       .extras = "{\"gnomon_sun\":true}"};
    struct gn_glb_node node = {.name = "Sun", .light = gn_glb_light(s->glb, &light)};
    for (int i = 0; i < 3; i++) node.move[i] = (float)(20 * s->dial->opts.size_m * to_sun[i]);
    gn_glb_look(node.move, (float[3]){0, 0, 0}, node.turn);
    gn_glb_node(s->glb, &node);
}

static const struct gn_glb_material materials[MATERIALS] = {
    [BRONZE] = {.name = "bronze", .rgba = {.47f, .30f, .13f, 1}, .metal = .4f, .rough = .6f},
    [INLAY] = {.name = "inlay", .rgba = {.055f, .033f, .018f, 1}, .metal = .2f, .rough = .55f},
    [BRASS] = {.name = "brass", .rgba = {.80f, .60f, .26f, 1}, .metal = .6f, .rough = .35f},
    [STONE] = {.name = "stone", .rgba = {.62f, .58f, .51f, 1}, .metal = 0, .rough = 1},
};

void gn_dial_model(const struct gn_dial *dial, struct gn_bytes *out) {
    struct scene s = {.dial = dial, .glb = gn_glb_create("gnomon dial " GN_VERSION, NULL)};
    gn_glb_scene_extras(s.glb,
                        "{\"gnomon_sky\":[0.19,0.22,0.27],\"gnomon_ground\":[0.11,0.1,0.085],"
                        "\"gnomon_background\":[0.62,0.70,0.80]}");
    for (int i = 0; i < MATERIALS; i++) s.materials[i] = gn_glb_material(s.glb, &materials[i]);
    add_cameras(&s);
    add_sun(&s);
    add_plate(&s);
    add_lines(&s);
    add_gnomon(&s);
    add_stand(&s);
    gn_glb_build(s.glb, out);
    gn_glb_destroy(s.glb);
}
