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

#define STATUS "\"gnomon ctl status\" has the reason."
const struct gn_problem_words gn_problem_words[GN_PROBLEM_COUNT] = {
    [GN_PROBLEM_START] = {"A part of the program did not start", STATUS},
    [GN_PROBLEM_CONTROL] = {"Remote control does not work",
                            "Correct \"socket\" in [kiosk], or end the program that uses it."},
    [GN_PROBLEM_TRIAL] = {"The new content is not shown",
                          "What was there before is shown; bring corrected content."},
    [GN_PROBLEM_CONFIG] = {"The settings have an error",
                           "Correct the file; \"gnomon show --check FILE\" tests it."},
    [GN_PROBLEM_FIRST] = {"The chosen scene cannot be shown",
                          "Copy its file again, or correct \"file\" in [scene]."},
    [GN_PROBLEM_FONT] = {"The chosen font cannot be used",
                         "Set \"font\" in [render] to a .ttf or .otf file that is there."},
    [GN_PROBLEM_INPUT] = {"The buttons do not work",
                          "\"gnomon doctor\" has the reason and the cure."},
    [GN_PROBLEM_ACTION] = {"A button asks for what is not there",
                           "Correct the mode or the clip that it names."},
    [GN_PROBLEM_MODE] = {"A mode cannot be shown", STATUS},
    [GN_PROBLEM_SCENE] = {"A scene cannot be shown",
                          "Copy its file again; \"gnomon inspect FILE\" tests it."},
    [GN_PROBLEM_WATCH] = {"Changes of files are not noticed",
                          "After a change use \"gnomon ctl reload\"."},
    [GN_PROBLEM_SHADERS] = {"The changed shaders cannot be used", STATUS},
    [GN_PROBLEM_CLOCK] = {"The clock is not set",
                          "Connect a network, or set the time; then the sun is that of now."},
    [GN_PROBLEM_STATE] = {"What is shown is not remembered",
                          "Correct \"state\" in [kiosk], or make room on its drive."},
    [GN_PROBLEM_TELEVISION] = {"The television does not answer",
                               "Switch on HDMI-CEC in its menu, or set \"off\" in [schedule]."},
    [GN_PROBLEM_RANGE] = {"The signal's levels cannot be set", "Set them in the monitor's menu."},
    [GN_PROBLEM_GRAPHICS] = {GN_DISPLAY_NO_GL, STATUS},
    [GN_PROBLEM_VOLTAGE] = {"The power supply is too weak",
                            "Use the board's own power supply and a short, thick cable."},
    [GN_PROBLEM_THROTTLED] = {"The board is too hot",
                              "Give it a heat sink, a fan, or air around its case."},
    [GN_PROBLEM_CMA] = {"Memory for the screen runs out",
                        "Set a larger cma= on the kernel's command line, or a smaller mode."},
};
