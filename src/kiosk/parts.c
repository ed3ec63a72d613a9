#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "kiosk/part.h"

/* Calls that function of each row that has it and is open. */
#define CALL_EACH(parts, function, ...)                                                            \
    for (int i = 0; i < GN_PART_COUNT; i++)                                                        \
        if ((parts)->is_open[i] && (parts)->rows[i]->function)                                     \
    (parts)->rows[i]->function(__VA_ARGS__)

/* ---- one ------------------------------------------------------------------------------------- */

static void clear_part(struct gn_parts *p, int part) {
    memset(p->of[part], 0, p->rows[part]->size);
    *(const struct gn_part_host **)p->of[part] = &p->host;
    p->is_open[part] = false;
}

void gn_part_open(struct gn_parts *p, int part) {
    p->is_open[part] = true;
    if (p->rows[part]->open) p->rows[part]->open(p->of[part]);
}

void gn_part_close(struct gn_parts *p, int part) {
    if (!p->is_open[part]) return;
    if (p->rows[part]->close) p->rows[part]->close(p->of[part]);
    clear_part(p, part);
}

/* ---- all ------------------------------------------------------------------------------------- */

void gn_parts_create(struct gn_parts *p) {
    for (int i = 0; i < GN_PART_COUNT; i++) {
        p->of[i] = gn_xalloc(1, p->rows[i]->size);
        clear_part(p, i);
    }
}

void gn_parts_destroy(struct gn_parts *p) {
    for (int i = GN_PART_COUNT; i-- > 0;) {
        gn_part_close(p, i);
        free(p->of[i]);
    }
}

void gn_parts_begin(struct gn_parts *p) {
    for (int i = 0; i < GN_PART_COUNT; i++) {
        if (!p->rows[i]->begin) continue;
        p->is_open[i] = true;
        p->rows[i]->begin(p->of[i]);
    }
}

void gn_parts_open(struct gn_parts *p) {
    for (int i = 0; i < GN_PART_COUNT; i++) gn_part_open(p, i);
}

void gn_parts_reopen(struct gn_parts *p) { CALL_EACH(p, reopen, p->of[i]); }

void gn_parts_loaded(struct gn_parts *p, enum gn_part_load what) {
    CALL_EACH(p, loaded, p->of[i], what);
}

void gn_parts_add_screen(const struct gn_parts *p, struct gn_screen_opts *opts) {
    CALL_EACH(p, add_screen, p->of[i], opts);
}

void gn_parts_look(struct gn_parts *p) { CALL_EACH(p, look, p->of[i]); }

void gn_parts_step(struct gn_parts *p) { CALL_EACH(p, step, p->of[i]); }

void gn_parts_end(struct gn_parts *p) { CALL_EACH(p, end, p->of[i]); }

/* ---- of frames ------------------------------------------------------------------------------- */

int64_t gn_parts_due_ns(const struct gn_parts *p) {
    int64_t at_ns = INT64_MAX;
    for (int i = 0; i < GN_PART_COUNT; i++) {
        if (!p->is_open[i] || !p->rows[i]->due_ns) continue;
        const int64_t its_ns = p->rows[i]->due_ns(p->of[i]);
        if (its_ns < at_ns) at_ns = its_ns;
    }
    return at_ns;
}

bool gn_parts_want_frame(const struct gn_parts *p) {
    for (int i = 0; i < GN_PART_COUNT; i++)
        if (p->is_open[i] && p->rows[i]->wants_frame && p->rows[i]->wants_frame(p->of[i]))
            return true;
    return false;
}

void gn_parts_add_frame(struct gn_parts *p, struct gn_frame_opts *opts) {
    CALL_EACH(p, add_frame, p->of[i], opts);
}

void gn_parts_drawn(struct gn_parts *p, int64_t draw_ns) { CALL_EACH(p, drawn, p->of[i], draw_ns); }

bool gn_parts_pause(struct gn_parts *p, uint64_t pieces, int64_t run_ns, struct gn_err *err) {
    bool ok = true;
    for (int i = 0; ok && i < GN_PART_COUNT; i++)
        if (p->is_open[i] && p->rows[i]->pause)
            ok = p->rows[i]->pause(p->of[i], pieces, run_ns, err);
    return ok;
}

/* ---- what they tell -------------------------------------------------------------------------- */

void gn_parts_add_info(struct gn_parts *p, struct gn_info *info) {
    for (int i = 0; i < GN_PART_COUNT; i++)
        if (p->is_open[i] && p->rows[i]->add_info) p->rows[i]->add_info(p->of[i], info);
}

json_t *gn_parts_status(struct gn_parts *p, bool brief) {
    json_t *all = json_object();
    for (int i = 0; i < GN_PART_COUNT; i++) {
        const struct gn_part *row = p->rows[i];
        const void *values = p->is_open[i] && row->status ? row->status(p->of[i]) : NULL;
        if (values) gn_metrics_put(row->metrics, row->metric_count, values, brief, all);
    }
    return all;
}
