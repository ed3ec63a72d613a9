/* television DEVICE: a television at the other end of vivid's CEC, at its adapter of an input. Each
 * message that comes is a line of stdout: its bytes, as "04" or "36"; the power status is answered:
 * on, or standby, or once after each waking "in transition". Ends when nothing can be received. */
#include <errno.h>
#include <fcntl.h>
#include <linux/cec.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int become_television(int fd) {
    struct cec_log_addrs addresses = {
        .cec_version = CEC_OP_CEC_VERSION_1_4,
        .num_log_addrs = 1,
        .vendor_id = CEC_VENDOR_ID_NONE,
        .osd_name = "television",
        .primary_device_type = {CEC_OP_PRIM_DEVTYPE_TV},
        .log_addr_type = {CEC_LOG_ADDR_TYPE_TV},
        .all_device_types = {CEC_OP_ALL_DEVTYPE_TV},
    };
    unsigned mode = CEC_MODE_INITIATOR | CEC_MODE_FOLLOWER;
    return ioctl(fd, CEC_ADAP_S_LOG_ADDRS, &addresses) || ioctl(fd, CEC_S_MODE, &mode);
}

static int answer_power(int fd, const struct cec_msg *question, int status) {
    struct cec_msg reply;
    cec_msg_init(&reply, 0, cec_msg_initiator(question));
    reply.msg[1] = CEC_MSG_REPORT_POWER_STATUS;
    reply.msg[2] = (unsigned char)status;
    reply.len = 3;
    return ioctl(fd, CEC_TRANSMIT, &reply);
}

int main(int argc, char **argv) {
    const int fd = argc > 1 ? open(argv[1], O_RDWR | O_CLOEXEC) : -1;
    int status = CEC_OP_POWER_STATUS_STANDBY;
    int error = fd < 0 || become_television(fd);
    if (!error) puts("is on the wire");
    fflush(stdout);
    while (!error) {
        struct cec_msg message = {0};
        error = ioctl(fd, CEC_RECEIVE, &message);
        if (error || message.tx_status || message.len < 2) continue;
        for (unsigned i = 0; i < message.len; i++)
            printf("%02x%c", message.msg[i], i + 1 < message.len ? ':' : '\n');
        fflush(stdout);
        if (message.msg[1] == CEC_MSG_STANDBY) status = CEC_OP_POWER_STATUS_STANDBY;
        if (message.msg[1] == CEC_MSG_IMAGE_VIEW_ON && status == CEC_OP_POWER_STATUS_STANDBY)
            status = CEC_OP_POWER_STATUS_TO_ON;
        if (message.msg[1] != CEC_MSG_GIVE_DEVICE_POWER_STATUS) continue;
        error = answer_power(fd, &message, status);
        if (status == CEC_OP_POWER_STATUS_TO_ON) status = CEC_OP_POWER_STATUS_ON;
    }
    perror("television");
    return 1;
}
