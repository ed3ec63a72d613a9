/* The turntable rests while the view is turned by hand and some time longer, then goes on from
 * where it stood. Pure: times come in. */
#ifndef GN_KIOSK_TURNTABLE_H
#define GN_KIOSK_TURNTABLE_H

#include <stdbool.h>
#include <stdint.h>

struct gn_turntable {          /* zeroed: not used yet */
    int64_t used_ns;           /* monotonic: the last move by hand; 0: none */
    int64_t seen_ns, scene_ns; /* of the last frame: when it is on the screen, the scene's time */
    int64_t rested_ns;         /* of the scene's time */
    bool off;                  /* from that frame to the next, which it begins anew with */
};

void gn_turntable_use(struct gn_turntable *turntable, int64_t now_ns);
/* Whether it rests for rest_ns after the last use. */
bool gn_turntable_rests(const struct gn_turntable *turntable, int64_t rest_ns, int64_t now_ns);
/* A frame is on the screen at seen_ns and shows scene_ns. Returns how much of the scene's time the
 * turntable has stood in all. */
int64_t gn_turntable_step(struct gn_turntable *turntable, int64_t rest_ns, int64_t seen_ns,
                          int64_t scene_ns);
/* When it goes on; INT64_MAX: it does not rest. */
int64_t gn_turntable_due_ns(const struct gn_turntable *turntable, int64_t rest_ns, int64_t now_ns);

#endif
