/* The thread that reads a board's health. */
#include "kiosk/sensor.h"

#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "unit/check.h"
#include "unit/folder.h"
#include "unit/health_help.h"

static struct gn_health next_reading(struct gn_sensor *s) {
    struct gn_health h;
    assert_int_equal(poll(&(struct pollfd){gn_sensor_fd(s), POLLIN, 0}, 1, 60000), 1);
    gn_sensor_read(s, &h);
    return h;
}

static void it_reads_again_and_again(void **state) {
    (void)state;
    struct gn_err err = {0};
    char root[] = "/tmp/gnomon-sensor.XXXXXX";
    assert_non_null(mkdtemp(root));
    health_pi4(root);
    struct gn_sensor *s = gn_sensor_open(root, GN_NS_PER_S / 500, &err);
    assert_non_null(s);
    assert_int_equal(next_reading(s).undervoltage, 0);
    health_write(root, "sys/class/hwmon/hwmon1/in0_lcrit_alarm", "1\n");
    for (int i = 0; next_reading(s).undervoltage != 1; i++) assert_true(i < 1000);
    gn_sensor_close(s);
    usleep(20000);
    assert_int_equal(gn_test_remove_folder(root), 0);
}

/* Its first reading comes at once, the next after the interval, and it may be closed before. */
static void it_waits_between_and_closes_at_once(void **state) {
    (void)state;
    struct gn_err err = {0};
    for (int i = 0; i < 50; i++) {
        struct gn_sensor *s = gn_sensor_open("/nonexistent", 3600 * GN_NS_PER_S, &err);
        assert_non_null(s);
        if (i % 2 == 0) {
            assert_int_equal(next_reading(s).undervoltage, -1);
            assert_int_equal(poll(&(struct pollfd){gn_sensor_fd(s), POLLIN, 0}, 1, 5), 0);
        }
        const int64_t before_ns = gn_clock_monotonic_ns();
        gn_sensor_close(s);
        assert_true(gn_clock_monotonic_ns() - before_ns < GN_NS_PER_S);
    }
    gn_sensor_close(NULL);
    usleep(20000); /* the threads end */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_reads_again_and_again),
        cmocka_unit_test(it_waits_between_and_closes_at_once),
    };
    return RUN(tests);
}
