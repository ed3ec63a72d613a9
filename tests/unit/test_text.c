#include "unit/check.h"

#include "core/embedded.h"
#include "core/text.h"

#include <string.h>

static void distance_counts_edits(void **state) {
    (void)state;
    assert_int_equal(gn_text_distance("", ""), 0);
    assert_int_equal(gn_text_distance("", "abc"), 3);
    assert_int_equal(gn_text_distance("render", "rendr"), 1);
    assert_int_equal(gn_text_distance("kitten", "sitting"), 3);
    assert_int_equal(gn_text_distance("sitting", "kitten"), 3);
}

static void two_neighbours_that_changed_places_are_one_edit(void **state) {
    (void)state;
    assert_int_equal(gn_text_distance("pfc", "pcf"), 1);
    assert_int_equal(gn_text_distance("stauts", "status"), 1);
    assert_int_equal(gn_text_distance("ca", "abc"), 3); /* an edited pair is not edited again */
}

static const char *guess_of(const char *word) {
    static const char *const names[] = {"aov", "ctl", "show", "shadow", "pcf", "pcf2", "caption"};
    struct gn_text_guess guess = {0};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) gn_text_guess(&guess, word, names[i]);
    return guess.name ? guess.name : "";
}

static void a_guess_is_near(void **state) {
    (void)state;
    assert_string_equal(guess_of("pfc"), "pcf");
    assert_string_equal(guess_of("pcf"), "pcf");
    assert_string_equal(guess_of("shdaow"), "shadow");
    assert_string_equal(guess_of("captain"), "caption");
    assert_string_equal(guess_of("foo"), "");
    assert_string_equal(guess_of("help"), "");
    assert_string_equal(guess_of(""), "");
}

static void long_texts_are_safe(void **state) {
    (void)state;
    char a[4000], b[4000];
    memset(a, 'a', sizeof a);
    memset(b, 'b', sizeof b);
    a[sizeof a - 1] = b[sizeof b - 1] = '\0';
    assert_int_equal(gn_text_distance(a, b), 31);
}

static void embedded_files_are_found_and_end_with_zero(void **state) {
    (void)state;
    assert_null(gn_embedded_find("no such file"));
    int count = 0;
    for (const struct gn_embedded *e = gn_embedded_table; e->name; e++, count++) {
        assert_ptr_equal(gn_embedded_find(e->name), e);
        assert_int_equal(e->data[e->size], 0);
    }
    assert_true(count > 0);
    const struct gn_embedded *sundial = gn_embedded_find("sundial.glb");
    assert_non_null(sundial);
    assert_memory_equal(sundial->data, "glTF", 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_counts_edits),
        cmocka_unit_test(two_neighbours_that_changed_places_are_one_edit),
        cmocka_unit_test(a_guess_is_near),
        cmocka_unit_test(long_texts_are_safe),
        cmocka_unit_test(embedded_files_are_found_and_end_with_zero),
    };
    return RUN(tests);
}
