/* Valid files, broken at random in ways that a loader has to survive: numbers at the edges of their
 * types, missing keys, swapped types, deep nesting, flipped bytes, cut ends, wrong lengths, and
 * allocations that fail. What comes out is one line or a scene that holds; in time and within the
 * memory limit. Some of them are baked, too. The seed is fixed: a failure can be had again by its
 * number.
 *
 *   test_scene_mutations [FIRST [COUNT]]    COUNT: default GN_MUTANTS, 20,000 with GN_FULL=1, else
 * 500; mutants that fail are left in mutant-N.glb */
#include <ftw.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "bake/bake.h"
#include "core/arena.h"
#include "core/clock.h"
#include "core/file.h"
#include "image/dice.h"
#include "seeds.h"
#include "unit/scene_check.h"

enum { MEMORY_MB = 128, SECONDS = 2, BAKED_EVERY = 4 };

/* ---- random numbers ---- */

static struct gn_dice dice;

static uint64_t next(void) { return gn_dice_next(&dice); }

static size_t below(size_t n) { return n > 0 ? (size_t)(next() % n) : 0; }

/* ---- mutations of the JSON ---- */

static json_t *edge_value(const json_t *old) {
    static const double reals[] = {1e308, -1e308, 1e38, -0.0, 0.5, 1e-320, 3.4e38, 1e19};
    static const json_int_t whole[] = {-1,
                                       0,
                                       1,
                                       2,
                                       3,
                                       255,
                                       256,
                                       65535,
                                       65536,
                                       INT32_MAX,
                                       INT64_C(1) << 31,
                                       (INT64_C(1) << 32) - 1,
                                       INT64_C(1) << 32,
                                       INT64_C(1) << 62,
                                       INT64_MAX,
                                       INT64_MIN,
                                       5120,
                                       5123,
                                       5126,
                                       9728,
                                       4,
                                       5,
                                       6};
    json_int_t value = json_is_integer(old) ? json_integer_value(old) : 1;
    switch (below(4)) {
    case 0: return json_real(reals[below(sizeof reals / sizeof reals[0])]);
    case 1: return json_integer((json_int_t)((uint64_t)value + (uint64_t)below(9) - 4));
    default: return json_integer(whole[below(sizeof whole / sizeof whole[0])]);
    }
}

static json_t *deep(size_t levels) {
    json_t *value = json_array();
    while (levels-- > 0) {
        json_t *outer = json_array();
        json_array_append_new(outer, value);
        value = outer;
    }
    return value;
}

static json_t *other_type(void) {
    static const char *const words[] = {"",
                                        "SCALAR",
                                        "VEC3",
                                        "MAT4",
                                        "spot",
                                        "CUBICSPLINE",
                                        "STEP",
                                        "scale",
                                        "MASK",
                                        "\x01",
                                        "../a.png",
                                        "data:,",
                                        "data:;base64,iVBORw0KGgo=",
                                        "/dev/zero",
                                        "dark"};
    switch (below(9)) {
    case 0: return json_null();
    case 1: return json_true();
    case 2: return json_array();
    case 3: return json_object();
    case 4: return json_string(words[below(sizeof words / sizeof words[0])]);
    case 5: return deep(below(700));
    case 6: return json_pack("[i,i,i]", 1, 2, 3);
    default: return edge_value(NULL);
    }
}

/* Replaces, removes or copies a child of the container. */
static void break_child(json_t *container, const char *key, size_t index, json_t *child,
                        json_t *donor) {
    json_t *fresh = NULL;
    size_t what = below(8);
    if (what == 0) {
        if (key)
            json_object_del(container, key);
        else
            json_array_remove(container, index);
        return;
    }
    if (what == 1 && donor)
        fresh = json_deep_copy(donor);
    else if (what == 2 && !key) {
        json_array_append_new(container, json_deep_copy(child));
        return;
    } else if (json_is_number(child) && what > 2)
        fresh = edge_value(child);
    else
        fresh = other_type();
    if (key)
        json_object_set_new(container, key, fresh);
    else
        json_array_set_new(container, index, fresh);
}

struct pick {
    json_t *container, *child;
    const char *key;
    size_t index, seen;
};

/* Reservoir sampling over all values of the document: each is as likely. */
static void choose(struct pick *pick, json_t *value) {
    const char *key;
    json_t *child;
    size_t i;
    json_object_foreach(value, key, child) {
        if (below(++pick->seen) == 0) *pick = (struct pick){value, child, key, 0, pick->seen};
        choose(pick, child);
    }
    json_array_foreach(value, i, child) {
        if (below(++pick->seen) == 0) *pick = (struct pick){value, child, NULL, i, pick->seen};
        choose(pick, child);
    }
}

static void break_json(json_t *root) {
    struct pick pick = {0}, donor = {0};
    choose(&pick, root);
    choose(&donor, root);
    if (!pick.child) return;
    char *key = pick.key ? strdup(pick.key) : NULL;
    break_child(pick.container, key, pick.index, pick.child, donor.child);
    free(key);
}

/* ---- mutations of the bytes ---- */

static uint32_t u32(const uint8_t *p) {
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static void put_u32(uint8_t *p, uint32_t value) {
    for (int i = 0; i < 4; i++) p[i] = (uint8_t)(value >> (8 * i));
}

/* Where the BIN chunk's bytes begin; 0 if there is none. */
static size_t binary_start(const struct gn_made *made) {
    if (made->size < 20 || memcmp(made->data, "glTF", 4) != 0) return 0;
    size_t start = 28 + (size_t)u32(made->data + 12);
    return start < made->size ? start : 0;
}

/* A float that is none, an extreme short: at a multiple of four, where numbers mostly lie. */
static void break_word(uint8_t *data, size_t size) {
    static const uint32_t words[] = {0x7f800000, 0xff800000, 0x7fc00000, 0x7f7fffff,
                                     0xffffffff, 0,          0x80000000, 0x7149f2ca};
    if (size >= 8)
        put_u32(data + 4 * below(size / 4 - 1), words[below(sizeof words / sizeof words[0])]);
}

static void break_bytes(struct gn_made *made) {
    size_t start = below(8) ? binary_start(made) : 0;
    switch (below(12)) {
    case 0: made->size = below(made->size + 1); break;
    case 1:
    case 2:
    case 3:
        for (size_t n = 1 + below(8); n > 0 && made->size > start; n--)
            made->data[start + below(made->size - start)] ^= (uint8_t)(1U << below(8));
        break;
    case 4: /* the .glb's own numbers */
        if (made->size >= 24) {
            size_t at = 4 * below(5);
            put_u32(made->data + at,
                    below(2) ? (uint32_t)next() : u32(made->data + at) + (uint32_t)below(9) - 4);
        }
        break;
    default:
        for (size_t n = 1 + below(6); n > 0; n--)
            break_word(made->data + start, made->size - start);
    }
}

/* ---- a mutant ---- */

/* A .glb taken apart, its JSON broken, and put together again; empty if it is none. */
static struct gn_made break_glb_json(const struct gn_made *seed) {
    struct gn_made made = {0};
    bool glb = seed->size > 20 && memcmp(seed->data, "glTF", 4) == 0;
    const uint8_t *text = glb ? seed->data + 20 : seed->data;
    size_t length = glb ? u32(seed->data + 12) : seed->size;
    json_t *root = json_loadb((const char *)text, length, 0, NULL);
    if (!root) return made;
    for (size_t n = below(3) ? 1 : 2 + below(3); n > 0; n--) break_json(root);
    char *dumped = json_dumps(root, JSON_COMPACT | JSON_ENCODE_ANY);
    json_decref(root);
    if (!dumped) return made;
    size_t tail = glb ? seed->size - 20 - length : 0, head = glb ? 20 : 0,
           dump_size = strlen(dumped);
    size_t padded = glb ? (dump_size + 3) / 4 * 4 : dump_size;
    made.size = head + padded + tail;
    made.data = gn_xalloc(made.size, 1);
    memcpy(made.data, seed->data, head);
    memset(made.data + head, ' ', padded);
    memcpy(made.data + head, dumped, dump_size);
    memcpy(made.data + head + padded, seed->data + seed->size - tail, tail);
    free(dumped);
    if (glb) put_u32(made.data + 12, (uint32_t)padded);
    if (glb) put_u32(made.data + 8, (uint32_t)made.size);
    return made;
}

static struct gn_made mutate(const struct gn_made *seed) {
    struct gn_made made = {0};
    size_t how = below(10);
    if (how < 7) made = break_glb_json(seed);
    if (!made.data) {
        made.size = seed->size;
        made.data = gn_xalloc(made.size, 1);
        memcpy(made.data, seed->data, made.size);
    }
    if (how >= 6) break_bytes(&made);
    return made;
}

/* ---- trying it ---- */

static int shown, refused, failures;
static int64_t slowest_ns;

static void fail(size_t number, const char *what, const struct gn_made *made) {
    char path[40];
    snprintf(path, sizeof path, "mutant-%zu.glb", number);
    gn_file_write(path, made->data, made->size, NULL);
    printf("FAIL %zu: %s (left in %s)\n", number, what, path);
    failures++;
}

static int baked;

/* What bake makes of a file that is shown is shown, too. */
static void try_bake(size_t number, const struct gn_made *made, bool is_shown) {
    const struct gn_scene_limits limits = {.memory_mb = MEMORY_MB, .file_mb = MEMORY_MB};
    const struct gn_bake_opts opts = {.path = "m",
                                      .limits = &limits,
                                      .share = below(2) ? 1 : .5,
                                      .texture_limit_px = GN_BAKE_TEXTURE_PX};
    struct gn_bytes out = {0};
    struct gn_bake_report report = {0};
    struct gn_err err = {0}, why = {0};
    const int64_t start_ns = gn_clock_process_cpu_ns();
    const bool done = gn_bake(&opts, made->data, made->size, &out, &report, NULL, &err);
    if (gn_clock_process_cpu_ns() - start_ns > SECONDS * GN_NS_PER_S)
        fail(number, "took too long to bake", made);
    if (!done && (strncmp(err.text, "m: ", 3) != 0 || strchr(err.text, '\n')))
        fail(number, err.text, made);
    if (!done || !is_shown) {
        gn_bytes_finish(&out);
        return;
    }
    baked++;
    struct gn_scene *scene = gn_scene_load_bytes("m", out.data, out.size, &limits, NULL, &why);
    const char *wrong = scene ? gn_scene_check(scene) : why.text;
    if (wrong) fail(number, wrong, made);
    gn_scene_destroy(scene);
    gn_bytes_finish(&out);
}

static void try_mutant(size_t number, const struct gn_made *made) {
    const struct gn_scene_limits limits = {.memory_mb = MEMORY_MB, .file_mb = MEMORY_MB};
    struct gn_err err = {0};
    struct gn_warnings warnings = {0};
    if (below(10) == 0) gn_alloc_fail_at(1 + below(80));
    int64_t start_ns = gn_clock_process_cpu_ns();
    struct gn_scene *scene =
        gn_scene_load_bytes("m", made->data, made->size, &limits, &warnings, &err);
    int64_t took_ns = gn_clock_process_cpu_ns() - start_ns;
    gn_alloc_fail_at(0);
    if (took_ns > slowest_ns) slowest_ns = took_ns;
    if (took_ns > SECONDS * GN_NS_PER_S) fail(number, "took too long", made);
    const char *wrong = scene ? gn_scene_check(scene) : NULL;
    if (wrong) fail(number, wrong, made);
    if (scene && scene->memory.bytes > (size_t)MEMORY_MB << 20)
        fail(number, "holds more than it may", made);
    if (!scene && (strncmp(err.text, "m: ", 3) != 0 || strchr(err.text, '\n') || !err.text[3]))
        fail(number, err.text, made);
    *(scene ? &shown : &refused) += 1;
    if (gn_bake_is_built() && number % BAKED_EVERY == 0) try_bake(number, made, scene != NULL);
    gn_scene_destroy(scene);
}

/* ---- seeds ---- */

enum { SEEDS_MAX = 128 };
static struct gn_made seeds[SEEDS_MAX];
static size_t seed_count;

static int add_file(const char *path, const struct stat *status, int type, struct FTW *where) {
    (void)where;
    const char *dot = strrchr(path, '.');
    struct gn_bytes bytes;
    if (type != FTW_F || !dot || (strcmp(dot, ".glb") != 0 && strcmp(dot, ".gltf") != 0)) return 0;
    if (status->st_size > 200000 || seed_count == SEEDS_MAX || !gn_file_read(path, 0, &bytes, NULL))
        return 0;
    struct gn_scene *scene = gn_scene_load_bytes("m", bytes.data, bytes.size, NULL, NULL, NULL);
    if (scene)
        seeds[seed_count++] = (struct gn_made){bytes.data, bytes.size};
    else
        gn_bytes_finish(&bytes);
    gn_scene_destroy(scene);
    return 0;
}

static void gather_seeds(void) {
    const char *shared = getenv("GNOMON_SHARED");
    char folder[PATH_MAX];
    for (seed_count = 0; seed_count < GN_SEED_COUNT; seed_count++)
        seeds[seed_count] = gn_seed_make((int)seed_count);
    snprintf(folder, sizeof folder, "%s/assets", shared ? shared : "../shared");
    nftw(folder, add_file, 16, FTW_PHYS);
}

/* The seeds themselves must load, or the mutants say little. */
static void try_seeds(void) {
    for (size_t i = 0; i < GN_SEED_COUNT; i++) {
        struct gn_err err = {0};
        struct gn_warnings warnings = {0};
        struct gn_scene *scene =
            gn_scene_load_bytes("m", seeds[i].data, seeds[i].size, NULL, &warnings, &err);
        const char *wrong = scene ? gn_scene_check(scene) : err.text;
        if (wrong) fail(i, wrong, &seeds[i]);
        if (warnings.count > 0) fail(i, warnings.text[0], &seeds[i]);
        gn_scene_destroy(scene);
    }
}

/* Every allocation of a load fails once: no leak, no crash, one line. */
static void try_allocations(const struct gn_made *seed) {
    for (unsigned long n = 1; n < 10000; n++) {
        struct gn_err err = {0};
        gn_alloc_fail_at(n);
        struct gn_scene *scene = gn_scene_load_bytes("m", seed->data, seed->size, NULL, NULL, &err);
        gn_alloc_fail_at(0);
        if (scene)
            gn_scene_destroy(scene);
        else if (strncmp(err.text, "m: out of memory", 16) != 0)
            fail(n, err.text, seed);
        if (scene) return;
    }
}

int main(int argc, char **argv) {
    size_t first = argc > 1 ? strtoul(argv[1], NULL, 10) : 0;
    const char *count = argc > 2 ? argv[2] : getenv("GN_MUTANTS");
    size_t most = count ? strtoul(count, NULL, 10) : getenv("GN_FULL") ? 20000 : 500;
    gather_seeds();
    try_seeds();
    for (size_t i = 0; i < GN_SEED_COUNT; i++) try_allocations(&seeds[i]);
    for (size_t i = first; i < first + most; i++) {
        dice.state = UINT64_C(0x676e6f6d6f6e) + i * UINT64_C(1000003);
        struct gn_made made = mutate(&seeds[below(seed_count)]);
        try_mutant(i, &made);
        free(made.data);
    }
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    for (size_t i = 0; i < seed_count; i++) free(seeds[i].data);
    printf("%zu mutants of %zu seeds: %d shown, %d refused, %d baked, %d wrong; slowest %" PRId64
           " ms, peak %ld MB\n",
           most, seed_count, shown, refused, baked, failures, slowest_ns / 1000000,
           usage.ru_maxrss / 1024);
    return failures > 0;
}
