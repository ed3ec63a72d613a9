#include <string.h>

#include "core/embedded.h"
#include "kiosk/private.h"
#include "options/args.h"
#include "options/lesson.h"
#include "unit/options_help.h"

static bool parse(char *name) {
    static char *argv[] = {"gnomon", "lesson", NULL, NULL};
    argv[2] = name;
    gn_options_finish(&options);
    err = (struct gn_err){0};
    return gn_args_parse(&options, 3, argv, &warnings, &err);
}

/* They stand on a page of HTML as they are, and steps are names of modes in a configuration. */
static void assert_plain(const char *text) {
    assert_non_null(text);
    assert_null(strpbrk(text, "<>&\"]\n"));
}

static void every_lesson_has_a_mode_for_each_step(void **state) {
    (void)state;
    for (int i = 0; i < gn_lesson_count; i++) {
        const struct gn_lesson *lesson = &gn_lessons[i];
        if (!parse((char *)lesson->name)) fail_msg("%s: %s", lesson->name, err.text);
        assert_int_equal(options.mode_count, gn_lesson_steps(lesson));
        assert_true(options.is_lesson);
        for (int k = 0; k < options.mode_count; k++)
            assert_string_equal(options.modes[k].name, lesson->steps[k].name);
        assert_string_equal(options.settings->scene.path + strlen(GN_SCENE_LESSON), lesson->scene);
    }
}

static void every_lesson_has_a_scene_inside(void **state) {
    (void)state;
    for (int i = 0; i < gn_lesson_count; i++) {
        char name[80];
        snprintf(name, sizeof name, "lessons/%s.glb", gn_lessons[i].scene);
        if (!gn_embedded_find(name)) fail_msg("no %s", name);
    }
}

static void every_lesson_shows_a_fault_and_last_its_cure(void **state) {
    (void)state;
    for (int i = 0; i < gn_lesson_count; i++) {
        const struct gn_lesson *lesson = &gn_lessons[i];
        assert_true(gn_lesson_figures(lesson));
        assert_int_equal(lesson->steps[gn_lesson_steps(lesson) - 1].fault, GN_FIGURE_NONE);
    }
}

static void texts_need_no_escapes(void **state) {
    (void)state;
    for (int i = 0; i < gn_lesson_count; i++) {
        const struct gn_lesson *lesson = &gn_lessons[i];
        assert_plain(lesson->name);
        assert_plain(lesson->title);
        assert_plain(lesson->teaches);
        for (int k = 0; k < gn_lesson_steps(lesson); k++) assert_plain(lesson->steps[k].name);
    }
}

/* It parses the arguments again, at its start and with each reload. */
static void a_kiosk_reads_the_lesson_itself(void **state) {
    (void)state;
    assert_true(parse("acne"));
    struct gn_options *again = gn_show_read_options(&options, NULL, &err);
    assert_non_null(again);
    assert_int_equal(again->settings->run.command, GN_COMMAND_SHOW);
    assert_int_equal(again->mode_count, options.mode_count);
    assert_string_equal(again->settings->mode, options.modes[0].name);
    assert_string_equal(again->settings->scene.path, "lesson:solids");
    gn_show_drop_options(again);
}

static void names_are_unique(void **state) {
    (void)state;
    for (int i = 0; i < gn_lesson_count; i++)
        assert_ptr_equal(gn_lesson_find(gn_lessons[i].name, &err), &gn_lessons[i]);
}

static void an_unknown_lesson_is_refused_with_what_to_do(void **state) {
    (void)state;
    assert_false(parse("positon"));
    assert_string_equal(err.text, "there is no lesson \"positon\"; did you mean position?");
    assert_int_equal(err.status, GN_EXIT_USAGE);
    assert_false(parse("nothing-like-it"));
    assert_non_null(strstr(err.text, "gnomon lesson list"));
    assert_true(parse("list"));
    assert_true(parse("all"));
}

static void steps_are_written_as_flags(void **state) {
    (void)state;
    static const struct gn_lesson lesson = {
        .set = "map = 256\nshadow = hard",
        .steps = {{.name = "a", .set = "map_format = r16f-raw\nbias = 0"}, {.name = "b"}}};
    char flags[200];
    gn_lesson_flags(&lesson, 0, flags, sizeof flags);
    assert_string_equal(flags, " --map 256 --shadow hard --map-format r16f-raw --bias 0");
    gn_lesson_flags(&lesson, 1, flags, sizeof flags);
    assert_string_equal(flags, " --map 256 --shadow hard");
    gn_lesson_flags(&lesson, 0, flags, 12);
    assert_string_equal(flags, " --map 256 ");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(every_lesson_has_a_mode_for_each_step, clean),
        cmocka_unit_test(every_lesson_has_a_scene_inside),
        cmocka_unit_test(every_lesson_shows_a_fault_and_last_its_cure),
        cmocka_unit_test(texts_need_no_escapes),
        cmocka_unit_test_teardown(a_kiosk_reads_the_lesson_itself, clean),
        cmocka_unit_test(names_are_unique),
        cmocka_unit_test_teardown(an_unknown_lesson_is_refused_with_what_to_do, clean),
        cmocka_unit_test(steps_are_written_as_flags),
    };
    return cmocka_run_group_tests(tests, without_home, NULL);
}
