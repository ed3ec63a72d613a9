/* From arguments to the first mode: shared by start and reload. */
#include <stdlib.h>

#include "core/arena.h"
#include "kiosk/private.h"
#include "options/args.h"

void gn_show_drop_options(struct gn_options *options) {
    if (options) gn_options_finish(options);
    free(options);
}

struct gn_options *gn_show_read_options(const struct gn_options *like, struct gn_warnings *warnings,
                                        struct gn_err *err) {
    struct gn_options *o = gn_xalloc(1, sizeof *o);
    if (gn_args_parse(o, like->argc, like->argv, warnings, err)) {
        gn_options_run_as(o, GN_COMMAND_SHOW); /* also for the bare command */
        return o;
    }
    gn_show_drop_options(o);
    return NULL;
}

/* With modes in the file one of them is always on. */
bool gn_show_load(struct gn_stage *stage, struct gn_options *o, struct gn_warnings *warnings,
                  struct gn_err *err) {
    if (!o->settings->mode && o->mode_count > 0) o->settings = &o->all[1];
    return gn_stage_load(stage, o->settings, warnings, err);
}

bool gn_show_begin(struct gn_show *s, struct gn_err *err) {
    gn_show_list_modes(s);
    s->kiosk = (struct gn_kiosk){.shown.mode = s->modes.first, .wanted.mode = s->modes.first};
    s->scenes.shown = gn_kiosk_scene(&s->rules, &s->kiosk.shown);
    if (!gn_show_look(s, s->stage.scene, &s->looks, err)) return false;
    gn_show_enter(s);
    return true;
}
