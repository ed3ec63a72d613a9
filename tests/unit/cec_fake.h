/* CEC adapters with a television behind them, by the rules of the kernel's ioctls. One at a time; a
 * thread may use it while the test looks. */
#ifndef GN_UNIT_CEC_FAKE_H
#define GN_UNIT_CEC_FAKE_H

#include "display/cec.h"

enum { CEC_FAKE_ADAPTERS = 3, CEC_FAKE_NONE = 0xffff };
struct cec_fake_adapter {
    bool present, not_cec;
    int open_error; /* errno */
    uint32_t less_caps, more_caps;
    uint16_t address;            /* CEC_FAKE_NONE: no television */
    unsigned card, connector;    /* connector 0: unknown */
    unsigned long fails;         /* this request fails .. */
    int fails_with, fails_times; /* .. with that errno, so often; -1: always */
    int logical;                 /* claimed; 0: none */
    int claim_reads;             /* so often a claim is asked for until it is done */
    char osd_name[16];
};
struct cec_fake {
    struct cec_fake_adapter adapters[CEC_FAKE_ADAPTERS]; /* /dev/cec0, .. */
    int nacks;  /* messages that the television does not acknowledge; -1: all */
    int starts; /* answers of "in transition to on" before "on"; -1: it does not say */
    bool powered;
    char log[2048]; /* "40:04 4f:82:10:00 " */
    int open;       /* descriptors */
    int delay_us;   /* of each transmission */
};
extern const struct gn_cec_ops cec_fake_ops;

/* With /dev/cec0 at 1.0.0.0. The context of cec_fake_ops. */
struct cec_fake *cec_fake_new(void);
void cec_fake_lock(void); /* around what a test changes or looks at while a thread runs */
void cec_fake_unlock(void);
int cec_fake_count(struct cec_fake *fake, const char *message); /* in the log; locks */

#endif
