/* gnomon take: the folder gnomon of a USB stick becomes what a kiosk shows, once it is copied and
 * looked at; a text on the stick says what was done. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "cli/commands.h"
#include "cli/take_check.h"
#include "config.h"
#include "core/clock.h"
#include "core/file.h"
#include "core/text.h"
#include "take/take.h"

static const char report_name[] = "gnomon-status.txt";
enum { REPORT_MAX = 64 * 1024 };
struct report {
    char text[REPORT_MAX];
};
/* Lines end with CR LF, for any editor of a PC. */
#define ADD_LINE(r, ...) gn_text_add_line((r)->text, sizeof(r)->text, "\r\n", __VA_ARGS__)

/* ---- the report ----------------------------------------------------------------------------- */

static void add_time(struct report *r) {
    const time_t now = time(NULL);
    struct tm utc;
    char text[40] = "";
    if (gmtime_r(&now, &utc)) strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &utc);
    const bool is_set = now >= GN_CLOCK_PAST_S && gn_clock_was_set();
    ADD_LINE(r, "gnomon " GN_VERSION ", %s%s", text,
             is_set ? "" : " (this machine's clock may be wrong: nothing has set it)");
}

/* "12, of 2026-11-25 14:30 UTC" */
static void add_version(struct report *r, const struct gn_take *t, const char *what,
                        const char *version) {
    struct stat info;
    struct tm utc;
    char text[40] = "";
    const int number = (int)strcspn(version, "-");
    if (!version[0]) {
        ADD_LINE(r, "%s: none", what);
        return;
    }
    if (fstatat(t->versions, version, &info, 0) == 0 && gmtime_r(&info.st_mtime, &utc))
        strftime(text, sizeof text, ", of %Y-%m-%d %H:%M UTC", &utc);
    ADD_LINE(r, "%s: version %.*s%s", what, number, version, text);
}

/* A stick that cannot be written to has no report, which is no error. Beside the versions there is
 * always one. */
static void save_report(const struct report *r, const struct gn_take *t, const char *dir,
                        const char *stick) {
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s/%s", dir, report_name) < (int)sizeof path)
        gn_file_replace(path, r->text, strlen(r->text), NULL);
    if (t->from >= 0 &&
        snprintf(path, sizeof path, "%s/%s/%s", stick, t->name, report_name) < (int)sizeof path)
        gn_file_replace(path, r->text, strlen(r->text), NULL);
}

/* ---- taking --------------------------------------------------------------------------------- */

static bool take_fresh(const struct gn_options *o, struct gn_take *t, struct report *r,
                       struct gn_take_findings *found, struct gn_err *err) {
    if (!gn_take_copy(t, err)) return false;
    if (!gn_take_check(o, t->path, found)) {
        gn_take_drop(t);
        const char *first = found->errors.items[0].text;
        if (found->errors.count == 1) return gn_fail(err, "%s", first);
        return gn_fail(err, "%d errors; the first: %s", found->errors.count, first);
    }
    if (!gn_take_keep(t, err)) return false;
    const char *plural = t->count == 1 ? "" : "s";
    ADD_LINE(r, "This folder was taken over: %d file%s, %.1f MB.", t->count, plural,
             (double)t->bytes / (1 << 20));
    printf("taken: version %.*s, %d file%s, %.1f MB\n", (int)strcspn(t->shown, "-"), t->shown,
           t->count, plural, (double)t->bytes / (1 << 20));
    return true;
}

static bool take_stick(const struct gn_options *o, struct gn_take *t, const char *stick,
                       struct gn_warnings *warnings, struct gn_err *err) {
    static struct report report;
    static struct gn_take_findings findings;
    bool ok = true;
    add_time(&report);
    const enum gn_take_found found = gn_take_look(t, stick, err);
    switch (found) {
    case GN_TAKE_NOTHING: printf("nothing to take: no folder gnomon in %s\n", stick); return true;
    case GN_TAKE_FAILED: ok = false; break;
    case GN_TAKE_FRESH: ok = take_fresh(o, t, &report, &findings, err); break;
    case GN_TAKE_SAME:
        ADD_LINE(&report, "This folder is shown already.");
        puts("already shown");
        break;
    case GN_TAKE_BACK:
        ADD_LINE(&report, "This folder was shown until somebody went back to the version before, "
                          "or a kiosk did, since no picture came; it is not taken again unless "
                          "something in it changes.");
        puts("not taken again: gnomon take --rollback went back from it, and goes to it again");
        break;
    }
    if (!ok) ADD_LINE(&report, "This folder was NOT taken over: %s", err->text);
    /* one error alone is the reason that stands above */
    for (int i = 0; findings.errors.count > 1 && i < findings.errors.count; i++)
        ADD_LINE(&report, "- %s", findings.errors.items[i].text);
    for (int i = 0; i < findings.warnings.count; i++) {
        ADD_LINE(&report, "- warning: %s", findings.warnings.text[i]);
        gn_warn(warnings, "%s", findings.warnings.text[i]);
    }
    ADD_LINE(&report, "%s", "");
    add_version(&report, t, "Shown now", t->shown);
    const bool has_other = t->before[0] && strcmp(t->before, t->shown) != 0;
    add_version(&report, t, "The version before", has_other ? t->before : "");
    save_report(&report, t, o->settings->kiosk.content, stick);
    return ok;
}

static bool go_back(struct gn_take *t, struct gn_err *err) {
    if (!gn_take_back(t, err)) return false;
    printf("shown now: version %.*s\n", (int)strcspn(t->shown, "-"), t->shown);
    return true;
}

static void print_shown(const char *dir) {
    struct gn_take_shown shown;
    const bool has = gn_take_shown(dir, &shown);
    const char *what = shown.ini[0] ? shown.ini : shown.scene;
    if (has) printf("shown now: %s\n", what);
    if (!has) puts("shown now: nothing that was taken");
    printf("kept in: %s\n", dir);
}

bool gn_cli_take(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    const struct gn_settings *s = options->settings;
    const char *dir = s->kiosk.content;
    const char *stick = options->word_count > 0 ? options->words[0] : NULL;
    struct gn_take take;
    if (stick && s->run.rollback)
        return gn_fail_usage(err, "take: --rollback takes no folder: unexpected argument \"%.80s\"",
                             stick);
    if (strcmp(dir, "no") == 0)
        return gn_fail_usage(err, "take: nothing is to be taken: there is no content = DIR in "
                                  "[kiosk] of kiosk.ini, and no --content DIR");
    if (!stick && !s->run.rollback) {
        print_shown(dir);
        return true;
    }
    bool ok = gn_take_open(&take, &gn_disk, dir, NULL, err);
    if (ok) ok = stick ? take_stick(options, &take, stick, warnings, err) : go_back(&take, err);
    gn_take_close(&take);
    return ok;
}
