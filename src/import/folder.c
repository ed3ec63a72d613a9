/* Files of the model's folder, which the parent opens. Models name materials and textures by paths
 * of the machine that exported them: a path that leads out of the folder is retried by its base
 * name. */
#include <stdlib.h>
#include <string.h>

#include "core/memory.h"
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

/* Processor time that any file may take, and bytes read for each second more. A large file has as
 * long on a slow board, a small one that asks for much work ends. Sanitizers are slower. */
enum { LEAST_S = GN_LIMITS_MEMORY ? 5 : 60, BYTES_A_SECOND = 1 << 19 };

void gn_import_extend_time(struct gn_import *import, size_t bytes) {
    const struct gn_import_opts *opts = import->opts;
    if (!opts->time_by_size) return;
    import->read_bytes += bytes;
    const uint64_t wanted_s = LEAST_S + import->read_bytes / BYTES_A_SECOND;
    import->report->time_s = wanted_s < (uint64_t)opts->time_s ? (int)wanted_s : opts->time_s;
}

static size_t file_limit(const struct gn_import *import) {
    return (size_t)import->opts->file_mb << 20;
}

bool gn_import_model_read(struct gn_import *import, struct gn_bytes *bytes, struct gn_err *err) {
    const int fd = gn_opener_ask(import->opener, "", err);
    *bytes = (struct gn_bytes){0};
    const bool ok =
        fd >= 0 && gn_file_read_fd(fd, import->opts->model, file_limit(import), bytes, err);
    if (import->read_bytes == 0) gn_import_extend_time(import, bytes->size); /* it is read again */
    return ok;
}

static bool read_in(struct gn_import *import, const char *relative, struct gn_bytes *bytes) {
    const int fd = gn_opener_ask(import->opener, relative, NULL);
    const bool ok = fd >= 0 && gn_file_read_fd(fd, relative, file_limit(import), bytes, NULL);
    gn_import_extend_time(import, ok ? bytes->size : 0);
    return ok;
}

const char *gn_import_relative_name(const struct gn_import *import, const char *name) {
    size_t length = strlen(import->folder);
    if (strncmp(name, "file://", 7) == 0) name += 7;
    if (strncmp(name, import->folder, length) == 0 && name[length] == '/') name += length + 1;
    while (strncmp(name, "./", 2) == 0) name += 2;
    return name;
}

bool gn_import_folder_read(struct gn_import *import, const char *name, struct gn_bytes *bytes) {
    char plain[PATH_MAX];
    *bytes = (struct gn_bytes){0};
    if (!*name || snprintf(plain, sizeof plain, "%s", name) >= (int)sizeof plain) return false;
    for (char *c = plain; *c; c++)
        if (*c == '\\') *c = '/';
    const char *relative = gn_import_relative_name(import, plain), *slash = strrchr(relative, '/');
    if (*relative != '/' && read_in(import, relative, bytes)) return true;
    return slash && slash[1] && read_in(import, slash + 1, bytes);
}
