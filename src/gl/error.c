/* Errors of the driver, by GetError and, in debug, by messages of KHR_debug. */
#include <stdio.h>

#include "gl/private.h"

static void GL_APIENTRY keep_debug_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                           GLsizei length, const GLchar *message,
                                           const void *user) {
    (void)source, (void)id, (void)severity, (void)length;
    struct gn_gl *gl = (struct gn_gl *)user;
    if (type != GL_DEBUG_TYPE_ERROR_KHR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR_KHR) return;
    if (!gl->debug.text[0]) snprintf(gl->debug.text, sizeof gl->debug.text, "%s", message);
}

void gn_gl_debug_start(struct gn_gl *gl) {
    if (!(gl->caps.has & 1u << GN_CAP_DEBUG)) return;
    GL(gl, Enable)(GL_DEBUG_OUTPUT_KHR);
    GL(gl, Enable)(GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR);
    GL(gl, DebugMessageCallback)(keep_debug_message, gl);
}

static const char *error_name(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM: return "invalid enum";
    case GL_INVALID_VALUE: return "invalid value";
    case GL_INVALID_OPERATION: return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY: return "out of GPU memory";
    default: return "unknown GL error";
    }
}

void gn_gl_error_keep(struct gn_gl *gl) {
    GLenum error = GL(gl, GetError)();
    if (error != GL_NO_ERROR && !gl->debug.text[0])
        snprintf(gl->debug.text, sizeof gl->debug.text, "%s", error_name(error));
}

bool gn_gl_error_check(struct gn_gl *gl, const char *what, struct gn_err *err) {
    GLenum error = GL(gl, GetError)();
    if (error == GL_NO_ERROR && !gl->debug.text[0]) return true;
    gn_fail(err, "%s: %s", what, gl->debug.text[0] ? gl->debug.text : error_name(error));
    gl->debug.text[0] = 0;
    for (int i = 0; error != GL_NO_ERROR && i < 8; i++) error = GL(gl, GetError)();
    return false;
}
