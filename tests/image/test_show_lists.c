/* Files with 100,000 of each thing that glTF lists, shown by a kiosk while it runs: shown or
 * refused within seconds of processor time, and no step of its loop takes long. What works ahead
 * behind the picture has its own limits. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/file.h"
#include "kiosk/private.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"
#include "unit/show_help.h"

enum { MANY = 99990, MOST_MS = 500, SHOWN_S = 10, TRIES = 3, ADDED = 3 };

/* Each array of the file, by its path, gets MANY such elements, in which # stands for the element's
 * number and ' for ". The file has a square: accessors 0 and 1 are its own, 2 two times, 3 two
 * places, 4 two bytes; mesh, node and scene 0. Posed: gn_maker_posed_square(), and these are 7 to
 * 9. */
static const struct list {
    const char *name, *samplers; /* of its one clip */
    struct {
        const char *path, *element;
    } added[ADDED];
} LISTS[] = {
    {"clips",
     NULL,
     {{"animations", "{'samplers':[{'input':2,'output':3}],"
                     "'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]}"}}},
    {"clips, posed",
     NULL,
     {{"animations", "{'samplers':[{'input':7,'output':8}],"
                     "'channels':[{'sampler':0,'target':{'node':1,'path':'translation'}}]}"},
      {"nodes", "{'name':'#'}"}}},
    {"hidden nodes",
     "[{'samplers':[{'input':2,'output':4,'interpolation':'STEP'}]}]",
     {{"nodes", "{'mesh':0,'extensions':{'KHR_node_visibility':{'visible':true}}}"},
      {"scenes/0/nodes", "#"},
      {"animations/0/channels",
       "{'sampler':0,'target':{'path':'pointer','extensions':{'KHR_animation_pointer':{"
       "'pointer':'/nodes/#/extensions/KHR_node_visibility/visible'}}}}"}}},
    {"empty clips", NULL, {{"animations", "{'samplers':[],'channels':[]}"}}},
    {"channels",
     "[{'samplers':[{'input':2,'output':3}]}]",
     {{"nodes", "{'mesh':0,'translation':[0,0,#]}"},
      {"scenes/0/nodes", "1#"},
      {"animations/0/channels", "{'sampler':0,'target':{'node':#,'path':'scale'}}"}}},
    {"cameras",
     NULL,
     {{"cameras", "{'type':'perspective','perspective':{'yfov':0.5,'znear':0.1}}"},
      {"nodes", "{'camera':#,'translation':[0,0,5]}"}}},
    {"lights",
     NULL,
     {{"extensions/KHR_lights_punctual/lights", "{'type':'point','name':'#'}"},
      {"nodes", "{'extensions':{'KHR_lights_punctual':{'light':#}},'translation':[0,1,0]}"}}},
    {"skins", NULL, {{"skins", "{'joints':[0]}"}, {"nodes", "{'mesh':0,'skin':#}"}}},
    {"variants", NULL, {{"extensions/KHR_materials_variants/variants", "{'name':'#'}"}}},
    {"mappings",
     NULL,
     {{"extensions/KHR_materials_variants/variants", "{'name':'#'}"},
      {"materials", "{}"},
      {"meshes/0/primitives/0/extensions/KHR_materials_variants/mappings",
       "{'material':#,'variants':[#]}"}}},
    {"targets", NULL, {{"meshes/0/primitives/0/targets", "{'POSITION':0}"}}},
    {"materials",
     NULL,
     {{"materials", "{'pbrMetallicRoughness':{'roughnessFactor':0.#}}"},
      {"meshes/0/primitives", "{'attributes':{'POSITION':0},'indices':1,'material':#}"}}},
    {"textures",
     NULL,
     {{"textures", "{'sampler':#,'source':#}"},
      {"images", "{'uri':'#.png'}"},
      {"samplers", "{'wrapS':33071}"}}},
    {"scenes", NULL, {{"scenes", "{'nodes':[0],'name':'#'}"}}},
    {"buffers",
     NULL,
     {{"buffers", "{'byteLength':4,'uri':'data:,abcd'}"},
      {"bufferViews", "{'buffer':#,'byteLength':4}"},
      {"accessors", "{'bufferView':#,'componentType':5126,'count':1,'type':'SCALAR'}"}}},
    {"meshes",
     NULL,
     {{"meshes", "{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}"},
      {"nodes", "{'mesh':#}"},
      {"scenes/0/nodes", "#"}}},
    {"extensions", NULL, {{"extensionsUsed", "'EXT_#'"}}},
    {"extras", NULL, {{"nodes/0/extras/x", "{'#':#}"}, {"extras/y", "{'#':{}}"}}},
};
enum { LIST_COUNT = sizeof LISTS / sizeof LISTS[0] };

/* ---- the file ---- */

/* The array of that path; what is missing is made. */
static json_t *array_at(json_t *at, const char *path) {
    char part[80];
    for (int length; *path; path += length + (path[length] == '/')) {
        length = (int)strcspn(path, "/");
        snprintf(part, sizeof part, "%.*s", length, path);
        json_t *next = json_is_array(at) ? json_array_get(at, strtoul(part, NULL, 10))
                                         : json_object_get(at, part);
        const char *after = path + length;
        if (!next) {
            const bool array = !*after || (after[1] >= '0' && after[1] <= '9');
            next = array ? json_array() : json_object();
            if (json_is_array(at))
                json_array_append_new(at, next = json_object());
            else
                json_object_set_new(at, part, next);
        }
        at = next;
    }
    return at;
}

static void add_many(json_t *root, const char *path, const char *element) {
    json_t *array = array_at(root, path);
    for (int n = 0; n < MANY; n++) {
        char text[300];
        int length = 0;
        for (const char *c = element; *c; c++)
            length += *c == '#' ? snprintf(text + length, sizeof text - (size_t)length, "%d", n)
                                : snprintf(text + length, 2, "%c", *c == '\'' ? '"' : *c);
        json_array_append_new(array, json_loads(text, JSON_DECODE_ANY, NULL));
    }
}

static void write_list(const struct list *list, const char *path) {
    static const float times_s[] = {0, 1}, places[] = {0, 0, 0, 1, 1, 1};
    static const uint8_t shown[] = {1, 0};
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    if (strstr(list->name, "posed"))
        gn_maker_posed_square(&maker);
    else
        gn_maker_square(&maker);
    gn_maker_accessor(&maker, "SCALAR", 5126, 2, times_s, sizeof times_s, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, 2, places, sizeof places, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5121, 2, shown, sizeof shown, NULL);
    if (list->samplers) gn_maker_set(&maker, "animations", list->samplers);
    for (int i = 0; i < ADDED && list->added[i].path; i++)
        add_many(maker.root, list->added[i].path, list->added[i].element);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
}

/* ---- the kiosk ---- */

struct taken {
    double longest_ms, shown_s, all_s;
    bool refused;
};

/* Shows it, until nothing is made ahead any more or long after it should be there. */
static struct taken show_list(struct gn_show *show, const char *path) {
    struct taken taken = {0};
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    gn_show_load_file(show, path);
    for (int steps = 0;; steps++) {
        const int64_t start_ns = gn_clock_thread_cpu_ns();
        help_show_step(show);
        const double took_ms = 1e-6 * (double)(gn_clock_thread_cpu_ns() - start_ns);
        if (took_ms > taken.longest_ms) taken.longest_ms = took_ms;
        taken.all_s = 1e-9 * (double)(gn_clock_process_cpu_ns() - begun_ns);
        const bool loads =
            steps < 4 || show->wants_reload || show->reload.options || show->screen.staged.loaded;
        if (loads) taken.shown_s = taken.all_s;
        if (taken.shown_s > 2 * SHOWN_S || (!loads && !gn_show_has_work(&show->screen))) break;
    }
    return taken;
}

static void test_long_lists(void **state) {
    const char *folder = help_folder(), *only = getenv("GN_LIST");
    char path[200];
    int wrong = 0;
    (void)state;
    snprintf(path, sizeof path, "%s/list.glb", folder);
    struct gn_show *show = help_show((const char *[]){
        "--size", "64x64", "--shadow", "hard", "--map", "64", "build/selftest/box.glb", NULL});
    for (int i = 0; i < LIST_COUNT; i++) {
        if (only && strcmp(only, LISTS[i].name) != 0) continue;
        struct taken taken = {.longest_ms = 1e9};
        write_list(&LISTS[i], path);
        for (int n = 0; n < TRIES && taken.longest_ms > MOST_MS; n++) taken = show_list(show, path);
        printf("%-16s longest step %4.0f ms, shown after %5.2f s, %5.2f s in all\n", LISTS[i].name,
               taken.longest_ms, taken.shown_s, taken.all_s);
        wrong += taken.longest_ms > MOST_MS || taken.shown_s > SHOWN_S;
    }
    gn_show_close(show);
    help_remove(folder);
    assert_int_equal(wrong, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_long_lists)};
    return cmocka_run_group_tests_name("show_lists", tests, NULL, NULL);
}
