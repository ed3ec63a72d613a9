/* What a scene of the user's own offers to the buttons, by a table of scenes. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "kiosk/offers.h"
#include "options/options.h"

enum { MANY = 40 };

/* Names are parted by commas; "" is a thing without a name. */
struct contents {
    const char *what;
    const char *cameras, *variants, *clips, *paths; /* NULL: none; of cameras and paths: one */
    int shown;
    int plain; /* the variant that looks as the file does; -1: none does */
    const char *camera, *variant;
    bool by_flag; /* these are of the command line */
    double turntable_deg_s;
    bool stands;          /* no clip plays */
    const char *expected; /* names, those of other scenes with their place behind a "@" */
    int first, home;
    bool replays;
};

static const struct contents table[] = {
    {"cameras", "Front,Top", NULL, NULL, NULL, 0, -1, .expected = "Front,Top"},
    {"cameras before variants and clips", "Front,Top", "red,blue", "Spin", NULL, 0, 0,
     .expected = "Front,Top"},
    {"cameras without a name", "Front,,", NULL, NULL, NULL, 0, -1,
     .expected = "Front,Camera 2,Camera 3"},
    {"cameras of one name", "Eye,Eye,Eye", NULL, NULL, NULL, 0, -1,
     .expected = "Eye,Eye (2),Eye (3)"},
    {"the settings' camera is shown first", "Front,Top,Side", NULL, NULL, NULL, 0, -1,
     .camera = "Top", .expected = "Front,Top,Side", .first = 1, .home = 1},
    {"a camera that is not there", "Front,Top", NULL, NULL, NULL, 0, -1, .camera = "Nose",
     .expected = "Front,Top"},
    {"a view that no camera has", "Front,Top", NULL, NULL, NULL, 0, -1, .camera = "auto",
     .expected = "a,Front,Top"},
    {"the view of a light", "Front,Top", NULL, NULL, NULL, 0, -1, .camera = "light:Sun",
     .expected = "a,Front,Top"},
    {"a camera of the command line", "Front,Top", NULL, "Spin", NULL, 0, -1, .camera = "Top",
     .by_flag = true, .expected = "Spin", .replays = true},
    {"scenes", NULL, "red,blue", "Spin", "a.glb,b.glb,x/c.d.glb", 0, 0, .expected = "a,b@1,c.d@2"},
    {"scenes, the second one shown", NULL, NULL, NULL, "a.glb,b.glb,c.glb", 1, -1,
     .expected = "b,c@2,a@0", .home = 2},
    {"cameras, then scenes", "Front,Top", NULL, NULL, "a.glb,b.glb", 1, -1,
     .expected = "Front,Top,a@0", .home = 2},
    {"cameras, then scenes, of the first one", "Front,Top", NULL, NULL, "a.glb,b.glb", 0, -1,
     .camera = "Top", .expected = "Front,Top,b@1", .first = 1, .home = 1},
    {"variants", NULL, "red,blue", "Spin", NULL, 0, 0, .expected = "red,blue"},
    {"the file is as its second variant", NULL, "red,blue", NULL, NULL, 0, 1,
     .expected = "red,blue", .first = 1, .home = 1},
    {"the file is as none of them", NULL, "red,", NULL, NULL, 0, -1, .expected = "a,red,Variant 2"},
    {"the settings' variant is shown first", NULL, "red,blue", NULL, NULL, 0, 0, .variant = "blue",
     .expected = "red,blue", .first = 1, .home = 1},
    {"a variant of the command line", NULL, "red,blue", NULL, NULL, 0, 0, .variant = "blue",
     .by_flag = true, .expected = "still,turning"},
    {"one of each", "Front", "red", "Spin", NULL, 0, 0, .expected = "Spin", .replays = true},
    {"a clip without a name", "Front", NULL, "", NULL, 0, 0, .expected = "a", .replays = true},
    {"several clips", NULL, NULL, "Spin,Nod", NULL, 0, 0, .expected = "a", .replays = true},
    {"a clip that does not play", NULL, NULL, "Spin", NULL, 0, 0, .stands = true,
     .expected = "still,turning"},
    {"nothing", NULL, NULL, NULL, NULL, 0, 0, .expected = "still,turning"},
    {"nothing, on a turntable", NULL, NULL, NULL, NULL, 0, 0, .turntable_deg_s = 9,
     .expected = "turning,still"},
    {"nothing, on a turntable of the command line", NULL, NULL, NULL, NULL, 0, 0,
     .turntable_deg_s = 9, .by_flag = true, .expected = "a"},
};

static int split_names(const char *text, const char *names[MANY], char store[400]) {
    int count = 0;
    snprintf(store, 400, "%s", text ? text : "");
    for (char *at = store; text; count++) {
        char *comma = strchr(at, ',');
        names[count] = at;
        if (!comma) return count + 1;
        *comma = '\0';
        at = comma + 1;
    }
    return count;
}

static void set_text(struct gn_options *o, const char *key, const char *text, bool by_flag) {
    struct gn_err err = {0};
    if (text)
        assert_true(gn_options_set(o, gn_option_find_key("scene", key), text,
                                   by_flag ? GN_SOURCE_FLAG : GN_SOURCE_INI, key, &err));
}

static void build_offers(const struct contents *c, struct gn_offers *out) {
    char stores[4][400], number[20];
    const char *names[4][MANY] = {{"Eye"}, {NULL}, {NULL}, {"a.glb"}};
    struct gn_camera cameras[MANY] = {0};
    struct gn_clip clips[MANY] = {0};
    struct gn_node node = {.name = ""};
    struct gn_item item = {.hidden_in = ~(c->plain < 0 ? 0 : UINT64_C(2) << c->plain)};
    struct gn_options options;
    const int camera_count = c->cameras ? split_names(c->cameras, names[0], stores[0]) : 1,
              variant_count = split_names(c->variants, names[1], stores[1]),
              clip_count = split_names(c->clips, names[2], stores[2]),
              path_count = c->paths ? split_names(c->paths, names[3], stores[3]) : 1;
    item.hidden_in &= ~UINT64_C(1);
    for (int i = 0; i < MANY; i++) {
        cameras[i].name = names[0][i];
        clips[i].name = names[2][i];
    }
    const struct gn_scene scene = {
        .cameras = cameras,
        .camera_count = (uint32_t)camera_count,
        .variants = {names[1], (uint32_t)variant_count},
        .animation = {.clips = clips, .clip_count = (uint32_t)clip_count},
        .nodes = &node,
        .node_count = 1,
        .items = &item,
        .item_count = 1};
    gn_options_init(&options, GN_COMMAND_SHOW);
    set_text(&options, "camera", c->camera, c->by_flag);
    set_text(&options, "variant", c->variant, c->by_flag);
    snprintf(number, sizeof number, "%g", c->turntable_deg_s);
    set_text(&options, "turntable", c->turntable_deg_s != 0 ? number : NULL, c->by_flag);
    gn_offers_build(&(struct gn_offers_of){.scene = &scene,
                                           .settings = options.settings,
                                           .clips = c->stands ? GN_POSE_NONE : GN_POSE_DEFAULT,
                                           .paths = names[3],
                                           .path_count = path_count,
                                           .shown = c->shown},
                    out);
    gn_options_finish(&options);
}

static void each_scene_offers_the_first_that_it_has(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        const struct contents *c = &table[i];
        struct gn_offers offers;
        char got[400] = "";
        size_t at = 0;
        build_offers(c, &offers);
        for (int k = 0; k < offers.count; k++) {
            at += (size_t)snprintf(got + at, sizeof got - at, "%s%s", k ? "," : "",
                                   offers.items[k].name);
            if (offers.items[k].scene >= 0)
                at += (size_t)snprintf(got + at, sizeof got - at, "@%d", offers.items[k].scene);
        }
        if (strcmp(got, c->expected) != 0 || offers.first != c->first || offers.home != c->home ||
            offers.replays != c->replays)
            fail_msg("%s: %s, first %d, home %d, replays %d", c->what, got, offers.first,
                     offers.home, offers.replays);
    }
}

static void an_offer_is_what_its_name_is(void **state) {
    (void)state;
    struct gn_offers offers;
    build_offers(&(struct contents){.cameras = "Front,Top", .camera = "auto"}, &offers);
    assert_int_equal(offers.items[0].camera, -1);
    assert_int_equal(offers.items[1].camera, 0);
    assert_int_equal(offers.items[2].camera, 1);
    build_offers(&(struct contents){.variants = "red,blue", .plain = -1}, &offers);
    assert_int_equal(offers.items[0].variant, -1);
    assert_int_equal(offers.items[2].variant, 1);
    build_offers(&(struct contents){0}, &offers);
    assert_false(offers.items[0].turns);
    assert_true(offers.items[1].turns);
}

/* More cameras than modes. */
static void the_list_ends_where_modes_do(void **state) {
    (void)state;
    struct gn_offers offers;
    build_offers(&(struct contents){.cameras = ",,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,"}, &offers);
    assert_int_equal(offers.count, GN_KIOSK_MODES_MAX);
    assert_string_equal(offers.items[GN_KIOSK_MODES_MAX - 1].name, "Camera 32");
}

static void an_offer_is_applied_unless_something_stronger_is_set(void **state) {
    (void)state;
    struct gn_options options;
    const struct gn_scene scene = {.camera_count = 2, .variants.count = 2};
    const struct gn_offer second = {.camera = 1, .variant = 1}, third = {.camera = 2, .variant = 2};
    gn_options_init(&options, GN_COMMAND_SHOW);
    struct gn_stage_look look = {.variant = -1, .frame_opts.view.light_plus_1 = 3};
    gn_offer_apply(&third, options.settings, &scene, &look); /* of another scene */
    assert_int_equal(look.frame_opts.view.camera, 0);
    assert_int_equal(look.variant, -1);
    gn_offer_apply(&second, options.settings, &scene, &look);
    assert_int_equal(look.frame_opts.view.camera, 1);
    assert_int_equal(look.frame_opts.view.light_plus_1, 0);
    assert_int_equal(look.variant, 1);
    look = (struct gn_stage_look){.variant = -1};
    set_text(&options, "camera", "0", true);
    set_text(&options, "variant", "auto", true);
    gn_offer_apply(&second, options.settings, &scene, &look);
    assert_int_equal(look.frame_opts.view.camera, 0);
    assert_int_equal(look.variant, -1);
    gn_options_finish(&options);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_scene_offers_the_first_that_it_has),
        cmocka_unit_test(an_offer_is_what_its_name_is),
        cmocka_unit_test(the_list_ends_where_modes_do),
        cmocka_unit_test(an_offer_is_applied_unless_something_stronger_is_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
