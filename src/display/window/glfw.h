/* The functions of GLFW used by window.c, as a table filled at run time. */
#ifndef GN_DISPLAY_WINDOW_GLFW_H
#define GN_DISPLAY_WINDOW_GLFW_H

#define GLFW_INCLUDE_NONE
#define GLFW_EXPOSE_NATIVE_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>

#include "display/window/link.h"

/* clang-format off */
#define GLFW_TABLE(X) \
    X(Init) X(GetError) X(WindowHint) X(WindowHintString) X(CreateWindow) X(DestroyWindow) \
    X(ShowWindow) X(MakeContextCurrent) X(SwapInterval) X(SwapBuffers) X(PollEvents) \
    X(GetProcAddress) X(GetEGLDisplay) X(GetEGLSurface) X(GetFramebufferSize) X(GetWindowSize) \
    X(SetWindowTitle) X(SetWindowIcon) X(SetWindowPos) X(GetWindowPos) X(GetWindowMonitor) \
    X(SetWindowMonitor) X(GetMonitors) X(GetMonitorPos) X(GetVideoMode) X(SetWindowUserPointer) \
    X(GetWindowUserPointer) X(SetWindowCloseCallback) X(SetWindowRefreshCallback) \
    X(SetFramebufferSizeCallback) X(SetWindowIconifyCallback) X(SetKeyCallback) \
    X(SetCharCallback) X(SetMouseButtonCallback) X(SetCursorPosCallback) X(SetScrollCallback) \
    X(SetDropCallback)
/* clang-format on */

struct glfw {
    void *library;
    struct gn_window_link link; /* valid once initialised */
#define X(name) __typeof__(glfw##name) *(name);
    GLFW_TABLE(X)
#undef X
};

#endif
