/* What the sky loses on the floor under a model: the ambient occlusion of its parts, as a texture
 * of the shadow catcher. Of what moves it is the mean over some poses; what does not stay where it
 * is would leave stains, and has none.
 *
 * The model is taken as a field of columns, each solid from its lowest to its highest surface. From
 * a point of the floor, in each of some directions, the columns hide intervals of elevation; of
 * elevations e weighted by the cosine to the floor's normal, those up to e have the share
 * sin(e)^2. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/deform.h"
#include "scene/poses.h"

enum {
    COLUMNS = 128,  /* to each side */
    TEXELS = 64,    /* of the texture */
    AZIMUTHS = 12,  /* of one texel; */
    TURNS = 2,      /* its neighbours have others, in squares of so many to each side */
    SHARES = 64,    /* of sin(e)^2: bits of a word */
    WORK = 1 << 24, /* triangles and columns that they are over; no more are looked at in a pose */
    POSES = 4,      /* of a period, if something moves; */
};
#define HALF UINT64_C(0x5555555555555555) /* of the shares, wherever they are */

struct columns {
    float corner[2], side_m; /* x and z of the least corner; of the square that they fill */
    int64_t work_left;
    int first[2], last[2];                               /* of columns that hold something */
    float low[COLUMNS][COLUMNS], high[COLUMNS][COLUMNS]; /* above the floor; low > high: empty */
};

/* A triangle over the columns, seen from above; lengths in columns, heights in metres. */
struct outline {
    float at[3][2], height[3], bottom, top;
    float area;             /* twice, with a sign */
    float along[2], length; /* unit, of its longest side; that side */
    const float *on;        /* a corner of that side */
};

static void set_outline(const struct columns *c, vec3 corner[3], struct outline *t) {
    const float scale = (float)COLUMNS / c->side_m;
    *t = (struct outline){.bottom = INFINITY, .top = -INFINITY};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) t->at[i][k] = (corner[i][2 * k] - c->corner[k]) * scale;
        t->height[i] = corner[i][1];
        t->bottom = fminf(t->bottom, corner[i][1]);
        t->top = fmaxf(t->top, corner[i][1]);
    }
    t->on = t->at[0];
    for (int i = 0; i < 3; i++) {
        const float *a = t->at[i], *b = t->at[(i + 1) % 3];
        const float length = hypotf(b[0] - a[0], b[1] - a[1]);
        if (length <= t->length) continue;
        t->length = length;
        t->on = a;
        for (int k = 0; k < 2; k++) t->along[k] = (b[k] - a[k]) / length;
    }
    t->area = (t->at[1][0] - t->at[0][0]) * (t->at[2][1] - t->at[0][1]) -
              (t->at[2][0] - t->at[0][0]) * (t->at[1][1] - t->at[0][1]);
}

/* The heights y over a column with the middle p of what is narrower than that, as a wall: those
 * between two places along its longest side. In columns that meet at corners alone it leaves no gap
 * for a ray. False: it is not there. */
static bool find_wall(const struct outline *t, const float p[2], float y[2]) {
    const float x = fabsf(t->along[0]), z = fabsf(t->along[1]), half = (x + z) / 2;
    const float to[2] = {p[0] - t->on[0], p[1] - t->on[1]};
    const float middle = to[0] * t->along[0] + to[1] * t->along[1];
    const float aside = fabsf(to[0] * t->along[1] - to[1] * t->along[0]);
    y[0] = INFINITY;
    y[1] = -INFINITY;
    if (t->length > 0 && aside > fmaxf(x, z) / 2 + fabsf(t->area) / t->length) return false;
    for (int i = 0; i < 3; i++) { /* what of each side is within */
        const int j = (i + 1) % 3, ends[2] = {i, j};
        float from_middle[2], share[2] = {0, 1};
        for (int k = 0; k < 2; k++)
            from_middle[k] = (t->at[ends[k]][0] - t->on[0]) * t->along[0] +
                             (t->at[ends[k]][1] - t->on[1]) * t->along[1] - middle;
        const float length = from_middle[1] - from_middle[0];
        if (length != 0) {
            const float a = (-half - from_middle[0]) / length, b = (half - from_middle[0]) / length;
            share[0] = fmaxf(share[0], fminf(a, b));
            share[1] = fminf(share[1], fmaxf(a, b));
        } else if (fabsf(from_middle[0]) > half)
            continue;
        for (int k = 0; k < 2 && share[0] <= share[1]; k++) {
            const float height = glm_lerp(t->height[i], t->height[j], share[k]);
            y[0] = fminf(y[0], height);
            y[1] = fmaxf(y[1], height);
        }
    }
    return y[0] <= y[1];
}

/* The same of what is wider: one height, as its slope within a column counts for nothing. */
static bool find_roof(const struct outline *t, const float p[2], float y[2]) {
    float height = 0;
    for (int i = 0; i < 3; i++) {
        const float *a = t->at[(i + 1) % 3], *b = t->at[(i + 2) % 3];
        const float share =
            ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / t->area;
        height += share * t->height[i];
        /* farther from the middle than its corners are */
        if (share * fabsf(t->area) < -.7072f * hypotf(b[0] - a[0], b[1] - a[1])) return false;
    }
    y[0] = y[1] = glm_clamp(height, t->bottom, t->top);
    return true;
}

/* Widens the columns that a triangle passes through, with the heights that it has there. */
static void add_triangle(struct columns *c, vec3 corner[3]) {
    struct outline t;
    int first[2], last[2];
    set_outline(c, corner, &t);
    for (int k = 0; k < 2; k++) {
        const float least = fminf(fminf(t.at[0][k], t.at[1][k]), t.at[2][k]);
        const float most = fmaxf(fmaxf(t.at[0][k], t.at[1][k]), t.at[2][k]);
        if (!(most >= 0 && least < COLUMNS)) return;
        first[k] = (int)glm_clamp(floorf(least), 0, COLUMNS - 1);
        last[k] = (int)glm_clamp(floorf(most), 0, COLUMNS - 1);
    }
    const bool is_wide = fabsf(t.area) > t.length;
    c->work_left -= (int64_t)(last[0] - first[0] + 1) * (last[1] - first[1] + 1);
    for (int z = first[1]; z <= last[1]; z++)
        for (int x = first[0]; x <= last[0]; x++) {
            const float p[2] = {(float)x + .5f, (float)z + .5f};
            float y[2];
            if (!(is_wide ? find_roof(&t, p, y) : find_wall(&t, p, y))) continue;
            for (int k = 0; k < 2; k++) {
                const int at_k = k ? z : x;
                if (at_k < c->first[k]) c->first[k] = at_k;
                if (at_k > c->last[k]) c->last[k] = at_k;
            }
            c->low[z][x] = fminf(c->low[z][x], y[0]);
            c->high[z][x] = fmaxf(c->high[z][x], y[1]);
        }
}

static bool is_solid(const struct gn_scene *scene, const struct gn_item *item) {
    return item->casts && !gn_material_is_clear(&scene->materials[item->material]);
}

/* How many poses are looked at. */
static int count_poses(const struct gn_scene *scene, const struct gn_pose *pose) {
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (pose->items[i].moves && is_solid(scene, &scene->items[i]))
            triangles += scene->geometries[scene->items[i].geometry].index_count / 3;
    return gn_poses_count(pose, triangles, POSES);
}

static void fill_columns(struct columns *c, const struct gn_scene *scene,
                         const struct gn_pose *pose, const struct gn_poses_place *places,
                         float floor_m) {
    c->work_left = WORK;
    c->first[0] = c->first[1] = COLUMNS;
    c->last[0] = c->last[1] = -1;
    for (int i = 0; i < COLUMNS * COLUMNS; i++) {
        c->low[i / COLUMNS][i % COLUMNS] = INFINITY;
        c->high[i / COLUMNS][i % COLUMNS] = -INFINITY;
    }
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        const struct gn_geometry *geometry = &scene->geometries[item->geometry];
        if (!pose->items[i].visible || !is_solid(scene, item)) continue;
        if (!gn_poses_stays(&places[i], 0) || !gn_poses_stays(&places[i], 2)) continue;
        const uint32_t *index = scene->buffers.indices + geometry->first_index;
        for (uint32_t t = 0; t + 2 < geometry->index_count; t += 3) {
            if (--c->work_left < 0) return;
            vec3 corner[3];
            for (int k = 0; k < 3; k++) {
                gn_pose_corner(pose, i, index[t + (uint32_t)k], corner[k]);
                corner[k][1] = fmaxf(corner[k][1] - floor_m, 0);
            }
            add_triangle(c, corner);
        }
    }
}

/* Bits of the shares from sine2[0] to sine2[1]. */
static uint64_t bits_between(float from, float to) {
    const int a = (int)(from * SHARES + .5f), b = (int)(to * SHARES + .5f);
    if (b <= a) return 0;
    return (b - a >= SHARES ? ~UINT64_C(0) : (UINT64_C(1) << (b - a)) - 1) << a;
}

static bool is_stood_on(const struct columns *c, int x, int z) {
    return x >= 0 && z >= 0 && x < COLUMNS && z < COLUMNS &&
           c->low[z][x] < .25f * c->side_m / COLUMNS;
}

/* Whether something stands on the floor at the middle of a texel, which nobody sees there: in most
 * of the columns around, or it is a wall. */
static bool is_under(const struct columns *c, int x, int z) {
    const int step = COLUMNS / TEXELS, at[2] = {x * step + step / 2, z * step + step / 2};
    bool under = true;
    int around = 0;
    for (int i = 0; i < 4; i++) under &= is_stood_on(c, at[0] - i % 2, at[1] - i / 2);
    for (int i = 0; i < 16 && under; i++)
        around += is_stood_on(c, at[0] - 2 + i % 4, at[1] - 2 + i / 4);
    return around > 8;
}

/* Which shares of the elevations the columns hide that a ray of the floor passes, one after the
 * other (Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987); from, and
 * lengths, in columns. at_first: those that the column in which it begins may hide. */
static uint64_t hidden_along(const struct columns *c, const float from[2], const float along[2],
                             uint64_t at_first) {
    const float x = from[0], z = from[1], dx = along[0], dz = along[1],
                column_m = c->side_m / COLUMNS;
    const float each[2] = {1 / fmaxf(fabsf(dx), 1e-6f), 1 / fmaxf(fabsf(dz), 1e-6f)};
    const int step[2] = {dx < 0 ? -1 : 1, dz < 0 ? -1 : 1};
    const int end[2] = {dx < 0 ? c->first[0] - 1 : c->last[0] + 1,
                        dz < 0 ? c->first[1] - 1 : c->last[1] + 1}; /* nothing lies behind */
    int at[2] = {(int)x, (int)z};
    float next[2] = {each[0] * (dx < 0 ? x - (float)at[0] : (float)at[0] + 1 - x),
                     each[1] * (dz < 0 ? z - (float)at[1] : (float)at[1] + 1 - z)};
    float r = 0, before[2] = {1, 0}; /* hidden by the column before; [0] > [1]: nothing */
    uint64_t bits = 0;
    while ((end[0] - at[0]) * step[0] > 0 && (end[1] - at[1]) * step[1] > 0) {
        const float low = c->low[at[1]][at[0]], high = c->high[at[1]][at[0]];
        const int k = next[1] < next[0];
        float now[2] = {1, 0};
        if (low <= high && next[k] > r) { /* not one that it only touches */
            const float r_m = .5f * (r + next[k]) * column_m, r2 = r_m * r_m;
            now[0] = low * low / (low * low + r2);
            now[1] = high * high / (high * high + r2);
            /* what lies between two solid columns is solid, too */
            const bool joined = before[0] <= before[1];
            const uint64_t hides = bits_between(joined ? fminf(now[0], before[0]) : now[0],
                                                joined ? fmaxf(now[1], before[1]) : now[1]);
            bits |= r > 0 ? hides : hides & at_first;
        }
        before[0] = now[0];
        before[1] = now[1];
        r = next[k];
        at[k] += step[k];
        next[k] += each[k];
    }
    return bits;
}

/* Share of a uniform sky that the middle of a texel sees; turn: of its azimuths, from 0 to 1. What
 * stands in a column beside it, and not on it, may be a wall on either side. */
static float seen_sky(const struct columns *c, int x, int z, float turn) {
    const uint64_t at_first = is_under(c, x, z) ? ~UINT64_C(0) : HALF;
    const float step = (float)COLUMNS / TEXELS,
                at[2] = {((float)x + .5f) * step, ((float)z + .5f) * step};
    int hidden = 0;
    for (int a = 0; a < AZIMUTHS; a++) {
        const float azimuth = ((float)a + turn) * 2 * GLM_PIf / AZIMUTHS;
        hidden += __builtin_popcountll(
            hidden_along(c, at, (float[2]){cosf(azimuth), sinf(azimuth)}, at_first));
    }
    return 1 - (float)hidden / (SHARES * AZIMUTHS);
}

/* Each of the turns around a texel with the same weight: a tent, of halves at its rim. Contacts
 * stay sharp: what lies under the model counts only there. */
static float mean_of_turns(const struct columns *c, float (*seen)[TEXELS], int x, int z) {
    const int reach = TURNS / 2;
    const bool under = is_under(c, x, z);
    float sum = 0, all = 0;
    for (int v = -reach; v <= reach; v++)
        for (int u = -reach; u <= reach; u++) {
            if (x + u < 0 || z + v < 0 || x + u >= TEXELS || z + v >= TEXELS) continue;
            if (is_under(c, x + u, z + v) != under) continue;
            const float weight = (abs(u) == reach ? .5f : 1) * (abs(v) == reach ? .5f : 1);
            sum += weight * seen[z + v][x + u];
            all += weight;
        }
    return sum / all;
}

/* Appends a texture of grey texels; returns its number, or -1 when memory lacks. */
static int32_t add_texture(struct gn_gltf *g, uint8_t *rgba) {
    struct gn_scene_pictures *pictures = &g->scene->pictures;
    struct gn_image *images =
        gn_gltf_alloc(g, g->memory.scene, pictures->image_count + 1, sizeof *images);
    struct gn_texture *textures =
        gn_gltf_alloc(g, g->memory.scene, pictures->texture_count + 1, sizeof *textures);
    if (!images || !textures) return -1;
    if (pictures->image_count)
        memcpy(images, pictures->images, pictures->image_count * sizeof *images);
    if (pictures->texture_count)
        memcpy(textures, pictures->textures, pictures->texture_count * sizeof *textures);
    images[pictures->image_count] =
        (struct gn_image){.width_px = TEXELS, .height_px = TEXELS, .rgba = rgba};
    textures[pictures->texture_count] = (struct gn_texture){
        .image = pictures->image_count, .wrap_s = GN_WRAP_CLAMP, .wrap_t = GN_WRAP_CLAMP};
    pictures->images = images;
    pictures->textures = textures;
    pictures->image_count++;
    return (int32_t)pictures->texture_count++;
}

/* Adds to each texel the share of the sky that it sees; seen: room for all. */
static void add_sky(const struct columns *c, float (*seen)[TEXELS], float (*sum)[TEXELS]) {
    for (int z = 0; z < TEXELS; z++)
        for (int x = 0; x < TEXELS; x++) {
            const int turn = x % TURNS + TURNS * ((x + z) % TURNS);
            seen[z][x] = seen_sky(c, x, z, (float)turn / (TURNS * TURNS));
        }
    for (int z = 0; z < TEXELS; z++)
        for (int x = 0; x < TEXELS; x++) sum[z][x] += mean_of_turns(c, seen, x, z);
}

/* It fades out towards the rim, whose texels continue for ever. */
static void write_texels(float (*sum)[TEXELS], int poses, uint8_t *rgba) {
    for (int z = 0; z < TEXELS; z++)
        for (int x = 0; x < TEXELS; x++) {
            const float to_rim = fminf(fminf((float)x, (float)z),
                                       fminf((float)(TEXELS - 1 - x), (float)(TEXELS - 1 - z)));
            const float share = glm_smoothstep(0, TEXELS / 5.0f, to_rim);
            const float sky = 1 - share * (1 - sum[z][x] / (float)poses);
            memset(rgba + 4 * (z * TEXELS + x), (int)(sky * 255 + .5f), 3);
            rgba[4 * (z * TEXELS + x) + 3] = 255;
        }
}

int32_t gn_floor_occlusion(struct gn_gltf *g, struct gn_pose *pose, const float middle[3],
                           float side_m) {
    struct gn_arena *step = &g->memory.step;
    const struct gn_scene *scene = g->scene;
    const uint32_t items = scene->item_count;
    gn_arena_reset(step);
    struct columns *c = gn_gltf_alloc(g, step, 1, sizeof *c);
    uint8_t *rgba = gn_gltf_alloc(g, g->memory.scene, TEXELS * TEXELS, 4);
    float(*seen)[TEXELS] = gn_gltf_alloc(g, step, TEXELS, sizeof *seen),
    (*sum)[TEXELS] = gn_gltf_alloc(g, step, TEXELS, sizeof *sum);
    struct gn_poses_place *places = gn_gltf_alloc(g, step, items, sizeof *places);
    if (g->failed) return -1;
    c->side_m = side_m;
    c->corner[0] = middle[0] - side_m / 2;
    c->corner[1] = middle[2] - side_m / 2;
    const int poses = count_poses(scene, pose);
    gn_poses_find_places(pose, poses, places);
    for (int p = 0; p < poses; p++) {
        gn_poses_step(pose, p, poses);
        fill_columns(c, scene, pose, places, middle[1]);
        add_sky(c, seen, sum);
    }
    gn_pose_step(pose, 0);
    write_texels(sum, poses, rgba);
    return add_texture(g, rgba);
}
