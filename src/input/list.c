#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "input/private.h"

static void add_pointer(const struct gn_input_world *world, const char *path,
                        struct gn_input_list *out) {
    static const uint8_t no_keys[GN_KEY_BYTES];
    const struct gn_evdev_ops *ops = world->evdev ? world->evdev : &gn_evdev;
    const struct gn_evdev_wish wish = {.bound = no_keys, .pointers = GN_POINTERS_ALL};
    struct gn_evdev_found found = {.fd = -1};
    if (out->pointer_count == GN_INPUT_POINTERS_MAX ||
        ops->open(world->evdev_context, path, &wish, &found) != 0)
        return;
    close(found.fd);
    struct gn_input_pointer *p = &out->pointers[out->pointer_count++];
    snprintf(p->path, sizeof p->path, "%s", path);
    snprintf(p->name, sizeof p->name, "%s", found.name);
    p->kind = found.touch.kind;
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
            const bool denied = access(found.gl_pathv[i], R_OK) != 0;
            out->devices_denied += denied;
            if (!denied) add_pointer(world, found.gl_pathv[i], out);
        }
        globfree(&found);
    }
    if (!ops->library) return;
    out->chip_count = gn_line_list_chips(folder, paths, GN_INPUT_CHIPS_MAX);
    for (int i = 0; i < out->chip_count; i++) {
        struct gn_input_chip *chip = &out->chips[i];
        struct gn_gpio_chip info = {0};
        void *opened;
        memcpy(chip->path, paths[i], sizeof paths[i]);
        chip->error = ops->open(world->gpio_context, chip->path, &opened, &info);
        if (chip->error) continue;
        snprintf(chip->name, sizeof chip->name, "%s", info.name);
        snprintf(chip->label, sizeof chip->label, "%s", info.label);
        struct gn_input_line *lines = gn_arena_alloc(&out->arena, info.lines, sizeof *lines);
        chip->lines = lines;
        for (unsigned k = 0; lines && k < info.lines; k++) {
            struct gn_gpio_line line = {0};
            if (ops->look(opened, k, &line) == 0) {
                memcpy(lines[k].name, line.name, sizeof line.name);
                memcpy(lines[k].consumer, line.consumer, sizeof line.consumer);
                lines[k].used = line.used;
            }
            chip->line_count++;
        }
        ops->close(opened);
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
