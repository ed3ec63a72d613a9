/* Inside the frame room. */
#ifndef GN_FRAME_PRIVATE_H
#define GN_FRAME_PRIVATE_H

#include "frame/plan.h"

/* A growing array: keeps its memory, allocates only while growing. */
#define GN_LIST(type)                                                                              \
    struct {                                                                                       \
        type *at;                                                                                  \
        uint32_t count, room;                                                                      \
    }
void *gn_list_grow(void *at, uint32_t count, uint32_t *room, size_t size);
/* Room for one more; an lvalue. */
#define GN_LIST_PUSH(list)                                                                         \
    (*((list)->at = gn_list_grow((list)->at, (list)->count, &(list)->room, sizeof *(list)->at),    \
       &(list)->at[(list)->count++]))

struct gn_placed {
    float depth; /* behind the near plane, metres */
    uint32_t item;
};

/* A light of this frame. */
struct gn_frame_light {
    uint32_t light;              /* of the scene */
    enum gn_technique technique; /* NONE: no map */
    enum gn_encoding encoding;
    float strength;
    float illuminance; /* of its light on the scene's centre, lux; orders them when there are too
                          many */
};

struct gn_frame {
    const struct gn_scene *scene;
    struct gn_caps caps;
    bool exposure_known;
    float auto_exposure;                         /* fixed at the first build */
    struct gn_frame_light lights[GN_LIGHTS_MAX]; /* those with maps first */
    uint32_t light_count, shadow_count;
    struct gn_shadow_view shadows[GN_SHADOWS_MAX];
    struct gn_shadow_memory memory[GN_SHADOWS_MAX];
    GN_LIST(struct gn_draw) draws;
    GN_LIST(struct gn_instance) instances;
    GN_LIST(struct gn_program_key) programs;
    GN_LIST(struct gn_placed) blended, run, sorted;
    GN_LIST(struct gn_pass) passes;
    float (*constants)[4]; /* one set per shadow slot, then one for the picture */
    struct gn_eye eye;
    struct gn_plan plan;
};

/* Room of the constants of one pass, in vec4. */
enum { GN_PASS_SIZE = 70 };

/* lights.c: which lights, with what; then what they say to the shaders. */
void gn_frame_choose_lights(struct gn_frame *frame, const struct gn_pose *pose,
                            const struct gn_frame_opts *opts, struct gn_warnings *warnings);
void gn_frame_fit_shadows(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts);
float gn_frame_exposure(struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_frame_opts *opts);
void gn_frame_light_constants(const struct gn_frame *frame, const struct gn_pose *pose,
                              float (*constants)[4]);
void gn_frame_shadow_constants(const struct gn_shadow_view *view, float (*constants)[4]);

/* key.c: the program that draws an item. */
struct gn_program_key gn_key_lit(const struct gn_frame *frame, uint32_t item,
                                 const struct gn_frame_opts *opts);
struct gn_program_key gn_key_caster(const struct gn_frame *frame, uint32_t item,
                                    const struct gn_shadow_view *view);

/* eye.c: clip_from_world of the camera, its place and the constants that tell of it. */
void gn_frame_eye(struct gn_frame *frame, const struct gn_pose *pose,
                  const struct gn_frame_opts *opts, float (*constants)[4]);

#endif
