#include "cli/report.h"
#include "core/file.h"

enum { ELEMENTS_MAX = 1000 };

/* No list is so long that comparing each element with each takes long. */
static bool has_short_lists(json_t *value) {
    size_t i;
    const char *key;
    json_t *item;
    if (json_array_size(value) > ELEMENTS_MAX) return false;
    json_array_foreach(value, i, item) if (!has_short_lists(item)) return false;
    json_object_foreach(value, key, item) if (!has_short_lists(item)) return false;
    return true;
}

json_t *gn_report_read(const char *path, struct gn_err *err) {
    struct gn_bytes bytes = {0};
    json_error_t why;
    if (!gn_file_read(path, GN_REPORT_BYTES, &bytes, err)) return NULL;
    json_t *all = json_loadb((const char *)bytes.data, bytes.size, JSON_REJECT_DUPLICATES, &why);
    gn_bytes_finish(&bytes);
    const json_t *version = json_object_get(all, "gnomon_report");
    if (!all)
        gn_fail(err, "%.200s:%d: not a whole report: %s", path, why.line, why.text);
    else if (!json_is_integer(version))
        gn_fail(err, "%.200s: not a file of gnomon doctor --report", path);
    else if (json_integer_value(version) != GN_REPORT_VERSION)
        gn_fail(err,
                "%.200s: a report of version %lld, and this gnomon reads %d: use the one that "
                "is newer",
                path, (long long)json_integer_value(version), GN_REPORT_VERSION);
    else if (!json_is_object(json_object_get(all, "machine")) ||
             !json_is_object(json_object_get(all, "bench")))
        gn_fail(err, "%.200s: a report without \"machine\" or \"bench\": send it again", path);
    else if (!has_short_lists(all))
        gn_fail(err, "%.200s: a list of more than %d elements, which no report has", path,
                ELEMENTS_MAX);
    else
        return all;
    json_decref(all);
    return NULL;
}
