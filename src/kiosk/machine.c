#include "kiosk/machine.h"

#include <stdlib.h>

static const int64_t SUN_AHEAD_MOST_S = 36525 * INT64_C(86400);

static int modes_of(const struct gn_kiosk_rules *rules) {
    return rules->mode_count > 0 ? rules->mode_count : 1;
}

int gn_kiosk_scene(const struct gn_kiosk_rules *rules, const struct gn_kiosk_place *place) {
    const int own = rules->own_scene[place->mode];
    return own > 0 ? own - 1 : place->scene;
}

static bool is_same_place(const struct gn_kiosk_place *a, const struct gn_kiosk_place *b) {
    return a->mode == b->mode && a->scene == b->scene;
}

bool gn_kiosk_waits(const struct gn_kiosk *s) { return !is_same_place(&s->shown, &s->wanted); }

bool gn_kiosk_is_dark(const struct gn_kiosk *s) { return s->blanked || (s->asleep && !s->woken); }

static void set_caption(struct gn_kiosk *s, enum gn_kiosk_caption what, int64_t time_ns) {
    s->caption = what;
    s->caption_begun_ns = time_ns;
}

/* ns of real time pass: for the clip that plays once, then for the scene. */
static void pass_time(struct gn_kiosk *s, int64_t ns) {
    ns = s->speed >= 0 ? ns * (1 << s->speed) : ns / (1 << -s->speed);
    if (s->play.clip_plus_1 > 0) {
        s->play.time_ns += ns;
        if (s->play.time_ns < s->play.length_ns) return;
        ns = s->play.time_ns - s->play.length_ns;
        s->play = (struct gn_kiosk_play){0};
    }
    s->scene_ns += ns;
}

/* Where all stands no frame passes time. */
static void pass_until(struct gn_kiosk *s, int64_t time_ns) {
    if (s->paused || s->seen_ns == 0 || time_ns <= s->seen_ns) return;
    pass_time(s, time_ns - s->seen_ns);
    s->seen_ns = time_ns;
}

/* The clips of the shown mode begin, or go with the scene's time. A clip that plays once ends,
 * unless it was asked for after the mode was. */
static void enter_clips(const struct gn_kiosk_rules *rules, struct gn_kiosk *s, int64_t time_ns,
                        bool plays_on) {
    const bool restarts = rules->restarts >> s->shown.mode & 1;
    if (restarts) pass_until(s, time_ns);
    s->clips_begun_ns = restarts ? s->scene_ns : 0;
    if (!plays_on) s->play = (struct gn_kiosk_play){0};
}

/* ---- what is wanted ---- */

/* The next mode that is not passed by and has not failed; if there is none, the same one. */
static void want_mode(const struct gn_kiosk_rules *rules, struct gn_kiosk *s, int by) {
    const int count = modes_of(rules);
    int mode = s->wanted.mode;
    for (int i = 0; i < count; i++) {
        mode = (mode + by + count) % count;
        const int own = rules->own_scene[mode];
        const bool bad = (s->bad_modes | rules->passed_by) >> mode & 1 ||
                         (own > 0 && s->bad_scenes >> (own - 1) & 1);
        if (!bad) break;
    }
    s->wanted.mode = mode;
}

/* ---- actions ---- */

/* The scene's time continues where it was paused. */
static void toggle_pause(struct gn_kiosk *s, int64_t time_ns) {
    s->paused = !s->paused;
    if (!s->paused && s->seen_ns != 0 && time_ns > s->seen_ns) s->seen_ns = time_ns;
}

/* Whether the action changes what is so now. */
static bool turns(bool is_on, enum gn_turn turn) {
    return turn == GN_TURN_OTHER || (turn == GN_TURN_ON) != is_on;
}

/* Timers name what they want, also of a screen that is off: that says blank alone. */
static bool keeps_dark(const struct gn_kiosk_event *e) {
    return e->turn != GN_TURN_OTHER && (e->action == GN_ACTION_BLANK || !e->pressed);
}

typedef void act_fn(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                    const struct gn_kiosk_event *e);

static void step_mode(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                      const struct gn_kiosk_event *e, int by) {
    want_mode(rules, s, by);
    if (rules->replays && modes_of(rules) == 1 && !gn_kiosk_waits(s))
        enter_clips(rules, s, e->time_ns, false);
    set_caption(s, GN_KIOSK_CAPTION_MODE, e->time_ns);
}

static void act_next(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                     const struct gn_kiosk_event *e) {
    step_mode(rules, s, e, 1);
}

static void act_prev(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                     const struct gn_kiosk_event *e) {
    step_mode(rules, s, e, -1);
}

static void act_mode(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                     const struct gn_kiosk_event *e) {
    if (e->mode >= 0 && e->mode < modes_of(rules)) {
        const int own = rules->own_scene[e->mode];
        s->bad_modes &= ~(1u << e->mode); /* requested by name: try again */
        if (own > 0) s->bad_scenes &= ~(UINT64_C(1) << (own - 1));
        s->wanted.mode = e->mode;
        if (rules->restarts >> e->mode & 1 && !gn_kiosk_waits(s))
            enter_clips(rules, s, e->time_ns, false);
    }
    set_caption(s, GN_KIOSK_CAPTION_MODE, e->time_ns);
}

/* When all others have failed they are tried again: their files may be fixed by now. */
static void act_next_scene(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                           const struct gn_kiosk_event *e) {
    const int count = rules->scene_count > 0 ? rules->scene_count : 1;
    int by = 1;
    while (by < count && s->bad_scenes >> (s->wanted.scene + by) % count & 1) by++;
    if (by >= count) {
        for (int i = 0; i < count; i++) s->bad_scenes &= ~(UINT64_C(1) << i);
        by = 1;
    }
    s->wanted.scene = (s->wanted.scene + by) % count;
    set_caption(s, GN_KIOSK_CAPTION_SCENE, e->time_ns);
}

static void act_next_camera(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                            const struct gn_kiosk_event *e) {
    (void)rules;
    s->camera++;
    set_caption(s, GN_KIOSK_CAPTION_CAMERA, e->time_ns);
}

/* A further press begins anew. */
static void act_play(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                     const struct gn_kiosk_event *e) {
    (void)rules;
    if (e->clip < 0) return;
    if (s->paused) toggle_pause(s, e->time_ns);
    pass_until(s, e->time_ns);
    s->play = (struct gn_kiosk_play){
        .clip_plus_1 = e->clip + 1, .length_ns = e->clip_ns, .wanted = s->wanted};
}

static void act_pause(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                      const struct gn_kiosk_event *e) {
    (void)rules;
    if (!turns(s->paused, e->turn)) return;
    toggle_pause(s, e->time_ns);
    set_caption(s, GN_KIOSK_CAPTION_PAUSE, e->time_ns);
}

static void act_blank(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                      const struct gn_kiosk_event *e) {
    (void)rules;
    if (!turns(gn_kiosk_is_dark(s), e->turn)) return;
    const bool lights = gn_kiosk_is_dark(s);
    s->blanked = !lights;
    s->woken = lights && s->asleep;
}

static void act_info(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                     const struct gn_kiosk_event *e) {
    (void)rules;
    if (turns(s->info, e->turn)) s->info = !s->info;
}

static void act_sun(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                    const struct gn_kiosk_event *e) {
    (void)rules;
    const int64_t ahead_s = e->sun_s == 0 ? 0 : s->sun_ahead_s + e->sun_s;
    if (llabs(ahead_s) <= SUN_AHEAD_MOST_S) s->sun_ahead_s = ahead_s;
    set_caption(s, GN_KIOSK_CAPTION_SUN, e->time_ns);
}

static void apply_action(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                         const struct gn_kiosk_event *e) {
    static act_fn *const acts[GN_ACTION_KIND_COUNT] = {
#define X(ID, id, ...) [GN_ACTION_##ID] = act_##id,
        GN_ACTIONS(X)
#undef X
    };
    if (e->action == GN_ACTION_NONE) return;
    if (s->play.clip_plus_1 > 0 && rules->plays_alone && e->pressed && !gn_kiosk_is_dark(s)) return;
    s->used_ns = e->time_ns;
    const bool sleeps = s->asleep && !s->woken;
    if (sleeps ? e->pressed && !keeps_dark(e) : s->blanked && !keeps_dark(e)) {
        s->blanked = false;
        s->woken = s->asleep;
    } else
        acts[e->action](rules, s, e);
}

/* ---- other events ---- */

/* A problem's text is longer and takes more time to read. */
static int64_t caption_duration_ns(const struct gn_kiosk_rules *rules,
                                   enum gn_kiosk_caption caption) {
    return (caption == GN_KIOSK_CAPTION_PROBLEM ? 5 : 1) * rules->caption_ns;
}

static void check_timeouts(const struct gn_kiosk_rules *rules, struct gn_kiosk *s, int64_t now_ns) {
    if (s->used_ns == 0) s->used_ns = now_ns;
    if (s->fade_begun_ns != 0 && now_ns - s->fade_begun_ns >= rules->fade_ns) s->fade_begun_ns = 0;
    if (s->caption && now_ns - s->caption_begun_ns >= caption_duration_ns(rules, s->caption))
        s->caption = GN_KIOSK_CAPTION_NONE;
    if (s->woken && now_ns - s->used_ns >= rules->wake_ns) s->woken = false;
    if (rules->idle == GN_IDLE_NONE || rules->idle_after_ns <= 0 || gn_kiosk_is_dark(s) ||
        s->play.clip_plus_1 > 0 || now_ns - s->used_ns < rules->idle_after_ns)
        return;
    s->used_ns = now_ns;
    s->idled++;
    if (s->paused) toggle_pause(s, now_ns);
    s->info = false;
    s->sun_ahead_s = 0;
    if (rules->idle == GN_IDLE_NEXT) {
        want_mode(rules, s, 1);
        return;
    }
    s->wanted = (struct gn_kiosk_place){.mode = rules->first_mode};
    s->camera = 0;
}

/* In the morning it is lit, whoever has blanked it before. */
static void change_hours(struct gn_kiosk *s, bool ended) {
    if (s->asleep == ended) return;
    s->asleep = ended;
    s->woken = false;
    if (!ended) s->blanked = false;
}

static void enter_wanted(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                         const struct gn_kiosk_event *e) {
    const int before = gn_kiosk_scene(rules, &s->shown);
    if (e->mode != s->wanted.mode || e->scene != gn_kiosk_scene(rules, &s->wanted) ||
        !gn_kiosk_waits(s))
        return;
    const bool enters = s->shown.mode != s->wanted.mode;
    if (e->scene != before || (enters && rules->own_camera >> e->mode & 1)) s->camera = 0;
    s->fade_begun_ns = rules->fade_ns > 0 ? e->time_ns : 0;
    if (s->caption == GN_KIOSK_CAPTION_MODE || s->caption == GN_KIOSK_CAPTION_SCENE)
        set_caption(s, s->caption, e->time_ns); /* for its time, with what it names */
    s->shown = s->wanted;
    enter_clips(rules, s, e->time_ns,
                e->scene == before && is_same_place(&s->play.wanted, &s->wanted));
}

static void give_up_scene(const struct gn_kiosk_rules *rules, struct gn_kiosk *s,
                          const struct gn_kiosk_event *e) {
    if (e->scene < 0 || e->scene >= GN_KIOSK_SCENES_MAX) return;
    s->bad_scenes |= UINT64_C(1) << e->scene;
    if (!gn_kiosk_waits(s) || gn_kiosk_scene(rules, &s->wanted) != e->scene) return;
    if (rules->own_scene[s->wanted.mode] > 0)
        s->wanted.mode = s->shown.mode;
    else
        s->wanted.scene = s->shown.scene;
    set_caption(s, GN_KIOSK_CAPTION_PROBLEM, e->time_ns);
}

static void give_up_mode(struct gn_kiosk *s, const struct gn_kiosk_event *e) {
    if (e->mode < 0 || e->mode >= GN_KIOSK_MODES_MAX) return;
    s->bad_modes |= 1u << e->mode;
    if (s->wanted.mode != e->mode || s->shown.mode == e->mode) return;
    s->wanted.mode = s->shown.mode;
    set_caption(s, GN_KIOSK_CAPTION_PROBLEM, e->time_ns);
}

struct gn_kiosk gn_kiosk_step(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state,
                              const struct gn_kiosk_event *event) {
    struct gn_kiosk next = *state;
    switch (event->kind) {
    case GN_KIOSK_ACTION: apply_action(rules, &next, event); break;
    case GN_KIOSK_FRAME:
        if (next.seen_ns == 0 && rules->names_first && !next.caption)
            set_caption(&next, GN_KIOSK_CAPTION_MODE, event->time_ns);
        if (!next.paused && next.seen_ns != 0) pass_time(&next, event->time_ns - next.seen_ns);
        if (state->play.clip_plus_1 > 0) next.used_ns = event->time_ns;
        next.seen_ns = event->time_ns;
        break;
    case GN_KIOSK_TICK: check_timeouts(rules, &next, event->time_ns); break;
    case GN_KIOSK_READY: enter_wanted(rules, &next, event); break;
    case GN_KIOSK_MODE_FAILED: give_up_mode(&next, event); break;
    case GN_KIOSK_SCENE_FAILED: give_up_scene(rules, &next, event); break;
    case GN_KIOSK_NOTE: set_caption(&next, event->caption, event->time_ns); break;
    case GN_KIOSK_CAMERA:
        next.camera = event->camera;
        set_caption(&next, GN_KIOSK_CAPTION_CAMERA, event->time_ns);
        break;
    case GN_KIOSK_HOURS: change_hours(&next, event->by); break;
    case GN_KIOSK_SPEED:
        if (abs(next.speed + event->by) <= GN_KIOSK_SPEED_MOST) next.speed += event->by;
        break;
    default: break;
    }
    return next;
}

/* ---- what a frame shows ---- */

struct gn_kiosk_view gn_kiosk_view(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state,
                                   int64_t seen_ns) {
    struct gn_kiosk then = *state;
    if (!state->paused && state->seen_ns != 0) pass_time(&then, seen_ns - state->seen_ns);
    struct gn_kiosk_view view = {
        .mode = state->shown.mode,
        .scene = gn_kiosk_scene(rules, &state->shown),
        .camera = state->camera,
        .time_ns = then.scene_ns,
        .clips_begun_ns = state->clips_begun_ns,
        .clip = then.play.clip_plus_1 - 1,
        .clip_ns = then.play.time_ns,
        .stands = state->paused,
        .dark = gn_kiosk_is_dark(state),
        .info = state->info,
        .caption_mode = state->wanted.mode,
        .caption_scene = gn_kiosk_scene(rules, &state->wanted),
    };
    if (state->fade_begun_ns != 0 && rules->fade_ns > 0) {
        const double share = (double)(seen_ns - state->fade_begun_ns) / (double)rules->fade_ns;
        view.old = share <= 0.0 ? 1.0f : share >= 1.0 ? 0.0f : (float)(1.0 - share);
    }
    if (seen_ns - state->caption_begun_ns < caption_duration_ns(rules, state->caption))
        view.caption = state->caption;
    return view;
}

static int64_t earlier_ns(int64_t a, int64_t b) { return a < b ? a : b; }

int64_t gn_kiosk_deadline(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state) {
    int64_t at_ns = INT64_MAX;
    if (state->fade_begun_ns != 0) at_ns = earlier_ns(at_ns, state->fade_begun_ns + rules->fade_ns);
    if (state->caption)
        at_ns =
            earlier_ns(at_ns, state->caption_begun_ns + caption_duration_ns(rules, state->caption));
    if (state->woken) at_ns = earlier_ns(at_ns, state->used_ns + rules->wake_ns);
    if (rules->idle != GN_IDLE_NONE && rules->idle_after_ns > 0 && !gn_kiosk_is_dark(state) &&
        state->play.clip_plus_1 == 0)
        at_ns = earlier_ns(at_ns, state->used_ns + rules->idle_after_ns);
    return at_ns;
}
