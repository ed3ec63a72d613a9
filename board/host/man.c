/* Host tool: man PAGE prints a page generated from the tables of commands and options: gnomon.1 or
 * gnomon.ini.5 (roff), or options.md, the table of keys in src/options/README.md. */
#include <string.h>

#include "cli/help.h"
#include "config.h"
#include "options/command.h"
#include "options/section.h"
#include "options/viewer_keys.h"

static const struct gn_help_entry variables[] = {
    {"WAYLAND_DISPLAY, DISPLAY",
     "one of them set: gnomon without a command opens a window there, else it uses the screen"},
    {"XDG_CONFIG_HOME", "where gnomon/kiosk.ini is looked for (~/.config)"},
    {"XDG_RUNTIME_DIR", "where the control socket is, if /run/gnomon cannot be written to"},
    {"NOTIFY_SOCKET, WATCHDOG_USEC, WATCHDOG_PID",
     "set by systemd: gnomon show sends READY=1, STATUS and WATCHDOG=1"},
    {"PATH", "where gnomon-import is looked for, after the folders of gnomon itself"},
    {"MESA_SHADER_CACHE_DIR, XDG_CACHE_HOME",
     "where Mesa keeps compiled shaders; with that folder kept between starts the first picture "
     "comes sooner"},
    {"CACHE_DIRECTORY, XDG_CACHE_HOME",
     "where prefiltered environments and models' ambient occlusion are kept: in the first itself, "
     "or in gnomon in the second (~/.cache); at most 16 of each, of 2 and of 4 MB at most"},
    {0},
};
static const struct gn_help_entry files[] = {
    {"$XDG_CONFIG_HOME/gnomon/kiosk.ini", "the configuration, see gnomon.ini(5)"},
    {"/etc/gnomon/kiosk.ini", "the same, if the first does not exist"},
    {"/run/gnomon/ctl", "the control socket, if that folder can be written to"},
    {"$XDG_RUNTIME_DIR/gnomon/ctl", "the control socket otherwise"},
    {0},
};

/* ---- roff ---------------------------------------------------------------------------------- */

static void print_roff(const char *text) {
    if (*text == '.' || *text == '\'') fputs("\\&", stdout);
    for (; *text; text++)
        if (*text == '-')
            fputs("\\-", stdout);
        else if (*text == '\\')
            fputs("\\e", stdout);
        else if (*text == '"') /* would quote an argument of a macro */
            fputs("\\(dq", stdout);
        else
            putchar(*text);
}

static void print_line(const char *before, const char *text, const char *after) {
    fputs(before, stdout);
    print_roff(text);
    fputs(after, stdout);
}

static void print_tagged(const char *tag, const char *text) {
    print_line(".TP\n.B ", tag, "\n");
    print_line("", text, "\n");
}

static void print_entries(const char *heading, const struct gn_help_entry *entry) {
    if (heading) printf(".SH %s\n", heading);
    for (; entry->name; entry++) print_tagged(entry->name, entry->meaning);
}

static void print_head(const char *page, int section, const char *what) {
    printf(".TH %s %d \"\" \"gnomon %s\"\n.SH NAME\n", page, section, GN_VERSION);
    print_roff(what);
    putchar('\n');
}

/* Paragraphs; a line that begins with a tab is an example. */
static void print_text(const char *text) {
    bool example = false;
    while (*text) {
        const int length = (int)strcspn(text, "\n");
        char line[400];
        snprintf(line, sizeof line, "%.*s", length, text);
        if ((line[0] == '\t') != example) {
            example = !example;
            puts(example ? ".PP\n.nf\n.RS" : ".RE\n.fi\n.PP");
        }
        if (line[0])
            print_line("", line + example, "\n");
        else
            puts(".PP");
        text += length + (text[length] == '\n');
    }
    if (example) puts(".RE\n.fi");
}

/* ---- gnomon(1) ------------------------------------------------------------------------------ */

static void print_synopsis(void) {
    fputs(".SH SYNOPSIS\n.nf\n", stdout);
    for (int i = 0; i < GN_COMMAND_COUNT; i++) print_line("gnomon ", gn_commands[i].usage, "\n");
    fputs("gnomon help [COMMAND|TOPIC]\ngnomon version\n.fi\n", stdout);
}

static void print_commands(void) {
    puts(".SH COMMANDS");
    for (int i = 0; i < GN_COMMAND_COUNT; i++)
        print_tagged(gn_commands[i].name ? gn_commands[i].name : "(none)", gn_commands[i].what);
    print_tagged("help", "prints all commands, or the options of one");
    print_tagged("version", "prints the version");
}

static void print_option(const struct gn_option_row *row) {
    char tag[120], text[700], key[64];
    int at = row->letter ? snprintf(tag, sizeof tag, "-%c, ", row->letter) : 0;
    snprintf(tag + at, sizeof tag - (size_t)at, "--%s%s%s", row->name, row->value ? " " : "",
             row->value ? row->value : "");
    gn_help_phrase(row, text, sizeof text);
    size_t used = strlen(text);
    used += (size_t)snprintf(text + used, sizeof text - used, ". For");
    for (int i = 0, more = 0; i < GN_COMMAND_COUNT; i++)
        if (row->commands & 1u << i)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s %s", more++ ? "," : "",
                                     gn_commands[i].name ? gn_commands[i].name : "no command");
    if (row->section)
        used += (size_t)snprintf(text + used, sizeof text - used, ". INI: [%s] %s", row->section,
                                 gn_option_key(row, key, sizeof key));
    snprintf(text + used, sizeof text - used, ".");
    print_tagged(tag, text);
}

static void print_control(void) {
    char tag[40];
    puts(".SH CONTROL\n\\fBgnomon ctl\\fP sends one of these to the running kiosk:");
    for (int i = 0; i < GN_CTL_COUNT; i++) {
        const struct gn_ctl_row *row = &gn_ctl_rows[i];
        snprintf(tag, sizeof tag, "%s%s%s", row->name, row->words[0] ? " " : "", row->words);
        print_tagged(tag, row->what);
    }
    print_text("\nThe socket is a Unix stream socket. A request is a line with a JSON object, and "
               "so is the reply:\n"
               "\t{\"cmd\":\"set\",\"key\":\"shadow\",\"value\":\"pcss\"}\n"
               "\t{\"key\":\"shadow\",\"value\":\"pcss\",\"ok\":true}\n"
               "\t{\"cmd\":\"mode\",\"name\":\"Nosuch\"}\n"
               "\t{\"ok\":false,\"error\":\"no mode \\\"Nosuch\\\"; ..\",\"status\":2}\n"
               "The kiosk's own user, root, and the members of the socket's group may connect.\n");
}

static void print_keys(void) {
    char keys[60];
    const char *action;
    puts(".SH KEYS AND MOUSE\nIn a window:");
    for (const struct gn_viewer_key *key = gn_viewer_keys; key->name; key++)
        print_tagged(key->name, key->meaning);
    puts(".PP\nIn a window, on the screen and in the terminal, unless the configuration has "
         "buttons of its own:");
    for (int i = 0; gn_help_default_button(i, keys, sizeof keys, &action); i++)
        print_tagged(keys, action);
}

static void print_examples(void) {
    puts(".SH EXAMPLES\n.nf");
    for (int i = 0; i < GN_COMMAND_COUNT; i++)
        for (int k = 0; k < GN_COMMAND_EXAMPLES; k++)
            print_line("", gn_commands[i].examples[k], "\n");
    puts(".fi");
}

static void print_gnomon(void) {
    print_head("GNOMON", 1, "gnomon - shows a 3-D scene with correct shadows");
    print_synopsis();
    puts(".SH DESCRIPTION");
    print_text(
        "gnomon shows a 3-D scene with correct shadows on a screen without a desktop, in a window, "
        "or writes it into a file. SCENE is a glTF 2.0 file, .glb or .gltf; without one, gnomon "
        "shows its default scene, a sundial.\n\n"
        "Files of other formats (.obj, .fbx, .stl, .ply, .dae) are converted by gnomon-import(1), "
        "which is looked for beside gnomon, in libexec and bin, and in PATH.\n\n"
        "Settings come from the default, the configuration file, a mode of it, an option and "
        "gnomon ctl set; each of these wins over those before it.\n");
    print_commands();
    puts(".SH OPTIONS\n\\fBgnomon help COMMAND\\fP prints the options of one command that are used "
         "most, \\fBgnomon COMMAND \\-\\-help=all\\fP all of them.");
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        if (gn_option_rows[i].commands) print_option(&gn_option_rows[i]);
    print_control();
    print_keys();
    print_examples();
    print_entries("ENVIRONMENT", variables);
    print_entries("FILES", files);
    print_entries("EXIT STATUS", gn_help_exits);
    puts(".SH SEE ALSO\n.BR gnomon\\-import (1),\n.BR gnomon.ini (5)");
}

/* ---- gnomon.ini(5) --------------------------------------------------------------------------- */

/* What a key does; of sections of many the row has it all. */
static const char *phrase_of(const struct gn_section_row *section, const struct gn_option_row *row,
                             char *out, size_t size) {
    if (section->rows) return row->help;
    gn_help_phrase(row, out, size);
    return out;
}

static const char *value_of(const struct gn_option_row *row) {
    return row->value ? row->value : "yes|no";
}

/* Whether the manual describes the row under that section: not under those whose keys are of
 * others. */
static bool is_described(const struct gn_section_row *section, const struct gn_option_row *row) {
    return section->rows || gn_option_is_of(row, section->title);
}

/* Keys that are of other sections, too, after a text that ends with a colon. */
static bool lists_keys(const struct gn_section_row *section) {
    return section->about[strlen(section->about) - 1] == ':';
}

static void print_section(const struct gn_section_row *section) {
    char tag[120], text[600], key[64];
    int count, more = 0;
    const struct gn_option_row *rows = gn_section_options(section, &count);
    snprintf(tag, sizeof tag, "[%s]", section->title);
    print_line(".SS ", tag, "\n");
    print_line("", section->about, "\n");
    for (int i = 0; i < count; i++) {
        gn_option_key(&rows[i], key, sizeof key);
        if (lists_keys(section) && section->has(&rows[i])) print_line(more++ ? ", " : "", key, "");
        if (!is_described(section, &rows[i])) continue;
        snprintf(tag, sizeof tag, "%s = %s", key, value_of(&rows[i]));
        print_tagged(tag, phrase_of(section, &rows[i], text, sizeof text));
    }
    if (more) puts(".");
}

static void print_ini(void) {
    print_head("GNOMON.INI", 5, "gnomon.ini - configuration of gnomon(1)");
    puts(".SH DESCRIPTION");
    print_text(
        "gnomon and gnomon show read one file: that of -c FILE, else "
        "$XDG_CONFIG_HOME/gnomon/kiosk.ini, else /etc/gnomon/kiosk.ini. The other commands read "
        "only that of -c FILE.\n\n"
        "A file has sections, and keys with values. A comment begins with ; or, at the start of a "
        "line, with #. An unknown key or a wrong value is an error that names file, line, key and "
        "what was expected. Relative paths start at the folder of the file.\n\n"
        "gnomon show --check FILE tests a file and all that it names. With a wrong file the kiosk "
        "starts with the defaults; after a reload with a wrong file it keeps the last good "
        "configuration. The error is on the screen, on stderr and in gnomon ctl status.\n");
    puts(".SH SECTIONS");
    for (int i = 0; i < GN_SECTION_COUNT; i++) print_section(&gn_section_rows[i]);
    char actions[240], sentence[280];
    gn_action_list(actions, sizeof actions);
    snprintf(sentence, sizeof sentence, "\nACTION is one of %s.\n", actions);
    print_text(sentence);
    puts(".SH EXAMPLES");
    print_text("\t[display]\n\tmode = 1920x1080@60\n\t[scene]\n\tfile = sundial.glb\n"
               "\t[mode \"Sharp\"]\n\tshadow = pcf\n\t[mode \"Soft\"]\n\tshadow = cone\n"
               "\tcamera = Top\n\t[button \"next\"]\n\tline = GPIO17\n\tkeys = space right\n"
               "\tpress = next\n\t[kiosk]\n\tidle = first\n");
    puts(".SH SEE ALSO\n.BR gnomon (1)");
}

/* ---- the table of keys, for src/options/README.md -------------------------------------------- */

static void print_row(const char *key, const char *value, const char *text) {
    printf("| `%s` | `", key);
    for (; *value; value++) printf("%s%c", *value == '|' ? "\\" : "", *value);
    printf("` | ");
    for (; *text; text++) printf("%s%c", *text == '|' ? "\\" : "", *text);
    puts(" |");
}

static void print_keys_of(const struct gn_section_row *section) {
    char text[600], key[64];
    int count, more = 0;
    const struct gn_option_row *rows = gn_section_options(section, &count);
    printf("### [%s]\n\n%s", section->title, section->about);
    for (int i = 0; lists_keys(section) && i < count; i++)
        if (section->has(&rows[i]))
            printf("%s `%s`", more++ ? "," : "", gn_option_key(&rows[i], key, sizeof key));
    puts(more ? "." : "");
    if (!section->has) puts("\n| key | value | |\n|---|---|---|");
    for (int i = 0; i < count; i++)
        if (is_described(section, &rows[i]))
            print_row(gn_option_key(&rows[i], key, sizeof key), value_of(&rows[i]),
                      phrase_of(section, &rows[i], text, sizeof text));
}

static void print_options(void) {
    for (int i = 0; i < GN_SECTION_COUNT; i++) {
        if (i > 0) putchar('\n');
        print_keys_of(&gn_section_rows[i]);
    }
}

int main(int argc, char **argv) {
    const char *page = argc == 2 ? argv[1] : "";
    if (strcmp(page, "gnomon.1") == 0)
        print_gnomon();
    else if (strcmp(page, "gnomon.ini.5") == 0)
        print_ini();
    else if (strcmp(page, "options.md") == 0)
        print_options();
    else
        return fputs("usage: man gnomon.1|gnomon.ini.5|options.md\n", stderr), 2;
    return ferror(stdout) || fclose(stdout) ? 1 : 0;
}
