#include "core/health.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"

const char *const gn_health_names[GN_HEALTH_COUNT] = {
    [GN_HEALTH_VOLTAGE] = "undervoltage",
    [GN_HEALTH_THROTTLED] = "throttled",
    [GN_HEALTH_CMA] = "out of CMA",
};
const char *const gn_health_cures[GN_HEALTH_COUNT] = {
    [GN_HEALTH_VOLTAGE] = "use the board's own power supply and a short, thick cable, and give USB "
                          "devices a supply of their own",
    [GN_HEALTH_THROTTLED] = "cool the board: a heat sink, a fan, or air around its case",
    [GN_HEALTH_CMA] = "set a larger cma= on the kernel's command line (on a Raspberry Pi: "
                      "dtoverlay=vc4-kms-v3d,cma-512), or a lower resolution",
};

/* ---- texts of the kernel --------------------------------------------------------------------- */

enum { DIGITS_MAX = 9 };

int64_t gn_health_parse_number(const char *text, int base) {
    static const char digits[] = "0123456789abcdefABCDEF";
    const char *at = text + strspn(text, " \t");
    if (base == 16 && at[0] == '0' && (at[1] == 'x' || at[1] == 'X')) at += 2;
    size_t count = 0;
    while (at[count] && memchr(digits, at[count], base == 16 ? 22 : 10)) count++;
    if (count == 0 || count > DIGITS_MAX || at[count + strspn(at + count, " \t\n")]) return -1;
    return strtoll(at, NULL, base);
}

int64_t gn_health_parse_line(const char *text, const char *key) {
    const size_t length = strlen(key);
    for (const char *at = text; at; at = strchr(at, '\n')) {
        at += *at == '\n';
        if (strncmp(at, key, length) != 0) continue;
        const char *number = at + length + strspn(at + length, " \t");
        const size_t digits = strspn(number, "0123456789");
        const bool ends = number[digits] == '\0' || strchr(" \t\n", number[digits]);
        const bool begins = number > at + length || key[length - 1] == ':';
        return begins && ends && digits > 0 && digits < 18 ? strtoll(number, NULL, 10) : -1;
    }
    return -1;
}

/* ---- a reading ------------------------------------------------------------------------------- */

/* What is so, or was a moment ago. */
static unsigned bits_of(const struct gn_health *h) {
    if (h->firmware < 0) return 0;
    return (unsigned)(h->undervoltage < 0 ? h->firmware : h->firmware | h->firmware >> 16) & 15;
}

static bool explain_throttled(const struct gn_health *h, char *out, size_t size) {
    const unsigned bits = bits_of(h);
    char heat[40] = "";
    if (h->hottest_mc > 0) snprintf(heat, sizeof heat, " (%.0f C)", (double)h->hottest_mc * 1e-3);
    if (h->cooled > 0)
        snprintf(out, size, "throttled: %s runs slower to stay cool%s", h->cooling, heat);
    else if (bits & GN_HEALTH_SOFT_LIMIT)
        snprintf(out, size, "throttled: the firmware lowers the clock to stay cool%s", heat);
    else if (bits & (GN_HEALTH_CAPPED | GN_HEALTH_SLOWED))
        snprintf(out, size, "throttled: the firmware lowers the clock%s%s",
                 bits & GN_HEALTH_UNDERVOLTAGE || h->undervoltage > 0 ? " because of undervoltage"
                                                                      : "",
                 heat);
    else
        return false;
    return true;
}

static bool explain_cma(const struct gn_health *h, int64_t failed_before, char *out, size_t size) {
    const bool fails = h->cma_kb != 0 && failed_before >= 0 && h->cma_failed > failed_before;
    const bool is_low = h->cma_kb > 0 && h->cma_free_kb >= 0 && h->cma_free_kb < h->cma_kb / 16 &&
                        h->memory_kb > 0 && h->available_kb >= 0 &&
                        h->available_kb < h->memory_kb / 16;
    char place[64] = "", failed[64] = "";
    if (!fails && !is_low) return false;
    if (h->cma_kb > 0 && h->cma_free_kb >= 0)
        snprintf(place, sizeof place, ": %lld of %lld MB are free",
                 (long long)h->cma_free_kb / 1024, (long long)h->cma_kb / 1024);
    if (fails)
        snprintf(failed, sizeof failed, ", %lld request%s failed",
                 (long long)(h->cma_failed - failed_before),
                 h->cma_failed - failed_before == 1 ? "" : "s");
    snprintf(out, size, "contiguous memory for screen and GPU (CMA) runs out%s%s", place, failed);
    return true;
}

bool gn_health_explain(const struct gn_health *h, enum gn_health_kind kind, int64_t failed_before,
                       char *out, size_t size) {
    const bool is_low =
        h->undervoltage >= 0 ? h->undervoltage > 0 : bits_of(h) & GN_HEALTH_UNDERVOLTAGE;
    switch (kind) {
    case GN_HEALTH_VOLTAGE:
        if (is_low) snprintf(out, size, "undervoltage: the board's supply is too weak");
        return is_low;
    case GN_HEALTH_THROTTLED: return explain_throttled(h, out, size);
    case GN_HEALTH_CMA: return explain_cma(h, failed_before, out, size);
    default: return false;
    }
}

/* ---- several readings ------------------------------------------------------------------------ */

void gn_health_take(struct gn_health_log *log, const struct gn_health *reading) {
    const int64_t failed_before = log->begun ? log->cma_failed : -1;
    for (int i = 0; i < GN_HEALTH_COUNT; i++) {
        struct gn_ailment *a = &log->of[i];
        const bool is_ill = gn_health_explain(reading, (enum gn_health_kind)i, failed_before,
                                              a->text, sizeof a->text);
        a->times += is_ill && !a->lasts;
        a->calm = is_ill ? 0 : a->calm + a->lasts;
        a->lasts = is_ill || (a->lasts && a->calm < GN_HEALTH_CALM);
    }
    log->cma_failed = reading->cma_failed < 0 ? failed_before : reading->cma_failed;
    log->last = *reading;
    log->begun = true;
}

void gn_health_summarise(const struct gn_health_log *log, char *out, size_t size) {
    out[0] = '\0';
    for (int i = 0; i < GN_HEALTH_COUNT; i++) {
        const struct gn_ailment *a = &log->of[i];
        const char *comma = out[0] ? ", " : "";
        const unsigned before = a->times - a->lasts;
        if (a->lasts) gn_text_add(out, size, "%s%s now", comma, gn_health_names[i]);
        if (before > 0)
            gn_text_add(out, size, "%s%s %u time%s before", a->lasts ? " and" : comma,
                        a->lasts ? "" : gn_health_names[i], before, before == 1 ? "" : "s");
    }
}
