#include "scenes.h"

#include <errno.h>
#include <stdio.h>

#define WITHIN (30 * SIM_S)

/* ---- machines ---- */

static const struct sim_traits good = {.console = true},
                               rich = {.console = true, .modifiers = true, .fences = true},
                               taken = {.console = true, .rotation = true, .overlays = true},
                               old = {.console = true, .legacy = true}, dark = {0},
                               virtual = {.no_vblank = true},
                               scaling = {.console = true, .fences = true, .enlarges = 200},
                               liar = {.enlarges = 200, .enlarges_never = true},
                               alone = {.gpu_alone = true};

static void add(const struct sim_traits *traits, int monitor) {
    sim_add_card(0, "/dev/dri/card1", traits);
    sim_plug(0, 0, monitor);
}

static void build_good(void) { add(&good, SIM_FULL_HD); }
static void build_rich(void) { add(&rich, SIM_FULL_HD); }
static void build_taken(void) { add(&taken, SIM_FULL_HD); }
static void build_old(void) { add(&old, SIM_FULL_HD); }
static void build_virtual(void) { add(&virtual, SIM_FULL_HD); }
static void build_scaling(void) { add(&scaling, SIM_FULL_HD); }
static void build_liar(void) { add(&liar, SIM_FULL_HD); }
static void build_no_monitor(void) { add(&good, SIM_NO_MONITOR); }
static void build_unknown(void) { add(&good, SIM_NO_EDID); }

static void build_refused(void) {
    add(&dark, SIM_FULL_HD);
    sim_refuse_mode((struct sim_refusal){96, EINVAL, false});
}

static void build_refused_late(void) {
    add(&dark, SIM_FULL_HD);
    sim_refuse_mode((struct sim_refusal){96, ENOSPC, true});
}

static void build_copies(void) {
    add(&good, SIM_FULL_HD);
    sim_set_gpu(&(struct sim_gpu){.no_surface = {true, true, true}});
}

static void build_two_cards(void) {
    sim_add_card(0, "/dev/dri/card0", &alone);
    sim_add_card(1, "/dev/dri/card1", &good);
    sim_plug(1, 1, SIM_FULL_HD);
}

static void build_pair(void) {
    sim_add_card(0, "/dev/dri/card0", &good);
    sim_add_card(1, "/dev/dri/card1", &rich);
    sim_plug(0, 0, SIM_FULL_HD);
}

static void build_stranger(void) {
    add(&taken, SIM_FULL_HD);
    sim_stranger_takes(0);
}

/* ---- scenarios ---- */

/* client_run() with a still picture: time passes without frames. */
static void rest(struct client *c, int64_t for_ns) {
    c->moves = false;
    client_run(c, for_ns);
    c->moves = true;
}

static void plug_late(struct client *c) {
    client_run(c, 5 * SIM_S);
    sim_plug(0, 0, SIM_FULL_HD);
    client_frames(c, 3);
}

static void replug(struct client *c) {
    client_frames(c, 3);
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(c, 3 * SIM_S);
    sim_plug(0, 0, SIM_FULL_HD);
    client_frames(c, 3);
}

static void change_monitor(struct client *c) {
    client_frames(c, 3);
    sim_plug(0, 0, SIM_SMALL);
    client_run(c, SIM_S / 2);
    sim_plug(0, 0, SIM_LARGE);
    client_run(c, SIM_S / 2);
    sim_plug(0, 0, SIM_NO_MONITOR);
    sim_plug(0, 1, SIM_FULL_HD);
    client_run(c, SIM_S / 2);
}

/* The twin has the same modes but must get its preferred one. */
static void change_twin(struct client *c) {
    sim_refuse_mode((struct sim_refusal){96, EINVAL, false});
    client_frames(c, 3);
    sim_allow_modes();
    sim_plug(0, 0, SIM_TWIN);
    client_run(c, SIM_S / 2);
    sim_plug(0, 0, SIM_VIEWER);
    client_run(c, SIM_S / 2);
    sim_plug(0, 0, SIM_WIDE_VIEWER);
    client_run(c, SIM_S / 2);
}

static void switch_console(struct client *c) {
    client_frames(c, 3);
    client_leave_console(c);
    client_run(c, SIM_S);
    client_enter_console(c);
    client_frames(c, 3);
}

static void switch_console_fast(struct client *c) {
    client_frames(c, 3);
    for (int i = 0; i < 3; i++) {
        client_leave_console(c);
        client_run(c, SIM_MS);
        client_enter_console(c);
        client_run(c, 3 * SIM_MS);
    }
}

static void card_comes_back(struct client *c) {
    client_frames(c, 3);
    sim_lose_card(0);
    client_run(c, 3 * SIM_S);
    sim_return_card(0, "/dev/dri/card3");
    client_frames(c, 3);
}

static void other_card(struct client *c) {
    client_frames(c, 3);
    sim_plug(0, 0, SIM_NO_MONITOR);
    sim_plug(1, 1, SIM_SMALL);
    rest(c, SIM_S);
    sim_lose_card(1);
    sim_plug(0, 1, SIM_FULL_HD);
    rest(c, SIM_S);
}

static void bad_link(struct client *c) {
    client_frames(c, 3);
    sim_break_link(0, 0);
    rest(c, SIM_S);
}

static void stranger_goes(struct client *c) {
    client_run(c, 3 * SIM_S);
    sim_stranger_leaves(0, false);
    client_frames(c, 3);
    sim_stranger_takes(0);
    client_run(c, 3 * SIM_S / 2);
    sim_stranger_leaves(0, true);
    client_frames(c, 3);
}

static void stall_until(struct client *c, enum sim_stall how) {
    client_frames(c, 3);
    sim_stall(0, how);
    client_run(c, 13 * SIM_S);
}

static void stall_relit(struct client *c) { stall_until(c, SIM_STALLS_UNTIL_RELIT); }
static void stall_reopened(struct client *c) {
    stall_until(c, SIM_STALLS_UNTIL_REOPENED);
    rest(c, 14 * SIM_S);
}
static void stall_event(struct client *c) { stall_until(c, SIM_EVENT_LOST); }
static void event_too_late(struct client *c) { stall_until(c, SIM_EVENT_LATE); }
static void stall_short(struct client *c) {
    client_frames(c, 3);
    sim_stall(0, SIM_STALLS);
    rest(c, 3 * SIM_S);
    sim_stall(0, SIM_FLOWS);
    client_frames(c, 3);
}
static void stall_long(struct client *c) {
    stall_until(c, SIM_STALLS);
    rest(c, 40 * SIM_S);
    sim_stall(0, SIM_FLOWS);
}

static void modes_come_back(struct client *c) {
    client_frames(c, 2);
    sim_refuse_mode((struct sim_refusal){64, EINVAL, false});
    sim_refuse_mode((struct sim_refusal){96, EINVAL, false});
    sim_break_link(0, 0);
    rest(c, 3 * SIM_S);
    sim_allow_modes();
    rest(c, 11 * SIM_S);
}

static void gl_starts_late(struct client *c) {
    sim_set_gpu(&(struct sim_gpu){.no_gl = true});
    sim_lose_card(0);
    sim_return_card(0, NULL);
    rest(c, 25 * SIM_S);
    sim_set_gpu(&(struct sim_gpu){0});
    rest(c, 11 * SIM_S);
}

/* Blanks for a long time, with many events. */
static void sleep_and_wake(struct client *c) {
    client_frames(c, 3);
    client_blank(c, true);
    client_run(c, 14 * SIM_S);
    if (sim_counts.failed == 0 && !sim_is_dark()) sim_complain("screen not dark");
    client_blank(c, false);
    client_frames(c, 2);
    client_blank(c, true);
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(c, 3 * SIM_S);
    sim_plug(0, 0, SIM_TWIN);
    client_run(c, SIM_S);
    client_leave_console(c);
    client_run(c, SIM_S);
    client_enter_console(c);
    client_run(c, SIM_S);
    client_blank(c, false);
}

static void say(struct client *c, const char *text) {
    c->told_ns = sim_now();
    gn_kms_show_message(c->kms, text, c->told_ns);
}

static void a_text_and_back(struct client *c) {
    client_frames(c, 3);
    client_run(c, 5 * SIM_MS);
    say(c, "no such scene");
    client_run(c, SIM_S);
    say(c, NULL);
}

const struct scene scenes[] = {
    {"plain start", build_good, NULL, .opts = {0}, .put_back = true},
    {"fences and modifiers", build_rich, NULL, .opts = {0}, .put_back = true},
    {"plane left rotated by the console", build_taken, switch_console, .opts = {0},
     .needs_atomic = true},
    {"start without a monitor, plugged later", build_no_monitor, plug_late, .opts = {0}},
    {"monitor unplugged and plugged", build_good, replug, .opts = {0}},
    {"other monitor, then other connector", build_good, change_monitor, .opts = {0}},
    {"other monitor with the same modes, then a resized viewer", build_good, change_twin,
     .opts = {0}},
    {"monitor without EDID", build_unknown, NULL, .opts = {0}},
    {"mode refused", build_refused, NULL, .opts = {0}},
    {"mode refused after TEST_ONLY accepted it", build_refused_late, NULL, .opts = {0}},
    {"all modes refused temporarily", build_good, modes_come_back, .opts = {0}},
    {"switch of consoles", build_rich, switch_console, .opts = {0}},
    {"fast switch of consoles, three times", build_good, switch_console_fast, .opts = {0}},
    {"card lost, back with another number", build_good, card_comes_back, .opts = {0}},
    {"second card that only renders", build_two_cards, NULL, .opts = {0}},
    {"monitor moved to another card and back", build_pair, other_card, .opts = {0}},
    {"legacy interface", build_old, replug, .opts = {0}, .put_back = true},
    {"legacy interface by option", build_good, switch_console, .opts = {.legacy = true}},
    {"driver without vblank", build_virtual, replug, .opts = {0}},
    {"driver without vblank, 10 frames per second", build_virtual, NULL, .opts = {.max_fps = 10}},
    {"copies into dumb buffers", build_copies, replug, .opts = {0}},
    {"bad link", build_good, bad_link, .opts = {0}},
    {"bad link, legacy interface", build_old, bad_link, .opts = {0}},
    {"another process is master, twice", build_stranger, stranger_goes, .opts = {0},
     .needs_atomic = true},
    {"stall that a modeset ends", build_good, stall_relit, .opts = {0}},
    {"stall that reopening the card ends", build_good, stall_reopened, .slack_ns = 15 * SIM_S,
     .opts = {0}},
    {"temporary stall", build_rich, stall_short, .opts = {0}},
    {"stall until the program gives up", build_old, stall_long, .opts = {0}, .slack_ns = 30 * SIM_S,
     .may_give_up = true},
    {"flip event lost", build_good, stall_event, .opts = {0}},
    {"flip event too late", build_good, event_too_late, .opts = {0}},
    {"blanked and unblanked", build_good, sleep_and_wake, .opts = {0}},
    {"blanked and unblanked, legacy interface", build_old, sleep_and_wake, .opts = {0}},
    {"message and back", build_rich, a_text_and_back, .opts = {0}},
    {"scaled by the plane, consoles switched", build_scaling, switch_console, .opts = {0},
     .draws = 0.75f, .put_back = true},
    {"scaled by the plane, other monitor", build_scaling, change_monitor, .opts = {0},
     .draws = 0.75f},
    {"scaled by the plane, blanked", build_scaling, sleep_and_wake, .opts = {0}, .draws = 0.75f},
    {"scaled by the plane, stalled", build_scaling, stall_relit, .opts = {0}, .draws = 0.75f},
    {"scaled by the plane, message and back", build_scaling, a_text_and_back, .opts = {0},
     .draws = 0.75f},
    {"scaling refused after TEST_ONLY accepted it", build_liar, replug, .opts = {0},
     .draws = 0.75f},
    {"GL starts late", build_good, gl_starts_late, .opts = {0}},
};
const int scene_count = (int)(sizeof scenes / sizeof *scenes);

/* ---- running one ---- */

struct ending scene_run(const struct scene *scene, void (*prepare)(void *), void *context) {
    struct ending e = {0};
    struct client c;
    char status[160];
    sim_begin();
    scene->build();
    if (prepare) prepare(context);
    client_draws(scene->draws > 0 ? scene->draws : 1);
    client_open(&c, &scene->opts);
    if (scene->play)
        scene->play(&c);
    else
        client_frames(&c, 4);
    sim_stall(0, SIM_FLOWS);
    const bool right = client_settle(&c, WITHIN + scene->slack_ns, &e.took_ns);
    snprintf(status, sizeof status, "%s", client_screen(&c)->status);
    if (right && !prepare && client_screen(&c)->counts.again == 0)
        sim_complain("still picture not flipped again");
    client_draws(1);
    e.frames = c.frames;
    e.gave_up = c.gave_up;
    client_close(&c);
    if (scene->put_back && !prepare && !sim_shows_console(0)) sim_complain("console not restored");
    e.calls = sim_counts.all_calls;
    if (!right) sim_complain("wrong picture: %s", status[0] ? status : "no problem reported");
    sim_end();
    snprintf(e.complaint, sizeof e.complaint, "%s", sim_complaint());
    return e;
}
