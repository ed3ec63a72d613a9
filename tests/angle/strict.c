/* libEGL.so.1, and libGLESv2.so.2, for the tests on strict OpenGL ES 3.0: what ANGLE's libEGL.so
 * gives, with which it is linked, but for two functions.
 *
 * eglGetProcAddress and eglCreateContext ask for what only ANGLE's own attributes can ask for: the
 * display that draws by Vulkan on SwiftShader, and a context that is ES 3.0, not the latest that
 * there is, with extensions off. An attribute that ANGLE does not know makes it fail, so nothing
 * else passes for strict. The values are those of the registries of EGL_ANGLE_platform_angle,
 * _platform_angle_vulkan, _platform_angle_device_type_swiftshader,
 * _create_context_backwards_compatible and _create_context_extensions_enabled.
 *
 * Some thirty extensions cannot be switched off (GL_KHR_debug, GL_KHR_robustness, what ES 3.0 has
 * anyway). Those are hidden: the list is empty, and functions with an extension's suffix are not
 * there. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

enum {
    PLATFORM_ANGLE = 0x3202,
    PLATFORM_TYPE = 0x3203,
    TYPE_VULKAN = 0x3450,
    DEVICE_TYPE = 0x3209,
    DEVICE_SWIFTSHADER = 0x3487,
    NATIVE_PLATFORM = 0x348F,
    BACKWARDS_COMPATIBLE = 0x3483,
    EXTENSIONS_ENABLED = 0x345F,
};

typedef __eglMustCastToProperFunctionPointerType gn_proc;

static void *angle_symbol(const char *name) {
    void *library = dlopen("libEGL.so", RTLD_NOW | RTLD_NOLOAD);
    void *function = library ? dlsym(library, name) : NULL;
    if (!function) abort(); /* it is linked with us, so it is there */
    return function;
}

static gn_proc angle_proc(const char *name) {
    PFNEGLGETPROCADDRESSPROC find;
    *(void **)&find = angle_symbol("eglGetProcAddress");
    return find(name);
}

/* The platform that is asked for says where pictures are to appear. */
static EGLDisplay get_platform_display(EGLenum platform, void *native, const EGLint *attributes) {
    const EGLint swiftshader[] = {
        PLATFORM_TYPE,   TYPE_VULKAN,      DEVICE_TYPE, DEVICE_SWIFTSHADER,
        NATIVE_PLATFORM, (EGLint)platform, EGL_NONE};
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)angle_proc("eglGetPlatformDisplayEXT");
    return get && !attributes ? get(PLATFORM_ANGLE, native, swiftshader) : EGL_NO_DISPLAY;
}

EGLAPI EGLContext EGLAPIENTRY eglCreateContext(EGLDisplay display, EGLConfig config,
                                               EGLContext shared, const EGLint *attributes) {
    static const EGLint strict[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    0,
                                    BACKWARDS_COMPATIBLE,
                                    EGL_FALSE,
                                    EXTENSIONS_ENABLED,
                                    EGL_FALSE,
                                    EGL_NONE};
    PFNEGLCREATECONTEXTPROC create;
    *(void **)&create = angle_symbol("eglCreateContext");
    (void)attributes; /* they name a version, and it is this one that is tested */
    return create(display, config, shared, strict);
}

/* ---- no extensions ---- */

static void GL_APIENTRY get_integer(GLenum what, GLint *out) {
    PFNGLGETINTEGERVPROC get = (PFNGLGETINTEGERVPROC)angle_proc("glGetIntegerv");
    if (what == GL_NUM_EXTENSIONS)
        *out = 0;
    else
        get(what, out);
}

static const GLubyte *GL_APIENTRY get_string(GLenum what) {
    PFNGLGETSTRINGPROC get = (PFNGLGETSTRINGPROC)angle_proc("glGetString");
    return what == GL_EXTENSIONS ? (const GLubyte *)"" : get(what);
}

/* Core functions end in a small letter, "1D" to "3D", or a type: "v", "i", "f". */
static int is_extension(const char *name) {
    static const char *const suffixes[] = {"AMD", "ANGLE", "APPLE", "ARM", "CHROMIUM",
                                           "EXT", "KHR",   "NV",    "OES", "OVR"};
    const size_t length = strlen(name);
    for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++) {
        const size_t n = strlen(suffixes[i]);
        if (length > n && strcmp(name + length - n, suffixes[i]) == 0) return 1;
    }
    return 0;
}

EGLAPI gn_proc EGLAPIENTRY eglGetProcAddress(const char *name) {
    if (strcmp(name, "eglGetPlatformDisplayEXT") == 0) return (gn_proc)get_platform_display;
    if (strcmp(name, "glGetIntegerv") == 0) return (gn_proc)get_integer;
    if (strcmp(name, "glGetString") == 0) return (gn_proc)get_string;
    return strncmp(name, "gl", 2) == 0 && is_extension(name) ? NULL : angle_proc(name);
}
