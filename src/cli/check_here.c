/* gnomon show --check FILE --here: what the settings ask of the machine, and whether it has it.
 * What a kiosk could not do is an error; what it waits for, or does in another way, a warning. */
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/doctor_report.h"
#include "core/text.h"
#include "display/cec.h"
#include "input/line_find.h"

struct here {
    const struct gn_options *options;
    struct gn_doctor_report *report;
    struct gn_errors *errors;
    struct gn_warnings *warnings;
};

static void add_error(struct here *h, struct gn_err *err) { gn_errors_take(h->errors, err); }

/* ---- buttons ------------------------------------------------------------------------------- */

/* A kiosk that runs already holds its lines itself. */
static bool check_line(const char *button, const char *text, const struct gn_line_match *match,
                       const struct gn_line_search *search, struct gn_err *err) {
    const struct gn_gpio_line *line = &match->line;
    if (search->chips == 0)
        return gn_fail(err, "button \"%s\": line %s: this machine has no GPIO chip", button, text);
    if (match->count == 0 && search->refused)
        return gn_fail(err,
                       "button \"%s\": line %s: no permission to open %s; add the user to group "
                       "gpio (sudo usermod -aG gpio USER) and log in again",
                       button, text, search->refused_path);
    if (match->count == 0)
        return gn_fail(err, "button \"%s\": no GPIO line here is %s; gnomon doctor lists them",
                       button, text);
    if (match->count > 1)
        return gn_fail(err, "button \"%s\": %d lines are named %s: %.150s; use label:CHIP/NUMBER",
                       button, match->count, text, match->list);
    if (line->used && strcmp(line->consumer, "gnomon") != 0)
        return gn_fail(err, "button \"%s\": line %s is in use by %s; free it or use another line",
                       button, text, line->consumer[0] ? line->consumer : "another program");
    return true;
}

static void check_buttons(struct here *h) {
    const struct gn_buttons *buttons = h->options->buttons;
    struct gn_line_spec specs[GN_BUTTONS_MAX];
    const struct gn_line_spec *wanted[GN_BUTTONS_MAX] = {0};
    struct gn_line_match matches[GN_BUTTONS_MAX];
    struct gn_line_search search;
    struct gn_err err = {0};
    int count = 0;
    for (int i = 0; buttons && i < buttons->count; i++) {
        const char *line = buttons->items[i].opts.line;
        if (!line || !gn_line_parse(line, &specs[i], &err)) continue;
        wanted[i] = &specs[i];
        count++;
    }
    if (count == 0) return;
    if (!gn_gpio_library.library) {
        gn_fail(&err, "%d buttons have a line, and this build reads none: it is without libgpiod",
                count);
        add_error(h, &err);
        return;
    }
    gn_line_search(&gn_gpio_library, NULL, "/dev", wanted, matches, buttons->count, &search);
    for (int i = 0; i < buttons->count; i++)
        if (wanted[i] && !check_line(buttons->items[i].opts.name, buttons->items[i].opts.line,
                                     &matches[i], &search, &err))
            add_error(h, &err);
}

/* ---- the display --------------------------------------------------------------------------- */

/* connector: as "HDMI-A-1"; name: as "card0-HDMI-A-1". */
static bool is_connector(const struct gn_connector *c, const char *connector) {
    const char *dash = strchr(c->name, '-');
    return dash && strcmp(dash + 1, connector) == 0;
}

static void list_connectors(const struct gn_machine *m, char *out, size_t size) {
    out[0] = '\0';
    for (int i = 0; i < m->connector_count; i++) {
        const char *dash = strchr(m->connectors[i].name, '-');
        gn_text_add(out, size, "%s %s", i ? "," : "", dash ? dash + 1 : m->connectors[i].name);
    }
}

/* Of "1920x1080 1280x720". */
static bool has_size(const char *modes, const struct gn_display_mode *mode) {
    char word[32];
    const int length = snprintf(word, sizeof word, "%dx%d", mode->width_px, mode->height_px);
    for (const char *at = modes; (at = strstr(at, word)); at++)
        if ((at == modes || at[-1] == ' ') && (!at[length] || at[length] == ' ')) return true;
    return false;
}

static void check_connector(struct here *h, const struct gn_settings *s) {
    const struct gn_machine *m = &h->report->machine;
    const char *name = s->display.connector;
    const struct gn_connector *found = NULL;
    struct gn_err err = {0};
    char list[300];
    for (int i = 0; i < m->connector_count; i++) {
        const struct gn_connector *c = &m->connectors[i];
        const bool fits = name ? is_connector(c, name) : strcmp(c->status, "connected") == 0;
        if (fits && !found) found = c;
    }
    list_connectors(m, list, sizeof list);
    if (name && !found) {
        gn_fail(&err, "%s: no connector %s here; there %s%s",
                gn_settings_label(s, display.connector), name,
                m->connector_count ? "are:" : "is none", list);
        add_error(h, &err);
    } else if (!found || strcmp(found->status, "connected") != 0) {
        gn_warn(h->warnings, "no monitor is connected%s%s: a kiosk waits for one",
                name ? " to " : "", name ? name : "");
    } else if (s->display.mode.width_px && !s->display.modeline &&
               !has_size(found->modes, &s->display.mode)) {
        gn_warn(h->warnings, "%s: the monitor at %s does not offer %dx%d: timings are made for it",
                gn_settings_label(s, display.mode), found->name, s->display.mode.width_px,
                s->display.mode.height_px);
    }
}

/* The adapter that would send the messages; a television may be plugged into one without. */
static void check_television(struct here *h, const struct gn_settings *s) {
    const struct gn_cec_opts opts = {.device = s->schedule.cec_device,
                                     .connector = s->display.connector};
    struct gn_cec_report found;
    struct gn_err err = {0};
    if (!(s->schedule.off & GN_OFF_CEC)) return;
    gn_cec_find(&opts, &found);
    const unsigned at = found.adapter.address;
    if (found.result == GN_CEC_NO_ADAPTER) {
        gn_fail(&err, "%s: %s", gn_settings_label(s, schedule.off), found.why);
        add_error(h, &err);
    } else if (found.result != GN_CEC_TOLD)
        gn_warn(h->warnings, "%s: a kiosk waits for one", found.why);
    else
        printf("television at %s (%s), %u.%u.%u.%u\n", found.adapter.path, found.adapter.name,
               at >> 12, at >> 8 & 15, at >> 4 & 15, at & 15);
}

static void check_devices(struct here *h) {
    const struct gn_problem_list *problems = &h->report->problems;
    struct gn_err err = {0};
    gn_doctor_diagnose_devices(h->report, GN_DEVICE_CARD);
    gn_doctor_diagnose_devices(h->report, GN_DEVICE_RENDER);
    for (uint32_t i = 0; i < problems->count; i++) {
        gn_fail(&err, "%s: %s", problems->items[i].what, problems->items[i].cure);
        add_error(h, &err);
    }
}

/* Of now: a kiosk runs on, and says so, too. */
static void check_health(struct here *h) {
    char text[200];
    for (int i = 0; i < GN_HEALTH_COUNT; i++)
        if (gn_health_explain(&h->report->health, (enum gn_health_kind)i, -1, text, sizeof text))
            gn_warn(h->warnings, "%s; %s", text, gn_health_cures[i]);
}

/* ---- the GPU ------------------------------------------------------------------------------- */

/* Another format is taken where a GPU lacks the one that is named; whoever names it has a reason.
 */
static void check_format(struct here *h, const struct gn_settings *s) {
    const struct gn_caps *caps = &h->report->backends[h->report->chosen].caps;
    const enum gn_encoding encoding = GN_MAP_FORMAT_ENCODING(s->render.map_format);
    const enum gn_moments moments = GN_MAP_FORMAT_MOMENTS(s->render.map_format);
    const struct gn_option_row *row = gn_option_find("map-format", strlen("map-format"));
    const bool has_encoding =
        encoding == GN_ENCODING_AUTO || gn_caps_encodings(caps) >> encoding & 1;
    const bool has_moments = moments == GN_MOMENTS_NONE || gn_caps_moments(caps) >> moments & 1;
    struct gn_err err = {0};
    char name[40];
    if (has_encoding && has_moments) return;
    gn_settings_text(s, row, name, sizeof name);
    gn_fail(&err, "%s: %s does not draw maps of the format %s; gnomon doctor lists those it does",
            gn_settings_label(s, render.map_format), caps->renderer, name);
    add_error(h, &err);
}

void gn_cli_check_here(const struct gn_options *options, struct gn_errors *errors,
                       struct gn_warnings *warnings) {
    struct gn_doctor_report report;
    struct here h = {options, &report, errors, warnings};
    struct gn_err err = {0};
    if (!gn_doctor_look(&report, options->settings, &err)) {
        add_error(&h, &err);
        return;
    }
    const char *backend = options->settings->display.backend;
    check_buttons(&h);
    check_television(&h, options->settings);
    if (strcmp(backend, "auto") == 0 || strcmp(backend, "kms") == 0) {
        check_devices(&h);
        check_connector(&h, options->settings);
    }
    check_health(&h);
    if (report.chosen < 0) {
        gn_fail(&err, "nothing can draw here; gnomon doctor says why");
        add_error(&h, &err);
    }
    for (int i = 0; i <= options->mode_count && report.chosen >= 0; i++)
        check_format(&h, i ? &options->all[i] : options->settings);
    gn_input_list_finish(&report.input);
}
