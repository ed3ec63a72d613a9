#include "cli/machine.h"

#include <fcntl.h>
#include <glob.h>
#include <grp.h>
#include <limits.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "core/text.h"

__attribute__((format(printf, 3, 4))) static void say(char *out, size_t size, const char *format,
                                                      ...) {
    va_list args;
    va_start(args, format);
    gn_text_vformat(out, size, format, args);
    va_end(args);
}

/* The first bytes of a file of the kernel's, as text; "" if it cannot be read. */
static const char *slurp(const char *root, const char *path, char *out, size_t size) {
    char full[PATH_MAX];
    snprintf(full, sizeof full, "%s%s", root, path);
    int fd = open(full, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    ssize_t length = fd < 0 ? 0 : read(fd, out, size - 1);
    if (fd >= 0) close(fd);
    out[length > 0 ? length : 0] = 0;
    return out;
}

static void copy_line(char *out, size_t size, const char *text) {
    say(out, size, "%.*s", (int)strcspn(text, "\n"), text);
}

static const char *base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The target of a link below root, without its last `drop` parts. */
static bool read_link(const char *root, const char *path, int drop, char *out, size_t size) {
    char full[PATH_MAX], target[PATH_MAX];
    snprintf(full, sizeof full, "%s%s", root, path);
    ssize_t length = readlink(full, target, sizeof target - 1);
    if (length <= 0) return false;
    target[length] = 0;
    for (; drop > 0 && strrchr(target, '/'); drop--) *strrchr(target, '/') = 0;
    say(out, size, "%s", base_name(target));
    return true;
}

/* ---- the system ---------------------------------------------------------------------------- */

static void read_system(struct gn_machine *m, const char *root) {
    char text[4096];
    struct utsname name;
    copy_line(m->model, sizeof m->model, slurp(root, "/proc/device-tree/model", text, sizeof text));
    const char *pretty =
        strstr(slurp(root, "/etc/os-release", text, sizeof text), "PRETTY_NAME=\"");
    if (pretty)
        say(m->system, sizeof m->system, "%.*s", (int)strcspn(pretty + 13, "\"\n"), pretty + 13);
    if (uname(&name) == 0) {
        say(m->kernel, sizeof m->kernel, "%s %s", name.sysname, name.release);
        say(m->arch, sizeof m->arch, "%s", name.machine);
    }
    long cpus = sysconf(_SC_NPROCESSORS_ONLN);
    m->cpus = cpus > 0 ? (int)cpus : 1;
}

static uint64_t meminfo_mb(const char *text, const char *key) {
    const char *at = strstr(text, key);
    return at ? strtoull(at + strlen(key), NULL, 10) / 1024 : 0;
}

static void read_memory(struct gn_machine *m, const char *root) {
    char text[8192];
    slurp(root, "/proc/meminfo", text, sizeof text);
    m->memory_mb = meminfo_mb(text, "MemTotal:");
    m->free_mb = meminfo_mb(text, "MemAvailable:");
    m->cma_mb = meminfo_mb(text, "CmaTotal:");
}

static void name_group(gid_t gid, char *out, size_t size) {
    const struct group *group = getgrgid(gid);
    if (group)
        say(out, size, "%s", group->gr_name);
    else
        say(out, size, "%u", (unsigned)gid);
}

static void read_user(struct gn_machine *m) {
    const struct passwd *user = getpwuid(geteuid());
    if (user)
        say(m->user, sizeof m->user, "%s", user->pw_name);
    else
        say(m->user, sizeof m->user, "%u", (unsigned)geteuid());
    gid_t ids[GN_MACHINE_GROUPS];
    int count = getgroups(GN_MACHINE_GROUPS - 1, ids);
    if (count < 0) count = 0;
    bool listed = false;
    for (int i = 0; i < count; i++) listed |= ids[i] == getegid();
    if (!listed) ids[count++] = getegid();
    for (m->group_count = 0; m->group_count < count; m->group_count++)
        name_group(ids[m->group_count], m->groups[m->group_count], sizeof m->groups[0]);
}

/* ---- devices ------------------------------------------------------------------------------- */

static void find_driver(struct gn_device *device, const char *root) {
    char path[PATH_MAX];
    const char *name = base_name(device->path);
    if (device->kind == GN_DEVICE_GPIO) {
        snprintf(path, sizeof path, "/sys/bus/gpio/devices/%s", name);
        read_link(root, path, 1, device->driver, sizeof device->driver);
        return;
    }
    snprintf(path, sizeof path, "/sys/class/drm/%s/device/driver", name);
    read_link(root, path, 0, device->driver, sizeof device->driver);
}

static void add_device(struct gn_machine *m, enum gn_device_kind kind, const char *full,
                       const char *root) {
    struct stat info;
    if (m->device_count == GN_MACHINE_DEVICES || stat(full, &info)) return;
    struct gn_device *device = &m->devices[m->device_count++];
    device->kind = kind;
    say(device->path, sizeof device->path, "%s", full + strlen(root));
    name_group(info.st_gid, device->group, sizeof device->group);
    device->group_may = (info.st_mode & 0060) == 0060;
    device->readable = access(full, R_OK) == 0;
    device->writable = access(full, W_OK) == 0;
    find_driver(device, root);
}

/* One a line; those that differ in their rate alone stand there more than once. */
static void copy_modes(struct gn_connector *c, const char *text) {
    size_t used = 0;
    while (*text) {
        const size_t length = strcspn(text, "\n"), room = sizeof c->modes - used;
        char word[24];
        snprintf(word, sizeof word, "%.*s", (int)length, text);
        if (length + 2 > room) return;
        if (!strstr(c->modes, word))
            used += (size_t)snprintf(c->modes + used, room, "%s%s", used ? " " : "", word);
        text += length + (text[length] == '\n');
    }
}

/* full: ".../card0-HDMI-A-1/status" */
static void add_connector(struct gn_machine *m, const char *full, const char *root) {
    char folder[PATH_MAX], path[PATH_MAX + 8], text[4096];
    if (m->connector_count == GN_MACHINE_CONNECTORS) return;
    struct gn_connector *connector = &m->connectors[m->connector_count++];
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(full, '/') - full), full);
    say(connector->name, sizeof connector->name, "%s", base_name(folder));
    copy_line(connector->status, sizeof connector->status,
              slurp(root, full + strlen(root), text, sizeof text));
    snprintf(path, sizeof path, "%s/modes", folder);
    const char *modes = slurp(root, path + strlen(root), text, sizeof text);
    copy_line(connector->mode, sizeof connector->mode, modes);
    if (modes) copy_modes(connector, modes);
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

void gn_machine_read(struct gn_machine *machine, const char *root) {
    *machine = (struct gn_machine){0};
    read_system(machine, root);
    read_memory(machine, root);
    read_user(machine);
    read_devices(machine, root);
}
