/* Problems that doctor and inspect find, each with its cure. */
#ifndef GN_CLI_PROBLEM_H
#define GN_CLI_PROBLEM_H

#include <jansson.h>
#include <stdint.h>

enum { GN_PROBLEMS_MAX = 64 };

struct gn_problem { /* one line together: "what: cure" */
    char what[320], cure[200];
};
struct gn_problem_list {
    struct gn_problem items[GN_PROBLEMS_MAX];
    uint32_t count, dropped; /* dropped: beyond GN_PROBLEMS_MAX */
};

/* Adds a problem; names in its arguments may come from files. */
void gn_problem_add(struct gn_problem_list *list, const char *cure, const char *what, ...)
    __attribute__((format(printf, 3, 4)));

/* [{what, cure}], a new reference. */
json_t *gn_problem_json(const struct gn_problem_list *list);

#endif
