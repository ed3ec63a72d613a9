/* A cursor into the JSON of a glTF file that knows its path, and typed getters. A getter that finds
 * the wrong type fails the load with that path and returns a harmless value; those of flags and
 * floats, which no data depend on, name it by a warning and ignore it. */
#ifndef GN_SCENE_GLTF_JSON_H
#define GN_SCENE_GLTF_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gn_gltf;

struct gn_at {
    const struct gn_at *up; /* must outlive this one */
    const char *key;        /* NULL: element `index` of up */
    size_t index;
    json_t *json; /* NULL: absent */
};

/* Parses text into g->file.json; offset: of the text in the file, for messages. */
bool gn_gltf_parse(struct gn_gltf *g, const char *text, size_t size, size_t offset);

struct gn_at gn_at_root(const struct gn_gltf *g);
struct gn_at gn_at_any(const struct gn_at *up, const char *key);
/* path: a key, or keys with dots between: "normalTexture.scale"; it must outlive the cursor. Absent
 * gives an empty cursor; the wrong type, also of a part of the path, fails. */
struct gn_at gn_at_object(struct gn_gltf *g, const struct gn_at *up, const char *path);
struct gn_at gn_at_array(struct gn_gltf *g, const struct gn_at *up, const char *path);
struct gn_at gn_at_element(const struct gn_at *array, size_t index);
struct gn_at gn_at_item(struct gn_gltf *g, const struct gn_at *array, size_t index); /* an object */
size_t gn_at_size(const struct gn_at *array);

const char *gn_at_text(struct gn_gltf *g, const struct gn_at *up,
                       const char *path);                          /* NULL if absent */
const char *gn_at_name(struct gn_gltf *g, const struct gn_at *up); /* one of no string is none */
bool gn_at_flag(struct gn_gltf *g, const struct gn_at *up, const char *path, bool fallback);
uint64_t gn_at_uint(struct gn_gltf *g, const struct gn_at *up, const char *path, uint64_t fallback);
float gn_at_float(struct gn_gltf *g, const struct gn_at *up, const char *path, float fallback);
/* Exactly n numbers, at most 16, into out, which stays as it is if there are none, or others; true
 * if there were. */
bool gn_at_floats(struct gn_gltf *g, const struct gn_at *up, const char *path, size_t n,
                  float *out);
/* The first n numbers of an array, or as many as it has; what is none stays as it is. */
void gn_at_first_floats(struct gn_gltf *g, const struct gn_at *array, size_t n, float *out);
/* An index below count, or -1 if absent or wrong; what: plural, for the message. */
int32_t gn_at_ref(struct gn_gltf *g, const struct gn_at *up, const char *path, size_t count,
                  const char *what);
/* The same; a wrong one is named by a warning, and the load goes on. */
int32_t gn_at_spare_ref(struct gn_gltf *g, const struct gn_at *up, const char *path, size_t count,
                        const char *what);
int32_t gn_at_ref_here(struct gn_gltf *g, const struct gn_at *at, size_t count, const char *what);
/* A finite number; a whole one below 2^63 (in the file it may be an integer or a real). False
 * without a failure of the load. */
bool gn_json_number(const json_t *json, double *out);
bool gn_json_whole(const json_t *json, int64_t *out);
/* The index of a string among names, or -1. */
int gn_json_word(const json_t *json, const char *const *names, int count);

#endif
