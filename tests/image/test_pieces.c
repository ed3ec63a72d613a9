/* A frame that takes long is drawn in pieces: the same picture; requests are answered and the
 * watchdog is fed meanwhile. By counts of pieces, since a busy machine has no time of its own. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/clock.h"
#include "gl/private.h"
#include "kiosk/private.h"
#include "unit/control_help.h"
#include "unit/folder.h"
#include "unit/gltf_maker.h"
#include "unit/show_help.h"

enum { LAYERS = 90, WIDTH = 1280, HEIGHT = 720, PIXELS = WIDTH * HEIGHT, FEWEST = 4 };

static char folder[] = "/tmp/gnomon-pieces-XXXXXX", scene[80], ctl[80];

/* Blended squares on one another, as instances or as triangles of one mesh. */
static void write_scene(bool of_one_mesh) {
    struct gn_maker maker;
    struct gn_err err = {0};
    char json[200];
    float at[LAYERS][3] = {{0}};
    uint16_t squares[LAYERS][6];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    for (int i = 0; i < LAYERS; i++) {
        at[i][1] = 0.01f * (float)i;
        memcpy(squares[i], (const uint16_t[]){0, 2, 1, 0, 3, 2}, sizeof squares[i]);
    }
    const int where = gn_maker_accessor(&maker, "VEC3", 5126, LAYERS, at, sizeof at, NULL),
              many = gn_maker_accessor(&maker, "SCALAR", 5123, 6 * LAYERS, squares, sizeof squares,
                                       NULL);
    gn_maker_set(&maker, "materials",
                 "[{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.02]}}]");
    snprintf(json, sizeof json,
             "[{'primitives':[{'attributes':{'POSITION':0},'indices':%d,'material':0}]}]",
             of_one_mesh ? many : 1);
    gn_maker_set(&maker, "meshes", json);
    snprintf(json, sizeof json,
             "[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':%d}}}"
             "}]",
             where);
    gn_maker_set(&maker, "nodes", of_one_mesh ? "[{'mesh':0}]" : json);
    gn_maker_add(&maker, "nodes",
                 "{'camera':0,'translation':[0,2,0],'rotation':[-0.70710678,0,0,0.70710678]}");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':1,'ymag':1,'znear':0.01,"
                 "'zfar':9}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    if (!gn_maker_write(&maker, scene, &err)) fail_msg("%s", err.text);
    gn_maker_finish(&maker);
}

static struct gn_show *open_show(bool of_one_mesh) {
    write_scene(of_one_mesh);
    return help_show((const char *const[]){"--size", "1280x720", "--turntable", "30", "--socket",
                                           ctl, scene, NULL});
}

/* ---- the picture ----------------------------------------------------------------------------- */

static struct pauses {
    uint64_t calls, pieces, most; /* most: pieces until the frame is ended; 0: it is not */
} pauses;

static bool count_pause(void *user, uint64_t pieces, int64_t run_ns, struct gn_err *err) {
    assert_true(run_ns >= 0);
    struct pauses *p = user;
    p->calls++;
    p->pieces = pieces;
    return p->most == 0 || pieces < p->most || gn_fail(err, "given up");
}

static void draw_again(struct gn_show *show, uint8_t *out) {
    struct gn_stage *stage = &show->screen.stage;
    struct gn_err err = {0};
    if (!gn_view_draw(&stage->shown, stage, 0, show->warnings, &err)) fail_msg("%s", err.text);
    help_show_picture(show, out);
}

static void pieces_make_the_same_picture(void **state) {
    (void)state;
    static uint8_t whole[4 * PIXELS], pieces[4 * PIXELS];
    for (int of_one_mesh = 0; of_one_mesh < 2; of_one_mesh++) {
        struct gn_show *show = open_show(of_one_mesh);
        struct gn_err err = {0};
        help_show_frames(show, 1);
        struct gn_gl *gl = show->screen.stage.gl;
        gn_gl_set_pause(gl, NULL, NULL);
        draw_again(show, whole);
        pauses = (struct pauses){0};
        gn_gl_set_pause(gl, count_pause, &pauses);
        gl->pieces.of = NULL; /* as of a new scene */
        gl->pieces.done = 0;
        draw_again(show, pieces);
        assert_memory_equal(whole, pieces, sizeof whole);
        print_message("%u pieces, %u pauses\n", (unsigned)pauses.pieces, (unsigned)pauses.calls);
        assert_true(pauses.pieces >= FEWEST && pauses.calls >= pauses.pieces);
        /* ended, and drawn again */
        gl->pieces.of = NULL;
        pauses.most = pauses.pieces + 2;
        assert_null(
            gn_view_draw(&show->screen.stage.shown, &show->screen.stage, 0, show->warnings, &err));
        assert_string_equal(err.text, "given up");
        pauses.most = 0;
        draw_again(show, pieces);
        assert_memory_equal(whole, pieces, sizeof whole);
        gn_show_close(show);
    }
}

/* Pieces grow until a frame that is short has none. */
static void a_short_frame_is_whole(void **state) {
    (void)state;
    static uint8_t out[4 * PIXELS];
    struct gn_show *show = open_show(false);
    help_show_frames(show, 1);
    struct gn_gl *gl = show->screen.stage.gl;
    pauses = (struct pauses){0};
    gn_gl_set_pause(gl, count_pause, &pauses);
    for (int k = 0; k < GN_GL_PACES; k++) gl->pieces.most_px[k] = 1e9; /* as on a fast GPU */
    draw_again(show, out);
    assert_int_equal(pauses.calls, 0);
    for (int i = 0; i < 3; i++) gn_gl_frame_was_long(gl); /* but it was not */
    draw_again(show, out);
    assert_true(pauses.calls > 0);
    gn_show_close(show);
}

/* Each program that a frame lacks is a piece: at a start all are lacking. */
static void making_programs_is_in_pieces(void **state) {
    (void)state;
    struct gn_show *show =
        help_show((const char *const[]){"--size", "64x64", "build/selftest/box.glb", NULL});
    struct gn_stage *stage = &show->screen.stage;
    struct gn_err err = {0};
    help_show_frames(show, 1);
    struct gn_gl *gl = stage->gl;
    for (int k = 0; k < GN_GL_PACES; k++) gl->pieces.most_px[k] = 1e9;
    pauses = (struct pauses){0};
    gn_gl_set_pause(gl, count_pause, &pauses);
    for (int aov = GN_AOV_DISTANCE; aov <= GN_AOV_NORMAL; aov++) {
        const uint64_t made = gl->programs.made, calls = pauses.calls;
        stage->shown.opts.debug.aov = (enum gn_aov)aov;
        assert_non_null(gn_view_draw(&stage->shown, stage, 0, show->warnings, &err));
        assert_true(gl->programs.made > made);
        assert_true(pauses.calls - calls >= gl->programs.made - made);
    }
    /* ended, and made again */
    pauses.most = pauses.pieces + 1;
    stage->shown.opts.debug.aov = GN_AOV_VISIBILITY;
    assert_null(gn_view_draw(&stage->shown, stage, 0, show->warnings, &err));
    assert_string_equal(err.text, "given up");
    pauses.most = 0;
    assert_non_null(gn_view_draw(&stage->shown, stage, 0, show->warnings, &err));
    gn_show_close(show);
}

/* ---- the kiosk ------------------------------------------------------------------------------- */

static int count_replies(int fd) {
    static char text[65536];
    int lines = 0;
    for (ssize_t n; (n = recv(fd, text, sizeof text, 0)) > 0;)
        for (ssize_t i = 0; i < n; i++) lines += text[i] == '\n';
    return lines;
}

/* A step answers one request of a client, and one more in each pause of its frame. */
static void requests_are_answered_while_a_frame_is_drawn(void **state) {
    (void)state;
    struct gn_show *show = open_show(false);
    help_show_frames(show, 1);
    const int fd = connect_to(ctl);
    int most = 0;
    assert_true(fd >= 0);
    for (int i = 0; i < 20; i++) say(fd, "{\"cmd\":\"status\"}\n");
    for (int i = 0; i < 20 && most < 3; i++) {
        show->screen.stage.gl->pieces.of = NULL;
        help_show_step(show);
        const int replies = count_replies(fd);
        if (replies > most) most = replies;
    }
    close(fd);
    gn_show_close(show);
    assert_true(most >= 3);
}

static void draw_long_frame(struct gn_show *show) {
    struct gn_err err = {0};
    show->screen.stage.gl->pieces.of = NULL;
    while (!show->screen.stage.display.screen.may_draw) {
        usleep(1000);
        assert_true(gn_show_take_events(&show->screen, &err));
    }
    assert_true(gn_show_frame(&show->screen, &err));
    assert_string_equal(err.text, "");
}

static void change(void *user, int64_t now_ns) {
    struct gn_show_screen *screen = user;
    (void)now_ns;
    assert_true(screen->pauses);
    screen->changed = true;
}

/* What changes in a pause is drawn next; what is dropped in one may be what is being drawn, and
 * goes after that frame; an end that is asked for in one is no failure. */
static void a_pause_leaves_the_frame_alone(void **state) {
    (void)state;
    struct gn_show *show = open_show(false);
    struct gn_show_screen *screen = &show->screen;
    struct gn_timer timer = {.due_ns = 0, .call = change, .user = screen};
    help_show_frames(show, 1);
    for (int changes = 0; changes < 2; changes++) {
        if (changes) gn_loop_add_timer(show->loop, &timer);
        draw_long_frame(show);
        assert_int_equal(screen->changed, changes);
    }
    screen->staged.loaded = gn_xalloc(1, sizeof *screen->staged.loaded);
    screen->staged.loaded->number = screen->scene;
    screen->pauses = true;
    gn_show_drop_staged(screen);
    screen->pauses = false;
    assert_non_null(screen->staged.loaded);
    gn_show_advance(screen);
    assert_null(screen->staged.loaded);
    show->ends = true;
    const uint64_t before = show->counts.frames;
    draw_long_frame(show);
    assert_int_equal(show->counts.frames, before);
    gn_show_close(show);
}

static int begin(void **state) {
    (void)state;
    if (!mkdtemp(folder)) return -1;
    snprintf(scene, sizeof scene, "%s/heavy.glb", folder);
    snprintf(ctl, sizeof ctl, "%s/ctl", folder);
    return 0;
}

static int end(void **state) {
    (void)state;
    return gn_test_remove_folder(folder);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_make_the_same_picture),
        cmocka_unit_test(a_short_frame_is_whole),
        cmocka_unit_test(making_programs_is_in_pieces),
        cmocka_unit_test(requests_are_answered_while_a_frame_is_drawn),
        cmocka_unit_test(a_pause_leaves_the_frame_alone),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
