#include "stage/driver_cache.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

enum { DEPTH_MAX = 3 }; /* the cache has folders of two digits, a database one of parts */

static void add_folder(struct gn_driver_cache *cache, const char *path, int depth) {
    DIR *folder = opendir(path);
    if (!folder) return;
    char child[4096];
    for (struct dirent *entry; (entry = readdir(folder));) {
        int length = snprintf(child, sizeof child, "%s/%s", path, entry->d_name);
        struct stat info;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0 || length <= 0 ||
            (size_t)length >= sizeof child || lstat(child, &info) < 0)
            continue;
        if (S_ISDIR(info.st_mode) && depth < DEPTH_MAX) add_folder(cache, child, depth + 1);
        if (!S_ISREG(info.st_mode)) continue;
        cache->files++;
        cache->bytes += (uint64_t)info.st_size;
    }
    closedir(folder);
}

/* The folder of that name in which Mesa keeps shaders; false: there is none. */
static bool find_folder(const char *name, char *out, size_t size) {
    const char *base = getenv("MESA_SHADER_CACHE_DIR"), *below = "";
    const char *off = getenv("MESA_SHADER_CACHE_DISABLE");
    if (off && (!strcmp(off, "1") || !strcasecmp(off, "true") || !strcasecmp(off, "yes")))
        return false;
    if (!base) base = getenv("XDG_CACHE_HOME");
    if (!base) {
        base = getenv("HOME");
        below = "/.cache";
    }
    return base && snprintf(out, size, "%s%s/%s", base, below, name) < (int)size;
}

struct gn_driver_cache gn_driver_cache_read(void) {
    static const char *const names[] = {"mesa_shader_cache", "mesa_shader_cache_db"};
    struct gn_driver_cache cache = {0};
    char path[4096];
    for (int i = 0; i < 2; i++)
        if (find_folder(names[i], path, sizeof path)) add_folder(&cache, path, 0);
    return cache;
}

enum {
    INDEX_BYTES = 8 + 20 * 65536, /* of Mesa's index: 65,536 keys after a head */
    ROOM_BYTES = 4 << 20,         /* less is no room for shaders: Mesa complains of each */
};

bool gn_driver_cache_reserve(struct gn_err *err) {
    char folder[4096], path[4200];
    struct stat info;
    struct statvfs disk;
    if (!find_folder("mesa_shader_cache", folder, sizeof folder)) return true;
    mkdir(folder, 0755); /* as Mesa does it */
    snprintf(path, sizeof path, "%s/index", folder);
    const int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (fd < 0) return true; /* Mesa has no cache then, either */
    const off_t bytes = fstat(fd, &info) == 0 && info.st_size > 0 ? info.st_size : INDEX_BYTES;
    const int error = posix_fallocate(fd, 0, bytes);
    if (error == ENOSPC && info.st_size == 0) unlink(path); /* made just now, and empty */
    close(fd);
    const bool has_room =
        statvfs(folder, &disk) != 0 || disk.f_bavail * disk.f_frsize >= ROOM_BYTES;
    if (error != ENOSPC && error != EDQUOT && has_room) return true;
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    return gn_fail(
        err,
        "%s: no space left for the driver's cache of shaders, which is off: the start takes "
        "longer; make room there",
        folder);
}

bool gn_driver_cache_warm(const struct gn_driver_cache *before,
                          const struct gn_driver_cache *after) {
    return after->files > 0 && after->files <= before->files && after->bytes <= before->bytes;
}
