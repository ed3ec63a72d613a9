#include "core/library.h"

#include <dlfcn.h>
#include <string.h>

void *gn_library_open(const char *name, const char *package, struct gn_err *err) {
    void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (library) return library;
    /* "libx.so.1: cannot open shared object file: No such file or directory" */
    const char *why = dlerror();
    const size_t length = strlen(name);
    const bool of_itself = why && strncmp(why, name, length) == 0 && why[length] == ':';
    if (!why || (of_itself && strstr(why, "No such file or directory")))
        gn_fail(err, "%s is missing; install %s", name, package);
    else
        gn_fail(err, "%s cannot be loaded (%s); check memory, open files and package %s", name,
                of_itself ? why + length + strspn(why + length, ": ") : why, package);
    return NULL;
}
