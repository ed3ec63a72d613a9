#include "kiosk/problems.h"

#include <stdio.h>
#include <string.h>

void gn_problem_report(struct gn_problems *p, enum gn_problem kind, const char *text) {
    if (strcmp(p->of[kind], text) == 0) return;
    snprintf(p->of[kind], sizeof p->of[kind], "%s", text);
    p->begun[kind] = ++p->count;
    fprintf(stderr, "gnomon: warning: %s\n", text);
}

void gn_problem_cure(struct gn_problems *p, enum gn_problem kind) { p->of[kind][0] = '\0'; }

const char *gn_problem_last(const struct gn_problems *p) {
    int last = -1;
    for (int i = 0; i < GN_PROBLEM_COUNT; i++)
        if (p->of[i][0] && (last < 0 || p->begun[i] > p->begun[last])) last = i;
    return last < 0 ? NULL : p->of[last];
}
