#include "stage/hours_picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "caption/atlas.h"
#include "caption/layout.h"
#include "core/arena.h"
#include "options/date.h"
#include "stage/sun.h"

/* ---- bands ---- */

enum { BANDS_MAX = 12 };

struct bands {
    double width_h;
    int count;
};

static struct bands bands_of(double most_h) {
    static const double widths_h[] = {0.25, 0.5, 1, 2};
    int i = 0;
    while (i < 3 && most_h > widths_h[i] * BANDS_MAX) i++;
    return (struct bands){widths_h[i], (int)fmax(ceil(most_h / widths_h[i] - 1e-3), 1)};
}

/* Their lightness grows evenly with the hours: the order of bands is seen without colours, too. */
static void color_at(double share, uint8_t out[3]) {
    static const uint8_t stops[][3] = {
        {58, 48, 112}, {46, 98, 158}, {38, 146, 136}, {156, 188, 84}, {252, 226, 130}};
    const double at = fmin(fmax(share, 0), 1) * 4;
    const int i = (int)fmin(at, 3);
    for (int k = 0; k < 3; k++)
        out[k] = (uint8_t)lrint(stops[i][k] + (at - i) * (stops[i + 1][k] - stops[i][k]));
}

static const uint8_t paper[3] = {255, 255, 255}, ink[3] = {24, 24, 32}, sky[3] = {222, 224, 228},
                     none[3] = {36, 30, 46};

/* Less than a minute is none. band: -1 for that. */
static void color_of_band(const struct bands *bands, int band, uint8_t out[3]) {
    if (band < 0)
        memcpy(out, none, 3);
    else
        color_at(bands->count > 1 ? (double)band / (bands->count - 1) : 1, out);
}

static int band_of(const struct bands *bands, double hours) {
    const int band = (int)(hours / bands->width_h);
    if (hours < 1 / 60.0) return -1;
    return band < bands->count ? band : bands->count - 1;
}

static void draw_surface(const struct bands *bands, float hours, const float n[4], uint8_t out[3]) {
    const float shade = 0.84f + 0.16f * (0.36f * n[0] + 0.80f * n[1] + 0.48f * n[2]);
    color_of_band(bands, band_of(bands, (double)hours), out);
    for (int k = 0; k < 3; k++) out[k] = (uint8_t)lrintf(shade * (float)out[k]);
}

/* ---- the legend ---- */

struct canvas {
    uint8_t *rgba;
    int width_px, height_px;
    struct gn_font *font;
    struct gn_atlas *atlas;
};

static void cover(struct canvas *c, int x, int y, int coverage, const uint8_t color[3]) {
    if (x < 0 || y < 0 || x >= c->width_px || y >= c->height_px) return;
    uint8_t *to = c->rgba + 4 * ((size_t)y * (size_t)c->width_px + (size_t)x);
    for (int k = 0; k < 3; k++)
        to[k] = (uint8_t)((to[k] * (255 - coverage) + color[k] * coverage + 127) / 255);
}

static void fill(struct canvas *c, int x, int y, int width, int height, const uint8_t color[3]) {
    for (int v = y; v < y + height; v++)
        for (int u = x; u < x + width; u++) cover(c, u, v, 255, color);
}

/* From that corner of its line; returns its width. Without ink it is only measured. */
static int write_text(struct canvas *c, int x, int y, const char *text, bool inked) {
    const char *end = text + strlen(text);
    int pen = x;
    for (uint32_t code; (code = gn_layout_next(&text, end)) != 0;) {
        const struct gn_atlas_glyph *g = gn_atlas_glyph(c->atlas, c->font, code);
        const struct gn_caption_atlas *from = &c->atlas->picture;
        for (int v = 0; inked && v < g->height_px; v++)
            for (int u = 0; u < g->width_px; u++)
                cover(c, pen + g->left + u, y + (int)c->font->ascent_px - g->top + v,
                      from->coverage[(size_t)(g->y + v) * from->width_px + (size_t)(g->x + u)],
                      ink);
        pen += g->advance_px;
    }
    return pen - x;
}

enum { HEADINGS_MAX = 5, LINES_MAX = HEADINGS_MAX + BANDS_MAX + 1, LEAST_PX = 7 };
struct legend {
    char lines[LINES_MAX][64]; /* headings, then bands from the most hours down */
    int headings, count;
};

static void add_line(struct legend *l, const char *text) {
    snprintf(l->lines[l->count++], sizeof l->lines[0], "%s", text);
}

static void build_legend(struct legend *l, const struct gn_sun_hours *hours,
                         const struct bands *bands, const struct gn_settings *o) {
    const int minutes = (int)lrint(60 * hours->count * hours->step_h);
    struct gn_place place = {0};
    char text[64];
    gn_stage_sun_place(o, &place);
    *l = (struct legend){.count = 0};
    add_line(l, "Hours of direct sun");
    gn_date_print((hours->begin_s + hours->end_s) / 2, o->sun.time_zone, text, sizeof text);
    text[strcspn(text, ",")] = '\0'; /* the day alone */
    if (o->run.from) snprintf(text, sizeof text, "%.40s to", o->run.from);
    add_line(l, text);
    if (o->run.from) add_line(l, o->run.to);
    snprintf(text, sizeof text, "%.2f\u00b0 %c, %.2f\u00b0 %c", fabs(place.latitude_deg),
             place.latitude_deg < 0 ? 'S' : 'N', fabs(place.longitude_deg),
             place.longitude_deg < 0 ? 'W' : 'E');
    add_line(l, text);
    snprintf(text, sizeof text, "sun is up %d h %02d min", minutes / 60, minutes % 60);
    add_line(l, text);
    l->headings = l->count;
    for (int i = bands->count - 1; i >= 0; i--) {
        const double from_h = i * bands->width_h;
        if (i + 1 < bands->count || i == 0)
            snprintf(text, sizeof text, "%g to %g h", from_h, from_h + bands->width_h);
        else
            snprintf(text, sizeof text, "over %g h", from_h);
        add_line(l, text);
    }
    add_line(l, "no sun"); /* less than a minute */
}

/* At the font's size. */
static int width_of(struct canvas *c, const struct legend *l, int swatch_px) {
    int most = 0;
    for (int i = 0; i < l->count; i++) {
        const int width =
            write_text(c, 0, 0, l->lines[i], false) + (i < l->headings ? 0 : swatch_px);
        if (width > most) most = width;
    }
    return most;
}

static void draw_legend(struct canvas *c, const struct legend *l, const struct bands *bands) {
    int line_px = c->height_px / 30 + 1, width = 0;
    do {
        if (--line_px < LEAST_PX) return;
        gn_font_resize(c->font, (uint32_t)line_px);
        width = width_of(c, l, 2 * line_px);
    } while (width + 2 * line_px > c->width_px / 2 ||
             (l->count + 2) * (int)c->font->line_px > c->height_px);
    const int pitch = (int)c->font->line_px, margin = pitch / 2;
    fill(c, margin, margin, width + 2 * margin, l->count * pitch + 2 * margin, paper);
    for (int i = 0; i < l->count; i++) {
        const int x = 2 * margin, y = 2 * margin + i * pitch;
        uint8_t color[3];
        color_of_band(bands, bands->count - 1 - (i - l->headings), color);
        if (i >= l->headings) fill(c, x, y, 2 * line_px - line_px / 2, pitch, color);
        write_text(c, i < l->headings ? x : x + 2 * line_px, y, l->lines[i], true);
    }
}

/* ---- the picture ---- */

static struct gn_font *open_font(const char *path, struct gn_warnings *warnings) {
    struct gn_err err = {0};
    struct gn_font *font = path && !*path ? NULL : gn_font_open_file(path, &err);
    if (!font && path && *path)
        gn_warn(warnings, "font: %s; texts are shown in the built-in font", err.text);
    return font ? font : gn_font_open_dots();
}

void gn_hours_picture_draw(const struct gn_sun_hours *hours,
                           const struct gn_sun_hours_picture *picture,
                           const struct gn_settings *settings, uint8_t *rgba, int width_px,
                           int height_px, struct gn_warnings *warnings) {
    const struct bands bands = bands_of(hours->count * hours->step_h);
    struct canvas canvas = {.rgba = rgba,
                            .width_px = width_px,
                            .height_px = height_px,
                            .font = open_font(settings->render.font, warnings),
                            .atlas = gn_xalloc(1, sizeof *canvas.atlas)};
    struct legend legend;
    for (size_t i = 0; i < (size_t)width_px * (size_t)height_px; i++) {
        uint8_t *to = rgba + 4 * i;
        to[3] = 255;
        if (picture->hours[i] < 0.0f)
            memcpy(to, sky, 3);
        else
            draw_surface(&bands, picture->hours[i], picture->normal_ws[i], to);
    }
    build_legend(&legend, hours, &bands, settings);
    draw_legend(&canvas, &legend, &bands);
    gn_atlas_reset(canvas.atlas);
    free(canvas.atlas);
    gn_font_close(canvas.font);
}
