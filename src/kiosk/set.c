/* Options of the running kiosk: by `ctl set`, and by keys of a window. */
#include "kiosk/private.h"

bool gn_show_set_option(struct gn_show_screen *s, const struct gn_option_row *row, const char *text,
                        struct gn_err *err) {
    struct gn_show_looks looks;
    if (!s->show->config.changes)
        s->show->config.changes = gn_changes_create(s->show->config.options);
    if (!gn_changes_set(s->show->config.changes, row, text, err)) return false;
    if (!gn_show_build_looks(s->show, s->stage.scene, &looks, err)) { /* a mode cannot use it */
        gn_changes_undo(s->show->config.changes);
        return false;
    }
    s->looks = looks;
    s->stage.settings = gn_show_settings(s->show, s->kiosk.shown.mode);
    s->ahead.idle = false; /* the changed settings have no programs yet */
    gn_show_take_rules(s);
    if (!gn_show_reload_is_staged(s)) /* it was prepared with the old options */
        gn_show_drop_staged(s);
    s->show->config.waits = true;
    return true;
}

/* The old picture stays until the programs are made. */
void gn_show_enter_set(struct gn_show_screen *s) {
    if (!s->show->config.waits) return;
    if (s->stage.gl && !(s->looks.ready >> s->kiosk.shown.mode & 1)) return;
    s->show->config.waits = false;
    gn_show_enter(s);
}
