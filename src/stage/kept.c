#include "stage/kept.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/hash.h"

static bool find_folder(char *out, size_t size) {
    const char *own = getenv("CACHE_DIRECTORY"), *base = getenv("XDG_CACHE_HOME"),
               *home = getenv("HOME");
    int length = -1;
    if (own && own[0] == '/') /* systemd's; the first of several */
        length = snprintf(out, size, "%.*s", (int)strcspn(own, ":"), own);
    else if (base && base[0] == '/')
        length = snprintf(out, size, "%s/gnomon", base);
    else if (home && home[0] == '/')
        length = snprintf(out, size, "%s/.cache/gnomon", home);
    return length > 0 && (size_t)length < size;
}

bool gn_kept_path(const struct gn_kept_kind *kind, uint64_t hash, size_t size,
                  char out[GN_KEPT_PATH]) {
    char folder[GN_KEPT_PATH - 100];
    if (!find_folder(folder, sizeof folder)) return false;
    snprintf(out, GN_KEPT_PATH, "%s/%s%016llx-%zu%s", folder, kind->prefix,
             (unsigned long long)hash, size, kind->suffix);
    return true;
}

static bool is_name(const struct gn_kept_kind *kind, const char *name) {
    const size_t length = strlen(name), prefix = strlen(kind->prefix),
                 suffix = strlen(kind->suffix);
    return strncmp(name, kind->prefix, prefix) == 0 && length > prefix + suffix &&
           strcmp(name + length - suffix, kind->suffix) == 0;
}

/* Removes the oldest files of the kind until there are few enough. */
static void bound_files(const struct gn_kept_kind *kind, const char *folder) {
    for (;;) {
        char path[GN_KEPT_PATH], oldest[GN_KEPT_PATH] = "";
        struct timespec when = {0};
        int count = 0;
        DIR *dir = opendir(folder);
        if (!dir) return;
        for (struct dirent *entry; (entry = readdir(dir));) {
            struct stat info;
            if (!is_name(kind, entry->d_name)) continue;
            const int length = snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
            if (length >= (int)sizeof path || lstat(path, &info) < 0 || !S_ISREG(info.st_mode))
                continue;
            const bool older =
                info.st_mtim.tv_sec < when.tv_sec ||
                (info.st_mtim.tv_sec == when.tv_sec && info.st_mtim.tv_nsec < when.tv_nsec);
            if (count++ > 0 && !older) continue;
            when = info.st_mtim;
            memcpy(oldest, path, sizeof oldest);
        }
        closedir(dir);
        if (count <= kind->files_max || unlink(oldest) < 0) return;
    }
}

void gn_kept_write(const struct gn_kept_kind *kind, const char *path, const void *data,
                   size_t size) {
    struct gn_err unused = {0};
    char folder[GN_KEPT_PATH], parent[GN_KEPT_PATH];
    if (size > kind->bytes_max || !find_folder(folder, sizeof folder)) return;
    snprintf(parent, sizeof parent, "%s", folder);
    char *slash = strrchr(parent, '/');
    if (slash && slash > parent) *slash = '\0';
    mkdir(parent, 0700);
    mkdir(folder, 0700);
    const uint64_t hash = gn_hash(GN_HASH_INIT, data, size);
    uint8_t *bytes = gn_xalloc(size + sizeof hash, 1);
    if (size > 0) memcpy(bytes, data, size);
    memcpy(bytes + size, &hash, sizeof hash);
    if (gn_file_replace(path, bytes, size + sizeof hash, &unused)) bound_files(kind, folder);
    free(bytes);
}

bool gn_kept_read(const struct gn_kept_kind *kind, const char *path, struct gn_bytes *out) {
    struct gn_err unused = {0};
    uint64_t hash = 0;
    if (!gn_file_read(path, kind->bytes_max + sizeof hash, out, &unused)) return false;
    if (out->size >= sizeof hash) {
        out->size -= sizeof hash;
        memcpy(&hash, (const uint8_t *)out->data + out->size, sizeof hash);
        if (hash == gn_hash(GN_HASH_INIT, out->data, out->size)) return true;
    }
    gn_bytes_finish(out);
    return false;
}
