/* What the sky loses on the floor under a model: the ambient occlusion of its resting parts, as a
 * texture of the shadow catcher.
 *
 * The model is taken as a field of columns, each solid from its lowest to its highest surface. From
 * a point of the floor, in each of some directions, the columns hide intervals of elevation; of
 * elevations e weighted by the cosine to the floor's normal, those up to e have the share
 * sin(e)^2. */
#include "scene/private.h"

#include <math.h>
#include <string.h>

#include "scene/pose.h"

enum {
    COLUMNS = 128, /* to each side */
    TEXELS = 64,   /* of the texture */
    AZIMUTHS = 12,
    STEPS = 31,     /* to farther than the columns reach */
    SHARES = 64,    /* of sin(e)^2: bits of a word */
    WORK = 1 << 24, /* triangles and columns that they are over; no more are looked at */
};
static const float STEP_GROWS = 1.2f; /* along a direction, from half a column on */

struct columns {
    float corner[2], side_m; /* x and z of the least corner; of the square that they fill */
    int64_t work_left;
    float low[COLUMNS][COLUMNS], high[COLUMNS][COLUMNS]; /* above the floor; low > high: empty */
};

/* Widens the columns that a triangle passes through, with the heights that it has there. */
static void add_triangle(struct columns *c, vec3 corner[3]) {
    const float scale = (float)COLUMNS / c->side_m;
    float at[3][2], least[2] = {COLUMNS, COLUMNS}, most[2] = {0, 0};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            at[i][k] = (corner[i][2 * k] - c->corner[k]) * scale;
            least[k] = fminf(least[k], at[i][k]);
            most[k] = fmaxf(most[k], at[i][k]);
        }
    if (!(most[0] >= 0 && most[1] >= 0 && least[0] < COLUMNS && least[1] < COLUMNS)) return;
    const float area = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                       (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]);
    const float bottom = fminf(fminf(corner[0][1], corner[1][1]), corner[2][1]);
    const float top = fmaxf(fmaxf(corner[0][1], corner[1][1]), corner[2][1]);
    int first[2], last[2];
    for (int k = 0; k < 2; k++) {
        first[k] = (int)glm_clamp(floorf(least[k]), 0, COLUMNS - 1);
        last[k] = (int)glm_clamp(floorf(most[k]), 0, COLUMNS - 1);
    }
    c->work_left -= (int64_t)(last[0] - first[0] + 1) * (last[1] - first[1] + 1);
    for (int z = first[1]; z <= last[1]; z++)
        for (int x = first[0]; x <= last[0]; x++) {
            float y[2] = {bottom, top}; /* of a wall, which is seen from its edge */
            if (fabsf(area) > 1e-3f) {
                const float p[2] = {(float)x + .5f, (float)z + .5f};
                float share[3], height = 0, outside = 0;
                for (int i = 0; i < 3; i++) {
                    const float *a = at[(i + 1) % 3], *b = at[(i + 2) % 3];
                    share[i] =
                        ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / area;
                    height += share[i] * corner[i][1];
                    outside = fminf(outside, share[i] * fabsf(area) /
                                                 fmaxf(hypotf(b[0] - a[0], b[1] - a[1]), 1e-6f));
                }
                if (outside < -.7072f) continue; /* farther from the middle than its corners are */
                /* its slope within a column */
                y[0] = y[1] = glm_clamp(height, bottom, top);
            }
            c->low[z][x] = fminf(c->low[z][x], y[0]);
            c->high[z][x] = fmaxf(c->high[z][x], y[1]);
        }
}

static void fill_columns(struct columns *c, const struct gn_scene *scene,
                         const struct gn_pose *pose, float floor_m) {
    c->work_left = WORK;
    for (int i = 0; i < COLUMNS * COLUMNS; i++) {
        c->low[i / COLUMNS][i % COLUMNS] = INFINITY;
        c->high[i / COLUMNS][i % COLUMNS] = -INFINITY;
    }
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        const struct gn_geometry *geometry = &scene->geometries[item->geometry];
        if (!pose->items[i].visible || !item->casts || pose->items[i].moves) continue;
        if (gn_material_is_clear(&scene->materials[item->material])) continue;
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

/* Share of a uniform sky that a point of the floor sees; x, z: in columns. */
static float seen_sky(const struct columns *c, float x, float z) {
    const float column_m = c->side_m / COLUMNS;
    int hidden = 0;
    for (int a = 0; a < AZIMUTHS; a++) {
        const float turn = (float)a * 2 * GLM_PIf / AZIMUTHS, dx = cosf(turn), dz = sinf(turn);
        uint64_t bits = 0;
        float before[2] = {1, 0}; /* hidden by the step before; [0] > [1]: nothing */
        float r = .5f;
        for (int step = 0; step < STEPS; step++, r *= STEP_GROWS) {
            const int ix = (int)floorf(x + dx * r), iz = (int)floorf(z + dz * r);
            if (ix < 0 || iz < 0 || ix >= COLUMNS || iz >= COLUMNS) break;
            const float low = c->low[iz][ix], high = c->high[iz][ix];
            float now[2] = {1, 0};
            if (low <= high) {
                const float r2 = r * r * column_m * column_m;
                now[0] = low * low / (low * low + r2);
                now[1] = high * high / (high * high + r2);
                /* what lies between two solid columns is solid, too */
                const bool joined = before[0] <= before[1];
                bits |= bits_between(joined ? fminf(now[0], before[0]) : now[0],
                                     joined ? fmaxf(now[1], before[1]) : now[1]);
            }
            memcpy(before, now, sizeof now);
        }
        hidden += __builtin_popcountll(bits);
    }
    return 1 - (float)hidden / (SHARES * AZIMUTHS);
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

int32_t gn_floor_occlusion(struct gn_gltf *g, const struct gn_pose *pose, const float middle[3],
                           float side_m) {
    gn_arena_reset(&g->memory.step);
    struct columns *c = gn_gltf_alloc(g, &g->memory.step, 1, sizeof *c);
    uint8_t *rgba = gn_gltf_alloc(g, g->memory.scene, TEXELS * TEXELS, 4);
    if (!c || !rgba) return -1;
    c->side_m = side_m;
    c->corner[0] = middle[0] - side_m / 2;
    c->corner[1] = middle[2] - side_m / 2;
    fill_columns(c, g->scene, pose, middle[1]);
    const float step = (float)COLUMNS / TEXELS;
    for (int z = 0; z < TEXELS; z++)
        for (int x = 0; x < TEXELS; x++) {
            /* it fades out towards the rim, whose texels continue for ever */
            const float to_rim = fminf(fminf((float)x, (float)z),
                                       fminf((float)(TEXELS - 1 - x), (float)(TEXELS - 1 - z)));
            const float share = glm_smoothstep(0, TEXELS / 5.0f, to_rim);
            float seen = seen_sky(c, ((float)x + .5f) * step, ((float)z + .5f) * step);
            seen = 1 - share * (1 - seen);
            memset(rgba + 4 * (z * TEXELS + x), (int)(seen * 255 + .5f), 3);
            rgba[4 * (z * TEXELS + x) + 3] = 255;
        }
    return add_texture(g, rgba);
}
