/* [kiosk] watch: the files that are watched are kiosk.ini, the scene that is shown, the one that
 * the configuration wants, which may be missing or broken, and one of next-scene or of a mode that
 * could not be shown. [kiosk] content: the link that gnomon take turns is, with watch or without.
 */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "kiosk/private.h"
#include "take/shown.h"

/* Another version than the one that is shown. */
bool gn_show_content_turned(const struct gn_show *s) {
    const struct gn_options *o = s->config.options;
    const char *folder = o->settings->kiosk.content;
    struct gn_take_shown shown;
    return strcmp(folder, "no") != 0 && gn_take_shown(folder, &shown) &&
           (!o->content || strcmp(o->content, shown.folder) != 0);
}

void gn_show_follow_content(struct gn_show *s, bool missed) {
    const struct gn_options *o = s->config.options;
    const struct gn_problems *problems = &s->problems;
    const bool fails = problems->of[GN_PROBLEM_SCENE][0];
    const struct gn_kiosk_settings *kiosk = &o->settings->kiosk;
    char link[PATH_MAX] = "", text[200];
    if (strcmp(kiosk->content, "no") != 0 &&
        snprintf(link, sizeof link, "%s/" GN_TAKE_CURRENT, kiosk->content) >= (int)sizeof link)
        link[0] = '\0';
    const char *const paths[] = {
        link,
        o->config_path,
        o->base_path,
        s->scenes.count > 0 ? s->scenes.paths[s->scenes.shown] : NULL,
        s->config.asked,
        fails && problems->scene < s->scenes.count ? s->scenes.paths[problems->scene] : NULL,
    };
    const int count = kiosk->watch ? sizeof paths / sizeof paths[0] : 1;
    const bool is_open = s->content.watch.fd >= 0;
    if (!kiosk->watch && !link[0]) {
        gn_content_close(&s->content);
        gn_problem_cure(&s->problems, GN_PROBLEM_WATCH);
    } else if (is_open || gn_content_open(&s->content, s->loop)) {
        gn_content_follow(&s->content, paths, count, missed && kiosk->watch);
        gn_problem_cure(&s->problems, GN_PROBLEM_WATCH);
    } else {
        snprintf(text, sizeof text, "%s: changes of files are not noticed: %s",
                 kiosk->watch ? gn_settings_label(o->settings, kiosk.watch)
                              : gn_settings_label(o->settings, kiosk.content),
                 strerror(errno));
        gn_problem_report(&s->problems, GN_PROBLEM_WATCH, text);
    }
}
