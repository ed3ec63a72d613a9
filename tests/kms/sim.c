/* The simulated machine: cards, monitors, other programs and the clock. */
#include "sim.h"

#include <dirent.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "sim_state.h"

struct sim_world sim;
struct sim_counts sim_counts;
struct gn_drm_ops sim_drm;
static char first_complaint[200];
static int fds_before;

/* ---- complaints ---- */

void sim_complain(const char *format, ...) {
    va_list args;
    va_start(args, format);
    if (sim_counts.complaints++ == 0)
        vsnprintf(first_complaint, sizeof first_complaint, format, args);
    va_end(args);
}

const char *sim_complaint(void) { return sim_counts.complaints > 0 ? first_complaint : ""; }

/* ---- begin and end ---- */

static int open_descriptors(void) {
    DIR *folder = opendir("/proc/self/fd");
    int count = 0;
    while (folder && readdir(folder)) count++;
    if (folder) closedir(folder);
    return count;
}

static void drop_objects(struct sim_card *card) {
    for (int i = 0; i < SIM_CRTCS; i++) {
        struct sim_crtc *c = &card->crtcs[i];
        if (c->shown) sim_fb_unref(c->shown);
        if (c->flip.fb) sim_fb_unref(c->flip.fb);
        memset(c, 0, sizeof *c);
    }
    for (int i = 0; i < SIM_FBS; i++)
        if (card->fbs[i].id) {
            card->fbs[i].id = 0;
            sim_fb_unref(&card->fbs[i]);
        }
    for (int i = 0; i < SIM_BLOBS; i++)
        if (card->blobs[i].id) {
            card->blobs[i].id = 0;
            sim_counts.blobs--;
        }
}

void sim_begin(void) {
    for (int i = 0; i < SIM_FILES; i++)
        if (sim.files[i].fd) sim_file_close(&sim.files[i]);
    for (int i = 0; i < SIM_CARDS; i++) drop_objects(&sim.cards[i]);
    memset(&sim, 0, sizeof sim);
    memset(&sim_counts, 0, sizeof sim_counts);
    sim.now_ns = 100 * SIM_S;
    sim.next_fd = SIM_FIRST_FD;
    sim_call_reset();
    sim_gl_reset();
    sim_fill_read(&sim_drm);
    sim_fill_commit(&sim_drm);
    sim_fill_memory(&sim_drm);
    fds_before = open_descriptors();
}

int sim_end(void) {
    for (int i = 0; i < SIM_CARDS; i++) drop_objects(&sim.cards[i]);
    const struct {
        const char *what;
        int count;
    } alive[] = {
        {"open cards", sim_counts.files},
        {"framebuffers", sim_counts.fbs},
        {"blobs", sim_counts.blobs},
        {"buffers", sim_counts.buffers},
        {"dumb buffers", sim_counts.dumbs},
        {"mappings", sim_counts.maps},
        {"libdrm structs", sim_counts.replies},
        {"descriptors", open_descriptors() - fds_before},
    };
    for (size_t i = 0; i < sizeof alive / sizeof *alive; i++)
        if (alive[i].count != 0) sim_complain("%d %s leaked", alive[i].count, alive[i].what);
    return sim_counts.complaints;
}

static void start_card(struct sim_card *card) {
    const int n = (int)(card - sim.cards);
    card->present = true;
    card->life++;
    card->base = (uint32_t)(n + 1) * 100000 + card->life * 1000;
    card->next_id = card->base + 100;
    card->master = SIM_NOBODY;
    memset(&card->state, 0, sizeof card->state);
    for (int i = 0; i < SIM_CONNECTORS; i++) card->state.connectors[i].crtc = -1;
    for (int i = 0; i < SIM_PLANES; i++) {
        card->state.planes[i].crtc = -1;
        card->state.planes[i].rotation = DRM_MODE_ROTATE_0;
    }
    memcpy(card->known, card->plugged, sizeof card->known);
    for (int i = 0; i < SIM_CONNECTORS && card->traits.range; i++)
        card->state.connectors[i].range = SIM_RANGE_LIMITED; /* as somebody has left it */
    if (card->traits.console) sim_set_console(card, SIM_CONSOLE);
}

void sim_add_card(int n, const char *path, const struct sim_traits *traits) {
    struct sim_card *card = &sim.cards[n];
    card->there = true;
    card->traits = *traits;
    snprintf(card->path, sizeof card->path, "%s", path);
    snprintf(card->place, sizeof card->place, "platform-gpu%d", n);
    start_card(card);
    sim.uevent = true;
}

uint64_t sim_range(int n) { return sim.cards[n].state.connectors[0].range; }

void sim_set_gpu(const struct sim_gpu *gpu) { sim.gpu = *gpu; }

void sim_refuse_mode(struct sim_refusal refusal) {
    if (sim.refusal_count < SIM_BROKEN) sim.refusals[sim.refusal_count++] = refusal;
}

void sim_allow_modes(void) { sim.refusal_count = 0; }

/* ---- events ---- */

void sim_plug(int n, int connector, int kind) {
    struct sim_card *card = &sim.cards[n];
    card->plugged[connector] = kind;
    if (!card->present) return;
    sim.uevent = true;
    if (card->traits.console && card->master == SIM_NOBODY) sim_set_console(card, SIM_CONSOLE);
}

void sim_break_link(int n, int connector) {
    sim.cards[n].state.connectors[connector].bad_link = true;
    sim.uevent = true;
}

void sim_lose_card(int n) {
    struct sim_card *card = &sim.cards[n];
    if (!card->present) return;
    card->present = false;
    card->master = SIM_NOBODY;
    drop_objects(card);
    sim.uevent = true;
}

void sim_return_card(int n, const char *path) {
    struct sim_card *card = &sim.cards[n];
    if (card->present || !card->there) return;
    if (path) snprintf(card->path, sizeof card->path, "%s", path);
    start_card(card);
    sim.uevent = true;
}

void sim_stall(int n, enum sim_stall how) {
    struct sim_card *card = &sim.cards[n];
    for (int i = 0; i < SIM_CRTCS; i++) {
        struct sim_flip *flip = &card->crtcs[i].flip;
        card->crtcs[i].stall = how;
        if (!flip->pending) continue;
        if (how == SIM_FLOWS && flip->done_ns == INT64_MAX) flip->done_ns = sim.now_ns + 5 * SIM_MS;
        if (sim_is_stalled(&card->crtcs[i])) flip->done_ns = INT64_MAX;
    }
}

/* A new owner of the CRTCs waits for the flip until the kernel's timeout. */
static void take_over(struct sim_card *card, int owner) {
    for (int i = 0; i < SIM_CRTCS; i++)
        if (card->crtcs[i].flip.pending) sim_finish_flip(card, i);
    sim_set_console(card, owner);
}

void sim_console_takes(int n) {
    struct sim_card *card = &sim.cards[n];
    if (!card->present || card->master != SIM_NOBODY) return;
    if (card->traits.console) take_over(card, SIM_CONSOLE);
}

void sim_stranger_takes(int n) {
    struct sim_card *card = &sim.cards[n];
    if (!card->present) return;
    card->master = SIM_STRANGER;
    take_over(card, SIM_STRANGER);
}

void sim_stranger_leaves(int n, bool dark) {
    struct sim_card *card = &sim.cards[n];
    if (card->master != SIM_STRANGER) return;
    card->master = SIM_NOBODY;
    for (int i = 0; dark && i < SIM_FBS; i++)
        if (card->fbs[i].id && card->fbs[i].file == SIM_STRANGER)
            sim_fb_remove(card, &card->fbs[i]);
}

/* ---- time ---- */

int64_t sim_now(void) { return sim.now_ns; }

static int64_t next_flip(int *out_card, int *out_crtc) {
    int64_t at_ns = INT64_MAX;
    for (int n = 0; n < SIM_CARDS; n++)
        for (int i = 0; i < SIM_CRTCS; i++) {
            const struct sim_flip *flip = &sim.cards[n].crtcs[i].flip;
            if (!flip->pending || flip->done_ns >= at_ns) continue;
            at_ns = flip->done_ns;
            *out_card = n, *out_crtc = i;
        }
    return at_ns;
}

static int64_t late_ns(void) { return sim.late.flip.pending ? sim.late.flip.done_ns : INT64_MAX; }

int64_t sim_next(void) {
    int card, crtc;
    int64_t at_ns = next_flip(&card, &crtc);
    if (sim_call_next() < at_ns) at_ns = sim_call_next();
    return late_ns() < at_ns ? late_ns() : at_ns;
}

void sim_run_to(int64_t ns) {
    int card = 0, crtc = 0;
    for (int64_t at_ns; (at_ns = sim_next()) <= ns;) {
        if (at_ns > sim.now_ns) sim.now_ns = at_ns;
        if (sim_call_next() <= at_ns)
            sim_call_pass();
        else if (late_ns() <= at_ns)
            sim_tell_late();
        else if (next_flip(&card, &crtc) <= at_ns)
            sim_finish_flip(&sim.cards[card], crtc);
    }
    if (ns > sim.now_ns) sim.now_ns = ns;
}

bool sim_readable(int fd) {
    const struct sim_file *file = fd > 0 ? sim_find_file(fd) : NULL;
    return file && file->event_count > 0;
}

bool sim_take_uevent(void) {
    const bool was = sim.uevent;
    sim.uevent = false;
    return was;
}

/* ---- what is visible ---- */

static bool is_listed(int monitor, const drmModeModeInfo *mode) {
    drmModeModeInfo modes[SIM_MODES];
    const int count = sim_monitor_modes(monitor, modes);
    for (int i = 0; i < count; i++)
        if (modes[i].hdisplay == mode->hdisplay && modes[i].vdisplay == mode->vdisplay &&
            modes[i].clock == mode->clock)
            return true;
    return false;
}

static uint32_t colour_of(const struct sim_bo *bo) {
    uint32_t colour = bo->colour;
    if (bo->pixels) memcpy(&colour, bo->pixels, sizeof colour);
    return colour;
}

/* The plane reads what was painted, and nothing else. A flip that is pending is not visible yet. */
static bool reads_painted(const struct sim_card *card, int crtc) {
    const struct sim_plane_state *p = &card->state.planes[crtc];
    const struct sim_bo *bo = card->crtcs[crtc].shown->bo;
    const uint64_t width = bo->painted[0] ? bo->painted[0] : bo->width_px,
                   height = bo->painted[1] ? bo->painted[1] : bo->height_px;
    return card->crtcs[crtc].flip.pending ||
           (p->src[0] == 0 && p->src[1] == (bo->height_px - height) << 16 &&
            p->src[2] == width << 16 && p->src[3] == height << 16);
}

static bool connector_shows(const struct sim_card *card, int i, uint32_t colour) {
    const struct sim_connector_state *c = &card->state.connectors[i];
    if (!card->plugged[i] || c->crtc < 0 || c->bad_link || c->asleep) return false;
    if (card->state.planes[c->crtc].rotation != DRM_MODE_ROTATE_0) return false;
    const struct sim_crtc_state *crtc = &card->state.crtcs[c->crtc];
    const struct sim_fb *shown = card->crtcs[c->crtc].shown;
    if (!crtc->active || !shown || !is_listed(card->plugged[i], &crtc->mode)) return false;
    for (int p = SIM_CRTCS; p < SIM_PLANES; p++) /* an overlay covers it */
        if (card->state.planes[p].crtc == c->crtc) return false;
    return colour_of(shown->bo) == colour && reads_painted(card, c->crtc);
}

bool sim_shows(uint32_t colour) {
    for (int n = 0; n < SIM_CARDS; n++)
        for (int i = 0; sim.cards[n].present && i < SIM_CONNECTORS; i++)
            if (connector_shows(&sim.cards[n], i, colour)) return true;
    return false;
}

bool sim_is_dark(void) {
    for (int n = 0; n < SIM_CARDS; n++)
        for (int i = 0; sim.cards[n].present && i < SIM_CONNECTORS; i++) {
            const struct sim_card *card = &sim.cards[n];
            const struct sim_connector_state *c = &card->state.connectors[i];
            if (card->plugged[i] && c->crtc >= 0 && !c->asleep && card->state.crtcs[c->crtc].active)
                return false;
        }
    return true;
}

bool sim_shows_console(int n) {
    const struct sim_card *card = &sim.cards[n];
    for (int i = 0; i < SIM_CRTCS; i++)
        if (card->state.crtcs[i].active && card->crtcs[i].shown &&
            card->crtcs[i].shown->file == SIM_CONSOLE)
            return true;
    return false;
}

bool sim_is_master(int fd) {
    const struct sim_file *file = fd > 0 ? sim_find_file(fd) : NULL;
    return file && sim_card_of(file) && sim_card_of(file)->master == sim_index_of(file);
}
