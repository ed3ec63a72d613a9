#include "kiosk/metric.h"

#include <stdio.h>
#include <string.h>

#include "core/json.h"

static json_t *make_value(const struct gn_metric *m, const void *of) {
    const void *at = (const char *)of + m->offset;
    switch (m->kind) {
    case GN_METRIC_SWITCH: return json_boolean(*(const bool *)at);
    case GN_METRIC_KNOWN: {
        const int8_t is = *(const int8_t *)at;
        return is < 0 ? json_null() : json_boolean(is);
    }
    case GN_METRIC_INT: return json_integer(*(const int *)at);
    case GN_METRIC_UINT: return json_integer(*(const uint32_t *)at);
    case GN_METRIC_AMOUNT: {
        const int64_t amount = *(const int64_t *)at;
        return amount < 0 ? json_null() : json_integer(amount);
    }
    case GN_METRIC_COUNTER: return json_integer((json_int_t) * (const uint64_t *)at);
    case GN_METRIC_NUMBER: return gn_json_make_number(*(const double *)at);
    case GN_METRIC_TEXT: return gn_json_make_text(*(const char *const *)at);
    case GN_METRIC_CHARS: return gn_json_make_text(at);
    case GN_METRIC_JSON: return *(json_t *const *)at;
    }
    return NULL;
}

/* The object of a name "group.name", made for its first member; else `into`. */
static json_t *find_group(json_t *into, const char *name) {
    char group[40];
    const char *dot = strchr(name, '.');
    if (!dot) return into;
    snprintf(group, sizeof group, "%.*s", (int)(dot - name), name);
    if (!json_object_get(into, group)) json_object_set_new(into, group, json_object());
    return json_object_get(into, group);
}

void gn_metrics_put(const struct gn_metric *metrics, int count, const void *of, bool brief,
                    json_t *into) {
    for (const struct gn_metric *m = metrics; m < metrics + count; m++) {
        json_t *value = make_value(m, of);
        const char *dot = strchr(m->name, '.');
        if (!value || (brief && !m->brief))
            json_decref(value);
        else
            json_object_set_new(find_group(into, m->name), dot ? dot + 1 : m->name, value);
    }
}
