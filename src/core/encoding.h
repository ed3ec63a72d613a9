/* Texts that stand for bytes: percent and base64 encoding, as in URIs. */
#ifndef GN_CORE_ENCODING_H
#define GN_CORE_ENCODING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* %XX into out, as large as the text; the number of bytes. An invalid % is kept. */
size_t gn_percent_decode(const char *text, uint8_t *out);

/* Into out, 3/4 of the length and 2 more; false: not base64. */
bool gn_base64_decode(const char *text, size_t length, uint8_t *out, size_t *size);

/* The bytes of a data URI ("data:..;base64,.." or percent-encoded) into out, as large as the URI.
 * False without a comma, or for wrong base64. */
bool gn_data_uri_decode(const char *uri, uint8_t *out, size_t *size, const char **why);
bool gn_data_uri_is(const char *uri);

#endif
