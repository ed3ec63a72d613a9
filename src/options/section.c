#include "options/section.h"

#include <string.h>

#include "core/text.h"
#include "options/buttons.h"

static bool is_of_mode(const struct gn_option_row *row);
static bool is_of_light(const struct gn_option_row *row) { return row->of_light; }

/* gn_options_resolve() makes settings of them, once the flags are there. */
static bool take_modes(struct gn_options *options, const struct gn_sections *sections, bool checks,
                       struct gn_err *err) {
    (void)checks, (void)err;
    options->modes = sections->items;
    options->mode_count = sections->count;
    return true;
}

static bool take_lights(struct gn_options *options, const struct gn_sections *sections, bool checks,
                        struct gn_err *err) {
    (void)checks, (void)err;
    options->all[0].lights = sections->items;
    options->all[0].light_count = sections->count;
    return true;
}

/* clang-format off */
const struct gn_section_row gn_section_rows[GN_SECTION_COUNT] = {
    {.title = "display", .heading = "display", .place = 6, .of_machine = true,
     .about = "These keys set the screen: card, connector, mode.."},
    {.title = "scene", .heading = "scene", .place = 1, .of_content = true, .of_modes = true,
     .about = "These keys set what is shown."},
    {.title = "render", .heading = "picture", .place = 2, .of_modes = true, .takes_whole_names = true,
     .about = "These keys set how the picture is drawn."},
    {.title = "camera", .heading = "camera", .place = 3, .of_content = true, .by_whole_names = true,
     .about = "These keys set the place of the camera, the file's or an added one, and how far the mouse may take it. [render] and modes take these keys, too, by the whole names of their options: camera_theta."},
    {.title = "light", .heading = "light of a scene without any", .place = 4, .of_content = true, .by_whole_names = true,
     .about = "These keys set the key light, which a scene without lights gets. [render] and modes take these keys, too, by the whole names of their options: light_azimuth."},
    {.title = "sun", .heading = "sun", .place = 5, .by_whole_names = true,
     .about = "With a place, or an azimuth and an altitude, these keys make a light the real sun: its direction, size, colour and strength follow from place and time. It is the directional light that has gnomon_sun in the scene, else the key light of a scene without lights, else the first directional light. [render] and modes take these keys, too, by the whole names of their options: date, sun_speed."},
    {.title = "kiosk", .heading = "kiosk", .place = 7,
     .about = "These keys set what gnomon show does by itself."},
    {.title = "schedule", .heading = "hours", .place = 8, .of_machine = true,
     .about = "These keys set when the screen is on, by local time."},
    {.title = "mode \"NAME\"", .has = is_of_mode, .takes_whole_names = true, .take = take_modes,
     .about = "There may be any number of modes; each has the keys of [scene], [render], [camera], [light] and [sun] that differ in it. The first one is shown at the start. Without any, and with a scene of your own, next and prev go through what that has: its cameras; the scenes of [scene], after the cameras of the one that is shown; its variants of materials. With one of each, they play the clip from its beginning; without a clip, they switch a turntable on and off. Each has the name that it has in the file, else its number (\"Camera 2\"). What an option or gnomon ctl set has chosen stays. With the sundial inside the program, in a window, and where --mode or a button names a technique, each technique is a mode; with the sundial next and prev go through soft, sharp and no shadows alone."},
    {.title = "light \"NAME\"", .has = is_of_light, .take = take_lights,
     .about = "These keys set the lights of that name: their node's, or their own. They override the scene's settings and those of [render]; a mode, an option and gnomon ctl set override them. \"shadow = none\" always holds. intensity is in candela, of a directional light in lux, as in the file; \"on = no\" switches a light off. Other keys are as in [render] and [light]:"},
    {.title = "button \"NAME\"", .rows = gn_button_rows, .row_count = GN_BUTTON_ROWS, .one_word = true, .take = gn_buttons_take,
     .about = "There may be any number of buttons; they replace the default ones, which are in gnomon(1)."},
};
/* clang-format on */
_Static_assert(GN_SECTIONS_MAX <= GN_BUTTONS_MAX, "an input takes so many");

bool gn_section_is_many(const struct gn_section_row *section) { return section->take; }

const struct gn_section_row *gn_section_find(const char *word, bool many) {
    const struct gn_section_row *row = gn_section_rows;
    for (const size_t length = strlen(word); row < gn_section_rows + GN_SECTION_COUNT; row++)
        if (gn_section_is_many(row) == many && strcspn(row->title, " ") == length &&
            memcmp(row->title, word, length) == 0)
            return row;
    return NULL;
}

void gn_section_list(char *out, size_t size) {
    out[0] = '\0';
    for (int i = 0; i < GN_SECTION_COUNT; i++)
        gn_text_add(out, size, "%s[%s]",
                    i == 0                      ? ""
                    : i == GN_SECTION_COUNT - 1 ? " or "
                                                : ", ",
                    gn_section_rows[i].title);
}

/* ---- keys ---------------------------------------------------------------------------------- */

static const struct gn_section_row *plain_section_of(const struct gn_option_row *row) {
    return row->section ? gn_section_find(row->section, false) : NULL;
}

static bool is_of_mode(const struct gn_option_row *row) {
    return row->section && plain_section_of(row)->of_modes;
}

const struct gn_option_row *gn_section_options(const struct gn_section_row *section, int *count) {
    *count = section->rows ? section->row_count : GN_OPTION_COUNT;
    return section->rows ? section->rows : gn_option_rows;
}

const char *gn_section_key(const struct gn_section_row *section, const struct gn_option_row *row,
                           char *buffer, size_t size) {
    const struct gn_section_row *own = plain_section_of(row);
    const bool has = section->rows
                         ? row >= section->rows && row < section->rows + section->row_count
                     : section->has ? section->has(row)
                                    : own == section;
    if (has) return gn_option_key(row, buffer, size);
    const struct gn_option_row whole = {.name = row->name};
    return own && own->by_whole_names && section->takes_whole_names
               ? gn_option_key(&whole, buffer, size)
               : NULL;
}

const struct gn_option_row *gn_section_find_key(const struct gn_section_row *section,
                                                const char *key) {
    int count;
    const struct gn_option_row *rows = gn_section_options(section, &count);
    for (int i = 0; i < count; i++) {
        char buffer[64];
        const char *own = gn_section_key(section, &rows[i], buffer, sizeof buffer);
        if (!own) continue;
        if (strcmp(own, key) == 0) return &rows[i];
        /* beside the short key, too; elsewhere gn_section_key() gave the whole name */
        const struct gn_section_row *of = plain_section_of(&rows[i]);
        const struct gn_option_row whole = {.name = rows[i].name};
        if (of && of->by_whole_names &&
            strcmp(gn_option_key(&whole, buffer, sizeof buffer), key) == 0)
            return &rows[i];
    }
    return NULL;
}
