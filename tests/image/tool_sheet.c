/* Puts pictures of one size side by side: tool_sheet OUT.png COLUMNS PNG.. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"

enum { GAP = 4 };

static int quit(const char *text) {
    fprintf(stderr, "tool_sheet: %s\n", text);
    return 1;
}

static void put(struct gn_picture *sheet, const struct gn_picture *from, int x0, int y0) {
    for (int y = 0; y < from->height_px; y++)
        for (int x = 0; x < from->width_px; x++)
            memcpy(gn_picture_at(sheet, x0 + x, y0 + y), gn_picture_at(from, x, y),
                   3 * sizeof(float));
}

int main(int argc, char **argv) {
    const int columns = argc > 3 ? atoi(argv[2]) : 0, count = argc - 3;
    struct gn_picture sheet = {0}, one = {0};
    struct gn_err err = {0};
    if (columns < 1) return quit("OUT.png COLUMNS PNG..");
    for (int i = 0; i < count; i++) {
        if (!gn_picture_read(&one, argv[3 + i], &err)) return quit(err.text);
        const int w = one.width_px + GAP, h = one.height_px + GAP;
        if (!sheet.data)
            gn_picture_init(&sheet, columns * w - GAP, (count + columns - 1) / columns * h - GAP,
                            3);
        const int x = i % columns * w, y = i / columns * h;
        if (one.channels < 3 || x + one.width_px > sheet.width_px ||
            y + one.height_px > sheet.height_px)
            return quit("the pictures are not alike");
        put(&sheet, &one, x, y);
        gn_picture_finish(&one);
    }
    const bool ok = gn_picture_write_png(&sheet, argv[1], &err);
    gn_picture_finish(&sheet);
    return ok ? 0 : quit(err.text);
}
