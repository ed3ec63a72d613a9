#include "cli/driver_cache.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

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

struct gn_driver_cache gn_driver_cache_read(void) {
    static const char *const names[] = {"mesa_shader_cache", "mesa_shader_cache_db"};
    struct gn_driver_cache cache = {0};
    const char *base = getenv("MESA_SHADER_CACHE_DIR"), *below = "";
    const char *off = getenv("MESA_SHADER_CACHE_DISABLE");
    if (off && (!strcmp(off, "1") || !strcasecmp(off, "true") || !strcasecmp(off, "yes")))
        return cache;
    if (!base) base = getenv("XDG_CACHE_HOME");
    if (!base) {
        base = getenv("HOME");
        below = "/.cache";
    }
    for (int i = 0; base && i < 2; i++) {
        char path[4096];
        int length = snprintf(path, sizeof path, "%s%s/%s", base, below, names[i]);
        if (length > 0 && (size_t)length < sizeof path) add_folder(&cache, path, 0);
    }
    return cache;
}

bool gn_driver_cache_warm(const struct gn_driver_cache *before,
                          const struct gn_driver_cache *after) {
    return after->files > 0 && after->files <= before->files && after->bytes <= before->bytes;
}
