/* Files of the model's folder, which the parent opens. Models name materials and textures by paths
 * of the machine that exported them: a path that leads out of the folder is retried by its base
 * name. */
#include <stdlib.h>
#include <string.h>

#include "core/opener.h"
#include "import/import.h"

bool gn_import_folder_find(struct gn_import *import) {
    const char *path = import->opts->model, *slash = strrchr(path, '/');
    char folder[PATH_MAX];
    int length = slash ? (int)(slash - path + 1) : 2;
    int all = snprintf(folder, sizeof folder, "%.*s", length, slash ? path : "./");
    if (all >= (int)sizeof folder || !realpath(folder, import->folder))
        return gn_fail(import->err, "%s: cannot open its folder", path);
    if (strcmp(import->folder, "/") == 0) import->folder[0] = 0;
    all = snprintf(import->name, sizeof import->name, "%s/%s", import->folder,
                   slash ? slash + 1 : path);
    return all < (int)sizeof import->name || gn_fail(import->err, "%s: path too long", path);
}

static size_t file_limit(const struct gn_import *import) {
    return (size_t)import->opts->file_mb << 20;
}

bool gn_import_model_read(const struct gn_import *import, struct gn_bytes *bytes,
                          struct gn_err *err) {
    const int fd = gn_opener_ask(import->opener, "", err);
    *bytes = (struct gn_bytes){0};
    return fd >= 0 && gn_file_read_fd(fd, import->opts->model, file_limit(import), bytes, err);
}

static bool read_in(const struct gn_import *import, const char *relative, struct gn_bytes *bytes) {
    const int fd = gn_opener_ask(import->opener, relative, NULL);
    return fd >= 0 && gn_file_read_fd(fd, relative, file_limit(import), bytes, NULL);
}

const char *gn_import_relative_name(const struct gn_import *import, const char *name) {
    size_t length = strlen(import->folder);
    if (strncmp(name, "file://", 7) == 0) name += 7;
    if (strncmp(name, import->folder, length) == 0 && name[length] == '/') name += length + 1;
    while (strncmp(name, "./", 2) == 0) name += 2;
    return name;
}

bool gn_import_folder_read(const struct gn_import *import, const char *name,
                           struct gn_bytes *bytes) {
    char plain[PATH_MAX];
    *bytes = (struct gn_bytes){0};
    if (!*name || snprintf(plain, sizeof plain, "%s", name) >= (int)sizeof plain) return false;
    for (char *c = plain; *c; c++)
        if (*c == '\\') *c = '/';
    const char *relative = gn_import_relative_name(import, plain), *slash = strrchr(relative, '/');
    if (*relative != '/' && read_in(import, relative, bytes)) return true;
    return slash && slash[1] && read_in(import, slash + 1, bytes);
}
