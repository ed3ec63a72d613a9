#include "import_help.h"
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gltf_maker.h"
#include "scene_check.h"
#include "stage/import.h"
#include "unit/folder.h"

static char folder[64] = "/tmp/gnomon-import-XXXXXX";
static struct gn_warnings warnings;
static struct gn_err err;

const char *help_import_folder(void) { return folder; }

const struct gn_warnings *help_import_warnings(void) { return &warnings; }

const struct gn_material *help_import_material(const struct gn_scene *scene) {
    return &scene->materials[scene->items[0].material];
}

const char *help_import_path(const char *name) {
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

void help_import_put_bytes(const char *name, const void *data, size_t size) {
    FILE *file = fopen(help_import_path(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

void help_import_put(const char *name, const char *text) {
    help_import_put_bytes(name, text, strlen(text));
}

void help_import_put_picture(const char *name, uint8_t a0, uint8_t a1, uint8_t a2, uint8_t a3) {
    const uint8_t rgba[] = {255, 0, 0, a0, 0, 255, 0, a1, 0, 0, 255, a2, 255, 255, 255, a3};
    struct gn_made png = gn_maker_png(2, 2, rgba);
    help_import_put_bytes(name, png.data, png.size);
    free(png.data);
}

struct gn_scene *help_import_load(const char *name) {
    const struct gn_scene_limits limits = {0};
    memset(&warnings, 0, sizeof warnings);
    struct gn_scene *scene = gn_import_load(help_import_path(name), &limits, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    const char *wrong = gn_scene_check(scene);
    if (wrong) fail_msg("%s: %s", name, wrong);
    return scene;
}

void help_import_refused(const char *name, const char *why) {
    const struct gn_scene_limits limits = {0};
    memset(&err, 0, sizeof err);
    assert_null(gn_import_load(help_import_path(name), &limits, &warnings, &err));
    const char *path = help_import_path(name);
    if (strncmp(err.text, path, strlen(path)) != 0 || !strstr(err.text, why))
        fail_msg("\"%s\" does not say \"%s\"", err.text, why);
}

void help_import_warned(const char *what) {
    for (int i = 0; i < warnings.count; i++)
        if (strstr(warnings.text[i], what)) return;
    fail_msg("no warning of \"%s\"", what);
}

void help_import_near(float a, float b) {
    if (!(fabsf(a - b) < 1e-4f * fmaxf(1.0f, fabsf(b))))
        fail_msg("%g is not %g", (double)a, (double)b);
}

void help_import_box(const struct gn_scene *scene, float x0, float y0, float z0, float x1, float y1,
                     float z1) {
    const float low[] = {x0, y0, z0}, high[] = {x1, y1, z1};
    for (int k = 0; k < 3; k++) {
        help_import_near(scene->box.min[k], low[k]);
        help_import_near(scene->box.max[k], high[k]);
    }
}

static bool is_there(void) {
    char path[4096], *slash;
    const char *gnomon = getenv("GNOMON");
    if (!realpath(gnomon ? gnomon : "build/release/gnomon", path)) return false;
    slash = strrchr(path, '/');
    strcpy(slash, "/gnomon-import");
    bool there = access(path, X_OK) == 0;
    *slash = 0;
    setenv("PATH", path, 1);
    return there;
}

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int leave(void **state) {
    (void)state;
    return gn_test_remove_folder(folder);
}

int help_import_run(const struct CMUnitTest *tests, size_t count) {
    if (!is_there()) {
        puts("gnomon-import was not built: it needs libassimp-dev (make deps)");
        return 77;
    }
    setenv("XDG_CACHE_HOME", "/dev/null", 1); /* the user's own is no test's */
    unsetenv("CACHE_DIRECTORY");
    return _cmocka_run_group_tests("import", tests, count, enter, leave);
}
