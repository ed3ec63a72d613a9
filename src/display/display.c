#include "display/display.h"

#include <string.h>

#include "core/text.h"
#include "display/kms/holder.h"
#include "display/private.h"

const struct gn_display_ops *const gn_displays[] = {
#define X(file, name) &gn_display_##file,
    GN_DISPLAY_TABLE(X)
#undef X
        NULL,
};

static bool open_row(struct gn_display *display, const struct gn_display_ops *ops,
                     struct gn_warnings *warnings, struct gn_err *err) {
    *display = (struct gn_display){.ops = ops};
    if (ops->open(display, warnings, err)) return true;
    *display = (struct gn_display){0};
    return false;
}

static bool fail_unknown(const char *name, struct gn_err *err) {
    char names[sizeof err->text] = "auto";
    for (const struct gn_display_ops *const *row = gn_displays; *row; row++)
        gn_text_add(names, sizeof names, ", %s", (*row)->name);
    return gn_fail_usage(err, "unknown backend \"%s\": expected one of %s", name, names);
}

static const struct gn_display_ops *find_row(const char *name) {
    for (const struct gn_display_ops *const *row = gn_displays; *row; row++)
        if (strcmp(name, (*row)->name) == 0) return *row;
    return NULL;
}

bool gn_display_open(struct gn_display *display, const char *name, struct gn_warnings *warnings,
                     struct gn_err *err) {
    *display = (struct gn_display){0};
    if (strcmp(name, "auto") != 0) {
        const struct gn_display_ops *row = find_row(name);
        if (!row) return fail_unknown(name, err);
        return open_row(display, row, warnings, err) || gn_fail_prefix(err, "backend %s", name);
    }
    char reasons[sizeof err->text] = "";
    for (const struct gn_display_ops *const *row = gn_displays; *row; row++) {
        struct gn_err why = {0};
        if (open_row(display, *row, warnings, &why)) return true;
        gn_text_add(reasons, sizeof reasons, "%s%s: %s", *reasons ? "; " : "", (*row)->name,
                    why.text);
    }
    return gn_fail(err, "no display can be opened: %s", reasons);
}

static const struct gn_screen_ops *screen_of(const struct gn_display *display) {
    return display->ops->screen ? display->ops->screen : &gn_screen_headless;
}

bool gn_display_open_screen(struct gn_display *display, const char *name,
                            const struct gn_screen_opts *opts, int64_t now_ns,
                            struct gn_warnings *warnings, struct gn_err *err) {
    *display = (struct gn_display){0};
    const struct gn_display_ops *row = strcmp(name, "auto") == 0 ? &gn_display_kms : find_row(name);
    if (!row) return fail_unknown(name, err);
    *display = (struct gn_display){.ops = row};
    if ((row->screen || open_row(display, row, warnings, err)) &&
        screen_of(display)->open(display, opts, now_ns, warnings, err))
        return true;
    gn_display_close(display);
    return gn_fail_prefix(err, "backend %s", row->name);
}

bool gn_display_dispatch(struct gn_display *d, int64_t now_ns, struct gn_err *err) {
    return screen_of(d)->dispatch(d, now_ns, err);
}

bool gn_display_renew(struct gn_display *d, int64_t now_ns, struct gn_err *err) {
    return screen_of(d)->renew(d, now_ns, err);
}

bool gn_display_begin(struct gn_display *d, int64_t now_ns, struct gn_err *err) {
    return screen_of(d)->begin(d, now_ns, err);
}

bool gn_display_scale(struct gn_display *d, uint32_t width_px, uint32_t height_px) {
    return screen_of(d)->scale && screen_of(d)->scale(d, width_px, height_px);
}

bool gn_display_present(struct gn_display *d, int64_t now_ns, struct gn_err *err) {
    return screen_of(d)->present(d, now_ns, err);
}

bool gn_display_lose(struct gn_display *d, int64_t now_ns) {
    if (screen_of(d)->lose) screen_of(d)->lose(d, now_ns);
    return d->screen.lost;
}

void gn_display_blank(struct gn_display *d, bool on, int64_t now_ns) {
    screen_of(d)->blank(d, on, now_ns);
}

bool gn_display_show_message(struct gn_display *d, const char *text, int64_t now_ns) {
    return screen_of(d)->show_message && screen_of(d)->show_message(d, text, now_ns);
}

void gn_display_set_title(struct gn_display *d, const char *title) {
    if (screen_of(d)->set_title) screen_of(d)->set_title(d, title);
}

bool gn_display_is_free(const char *name) {
    const struct gn_display_ops *row = find_row(name);
    return row && (!row->screen || !row->screen->is_free || row->screen->is_free());
}

bool gn_display_holder(const char *path, char *out, size_t size) {
    *out = 0;
    return gn_kms_find_holder(path, out, size);
}

gn_display_proc gn_display_get_proc(void *display, const char *name) {
    struct gn_display *d = display;
    return d->ops->get_proc(d, name);
}

void gn_display_close(struct gn_display *display) {
    gn_screen_headless_close(display);
    if (display->ops) display->ops->close(display);
    *display = (struct gn_display){0};
}
