#include "cli/machine.h"

#include <glob.h>
#include <grp.h>
#include <limits.h>
#include <pwd.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "core/file.h"
#include "core/memory.h"
#include "core/text.h"

enum { EDID_MAX = 128 * 256 };

/* The first bytes of a file of the kernel, as text; "" if it cannot be read. */
static const char *read_text(const char *root, const char *path, char *out, size_t size) {
    char full[PATH_MAX];
    snprintf(full, sizeof full, "%s%s", root, path);
    gn_file_read_text(full, out, size);
    return out;
}

static void copy_line(char *out, size_t size, const char *text) {
    gn_text_format(out, size, "%.*s", (int)strcspn(text, "\n"), text);
}

static void name_group(gid_t gid, char *out, size_t size) {
    const struct group *group = getgrgid(gid);
    if (group)
        gn_text_format(out, size, "%s", group->gr_name);
    else
        gn_text_format(out, size, "%u", (unsigned)gid);
}

/* ---- devices ------------------------------------------------------------------------------- */

static void add_device(struct gn_machine *m, enum gn_device_kind kind, const char *full,
                       const char *root) {
    struct stat info;
    if (m->device_count == GN_MACHINE_DEVICES || stat(full, &info)) return;
    struct gn_device *device = &m->devices[m->device_count++];
    device->kind = kind;
    gn_text_format(device->path, sizeof device->path, "%s", full + strlen(root));
    name_group(info.st_gid, device->group, sizeof device->group);
    device->group_may = (info.st_mode & 0060) == 0060;
    device->readable = access(full, R_OK) == 0;
    device->writable = access(full, W_OK) == 0;
    const bool gpio = kind == GN_DEVICE_GPIO;
    char path[PATH_MAX];
    snprintf(path, sizeof path,
             gpio ? "/sys/bus/gpio/devices/%s" : "/sys/class/drm/%s/device/driver",
             gn_file_name(device->path));
    char link[2 * PATH_MAX], target[PATH_MAX];
    snprintf(link, sizeof link, "%s%s", root, path);
    const ssize_t length = readlink(link, target, sizeof target - 1);
    if (length <= 0) return;
    target[length] = 0;
    if (gpio && strrchr(target, '/')) *strrchr(target, '/') = 0; /* the chip's parent */
    gn_text_format(device->driver, sizeof device->driver, "%s", gn_file_name(target));
}

/* Manufacturer and product code of an EDID (VESA E-EDID 1.4, 3.4.1 and 3.4.2); the serial number,
 * which follows them, is not looked at. */
static void read_monitor(const char *path, char *out, size_t size) {
    static const uint8_t header[8] = {0, 255, 255, 255, 255, 255, 255, 0};
    struct gn_bytes bytes = {0};
    uint8_t edid[12] = {0};
    if (gn_file_read(path, EDID_MAX, &bytes, NULL) && bytes.size >= sizeof edid)
        memcpy(edid, bytes.data, sizeof edid);
    gn_bytes_finish(&bytes);
    const unsigned vendor = (unsigned)edid[8] << 8 | edid[9];
    if (memcmp(edid, header, sizeof header) != 0) return;
    for (int shift = 10; shift >= 0; shift -= 5)
        gn_text_add(out, size, "%c", '@' + (int)(vendor >> shift & 31));
    gn_text_add(out, size, " %04x", (unsigned)edid[11] << 8 | edid[10]);
}

/* full: ".../card0-HDMI-A-1/status" */
static void add_connector(struct gn_machine *m, const char *full, const char *root) {
    char folder[PATH_MAX], path[PATH_MAX + 8], text[4096];
    if (m->connector_count == GN_MACHINE_CONNECTORS) return;
    struct gn_connector *connector = &m->connectors[m->connector_count++];
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(full, '/') - full), full);
    gn_text_format(connector->name, sizeof connector->name, "%s", gn_file_name(folder));
    copy_line(connector->status, sizeof connector->status,
              read_text(root, full + strlen(root), text, sizeof text));
    snprintf(path, sizeof path, "%s/edid", folder);
    read_monitor(path, connector->monitor, sizeof connector->monitor);
    snprintf(path, sizeof path, "%s/modes", folder);
    read_text(root, path + strlen(root), text, sizeof text);
    copy_line(connector->mode, sizeof connector->mode, text);
    /* modes, one a line; those that differ in their rate only are equal lines */
    char *modes = connector->modes, word[24];
    size_t length;
    for (const char *at = text; *at; at += length + (at[length] == '\n')) {
        length = strcspn(at, "\n");
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (strlen(modes) + length + 2 > sizeof connector->modes) return;
        if (!strstr(modes, word))
            gn_text_add(modes, sizeof connector->modes, "%s%s", modes[0] ? " " : "", word);
    }
}

static void read_devices(struct gn_machine *m, const char *root) {
    static const struct {
        const char *pattern;
        int kind; /* -1: a connector */
    } rows[] = {{"/dev/dri/card*", GN_DEVICE_CARD},
                {"/dev/dri/renderD*", GN_DEVICE_RENDER},
                {"/dev/gpiochip*", GN_DEVICE_GPIO},
                {"/sys/class/drm/card*-*/status", -1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char pattern[PATH_MAX];
        glob_t found;
        snprintf(pattern, sizeof pattern, "%s%s", root, rows[i].pattern);
        if (glob(pattern, 0, NULL, &found)) continue;
        for (size_t k = 0; k < found.gl_pathc; k++)
            if (rows[i].kind < 0)
                add_connector(m, found.gl_pathv[k], root);
            else
                add_device(m, (enum gn_device_kind)rows[i].kind, found.gl_pathv[k], root);
        globfree(&found);
    }
}

static void read_model(struct gn_machine *m, const char *root) {
    char vendor[64], product[64], text[4096];
    copy_line(m->model, sizeof m->model,
              read_text(root, "/proc/device-tree/model", text, sizeof text));
    copy_line(vendor, sizeof vendor,
              read_text(root, "/sys/class/dmi/id/sys_vendor", text, sizeof text));
    copy_line(product, sizeof product,
              read_text(root, "/sys/class/dmi/id/product_name", text, sizeof text));
    if (!m->model[0])
        gn_text_format(m->model, sizeof m->model, "%s%s%s", vendor, vendor[0] ? " " : "", product);
    const char *cpu = strstr(read_text(root, "/proc/cpuinfo", text, sizeof text), "model name\t: ");
    if (cpu) copy_line(m->cpu, sizeof m->cpu, strchr(cpu, ':') + 2);
}

void gn_machine_read(struct gn_machine *machine, const char *root) {
    char text[8192];
    struct utsname name;
    *machine = (struct gn_machine){0};
    read_model(machine, root);
    const char *pretty =
        strstr(read_text(root, "/etc/os-release", text, sizeof text), "PRETTY_NAME=\"");
    if (pretty)
        gn_text_format(machine->system, sizeof machine->system, "%.*s",
                       (int)strcspn(pretty + 13, "\"\n"), pretty + 13);
    if (uname(&name) == 0) {
        gn_text_format(machine->kernel, sizeof machine->kernel, "%s %s", name.sysname,
                       name.release);
        gn_text_format(machine->arch, sizeof machine->arch, "%s", name.machine);
    }
    const long cpus = sysconf(_SC_NPROCESSORS_ONLN);
    machine->cpus = cpus > 0 ? (int)cpus : 1;
    read_text(root, "/proc/meminfo", text, sizeof text);
    machine->memory_mb = gn_memory_of_meminfo(text, "MemTotal:");
    machine->free_mb = gn_memory_of_meminfo(text, "MemAvailable:");
    machine->cma_mb = gn_memory_of_meminfo(text, "CmaTotal:");

    const struct passwd *user = getpwuid(geteuid());
    if (user)
        gn_text_format(machine->user, sizeof machine->user, "%s", user->pw_name);
    else
        gn_text_format(machine->user, sizeof machine->user, "%u", (unsigned)geteuid());
    gid_t ids[GN_MACHINE_GROUPS];
    int count = getgroups(GN_MACHINE_GROUPS - 1, ids);
    if (count < 0) count = 0;
    bool listed = false;
    for (int i = 0; i < count; i++) listed |= ids[i] == getegid();
    if (!listed) ids[count++] = getegid();
    for (int i = 0; i < count; i++)
        name_group(ids[i], machine->groups[i], sizeof machine->groups[0]);
    machine->group_count = count;
    read_devices(machine, root);
}
