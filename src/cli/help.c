#include "cli/help.h"

#include <string.h>

#include "options/buttons.h"
#include "options/command.h"
#include "shadow/technique.h"

#define COLUMN 26 /* where the phrases of --help begin */
#define WIDTH  96

static const struct {
    const char *status, *meaning;
} exits[] = {
    {"0", "done, also after SIGTERM or SIGINT"},
    {"1", "the world said no: a file, a driver, a scene"},
    {"2", "wrong usage, also a value outside its range"},
    {"70", "gave up on the display: restart me"},
};
static const struct {
    const char *path, *meaning;
} files[] = {
    {"$XDG_CONFIG_HOME/gnomon/kiosk.ini",
     "the configuration, if it is there (~/.config without the variable)"},
    {"/etc/gnomon/kiosk.ini", "else this one"},
};

static const struct {
    const char *key, *meaning;
} keys[] = {
    {"Escape, q", "end"},
    {"F11", "full screen, and back"},
    {"Home", "the view as the camera has it"},
    {"left button", "drags the scene round"},
    {"other buttons, shift", "drag it along"},
    {"wheel", "nearer, farther"},
};

/* ---- --help -------------------------------------------------------------------------------- */

/* Prints words from column `at` on, wrapped before WIDTH, ends the line. */
static void print_wrapped(FILE *to, int at, const char *text) {
    while (*text) {
        int length = (int)strcspn(text, " ");
        if (at + 1 + length > WIDTH) at = fprintf(to, "\n%*s", COLUMN - 1, "") - 1;
        at += fprintf(to, " %.*s", length, text);
        text += length;
        text += strspn(text, " ");
    }
    fputc('\n', to);
}

static void phrase(const struct gn_option_row *row, char *out, size_t size) {
    const char *choices_or_unit = row->unit ? row->unit : "";
    size_t used = (size_t)snprintf(out, size, "%s", row->help);
    for (const struct gn_choice *c = row->choices; c && c->name && used < size; c++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", c == row->choices ? ": " : ", ",
                                 c->name);
    for (int i = 0; row->kind == GN_KIND_TECHNIQUES && i < GN_TECHNIQUE_COUNT && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? ", " : ": ",
                                 gn_techniques[i].name);
    if (row->fallback && used < size)
        snprintf(out + used, size - used, " (%s%s%s)", row->fallback, choices_or_unit[0] ? " " : "",
                 choices_or_unit);
    else if (row->unit && used < size)
        snprintf(out + used, size - used, " (in %s)", row->unit);
}

static void print_option(FILE *to, const struct gn_option_row *row) {
    char text[400], letter[8] = "    ";
    if (row->letter) snprintf(letter, sizeof letter, "-%c, ", row->letter);
    phrase(row, text, sizeof text);
    int at = fprintf(to, "  %s--%s%s%s", letter, row->name, row->value ? " " : "",
                     row->value ? row->value : "");
    if (at >= COLUMN) at = fprintf(to, "\n") - 1;
    print_wrapped(to, at + fprintf(to, "%*s", COLUMN - 1 - at, ""), text);
}

static void print_options(FILE *to, unsigned commands) {
    fputs("\noptions:\n", to);
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        if (gn_option_rows[i].commands & commands) print_option(to, &gn_option_rows[i]);
}

static void print_keys(FILE *to) {
    fputs("\nin a window:\n", to);
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        fprintf(to, "  %-*s%s\n", COLUMN - 2, keys[i].key, keys[i].meaning);
}

static void ctl_tag(const struct gn_ctl_row *row, char *out, size_t size) {
    snprintf(out, size, "%s%s%s", row->name, row->words[0] ? " " : "", row->words);
}

static void print_ctl(FILE *to) {
    char tag[40];
    fputs("\ncommands:\n", to);
    for (int i = 0; i < GN_CTL_COUNT; i++) {
        ctl_tag(&gn_ctl_rows[i], tag, sizeof tag);
        print_wrapped(to, fprintf(to, "  %-*s", COLUMN - 3, tag), gn_ctl_rows[i].what);
    }
}

static void print_command(FILE *to, enum gn_command command) {
    fprintf(to, "usage: gnomon %s\n\n  %s\n", gn_commands[command].usage,
            gn_commands[command].what);
    if (command == GN_COMMAND_CTL) print_ctl(to);
    print_options(to, 1u << command);
    if (command == GN_COMMAND_SHOW) print_keys(to);
}

void gn_help_print(FILE *to, enum gn_command command) {
    if (command != GN_COMMAND_AUTO) {
        print_command(to, command);
        return;
    }
    fputs("gnomon puts a 3-D scene with true shadows on a screen or into a file.\n\nusage:\n", to);
    for (int i = 0; i < GN_COMMAND_COUNT; i++)
        fprintf(to, "  gnomon %s\n      %s\n", gn_commands[i].usage, gn_commands[i].what);
    fputs(
        "\nA SCENE is a .glb or .gltf file; without one, the sundial inside the program is shown.\n"
        "An .obj, .fbx, .stl, .ply or .dae is turned into one by gnomon-import, if that is there.\n"
        "`gnomon COMMAND --help` lists what that command takes.\n",
        to);
    print_options(to, ~0u);
    print_keys(to);
}

/* ---- the man page -------------------------------------------------------------------------- */

static void print_roff(FILE *to, const char *text) {
    if (*text == '.' || *text == '\'') fputs("\\&", to);
    for (; *text; text++)
        if (*text == '-')
            fputs("\\-", to);
        else if (*text == '\\')
            fputs("\\e", to);
        else if (*text == '"') /* would quote an argument of a macro */
            fputs("\\(dq", to);
        else
            fputc(*text, to);
}

static void print_tagged(FILE *to, const char *tag, const char *text) {
    fputs(".TP\n.B ", to);
    print_roff(to, tag);
    fputc('\n', to);
    print_roff(to, text);
    fputc('\n', to);
}

static void print_man_synopsis(FILE *to) {
    fputs(".SH SYNOPSIS\n.nf\n", to);
    for (int i = 0; i < GN_COMMAND_COUNT; i++) {
        fputs("gnomon ", to);
        print_roff(to, gn_commands[i].usage);
        fputc('\n', to);
    }
    fputs(".fi\n", to);
}

static void print_man_commands(FILE *to) {
    fputs(".SH COMMANDS\n", to);
    for (int i = 0; i < GN_COMMAND_COUNT; i++)
        print_tagged(to, gn_commands[i].name ? gn_commands[i].name : "(none)", gn_commands[i].what);
}

static void print_man_option(FILE *to, const struct gn_option_row *row) {
    char tag[120], text[700], key[64];
    int at = row->letter ? snprintf(tag, sizeof tag, "-%c, ", row->letter) : 0;
    snprintf(tag + at, sizeof tag - (size_t)at, "--%s%s%s", row->name, row->value ? " " : "",
             row->value ? row->value : "");
    phrase(row, text, sizeof text);
    size_t used = strlen(text);
    if (row->section)
        snprintf(text + used, sizeof text - used, ". INI: [%s] %s", row->section,
                 gn_option_key(row, key, sizeof key));
    used = strlen(text);
    snprintf(text + used, sizeof text - used, ".");
    print_tagged(to, tag, text);
}

static void print_man_options(FILE *to) {
    fputs(".SH OPTIONS\nWhat each command takes, `gnomon COMMAND \\-\\-help` says.\n", to);
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        if (gn_option_rows[i].commands) print_man_option(to, &gn_option_rows[i]);
}

static void print_man_ctl(FILE *to) {
    char tag[40];
    fputs(".SH CONTROL\n\\fBgnomon ctl\\fP sends one of these to the kiosk that runs:\n", to);
    for (int i = 0; i < GN_CTL_COUNT; i++) {
        ctl_tag(&gn_ctl_rows[i], tag, sizeof tag);
        print_tagged(to, tag, gn_ctl_rows[i].what);
    }
    fputs(".PP\nThe socket is a Unix stream socket. A request is a line with a JSON object, so is "
          "the "
          "reply:\n.PP\n.nf\n{\"cmd\":\"set\",\"key\":\"shadow\",\"value\":\"pcss\"}\n"
          "{\"key\":\"shadow\",\"value\":\"pcss\",\"ok\":true}\n"
          "{\"cmd\":\"mode\",\"name\":\"Nosuch\"}\n"
          "{\"ok\":false,\"error\":\"no mode \\e\"Nosuch\\e\"; ..\",\"status\":2}\n.fi\n.PP\n"
          "The kiosk's own user, root, and the members of the socket's group may ask.\n",
          to);
}

/* ---- the configuration file ---------------------------------------------------------------- */

static void print_man_ini_key(FILE *to, const char *section, const char *key, const char *value,
                              const char *text) {
    char tag[120], sentence[500];
    snprintf(tag, sizeof tag, "[%s] %s = %s", section, key, value);
    snprintf(sentence, sizeof sentence, "%s.", text);
    print_tagged(to, tag, sentence);
}

static void print_man_ini(FILE *to) {
    char text[400], key[64];
    fputs(".SH CONFIGURATION\nBeside the options above the configuration file knows:\n", to);
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (row->commands || !row->section) continue;
        phrase(row, text, sizeof text);
        print_man_ini_key(to, row->section, gn_option_key(row, key, sizeof key),
                          row->value ? row->value : "yes|no", text);
    }
    for (int i = 0; i < GN_BUTTON_KEY_COUNT; i++)
        print_man_ini_key(to, "button \"NAME\"", gn_button_key(i)->name, gn_button_key(i)->value,
                          gn_button_key(i)->help);
    fputs(
        ".PP\nAn ACTION is next, prev, mode NAME, next\\-scene, next\\-camera, pause, blank, info "
        "or none.\n"
        "Buttons in the file replace those that there are without it: the lines GPIO17 and GPIO27, "
        "and keys.\n"
        "\\fBgnomon show \\-\\-check FILE\\fP says whether a file is right. With a wrong one the "
        "kiosk starts with the\ndefaults; one that goes wrong later leaves it as it was. Either "
        "way it says why on the screen.\n",
        to);
}

static void print_man_keys(FILE *to) {
    fputs(".SH KEYS AND MOUSE\nIn a window:\n", to);
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        print_tagged(to, keys[i].key, keys[i].meaning);
}

static void print_man_files(FILE *to) {
    fputs(".SH FILES\nExactly one configuration file is read: the one that \\-c names, else the "
          "first there is of these,\n"
          "and only by \\fBshow\\fP and by \\fBgnomon\\fP without a command.\n",
          to);
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        print_tagged(to, files[i].path, files[i].meaning);
    fputs(".PP\nIts sections are [display], [scene], [render], [kiosk], any number of [mode "
          "\"NAME\"], "
          "which hold\nsettings of [scene] and [render], and of [button \"NAME\"]. A key is an "
          "option's name with _ for \\-; the scene is "
          "\\fBfile\\fP in [scene].\n"
          "A flag beats a mode, a mode beats a section, a section beats the default. Paths are "
          "seen from the\n"
          "folder of the file. A comment begins with ; or, at the start of a line, with #.\n"
          ".PP\n.nf\n[scene]\nfile = sundial.glb\n[render]\nshadow = pcf\nshadow_strength = "
          "0.7\n[mode \"Hard\"]\n"
          "shadow = hard\n.fi\n",
          to);
}

void gn_help_print_man(FILE *to, const char *version) {
    fprintf(to,
            ".TH GNOMON 1 \"\" \"gnomon %s\"\n.SH NAME\ngnomon \\- a 3\\-D scene with true shadows "
            "on a screen or in a file\n",
            version);
    print_man_synopsis(to);
    fputs(".SH DESCRIPTION\nA SCENE is a glTF 2.0 file, .glb or .gltf; without one, the sundial "
          "inside the program is shown.\nAn .obj, .fbx, .stl, .ply or .dae is turned into one by\n"
          "\\fBgnomon\\-import\\fP, a program of its own with limits on memory and time, which is "
          "looked for beside gnomon,\nin libexec and bin, and in PATH; "
          "\\fBgnomon\\-import \\-\\-help\\fP lists what it takes by hand.\n",
          to);
    print_man_commands(to);
    print_man_options(to);
    print_man_ctl(to);
    print_man_ini(to);
    print_man_keys(to);
    fputs(".SH EXIT STATUS\n", to);
    for (size_t i = 0; i < sizeof exits / sizeof exits[0]; i++)
        print_tagged(to, exits[i].status, exits[i].meaning);
    print_man_files(to);
}
