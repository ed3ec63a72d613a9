#include "caption/fade.h"

#include <stdbool.h>
#include <string.h>

#include "caption/layout.h"
#include "caption/script.h"

static const int64_t FIRST_NS = INT64_C(1000000000), WORD_NS = INT64_C(350000000);

int64_t gn_caption_read_ns(const char *text, int64_t least_ns) {
    const char *end = text + strlen(text);
    bool in_word = false;
    int64_t halves = 0; /* of words */
    for (uint32_t code; (code = gn_layout_next(&text, end)) != 0;) {
        const bool alone = gn_script_breaks(code), inks = code > ' ' && !alone;
        halves += alone ? 1 : inks && !in_word ? 2 : 0;
        in_word = inks;
    }
    const int64_t read_ns = FIRST_NS + halves * WORD_NS / 2;
    return read_ns > least_ns ? read_ns : least_ns;
}

static float share_of(int64_t part_ns, int64_t whole_ns) {
    return part_ns >= whole_ns ? 1.0f
           : part_ns <= 0      ? 0.0f
                               : (float)((double)part_ns / (double)whole_ns);
}

float gn_caption_alpha(const struct gn_caption_fade *f, int64_t now_ns) {
    const float risen = share_of(now_ns - f->begun_ns, GN_CAPTION_RISE_NS),
                left = f->ends_ns < INT64_MAX ? share_of(f->ends_ns - now_ns, GN_CAPTION_FALL_NS)
                                              : 1.0f;
    return risen < left ? risen : left;
}

struct gn_caption_fade gn_caption_begin(const struct gn_caption_fade *before, int64_t lasts_ns,
                                        int64_t now_ns) {
    const double alpha = (double)gn_caption_alpha(before, now_ns);
    return (struct gn_caption_fade){.begun_ns =
                                        now_ns - (int64_t)(alpha * (double)GN_CAPTION_RISE_NS),
                                    .ends_ns = lasts_ns > 0 ? now_ns + lasts_ns : INT64_MAX};
}

struct gn_caption_fade gn_caption_end(const struct gn_caption_fade *f, int64_t now_ns) {
    struct gn_caption_fade out = *f;
    const double alpha = (double)gn_caption_alpha(f, now_ns);
    if (f->ends_ns == INT64_MAX || f->ends_ns - now_ns > GN_CAPTION_FALL_NS)
        out.ends_ns = now_ns + (int64_t)(alpha * (double)GN_CAPTION_FALL_NS);
    return out;
}

int64_t gn_caption_next_ns(const struct gn_caption_fade *f, int64_t shown_ns) {
    if (gn_caption_alpha(f, shown_ns) < 1.0f) return shown_ns < f->ends_ns ? 0 : INT64_MAX;
    return f->ends_ns < INT64_MAX ? f->ends_ns - GN_CAPTION_FALL_NS : INT64_MAX;
}
