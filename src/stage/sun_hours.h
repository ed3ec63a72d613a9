/* Hours of sun: for how long each pixel's surface sees the sun, in a day or between two moments.
 * What counts is direct sunlight alone: the share of the sun's disk that is seen over a horizon of
 * 0 degrees and past all that casts shadows, by a surface that is turned towards it. How steeply it
 * shines does not count, nor do clouds, and glass lets all of it pass. */
#ifndef GN_STAGE_SUN_HOURS_H
#define GN_STAGE_SUN_HOURS_H

#include "stage/stage.h"

/* Each stands for the same time, and is another point of the disk. */
enum { GN_SUN_POSITIONS = 720 };

struct gn_sun_hours {
    double begin_s, end_s;            /* UTC, as time() has it */
    double step_h;                    /* that a position stands for */
    uint32_t light;                   /* of the scene, that is the sun */
    uint32_t count;                   /* positions over the horizon, in the order of time */
    float to_ws[GN_SUN_POSITIONS][3]; /* unit vectors to them */
};
/* From the settings' place, and --from and --to, else the day of their date: from sunrise to
 * sunset. A usage error where one of them is missing; a failure where the sun stays down, and where
 * no light of the scene can be the sun. */
bool gn_sun_hours_build(struct gn_sun_hours *hours, const struct gn_settings *settings,
                        const struct gn_scene *scene, struct gn_err *err);

/* The same of the day, by the place's sun, that a moment is in. */
bool gn_sun_hours_build_day(struct gn_sun_hours *hours, const struct gn_settings *settings,
                            const struct gn_scene *scene, double utc_s, struct gn_err *err);

/* Gives a view the options to draw that, of the light that is the sun. */
enum gn_sun_look { GN_SUN_VISIBILITY = GN_AOV_VISIBILITY, GN_SUN_NORMAL = GN_AOV_NORMAL };
void gn_sun_hours_look(struct gn_frame_opts *opts, uint32_t light, enum gn_sun_look look);
/* Turns the light to the position at that place in the list. */
void gn_sun_hours_aim(const struct gn_sun_hours *hours, struct gn_pose *pose, uint32_t position);

/* What is seen on a picture of the stage's shown view; row 0 on top. */
struct gn_sun_hours_picture {
    float *hours;          /* for each pixel; GN_SUN_HOURS_NONE: there is no surface */
    float (*normal_ws)[4]; /* unit; w: 1 */
};
#define GN_SUN_HOURS_NONE (-1.0f)
/* Draws it at the scene's time, by hard shadow maps, or with technique truth by a ray for each
 * position. Blocks: stage->truth.progress is called. The sun stays at the last position. The
 * picture is to be finished after a failure, too. */
bool gn_sun_hours_draw(const struct gn_sun_hours *hours, struct gn_stage *stage, int64_t time_ns,
                       struct gn_sun_hours_picture *out, struct gn_warnings *warnings,
                       struct gn_err *err);
void gn_sun_hours_finish(struct gn_sun_hours_picture *picture);

#endif
