/* What boards suffer from, where the kernel reports it: a supply that is too weak, a clock lowered
 * because of heat, contiguous memory (CMA) that runs out. One reading, and what follows from
 * several. */
#ifndef GN_CORE_HEALTH_H
#define GN_CORE_HEALTH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum gn_health_kind { GN_HEALTH_VOLTAGE, GN_HEALTH_THROTTLED, GN_HEALTH_CMA, GN_HEALTH_COUNT };
extern const char *const gn_health_names[GN_HEALTH_COUNT]; /* "undervoltage", .. */
extern const char *const gn_health_cures[GN_HEALTH_COUNT];

/* Bits of a Raspberry Pi's firmware (its GET_THROTTLED), and the same from 16 on: was so since the
 * driver rpi_volt asked last, 2 s ago; without that driver since the boot, which is not looked at.
 */
enum gn_health_bits {
    GN_HEALTH_UNDERVOLTAGE = 1,
    GN_HEALTH_CAPPED = 2,
    GN_HEALTH_SLOWED = 4,
    GN_HEALTH_SOFT_LIMIT = 8,
};

struct gn_health {
    int undervoltage;            /* 0 or 1; -1: not reported by the kernel */
    int64_t firmware;            /* the bits above; -1: not reported by the kernel */
    int cooled;                  /* devices that run slower to stay cool; -1: there are none */
    char cooling[48];            /* the type of one of them */
    int hottest_mc;              /* thousandths of a degree, of all zones; 0: unknown */
    int64_t cma_kb, cma_free_kb; /* 1024 bytes; -1: unknown; 0: there is none */
    int64_t memory_kb, available_kb;
    int64_t cma_failed; /* requests for it that failed since the boot; -1: unknown */
};

/* ---- texts of the kernel: pure --------------------------------------------------------------- */

/* The one number in a file, decimal or hexadecimal (with 0x or without); -1: it is none, is
 * negative, or has more than 9 digits. */
int64_t gn_health_parse_number(const char *text, int base);
/* Behind a key at the start of a line: "CmaTotal:" of /proc/meminfo, "cma_alloc_fail" of
 * /proc/vmstat; -1: there is no such line, or it has no number. */
int64_t gn_health_parse_line(const char *text, const char *key);

/* ---- a reading ------------------------------------------------------------------------------- */

/* root is put before every path: "" except in tests. What cannot be read, or is no number, is
 * unknown. May take milliseconds where a sensor is slow: not for the frame loop. */
void gn_health_read(struct gn_health *health, const char *root);
/* The hottest zone alone, as in hottest_mc. */
int gn_health_read_hottest_mc(const char *root);

/* Whether it suffers from that, and the sentence that says so. failed_before: cma_failed of the
 * reading before, -1: there was none. CMA runs out when requests for it have failed since, or when
 * less than a sixteenth of it is free while less than a sixteenth of all memory could be made free:
 * as long as there is other memory, the kernel moves what lies in it. */
bool gn_health_explain(const struct gn_health *health, enum gn_health_kind kind,
                       int64_t failed_before, char *out, size_t size);

/* ---- several readings ------------------------------------------------------------------------ */

/* So many in a row without it end it: short dips of a supply are one trouble, not many. */
enum { GN_HEALTH_CALM = 6 };
struct gn_health_log { /* zeroed: none yet */
    struct gn_health last;
    bool begun;
    int64_t cma_failed; /* of the last reading that had it; -1: none */
    struct gn_ailment {
        bool lasts;
        int calm;       /* readings without it, while it lasts */
        unsigned times; /* that it began */
        char text[200]; /* as it was said last */
    } of[GN_HEALTH_COUNT];
};
void gn_health_take(struct gn_health_log *log, const struct gn_health *reading);
/* "undervoltage now, throttled 3 times before"; "" if there was never anything. */
void gn_health_summarise(const struct gn_health_log *log, char *out, size_t size);

#endif
