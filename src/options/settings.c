#include "options/settings.h"

#include <assert.h>
#include <string.h>

#include "options/value.h"

const struct gn_override *gn_section_setting(const struct gn_named_section *section,
                                             const struct gn_option_row *row) {
    const struct gn_override *override = section->first;
    while (override && override->row != row) override = override->next;
    return override;
}

void gn_section_fill(const struct gn_named_section *section, void *out) {
    for (const struct gn_override *o = section->first; o; o = o->next)
        memcpy((char *)out + o->row->offset, o->value, gn_value_size(o->row->kind));
}

static size_t index_of_row(const struct gn_option_row *row) {
    return (size_t)(row - gn_option_rows);
}

void gn_settings_put(struct gn_settings *settings, const struct gn_option_row *row,
                     const void *value, enum gn_source source, const char *label) {
    uint8_t *from = &settings->source[index_of_row(row)];
    if (*from > source) return;
    memcpy((char *)settings + row->offset, value, gn_value_size(row->kind));
    *from = (uint8_t)source;
    settings->label[index_of_row(row)] = label;
}

const void *gn_settings_value(const struct gn_settings *settings, const struct gn_option_row *row) {
    return (const char *)settings + row->offset;
}

void gn_settings_text(const struct gn_settings *settings, const struct gn_option_row *row,
                      char *out, size_t size) {
    gn_value_text(row, gn_settings_value(settings, row), out, size);
}

static size_t index_of_field(size_t offset) {
    size_t i = 0;
    while (i < GN_OPTION_COUNT && gn_option_rows[i].offset != offset) i++;
    assert(i < GN_OPTION_COUNT && "a field of the table");
    return i;
}

enum gn_source gn_settings_source(const struct gn_settings *settings, size_t offset) {
    return settings->source[index_of_field(offset)];
}

bool gn_settings_light_holds(const struct gn_settings *settings,
                             const struct gn_override *override) {
    const struct gn_technique_list *techniques = override->value;
    const bool casts_none =
        override->row->kind == GN_KIND_TECHNIQUES && techniques->items[0] == GN_TECHNIQUE_NONE;
    return casts_none || gn_option_is_of(override->row, "light") ||
           settings->source[index_of_row(override->row)] < GN_SOURCE_MODE;
}

const char *gn_settings_label_at(const struct gn_settings *settings, size_t offset) {
    const char *label = settings->label[index_of_field(offset)];
    return label ? label : gn_option_rows[index_of_field(offset)].name;
}
