/* Switches a television over HDMI CEC into standby, or on and to this machine's input. The
 * calls block, for seconds where no device answers: they are for a thread (display/television.h).
 *
 * The kernel's adapters are /dev/cec0, 1, ..; each has the physical address that the television
 * behind its connector names in its EDID, ffff without one. An adapter without a logical address
 * gets one, as a playback device that is called "gnomon"; one that another program has configured
 * stays as it is. Messages: HDMI 1.4b, supplement 1 (CEC), 13.1 One Touch Play, 13.3 Standby, 13.14
 * Power Status; ioctls: the kernel's userspace-api/media/cec. */
#ifndef GN_DISPLAY_CEC_H
#define GN_DISPLAY_CEC_H

#include <stdbool.h>
#include <stdint.h>

/* The kernel, or a test's. Both return -errno. */
struct gn_cec_ops {
    int (*open)(void *context, const char *path); /* a descriptor */
    int (*ioctl)(void *context, int fd, unsigned long request, void *argument);
    void (*close)(void *context, int fd);
};
extern const struct gn_cec_ops gn_cec_kernel;

struct gn_cec_opts {              /* zero means the default written beside */
    const struct gn_cec_ops *ops; /* gn_cec_kernel */
    void *context;                /* of ops */
    const char *device;    /* "/dev/cec1"; the adapter of the connector, else the first that has a
                              television */
    const char *connector; /* "HDMI-A-1": the one that shows the picture; any */
    const char *drm;       /* folder that has the connectors; "/sys/class/drm" */
};

enum gn_cec_result {
    GN_CEC_TOLD,
    GN_CEC_STARTS,     /* it reports that it is starting: the request is to be repeated then, since
                          many ignore meanwhile which source to show */
    GN_CEC_UNPLUGGED,  /* the adapter has no physical address */
    GN_CEC_NO_ANSWER,  /* no device acknowledges */
    GN_CEC_NO_ADAPTER, /* it is missing, or cannot be used; see why */
};
struct gn_cec_adapter {
    int fd; /* -1: not open */
    char path[64], name[72];
    uint32_t caps;
    uint16_t address; /* physical; 0xffff: no television */
    bool has_address; /* that of a source: not that of a television */
};
struct gn_cec_report {
    enum gn_cec_result result;
    struct gn_cec_adapter adapter; /* that was used; closed again; path "": none */
    char why[200]; /* what and where, and what to do; "": the message was acknowledged */
};

/* The adapter that gn_cec_tell() would use, in report->adapter: TOLD, UNPLUGGED or NO_ADAPTER.
 * Changes nothing. */
void gn_cec_find(const struct gn_cec_opts *opts, struct gn_cec_report *report);
/* One attempt: <Image View On>, <Active Source> and the question whether it is on; or <Standby>. */
void gn_cec_tell(const struct gn_cec_opts *opts, bool on, struct gn_cec_report *report);

#endif
