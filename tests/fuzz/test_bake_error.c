/* What bake promises of positions, normals and texture coordinates (src/bake/README.md), measured
 * on what both files draw: on generated models by their number, and on those of ../shared/assets.
 * Prints a row for each file, those over the promise last.
 *
 *   test_bake_error [FIRST COUNT | FILE..]    default: 200 models and all files with GN_FULL=1,
 * else 60 and those under 100 kB */
#include <ftw.h>
#include <libgen.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "bake/bake.h"
#include "bake_models.h"
#include "core/file.h"
#include "drawn.h"
#include "stage/import.h"

/* Weights of joints are rounded, too, and each target. */
static const struct gn_drawn_promise promise = {.position = 1.0 / 65535,
                                                .normal_deg = .4,
                                                .uv = 1.0 / 131070},
                                     promise_posed = {.position = 2.0 / 65535,
                                                      .normal_deg = .8,
                                                      .uv = 1.0 / 131070};
static struct gn_drawn_errors largest, largest_posed;
static size_t files, over, refused;

/* ---- one file ---- */

static void join(struct gn_drawn_errors *e, const struct gn_drawn_errors *more) {
    e->triangles += more->triangles;
    e->missing += more->missing;
    e->share = fmax(e->share, more->share);
    e->largest.position = fmax(e->largest.position, more->largest.position);
    e->largest.normal_deg = fmax(e->largest.normal_deg, more->largest.normal_deg);
    e->largest.uv = fmax(e->largest.uv, more->largest.uv);
}

static void print_errors(const struct gn_drawn_errors *e) {
    printf(" %6.3f %6.3f %6.3f", 65535 * e->largest.position, e->largest.normal_deg,
           131070 * e->largest.uv);
}

static void print_row(const char *name, const struct gn_drawn_errors *e,
                      const struct gn_drawn_errors *posed) {
    const bool bad = e->share > 1 || posed->share > 1 || e->missing > 0 || posed->missing > 0;
    printf("%s%-44s %8zu", bad ? "OVER " : "", name, e->triangles);
    print_errors(e);
    if (posed->triangles) print_errors(posed);
    if (e->flat) printf("  %zu too thin", e->flat);
    if (e->missing + posed->missing) printf("  %zu missing", e->missing + posed->missing);
    putchar('\n');
    files++;
    over += bad;
    join(&largest, e);
    join(&largest_posed, posed);
}

/* What is deformed also as it is posed, at two times. */
static void compare(const char *name, const struct gn_scene *first, const struct gn_scene *second) {
    struct gn_drawn_errors e = gn_drawn_compare(first, second, 0, false, &promise), posed = {0};
    for (int i = 0; i < 2 && first->deformation.width > 0; i++) {
        const struct gn_drawn_errors more =
            gn_drawn_compare(first, second, i * 700 * INT64_C(1000000), true, &promise_posed);
        join(&posed, &more);
    }
    e.missing += first->material_count != second->material_count;
    print_row(name, &e, &posed);
}

static void try_bytes(const char *name, const char *path, const struct gn_bytes *bytes) {
    const struct gn_bake_opts opts = {.path = path, .share = 1, .texture_limit_px = INT_MAX};
    struct gn_bytes out = {0};
    struct gn_bake_report report;
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    struct gn_scene *second = NULL, *first = gn_scene_load_converted(path, bytes->data, bytes->size,
                                                                     NULL, &warnings, &err);
    if (first && gn_bake(&opts, bytes->data, bytes->size, &out, &report, &warnings, &err))
        second = gn_scene_load_converted(path, out.data, out.size, NULL, &warnings, &err);
    if (second)
        compare(name, first, second);
    else
        printf("%s%s\n", first ? "FAIL: " : "refused: ", err.text);
    refused += !first;
    over += first && !second;
    gn_scene_destroy(first);
    gn_scene_destroy(second);
    gn_bytes_finish(&out);
}

static void try_file(const char *path) {
    const struct gn_scene_limits limits = {0};
    struct gn_bytes bytes = {0};
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    const char *slash = strrchr(path, '/');
    const bool read = gn_import_wants_refused(path, NULL)
                          ? gn_import_convert(path, &limits, &bytes, &warnings, &err)
                          : gn_file_read(path, 0, &bytes, &err);
    if (read)
        try_bytes(slash ? slash + 1 : path, path, &bytes);
    else
        printf("refused: %s\n", err.text);
    refused += !read;
    gn_bytes_finish(&bytes);
}

static void try_model(int number) {
    char what[200], name[260];
    struct gn_made made = gn_bake_model(number, what, sizeof what);
    snprintf(name, sizeof name, "%d:%s", number, what);
    try_bytes(name, "m", &(struct gn_bytes){made.data, made.size});
    free(made.data);
}

/* ---- all ---- */

/* gnomon-import, which decompresses Draco's meshes, is in the folder above that of the tests. */
static void find_import(const char *program) {
    char path[PATH_MAX], folder[PATH_MAX];
    const char *old = getenv("PATH");
    snprintf(folder, sizeof folder, "%s", program);
    snprintf(path, sizeof path, "%s/..:%s", dirname(folder), old ? old : "");
    setenv("PATH", path, 1);
}

static off_t largest_file;

static int add_file(const char *path, const struct stat *status, int type, struct FTW *where) {
    const char *dot = strrchr(path, '.');
    (void)where;
    if (type == FTW_F && dot && (strcmp(dot, ".glb") == 0 || strcmp(dot, ".gltf") == 0) &&
        status->st_size <= largest_file)
        try_file(path);
    return 0;
}

int main(int argc, char **argv) {
    const bool full = getenv("GN_FULL"), by_number = argc > 2 && atoi(argv[2]) > 0;
    const char *shared = getenv("GNOMON_SHARED");
    char folder[PATH_MAX];
    if (!gn_bake_is_built()) {
        puts("this build has no libmeshoptimizer");
        return 77;
    }
    find_import(argv[0]);
    puts("Triangles; the largest errors: of positions, in 65535ths of the mesh, of normals, in "
         "degrees, of texture coordinates, in "
         "131070ths; the same of what is posed");
    for (int i = 1; i < argc && !by_number; i++) try_file(argv[i]);
    const int first = by_number ? atoi(argv[1]) : 0, count = by_number  ? atoi(argv[2])
                                                             : argc > 1 ? 0
                                                             : full     ? 200
                                                                        : 60;
    for (int i = first; i < first + count; i++) try_model(i);
    largest_file = full ? LONG_MAX : 100000;
    snprintf(folder, sizeof folder, "%s/assets", shared ? shared : "../shared");
    if (argc == 1) nftw(folder, add_file, 16, FTW_PHYS);
    printf("%zu files, %zu triangles, %zu refused; at most", files, largest.triangles, refused);
    print_errors(&largest);
    printf(", posed");
    print_errors(&largest_posed);
    printf("; %zu over the promise\n", over);
    return over > 0;
}
