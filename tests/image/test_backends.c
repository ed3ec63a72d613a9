/* The same picture from both backends, and the same bytes from two runs.
 * Scenes: the default one, bench S1, two of the generated ones. Without OSMesa the comparison is
 * skipped (77). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "image/compare.h"
#include "image/shot.h"
#include "image/table.h"

enum { SKIP = 77 };

struct look {
    const char *name, *kind;
    double tolerance; /* of a channel */
    const char *args[8];
};
static const struct look looks[] = {
    {"colour", "png", 1.001 / 255, {"--size", "640x360", NULL}},
    {"hard", "png", 1.001 / 255, {"--size", "640x360", "--shadow", "hard", NULL}},
    {"visibility", "pfm", 1.001 / 255, {"--size", "640x360", "--aov", "visibility", NULL}},
};
enum { LOOKS = sizeof looks / sizeof *looks };

static bool shot_by(struct gn_picture *picture, const char *backend, const char *scene,
                    const struct look *look, struct gn_err *err) {
    const char *args[16] = {"--backend", backend};
    for (int i = 0; look->args[i]; i++) args[2 + i] = look->args[i];
    return gn_shot(picture, NULL, err, look->kind, scene, args);
}

/* Not more than 1/255 apart in 99.9 % of the pixels. */
static bool backends_agree(const char *scene, const struct look *look) {
    struct gn_picture egl = {0}, osmesa = {0};
    struct gn_err err = {0};
    struct gn_difference d;
    bool ok =
        shot_by(&egl, "egl", scene, look, &err) && shot_by(&osmesa, "osmesa", scene, look, &err);
    if (!ok) printf("%s\n", err.text);
    bool alike = ok && gn_compare(&osmesa, &egl, look->tolerance, &d) && d.share <= .001;
    if (ok) {
        const char *base = strrchr(scene, '/') ? strrchr(scene, '/') + 1 : scene;
        printf("%-14s %-10s %.4f %% of the pixels apart, at most %.4f (at %d, %d)%s\n", base,
               look->name, 100 * d.share, d.max, d.worst_x, d.worst_y, alike ? "" : " FAILED");
        char name[100];
        snprintf(name, sizeof name, "backends-%.30s-%s", base, look->name);
        if (!alike) gn_compare_save(NULL, name, &osmesa, &egl);
    }
    gn_picture_finish(&egl);
    gn_picture_finish(&osmesa);
    return alike;
}

static bool runs_are_equal(const char *scene, const char *backend, const struct look *look) {
    struct gn_bytes bytes[2] = {{0}};
    struct gn_err err = {0};
    const char *args[16] = {"--backend", backend};
    char path[2][400];
    bool ok = true;
    for (int i = 0; look->args[i]; i++) args[2 + i] = look->args[i];
    for (int i = 0; ok && i < 2; i++) {
        snprintf(path[i], sizeof path[i], "%s/twice-%d-%d.%s", gn_shot_build(), (int)getpid(), i,
                 look->kind);
        ok = gn_shot_file(path[i], NULL, &err, scene, args) &&
             gn_file_read(path[i], 0, &bytes[i], &err);
        unlink(path[i]);
    }
    if (!ok) printf("%s\n", err.text);
    bool same = ok && bytes[0].size == bytes[1].size &&
                !memcmp(bytes[0].data, bytes[1].data, bytes[0].size);
    if (ok && !same) printf("%s: two runs on %s give different bytes\n", scene, backend);
    gn_bytes_finish(&bytes[0]);
    gn_bytes_finish(&bytes[1]);
    return same;
}

/* Why OSMesa cannot be had, or NULL: only "not built in" is a reason to skip. */
static const char *osmesa_missing(const char *scene) {
    static struct gn_err err;
    struct gn_picture picture;
    bool ok = shot_by(&picture, "osmesa", scene, &looks[0], &err);
    gn_picture_finish(&picture);
    return !ok && strstr(err.text, "not built in") ? err.text : NULL;
}

int main(void) {
    struct gn_err err = {0};
    char *folder = gn_table_scenes(false, &err), generated[2][600];
    if (!folder) {
        printf("%s\n", err.text);
        return 1;
    }
    for (int i = 0; i < 2; i++)
        snprintf(generated[i], sizeof generated[i], "%s/truth-%02d.glb", folder, i ? 14 : 3);
    free(folder);
    const char *scenes[] = {"assets/bench/yard.glb", "assets/bench/s1.glb", generated[0],
                            generated[1]};
    const char *missing = osmesa_missing(generated[0]);
    int failures = 0;
    for (int s = 0; s < 4; s++)
        for (int l = 0; l < LOOKS; l++) {
            failures += !runs_are_equal(scenes[s], "egl", &looks[l]);
            if (missing) continue;
            failures += !backends_agree(scenes[s], &looks[l]);
            if (l == 0) failures += !runs_are_equal(scenes[s], "osmesa", &looks[l]);
        }
    if (missing) printf("OSMesa is not compared: %s\n", missing);
    return failures ? 1 : missing ? SKIP : 0;
}
