/* A bounding volume hierarchy over triangles in double precision: what the ray caster asks "what is
 * first along this ray?"
 *
 * Build: binned surface-area heuristic, 16 bins on the longest axis of the centroids, a median
 * split where the bins cannot part them (Wald, "On fast construction of SAH-based bounding volume
 * hierarchies", 2007). Traversal: an explicit stack, near child first. Triangle test: Woop,
 * Benthin, Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013: both neighbours of an
 * edge count a ray through it, so no ray slips between them. */
#ifndef GN_TRUTH_BVH_H
#define GN_TRUTH_BVH_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

struct gn_bvh_triangle {
    double p[3][3]; /* corners, world space */
    uint32_t item;  /* the caller's */
    uint32_t index; /* the caller's: first index of this triangle in buffers.indices */
    uint32_t flags; /* the caller's */
};

struct gn_bvh_node;
struct gn_bvh {
    struct gn_bvh_triangle *triangles; /* owned, in the order of the leaves */
    uint32_t triangle_count;
    struct gn_bvh_node *nodes;
    uint32_t node_count;
    double diagonal; /* of the box of all triangles; 0 without any */
};

struct gn_ray {
    double origin[3], direction[3]; /* direction of any length; t counts in it */
    double t_min, t_max;            /* t_min < t <= t_max */
};

struct gn_bvh_hit {
    double t, u, v;    /* point = (1 - u - v) p[0] + u p[1] + v p[2] */
    double facing;     /* > 0: the ray meets the side on which the corners go anticlockwise */
    uint32_t triangle; /* into bvh->triangles */
};

/* May a candidate count? Called for those in range, in no order. NULL accepts all. */
typedef bool (*gn_bvh_accept)(const void *context, const struct gn_bvh_triangle *triangle,
                              const struct gn_bvh_hit *hit);

/* Takes count triangles (malloc'ed, owned from here on, reordered). Another thread sets *cancel to
 * end it; then the tree may only be finished. NULL: none. */
void gn_bvh_build(struct gn_bvh *bvh, struct gn_bvh_triangle *triangles, uint32_t count,
                  const atomic_bool *cancel);
void gn_bvh_finish(struct gn_bvh *bvh);
/* What a tree of so many triangles takes, with them. */
uint64_t gn_bvh_bytes(uint64_t triangles);

/* The closest accepted hit, or any accepted one if `any` (then `hit` is just one of them).
 * Thread-safe. */
bool gn_bvh_hit(const struct gn_bvh *bvh, const struct gn_ray *ray, bool any, gn_bvh_accept accept,
                const void *context, struct gn_bvh_hit *hit);
/* All rays from one point with directions between two corners of a box. */
struct gn_beam {
    double origin[3], low[3], high[3];
    double t_max; /* 0 < t <= t_max */
};
/* The triangles, into bvh->triangles, that a ray of the beam can meet; perhaps others that are
 * near. Returns how many; most + 1: there are more, and those in `out` are only some. */
uint32_t gn_bvh_gather(const struct gn_bvh *bvh, const struct gn_beam *beam, uint32_t *out,
                       uint32_t most);
/* Whether the ray meets one of these that is accepted; *which: its number in the list. */
bool gn_bvh_hit_some(const struct gn_bvh *bvh, const struct gn_ray *ray, const uint32_t *list,
                     uint32_t count, gn_bvh_accept accept, const void *context, uint32_t *which);
/* The same as gn_bvh_hit() over every triangle, without the tree: the reference that the tree is
 * tested against. */
bool gn_bvh_hit_slow(const struct gn_bvh *bvh, const struct gn_ray *ray, gn_bvh_accept accept,
                     const void *context, struct gn_bvh_hit *hit);

#endif
