/* The oracle's shadow edges against a closed form, in scenes of 1 mm to 100 km with casters 3 mm to
 * 30 km up: a caster is a quad, and a point is dark where its line to the lamp passes the quad's
 * plane inside of it. Half of each picture is dark; a pixel that is wrong counts by its distance
 * from the edge. Penumbrae likewise: of a lamp's disk, one edge of a quad hides a segment.
 * --shadow truth is the oracle to the bit (test_rays.c), and drawn here, too. Prints the worst of
 * each scene, and that of hard. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "truth/raycast.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { PX = 64, SAMPLES = 1024, SPARSE = 13 }; /* penumbrae: one pixel in so many */
static const double NOISE = .008;              /* of a share by so many samples: test_raycast.c */
static const double LIMIT_PX = .1;
static const double SIZES_M[] = {1e-3, 1, 100, 1e3, 1e4, 1e5},
                    HEIGHTS_M[] = {3e-3, 3, 300, 3e3, 3e4};
enum { SIZES = 6, HEIGHTS = 5 };

enum view { WHOLE, NEAR, ASIDE, VIEWS };
static const char *const view_names[] = {"whole", "near", "aside"};

struct test_case {
    double size_m, height_m; /* of the floor's side; of the caster over it */
    const char *light, *place;
    enum view view;
    bool tilted;      /* by its root node, which `place` moves */
    double radius;    /* of the light: a tangent, or a share of its distance; 0: its middle */
    bool perspective; /* the camera looks down at 45 degrees */
};

/* ---- the scene: item 0 is the floor, item 1 the caster ---- */

static double width_of(const struct test_case *c) {
    const double widest = c->view == ASIDE ? .3 : .9,
                 near = fmax(2 * c->height_m, 4e-6 * c->size_m);
    return fmin(widest * c->size_m, c->view == WHOLE ? INFINITY : near);
}

static void add_quad(struct gn_maker *maker, const double at[4][3]) {
    float p[12];
    char text[120];
    for (int i = 0; i < 12; i++) p[i] = (float)at[i / 3][i % 3];
    const int accessor = gn_maker_accessor(maker, "VEC3", 5126, 4, p, sizeof p, NULL);
    snprintf(text, sizeof text, "{'primitives':[{'attributes':{'POSITION':%d},'indices':0}]}",
             accessor);
    const int mesh = gn_maker_add(maker, "meshes", text);
    snprintf(text, sizeof text, "{'mesh':%d}", mesh);
    gn_maker_add(maker, "nodes", text);
}

static double lamp_m(const struct test_case *c) { return 2 * fmax(c->height_m, width_of(c)); }

/* Half the caster's side: its other edges hide nothing of the lamp. */
static double caster_m(const struct test_case *c) {
    return 2 * width_of(c) + 4 * c->radius * c->height_m;
}

/* A node whose -Z is along (x, y, z), of any length but not +Z. */
static void add_aimed(struct gn_maker *maker, const double at[3], const double to[3],
                      const char *what) {
    const double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    double q[4] = {to[1] / length, -to[0] / length, 0, 1 - to[2] / length};
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[3] * q[3]);
    char text[400];
    snprintf(text, sizeof text, "{'translation':[%.9g,%.9g,%.9g],'rotation':[%.9g,%.9g,0,%.9g],%s}",
             at[0], at[1], at[2], q[0] / norm, q[1] / norm, q[3] / norm, what);
    gn_maker_add(maker, "nodes", text);
}

static void make_scene(const struct test_case *c, struct gn_maker *maker) {
    static const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    const double half = c->size_m / 2, width = width_of(c), h = c->height_m, far = lamp_m(c);
    const double x = c->view == ASIDE ? .31 * c->size_m : 0,
                 z = c->view == ASIDE ? .23 * c->size_m : 0;
    const bool sun = !strcmp(c->light, "directional"), spot = !strcmp(c->light, "spot");
    const double lamp[3] = {x + .5 * far, far, z + .2 * far};
    const double above[3] = {x + .5 * h, h, z + .2 * h}; /* on the line from the view's middle */
    const double u[2] = {caster_m(c) * cos(.3), caster_m(c) * sin(.3)}; /* along its edge */
    char text[400];
    gn_maker_init(maker);
    gn_maker_accessor(maker, "SCALAR", 5123, 6, indices, sizeof indices, NULL);
    add_quad(maker, (const double[4][3]){
                        {-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}});
    add_quad(maker,
             (const double[4][3]){{above[0] - u[0], h, above[2] - u[1]}, /* faces the floor */
                                  {above[0] + u[0], h, above[2] + u[1]},
                                  {above[0] + u[0] - u[1], h, above[2] + u[1] + u[0]},
                                  {above[0] - u[0] - u[1], h, above[2] - u[1] + u[0]}});
    snprintf(text, sizeof text,
             "{'KHR_lights_punctual':{'lights':[{'type':'%s','intensity':%g%s,'extras':{"
             "'gnomon_radius':%.9g}}]}}",
             c->light, sun ? 3 : 3 * far * far, spot ? ",'spot':{'outerConeAngle':0.7}" : "",
             sun ? c->radius : c->radius * far);
    gn_maker_set(maker, "extensions", text);
    add_aimed(maker, lamp, (const double[3]){-.5, -1, -.2},
              "'extensions':{'KHR_lights_punctual':{'light':0}}");
    const double aside = c->perspective ? 2 * width : 0;
    add_aimed(maker, (const double[3]){x + aside, 2 * width, z},
              (const double[3]){-aside, -2 * width, 0}, "'camera':0");
    if (c->perspective)
        snprintf(text, sizeof text,
                 "[{'type':'perspective','perspective':{'yfov':0.14,'znear':%.9g}}]", .01 * width);
    else
        snprintf(text, sizeof text,
                 "[{'type':'orthographic','orthographic':{'xmag':%.9g,'ymag':%.9g,'znear':0,"
                 "'zfar':%.9g}}]",
                 width / 2, width / 2, 4 * width);
    gn_maker_set(maker, "cameras", text);
    snprintf(text, sizeof text, "{'children':[0,1,2,3],'translation':[%s]%s}", c->place,
             c->tilted ? ",'rotation':[0.2,0.3,-0.1,0.92736185]" : "");
    const int root = gn_maker_add(maker, "nodes", text);
    snprintf(text, sizeof text, "[{'nodes':[%d]}]", root);
    gn_maker_set(maker, "scenes", text);
}

/* ---- the closed form ---- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = a[k] - b[k];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

struct quad {
    double corner[4][3], normal[3]; /* normal: of any length */
};

static void quad_of(const struct gn_pose *pose, uint32_t item, struct quad *q) {
    const struct gn_scene *scene = pose->scene;
    const struct gn_geometry *g = &scene->geometries[scene->items[item].geometry];
    static const int at[4] = {0, 1, 2, 5};
    double a[3], b[3];
    for (int i = 0; i < 4; i++)
        gn_pose_vertex(pose, item, scene->buffers.indices[g->first_index + (uint32_t)at[i]],
                       q->corner[i], NULL);
    subtract(q->corner[1], q->corner[0], a);
    subtract(q->corner[2], q->corner[0], b);
    cross(a, b, q->normal);
}

/* How far inside of the caster's shadow a point is, metres on the floor; negative: outside. */
static double depth_in_shadow(const struct quad *q, const struct gn_ray_lamp *lamp,
                              const double p[3]) {
    double to[3], up[3], at[3], depth = INFINITY;
    for (int k = 0; k < 3; k++)
        to[k] = lamp->type == GN_LIGHT_DIRECTIONAL ? -lamp->direction_ws[k]
                                                   : lamp->position_ws[k] - p[k];
    subtract(q->corner[0], p, up);
    const double share = dot(up, q->normal) / dot(to, q->normal);
    for (int k = 0; k < 3; k++) at[k] = p[k] + share * to[k];
    for (int i = 0; i < 4; i++) {
        double edge[3], inward[3], from[3];
        subtract(q->corner[(i + 1) % 4], q->corner[i], edge);
        cross(q->normal, edge, inward);
        subtract(at, q->corner[i], from);
        depth = fmin(depth, dot(from, inward) / sqrt(dot(inward, inward)));
    }
    return depth / (lamp->type == GN_LIGHT_DIRECTIONAL ? 1 : 1 - share);
}

/* ---- the closed form of penumbrae ---- */

/* Share of a unit disk left of x = cut. */
static double left_of(double cut) {
    cut = fmax(-1, fmin(cut, 1));
    return 1 - (acos(cut) - cut * sqrt(1 - cut * cut)) / M_PI;
}

/* The share of the lamp's disk that its caster's first edge leaves: the plane through a point and
 * that edge cuts the disk along a line. */
static double seen_share(const struct quad *q, const struct gn_ray_lamp *lamp, const double p[3]) {
    double to[3], edge[3], up[3], inside[3], plane[3];
    for (int k = 0; k < 3; k++)
        to[k] = lamp->type == GN_LIGHT_DIRECTIONAL ? -lamp->direction_ws[k]
                                                   : lamp->position_ws[k] - p[k];
    subtract(q->corner[1], q->corner[0], edge);
    subtract(q->corner[0], p, up);
    subtract(q->corner[2], p, inside);
    cross(edge, up, plane);
    const double along = dot(plane, to) / sqrt(dot(to, to)),
                 across = sqrt(fmax(dot(plane, plane) - along * along, 0));
    const double middle = dot(plane, to) / (across * lamp->radius);
    return left_of(dot(plane, inside) > 0 ? -middle : middle);
}

/* How far across the edge the nearest point lies that sees as much, metres; at most so much. */
static double off_by(const struct quad *q, const struct gn_ray_lamp *lamp,
                     const struct gn_ray_surface *at, double share, double most_m) {
    double edge[3], across[3], off_m[2] = {0, most_m};
    subtract(q->corner[1], q->corner[0], edge);
    cross(at->normal_ws, edge, across);
    const double length = sqrt(dot(across, across));
    for (int i = 0; i < 12; i++) { /* halves what is left */
        const double m = i == 0 ? 0 : (off_m[0] + off_m[1]) / 2;
        double p[2][3], seen[2];
        for (int side = 0; side < 2; side++) {
            for (int k = 0; k < 3; k++)
                p[side][k] = at->point_ws[k] + (side ? m : -m) * across[k] / length;
            seen[side] = seen_share(q, lamp, p[side]);
        }
        const bool within =
            share > fmin(seen[0], seen[1]) - NOISE && share < fmax(seen[0], seen[1]) + NOISE;
        if (within && i == 0) return 0;
        off_m[within] = m;
    }
    return off_m[1];
}

/* ---- cases ---- */

/* How far off a pixel's visibility is, metres on the floor; dark: whether less than half is seen.
 */
static double find_off(const struct quad *caster, const struct gn_ray_lamp *lamp,
                       const struct gn_ray_surface *seen, double visibility, double pixel_m) {
    if (lamp->radius > 0) return off_by(caster, lamp, seen, visibility, 4 * pixel_m);
    const double depth_m = depth_in_shadow(caster, lamp, seen->point_ws);
    return (visibility < .5) == (depth_m > 0) ? 0 : fabs(depth_m);
}

/* The distance from where it should be of the worst pixel that is wrong, in pixels; beyond two
 * units in the last place of the floor's own distance from the origin, which floats do not tell
 * apart. shot: of whose visibility; NULL: of the oracle's. */
static double find_worst(const struct gn_scene *scene, const struct gn_picture *shot,
                         double *dark) {
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    struct quad caster;
    double worst = 0, sum = 0;
    int count = 0;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, 0, PX, PX);
    gn_ray_lamp_init(&lamp, &pose, 0);
    quad_of(&pose, 1, &caster);
    for (int i = 0; i<PX * PX; i += lamp.radius> 0 ? SPARSE : 1, count++) {
        struct gn_ray_surface seen;
        if (!gn_raycast_eye(&rays, &eye, i % PX, i / PX, &seen) || seen.item != 0)
            fail_msg("pixel %d, %d does not show the floor", i % PX, i / PX);
        const double pixel_m = gn_ray_eye_pixel_m(&eye, seen.point_ws);
        const double visibility = shot              ? (double)shot->data[i * shot->channels]
                                  : lamp.radius > 0 ? gn_raycast_share(&rays, &lamp, &seen, SAMPLES)
                                                    : gn_raycast_visible(&rays, &lamp, &seen);
        const double off_m = find_off(&caster, &lamp, &seen, visibility, pixel_m) -
                             0x1p-22 * fabs(dot(seen.point_ws, seen.normal_ws));
        sum += 1 - visibility;
        worst = fmax(worst, off_m / pixel_m);
    }
    *dark = sum / count;
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
    return worst;
}

/* technique: of a picture; NULL: the oracle itself. */
static double measure(const struct test_case *c, const char *technique, double *dark) {
    struct gn_maker maker;
    struct gn_err err = {0};
    struct gn_picture shot;
    char path[300];
    snprintf(path, sizeof path, "%s/truth_sizes.glb", gn_shot_build());
    make_scene(c, &maker);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    if (technique && !gn_shot(&shot, NULL, &err, "pfm", path,
                              (const char *const[]){"--shadow", technique, "--aov", "visibility",
                                                    "--samples", c->radius > 0 ? "1024" : "1",
                                                    "--size", "64x64", "--backend", "egl", NULL}))
        fail_msg("%s", err.text);
    const double worst = find_worst(scene, technique ? &shot : NULL, dark);
    if (technique) gn_picture_finish(&shot);
    gn_scene_destroy(scene);
    return worst;
}

/* Is the truth within the limit? Says what is not. A sun's direction has no floats for the shadow
 * of something so far up to fall on a floor that small. */
static bool is_right(const struct test_case *c, double *worst_px) {
    double dark;
    const double worst = measure(c, NULL, &dark);
    const bool falls = width_of(c) > 0x1p-20 * c->height_m,
               right = worst < LIMIT_PX && (!falls || (dark > .3 && dark < .7));
    *worst_px = fmax(*worst_px, worst);
    if (!right)
        printf("%s, scene of %g m at %s%s, caster %g m up, %s: %.3f px off, %.0f %% dark\n",
               c->light, c->size_m, c->place, c->tilted ? ", tilted" : "", c->height_m,
               view_names[c->view], worst, 100 * dark);
    return right;
}

/* What is turned has rounded heights: nothing is to be told of a caster as low as the floats there
 * lie apart, or of a view as small as those of its camera. */
static bool is_resolved(const struct test_case *c) {
    const double width_m = width_of(c), off_m = c->view == ASIDE ? .4 * c->size_m : width_m;
    return !c->tilted || (c->height_m > 0x1p-17 * off_m && width_m > 0x1p-16 * c->height_m);
}

static int try_heights(struct test_case c, double *worst_px) {
    int wrong = 0;
    for (int h = 0; h < HEIGHTS; h++)
        for (int view = 0; view < VIEWS; view++) {
            c.height_m = HEIGHTS_M[h];
            c.view = (enum view)view;
            if (is_resolved(&c)) wrong += !is_right(&c, worst_px);
        }
    return wrong;
}

static const char *const lights[] = {"directional", "spot", "point"};

static void test_edges_are_where_they_should_be_at_all_sizes(void **state) {
    (void)state;
    int wrong = 0;
    for (int light = 0; light < 3; light++)
        for (int size = 0; size < SIZES; size++) {
            double worst_px[2] = {0, 0};
            for (int tilted = 0; tilted < 2; tilted++)
                wrong += try_heights((struct test_case){.size_m = SIZES_M[size],
                                                        .light = lights[light],
                                                        .place = "0,0,0",
                                                        .tilted = tilted},
                                     &worst_px[tilted]);
            printf("%-11s %6g m: %.4f px off, tilted %.4f\n", lights[light], SIZES_M[size],
                   worst_px[0], worst_px[1]);
        }
    assert_int_equal(wrong, 0);
}

static void test_edges_are_right_far_from_the_origin(void **state) {
    (void)state;
    static const char *const places[] = {"80,-20,30", "1e5,-2e4,3e4", "-1.00000013e5,0.3,7e6"};
    int wrong = 0;
    for (int place = 0; place < 3; place++)
        for (int light = 0; light < 3; light++) {
            double worst_px = 0;
            wrong += try_heights(
                (struct test_case){.size_m = 1, .light = lights[light], .place = places[place]},
                &worst_px);
            printf("%-11s 1 m at %s: %.4f px off\n", lights[light], places[place], worst_px);
        }
    assert_int_equal(wrong, 0);
}

static void test_penumbrae_are_right_at_all_sizes(void **state) {
    (void)state;
    int wrong = 0;
    for (int light = 0; light < 3; light++)
        for (int size = 0; size < SIZES; size++) {
            double worst_px = 0;
            wrong += try_heights((struct test_case){.size_m = SIZES_M[size],
                                                    .light = lights[light],
                                                    .place = "0,0,0",
                                                    .radius = .00465,
                                                    .perspective = true},
                                 &worst_px);
            printf("%-11s %6g m: penumbrae %.4f px off\n", lights[light], SIZES_M[size], worst_px);
        }
    assert_int_equal(wrong, 0);
}

/* Pictures of floors of +-3, +-10 and +-50 km: the truth, and techniques whose maps have texels
 * finer than a pixel there, for which nothing but rounding is left to be wrong. A floor's rounding
 * hides what is 3 mm over it. */
static void test_pictures_of_wide_floors(void **state) {
    (void)state;
    static const double sizes_m[] = {1e5, 2e4, 6e3};
    static const char *const techniques[] = {"truth", "hard", "pcf"};
    int wrong = 0;
    for (int size = 0; size < (gn_shot_full() ? 3 : 1); size++)
        for (int t = 0; t < 3; t++) {
            printf("%-5s, %g m:", techniques[t], sizes_m[size]);
            for (int h = t > 0; h < HEIGHTS; h++) {
                const struct test_case c = {.size_m = sizes_m[size],
                                            .height_m = HEIGHTS_M[h],
                                            .light = "directional",
                                            .place = "0,0,0",
                                            .view = NEAR,
                                            .perspective = true};
                double dark[2];
                const double worst = measure(&c, techniques[t], &dark[0]);
                measure(&c, NULL, &dark[1]);
                printf("%s %g m up %.2f px, dark %.4f, right %.4f", h > (t > 0) ? ";" : "",
                       HEIGHTS_M[h], worst, dark[0], dark[1]);
                wrong += worst >= (t > 0 ? 2.5 * LIMIT_PX : LIMIT_PX) ||
                         fabs(dark[0] - dark[1]) > (t > 0 ? .005 : 0);
            }
            printf("\n");
        }
    assert_int_equal(wrong, 0);
}

/* All techniques of maps, of lamps without a width over a small floor: the quad's shadow is there.
 */
static void test_lamps_without_a_width(void **state) {
    (void)state;
    static const char *const techniques[] = {"hard", "pcf", "disk", "pcss", "cone", "smsm", "vssm"};
    struct test_case c = {
        .size_m = 1, .height_m = .1, .place = "0,0,0", .view = NEAR, .perspective = true};
    int wrong = 0;
    for (int light = 0; light < 3; light++) {
        double dark, right;
        c.light = lights[light];
        measure(&c, NULL, &right);
        for (size_t t = 0; t < sizeof techniques / sizeof *techniques; t++) {
            measure(&c, techniques[t], &dark);
            printf("%s, %s: dark %.4f, right %.4f\n", lights[light], techniques[t], dark, right);
            wrong += fabs(dark - right) > .05;
        }
    }
    assert_int_equal(wrong, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edges_are_where_they_should_be_at_all_sizes),
        cmocka_unit_test(test_edges_are_right_far_from_the_origin),
        cmocka_unit_test(test_penumbrae_are_right_at_all_sizes),
        cmocka_unit_test(test_pictures_of_wide_floors),
        cmocka_unit_test(test_lamps_without_a_width),
    };
    return cmocka_run_group_tests_name("truth_sizes", tests, NULL, NULL);
}
