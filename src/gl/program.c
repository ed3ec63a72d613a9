/* Programs: one per key, in a hash table, made in prepare. After linking no string is used. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "gl/private.h"

const char gn_gl_whole_vertex[] = "#version 300 es\n"
                                  "void main() {\n"
                                  "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, "
                                  "gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
                                  "}\n";

struct sources { /* of one program, and the stage that failed */
    struct gn_gl_text stage[2];
    int failed;    /* enum gn_gl_shader; 2: linking */
    bool composed; /* both stages: a failure is the driver's */
};

static const char *const stage_names[] = {"vertex", "fragment", "link"};

/* Fails with the log's first line that contains "error", else with its first line. */
static bool fail_log(const char *log, const char *stage, struct gn_err *err) {
    const char *line = strcasestr(log, "error");
    while (line && line > log && line[-1] != '\n') line--;
    if (!line) line = log;
    while (isspace((unsigned char)*line)) line++;
    return gn_fail(err, "%s: %.*s", stage, (int)strcspn(line, "\n"),
                   *line ? line : "the driver gave no reason");
}

/* 0 on failure; *failed says at which stage. */
static GLuint build_program(struct gn_gl *gl, const char *const sources[2], int *failed,
                            struct gn_err *err) {
    GLuint program = GL(gl, CreateProgram)();
    gl->objects_created++;
    gl->programs.made++;
    GLuint shaders[2]; /* attached, they live on until they are detached */
    char log[2048] = "";
    GLint ok = 0;
    for (*failed = 0; *failed < 2; ++*failed) {
        GLuint shader = shaders[*failed] =
            GL(gl, CreateShader)(*failed == GN_GL_VERTEX ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        GL(gl, ShaderSource)(shader, 1, &sources[*failed], NULL);
        GL(gl, CompileShader)(shader);
        GL(gl, GetShaderiv)(shader, GL_COMPILE_STATUS, &ok);
        if (ok)
            GL(gl, AttachShader)(program, shader);
        else
            GL(gl, GetShaderInfoLog)(shader, sizeof log, NULL, log);
        GL(gl, DeleteShader)(shader);
        if (ok) continue;
        fail_log(log, stage_names[*failed], err);
        goto fail;
    }
    ok = 0;
    GL(gl, LinkProgram)(program);
    GL(gl, GetProgramiv)(program, GL_LINK_STATUS, &ok);
    if (ok) {
        /* a program never links again: what the stages were compiled into is freed */
        for (int i = 0; i < 2; i++) GL(gl, DetachShader)(program, shaders[i]);
        return program;
    }
    GL(gl, GetProgramInfoLog)(program, sizeof log, NULL, log);
    fail_log(log, stage_names[2], err);
fail:
    GL(gl, DeleteProgram)(program);
    return 0;
}

GLuint gn_gl_program_link(struct gn_gl *gl, const char *vertex, const char *fragment,
                          struct gn_err *err) {
    int failed;
    return build_program(gl, (const char *const[]){vertex, fragment}, &failed, err);
}

static GLuint compose_and_build(struct gn_gl *gl, const struct gn_program_key *key,
                                struct sources *sources, struct gn_err *err) {
    for (int i = 0; i < 2; i++) {
        sources->failed = i;
        if (!gn_gl_compose(gl->shaders, key, i, &sources->stage[i], err)) return 0;
    }
    sources->composed = true;
    const char *const text[2] = {sources->stage[0].data, sources->stage[1].data};
    GLuint program = build_program(gl, text, &sources->failed, err);
    if (program) return program;
    char name[200];
    gn_gl_key_text(key, name, sizeof name);
    gn_fail_prefix(err, "shader program (%s)", name);
    return 0;
}

static void sources_finish(struct sources *sources) {
    for (int i = 0; i < 2; i++) gn_gl_text_finish(&sources->stage[i]);
}

/* Of a failed link the fragment stage is shown: it is nearly always the one over a limit. */
static char *sources_log(const struct sources *sources) {
    return gn_gl_text_numbered(&sources->stage[sources->failed == 0 ? 0 : 1]);
}

static uint32_t active_attributes(struct gn_gl *gl, GLuint program) {
    uint32_t mask = 0;
    GLint count = 0;
    GL(gl, GetProgramiv)(program, GL_ACTIVE_ATTRIBUTES, &count);
    for (GLint i = 0; i < count; i++) {
        char name[64];
        GLint size;
        GLenum type;
        GL(gl, GetActiveAttrib)(program, (GLuint)i, sizeof name, NULL, &size, &type, name);
        GLint location = GL(gl, GetAttribLocation)(program, name);
        if (location >= 0 && location < GN_GL_LOCATION_COUNT) mask |= 1u << location;
    }
    return mask;
}

static bool set_unit(struct gn_gl *gl, GLuint program, const char *sampler, int unit) {
    GLint location = GL(gl, GetUniformLocation)(program, sampler);
    if (location >= 0) GL(gl, Uniform1i)(location, unit);
    return location >= 0;
}

static void set_units(struct gn_gl *gl, struct gn_gl_program *program) {
    static const char *const textures[GN_TEXTURE_SLOT_COUNT] = {
#define GN_X(NAME, name, ...) [GN_TEXTURE_##NAME] = "u_texture_" #name,
        GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
    };
    static const char *const maps[GN_SHADOWS_MAX] = {"u_map_0", "u_map_1", "u_map_2", "u_map_3"};
    static const char *const filtered[GN_SHADOWS_MAX] = {"u_filtered_0", "u_filtered_1",
                                                         "u_filtered_2", "u_filtered_3"};
    static const char *const slides[GN_SLIDES_MAX] = {"u_slide_0", "u_slide_1", "u_slide_2",
                                                      "u_slide_3"};
    gn_gl_use_program(gl, program->name);
    for (int i = 0; i < GN_SHADOWS_MAX; i++) {
        set_unit(gl, program->name, maps[i], GN_GL_UNIT_MAP + i);
        set_unit(gl, program->name, filtered[i], GN_GL_UNIT_FILTERED + i);
    }
    for (int i = 0; i < GN_SLIDES_MAX; i++)
        set_unit(gl, program->name, slides[i], GN_GL_UNIT_SLIDE + i);
    set_unit(gl, program->name, "u_environment", GN_GL_UNIT_ENVIRONMENT);
    set_unit(gl, program->name, "u_occlusion", GN_GL_UNIT_OCCLUSION);
    set_unit(gl, program->name, "u_pose", GN_GL_UNIT_POSE);
    set_unit(gl, program->name, "u_deltas", GN_GL_UNIT_DELTAS);
    for (int i = 0; i < GN_TEXTURE_SLOT_COUNT; i++)
        if (set_unit(gl, program->name, textures[i], GN_GL_UNIT_TEXTURE + i))
            program->texture_slots |= 1u << i;
}

static struct gn_gl_program *program_place(struct gn_gl_programs *programs,
                                           const struct gn_program_key *key) {
    uint32_t i = (uint32_t)gn_hash(GN_HASH_INIT, key, sizeof *key);
    for (;; i++) {
        struct gn_gl_program *p = &programs->table[i & (programs->room - 1)];
        if ((!p->name && !p->dropped) || memcmp(&p->key, key, sizeof *key) == 0) return p;
    }
}

struct gn_gl_program *gn_gl_program_find(struct gn_gl *gl, const struct gn_program_key *key) {
    if (!gl->programs.room) return NULL;
    struct gn_gl_program *p = program_place(&gl->programs, key);
    return p->name ? p : NULL;
}

bool gn_gl_program_is_dropped(struct gn_gl *gl, const struct gn_program_key *key) {
    return gl->programs.room && program_place(&gl->programs, key)->dropped;
}

/* What is known of a program that was just linked. */
static struct gn_gl_program program_of(struct gn_gl *gl, const struct gn_program_key *key,
                                       GLuint name) {
    struct gn_gl_program p = {
        .key = *key, .name = name, .made = gl->programs.made, .set = UINT32_MAX};
    p.u_pass = GL(gl, GetUniformLocation)(name, "u_pass");
    p.u_uv = GL(gl, GetUniformLocation)(name, "u_uv");
    p.u_factors = GL(gl, GetUniformLocation)(name, "u_factors");
    p.attributes = active_attributes(gl, name);
    set_units(gl, &p);
    return p;
}

bool gn_gl_program_ensure(struct gn_gl *gl, const struct gn_program_key *key, struct gn_err *err) {
    if (gn_gl_program_find(gl, key)) return true;
    struct gn_gl_programs *programs = &gl->programs;
    if (2 * (programs->count + 1) > programs->room) {
        struct gn_gl_programs more = *programs;
        more.room = programs->room ? 2 * programs->room : 32;
        more.table = gn_xalloc(more.room, sizeof *more.table);
        for (uint32_t i = 0; i < programs->room; i++)
            if (programs->table[i].name || programs->table[i].dropped)
                *program_place(&more, &programs->table[i].key) = programs->table[i];
        free(programs->table);
        *programs = more;
    }
    struct sources sources = {0};
    GLuint name = compose_and_build(gl, key, &sources, err);
    if (name) {
        const struct gn_gl_program p = program_of(gl, key, name);
        struct gn_gl_program *place = program_place(programs, key);
        programs->count += !place->dropped;
        *place = p;
    } else if (sources.composed) {
        free(gl->debug.failed_source);
        gl->debug.failed_source = gl->debug.on ? sources_log(&sources) : NULL;
        if (!gl->debug.on && err) {
            const struct gn_err said = *err;
            gn_fail(err, "%.440s (-v prints the source)", said.text);
        }
    }
    sources_finish(&sources);
    return name;
}

static bool renew_program(struct gn_gl *gl, struct gn_gl_program *place, struct gn_err *err) {
    struct sources sources = {0};
    const GLuint name = compose_and_build(gl, &place->key, &sources, err);
    sources_finish(&sources);
    if (!name) return false;
    struct gn_gl_program p = program_of(gl, &place->key, name);
    if (!gn_gl_vertices_ensure(gl, p.attributes, err)) {
        gn_gl_use_program(gl, place->name);
        GL(gl, DeleteProgram)(name);
        return false;
    }
    p.kept = place->kept;
    p.used = place->used;
    p.bytes = place->bytes;
    GL(gl, DeleteProgram)(place->name);
    *place = p;
    return true;
}

bool gn_gl_renew_programs(struct gn_gl *gl, struct gn_err *err) {
    bool ok = true;
    for (uint32_t i = 0; i < gl->programs.room; i++)
        if (gl->programs.table[i].name)
            ok &= renew_program(gl, &gl->programs.table[i], ok ? err : NULL);
    gn_gl_targets_forget(gl);
    return ok;
}

/* ---- those that are needed, and idle ones ---- */

void gn_gl_keep_programs(struct gn_gl *gl, const struct gn_plan *plan) {
    for (uint32_t i = 0; i < gl->programs.room; i++) gl->programs.table[i].kept = false;
    for (uint32_t i = 0; i < plan->program_count; i++) {
        struct gn_gl_program *p = gn_gl_program_find(gl, &plan->programs[i]);
        if (p) p->kept = true;
    }
}

bool gn_gl_has_programs(struct gn_gl *gl, const struct gn_plan *plan) {
    uint32_t i = 0;
    while (i < plan->program_count && gn_gl_program_find(gl, &plan->programs[i])) i++;
    return i == plan->program_count;
}

/* What others free meanwhile, for programs dropped before, hides a part of what this one takes: so
 * none counts as less than they do on average. */
void gn_gl_program_took(struct gn_gl *gl, struct gn_gl_program *program, uint64_t bytes) {
    struct gn_gl_programs *programs = &gl->programs;
    programs->measured += program->bytes == 0;
    programs->measured_bytes += bytes;
    program->bytes += bytes;
}

struct gn_gl_idle gn_gl_idle_programs(const struct gn_gl *gl) {
    const struct gn_gl_programs *programs = &gl->programs;
    const uint64_t mean = programs->measured ? programs->measured_bytes / programs->measured : 0;
    struct gn_gl_idle idle = {0};
    for (uint32_t i = 0; i < programs->room; i++) {
        const struct gn_gl_program *p = &programs->table[i];
        if (!p->name || p->kept) continue;
        const uint64_t bytes = p->bytes > mean ? p->bytes : mean;
        idle.bytes += bytes;
        idle.ahead_bytes += p->used == 0 ? bytes : 0;
    }
    return idle;
}

/* Of idle programs, a is to be dropped before b. */
static bool goes_first(const struct gn_gl_program *a, const struct gn_gl_program *b) {
    return a->used != b->used ? a->used < b->used : a->made < b->made;
}

/* The one to be dropped first. Not the current one: llvmpipe frees a program that is bound when it
 * is deleted only after another one was deleted. */
static struct gn_gl_program *first_idle(struct gn_gl *gl) {
    struct gn_gl_program *first = NULL;
    for (uint32_t i = 0; i < gl->programs.room; i++) {
        struct gn_gl_program *p = &gl->programs.table[i];
        if (p->name && !p->kept && p->name != gl->state.program && (!first || goes_first(p, first)))
            first = p;
    }
    return first;
}

bool gn_gl_drop_programs(struct gn_gl *gl, const struct gn_gl_idle *most) {
    bool drops = false;
    for (;;) {
        const struct gn_gl_idle now = gn_gl_idle_programs(gl);
        struct gn_gl_program *p = first_idle(gl);
        if (!p || (now.bytes <= most->bytes && now.ahead_bytes <= most->ahead_bytes)) break;
        GL(gl, DeleteProgram)(p->name);
        p->name = 0;
        p->dropped = drops = true;
    }
    if (drops) GL(gl, Flush)(); /* draws that wait hold what they draw with */
    return drops;
}

void gn_gl_programs_finish(struct gn_gl *gl) {
    for (uint32_t i = 0; i < gl->programs.room; i++)
        if (gl->programs.table[i].name) GL(gl, DeleteProgram)(gl->programs.table[i].name);
    free(gl->programs.table);
    gl->programs = (struct gn_gl_programs){0};
}

bool gn_gl_try_program(struct gn_gl *gl, const struct gn_program_key *key, char **log,
                       struct gn_err *err) {
    struct sources sources = {0};
    GLuint name = compose_and_build(gl, key, &sources, err);
    if (name)
        GL(gl, DeleteProgram)(name);
    else if (log)
        *log = sources_log(&sources);
    sources_finish(&sources);
    return name;
}
