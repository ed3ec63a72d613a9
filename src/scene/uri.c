/* Fetches a URI of the model: a data URI, or a regular file in its folder or below. Everything else
 * is refused: neither ".." nor a link leads out. */
#include "scene/private.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/encoding.h"

static bool has_scheme(const char *uri) {
    if (!isalpha((unsigned char)*uri)) return false;
    while (isalnum((unsigned char)*uri) || strchr("+.-", *uri)) {
        if (*uri == 0) return false;
        uri++;
    }
    return *uri == ':';
}

/* Whether ".." leads above the start of the path, ignoring links. */
static bool path_climbs(const char *path) {
    int depth = 0;
    for (const char *part = path; *part && depth >= 0;) {
        size_t length = strcspn(part, "/");
        if (length == 2 && part[0] == '.' && part[1] == '.')
            depth--;
        else if (length > 0 && !(length == 1 && part[0] == '.'))
            depth++;
        part += length;
        part += *part == '/';
    }
    return depth < 0;
}

int gn_uri_open(struct gn_gltf *g, const char *uri, struct gn_err *err) {
    char below[PATH_MAX];
    const char *refusal = NULL;
    const size_t length = strlen(uri) < sizeof below ? gn_uri_name(uri, 0, below) : 0;
    if (strlen(uri) >= sizeof below)
        gn_fail(err, "URI of %zu characters is too long", strlen(uri));
    else if (length == 0)
        gn_fail(err, "empty URI");
    else if (strlen(below) != length)
        refusal = "a file name cannot contain a zero byte";
    else if (has_scheme(uri))
        refusal = "only files beside the model are read";
    else if (below[0] == '/' || path_climbs(below))
        gn_fail(err, "'%.80s' lies outside the model's folder; put the file beside it", uri);
    else if (!g->folder)
        refusal = "a model in memory cannot name other files";
    else {
        int fd = gn_file_open_beneath(g->folder, below, err);
        for (int i = 1; fd < 0 && errno == ENOENT && gn_uri_name(uri, i, below) > 0; i++)
            fd = gn_file_open_beneath(g->folder, below, NULL);
        if (fd >= 0) *err = (struct gn_err){0};
        return fd;
    }
    if (refusal) gn_fail(err, "'%.80s': %s", uri, refusal);
    return -1;
}

bool gn_uri_read(struct gn_gltf *g, int fd, const char *uri, struct gn_blob *out,
                 struct gn_err *err) {
    uint64_t limit = g->limits.file_mb << 20;
    const size_t room = gn_gltf_room(g);
    if (limit > room) limit = room;
    if (limit == 0) {
        close(fd);
        return gn_fail(err, "'%.80s': no memory left for it", uri);
    }
    char path[2 * PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", g->folder, uri);
    if (!gn_file_read_fd(fd, path, (size_t)limit, &out->file, err)) return false;
    out->data = out->file.data;
    out->size = out->file.size;
    g->memory.other_bytes += out->size;
    g->read_bytes += out->size;
    return true;
}

bool gn_uri_fetch(struct gn_gltf *g, const char *uri, struct gn_blob *out, struct gn_err *err) {
    *out = (struct gn_blob){0};
    if (!gn_data_uri_is(uri)) {
        const int fd = gn_uri_open(g, uri, err);
        return fd >= 0 && gn_uri_read(g, fd, uri, out, err);
    }
    const char *why;
    uint8_t *bytes = gn_gltf_alloc(g, &g->memory.load, strlen(uri), 1);
    if (!bytes) return false;
    out->data = bytes;
    return gn_data_uri_decode(uri, bytes, &out->size, &why) || gn_fail(err, "%s", why);
}

void gn_blob_finish(struct gn_gltf *g, struct gn_blob *blob) {
    if (blob->file.data) g->memory.other_bytes -= blob->size;
    gn_bytes_finish(&blob->file);
    *blob = (struct gn_blob){0};
}
