/* The dial as a drawing in millimetres, 1:1: each face with its plate's outline, and the gnomon's
 * sheet beside it. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "dial/private.h"

static const double MM = 1000, MARGIN_MM = 10;

struct text { /* grows; data ends with a zero byte */
    char *data;
    size_t size, room;
};

static void put(struct text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(struct text *t, const char *format, ...) {
    enum { MOST = 512 };
    if (t->size + MOST > t->room) t->data = gn_xrealloc(t->data, t->room = 2 * t->room + MOST, 1);
    va_list arguments;
    va_start(arguments, format);
    t->size += (size_t)vsnprintf(t->data + t->size, MOST, format, arguments);
    va_end(arguments);
}

static const char *const roles[GN_DIAL_ROLE_COUNT] = {
    [GN_DIAL_HOUR] = "hour", [GN_DIAL_HALF] = "half",       [GN_DIAL_QUARTER] = "quarter",
    [GN_DIAL_RING] = "ring", [GN_DIAL_NUMERAL] = "numeral", [GN_DIAL_YEAR] = "year"};

static void put_points(struct text *t, const double (*p)[2], int count) {
    put(t, " points=\"");
    for (int i = 0; i < count; i++)
        put(t, "%s%.4f,%.4f", i ? " " : "", MM * p[i][0], -MM * p[i][1]);
    put(t, "\"/>\n");
}

static void put_stroke(struct text *t, const struct gn_dial *d, const struct gn_dial_stroke *s) {
    const double(*p)[2] = (const double(*)[2])(d->points + s->first);
    const bool closed = p[0][0] == p[s->count - 1][0] && p[0][1] == p[s->count - 1][1];
    put(t, "<%s class=\"%s\"", closed ? "polygon" : "polyline", roles[s->role]);
    if (s->hour >= 0) put(t, " data-hour=\"%g\"", s->hour);
    put(t, " stroke-width=\"%.4f\"", MM * s->width_m);
    put_points(t, p, s->count - (closed ? 1 : 0));
}

/* What is cut: outlines are thin, red lines. */
static void put_cut(struct text *t, const char *name, const double (*p)[2], int count) {
    put(t, "<polygon class=\"%s\" stroke=\"#c00\" stroke-width=\"0.1\"", name);
    put_points(t, p, count);
}

static void put_face(struct text *t, const struct gn_dial *d, int face) {
    const double corner[4][2] = {{d->low[0], d->low[1]},
                                 {d->high[0], d->low[1]},
                                 {d->high[0], d->high[1]},
                                 {d->low[0], d->high[1]}};
    put_cut(t, "plate", corner, 4);
    for (size_t i = 0; i < d->stroke_count; i++)
        if (d->strokes[i].face == face) put_stroke(t, d, &d->strokes[i]);
}

/* Where the sheet, or the rod, stands on the face. */
static void put_foot(struct text *t, const struct gn_dial *d, int face, double length) {
    const struct gn_dial_face *f = &d->faces[face];
    if (length == 0) {
        const double at[2] = {f->foot[0], f->foot[1] + (d->opts.kind == GN_DIAL_ANALEMMATIC
                                                            ? gn_dial_pin(d, d->opts.sun_deg)
                                                            : 0)};
        put(t,
            "<circle class=\"foot\" stroke=\"#c00\" stroke-width=\"0.1\" cx=\"%.4f\" cy=\"%.4f\" "
            "r=\"%.4f\"/>\n",
            MM * at[0], -MM * at[1], MM * d->thickness_m / 2);
        return;
    }
    double p[4][2];
    for (int i = 0; i < 4; i++) {
        const double along = i == 1 || i == 2 ? length : 0,
                     across = (i < 2 ? -0.5 : 0.5) * d->thickness_m;
        p[i][0] = f->foot[0] + along * f->along[0] - across * f->along[1];
        p[i][1] = f->foot[1] + along * f->along[1] + across * f->along[0];
    }
    put_cut(t, "foot", (const double(*)[2])p, 4);
}

void gn_dial_svg(const struct gn_dial *d, struct gn_bytes *out) {
    struct text t = {0};
    double sheet[24][2];
    const int count = gn_dial_sheet(d, sheet);
    const double wide = MM * (d->high[0] - d->low[0]), tall = MM * (d->high[1] - d->low[1]);
    double extent = 0, height = 0;
    for (int i = 0; i < count; i++) {
        extent = fmax(extent, MM * sheet[i][0]);
        height = fmax(height, MM * sheet[i][1]);
    }
    const double page_wide = MARGIN_MM + d->face_count * (wide + MARGIN_MM) +
                             (count ? extent + MARGIN_MM : 0),
                 page_tall = fmax(tall, height) + 2 * MARGIN_MM;
    put(&t,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.4fmm\" height=\"%.4fmm\" "
        "viewBox=\"0 0 %.4f %.4f\">\n",
        page_wide, page_tall, page_wide, page_tall);
    static const char *const names[] = {
#define X(NAME, name) name,
        GN_DIAL_KINDS(X)
#undef X
    };
    put(&t, "<title>%s sundial, latitude %g</title>\n", names[d->opts.kind], d->opts.latitude_deg);
    put(&t,
        "<desc>1:1 in millimetres. Black: to be engraved; red: to be cut. The gnomon's sheet is "
        "%.2f mm thick.</desc>\n",
        MM * d->thickness_m);
    put(&t, "<g fill=\"none\" stroke=\"#000\" stroke-linejoin=\"miter\">\n");
    for (int face = 0; face < d->face_count; face++) {
        put(&t, "<g id=\"face%d\" transform=\"translate(%.4f %.4f)\">\n", face,
            MARGIN_MM + face * (wide + MARGIN_MM) - MM * d->low[0], MARGIN_MM + MM * d->high[1]);
        put_face(&t, d, face);
        put_foot(&t, d, face, count ? sheet[1][0] : 0);
        put(&t, "</g>\n");
    }
    if (count) {
        put(&t, "<g id=\"gnomon\" transform=\"translate(%.4f %.4f)\">\n",
            MARGIN_MM + d->face_count * (wide + MARGIN_MM), MARGIN_MM + height);
        put_cut(&t, "sheet", (const double(*)[2])sheet, count);
        put(&t, "</g>\n");
    }
    put(&t, "</g>\n</svg>\n");
    *out = (struct gn_bytes){(uint8_t *)t.data, t.size};
}
