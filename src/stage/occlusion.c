#include "stage/occlusion.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/thread.h"
#include "stage/kept.h"

/* A step of a fade is at most 1/127 at 60 frames a second. */
static const int64_t FADE_NS = 2 * GN_NS_PER_S;

struct cause { /* compared whole */
    struct gn_sky sky;
    int clips; /* as gn_pose_init() has them; NONE where they move nothing */
};
struct gn_occluder {
    const struct gn_scene *scene;
    struct cause cause;                       /* that it is wanted for */
    bool wanted, is_made;                     /* for that; is_made: `to` is of it */
    int8_t (*from)[4], (*to)[4], (*shown)[4]; /* a fade's; shown: what frames have */
    float share;                              /* of `to` in what is shown */
    int64_t begun_ns;                         /* the fade; 0: not yet */
    uint64_t id;                              /* of what is shown; 0: nothing */
    /* the thread's, until it is done */
    pthread_t thread;
    bool works;
    struct cause its_cause;
    struct gn_occlusion_made made;
    atomic_bool cancel, done;
};

struct gn_sky gn_stage_sky(const struct gn_environment_light *light, float turn_rad) {
    /* diffuse light is radiance times these by order: Ramamoorthi, Hanrahan 2001 */
    static const float by_order[3] = {1, 1 / 1.5f, .25f};
    static const float luminance[3] = {.2126f, .7152f, .0722f};
    _Static_assert((int)GN_SKY_TERMS == (int)GN_ENVIRONMENT_HARMONICS, "the same terms");
    struct gn_sky sky = {.turn = {cosf(turn_rad), sinf(turn_rad)}};
    for (int i = 0; i < GN_SKY_TERMS; i++)
        for (int k = 0; k < 3; k++)
            sky.radiance[i] += luminance[k] * light->harmonics[i][k] / by_order[(i > 0) + (i > 3)];
    return sky;
}

static size_t cells_of(const struct gn_scene *scene) {
    const uint32_t *size = scene->occlusion.size;
    return (size_t)size[0] * size[1] * size[2];
}

struct gn_occluder *gn_occluder_create(const struct gn_scene *scene) {
    struct gn_occluder *o = gn_xalloc(1, sizeof *o);
    o->scene = scene;
    return o;
}

static void end_thread(struct gn_occluder *o) {
    if (!o->works) return;
    pthread_join(o->thread, NULL);
    o->works = false;
}

void gn_occluder_destroy(struct gn_occluder *o) {
    if (!o) return;
    atomic_store(&o->cancel, true);
    end_thread(o);
    free(o->made.texels);
    free(o->from);
    free(o->to);
    free(o->shown);
    free(o);
}

/* ---- what is shown ---- */

static void mix_texels(struct gn_occluder *o) {
    static atomic_uint_fast64_t last_id; /* ids of all scenes differ */
    const size_t count = cells_of(o->scene);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++) {
            const float from = o->from[i][k], to = o->to[i][k];
            o->shown[i][k] = (int8_t)lrintf(from + o->share * (to - from));
        }
    o->id = atomic_fetch_add(&last_id, 1) + 1;
}

static void fill_open(int8_t (*texels)[4], size_t count) {
    for (size_t i = 0; i < count; i++) {
        memset(texels[i], 0, 3);
        texels[i][3] = 127;
    }
}

/* From what is shown to what was made; without texels to nothing. */
static void begin_fade(struct gn_occluder *o, bool at_once) {
    const size_t count = cells_of(o->scene);
    if (!o->shown && !o->made.texels) return;
    if (!o->shown) {
        o->from = gn_xalloc(count, sizeof *o->from);
        o->to = gn_xalloc(count, sizeof *o->to);
        o->shown = gn_xalloc(count, sizeof *o->shown);
        fill_open(o->shown, count);
    }
    memcpy(o->from, o->shown, count * sizeof *o->from);
    if (o->made.texels)
        memcpy(o->to, o->made.texels, count * sizeof *o->to);
    else
        fill_open(o->to, count);
    free(o->made.texels);
    o->made.texels = NULL;
    o->share = at_once ? 1.0f : 0.0f;
    o->begun_ns = 0;
    if (at_once) mix_texels(o);
}

/* ---- kept on the disk ---- */

static const struct gn_kept_kind kept_kind = {
    .prefix = "occlusion-", .suffix = ".bin", .files_max = 16, .bytes_max = 4 << 20};

/* A file has texels, or nothing where the scene has none. */
static bool read_kept(const char *path, size_t bytes, struct gn_occlusion_made *made) {
    struct gn_bytes file = {0};
    const bool ok = gn_kept_read(&kept_kind, path, &file) && (file.size == 0 || file.size == bytes);
    if (ok && file.size > 0) {
        made->texels = gn_xalloc(bytes, 1);
        memcpy(made->texels, file.data, bytes);
    }
    gn_bytes_finish(&file);
    return ok;
}

/* ---- making ---- */

static struct gn_occlusion_made read_or_make(const struct gn_scene *scene,
                                             const struct cause *cause,
                                             const struct gn_occlusion_work *work) {
    const size_t bytes = cells_of(scene) * sizeof(int8_t[4]);
    struct gn_occlusion_made made = {.texels = NULL};
    char path[GN_KEPT_PATH];
    const bool keeps =
        gn_kept_path(&kept_kind, gn_occlusion_key(scene, cause->clips, &cause->sky), bytes, path);
    if (keeps && read_kept(path, bytes, &made)) return made;
    made = gn_occlusion_make(scene, cause->clips, &cause->sky, work);
    if (keeps && !(work->cancel && atomic_load(work->cancel)))
        gn_kept_write(&kept_kind, path, made.texels, made.texels ? bytes : 0);
    return made;
}

static void *make_in_thread(void *data) {
    struct gn_occluder *o = data;
    const struct gn_occlusion_work work = {.threads = 1, .cancel = &o->cancel};
    gn_thread_lower_priority();
    o->made = read_or_make(o->scene, &o->its_cause, &work);
    atomic_store(&o->done, true);
    return NULL;
}

static void start_thread(struct gn_occluder *o) {
    atomic_store(&o->cancel, false);
    atomic_store(&o->done, false);
    o->its_cause = o->cause;
    o->works = pthread_create(&o->thread, NULL, make_in_thread, o) == 0;
    o->is_made = !o->works; /* without a thread it is not tried again */
}

struct gn_sky gn_stage_sky_of(const struct gn_frame_environment_opts *e) {
    /* one for all of a day, from all sides alike */
    if (!e->of || e->reflected_only || e->is_sky) return (struct gn_sky){.turn = {1, 0}};
    return gn_stage_sky(e->lights_key ? &e->of->rest : &e->of->whole, e->turn_rad);
}

void gn_occluder_give(struct gn_occluder *o, const struct gn_pose *pose, struct gn_frame_opts *opts,
                      bool now) {
    const struct cause cause = {gn_stage_sky_of(&opts->environment),
                                pose->animated ? pose->at.clips : GN_POSE_NONE};
    if (!o->wanted || memcmp(&cause, &o->cause, sizeof cause) != 0) {
        o->cause = cause;
        o->wanted = true;
        o->is_made = false;
        atomic_store(&o->cancel, true);
    }
    if (now && !o->is_made) {
        end_thread(o);
        o->made = read_or_make(o->scene, &o->cause, &(struct gn_occlusion_work){.threads = 0});
        o->is_made = true;
        begin_fade(o, true);
    } else if (!o->is_made && !o->works) {
        start_thread(o);
    }
    opts->occlusion.texels = (const int8_t(*)[4])(o->id ? o->shown : NULL);
    opts->occlusion.id = o->id;
}

void gn_occluder_step(struct gn_occluder *o, int64_t now_ns) {
    if (!o) return;
    if (o->works && atomic_load(&o->done)) {
        end_thread(o);
        o->is_made = memcmp(&o->its_cause, &o->cause, sizeof o->cause) == 0;
        if (o->is_made)
            begin_fade(o, false);
        else { /* of another cause than is wanted by now */
            free(o->made.texels);
            o->made.texels = NULL;
            start_thread(o);
        }
    }
    if (!gn_occluder_fades(o)) return;
    if (o->begun_ns == 0) o->begun_ns = now_ns;
    o->share = fminf((float)(now_ns - o->begun_ns) / (float)FADE_NS, 1.0f);
    mix_texels(o);
}

bool gn_occluder_fades(const struct gn_occluder *o) { return o && o->shown && o->share < 1.0f; }

bool gn_occluder_works(const struct gn_occluder *o) { return o && o->works; }
