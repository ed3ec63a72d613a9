#include "options/lesson.h"

#include <stdio.h>
#include <string.h>

#include "core/text.h"
#include "options/file.h"

const struct gn_figure_row gn_figures[GN_FIGURE_COUNT] = {
    [GN_FIGURE_NONE] = {"", "", ""},
    [GN_FIGURE_DARKENING] = {"darkening", "%", "mean darkening of safely lit pixels"},
    [GN_FIGURE_GAP] = {"gap", "texels", "mean gap between a contact and its shadow"},
    [GN_FIGURE_LEAK] = {"leak", "%", "dark pixels, away from edges, that are shown lit"},
    [GN_FIGURE_GLOW] = {"glow", "%", "most light in a safely dark pixel"},
    [GN_FIGURE_WRONG] = {"wrong", "%", "pixels that are lit instead of dark, or the reverse"},
    [GN_FIGURE_PENUMBRA] = {"penumbra", "", "root mean square error in penumbrae"},
};

const struct gn_lesson gn_lessons[] = {
#define LESSON(...) {__VA_ARGS__},
#define FAULT(figure, name, set)                                                                   \
    { name, set, GN_FIGURE_##figure }
#define CURE(name, set)                                                                            \
    { name, set, GN_FIGURE_NONE }
#include "options/lesson_rows.h"
};
const int gn_lesson_count = sizeof gn_lessons / sizeof gn_lessons[0];

int gn_lesson_steps(const struct gn_lesson *lesson) {
    int count = 0;
    while (count < GN_LESSON_STEPS_MAX && lesson->steps[count].name) count++;
    return count;
}

unsigned gn_lesson_figures(const struct gn_lesson *lesson) {
    unsigned figures = 0;
    for (int i = 0; i < gn_lesson_steps(lesson); i++) figures |= 1u << lesson->steps[i].fault;
    return figures & ~(1u << GN_FIGURE_NONE);
}

const struct gn_lesson *gn_lesson_find(const char *name, struct gn_err *err) {
    struct gn_text_guess guess = {0};
    for (int i = 0; i < gn_lesson_count; i++) {
        if (strcmp(name, gn_lessons[i].name) == 0) return &gn_lessons[i];
        gn_text_guess(&guess, name, gn_lessons[i].name);
    }
    if (guess.name)
        gn_fail_usage(err, "there is no lesson \"%.80s\"; did you mean %s?", name, guess.name);
    else
        gn_fail_usage(err, "there is no lesson \"%.80s\"; gnomon lesson list prints their names",
                      name);
    return NULL;
}

static void add_flags(const char *set, char *out, size_t size) {
    while (set && *set) {
        const size_t line = strcspn(set, "\n"), key = strcspn(set, " =");
        const char *value = set + key + strspn(set + key, " =");
        char *flag = out + strlen(out);
        gn_text_add(out, size, " --%.*s %.*s", (int)key, set, (int)(set + line - value), value);
        for (size_t i = 0; i <= key + 2 && flag[i]; i++)
            if (flag[i] == '_') flag[i] = '-';
        set += line + (set[line] == '\n');
    }
}

void gn_lesson_flags(const struct gn_lesson *lesson, int step, char *out, size_t size) {
    out[0] = '\0';
    add_flags(lesson->set, out, size);
    add_flags(lesson->steps[step].set, out, size);
}

bool gn_lesson_load(struct gn_options *options, const struct gn_lesson *lesson,
                    struct gn_err *err) {
    char text[4000], name[80];
    const char *set = lesson->set;
    snprintf(text, sizeof text,
             "[kiosk]\ncaption_seconds = 6\n[scene]\nfile = " GN_SCENE_LESSON "%s\n[render]\n%s\n",
             lesson->scene, set ? set : "");
    for (int i = 0; i < gn_lesson_steps(lesson); i++) {
        set = lesson->steps[i].set;
        gn_text_add(text, sizeof text, "[mode \"%s\"]\n%s\n", lesson->steps[i].name,
                    set ? set : "");
    }
    options->is_lesson = true;
    snprintf(name, sizeof name, "lesson %s", lesson->name);
    return gn_config_load_text(options, name, text, strlen(text), err);
}
