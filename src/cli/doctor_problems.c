/* The problems that doctor can read off the machine, the backends and the input, each with its
 * cure.
 */
#include <errno.h>
#include <stdarg.h>
#include <string.h>

#include "cli/doctor_report.h"
#include "core/text.h"

void gn_doctor_add(struct gn_doctor_report *report, const char *cure, const char *what, ...) {
    if (report->problem_count == GN_DOCTOR_PROBLEMS) return;
    struct gn_doctor_problem *problem = &report->problems[report->problem_count++];
    va_list args;
    va_start(args, what);
    gn_text_vformat(problem->what, sizeof problem->what, what, args);
    va_end(args);
    snprintf(problem->cure, sizeof problem->cure, "%s", cure);
}

static bool in_group(const struct gn_machine *m, const char *group) {
    for (int i = 0; i < m->group_count; i++)
        if (strcmp(m->groups[i], group) == 0) return true;
    return false;
}

static void diagnose_device(struct gn_doctor_report *report, const struct gn_device *device) {
    const struct gn_machine *m = &report->machine;
    char cure[200];
    if (device->readable && device->writable) return;
    if (device->group_may && !in_group(m, device->group) && strcmp(device->group, "root") != 0)
        snprintf(cure, sizeof cure, "sudo usermod -aG %s %s, then log in again", device->group,
                 m->user);
    else
        snprintf(cure, sizeof cure,
                 "give it to a group with a udev rule (GROUP=\"%s\", MODE=\"0660\")",
                 device->kind == GN_DEVICE_GPIO   ? "gpio"
                 : device->kind == GN_DEVICE_CARD ? "video"
                                                  : "render");
    gn_doctor_add(report, cure, "%s may not %s %s", m->user,
                  device->readable   ? "write"
                  : device->writable ? "read"
                                     : "open",
                  device->path);
}

static bool has_device(const struct gn_machine *m, enum gn_device_kind kind) {
    for (int i = 0; i < m->device_count; i++)
        if (m->devices[i].kind == kind) return true;
    return false;
}

static void diagnose_machine(struct gn_doctor_report *report) {
    const struct gn_machine *m = &report->machine;
    for (int i = 0; i < m->device_count; i++) diagnose_device(report, &m->devices[i]);
    if (!has_device(m, GN_DEVICE_CARD))
        gn_doctor_add(report,
                      "on a Raspberry Pi put dtoverlay=vc4-kms-v3d into /boot/firmware/config.txt; "
                      "else load the GPU's kernel driver",
                      "there is no display card (/dev/dri/card*): pictures go to files only");
    if (m->memory_mb && m->free_mb < 128)
        gn_doctor_add(report, "end other programs, or use smaller textures",
                      "only %llu MB of memory are free", (unsigned long long)m->free_mb);
}

static void diagnose_gpu(struct gn_doctor_report *report) {
    const struct gn_caps *caps = &report->backends[report->chosen].caps;
    if (caps->software)
        gn_doctor_add(report,
                      has_device(&report->machine, GN_DEVICE_RENDER)
                          ? "install the GPU's driver (libgl1-mesa-dri) and let the user open "
                            "/dev/dri/renderD*"
                          : "use a board whose GPU has OpenGL ES 3 (Pi 4/5, Mali T760+, Adreno "
                            "3xx+), or small pictures",
                      "the CPU draws (%s): shadows work, but slowly", caps->renderer);
    if (gn_caps_encodings(caps) == 1u << GN_ENCODING_RGBA8)
        gn_doctor_add(report, "update Mesa or the GPU's driver",
                      "the GPU draws no map format but rgba8: shadows are slower");
}

/* What a backend says has its cure after a semicolon. */
static void diagnose_backend(struct gn_doctor_report *report, const struct gn_doctor_backend *b) {
    const char *cure = strstr(b->why, "; ");
    gn_doctor_add(report, cure ? cure + 2 : "update Mesa, or choose another --backend",
                  "backend %s: %.*s", b->name, cure ? (int)(cure - b->why) : (int)strlen(b->why),
                  b->why);
}

/* A window hears keys without reading devices. */
static bool has_window(const struct gn_doctor_report *report) {
    for (int i = 0; i < report->backend_count; i++)
        if (report->backends[i].is_window && report->backends[i].opens) return true;
    return false;
}

void gn_doctor_diagnose_input(struct gn_doctor_report *report) {
    const struct gn_input_list *input = &report->input;
    if (!input->library && has_device(&report->machine, GN_DEVICE_GPIO))
        gn_doctor_add(report, "install libgpiod-dev and build gnomon again",
                      "this build has no support for GPIO buttons: it is without libgpiod");
    for (int i = 0; i < input->chip_count; i++) {
        const struct gn_input_chip *chip = &input->chips[i];
        if (chip->error && chip->error != EACCES && chip->error != EPERM) /* said of the node */
            gn_doctor_add(report, "look for the chip in the kernel's messages (dmesg)",
                          "%s cannot be opened: %s", chip->path, strerror(chip->error));
    }
    if (!input->devices_denied || has_window(report)) return;
    char cure[100];
    snprintf(cure, sizeof cure, "sudo usermod -aG input %s, then log in again",
             report->machine.user);
    gn_doctor_add(report, cure, "%d of %d input devices may not be read: keys there are not heard",
                  input->devices_denied, input->devices);
}

void gn_doctor_diagnose(struct gn_doctor_report *report) {
    for (int i = 0; i < report->backend_count; i++)
        if (report->backends[i].built && !report->backends[i].opens &&
            !(report->backends[i].is_console &&
              !has_device(&report->machine, GN_DEVICE_CARD))) /* which is said below */
            diagnose_backend(report, &report->backends[i]);
    if (report->chosen >= 0) diagnose_gpu(report);
    diagnose_machine(report);
    gn_doctor_diagnose_input(report);
}
