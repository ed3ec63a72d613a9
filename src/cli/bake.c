/* gnomon bake: a scene as one small .glb, and what that saves. */
#include "bake/bake.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/commands.h"
#include "cli/units.h"
#include "core/clock.h"
#include "core/json.h"
#include "stage/import.h"
#include "stage/stage.h"

struct measures { /* of a file and its scene */
    uint64_t file_bytes, triangles, vertices, gpu_bytes, scene_bytes;
    double load_ms;
};
struct bake {
    const struct gn_settings *settings;
    struct gn_scene_limits limits;
    struct gn_bytes source, baked;
    struct gn_bake_report report;
    struct measures before, after;
    int texture_limit_px;
};

/* ---- measuring ---- */

static void measure_scene(const struct gn_scene *s, struct measures *m) {
    m->vertices = s->buffers.vertex_count;
    m->triangles = s->buffers.index_count / 3;
    m->scene_bytes = s->memory.bytes;
    m->gpu_bytes = gn_scene_gpu_bytes(s);
}

/* Loads the bytes as a scene, which must succeed, and measures that. */
static bool measure_bytes(const struct bake *b, const char *path, const struct gn_bytes *bytes,
                          struct measures *m, struct gn_warnings *warnings, struct gn_err *err) {
    const int64_t start_ns = gn_clock_thread_cpu_ns();
    struct gn_scene *scene =
        gn_scene_load_converted(path, bytes->data, bytes->size, &b->limits, warnings, err);
    if (!scene) return false;
    m->load_ms = (double)(gn_clock_thread_cpu_ns() - start_ns) * 1e-6;
    measure_scene(scene, m);
    gn_scene_destroy(scene);
    return true;
}

/* ---- the report ---- */

static void print_row(const char *name, double before, double after, int digits, const char *unit) {
    printf("%-12s %12.*f %12.*f%s", name, digits, before, digits, after, unit);
    if (before > 0) printf("  %5.1f %%", 100 * after / before);
    putchar('\n');
}

static void print_table(const struct bake *b) {
    const struct measures *x = &b->before, *y = &b->after;
    const struct gn_bake_report *r = &b->report;
    printf("%-12s %12s %12s\n", b->settings->run.out, "before", "after");
    print_row("file", (double)x->file_bytes / 1024, (double)y->file_bytes / 1024, 1, " KB");
    print_row("textures", (double)r->image_bytes_before / 1024, (double)r->image_bytes_after / 1024,
              1, " KB");
    print_row("triangles", (double)x->triangles, (double)y->triangles, 0, "   ");
    print_row("vertices", (double)x->vertices, (double)y->vertices, 0, "   ");
    print_row("GPU memory", GN_MB(x->gpu_bytes), GN_MB(y->gpu_bytes), 2, " MB");
    print_row("memory", GN_MB(x->scene_bytes), GN_MB(y->scene_bytes), 2, " MB");
    print_row("load", x->load_ms, y->load_ms, 1, " ms");
    if (r->scaled_images)
        printf("%zu of %zu pictures scaled down to %d pixels\n", r->scaled_images, r->images,
               b->texture_limit_px);
    if (b->settings->run.simplify < 1)
        printf("simplified: surfaces moved by at most %.2g %% of the size of their mesh\n",
               100 * r->error);
    if (r->kept_primitives)
        printf("%zu of %zu primitives stay as they are: not of triangles, or not finite\n",
               r->kept_primitives, r->primitives);
}

static json_t *make_measures(const struct measures *m) {
    return json_pack("{so so so so so so}", "file_bytes", gn_json_make_count(m->file_bytes),
                     "triangles", gn_json_make_count(m->triangles), "vertices",
                     gn_json_make_count(m->vertices), "gpu_bytes", gn_json_make_count(m->gpu_bytes),
                     "memory_bytes", gn_json_make_count(m->scene_bytes), "load_ms",
                     gn_json_make_number(m->load_ms));
}

static bool print_json(const struct bake *b, struct gn_err *err) {
    const struct gn_bake_report *r = &b->report;
    return gn_json_print(json_pack("{so so so so so so so so so so so so}", "file",
                                   gn_json_make_text(b->settings->scene.path), "out",
                                   gn_json_make_text(b->settings->run.out), "before",
                                   make_measures(&b->before), "after", make_measures(&b->after),
                                   "image_bytes_before", gn_json_make_count(r->image_bytes_before),
                                   "image_bytes_after", gn_json_make_count(r->image_bytes_after),
                                   "images", gn_json_make_count(r->images), "scaled_images",
                                   gn_json_make_count(r->scaled_images), "primitives",
                                   gn_json_make_count(r->primitives), "kept_primitives",
                                   gn_json_make_count(r->kept_primitives), "simplified_error",
                                   gn_json_make_number(r->error), "unknown_extension",
                                   r->unknown[0] ? gn_json_make_text(r->unknown) : json_null()),
                         9, stdout, err);
}

/* ---- the command ---- */

static bool check_out(const char *out, struct gn_err *err) {
    if (!out) return gn_fail_usage(err, "bake needs -o FILE.glb");
    const char *dot = strrchr(out, '.');
    return (dot && strcmp(dot, ".glb") == 0) ||
           gn_fail_usage(err, "-o %s: bake writes .glb files: name it so", out);
}

static bool read_source(struct bake *b, const char *path, struct gn_warnings *warnings,
                        struct gn_err *err) {
    struct stat info;
    if (stat(path, &info) == 0) b->before.file_bytes = (uint64_t)info.st_size;
    if (gn_import_wants(path) || gn_import_wants_refused(path, &b->limits))
        return gn_import_convert(path, &b->limits, &b->source, warnings, err);
    return gn_file_read(path, (size_t)b->limits.file_mb << 20, &b->source, err);
}

static bool bake(struct bake *b, struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_settings *s = b->settings;
    const double texture_px = s->scene.texture_limit_px;
    b->texture_limit_px = isnan(texture_px)   ? GN_BAKE_TEXTURE_PX
                          : isinf(texture_px) ? INT_MAX
                                              : (int)texture_px;
    const struct gn_bake_opts opts = {.path = s->scene.path,
                                      .limits = &b->limits,
                                      .share = s->run.simplify,
                                      .texture_limit_px = b->texture_limit_px};
    struct gn_warnings again = {0};
    b->limits = gn_stage_limits(s);
    b->limits.floor.kind = GN_FLOOR_NONE;
    b->limits.texture_px = 0;
    if (!read_source(b, s->scene.path, warnings, err) ||
        !measure_bytes(b, s->scene.path, &b->source, &b->before, warnings, err) ||
        !gn_bake(&opts, b->source.data, b->source.size, &b->baked, &b->report, warnings, err))
        return false;
    b->before.file_bytes += b->report.other_bytes;
    b->after.file_bytes = b->baked.size;
    if (b->report.unknown[0])
        gn_warn(warnings, "%s: %s may refer to any of its data: all of that is kept", s->scene.path,
                b->report.unknown);
    /* nothing is written that would not be read */
    return (measure_bytes(b, s->run.out, &b->baked, &b->after, &again, err) ||
            gn_fail_prefix(err, "not written, since gnomon would refuse it")) &&
           gn_file_write(s->run.out, b->baked.data, b->baked.size, err);
}

bool gn_cli_bake(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    struct bake b = {.settings = options->settings};
    if (!check_out(b.settings->run.out, err)) return false;
    bool done = bake(&b, warnings, err);
    if (done && b.settings->run.json)
        done = print_json(&b, err);
    else if (done)
        print_table(&b);
    gn_bytes_finish(&b.source);
    gn_bytes_finish(&b.baked);
    return done;
}
