/* Valid JSON that jansson refuses: numbers beyond a double, and escapes that are no character. Both
 * are legal in names and extras of a file that is otherwise all right. */
#include "scene/gltf/json_text.h"

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const char huge[] = {'9', 'e', '3', '0', '7'}; /* no number of 1e308 or more is shorter */
static const char replacement[] = {'\\', 'u', 'f', 'f', 'f', 'd'};
enum { DOUBLE_DIGITS = 308, EXPONENT_MAX = 1 << 30 }; /* every number below 1e308 is a double */

/* The end of the number at c, and in *power how large it is: below 10^power, and not below a tenth
 * of that; far below 0 if all digits are zeros. */
static const char *read_number(const char *c, const char *end, int64_t *power) {
    int64_t place = 0, exponent = 0; /* place: digits from the first that counts to the point */
    bool behind_point = false, counts = false;
    for (; c < end && (isdigit((unsigned char)*c) || (*c == '.' && !behind_point)); c++) {
        behind_point |= *c == '.';
        if (*c == '.') continue;
        counts |= *c != '0';
        if (counts != behind_point) place += counts ? 1 : -1;
    }
    bool minus = false;
    if (c < end && (*c == 'e' || *c == 'E')) {
        c++;
        minus = c < end && *c == '-';
        if (c < end && (*c == '-' || *c == '+')) c++;
        for (; c < end && isdigit((unsigned char)*c); c++)
            if (exponent < EXPONENT_MAX) exponent = exponent * 10 + (*c - '0');
    }
    *power = (counts ? place : INT64_MIN / 2) + (minus ? -exponent : exponent);
    return c;
}

/* The code of the \uXXXX at c, or -1. */
static int32_t read_escape(const char *c, const char *end) {
    int32_t code = 0;
    if (end - c < 6 || c[0] != '\\' || c[1] != 'u') return -1;
    for (int i = 2; i < 6; i++) {
        if (!isxdigit((unsigned char)c[i])) return -1;
        const int digit = isdigit((unsigned char)c[i]) ? c[i] - '0' : (c[i] | 0x20) - 'a' + 10;
        code = code * 16 + digit;
    }
    return code;
}

/* The length of the escape at c; *bad: it is NUL, or one half of a surrogate pair. */
static size_t escape_length(const char *c, const char *end, bool *bad) {
    const int32_t code = read_escape(c, end);
    *bad = code == 0 || (code >= 0xd800 && code < 0xe000);
    if (code < 0) return end - c < 2 ? 1 : 2;
    const int32_t next = read_escape(c + 6, end);
    if (code < 0xd800 || code >= 0xdc00 || next < 0xdc00 || next >= 0xe000) return 6;
    *bad = false;
    return 12;
}

/* Finds what is to be replaced, and replaces it in out if that is not NULL. */
static bool replace_all(const char *text, size_t size, char *out) {
    const char *end = text + size;
    bool quoted = false, found = false;
    for (const char *c = text; c < end;) {
        const char *start = c;
        bool bad = false;
        if (quoted && *c == '\\') {
            c += escape_length(c, end, &bad);
            if (bad && out) memcpy(out + (start - text), replacement, sizeof replacement);
        } else if (!quoted && isdigit((unsigned char)*c)) {
            int64_t power;
            c = read_number(c, end, &power);
            bad = power > DOUBLE_DIGITS;
            if (bad && out) {
                memset(out + (start - text), ' ', (size_t)(c - start));
                memcpy(out + (start - text), huge, sizeof huge);
            }
        } else {
            quoted ^= *c++ == '"';
        }
        found |= bad;
    }
    return found;
}

char *gn_json_text_replace(const char *text, size_t size) {
    char *out = replace_all(text, size, NULL) ? malloc(size) : NULL;
    if (!out) return NULL;
    memcpy(out, text, size);
    replace_all(text, size, out);
    return out;
}
