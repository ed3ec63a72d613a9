/* Loading a scene: the steps in order; freeing a scene; finding its cameras and clips. */
#include "scene/private.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"

struct holder { /* what scene->memory.arena points to */
    struct gn_arena arena;
    struct gn_scene scene;
};

static bool count_textures(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g);
    struct gn_at textures = gn_at_array(g, &root, "textures"),
                 images = gn_at_array(g, &root, "images");
    g->file.texture_count = gn_at_size(&textures);
    g->file.image_count = gn_at_size(&images);
    return !g->failed;
}

/* Limits what a frame would draw, before any of it is unpacked: a few hundred bytes can name a
 * million instances of a million triangles, which would hang any GPU. */
static bool check_triangles(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), nodes = gn_at_any(&root, "nodes");
    uint64_t total = 0;
    for (uint32_t i = 0; i < g->scene->node_count; i++) {
        const struct gn_placed *placed = &g->placed[i];
        if (placed->mesh < 0) continue;
        const struct gn_mesh *mesh = &g->file.meshes[placed->mesh];
        uint64_t triangles = 0;
        const struct gn_primitive *primitives = &g->primitives.list[mesh->first_primitive];
        for (uint32_t k = 0; k < mesh->primitive_count; k++)
            if (!(primitives[k].hidden_in & 1))
                triangles += g->primitives.shapes[primitives[k].geometry].corner_count / 3;
        const uint64_t instances = placed->instance_count ? placed->instance_count : 1;
        if (triangles > 0 && instances > (g->limits.triangles_per_frame - total) / triangles)
            return gn_gltf_fail(g, &nodes,
                                "more triangles than the limit triangles_per_frame=%" PRIu64,
                                g->limits.triangles_per_frame);
        total += triangles * instances;
    }
    return true;
}

/* With how much of the load is done before each, per mille: what takes long is to read the files,
 * the geometry, and the pictures of materials. */
enum { FILE_PERMILLE = 300 };
static const struct {
    bool (*run)(struct gn_gltf *);
    unsigned permille;
} STEPS[] = {
    {gn_gltf_check_support, FILE_PERMILLE},
    {gn_gltf_buffers, 320},
    {gn_gltf_list_accessors, 420},
    {count_textures, 450},
    {gn_gltf_nodes, 450},
    {gn_gltf_variants, 460},
    {gn_gltf_meshes, 460},
    {gn_gltf_instances, 470},
    {check_triangles, 480},
    {gn_gltf_skins, 480},
    {gn_gltf_far, 480},
    {gn_gltf_geometries, 480},
    {gn_gltf_items, 700},
    {gn_gltf_pointers, 710},
    {gn_gltf_materials, 710},
    {gn_gltf_lights, 930},
    {gn_gltf_cameras, 930},
    {gn_gltf_animations, 930},
    {gn_scene_complete, 950},
    {gn_scene_lay_occlusion, 975},
    {gn_scene_batch, 980},
    {gn_scene_count_gpu, 990},
};

/* fit_px: the side that pictures must be within for another try; 0: there is no other try. */
static struct gn_scene *load_once(struct gn_gltf *g, const uint8_t *data, size_t size,
                                  uint32_t *fit_px) {
    struct holder *holder = gn_xalloc(1, sizeof *holder);
    holder->scene.memory.arena = holder;
    g->memory.scene = &holder->arena;
    g->scene = &holder->scene;
    g->memory.other_bytes = size;
    g->read_bytes = size;
    bool done = gn_gltf_open(g, data, size);
    const size_t steps = sizeof STEPS / sizeof STEPS[0];
    for (size_t i = 0; done && i < steps; i++) {
        g->permille[0] = STEPS[i].permille;
        g->permille[1] = i + 1 < steps ? STEPS[i + 1].permille : 1000;
        gn_gltf_progress(g, 0, 1);
        done = STEPS[i].run(g) && gn_gltf_check_time(g);
    }
    done = done && !g->failed;
    /* after success, or a failure by a limit, smaller pictures may fit */
    *fit_px = done || !g->failed_part ? gn_gltf_fit_pictures(g) : 0;
    holder->scene.memory.bytes = holder->arena.used + sizeof *holder;
    holder->scene.memory.loading_bytes = g->memory.most_bytes + sizeof *holder;
    for (size_t i = 0; i < g->file.buffer_count; i++) gn_blob_finish(g, &g->file.buffers[i]);
    json_decref(g->file.json);
    gn_arena_finish(&g->memory.step);
    gn_arena_finish(&g->memory.load);
    if (done) return &holder->scene;
    gn_scene_destroy(&holder->scene);
    return NULL;
}

/* Loads, and while its pictures are over a limit loads again with smaller ones. Warnings are those
 * of the last load. */
static struct gn_scene *load_scene(struct gn_gltf *g, const uint8_t *data, size_t size) {
    struct gn_scene *scene;
    struct gn_warnings before = {0};
    uint32_t fit_px = 0;
    if (g->warnings) before = *g->warnings;
    g->hash_key = gn_hash_key_make();
    g->end_ns = gn_clock_thread_cpu_ns() + (int64_t)g->limits.seconds * GN_NS_PER_S;
    const struct gn_gltf begin = *g;
    while (scene = load_once(g, data, size, &fit_px), fit_px > 0) {
        const struct gn_gltf_pictures over = g->pictures;
        const uint64_t decode_work = g->decode_work; /* the time is spent */
        gn_scene_destroy(scene);
        *g = begin;
        g->limits.texture_px = fit_px;
        g->pictures.loads = over.loads + 1;
        g->decode_work = decode_work;
        if (g->err) *g->err = (struct gn_err){0};
        if (g->warnings) *g->warnings = before;
        gn_warn(g->warnings,
                "%s: its pictures are over the limit %s=%" PRIu64 ": the largest are halved until "
                "no side is longer than %" PRIu32 " pixels",
                g->path, over.over, over.over_mb, fit_px);
    }
    free(g->folder);
    return scene;
}

struct gn_scene *gn_scene_load_bytes(const char *label, const void *data, size_t size,
                                     const struct gn_scene_limits *limits,
                                     struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_gltf g = {.path = label, .warnings = warnings, .err = err};
    g.limits = gn_scene_limits_or_default(limits);
    return load_scene(&g, data, size);
}

char *gn_scene_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    char folder[PATH_MAX] = ".";
    size_t length = slash == path ? 1 : slash ? (size_t)(slash - path) : strlen(folder);
    if (length >= sizeof folder) return NULL;
    if (slash) memcpy(folder, path, length);
    folder[length] = 0;
    return realpath(folder, NULL);
}

static bool read_model(const struct gn_gltf *g, struct gn_bytes *bytes) {
    const uint64_t most = g->limits.file_mb << 20;
    return gn_file_read_progress(g->path, most < SIZE_MAX ? (size_t)most : SIZE_MAX,
                                 g->limits.progress, FILE_PERMILLE, bytes, g->err);
}

struct gn_scene *gn_scene_load_converted(const char *path, const void *data, size_t size,
                                         const struct gn_scene_limits *limits,
                                         struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_gltf g = {.path = path, .warnings = warnings, .err = err};
    g.limits = gn_scene_limits_or_default(limits);
    g.folder = gn_scene_folder(path);
    return load_scene(&g, data, size);
}

struct gn_scene *gn_scene_load(const char *path, const struct gn_scene_limits *limits,
                               struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_gltf g = {.path = path, .warnings = warnings, .err = err};
    g.limits = gn_scene_limits_or_default(limits);
    struct gn_bytes bytes = {0};
    if (!read_model(&g, &bytes)) return NULL;
    g.folder = gn_scene_folder(path);
    struct gn_scene *scene = load_scene(&g, bytes.data, bytes.size);
    gn_bytes_finish(&bytes);
    return scene;
}

bool gn_scene_uses(const char *path, const struct gn_scene_limits *limits, const char *extension) {
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    struct gn_gltf g = {.path = path, .warnings = &warnings, .err = &err};
    g.limits = gn_scene_limits_or_default(limits);
    g.limits.progress = NULL; /* it has been read before */
    g.hash_key = gn_hash_key_make();
    g.end_ns = gn_clock_thread_cpu_ns() + (int64_t)g.limits.seconds * GN_NS_PER_S;
    struct gn_arena none = {0};
    g.memory.scene = &none;
    struct gn_bytes bytes = {0};
    const bool found = read_model(&g, &bytes) && gn_gltf_open(&g, bytes.data, bytes.size) &&
                       gn_gltf_uses(&g, extension);
    json_decref(g.file.json);
    gn_arena_finish(&g.memory.step);
    gn_arena_finish(&g.memory.load);
    gn_arena_finish(&none);
    gn_bytes_finish(&bytes);
    return found;
}

void gn_scene_destroy(struct gn_scene *scene) {
    if (!scene) return;
    struct holder *holder = scene->memory.arena;
    gn_arena_finish(&holder->arena);
    free(holder);
}

/* ---- finding ---- */

enum list { CAMERAS, LIGHTS, CLIPS, VARIANTS };

/* second: of a camera or a light, the name of its node. */
static const char *listed_name(const struct gn_scene *scene, enum list list, uint32_t i,
                               bool second) {
    if (list == VARIANTS) return scene->variants.names[i];
    if (list == CLIPS) return scene->animation.clips[i].name;
    if (list == LIGHTS)
        return second ? scene->nodes[scene->lights[i].node].name : scene->lights[i].name;
    return second ? scene->nodes[scene->cameras[i].node].name : scene->cameras[i].name;
}

static int find_listed(const struct gn_scene *scene, enum list list, const char *what,
                       struct gn_err *err) {
    static const char *const kinds[] = {"camera", "light", "animation", "variant"};
    const uint32_t counts[] = {scene->camera_count, scene->light_count, scene->animation.clip_count,
                               scene->variants.count};
    const char *kind = kinds[list];
    const uint32_t count = counts[list];
    if (count > 0 && (!what || !*what)) return 0;
    for (uint32_t i = 0; what && i < 2 * count; i++)
        if (strcmp(listed_name(scene, list, i % count, i >= count), what) == 0)
            return (int)(i % count);
    char *end = NULL;
    unsigned long number =
        what && *what >= '0' && *what <= '9' ? strtoul(what, &end, 10) : ULONG_MAX;
    if (end && *end == 0 && number < count) return (int)number;
    char names[360] = "";
    size_t at = 0;
    for (uint32_t i = 0; i < count && at < sizeof names; i++)
        at += (size_t)snprintf(names + at, sizeof names - at, "%s%" PRIu32 " '%.40s'",
                               i > 0 ? ", " : "", i, listed_name(scene, list, i, false));
    if (count == 0)
        gn_fail_usage(err, "the scene has no %s", kind);
    else
        gn_fail_usage(err, "no %s named '%.60s'; available: %s", kind, what, names);
    return -1;
}

int gn_scene_find_camera(const struct gn_scene *scene, const char *what, struct gn_err *err) {
    return find_listed(scene, CAMERAS, what, err);
}

int gn_scene_find_light(const struct gn_scene *scene, const char *what, struct gn_err *err) {
    return find_listed(scene, LIGHTS, what, err);
}

int gn_scene_find_clip(const struct gn_scene *scene, const char *what, struct gn_err *err) {
    return find_listed(scene, CLIPS, what, err);
}

int gn_scene_find_variant(const struct gn_scene *scene, const char *what, struct gn_err *err) {
    return find_listed(scene, VARIANTS, what, err);
}
