/* Events for the machine of a kiosk, and a kiosk with three modes and two scenes. */
#ifndef GN_UNIT_KIOSK_HELP_H
#define GN_UNIT_KIOSK_HELP_H

#include "core/clock.h"
#include "kiosk/machine.h"

#define S GN_NS_PER_S

static const struct gn_kiosk_rules three = {
    .mode_count = 3, .scene_count = 2, .caption_ns = 2 * S, .fade_ns = S / 2};

/* All of them return the state after the event, at that time. */
struct gn_kiosk act(const struct gn_kiosk_rules *r, struct gn_kiosk s, int64_t at,
                    enum gn_action_kind action);
struct gn_kiosk ready(const struct gn_kiosk_rules *r, struct gn_kiosk s, int64_t at, int mode,
                      int scene);
struct gn_kiosk on(const struct gn_kiosk_rules *r, struct gn_kiosk s, enum gn_kiosk_event_kind kind,
                   int64_t at);

#endif
