/* Reads the board's health again and again in a thread of its own: a sensor that waits for the
 * firmware or a slow bus delays no frame. */
#ifndef GN_KIOSK_SENSOR_H
#define GN_KIOSK_SENSOR_H

#include "core/err.h"
#include "core/health.h"

struct gn_sensor;
/* Begins at once. root: as gn_health_read() has it, copied. NULL: no thread. */
struct gn_sensor *gn_sensor_open(const char *root, int64_t interval_ns, struct gn_err *err);
int gn_sensor_fd(const struct gn_sensor *sensor); /* readable after a reading */
void gn_sensor_read(struct gn_sensor *sensor, struct gn_health *health); /* the last one */
/* Does not wait for the thread. NULL is legal. */
void gn_sensor_close(struct gn_sensor *sensor);

#endif
