#include "cli/problem.h"

#include <stdarg.h>
#include <stdio.h>

#include "core/json.h"
#include "core/text.h"

void gn_problem_add(struct gn_problem_list *list, const char *cure, const char *what, ...) {
    if (list->count == GN_PROBLEMS_MAX) {
        list->dropped++;
        return;
    }
    struct gn_problem *problem = &list->items[list->count++];
    va_list args;
    va_start(args, what);
    gn_text_vformat(problem->what, sizeof problem->what, what, args);
    va_end(args);
    snprintf(problem->cure, sizeof problem->cure, "%s", cure);
}

json_t *gn_problem_json(const struct gn_problem_list *list) {
    json_t *all = json_array();
    for (uint32_t i = 0; i < list->count; i++)
        json_array_append_new(all,
                              json_pack("{so so}", "what", gn_json_make_text(list->items[i].what),
                                        "cure", gn_json_make_text(list->items[i].cure)));
    return all;
}
