/* What soft shadows cost as their penumbrae grow: tool_widths [OPTION of bench].. Bars 3 m over the
 * ground under suns of several sizes, seen from above. They are as wide as a penumbra's radius, and
 * so are the gaps: whatever its size, all of the ground is penumbra, and no pixel is spared a part
 * of the work. Nothing moves, so maps are kept. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "shadow/technique.h"
#include "unit/gltf_maker.h"

enum { HEIGHT_M = 3, TECHNIQUES = GN_TECHNIQUE_COUNT };
static const char *techniques[TECHNIQUES]; /* none, and those with penumbrae */
static int technique_count;
static char list[40 * TECHNIQUES];

static void list_techniques(void) {
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        if (t != GN_TECHNIQUE_NONE && !gn_techniques[t].soft) continue;
        techniques[technique_count++] = gn_techniques[t].name;
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", *list ? "," : "",
                 gn_techniques[t].name);
    }
}

static void quit(const char *what) {
    fprintf(stderr, "tool_widths: %s\n", what);
    exit(1);
}

static void write_scene(const char *path, double radius) {
    enum { ALONG_M = 3, MOST = 1000 };
    const double width_m = HEIGHT_M * radius;
    const int bars = (int)(ALONG_M / width_m) < MOST ? (int)(ALONG_M / width_m) : MOST;
    struct gn_maker maker;
    struct gn_err err = {0};
    char json[300], roots[8 * MOST] = "[{'nodes':[0,1,2";
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[12,1,12]},"
                 "{'camera':0,'translation':[0,2.5,0],'rotation':[-0.70710678,0,0,0.70710678]},"
                 "{'rotation':[-0.70710678,0,0,0.70710678],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}}]");
    for (int i = 0; i < bars; i++) {
        snprintf(json, sizeof json, "{'mesh':0,'translation':[%.6f,%d,0],'scale':[%.6f,1,20]}",
                 (2 * i - bars + 1) * width_m, HEIGHT_M, width_m / 2);
        snprintf(roots + strlen(roots), 8, ",%d", gn_maker_add(&maker, "nodes", json));
    }
    snprintf(roots + strlen(roots), 8, "]}]");
    gn_maker_set(&maker, "scenes", roots);
    snprintf(json, sizeof json,
             "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3,"
             "'extras':{'gnomon_radius':%.6f}}]}}",
             radius);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions", json);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.7,'znear':0.1,'zfar':60}}]");
    if (!gn_maker_write(&maker, path, &err)) quit(err.text);
}

/* Runs gnomon; what it wrote. */
static const char *ask(const char *const argv[]) {
    static struct gn_run run;
    struct gn_err err = {0};
    if (!gn_run(&run, argv, 300, &err)) quit(err.text);
    if (run.status != 0) quit(run.err);
    return run.out;
}

/* Of the map that a technique gets, metres. */
static double texel_of(const char *scene) {
    char picture[600];
    snprintf(picture, sizeof picture, "%s/widths.png", gn_shot_build());
    const char *const argv[] = {gn_shot_program(), "render", scene,     "-o",       picture,
                                "--plan",          "--size", "320x180", "--shadow", "vssm",
                                "--backend",       "egl",    NULL};
    const char *at = strstr(ask(argv), ", texel ");
    if (!at) quit("no map in the plan");
    return atof(at + 8);
}

static void measure(const char *scene, int count, char **options, double ms[TECHNIQUES]) {
    const char *argv[40] = {
        gn_shot_program(), "bench",   scene,      "--shadow", list,    "--backend", "egl",
        "--size",          "320x180", "--frames", "10",       "--json"};
    int n = 12;
    for (int i = 0; i < count && n < 39; i++) argv[n++] = options[i];
    json_t *report = json_loads(ask(argv), 0, NULL), *run;
    size_t i;
    json_array_foreach(json_object_get(report, "runs"), i, run) for (int t = 0; t < technique_count;
                                                                     t++) {
        const char *name = json_string_value(json_object_get(run, "technique"));
        if (name && strcmp(name, techniques[t]) == 0)
            ms[t] = fmin(ms[t], json_number_value(json_object_get(run, "cpu_ms")));
    }
    json_decref(report);
}

/* A scene whose penumbrae have this radius; what they have in truth. */
static double make_scene(const char *path, double texels) {
    double radius = 0.02;
    for (int i = 0; i < 3; i++) { /* a larger sun makes a wider map */
        write_scene(path, radius);
        radius = texels * texel_of(path) / HEIGHT_M;
    }
    write_scene(path, radius);
    return HEIGHT_M * radius / texel_of(path);
}

/* Widths take turns, so that what else the machine does falls on all of them; of all rounds the
 * least counts. */
int main(int argc, char **argv) {
    enum { WIDTHS = 6, ROUNDS = 10 };
    double ms[WIDTHS][TECHNIQUES], texels[WIDTHS], most[TECHNIQUES] = {0}, least[TECHNIQUES];
    char scenes[WIDTHS][600];
    list_techniques();
    for (int w = 0; w < WIDTHS; w++) {
        snprintf(scenes[w], sizeof scenes[w], "%s/widths%d.glb", gn_shot_build(), w);
        texels[w] = make_scene(scenes[w], 2 << w);
        for (int t = 0; t < technique_count; t++) ms[w][t] = least[t] = INFINITY;
    }
    for (int i = 0; i < ROUNDS * WIDTHS; i++)
        measure(scenes[i % WIDTHS], argc - 1, argv + 1, ms[i % WIDTHS]);
    printf("radius of the penumbra, and CPU ms of a frame less those without shadows: the least of "
           "%d rounds\n%8s",
           ROUNDS, "texels");
    for (int t = 1; t < technique_count; t++) printf(" %8s", techniques[t]);
    printf("\n");
    for (int w = 0; w < WIDTHS; w++) {
        printf("%8.1f", texels[w]);
        for (int t = 1; t < technique_count; t++) {
            const double own = ms[w][t] - ms[w][0];
            most[t] = fmax(most[t], own);
            least[t] = fmin(least[t], own);
            printf(" %8.2f", own);
        }
        printf("\n");
    }
    printf("%8s", "most");
    for (int t = 1; t < technique_count; t++) printf(" %7.0f%%", 100 * (most[t] / least[t] - 1));
    printf("\n");
    return 0;
}
