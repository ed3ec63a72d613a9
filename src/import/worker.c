/* The child that reads a model: sets its resource limits, gives up its rights and converts. It
 * frees nothing; its memory goes with the process. */
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/memory.h"
#include "core/sandbox.h"
#include "import/import.h"

static void limit_resource(int what, rlim_t most) {
    struct rlimit limit = {most, most};
    setrlimit(what, &limit);
}

void gn_import_work(const struct gn_import_opts *opts, int fd, int opener,
                    struct gn_import_report *report) {
    static struct gn_import import;
    gn_import_memory_begin(opts, report);
    report->time_s = opts->time_s;
    report->pid = getpid();
    import = (struct gn_import){.opts = opts,
                                .report = report,
                                .opener = opener,
                                .format = gn_model_format_of(opts->model),
                                .warnings = &report->warnings,
                                .err = &report->err};
    if (!gn_import_folder_find(&import)) return;

    /* the parent enforces the times; RLIMIT_CPU is a second line of defence */
    if (GN_LIMITS_MEMORY) limit_resource(RLIMIT_AS, (rlim_t)opts->memory_mb << 20);
    limit_resource(RLIMIT_CPU, (rlim_t)opts->time_s + 2);
    gn_import_extend_time(&import, 0);
    limit_resource(RLIMIT_FSIZE, (rlim_t)opts->file_mb << 20);
    limit_resource(RLIMIT_CORE, 0);
    prctl(PR_SET_DUMPABLE, 0); /* also disables core dumps through a pipe handler */
    signal(SIGXFSZ, SIG_IGN);
    setenv("LIBC_FATAL_STDERR_", "1", 1); /* otherwise glibc writes to the terminal */

    const int kept[2] = {fd, opener};
    if (gn_sandbox_enter(kept, &report->err) < 0) {
        gn_fail_prefix(&report->err, "%s: the importer", opts->model);
        return;
    }
    gn_glb_init(&import.glb);
    const bool is_gltf = import.format == GN_MODEL_FORMAT_COUNT;
    if (!(is_gltf ? gn_import_gltf_build : gn_import_scene_build)(&import)) return;
    report->done = gn_glb_write(&import.glb, fd, &report->err);
    if (!report->done) gn_fail_prefix(&report->err, "%s", opts->model);
}
