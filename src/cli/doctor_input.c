#include "cli/doctor_input.h"

#include <string.h>

#include "core/json.h"

enum { COLUMNS = 96 };

static const char *const kinds[] = {
    [GN_TOUCH_NONE] = "",
    [GN_TOUCH_SCREEN] = "touch screen",
    [GN_TOUCH_TABLET] = "tablet",
    [GN_TOUCH_MOUSE] = "mouse",
};

/* ---- for people ---------------------------------------------------------------------------- */

void gn_doctor_print_input(const struct gn_doctor_report *report, FILE *to) {
    const struct gn_input_list *input = &report->input;
    for (int i = 0; i < input->chip_count; i++) {
        const struct gn_input_chip *chip = &input->chips[i];
        int named = 0, used = 0;
        for (int k = 0; k < chip->line_count; k++) {
            named += chip->lines[k].name[0] != '\0';
            used += chip->lines[k].used;
        }
        if (chip->error) continue; /* printed with the device */
        fprintf(to, "  %s: %d line%s, label %s", chip->name, chip->line_count,
                chip->line_count == 1 ? "" : "s", chip->label);
        if (!named) fprintf(to, "; without names: write label:%s/NUMBER", chip->label);
        fprintf(to, "\n");
        if (!named && !used) continue;
        int column = fprintf(to, "    ");
        for (int k = 0; k < chip->line_count; k++) {
            const struct gn_input_line *line = &chip->lines[k];
            if (!line->name[0] && !line->used) continue;
            char word[160];
            int length = line->name[0] ? snprintf(word, sizeof word, "%s", line->name)
                                       : snprintf(word, sizeof word, "line %d", k);
            if (line->used)
                snprintf(word + length, sizeof word - (size_t)length, " (in use%s%s)",
                         line->consumer[0] ? " by " : "", line->consumer);
            length = (int)strlen(word);
            if (column + 1 + length > COLUMNS) column = fprintf(to, "\n     ") - 1;
            fprintf(to, " %s", word);
            column += 1 + length;
        }
        fprintf(to, "\n");
    }
    fprintf(to, "  read by %s\n", input->library ? input->library : "nothing in this build");
    fprintf(to, "\nKeys\n  %d input device%s", input->devices, input->devices == 1 ? "" : "s");
    if (input->devices_denied) fprintf(to, ", %d of them not to be read", input->devices_denied);
    fprintf(to, "\n");
    for (int i = 0; i < input->pointer_count; i++)
        fprintf(to, "  %s: %s, %s\n", kinds[input->pointers[i].kind], input->pointers[i].name,
                input->pointers[i].path);
}

/* ---- for programs -------------------------------------------------------------------------- */

void gn_doctor_describe_chip(const struct gn_doctor_report *report, const char *path,
                             json_t *object) {
    json_t *label = NULL, *lines = NULL;
    for (int i = 0; i < report->input.chip_count && !lines; i++) {
        const struct gn_input_chip *chip = &report->input.chips[i];
        if (strcmp(chip->path, path) != 0 || chip->error) continue;
        label = gn_json_make_text(chip->label);
        lines = json_array();
        for (int k = 0; k < chip->line_count; k++) {
            const struct gn_input_line *line = &chip->lines[k];
            json_t *name = gn_json_make_text(line->name[0] ? line->name : NULL);
            json_t *consumer = gn_json_make_text(line->consumer[0] ? line->consumer : NULL);
            json_array_append_new(lines, json_pack("{so sb so}", "name", name, "used", line->used,
                                                   "consumer", consumer));
        }
    }
    json_object_set_new(object, "label", label ? label : json_null());
    json_object_set_new(object, "lines", lines ? lines : json_null());
}

json_t *gn_doctor_input_json(const struct gn_doctor_report *report) {
    const struct gn_input_list *input = &report->input;
    json_t *pointers = json_array();
    for (int i = 0; i < input->pointer_count; i++)
        json_array_append_new(pointers,
                              json_pack("{ss so so}", "kind", kinds[input->pointers[i].kind],
                                        "name", gn_json_make_text(input->pointers[i].name), "path",
                                        gn_json_make_text(input->pointers[i].path)));
    return json_pack("{so si si so}", "gpio_library", gn_json_make_text(input->library), "devices",
                     input->devices, "devices_denied", input->devices_denied, "pointers", pointers);
}
