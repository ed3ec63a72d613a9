/* A long frame in pieces: draws of so many pixels, then a fence, and while that is waited for the
 * owner's `pause`. A piece is as large as the last ones took time for: it grows up to PIECE_NS,
 * so a frame that is short has none any more. */
#include <math.h>

#include "core/clock.h"
#include "gl/private.h"

#define PIECE_NS  (GN_NS_PER_S / 10)
#define POLL_NS   (GN_NS_PER_S / 200)
/* The first piece: pixels, and what a corner of a triangle counts. */
#define LEAST_PX  4e6
#define CORNER_PX 16.0
/* By how much a piece grows or shrinks at most. */
#define GROWTH    2.0
#define SHRINK    0.125

void gn_gl_set_pause(struct gn_gl *gl, gn_gl_pause *pause, void *user) {
    gl->pieces.pause = pause;
    gl->pieces.user = user;
}

void gn_gl_pieces_begin(struct gn_gl *gl, const struct gn_scene *scene) {
    struct gn_gl_pieces *p = &gl->pieces;
    for (int k = 0; p->of != scene && k < GN_GL_PACES; k++) p->most_px[k] = LEAST_PX;
    p->of = scene;
    p->used = 0;
    p->done_before = p->done;
    p->begun_ns = p->run_ns = p->pause ? gn_clock_monotonic_ns() : 0;
}

void gn_gl_frame_was_long(struct gn_gl *gl) {
    struct gn_gl_pieces *p = &gl->pieces;
    for (int k = 0; p->done == p->done_before && k < GN_GL_PACES; k++)
        p->most_px[k] = fmax(SHRINK * p->most_px[k], LEAST_PX);
}

/* Passes whose pixels take about as long as one another's. */
static int pace_of(const struct gn_pass *pass) {
    if (pass->kind != GN_PASS_PICTURE) return pass->kind == GN_PASS_MAP ? 0 : 1;
    return pass->picture.blend == GN_BLEND_OFF ? 2 : 3;
}

/* Pixels of an instance, if it covers all of the target; those without geometry, as the rectangles
 * of a text, do so together. */
static double pixels_of(const struct gn_gl *gl, const struct gn_pass *pass,
                        const struct gn_draw *d) {
    const double target_px = (double)pass->target.width_px * pass->target.height_px;
    if (d->geometry == GN_NO_GEOMETRY) return target_px / d->instance_count;
    const struct gn_geometry *g = &gl->scene.scene->geometries[d->geometry];
    const double corners = gn_draw_corners(gl->scene.scene, gl->scene.detail, d).count;
    double layers = (double)fmaxf(fmaxf(g->layers[0], g->layers[1]), g->layers[2]);
    if (layers == 0) layers = corners / 3; /* posed ones may have an area */
    return layers * target_px + CORNER_PX * corners;
}

static bool end_piece(struct gn_gl *gl, int pace, struct gn_err *err) {
    struct gn_gl_pieces *p = &gl->pieces;
    const GLsync fence = GL(gl, FenceSync)(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    GLenum state;
    bool goes_on;
    do {
        state = GL(gl, ClientWaitSync)(fence, GL_SYNC_FLUSH_COMMANDS_BIT, (GLuint64)POLL_NS);
        p->done += state != GL_TIMEOUT_EXPIRED;
        goes_on = p->pause(p->user, p->done, gn_clock_monotonic_ns() - p->run_ns, err);
    } while (goes_on && state == GL_TIMEOUT_EXPIRED);
    GL(gl, DeleteSync)(fence);
    const int64_t now_ns = gn_clock_monotonic_ns(), took_ns = now_ns - p->begun_ns;
    const double scale = fmin(fmax((double)PIECE_NS / (double)(took_ns + 1), SHRINK), GROWTH);
    p->most_px[pace] = fmax(scale * p->most_px[pace], LEAST_PX);
    p->begun_ns = now_ns;
    p->used = 0;
    return goes_on;
}

bool gn_gl_pause_after(struct gn_gl *gl, int64_t begun_ns, struct gn_err *err) {
    struct gn_gl_pieces *p = &gl->pieces;
    const int64_t now_ns = p->pause ? gn_clock_monotonic_ns() : 0;
    return !p->pause || now_ns - begun_ns < POLL_NS ||
           p->pause(p->user, ++p->done, now_ns - p->run_ns, err);
}

bool gn_gl_draw_in_pieces(struct gn_gl *gl, const struct gn_pass *pass, const struct gn_draw *d,
                          uint64_t constants_hash, struct gn_err *err) {
    struct gn_gl_pieces *p = &gl->pieces;
    const int pace = pace_of(pass);
    const double each_px = p->pause ? pixels_of(gl, pass, d) : 0;
    const uint32_t corners = d->geometry == GN_NO_GEOMETRY
                                 ? d->vertex_count
                                 : gn_draw_corners(gl->scene.scene, gl->scene.detail, d).count;
    struct gn_draw part = *d;
    for (uint32_t i = 0; i < d->instance_count; i += part.instance_count) {
        const double room = p->pause ? (1 - p->used) * p->most_px[pace] / each_px : INFINITY;
        const uint32_t left = d->instance_count - i;
        part.first_instance = d->first_instance + i;
        part.instance_count = room < left ? room > 1 ? (uint32_t)room : 1 : left;
        /* one that is more than a piece by its triangles; pieces grow meanwhile */
        for (uint32_t first = 0, count; first < corners; first += count) {
            const double each = p->pause ? each_px / p->most_px[pace] : 0,
                         most = each > 1 ? 3 * ceil(corners / (3 * each)) : corners;
            count = most < corners - first ? (uint32_t)most : corners - first;
            gn_gl_draw(gl, pass, &part, constants_hash, first, count);
            p->used += each * part.instance_count * count / corners;
            if (p->used >= 1 && !end_piece(gl, pace, err)) return false;
        }
    }
    return true;
}
