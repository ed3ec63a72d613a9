/* A program with a screen, as `gnomon show` is one, on the simulator's clock: it steps when it has
 * to, makes a new context when the old one is lost, and paints a new colour whenever it may, or, of
 * a still picture, when that has changed or is not seen. */
#ifndef GN_KMS_CLIENT_H
#define GN_KMS_CLIENT_H

#include "display/kms/kms.h"
#include "sim.h"

struct client {
    struct gn_screen_opts opts;
    struct gn_kms *kms;
    bool moves, changed, away, blank;
    unsigned heard;  /* events of the console, to be told */
    uint32_t colour; /* of the last frame presented */
    bool gave_up;    /* the screen did, at least once; a new process has begun */
    long frames, steps, restarts;
    int64_t told_ns; /* the time that the screen was last told */
    int64_t now_ns;  /* the last step's */
    int spins;       /* steps at that time */
};

/* A machine to run it on, with the name that complaints have. */
struct client_kind {
    const char *name;
    struct sim_traits traits;
    struct gn_screen_opts opts;
    struct sim_gpu gpu;
};
/* One card with that monitor (SIM_NO_MONITOR: none), and the first 5 frames if there is one. */
void client_begin(struct client *client, const struct client_kind *kind, int monitor);
/* Fails the test if the simulator has complained. */
void client_end(struct client *client, const struct client_kind *kind);

/* Whether all clients are told of monitors and cards: at first they are. */
void client_has_uevents(bool uevents);
void client_open(struct client *client, const struct gn_screen_opts *opts);
/* The same in a world of its own, with one card that shows the console, and 3 frames. */
void client_begin_alone(struct client *client, int monitor, const struct gn_screen_opts *opts);
void client_close(struct client *client);
const struct gn_screen *client_screen(const struct client *client);
void client_leave_console(struct client *client); /* and the text console shows itself */
void client_enter_console(struct client *client);

void client_blank(struct client *client, bool on);

void client_run(struct client *client, int64_t for_ns);
/* As many frames, or 5 s. */
void client_frames(struct client *client, long count);
/* From now on a still picture. True if it is seen at last, within that time, and 12 s later too, or
 * else again; `took` gets the time until it was. */
bool client_settle(struct client *client, int64_t within_ns, int64_t *took_ns);

#endif
