/* Textures and pictures, read at their first use. A picture that cannot be read is dropped with a
 * warning, and so are its textures; the scene is shown without them. */
#include "scene/private.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/encoding.h"
#include "image/format.h"

enum { PICTURE_SIDE_MAX = 1 << 20 };
enum { UNSEEN = -1, DROPPED = -2, BASIS = -3 };

/* ---- pictures ---- */

/* What it takes with so many halvings, the decoder's own among them being as few as there is room
 * for. */
static struct gn_picture_need need_of(const struct gn_picture_file *file, uint32_t level,
                                      uint64_t room, uint32_t *shrink) {
    struct gn_picture_need need = {0};
    const uint32_t most = gn_picture_most_shrink(file);
    for (int k = 0; k < 2; k++) need.px[k] = gn_level_px(file->px[k], level);
    const uint64_t texels = (uint64_t)need.px[0] * need.px[1];
    need.kept = 4 * texels;
    need.on_gpu = 4 * (texels + texels / 3);
    for (*shrink = 0;; ++*shrink) {
        need.decoding = gn_picture_work_bytes(file, need.px, *shrink);
        if (*shrink == most || *shrink == level || need.kept + need.decoding <= room) break;
    }
    return need;
}

/* The halvings without which it is over the limit texels. */
static uint32_t least_level(const struct gn_gltf *g, const uint32_t px[2]) {
    uint32_t level = gn_gltf_halvings(px, PICTURE_SIDE_MAX);
    while ((uint64_t)gn_level_px(px[0], level) * gn_level_px(px[1], level) > g->limits.texels)
        level++;
    return level;
}

/* Where all of it takes longer than is left for pictures, a part, if its decoder can stop: the
 * first passes of an interlaced PNG, or the rows that a share of what is left pays for, so that
 * further pictures have theirs. Returns the halvings that this takes. */
static uint32_t take_part(struct gn_gltf *g, const struct gn_at *at, struct gn_picture_file *file,
                          uint64_t *work) {
    enum { SHARE = 8 };
    const uint64_t left = gn_gltf_picture_time(g) / SHARE, row = *work / file->px[1];
    const bool interlaced = file->kind == GN_FORMAT_PNG && gn_png_is_interlaced(file->data);
    if (*work <= gn_gltf_picture_time(g)) return 0;
    if (interlaced && *work >> 2 * GN_SHRINK_MOST <= left) {
        *work >>= 2 * GN_SHRINK_MOST;
        gn_gltf_warn(g, at,
                     "pictures of so many texels take too long to decode: shown with an eighth of "
                     "its rows and columns");
        return GN_SHRINK_MOST;
    }
    if (!gn_picture_can_stop(file) || left < row) return 0;
    file->rows = (uint32_t)(left / row);
    *work = row * file->rows;
    gn_gltf_warn(g, at,
                 "pictures of so many texels take too long to decode: shown with %" PRIu32
                 " of %" PRIu32 " rows, and their mean below",
                 file->rows, file->px[1]);
    return 0;
}

static bool decode_image(struct gn_gltf *g, const struct gn_at *at, const struct gn_blob *blob,
                         enum gn_scale_kind kind, struct gn_image *image, struct gn_err *err) {
    struct gn_picture_file file = {
        .kind = gn_format_of(blob->data, blob->size), .data = blob->data, .size = blob->size};
    uint32_t shrink;
    if (file.kind == GN_FORMAT_OTHER) return gn_fail(err, GN_FORMAT_OTHER_TEXT);
    if (!gn_picture_size(&file, err)) return false;
    if (file.px[0] == 0 || file.px[1] == 0) return gn_fail(err, "width or height is 0");
    uint64_t work = gn_gltf_picture_work(file.px) * gn_picture_cost(&file);
    const uint32_t part = take_part(g, at, &file, &work), all = least_level(g, file.px),
                   least = all > part ? all : part,
                   wanted = gn_gltf_halvings(file.px, g->limits.texture_px),
                   level = wanted > least ? wanted : least;
    struct gn_picture_need whole = need_of(&file, least, 0, &shrink);
    for (uint32_t i = 0; i < GN_HALVINGS; i++)
        whole.halved[i] = need_of(&file, least + 1 + i, 0, &shrink).decoding;
    struct gn_picture_need need = need_of(&file, level, gn_gltf_picture_room(g), &shrink);
    need.work = whole.work = work;
    if (part > 0) shrink = part;
    if (!gn_gltf_picture_fits(g, &need, &whole, err)) return false;
    if (all > 0 && wanted < all)
        gn_gltf_warn(g, at,
                     "%" PRIu32 "x%" PRIu32 " is over the limit texels=%" PRIu64
                     ": halved to %" PRIu32 "x%" PRIu32,
                     file.px[0], file.px[1], g->limits.texels, need.px[0], need.px[1]);
    uint8_t *rgba = gn_gltf_alloc(g, g->memory.scene, need.kept, 1);
    if (!rgba || !gn_gltf_check_time(g)) return false;
    if (!gn_picture_decode(&file, shrink, kind, rgba, need.px, err)) {
        gn_arena_undo(g->memory.scene, rgba, need.kept);
        g->damaged_work += need.work;
        return false;
    }
    gn_gltf_picture_count(g, &need);
    *image = (struct gn_image){.width_px = need.px[0], .height_px = need.px[1], .rgba = rgba};
    image->has_alpha = gn_packing_has_alpha(GN_PACKING_RGBA8, rgba, need.px);
    return true;
}

/* KTX2 whose levels or blocks go to the GPU as they are, or any picture as pixels; *basis: it
 * failed since it is Basis Universal's. */
static bool take_image(struct gn_gltf *g, const struct gn_at *at, const struct gn_blob *blob,
                       enum gn_scale_kind kind, struct gn_image *image, bool *basis,
                       struct gn_err *err) {
    struct gn_ktx2 ktx2;
    if (gn_format_of(blob->data, blob->size) != GN_FORMAT_KTX2)
        return decode_image(g, at, blob, kind, image, err);
    const bool known = gn_ktx2_open(blob->data, blob->size, &ktx2, err);
    *basis = ktx2.basis;
    if (!known) return false;
    if (ktx2.level_count == 1 && ktx2.packing == GN_PACKING_RGBA8)
        return decode_image(g, at, blob, kind, image, err);
    if (!gn_gltf_levels(g, blob, &ktx2, image, err)) return false;
    const uint32_t most = g->limits.texture_px;
    if (most > 0 && (image->width_px > most || image->height_px > most))
        gn_gltf_warn(g, at,
                     "%" PRIu32 "x%" PRIu32 " pixels, and no smaller level; larger than the limit "
                     "on textures of %" PRIu32,
                     image->width_px, image->height_px, most);
    return true;
}

/* The source of an image: bytes, or an open file of which only the identity is known. */
struct source {
    const char *uri;
    int fd; /* -1: blob is filled */
    struct gn_blob blob;
    uint64_t key[3]; /* of struct gn_picture; zeros: none can be the same */
};

static bool open_source(struct gn_gltf *g, const struct gn_at *at, struct source *source,
                        struct gn_err *err) {
    *source = (struct source){.uri = gn_at_text(g, at, "uri"), .fd = -1};
    const int32_t number = gn_at_ref(g, at, "bufferView", g->file.view_count, "bufferViews");
    if (g->failed) return false;
    if (source->uri && gn_data_uri_is(source->uri))
        return gn_uri_fetch(g, source->uri, &source->blob, err);
    if (source->uri) {
        struct stat info;
        source->fd = gn_uri_open(g, source->uri, err);
        if (source->fd < 0) return false;
        if (fstat(source->fd, &info) == 0)
            memcpy(source->key, (uint64_t[]){1, info.st_dev, info.st_ino}, sizeof source->key);
        return true;
    }
    if (number < 0) return gn_fail(err, "has neither uri nor bufferView");
    const struct gn_buffer_view *view = &g->file.views[number];
    if (!view->data) return gn_fail(err, "bufferView %d holds no data", number);
    source->blob = (struct gn_blob){.data = view->data, .size = view->size};
    memcpy(source->key, (uint64_t[]){2, (uintptr_t)view->data, view->size}, sizeof source->key);
    return true;
}

/* A file of gigabytes that is no picture is not read. */
static bool read_source(struct gn_gltf *g, struct source *source, struct gn_err *err) {
    if (source->fd < 0) return true;
    uint8_t head[GN_FORMAT_HEAD_BYTES];
    const ssize_t size = pread(source->fd, head, sizeof head, 0);
    const int fd = source->fd;
    source->fd = -1;
    if (size < 0 || gn_format_of(head, (size_t)size) != GN_FORMAT_OTHER)
        return gn_uri_read(g, fd, source->uri, &source->blob, err);
    close(fd);
    return gn_fail(err, GN_FORMAT_OTHER_TEXT);
}

/* The first image with the same source, or this one. */
static size_t first_image_of(struct gn_gltf *g, const struct source *source, size_t index) {
    if (!source->key[0]) return index;
    uint32_t *known = gn_table_find(&g->pictures.table, source->key);
    if (*known) return g->pictures.list[*known - 1].first;
    struct gn_picture *picture = &g->pictures.list[g->pictures.count++];
    memcpy(picture->key, source->key, sizeof picture->key);
    picture->first = index;
    *known = (uint32_t)g->pictures.count;
    return index;
}

/* A texture shows nothing but that image: the scene is refused where it says that it needs it. */
static void miss_basis(struct gn_gltf *g, int32_t index) {
    struct gn_at root = gn_at_root(g), images = gn_at_array(g, &root, "images");
    struct gn_at at = gn_at_item(g, &images, (size_t)index);
    g->is_missing[GN_MISSING_BASISU] = true;
    if (!gn_gltf_requires(g, "KHR_texture_basisu")) return;
    gn_gltf_fail(g, &at, "%s", GN_KTX2_BASIS);
    g->failed_part = false; /* nothing is shown without it */
}

/* The index of the scene's image for one of the file, or DROPPED or BASIS. other: the image that
 * the texture shows instead of one that cannot be read, or -1. */
static int32_t image_at(struct gn_gltf *g, int32_t index, int32_t other, enum gn_scale_kind kind) {
    if (g->to_scene.image[index] == BASIS && other < 0) miss_basis(g, index);
    if (g->to_scene.image[index] != UNSEEN) return g->to_scene.image[index];
    g->to_scene.image[index] = DROPPED;
    struct gn_scene_pictures *pictures = &g->scene->pictures;
    struct gn_at root = gn_at_root(g), images = gn_at_array(g, &root, "images");
    struct gn_at at = gn_at_item(g, &images, (size_t)index);
    struct source source;
    struct gn_err err = {0};
    bool basis = false;
    if (gn_gltf_check_time(g) && open_source(g, &at, &source, &err)) {
        const size_t first = first_image_of(g, &source, (size_t)index);
        if (first != (size_t)index) {
            g->to_scene.image[index] = g->to_scene.image[first];
            gn_fail(&err, "the same picture as images[%zu]", first);
        } else if (read_source(g, &source, &err) &&
                   take_image(g, &at, &source.blob, kind, &pictures->images[pictures->image_count],
                              &basis, &err))
            g->to_scene.image[index] = (int32_t)pictures->image_count++;
        if (basis) g->to_scene.image[index] = BASIS;
        if (source.fd >= 0) close(source.fd);
        gn_blob_finish(g, &source.blob);
        if (pictures->image_count <= g->file.image_count)
            gn_gltf_progress(g, pictures->image_count, g->file.image_count);
    }
    if (basis && other < 0) miss_basis(g, index);
    if (g->to_scene.image[index] < 0 && !g->failed && other >= 0)
        gn_gltf_warn(g, &at, "%s; images[%" PRId32 "] is shown instead", err.text, other);
    else if (g->to_scene.image[index] < 0 && !g->failed)
        gn_gltf_warn(g, &at, "%s; shown without this picture", err.text);
    return g->to_scene.image[index];
}

/* ---- textures ---- */

static enum gn_wrap read_wrap(struct gn_gltf *g, const struct gn_at *sampler, const char *key) {
    uint64_t value = gn_at_uint(g, sampler, key, 10497);
    struct gn_at at = gn_at_any(sampler, key);
    if (value == 33071) return GN_WRAP_CLAMP;
    if (value == 33648) return GN_WRAP_MIRROR;
    if (value != 10497)
        gn_gltf_warn(g, &at, "%" PRIu64 " is not a wrap mode; taken as REPEAT", value);
    return GN_WRAP_REPEAT;
}

static void read_sampler(struct gn_gltf *g, const struct gn_at *sampler,
                         struct gn_texture *texture) {
    enum {
        NEAREST = 9728,
        LINEAR = 9729,
        NEAREST_MIP_NEAREST = 9984,
        LINEAR_MIP_NEAREST,
        NEAREST_MIP_LINEAR,
        LINEAR_MIP_LINEAR
    };
    uint64_t mag = gn_at_uint(g, sampler, "magFilter", LINEAR);
    uint64_t min = gn_at_uint(g, sampler, "minFilter", LINEAR_MIP_LINEAR);
    bool known =
        min == NEAREST || min == LINEAR || (min >= NEAREST_MIP_NEAREST && min <= LINEAR_MIP_LINEAR);
    if (!known || (mag != NEAREST && mag != LINEAR))
        gn_gltf_warn(g, sampler, "unknown filter; taken as trilinear");
    texture->mag_nearest = mag == NEAREST;
    texture->min_nearest =
        min == NEAREST || min == NEAREST_MIP_NEAREST || min == NEAREST_MIP_LINEAR;
    texture->mipmaps = min != NEAREST && min != LINEAR;
    texture->mip_nearest = min == NEAREST_MIP_NEAREST || min == LINEAR_MIP_NEAREST;
    texture->wrap_s = read_wrap(g, sampler, "wrapS");
    texture->wrap_t = read_wrap(g, sampler, "wrapT");
}

static bool allocate_textures(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    if (g->to_scene.texture) return true;
    g->to_scene.texture = gn_gltf_alloc(g, &g->memory.load, g->file.texture_count, sizeof(int32_t));
    g->to_scene.image = gn_gltf_alloc(g, &g->memory.load, g->file.image_count, sizeof(int32_t));
    /* and for one more of each, which gltf/glossiness.c may make */
    GN_NEW(g, g->memory.scene, scene->pictures.textures, 2 * (uint64_t)g->file.texture_count);
    GN_NEW(g, g->memory.scene, scene->pictures.images,
           (uint64_t)g->file.image_count + g->file.texture_count);
    GN_NEW(g, &g->memory.load, g->pictures.list, g->file.image_count);
    if (g->failed) return false;
    g->pictures.table = (struct gn_table){.stride = sizeof *g->pictures.list,
                                          .key_size = sizeof g->pictures.list->key,
                                          .keys = (const char *)g->pictures.list};
    if (!gn_table_init(g, &g->pictures.table, g->file.image_count)) return false;
    for (size_t i = 0; i < g->file.texture_count; i++) g->to_scene.texture[i] = UNSEEN;
    for (size_t i = 0; i < g->file.image_count; i++) g->to_scene.image[i] = UNSEEN;
    return true;
}

/* The scene's image of a texture: that of an extension, else its own. */
static int32_t texture_image(struct gn_gltf *g, const struct gn_at *at, enum gn_scale_kind kind) {
    const struct gn_at webp = gn_at_object(g, at, "extensions.EXT_texture_webp");
    int32_t source = gn_at_ref(g, at, "source", g->file.image_count, "images"), image = -1;
    if (webp.json && (gn_webp_is_read() || source < 0))
        source = gn_at_ref(g, &webp, "source", g->file.image_count, "images");
    const int32_t ktx2 =
        gn_at_ref(g, at, "extensions.KHR_texture_basisu.source", g->file.image_count, "images");
    if (ktx2 >= 0 && !g->failed) image = image_at(g, ktx2, source, kind);
    if (image < 0 && source >= 0 && !g->failed) image = image_at(g, source, -1, kind);
    if (source < 0 && ktx2 < 0 && !g->failed)
        gn_gltf_warn(g, at, "has no source; shown without this texture");
    return g->failed ? -1 : image;
}

int32_t gn_gltf_texture(struct gn_gltf *g, int32_t index, enum gn_scale_kind kind) {
    if (g->failed || !allocate_textures(g)) return -1;
    if (g->to_scene.texture[index] != UNSEEN)
        return g->to_scene.texture[index] < 0 ? -1 : g->to_scene.texture[index];
    g->to_scene.texture[index] = DROPPED;
    struct gn_at root = gn_at_root(g), textures = gn_at_array(g, &root, "textures");
    struct gn_at samplers = gn_at_array(g, &root, "samplers");
    struct gn_at at = gn_at_item(g, &textures, (size_t)index);
    int32_t sampler = gn_at_spare_ref(g, &at, "sampler", gn_at_size(&samplers), "samplers");
    const int32_t image = texture_image(g, &at, kind);
    if (gn_gltf_spare(g, "shown without this texture") || image < 0) return -1;
    struct gn_at sampler_at =
        sampler < 0 ? (struct gn_at){0} : gn_at_element(&samplers, (size_t)sampler);
    struct gn_texture *texture = &g->scene->pictures.textures[g->scene->pictures.texture_count];
    texture->image = (uint32_t)image;
    read_sampler(g, &sampler_at, texture);
    gn_gltf_spare(g, "taken as trilinear and repeated");
    g->to_scene.texture[index] = (int32_t)g->scene->pictures.texture_count++;
    return g->to_scene.texture[index];
}
