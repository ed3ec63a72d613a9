#include "core/redact.h"

#include <arpa/inet.h>
#include <ctype.h>
#include <glob.h>
#include <limits.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "core/file.h"
#include "core/text.h"

enum { ANYWHERE = 6, TOKEN = 256 };

/* ---- the words ----------------------------------------------------------------------------- */

void gn_redact_add(struct gn_redact *redact, const char *word) {
    static const char *const common[] = {
        "debian", "raspberrypi", "localhost", "localdomain", "root",  "user", "admin",
        "gnomon", "beagleplay",  "beagle",    "raspberry",   "linux", "pi",   "rock",
    };
    char *to = redact->words[redact->count];
    if (!word || strlen(word) < 2 || redact->count == GN_REDACT_WORDS) return;
    for (size_t i = 0; i < sizeof common / sizeof *common; i++)
        if (strcasecmp(word, common[i]) == 0) return;
    snprintf(to, sizeof redact->words[0], "%s", word);
    redact->count++;
}

/* The text whole, and its parts between spaces, points and commas: "first.last", "First Last,,," */
static void add_parts(struct gn_redact *redact, const char *text) {
    static const char between[] = " \t\n.,;:";
    char word[64];
    if (!text) return;
    text += strspn(text, between);
    const size_t all = strcspn(text, "\n");
    snprintf(word, sizeof word, "%.*s", (int)all, text);
    gn_redact_add(redact, word);
    for (const char *at = text; *(at += strspn(at, between)); at += strcspn(at, between)) {
        const size_t length = strcspn(at, between);
        if (length < all) snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (length < all && length > 2) gn_redact_add(redact, word);
    }
}

static void add_files(struct gn_redact *redact, const char *root, const char *pattern) {
    char path[PATH_MAX], text[256];
    glob_t found;
    snprintf(path, sizeof path, "%s%s", root, pattern);
    if (glob(path, GLOB_BRACE, NULL, &found)) return;
    for (size_t i = 0; i < found.gl_pathc; i++)
        if (gn_file_read_text(found.gl_pathv[i], text, sizeof text)) {
            text[strcspn(text, "\n")] = 0;
            for (size_t end = strlen(text); end > 0 && text[end - 1] == ' ';) text[--end] = 0;
            if (strpbrk(text, "0123456789")) gn_redact_add(redact, text); /* not "None" */
        }
    globfree(&found);
}

static void add_user(struct gn_redact *redact, const struct passwd *user) {
    if (!user) return;
    add_parts(redact, user->pw_name);
    add_parts(redact, user->pw_gecos);
}

void gn_redact_read(struct gn_redact *redact, const char *root) {
    static const char *const variables[] = {"HOSTNAME", "USER", "LOGNAME", "SUDO_USER", "DISPLAY"};
    char host[HOST_NAME_MAX + 1] = "", path[PATH_MAX], text[256];
    *redact = (struct gn_redact){0};
    gethostname(host, sizeof host - 1);
    add_parts(redact, host);
    snprintf(path, sizeof path, "%s/etc/hostname", root);
    if (gn_file_read_text(path, text, sizeof text)) add_parts(redact, text);
    for (size_t i = 0; i < sizeof variables / sizeof *variables; i++)
        add_parts(redact, getenv(variables[i]));
    add_user(redact, getpwuid(getuid()));
    add_user(redact, getpwuid(geteuid()));
    add_files(redact, root, "/proc/device-tree/serial-number");
    add_files(redact, root, "/etc/machine-id");
    add_files(redact, root,
              "/sys/class/dmi/id/{product_serial,product_uuid,board_serial,board_asset_tag,"
              "chassis_serial,chassis_asset_tag}");
    add_files(redact, root, "/sys/class/net/*/address");
}

/* ---- texts --------------------------------------------------------------------------------- */

static bool is_of_word(char c) { return isalnum((unsigned char)c) || (c & 0x80); }

/* The length of a word of the list that begins at `at`; 0: none does. */
static size_t length_of_name(const struct gn_redact *redact, const char *text, const char *at) {
    size_t longest = 0;
    for (int i = 0; i < redact->count; i++) {
        const size_t length = strlen(redact->words[i]);
        if (length <= longest || strncasecmp(at, redact->words[i], length) != 0) continue;
        const bool apart = (at == text || !is_of_word(at[-1])) && !is_of_word(at[length]);
        if (apart || length >= ANYWHERE) longest = length;
    }
    return longest;
}

/* The length of an IP or MAC address that begins at `at`, which is no part of a number. */
static size_t length_of_address(const char *at) {
    char token[64];
    unsigned char address[16];
    const size_t length = strspn(at, "0123456789abcdefABCDEF.:");
    if (length < 3 || length >= sizeof token || is_of_word(at[length]) || at[length] == '-')
        return 0;
    size_t kept = length; /* a point or colon of the sentence */
    while (kept > 3 && strchr(".:", at[kept - 1]) && at[kept - 2] != ':') kept--;
    snprintf(token, sizeof token, "%.*s", (int)kept, at);
    if (inet_pton(AF_INET, token, address) == 1 || inet_pton(AF_INET6, token, address) == 1)
        return kept;
    const size_t host = strcspn(token, ":"); /* "192.0.2.1:0" */
    char *port = token + host;
    if (*port && !strchr(port + 1, ':')) {
        *port = 0;
        if (inet_pton(AF_INET, token, address) == 1) return host;
        *port = ':';
    }
    int pairs = 0;
    for (const char *pair = token;
         isxdigit((unsigned char)pair[0]) && isxdigit((unsigned char)pair[1]); pair += 3) {
        pairs++;
        if (pair[2] != ':') return pairs >= 6 && !pair[2] ? kept : 0;
    }
    return 0;
}

/* The length of a path that begins at `at` with a slash, a tilde or points, without what ends a
 * sentence. */
static size_t length_of_path(const char *text, const char *at) {
    const size_t before = strspn(at, "~.");
    if (before > 2 || at[before] != '/') return 0;
    if (at > text && (is_of_word(at[-1]) || at[-1] == '.')) return 0; /* "GNU/Linux" */
    size_t length = strcspn(at, " \t\n\"'()<>,;");
    while (length > 1 && strchr(".:", at[length - 1])) length--;
    return length > 1 ? length : 0;
}

/* "card0" of "/dev/dri/card0": folders of nodes that the kernel numbers. */
static void add_path(char *out, size_t size, const char *at, size_t length) {
    static const char *const folders[] = {"/dev/dri/", "/dev/input/", "/dev/"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        const size_t folder = strlen(folders[i]);
        if (length <= folder || strncmp(at, folders[i], folder) != 0) continue;
        if (memchr(at + folder, '/', length - folder)) continue;
        gn_text_add(out, size, "%.*s", (int)(length - folder), at + folder);
        return;
    }
    gn_text_add(out, size, "(path)");
}

void gn_redact_text(const struct gn_redact *redact, const char *text, char *out, size_t size) {
    out[0] = 0;
    for (const char *at = text; *at;) {
        const bool begins = at == text || !is_of_word(at[-1]);
        size_t length = length_of_path(text, at);
        if (length) {
            add_path(out, size, at, length);
        } else if (begins && (length = length_of_address(at))) {
            gn_text_add(out, size, "(address)");
        } else if ((length = length_of_name(redact, text, at))) {
            gn_text_add(out, size, "(name)");
        } else {
            length = 1;
            gn_text_add(out, size, "%c", (unsigned char)*at < ' ' || *at == 0x7f ? ' ' : *at);
        }
        at += length;
    }
}
