#include "caption/message.h"

#include "caption/captions.h"
#include "core/turn.h"

static const int ground[3] = {0x20, 0x24, 0x28}, ink = 0xe8; /* red, green, blue; of each */

/* The pixel at column u of row v of the upright picture. */
static uint8_t *pixel_at(const struct gn_message_picture *p, uint32_t u, uint32_t v) {
    const struct gn_turned turn = {p->turn_deg, p->width_px, p->height_px};
    uint32_t to[2];
    gn_turned_place(&turn, u, v, to);
    return p->pixels + to[1] * p->stride + 4ul * to[0];
}

/* covered: 0 the ground, 255 the ink. */
static void paint(const struct gn_message_picture *p, uint32_t u, uint32_t v, int covered) {
    uint8_t *to = pixel_at(p, u, v);
    for (int k = 0; k < 3; k++)
        to[p->red_first ? k : 2 - k] = (uint8_t)(ground[k] + (ink - ground[k]) * covered / 255);
}

static void paint_text(const struct gn_message_picture *p, const struct gn_caption_run *run) {
    for (uint32_t i = 0; i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        for (int32_t y = 0; y < q->height && !q->ground; y++)
            for (int32_t x = 0; x < q->width; x++)
                paint(p, (uint32_t)(q->x + x), (uint32_t)(q->y + y),
                      run->atlas->coverage[(uint32_t)(q->atlas_y + y) * run->atlas->width_px +
                                           (uint32_t)(q->atlas_x + x)]);
    }
}

bool gn_message_draw(const struct gn_message_picture *p, const char *text) {
    const bool on_side = p->turn_deg % 180 != 0;
    const uint32_t width = on_side ? p->height_px : p->width_px,
                   height = on_side ? p->width_px : p->height_px;
    struct gn_captions *captions = gn_captions_create(&(struct gn_captions_opts){.font = p->font});
    gn_captions_set(captions, GN_CAPTION_TEXT, text, 0);
    const struct gn_caption_run *run = gn_captions_run(captions, width, height, 0);
    for (uint32_t v = 0; v < height; v++)
        for (uint32_t u = 0; u < width; u++) paint(p, u, v, 0);
    if (run) paint_text(p, run);
    gn_captions_destroy(captions);
    return run;
}
