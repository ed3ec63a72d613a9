/* [kiosk] watch: the files that are watched are kiosk.ini, the scene that is shown, and the one
 * that the configuration wants, which may be missing or broken. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "kiosk/private.h"

void gn_show_follow_content(struct gn_show *s, bool missed) {
    const struct gn_options *o = s->config.options;
    const char *const paths[] = {
        o->config_path,
        s->scenes.count > 0 ? s->scenes.paths[s->scenes.shown] : NULL,
        s->config.asked,
    };
    const bool is_open = s->content.watch.fd >= 0;
    char text[200];
    if (!o->settings->kiosk.watch) {
        gn_content_close(&s->content);
    } else if (is_open || gn_content_open(&s->content, s->loop)) {
        gn_content_follow(&s->content, paths, sizeof paths / sizeof paths[0], missed);
    } else {
        snprintf(text, sizeof text, "%s: changes of files are not noticed: %s",
                 gn_settings_label(o->settings, kiosk.watch), strerror(errno));
        gn_show_report_problem(s, text);
    }
}
