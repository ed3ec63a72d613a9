#include "image/occlusion.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "scene/private.h"
#include "unit/gltf_maker.h"

const char *const gn_occlusion_names[GN_OCCLUSION_SCENES] = {"pavilion", "table", "room", "plates"};

/* ---- scenes ---- */

struct shape {
    float positions[4096][3], normals[4096][3];
    uint16_t indices[6144];
    size_t vertices, corners;
};

static void add_quad(struct shape *s, const float corner[4][3]) {
    static const uint16_t order[6] = {0, 1, 2, 0, 2, 3};
    vec3 a, b, n;
    glm_vec3_sub((float *)corner[1], (float *)corner[0], a);
    glm_vec3_sub((float *)corner[3], (float *)corner[0], b);
    glm_vec3_crossn(a, b, n);
    for (int i = 0; i < 6; i++) s->indices[s->corners++] = (uint16_t)(s->vertices + order[i]);
    for (int i = 0; i < 4; i++, s->vertices++) {
        memcpy(s->positions[s->vertices], corner[i], sizeof corner[i]);
        memcpy(s->normals[s->vertices], n, sizeof n);
    }
}

/* Its sides but those of `without`: bits 2 k and 2 k + 1 are those at the low and high end of k. */
static void add_box(struct shape *s, const float low[3], const float high[3], unsigned without) {
    for (int k = 0; k < 3; k++)
        for (int end = 0; end < 2; end++) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            float corner[4][3];
            if (without >> (2 * k + end) & 1) continue;
            for (int i = 0; i < 4; i++) {
                const int at = end ? i : 3 - i;
                corner[i][k] = end ? high[k] : low[k];
                corner[i][u] = at == 1 || at == 2 ? high[u] : low[u];
                corner[i][v] = at >= 2 ? high[v] : low[v];
            }
            add_quad(s, (const float(*)[3])corner);
        }
}

static void add_boxes(struct shape *s, enum gn_occlusion_scene which) {
    switch (which) {
    case GN_OCCLUSION_PAVILION:
        add_box(s, (float[3]){-1.2f, 0, -1.2f}, (float[3]){1.2f, .1f, 1.2f}, 0);
        add_box(s, (float[3]){-1.2f, 1.2f, -1.2f}, (float[3]){1.2f, 1.4f, 1.2f}, 0);
        for (int i = 0; i < 9; i++) {
            const float x = (float)(i % 3 - 1), z = (float)(i / 3 - 1);
            if (i != 4)
                add_box(s, (float[3]){x - .09f, .1f, z - .09f},
                        (float[3]){x + .09f, 1.2f, z + .09f}, 0);
        }
        break;
    case GN_OCCLUSION_TABLE:
        add_box(s, (float[3]){-.8f, .7f, -.5f}, (float[3]){.8f, .75f, .5f}, 0);
        add_box(s, (float[3]){-.7f, .2f, -.4f}, (float[3]){.7f, .24f, .4f}, 0);
        for (int i = 0; i < 4; i++) {
            const float x = i & 1 ? .7f : -.7f, z = i & 2 ? .4f : -.4f;
            add_box(s, (float[3]){x - .04f, 0, z - .04f}, (float[3]){x + .04f, .7f, z + .04f}, 0);
        }
        break;
    case GN_OCCLUSION_ROOM:
        add_box(s, (float[3]){-1, 0, -1}, (float[3]){1, 1.4f, 1}, 1u << 5);
        add_quad(s,
                 (const float[4][3]){{-.31f, 0, -1}, {-.31f, 0, 1}, {-.31f, 1, 1}, {-.31f, 1, -1}});
        break;
    default:
        for (int i = 0; i < 14; i++) {
            const float at = (float)i;
            add_box(s, (float[3]){-1 + .06f * at, .07f * at, -1},
                    (float[3]){1, .07f * at + .02f, 1 - .05f * at}, 0);
        }
    }
}

static void make_scene(enum gn_occlusion_scene which, struct gn_maker *made) {
    struct shape *s = gn_xalloc(1, sizeof *s);
    struct gn_maker maker;
    gn_maker_init(&maker);
    add_boxes(s, which);
    gn_maker_accessor(&maker, "VEC3", 5126, s->vertices, s->positions,
                      s->vertices * sizeof s->positions[0], NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, s->vertices, s->normals,
                      s->vertices * sizeof s->normals[0], NULL);
    gn_maker_accessor(&maker, "SCALAR", 5123, s->corners, s->indices,
                      s->corners * sizeof s->indices[0], NULL);
    char material[200];
    snprintf(material, sizeof material,
             "{'doubleSided':%s,'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':1,"
             "'baseColorFactor':[0.5,0.5,0.5,1]}}",
             which == GN_OCCLUSION_ROOM ? "true" : "false");
    gn_maker_add(&maker, "materials", material);
    gn_maker_add(
        &maker, "meshes",
        "{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2,'material':0}]}");
    gn_maker_add(&maker, "nodes", "{'mesh':0}");
    gn_maker_add(&maker, "scenes", "{'nodes':[0]}");
    free(s);
    *made = maker;
}

bool gn_occlusion_write(enum gn_occlusion_scene which, const char *path, struct gn_err *err) {
    struct gn_maker maker;
    make_scene(which, &maker);
    return gn_maker_write(&maker, path, err);
}

struct gn_scene *gn_occlusion_scene(enum gn_occlusion_scene which, struct gn_err *err) {
    struct gn_warnings warnings = {0};
    struct gn_maker maker;
    make_scene(which, &maker);
    return gn_maker_load(&maker, &warnings, err);
}

/* ---- the measure ---- */

enum { VIEWS = 2, TIMES = 10 };

static int compare_floats(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The picture's camera, then from the other side and from above. */
static void turn_eye(struct gn_ray_eye *eye, const struct gn_pose *pose, int view, int side_px) {
    const struct gn_framing_opts opts = {.aspect = 1,
                                         .made_plus_1 = 1,
                                         .given = view ? GN_FRAMING_THETA | GN_FRAMING_PHI : 0,
                                         .theta_rad = 3.6f,
                                         .phi_rad = 1.0f};
    struct gn_framing framing;
    gn_framing_build(pose, 0, &opts, &framing);
    gn_ray_eye_look(eye, &framing, side_px, side_px);
}

static void measure_pixel(const struct gn_occlusion *o, const struct gn_ray_surface *surface,
                          const int8_t (*texels)[4], uint32_t number, uint32_t rays, double sums[3],
                          float *off) {
    struct gn_occlusion_site site;
    double light[2], whole[2] = {0, 0};
    gn_occlusion_site_of(&o->pose, surface, &site);
    for (int k = 0; k < 2; k++) { /* of each half its own: their noise has nothing in common */
        site.turn[0] = (float)fmod(.5 + number * .7548776662 + k * .3819660113, 1);
        site.turn[1] = (float)fmod(.5 + number * (k ? .4503599627 : .5698402910), 1);
        light[k] = gn_occlusion_cast(o, &site, 0, rays / 2, &whole[k]);
    }
    const double read = texels ? (double)gn_occlusion_read(&o->rays.scene->occlusion, texels,
                                                           site.point_ws, site.normal_ws)
                               : 1;
    if (!(whole[0] > 0) || !(whole[1] > 0)) return;
    const double seen[2] = {light[0] / whole[0], light[1] / whole[1]};
    sums[0] += (read - seen[0]) * (read - seen[1]);
    sums[1] += (1 - seen[0]) * (1 - seen[1]);
    sums[2] += read - (seen[0] + seen[1]) / 2;
    *off = (float)fabs(read - (seen[0] + seen[1]) / 2);
}

struct sums {
    double of[3]; /* as measure_pixel() adds them */
    float *off;
    uint32_t pixels;
};

/* From all sides. */
static void measure_moment(const struct gn_scene *scene, const struct gn_moment *at,
                           const struct gn_sky *sky, const int8_t (*texels)[4], int side_px,
                           uint32_t rays, struct sums *sums) {
    struct gn_occlusion o;
    struct gn_ray_eye eye;
    gn_occlusion_init(&o, scene, at, sky, NULL);
    for (int i = 0; i < VIEWS * side_px * side_px; i++) {
        const int view = i / (side_px * side_px), pixel = i % (side_px * side_px);
        struct gn_ray_surface surface;
        if (pixel == 0) turn_eye(&eye, &o.pose, view, side_px);
        if (!gn_raycast_eye(&o.rays, &eye, pixel % side_px, pixel / side_px, &surface) ||
            !gn_item_is_occluded(scene, &scene->items[surface.item]))
            continue;
        measure_pixel(&o, &surface, texels, sums->pixels, rays, sums->of, &sums->off[sums->pixels]);
        sums->pixels++;
    }
    gn_occlusion_finish(&o);
}

struct gn_occlusion_score gn_occlusion_measure(const struct gn_scene *scene, int clips,
                                               const struct gn_sky *sky, const int8_t (*texels)[4],
                                               int side_px, uint32_t rays) {
    struct gn_occlusion_score score = {.pixels = 0};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, clips);
    const int64_t period_ns = gn_scene_period_ns(&pose);
    const int times = period_ns > 0 ? TIMES : 1;
    struct sums sums = {.off =
                            gn_xalloc((size_t)(times * VIEWS * side_px * side_px), sizeof(float))};
    for (int t = 0; t < times; t++) {
        gn_pose_step(&pose, (int64_t)((t + .37) / times * (double)period_ns));
        measure_moment(scene, &pose.at, sky, texels, side_px, rays, &sums);
    }
    gn_pose_finish(&pose);
    if (sums.pixels > 0) {
        const double count = sums.pixels;
        qsort(sums.off, sums.pixels, sizeof *sums.off, compare_floats);
        score.pixels = sums.pixels;
        score.rmse = sqrt(fmax(sums.of[0], 0) / count);
        score.none = sqrt(sums.of[1] / count);
        score.bias = sums.of[2] / count;
        score.p95 = (double)sums.off[(size_t)(.95 * count)];
        score.p999 = (double)sums.off[(size_t)(.999 * count)];
    }
    free(sums.off);
    return score;
}
