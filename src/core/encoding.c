#include "core/encoding.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

static int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    c = (char)(c | 32);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

size_t gn_percent_decode(const char *text, uint8_t *out) {
    size_t n = 0;
    while (*text) {
        int high = *text == '%' ? hex_digit(text[1]) : -1;
        int low = high >= 0 ? hex_digit(text[2]) : -1;
        out[n++] = low >= 0 ? (uint8_t)(high * 16 + low) : (uint8_t)*text;
        text += low >= 0 ? 3 : 1;
    }
    return n;
}

size_t gn_uri_name(const char *uri, int number, char *out) {
    const size_t whole = strlen(uri), bare = strcspn(uri, "?#");
    if (number > 3 || (number > 1 && bare == whole)) return 0;
    memcpy(out, uri, whole + 1);
    if (number > 1) out[bare] = 0;
    const size_t length = number % 2 == 0 ? gn_percent_decode(out, (uint8_t *)out) : strlen(out);
    out[length] = 0;
    for (size_t i = 0; i < length; i++)
        if (out[i] == '\\') out[i] = '/';
    return length;
}

/* out may be the text itself; false: not base64. */
static bool decode_base64(const char *text, size_t length, uint8_t *out, size_t *size) {
    static const char alphabet[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    int8_t table[256];
    memset(table, -1, sizeof table);
    for (int i = 0; i < 64; i++) table[(uint8_t)alphabet[i]] = (int8_t)i;
    while (length > 0 && text[length - 1] == '=') length--;
    uint32_t bits = 0;
    size_t n = 0;
    for (size_t i = 0; i < length; i++) {
        int8_t value = table[(uint8_t)text[i]];
        if (value < 0) return false;
        bits = bits << 6 | (uint32_t)value;
        if (i % 4 == 0) continue;
        out[n++] = (uint8_t)(bits >> (6 - 2 * (i % 4)));
    }
    *size = n;
    return length % 4 != 1;
}

/* Percent-decoded, without white space; the length. */
static size_t decode_text(const char *text, uint8_t *out) {
    const size_t length = gn_percent_decode(text, out);
    size_t n = 0;
    for (size_t i = 0; i < length; i++)
        if (!isspace(out[i])) out[n++] = out[i];
    return n;
}

bool gn_data_uri_is(const char *uri) { return strncasecmp(uri, "data:", 5) == 0; }

bool gn_data_uri_decode(const char *uri, uint8_t *out, size_t *size, const char **why) {
    static const char mark[] = ";base64";
    const char *comma = strchr(uri, ',');
    *why = "data URI without a comma";
    if (!comma) return false;
    const size_t header = (size_t)(comma - uri), tail = sizeof mark - 1;
    *why = "data URI: not valid base64";
    if (header >= tail && strncasecmp(comma - tail, mark, tail) == 0)
        return decode_base64((const char *)out, decode_text(comma + 1, out), out, size);
    *size = gn_percent_decode(comma + 1, out);
    return true;
}
