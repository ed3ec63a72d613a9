#include "display/cec.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/cec.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { ADAPTERS_MAX = 16, REPLY_MS = 1000, CLAIM_MS = 5000, CLAIM_STEP_MS = 20 };

/* ---- the kernel ----------------------------------------------------------------------------- */

static int open_device(void *context, const char *path) {
    (void)context;
    const int fd = open(path, O_RDWR | O_CLOEXEC | O_NOCTTY);
    return fd >= 0 ? fd : -errno;
}

/* The kernel waits for a claim in a way that nothing ends, not even the end of the process, and for
 * seconds: this request returns at once instead, and wait_for_claim() asks for the result. */
static int call_device(void *context, int fd, unsigned long request, void *argument) {
    const bool waits = request != CEC_ADAP_S_LOG_ADDRS;
    (void)context;
    if (!waits && fcntl(fd, F_SETFL, O_RDWR | O_NONBLOCK) < 0) return -errno;
    const int error = ioctl(fd, request, argument) < 0 ? -errno : 0;
    if (!waits) fcntl(fd, F_SETFL, O_RDWR);
    return error;
}

static void close_device(void *context, int fd) {
    (void)context;
    close(fd);
}

const struct gn_cec_ops gn_cec_kernel = {open_device, call_device, close_device};

static const struct gn_cec_ops *ops_of(const struct gn_cec_opts *o) {
    return o->ops ? o->ops : &gn_cec_kernel;
}

static int call_adapter(const struct gn_cec_opts *o, const struct gn_cec_adapter *a,
                        unsigned long request, void *argument) {
    int error;
    do error = ops_of(o)->ioctl(o->context, a->fd, request, argument);
    while (error == -EINTR);
    return error;
}

static void close_adapter(const struct gn_cec_opts *o, struct gn_cec_adapter *a) {
    if (a->fd >= 0) ops_of(o)->close(o->context, a->fd);
    a->fd = -1;
}

/* ---- which adapter -------------------------------------------------------------------------- */

enum match { IS_OTHER, IS_UNKNOWN, IS_SAME }; /* what the adapter's connector is */

/* Kernels before 6.2 report the card of a connector, but not its number. */
static enum match match_connector(const struct gn_cec_opts *o, const struct gn_cec_adapter *a) {
    struct cec_connector_info info = {0};
    char path[256];
    unsigned id;
    if (!o->connector || !o->connector[0] || !(a->caps & CEC_CAP_CONNECTOR_INFO) ||
        call_adapter(o, a, CEC_ADAP_G_CONNECTOR_INFO, &info) != 0 ||
        info.type != CEC_CONNECTOR_TYPE_DRM)
        return IS_UNKNOWN;
    const char *drm = o->drm ? o->drm : "/sys/class/drm";
    snprintf(path, sizeof path, "%s/card%u-%s", drm, info.drm.card_no, o->connector);
    if (access(path, F_OK) != 0) return IS_OTHER;
    snprintf(path, sizeof path, "%s/card%u-%s/connector_id", drm, info.drm.card_no, o->connector);
    FILE *file = fopen(path, "re");
    if (!file) return IS_UNKNOWN;
    const bool is_read = fscanf(file, "%u", &id) == 1;
    fclose(file);
    if (!is_read) return IS_UNKNOWN;
    return id == info.drm.connector_id ? IS_SAME : IS_OTHER;
}

/* 0 or -errno; ENOTTY: it is no adapter. Open only after 0. */
static int open_adapter(const struct gn_cec_opts *o, const char *path, struct gn_cec_adapter *a) {
    struct cec_caps caps = {0};
    *a = (struct gn_cec_adapter){.fd = ops_of(o)->open(o->context, path)};
    snprintf(a->path, sizeof a->path, "%s", path);
    int error = a->fd < 0 ? a->fd : call_adapter(o, a, CEC_ADAP_G_CAPS, &caps);
    if (error == 0) error = call_adapter(o, a, CEC_ADAP_G_PHYS_ADDR, &a->address);
    a->caps = caps.capabilities;
    /* 0.0.0.0 is the television itself, or an adapter at an input */
    a->has_address = a->address != CEC_PHYS_ADDR_INVALID && a->address != 0;
    snprintf(a->name, sizeof a->name, "%.32s %.32s", caps.driver, caps.name);
    if (error != 0) close_adapter(o, a);
    return error;
}

static void explain_open(struct gn_cec_report *r, const char *path, int error) {
    const int code = -error;
    if (code == EACCES || code == EPERM)
        snprintf(r->why, sizeof r->why,
                 "no permission to open %s; add the user to group video (sudo usermod -aG video "
                 "USER) and log in again",
                 path);
    else if (code == ENOENT || code == ENXIO || code == ENODEV)
        snprintf(r->why, sizeof r->why, "no CEC adapter is %s here", path);
    else if (code == ENOTTY || code == EINVAL)
        snprintf(r->why, sizeof r->why,
                 "%s is not a CEC adapter; they are /dev/cec0, /dev/cec1, ..", path);
    else
        snprintf(r->why, sizeof r->why, "cannot use %s: %s", path, strerror(code));
}

/* The best one into *best, open; -1: there is none, and r says why. */
static int choose_adapter(const struct gn_cec_opts *o, struct gn_cec_adapter *best,
                          struct gn_cec_report *r) {
    int best_score = -1;
    for (int i = 0; i < ADAPTERS_MAX; i++) {
        struct gn_cec_adapter a;
        char path[32];
        snprintf(path, sizeof path, "/dev/cec%d", i);
        const int error = open_adapter(o, path, &a);
        if (error != 0) {
            if (error != -ENOENT) explain_open(r, path, error);
            continue;
        }
        const enum match match = match_connector(o, &a);
        const bool fits = match != IS_OTHER && a.address != 0 && a.caps & CEC_CAP_TRANSMIT;
        const int score = fits ? 2 * (match == IS_SAME) + a.has_address : -1;
        if (score > best_score) {
            if (best_score >= 0) close_adapter(o, best);
            best_score = score;
            *best = a;
        } else {
            close_adapter(o, &a);
        }
    }
    if (best_score < 0 && !r->why[0])
        snprintf(r->why, sizeof r->why, "no CEC adapter here%s%s",
                 o->connector && o->connector[0] ? " is that of " : "",
                 o->connector ? o->connector : "");
    return best_score;
}

/* Leaves the adapter open, if there is one. */
static void find_adapter(const struct gn_cec_opts *o, struct gn_cec_report *r) {
    struct gn_cec_adapter *a = &r->adapter;
    *r = (struct gn_cec_report){.result = GN_CEC_NO_ADAPTER, .adapter.fd = -1};
    if (o->device) {
        const int error = open_adapter(o, o->device, a);
        if (error != 0) explain_open(r, o->device, error);
        if (error != 0) return;
    } else if (choose_adapter(o, a, r) < 0) {
        *a = (struct gn_cec_adapter){.fd = -1};
        return;
    }
    r->why[0] = '\0'; /* the others may concern an adapter without a television */
    r->result = a->has_address ? GN_CEC_TOLD : GN_CEC_UNPLUGGED;
    if (!a->has_address)
        snprintf(r->why, sizeof r->why, "no television is connected to %s%s", a->path,
                 a->caps & CEC_CAP_PHYS_ADDR ? ", which has to be given its address by cec-ctl"
                                             : "");
}

void gn_cec_find(const struct gn_cec_opts *opts, struct gn_cec_report *report) {
    find_adapter(opts, report);
    close_adapter(opts, &report->adapter);
}

/* ---- messages ------------------------------------------------------------------------------- */

static void explain_call(struct gn_cec_report *r, int error) {
    const char *path = r->adapter.path;
    r->result = GN_CEC_NO_ADAPTER;
    if (error == -ENONET) {
        r->result = GN_CEC_UNPLUGGED;
        snprintf(r->why, sizeof r->why, "no television is connected to %s", path);
    } else if (error == -EBUSY)
        snprintf(r->why, sizeof r->why, "another program has %s for itself; end it", path);
    else
        snprintf(r->why, sizeof r->why, "cannot send by %s: %s", path, strerror(-error));
}

static bool is_claimed(const struct cec_log_addrs *have) {
    return have->log_addr_mask != 0 && have->log_addr[0] <= CEC_LOG_ADDR_UNREGISTERED;
}

/* Until the adapter has an address, for a while: without a television it gets none. */
static int wait_for_claim(const struct gn_cec_opts *o, const struct gn_cec_report *r,
                          struct cec_log_addrs *have) {
    int error = 0;
    for (int ms = 0; error == 0 && !is_claimed(have) && ms < CLAIM_MS; ms += CLAIM_STEP_MS) {
        if (ms > 0) usleep(1000 * CLAIM_STEP_MS);
        if (!r->adapter.has_address) return 0;
        error = call_adapter(o, &r->adapter, CEC_ADAP_G_LOG_ADDRS, have);
    }
    return error;
}

/* Claims a logical address, unless there is one. False: see r. With *own 15 it has none, but the
 * television receives it all the same. */
static bool claim_address(const struct gn_cec_opts *o, struct gn_cec_report *r, uint8_t *own) {
    struct cec_log_addrs have = {0};
    int error = call_adapter(o, &r->adapter, CEC_ADAP_G_LOG_ADDRS, &have);
    *own = CEC_LOG_ADDR_UNREGISTERED;
    if (error == 0 && have.num_log_addrs == 0 && r->adapter.caps & CEC_CAP_LOG_ADDRS) {
        have = (struct cec_log_addrs){
            .cec_version = CEC_OP_CEC_VERSION_1_4,
            .num_log_addrs = 1,
            .vendor_id = CEC_VENDOR_ID_NONE,
            .flags = CEC_LOG_ADDRS_FL_ALLOW_UNREG_FALLBACK,
            .osd_name = "gnomon",
            .primary_device_type = {CEC_OP_PRIM_DEVTYPE_PLAYBACK},
            .log_addr_type = {CEC_LOG_ADDR_TYPE_PLAYBACK},
            .all_device_types = {CEC_OP_ALL_DEVTYPE_PLAYBACK},
        };
        error = call_adapter(o, &r->adapter, CEC_ADAP_S_LOG_ADDRS, &have);
        have.log_addr_mask = 0; /* what it was given, where it does not wait */
        if (error == 0) error = wait_for_claim(o, r, &have);
    }
    if (error != 0)
        explain_call(r, error);
    else if (is_claimed(&have))
        *own = have.log_addr[0];
    return error == 0;
}

/* The kernel waits until it is sent, at most 2.5 s, and repeats it itself a few times. */
static bool send_message(const struct gn_cec_opts *o, struct gn_cec_report *r,
                         struct cec_msg *message) {
    const bool is_broadcast = cec_msg_is_broadcast(message);
    const int error = call_adapter(o, &r->adapter, CEC_TRANSMIT, message);
    if (error != 0) {
        explain_call(r, error);
        return false;
    }
    if (message->tx_status & CEC_TX_STATUS_OK) return true;
    r->result = GN_CEC_NO_ANSWER;
    snprintf(r->why, sizeof r->why, "the television at %s %s", r->adapter.path,
             message->tx_status & CEC_TX_STATUS_NACK && !is_broadcast
                 ? "does not answer to CEC"
                 : "cannot be told: CEC is disturbed");
    return false;
}

static bool send_opcode(const struct gn_cec_opts *o, struct gn_cec_report *r, uint8_t own,
                        uint8_t opcode) {
    struct cec_msg message;
    cec_msg_init(&message, own, CEC_LOG_ADDR_TV);
    message.msg[message.len++] = opcode;
    return send_message(o, r, &message);
}

static bool send_source(const struct gn_cec_opts *o, struct gn_cec_report *r, uint8_t own) {
    struct cec_msg message;
    cec_msg_init(&message, own, CEC_LOG_ADDR_BROADCAST);
    message.msg[message.len++] = CEC_MSG_ACTIVE_SOURCE;
    message.msg[message.len++] = (uint8_t)(r->adapter.address >> 8);
    message.msg[message.len++] = (uint8_t)(r->adapter.address & 0xff);
    return send_message(o, r, &message);
}

/* A television that does not report its power status counts as on. */
static bool says_not_on(const struct gn_cec_opts *o, const struct gn_cec_report *r, uint8_t own) {
    struct cec_msg message;
    cec_msg_init(&message, own, CEC_LOG_ADDR_TV);
    message.msg[message.len++] = CEC_MSG_GIVE_DEVICE_POWER_STATUS;
    message.reply = CEC_MSG_REPORT_POWER_STATUS;
    message.timeout = REPLY_MS;
    return call_adapter(o, &r->adapter, CEC_TRANSMIT, &message) == 0 &&
           message.tx_status & CEC_TX_STATUS_OK && message.rx_status & CEC_RX_STATUS_OK &&
           message.len >= 3 && message.msg[1] == CEC_MSG_REPORT_POWER_STATUS &&
           message.msg[2] != CEC_OP_POWER_STATUS_ON;
}

/* Some in standby take their physical address away and still listen. The kernel sends them this
 * one message, unless the adapter cannot (CEC_CAP_NEEDS_HPD): then it refuses. */
static void wake_unplugged(const struct gn_cec_opts *o, const struct gn_cec_report *r) {
    struct gn_cec_report unused = *r;
    uint8_t own;
    if (!claim_address(o, &unused, &own)) return;
    send_opcode(o, &unused, CEC_LOG_ADDR_UNREGISTERED, CEC_MSG_IMAGE_VIEW_ON);
}

static void tell_adapter(const struct gn_cec_opts *o, bool on, struct gn_cec_report *r) {
    uint8_t own;
    if (r->result == GN_CEC_UNPLUGGED && on) wake_unplugged(o, r);
    if (r->result != GN_CEC_TOLD || !claim_address(o, r, &own)) return;
    if (!on)
        send_opcode(o, r, own, CEC_MSG_STANDBY);
    else if (send_opcode(o, r, own, CEC_MSG_IMAGE_VIEW_ON) && send_source(o, r, own) &&
             says_not_on(o, r, own))
        r->result = GN_CEC_STARTS;
}

void gn_cec_tell(const struct gn_cec_opts *opts, bool on, struct gn_cec_report *report) {
    find_adapter(opts, report);
    if (report->adapter.fd >= 0) tell_adapter(opts, on, report);
    close_adapter(opts, &report->adapter);
}
