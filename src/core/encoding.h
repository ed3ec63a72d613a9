/* Texts that stand for bytes: percent and base64 encoding, as in URIs. */
#ifndef GN_CORE_ENCODING_H
#define GN_CORE_ENCODING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* %XX into out, as large as the text; the number of bytes. An invalid % is kept. */
size_t gn_percent_decode(const char *text, uint8_t *out);

/* The names that the file of a relative URI may have, by number from 0: percent-decoded; as it is
 * written, by an exporter that does not encode; both without a query or fragment. '\\' becomes '/'.
 * Into out, of strlen(uri) + 1 bytes; returns the length, in which a decoded zero byte counts, or
 * 0: no further name. */
size_t gn_uri_name(const char *uri, int number, char *out);

/* The bytes of a data URI ("data:..;base64,..", also percent-encoded or with line breaks in it; or
 * percent-encoded alone; RFC 2397) into out, as large as the URI.
 * False without a comma, or for wrong base64. */
bool gn_data_uri_decode(const char *uri, uint8_t *out, size_t *size, const char **why);
bool gn_data_uri_is(const char *uri);

#endif
