/* Before jansson parses a text: what is valid JSON and jansson refuses is replaced in place. */
#ifndef GN_SCENE_GLTF_JSON_TEXT_H
#define GN_SCENE_GLTF_JSON_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#define GN_JSON_TEXT_LARGEST 9e307

/* A copy of the text (free() it), of the same length, in which numbers of 1e308 and more are that
 * and \u0000 and single surrogates are U+FFFD; NULL if there is nothing to replace, or no memory
 * for it. Wrong JSON stays wrong. */
char *gn_json_text_replace(const char *text, size_t size);

#endif
