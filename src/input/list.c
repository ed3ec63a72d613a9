#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "input/private.h"

static void list_chip(const struct gn_gpio_ops *ops, void *context, struct gn_input_chip *chip,
                      struct gn_arena *arena) {
    struct gn_gpio_chip info = {0};
    void *opened;
    chip->error = ops->open(context, chip->path, &opened, &info);
    if (chip->error) return;
    snprintf(chip->name, sizeof chip->name, "%s", info.name);
    snprintf(chip->label, sizeof chip->label, "%s", info.label);
    struct gn_input_line *lines = gn_arena_alloc(arena, info.lines, sizeof *lines);
    chip->lines = lines;
    for (unsigned i = 0; lines && i < info.lines; i++) {
        struct gn_gpio_line line = {0};
        if (ops->look(opened, i, &line) == 0) {
            memcpy(lines[i].name, line.name, sizeof line.name);
            memcpy(lines[i].consumer, line.consumer, sizeof line.consumer);
            lines[i].used = line.used;
        }
        chip->line_count++;
    }
    ops->close(opened);
}

void gn_input_list_in(const struct gn_input_world *world, struct gn_input_list *out) {
    const struct gn_gpio_ops *ops = world->gpio ? world->gpio : &gn_gpio_library;
    const char *folder = world->folder ? world->folder : "/dev";
    char paths[GN_INPUT_CHIPS_MAX][64], pattern[80];
    glob_t found;
    *out = (struct gn_input_list){.library = ops->library};
    snprintf(pattern, sizeof pattern, "%s/input/event*", folder);
    if (glob(pattern, 0, NULL, &found) == 0) {
        for (size_t i = 0; i < found.gl_pathc; i++) {
            out->devices++;
            out->devices_denied += access(found.gl_pathv[i], R_OK) != 0;
        }
        globfree(&found);
    }
    if (!ops->library) return;
    out->chip_count = gn_line_list_chips(folder, paths, GN_INPUT_CHIPS_MAX);
    for (int i = 0; i < out->chip_count; i++) {
        memcpy(out->chips[i].path, paths[i], sizeof paths[i]);
        list_chip(ops, world->gpio_context, &out->chips[i], &out->arena);
    }
}

void gn_input_list_lines(struct gn_input_list *out) {
    const struct gn_input_world world = {0};
    gn_input_list_in(&world, out);
}

void gn_input_list_finish(struct gn_input_list *list) {
    gn_arena_finish(&list->arena);
    *list = (struct gn_input_list){0};
}
