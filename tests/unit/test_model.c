/* Which files are models, by their names alone. */
#include "core/model.h"
#include "unit/check.h"

static void test_the_end_of_a_name_tells(void **state) {
    (void)state;
    assert_int_equal(gn_model_format_of("a.obj"), GN_MODEL_OBJ);
    assert_int_equal(gn_model_format_of("/x.y/A.B.FBX"), GN_MODEL_FBX);
    assert_int_equal(gn_model_format_of("a.obj.Stl"), GN_MODEL_STL);
    assert_int_equal(gn_model_format_of(".ply"), GN_MODEL_PLY);
    assert_int_equal(gn_model_format_of("./a.dae"), GN_MODEL_DAE);
    assert_string_equal(gn_model_formats[GN_MODEL_DAE].name, "Collada");
}

static void test_other_files_are_none(void **state) {
    static const char *const others[] = {"", "obj", "a.glb", "a.obj/b", "a.objx", "a.", "a.obj "};
    (void)state;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_int_equal(gn_model_format_of(others[i]), GN_MODEL_FORMAT_COUNT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_end_of_a_name_tells),
        cmocka_unit_test(test_other_files_are_none),
    };
    return RUN(tests);
}
