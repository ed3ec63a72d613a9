/* Sorts the items so that those of one instanced call are adjacent: same geometry, same flags, and
 * materials that differ only in factors. */
#include "scene/private.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* The properties of a material that select its program and state, as words to compare. */
enum {
    SLOT_WORDS = 2 + 6,
    FLAG_WORDS = 15 + GN_FACTORS_SIZE,
    LOOK_WORDS = GN_TEXTURE_SLOT_COUNT * SLOT_WORDS + FLAG_WORDS
};
struct look {
    uint32_t word[LOOK_WORDS];
    uint32_t material; /* its index; not compared */
};

static int compare_looks(const void *a, const void *b) {
    return memcmp(((const struct look *)a)->word, ((const struct look *)b)->word,
                  LOOK_WORDS * sizeof(uint32_t));
}

/* Numbers the looks; look_number[material]. */
static bool number_looks(struct gn_gltf *g, uint32_t *look_number) {
    uint32_t count = g->scene->material_count, number = 0;
    struct look *looks = gn_gltf_alloc(g, &g->memory.load, count, sizeof *looks);
    if (!looks) return false;
    for (uint32_t i = 0; i < count; i++) {
        const struct gn_material *m = &g->scene->materials[i];
        uint32_t *to = looks[i].word;
        looks[i].material = i;
        for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++, to += SLOT_WORDS) {
            const struct gn_texture_ref *ref = &m->textures[slot];
            if (ref->texture < 0) continue;
            to[0] = (uint32_t)ref->texture + 1;
            to[1] = ref->uv_set;
            memcpy(to + 2, ref->uv_from_uv, sizeof ref->uv_from_uv);
        }
        *to++ = m->alpha;
        *to++ = m->double_sided;
        *to++ = m->unlit;
        *to++ = m->shadow_catcher;
        *to++ = gn_material_is_specular(m) && !m->unlit;
        *to++ = gn_material_is_metal(m) && !m->unlit;
        *to++ = gn_material_needs_reflections(m);
        *to++ = gn_material_is_emissive(m);
        if (m->textures[GN_TEXTURE_NORMAL].texture >= 0) /* a uniform, beside the transforms */
            memcpy(to, &m->normal_scale, sizeof m->normal_scale);
        to++;
        if (gn_material_has_f0(m)) memcpy(to, m->f0, sizeof m->f0); /* another */
        to += 3;
        if (m->textures[GN_TEXTURE_LIGHTMAP].texture >= 0)
            memcpy(to, &m->lightmap_intensity, sizeof m->lightmap_intensity);
        to++;
        for (int k = 0; k < GN_LAYER_COUNT; k++) {
            int first = gn_layers[k].first, count = gn_layers[k + 1].first - first;
            if (gn_material_has(m, k)) memcpy(to, m->factors + first, (size_t)count * sizeof *to);
            to += count;
        }
        *to++ = gn_material_is_tinted(m);
        *to++ = m->moves ? i + 1 : 0; /* its uniforms are its own */
        assert(to == looks[i].word + LOOK_WORDS);
    }
    qsort(looks, count, sizeof *looks, compare_looks);
    for (uint32_t i = 0; i < count; i++) {
        if (i > 0 && compare_looks(&looks[i], &looks[i - 1]) != 0) number++;
        look_number[looks[i].material] = number;
    }
    return true;
}

/* Within a batch what is still lies together where the studio lights it: only that has occlusion.
 */
enum { KEY_ALPHA, KEY_LOOK, KEY_GEOMETRY, KEY_FLAGS, KEY_STAYS, KEY_ORDER, KEY_COUNT };
struct item_key {
    uint32_t part[KEY_COUNT];
    struct gn_item item;
};

static int compare_items(const void *a, const void *b) {
    const uint32_t *x = ((const struct item_key *)a)->part, *y = ((const struct item_key *)b)->part;
    for (int i = 0; i < KEY_COUNT; i++)
        if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
    return 0;
}

bool gn_scene_batch(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    gn_arena_reset(&g->memory.step);
    uint32_t *looks = gn_gltf_alloc(g, &g->memory.step, scene->material_count, sizeof *looks);
    struct item_key *keys = gn_gltf_alloc(g, &g->memory.step, scene->item_count, sizeof *keys);
    if (g->failed || !number_looks(g, looks)) return false;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        uint32_t flags = (uint32_t)item->casts | (uint32_t)item->receives << 1 |
                         (uint32_t)item->cast_faces << 2 | (uint32_t)item->plane << 8 |
                         (uint32_t)item->casts_alpha << 16 | (uint32_t)(item->skin >= 0) << 17 |
                         (uint32_t)(item->morph >= 0) << 18;
        const struct gn_material *m = &scene->materials[item->material];
        keys[i] = (struct item_key){
            .part = {[KEY_ALPHA] = gn_material_is_blended(m) ? GN_ALPHA_BLEND : m->alpha,
                     [KEY_LOOK] = looks[item->material],
                     [KEY_GEOMETRY] = item->geometry,
                     [KEY_FLAGS] = flags,
                     [KEY_STAYS] = scene->added.light && item->stays,
                     [KEY_ORDER] = i},
            .item = *item};
    }
    qsort(keys, scene->item_count, sizeof *keys, compare_items);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        bool next =
            i > 0 && memcmp(keys[i].part, keys[i - 1].part, KEY_STAYS * sizeof(uint32_t)) != 0;
        scene->batch_count = i == 0 ? 1 : scene->batch_count + next;
        scene->items[i] = keys[i].item;
        scene->items[i].batch = scene->batch_count - 1;
    }
    return true;
}
