#include "display/kms/import.h"

#include <drm.h>
#include <errno.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int call_ioctl(int card, unsigned long request, void *argument) {
    int result;
    do result = ioctl(card, request, argument);
    while (result < 0 && (errno == EINTR || errno == EAGAIN));
    return result;
}

/* Planes may share one handle, which is closed once. */
static void close_handles(int card, struct gn_import *import) {
    for (int i = 0; i < import->count; i++) {
        struct drm_gem_close which = {.handle = import->handles[i]};
        bool closed = false;
        for (int k = 0; k < i; k++) closed |= import->handles[k] == import->handles[i];
        if (!closed) call_ioctl(card, DRM_IOCTL_GEM_CLOSE, &which);
    }
    *import = (struct gn_import){0};
}

const struct gn_import *gn_import_get(struct gn_imports *imports, void *key, int plane_count,
                                      int (*export)(void *context, void *key, int plane),
                                      void *context) {
    struct gn_import *place = NULL;
    for (int i = 0; i < GN_IMPORTS_MAX; i++) {
        if (imports->all[i].key == key) return &imports->all[i];
        if (!place && !imports->all[i].key) place = &imports->all[i];
    }
    errno = ENOSPC;
    if (!place || plane_count > 4) return NULL;
    place->key = key;
    for (; place->count < plane_count; place->count++) {
        struct drm_prime_handle plane = {.fd = export(context, key, place->count)};
        const bool ok =
            plane.fd >= 0 && call_ioctl(imports->card, DRM_IOCTL_PRIME_FD_TO_HANDLE, &plane) == 0;
        const int error = errno;
        if (ok) place->handles[place->count] = plane.handle;
        if (plane.fd >= 0) close(plane.fd);
        if (ok) continue;
        close_handles(imports->card, place);
        errno = error;
        return NULL;
    }
    return place;
}

void gn_import_drop(struct gn_imports *imports) {
    for (int i = 0; i < GN_IMPORTS_MAX; i++) close_handles(imports->card, &imports->all[i]);
}
