#include "input/play.h"

#include <string.h>

#include "core/file.h"
#include "input/private.h"
#include "input/script.h"

enum { SCRIPT_BYTES = 1 << 20 };

/* Inserts after all steps that are not later: keeps the order of equal times. */
static void insert_step(struct gn_play *play, struct gn_play_step step) {
    int at = play->count++;
    for (; at > 0 && play->steps[at - 1].time_ns > step.time_ns; at--)
        play->steps[at] = play->steps[at - 1];
    play->steps[at] = step;
}

bool gn_play_load(struct gn_play *play, const char *path, const char *const *names, int count,
                  int64_t now_ns, struct gn_err *err) {
    struct gn_bytes file = {0};
    struct gn_script script;
    if (!gn_file_read(path, SCRIPT_BYTES, &file, err)) return false;
    bool ok = gn_script_parse((const char *)file.data, file.size, path, &play->arena, &script, err);
    gn_bytes_finish(&file);
    if (!ok) return false;
    play->steps = gn_arena_alloc(&play->arena, 2 * (size_t)script.count, sizeof *play->steps);
    if (!play->steps) return gn_fail(err, "%s: out of memory for its lines", path);
    for (int i = 0; i < script.count; i++) {
        const struct gn_script_line *line = &script.lines[i];
        struct gn_play_step step = {.time_ns = now_ns + line->time_ns, .button = -1};
        for (int k = 0; k < count && step.button < 0; k++)
            if (strcmp(names[k], line->name) == 0) step.button = k;
        if (step.button < 0) step.key = gn_key_find(line->name);
        if (step.button < 0 && step.key == GN_KEY_NONE)
            return gn_fail_usage(err, "%s:%d: unknown button or key \"%s\"", path, line->number,
                                 line->name);
        if (step.button >= 0) play->buttons |= UINT32_C(1) << step.button;
        step.down = line->what != GN_SCRIPT_UP;
        insert_step(play, step);
        if (line->what != GN_SCRIPT_CLICK) continue;
        step.down = false;
        if (step.button >= 0) step.time_ns += GN_SCRIPT_CLICK_NS;
        insert_step(play, step);
    }
    return true;
}

/* ---- the source ---- */

static void step_script(struct gn_input *input, int64_t now_ns) {
    struct gn_play *play = &input->play;
    for (; play->next < play->count && play->steps[play->next].time_ns <= now_ns; play->next++) {
        const struct gn_play_step *step = &play->steps[play->next];
        if (step->button >= 0)
            gn_gestures_edge(&input->gestures, step->button, step->down, step->time_ns);
        else
            gn_keys_set(&input->keys, &play->source, step->key, step->down, step->time_ns);
    }
}

static int64_t script_deadline(const struct gn_input *input) {
    const struct gn_play *play = &input->play;
    return play->next < play->count ? play->steps[play->next].time_ns : INT64_MAX;
}

static void close_script(struct gn_input *input) { gn_arena_finish(&input->play.arena); }

const struct gn_input_source gn_source_script = {
    .step = step_script,
    .deadline = script_deadline,
    .close = close_script,
};
