/* [kiosk] watch: the files that are watched are kiosk.ini, the scene that is shown, the one that
 * the configuration wants, which may be missing or broken, and one of next-scene or of a mode that
 * could not be shown. [kiosk] content: the link that gnomon take turns is, with watch or without.
 */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "kiosk/content.h"
#include "kiosk/part.h"
#include "take/shown.h"

struct follow {
    const struct gn_part_host *host;
    struct gn_contents files;
};

/* Another version than the one that is shown. */
static bool is_turned(const struct gn_options *o) {
    const char *folder = o->settings->kiosk.content;
    struct gn_take_shown shown;
    return strcmp(folder, "no") != 0 && gn_take_shown(folder, &shown) &&
           (!o->content || strcmp(o->content, shown.folder) != 0);
}

static void begin_follow(void *part) { ((struct follow *)part)->files.watch.fd = -1; }

static void follow_files(void *part, enum gn_part_load what) {
    struct follow *f = part;
    const struct gn_part_host *h = f->host;
    const struct gn_options *o = *h->options;
    const struct gn_kiosk_settings *kiosk = &o->settings->kiosk;
    char link[PATH_MAX] = "", text[200];
    if (strcmp(kiosk->content, "no") != 0 &&
        snprintf(link, sizeof link, "%s/" GN_TAKE_CURRENT, kiosk->content) >= (int)sizeof link)
        link[0] = '\0';
    const char *paths[6] = {link, o->config_path, o->base_path};
    h->scene_files(h->show, paths + 3);
    const int count = kiosk->watch ? sizeof paths / sizeof paths[0] : 1;
    const bool is_open = f->files.watch.fd >= 0;
    if (!kiosk->watch && !link[0]) {
        gn_content_close(&f->files);
        gn_problem_cure(h->problems, GN_PROBLEM_WATCH);
    } else if (is_open || gn_content_open(&f->files, h->loop)) {
        gn_content_follow(&f->files, paths, count, what == GN_PART_LOAD_FAILED && kiosk->watch);
        gn_problem_cure(h->problems, GN_PROBLEM_WATCH);
    } else {
        snprintf(text, sizeof text, "%s: changes of files are not noticed: %s",
                 kiosk->watch ? gn_settings_label(o->settings, kiosk.watch)
                              : gn_settings_label(o->settings, kiosk.content),
                 strerror(errno));
        gn_problem_report(h->problems, GN_PROBLEM_WATCH, text);
    }
    /* content may have been turned while the options were read */
    if (what == GN_PART_LOAD_OPTIONS && f->files.watch.fd >= 0) f->files.changed |= is_turned(o);
}

/* New content also replaces the scene of ctl scene. */
static void renew_content(void *part) {
    struct follow *f = part;
    const struct gn_part_host *h = f->host;
    if (f->files.changed && h->renew(h->show, is_turned(*h->options))) f->files.changed = false;
}

static void close_follow(void *part) { gn_content_close(&((struct follow *)part)->files); }

static const void *follow_status(void *part) {
    const struct follow *f = part;
    return f->files.watch.fd >= 0 ? f : NULL;
}

static const struct gn_metric metrics[] = {
    GN_METRIC(struct follow, files.count, "watch.files", "", "whose changes are noticed"),
};

const struct gn_part gn_part_content = {
    .name = "content",
    .size = sizeof(struct follow),
    .begin = begin_follow,
    .loaded = follow_files,
    .look = renew_content,
    .status = follow_status,
    GN_PART_METRICS(metrics),
    .close = close_follow,
};
