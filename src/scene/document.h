/* A glTF file as it is, for programs that rewrite it: its JSON, and the data behind that, checked
 * as a load checks it. The first failure sticks, as in a load: nothing is read after it. */
#ifndef GN_SCENE_DOCUMENT_H
#define GN_SCENE_DOCUMENT_H

#include <jansson.h>

#include "core/file.h"
#include "scene/scene.h"

struct gn_document;
struct gn_elements { /* of an accessor; sparse ones are dense, compressed ones plain */
    const uint8_t *data;
    size_t stride;  /* bytes from one to the next; 0: all are the same */
    size_t element; /* bytes of one, the padding between columns of a matrix included */
    size_t count;
    int component;  /* glTF's number: 5120 to 5126 */
    int components; /* of one element: 1 to 16 */
    bool normalized;
};
enum { GN_COMPONENT_U8 = 5121, GN_COMPONENT_U16 = 5123, GN_COMPONENT_F32 = 5126 };

/* The bytes of a .glb or .gltf; other files are searched from the folder of path, which names the
 * file in messages. data, limits, warnings and err must outlive it. NULL: err is filled. */
struct gn_document *gn_document_open(const char *path, const void *data, size_t size,
                                     const struct gn_scene_limits *limits,
                                     struct gn_warnings *warnings, struct gn_err *err);
void gn_document_close(struct gn_document *document);

/* Its numbers are integers or reals (gn_json_number()). */
const json_t *gn_document_json(const struct gn_document *document);
size_t gn_document_accessor_count(const struct gn_document *document);
size_t gn_document_view_count(const struct gn_document *document);
/* Bytes that the limit memory_mb leaves beside what the document holds. */
size_t gn_document_room(const struct gn_document *document);

/* Owned by the document. False: failed. */
bool gn_document_accessor(struct gn_document *document, size_t index, struct gn_elements *out);
/* As floats, normalised as the accessor says, into out: components x count of them; missing
 * components stay as they are. The elements have been read before. */
void gn_document_floats(struct gn_document *document, size_t index, size_t components, float *out);
/* As numbers, into out: count of them. False, and failed, where they are no unsigned scalars. */
bool gn_document_indices(struct gn_document *document, size_t index, uint32_t *out);
/* The numbers among count indices of the vertices of triangle t, as it is wound: glTF 2.0, 3.7.2.1.
 */
enum { GN_MODE_TRIANGLES = 4, GN_MODE_STRIP, GN_MODE_FAN };
void gn_triangle_of(int64_t mode, const uint32_t *raw, size_t t, uint32_t out[3]);
/* Of a bufferView, decompressed; data is NULL where its buffer holds none. */
void gn_document_view(const struct gn_document *document, size_t index, const uint8_t **data,
                      size_t *size, size_t *stride);
/* The bytes that a URI stands for, to be freed by gn_bytes_finish(). A failure does not stick; its
 * text in why has no path before it. */
bool gn_document_fetch(struct gn_document *document, const char *uri, struct gn_bytes *out,
                       struct gn_err *why);

#endif
