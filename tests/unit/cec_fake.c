#include "unit/cec_fake.h"

#include <errno.h>
#include <linux/cec.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static struct cec_fake fake;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

enum { FIRST_FD = 1000 };

void cec_fake_lock(void) { pthread_mutex_lock(&mutex); }
void cec_fake_unlock(void) { pthread_mutex_unlock(&mutex); }

struct cec_fake *cec_fake_new(void) {
    cec_fake_lock();
    fake = (struct cec_fake){.adapters[0] = {.present = true, .address = 0x1000}};
    cec_fake_unlock();
    return &fake;
}

int cec_fake_count(struct cec_fake *f, const char *message) {
    int count = 0;
    cec_fake_lock();
    for (const char *at = f->log; (at = strstr(at, message)); at++) count++;
    cec_fake_unlock();
    return count;
}

static int open_fake(void *context, const char *path) {
    struct cec_fake *f = context;
    int number = -1, fd = -ENOENT;
    cec_fake_lock();
    if (sscanf(path, "/dev/cec%d", &number) == 1 && number < CEC_FAKE_ADAPTERS &&
        f->adapters[number].present) {
        fd = f->adapters[number].open_error ? -f->adapters[number].open_error : FIRST_FD + number;
        f->open += fd >= 0;
    }
    cec_fake_unlock();
    return fd;
}

static void close_fake(void *context, int fd) {
    struct cec_fake *f = context;
    (void)fd;
    cec_fake_lock();
    f->open--;
    cec_fake_unlock();
}

static uint32_t caps_of(const struct cec_fake_adapter *a) {
    return ((CEC_CAP_LOG_ADDRS | CEC_CAP_TRANSMIT | CEC_CAP_CONNECTOR_INFO) & ~a->less_caps) |
           a->more_caps;
}

static int claim(struct cec_fake_adapter *a, struct cec_log_addrs *l) {
    if (a->logical) return -EBUSY;
    if (l->num_log_addrs != 1 || l->log_addr_type[0] != CEC_LOG_ADDR_TYPE_PLAYBACK) return -EINVAL;
    snprintf(a->osd_name, sizeof a->osd_name, "%s", l->osd_name);
    if (a->address == CEC_FAKE_NONE) return 0; /* claims once there is one */
    a->logical = CEC_LOG_ADDR_PLAYBACK_1;      /* the claim goes on behind it: see tell_claimed() */
    return 0;
}

static void tell_claimed(struct cec_fake_adapter *a, struct cec_log_addrs *l) {
    *l = (struct cec_log_addrs){.num_log_addrs = a->osd_name[0] || a->logical};
    memset(l->log_addr, CEC_LOG_ADDR_INVALID, sizeof l->log_addr);
    if (!a->logical) return;
    if (a->claim_reads > 0) {
        a->claim_reads--;
        return;
    }
    l->log_addr[0] = (uint8_t)a->logical;
    l->log_addr_mask = (uint16_t)(1 << a->logical);
}

static void log_message(struct cec_fake *f, const struct cec_msg *m) {
    size_t used = strlen(f->log);
    for (uint32_t i = 0; i < m->len && used + 4 < sizeof f->log; i++)
        used += (size_t)snprintf(f->log + used, sizeof f->log - used, "%02x%c", m->msg[i],
                                 i + 1 < m->len ? ':' : ' ');
}

/* The television's part. */
static void answer(struct cec_fake *f, struct cec_msg *m) {
    const int opcode = cec_msg_opcode(m);
    if (opcode == CEC_MSG_STANDBY) f->powered = false;
    if (opcode == CEC_MSG_IMAGE_VIEW_ON) f->powered = true;
    if (opcode != CEC_MSG_GIVE_DEVICE_POWER_STATUS) return;
    m->rx_status = f->starts < 0 ? CEC_RX_STATUS_TIMEOUT : CEC_RX_STATUS_OK;
    if (f->starts < 0) return;
    m->msg[0] = 0x04;
    m->msg[1] = CEC_MSG_REPORT_POWER_STATUS;
    m->msg[2] = f->starts > 0 ? CEC_OP_POWER_STATUS_TO_ON : CEC_OP_POWER_STATUS_ON;
    m->len = 3;
    f->starts -= f->starts > 0;
}

static int transmit(struct cec_fake *f, const struct cec_fake_adapter *a, struct cec_msg *m) {
    const bool is_configured = a->logical && a->address != CEC_FAKE_NONE && a->claim_reads == 0;
    if (!is_configured && (m->msg[0] != 0xf0 || caps_of(a) & CEC_CAP_NEEDS_HPD)) return -ENONET;
    if (is_configured && cec_msg_initiator(m) != a->logical) return -EINVAL;
    log_message(f, m);
    if (f->nacks != 0 && !cec_msg_is_broadcast(m)) {
        f->nacks -= f->nacks > 0;
        m->tx_status = CEC_TX_STATUS_NACK | CEC_TX_STATUS_MAX_RETRIES;
        return 0;
    }
    m->tx_status = CEC_TX_STATUS_OK;
    answer(f, m);
    return 0;
}

static int call(struct cec_fake *f, struct cec_fake_adapter *a, unsigned long request,
                void *argument) {
    if (a->not_cec) return -ENOTTY;
    if (!a->present) return -ENODEV;
    if (a->fails == request && a->fails_times != 0) {
        a->fails_times -= a->fails_times > 0;
        return -a->fails_with;
    }
    switch (request) {
    case CEC_ADAP_G_CAPS:
        *(struct cec_caps *)argument =
            (struct cec_caps){.driver = "fake", .name = "fake-hdmi", .capabilities = caps_of(a)};
        return 0;
    case CEC_ADAP_G_PHYS_ADDR: *(uint16_t *)argument = a->address; return 0;
    case CEC_ADAP_G_CONNECTOR_INFO:
        *(struct cec_connector_info *)argument = (struct cec_connector_info){
            .type = a->connector ? CEC_CONNECTOR_TYPE_DRM : CEC_CONNECTOR_TYPE_NO_CONNECTOR,
            .drm = {a->card, a->connector}};
        return 0;
    case CEC_ADAP_G_LOG_ADDRS: tell_claimed(a, argument); return 0;
    case CEC_ADAP_S_LOG_ADDRS: return claim(a, argument);
    case CEC_TRANSMIT: return transmit(f, a, argument);
    default: return -ENOTTY;
    }
}

static int call_fake(void *context, int fd, unsigned long request, void *argument) {
    struct cec_fake *f = context;
    cec_fake_lock();
    const int delay_us = request == CEC_TRANSMIT ? f->delay_us : 0;
    const int result = call(f, &f->adapters[fd - FIRST_FD], request, argument);
    cec_fake_unlock();
    if (delay_us) usleep((useconds_t)delay_us);
    return result;
}

const struct gn_cec_ops cec_fake_ops = {open_fake, call_fake, close_fake};
