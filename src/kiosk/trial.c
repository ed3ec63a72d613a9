/* A trial of what is new: content of a stick, and a scene of ctl scene. Until it has brought 100
 * pictures, or a minute has passed with it, a mark is kept on the disk, beside the state or in the
 * folder of content. A start that finds the mark for the second time does not try it again: it goes
 * back to the version before, or to the scene of the configuration. An end that was asked for does
 * not count. */
#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/file.h"
#include "core/hash.h"
#include "kiosk/private.h"
#include "take/take.h"

static const int64_t PROOF_NS = 60 * GN_NS_PER_S, PATIENCE_NS = 2 * GN_NS_PER_S;
enum { PROOF_FLIPS = 100, TRIES = 2, MARK_MAX = 100 };

struct trial {
    const struct gn_part_host *host;
    char path[PATH_MAX];    /* of the mark; "": none is kept */
    uint64_t tried, proven; /* what is; 0: nothing */
    unsigned tries;         /* starts that found it, this one and a reload included */
    bool leaves_out;        /* content, in this start */
    unsigned before;        /* what an end that was asked for leaves */
    bool loads;             /* a reload goes on */
    bool reloaded;          /* `tried` came by one */
    bool counts;            /* `tried` is shown: */
    uint64_t flips;         /* then */
    int64_t begun_ns;
};
static struct gn_show *show_of(const struct trial *t) { return t->host->show; }

/* ---- what is tried --------------------------------------------------------------------------- */

/* A file that is replaced is another one. 0: nothing of others is shown. */
static uint64_t identify(const struct gn_options *o, const char *file) {
    const char *const paths[] = {file ? file : o->content, o->all[0].scene.path,
                                 file ? NULL : o->config_path};
    uint64_t hash = GN_HASH_INIT;
    for (int i = 0; paths[0] && i < 3; i++) {
        struct stat info;
        hash = gn_hash(hash, paths[i] ? paths[i] : "", paths[i] ? strlen(paths[i]) + 1 : 1);
        if (!paths[i] || stat(paths[i], &info) != 0) continue;
        const int64_t state[] = {info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec};
        if (S_ISREG(info.st_mode)) hash = gn_hash(hash, state, sizeof state);
    }
    return paths[0] ? hash : 0;
}

/* ---- the mark -------------------------------------------------------------------------------- */

static void read_mark(struct trial *t) {
    struct gn_bytes bytes;
    char text[MARK_MAX + 1] = "";
    if (!gn_file_read(t->path, MARK_MAX, &bytes, NULL)) return;
    memcpy(text, bytes.data, bytes.size);
    gn_bytes_finish(&bytes);
    unsigned tries;
    uint64_t tried, proven;
    if (sscanf(text, "trial %u %" SCNx64 " %" SCNx64, &tries, &tried, &proven) != 3) return;
    t->tries = tries;
    t->tried = tried;
    t->proven = proven;
}

static void keep_mark(struct trial *t, unsigned tries) {
    char text[MARK_MAX], why[600];
    struct gn_err err = {0};
    const int size = snprintf(text, sizeof text, "trial %u %016" PRIx64 " %016" PRIx64 "\n", tries,
                              t->tried, t->proven);
    if (gn_file_keep(&gn_disk, t->path, text, (size_t)size, &err)) return;
    snprintf(why, sizeof why, "%.400s (what is new is shown without a trial)", err.text);
    gn_problem_report(t->host->problems, GN_PROBLEM_STATE, why);
}

/* What is proven already, and nothing, is not tried. */
static void try_one(struct trial *t, uint64_t what, unsigned before) {
    const bool is_new = what && what != t->proven;
    const bool had = t->tried;
    t->tried = is_new ? what : 0;
    t->before = before;
    t->tries = is_new ? before + 1 : 0;
    t->counts = false;
    if (is_new || had) keep_mark(t, t->tries);
}

/* ---- back ------------------------------------------------------------------------------------ */

/* The options without content, until other content comes; NULL: they cannot be read. */
static struct gn_options *read_without(const struct gn_options *now, struct gn_err *err) {
    struct gn_options like = *now;
    char **argv = gn_xalloc((size_t)now->argc + 2, sizeof *argv);
    memcpy(argv, now->argv, (size_t)now->argc * sizeof *argv);
    argv[like.argc++] = (char *)"--content=no";
    like.argv = argv;
    struct gn_options *o = gn_show_read_options(&like, NULL, err);
    free(argv);
    if (!o) return NULL;
    o->argc = now->argc;
    o->argv = now->argv;
    o->content = now->content ? gn_arena_strdup(&o->arena, now->content) : NULL;
    const char *folder = gn_arena_strdup(&o->arena, now->settings->kiosk.content);
    for (int i = 0; i < o->all_count; i++) o->all[i].kiosk.content = folder;
    return o;
}

static void replace_options(struct gn_show *s, struct gn_options *o) {
    gn_show_drop_options(s->config.options);
    s->config.options = o;
    s->config.file = NULL;
    s->config.has_past = false;
    s->first.scene = 0;
}

/* The link leads to the version before, or to none; false: it could not be turned. */
static bool turn_back(const char *folder, char from[GN_TAKE_NAME], char to[GN_TAKE_NAME]) {
    struct gn_take take;
    struct gn_err unused = {0};
    const struct gn_take_limits limits = {.patience_ns = PATIENCE_NS};
    struct stat info;
    char link[PATH_MAX];
    if (snprintf(link, sizeof link, "%s/" GN_TAKE_CURRENT, folder) >= (int)sizeof link ||
        lstat(link, &info) != 0 || !S_ISLNK(info.st_mode))
        return false; /* a folder that gnomon take does not keep */
    bool ok = gn_take_open(&take, &gn_disk, folder, &limits, &unused);
    if (ok) {
        memcpy(from, take.shown, GN_TAKE_NAME);
        ok = gn_take_give_up(&take, &unused);
        memcpy(to, take.shown, GN_TAKE_NAME);
    }
    gn_take_close(&take);
    return ok;
}

/* False: the configuration cannot be read; then all stays. */
static bool go_back(struct trial *t) {
    struct gn_show *s = show_of(t);
    const struct gn_options *now = s->config.options;
    char text[512], from[GN_TAKE_NAME] = "", to[GN_TAKE_NAME] = "";
    struct gn_err err = {0};
    const bool turned = !s->config.file && turn_back(now->settings->kiosk.content, from, to);
    struct gn_options *fresh =
        s->config.file || turned ? gn_show_read_options(now, NULL, &err) : read_without(now, &err);
    if (!fresh) return false;
    if (s->config.file)
        snprintf(text, sizeof text,
                 "scene %.300s: %d starts with it brought no picture; showing the configured scene",
                 s->config.file, TRIES);
    else if (to[0])
        snprintf(text, sizeof text,
                 "content: %d starts with version %.*s brought no picture; back to version %.*s",
                 TRIES, (int)strcspn(from, "-"), from, (int)strcspn(to, "-"), to);
    else
        snprintf(text, sizeof text,
                 "content: %d starts with %.300s brought no picture; showing the machine's scene",
                 TRIES, now->content);
    t->leaves_out = !s->config.file && !turned;
    replace_options(s, fresh);
    gn_problem_report(t->host->problems, GN_PROBLEM_TRIAL, text);
    return true;
}

/* ---- the part -------------------------------------------------------------------------------- */

static void begin_trial(void *part) {
    struct trial *t = part;
    struct gn_show *s = show_of(t);
    const struct gn_kiosk_settings *kiosk = &s->config.options->settings->kiosk;
    const bool has_state = strcmp(kiosk->state, "no") != 0;
    if (s->config.place || (!has_state && strcmp(kiosk->content, "no") == 0)) return;
    const int length = has_state ? snprintf(t->path, sizeof t->path, "%s.trial", kiosk->state)
                                 : snprintf(t->path, sizeof t->path, "%s/trial", kiosk->content);
    if (length >= (int)sizeof t->path) t->path[0] = '\0';
    if (!t->path[0]) return;
    read_mark(t);
    uint64_t what = identify(s->config.options, s->config.file);
    if (what && what != t->proven && what == t->tried && t->tries >= TRIES && go_back(t)) {
        what = identify(s->config.options, s->config.file);
        if (t->leaves_out) t->tried = 0; /* the mark stays for the next start */
        if (t->leaves_out) return;
    }
    try_one(t, what, what == t->tried ? t->tries : 0);
}

static int64_t trial_due_ns(const void *part) {
    const struct trial *t = part;
    return t->counts ? t->begun_ns + PROOF_NS : INT64_MAX;
}

/* A reload is marked as it begins to load; one that fails leaves reload.options NULL, and the old
 * state is marked again. */
static void step_trial(void *part) {
    struct trial *t = part;
    const struct gn_show *s = show_of(t);
    const struct gn_show_reload *r = &s->reload;
    const bool loads = r->options && !r->first;
    if (!t->path[0]) return;
    t->reloaded |= loads;
    if (loads && !t->loads) try_one(t, identify(r->options, r->file), 0);
    if (!loads && t->loads) {
        const uint64_t what = identify(s->config.options, s->config.file);
        if (what != t->tried) try_one(t, what, 0);
    }
    t->loads = loads;
    if (!t->tried || loads || r->first) return;
    const uint64_t flips = t->host->display->screen.counts.shown;
    const int64_t now_ns = gn_loop_now_ns(t->host->loop);
    if (!t->counts || flips < t->flips) { /* it begins, or the display was opened again */
        t->begun_ns = t->counts ? t->begun_ns : now_ns;
        t->counts = true;
        t->flips = flips;
    }
    if (flips - t->flips < PROOF_FLIPS && now_ns - t->begun_ns < PROOF_NS) return;
    t->proven = t->tried;
    if (t->reloaded) gn_problem_cure(t->host->problems, GN_PROBLEM_TRIAL);
    try_one(t, 0, 0);
}

static void end_trial(void *part) {
    struct trial *t = part;
    const struct gn_show *s = show_of(t);
    if (t->tried && s->ends && !s->failed) keep_mark(t, t->before);
}

const struct gn_part gn_part_trial = {
    .name = "trial",
    .size = sizeof(struct trial),
    .begin = begin_trial,
    .step = step_trial,
    .due_ns = trial_due_ns,
    .end = end_trial,
};
