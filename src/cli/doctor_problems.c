/* The problems that can be read off the machine, the backends and the input, each with its cure. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "cli/doctor_report.h"

static void diagnose_device(struct gn_doctor_report *report, const struct gn_device *device) {
    const struct gn_machine *m = &report->machine;
    char cure[200];
    if (device->readable && device->writable) return;
    bool in_group = false;
    for (int i = 0; i < m->group_count; i++) in_group |= strcmp(m->groups[i], device->group) == 0;
    if (device->group_may && !in_group && strcmp(device->group, "root") != 0)
        snprintf(cure, sizeof cure, "sudo usermod -aG %s %s, then log in again", device->group,
                 m->user);
    else
        snprintf(cure, sizeof cure,
                 "give it to a group with a udev rule (GROUP=\"%s\", MODE=\"0660\")",
                 device->kind == GN_DEVICE_GPIO   ? "gpio"
                 : device->kind == GN_DEVICE_CARD ? "video"
                                                  : "render");
    gn_problem_add(&report->problems, cure, "%s may not %s %s", m->user,
                   device->readable   ? "write"
                   : device->writable ? "read"
                                      : "open",
                   device->path);
}

void gn_doctor_diagnose_devices(struct gn_doctor_report *report, enum gn_device_kind kind) {
    for (int i = 0; i < report->machine.device_count; i++)
        if (report->machine.devices[i].kind == kind)
            diagnose_device(report, &report->machine.devices[i]);
}

static bool has_device(const struct gn_machine *m, enum gn_device_kind kind) {
    for (int i = 0; i < m->device_count; i++)
        if (m->devices[i].kind == kind) return true;
    return false;
}

void gn_doctor_diagnose_input(struct gn_doctor_report *report) {
    const struct gn_input_list *input = &report->input;
    if (!input->library && has_device(&report->machine, GN_DEVICE_GPIO))
        gn_problem_add(&report->problems, "install libgpiod-dev and build gnomon again",
                       "this build has no support for GPIO buttons: it is without libgpiod");
    for (int i = 0; i < input->chip_count; i++) {
        const struct gn_input_chip *chip = &input->chips[i];
        if (chip->error && chip->error != EACCES &&
            chip->error != EPERM) /* a problem of the device */
            gn_problem_add(&report->problems, "look for the chip in the kernel's messages (dmesg)",
                           "%s cannot be opened: %s", chip->path, strerror(chip->error));
    }
    bool has_window = false; /* which gets keys without reading devices */
    for (int i = 0; i < report->backend_count; i++)
        has_window |= report->backends[i].is_window && report->backends[i].opens;
    if (!input->devices_denied || has_window) return;
    char cure[100];
    snprintf(cure, sizeof cure, "sudo usermod -aG input %s, then log in again",
             report->machine.user);
    gn_problem_add(&report->problems, cure,
                   "%d of %d input devices may not be read: keys and touches there are ignored",
                   input->devices_denied, input->devices);
}

void gn_doctor_diagnose_health(struct gn_doctor_report *report) {
    char text[200];
    for (int i = 0; i < GN_HEALTH_COUNT; i++)
        if (gn_health_explain(&report->health, (enum gn_health_kind)i, -1, text, sizeof text))
            gn_problem_add(&report->problems, gn_health_cures[i], "%s", text);
}

void gn_doctor_diagnose(struct gn_doctor_report *report) {
    const struct gn_machine *m = &report->machine;
    const bool has_card = has_device(m, GN_DEVICE_CARD);
    for (int i = 0; i < report->backend_count; i++) {
        const struct gn_doctor_backend *b = &report->backends[i];
        if (!b->built || b->opens) continue;
        if (b->is_console && !has_card) continue; /* a problem of the machine, below */
        const char *cure = strstr(b->why, "; ");  /* in messages of backends it follows that */
        gn_problem_add(
            &report->problems, cure ? cure + 2 : "update Mesa, or choose another --backend",
            "backend %s: %.*s", b->name, cure ? (int)(cure - b->why) : (int)strlen(b->why), b->why);
    }
    const struct gn_caps *caps = &report->backends[report->chosen < 0 ? 0 : report->chosen].caps;
    if (report->chosen >= 0 && caps->software)
        gn_problem_add(&report->problems,
                       has_device(m, GN_DEVICE_RENDER)
                           ? "install the GPU's driver (libgl1-mesa-dri) and let the user open "
                             "/dev/dri/renderD*"
                           : "use a board whose GPU has OpenGL ES 3 (Pi 4/5, Mali T760+, Adreno "
                             "3xx+), or small pictures",
                       "the CPU draws (%s): shadows work, but slowly", caps->renderer);
    if (report->chosen >= 0 && gn_caps_encodings(caps) == 1u << GN_ENCODING_RGBA8)
        gn_problem_add(&report->problems, "update Mesa or the GPU's driver",
                       "the GPU draws no map format but rgba8: shadows are slower");
    for (int kind = GN_DEVICE_CARD; kind <= GN_DEVICE_GPIO; kind++)
        gn_doctor_diagnose_devices(report, (enum gn_device_kind)kind);
    if (!has_card)
        gn_problem_add(
            &report->problems,
            "on a Raspberry Pi put dtoverlay=vc4-kms-v3d into /boot/firmware/config.txt; "
            "else load the GPU's kernel driver",
            "there is no display card (/dev/dri/card*): pictures go to files only");
    gn_doctor_diagnose_health(report);
    if (m->memory_mb && m->free_mb < 128)
        gn_problem_add(&report->problems, "end other programs, or use smaller textures",
                       "only %llu MB of memory are free", (unsigned long long)m->free_mb);
    gn_doctor_diagnose_input(report);
}
