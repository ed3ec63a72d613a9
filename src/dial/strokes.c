/* Lines and letters of lines. */
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "dial/private.h"

void gn_dial_stroke(struct gn_dial *d, struct gn_dial_stroke stroke, const double (*points)[2],
                    int count) {
    if (d->stroke_count == d->stroke_room)
        d->strokes =
            gn_xrealloc(d->strokes, d->stroke_room = 2 * d->stroke_room + 64, sizeof *d->strokes);
    if (d->point_count + (size_t)count > d->point_room)
        d->points = gn_xrealloc(d->points, d->point_room = 2 * d->point_room + (size_t)count + 256,
                                sizeof *d->points);
    stroke.first = d->point_count;
    stroke.count = count;
    d->strokes[d->stroke_count++] = stroke;
    memcpy(d->points + d->point_count, points, (size_t)count * sizeof *points);
    d->point_count += (size_t)count;
}

/* Letters on a grid of 4 by 6: the digits are x and y of points, a space ends a line. */
static const struct glyph {
    char name, width;
    const char *lines;
} glyphs[] = {
    {'I', 0, "0006"},
    {'V', 4, "062046"},
    {'X', 4, "0046 0640"},
    {'0', 4, "103041453616050110"},
    {'1', 1, "051610"},
    {'2', 4, "05163645440040"},
    {'3', 4, "064624344341301001"},
    {'4', 4, "30360242"},
    {'5', 4, "4606043443413000"},
    {'6', 4, "36160501103041423303"},
    {'7', 4, "064610"},
    {'8', 4, "13334241301001021304051636454433"},
    {'9', 4, "10304145361605041343"},
    {'+', 4, "0343 2125"},
    {'-', 3, "0333"},
    {'.', 0, "0001"},
    {'*', 2, "0516251405"},
    {'A', 4, "002640 1232"},
    {'D', 4, "00063645413000"},
    {'E', 4, "46060040 0333"},
    {'F', 4, "000646 0333"},
    {'J', 4, "4641301001"},
    {'M', 4, "0006234640"},
    {'N', 4, "00064046"},
    {'O', 4, "103041453616050110"},
    {'S', 4, "453616050413334241301001"},
    {'W', 4, "0610243046"},
};
static const double GRID = 6, GAP = 2;

static const struct glyph *find_glyph(char name) {
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++)
        if (glyphs[i].name == name) return &glyphs[i];
    return NULL;
}

double gn_dial_text_width(const char *text, double height_m) {
    double width = -GAP;
    for (; *text; text++) {
        const struct glyph *glyph = find_glyph(*text);
        if (glyph) width += glyph->width + GAP;
    }
    return fmax(width, 0) * height_m / GRID;
}

/* One glyph, whose left lower corner is at `left` to the right of the text's centre. */
static void write_glyph(struct gn_dial *d, const struct gn_dial_text *how,
                        const struct glyph *glyph, double left) {
    double points[24][2];
    int count = 0;
    for (const char *c = glyph->lines;; c += 2) {
        if (*c == 0 || *c == ' ') {
            const struct gn_dial_stroke stroke = {
                .face = how->face, .role = how->role, .width_m = 0.12 * how->height_m, .hour = -1};
            gn_dial_stroke(d, stroke, (const double(*)[2])points, count);
            count = 0;
            if (*c == 0) return;
            c++;
        }
        const double x = left + (c[0] - '0') * how->height_m / GRID,
                     y = ((c[1] - '0') / GRID - 0.5) * how->height_m;
        points[count][0] = how->at[0] + x * how->up[1] + y * how->up[0];
        points[count][1] = how->at[1] - x * how->up[0] + y * how->up[1];
        count++;
    }
}

void gn_dial_write(struct gn_dial *d, const struct gn_dial_text *how, const char *text) {
    double left = -gn_dial_text_width(text, how->height_m) / 2;
    for (; *text; text++) {
        const struct glyph *glyph = find_glyph(*text);
        if (!glyph) continue;
        write_glyph(d, how, glyph, left);
        left += (glyph->width + GAP) * how->height_m / GRID;
    }
}
