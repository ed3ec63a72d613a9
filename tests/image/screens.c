#include "image/screens.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"
#include "image/read.h"
#include "kiosk/private.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

enum { VERTICES = 1500000, FRAMES_MAX = 200 }; /* of what loads; until texts stand */

const char *const screen_names[SCREEN_STATES] = {
    [SCREEN_NORMAL] = "normal",
    [SCREEN_MODE] = "mode",
    [SCREEN_INFORMATION] = "information",
    [SCREEN_HELP] = "help",
    [SCREEN_SPLIT] = "split",
    [SCREEN_SPLIT_HELP] = "split-help",
    [SCREEN_TRUTH] = "truth",
    [SCREEN_PROBLEM] = "problem",
    [SCREEN_PROBLEM_INFORMATION] = "problem-information",
    [SCREEN_LOADING] = "loading",
    [SCREEN_DARK] = "dark",
    [SCREEN_NO_CARD] = "no-card",
    [SCREEN_NO_MONITOR] = "no-monitor",
    [SCREEN_WRONG_KEY] = "wrong-key",
    [SCREEN_WRONG_FILE] = "wrong-file",
    [SCREEN_NO_SCENE] = "no-scene",
    [SCREEN_STICK_TAKEN] = "stick-taken",
    [SCREEN_STICK_REFUSED] = "stick-refused",
};

static const struct screen_opts *opts;
static void (*take_picture)(const struct screen_shown *shown);
static const char *folder;
static char config_path[100], content[120];
static struct gn_show *show;

/* ---- a kiosk -------------------------------------------------------------------------------- */

/* Beside the modes of the folder's kiosk.ini; captions stand as long as a slow machine draws. */
static const char modes[] = "caption_seconds = 60\n"
                            "[mode \"Soft shadows\"]\nshadow = pcf\n"
                            "[mode \"Sharp shadows\"]\nshadow = hard\n"
                            "[mode \"The long hall\"]\nfile = hall.gltf\n";

static void write_config(const char *path, const char *scene, const char *more) {
    char text[900], *real = realpath(scene, NULL);
    snprintf(text, sizeof text, "[scene]\nfile = %s\n%s[kiosk]\nscreenshots = %s\n%s",
             real ? real : scene, more, folder, modes);
    help_write(folder, path, text);
    free(real);
}

static void open_show(const char *scene, const char *more, const char *stick) {
    const char *args[] = {"--size",    opts->size,       "--rotate", opts->rotate, "-c",
                          config_path, "--no-animation", stick,      NULL};
    write_config("kiosk.ini", scene, more);
    show = help_show(args);
}

static void close_show(void) {
    gn_show_close(show);
    show = NULL;
}

/* Does not wait for anything longer than a frame takes. */
static void step(void) {
    static const uint64_t one = 1;
    show->screen.changed = true;
    assert_int_equal(write(gn_loader_fd(show->scenes.loader), &one, sizeof one), sizeof one);
    help_show_step(show);
}

static bool all_stand(const struct gn_caption_run *run) {
    for (int i = 0; run && i < GN_CAPTION_KIND_COUNT; i++)
        if (run->alpha[i] > 0 && run->alpha[i] < 1) return false;
    return true;
}

static void draw_frame(void) {
    show->screen.changed = true;
    help_show_frames(show, 1);
}

/* Until nothing rises or falls any more; in its first frame what falls is still whole. */
static void draw(void) {
    draw_frame();
    draw_frame();
    for (int i = 0; i < FRAMES_MAX && !all_stand(show->screen.stage.shown.opts.cover.captions); i++)
        draw_frame();
}

static void press(char letter) {
    static const struct gn_key_event no_key = {.down = true};
    struct gn_pointer pointer = {0};
    gn_pointer_key(&pointer, &no_key);
    gn_pointer_letter(&pointer, (unsigned char)letter);
    gn_viewer_take_keys(&show->screen, &pointer);
}

/* ---- pictures ------------------------------------------------------------------------------- */

static size_t turned_index(const struct gn_frame_opts *f, uint32_t u, uint32_t v) {
    const uint32_t w = f->output.width_px, h = f->output.height_px;
    switch (f->output.turn_deg) {
    case 90: return (size_t)u * w + (w - 1 - v);
    case 180: return (size_t)(h - 1 - v) * w + (w - 1 - u);
    case 270: return (size_t)(h - 1 - u) * w + v;
    default: return (size_t)v * w + u;
    }
}

static void find_texts(struct screen_shown *shown) {
    struct gn_show_text *t = &show->screen.text;
    shown->texts[GN_CAPTION_INFO] = show->screen.viewer.helps ? t->help : t->page.text;
    shown->texts[GN_CAPTION_CARD] = t->card;
    if (show->screen.drawn.caption == GN_KIOSK_CAPTION_MODE)
        shown->texts[GN_CAPTION_MODE] = t->change;
    if (show->screen.drawn.caption == GN_KIOSK_CAPTION_NOTE)
        shown->texts[GN_CAPTION_MODE] = show->screen.viewer.note;
}

/* The frame that was drawn last. */
static void take_frame(enum screen_state state) {
    const struct gn_frame_opts *f = &show->screen.stage.shown.opts;
    const bool on_side = f->output.turn_deg % 180 != 0;
    const size_t pixels = (size_t)f->output.width_px * f->output.height_px;
    uint32_t *stored = malloc(4 * pixels), *upright = malloc(4 * pixels);
    struct screen_shown shown = {
        .state = state,
        .width_px = on_side ? f->output.height_px : f->output.width_px,
        .height_px = on_side ? f->output.width_px : f->output.height_px,
        .rgba = (uint8_t *)upright,
        .run = f->cover.captions,
    };
    assert_true(stored && upright);
    help_show_picture(show, (uint8_t *)stored);
    for (uint32_t v = 0, at = 0; v < shown.height_px; v++)
        for (uint32_t u = 0; u < shown.width_px; u++) upright[at++] = stored[turned_index(f, u, v)];
    find_texts(&shown);
    take_picture(&shown);
    free(stored);
    free(upright);
}

static void take_answer(void *self, const struct gn_request *request, json_t *reply) {
    (void)request;
    assert_true(json_is_object(reply) && !json_object_get(reply, "error"));
    *(bool *)self = true;
    json_decref(reply);
}

/* What `gnomon ctl screenshot` writes: of a dark screen the reason. */
static void take_dark(enum screen_state state, const char *status) {
    struct gn_screen *screen = &show->screen.stage.display.screen;
    bool done = false;
    const struct gn_transport transport = {.self = &done, .answer = take_answer};
    struct gn_request request = {.command = GN_CTL_SCREENSHOT, .fd = -1};
    struct gn_bytes png;
    uint32_t px[2];
    struct gn_err err = {0};
    snprintf(request.text, sizeof request.text, "%s/dark.png", folder);
    request.words[0] = request.text;
    screen->lit &= !status;
    snprintf(screen->status, sizeof screen->status, "%s", status ? status : "");
    gn_show_take_request(show, &transport, &request);
    while (!done) step();
    screen->status[0] = 0;
    if (!gn_file_read(request.text, SIZE_MAX, &png, &err) ||
        !gn_png_size(png.data, png.size, px, &err))
        fail_msg("%s", err.text);
    uint8_t *rgba = malloc((size_t)4 * px[0] * px[1]);
    assert_non_null(rgba);
    if (!gn_png_read(png.data, png.size, px, 0, rgba, &err)) fail_msg("%s", err.text);
    take_picture(&(struct screen_shown){
        .state = state, .width_px = px[0], .height_px = px[1], .rgba = rgba});
    free(rgba);
    gn_bytes_finish(&png);
}

/* ---- states --------------------------------------------------------------------------------- */

static void act(enum gn_action_kind kind, const char *name) {
    const struct gn_action action = {.kind = kind, .name = name};
    gn_show_act(&show->screen, &action, gn_loop_now_ns(show->loop));
    show->screen.changed = true;
}

static void take_pages(void) {
    help_show_until_warm(show);
    draw();
    take_frame(SCREEN_NORMAL);
    act(GN_ACTION_NEXT, NULL);
    while (gn_kiosk_waits(&show->screen.kiosk)) step();
    draw();
    take_frame(SCREEN_MODE);
    act(GN_ACTION_INFO, NULL);
    draw();
    take_frame(SCREEN_INFORMATION);
    act(GN_ACTION_INFO, NULL);
    press('h');
    draw();
    take_frame(SCREEN_HELP);
    press('h');
    act(GN_ACTION_PREV, NULL);
    while (gn_kiosk_waits(&show->screen.kiosk)) step();
}

static void take_halves(void) {
    press('x');
    while (gn_kiosk_waits(&show->screen.kiosk)) step();
    draw();
    take_frame(SCREEN_SPLIT);
    press('h');
    draw();
    take_frame(SCREEN_SPLIT_HELP);
    press('h');
    draw();
    press('t');
    draw();
    while (opts->traces && show->screen.truth.on && !show->screen.truth.shown) step();
    draw();
    take_frame(SCREEN_TRUTH);
    press('t');
    press('x');
}

static void take_problems(void) {
    act(GN_ACTION_MODE, "The long hall");
    while (!gn_problem_last(&show->problems)) step();
    draw();
    take_frame(SCREEN_PROBLEM);
}

static void take_loading(void) {
    char path[120];
    help_write_huge(folder, VERTICES);
    snprintf(path, sizeof path, "%s/huge.gltf", folder);
    gn_show_load_file(show, path);
    while (show->wants_reload || (show->reload.options && show->screen.text.bar < 0)) step();
    if (show->screen.text.bar >= 0) take_frame(SCREEN_LOADING);
}

static void take_darkness(void) {
    act(GN_ACTION_BLANK, NULL);
    step();
    take_dark(SCREEN_DARK, NULL);
    act(GN_ACTION_BLANK, NULL);
    step();
    take_dark(SCREEN_NO_CARD, "waiting for a card");
    take_dark(SCREEN_NO_MONITOR, "waiting for a monitor on HDMI-A-1");
}

static void take_start(enum screen_state state, const char *scene, const char *more) {
    open_show(scene, more, NULL);
    draw();
    take_frame(state);
    act(GN_ACTION_INFO, NULL);
    draw();
    if (state == SCREEN_WRONG_KEY) take_frame(SCREEN_PROBLEM_INFORMATION);
    close_show();
}

/* As gnomon take leaves it. */
static void turn_link(const char *name) {
    char fresh[120], link[120];
    snprintf(fresh, sizeof fresh, "%s/fresh", folder);
    snprintf(link, sizeof link, "%s/current", folder);
    assert_int_equal(symlink(name, fresh), 0);
    assert_int_equal(rename(fresh, link), 0);
}

static void take_stick(void) {
    snprintf(content, sizeof content, "--content=%s", folder);
    write_config("first/kiosk.ini", opts->scene, "");
    write_config("taken/kiosk.ini", opts->scene, "");
    write_config("refused/kiosk.ini", opts->scene, "[render]\nshadow = sooft\n");
    turn_link("first");
    open_show(opts->scene, "", content);
    draw();
    turn_link("taken");
    const struct gn_options *before = show->config.options;
    while (show->config.options == before) step();
    draw();
    take_frame(SCREEN_STICK_TAKEN);
    turn_link("refused");
    while (!gn_problem_last(&show->problems)) step();
    draw();
    take_frame(SCREEN_STICK_REFUSED);
    close_show();
}

void screens_draw(const struct screen_opts *all, void (*take)(const struct screen_shown *shown)) {
    opts = all;
    take_picture = take;
    folder = help_folder();
    snprintf(config_path, sizeof config_path, "%s/kiosk.ini", folder);
    open_show(opts->scene, "", NULL);
    take_pages();
    take_halves();
    take_darkness();
    take_problems();
    take_loading();
    close_show();
    take_start(SCREEN_WRONG_KEY, opts->scene, "[render]\nshadw = pcf\n");
    help_write(folder, "wrong.gltf", "this is no scene");
    char path[120];
    snprintf(path, sizeof path, "%s/wrong.gltf", folder);
    take_start(SCREEN_WRONG_FILE, path, "");
    take_start(SCREEN_NO_SCENE, "/srv/exhibition/hall.glb", "");
    take_stick();
    help_remove(folder);
}
