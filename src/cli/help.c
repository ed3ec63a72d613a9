#include "cli/help.h"

#include <string.h>

#include "core/terminal.h"
#include "core/text.h"
#include "options/binding.h"
#include "options/command.h"
#include "options/section.h"
#include "options/topic.h"
#include "options/value.h"
#include "options/viewer_keys.h"
#include "scene/scene.h"
#include "shadow/technique.h"

#define COLUMN 26 /* where the phrases of --help begin */
#define WIDTH  96 /* of a line, but on a narrower terminal */
#define FEW    15 /* options that fit a screen beside a command's examples */

const struct gn_help_entry gn_help_exits[] = {
    {"0", "done; show and the window also after SIGTERM or SIGINT"},
    {"1", "runtime error: a file, a driver, a device or a scene"},
    {"2", "wrong usage, also a value outside its range"},
    {"3", "compare: the pictures differ; doctor --compare: the second report is worse"},
    {"70", "the display could not be recovered: restart the program"},
    {"130, 143", "another command was interrupted by SIGINT or SIGTERM"},
    {0},
};

/* ---- texts --------------------------------------------------------------------------------- */

void gn_help_phrase(const struct gn_option_row *row, char *out, size_t size) {
    char limits[400];
    const char *word, *fallback = row->fallback, *unit = row->unit;
    const bool only_words = row->kind != GN_KIND_COLOR && row->kind != GN_KIND_PATH;
    snprintf(out, size, "%s", row->help);
    for (int i = 0; (word = gn_value_word(row, i)); i++)
        gn_text_add(out, size, "%s%s",
                    i == 0 ? (only_words ? ". One of: " : ". Or: ")
                    : row->kind == GN_KIND_TECHNIQUES && i == GN_TECHNIQUE_TRUTH
                        ? "; for render also "
                        : ", ",
                    word);
    if (row->kind == GN_KIND_LIMIT) {
        gn_scene_limits_list(limits, sizeof limits);
        gn_text_add(out, size, ". Limits: %s", limits);
    }
    /* "(default 1280x720 pixels)", "(in degrees)", "(in stops; default auto)" */
    if (fallback && (!unit || strchr("-0123456789", fallback[0])))
        gn_text_add(out, size, " (default %s%s%s)", fallback, unit ? " " : "", unit ? unit : "");
    else if (fallback || unit)
        gn_text_add(out, size, " (in %s%s%s)", unit, fallback ? "; default " : "",
                    fallback ? fallback : "");
}

bool gn_help_default_button(int index, char *keys, size_t size, const char **action) {
    static struct gn_buttons buttons;
    gn_buttons_defaults(&buttons);
    if (index >= buttons.count) return false;
    const struct gn_button_config *button = &buttons.items[index];
    const char *line = button->opts.line, *from = button->opts.keys;
    size_t used = 0;
    for (; *from && used + 2 < size; from++) {
        if (*from == ' ') keys[used++] = ',';
        keys[used++] = *from;
    }
    snprintf(keys + used, size - used, "%s%s", line ? "; " : "", line ? line : "");
    *action = gn_action_name(button->on[GN_GESTURE_PRESS].action.kind);
    return true;
}

/* ---- lines --------------------------------------------------------------------------------- */

/* A name and, from COLUMN on, its meaning, wrapped before the end of a line. */
static void print_entry(FILE *to, const char *name, const char *meaning) {
    const int columns = gn_terminal_columns(stdout),
              width = columns && columns < WIDTH ? columns : WIDTH;
    int at = fprintf(to, "  %s", name);
    if (at >= COLUMN) at = fprintf(to, "\n") - 1;
    at += fprintf(to, "%*s", COLUMN - 1 - at, "");
    while (*meaning) {
        int length = (int)strcspn(meaning, " ");
        if (at + 1 + length > width) at = fprintf(to, "\n%*s", COLUMN - 1, "") - 1;
        at += fprintf(to, " %.*s", length, meaning);
        meaning += length;
        meaning += strspn(meaning, " ");
    }
    fputc('\n', to);
}

/* ---- groups of options: the sections of the INI file, [render] in two ------------------------ */

static bool is_of_shadows(const struct gn_option_row *row) {
    static const char *const names[] = {"shadow", "map",      "planar",    "taps",
                                        "filter", "cascades", "cast-faces"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strncmp(row->name, names[i], strlen(names[i])) == 0) return true;
    return false;
}

static void print_option(FILE *to, const struct gn_option_row *row) {
    char text[500], name[80], letter[8] = "    ";
    if (row->letter) snprintf(letter, sizeof letter, "-%c, ", row->letter);
    snprintf(name, sizeof name, "%s--%s%s%s", letter, row->name, row->value ? " " : "",
             row->value ? row->value : "");
    gn_help_phrase(row, text, sizeof text);
    print_entry(to, name, text);
}

/* section NULL: options that the INI file does not have */
static void print_group(FILE *to, const struct gn_section_row *section, bool shadows,
                        enum gn_command command) {
    bool begun = false;
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        const bool in_group =
            section ? gn_option_is_of(row, section->title) && is_of_shadows(row) == shadows
                    : !row->section;
        if (!(row->commands & 1u << command) || !in_group) continue;
        if (!begun && section)
            fprintf(to, "\n%s, [%s] in kiosk.ini:\n", shadows ? "shadows" : section->heading,
                    section->title);
        else if (!begun)
            fputs("\nother options:\n", to);
        begun = true;
        print_option(to, row);
    }
}

/* Of the options of a command those that most people need; false: it has so few that all are
 * printed. */
static bool print_first(FILE *to, enum gn_command command) {
    static const char *const names[] = {"out",    "size", "shadow", "camera", "time", "turntable",
                                        "frames", "fps",  "check",  "config", "json", "for"};
    int count = 0;
    for (int i = 0; i < GN_OPTION_COUNT; i++) count += gn_option_rows[i].commands >> command & 1;
    if (count <= FEW) return false;
    fprintf(to, "\noptions that are used most, of %d; --help=all prints all:\n", count);
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        const struct gn_option_row *row = gn_option_find(names[n], strlen(names[n]));
        if (row->commands & 1u << command) print_option(to, row);
    }
    return true;
}

/* ---- --help -------------------------------------------------------------------------------- */

static void print_usage(FILE *to, enum gn_command command) {
    if (command != GN_COMMAND_AUTO) {
        fprintf(to, "usage: gnomon %s\n\n  %s\n", gn_commands[command].usage,
                gn_commands[command].what);
        return;
    }
    fputs(
        "gnomon shows a 3-D scene with correct shadows on a screen, or writes it into a file.\n\n",
        to);
    for (int i = 0; i < GN_COMMAND_COUNT; i++) {
        char tag[80];
        snprintf(tag, sizeof tag, "gnomon %s", gn_commands[i].name ? gn_commands[i].name : "SCENE");
        print_entry(to, tag, gn_commands[i].what);
    }
    print_entry(to, "gnomon help COMMAND", "prints the options of a command");
    for (const struct gn_topic *t = gn_topics; t->name; t++) {
        char tag[80];
        snprintf(tag, sizeof tag, "gnomon help %s", t->name);
        print_entry(to, tag, t->what);
    }
    fputs("\nSCENE is a .glb or .gltf file; without one, gnomon shows its default scene, a "
          "sundial.\n"
          ".obj, .fbx, .stl, .ply and .dae files are converted by gnomon-import.\n",
          to);
}

static void print_keys(FILE *to) {
    char tag[60];
    const char *action;
    fputs("\nin a window:\n", to);
    for (const struct gn_viewer_key *key = gn_viewer_keys; key->name; key++)
        print_entry(to, key->name, key->meaning);
    fputs("\nkeys and GPIO lines, unless kiosk.ini has buttons of its own:\n", to);
    for (int i = 0; gn_help_default_button(i, tag, sizeof tag, &action); i++)
        print_entry(to, tag, action);
}

void gn_help_print(FILE *to, enum gn_command command, bool all) {
    print_usage(to, command);
    fputs("\nexamples:\n", to);
    for (int i = 0; i < GN_COMMAND_EXAMPLES; i++)
        fprintf(to, "  %s\n", gn_commands[command].examples[i]);
    if (command == GN_COMMAND_CTL) fputs("\ncommands:\n", to);
    for (int i = 0; command == GN_COMMAND_CTL && i < GN_CTL_COUNT; i++) {
        const struct gn_ctl_row *row = &gn_ctl_rows[i];
        char tag[60];
        snprintf(tag, sizeof tag, "%s%s%s", row->name, row->words[0] ? " " : "", row->words);
        print_entry(to, tag, row->what);
    }
    if (!all && print_first(to, command)) return;
    for (int place = 1; place <= GN_SECTION_COUNT; place++)
        for (int i = 0; i < GN_SECTION_COUNT; i++)
            for (int shadows = 0; shadows < 2 && gn_section_rows[i].place == place; shadows++)
                print_group(to, &gn_section_rows[i], shadows, command);
    print_group(to, NULL, false, command);
    if (command == GN_COMMAND_AUTO || command == GN_COMMAND_SHOW) print_keys(to);
}
