#include "stage/import.h"

#include <config.h> /* the generated one */
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/child.h"
#include "core/hash.h"
#include "core/model.h"
#include "stage/kept.h"

enum {
    GRACE_S = 15, /* it times out by itself, so long before it is killed */
    MOST_FILE_MB = 4095,
};
#define PROGRAM "gnomon-import"

bool gn_import_wants(const char *path) { return gn_model_format_of(path) != GN_MODEL_FORMAT_COUNT; }

bool gn_import_wants_refused(const char *path, const struct gn_scene_limits *limits) {
    return gn_model_is_gltf(path) && gn_scene_uses(path, limits, "KHR_draco_mesh_compression");
}

/* ---- finding the program ---- */

static bool is_program(char *out, size_t size, int length, const char *folder, const char *more) {
    struct stat info;
    int all = snprintf(out, size, "%.*s%s/" PROGRAM, length, folder, more);
    return all < (int)size && stat(out, &info) == 0 && S_ISREG(info.st_mode) &&
           access(out, X_OK) == 0;
}

static bool find_program(char *out, size_t size) {
    static const char prefix[] = GN_PREFIX;
    char own[4096];

    /* beside our own program */
    const ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    if (length > 0) {
        own[length] = 0;
        const int folder = (int)(strrchr(own, '/') - own);
        if (is_program(out, size, folder, own, "") ||
            is_program(out, size, folder, own, "/../libexec"))
            return true;
    }

    /* where it is installed, and in PATH */
    if (is_program(out, size, INT32_MAX, prefix, "/libexec") ||
        is_program(out, size, INT32_MAX, prefix, "/bin"))
        return true;
    for (const char *at = getenv("PATH"); at && *at;) {
        const int part = (int)strcspn(at, ":");
        if (part > 0 && is_program(out, size, part, at, "")) return true;
        at += part + (at[part] == ':');
    }
    return false;
}

/* ---- running it ---- */

struct job {
    const char *program, *path;
    uint64_t file_mb, seconds; /* 0: its defaults */
    uint64_t memory_mb;
    int glb, log; /* memfds: its output and its messages */
};

/* At most that; 0 for a default, in place of which the program has its own. */
static uint64_t given(uint64_t value, uint64_t usual, uint64_t most) {
    return value == usual ? 0 : value < most ? value : most;
}

static void exec_program(void *shared, const void *argument) {
    (void)shared;
    const struct job *job = argument;
    const struct {
        const char *option;
        uint64_t value;
    } limits[] = {{"--file", job->file_mb}, {"--memory", job->memory_mb}, {"--time", job->seconds}};
    char values[3][24];
    const char *line[12] = {PROGRAM, "-o", "/dev/stdout"};
    int n = 3;
    for (int i = 0; i < 3; i++) {
        if (!limits[i].value) continue;
        snprintf(values[i], sizeof values[i], "%llu", (unsigned long long)limits[i].value);
        line[n++] = limits[i].option;
        line[n++] = values[i];
    }
    line[n++] = "--";
    line[n] = job->path;
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    dup2(job->glb, STDOUT_FILENO);
    dup2(job->log, STDERR_FILENO);
    execv(job->program, (char *const *)(uintptr_t)line);
    _exit(127);
}

/* The contents of a memfd, to be unmapped; NULL: empty. */
static char *map_memfd(int fd, size_t *size) {
    struct stat info;
    if (fstat(fd, &info) != 0 || info.st_size <= 0) return NULL;
    void *data = mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
    *size = (size_t)info.st_size;
    return data == MAP_FAILED ? NULL : data;
}

/* Its lines "gnomon-import: warning: .." become warnings, a line "gnomon-import: .." the error. */
static void read_log(int fd, struct gn_warnings *warnings, struct gn_err *err) {
    static const char start[] = PROGRAM ": ", warning[] = PROGRAM ": warning: ";
    size_t size = 0;
    char *text = map_memfd(fd, &size);
    for (size_t at = 0, end; text && at < size; at = end + 1) {
        const char *line = text + at, *newline = memchr(line, '\n', size - at);
        end = newline ? (size_t)(newline - text) : size;
        int length = (int)(end - at < 1000 ? end - at : 1000);
        if (end - at > sizeof warning && strncmp(line, warning, sizeof warning - 1) == 0)
            gn_warn(warnings, "%.*s", length - (int)sizeof warning + 1, line + sizeof warning - 1);
        else if (end - at > sizeof start && strncmp(line, start, sizeof start - 1) == 0)
            gn_fail(err, "%.*s", length - (int)sizeof start + 1, line + sizeof start - 1);
    }
    if (text) munmap(text, size);
}

/* The output of gnomon-import, to be unmapped; NULL: it failed. */
static char *run_import(const char *path, const struct gn_scene_limits *limits, size_t *size,
                        struct gn_warnings *warnings, struct gn_err *err) {
    char program[4096];
    if (!find_program(program, sizeof program)) {
        gn_fail(err,
                "%s: needs " PROGRAM ", which is not installed: install it beside gnomon, or %s",
                path,
                gn_model_is_gltf(path) ? "decompress its meshes (gltf-transform can)"
                                       : "convert the file to .glb");
        return NULL;
    }
    const struct gn_scene_limits usual = gn_scene_limits_or_default(NULL),
                                 all = gn_scene_limits_or_default(limits);
    struct job job = {.program = program,
                      .path = path,
                      .file_mb = given(limits->file_mb, usual.file_mb, MOST_FILE_MB),
                      .memory_mb = all.memory_mb,
                      .seconds = given(limits->seconds, usual.seconds, UINT64_MAX),
                      .glb = memfd_create("gnomon-glb", MFD_CLOEXEC),
                      .log = memfd_create("gnomon-log", MFD_CLOEXEC)};
    char *glb = NULL;
    if (job.glb < 0 || job.log < 0)
        gn_fail(err, "%s: no memory to import it: %s", path, strerror(errno));
    else {
        const struct gn_child child = {.work = exec_program,
                                       .argument = &job,
                                       .cancel = limits->cancel,
                                       .stall_s = (int)all.seconds + GRACE_S};
        struct gn_err end = {0}, reported = {0};
        const bool ok = gn_child_run(&child, NULL, &end);
        read_log(job.log, warnings, &reported);
        glb = ok ? map_memfd(job.glb, size) : NULL;
        if (ok && !glb)
            gn_fail(err, "%s: " PROGRAM " wrote no output", path);
        else if (!ok && reported.text[0])
            gn_fail(err, "%s", reported.text);
        else if (!ok)
            gn_fail(err, "%s: " PROGRAM " %s; export it as .glb where it was made", path, end.text);
    }
    if (job.glb >= 0) close(job.glb);
    if (job.log >= 0) close(job.log);
    return glb;
}

/* ---- kept output ---- */

/* At most 128 MB in all: a card of a board is small. */
static const struct gn_kept_kind kept_kind = {
    .prefix = "draco-", .suffix = ".glb", .files_max = 4, .bytes_max = 32 << 20};

/* Of a .glb that names no other file, so that its bytes are all that its output is made of, and of
 * the program that makes it. */
static bool find_kept(const char *path, uint64_t file_mb, char out[GN_KEPT_PATH]) {
    static const char uri[] = "\"uri\"", magic[] = "glTF";
    char program[4096];
    struct stat made_by;
    struct gn_bytes file = {0};
    struct gn_err unused = {0};
    bool found = false;
    if (!gn_model_is_gltf(path) || !find_program(program, sizeof program) ||
        stat(program, &made_by) < 0 ||
        !gn_file_read(path, file_mb < SIZE_MAX >> 20 ? (size_t)file_mb << 20 : SIZE_MAX, &file,
                      &unused))
        return false;
    const bool alone = file.size > sizeof magic && memcmp(file.data, magic, 4) == 0 &&
                       !memmem(file.data, file.size, uri, sizeof uri - 1);
    if (alone) {
        const int64_t by[] = {made_by.st_size, made_by.st_mtim.tv_sec, made_by.st_mtim.tv_nsec};
        const uint64_t hash = gn_hash(gn_hash(GN_HASH_INIT, by, sizeof by), file.data, file.size);
        found = gn_kept_path(&kept_kind, hash, file.size, out);
    }
    gn_bytes_finish(&file);
    return found;
}

static struct gn_scene *load_kept(const char *path, const char *kept,
                                  const struct gn_scene_limits *limits,
                                  struct gn_warnings *warnings) {
    struct gn_bytes file = {0};
    struct gn_err unused = {0};
    struct gn_scene *scene = NULL;
    if (gn_kept_read(&kept_kind, kept, &file))
        scene = gn_scene_load_converted(path, file.data, file.size, limits, warnings, &unused);
    gn_bytes_finish(&file);
    return scene;
}

/* An output that warnings came with is not kept: they would not come again. */
struct gn_scene *gn_import_load(const char *path, const struct gn_scene_limits *limits,
                                struct gn_warnings *warnings, struct gn_err *err) {
    size_t size = 0;
    char kept[GN_KEPT_PATH];
    const bool keeps = find_kept(path, gn_scene_limits_or_default(limits).file_mb, kept);
    struct gn_scene *scene = keeps ? load_kept(path, kept, limits, warnings) : NULL;
    if (scene) return scene;
    const int warned = warnings ? warnings->count + warnings->dropped : 0;
    char *glb = run_import(path, limits, &size, warnings, err);
    if (!glb) return NULL;
    const bool silent = warnings && warnings->count + warnings->dropped == warned;
    scene = gn_scene_load_converted(path, glb, size, limits, warnings, err);
    if (scene && keeps && silent) gn_kept_write(&kept_kind, kept, glb, size);
    munmap(glb, size);
    return scene;
}

bool gn_import_convert(const char *path, const struct gn_scene_limits *limits, struct gn_bytes *out,
                       struct gn_warnings *warnings, struct gn_err *err) {
    size_t size = 0;
    char *glb = run_import(path, limits, &size, warnings, err);
    if (!glb) return false;
    *out = (struct gn_bytes){.data = malloc(size), .size = size};
    if (out->data) memcpy(out->data, glb, size);
    munmap(glb, size);
    return out->data || gn_fail(err, "%s: out of memory", path);
}
