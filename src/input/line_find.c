#include "input/line_find.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/text.h"

enum { CHIPS_MAX = 32 };

/* ---- line specifications ------------------------------------------------------------------- */

/* Header pins of the Raspberry Pi: mainline device trees (bcm2711-rpi-4-b.dts, bcm2837-rpi-3-b.dts)
 * name some by their alternate function, Raspberry Pi's kernels all by number. */
static const struct {
    const char *number, *function;
} aliases[] = {
    {"GPIO0", "ID_SDA"},    {"GPIO1", "ID_SCL"},    {"GPIO2", "SDA1"},      {"GPIO3", "SCL1"},
    {"GPIO4", "GPIO_GCLK"}, {"GPIO7", "SPI_CE1_N"}, {"GPIO8", "SPI_CE0_N"}, {"GPIO9", "SPI_MISO"},
    {"GPIO10", "SPI_MOSI"}, {"GPIO11", "SPI_SCLK"}, {"GPIO14", "TXD1"},     {"GPIO14", "TXD0"},
    {"GPIO15", "RXD1"},     {"GPIO15", "RXD0"},
};
static const char *const alias_chips[] = {"pinctrl-bcm2711", "pinctrl-bcm2835", "pinctrl-rp1"};

static bool parse_offset(const char *text, unsigned *out) {
    char *end;
    if (*text < '0' || *text > '9') return false;
    const unsigned long value = strtoul(text, &end, 10);
    *out = (unsigned)value;
    return *end == '\0' && value < 1000000;
}

bool gn_line_parse(const char *text, struct gn_line_spec *out, struct gn_err *err) {
    static const char how[] = "GPIO17, or label:pinctrl-rp1/17; `gnomon doctor` lists them";
    *out = (struct gn_line_spec){0};
    const bool by_label = strncmp(text, "label:", 6) == 0;
    const char *slash = strrchr(text, '/');
    unsigned number;
    if (strlen(text) >= sizeof out->name) return gn_fail_usage(err, "line name too long");
    if (!by_label && (parse_offset(text, &number) || strncmp(text, "gpiochip", 8) == 0 ||
                      strncmp(text, "/dev/", 5) == 0))
        return gn_fail_usage(
            err, "\"%s\" is a chip or line number, which is not stable: use its name, %s", text,
            how);
    if (!by_label && !*text) return gn_fail_usage(err, "empty line name: expected %s", how);
    if (!by_label) {
        snprintf(out->name, sizeof out->name, "%s", text);
        return true;
    }
    if (!slash || slash == text + 6 || !parse_offset(slash + 1, &out->offset))
        return gn_fail_usage(err, "\"%s\" is not label:LABEL/NUMBER: expected %s", text, how);
    snprintf(out->label, sizeof out->label, "%.*s", (int)(slash - text - 6), text + 6);
    return true;
}

/* How well this line matches: 2 by its name, 1 by the name other kernels give it on this board, 0
 * not at all. */
static int rate_match(const struct gn_line_spec *spec, const struct gn_gpio_chip *chip,
                      unsigned offset, const struct gn_gpio_line *line) {
    if (spec->label[0])
        return strcmp(spec->label, chip->label) == 0 && spec->offset == offset ? 2 : 0;
    if (strcmp(spec->name, line->name) == 0) return 2;
    bool has_aliases = false;
    for (size_t i = 0; i < sizeof alias_chips / sizeof *alias_chips; i++)
        has_aliases |= strcmp(chip->label, alias_chips[i]) == 0;
    for (size_t i = 0; has_aliases && i < sizeof aliases / sizeof *aliases; i++) {
        const char *number = aliases[i].number, *function = aliases[i].function;
        if (strcmp(spec->name, number) == 0 && strcmp(line->name, function) == 0) return 1;
        if (strcmp(spec->name, function) == 0 && strcmp(line->name, number) == 0) return 1;
    }
    return 0;
}

/* ---- lines of all chips -------------------------------------------------------------------- */

static int by_number(const void *a, const void *b) { return strverscmp(a, b); }

int gn_line_list_chips(const char *folder, char (*paths)[64], int max) {
    DIR *open = opendir(folder);
    int count = 0;
    for (const struct dirent *entry; open && count < max && (entry = readdir(open));) {
        struct stat info;
        if (strncmp(entry->d_name, "gpiochip", 8) != 0) continue;
        if (snprintf(paths[count], sizeof *paths, "%s/%s", folder, entry->d_name) >=
            (int)sizeof *paths)
            continue;
        if (lstat(paths[count], &info) == 0 && !S_ISLNK(info.st_mode)) count++;
    }
    if (open) closedir(open);
    if (count) qsort(paths, (size_t)count, sizeof *paths, by_number);
    return count;
}

static void search_chip(const struct gn_gpio_ops *ops, void *chip, const char *path,
                        const struct gn_gpio_chip *info, const struct gn_line_spec *const *wanted,
                        struct gn_line_match *matches, int count) {
    for (unsigned offset = 0; offset < info->lines; offset++) {
        struct gn_gpio_line line = {0};
        if (ops->look(chip, offset, &line)) continue;
        for (int i = 0; i < count; i++) {
            struct gn_line_match *match = &matches[i];
            const int fits = wanted[i] ? rate_match(wanted[i], info, offset, &line) : 0;
            if (fits == 0 || fits < match->fits) continue;
            if (fits > match->fits) {
                *match = (struct gn_line_match){
                    .fits = fits, .chip = *info, .line = line, .offset = offset};
                snprintf(match->path, sizeof match->path, "%s", path);
            }
            gn_text_add(match->list, sizeof match->list, "%s%s (%s) line %u",
                        match->count++ ? ", " : "", info->name, info->label, offset);
        }
    }
}

void gn_line_search(const struct gn_gpio_ops *ops, void *context, const char *folder,
                    const struct gn_line_spec *const *wanted, struct gn_line_match *matches,
                    int count, struct gn_line_search *out) {
    char paths[CHIPS_MAX][64];
    const int chips = gn_line_list_chips(folder, paths, CHIPS_MAX);
    *out = (struct gn_line_search){.chips = chips};
    for (int i = 0; i < count; i++) matches[i] = (struct gn_line_match){0};
    for (int i = 0; i < chips; i++) {
        struct gn_gpio_chip info = {0};
        void *chip;
        const int error = ops->open(context, paths[i], &chip, &info);
        if (error) {
            out->refused++;
            out->error = error;
            memcpy(out->refused_path, paths[i], sizeof out->refused_path);
            continue;
        }
        search_chip(ops, chip, paths[i], &info, wanted, matches, count);
        ops->close(chip);
    }
}
