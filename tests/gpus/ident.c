/* Preloaded before Mesa's drm-shim for V3D: what the kernel of a Pi 4 (V3D=42) or a Pi 5 (V3D=71)
 * answers to questions that the shim answers wrongly or not at all. It knows the older chip alone;
 * the compiler asks for the version, the number of slices and QPUs, and the size of the memory for
 * vertices. Numbers and layout: the kernel's v3d_drm.h, and for the registers its v3d_regs.h. */
#include <dlfcn.h>
#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>

struct get_param { /* drm_v3d_get_param */
    uint32_t param, pad;
    uint64_t value;
};
enum { /* enum drm_v3d_param */
       HUB_IDENT3 = 3,
       CORE0_IDENT0 = 4,
       CORE0_IDENT1 = 5,
       MULTISYNC = 11,
       CPU_QUEUE = 12,
       MAX_PERF_COUNTERS = 13,
       SUPER_PAGES = 14,
};

/* DRM_IOCTL_V3D_GET_PARAM, by the rule of asm-generic/ioctl.h: read and write, size, 'd', number.
 */
static const unsigned long request_get_param =
    3ul << 30 | sizeof(struct get_param) << 16 | 'd' << 8 | (0x40 + 4);

static bool is_newer(void) {
    const char *version = getenv("V3D");
    return version && strcmp(version, "71") == 0;
}

/* 0: answered, -1: refused with errno, 1: not ours. */
static int answer(struct get_param *get) {
    switch (get->param) {
    case HUB_IDENT3: get->value = 7 << 8; return is_newer() ? 0 : 1; /* revision 7 */
    case CORE0_IDENT0: get->value = 7 << 24 | 'D' << 16 | '3' << 8 | 'V'; return is_newer() ? 0 : 1;
    /* bits 0-3 the version's .1, 4-7 slices, 8-11 QPUs in each, 12-15 TMUs, 28-31 VPM of 8 KiB */
    case CORE0_IDENT1:
        get->value = 8u << 28 | 1 << 24 | 1 << 12 | 4 << 8 | 3 << 4 | 1;
        return is_newer() ? 0 : 1;
    case MULTISYNC:
    case CPU_QUEUE: get->value = 1; return 0; /* every kernel of the last years */
    case MAX_PERF_COUNTERS:
    case SUPER_PAGES: errno = EINVAL; return -1;
    default: return 1;
    }
}

int ioctl(int fd, unsigned long request, ...) {
    static int (*next)(int, unsigned long, ...);
    va_list list;
    va_start(list, request);
    void *argument = va_arg(list, void *);
    va_end(list);
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, "ioctl");
    if (request == request_get_param) {
        const uint64_t before = ((struct get_param *)argument)->value;
        const int status = answer(argument);
        if (status <= 0) return status;
        ((struct get_param *)argument)->value = before;
    }
    return next(fd, request, argument);
}
