/* The pose of a scene at a time: all transforms. Created once for a scene, stepped without
 * allocating. */
#ifndef GN_SCENE_POSE_H
#define GN_SCENE_POSE_H

#include "scene/scene.h"

enum gn_pose_clips {
    GN_POSE_DEFAULT = -1,
    GN_POSE_NONE = -2
}; /* or a clip's number: that one alone */

struct gn_pose_item {
    mat4 world_from_item; /* with a skin: identity */
    struct gn_box box;    /* of what it is made of, item space */
    struct gn_box box_ws;
    bool mirrored; /* negative determinant: front faces wind the other way */
    bool visible;  /* false: scaled to nothing, not finite, or of another variant; never drawn */
    bool moves;    /* a channel moves or deforms it */
    uint64_t hash; /* of all that its vertices depend on */
};

/* How clips go with the scene's time, except for one that plays over others. Zeroed: each in a
 * loop, at the speed that it has. */
struct gn_pose_run {
    enum gn_pose_turns { GN_POSE_LOOP, GN_POSE_ONCE, GN_POSE_PING_PONG } turns;
    double speed_less_1; /* 0: 1; -1: they stand */
    int64_t start_ns;    /* the time within each clip at time 0; not negative */
};
/* The time within a clip of that length, 0 to its end, at a time of the scene, which may be
 * negative. */
int64_t gn_pose_clip_ns(const struct gn_pose_run *run, int64_t length_ns, int64_t time_ns);

enum { GN_POSE_PARTS = 4 };
struct gn_pose_part { /* of what is shown: clips and over as in gn_pose */
    int clips, over;
    float share;
};

struct gn_moment { /* which clips are shown, and where in them: compared and copied whole */
    int64_t time_ns;
    struct gn_pose_run run;
    int64_t begun_ns; /* the scene's time that is 0 for the clips */
    int clips;        /* enum gn_pose_clips or a number */
    int over;         /* number of a clip that plays over those, at over_ns; -1: none */
    int64_t over_ns;
    float fade;  /* share of the chosen clips, against what gn_pose_choose_fading() kept; 1: they
                    alone */
    int variant; /* number of the variant of materials; GN_POSE_DEFAULT: none */
};

struct gn_exact;
struct gn_pose {
    const struct gn_scene *scene;
    struct gn_moment at;
    struct gn_pose_part before[GN_POSE_PARTS]; /* what a fade kept, in shares of 1 in all */
    mat4 *world_from_node;                     /* scene->node_count */
    struct gn_exact *exact;     /* the same, before the origin is moved; NULL: floats are enough */
    struct gn_pose_item *items; /* scene->item_count */
    struct gn_box box_ws;       /* of all visible items */
    uint32_t *playing;          /* numbers of the clips that are on; the one over others is last */
    uint32_t playing_count;
    bool animated;        /* some clip is on: time changes the pose */
    bool aimed;           /* a directional light shines along aim_ws */
    uint32_t aimed_light; /* that light */
    vec3 aim_ws;
    vec4 *texels; /* scene->deformation.width x height; what vertex shaders read of skins and
                     targets: rows of world_from_mesh of each joint, and lists of weights */
    uint32_t *list_counts; /* by deformation.morphs: how many targets have a weight */
    bool *node_moves;      /* scene->node_count: an active channel moves it or one of its parents */
    /* Those of the scene, or the pose's own where clips move any: read these for all that is drawn.
     * A light in a hidden node is black. */
    const struct gn_light *lights;
    const struct gn_camera *cameras;
    const struct gn_material *materials;
    /* By light: how far it is from its place, metres; of one without a place, how far across its
     * direction it shines, as a tangent along two axes. NULL: each is at its own. Not owned. */
    const float (*lights_aside)[3];
    bool *node_hidden; /* scene->node_count; NULL: none is, at any time */
    void *memory;      /* private */
};

/* Makes a pose at time 0. The scene must outlive it. */
void gn_pose_init(struct gn_pose *pose, const struct gn_scene *scene, int clips);
/* Changes the clips, as if initialised again; allocates nothing. over: a clip that plays over them:
 * what both move follows it, at a time of its own; -1: none. */
void gn_pose_choose(struct gn_pose *pose, int clips);
void gn_pose_choose_over(struct gn_pose *pose, int clips, int over);
/* The same, from what is shown now: fade becomes 0. The caller raises it before each step; when it
 * is 1 it chooses again, without a fade. */
void gn_pose_choose_fading(struct gn_pose *pose, int clips, int over);
/* Shows the items of that variant of materials, at the same time; a new pose has none. Allocates
 * nothing. */
void gn_pose_choose_variant(struct gn_pose *pose, int variant);
/* Moves it to time_ns (any value; clips loop, negative times too). Allocates nothing; nodes that
 * are not animated cost nothing. */
void gn_pose_step(struct gn_pose *pose, int64_t time_ns);
/* Later times show the same as the last step did. */
bool gn_pose_stands(const struct gn_pose *pose);
void gn_pose_finish(struct gn_pose *pose);

/* view_from_world of a camera at this pose, rigid (scale is dropped); eye_ws gets its position if
 * not NULL. */
void gn_pose_view(const struct gn_pose *pose, uint32_t camera, mat4 view_from_world, vec3 eye_ws);
/* The same for a light, along its -Z. */
void gn_pose_light_view(const struct gn_pose *pose, uint32_t light, mat4 light_from_world);
/* Turns a directional light, one of a pose, until it is turned again: the unit vector along which
 * it shines; NULL: as its node stands. Where a clip moves that node, after each step. */
void gn_pose_aim(struct gn_pose *pose, uint32_t light, const float *aim_ws);
/* Position of a light and the unit vector along which it shines, world space. */
void gn_pose_light(const struct gn_pose *pose, uint32_t light, vec3 position_ws, vec3 direction_ws);
/* Normalises a vector of any length; zero stays zero. glm_vec3_normalize() of cglm 0.9 and later
 * returns zero for lengths under 1.2e-7. */
void gn_unit(vec3 v);

/* Where a vertex of an item is, world space: mesh space for gn_scene_buffers.positions; its normal,
 * of any length, unless that is NULL. The second computes in floats, as a GPU would, where nothing
 * is deformed. */
void gn_pose_vertex(const struct gn_pose *pose, uint32_t item, uint32_t vertex, double out[3],
                    double normal[3]);
void gn_pose_corner(const struct gn_pose *pose, uint32_t item, uint32_t vertex, vec3 out);
/* ray.c: how far off the first surface is that is seen along a line, not nearer than least_m;
 * along: unit. INFINITY: none. Blended surfaces and the holes of masked ones count, too. It looks
 * at each triangle of the items on the line. */
float gn_pose_surface_m(const struct gn_pose *pose, const vec3 from_ws, const vec3 along,
                        float least_m);
/* Exact, where gn_pose_item.box_ws may be larger. */
struct gn_box gn_pose_tight_box(const struct gn_pose *pose, uint32_t item);

/* The plane of a flat item, world space: n.p + d = 0, |n| = 1, on the side its front faces look to.
 */
void gn_pose_plane(const struct gn_pose *pose, uint32_t item, vec4 plane_ws);

#endif
