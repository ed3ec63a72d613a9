/* Memory of the child: a failed allocation ends it with a report. */
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/memory.h"
#include "import/import.h"

static struct gn_import_report *the_report;
static const struct gn_import_opts *the_opts;

void gn_import_memory_begin(const struct gn_import_opts *opts, struct gn_import_report *report) {
    the_opts = opts;
    the_report = report;
}

void gn_import_no_memory(void) {
    gn_fail(&the_report->err,
            "%s: needs more than %d MB of memory; raise the limit: gnomon --limit memory_mb=N, or "
            "gnomon-import --memory N",
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

/* Addresses without pages, which RLIMIT_AS counts. */
void gn_import_reserve(size_t size) {
    if (!GN_LIMITS_MEMORY || size == 0) return;
    if (mmap(NULL, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED)
        gn_import_no_memory();
}
