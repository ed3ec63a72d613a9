#include "display/kms/drm.h"

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "core/library.h"

/* ---- stable place of a node, as udev's path_id ---- */

/* Walks up the device tree to the first bus with persistent names. */
static void find_place(const char *node, char *out, size_t size) {
    struct stat st;
    char at[PATH_MAX], link[PATH_MAX + 16], target[PATH_MAX];
    *out = 0;
    if (stat(node, &st) < 0) return;
    snprintf(link, sizeof link, "/sys/dev/char/%u:%u/device", major(st.st_rdev), minor(st.st_rdev));
    if (!realpath(link, at)) return;
    for (char *slash; (slash = strrchr(at, '/')) && slash != at; *slash = 0) {
        snprintf(link, sizeof link, "%s/subsystem", at);
        const ssize_t length = readlink(link, target, sizeof target - 1);
        if (length <= 0) continue;
        target[length] = 0;
        const char *last = strrchr(target, '/'), *bus = last ? last + 1 : target;
        if (strcmp(bus, "pci") != 0 && strcmp(bus, "platform") != 0 && strcmp(bus, "usb") != 0)
            continue;
        snprintf(out, size, "%s-%.80s", bus, slash + 1);
        return;
    }
}

/* ---- functions of our own ---- */

static int by_number(const void *a, const void *b) {
    const struct gn_kms_node *x = a, *y = b;
    return atoi(x->path + strlen("/dev/dri/card")) - atoi(y->path + strlen("/dev/dri/card"));
}

/* Lists primary nodes by name: drmGetDevices2 reads much of sysfs, and what it accepts as a card
 * differs between releases. */
static int list_nodes(struct gn_kms_node *out, int most) {
    DIR *folder = opendir("/dev/dri");
    int count = 0;
    if (!folder) return 0;
    for (struct dirent *entry; count < most && (entry = readdir(folder));) {
        char end;
        unsigned number;
        if (sscanf(entry->d_name, "card%3u%c", &number, &end) != 1) continue;
        struct gn_kms_node *node = &out[count++];
        *node = (struct gn_kms_node){0};
        snprintf(node->path, sizeof node->path, "/dev/dri/card%u", number);
        find_place(node->path, node->place, sizeof node->place);
    }
    closedir(folder);
    qsort(out, (size_t)count, sizeof *out, by_number);
    return count;
}

static int open_node(const char *path) { return open(path, O_RDWR | O_CLOEXEC | O_NONBLOCK); }

static void close_node(int fd) { close(fd); }

static void *map_buffer(int fd, uint64_t offset, size_t size) {
    void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, (off_t)offset);
    return memory == MAP_FAILED ? NULL : memory;
}

static void unmap_buffer(void *memory, size_t size) { munmap(memory, size); }

/* ---- libdrm ---- */

const struct gn_drm_ops *gn_drm_real(struct gn_err *err) {
    static struct gn_drm_ops ops = {.list = list_nodes,
                                    .open = open_node,
                                    .close = close_node,
                                    .map = map_buffer,
                                    .unmap = unmap_buffer};
    static bool loaded;
    if (loaded) return &ops;
    void *library = gn_library_open("libdrm.so.2", "libdrm2", err);
    if (!library) return NULL;
#define X(name)                                                                                    \
    *(void **)&ops.name = dlsym(library, "drm" #name);                                             \
    if (!ops.name) {                                                                               \
        gn_fail(err, "libdrm.so.2 has no drm" #name "; install libdrm2");                          \
        return NULL;                                                                               \
    }
    GN_DRM_TABLE(X)
#undef X
    loaded = true;
    return &ops;
}
