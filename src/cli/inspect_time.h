/* inspect and bench --for GPU: how long the GPU of a board takes for a frame at least
 * (cost/frame_cost.h). */
#ifndef GN_CLI_INSPECT_TIME_H
#define GN_CLI_INSPECT_TIME_H

#include <jansson.h>
#include <stdio.h>

#include "core/err.h"
#include "core/warn.h"
#include "stage/time.h"

struct gn_inspect_time {
    struct gn_stage_time frame;
    char advice[400]; /* what to change first */
};

/* Of the stage's scene, pose and options, as settings have them: at --size, with the samples of
 * --msaa (auto: 4), on a GPU that has all capabilities. The stage must outlive it; its pose is as
 * before. */
bool gn_inspect_time_build(struct gn_inspect_time *time, struct gn_stage *stage,
                           const struct gn_cost_gpu *gpu, struct gn_warnings *warnings,
                           struct gn_err *err);
void gn_inspect_time_finish(struct gn_inspect_time *time);

void gn_inspect_time_print(const struct gn_inspect_time *time, FILE *to);
/* {gpu, board, source, error|null (of the calibration), width_px, height_px, msaa,
 * each_frame_ms, camera_moves_ms, all_ms, frames_per_second,
 * passes [{label, drawn (each frame, camera moves, kept), draws, triangles, vertices, pixels,
 * lanes, instructions, fetches, bytes, vertex_instructions, instructions_ms, fetches_ms, bytes_ms,
 *     vertices_ms, ms, limit (instructions, fetches, bytes)}] (triangles: that reach a sample;
 *     instructions, fetches: of all lanes),
 * programs [{name, instructions, vertex_instructions, fetches, estimated, fetches_estimated,
 *     nearest|null}]
 *     (instructions, fetches: of a lane),
 * materials [{name, ms}], lights [{name, ms}], advice}. */
json_t *gn_inspect_time_json(const struct gn_inspect_time *time);

#endif
