/* For tests that import models: a folder for them, and gnomon-import. */
#ifndef GN_TESTS_IMPORT_HELP_H
#define GN_TESTS_IMPORT_HELP_H

#include "core/warn.h"
#include "scene/scene.h"

struct CMUnitTest;
/* Runs a program's tests in a folder of their own; 77 where gnomon-import was not built. */
int help_import_run(const struct CMUnitTest *tests, size_t count);

const char *help_import_folder(void);
/* Of a file in the folder; valid until the next call. */
const char *help_import_path(const char *name);
void help_import_put_bytes(const char *name, const void *data, size_t size);
void help_import_put(const char *name, const char *text);
/* 2 x 2: red and green above, blue and white below, with that alpha. */
void help_import_put_picture(const char *name, uint8_t a0, uint8_t a1, uint8_t a2, uint8_t a3);

/* Imports, or fails the test. */
struct gn_scene *help_import_load(const char *name);
/* Of its first item. */
const struct gn_material *help_import_material(const struct gn_scene *scene);
/* Those that the last one that was loaded came with. */
const struct gn_warnings *help_import_warnings(void);
/* It is refused, by one line that begins with the path and says why. */
void help_import_refused(const char *name, const char *why);
/* One of the warnings says that. */
void help_import_warned(const char *what);

void help_import_near(float a, float b); /* a is b, to a ten-thousandth */
void help_import_box(const struct gn_scene *scene, float x0, float y0, float z0, float x1, float y1,
                     float z1);

#endif
