#include "gpus/cost.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"

/* The drivers' words for a stage, and ours. Vertex shaders are compiled twice: once for where
 * triangles lie, for the sorting into tiles, and once for the rest. */
static const char *const words[][2] = {
    {"FRAG", "fragment"}, {"VERT", "vertex"}, {"BVERT", "binning"}, {"VERTEX_BIN", "binning"}};

static void name_stage(const char *line, char *out, size_t size) {
    static const char prefix[] = "MESA_SHADER_";
    if (strncmp(line, prefix, sizeof prefix - 1) == 0) line += sizeof prefix - 1;
    snprintf(out, size, "%.*s", (int)strcspn(line, " "), line);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(out, words[i][0]) == 0) snprintf(out, size, "%s", words[i][1]);
    for (char *c = out; *c; c++) *c = (char)tolower((unsigned char)*c);
}

/* The number before " what"; 0 if there is none. */
static unsigned number_before(const char *line, const char *what) {
    const char *at = strstr(line, what);
    if (!at) return 0;
    while (at > line && isdigit((unsigned char)at[-1])) at--;
    unsigned number = 0;
    sscanf(at, "%u", &number);
    return number;
}

static unsigned spills_of(const char *line) {
    unsigned spills = 0, fills = 0;
    const char *at = strstr(line, " spills:fills");
    while (at && at > line && at[-1] != ' ') at--;
    if (at && sscanf(at, "%u:%u", &spills, &fills) == 2) return spills + fills;
    return number_before(line, " stp") + number_before(line, " ldp");
}

/* Of texels, by a wave of the smallest kind. Mali's compilers say for how many clocks a large
 * core's texture units are busy, which take so many at once; the others' say nothing. */
static int fetches_of(const char *line) {
    static const struct {
        const char *what;
        float per_clock;
    } words[] = {{" texture,", 2}, {" t,", 4}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const char *at = strstr(line, words[i].what);
        while (at && at > line && at[-1] != ' ') at--;
        if (at) return (int)(words[i].per_clock * strtof(at, NULL) + 0.5f);
    }
    return GN_COST_UNKNOWN;
}

bool gn_cost_read(struct gn_cost *cost, const char *line) {
    struct gn_cost_stage stage;
    const char *colon = strstr(line, " shader: ");
    if (!colon || !strstr(colon, " inst")) return false;
    name_stage(line, stage.name, sizeof stage.name);
    stage.instructions = number_before(colon, " inst");
    stage.spills = spills_of(colon);
    stage.fetches = fetches_of(colon);
    int i = 0;
    while (i < cost->count && strcmp(cost->stages[i].name, stage.name) != 0) i++;
    if (i == GN_COST_STAGES) return false;
    cost->stages[i] = stage;
    if (i == cost->count) cost->count++;
    return true;
}

bool gn_cost_is_whole(const struct gn_cost *cost) {
    bool fragment = false, vertex = false;
    for (int i = 0; i < cost->count; i++) {
        if (strcmp(cost->stages[i].name, "fragment") == 0)
            fragment = true;
        else
            vertex = true;
    }
    return fragment && vertex;
}

static void GL_APIENTRY hear(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                             const GLchar *message, const void *user) {
    struct gn_listener *l = (struct gn_listener *)user;
    (void)id, (void)severity, (void)length;
    if (type == GL_DEBUG_TYPE_ERROR_KHR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR_KHR) {
        l->errors++;
        if (!l->gl->debug.text[0])
            snprintf(l->gl->debug.text, sizeof l->gl->debug.text, "%s", message);
    } else if (l->into && source == GL_DEBUG_SOURCE_SHADER_COMPILER_KHR)
        gn_cost_read(l->into, message);
}

static struct gn_listener *asked; /* the driver's functions take no pointer of ours */
static PFNGLCHECKFRAMEBUFFERSTATUSPROC check_status;

static GLenum GL_APIENTRY count_framebuffer(GLenum target) {
    const GLenum status = check_status(target);
    asked->framebuffers++;
    asked->incomplete += status != GL_FRAMEBUFFER_COMPLETE;
    return status;
}

void gn_cost_listen(struct gn_listener *listener, struct gn_gl *gl) {
    listener->gl = gl;
    GL(gl, Enable)(GL_DEBUG_OUTPUT_KHR);
    GL(gl, Enable)(GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR);
    GL(gl, DebugMessageCallback)(hear, listener);
    asked = listener;
    check_status = gl->fn.CheckFramebufferStatus;
    gl->fn.CheckFramebufferStatus = count_framebuffer;
}

void gn_cost_forget_programs(struct gn_gl *gl) {
    gn_gl_use_program(gl, 0);
    gn_gl_programs_finish(gl);
}

/* A compiler that has compiled an equal stage for a program that is still there tells of it only
 * once: so no other is. */
bool gn_cost_compile(struct gn_listener *listener, const struct gn_plan *plan, uint32_t index,
                     const char *name, struct gn_cost *cost, struct gn_err *err) {
    struct gn_gl *gl = listener->gl;
    *cost = (struct gn_cost){0};
    gn_cost_forget_programs(gl);
    listener->into = cost;
    const bool ok = gn_gl_program_prepare(gl, &plan->programs[index], err) &&
                    gn_gl_touch(gl, plan, index, err) && gn_gl_error_check(gl, name, err);
    listener->into = NULL;
    return ok &&
           (gn_cost_is_whole(cost) || gn_fail(err, "the driver has not compiled both stages"));
}

bool gn_cost_hash(const struct gn_gl *gl, const struct gn_plan *plan,
                  const struct gn_program_key *key, const char *name, uint64_t *out) {
    *out = gn_hash(GN_HASH_INIT, name, strlen(name));
    *out = gn_hash(*out, &plan->output, sizeof plan->output);
    *out = gn_hash(*out, &plan->msaa, sizeof plan->msaa);
    for (int shader = GN_GL_VERTEX; shader <= GN_GL_FRAGMENT; shader++) {
        struct gn_gl_text text = {0};
        const bool ok = gn_gl_compose(gl->shaders, key, (enum gn_gl_shader)shader, &text, NULL);
        if (ok) *out = gn_hash(*out, text.data, text.size);
        gn_gl_text_finish(&text);
        if (!ok) return false;
    }
    return true;
}

bool gn_cost_find(const char *path, uint64_t hash, struct gn_cost *cost) {
    FILE *file = path ? fopen(path, "r") : NULL;
    char line[400];
    unsigned long long known;
    while (file && cost->count < GN_COST_STAGES && fgets(line, sizeof line, file)) {
        struct gn_cost_stage *stage = &cost->stages[cost->count];
        cost->count += sscanf(line, "%llx %u %u %d %15s", &known, &stage->instructions,
                              &stage->spills, &stage->fetches, stage->name) == 5 &&
                       known == hash;
    }
    if (file) fclose(file);
    return gn_cost_is_whole(cost);
}

bool gn_keys_have(const struct gn_keys *keys, const struct gn_program_key *key) {
    for (uint32_t i = 0; i < keys->count; i++)
        if (memcmp(&keys->at[i], key, sizeof *key) == 0) return true;
    return false;
}

void gn_keys_add(struct gn_keys *keys, const struct gn_program_key *key) {
    if (keys->count == keys->room) {
        keys->room = keys->room ? 2 * keys->room : 64;
        keys->at = gn_xrealloc(keys->at, keys->room, sizeof *keys->at);
    }
    keys->at[keys->count++] = *key;
}
