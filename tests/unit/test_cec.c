/* Messages to a television, and which adapter sends them. */
#include "unit/check.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/cec.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "unit/cec_fake.h"

static struct gn_cec_report tell(struct cec_fake *fake, bool on) {
    const struct gn_cec_opts opts = {.ops = &cec_fake_ops, .context = fake, .drm = "/nonexistent"};
    struct gn_cec_report report;
    gn_cec_tell(&opts, on, &report);
    assert_int_equal(fake->open, 0); /* whatever happened */
    assert_int_equal(report.result == GN_CEC_TOLD || report.result == GN_CEC_STARTS,
                     report.why[0] == '\0');
    return report;
}

static void on_is_view_on_and_source_and_off_is_standby(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_cec_report r = tell(fake, true);
    assert_int_equal(r.result, GN_CEC_TOLD);
    assert_string_equal(fake->log, "40:04 4f:82:10:00 40:8f ");
    assert_string_equal(fake->adapters[0].osd_name, "gnomon");
    assert_string_equal(r.adapter.path, "/dev/cec0");
    assert_true(fake->powered);
    fake->log[0] = '\0';
    r = tell(fake, false);
    assert_int_equal(r.result, GN_CEC_TOLD);
    assert_string_equal(fake->log, "40:36 ");
    assert_false(fake->powered);
}

static void one_that_starts_is_told_again_and_one_that_does_not_say_is_on(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    fake->starts = 2;
    assert_int_equal(tell(fake, true).result, GN_CEC_STARTS);
    assert_int_equal(tell(fake, true).result, GN_CEC_STARTS);
    assert_int_equal(tell(fake, true).result, GN_CEC_TOLD);
    fake->starts = -1;
    assert_int_equal(tell(fake, true).result, GN_CEC_TOLD);
}

/* The kernel's claim is not waited for in the kernel: nothing could end that. */
static void messages_wait_until_the_address_is_claimed(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    fake->adapters[0].claim_reads = 4;
    assert_int_equal(tell(fake, true).result, GN_CEC_TOLD);
    assert_string_equal(fake->log, "40:04 4f:82:10:00 40:8f ");
    assert_int_equal(fake->adapters[0].claim_reads, 0);
}

/* /dev/null stands for an adapter. */
static void a_claim_leaves_the_descriptor_waiting_for_the_rest(void **state) {
    (void)state;
    struct cec_log_addrs claim = {0};
    struct cec_msg message = {0};
    const int fd = gn_cec_kernel.open(NULL, "/dev/null");
    assert_true(fd >= 0);
    assert_int_equal(gn_cec_kernel.ioctl(NULL, fd, CEC_ADAP_S_LOG_ADDRS, &claim), -ENOTTY);
    assert_int_equal(fcntl(fd, F_GETFL) & O_NONBLOCK, 0);
    assert_int_equal(gn_cec_kernel.ioctl(NULL, fd, CEC_TRANSMIT, &message), -ENOTTY);
    gn_cec_kernel.close(NULL, fd);
}

static void one_that_does_not_acknowledge_is_no_success(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    fake->nacks = 2;
    struct gn_cec_report r = tell(fake, true);
    assert_int_equal(r.result, GN_CEC_NO_ANSWER);
    assert_non_null(strstr(r.why, "/dev/cec0 does not answer"));
    assert_string_equal(fake->log, "40:04 "); /* no source is announced to nobody */
    assert_int_equal(tell(fake, false).result, GN_CEC_NO_ANSWER);
    assert_int_equal(tell(fake, false).result, GN_CEC_TOLD);
}

/* HPD low: the one message that the kernel sends all the same, unless the adapter cannot. */
static void without_an_address_only_view_on_is_sent(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct cec_fake_adapter *a = &fake->adapters[0];
    a->address = CEC_FAKE_NONE;
    assert_int_equal(tell(fake, false).result, GN_CEC_UNPLUGGED);
    assert_string_equal(fake->log, "");
    assert_int_equal(tell(fake, true).result, GN_CEC_UNPLUGGED);
    assert_string_equal(fake->log, "f0:04 ");
    assert_string_equal(a->osd_name, "gnomon"); /* the kernel claims once the address is there */
    a->more_caps = CEC_CAP_NEEDS_HPD;
    assert_int_equal(tell(fake, true).result, GN_CEC_UNPLUGGED);
    assert_string_equal(fake->log, "f0:04 ");
    a->address = 0x2100; /* behind a receiver */
    a->logical = CEC_LOG_ADDR_PLAYBACK_2;
    fake->log[0] = '\0';
    assert_int_equal(tell(fake, true).result, GN_CEC_TOLD);
    assert_string_equal(fake->log, "80:04 8f:82:21:00 80:8f ");
}

static void an_adapter_that_others_have_configured_stays_so(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    fake->adapters[0].logical = CEC_LOG_ADDR_RECORD_1;
    assert_int_equal(tell(fake, false).result, GN_CEC_TOLD);
    assert_string_equal(fake->log, "10:36 ");
    assert_string_equal(fake->adapters[0].osd_name, "");
}

static void what_is_missing_is_named_with_its_cure(void **state) {
    (void)state;
    static const struct {
        struct cec_fake_adapter adapter;
        const char *why;
    } cases[] = {
        {{.present = false}, "no CEC adapter here"},
        {{.present = true, .open_error = EACCES}, "add the user to group video"},
        {{.present = true, .open_error = ENXIO}, "no CEC adapter is /dev/cec0 here"},
        {{.present = true, .not_cec = true}, "/dev/cec0 is not a CEC adapter"},
        {{.present = true, .open_error = EIO}, "cannot use /dev/cec0: Input/output error"},
        {{.present = true, .address = 0}, "no CEC adapter here"}, /* at an input */
        {{.present = true, .address = 0x1000, .less_caps = CEC_CAP_TRANSMIT},
         "no CEC adapter here"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct cec_fake *fake = cec_fake_new();
        fake->adapters[0] = cases[i].adapter;
        const struct gn_cec_report r = tell(fake, true);
        assert_int_equal(r.result, GN_CEC_NO_ADAPTER);
        if (!strstr(r.why, cases[i].why)) fail_msg("%s: %s", cases[i].why, r.why);
        assert_string_equal(fake->log, "");
    }
}

static void each_call_that_fails_is_reported(void **state) {
    (void)state;
    static const unsigned long requests[] = {CEC_ADAP_G_PHYS_ADDR, CEC_ADAP_G_LOG_ADDRS,
                                             CEC_ADAP_S_LOG_ADDRS, CEC_TRANSMIT};
    static const int errors[] = {EIO, ENODEV, EBUSY, ETIMEDOUT, ENONET};
    for (size_t i = 0; i < sizeof requests / sizeof requests[0]; i++)
        for (size_t k = 0; k < sizeof errors / sizeof errors[0]; k++) {
            struct cec_fake *fake = cec_fake_new();
            struct cec_fake_adapter *a = &fake->adapters[0];
            a->fails = requests[i];
            a->fails_with = errors[k];
            a->fails_times = 1;
            const struct gn_cec_report r = tell(fake, false);
            const bool unplugged = errors[k] == ENONET && i > 0;
            assert_int_equal(r.result, unplugged ? GN_CEC_UNPLUGGED : GN_CEC_NO_ADAPTER);
            assert_non_null(strstr(r.why, "/dev/cec0"));
            assert_int_equal(tell(fake, false).result, GN_CEC_TOLD);
            a->fails_times = 1;
            a->fails_with = EINTR; /* a signal */
            assert_int_equal(tell(fake, false).result, GN_CEC_TOLD);
        }
}

/* A Raspberry Pi 4: two connectors of card 1, with an adapter each. */
static void the_adapter_is_that_of_the_connector(void **state) {
    (void)state;
    char drm[] = "/tmp/gnomon-cec.XXXXXX", path[128];
    assert_non_null(mkdtemp(drm));
    for (unsigned i = 1; i <= 2; i++) {
        snprintf(path, sizeof path, "%s/card1-HDMI-A-%u", drm, i);
        assert_int_equal(mkdir(path, 0700), 0);
        snprintf(path, sizeof path, "%s/card1-HDMI-A-%u/connector_id", drm, i);
        FILE *file = fopen(path, "w");
        assert_true(file && fprintf(file, "%u\n", 30 + i) > 0 && fclose(file) == 0);
    }
    struct cec_fake *fake = cec_fake_new();
    for (unsigned i = 0; i < 2; i++)
        fake->adapters[i] = (struct cec_fake_adapter){
            .present = true, .address = 0x1000, .card = 1, .connector = 31 + i};
    fake->adapters[2] =
        (struct cec_fake_adapter){.present = true, .address = 0x1000, .card = 0, .connector = 32};
    static const struct {
        const char *connector, *device, *chosen;
        uint16_t addresses[3];
        bool bare; /* a kernel that does not know the numbers of connectors */
    } cases[] = {
        {NULL, NULL, "/dev/cec0", {0x1000, 0x1000, 0x1000}, false},
        {NULL, NULL, "/dev/cec1", {CEC_FAKE_NONE, 0x1000, 0x1000}, false},
        {NULL, "/dev/cec2", "/dev/cec2", {0x1000, 0x1000, 0x1000}, false},
        {"HDMI-A-1", NULL, "/dev/cec0", {0x1000, 0x1000, 0x1000}, false},
        {"HDMI-A-2", NULL, "/dev/cec1", {0x1000, 0x1000, 0x1000}, false},
        {"HDMI-A-2", NULL, "/dev/cec1", {0x1000, CEC_FAKE_NONE, 0x1000}, false},
        {"HDMI-A-2", "/dev/cec0", "/dev/cec0", {0x1000, 0x1000, 0x1000}, false},
        {"HDMI-A-2", NULL, "/dev/cec1", {CEC_FAKE_NONE, CEC_FAKE_NONE, 0x2000}, false},
        {"DP-1", NULL, "", {0x1000, 0x1000, 0x1000}, false},
        {"HDMI-A-2", NULL, "/dev/cec0", {0x1000, 0x1000, 0x1000}, true},
        {"HDMI-A-2", NULL, "/dev/cec1", {CEC_FAKE_NONE, 0x1000, 0x1000}, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct gn_cec_opts opts = {&cec_fake_ops, fake, cases[i].device, cases[i].connector,
                                         drm};
        struct gn_cec_report r;
        for (int k = 0; k < 3; k++) fake->adapters[k].address = cases[i].addresses[k];
        /* a stick at USB, say: it does not know its connector */
        fake->adapters[2].connector = cases[i].addresses[2] == 0x2000 ? 0 : 32;
        for (unsigned k = 1; k <= 2 && cases[i].bare; k++) {
            snprintf(path, sizeof path, "%s/card1-HDMI-A-%u/connector_id", drm, k);
            unlink(path);
        }
        gn_cec_find(&opts, &r);
        assert_string_equal(r.adapter.path, cases[i].chosen);
        assert_int_equal(r.result == GN_CEC_NO_ADAPTER, cases[i].chosen[0] == '\0');
        assert_int_equal(fake->open, 0);
    }
    assert_string_equal(fake->log, ""); /* to look changes nothing */
    assert_string_equal(fake->adapters[0].osd_name, "");
    for (unsigned i = 1; i <= 2; i++) {
        snprintf(path, sizeof path, "%s/card1-HDMI-A-%u", drm, i);
        assert_int_equal(rmdir(path), 0);
    }
    assert_int_equal(rmdir(drm), 0);
}

static void devices_of_the_kernel_that_are_no_adapters_are_refused(void **state) {
    (void)state;
    struct gn_cec_report r;
    gn_cec_tell(&(struct gn_cec_opts){.device = "/dev/null"}, true, &r);
    assert_int_equal(r.result, GN_CEC_NO_ADAPTER);
    assert_non_null(strstr(r.why, "/dev/null is not a CEC adapter"));
    gn_cec_tell(&(struct gn_cec_opts){.device = "/dev/no-cec"}, true, &r);
    assert_non_null(strstr(r.why, "no CEC adapter is /dev/no-cec here"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(on_is_view_on_and_source_and_off_is_standby),
        cmocka_unit_test(one_that_starts_is_told_again_and_one_that_does_not_say_is_on),
        cmocka_unit_test(messages_wait_until_the_address_is_claimed),
        cmocka_unit_test(a_claim_leaves_the_descriptor_waiting_for_the_rest),
        cmocka_unit_test(one_that_does_not_acknowledge_is_no_success),
        cmocka_unit_test(without_an_address_only_view_on_is_sent),
        cmocka_unit_test(an_adapter_that_others_have_configured_stays_so),
        cmocka_unit_test(what_is_missing_is_named_with_its_cure),
        cmocka_unit_test(each_call_that_fails_is_reported),
        cmocka_unit_test(the_adapter_is_that_of_the_connector),
        cmocka_unit_test(devices_of_the_kernel_that_are_no_adapters_are_refused),
    };
    return RUN(tests);
}
