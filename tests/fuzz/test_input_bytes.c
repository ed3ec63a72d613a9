/* What others write and buttons read: scripts, names of lines and keys, bytes of a terminal. Valid
 * ones are broken at random; what comes out is one line, or something that holds. The seed is
 * fixed, and a find is repeated by its number.
 *
 *   test_input_bytes [FIRST [COUNT]]    GN_FULL=1: two million */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/key.h"
#include "image/dice.h"
#include "input/keys.h"
#include "input/line_find.h"
#include "input/script.h"
#include "input/terminal_keys.h"

enum { SIZE_MAX_ = 400 };

static struct gn_dice dice;

static uint64_t next(void) { return gn_dice_next(&dice); }
static size_t below(size_t n) { return n > 0 ? (size_t)(next() % n) : 0; }

static const char *const seeds[] = {
    "# a script\n0 down next\n.5 up next\n1.25 click left button\r\n60 click f1\n",
    "0.000000001 click a\n\n0.1 down key_600\n999999 up key_600\n",
    "\33[A\33OB\33[5~\33[1;5C\33[[Aq\33[200~x\33[201~\33\33n\r\t \x7f",
    "label:pinctrl-rp1/17",
    "GPIO17",
    "space right KEY_POWER btn_0 key_600 f24",
};
enum { SEEDS = sizeof seeds / sizeof *seeds };

/* Pieces that matter to one of the readers. */
static const char *const pieces[] = {"\33[", "\33O", ";",      "~",    "9999999999999999999",
                                     ".",    "-",    "\n",     "\r\n", " ",
                                     "\t",   "/",    "label:", "key_", "down",
                                     "#",    "\xc3", "\xff",   "1e9",  "0x1"};

static size_t mutate(char *text) {
    const char *seed = seeds[below(SEEDS)];
    size_t size = strlen(seed);
    memcpy(text, seed, size);
    for (size_t i = below(8); i > 0; i--) {
        const size_t at = below(size + 1);
        const char *piece = pieces[below(sizeof pieces / sizeof *pieces)];
        const size_t length = strlen(piece), cut = below(size - at + 1);
        switch (below(4)) {
        case 0:
            if (at < size) text[at] = (char)next();
            break;
        case 1:
            if (size + length > SIZE_MAX_) break;
            memmove(text + at + length, text + at, size - at);
            memcpy(text + at, piece, length);
            size += length;
            break;
        case 2:
            memmove(text + at, text + at + cut, size - at - cut);
            size -= cut;
            break;
        case 3:
            if (size + cut > SIZE_MAX_) break;
            memmove(text + at + cut, text + at, size - at);
            size += cut;
            break;
        }
    }
    return size;
}

static const char *check_err(const struct gn_err *err) {
    if (!err->text[0]) return "fails without a word";
    return strchr(err->text, '\n') ? "says more than a line" : NULL;
}

static const char *try_script(const char *text, size_t size) {
    struct gn_arena arena = {.limit = 1 << 20};
    struct gn_script script;
    struct gn_err err = {0};
    const char *wrong = NULL;
    if (!gn_script_parse(text, size, "s", &arena, &script, &err))
        wrong = err.text[0] != 's' ? "does not name the file" : check_err(&err);
    else
        for (int i = 0; i < script.count; i++)
            if (script.lines[i].time_ns < (i ? script.lines[i - 1].time_ns : 0) ||
                !script.lines[i].name[0] || strchr(script.lines[i].name, '\n'))
                wrong = "a line that does not hold";
    gn_arena_finish(&arena);
    return wrong;
}

/* Keys that exist, and after a pause plain bytes are plain again. */
static const char *try_terminal(const char *text, size_t size) {
    struct gn_terminal_keys keys = {0};
    char buffer[16];
    int64_t now_ns = 0;
    for (size_t i = 0; i < size; i++) {
        const unsigned key = gn_terminal_keys_step(&keys, (uint8_t)text[i], now_ns += 1000000);
        if (key >= GN_KEY_COUNT) return "no key";
        if (key && strncmp(gn_key_name(key, buffer, sizeof buffer), "key_", 4) == 0)
            return "a key that no terminal has";
        if (below(20) == 0) gn_terminal_keys_wait(&keys, now_ns += 40000000);
    }
    gn_terminal_keys_wait(&keys, now_ns + 1000000000);
    if (gn_terminal_keys_deadline(&keys) != INT64_MAX) return "still waits";
    return gn_terminal_keys_step(&keys, 'n', now_ns) == GN_KEY_N ? NULL : "lost its way";
}

static const char *try_names(const char *text) {
    static struct gn_keys keys;
    struct gn_line_spec spec;
    struct gn_err err = {0};
    if (gn_line_parse(text, &spec, &err)) {
        if (!spec.name[0] == !spec.label[0]) return "a line without a name, or with two";
    } else if (check_err(&err)) {
        return check_err(&err);
    }
    memset(&keys, 0, sizeof keys);
    err.text[0] = '\0';
    if (!gn_keys_bind(&keys, 31, text, &err)) return check_err(&err);
    return gn_key_is_down(keys.bound, GN_KEY_NONE) ? "no key is bound" : NULL;
}

int main(int argc, char **argv) {
    const uint64_t first = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    const uint64_t all = getenv("GN_FULL") ? 2000000 : 100000;
    const uint64_t count = argc > 2 ? strtoull(argv[2], NULL, 10) : argc > 1 ? 1 : all;
    int failures = 0;
    for (uint64_t i = first; i < first + count && failures < 5; i++) {
        char text[SIZE_MAX_ + 1];
        dice.state = i;
        const size_t size = mutate(text);
        text[size] = '\0';
        /* exactly as long, so that a byte too far is found */
        char *exact = malloc(size + 1);
        memcpy(exact, text, size + 1);
        const char *wrong = try_names(exact);
        exact = realloc(exact, size ? size : 1);
        wrong = wrong ? wrong : try_script(exact, size);
        wrong = wrong ? wrong : try_terminal(exact, size);
        free(exact);
        if (!wrong) continue;
        printf("FAIL %" PRIu64 ": %s: \"%s\"\n", i, wrong, text);
        failures++;
    }
    printf("%" PRIu64 " texts, %d wrong\n", count, failures);
    return failures > 0;
}
