#include "stage/environment.h"

#include <cglm/cglm.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/embedded.h"
#include "core/file.h"
#include "core/hash.h"
#include "stage/kept.h"
#include "stage/lights.h"
#include "stage/sun.h"

enum {
    FILE_MB = 256, /* of a Radiance file */
    THREADS = 2,
    OPEN_MAX = 16, /* environments of all modes */
};

/* ---- kept files ---- */

static const struct gn_kept_kind kept_kind = {.prefix = "environment-",
                                              .suffix = ".env",
                                              .files_max = 16,
                                              .bytes_max = GN_ENVIRONMENT_FILE_BYTES};

struct reading {
    const char *path;
    int64_t begun_ns;
    int percent; /* that was printed last */
};

/* On a terminal, once the work has taken a second. */
static void print_progress(void *user, double share) {
    struct reading *r = user;
    const int percent = (int)(100.0 * share);
    if (percent <= r->percent || gn_clock_monotonic_ns() - r->begun_ns < GN_NS_PER_S) return;
    r->percent = percent;
    fprintf(stderr, "\r%s: light %d %%%s", r->path, percent, percent >= 100 ? "\n" : "");
}

static bool read_file(const char *path, struct gn_environment *out, struct gn_err *err) {
    struct gn_bytes bytes = {0}, old = {0};
    char kept[GN_KEPT_PATH];
    if (!gn_file_read(path, (size_t)FILE_MB << 20, &bytes, err)) return false;
    const uint64_t hash = gn_hash(GN_HASH_INIT, bytes.data, bytes.size);
    const bool keeps = gn_kept_path(&kept_kind, hash, bytes.size, kept);
    bool ok = keeps && gn_kept_read(&kept_kind, kept, &old) &&
              gn_environment_read(old.data, old.size, out);
    if (!ok) {
        struct reading reading = {.path = path, .begun_ns = gn_clock_monotonic_ns()};
        const struct gn_environment_work work = {.threads = THREADS,
                                                 .progress =
                                                     isatty(STDERR_FILENO) ? print_progress : NULL,
                                                 .user = &reading};
        ok = gn_environment_read_hdr(bytes.data, bytes.size, &work, out, err);
        if (!ok) gn_fail_prefix(err, "%s", path);
        if (ok && keeps) {
            uint8_t *made = gn_xalloc(1, GN_ENVIRONMENT_FILE_BYTES);
            gn_environment_write(out, made);
            gn_kept_write(&kept_kind, kept, made, GN_ENVIRONMENT_FILE_BYTES);
            free(made);
        }
    }
    gn_bytes_finish(&bytes);
    gn_bytes_finish(&old);
    return ok;
}

/* ---- those that are open ---- */

/* Frame options of all modes point to them. */
static struct open_environment {
    char *name;
    struct stat info; /* of the file, when it was read */
    struct gn_environment *of;
    uint64_t id;
} all_open[OPEN_MAX];

static bool is_same_file(const struct stat *a, const struct stat *b) {
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino && a->st_size == b->st_size &&
           a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec;
}

static bool read_studio(struct gn_environment *out, struct gn_err *err) {
    const struct gn_embedded *file = gn_embedded_find("studio.env");
    return (file && gn_environment_read(file->data, file->size, out)) ||
           gn_fail(err, "this build has no studio inside; use --environment none");
}

static const struct open_environment *open_environment(const char *name, struct gn_err *err) {
    const bool is_studio = strcmp(name, "studio") == 0;
    struct stat info = {0};
    int i = 0;
    if (!is_studio && stat(name, &info) < 0) {
        gn_fail(err, "%s: %s", name, strerror(errno));
        return NULL;
    }
    while (i < OPEN_MAX && all_open[i].name && strcmp(all_open[i].name, name) != 0) i++;
    if (i == OPEN_MAX) {
        gn_fail(err, "%s: at most %d environments in one process", name, OPEN_MAX);
        return NULL;
    }
    struct open_environment *open = &all_open[i];
    if (open->name && is_same_file(&open->info, &info)) return open;
    struct gn_environment *read = gn_xalloc(1, sizeof *read);
    if (!(is_studio ? read_studio(read, err) : read_file(name, read, err))) {
        free(read);
        return NULL;
    }
    if (!open->name) {
        open->name = gn_xalloc(strlen(name) + 1, 1);
        memcpy(open->name, name, strlen(name) + 1);
        open->of = gn_xalloc(1, sizeof *open->of);
    }
    *open->of = *read;
    open->info = info;
    open->id = (gn_hash(GN_HASH_INIT, read, sizeof *read) | 4) & ~UINT64_C(3);
    free(read);
    return open;
}

/* ---- of a look ---- */

static bool needs_reflections(const struct gn_scene *scene) {
    bool any = false;
    for (uint32_t i = 0; i < scene->item_count && !any; i++)
        any = gn_material_needs_reflections(&scene->materials[scene->items[i].material]);
    return any;
}

bool gn_stage_set_environment(struct gn_frame_opts *opts, const struct gn_settings *settings,
                              const struct gn_scene *scene, struct gn_err *err) {
    const char *name = settings->render.environment;
    const float strength = (float)settings->render.environment_strength;
    const bool automatic = !name || strcmp(name, "auto") == 0;
    const bool is_sky =
        automatic && gn_stage_sun_is_set(settings) && gn_stage_sun_light(scene) >= 0;
    const bool reflected_only = automatic && !scene->added.light && !is_sky;
    opts->environment = (struct gn_frame_environment_opts){0};
    const enum gn_environment_show show =
        (enum gn_environment_show)settings->render.environment_show;
    const bool is_seen = !reflected_only || needs_reflections(scene) || show;
    if (is_sky) {
        opts->environment = (struct gn_frame_environment_opts){
            .is_sky = true,
            .show = show,
            .turn_rad = glm_rad((float)settings->render.environment_turn_deg),
            .strength = strength};
        return true;
    }
    if (automatic) name = is_seen ? "studio" : "none";
    if (strcmp(name, "none") == 0 || strength <= 0.0f) return true;
    const struct open_environment *open = open_environment(name, err);
    if (!open) return false;
    opts->environment = (struct gn_frame_environment_opts){
        .of = open->of,
        .id = open->id,
        .lights_key = scene->added.light,
        .reflected_only = reflected_only,
        .show = show,
        .turn_rad = glm_rad((float)settings->render.environment_turn_deg),
        .strength = strength,
    };
    if (scene->added.light) gn_stage_set_key(&opts->shadow, scene, &open->of->key, strength);
    return true;
}
