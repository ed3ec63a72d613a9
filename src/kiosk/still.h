/* A scene that stands, seen by a camera that stands, converges to what its lamps really cast: once
 * nothing has moved for a while, pictures with hard shadows from many points of each lamp are drawn
 * into a mean, beside the screen; then that is faded in over the technique's picture. At the first
 * motion it is faded out. Only where a light has a soft technique. With [sun] hours the mean is
 * that of the sun's positions in a day, in false colours, and is seen while it is gathered. */
#ifndef GN_KIOSK_STILL_H
#define GN_KIOSK_STILL_H

#include <stdbool.h>
#include <stdint.h>

#include "stage/gather.h"
#include "stage/sun_gather.h"

struct gn_show_screen;

enum { GN_STILL_POINTS = GN_GATHER_POINTS };
struct gn_show_still {        /* zeroed: nothing is gathered */
    struct gn_view view;      /* that gathers */
    float (*aside)[3];        /* where the lights are in it, by light; NULL until it gathers */
    uint64_t generation;      /* of the shown view that it is of */
    int64_t changed_ns;       /* when that changed last */
    bool prepared;            /* its programs are made */
    bool never;               /* of this generation there is nothing to gather */
    uint32_t points;          /* that the mean has */
    float share;              /* of the mean in the picture */
    struct gn_sun_gather sun; /* with [sun] hours */
    bool painted;             /* the mean has a picture of them */
};

/* Ends what belongs to the context and the scene. */
void gn_still_drop(struct gn_show_screen *screen);
bool gn_still_wants_frame(const struct gn_show_screen *screen);
/* When gn_still_step() has something to do, if no frame is wanted then; INT64_MAX: never. */
int64_t gn_still_due_ns(const struct gn_show_screen *screen);
/* While no frame is wanted, and no other work is left: makes a program, or draws points for at most
 * half a frame's time, and waits for the GPU. */
void gn_still_step(struct gn_show_screen *screen);
/* Before a frame of the shown view at that time is drawn, and after it. cut: the frame is another
 * mode's or scene's. */
void gn_still_lay_over(struct gn_show_screen *screen, int64_t time_ns, bool cut);
void gn_still_follow(struct gn_show_screen *screen);

#endif
