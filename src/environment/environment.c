#include "environment/environment.h"

#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "environment/private.h"
#include "image/read.h"

/* ---- making one ---- */

static void make_light(const struct gn_sphere *sphere, int threads,
                       struct gn_environment_light *out) {
    gn_sphere_prefilter(sphere, threads, out->texels);
    gn_sphere_harmonics(sphere, out->harmonics);
}

float gn_environment_key_share(float roughness) { return roughness * roughness; }

/* The light of a texel is a sum over the sphere, so that shares of it can be mixed. */
static void make_shown(struct gn_environment *environment) {
    const uint32_t *whole = environment->whole.texels, *rest = environment->rest.texels;
    uint32_t *to = environment->shown.texels;
    int i = 0;
    environment->shown = environment->rest;
    for (int level = 0; level < GN_ENVIRONMENT_LEVELS; level++) {
        const float taken = gn_environment_key_share((float)level / (GN_ENVIRONMENT_LEVELS - 1));
        const int side = GN_ENVIRONMENT_PX >> level, end = i + 6 * side * side;
        for (; i < end; i++) {
            float with[3], without[3];
            if (taken <= 0.0f) to[i] = whole[i];
            if (taken <= 0.0f || taken >= 1.0f) continue;
            gn_environment_unpack(whole[i], with);
            gn_environment_unpack(rest[i], without);
            for (int k = 0; k < 3; k++) with[k] += taken * (without[k] - with[k]);
            to[i] = gn_environment_pack(with);
        }
    }
}

void gn_environment_make(struct gn_sphere *sphere, int threads, struct gn_environment *out) {
    gn_sphere_complete(sphere);
    make_light(sphere, threads, &out->whole);
    gn_sphere_take_key(sphere, &out->key);
    make_light(sphere, threads, &out->rest);
    make_shown(out);
}

struct picture {
    const struct gn_environment_work *work;
    struct gn_sphere *sphere;
    uint32_t px[2];
    float (*row)[3];
};

static void add_picture_row(void *user, uint32_t y, const uint8_t *rgbe) {
    const struct picture *p = user;
    for (uint32_t x = 0; x < p->px[0]; x++) gn_hdr_color(rgbe + 4 * x, p->row[x]);
    gn_sphere_add_row(p->sphere, y, p->px, (const float(*)[3])p->row);
    if (p->work->progress) p->work->progress(p->work->user, (y + 1.0) / p->px[1]);
}

bool gn_environment_read_hdr(const uint8_t *data, size_t size,
                             const struct gn_environment_work *work, struct gn_environment *out,
                             struct gn_err *err) {
    struct picture p = {.work = work};
    if (!gn_hdr_size(data, size, p.px, err)) return false;
    p.sphere = gn_sphere_create();
    p.row = gn_xalloc(p.px[0], sizeof *p.row);
    const bool ok = gn_hdr_read(data, size, add_picture_row, &p, err);
    if (ok) gn_environment_make(p.sphere, work->threads, out);
    free(p.row);
    gn_sphere_destroy(p.sphere);
    return ok;
}

/* ---- kept: a name with the version, words in little-endian order, a hash of all before ---- */

static const char name[8] = "GNENV 1";
enum { WORDS = offsetof(struct gn_environment, shown) / 4 };
_Static_assert(sizeof(struct gn_environment) % 4 == 0, "words");

void gn_environment_write(const struct gn_environment *environment,
                          uint8_t out[GN_ENVIRONMENT_FILE_BYTES]) {
    memcpy(out, name, 8);
    for (int i = 0; i < WORDS; i++) {
        uint32_t word;
        memcpy(&word, (const char *)environment + 4 * i, 4);
        for (int k = 0; k < 4; k++) out[8 + 4 * i + k] = (uint8_t)(word >> 8 * k);
    }
    const uint64_t hash = gn_hash(GN_HASH_INIT, out, GN_ENVIRONMENT_FILE_BYTES - 8);
    for (int k = 0; k < 8; k++) out[GN_ENVIRONMENT_FILE_BYTES - 8 + k] = (uint8_t)(hash >> 8 * k);
}

bool gn_environment_read(const uint8_t *data, size_t size, struct gn_environment *out) {
    if (size != GN_ENVIRONMENT_FILE_BYTES || memcmp(data, name, 8) != 0) return false;
    const uint64_t hash = gn_hash(GN_HASH_INIT, data, GN_ENVIRONMENT_FILE_BYTES - 8);
    for (int k = 0; k < 8; k++)
        if (data[GN_ENVIRONMENT_FILE_BYTES - 8 + k] != (uint8_t)(hash >> 8 * k)) return false;
    for (int i = 0; i < WORDS; i++) {
        uint32_t word = 0;
        for (int k = 0; k < 4; k++) word |= (uint32_t)data[8 + 4 * i + k] << 8 * k;
        memcpy((char *)out + 4 * i, &word, 4);
    }
    make_shown(out);
    return true;
}
