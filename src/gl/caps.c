/* What this GPU is and can do. Extension names are compared whole; what a draw can prove is proved
 * (probe.c). */
#include <stdio.h>
#include <string.h>

#include "gl/private.h"

static bool has_extension(struct gn_gl *gl, const char *name) {
    GLint count = 0;
    GL(gl, GetIntegerv)(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++) {
        const GLubyte *extension = GL(gl, GetStringi)(GL_EXTENSIONS, (GLuint)i);
        if (extension && strcmp((const char *)extension, name) == 0) return true;
    }
    return false;
}

bool gn_gl_version_check(const struct gn_gl_opts *opts, struct gn_err *err) {
    static const char es[] = "OpenGL ES ";
    PFNGLGETSTRINGPROC get = (PFNGLGETSTRINGPROC)opts->get_proc(opts->display, "glGetString");
    const char *version = get ? (const char *)get(GL_VERSION) : NULL;
    if (!version) return gn_fail(err, "no OpenGL ES context");
    const char *number =
        strncmp(version, es, sizeof es - 1) == 0 ? version + sizeof es - 1 : version;
    int major = 0, minor = 0;
    sscanf(number, "%d.%d", &major, &minor);
    if (major >= 3) return true;
    return gn_fail(
        err,
        "%s has only OpenGL ES %d.%d; gnomon needs 3.0 (Pi 4/5, Mali T760+, Adreno 3xx+, "
        "llvmpipe)",
        (const char *)get(GL_RENDERER), major, minor);
}

static void copy_string(struct gn_gl *gl, GLenum what, char *out, size_t size) {
    const GLubyte *text = GL(gl, GetString)(what);
    snprintf(out, size, "%s", text ? (const char *)text : "unknown");
}

bool gn_gl_is_software(const char *renderer) {
    return strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe") ||
           strstr(renderer, "swrast") || strstr(renderer, "Software Rasterizer") ||
           strstr(renderer, "SwiftShader");
}

/* ---- proof ---- */

/* These fit into one draw, which costs hardly more than one of them alone: when one is tested, all
 * are. */
static const uint32_t together =
    1u << GN_CAP_R16F | 1u << GN_CAP_R32UI | 1u << GN_CAP_SRGB | 1u << GN_CAP_DEPTH_COMPARE;

/* False when one fails, of these or of those tested with them; what fails leaves gl->caps. */
static bool prove_caps(struct gn_gl *gl, uint32_t caps) {
    const uint32_t open = gl->caps.has & ~gl->probed;
    if (!(caps & open)) return true;
    const uint32_t wanted = open & (caps | (caps & open & together ? together : 0));
    const uint32_t failed = wanted & ~gn_gl_probe(gl, wanted);
    gl->probed |= wanted;
    gl->caps.has &= ~failed;
    for (int i = 0; i < GN_CAP_COUNT; i++)
        if (failed >> i & 1)
            gn_warn(gl->warnings, "this GPU claims %s but a test draw failed; not using it",
                    gn_cap_names[i]);
    return !failed;
}

bool gn_gl_prove(struct gn_gl *gl, const struct gn_plan *plan) {
    static const uint32_t by_encoding[GN_ENCODING_ALL] = {
        [GN_ENCODING_DEPTH] = 1u << GN_CAP_DEPTH_COMPARE,
        [GN_ENCODING_DEPTH16] = 1u << GN_CAP_DEPTH_COMPARE,
        [GN_ENCODING_R32UI] = 1u << GN_CAP_R32UI,
        [GN_ENCODING_R16F] = 1u << GN_CAP_R16F,
        [GN_ENCODING_R16F_RAW] = 1u << GN_CAP_R16F,
    };
    uint32_t caps = plan->msaa > 1 ? 1u << GN_CAP_MSAA4 : 0;
    if (plan->output == GN_OUTPUT_SRGB8) caps |= 1u << GN_CAP_SRGB;
    if (plan->output == GN_OUTPUT_FLOAT) caps |= 1u << GN_CAP_RGBA16F;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_target *target = &plan->passes[i].target;
        if (target->kind == GN_TARGET_SHADOW) caps |= by_encoding[target->encoding];
        if (target->kind == GN_TARGET_MOMENTS)
            caps |= (1u << gn_cap_of_moments(target->moments)) & ((1u << GN_CAP_COUNT) - 1);
    }
    return prove_caps(gl, caps);
}

/* ---- all of it ---- */

bool gn_gl_caps_learn(struct gn_gl *gl, const struct gn_gl_opts *opts, struct gn_err *err) {
    struct gn_caps *caps = &gl->caps;
    const uint32_t asked_only = 1u << GN_CAP_TIMER | 1u << GN_CAP_DEBUG;
    uint32_t without;
    if (!gn_caps_parse(opts->without, &without, err)) return false;
    copy_string(gl, GL_VENDOR, caps->vendor, sizeof caps->vendor);
    copy_string(gl, GL_RENDERER, caps->renderer, sizeof caps->renderer);
    copy_string(gl, GL_VERSION, caps->version, sizeof caps->version);
    caps->software = gn_gl_is_software(caps->renderer);
    caps->etc2 = strncmp(caps->version, "OpenGL ES ", 10) == 0 ||
                 has_extension(gl, "GL_ARB_ES3_compatibility");
    GL(gl, GetIntegerv)(GL_MAX_TEXTURE_SIZE, &caps->max_texture_px);
    GL(gl, GetIntegerv)(GL_MAX_TEXTURE_IMAGE_UNITS, &caps->max_texture_units);
    GLint timer_bits = 0;
    if (gl->fn.GetQueryiv && (gl->desktop || has_extension(gl, "GL_EXT_disjoint_timer_query")))
        GL(gl, GetQueryiv)(GL_TIME_ELAPSED_EXT, GL_QUERY_COUNTER_BITS_EXT, &timer_bits);
    if (timer_bits > 0) caps->has |= 1u << GN_CAP_TIMER;
    if (gl->fn.PushDebugGroup && gl->fn.PopDebugGroup && gl->fn.DebugMessageCallback &&
        has_extension(gl, "GL_KHR_debug"))
        caps->has |= 1u << GN_CAP_DEBUG;
    gl->robust = gl->fn.GetGraphicsResetStatus && has_extension(gl, "GL_KHR_robustness");
    caps->has |= gn_gl_probe_claims(gl);
    caps->has &= ~without;
    gl->probed = asked_only;
    if (!opts->prove_later) prove_caps(gl, caps->has);
    return gn_gl_error_check(gl, "learning what the GPU can do", err);
}
