#include "take/shown.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/model.h"

bool gn_take_is_scene(const char *name) {
    return gn_model_is_gltf(name) || gn_model_format_of(name) != GN_MODEL_FORMAT_COUNT;
}

/* False: it does not fit, or is not there. */
static bool put_path(char out[PATH_MAX], const char *folder, const char *name) {
    const int length = snprintf(out, PATH_MAX, "%s/%s", folder, name);
    if (length < PATH_MAX && access(out, F_OK) == 0) return true;
    out[0] = '\0';
    return false;
}

static bool is_file(int folder, const char *name) {
    struct stat info;
    return fstatat(folder, name, &info, 0) == 0 && S_ISREG(info.st_mode);
}

/* The first by name; `gnomon take` lets only one in. */
static bool find_scene(const char *folder, char out[PATH_MAX]) {
    char best[NAME_MAX + 1] = "";
    DIR *stream = opendir(folder);
    const struct dirent *entry;
    while (stream && (entry = readdir(stream)))
        if (entry->d_name[0] != '.' && gn_take_is_scene(entry->d_name) &&
            (!best[0] || strcmp(entry->d_name, best) < 0) && is_file(dirfd(stream), entry->d_name))
            snprintf(best, sizeof best, "%s", entry->d_name);
    if (stream) closedir(stream);
    return best[0] && put_path(out, folder, best);
}

bool gn_take_shown(const char *folder, struct gn_take_shown *out) {
    char link[PATH_MAX], target[2];
    *out = (struct gn_take_shown){0};
    /* a folder of that name may be a version's own: copies have no links */
    const bool is_kept = put_path(link, folder, GN_TAKE_CURRENT) && readlink(link, target, 1) > 0;
    if (!realpath(is_kept ? link : folder, out->folder)) return false;
    if (put_path(out->ini, out->folder, GN_TAKE_INI) && is_file(AT_FDCWD, out->ini)) return true;
    out->ini[0] = '\0';
    return find_scene(out->folder, out->scene);
}
