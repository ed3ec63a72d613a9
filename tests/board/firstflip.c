/* LD_PRELOAD for any program that shows itself by KMS: writes the milliseconds from the program's
 * start to its first picture on the screen into the file that FIRST_FLIP names, and those to the
 * next three into lines of their own: some (kmscube) light the screen with a buffer that they have
 * not drawn on yet. A picture is there when a blocking SETCRTC or commit has returned, or when the
 * event of the flip or commit that asked for one has been read: the same for every program,
 * whatever it says of itself. START_NS: `date +%s%N` just before exec, by the caller.
 * With HEAP_USE, that file holds the bytes that the program had from malloc and not given back, as
 * of its last picture. */
#include <dlfcn.h>
#include <drm.h>
#include <drm_mode.h>
#include <fcntl.h>
#include <malloc.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { LINES = 4 };

static int awaited = -1; /* the card whose event is to come */
static int written;      /* lines */

static void write_now(void) {
    const char *path = getenv("FIRST_FLIP"), *start = getenv("START_NS");
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    FILE *f = path && start ? fopen(path, written ? "a" : "w") : NULL;
    written++;
    if (!f) return;
    double ns = (double)now.tv_sec * 1e9 + (double)now.tv_nsec - atof(start);
    fprintf(f, "%.0f\n", ns / 1e6);
    fclose(f);
}

/* Pages tell less: where malloc puts a block, and whether that place was touched before, goes by
 * how the driver's threads happen to run. */
static void write_heap(void) {
    const char *path = getenv("HEAP_USE");
    if (!path) return;
    const struct mallinfo2 heap = mallinfo2();
    FILE *f = fopen(path, "w");
    if (!f) return;
    fprintf(f, "%zu\n", heap.uordblks + heap.hblkhd);
    fclose(f);
}

static void note_picture(void) {
    if (written < LINES) write_now();
    write_heap();
}

/* Does this request put a picture on the screen, and does its event say when? */
static bool shows(unsigned long request, const void *argument, bool *by_event) {
    const struct drm_mode_crtc *crtc = argument;
    const struct drm_mode_crtc_page_flip *flip = argument;
    const struct drm_mode_atomic *commit = argument;
    *by_event = false;
    switch (request) {
    case DRM_IOCTL_MODE_SETCRTC: return crtc->fb_id && crtc->mode_valid;
    case DRM_IOCTL_MODE_PAGE_FLIP: *by_event = flip->flags & DRM_MODE_PAGE_FLIP_EVENT; return true;
    case DRM_IOCTL_MODE_ATOMIC:
        *by_event = commit->flags & DRM_MODE_PAGE_FLIP_EVENT;
        return !(commit->flags & DRM_MODE_ATOMIC_TEST_ONLY) &&
               (commit->count_objs > 1 || written > 0); /* lit, the plane alone is changed */
    default: return false;
    }
}

int ioctl(int fd, unsigned long request, ...) {
    static int (*real)(int, unsigned long, ...);
    if (!real) *(void **)&real = dlsym(RTLD_NEXT, "ioctl");
    va_list list;
    va_start(list, request);
    void *argument = va_arg(list, void *);
    va_end(list);
    int result = real(fd, request, argument);
    bool by_event;
    if (result != 0 || !shows(request, argument, &by_event)) return result;
    if (by_event)
        awaited = fd;
    else
        note_picture();
    return result;
}

ssize_t read(int fd, void *buffer, size_t size) {
    static ssize_t (*real)(int, void *, size_t);
    if (!real) *(void **)&real = dlsym(RTLD_NEXT, "read");
    ssize_t got = real(fd, buffer, size);
    if (fd == awaited && got > 0) {
        awaited = -1;
        note_picture();
    }
    return got;
}
