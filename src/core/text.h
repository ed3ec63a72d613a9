/* Short texts for people: one line, whole UTF-8 characters, no control characters. */
#ifndef GN_CORE_TEXT_H
#define GN_CORE_TEXT_H

#include <stdarg.h>
#include <stddef.h>

/* Formats into out (size > 0 bytes with the ending zero), drops C0, DEL and C1 control characters
 * and cuts what does not fit at whole UTF-8 characters: out of the middle ("..."), since what was
 * wrong stands at the end, behind names that can be long; at the end of short texts (under 64
 * bytes).
 */
void gn_text_vformat(char *out, size_t size, const char *format, va_list args);

/* How many single-character edits (insert, delete, replace) turn a into b; texts beyond 31
 * characters are cut. */
int gn_text_distance(const char *a, const char *b);

#endif
