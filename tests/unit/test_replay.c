/* Files of tests/replay: what happened to buttons, and what had to come of it. Lines:
 *
 *   button NAME press,click,..      what is bound; chord=A+B makes it a chord
 *   TIME_S down|up NAME             an edge of its line, as script.h has it (or click)
 *   TIME_S read-down|read-up NAME   its level was read
 *   > TIME_S GESTURE NAME           in this order; and nothing else
 *   > stuck NAME                    reported, once */
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "core/file.h"
#include "input/gesture.h"
#include "input/script.h"

enum { LINES_MAX = 200, LINE_MAX_ = 120 };

struct replay {
    char names[GN_BUTTONS_MAX][32];
    struct gn_gesture_opts opts[GN_BUTTONS_MAX];
    int count;
    char script[LINES_MAX * LINE_MAX_], expected[LINES_MAX * LINE_MAX_], got[LINES_MAX * LINE_MAX_];
};

static int find(const struct replay *r, const char *name, size_t length) {
    for (int i = 0; i < r->count; i++)
        if (strlen(r->names[i]) == length && strncmp(r->names[i], name, length) == 0) return i;
    fail_msg("no button is called %.*s", (int)length, name);
    return -1;
}

static void add_button(struct replay *r, char *words) {
    const char *name = strtok(words, " "), *bound = strtok(NULL, " "), *chord = strtok(NULL, " ");
    struct gn_gesture_opts *opts = &r->opts[r->count];
    snprintf(r->names[r->count++], sizeof r->names[0], "%s", name);
    for (int i = 0; i < GN_GESTURE_COUNT; i++)
        if (strstr(bound, gn_gesture_names[i])) opts->gestures |= 1u << i;
    for (const char *at = chord ? chord + strlen("chord=") : ""; *at;) {
        const size_t length = strcspn(at, "+");
        opts->chord |= UINT32_C(1) << find(r, at, length);
        at += length + (at[length] == '+');
    }
}

/* Reading a level is told from an edge by the name that the script has: "=NAME". */
static void add_line(struct replay *r, char *line) {
    char *read = strstr(line, "read-");
    if (strncmp(line, "button ", 7) == 0) {
        add_button(r, line + 7);
    } else if (line[0] == '>') {
        strcat(strcat(r->expected, line + 2), "\n");
    } else if (read) {
        char *name = strchr(read, ' ');
        *name = '\0';
        sprintf(r->script + strlen(r->script), "%.*s%s =%s\n", (int)(read - line), line, read + 5,
                name + 1);
    } else {
        strcat(strcat(r->script, line), "\n");
    }
}

static void collect(struct replay *r, struct gn_gestures *g) {
    struct gn_gesture_event event;
    struct gn_gesture_note note;
    while (gn_gestures_next(g, &event))
        sprintf(r->got + strlen(r->got), "%.3f %s %s\n", (double)event.time_ns / 1e9,
                gn_gesture_names[event.gesture], r->names[event.button]);
    while (gn_gestures_note(g, &note))
        sprintf(r->got + strlen(r->got), "%s %s\n",
                note.kind == GN_NOTE_STUCK   ? "stuck"
                : note.kind == GN_NOTE_NOISY ? "noisy"
                                             : "fast",
                r->names[note.button]);
}

static void sleep_until(struct replay *r, struct gn_gestures *g, int64_t until_ns) {
    for (int64_t due_ns; (due_ns = gn_gestures_deadline(g)) <= until_ns;) {
        gn_gestures_step(g, due_ns);
        collect(r, g);
    }
}

static void play(struct replay *r, const char *path) {
    static struct gn_gestures g;
    struct gn_arena arena = {0};
    struct gn_script script;
    struct gn_err err = {0};
    if (!gn_script_parse(r->script, strlen(r->script), path, &arena, &script, &err))
        fail_msg("%s", err.text);
    gn_gestures_init(&g, r->opts, r->count, 0);
    for (int i = 0; i < script.count; i++) {
        const struct gn_script_line *line = &script.lines[i];
        const bool read = line->name[0] == '=';
        sleep_until(r, &g, line->time_ns);
        const int button = find(r, line->name + read, strlen(line->name + read));
        if (read)
            gn_gestures_level(&g, button, line->what == GN_SCRIPT_DOWN, line->time_ns);
        else
            gn_gestures_edge(&g, button, line->what == GN_SCRIPT_DOWN, line->time_ns);
    }
    sleep_until(r, &g, INT64_C(1000000000000));
    gn_arena_finish(&arena);
    if (strcmp(r->got, r->expected) != 0)
        fail_msg("%s\nhad to be:\n%sbut was:\n%s", path, r->expected, r->got);
}

static void test_every_replay_ends_as_it_says(void **state) {
    (void)state;
    glob_t found;
    assert_int_equal(glob("tests/replay/*.txt", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        static struct replay replay;
        struct gn_bytes file;
        struct gn_err err = {0};
        memset(&replay, 0, sizeof replay);
        if (!gn_file_read(found.gl_pathv[i], 8000, &file, &err)) fail_msg("%s", err.text);
        char *rest = (char *)file.data;
        for (char *line; (line = strsep(&rest, "\n"));)
            if (*line && *line != '#') add_line(&replay, line);
        play(&replay, found.gl_pathv[i]);
        gn_bytes_finish(&file);
    }
    assert_true(found.gl_pathc >= 5);
    globfree(&found);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_replay_ends_as_it_says)};
    return RUN(tests);
}
