/* Common entry of all calls: counting, fault injection and incidents between calls. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim_state.h"

static struct {
    enum sim_op op;
    long nth;
    int burst, error;
    uint64_t random;
    unsigned often;
    enum sim_incident incident;
    long incident_at; /* 0: none pending */
    int64_t pass_ns;
    int card, connector, monitor; /* affected by the incident */
} plan;
static bool traced;

void sim_call_reset(void) {
    memset(&plan, 0, sizeof plan);
    plan.pass_ns = INT64_MAX;
}

/* ---- faults ---- */

static const char *const op_names[SIM_OPS] = {
#define X(name) [SIM_##name] = "drm" #name,
    GN_DRM_TABLE(X)
#undef X
        [SIM_list] = "readdir",
    [SIM_open] = "open",
    [SIM_map] = "mmap",
    [SIM_gl_open] = "gbm_create_device",
    [SIM_gl_surface] = "gbm_surface_create",
    [SIM_gl_swap] = "eglSwapBuffers",
};
static const char *const incident_names[SIM_INCIDENTS] = {
    [SIM_CARD_GOES] = "card lost",
    [SIM_MONITOR_GOES] = "monitor unplugged",
    [SIM_MONITOR_CHANGES] = "other monitor plugged",
    [SIM_MASTER_GOES] = "master lost",
    [SIM_LINK_GOES_BAD] = "bad link",
};

enum { ERRORS = 12 };
#define COMMITS                                                                                    \
    { EBUSY, EACCES, EPERM, EINVAL, ENOMEM, ENODEV, EIO, EINTR, ENOSPC, ENOENT, ERANGE }
#define LOOKUPS                                                                                    \
    { ENOENT, ENOMEM, ENODEV, EINVAL }
static const int errors[SIM_OPS][ERRORS] = {
    [SIM_GetVersion] = {ENOMEM, ENODEV},
    [SIM_GetCap] = {EINVAL, ENODEV},
    [SIM_SetClientCap] = {EINVAL, EOPNOTSUPP, ENODEV},
    [SIM_SetMaster] = {EACCES, EPERM, EBUSY, EINVAL, ENODEV},
    [SIM_DropMaster] = {EINVAL, ENODEV},
    [SIM_HandleEvent] = {EINTR, EAGAIN, EIO, ENODEV},
    [SIM_CrtcGetSequence] = {EOPNOTSUPP, EINVAL, ENODEV},
    [SIM_Ioctl] = {ENOMEM, EINVAL, ENOSPC, EACCES, ENODEV, EIO},
    [SIM_ModeGetResources] = {ENOMEM, EINVAL, EOPNOTSUPP, ENODEV},
    [SIM_ModeGetConnector] = LOOKUPS,
    [SIM_ModeGetConnectorCurrent] = LOOKUPS,
    [SIM_ModeGetEncoder] = LOOKUPS,
    [SIM_ModeGetCrtc] = LOOKUPS,
    [SIM_ModeSetCrtc] = COMMITS,
    [SIM_ModeSetCursor] = {ENXIO, EACCES, EINVAL, ENODEV},
    [SIM_ModePageFlip] = COMMITS,
    [SIM_ModeGetPlaneResources] = {ENOMEM, EOPNOTSUPP, ENODEV},
    [SIM_ModeGetPlane] = LOOKUPS,
    [SIM_ModeObjectGetProperties] = LOOKUPS,
    [SIM_ModeGetProperty] = LOOKUPS,
    [SIM_ModeGetPropertyBlob] = LOOKUPS,
    [SIM_ModeCreatePropertyBlob] = {ENOMEM, EINVAL, ENODEV, EACCES},
    [SIM_ModeDestroyPropertyBlob] = {ENOENT, EPERM, ENODEV},
    [SIM_ModeConnectorSetProperty] = {EACCES, EINVAL, ENODEV},
    [SIM_ModeAtomicAlloc] = {ENOMEM},
    [SIM_ModeAtomicAddProperty] = {ENOMEM},
    [SIM_ModeAtomicCommit] = COMMITS,
    [SIM_ModeAddFB2] = {EINVAL, ENOMEM, ENOENT, ENODEV, EACCES},
    [SIM_ModeAddFB2WithModifiers] = {EINVAL, ENOMEM, ENOENT, ENODEV, EACCES},
    [SIM_ModeRmFB] = {ENOENT, EINVAL, ENODEV},
    [SIM_list] = {ENOENT},
    [SIM_open] = {EACCES, EPERM, ENOENT, ENODEV, EMFILE, ENOMEM, EBUSY, EINTR, ENXIO, EIO},
    [SIM_map] = {ENOMEM, EACCES, ENODEV},
    [SIM_gl_open] = {ENODEV},
    [SIM_gl_surface] = {EINVAL},
    [SIM_gl_swap] = {EIO},
};

const char *sim_op_name(enum sim_op op) { return op_names[op]; }
const int *sim_op_errors(enum sim_op op) { return errors[op]; }
const char *sim_incident_name(enum sim_incident what) { return incident_names[what]; }

void sim_fail(enum sim_op op, long nth, int burst, int error) {
    plan.op = op;
    plan.nth = nth > 0 ? sim_counts.calls[op] + nth : 0;
    plan.burst = burst;
    plan.error = error;
}

void sim_fail_often(uint64_t seed, unsigned often) {
    plan.random = seed | 1;
    plan.often = often;
}

static uint64_t next_random(void) { /* xorshift64* */
    plan.random ^= plan.random >> 12;
    plan.random ^= plan.random << 25;
    plan.random ^= plan.random >> 27;
    return plan.random * UINT64_C(2685821657736338717) >> 32;
}

static int error_by_chance(enum sim_op op) {
    if (plan.often == 0 || next_random() % plan.often != 0) return 0;
    int count = 0;
    while (count < ERRORS && errors[op][count]) count++;
    return count > 0 ? errors[op][next_random() % (unsigned)count] : 0;
}

static int error_of(enum sim_op op) {
    const long n = sim_counts.calls[op];
    if (plan.nth > 0 && plan.op == op && n >= plan.nth && n < plan.nth + plan.burst)
        return plan.error;
    return error_by_chance(op);
}

/* ---- incidents ---- */

void sim_happen(enum sim_incident what, long nth) {
    plan.incident = what;
    plan.incident_at = nth > 0 ? sim_counts.all_calls + nth : 0;
}

static void happen(int card, int connector) {
    plan.card = card, plan.connector = connector;
    plan.monitor = sim.cards[card].plugged[connector];
    switch (plan.incident) {
    case SIM_CARD_GOES: sim_lose_card(card); break;
    case SIM_MONITOR_GOES: sim_plug(card, connector, SIM_NO_MONITOR); break;
    case SIM_MONITOR_CHANGES: sim_plug(card, connector, SIM_SMALL); break;
    case SIM_MASTER_GOES: sim_stranger_takes(card); break;
    case SIM_LINK_GOES_BAD: sim_break_link(card, connector); break;
    case SIM_INCIDENTS: break;
    }
    plan.pass_ns = sim.now_ns + 2 * SIM_S;
}

/* Affects the first card and its first monitor. */
static void happen_somewhere(void) {
    plan.incident_at = 0;
    for (int n = 0; n < SIM_CARDS; n++)
        for (int i = 0; sim.cards[n].present && i < SIM_CONNECTORS; i++) {
            if (!sim.cards[n].plugged[i]) continue;
            happen(n, i);
            return;
        }
}

int64_t sim_call_next(void) { return plan.pass_ns; }

void sim_call_pass(void) {
    plan.pass_ns = INT64_MAX;
    switch (plan.incident) {
    case SIM_CARD_GOES: sim_return_card(plan.card, NULL); break;
    case SIM_MONITOR_GOES: sim_plug(plan.card, plan.connector, plan.monitor); break;
    case SIM_MASTER_GOES: sim_stranger_leaves(plan.card, false); break;
    default: break;
    }
}

/* ---- calls ---- */

void sim_trace(bool on) { traced = on; }

bool sim_fails(enum sim_op op) {
    sim_counts.calls[op]++;
    sim_counts.all_calls++;
    if (plan.incident_at > 0 && sim_counts.all_calls >= plan.incident_at) happen_somewhere();
    const int error = error_of(op);
    if (traced)
        printf("%6ld %9.3f s  %s%s%s\n", sim_counts.all_calls, (double)sim.now_ns / 1e9,
               op_names[op], error ? ": " : "", error ? strerrorname_np(error) : "");
    if (error == 0) return false;
    sim_counts.failed++;
    errno = error;
    return true;
}

struct sim_file *sim_find_file(int fd) {
    for (int i = 0; i < SIM_FILES; i++)
        if (sim.files[i].fd == fd) return &sim.files[i];
    return NULL;
}

int sim_index_of(const struct sim_file *file) { return (int)(file - sim.files); }

/* NULL if the card is gone, even if another one has its place. */
struct sim_card *sim_card_of(const struct sim_file *file) {
    struct sim_card *card = &sim.cards[file->card];
    return card->present && card->life == file->life ? card : NULL;
}

struct sim_file *sim_enter(enum sim_op op, int fd) {
    const bool fails = sim_fails(op);
    const int error = errno;
    struct sim_file *file = fd >= SIM_FIRST_FD ? sim_find_file(fd) : NULL;
    if (!file) {
        sim_complain("%s on closed descriptor %d", op_names[op], fd);
        errno = EBADF;
        return NULL;
    }
    errno = fails ? error : ENODEV;
    return fails || !sim_card_of(file) ? NULL : file;
}

/* ---- libdrm's structs ---- */

enum { MAGIC = 0x51ac0ffe };
struct reply {
    _Alignas(16) uint32_t magic;
    _Alignas(16) char bytes[];
};

void *sim_reply(size_t size) {
    struct reply *reply = calloc(1, sizeof *reply + size);
    if (!reply) abort();
    reply->magic = MAGIC;
    sim_counts.replies++;
    return reply->bytes;
}

void sim_reply_free(void *bytes) {
    if (!bytes) return;
    struct reply *reply = (struct reply *)((char *)bytes - offsetof(struct reply, bytes));
    if (reply->magic != MAGIC) {
        sim_complain("libdrm struct freed twice");
        return;
    }
    reply->magic = 0;
    sim_counts.replies--;
    free(reply);
}
