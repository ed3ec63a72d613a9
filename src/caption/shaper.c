#include "caption/shaper.h"

#include <dlfcn.h>
#include <raqm.h>

#include "core/library.h"

#define FUNCTIONS(F)                                                                               \
    F(create)                                                                                      \
    F(destroy)                                                                                     \
    F(set_text)                                                                                    \
    F(set_par_direction)                                                                           \
    F(set_freetype_face_range)                                                                     \
    F(set_freetype_load_flags)                                                                     \
    F(layout)                                                                                      \
    F(get_glyphs)
#define MEMBER(name) __typeof__ (&raqm_##name)(name);

static struct {
    bool tried, opens;
    FUNCTIONS(MEMBER)
} raqm;

bool gn_shaper_open(struct gn_err *err) {
    if (raqm.tried) return raqm.opens || gn_fail(err, "libraqm cannot be used; install libraqm0");
    raqm.tried = true;
    void *library = gn_library_open("libraqm.so.0", "libraqm0", err);
    if (!library) return false;
    raqm.opens = true;
#define LOAD(name)                                                                                 \
    *(void **)&raqm.name = dlsym(library, "raqm_" #name);                                          \
    if (!raqm.name) raqm.opens = false;
    FUNCTIONS(LOAD)
    return raqm.opens || gn_fail(err, "libraqm.so.0 is not one that is known; install libraqm0");
}

/* Ranges of one font at a time, which are shaped apart. */
static bool give_text(raqm_t *line, const uint32_t *codes, void *const *faces, size_t count) {
    bool ok =
        raqm.set_text(line, codes, count) && raqm.set_par_direction(line, RAQM_DIRECTION_DEFAULT);
    for (size_t at = 0, end; ok && at < count; at = end) {
        for (end = at + 1; end < count && faces[end] == faces[at];) end++;
        ok = raqm.set_freetype_face_range(line, (FT_Face)faces[at], at, end - at);
    }
    return ok && raqm.set_freetype_load_flags(line, FT_LOAD_NO_BITMAP) && raqm.layout(line);
}

size_t gn_shaper_run(const uint32_t *codes, void *const *faces, size_t count,
                     struct gn_shaper_glyph *out, size_t most, int32_t *width) {
    size_t all = 0, kept = 0;
    raqm_t *line = count > 0 && gn_shaper_open(NULL) ? raqm.create() : NULL;
    if (!line) return 0;
    const raqm_glyph_t *glyphs =
        give_text(line, codes, faces, count) ? raqm.get_glyphs(line, &all) : NULL;
    *width = 0;
    for (; glyphs && kept < all && kept < most; kept++) {
        const raqm_glyph_t *g = &glyphs[kept];
        out[kept] = (struct gn_shaper_glyph){
            .face = g->ftface, .index = g->index, .x = *width + g->x_offset, .y = g->y_offset};
        *width += g->x_advance;
    }
    raqm.destroy(line);
    return kept;
}
