#include "unit/kiosk_help.h"

struct gn_kiosk act(const struct gn_kiosk_rules *r, struct gn_kiosk s, int64_t at,
                    enum gn_action_kind action) {
    return gn_kiosk_step(
        r, &s, &(struct gn_kiosk_event){.kind = GN_KIOSK_ACTION, .time_ns = at, .action = action});
}

struct gn_kiosk ready(const struct gn_kiosk_rules *r, struct gn_kiosk s, int64_t at, int mode,
                      int scene) {
    return gn_kiosk_step(r, &s,
                         &(struct gn_kiosk_event){
                             .kind = GN_KIOSK_READY, .time_ns = at, .mode = mode, .scene = scene});
}

struct gn_kiosk on(const struct gn_kiosk_rules *r, struct gn_kiosk s, enum gn_kiosk_event_kind kind,
                   int64_t at) {
    return gn_kiosk_step(r, &s, &(struct gn_kiosk_event){.kind = kind, .time_ns = at});
}
