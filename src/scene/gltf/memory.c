/* Allocation for a load, within the limit memory_mb; what pictures take, within theirs. */
#include "scene/private.h"

#include <inttypes.h>
#include <string.h>

static uint64_t used_bytes(const struct gn_gltf *g) {
    return (uint64_t)g->memory.scene->used + g->memory.load.used + g->memory.step.used +
           g->memory.other_bytes;
}

size_t gn_gltf_room(const struct gn_gltf *g) {
    uint64_t limit = g->limits.memory_mb << 20, used = used_bytes(g);
    return used < limit ? (size_t)(limit - used) : 0;
}

/* With so many more for a while. */
static void note_most(struct gn_gltf *g, uint64_t more) {
    const size_t used = (size_t)(used_bytes(g) + more);
    if (used > g->memory.most_bytes) g->memory.most_bytes = used;
}

void *gn_gltf_alloc(struct gn_gltf *g, struct gn_arena *arena, uint64_t count, size_t size) {
    if (g->failed) return NULL;
    uint64_t bytes = 0;
    void *memory = NULL;
    const bool fits = !__builtin_mul_overflow(count, size, &bytes) && bytes <= gn_gltf_room(g);
    if (fits) memory = gn_arena_alloc(arena, (size_t)count, size);
    if (!fits && g->pictures.need_count > 0)
        gn_gltf_halve_pictures(g, "memory_mb", g->limits.memory_mb);
    if (!memory)
        gn_gltf_fail(g, NULL, "out of memory, or over the limit memory_mb=%" PRIu64,
                     g->limits.memory_mb);
    note_most(g, 0);
    return memory;
}

bool gn_gltf_count(struct gn_gltf *g, uint64_t bytes) {
    if (bytes > gn_gltf_room(g))
        return gn_gltf_fail(g, NULL, "out of memory, or over the limit memory_mb=%" PRIu64,
                            g->limits.memory_mb);
    g->memory.other_bytes += bytes;
    note_most(g, 0);
    return !g->failed;
}

char *gn_gltf_strdup(struct gn_gltf *g, const char *text) {
    size_t size = text ? strlen(text) + 1 : 1;
    char *copy = gn_gltf_alloc(g, g->memory.scene, size, 1);
    if (copy && text) memcpy(copy, text, size);
    return copy;
}

/* ---- pictures ---- */

/* Decoding takes time by texels, however small a picture is made, and by rows where these are
 * short: libpng visits each in up to seven passes. A row counts as so many texels more, and all
 * together are at most as many as in so many of the largest pictures, and so many more for each
 * byte read: files with many real pictures are large. */
enum { ROW_WORK = 256, LARGEST_PICTURES = 10, WORK_A_BYTE = 8 };

enum {
    LOADS_MAX = 2,  /* with pictures too large, for their sake, then for that of the GPU */
    LEAST_PX = 64,  /* no longer side gets smaller */
    FOLLOWING = 16, /* what is loaded after pictures gets one of so many shares of the memory */
};

uint32_t gn_gltf_halvings(const uint32_t px[2], uint32_t most_px) {
    const uint32_t longer = px[0] > px[1] ? px[0] : px[1];
    uint32_t level = 0;
    while (most_px > 0 && gn_level_px(longer, level) > most_px) level++;
    return level;
}

bool gn_gltf_halve_pictures(struct gn_gltf *g, const char *limit, uint64_t mb) {
    if (g->pictures.loads == LOADS_MAX) return false;
    if (!g->pictures.over) {
        g->pictures.over = limit;
        g->pictures.over_mb = mb;
    }
    return true;
}

/* With so many halvings. */
static uint64_t least_decoding(const struct gn_picture_need *whole, uint32_t level) {
    if (level == 0) return whole->decoding;
    return whole->halved[(level < GN_HALVINGS ? level : GN_HALVINGS) - 1];
}

static bool can_be_halved(const struct gn_picture_need *whole) { return whole->halved[0] > 0; }

/* Whether those noted are within memory_mb and decoded_mb, with longer sides within most_px. */
static bool all_fit(const struct gn_gltf *g, uint32_t most_px) {
    const uint64_t room = g->pictures.room - g->pictures.room / FOLLOWING;
    uint64_t kept = 0, on_gpu = 0;
    bool fit = true;
    for (size_t i = 0; i < g->pictures.need_count; i++) {
        const struct gn_picture_need *whole = &g->pictures.needs[i];
        const uint32_t level = can_be_halved(whole) ? gn_gltf_halvings(whole->px, most_px) : 0;
        const uint64_t decoding = least_decoding(whole, level);
        kept += whole->kept >> 2 * level;
        const uint64_t its_gpu = whole->on_gpu >> 2 * level;
        fit &= kept + on_gpu + (decoding > its_gpu ? decoding : its_gpu) <= room &&
               kept + decoding <= g->limits.decoded_mb << 20;
        on_gpu += its_gpu;
    }
    return fit;
}

uint32_t gn_gltf_fit_pictures(const struct gn_gltf *g) {
    const uint32_t most = g->limits.texture_px;
    uint32_t px = 0;
    if (!g->pictures.over || g->pictures.fit_px) return g->pictures.fit_px;
    for (size_t i = 0; i < g->pictures.need_count; i++)
        for (int k = 0; k < 2; k++)
            if (g->pictures.needs[i].px[k] > px) px = g->pictures.needs[i].px[k];
    if (most > 0 && most < px) px = most;
    do px = (px + 1) / 2;
    while (px > LEAST_PX && !all_fit(g, px));
    return px;
}

/* Notes what it takes, unless it cannot be shown at any size. */
static void note_need(struct gn_gltf *g, const struct gn_picture_need *whole, bool halves) {
    struct gn_gltf_pictures *p = &g->pictures;
    const bool fits = can_be_halved(whole)
                          ? halves
                          : whole->kept + whole->decoding < p->room &&
                                whole->kept + whole->decoding < g->limits.decoded_mb << 20;
    if (p->needs && p->need_count < g->file.image_count && fits) p->needs[p->need_count++] = *whole;
}

static void begin_needs(struct gn_gltf *g) {
    if (g->pictures.needs) return;
    g->pictures.room = gn_gltf_room(g);
    GN_NEW(g, &g->memory.load, g->pictures.needs, g->file.image_count);
}

uint64_t gn_gltf_picture_room(const struct gn_gltf *g) {
    const uint64_t room = gn_gltf_room(g), limit = g->limits.decoded_mb << 20;
    const uint64_t decoded = limit > g->decoded_bytes ? limit - g->decoded_bytes : 0;
    return decoded < room ? decoded : room;
}

/* False. Why, where the decoder cannot make it small enough. */
static bool fail_over(const struct gn_picture_need *whole, const char *what, struct gn_err *err) {
    const uint64_t mb = (least_decoding(whole, GN_HALVINGS) >> 20) + 1;
    if (!can_be_halved(whole)) return gn_fail(err, "%s", what);
    return gn_fail(err, "%s: at any size, decoding it takes %" PRIu64 " MB", what, mb);
}

static uint64_t most_work(const struct gn_gltf *g) {
    return LARGEST_PICTURES * g->limits.texels + WORK_A_BYTE * g->read_bytes;
}

static bool is_quick(const struct gn_gltf *g, uint64_t work, const uint32_t px[2],
                     struct gn_err *err) {
    return work <= most_work(g) ||
           gn_fail(err,
                   "not decoded: pictures of %s take too long: over %d times the limit "
                   "texels=%" PRIu64,
                   px[0] < ROW_WORK ? "narrow rows" : "so many texels", LARGEST_PICTURES,
                   g->limits.texels);
}

bool gn_gltf_picture_fits(struct gn_gltf *g, const struct gn_picture_need *need,
                          const struct gn_picture_need *whole, struct gn_err *err) {
    if (!is_quick(g, need->work, need->px, err)) return false;
    begin_needs(g);
    const uint64_t least = least_decoding(whole, GN_HALVINGS);
    const bool halves =
        can_be_halved(whole) && least < g->pictures.room && least < g->limits.decoded_mb << 20;
    note_need(g, whole, halves);
    if (g->failed || g->pictures.over) return false;
    /* the decoder's memory is free again before the GPU has the picture */
    const uint64_t more = need->decoding > need->on_gpu ? need->decoding : need->on_gpu;
    if (need->kept + more > gn_gltf_room(g))
        return !(halves && gn_gltf_halve_pictures(g, "memory_mb", g->limits.memory_mb)) &&
               fail_over(whole, "exceeds the limit memory_mb", err);
    if (g->decoded_bytes + need->kept + need->decoding > g->limits.decoded_mb << 20)
        return !(halves && gn_gltf_halve_pictures(g, "decoded_mb", g->limits.decoded_mb)) &&
               fail_over(whole, "not decoded: over the limit decoded_mb", err);
    if (!is_quick(g, g->decode_work + need->work, need->px, err)) return false;
    if (g->damaged_work > g->limits.texels)
        return gn_fail(err, "not decoded: damaged pictures have used up the limit texels=%" PRIu64,
                       g->limits.texels);
    note_most(g, need->kept + more);
    return true;
}

uint64_t gn_gltf_picture_time(const struct gn_gltf *g) {
    const uint64_t most = most_work(g);
    return g->decode_work < most ? most - g->decode_work : 0;
}

uint64_t gn_gltf_picture_work(const uint32_t px[2]) {
    return (uint64_t)px[0] * px[1] + (uint64_t)ROW_WORK * px[1];
}

void gn_gltf_picture_count(struct gn_gltf *g, const struct gn_picture_need *need) {
    g->decode_work += need->work;
    g->decoded_bytes += need->kept;
    g->memory.other_bytes += need->on_gpu;
}
