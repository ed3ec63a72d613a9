/* What `gnomon doctor` has found out, as text and as JSON. */
#ifndef GN_CLI_DOCTOR_REPORT_H
#define GN_CLI_DOCTOR_REPORT_H

#include <jansson.h>
#include <stdio.h>

#include "cli/machine.h"
#include "cli/problem.h"
#include "cli/selftest.h"
#include "core/err.h"
#include "core/health.h"
#include "frame/caps.h"
#include "input/input.h"
#include "options/settings.h"

enum { GN_DOCTOR_BACKENDS = 8 };

struct gn_doctor_backend {
    const char *name, *what; /* what: a line of text, NULL if it is not built in */
    bool built, opens;
    bool is_window, is_console; /* as in struct gn_display_ops */
    char why[320];              /* it does not open */
    struct gn_caps caps;        /* it opens */
    char egl[96];               /* version and vendor of its EGL; "" without one */
};
struct gn_doctor_report {
    struct gn_machine machine;
    struct gn_health health;
    struct gn_input_list input;
    struct gn_doctor_backend backends[GN_DOCTOR_BACKENDS];
    int backend_count;
    int chosen;      /* index of the backend whose GPU is described; -1: none opens */
    char texts[512]; /* scripts without a font here, and packages to install; "": none */
    struct gn_problem_list problems;
    const struct gn_selftest *self_test; /* NULL: not asked for, or it did not start */
};

/* doctor.c: what the machine is and can do, without its problems. The caller finishes
 * report->input. Fails only for wrong usage (an unknown name in --without), and without memory. */
bool gn_doctor_look(struct gn_doctor_report *report, const struct gn_settings *settings,
                    struct gn_err *err);

/* doctor_problems.c: the problems that can be read off the machine and the backends, as filled so
 * far. */
void gn_doctor_diagnose(struct gn_doctor_report *report);
void gn_doctor_diagnose_input(struct gn_doctor_report *report); /* of buttons and keys alone */

void gn_doctor_diagnose_health(struct gn_doctor_report *report); /* what the board suffers from */

/* Those of this user's permissions for devices of one kind. */
void gn_doctor_diagnose_devices(struct gn_doctor_report *report, enum gn_device_kind kind);

void gn_doctor_print(const struct gn_doctor_report *report, FILE *to);
/* One object:
 * version, can_draw (bool),
 * machine {model|null, cpu|null, system, kernel, arch, cpus, memory_mb, memory_free_mb, cma_mb,
 * health [what it suffers from: undervoltage, throttled, out of CMA], limits, user, groups [name]},
 * backends
 * [{name, what|null, built, opens, why|null, vendor|null, renderer|null, gles|null,
 * egl|null, software|null}], gpu null or {backend, vendor, renderer, gles, egl|null, software,
 * max_texture_px, texture_units, proved [name], not_proved [{name, instead}], map_formats [name],
 * auto {technique: map format}}, cards [{path, kind (card, render), driver|null, group, readable,
 * writable, holder|null}], connectors [{name, status, mode|null, modes|null, monitor|null}], gpio
 * [{path, device|null, group, readable, writable, label|null, lines null or [{name|null, used,
 * consumer|null}] by number}], texts_missing|null (scripts, with packages), input
 * {gpio_library|null, devices, devices_denied}, problems [{what, cure}], self_test: see selftest.h;
 * absent if not asked for. */
json_t *gn_doctor_json(const struct gn_doctor_report *report);
bool gn_doctor_print_json(const struct gn_doctor_report *report, FILE *to, struct gn_err *err);

#endif
