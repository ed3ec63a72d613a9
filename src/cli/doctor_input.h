/* The part of doctor's report about buttons and keys: lines of GPIO chips and who uses them, input
 * devices. */
#ifndef GN_CLI_DOCTOR_INPUT_H
#define GN_CLI_DOCTOR_INPUT_H

#include <jansson.h>

#include "cli/doctor_report.h"

void gn_doctor_print_input(const struct gn_doctor_report *report, FILE *to);
/* Adds label and lines of that chip to an object: both null where it was not opened. */
void gn_doctor_describe_chip(const struct gn_doctor_report *report, const char *path,
                             json_t *object);
json_t *gn_doctor_input_json(const struct gn_doctor_report *report);

#endif
