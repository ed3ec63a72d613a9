/* Takes out of texts what names a machine or its user, for reports that are sent to others. */
#ifndef GN_CORE_REDACT_H
#define GN_CORE_REDACT_H

#include <stddef.h>

enum { GN_REDACT_WORDS = 48 };

struct gn_redact {
    char words[GN_REDACT_WORDS][64];
    int count;
};

/* The words that name this machine and its user: host name, names of the user (also of the one that
 * ran sudo), serial numbers of board and firmware, machine-id, MAC addresses. Names that systems
 * give by themselves ("pi", "debian") name nobody and are left out. root is put before every path:
 * "" except in tests. */
void gn_redact_read(struct gn_redact *redact, const char *root);
/* Adds a word, unless it is one of those or shorter than two characters. */
void gn_redact_add(struct gn_redact *redact, const char *word);

/* Copies the text into out, of size bytes with the ending zero, without control characters, and
 * with "(name)" for each of the words, in any case: between characters that are neither letters nor
 * digits, from 6 characters on anywhere. "(path)" stands for a path that begins with "/", "./",
 * "../" or "~/", of which that of a device ("/dev/dri/card0") keeps its last part, "(address)" for
 * an IP or MAC address. What does not fit is cut. */
void gn_redact_text(const struct gn_redact *redact, const char *text, char *out, size_t size);

#endif
