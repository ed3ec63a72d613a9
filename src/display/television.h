/* Keeps a television on or in standby by CEC: a thread, since each attempt takes from a tenth of a
 * second to several. Its queue has one place: what was wanted last counts.
 *
 * An attempt that fails is repeated after 1, 2, 4, 8 and 16 seconds: televisions in standby miss
 * messages. Then it is a problem. One that is to come on is told on once a minute, and one in
 * standby is left alone: it is most likely off, and whoever switches it on by hand wants to see it.
 * While the adapter has no television behind it, that is waited for. */
#ifndef GN_DISPLAY_TELEVISION_H
#define GN_DISPLAY_TELEVISION_H

#include "core/err.h"
#include "display/cec.h"

enum { GN_TELEVISION_TRIES = 6 };
struct gn_television_opts {
    struct gn_cec_opts cec; /* the device is copied; the connector is that of
                               gn_television_set(); the rest must outlive the thread */
    int64_t second_ns;      /* 0: a second. For tests: how long the waits above are */
};
enum gn_television_wish { GN_TELEVISION_ANY, GN_TELEVISION_ON, GN_TELEVISION_STANDBY };
struct gn_television_state {
    enum gn_television_wish wanted, told; /* told: the state acknowledged last, ANY: none yet */
    uint64_t attempts;
    char device[64]; /* "": none found yet */
    char waits[200]; /* why the wanted state is not sent; "": it was sent, or is being sent */
    char problem[200];
};

struct gn_television;
struct gn_television *gn_television_open(const struct gn_television_opts *opts, struct gn_err *err);
/* Takes no time. The connector that shows the picture, "HDMI-A-1", is copied; at another one there
 * may have another television, to which the state is sent again; NULL or "": as before. */
void gn_television_set(struct gn_television *television, bool on, const char *connector);
int gn_television_fd(const struct gn_television *television); /* readable after each attempt */
void gn_television_read(struct gn_television *television, struct gn_television_state *state);
/* Does not wait for an attempt that is under way. But the end of the process does, while the kernel
 * claims an address on the bus, which it does once and for as long as the polls take. NULL is
 * legal. */
void gn_television_close(struct gn_television *television);

/* How long to wait after that many such results in a row, in seconds; -1: until something else is
 * wanted. Pure. */
int gn_television_pause_s(enum gn_cec_result result, bool on, int tries);

#endif
