/* What is looked up once in a scene; warnings that are given once, and again when options change.
 */
#ifndef GN_FRAME_NOTICE_H
#define GN_FRAME_NOTICE_H

#include "frame/plan.h"

/* What a warning is about. */
enum gn_notice {
    GN_NOTICE_TECHNIQUE,
    GN_NOTICE_PLANE,
    GN_NOTICE_MOMENTS,
    GN_NOTICE_ENCODING,
    GN_NOTICE_MAPS,
    GN_NOTICE_LIGHTS,
    GN_NOTICE_SLIDES,
    GN_NOTICE_FLOAT,
    GN_NOTICE_MSAA,
    GN_NOTICE_BLENDED,
    GN_NOTICE_MAP_PX,
    GN_NOTICE_MAPS_MB,
    GN_NOTICE_TRIANGLES,
    GN_NOTICE_OVERDRAW,
    GN_NOTICE_PLANES,
    GN_NOTICE_TONE,
    GN_NOTICE_TRANSPARENT,
};
enum { GN_NOTICE_ABOUT = 9 }; /* options that a warning may be about */

struct gn_frame;
struct gn_frame_opts;
/* At the first build: resolves the names of the lights' techniques into notes.lights, finds the
 * plane. */
void gn_frame_learn_scene(struct gn_frame *frame);
/* Lets warnings be given again when options that they are about have changed. */
void gn_frame_renew_notices(struct gn_frame *frame, const struct gn_frame_opts *opts);
/* Whether to give this warning now: not given yet, and `warnings` is not NULL. Marks it as given.
 */
bool gn_frame_notice(uint32_t *said, enum gn_notice notice, const struct gn_warnings *warnings);

#endif
