/* A client of the KMS screen, like the kiosk, on the simulator's clock: steps when due, renews a
 * lost context, and draws a new colour whenever the screen allows it or, for a still picture, only
 * when it has changed or the screen is not lit. */
#ifndef GN_KMS_CLIENT_H
#define GN_KMS_CLIENT_H

#include "display/kms/kms.h"
#include "sim.h"

struct client {
    struct gn_screen_opts opts;
    struct gn_kms *kms;
    bool moves, changed, away, blank;
    unsigned heard;  /* console events for the next step */
    uint32_t colour; /* of the last frame presented */
    bool gave_up;    /* the screen gave up at least once; a new process was started */
    long frames, steps, restarts;
    long scaled;     /* of the frames: by the screen */
    int64_t told_ns; /* the time last passed to the screen */
    int64_t now_ns;  /* of the last step */
    int spins;       /* steps at that time */
};

/* A kind of machine, with its name for messages. */
struct client_kind {
    const char *name;
    struct sim_traits traits;
    struct gn_screen_opts opts;
    struct sim_gpu gpu;
};
/* A new simulation of one card with that monitor; with a monitor, runs the first 5 frames. */
void client_begin(struct client *client, const struct client_kind *kind, int monitor);
/* Fails the test if the simulator has recorded a violation. */
void client_end(struct client *client, const struct client_kind *kind);

/* Whether clients receive uevents; the default is true. */
void client_has_uevents(bool uevents);
/* Clients draw so much of the width and height, where the screen scales it; the default is 1. */
void client_draws(float share);
void client_open(struct client *client, const struct gn_screen_opts *opts);
/* As client_begin() in a new simulation, with a card that shows the console, and 3 frames. */
void client_begin_alone(struct client *client, int monitor, const struct gn_screen_opts *opts);
void client_close(struct client *client);
const struct gn_screen *client_screen(const struct client *client);
void client_leave_console(struct client *client); /* the text console takes the screen */
void client_enter_console(struct client *client);

void client_blank(struct client *client, bool on);

void client_run(struct client *client, int64_t for_ns);
/* Runs until `count` more frames are drawn, at most 5 s. */
void client_frames(struct client *client, long count);
/* Makes the picture still. Returns true if it becomes visible within that time and is visible 12 s
 * later; other programs may interrupt it, so up to three attempts. `took_ns` gets the longest wait.
 */
bool client_settle(struct client *client, int64_t within_ns, int64_t *took_ns);

#endif
