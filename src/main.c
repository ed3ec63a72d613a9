/* Arguments -> a command; the one error line; the exit status. */
#include <signal.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/help.h"
#include "cli/topic.h"
#include "config.h"
#include "core/file.h"
#include "core/stop.h"
#include "core/terminal.h"
#include "options/args.h"

static gn_cli_command *const commands[GN_COMMAND_COUNT] = {
#define GN_COMMAND(ID, id, ...) [GN_COMMAND_##ID] = gn_cli_##id,
#include "options/command_rows.h"
#undef GN_COMMAND
};

static void print_help(enum gn_command command, bool all) {
    struct gn_terminal terminal;
    gn_help_print(gn_terminal_begin(&terminal, stdout), command, all);
    gn_terminal_end(&terminal);
}

static bool run(const struct gn_options *options, struct gn_warnings *warnings,
                struct gn_err *err) {
    const enum gn_command command = options->settings->run.command;
    const bool prints = options->settings->run.version || options->settings->run.help ||
                        options->settings->run.check;
    if (prints || !gn_commands[command].handles_signals) gn_stop_end_process();
    if (options->settings->run.version)
        puts("gnomon " GN_VERSION);
    else if (options->settings->run.topic)
        gn_topic_print(options->settings->run.topic - 1);
    else if (options->settings->run.help)
        print_help(command, options->settings->run.help_all);
    else if (options->settings->run.check)
        return gn_cli_check(options, warnings, err);
    else
        return commands[command](options, warnings, err);
    return true;
}

static void print_error(const char *text) {
    fprintf(stderr, "%sgnomon:%s %s\n", gn_terminal_tint(stderr, GN_TINT_RED),
            gn_terminal_tint(stderr, GN_TINT_NONE), text);
}

static int report(bool ok, const struct gn_options *options, struct gn_warnings *warnings,
                  const struct gn_err *err) {
    if (ok || options->settings->run.verbose) gn_warn_print(warnings, stderr);
    if (ok) return GN_EXIT_OK;
    for (int i = 0; options->errors && i < options->errors->count; i++)
        print_error(options->errors->items[i].text);
    print_error(err->text);
    return err->status == GN_EXIT_OK ? GN_EXIT_RUNTIME : err->status;
}

int main(int argc, char **argv) {
    static struct gn_warnings warnings;
    struct gn_options options;
    struct gn_err err = {0};
    gn_stop_block();
    gn_file_fill_standard();
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a write past the limit fails and is reported like a full disk */
    bool ok =
        gn_args_parse(&options, argc, argv, &warnings, &err) && run(&options, &warnings, &err);
    if (ok) ok = gn_file_flush_output(&err);
    int status = report(ok, &options, &warnings, &err);
    gn_options_finish(&options);
    return status;
}
