/* The texels of a scene's volume of occlusion: measured by rays at points of its surfaces, and
 * fitted to that by least squares. So nothing is asked of places inside of bodies, both sides of a
 * thin wall have values of their own in the same texels, and no look-up needs an offset. After
 * Kavan, Bargteil, Sloan, "Least Squares Vertex Baking" (2011), in a volume. */
#include <cglm/cglm.h>
#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "scene/poses.h"
#include "truth/occlusion.h"

enum {
    RAYS = 16,   /* of a site, */
    PILOT = 4,   /* and those of them that find out whether it is inside of something */
    GOES_ON = 4, /* then one in so many is measured, for all of them */
    STEPS = 30,  /* of conjugate gradients */
    PIECE = 256, /* sites that a thread takes at once */
    CHECKS = 1024,
    CHECK_RAYS = 64, /* of each half */
    THREADS_MAX = 64
};
/* Weight of a site that sees nothing, since nobody sees it, either; and how fast that grows to 1.
 */
static const float LEAST_WEIGHT = .01f, STEEP = 2;
/* Parts of the mean diagonal: of the second differences between cubes, and of each value. The noise
 * of the rays shows as blotches in large dark places, which the second takes away; what is finely
 * shaped it blurs. It is taken where the error grows by no more than a tenth and that much. */
static const float BENDS[] = {.02f, .12f}, RIDGE = 3e-5f, BLUR = .001f;
/* What is farther off than this on average, where light varies much, had better not be shown;
 * unless it moves, and without occlusion all were farther off by that much. */
static const float COARSE = .09f, MOVES = 2;

struct measured {
    struct gn_occlusion_site site;
    float open[2]; /* by one half of its rays, by the other */
    float weight;  /* 0: not measured */
    bool leaves;   /* it is on what is to have no occlusion */
};

static bool is_cancelled(const struct gn_occlusion_work *work) {
    return work->cancel && atomic_load_explicit(work->cancel, memory_order_relaxed);
}

/* ---- sites, even over all faces ---- */

struct triangle {
    double p[3][3], area;
    vec3 n[3], face;
};

static bool read_triangle(const struct gn_pose *pose, uint32_t item, const uint32_t *index,
                          struct triangle *t) {
    const bool mirrored = pose->items[item].mirrored;
    for (int i = 0; i < 3; i++) {
        double n[3] = {0};
        gn_pose_vertex(pose, item, index[mirrored && i ? 3 - i : i], t->p[i], n);
        for (int k = 0; k < 3; k++) t->n[i][k] = (float)n[k];
        gn_unit(t->n[i]);
    }
    vec3 a, b;
    for (int k = 0; k < 3; k++) {
        a[k] = (float)(t->p[1][k] - t->p[0][k]);
        b[k] = (float)(t->p[2][k] - t->p[0][k]);
    }
    glm_vec3_cross(a, b, t->face);
    t->area = (double)glm_vec3_norm(t->face) / 2;
    gn_unit(t->face);
    for (int i = 0; i < 3; i++)
        if (glm_vec3_norm2(t->n[i]) < .5f) glm_vec3_copy(t->face, t->n[i]);
    return t->area > 0;
}

/* Place and turn together are of an even sequence in four dimensions: Roberts, "The Unreasonable
 * Effectiveness of Quasirandom Sequences" (2018). */
static struct gn_occlusion_site site_on(const struct triangle *t, bool back, uint32_t number) {
    static const double r4[4] = {.8566748838545029, .7338918566271260, .6287067210378087,
                                 .5385972572236101};
    struct gn_occlusion_site site;
    float e[4];
    for (int k = 0; k < 4; k++) e[k] = (float)fmod(.5 + number * r4[k], 1);
    const bool beyond = e[0] + e[1] > 1;
    const float u = beyond ? 1 - e[0] : e[0], v = beyond ? 1 - e[1] : e[1];
    for (int k = 0; k < 3; k++) {
        site.point_ws[k] = (1 - (double)u - (double)v) * t->p[0][k] + (double)u * t->p[1][k] +
                           (double)v * t->p[2][k];
        site.normal_ws[k] = (1 - u - v) * t->n[0][k] + u * t->n[1][k] + v * t->n[2][k];
        site.face_ws[k] = back ? -t->face[k] : t->face[k];
    }
    gn_unit(site.normal_ws);
    if (glm_vec3_dot(site.normal_ws, site.face_ws) < 0) glm_vec3_negate(site.normal_ws);
    site.side_m = sqrtf(2 * (float)t->area);
    memcpy(site.turn, e + 2, sizeof site.turn);
    return site;
}

/* One for each `step` of the area, from `next` on, if that is not 0, up to `most`, with numbers
 * from `first`; double-sided faces have two sides. Returns the area. */
static double lay_sites(const struct gn_occlusion *o, double step, double next, uint32_t first,
                        uint32_t most, struct measured *out, uint32_t *count) {
    const struct gn_pose *pose = &o->pose;
    const struct gn_scene *scene = pose->scene;
    double area = 0;
    uint32_t laid = 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        const struct gn_geometry *geometry = &scene->geometries[item->geometry];
        const uint32_t *index = scene->buffers.indices + geometry->first_index;
        const int sides = scene->materials[item->material].double_sided ? 2 : 1;
        if (!pose->items[i].visible && !o->leaves[i]) continue;
        if (!gn_item_is_occluded(scene, item)) continue;
        for (uint32_t k = 0; k + 2 < geometry->index_count; k += 3) {
            struct triangle t;
            if (!read_triangle(pose, i, index + k, &t)) continue;
            for (int side = 0; side < sides; side++) {
                area += t.area;
                for (; step > 0 && next < area && laid < most; next += step, laid++)
                    out[laid] = (struct measured){.site = site_on(&t, side, first + laid),
                                                  .leaves = o->leaves[i]};
            }
        }
    }
    if (count) *count = laid;
    return area;
}

/* ---- rays ---- */

struct job {
    const struct gn_occlusion *occlusion;
    const struct gn_occlusion_work *work;
    struct measured *sites;
    uint32_t first, count; /* number of the first of them */
    atomic_uint next;
};

/* Each half of the rays gives the other's weight: with its own, noise would lighten. */
static float weight_of(float open) { return fminf(1, LEAST_WEIGHT + STEEP * open); }

static void measure(const struct gn_occlusion *o, uint32_t number, struct measured *m) {
    double whole[2] = {0, 0}, light[2];
    m->weight = m->open[0] = m->open[1] = 1;
    if (m->leaves) return;
    light[0] = gn_occlusion_cast(o, &m->site, 0, PILOT, &whole[0]);
    light[1] = gn_occlusion_cast(o, &m->site, RAYS / 2, RAYS / 2 + PILOT / 2, &whole[1]);
    if (light[0] + light[1] == 0) {
        m->weight =
            gn_hash(GN_HASH_INIT, &number, sizeof number) >> 32 & (GOES_ON - 1) ? 0 : GOES_ON;
        if (m->weight == 0) return;
    }
    light[0] += gn_occlusion_cast(o, &m->site, PILOT, RAYS / 2, &whole[0]);
    light[1] += gn_occlusion_cast(o, &m->site, RAYS / 2 + PILOT / 2, RAYS, &whole[1]);
    if (!(whole[0] > 0) || !(whole[1] > 0)) m->weight = 0;
    for (int k = 0; k < 2 && m->weight > 0; k++) m->open[k] = (float)(light[k] / whole[k]);
}

static void *measure_sites(void *data) {
    struct job *job = data;
    for (uint32_t first; (first = atomic_fetch_add(&job->next, PIECE)) < job->count;)
        for (uint32_t i = first; i < first + PIECE && i < job->count; i++) {
            if (is_cancelled(job->work)) return NULL;
            measure(job->occlusion, job->first + i, &job->sites[i]);
        }
    return NULL;
}

static int count_threads(int wanted) {
    cpu_set_t set;
    if (wanted <= 0) wanted = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return wanted < THREADS_MAX ? wanted : THREADS_MAX;
}

static void measure_all(struct job *job) {
    pthread_t threads[THREADS_MAX];
    const int wanted = count_threads(job->work->threads) - 1;
    int started = 0;
    while (started < wanted && pthread_create(&threads[started], NULL, measure_sites, job) == 0)
        started++;
    measure_sites(job);
    while (started) pthread_join(threads[--started], NULL);
}

static uint32_t drop_unmeasured(struct measured *sites, uint32_t count) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (sites[i].weight > 0) sites[kept++] = sites[i];
    return kept;
}

/* ---- the fit: of what is less than 1, so that where nothing was measured nothing is ---- */

struct corners { /* of the eight cubes around a point */
    uint32_t first;
    float share[3]; /* of the upper ones */
};
struct fit {
    const struct gn_scene_occlusion *grid;
    const struct gn_occlusion_work *work;
    struct measured *sites, *checks;
    uint32_t count, check_count, cells;
    struct corners *corners; /* of each site */
    float bend, ridge;
    float (*bent)[4]; /* second differences */
};

static struct corners corners_of(const struct gn_scene_occlusion *grid, const double point_ws[3]) {
    struct corners c;
    uint32_t at[3];
    for (int k = 0; k < 3; k++) {
        const float last = (float)(grid->size[k] - 1),
                    t = glm_clamp(((float)point_ws[k] - grid->origin[k]) / grid->cell_m, 0, last);
        at[k] = (uint32_t)t < grid->size[k] - 2 ? (uint32_t)t : grid->size[k] - 2;
        c.share[k] = t - (float)at[k];
    }
    c.first = (at[2] * grid->size[1] + at[1]) * grid->size[0] + at[0];
    return c;
}

static void list_corners(const struct gn_scene_occlusion *grid, const struct corners *c,
                         uint32_t at[8], float share[8]) {
    const uint32_t step[3] = {1, grid->size[0], grid->size[0] * grid->size[1]};
    for (uint32_t i = 0; i < 8; i++) {
        at[i] = c->first;
        share[i] = 1;
        for (uint32_t k = 0; k < 3; k++) {
            at[i] += (i >> k & 1) * step[k];
            share[i] *= i >> k & 1 ? c->share[k] : 1 - c->share[k];
        }
    }
}

static float value_at(const float (*x)[4], const uint32_t at[8], const float share[8],
                      const float n[3]) {
    float value = 0;
    for (int i = 0; i < 8; i++) {
        const float *v = x[at[i]];
        value += share[i] * (v[0] * n[0] + v[1] * n[1] + v[2] * n[2] + v[3]);
    }
    return value;
}

static float mean_open(const struct measured *m) {
    const float by[2] = {weight_of(m->open[0]), weight_of(m->open[1])};
    return (by[0] * m->open[1] + by[1] * m->open[0]) / (by[0] + by[1]);
}

static float site_weight(const struct measured *m) {
    return m->weight * (weight_of(m->open[0]) + weight_of(m->open[1])) / 2;
}

/* Adds to `out` the transpose of the sites' matrix times what it makes of x, or, where x is NULL,
 * times what was measured; then also its diagonal, by cube. */
static void add_sites(const struct fit *f, const float (*x)[4], float (*out)[4], float *diagonal) {
    for (uint32_t i = 0; i < f->count; i++) {
        const struct measured *m = &f->sites[i];
        const float *n = m->site.normal_ws, weight = site_weight(m);
        uint32_t at[8];
        float share[8];
        list_corners(f->grid, &f->corners[i], at, share);
        const float value = weight * (x ? value_at(x, at, share, n) : mean_open(m) - 1);
        for (int c = 0; c < 8; c++) {
            float *to = out[at[c]];
            for (int k = 0; k < 3; k++) to[k] += share[c] * value * n[k];
            to[3] += share[c] * value;
            if (!x) diagonal[at[c]] += share[c] * share[c] * weight;
        }
    }
}

/* Adds `by` times the differences of each cube to its neighbours. */
static void add_differences(const struct fit *f, float by, const float (*x)[4], float (*out)[4]) {
    const uint32_t *size = f->grid->size, step[3] = {1, size[0], size[0] * size[1]};
    for (uint32_t i = 0; i < f->cells; i++) {
        const uint32_t at[3] = {i % size[0], i / size[0] % size[1], i / step[2]};
        for (int axis = 0; axis < 3; axis++)
            for (int k = 0; at[axis] + 1 < size[axis] && k < 4; k++) {
                const float d = by * (x[i][k] - x[i + step[axis]][k]);
                out[i][k] += d;
                out[i + step[axis]][k] -= d;
            }
    }
}

static void apply(const struct fit *f, const float (*x)[4], float (*out)[4]) {
    memset(out, 0, f->cells * sizeof *out);
    add_sites(f, x, out, NULL);
    for (uint32_t i = 0; i < f->cells; i++)
        for (int k = 0; k < 4; k++) out[i][k] += f->ridge * x[i][k];
    memset(f->bent, 0, f->cells * sizeof *f->bent);
    add_differences(f, 1, x, f->bent);
    add_differences(f, f->bend, (const float(*)[4])f->bent, out);
}

static double dot_all(const struct fit *f, const float (*a)[4], const float (*b)[4]) {
    double sum = 0;
    for (uint32_t i = 0; i < f->cells; i++)
        for (int k = 0; k < 4; k++) sum += (double)a[i][k] * (double)b[i][k];
    return sum;
}

/* Conjugate gradients, preconditioned by the diagonal: x from 0. */
static void solve(struct fit *f, float bend, float (*x)[4]) {
    float(*memory)[4] = gn_xalloc(5 * (size_t)f->cells, sizeof *memory);
    float(*r)[4] = memory, (*z)[4] = r + f->cells, (*p)[4] = z + f->cells, (*ap)[4] = p + f->cells;
    float *diagonal = gn_xalloc(f->cells, sizeof *diagonal);
    f->bent = ap + f->cells;
    add_sites(f, NULL, r, diagonal);
    double sum = 0;
    uint32_t used = 0;
    for (uint32_t i = 0; i < f->cells; i++) {
        sum += (double)diagonal[i];
        used += diagonal[i] > 0;
    }
    const float mean = (float)(sum / (used ? used : 1));
    f->bend = bend * mean;
    f->ridge = RIDGE * mean;
    for (uint32_t i = 0; i < f->cells; i++)
        diagonal[i] = 1 / (diagonal[i] + 42 * f->bend + f->ridge); /* 42: of a cube amid others */
    double rz = 0;
    for (int step = -1; step < STEPS && !is_cancelled(f->work); step++) {
        float along = 0;
        if (step >= 0) {
            apply(f, (const float(*)[4])p, ap);
            const double curve = dot_all(f, (const float(*)[4])p, (const float(*)[4])ap);
            if (!(rz > 0) || !(curve > 0)) break;
            along = (float)(rz / curve);
        }
        for (uint32_t i = 0; i < f->cells; i++)
            for (int k = 0; k < 4; k++) {
                x[i][k] += along * p[i][k];
                r[i][k] -= along * ap[i][k];
                /* of x, y and z the diagonal is a third of that of w, on average */
                z[i][k] = (k < 3 ? 2 : 1) * diagonal[i] * r[i][k];
            }
        const double before = rz;
        rz = dot_all(f, (const float(*)[4])r, (const float(*)[4])z);
        const float by = step < 0 ? 0 : (float)(rz / before);
        for (uint32_t i = 0; i < f->cells; i++)
            for (int k = 0; k < 4; k++) p[i][k] = z[i][k] + by * p[i][k];
    }
    free(diagonal);
    free(memory);
}

/* Of the checks' halves, whose noise differs: the product of their errors has none on average.
 * texels NULL: without occlusion. */
static float measure_error(const struct fit *f, const int8_t (*texels)[4]) {
    double sum = 0, all = 0;
    for (uint32_t i = 0; i < f->check_count; i++) {
        const struct measured *m = &f->checks[i];
        const float read =
            texels ? gn_occlusion_read(f->grid, texels, m->site.point_ws, m->site.normal_ws) : 1;
        sum += (double)m->weight * (double)(read - m->open[0]) * (double)(read - m->open[1]);
        all += (double)m->weight;
    }
    return sum > 0 ? (float)sqrt(sum / all) : 0;
}

static void fit_texels(struct fit *f, struct gn_occlusion_made *made) {
    f->corners = gn_xalloc(f->count, sizeof *f->corners);
    for (uint32_t i = 0; i < f->count; i++)
        f->corners[i] = corners_of(f->grid, f->sites[i].site.point_ws);
    for (size_t i = 0; i < sizeof BENDS / sizeof BENDS[0]; i++) {
        float(*x)[4] = gn_xalloc(f->cells, sizeof *x);
        int8_t(*texels)[4] = gn_xalloc(f->cells, sizeof *texels);
        solve(f, BENDS[i], x);
        for (uint32_t cell = 0; cell < f->cells; cell++)
            for (int k = 0; k < 4; k++)
                texels[cell][k] = (int8_t)lrintf(127 * glm_clamp(x[cell][k] + (k == 3), -1, 1));
        free(x);
        const float error = measure_error(f, (const int8_t(*)[4])texels);
        const bool better = i == 0 || error <= 1.1f * made->error + BLUR;
        free(better ? made->texels : texels);
        if (!better) continue;
        made->texels = texels;
        made->error = error;
    }
    free(f->corners);
}

/* ---- poses ---- */

/* Of some sites, with more rays than the fit has. */
static void check_sites(struct fit *f, const struct gn_occlusion *o, uint32_t first,
                        uint32_t checks) {
    for (uint32_t i = 0; i < checks && first < f->count && !is_cancelled(f->work); i++) {
        const uint32_t number = first + (uint32_t)((uint64_t)i * (f->count - first) / checks);
        struct measured check = f->sites[number];
        double whole[2] = {0, 0};
        check.weight = site_weight(&f->sites[number]);
        for (uint64_t k = 0; k < 2 && !check.leaves; k++) {
            const uint64_t turns = gn_hash(GN_HASH_INIT + k, &number, sizeof number);
            check.site.turn[0] = (float)(turns & 0xffff) * 0x1p-16f;
            check.site.turn[1] = (float)(turns >> 16 & 0xffff) * 0x1p-16f;
            const double light = gn_occlusion_cast(o, &check.site, 0, CHECK_RAYS, &whole[k]);
            check.open[k] = (float)(light / whole[k]);
        }
        if (check.leaves || (whole[0] > 0 && whole[1] > 0)) f->checks[f->check_count++] = check;
    }
}

/* Adds sites of pose p of so many, of each as many. */
static void add_pose(struct fit *f, const struct gn_scene *scene, const struct gn_moment *at,
                     const struct gn_sky *sky, int p, int poses) {
    const uint32_t most = (f->work->rays ? f->work->rays : GN_OCCLUSION_RAYS) / RAYS,
                   first = most / (uint32_t)poses * (uint32_t)p, room = most / (uint32_t)poses;
    struct gn_occlusion o;
    gn_occlusion_init(&o, scene, at, sky, f->work->cancel);
    struct job job = {
        .occlusion = &o, .work = f->work, .sites = f->sites + f->count, .first = first};
    const double area = lay_sites(&o, 0, 0, 0, 0, NULL, NULL), step = area / room;
    if (area > 0 && isfinite(area))
        lay_sites(&o, step, step * (p + .5) / poses, first, room, job.sites, &job.count);
    if (!is_cancelled(f->work)) measure_all(&job);
    const uint32_t before = f->count;
    f->count += is_cancelled(f->work) ? 0 : drop_unmeasured(job.sites, job.count);
    check_sites(f, &o, before, CHECKS / (uint32_t)poses);
    gn_occlusion_finish(&o);
}

static int add_poses(struct fit *f, const struct gn_scene *scene, int clips,
                     const struct gn_sky *sky) {
    struct gn_poses_place *places = gn_xalloc(scene->item_count, sizeof *places);
    struct gn_pose pose;
    gn_pose_init(&pose, scene, clips);
    const int poses = gn_poses_occlusion(&pose, places);
    for (int p = 0; p < poses && !is_cancelled(f->work); p++) {
        gn_poses_step(&pose, p, poses);
        add_pose(f, scene, &pose.at, sky, p, poses);
    }
    gn_pose_finish(&pose);
    free(places);
    return poses;
}

struct gn_occlusion_made gn_occlusion_make(const struct gn_scene *scene, int clips,
                                           const struct gn_sky *sky,
                                           const struct gn_occlusion_work *work) {
    struct gn_occlusion_made made = {.texels = NULL};
    const struct gn_scene_occlusion *grid = &scene->occlusion;
    if (grid->size[0] == 0) return made;
    struct fit f = {.grid = grid, .work = work};
    f.cells = grid->size[0] * grid->size[1] * grid->size[2];
    f.sites = gn_xalloc((work->rays ? work->rays : GN_OCCLUSION_RAYS) / RAYS, sizeof *f.sites);
    f.checks = gn_xalloc(CHECKS, sizeof *f.checks);
    const int poses = add_poses(&f, scene, clips, sky);
    if (f.count > 0 && !is_cancelled(work)) fit_texels(&f, &made);
    const float most = poses > 1 ? fmaxf(COARSE, measure_error(&f, NULL) / MOVES) : COARSE;
    free(f.checks);
    free(f.sites);
    if (!is_cancelled(work) && made.error <= most) return made;
    free(made.texels);
    made.texels = NULL;
    return made;
}

float gn_occlusion_read(const struct gn_scene_occlusion *grid, const int8_t (*texels)[4],
                        const double point_ws[3], const float normal_ws[3]) {
    const struct corners c = corners_of(grid, point_ws);
    uint32_t at[8];
    float share[8], value = 0;
    list_corners(grid, &c, at, share);
    for (int i = 0; i < 8; i++) {
        const int8_t *v = texels[at[i]];
        value += share[i] / 127 *
                 ((float)v[0] * normal_ws[0] + (float)v[1] * normal_ws[1] +
                  (float)v[2] * normal_ws[2] + (float)v[3]);
    }
    return glm_clamp_zo(value);
}
