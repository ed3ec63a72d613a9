/* Refresh rate of a mode; modes from modelines and CVT. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "display/kms/card.h"

uint32_t gn_kms_mode_mhz(const drmModeModeInfo *m) {
    if (m->clock == 0 || m->htotal == 0 || m->vtotal == 0) return m->vrefresh * 1000;
    uint64_t mhz = (uint64_t)m->clock * 1000000 / ((uint64_t)m->htotal * m->vtotal);
    if (m->flags & DRM_MODE_FLAG_INTERLACE) mhz *= 2;
    if (m->flags & DRM_MODE_FLAG_DBLSCAN) mhz /= 2;
    return (uint32_t)mhz;
}

static void complete_mode(drmModeModeInfo *m) {
    m->type = DRM_MODE_TYPE_USERDEF;
    m->vrefresh = (gn_kms_mode_mhz(m) + 500) / 1000;
    snprintf(m->name, sizeof m->name, "%ux%u", m->hdisplay, m->vdisplay);
}

static bool is_ascending(const unsigned t[4]) {
    return t[0] > 0 && t[0] <= t[1] && t[1] < t[2] && t[2] <= t[3] && t[3] < 65536;
}

bool gn_kms_modeline_parse(const char *text, drmModeModeInfo *out) {
    static const struct {
        const char *word;
        uint32_t flag;
    } known[] = {{"+hsync", DRM_MODE_FLAG_PHSYNC},       {"-hsync", DRM_MODE_FLAG_NHSYNC},
                 {"+vsync", DRM_MODE_FLAG_PVSYNC},       {"-vsync", DRM_MODE_FLAG_NVSYNC},
                 {"interlace", DRM_MODE_FLAG_INTERLACE}, {"doublescan", DRM_MODE_FLAG_DBLSCAN}};
    enum { KNOWN = sizeof known / sizeof *known };
    double mhz;
    unsigned h[4], v[4];
    int used = 0;
    memset(out, 0, sizeof *out);
    if (sscanf(text, "%lf %u %u %u %u %u %u %u %u%n", &mhz, &h[0], &h[1], &h[2], &h[3], &v[0],
               &v[1], &v[2], &v[3], &used) < 9)
        return false;
    if (!(mhz > 0 && mhz < 10000) || !is_ascending(h) || !is_ascending(v)) return false;
    out->clock = (uint32_t)lround(mhz * 1000);
    out->hdisplay = (uint16_t)h[0], out->hsync_start = (uint16_t)h[1];
    out->hsync_end = (uint16_t)h[2], out->htotal = (uint16_t)h[3];
    out->vdisplay = (uint16_t)v[0], out->vsync_start = (uint16_t)v[1];
    out->vsync_end = (uint16_t)v[2], out->vtotal = (uint16_t)v[3];

    char flags[64], *rest = NULL;
    if (snprintf(flags, sizeof flags, "%s", text + used) >= (int)sizeof flags) return false;
    for (char *word = strtok_r(flags, " \t", &rest); word; word = strtok_r(NULL, " \t", &rest)) {
        size_t i = 0;
        while (i < KNOWN && strcasecmp(word, known[i].word) != 0) i++;
        if (i == KNOWN) return false;
        out->flags |= known[i].flag;
    }
    complete_mode(out);
    return true;
}

/* VESA Coordinated Video Timings 1.2, 5.4: reduced blanking. */
drmModeModeInfo gn_kms_mode_cvt(uint32_t width_px, uint32_t height_px, double hz) {
    enum { H_BLANK = 160, H_FRONT = 48, H_SYNC = 32, V_FRONT = 3, V_BACK_LEAST = 6 };
    const double blank_us = 460.0, step_khz = 250.0;
    const uint32_t w = width_px & ~7u, h = height_px;
    /* CVT encodes the aspect ratio in the vertical sync width. */
    const uint32_t sync = width_px * 3 == h * 4                             ? 4
                          : width_px * 9 == h * 16                          ? 5
                          : width_px * 10 == h * 16                         ? 6
                          : width_px * 4 == h * 5 || width_px * 9 == h * 15 ? 7
                                                                            : 10;
    const double line_us = (1e6 / hz - blank_us) / h;
    uint32_t blank = (uint32_t)(blank_us / line_us) + 1;
    if (blank < V_FRONT + sync + V_BACK_LEAST) blank = V_FRONT + sync + V_BACK_LEAST;
    drmModeModeInfo m = {.hdisplay = (uint16_t)w,
                         .hsync_start = (uint16_t)(w + H_FRONT),
                         .hsync_end = (uint16_t)(w + H_FRONT + H_SYNC),
                         .htotal = (uint16_t)(w + H_BLANK),
                         .vdisplay = (uint16_t)h,
                         .vsync_start = (uint16_t)(h + V_FRONT),
                         .vsync_end = (uint16_t)(h + V_FRONT + sync),
                         .vtotal = (uint16_t)(h + blank),
                         .flags = DRM_MODE_FLAG_PHSYNC | DRM_MODE_FLAG_NVSYNC};
    m.clock = (uint32_t)(floor(hz * (w + H_BLANK) * (h + blank) / 1000.0 / step_khz) * step_khz);
    complete_mode(&m);
    return m;
}
