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
        cmocka_unit_test(long_texts_are_safe),
        cmocka_unit_test(embedded_files_are_found_and_end_with_zero),
    };
    return RUN(tests);
}
