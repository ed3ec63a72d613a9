#include "cli/take_check.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "cli/commands.h"
#include "core/child.h"
#include "options/args.h"

enum { CPU_S = 300, STALL_S = 600 };

struct work {
    const char *config; /* -c, or NULL */
    const char *folder;
};

/* ---- in the child --------------------------------------------------------------------------- */

static bool is_within(const char *path, const char *folder) {
    const size_t length = strlen(folder);
    return strncmp(path, folder, length) == 0 && path[length] == '/';
}

static void check_place(const char *path, const char *label, const char *folder,
                        struct gn_errors *errors) {
    char real[PATH_MAX];
    struct gn_err err = {0};
    if (!path || !strchr(path, '/') || !realpath(path, real))
        return; /* what is missing, the loader says */
    if (is_within(real, folder)) return;
    gn_fail(&err, "%s: \"%s\" is not in the folder gnomon; name it from there", label, path);
    gn_errors_take(errors, &err);
}

/* Of a copy nothing is shown that lies beside it: that would not come with the stick. The machine's
 * own kiosk.ini may name its font. */
static void check_places(const struct gn_options *o, const char *folder, struct gn_errors *errors) {
    for (int i = 0; i < o->all_count; i++) {
        const struct gn_settings *s = &o->all[i];
        const struct {
            const char *path, *label;
        } files[] = {{s->render.environment, gn_settings_label(s, render.environment)},
                     {s->render.font, gn_settings_label(s, render.font)}};
        for (int k = 0; k < s->scene.list.count; k++)
            check_place(s->scene.list.paths[k], gn_settings_label(s, scene.path), folder, errors);
        for (size_t k = 0; k < sizeof files / sizeof *files; k++)
            if (is_within(files[k].label, folder))
                check_place(files[k].path, files[k].label, folder, errors);
    }
}

static void check_copy(void *shared, const void *argument) {
    struct gn_take_findings *out = shared;
    const struct work *work = argument;
    char *argv[7] = {(char *)"gnomon", (char *)"show", (char *)"--content", (char *)work->folder};
    int argc = 4;
    if (work->config) {
        argv[argc++] = (char *)"-c";
        argv[argc++] = (char *)work->config;
    }
    struct gn_options options;
    struct gn_err err = {0};
    setrlimit(RLIMIT_CPU, &(struct rlimit){CPU_S, CPU_S});
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    if (!gn_args_parse(&options, argc, argv, &out->warnings, &err)) {
        gn_errors_take(&out->errors, &err);
        return;
    }
    if (options.config_error) {
        out->warnings = (struct gn_warnings){0}; /* they say the same */
        gn_fail(&err, "%s", options.config_error);
        gn_errors_take(&out->errors, &err);
        return;
    }
    check_places(&options, work->folder, &out->errors);
    if (out->errors.count) return;
    struct gn_errors *found = gn_xalloc(1, sizeof *found);
    options.errors = found;
    if (!options.config_path) options.config_path = work->folder;
    if (gn_cli_check(&options, &out->warnings, &err)) return;
    for (int i = 0; i < found->count; i++) gn_errors_take(&out->errors, &found->items[i]);
    if (found->count == 0) gn_errors_take(&out->errors, &err);
}

/* ---- its texts ------------------------------------------------------------------------------ */

/* The copy's folder means nothing to a reader: the message names the stick's. It is longer than
 * that name. */
static void rename_folder(char *text, const char *folder) {
    static const char name[] = "gnomon";
    const size_t length = strlen(folder), used = sizeof name - 1;
    for (char *at; (at = strstr(text, folder));) {
        for (size_t i = 0; i < used; i++) at[i] = name[i];
        memmove(at + used, at + length, strlen(at + length) + 1);
    }
}

bool gn_take_check(const struct gn_options *options, const char *folder,
                   struct gn_take_findings *out) {
    const struct work work = {options->settings->run.config, folder};
    const struct gn_child child = {.work = check_copy, .argument = &work, .stall_s = STALL_S};
    struct gn_err err = {0};
    struct gn_take_findings *shared = gn_child_share(sizeof *shared, &err);
    if (!shared || !gn_child_run(&child, shared, &err)) {
        gn_fail_prefix(&err, "gnomon: the program that looks at it");
        *out = (struct gn_take_findings){0};
        gn_errors_take(&out->errors, &err);
    } else {
        *out = *shared;
    }
    if (shared) gn_child_unshare(shared, sizeof *shared);
    for (int i = 0; i < out->errors.count; i++) rename_folder(out->errors.items[i].text, folder);
    for (int i = 0; i < out->warnings.count; i++) rename_folder(out->warnings.text[i], folder);
    return out->errors.count == 0;
}
