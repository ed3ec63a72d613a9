/* gnomon-import: parses arguments, converts the model in a child under limits and reports the
 * result in one line. This process never calls assimp. */
#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "core/child.h"
#include "core/opener.h"
#include "core/stop.h"
#include "core/text.h"
#include "import/import.h"

static const char help[] =
    "usage: gnomon-import [OPTION..] MODEL [-o OUT.glb]\n"
    "\n"
    "Turns a model (.obj .fbx .stl .ply .dae) into a .glb for gnomon, which calls this program by\n"
    "itself when such a file is named. Materials and pictures are read from the model's folder.\n"
    "A .glb or .gltf is written with its Draco-compressed meshes decompressed.\n"
    "\n"
    "options:\n"
    "  -o, --output FILE      output file (MODEL's name with .glb, unless that file exists)\n"
    "      --up auto|y|z      which axis of the model is up (auto: what FBX and Collada files "
    "state;\n"
    "                         z for STL and PLY; y for OBJ)\n"
    "      --memory MB        memory limit (2048, at most half of the machine's)\n"
    "      --time S           time limit (60 seconds, and less processor time for small "
    "files)\n"
    "      --file MB          size limit of files read and written (512)\n"
    "  -h, --help             this text\n"
    "      --version          the version\n"
    "\n"
    "Exit status: 0 done, 1 runtime error: bad model, or output not written, 2 wrong usage,\n"
    "130 or 143 interrupted by SIGINT or SIGTERM.\n";

/* ---- arguments ---- */

enum { OPTION_UP = 256, OPTION_MEMORY, OPTION_TIME, OPTION_FILE, OPTION_VERSION };

static bool parse_number(const char *name, const char *text, int most, int *value,
                         struct gn_err *err) {
    char *end;
    long number = strtol(text, &end, 10);
    if (!*text || *end || number < 1 || number > most)
        return gn_fail_usage(err, "--%s: \"%s\" is not a whole number from 1 to %d", name, text,
                             most);
    *value = (int)number;
    return true;
}

/* opts->model stays NULL when help or the version was printed. */
static bool parse_args(int argc, char **argv, struct gn_import_opts *opts, struct gn_err *err) {
    static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                            {"up", required_argument, NULL, OPTION_UP},
                                            {"memory", required_argument, NULL, OPTION_MEMORY},
                                            {"time", required_argument, NULL, OPTION_TIME},
                                            {"file", required_argument, NULL, OPTION_FILE},
                                            {"help", no_argument, NULL, 'h'},
                                            {"version", no_argument, NULL, OPTION_VERSION},
                                            {0}};
    opterr = 0;
    for (int c; (c = getopt_long(argc, argv, "o:h", options, NULL)) != -1;) {
        bool ok = true;
        switch (c) {
        case 'h': fputs(help, stdout); return true;
        case OPTION_VERSION: fputs("gnomon-import " GN_VERSION "\n", stdout); return true;
        case 'o': opts->out = optarg; break;
        case OPTION_UP:
            opts->up = strcmp(optarg, "y") == 0   ? GN_IMPORT_UP_Y
                       : strcmp(optarg, "z") == 0 ? GN_IMPORT_UP_Z
                                                  : GN_IMPORT_UP_AUTO;
            ok = opts->up != GN_IMPORT_UP_AUTO || strcmp(optarg, "auto") == 0 ||
                 gn_fail_usage(err, "--up: \"%s\" is not auto, y or z", optarg);
            break;
        case OPTION_MEMORY:
            ok = parse_number("memory", optarg, 1 << 20, &opts->memory_mb, err);
            break;
        case OPTION_TIME:
            ok = parse_number("time", optarg, 86400, &opts->time_s, err);
            opts->time_by_size = false;
            break;
        case OPTION_FILE: ok = parse_number("file", optarg, 4095, &opts->file_mb, err); break;
        default: { /* in a group of short options only optopt has the bad letter */
            const char *last = argv[optind - 1], letter[] = {'-', (char)optopt, 0};
            return gn_fail_usage(err, "%s: unknown option or missing value; see --help",
                                 strncmp(last, "--", 2) == 0 ? last : letter);
        }
        }
        if (!ok) return false;
    }
    if (argc - optind != 1)
        return gn_fail_usage(err, argc == optind ? "missing MODEL; see --help"
                                                 : "only one MODEL is accepted");
    opts->model = argv[optind];
    if (gn_model_format_of(opts->model) == GN_MODEL_FORMAT_COUNT && !gn_model_is_gltf(opts->model))
        return gn_fail_usage(
            err, "%s: unknown file extension; expected .obj, .fbx, .stl, .ply, .dae, .glb or .gltf",
            opts->model);
    return true;
}

/* ---- the child ---- */

struct job {
    const struct gn_import_opts *opts;
    int fd;                  /* memfd; the kernel frees it with its last descriptor */
    bool is_output;          /* it is already where the output goes */
    atomic_bool *late;       /* the child has had all of its processor time */
    int child_end;           /* of the socketpair on which the child asks for files */
    struct gn_opener opener; /* its other end */
};

static void run_child(void *shared, const void *argument) {
    const struct job *job = argument;
    gn_import_work(job->opts, job->fd, job->child_end, shared);
}

/* RLIMIT_CPU goes by ticks, of which a process on a busy machine sees too few. */
static bool is_late(const struct gn_import_report *report) {
    struct timespec used;
    clockid_t clock;
    return report->pid > 0 && clock_getcpuclockid(report->pid, &clock) == 0 &&
           clock_gettime(clock, &used) == 0 && used.tv_sec >= report->time_s;
}

static void watch_child(void *shared, const void *argument) {
    const struct job *job = argument;
    gn_opener_serve(&job->opener);
    if (is_late(shared)) atomic_store(job->late, true);
}

static bool wait_child(struct job *job, struct gn_import_report *report, struct gn_err *err) {
    const struct gn_import_opts *o = job->opts;
    atomic_bool late = false;
    job->late = &late;
    const struct gn_child child = {.work = run_child,
                                   .watch = watch_child,
                                   .wake = job->opener.socket,
                                   .argument = job,
                                   .cancel = &late,
                                   .stall_s = o->time_s};
    struct gn_err end = {0};
    if (gn_child_run(&child, report, &end)) {
        gn_fail(err, "%.511s", report->err.text); /* a model may have put any bytes there */
        return report->done || err->text[0] ||
               gn_fail(err, "%s: the importer failed without a reason", o->model);
    }
    if (late || strncmp(end.text, "hangs", 5) == 0)
        return gn_fail(err,
                       "%s: not read within %d s; raise the limit: gnomon --limit seconds=N, or "
                       "gnomon-import --time N",
                       o->model, late ? report->time_s : o->time_s);
    return gn_fail(err, "%s: the importer %s on it; export it as .glb where it was made", o->model,
                   end.text);
}

/* gnomon reads the output from a file in memory on its standard output: that one is written, so
 * that the .glb is not there twice. */
static bool open_output(struct job *job, struct gn_err *err) {
    struct stat info;
    job->is_output = strcmp(job->opts->out, "/dev/stdout") == 0 &&
                     fstat(STDOUT_FILENO, &info) == 0 && S_ISREG(info.st_mode) &&
                     info.st_nlink == 0 && info.st_size == 0;
    job->fd = job->is_output ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)
                             : memfd_create("gnomon-import", MFD_CLOEXEC);
    return job->fd >= 0 || gn_fail(err, "%s: cannot create a memory file for its .glb: %s",
                                   job->opts->model, strerror(errno));
}

static bool write_output(const struct job *job, struct gn_err *err) {
    struct stat info;
    if (job->is_output) return true;
    void *data = fstat(job->fd, &info) == 0
                     ? mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_PRIVATE, job->fd, 0)
                     : MAP_FAILED;
    if (data == MAP_FAILED)
        return gn_fail(err, "%s: cannot read back its .glb: %s", job->opts->model, strerror(errno));
    bool ok = gn_file_write(job->opts->out, data, (size_t)info.st_size, err);
    munmap(data, (size_t)info.st_size);
    return ok;
}

static bool run_job(const struct gn_import_opts *opts, struct gn_import_report *report,
                    struct gn_err *err) {
    char folder[PATH_MAX] = "./";
    const char *slash = strrchr(opts->model, '/');
    int ends[2] = {-1, -1};
    bool ok = false;
    if (slash) snprintf(folder, sizeof folder, "%.*s", (int)(slash - opts->model + 1), opts->model);
    struct job job = {.opts = opts};
    if (!open_output(&job, err)) return false;
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
        gn_fail(err, "%s: cannot connect to the importer: %s", opts->model, strerror(errno));
    else {
        job.child_end = ends[1];
        job.opener = (struct gn_opener){ends[0], folder, opts->model};
        ok = wait_child(&job, report, err) && report->done && write_output(&job, err);
    }
    for (int i = 0; i < 2; i++)
        if (ends[i] >= 0) close(ends[i]);
    if (job.fd >= 0) close(job.fd);
    return ok;
}

/* The child may have put any bytes there. */
static void print_warnings(const struct gn_warnings *warnings) {
    for (int i = 0; warnings && i < warnings->count && i < GN_WARN_MAX; i++) {
        char text[sizeof warnings->text[i] + 1];
        snprintf(text, sizeof text, "%.*s", (int)sizeof warnings->text[i], warnings->text[i]);
        fputs("gnomon-import: warning: ", stderr);
        gn_text_print(text, stderr);
        fputc('\n', stderr);
    }
    if (warnings && warnings->dropped)
        fprintf(stderr, "gnomon-import: warning: and %d more\n", warnings->dropped);
}

static bool import_model(int argc, char **argv, struct gn_err *err) {
    long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    long machine_mb = pages > 0 && page > 0 ? (long)((long long)pages * page >> 20) : 4096;
    long most_mb = machine_mb / 2;
    struct gn_import_opts opts = {.memory_mb = most_mb < 256    ? 256
                                               : most_mb < 2048 ? (int)most_mb
                                                                : 2048,
                                  .time_s = 60,
                                  .time_by_size = true,
                                  .file_mb = 512};
    if (!parse_args(argc, argv, &opts, err)) return false;
    if (!opts.model) return true;
    char out[PATH_MAX];
    if (!opts.out) { /* MODEL with .glb as its extension; that file must not exist */
        int stem = (int)(strrchr(opts.model, '.') - opts.model);
        if (snprintf(out, sizeof out, "%.*s.glb", stem, opts.model) >= (int)sizeof out)
            return gn_fail(err, "%s: path too long; name the output with -o", opts.model);
        if (access(out, F_OK) == 0)
            return gn_fail(err, "%s exists; use -o %s to overwrite it", out, out);
        opts.out = out;
    }
    struct gn_import_report *report = gn_child_share(sizeof *report, err);
    if (!report) return false;
    const bool ok = run_job(&opts, report, err);
    print_warnings(ok ? &report->warnings : NULL);
    gn_child_unshare(report, sizeof *report);
    return ok;
}

int main(int argc, char **argv) {
    struct gn_err err = {0};
    gn_stop_block();
    gn_file_fill_standard();
    signal(SIGPIPE, SIG_IGN);
    gn_stop_end_process();
    if (import_model(argc, argv, &err) && gn_file_flush_output(&err)) return GN_EXIT_OK;
    fprintf(stderr, "gnomon-import: %s\n", err.text);
    return err.status == GN_EXIT_USAGE ? GN_EXIT_USAGE : GN_EXIT_RUNTIME;
}
