/* Every .gltf and .glb below a folder of broken files (../shared/malformed, or malformed/ in
 * $GNOMON_SHARED), and of good ones beside it (assets/): a scene that holds, or one line that names
 * the file and a place in it; in under two seconds. With arguments: those files, and what became of
 * them. Skipped (77) without the folder. */
#include <ftw.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/clock.h"
#include "unit/scene_check.h"

static struct {
    int files, shown, refused, failures;
    bool verbose;
    int64_t slowest_ns;
} count;

static bool is_gltf(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && (strcmp(dot, ".gltf") == 0 || strcmp(dot, ".glb") == 0);
}

static void complain(const char *path, const char *what) {
    printf("FAIL %s: %s\n", path, what);
    count.failures++;
}

/* A byte offset, a JSON path, or the limit that was passed, right after the file's name. */
static bool says_where(const char *text) {
    static const char *const starts[] = {"byte ",    "asset",   "extensions", "scene",
                                         "nodes",    "meshes",  "accessors",  "bufferViews",
                                         "buffers",  "cameras", "materials",  "textures",
                                         "samplers", "images",  "animations", "out of memory"};
    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; i++)
        if (strncmp(text, starts[i], strlen(starts[i])) == 0) return true;
    return false;
}

static void try_file(const char *path) {
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    int64_t start_ns = gn_clock_process_cpu_ns();
    struct gn_scene *scene = gn_scene_load(path, NULL, &warnings, &err);
    int64_t took_ns = gn_clock_process_cpu_ns() - start_ns;
    const char *wrong = scene ? gn_scene_check(scene) : NULL;
    count.files++;
    if (scene)
        count.shown++;
    else
        count.refused++;
    if (took_ns > count.slowest_ns) count.slowest_ns = took_ns;
    if (took_ns > 2 * GN_NS_PER_S) complain(path, "took over 2 s");
    if (wrong) complain(path, wrong);
    size_t length = strlen(path);
    bool named = strncmp(err.text, path, length) == 0 && strncmp(err.text + length, ": ", 2) == 0;
    if (!scene && (!named || strchr(err.text, '\n') || !says_where(err.text + length + 2)))
        complain(path, err.text);
    if (count.verbose) {
        printf("%s %s\n", scene ? "shown  " : "refused", scene ? path : err.text);
        for (int i = 0; i < warnings.count; i++) printf("        %s\n", warnings.text[i]);
    }
    gn_scene_destroy(scene);
}

static int visit(const char *path, const struct stat *status, int type, struct FTW *where) {
    (void)status;
    (void)where;
    if (type == FTW_F && is_gltf(path)) try_file(path);
    return 0;
}

int main(int argc, char **argv) {
    const char *shared = getenv("GNOMON_SHARED");
    count.verbose = argc > 1 || getenv("GN_VERBOSE");
    for (int i = 1; i < argc; i++) nftw(argv[i], visit, 16, FTW_PHYS);
    static const char *const folders[] = {"malformed", "assets"};
    for (int i = 0; i < 2 && argc == 1; i++) {
        char folder[PATH_MAX];
        snprintf(folder, sizeof folder, "%s/%s", shared ? shared : "../shared", folders[i]);
        if (nftw(folder, visit, 16, FTW_PHYS) != 0 && i == 0) {
            printf("SKIP: there is no folder %s\n", folder);
            return 77;
        }
    }
    printf("%d files: %d shown, %d refused, %d wrong; slowest %" PRId64 " ms\n", count.files,
           count.shown, count.refused, count.failures, count.slowest_ns / 1000000);
    return count.failures > 0 || count.files == 0;
}
