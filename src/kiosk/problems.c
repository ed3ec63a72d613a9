#include "kiosk/problems.h"

#include <stdio.h>
#include <string.h>

#include "display/display.h"

void gn_problem_report(struct gn_problems *p, enum gn_problem kind, const char *text) {
    if (strcmp(p->of[kind], text) == 0) return;
    snprintf(p->of[kind], sizeof p->of[kind], "%s", text);
    p->begun[kind] = ++p->count;
    fprintf(stderr, "gnomon: warning: %s\n", text);
}

void gn_problem_report_again(struct gn_problems *p, enum gn_problem kind, const char *text) {
    gn_problem_report(p, kind, text);
    p->begun[kind] = ++p->count;
}

void gn_problem_cure(struct gn_problems *p, enum gn_problem kind) { p->of[kind][0] = '\0'; }

enum gn_problem gn_problem_last_kind(const struct gn_problems *p) {
    int last = GN_PROBLEM_COUNT;
    for (int i = 0; i < GN_PROBLEM_COUNT; i++)
        if (p->of[i][0] && (last == GN_PROBLEM_COUNT || p->begun[i] > p->begun[last])) last = i;
    return (enum gn_problem)last;
}

const char *gn_problem_last(const struct gn_problems *p) {
    const enum gn_problem last = gn_problem_last_kind(p);
    return last == GN_PROBLEM_COUNT ? NULL : p->of[last];
}

#define STATUS "\"gnomon ctl status\" shows why."
const struct gn_problem_words gn_problem_words[GN_PROBLEM_COUNT] = {
    [GN_PROBLEM_START] = {"A part of the program did not start", STATUS},
    [GN_PROBLEM_CONTROL] = {"\"gnomon ctl\" does not reach this screen",
                            "Correct \"socket\" in [kiosk] of kiosk.ini, or end the program "
                            "that uses that socket."},
    [GN_PROBLEM_TRIAL] = {"The new content is not shown",
                          "Correct it and bring it again; the earlier content is shown."},
    [GN_PROBLEM_CONFIG] = {"The settings have an error",
                           "Correct the file; \"gnomon show --check FILE\" tests it."},
    [GN_PROBLEM_FIRST] = {"The chosen scene cannot be shown",
                          "Copy its file again, or correct \"file\" in [scene] of kiosk.ini."},
    [GN_PROBLEM_FONT] = {"The chosen font cannot be used",
                         "Set \"font\" in [render] to a .ttf or .otf file that exists."},
    [GN_PROBLEM_INPUT] = {"The buttons do not work",
                          "\"gnomon doctor\" shows why, and what to do."},
    [GN_PROBLEM_ACTION] = {"A button cannot do what it is for",
                           "Correct its action in kiosk.ini; \"gnomon ctl status\" shows why."},
    [GN_PROBLEM_MODE] = {"This view cannot be shown", STATUS},
    [GN_PROBLEM_SCENE] = {"A scene cannot be shown",
                          "Copy its file again; \"gnomon inspect FILE\" tests it."},
    [GN_PROBLEM_WATCH] = {"Changes of files are not noticed",
                          "After a change use \"gnomon ctl reload\"."},
    [GN_PROBLEM_SHADERS] = {"Changes of shaders are not shown", STATUS},
    [GN_PROBLEM_CLOCK] =
        {"The clock is not set",
         "Connect to a network, or set the time; then the shadows are those of now."},
    [GN_PROBLEM_STATE] =
        {"The next start begins anew",
         "Correct \"state\" in [kiosk], or make room on its drive, and what is shown is kept."},
    [GN_PROBLEM_TELEVISION] = {"The television does not answer",
                               "Switch on HDMI-CEC in its menu, or set off = black in [schedule]."},
    [GN_PROBLEM_RANGE] = {"Black and white may look wrong",
                          "Choose the full or the limited range in the monitor's menu."},
    [GN_PROBLEM_GRAPHICS] = {GN_DISPLAY_NO_GL, STATUS},
    [GN_PROBLEM_VOLTAGE] = {"The power supply is too weak",
                            "Use the board's own power supply and a short, thick cable."},
    [GN_PROBLEM_THROTTLED] = {"The board runs slower than it can",
                              "Give it a heat sink, a fan, air around its case, or a stronger "
                              "power supply."},
    [GN_PROBLEM_CMA] = {"Memory for the screen runs out",
                        "Set a larger cma= on the kernel's command line, or a lower resolution."},
};
