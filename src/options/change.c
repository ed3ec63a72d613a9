#include "options/change.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "options/value.h"

enum { PLACE_BYTES = 512 }; /* a larger text gets more */

struct change { /* of one option */
    struct gn_arena places[2];
    unsigned now;
    char label[40]; /* "set shadow" */
};
struct gn_changes {
    struct gn_options *options;
    struct gn_settings *spare; /* as many as options->all */
    struct change *last;
    struct change rows[GN_OPTION_COUNT];
};

struct gn_changes *gn_changes_create(struct gn_options *options) {
    struct gn_changes *changes = gn_xalloc(1, sizeof *changes);
    changes->options = options;
    changes->spare = gn_xalloc((size_t)options->all_count, sizeof *changes->spare);
    return changes;
}

void gn_changes_destroy(struct gn_changes *changes) {
    if (!changes) return;
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        for (int p = 0; p < 2; p++) gn_arena_finish(&changes->rows[i].places[p]);
    free(changes->spare);
    free(changes);
}

/* ---- the option
 * ---------------------------------------------------------------------------------- */

static const char *const why_fixed[] = {
    [GN_CHANGE_NEVER] = "is not an option of the kiosk",
    [GN_CHANGE_LIVE] = NULL,
    [GN_CHANGE_RELOAD] =
        "takes a reload: change it in the configuration file, then gnomon ctl reload",
    [GN_CHANGE_RESTART] =
        "takes a restart: change it in the configuration file, then restart the kiosk",
};

/* "max-fps" as "max_fps" */
static void spell_key(const char *key, char *out, size_t size) {
    snprintf(out, size, "%s", key);
    for (char *c = out; *c; c++)
        if (*c == '-') *c = '_';
}

const struct gn_option_row *gn_changes_find(const char *key, struct gn_err *err) {
    struct gn_text_guess guess = {0};
    char spelled[80], name[64], names[GN_OPTION_COUNT][32];
    spell_key(key, spelled, sizeof spelled);
    const char *dot = strchr(spelled, '.');
    const size_t length = dot ? (size_t)(dot - spelled) : 0;
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (!row->section) continue;
        if (dot && (strlen(row->section) != length || strncmp(row->section, spelled, length) != 0))
            continue;
        gn_option_key(row, name, sizeof name);
        if (strcmp(name, dot ? dot + 1 : spelled) == 0) return row;
        spell_key(row->name, name, sizeof name); /* [display] mode is display_mode */
        if (strcmp(name, dot ? dot + 1 : spelled) == 0) return row;
    }
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        gn_option_key(&gn_option_rows[i], names[i], sizeof names[i]);
        if (gn_option_rows[i].change == GN_CHANGE_LIVE) gn_text_guess(&guess, spelled, names[i]);
    }
    if (guess.name)
        gn_fail_usage(err, "unknown key \"%.60s\"; did you mean %s?", spelled, guess.name);
    else
        gn_fail_usage(err, "unknown key \"%.60s\"; expected a key of [scene], [render] or [kiosk]",
                      spelled);
    return NULL;
}

/* ---- changing ------------------------------------------------------------------------------- */

static void swap_settings(struct gn_changes *changes) {
    struct gn_options *options = changes->options;
    struct gn_settings *before = options->all;
    options->settings = changes->spare + (options->settings - before);
    options->all = changes->spare;
    changes->spare = before;
    changes->last->now = !changes->last->now;
}

bool gn_changes_set(struct gn_changes *changes, const struct gn_option_row *row, const char *text,
                    struct gn_err *err) {
    const struct gn_options *options = changes->options;
    if (row->change != GN_CHANGE_LIVE)
        return gn_fail_usage(err, "%s %s", row->name, why_fixed[row->change]);
    /* whoever may use the socket would choose files that the kiosk opens with its rights */
    if (row->kind == GN_KIND_PATH && !gn_option_has_choice(row, text))
        return gn_fail_usage(err, "%s: only a word can be set, no file: a file %s", row->name,
                             why_fixed[GN_CHANGE_RELOAD]);
    struct change *change = &changes->rows[row - gn_option_rows];
    struct gn_arena *place = &change->places[!change->now];
    _Alignas(16) char value[sizeof(struct gn_limits)] = {0};
    snprintf(change->label, sizeof change->label, "set %s", row->name);
    place->block = PLACE_BYTES;
    gn_arena_reset(place);
    if (!gn_options_parse(options, row, text, value, place, change->label, err)) return false;
    for (int i = 0; i < options->all_count; i++) {
        changes->spare[i] = options->all[i];
        gn_settings_put(&changes->spare[i], row, value, GN_SOURCE_SET, change->label);
    }
    changes->last = change;
    swap_settings(changes);
    return true;
}

void gn_changes_undo(struct gn_changes *changes) { swap_settings(changes); }
