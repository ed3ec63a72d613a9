/* Builds the programs on the GPU that EGL finds, draws with each once, and prints what it costs:
 *   tool_gpus [--full] [--known FILE] [--turn N] [--shaders DIR]
 * Made for drivers behind which is no GPU (README.md): they compile and execute nothing, so nothing
 * that is drawn is looked at, and what the GPU claims is not proved. Programs come out of plans
 * that the frame builder makes of small scenes, with every technique, light and encoding that there
 * is in the tables. What is tried with one kind of light only is so with another one for another N.
 * Prints, separated by tabs,
 *   GPU renderer version    COST hash instructions spills fetches stage program    FAIL what DONE
 * counts and ends with 0, 1 (something failed) or 2 (nothing could be tried). What an earlier run
 * with the same driver has found may be in FILE (known/): what has the same hash is not compiled
 * again. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "caption/captions.h"
#include "core/arena.h"
#include "core/hash.h"
#include "display/display.h"
#include "frame/frame.h"
#include "gpus/cost.h"
#include "gpus/scenes.h"

struct bench {
    bool full, looks, only_looks, only_posed;
    int turn;
    const char *known; /* file, or NULL */
    struct gn_display display;
    struct gn_gl *gl;
    struct gn_listener listener;
    struct gn_keys seen; /* drawn with, and its cost printed */
    unsigned plans, compiled, failures;
    uint32_t kinds, targets, outputs; /* bits of what was there */
};

struct stage { /* one scene, loaded */
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_frame *frame;
};

static bool fail(struct bench *b, const char *what, const char *why) {
    printf("FAIL\t%s: %s\n", what, why);
    b->failures++;
    return false;
}

/* ---- programs, of which a plan may be to test some only ------------------------------------- */

enum what { EVERYTHING, ALL_BUT_LIT, NO_PROGRAM };

static bool is_drawn(const struct gn_plan *plan, uint32_t program) {
    for (uint32_t i = 0; i < plan->draw_count; i++)
        if (plan->draws[i].program == program) return true;
    return false;
}

static bool measure(struct bench *b, const struct gn_plan *plan, uint32_t index) {
    struct gn_cost cost = {0};
    uint64_t hash = 0;
    char name[200];
    const struct gn_program_key *key = &plan->programs[index];
    gn_gl_key_text(key, name, sizeof name);
    gn_keys_add(&b->seen, key);
    b->kinds |= 1u << key->kind;
    if (!gn_cost_hash(b->gl, plan, key, name, &hash) || !gn_cost_find(b->known, hash, &cost)) {
        struct gn_err err = {0};
        b->compiled++;
        if (!gn_cost_compile(&b->listener, plan, index, name, &cost, &err))
            return fail(b, name, err.text);
    }
    for (int i = 0; i < cost.count; i++)
        printf("COST\t%016llx\t%u\t%u\t%d\t%s\t%s\n", (unsigned long long)hash,
               cost.stages[i].instructions, cost.stages[i].spills, cost.stages[i].fetches,
               cost.stages[i].name, name);
    return true;
}

static bool is_wanted(enum what what, const struct gn_program_key *key) {
    const bool lit = key->kind == GN_PROGRAM_LIT || key->kind == GN_PROGRAM_AOV;
    return what == EVERYTHING || (what == ALL_BUT_LIT && !lit);
}

static bool measure_new(struct bench *b, const struct gn_plan *plan, enum what what) {
    bool ok = true;
    for (uint32_t i = 0; i < plan->program_count; i++)
        if (is_wanted(what, &plan->programs[i]) && is_drawn(plan, i) &&
            !gn_keys_have(&b->seen, &plan->programs[i]))
            ok = measure(b, plan, i) && ok;
    return ok;
}

/* ---- plans --------------------------------------------------------------------------------- */

static void note_plan(struct bench *b, const struct gn_plan *plan) {
    b->plans++;
    b->outputs |= 1u << plan->output;
    for (uint32_t i = 0; i < plan->pass_count; i++) b->targets |= 1u << plan->passes[i].target.kind;
}

/* Its passes with nothing in them: clears, resolves, copies, and all its framebuffers. */
static bool run_bare(struct bench *b, const struct gn_plan *plan, struct gn_err *err) {
    struct gn_plan bare = *plan;
    bare.passes = gn_xalloc(plan->pass_count, sizeof *bare.passes);
    memcpy(bare.passes, plan->passes, plan->pass_count * sizeof *bare.passes);
    for (uint32_t i = 0; i < plan->pass_count; i++) bare.passes[i].draw_count = 0;
    bare.program_count = 0;
    const bool ok = gn_gl_prepare(b->gl, &bare, err) && gn_gl_run(b->gl, &bare, NULL, err);
    free(bare.passes);
    return ok;
}

static bool draw(struct bench *b, const struct stage *s, const struct gn_frame_opts *opts,
                 enum what wanted, const char *what) {
    struct gn_err err = {0};
    const struct gn_plan *plan = gn_frame_build(s->frame, &s->pose, opts, NULL);
    note_plan(b, plan);
    if (!run_bare(b, plan, &err) || !gn_gl_error_check(b->gl, what, &err))
        return fail(b, what, err.text);
    return measure_new(b, plan, wanted);
}

static void stage_open(struct bench *b, struct stage *s, enum gn_gpu_scene which) {
    struct gn_err err = {0};
    gn_cost_forget_programs(b->gl);
    *s = (struct stage){.scene = gn_gpu_scene_make(which)};
    if (!gn_gl_load(b->gl, s->scene, &err)) fail(b, "loading a scene", err.text);
    gn_pose_init(&s->pose, s->scene, GN_POSE_DEFAULT);
    s->frame = gn_frame_create(s->scene, gn_gl_caps(b->gl));
}

static void stage_close(struct stage *s) {
    gn_frame_destroy(s->frame);
    gn_pose_finish(&s->pose);
    gn_scene_destroy(s->scene);
}

/* Small pictures, where all is seen: what is compiled does not depend on the size. */
static struct gn_frame_opts opts_of(enum gn_technique technique, enum gn_encoding encoding) {
    return (struct gn_frame_opts){
        .output.width_px = 64,
        .output.height_px = 48,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = technique,
                       .map_px = 64,
                       .map_format = GN_MAP_FORMAT(encoding, GN_MOMENTS_NONE)},
        .all_seen = true};
}

/* ---- techniques: each with every light and encoding that it can have ------------------------ */

static bool has_program(const struct bench *b, enum gn_light_type type, enum gn_technique technique,
                        enum gn_encoding encoding) {
    for (uint32_t i = 0; i < b->seen.count; i++) {
        const struct gn_program_light *light = &b->seen.at[i].lights[0];
        const bool shadowed = b->seen.at[i].shadow_count > 0 || technique == GN_TECHNIQUE_NONE;
        if (b->seen.at[i].kind == GN_PROGRAM_LIT && b->seen.at[i].light_count == 1 && shadowed &&
            light->type == type && light->technique == technique &&
            (technique == GN_TECHNIQUE_NONE ||
             light->encoding == gn_encoding_of_programs(encoding)))
            return true;
    }
    return false;
}

static void try_encoding(struct bench *b, const struct stage *s, enum gn_technique technique,
                         enum gn_encoding encoding) {
    struct gn_frame_opts opts = opts_of(technique, encoding);
    char what[80];
    snprintf(what, sizeof what, "%s, %s", gn_techniques[technique].name,
             gn_encodings[encoding].name);
    if (gn_techniques[technique].on_plane) {
        opts.shadow.planar_in_stencil = encoding == GN_ENCODING_STENCIL;
        opts.shadow.planar_points = encoding == GN_ENCODING_MEAN ? 64 : 0;
        GN_LIGHT_SET(&opts.shadow.any, map_format,
                     GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_NONE));
    }
    const enum gn_light_type type = s->scene->lights[0].type;
    if (draw(b, s, &opts, EVERYTHING, what) && !has_program(b, type, technique, encoding))
        fail(b, what, "the plan has no such program");
    opts.shadow.cascades = 1; /* its map is so small that a sun has some by itself */
    if (type == GN_LIGHT_DIRECTIONAL) draw(b, s, &opts, EVERYTHING, what);
}

/* all: not only the one that it gets by itself. */
static bool wants_encoding(const struct bench *b, enum gn_technique t, int encoding, bool all) {
    if (t == GN_TECHNIQUE_NONE) return encoding == 0;
    const uint32_t proved = gn_caps_encodings(gn_gl_caps(b->gl));
    bool fell_back;
    if (gn_techniques[t].on_plane && encoding > GN_ENCODING_MASK) return true;
    const enum gn_encoding own = gn_encoding_choose(t, GN_ENCODING_AUTO, proved, &fell_back);
    if (encoding == (int)own) return true;
    if (encoding == GN_ENCODING_DEPTH16) return false; /* has the programs of DEPTH */
    return all &&
           (int)gn_encoding_choose(t, (enum gn_encoding)encoding, proved, &fell_back) == encoding &&
           !fell_back;
}

/* All lights with the encoding that a technique gets by itself, and with all those of the first
 * technique; else one light, another one for each pair and GPU. Without --full there is only the
 * latter, of the encoding that it gets by itself. */
static bool wants_program(const struct bench *b, enum gn_technique t, int encoding, int light) {
    const bool own = wants_encoding(b, t, encoding, false);
    if (!b->full) return own && ((int)t + b->turn) % 3 == light;
    if (!wants_encoding(b, t, encoding, true)) return false;
    return own || t == GN_TECHNIQUE_HARD || ((int)t + encoding + b->turn) % 3 == light;
}

static void try_techniques(struct bench *b, enum gn_gpu_scene which) {
    struct stage s;
    stage_open(b, &s, which);
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
        for (int e = 0; e < GN_ENCODING_COUNT; e++)
            if (wants_program(b, (enum gn_technique)t, e, (int)which))
                try_encoding(b, &s, (enum gn_technique)t, (enum gn_encoding)e);
    stage_close(&s);
}

static void try_slides(struct bench *b) {
    for (int which = GN_GPU_SLIDE; which <= (b->full ? GN_GPU_FILM : GN_GPU_SLIDE); which++) {
        struct stage s;
        stage_open(b, &s, (enum gn_gpu_scene)which);
        for (int t = GN_TECHNIQUE_NONE; t <= GN_TECHNIQUE_PCF; t++) {
            if (t != GN_TECHNIQUE_NONE && !(b->full && t == GN_TECHNIQUE_PCF)) continue;
            const struct gn_frame_opts opts = opts_of((enum gn_technique)t, GN_ENCODING_AUTO);
            draw(b, &s, &opts, EVERYTHING, "a slide");
        }
        stage_close(&s);
    }
}

/* ---- pictures: every form that the target can have ------------------------------------------ */

static bool lay_over(struct bench *b, const char *what) {
    struct gn_err err = {0};
    if (!gn_gl_keep(b->gl, &err)) return fail(b, what, err.text);
    gn_gl_lay_over(b->gl, 0.5f);
    return gn_gl_error_check(b->gl, what, &err) || fail(b, what, err.text);
}

/* Each operator of the tone, by surfaces and by the last pass; and with alpha. */
static void try_tones(struct bench *b, const struct stage *s, enum what wanted) {
    for (int tone = GN_TONE_NONE; tone < GN_TONE_COUNT; tone++)
        for (int form = 0; form < 3; form++) {
            struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF, GN_ENCODING_AUTO);
            opts.tone = (enum gn_tone)tone;
            opts.output.unencoded = form == 1;
            opts.output.keeps_alpha = form == 2;
            if (opts.output.keeps_alpha) opts.background = GN_BACKGROUND_TRANSPARENT;
            draw(b, s, &opts, wanted, "tone");
        }
}

/* A picture into a mean, and that over another view's picture. */
static void try_mean(struct bench *b, const struct stage *s, struct gn_frame_opts opts) {
    opts.number = 1;
    opts.gather.part = opts.gather.whole = 0.5f;
    draw(b, s, &opts, ALL_BUT_LIT, "gather");
    opts.number = 0;
    opts.gather.part = 0;
    opts.cover.mean = 0.5f;
    opts.cover.mean_of = 1;
    draw(b, s, &opts, ALL_BUT_LIT, "mean");
}

/* Bytes that the target, shaders or nobody encodes, floats; with samples, a stencil, scaled. */
static void try_outputs(struct bench *b, const struct stage *s, enum what wanted) {
    for (int form = 0; form < 4; form++)
        for (uint32_t msaa = 0; msaa <= 4; msaa += 4)
            for (int planar = 0; planar < 2; planar++) {
                char what[80];
                struct gn_frame_opts opts =
                    opts_of(planar ? GN_TECHNIQUE_PLANAR : GN_TECHNIQUE_PCF, GN_ENCODING_AUTO);
                snprintf(what, sizeof what, "picture of form %d, %u samples%s", form, msaa,
                         planar ? ", stencil" : "");
                opts.output.msaa = msaa;
                opts.shadow.planar_in_stencil = planar;
                opts.output.unencoded = form == 1;
                opts.output.linear = form == 2;
                opts.output.floats = form == 3;
                b->gl->targets.wants_stencil = false;
                if (draw(b, s, &opts, wanted, what) && form < 2) lay_over(b, what);
                if (wanted == EVERYTHING && form < 2 && msaa == 0 && !planar) try_mean(b, s, opts);
                opts.output.scale = .75f;
                draw(b, s, &opts, wanted, what);
            }
}

static void try_aovs(struct bench *b, const struct stage *s) {
    for (int aov = GN_AOV_COLOR + 1; aov < GN_AOV_COUNT; aov++) {
        struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF, GN_ENCODING_AUTO);
        opts.debug.aov = (enum gn_aov)aov;
        opts.occlusion.on = true;
        draw(b, s, &opts, EVERYTHING, "aov");
    }
}

static void try_overlays(struct bench *b, const struct stage *s) {
    struct gn_captions *captions = gn_captions_create(&(struct gn_captions_opts){.font = ""});
    gn_captions_set(captions, GN_CAPTION_MODE, "caption", 0);
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++)
        for (int encoding = 0; encoding < GN_ENCODING_COUNT; encoding++) {
            struct gn_frame_opts opts = opts_of((enum gn_technique)t, (enum gn_encoding)encoding);
            if (!wants_encoding(b, (enum gn_technique)t, encoding, true)) continue;
            opts.shadow.planar_points = encoding == GN_ENCODING_MEAN ? 64 : 0;
            opts.output.width_px = 320, opts.output.height_px = 240;
            opts.debug.show_lights = opts.debug.show_maps = true;
            opts.cover.captions =
                gn_captions_run(captions, opts.output.width_px, opts.output.height_px, 0);
            draw(b, s, &opts, ALL_BUT_LIT, "overlays");
        }
    gn_captions_destroy(captions);
}

/* Maps of every encoding, that go with the eye, too; and what draws them. */
static void try_maps(struct bench *b, enum gn_gpu_scene which) {
    struct stage s;
    stage_open(b, &s, which);
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++)
        for (int e = 0; e < GN_ENCODING_COUNT; e++) {
            struct gn_frame_opts opts = opts_of((enum gn_technique)t, (enum gn_encoding)e);
            if (!wants_encoding(b, (enum gn_technique)t, e, true)) continue;
            opts.shadow.planar_points = e == GN_ENCODING_MEAN ? 64 : 0;
            opts.all_seen = false;
            for (int step = 0; step < 3; step++) {
                opts.view.turntable_rad = 0.7f * (float)step;
                draw(b, &s, &opts, ALL_BUT_LIT, "maps");
            }
            GN_LIGHT_SET(&opts.shadow.any, faces, 1 + GN_CAST_MIDDLE);
            if (t == GN_TECHNIQUE_HARD) draw(b, &s, &opts, ALL_BUT_LIT, "maps of middles");
        }
    stage_close(&s);
}

static void try_materials(struct bench *b, enum gn_gpu_scene which, enum gn_technique technique) {
    struct stage s;
    const struct gn_frame_opts opts = opts_of(technique, GN_ENCODING_AUTO);
    stage_open(b, &s, which);
    draw(b, &s, &opts, EVERYTHING, "materials");
    if (b->full) {
        try_aovs(b, &s);
        try_tones(b, &s, EVERYTHING);
    }
    try_outputs(b, &s, b->full ? EVERYTHING : NO_PROGRAM);
    stage_close(&s);
}

static void try_pictures(struct bench *b) {
    struct stage s;
    stage_open(b, &s, GN_GPU_SUN);
    try_outputs(b, &s, EVERYTHING);
    try_aovs(b, &s);
    try_overlays(b, &s);
    try_tones(b, &s, EVERYTHING);
    stage_close(&s);
    if (!b->full) {
        try_materials(b, GN_GPU_FEW_MATERIALS, GN_TECHNIQUE_NONE);
        return;
    }
    try_materials(b, GN_GPU_MATERIALS, GN_TECHNIQUE_PCF);
    try_materials(b, GN_GPU_LAMPS, GN_TECHNIQUE_PCF);
    try_materials(b, GN_GPU_CROWD, GN_TECHNIQUE_PCF);
}

/* A model as it is shown by itself: the studio and its tone, on the unseen floor; as metal shows it
 * beside lights of the file's own; and with occlusion. */
static void try_looks(struct bench *b) {
    static const struct gn_environment environment;
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_PCF, GN_TECHNIQUE_CONE};
    struct stage s;
    stage_open(b, &s, GN_GPU_LOOK);
    for (int i = 0; i < 6; i++) {
        const bool reflected_only = i / 2 == 1;
        struct gn_frame_opts opts = opts_of(techniques[i % 2], GN_ENCODING_AUTO);
        opts.shadow.cascades = 1; /* a model's light has no more */
        opts.occlusion.on = i / 2 == 2;
        opts.tone = reflected_only ? GN_TONE_NONE : GN_TONE_NEUTRAL;
        opts.environment = (struct gn_frame_environment_opts){
            .of = &environment,
            .id = 2,
            .reflected_only = reflected_only,
            .show = reflected_only ? GN_ENVIRONMENT_SHOW_NO : GN_ENVIRONMENT_SHOW_BLUR,
            .strength = 1};
        draw(b, &s, &opts, EVERYTHING, "a look");
    }
    stage_close(&s);
}

/* Vertices that follow joints, and that targets move: of things and of what casts, into planar
 * masks, too. Cone maps of what moves have larger blocks, by the size of the map. */
static void try_posed(struct bench *b) {
    struct stage s;
    struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF, GN_ENCODING_AUTO);
    stage_open(b, &s, GN_GPU_POSED);
    draw(b, &s, &opts, EVERYTHING, "skins and targets");
    opts.shadow.planar_points = 64, opts.shadow.cascades = 1; /* more have the usual blocks */
    for (uint32_t px = 512; px <= 2048; px *= 2) {
        opts.shadow.any.map_px = px;
        opts.shadow.any.technique = px > 512 ? GN_TECHNIQUE_CONE : GN_TECHNIQUE_PLANAR;
        draw(b, &s, &opts, ALL_BUT_LIT, "shadows of what moves");
    }
    stage_close(&s);
}

/* ---- all of it ----------------------------------------------------------------------------- */

/* That nothing was left out without anybody noticing. */
static void check_cover(struct bench *b) {
    const uint32_t looks = b->looks ? 0 : 1u << GN_PROGRAM_BACKDROP | 1u << GN_PROGRAM_FLOOR;
    for (uint32_t kind = 0; kind < GN_PROGRAM_KIND_COUNT; kind++)
        if (!((b->kinds | looks) >> kind & 1)) {
            char name[200];
            gn_gl_key_text(&(struct gn_program_key){.kind = (uint8_t)kind}, name, sizeof name);
            fail(b, name, "no plan had a program of this kind");
        }
    for (uint32_t kind = GN_TARGET_OUTPUT; kind <= GN_TARGET_PAGES; kind++)
        if (!(b->targets >> kind & 1)) fail(b, "targets", "no plan had one of some kind");
    for (uint32_t kind = GN_OUTPUT_SRGB8; kind <= GN_OUTPUT_AOV; kind++)
        if (!(b->outputs >> kind & 1)) fail(b, "pictures", "no plan had one of some format");
    if (b->listener.incomplete) fail(b, "framebuffers", "the driver calls some incomplete");
    if (b->listener.errors && !b->failures) fail(b, "errors", "the driver complained");
}

static bool open_bench(struct bench *b, const char *shaders) {
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    if (!gn_display_open(&b->display, "egl", NULL, &err)) return fail(b, "EGL", err.text);
    const struct gn_gl_opts opts = {.get_proc = gn_display_get_proc,
                                    .display = &b->display,
                                    .shaders = shaders,
                                    .prove_later = true,
                                    .debug = true};
    b->gl = gn_gl_create(&opts, &warnings, &err);
    if (!b->gl) return fail(b, "OpenGL ES", err.text);
    const struct gn_caps *caps = gn_gl_caps(b->gl);
    printf("GPU\t%s\t%s\n", caps->renderer, caps->version);
    b->gl->probed = UINT32_MAX; /* nothing is executed, so nothing can be proved */
    if (!(caps->has >> GN_CAP_DEBUG & 1)) return fail(b, "OpenGL ES", "it has no GL_KHR_debug");
    gn_cost_listen(&b->listener, b->gl);
    return true;
}

static const char *read_arguments(struct bench *b, int argc, char **argv) {
    const char *shaders = NULL;
    for (int i = 1; i < argc; i++) {
        const bool more = i + 1 < argc;
        b->full |= strcmp(argv[i], "--full") == 0;
        b->only_looks |= strcmp(argv[i], "--only-looks") == 0; /* for who works on them */
        b->only_posed |= strcmp(argv[i], "--only-posed") == 0;
        b->looks |= b->only_looks || strcmp(argv[i], "--looks") == 0;
        if (more && strcmp(argv[i], "--known") == 0) b->known = argv[i + 1];
        if (more && strcmp(argv[i], "--turn") == 0) b->turn = atoi(argv[i + 1]);
        if (more && strcmp(argv[i], "--shaders") == 0) shaders = argv[i + 1];
    }
    return shaders;
}

int main(int argc, char **argv) {
    static struct bench b;
    const char *shaders = read_arguments(&b, argc, argv);
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (!open_bench(&b, shaders)) return 2;
    if (b.looks) try_looks(&b);
    if (!b.only_looks) try_posed(&b);
    const bool all = !b.only_looks && !b.only_posed;
    for (int which = GN_GPU_SUN; which <= GN_GPU_SPOT && all; which++) {
        try_techniques(&b, (enum gn_gpu_scene)which);
        try_maps(&b, (enum gn_gpu_scene)which);
    }
    if (all) {
        try_slides(&b);
        try_pictures(&b);
        check_cover(&b);
    }
    printf("DONE\t%u programs, %u of them compiled, %u plans, %u framebuffers, %u incomplete, %u "
           "errors, %u failures\n",
           b.seen.count, b.compiled, b.plans, b.listener.framebuffers, b.listener.incomplete,
           b.listener.errors, b.failures);
    fflush(NULL);
    _Exit(b.failures > 0); /* no driver here is tested for how it ends */
}
