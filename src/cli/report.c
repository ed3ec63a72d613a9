#include "cli/report.h"

#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/json.h"
#include <config.h> /* made by the build */

/* ---- what may be sent ---------------------------------------------------------------------- */

/* What of doctor's JSON goes into a report. What is not here does not: user, groups, paths and
 * holders of devices, consumers of lines, names of input devices. */
static const struct {
    const char *part, *fields; /* NULL: all of it */
} allowed[] = {
    {"version", NULL},
    {"can_draw", NULL},
    {"machine", " model cpu system kernel arch cpus memory_mb cma_mb health limits "},
    {"backends", " name built opens why vendor renderer gles egl software "},
    {"gpu", NULL},
    {"cards", " kind driver readable writable "},
    {"connectors", " name status mode modes monitor "},
    {"gpio", " device readable writable label lines "},
    {"input", " gpio_library devices devices_denied "},
    {"problems", " what "},
    {"self_test", NULL},
};
static const char line_fields[] = " name used "; /* of gpio's lines */

static bool is_listed(const char *list, const char *key) {
    char word[80];
    snprintf(word, sizeof word, " %.70s ", key);
    return !list || strstr(list, word);
}

/* A copy of the fields of an object, or of each object of an array. */
static json_t *copy_fields(json_t *value, const char *fields) {
    size_t i;
    const char *key;
    json_t *item, *copy = json_is_array(value) ? json_array() : json_object();
    if (!fields || (!json_is_array(value) && !json_is_object(value))) {
        json_decref(copy);
        return json_deep_copy(value);
    }
    json_array_foreach(value, i, item) json_array_append_new(copy, copy_fields(item, fields));
    json_object_foreach(value, key, item) if (is_listed(fields, key)) json_object_set_new(
        copy, key, copy_fields(item, strcmp(key, "lines") == 0 ? line_fields : NULL));
    return copy;
}

/* Their texts are names of this program's own, whatever a machine is called. */
static const char own_names[] = " technique map_format kind scene ";

/* The same with each text as gn_redact_text() leaves it; a new reference. */
static json_t *redact_all(const json_t *value, const struct gn_redact *redact) {
    size_t i;
    const char *key;
    json_t *item, *copy;
    if (json_is_string(value)) {
        char text[2048];
        gn_redact_text(redact, json_string_value(value), text, sizeof text);
        return gn_json_make_text(text);
    }
    if (!json_is_array(value) && !json_is_object(value)) return json_deep_copy(value);
    copy = json_is_array(value) ? json_array() : json_object();
    json_array_foreach(value, i, item) json_array_append_new(copy, redact_all(item, redact));
    json_object_foreach((json_t *)value, key, item) json_object_set_new(
        copy, key,
        is_listed(own_names, key) && json_is_string(item) ? json_deep_copy(item)
                                                          : redact_all(item, redact));
    return copy;
}

static const char *describe_build(void) {
#ifdef __clang__
    return "clang " __VERSION__
#else
    return "gcc " __VERSION__
#endif
#ifndef __OPTIMIZE__
           ", not optimised"
#endif
        ;
}

json_t *gn_report_make(json_t *doctor, json_t *bench, const struct gn_redact *redact) {
    json_t *all =
        json_pack("{si ss}", "gnomon_report", GN_REPORT_VERSION, "built", describe_build());
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++) {
        json_t *part = json_object_get(doctor, allowed[i].part);
        if (part) json_object_set_new(all, allowed[i].part, copy_fields(part, allowed[i].fields));
    }
    json_object_set_new(all, "bench", bench);
    json_t *redacted = redact_all(all, redact);
    json_decref(all);
    json_decref(doctor);
    return redacted;
}

/* ---- the file ------------------------------------------------------------------------------ */

bool gn_report_write(const struct gn_doctor_report *report, const struct gn_settings *settings,
                     struct gn_err *err) {
    const char *path = settings->run.out ? settings->run.out : "gnomon-report.json";
    struct gn_redact redact;
    char *text = NULL;
    size_t size = 0;
    gn_redact_read(&redact, "");
    json_t *all =
        gn_report_make(gn_doctor_json(report), gn_report_bench(report, settings), &redact);
    FILE *to = open_memstream(&text, &size);
    bool ok = to && gn_json_print(json_incref(all), 7, to, err);
    ok = to && fclose(to) == 0 && ok;
    if (!ok && !err->text[0]) gn_fail(err, "no memory for a report");
    ok = ok && gn_file_write(path, text, size, err);
    if (ok) {
        gn_report_print_head(stdout);
        gn_report_print_row(all, stdout);
        printf("\n%s is written: names, paths, addresses and serial numbers are not in it. Look "
               "at it,\nthen send it: gnomon help report says where.\n",
               path);
    }
    free(text);
    json_decref(all);
    return ok;
}
