/* Host tool: completion bash|zsh|fish prints what completes gnomon's command line in that shell,
 * from the tables of commands and options. */
#include <stdio.h>
#include <string.h>

#include "cli/help.h"
#include "frame/caps.h"
#include "options/command.h"
#include "options/lesson.h"
#include "options/options.h"
#include "options/topic.h"
#include "options/value.h"
#include "scene/scene.h"

enum { TEXT = 1200 };

/* Their names alone: the rest needs what reads kiosk.ini. */
static const struct gn_lesson lessons[] = {
#define LESSON(...) {__VA_ARGS__},
#define FAULT(...)                                                                                 \
    { 0 }
#define CURE(...)                                                                                  \
    { 0 }
#include "options/lesson_rows.h"
};

/* ---- what the tables say -------------------------------------------------------------------- */

static const char *command_name(int command) {
    return gn_commands[command].name ? gn_commands[command].name : "auto";
}

static bool takes_file(const struct gn_option_row *row) {
    return row->kind == GN_KIND_PATH || row->kind == GN_KIND_SCENES;
}

/* Values with commas between them, which complete one by one. */
static bool takes_list(const struct gn_option_row *row) {
    return row->kind == GN_KIND_TECHNIQUES || row->kind == GN_KIND_CAPS;
}

static bool of_kiosk(const struct gn_option_row *row) {
    return row->change == GN_CHANGE_LIVE && row->commands & 1u << GN_COMMAND_SHOW;
}

static void add_word(char *out, const char *word, size_t length, const char *end) {
    const size_t used = strlen(out);
    snprintf(out + used, TEXT - used, "%s%.*s%s", used ? " " : "", (int)length, word, end);
}

/* The words that an option's value may be, a space between two; "": it is not one of a few. */
static void list_values(const struct gn_option_row *row, char *out) {
    char limits[400] = "";
    const char *word;
    out[0] = '\0';
    if (row->kind == GN_KIND_FLAG) add_word(out, "yes no", 6, "");
    for (int i = 0; (word = gn_value_word(row, i)); i++) add_word(out, word, strlen(word), "");
    for (int i = 0; row->kind == GN_KIND_CAPS && i < GN_CAP_COUNT; i++)
        add_word(out, gn_cap_names[i], strlen(gn_cap_names[i]), "");
    if (row->kind == GN_KIND_LIMIT) gn_scene_limits_list(limits, sizeof limits);
    for (const char *at = limits; *at;) { /* "file_mb (512), nodes (100000)" */
        const size_t length = strspn(at, "abcdefghijklmnopqrstuvwxyz_");
        if (length > 0) add_word(out, at, length, "=");
        at += strcspn(at, ",");
        at += strspn(at, ", ");
    }
}

/* The words after a command, a space between two; "": files. */
static void list_words(int command, char *out) {
    out[0] = '\0';
    for (int i = 0; gn_commands[command].words == GN_WORDS_REQUEST && i < GN_CTL_COUNT; i++)
        add_word(out, gn_ctl_rows[i].name, strlen(gn_ctl_rows[i].name), "");
    if (gn_commands[command].words != GN_WORDS_LESSON) return;
    add_word(out, "list all", 8, "");
    for (size_t i = 0; i < sizeof lessons / sizeof *lessons; i++)
        add_word(out, lessons[i].name, strlen(lessons[i].name), "");
}

/* The names of the options of `ctl set`, and of a mode. */
static void list_keys(char *out) {
    out[0] = '\0';
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        if (of_kiosk(&gn_option_rows[i]))
            add_word(out, gn_option_rows[i].name, strlen(gn_option_rows[i].name), "");
}

static void list_commands(char *out) {
    out[0] = '\0';
    for (int i = GN_COMMAND_SHOW; i < GN_COMMAND_COUNT; i++)
        add_word(out, gn_commands[i].name, strlen(gn_commands[i].name), "");
}

static void list_topics(char *out) {
    out[0] = '\0';
    for (const struct gn_topic *t = gn_topics; t->name; t++)
        add_word(out, t->name, strlen(t->name), "");
}

/* ---- bash ------------------------------------------------------------------------------------ */

/* --name, and its letter: "--out | -o" */
static void print_pattern(const struct gn_option_row *row) {
    printf("    --%s", row->name);
    if (row->letter) printf(" | -%c", row->letter);
    printf(") ");
}

static void print_bash_values(void) {
    char values[TEXT];
    puts("# _gnomon_values OPTION: sets words, list (they may follow each other, with commas) and "
         "files\n_gnomon_values() {\n    words='' list='' files=''\n    case $1 in");
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        list_values(row, values);
        if (!row->commands || (!values[0] && !takes_file(row))) continue;
        print_pattern(row);
        printf("words='%s'%s%s ;;\n", values, takes_list(row) ? " list=yes" : "",
               takes_file(row) ? " files=yes" : "");
    }
    puts("    esac\n}");
}

static void print_bash_options(void) {
    char words[TEXT];
    puts("# _gnomon_command COMMAND: sets options, those of them that take no value, and words\n"
         "_gnomon_command() {\n    options='' flags='' words=''\n    case $1 in");
    for (int command = 0; command < GN_COMMAND_COUNT; command++) {
        list_words(command, words);
        printf("    %s)\n        options='", command_name(command));
        for (int pass = 0; pass < 2; pass++) {
            if (pass) printf("'\n        flags='");
            for (int i = 0, more = 0; i < GN_OPTION_COUNT; i++)
                if (gn_option_rows[i].commands & 1u << command &&
                    (!pass || gn_option_rows[i].kind == GN_KIND_FLAG))
                    printf("%s--%s", more++ ? " " : "", gn_option_rows[i].name);
        }
        printf("'\n        words='%s'\n        ;;\n", words);
    }
    puts("    esac\n}");
}

static const char bash_code[] =
    "_gnomon() {\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} i\n"
    "    local command=auto at=0 before='' options='' flags='' words='' list='' files='' keys\n"
    "    keys='@KEYS@'\n"
    "    COMPREPLY=()\n"
    "    # bash splits --size=640x480 at the =\n"
    "    if [[ $current == = ]]; then\n"
    "        current=''\n"
    "    elif [[ $previous == = ]]; then\n"
    "        previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
    "    fi\n"
    "    for ((i = 1; i < COMP_CWORD; i++)); do\n"
    "        case ${COMP_WORDS[i]} in\n"
    "        @COMMANDS@ | help) command=${COMP_WORDS[i]} at=$i && break ;;\n"
    "        esac\n"
    "    done\n"
    "    _gnomon_command \"$command\"\n"
    "    if [[ $command == help ]]; then\n"
    "        words='@WORDS@ @TOPICS@'\n"
    "    elif [[ $previous == -* && \" $flags \" != *\" $previous \"* && $previous != -[hv] ]]; "
    "then\n"
    "        _gnomon_values \"$previous\"\n"
    "        [[ $list && $current == *,* ]] && before=${current%,*}, current=${current##*,}\n"
    "        [[ $words || $files ]] || return 0\n"
    "    elif [[ $current == -* ]]; then\n"
    "        words=$options files=''\n"
    "    elif [[ $command == auto ]]; then\n"
    "        words='@WORDS@ help version' files=yes\n"
    "    elif [[ $command == ctl && $previous == [gs]et ]]; then\n"
    "        words=$keys\n"
    "    elif [[ $command == ctl && ${COMP_WORDS[COMP_CWORD - 2]} == set ]]; then\n"
    "        _gnomon_values \"--$previous\"\n"
    "    elif [[ $command == ctl ]] && ((COMP_CWORD > at + 1)); then\n"
    "        [[ @FILES@ ]] && words='' files=yes || return "
    "0\n"
    "    elif [[ ! $words ]]; then\n"
    "        files=yes\n"
    "    fi\n"
    "    mapfile -t COMPREPLY < <(compgen -P \"$before\" -W \"$words\" -- \"$current\"\n"
    "        [[ ! $files ]] || compgen -f -- \"$current\")\n"
    "    [[ ! $files ]] || compopt -o filenames 2> /dev/null\n"
    "    [[ ${#COMPREPLY[@]} != 1 || ${COMPREPLY[0]} != *= ]] || compopt -o nospace 2> /dev/null\n"
    "}\n"
    "complete -F _gnomon gnomon";

/* Whether a command of ctl takes a file. */
static bool request_takes_file(const struct gn_ctl_row *row) {
    return row->members[0] && strcmp(row->members[0], "file") == 0;
}

static void print_files(const char *request) {
    for (int i = 0, more = 0; i < GN_CTL_COUNT; i++)
        if (request_takes_file(&gn_ctl_rows[i]))
            printf("%s%s == %s", more++ ? " || " : "", request, gn_ctl_rows[i].name);
}

/* `code` with @KEYS@, @TOPICS@, @COMMANDS@ (a pattern), @WORDS@ and @FILES@ (whether `request`, a
 * variable, is a command of ctl that takes a file) filled in. */
static void print_code(const char *code, const char *request) {
    char keys[TEXT], topics[TEXT], commands[TEXT];
    list_keys(keys);
    list_topics(topics);
    list_commands(commands);
    for (; *code; code++) {
        if (strncmp(code, "@KEYS@", 6) == 0) {
            fputs(keys, stdout);
            code += 5;
        } else if (strncmp(code, "@TOPICS@", 8) == 0) {
            fputs(topics, stdout);
            code += 7;
        } else if (strncmp(code, "@FILES@", 7) == 0) {
            print_files(request);
            code += 6;
        } else if (strncmp(code, "@WORDS@", 7) == 0) {
            fputs(commands, stdout);
            code += 6;
        } else if (strncmp(code, "@COMMANDS@", 10) == 0) {
            for (const char *c = commands; *c; c++)
                fputs(*c == ' ' ? " | " : (char[]){*c, 0}, stdout);
            code += 9;
        } else {
            putchar(*code);
        }
    }
    putchar('\n');
}

static void print_bash(void) {
    puts("# bash completion for gnomon, made from its table of options");
    print_bash_values();
    print_bash_options();
    print_code(bash_code, "$previous");
}

/* ---- zsh ------------------------------------------------------------------------------------- */

/* A text inside single quotes; what brackets and colons would end is escaped. */
static void print_quoted(const char *text, const char *escaped) {
    for (; *text; text++) {
        if (*text == '\'')
            fputs("'\\''", stdout);
        else
            printf("%s%c", strchr(escaped, *text) ? "\\" : "", *text);
    }
}

static void print_zsh_option(const struct gn_option_row *row) {
    char values[TEXT];
    list_values(row, values);
    for (int letter = 0; letter < (row->letter ? 2 : 1); letter++) {
        const bool flag = row->kind == GN_KIND_FLAG;
        if (letter)
            printf("        '-%c%s[", row->letter, flag ? "" : "+");
        else
            printf("        '--%s%s[", row->name, flag ? "" : "=");
        print_quoted(row->help, "[]\\");
        putchar(']');
        if (!flag) {
            putchar(':');
            print_quoted(row->value, ":\\");
            putchar(':');
        }
        if (!flag && takes_list(row))
            printf("_sequence compadd - %s", values);
        else if (!flag && takes_file(row))
            printf("%s%s", values[0] ? " _gnomon_file " : "_files", values);
        else if (!flag && row->kind == GN_KIND_LIMIT)
            printf("compadd -S \"\" - %s", values);
        else if (!flag && values[0])
            printf("(%s)", values);
        puts("' \\");
    }
}

static void print_zsh_command(int command) {
    char words[TEXT];
    list_words(command, words);
    printf("_gnomon_%s() {\n    _arguments -S \\\n", command_name(command));
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        if (gn_option_rows[i].commands & 1u << command) print_zsh_option(&gn_option_rows[i]);
    if (command == GN_COMMAND_AUTO)
        puts("        '1: :_gnomon_first'");
    else if (gn_commands[command].words == GN_WORDS_REQUEST)
        puts("        '*: :_gnomon_request'");
    else if (words[0])
        printf("        '1: :' '2:word:(%s)'\n", words);
    else
        puts("        '1: :' '*:file:_files'");
    puts("}");
}

/* _gnomon_setting KEY: the values of `ctl set KEY` */
static void print_zsh_settings(void) {
    char values[TEXT];
    puts("_gnomon_setting() {\n    case $1 in");
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        list_values(&gn_option_rows[i], values);
        if (of_kiosk(&gn_option_rows[i]) && values[0])
            printf("    %s) compadd -- %s ;;\n", gn_option_rows[i].name, values);
    }
    puts("    *) _message value ;;\n    esac\n}");
}

static void print_zsh_described(const char *function, bool requests) {
    printf("%s() {\n    local -a names=(\n", function);
    for (int i = requests ? 0 : GN_COMMAND_SHOW;
         i < (requests ? (int)GN_CTL_COUNT : (int)GN_COMMAND_COUNT); i++) {
        printf("        '%s:", requests ? gn_ctl_rows[i].name : gn_commands[i].name);
        print_quoted(requests ? gn_ctl_rows[i].what : gn_commands[i].what, ":\\");
        puts("'");
    }
    if (!requests) puts("        'help:the options of a command'\n        'version:the version'");
    puts("    )\n    _describe name names\n}");
}

static const char zsh_code[] =
    "_gnomon_file() { _alternative \"words:word:($*)\" 'files:file:_files' }\n"
    "_gnomon_first() { _alternative 'commands:command:_gnomon_commands' 'files:scene:_files' }\n"
    "_gnomon_request() {\n"
    "    local -i at=${words[(i)ctl]}\n"
    "    local request=${words[at+1]}\n"
    "    if ((CURRENT == at + 1)); then\n"
    "        _gnomon_requests\n"
    "    elif ((CURRENT == at + 2)) && [[ $request == [gs]et ]]; then\n"
    "        compadd -- @KEYS@\n"
    "    elif ((CURRENT == at + 3)) && [[ $request == set ]]; then\n"
    "        _gnomon_setting ${words[at+2]}\n"
    "    elif [[ @FILES@ ]]; then\n"
    "        _files\n"
    "    fi\n"
    "}\n"
    "_gnomon() {\n"
    "    local -a commands=(@WORDS@) found\n"
    "    if [[ ${words[2]} == help ]] && ((CURRENT == 3)); then\n"
    "        _alternative 'commands:command:_gnomon_commands' 'topics:topic:(@TOPICS@)'\n"
    "        return\n"
    "    fi\n"
    "    found=(${words[2,CURRENT-1]:*commands})\n"
    "    _gnomon_${found[1]:-auto}\n"
    "}\n"
    "_gnomon \"$@\"";

static void print_zsh(void) {
    puts("#compdef gnomon\n# zsh completion for gnomon, made from its table of options");
    for (int command = 0; command < GN_COMMAND_COUNT; command++) print_zsh_command(command);
    print_zsh_described("_gnomon_commands", false);
    print_zsh_described("_gnomon_requests", true);
    print_zsh_settings();
    print_code(zsh_code, "$request");
}

/* ---- fish ------------------------------------------------------------------------------------ */

static void print_fish_text(const char *text) {
    putchar('\'');
    for (; *text; text++) printf("%s%c", strchr("'\\", *text) ? "\\" : "", *text);
    putchar('\'');
}

static const char fish_code[] =
    "# fish completion for gnomon, made from its table of options\n"
    "function __gnomon_command\n"
    "    for word in (commandline -opc)[2..-1]\n"
    "        if contains -- $word @WORDS@ help version\n"
    "            echo $word\n"
    "            return\n"
    "        end\n"
    "    end\n"
    "    echo auto\n"
    "end\n"
    "function __gnomon_in\n"
    "    contains -- (__gnomon_command) $argv\n"
    "end\n"
    "# the command ctl, and as many words after it as $argv[1]; of them the first is one of the "
    "rest\n"
    "function __gnomon_request\n"
    "    set -l words (commandline -opc | string match -v -- '-*')\n"
    "    set -l at (contains -i -- ctl $words); or return 1\n"
    "    test (count $words) -eq (math $at + $argv[1]); or return 1\n"
    "    test (count $argv) -eq 1; or contains -- $words[(math $at + 1)] $argv[2..-1]\n"
    "end\n"
    "complete -c gnomon -n '__gnomon_in auto help' -f -a '@WORDS@'\n"
    "complete -c gnomon -n '__gnomon_in auto' -f -a 'help version'\n"
    "complete -c gnomon -n '__gnomon_in help' -f -a '@TOPICS@'\n"
    "complete -c gnomon -n '__gnomon_in ctl doctor help version' -f\n"
    "complete -c gnomon -n '__gnomon_request 1 get set' -f -a '@KEYS@'";

static void print_fish_option(const struct gn_option_row *row) {
    char values[TEXT];
    list_values(row, values);
    printf("complete -c gnomon -n '__gnomon_in");
    for (int i = 0; i < GN_COMMAND_COUNT; i++)
        if (row->commands & 1u << i) printf(" %s", command_name(i));
    printf("' -l %s", row->name);
    if (row->letter) printf(" -s %c", row->letter);
    if (row->kind != GN_KIND_FLAG) {
        printf(" %s", takes_file(row) ? "-r" : "-x");
        if (takes_list(row))
            printf(" -a '(__fish_append , %s)'", values);
        else if (values[0])
            printf(" -a '%s'", values);
    }
    printf(" -d ");
    print_fish_text(row->help);
    putchar('\n');
}

static void print_fish(void) {
    char values[TEXT];
    print_code(fish_code, "");
    for (int i = 0; i < GN_CTL_COUNT; i++)
        if (request_takes_file(&gn_ctl_rows[i]))
            printf("complete -c gnomon -n '__gnomon_request 1 %s' -F\n", gn_ctl_rows[i].name);
    for (int i = 0; i < GN_CTL_COUNT; i++) {
        printf("complete -c gnomon -n '__gnomon_request 0' -f -a %s -d ", gn_ctl_rows[i].name);
        print_fish_text(gn_ctl_rows[i].what);
        putchar('\n');
    }
    list_words(GN_COMMAND_LESSON, values);
    printf("complete -c gnomon -n '__gnomon_in lesson' -f -a '%s'\n", values);
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        if (gn_option_rows[i].commands) print_fish_option(&gn_option_rows[i]);
}

int main(int argc, char **argv) {
    const char *shell = argc == 2 ? argv[1] : "";
    if (strcmp(shell, "bash") == 0)
        print_bash();
    else if (strcmp(shell, "zsh") == 0)
        print_zsh();
    else if (strcmp(shell, "fish") == 0)
        print_fish();
    else
        return fputs("usage: completion bash|zsh|fish\n", stderr), 2;
    return ferror(stdout) || fclose(stdout) ? 1 : 0;
}
