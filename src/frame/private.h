/* Inside the frame room. */
#ifndef GN_FRAME_PRIVATE_H
#define GN_FRAME_PRIVATE_H

#include "frame/frame.h"
#include "frame/list.h"
#include "frame/notice.h"
#include "shadow/reach.h"

struct gn_placed {
    float depth; /* behind the near plane, metres */
    uint32_t item;
};

/* A light of this frame. */
struct gn_frame_light {
    uint32_t light;              /* of the scene */
    enum gn_technique technique; /* NONE: casts no shadow */
    enum gn_encoding encoding;
    enum gn_moments moments; /* of a technique that filters its map */
    enum gn_slide slide;
    struct gn_light_opts opts; /* what holds for it */
    float illuminance; /* at the scene's centre, lux; the weakest are dropped over the limit */
    uint32_t cascades; /* 1: one map. Known after gn_frame_fit_shadows() */
};

/* Lights that share a pass: those with maps first. The first group is drawn with the picture, each
 * other one is added to it. */
struct gn_light_group {
    uint32_t first, count, first_shadow, shadow_count;
    uint32_t plane_count;                   /* of those with maps, the last so many are planar */
    uint32_t first_on_plane[GN_PLANES_MAX]; /* slots of their shadows, by plane; of the first plane
                                               they are its own */
    struct gn_reach reaches[GN_LIGHTS_MAX]; /* of groups that are added */
    bool seen;                              /* in the camera's view; else it has no pass */
    struct gn_rect rect;                    /* of the picture; width 0: all of it */
};

enum {
    GN_CASCADE_CHOICES = 8
}; /* combinations of camera, map and picture size that are remembered */

/* How many cascades a light has, and how wide a map, or each of them, is. */
struct gn_map_choice {
    uint32_t cascades, px;
    bool fixed; /* as in gn_shadow_opts */
};
struct gn_cascade_choice {
    uint64_t choice;           /* hash of the options that it is for */
    struct gn_map_choice map;  /* no cascades: not known yet */
    struct gn_map_choice home; /* chosen before the user moved the camera; none: zeroed */
    uint64_t judged;           /* hash of the orbit that was judged last */
    float borne_px;            /* accepted texel size: another map would not help */
};

/* What is known of a scene's light, and which warnings it had. */
struct gn_light_note {
    enum gn_technique technique; /* its own, or pcf */
    bool unknown;                /* it names an unknown one */
    uint32_t said;               /* bits: enum gn_notice */
    struct gn_cascade_choice cascades[GN_CASCADE_CHOICES];
    uint32_t next_choice; /* replaced next */
};

struct gn_frame {
    const struct gn_scene *scene;
    struct gn_caps caps;
    bool has_middle; /* some item casts by its middle */
    struct {
        bool reflected_only; /* as in gn_frame_environment_opts */
        bool scaled, turned, shows_key;
    } environment; /* of this frame */
    struct {
        GN_LIST(struct gn_light_note) lights; /* what is learned of each of the scene's */
        uint32_t said, about[GN_NOTICE_ABOUT];
    } notes;
    struct {
        bool exists, blended;
        uint32_t count; /* of planes; those that have slots in this frame may be fewer */
        uint32_t shown;
        float (*constants)[4]; /* a set for each group and plane but the first; NULL until there
                                  are any */
    } plane;                   /* of the scene, for planar shadows */
    struct {
        bool is_apart;       /* the unseen floor has a texture of its alpha, in place of the made
                                light's own map */
        bool stands;         /* nothing that casts on it can move */
        uint32_t slot, item; /* of that; the floor */
    } floor;
    struct {
        bool known;
        float value;
    } auto_exposure;                                 /* fixed at the first build */
    struct gn_frame_light lights[GN_ALL_LIGHTS_MAX]; /* group by group */
    uint32_t scene_lights[GN_ALL_LIGHTS_MAX];        /* the same, as the plan shows them */
    uint32_t light_count, shadow_count;
    bool shadow_specular; /* of some of them that share is not what the strength leaves */
    uint32_t view_count;  /* of shadows[]: lights with maps, then planar ones on further planes */
    struct gn_light_group groups[GN_GROUPS_MAX];
    uint32_t group_count; /* 1 at least */
    struct gn_shadow_view shadows[GN_ALL_SHADOWS_MAX];
    struct gn_shadow_memory memory[GN_ALL_SHADOWS_MAX][GN_SHADOW_TILES_MAX]; /* once in use */
    struct {
        struct gn_shadow_view
            view;        /* of the filtered map that is there; no moments: there is none */
        uint32_t waited; /* frames */
    } kept[GN_ALL_SHADOWS_MAX];
    struct {
        uint64_t hash;      /* of the mask's content; 0: there is none */
        uint32_t drawn;     /* points of the lamp */
        uint32_t left;      /* frames until a floor shows them; 0: it does */
        float (*points)[4]; /* their constants; NULL until there are any */
    } gathered[GN_ALL_SHADOWS_MAX];
    GN_LIST(struct gn_draw) draws; /* these four: of the plan */
    GN_LIST(struct gn_instance) instances;
    GN_LIST(struct gn_program_key) programs;
    GN_LIST(struct gn_pass) passes;
    struct {
        GN_LIST(struct gn_placed) blended, run, sorted;
        GN_LIST(struct gn_draw) merged; /* room to sort in */
        GN_LIST(uint8_t) levels; /* of detail, by the scene's items; none without plan.detail */
        bool occluded;           /* by the scene's volume: what the open draw has */
    } items;                     /* of the pass that is being built */
    float (*constants)[4];       /* sets of GN_PASS_SIZE, see enum gn_frame_constants */
    float (*sets)[4];            /* stencil.c's, likewise; NULL until there are any */
    uint32_t camera;             /* of the scene; after those its lights */
    struct gn_eye eye;
    struct {
        uint32_t width_px, height_px;             /* before it is turned, as it is drawn */
        uint32_t shown_width_px, shown_height_px; /* likewise, as it is finished */
        float scale;   /* pixels as they are drawn for each that is shown */
        float turn[2]; /* cosine and sine of that, clockwise */
        unsigned turn_deg;
    } picture;
    struct gn_plan plan;
};

/* Room of the constants of one pass, in vec4. */
enum { GN_PASS_SIZE = 130 };
/* Sets of a slot: a page of a tile each. */
enum { GN_SLOT_SETS = GN_SHADOW_TILES_MAX * GN_SHADOW_PAGES_MAX };
/* Index of a set of constants. */
enum gn_frame_constants {
    GN_CONSTANTS_SHADOW,                                      /* GN_SLOT_SETS a slot */
    GN_CONSTANTS_PICTURE = GN_ALL_SHADOWS_MAX * GN_SLOT_SETS, /* a group each */
    GN_CONSTANTS_PROGRAM =
        GN_CONSTANTS_PICTURE + GN_GROUPS_MAX, /* a program each: MARK, PANEL .. */
    GN_CONSTANTS_COUNT = GN_CONSTANTS_PROGRAM + GN_PROGRAM_KIND_COUNT,
};
float (*gn_frame_constants(const struct gn_frame *frame, uint32_t which))[4];

/* Of visible items: receivers of planar shadows, or the rest. */
enum gn_part { GN_PART_ALL, GN_PART_PLANE, GN_PART_REST };
/* Which items a pass draws, and with which program. */
struct gn_selection {
    const uint8_t *casts; /* shadow pass: those marked by bit `page`; NULL: what the camera sees */
    uint32_t page;
    const struct gn_shadow_view *view;  /* shadow pass */
    bool mirrored;                      /* drawn mirrored */
    bool backs;                         /* only the far sides of what casts by its middle */
    const struct gn_light_group *group; /* added: draws items in its reach; NULL: the first */
    enum gn_part part;                  /* not of a shadow pass */
    bool tints;                         /* draws the tint of what transmits colours */
    bool colorless;                     /* tints as if it were white */
    bool blends;                        /* of blended items: what is not opaque */
    enum gn_cull cull;                  /* of double-sided items: NONE: both sides */
    uint32_t plane; /* the same: only receivers of planar shadows on it; 0: all but those on further
                       planes */
    const struct gn_frame_opts *opts; /* never NULL */
};

/* ---- pass.c: programs, passes, bare draws ---- */

/* Its index in the plan, which has each key once. */
uint32_t gn_frame_program(struct gn_frame *frame, const struct gn_program_key *key);
struct gn_pass *gn_frame_begin_pass(struct gn_frame *frame, enum gn_pass_kind kind);
void gn_frame_end_pass(struct gn_frame *frame);
/* Where the scene is drawn at another size, the pass's target is the finished picture. */
void gn_frame_to_shown(const struct gn_frame *frame, struct gn_pass *pass);
/* Begins a pass to the output. */
struct gn_pass *gn_frame_picture_pass(struct gn_frame *frame, const char *label);
/* The same with what the programs of a group of lights read; later groups are added by blending. */
struct gn_pass *gn_frame_lit_pass(struct gn_frame *frame, const char *label, uint32_t group);
/* Makes it one of items on a further plane, from 2: with the planar shadows on that. */
void gn_frame_set_plane(struct gn_frame *frame, struct gn_pass *pass, uint32_t group,
                        uint32_t plane);
/* A draw of bare vertices. */
void gn_frame_draw_bare(struct gn_frame *frame, const struct gn_program_key *key,
                        uint32_t vertex_count, uint32_t first_instance, uint32_t instance_count);

/* ---- draws.c ---- */

/* Visible blended items of a picture are not drawn but gathered in frame->items.blended. */
void gn_frame_draw_items(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_selection *s);
/* As a draw of its own, or one more instance of the last draw, if that is *open and fits. */
void gn_frame_draw_item(struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_selection *s, uint32_t item, bool *open);
/* Opaque before masked, then nearest first. */
void gn_frame_sort_draws(struct gn_frame *frame, uint32_t first);

/* ---- steps (rows: program.h): maps.c, picture.c, backdrop.c, overlay.c, caption.c, mean.c and, of
 * scaling, frame.c ---- */

#define X(name)                                                                                    \
    void gn_frame_add_##name(struct gn_frame *frame, const struct gn_pose *pose,                   \
                             const struct gn_frame_opts *opts);
GN_FRAME_STEPS(X)
#undef X

/* ---- filter.c, budget.c, gather.c: what belongs to the maps ---- */

/* The passes that turn a map into what shaders read; none where that is the map. */
void gn_frame_filter_passes(struct gn_frame *frame, uint32_t slot);
/* Size of a texture of the technique's filter, as numbered in gn_filter_stage. */
void gn_frame_filter_size(enum gn_technique technique, const struct gn_shadow_map *map,
                          uint32_t texture, uint32_t size_px[2]);
/* Of all that the moments of a tile depend on; never 0. */
uint64_t gn_frame_filter_hash(const struct gn_shadow_view *view, uint32_t tile);
/* budget.c: after the lights' views are known. Replaces views over the budget by their older ones.
 */
void gn_frame_hold_maps(struct gn_frame *frame, const struct gn_frame_opts *opts);

/* ---- floor.c: an unseen floor ---- */

/* Whether something casts, and nothing that does can move. */
bool gn_frame_casters_stand(const struct gn_pose *pose);
/* After the lights are chosen: whether its alpha has a texture, in a slot of its own. */
void gn_frame_take_floor(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts);
/* What is wanted of its map, by what is wanted of the light's own. */
void gn_frame_want_floor(const struct gn_frame *frame, const struct gn_pose *pose,
                         struct gn_shadow_opts *wanted);
/* How many points of the lamp a frame adds. */
uint32_t gn_frame_floor_points(const struct gn_frame *frame);
/* After the constants of the picture are known: the shares of light in its view. */
void gn_frame_light_floor(struct gn_frame *frame, const struct gn_pose *pose);
/* Draws it: a pass of its own, to the picture or to its visibility. */
void gn_frame_draw_floor(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts);

/* overdraw.c: after all passes. Leaves out instances over the limit gn_frame_opts.overdraw. */
void gn_frame_bound_overdraw(struct gn_frame *frame, const struct gn_pose *pose, uint64_t most,
                             struct gn_warnings *warnings);

/* gather.c: after the lights' views are known. How many points of its lamp each planar mask has
 * after this frame. */
void gn_frame_gather_points(struct gn_frame *frame, const struct gn_frame_opts *opts);
/* Of the pass that draws such a mask. */
void gn_frame_set_points(struct gn_frame *frame, uint32_t slot, struct gn_pass *pass);

/* ---- stencil.c, overlay.c: what belongs to the picture ---- */

/* Planar shadows without a map. Draws the receivers of such shadows in a group's light, and the
 * shadows. */
void gn_frame_plane_passes(struct gn_frame *frame, const struct gn_pose *pose,
                           const struct gn_frame_opts *opts, uint32_t group);
/* Whether the group has any that is visible. */
bool gn_frame_marks_plane(const struct gn_frame *frame, uint32_t group);

/* ---- tone.c ---- */

/* The plan's tone, when its groups of lights are known. */
void gn_frame_choose_tone(struct gn_frame *frame, const struct gn_frame_opts *opts,
                          struct gn_warnings *warnings);
/* The feature of programs that map it; 0: none does. */
uint64_t gn_frame_tone_feature(const struct gn_frame *frame);

/* ---- lights.c, group.c, slides.c: which lights ---- */

/* With what technique and map format; then in groups. */
void gn_frame_choose_lights(struct gn_frame *frame, const struct gn_pose *pose,
                            const struct gn_frame_opts *opts, struct gn_warnings *warnings);
float gn_frame_exposure(struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_frame_opts *opts);
void gn_frame_group_lights(struct gn_frame *frame, const struct gn_pose *pose);
/* The bounds of each group's light in the picture. */
void gn_frame_bound_groups(struct gn_frame *frame);
bool gn_group_touches(const struct gn_light_group *group, const struct gn_box *box_ws);
/* Which of the chosen lights have a slide. A pass has them in the order of its lights. */
void gn_frame_choose_slides(struct gn_frame *frame, const struct gn_frame_opts *opts,
                            struct gn_warnings *warnings);
void gn_frame_slide_constants(const struct gn_frame *frame, const struct gn_pose *pose,
                              const struct gn_light_group *group, float (*constants)[4]);

/* ---- fit.c, cascade.c, slot.c: their shadow maps ---- */

void gn_frame_fit_shadows(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts, struct gn_warnings *warnings);
/* How many cascades a light has, and whether its map is the same for every eye. Chosen once, for
 * the current camera and, if it is animated, for eight points of its path, and again when options
 * change that matter: while the camera moves neither programs nor targets change. opts: of the fit,
 * map_px of a map without cascades, cascades: the most; becomes what is chosen. */
void gn_frame_choose_map(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *frame_opts, uint32_t slot,
                         struct gn_shadow_opts *opts);
struct gn_frame_light *gn_frame_light_of_slot(struct gn_frame *frame, uint32_t slot);
uint32_t gn_frame_plane_of_slot(const struct gn_frame *frame, uint32_t slot); /* from 1 */
/* Gives planar lights slots on further planes: all of a group's on one plane follow each other. */
void gn_frame_add_plane_slots(struct gn_frame *frame);
/* Creates at least so many memories of a slot. */
void gn_frame_make_memories(struct gn_frame *frame, uint32_t slot, uint32_t count);
/* Largest resolution of a map, or of its tiles, whose texture this GPU supports. */
uint32_t gn_frame_most_px(const struct gn_frame *frame, const struct gn_frame_light *light,
                          uint32_t cascades);

/* ---- bytes.c: what they take on the GPU ---- */

struct gn_map_need { /* of a light */
    enum gn_technique technique;
    enum gn_encoding encoding;
    enum gn_moments moments;
    struct gn_shadow_map map; /* without gutters */
    bool paged;               /* drawn in pages */
    bool backs;               /* and the far sides of casters beside it */
};
/* Whether casters may cast by their middle (GN_CAST_MIDDLE): then passes draw their far sides.
 * faces: as in gn_light_opts. */
bool gn_frame_has_middle(const struct gn_frame *frame, enum gn_technique technique, int faces);
/* Halves map_px of the maps, by slot, until they take at most so many bytes; 0: no limit. */
void gn_frame_shrink_maps(struct gn_frame *frame, uint64_t most_bytes, struct gn_shadow_opts *maps,
                          struct gn_warnings *warnings);

/* ---- opts.c ---- */

/* What is set for that light alone; never NULL. */
const struct gn_light_opts *gn_frame_own_opts(const struct gn_frame_opts *opts, uint32_t light);

/* ---- constants.c ---- */

/* Of the shadow that sampler i of a pass reads. */
void gn_frame_reader_constants(const struct gn_shadow_view *view, uint32_t i,
                               float (*constants)[4]);

void gn_frame_light_constants(const struct gn_frame *frame, const struct gn_pose *pose,
                              const struct gn_light_group *group, float (*constants)[4]);
void gn_frame_shadow_constants(const struct gn_shadow_view *view, mat4 clip_from_world,
                               float (*constants)[4]);

/* key.c: the program that draws an item. */
struct gn_program_key gn_key_of(enum gn_program_kind kind); /* all else is zero */
/* The bits of a slot's texture; 0: the material has none. */
uint64_t gn_key_texture(const struct gn_material *material, enum gn_texture_slot slot);
/* Whether it reads the shadows of planar lights. */
bool gn_key_on_plane(const struct gn_frame *frame, uint32_t item, const struct gn_frame_opts *opts);
/* The plane whose planar shadows it reads, if that is not the first; else 0. */
uint32_t gn_key_further_plane(const struct gn_frame *frame, uint32_t item,
                              const struct gn_frame_opts *opts);
struct gn_program_key gn_key_lit(const struct gn_frame *frame, uint32_t item,
                                 const struct gn_frame_opts *opts);
struct gn_program_key gn_key_caster(const struct gn_frame *frame, uint32_t item,
                                    const struct gn_shadow_view *view);
/* The same caster, by its middle. */
void gn_key_add_middle(const struct gn_shadow_view *view, struct gn_program_key *key);
/* Of a blended item with opaque texels: these alone, as if it were masked, or the rest. */
void gn_key_take_part(bool rest, struct gn_program_key *key);
/* Whether an item is the floor that floor.c has taken. */
bool gn_key_is_floor(const struct gn_frame *frame, uint32_t item);
/* Whether an item transmits colours, or only its front faces tint. Each channel needs a factor of
 * its own on what is behind, which blending has no place for beside reflections (two outputs a
 * target are not in ES 3.0), so such an item is drawn twice: its tint multiplies, then its own
 * light adds. All others take one draw. */
bool gn_key_is_tinted(const struct gn_scene *scene, const struct gn_item *item);
/* The program of the first of them, by that of the second. */
struct gn_program_key gn_key_tint(const struct gn_program_key *lit);
/* The program that adds a group's light to what `lit` draws. */
struct gn_program_key gn_key_additive(const struct gn_frame *frame,
                                      const struct gn_program_key *lit,
                                      const struct gn_light_group *group,
                                      const struct gn_frame_opts *opts);

/* detail.c: items.levels, and what their errors add to the bias of maps. After those are fitted. */
void gn_frame_choose_levels(struct gn_frame *frame, const struct gn_pose *pose,
                            const struct gn_frame_opts *opts);

/* eye.c: clip_from_world of the camera, its position and their constants. */
void gn_frame_eye(struct gn_frame *frame, const struct gn_pose *pose,
                  const struct gn_frame_opts *opts, float (*constants)[4]);
/* light_eye.c: a camera in a light's place, a spot or a directional one, that shows its cone, or
 * what casts. */
void gn_frame_light_camera(const struct gn_pose *pose, uint32_t light, float aspect,
                           struct gn_framing *framing);
/* The same camera at another pose. */
void gn_frame_eye_at(const struct gn_frame *frame, const struct gn_pose *pose,
                     const struct gn_frame_opts *opts, struct gn_eye *eye);

#endif
