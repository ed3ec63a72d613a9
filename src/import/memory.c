/* Memory of the child: a failed allocation ends it with a report. */
#include <stdlib.h>
#include <unistd.h>

#include "import/import.h"

static struct gn_import_report *the_report;
static const struct gn_import_opts *the_opts;

void gn_import_memory_begin(const struct gn_import_opts *opts, struct gn_import_report *report) {
    the_opts = opts;
    the_report = report;
}

void gn_import_no_memory(void) {
    gn_fail(&the_report->err,
            "%s: needs more than %d MB of memory; raise the limit with gnomon-import --memory MB",
            the_opts->model, the_opts->memory_mb);
    _exit(0);
}

void *gn_import_alloc(size_t size) {
    void *memory = calloc(1, size ? size : 1);
    if (!memory) gn_import_no_memory();
    return memory;
}

void *gn_import_grow(void *old, size_t size) {
    void *memory = realloc(old, size);
    if (!memory) gn_import_no_memory();
    return memory;
}
