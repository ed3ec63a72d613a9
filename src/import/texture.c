/* Textures: images embedded in the model or found in its folder, copied unchanged. */
#include <stdlib.h>
#include <string.h>

#include "import/private.h"

enum {
    NAME_BYTES = sizeof(((struct aiString *)NULL)->data)
}; /* the name of assimp's macro differs between versions */

struct request {
    char base[NAME_BYTES], opacity[NAME_BYTES]; /* file names, "" for none */
    int wrap[2];                                /* glTF wrap modes */
    bool opaque;                                /* ignore alpha */
    unsigned uv_set;
};

static bool get_texture(const struct aiMaterial *material, enum aiTextureType type, char *name,
                        struct request *request) {
    struct aiString path = {0};
    unsigned uv_set = 0, flags = 0;
    enum aiTextureMapMode wrap[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (aiGetMaterialTexture(material, type, 0, &path, NULL, &uv_set, NULL, NULL, wrap, &flags) !=
            aiReturn_SUCCESS ||
        !path.data[0])
        return false;
    memcpy(name, path.data, NAME_BYTES);
    name[NAME_BYTES - 1] = 0;
    if (name == request->base || !request->base[0]) {
        enum { REPEAT = 10497, CLAMP = 33071, MIRROR = 33648 };
        for (int k = 0; k < 2; k++)
            request->wrap[k] =
                wrap[k] == aiTextureMapMode_Clamp || wrap[k] == aiTextureMapMode_Decal ? CLAMP
                : wrap[k] == aiTextureMapMode_Mirror                                   ? MIRROR
                                                                                       : REPEAT;
        request->uv_set = uv_set;
        request->opaque = flags & aiTextureFlags_IgnoreAlpha;
    }
    return true;
}

static const char *last_part(const char *path) {
    const char *at = path;
    for (const char *c = path; *c; c++)
        if (*c == '/' || *c == '\\') at = c + 1;
    return at;
}

/* Reads an image; warns and fails unless it is a PNG or JPEG. */
static bool fetch_image(struct gn_import *import, const char *name, struct gn_bytes *bytes) {
    const char *model = import->opts->model;
    const unsigned count = import->scene->mNumTextures;
    struct aiTexture *const *all = import->scene->mTextures;
    const struct aiTexture *inside = NULL; /* embedded, by index ("*3") or by name */
    const unsigned long index = name[0] == '*' ? strtoul(name + 1, NULL, 10) : count;
    if (index < count) inside = all[index];
    for (unsigned i = 0; i < count && name[0] != '*' && !inside; i++)
        if (strcmp(last_part(all[i]->mFilename.data), last_part(name)) == 0) inside = all[i];
    *bytes = (struct gn_bytes){0};
    bool found = false;
    if (!inside)
        found = gn_import_folder_read(import, name, bytes);
    else if (inside->mHeight == 0 && inside->mWidth && inside->pcData) { /* a compressed file */
        found = true;
        bytes->size = inside->mWidth;
        bytes->data = gn_import_alloc(bytes->size);
        memcpy(bytes->data, inside->pcData, bytes->size);
    }
    if (!found)
        gn_warn(import->warnings,
                "%s: image %.100s not found in the model's folder; shown without it", model, name);
    else if (!gn_import_picture_type(bytes))
        gn_warn(import->warnings, "%s: image %.100s is not PNG or JPEG; shown without it", model,
                last_part(name));
    if (found && gn_import_picture_type(bytes)) return true;
    gn_bytes_finish(bytes);
    return false;
}

/* Writes the base image, the opacity map, or both merged; the caller adds the texture. */
static struct gn_import_texture make_image(struct gn_import *import,
                                           const struct request *request) {
    struct gn_import_texture made = {.image = -1};
    struct gn_bytes picture = {0}, opacity = {0}, both = {0};
    bool has_base = request->base[0] && fetch_image(import, request->base, &picture);
    bool has_opacity = request->opacity[0] && strcmp(request->base, request->opacity) != 0 &&
                       fetch_image(import, request->opacity, &opacity);
    if (has_opacity &&
        gn_import_picture_merge(import, has_base ? &picture : NULL, &opacity, &both)) {
        gn_bytes_finish(&picture);
        picture = both;
    } else if (has_opacity)
        gn_warn(import->warnings, "%s: image %.100s cannot be decoded; shown without it",
                import->opts->model, request->opacity);
    gn_bytes_finish(&opacity);
    if (picture.size) {
        int view = gn_glb_view(&import->glb, picture.data, picture.size);
        made.image =
            gn_glb_add(&import->glb, "images",
                       json_pack("{s:o,s:s,s:i}", "name", gn_glb_text(last_part(request->base)),
                                 "mimeType", gn_import_picture_type(&picture), "bufferView", view));
        made.alpha = gn_import_picture_alpha(import, &picture);
    }
    gn_bytes_finish(&picture);
    made.base = strdup(request->base);
    made.opacity = strdup(request->opacity);
    if (!made.base || !made.opacity) gn_import_no_memory();
    return made;
}

struct gn_import_texture gn_import_texture(struct gn_import *import,
                                           const struct aiMaterial *material,
                                           enum aiTextureType type, bool with_opacity,
                                           int *uv_set) {
    struct request request = {0};
    bool any = get_texture(material, type, request.base, &request);
    if (with_opacity)
        any |= get_texture(material, aiTextureType_OPACITY, request.opacity, &request);
    *uv_set = request.uv_set == 1 ? 1 : 0;
    if (!any) return (struct gn_import_texture){.index = -1};
    const struct gn_import_texture *known = NULL; /* the same image */
    for (size_t i = 0; i < import->texture_count; i++) {
        const struct gn_import_texture *t = &import->textures[i];
        if (strcmp(t->base, request.base) != 0 || strcmp(t->opacity, request.opacity) != 0)
            continue;
        known = t;
        if (t->wrap[0] == request.wrap[0] && t->wrap[1] == request.wrap[1] &&
            t->opaque == request.opaque)
            return *t;
    }
    struct gn_import_texture made = known ? *known : make_image(import, &request);
    memcpy(made.wrap, request.wrap, sizeof made.wrap);
    made.opaque = request.opaque;
    made.index = -1;
    if (made.image >= 0) {
        int sampler = gn_glb_add(&import->glb, "samplers",
                                 json_pack("{s:i,s:i,s:i,s:i}", "magFilter", 9729, "minFilter",
                                           9987, "wrapS", made.wrap[0], "wrapT", made.wrap[1]));
        made.index = gn_glb_add(&import->glb, "textures",
                                json_pack("{s:i,s:i}", "sampler", sampler, "source", made.image));
    }
    size_t count = ++import->texture_count;
    import->textures = gn_import_grow(import->textures, count * sizeof *import->textures);
    return import->textures[count - 1] = made;
}
