#include "options/args.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/text.h"
#include "options/content.h"
#include "options/file.h"
#include "options/lesson.h"
#include "options/topic.h"

struct flag {
    const struct gn_option_row *row;
    const char *text;
    char label[40]; /* "--size", "-o" */
};
struct args {
    struct gn_options *options;
    char *const *argv;
    int argc, at;
    struct flag *flags;
    int flag_count;
    const char *words[1 + GN_WORDS_MAX]; /* command, and what follows it; bare: a scene */
    int word_count;
    int topic; /* of gn_topics; -1: none */
};

/* ---- splitting ----------------------------------------------------------------------------- */

static bool add_flag(struct args *args, const struct gn_option_row *row, const char *text,
                     const char *label, struct gn_err *err) {
    bool is_flag = row->kind == GN_KIND_FLAG;
    if (is_flag && text) return gn_fail_usage(err, "%s takes no value", label);
    const char *next = args->argv[args->at];
    const bool is_option =
        next && strncmp(next, "--", 2) == 0 && gn_option_find(next + 2, strcspn(next + 2, "="));
    if (!is_flag && !text && next && !is_option) {
        text = next;
        args->at++;
    }
    if (!is_flag && !text) return gn_fail_usage(err, "%s needs a value: %s", label, row->value);
    struct flag *flag = &args->flags[args->flag_count++];
    *flag = (struct flag){.row = row, .text = is_flag ? "yes" : text};
    snprintf(flag->label, sizeof flag->label, "%s", label);
    return true;
}

static bool add_long(struct args *args, const char *name, struct gn_err *err) {
    size_t length = strlen(name);
    const struct gn_option_row *row = gn_option_find(name, length); /* --help=all is whole */
    const char *equals = row ? NULL : strchr(name, '=');
    if (equals) {
        length = (size_t)(equals - name);
        row = gn_option_find(name, length);
    }
    char label[40];
    if (!row) {
        struct gn_text_guess guess = {0};
        snprintf(label, sizeof label, "%.*s", (int)(length < 31 ? length : 31), name);
        for (int i = 0; i < GN_OPTION_COUNT; i++)
            if (gn_option_rows[i].commands) gn_text_guess(&guess, label, gn_option_rows[i].name);
        if (guess.name)
            return gn_fail_usage(err, "unknown option --%s; did you mean --%s?", label, guess.name);
        return gn_fail_usage(err, "unknown option --%s; --help lists the options", label);
    }
    snprintf(label, sizeof label, "--%s", row->name);
    return add_flag(args, row, equals ? equals + 1 : NULL, label, err);
}

/* -v, -o FILE, -oFILE, -vo FILE */
static bool add_letters(struct args *args, const char *letters, struct gn_err *err) {
    for (; *letters; letters++) {
        const struct gn_option_row *row = gn_option_find_letter(*letters);
        char label[] = {'-', *letters, '\0'};
        if (!row)
            return gn_fail_usage(err, "unknown option -%.*s; --help lists the options",
                                 *letters & 0x80 ? 4 : 1, letters);
        bool takes_rest = row->kind != GN_KIND_FLAG && letters[1];
        if (takes_rest && letters[1] == '=')
            return gn_fail_usage(err, "%s: write %s VALUE or --%s=VALUE, not %s%.80s", label, label,
                                 row->name, label, letters + 1);
        if (!add_flag(args, row, takes_rest ? letters + 1 : NULL, label, err)) return false;
        if (takes_rest) break;
    }
    return true;
}

static enum gn_command command_of(const char *word) {
    for (int i = GN_COMMAND_SHOW; i < GN_COMMAND_COUNT; i++)
        if (strcmp(word, gn_commands[i].name) == 0) return i;
    return GN_COMMAND_AUTO;
}

/* The row of the command that the first word names, or the bare one. */
static const struct gn_command_row *command_row(const struct args *args) {
    return &gn_commands[args->word_count > 0 ? command_of(args->words[0]) : GN_COMMAND_AUTO];
}

static bool fail_word(const struct gn_command_row *row, const char *word, struct gn_err *err) {
    return gn_fail_usage(err, "%s%sunexpected argument \"%.80s\": %s", row->name ? row->name : "",
                         row->name ? ": " : "", word, row->takes);
}

static bool add_word(struct args *args, const char *word, struct gn_err *err) {
    const struct gn_command_row *row = command_row(args);
    if (args->word_count > row->most) return fail_word(row, word, err);
    args->words[args->word_count++] = word;
    return true;
}

/* helps: it follows `help`, so it may be a topic, and is no file. */
static bool fail_command(const char *word, bool helps, struct gn_err *err) {
    static const char *const others[] = {"help", "version"};
    const char *other = helps ? "topic" : "file";
    struct gn_text_guess guess = {0};
    char list[200] = "", topics[100] = "";
    for (int i = GN_COMMAND_SHOW; i < GN_COMMAND_COUNT; i++) {
        gn_text_guess(&guess, word, gn_commands[i].name);
        gn_text_add(list, sizeof list, "%s, ", gn_commands[i].name);
    }
    for (int i = 0; i < 2; i++) gn_text_guess(&guess, word, others[i]);
    for (const struct gn_topic *t = gn_topics; helps && t->name; t++) {
        gn_text_guess(&guess, word, t->name);
        gn_text_add(topics, sizeof topics, "%s%s", topics[0] ? ", " : "; the topics are ", t->name);
    }
    if (guess.name)
        return gn_fail_usage(err, "\"%.80s\" is neither a command nor a %s; did you mean %s?", word,
                             other, guess.name);
    return gn_fail_usage(err,
                         "\"%.80s\" is neither a command nor a %s; the commands are %s%s, %s%s",
                         word, other, list, others[0], others[1], topics);
}

static bool split_arguments(struct args *args, struct gn_err *err) {
    bool only_words = false, ok = true;
    while (ok && args->at < args->argc) {
        const char *arg = args->argv[args->at++];
        const bool is_value = /* `ctl set exposure -2` */
            args->word_count > 1 && command_row(args)->words == GN_WORDS_REQUEST && arg[0] &&
            strchr("0123456789.", arg[1]);
        if (only_words || arg[0] != '-' || !arg[1] || is_value)
            ok = add_word(args, arg, err);
        else if (arg[1] != '-')
            ok = add_letters(args, arg + 1, err);
        else if (arg[2])
            ok = add_long(args, arg + 2, err);
        else
            only_words = true;
    }
    if (!ok) return false;
    /* `gnomon help [COMMAND|TOPIC]` is --help, `gnomon version` is --version */
    const char *word = args->word_count > 0 ? args->words[0] : "", *command = args->words[1];
    const bool is_help = strcmp(word, "help") == 0;
    if (!is_help && strcmp(word, "version") != 0) return true;
    if (command && !is_help) return gn_fail_usage(err, "unexpected argument \"%.80s\"", command);
    args->topic = command ? gn_topic_find(command) : -1;
    if (command && command_of(command) == GN_COMMAND_AUTO && args->topic < 0)
        return fail_command(command, true, err);
    args->words[0] = command;
    args->words[1] = NULL;
    args->word_count--;
    return add_flag(args, gn_option_find(word, strlen(word)), NULL, word, err);
}

static const struct flag *find_flag(const struct args *args, const char *name) {
    for (int i = args->flag_count - 1; i >= 0; i--)
        if (strcmp(args->flags[i].row->name, name) == 0) return &args->flags[i];
    return NULL;
}

/* ---- the command --------------------------------------------------------------------------- */

static enum gn_command command_now(const struct args *args) {
    return args->options->settings->run.command;
}

static bool choose_command(struct args *args, struct gn_err *err) {
    const char *first = args->words[0];
    const struct gn_command_row *row = command_row(args);
    const bool bare = !row->name;
    const int given = args->word_count - !bare;
    gn_options_run_as(args->options, (enum gn_command)(row - gn_commands));
    if (bare && first && !strpbrk(first, "./:") && access(first, F_OK) != 0)
        return fail_command(first, false, err);
    const int most = row->words_with && !find_flag(args, row->words_with) ? 0 : row->most;
    if (given > most) return fail_word(row, args->words[!bare + most], err);
    return given >= row->least || gn_fail_usage(err, "%s: expected %s", row->name, row->expects);
}

static bool check_flags(const struct args *args, struct gn_err *err) {
    const enum gn_command command = command_now(args);
    const struct flag *flag = args->flags, *end = args->flags + args->flag_count;
    while (flag < end && flag->row->commands & (1u << command)) flag++;
    if (flag == end) return true;
    char takers[80] = "";
    for (int i = GN_COMMAND_SHOW; i < GN_COMMAND_COUNT; i++)
        if (flag->row->commands & (1u << i))
            gn_text_add(takers, sizeof takers, "%s %s", takers[0] ? "," : "", gn_commands[i].name);
    const char *name = gn_commands[command].name;
    return gn_fail_usage(err, "%s is not valid for %s; it is valid for%s", flag->label,
                         name ? name : "the bare gnomon", takers);
}

/* ---- the INI file, the flags, the mode ----------------------------------------------------- */

/* The file; "" where there is none. With errors it is read to its end, without the lines that have
 * some. */
static bool load_config(struct gn_options *options, const char *path, bool to_its_end,
                        struct gn_err *err) {
    options->errors = NULL;
    if (to_its_end) options->errors = gn_arena_alloc(&options->arena, 1, sizeof *options->errors);
    return !path[0] || gn_config_load(options, path, NULL, err);
}

/* A kiosk runs without the lines that are wrong; what is laid over the file is used whole or not at
 * all. */
static void report_lines(struct gn_options *options, struct gn_warnings *warnings) {
    const struct gn_errors *errors = options->errors;
    options->errors = NULL;
    for (int i = 0; errors && i < errors->count; i++)
        gn_warn(warnings, "%s (running without it)", errors->items[i].text);
    if (!errors || errors->count == 0) return;
    const int more = errors->count + errors->dropped - 1;
    char text[sizeof errors->items[0].text + 32];
    gn_text_format(text, sizeof text, "%s", errors->items[0].text);
    if (more > 0) gn_text_add(text, sizeof text, " (and %d more)", more);
    options->config_error = gn_arena_strdup(&options->arena, text);
    options->config_shown = gn_arena_strdup(&options->arena, errors->items[0].shown);
}

static bool read_lesson(struct args *args, struct gn_err *err) {
    const char *name = args->words[1];
    if (!name || strcmp(name, "list") == 0 || strcmp(name, "all") == 0) return true;
    const struct gn_lesson *lesson = gn_lesson_find(name, err);
    return lesson && gn_lesson_load(args->options, lesson, err);
}

/* A kiosk whose file cannot be read runs with its defaults and shows the reason; where content
 * cannot, with the file alone. */
static bool read_config(struct args *args, struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_options *options = args->options;
    char found[PATH_MAX];
    const enum gn_command command = command_now(args);
    const struct gn_command_row *row = &gn_commands[command];
    if (row->config == GN_CONFIG_LESSON) return read_lesson(args, err);
    const struct flag *check = find_flag(args, "check"), *content = find_flag(args, "content");
    const struct flag *named = check ? check : find_flag(args, "config");
    const bool searches = row->config != GN_CONFIG_ASKED &&
                          !(row->config_unless && find_flag(args, row->config_unless));
    const bool is_kiosk = row->config == GN_CONFIG_KIOSK && !check;
    if (!searches || !gn_config_find(found, sizeof found)) found[0] = '\0';
    const char *path = named ? named->text : found;
    struct gn_err why = {0};
    const bool is_read = load_config(options, path, check || is_kiosk, &why);
    if (is_kiosk) report_lines(options, warnings);
    if (is_read &&
        (check || !row->lays_content ||
         gn_options_lay_content(options, content ? content->text : NULL, warnings, &why)))
        return true;
    const bool does_without =
        row->config == GN_CONFIG_OPTIONAL && !(named && why.status != GN_EXIT_USAGE);
    if (!is_kiosk && !does_without) {
        *err = why;
        return false;
    }
    gn_options_finish(options);
    gn_options_init(options, command);
    if (is_read) load_config(options, path, is_kiosk, NULL);
    report_lines(options, NULL);
    options->config_error = gn_arena_strdup(&options->arena, why.text);
    options->config_shown = gn_arena_strdup(&options->arena, why.shown);
    if (is_kiosk)
        gn_warn(warnings, "%s (running with %s)", why.text,
                is_read && path[0] ? path : "the defaults");
    return true;
}

static bool apply_flags(struct args *args, struct gn_err *err) {
    struct gn_options *options = args->options;
    for (int i = 0; i < args->flag_count; i++) {
        const struct flag *flag = &args->flags[i];
        if (!gn_options_set(options, flag->row, flag->text, GN_SOURCE_FLAG, flag->label, err))
            return false;
    }
    if (command_row(args)->words != GN_WORDS_SCENES) {
        const char **words = gn_arena_alloc(&options->arena, GN_WORDS_MAX, sizeof *words);
        if (!words) return gn_fail(err, "no memory left");
        options->word_count = args->word_count - 1;
        memcpy(words, args->words + 1, (size_t)options->word_count * sizeof *words);
        options->words = words;
        return true;
    }
    const struct gn_option_row *row = gn_option_find_key("scene", "file");
    for (int i = command_now(args) != GN_COMMAND_AUTO; i < args->word_count; i++)
        if (!gn_options_set(options, row, args->words[i], GN_SOURCE_FLAG, "SCENE", err))
            return false;
    return true;
}

/* --animation and --no-animation from the same source: reject instead of guessing. In a file it is
 * only a warning, or a kiosk would end. Of different sources the stronger wins:
 * gn_stage_look_build().
 */
static bool check_animation(const struct gn_settings *s, struct gn_warnings *warnings,
                            struct gn_err *err) {
    const char *clip = s->scene.animation;
    const enum gn_source source = gn_settings_from(s, scene.animation);
    if (!clip || !s->scene.no_animation || strcmp(clip, "none") == 0 ||
        source != gn_settings_from(s, scene.no_animation))
        return true;
    if (source == GN_SOURCE_FLAG)
        return gn_fail_usage(err, "--animation %s and --no-animation exclude each other: drop one",
                             clip);
    gn_warn(warnings, "%s: %s is not played, since %s holds", gn_settings_label(s, scene.animation),
            clip, gn_settings_label(s, scene.no_animation));
    return true;
}

bool gn_args_parse(struct gn_options *options, int argc, char *const *argv,
                   struct gn_warnings *warnings, struct gn_err *err) {
    struct args args = {.options = options, .argv = argv, .argc = argc, .at = 1, .topic = -1};
    size_t letters = 0; /* no argument makes more flags than it has letters */
    for (int i = 0; i < argc; i++) letters += strlen(argv[i]);
    args.flags = gn_xalloc(letters + 1, sizeof *args.flags);
    gn_options_init(options, GN_COMMAND_AUTO);
    bool ok = split_arguments(&args, err);
    struct gn_run_settings *run = &options->all[0].run;
    run->help_all = ok && find_flag(&args, "help=all");
    run->help = ok && (run->help_all || find_flag(&args, "help"));
    run->topic = ok ? args.topic + 1 : 0;
    run->version = ok && find_flag(&args, "version");
    if (run->help && args.words[0]) run->command = command_of(args.words[0]);
    if (ok && !run->help && !run->version) {
        ok = choose_command(&args, err) && check_flags(&args, err) &&
             read_config(&args, warnings, err) && apply_flags(&args, err);
        if (ok) gn_options_resolve(options);
        const struct gn_settings *s = options->settings;
        if (ok && s->run.mode && !gn_options_choose(options, s->run.mode, err)) {
            ok = options->config_error || /* it may be what the file has lost */
                 gn_fail_prefix(err, "%s", gn_settings_label(s, run.mode));
            if (ok) *err = (struct gn_err){0};
        }
        if (ok && s->run.here && !s->run.check)
            ok = gn_fail_usage(err, "--here is valid only with --check FILE");
        ok = ok && check_animation(options->settings, warnings, err);
    }
    options->argc = argc;
    options->argv = argv;
    free(args.flags);
    return ok;
}
