/* Scenes of `gnomon doctor --self-test` with their ground truth: `make_selftest NAME PATH` writes
 * PATH.glb and PATH.truth (format: src/cli/selftest.h). The truth is computed by brute-force ray
 * casting in double precision; the scenes are small enough for that.
 *
 * Rules: opaque and masked surfaces cast from both sides, masked ones with their holes; a surface
 * whose visible side faces away from the light is dark; pixels outside of a spot's cone and of the
 * background are lit. */
#include "glb.h"
#include "paint.h"
#include "shape/outline.h"
#include "shape/shapes.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RADIANS (M_PI / 180)

enum { WIDTH = 128, HEIGHT = 96, PARTS_MAX = 5, LATTICE_PX = 60, BAND_PX = 2, ALL_ROUND = 180 };

struct part {
    const char *name;
    struct gn_shape shape; /* in scene coordinates: nodes are at the origin */
    bool double_sided, lattice;
};

struct scene {
    const char *name;
    void (*make)(struct scene *scene);
    float light[3]; /* position of the light; directional: it shines from here to `aim` */
    float aim[3];   /* target of the light */
    float cone;     /* half angle of a spot, degrees; 0: directional; ALL_ROUND: point light */
    struct part parts[PARTS_MAX];
    int part_count;
};

static const float eye_place[3] = {4.5f, 4.2f, 6}, eye_aim[3] = {0, .5f, 0};
static const float eye_yfov = (float)(29 * RADIANS);

/* ---- the scenes ---- */

static struct gn_shape *add_part(struct scene *scene, const char *name) {
    struct part *part = &scene->parts[scene->part_count++];
    part->name = name;
    gn_shape_init(&part->shape, 1);
    return &part->shape;
}

static void add_ground(struct scene *scene) { gn_shape_plane(add_part(scene, "ground"), 8, 8); }

static void make_box(struct scene *scene) {
    add_ground(scene);
    struct gn_shape *box = add_part(scene, "box");
    gn_shape_turn(box, 'y', 25);
    gn_shape_block(box, 1.4f, 1.6f, 1.2f);
}

static void make_ball(struct scene *scene) {
    add_ground(scene);
    struct gn_shape *ball = add_part(scene, "ball");
    gn_shape_at(ball, 0, .95f, 0);
    gn_shape_sphere(ball, .8f, 32, 20);
}

static void make_fence(struct scene *scene) {
    add_ground(scene);
    struct gn_shape *wall = add_part(scene, "wall");
    gn_shape_at(wall, -.4f, 0, -1.4f);
    gn_shape_turn(wall, 'y', 15);
    gn_shape_block(wall, 2.4f, 1.1f, .03f);
    struct gn_shape *fence = add_part(scene, "fence");
    gn_shape_at(fence, -1.2f, 0, .6f);
    gn_shape_fence(fence, &(struct gn_fence){.length = 2.6f,
                                             .height = 1.2f,
                                             .pitch = .6f,
                                             .pale = .35f,
                                             .depth = .04f,
                                             .pointed = true});
}

static void make_lattice(struct scene *scene) {
    add_ground(scene);
    struct gn_shape *card = add_part(scene, "lattice");
    scene->parts[1].double_sided = scene->parts[1].lattice = true;
    gn_shape_at(card, 0, .2f, -.6f);
    gn_shape_card(card, 3.2f, 2.6f);
}

static void make_tilt(struct scene *scene) {
    add_ground(scene);
    for (int i = 0; i < 2; i++) {
        struct gn_shape *plane = add_part(scene, i ? "seen from above" : "seen from below");
        scene->parts[1 + i].double_sided = true;
        gn_shape_at(plane, i ? 1.3f : -1.2f, i ? .8f : 1.3f, i ? 1.0f : -.6f);
        gn_shape_turn(plane, 'x', i ? 20 : -50);
        gn_shape_plane(plane, i ? 1.5f : 2.0f, 1.6f);
    }
}

static void make_stack(struct scene *scene) {
    add_ground(scene);
    struct gn_shape *low = add_part(scene, "low");
    gn_shape_at(low, -.5f, 0, .5f);
    gn_shape_block(low, 1, .8f, 1);
    struct gn_shape *high = add_part(scene, "high");
    gn_shape_at(high, .4f, 2.1f, -.5f);
    gn_shape_turn(high, 'y', 30);
    gn_shape_box(high, 1.5f, .1f, 1.5f);
}

/* A point light between boxes, and a wall behind. */
static void make_lamp(struct scene *scene) {
    static const float at[3][3] = {{-1.3f, -.9f, 20}, {1.2f, -.7f, 50}, {-.3f, 1.3f, 5}};
    add_ground(scene);
    for (int i = 0; i < 3; i++) {
        struct gn_shape *box = add_part(scene, "box");
        gn_shape_at(box, at[i][0], 0, at[i][1]);
        gn_shape_turn(box, 'y', at[i][2]);
        gn_shape_block(box, .5f, .6f, .4f);
    }
    struct gn_shape *wall = add_part(scene, "wall");
    gn_shape_at(wall, 0, 0, -2.2f);
    gn_shape_block(wall, 5, 2, .1f);
}

static struct scene scenes[] = {
    {.name = "box", .make = make_box, .light = {3, 4.2f, -1.5f}},
    {.name = "ball",
     .make = make_ball,
     .light = {-2.5f, 5, 1.5f},
     .aim = {.2f, .4f, 0},
     .cone = 17},
    {.name = "fence", .make = make_fence, .light = {1.6f, 3, -3}},
    {.name = "lattice", .make = make_lattice, .light = {-1.2f, 3.6f, -3.4f}},
    {.name = "tilt", .make = make_tilt, .light = {-1.5f, 4, -2.2f}},
    {.name = "stack", .make = make_stack, .light = {2.2f, 6, -2.4f}, .cone = 38},
    {.name = "lamp", .make = make_lamp, .light = {.1f, 1.6f, .2f}, .cone = ALL_ROUND},
};

/* ---- the lattice: two by two holes ---- */

static bool is_hole(int x, int y) {
    int cell = LATTICE_PX / 2, u = x % cell, v = y % cell;
    return u >= cell / 5 && u < cell - cell / 5 && v >= cell / 5 && v < cell - cell / 5;
}

static void paint_lattice(struct gn_image *image) {
    gn_image_init(image, LATTICE_PX, LATTICE_PX, 4);
    for (int i = 0; i < LATTICE_PX * LATTICE_PX; i++) {
        unsigned char *rgba = image->pixels + 4 * i;
        rgba[0] = rgba[1] = rgba[2] = 200;
        rgba[3] = is_hole(i % LATTICE_PX, i / LATTICE_PX) ? 0 : 255;
    }
}

/* ---- the file ---- */

static int add_material(struct gn_glb *glb, const struct part *part) {
    struct gn_glb_material material = {.name = part->name,
                                       .rgba = {.8f, .8f, .8f},
                                       .rough = 1,
                                       .double_sided = part->double_sided};
    if (part->lattice) {
        struct gn_image image;
        paint_lattice(&image);
        material.texture = gn_glb_texture(glb, part->name, &image, GN_GLB_CLAMP);
        material.alpha = GN_GLB_MASK;
        gn_image_finish(&image);
    }
    return gn_glb_material(glb, &material);
}

static void add_light(struct gn_glb *glb, const struct scene *scene) {
    bool spot = scene->cone > 0, point = scene->cone == ALL_ROUND;
    float outer = (float)(scene->cone * RADIANS);
    struct gn_glb_light light = {.name = "light",
                                 .kind = point  ? GN_GLB_POINT
                                         : spot ? GN_GLB_SPOT
                                                : GN_GLB_DIRECTIONAL,
                                 .intensity = point  ? 9
                                              : spot ? 90
                                                     : 3,
                                 .inner = .9f * outer,
                                 .outer = outer};
    struct gn_glb_node node = {.name = "light", .light = gn_glb_light(glb, &light)};
    memcpy(node.move, scene->light, sizeof node.move);
    gn_glb_look(scene->light, scene->aim, node.turn);
    gn_glb_node(glb, &node);
}

static void add_camera(struct gn_glb *glb) {
    struct gn_glb_camera lens = {.name = "camera", .yfov = eye_yfov, .znear = .2f, .zfar = 40};
    struct gn_glb_node node = {.name = "camera", .camera = gn_glb_camera(glb, &lens)};
    memcpy(node.move, eye_place, sizeof node.move);
    gn_glb_look(eye_place, eye_aim, node.turn);
    gn_glb_node(glb, &node);
}

static bool write_scene(const struct scene *scene, const char *path) {
    struct gn_glb *glb = gn_glb_create("gnomon assets", "CC0 1.0, the authors of gnomon");
    for (int i = 0; i < scene->part_count; i++) {
        const struct part *part = &scene->parts[i];
        int mesh = gn_glb_mesh(glb, part->name, gn_glb_geometry(glb, &part->shape),
                               add_material(glb, part));
        gn_glb_node(glb, &(struct gn_glb_node){.name = part->name, .mesh = mesh});
    }
    add_light(glb, scene);
    add_camera(glb);
    bool ok = gn_glb_write(glb, path);
    gn_glb_destroy(glb);
    return ok;
}

/* ---- rays ---- */

struct ray {
    double from[3], along[3];
};
struct hit {
    double t, normal[3]; /* towards the ray's origin */
    int part;            /* -1: none */
};

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void minus(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = a[k] - b[k];
}

static void normalise(double a[3]) {
    double length = sqrt(dot(a, a));
    for (int k = 0; k < 3; k++) a[k] /= length;
}

static void widen(const float a[3], double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = a[k];
}

static bool in_hole(const struct gn_vertex *const v[3], double b, double c) {
    double uv[2];
    for (int k = 0; k < 2; k++)
        uv[k] = (1 - b - c) * v[0]->uv[k] + b * v[1]->uv[k] + c * v[2]->uv[k];
    int x = (int)fmin(fmax(uv[0] * LATTICE_PX, 0), LATTICE_PX - 1);
    int y = (int)fmin(fmax(uv[1] * LATTICE_PX, 0), LATTICE_PX - 1);
    return is_hole(x, y);
}

/* Möller, Trumbore, "Fast, minimum storage ray-triangle intersection", 1997. `cull`: ignores the
 * back of single-sided surfaces. */
static bool hits_triangle(const struct part *part, size_t first, const struct ray *ray, bool cull,
                          struct hit *hit) {
    const struct gn_vertex *v[3];
    double p[3][3], e1[3], e2[3], h[3], s[3], q[3], normal[3];
    for (int k = 0; k < 3; k++) {
        v[k] = &part->shape.vertices[part->shape.indices[first + k]];
        widen(v[k]->position, p[k]);
    }
    minus(p[1], p[0], e1);
    minus(p[2], p[0], e2);
    cross(ray->along, e2, h);
    double det = dot(e1, h); /* positive: front face */
    if (det == 0 || (cull && !part->double_sided && det < 0)) return false;
    minus(ray->from, p[0], s);
    double b = dot(s, h) / det;
    cross(s, e1, q);
    double c = dot(ray->along, q) / det, t = dot(e2, q) / det;
    if (b < 0 || c < 0 || b + c > 1 || t <= 0 || t >= hit->t) return false;
    if (part->lattice && in_hole(v, b, c)) return false;
    cross(e1, e2, normal);
    for (int k = 0; k < 3; k++) hit->normal[k] = det > 0 ? normal[k] : -normal[k];
    normalise(hit->normal);
    hit->t = t;
    return true;
}

static struct hit cast_ray(const struct scene *scene, const struct ray *ray, bool cull,
                           double within) {
    struct hit hit = {.t = within, .part = -1};
    for (int i = 0; i < scene->part_count; i++)
        for (size_t k = 0; k < scene->parts[i].shape.index_count; k += 3)
            if (hits_triangle(&scene->parts[i], k, ray, cull, &hit)) hit.part = i;
    return hit;
}

/* ---- truth ---- */

struct pixel {
    struct hit hit;
    double point[3];
    bool lit;
};

static struct ray eye_ray(int x, int y) {
    struct ray ray;
    double aim[3], forward[3], right[3], up[3] = {0, 1, 0}, half = tan(eye_yfov / 2);
    widen(eye_place, ray.from);
    widen(eye_aim, aim);
    minus(aim, ray.from, forward);
    normalise(forward);
    cross(forward, up, right);
    normalise(right);
    cross(right, forward, up);
    double sx = ((x + .5) / WIDTH * 2 - 1) * half * WIDTH / HEIGHT,
           sy = (1 - (y + .5) / HEIGHT * 2) * half;
    for (int k = 0; k < 3; k++) ray.along[k] = forward[k] + sx * right[k] + sy * up[k];
    normalise(ray.along);
    return ray;
}

static bool is_lit(const struct scene *scene, const struct pixel *pixel) {
    double light[3], aim[3], axis[3];
    struct ray ray;
    widen(scene->light, light);
    widen(scene->aim, aim);
    minus(light, aim, axis); /* towards the light */
    minus(light, pixel->point, ray.along);
    double within = 1 - 1e-6, length = sqrt(dot(ray.along, ray.along) * dot(axis, axis));
    if (scene->cone > 0 && dot(ray.along, axis) < length * cos(scene->cone * RADIANS)) return true;
    if (scene->cone == 0) {
        memcpy(ray.along, axis, sizeof ray.along);
        within = INFINITY;
    }
    if (dot(ray.along, pixel->hit.normal) <= 0) return false;
    for (int k = 0; k < 3; k++) ray.from[k] = pixel->point[k] + 1e-4 * pixel->hit.normal[k];
    return cast_ray(scene, &ray, false, within).part < 0;
}

static void trace_pixels(const struct scene *scene, struct pixel *pixels) {
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        struct pixel *pixel = &pixels[i];
        struct ray ray = eye_ray(i % WIDTH, i / WIDTH);
        pixel->hit = cast_ray(scene, &ray, true, INFINITY);
        pixel->lit = true;
        if (pixel->hit.part < 0) continue;
        for (int k = 0; k < 3; k++) pixel->point[k] = ray.from[k] + pixel->hit.t * ray.along[k];
        pixel->lit = is_lit(scene, pixel);
    }
}

/* Neighbours differ in light or part, or are separated by a crease over 45 degrees or a depth step.
 */
static bool is_discontinuity(const struct pixel *a, const struct pixel *b) {
    double between[3];
    if (a->lit != b->lit || a->hit.part != b->hit.part) return true;
    if (a->hit.part < 0) return false;
    minus(b->point, a->point, between);
    double step = fmin(fabs(dot(between, a->hit.normal)), fabs(dot(between, b->hit.normal)));
    return dot(a->hit.normal, b->hit.normal) < sqrt(.5) || step > .02 * a->hit.t;
}

static const struct pixel *pixel_at(const struct pixel *pixels, int x, int y) {
    return x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT ? NULL : &pixels[y * WIDTH + x];
}

static bool is_edge(const struct pixel *pixels, int x, int y) {
    for (int i = 0; i < 9; i++) {
        const struct pixel *other = pixel_at(pixels, x + i % 3 - 1, y + i / 3 - 1);
        if (other && is_discontinuity(pixel_at(pixels, x, y), other)) return true;
    }
    return false;
}

static bool is_near_edge(const struct pixel *pixels, int x, int y) {
    for (int v = -BAND_PX; v <= BAND_PX; v++)
        for (int u = -BAND_PX; u <= BAND_PX; u++)
            if (u * u + v * v <= BAND_PX * BAND_PX && pixel_at(pixels, x + u, y + v) &&
                is_edge(pixels, x + u, y + v))
                return true;
    return false;
}

static void write_runs(const struct pixel *pixels, FILE *file) {
    int state = -1, length = 0;
    for (int i = 0; i <= WIDTH * HEIGHT; i++) {
        int next = i == WIDTH * HEIGHT
                       ? -1
                       : pixels[i].lit | is_near_edge(pixels, i % WIDTH, i / WIDTH) << 1;
        if (length > 0 && (next != state || length == 64)) {
            fputc(state | (length - 1) << 2, file);
            length = 0;
        }
        state = next;
        length++;
    }
}

static bool write_truth(const struct scene *scene, const char *path) {
    struct pixel *pixels = calloc(WIDTH * HEIGHT, sizeof *pixels);
    FILE *file = fopen(path, "wb");
    if (!pixels || !file) {
        perror(path);
        free(pixels);
        return false;
    }
    trace_pixels(scene, pixels);
    fwrite("gntruth1", 1, 8, file);
    fwrite((unsigned char[]){WIDTH % 256, WIDTH / 256, HEIGHT % 256, HEIGHT / 256}, 1, 4, file);
    write_runs(pixels, file);
    free(pixels);
    bool ok = !ferror(file);
    return !fclose(file) && ok;
}

int main(int argc, char **argv) {
    for (size_t i = 0; argc == 3 && i < sizeof scenes / sizeof *scenes; i++) {
        if (strcmp(argv[1], scenes[i].name) != 0) continue;
        char path[4096];
        scenes[i].make(&scenes[i]);
        snprintf(path, sizeof path, "%s.glb", argv[2]);
        bool ok = write_scene(&scenes[i], path);
        snprintf(path, sizeof path, "%s.truth", argv[2]);
        return ok && write_truth(&scenes[i], path) ? 0 : 1;
    }
    fprintf(stderr, "usage: make_selftest SCENE PATH, where SCENE is one of");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        fprintf(stderr, " %s", scenes[i].name);
    fprintf(stderr, "\n");
    return 2;
}
