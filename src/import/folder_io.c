/* aiFileIO on the model's folder: the whole file is read when it is opened. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/private.h"

struct opened {
    struct aiFile file;
    struct gn_bytes bytes;
    size_t at;
};

static struct opened *opened_of(struct aiFile *file) {
    return (struct opened *)(void *)file->UserData;
}

static size_t read_some(struct aiFile *file, char *to, size_t size, size_t count) {
    struct opened *o = opened_of(file);
    size_t left = o->bytes.size - o->at, whole = size ? left / size : 0;
    if (count > whole) count = whole;
    memcpy(to, o->bytes.data + o->at, size * count);
    o->at += size * count;
    return count;
}

static size_t write_none(struct aiFile *file, const char *from, size_t size, size_t count) {
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t tell_file(struct aiFile *file) { return opened_of(file)->at; }

static size_t size_of(struct aiFile *file) { return opened_of(file)->bytes.size; }

static enum aiReturn seek_file(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    struct opened *o = opened_of(file);
    size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? o->at : o->bytes.size;
    size_t at = from + offset; /* a negative offset wraps round */
    if (at > o->bytes.size) return aiReturn_FAILURE;
    o->at = at;
    return aiReturn_SUCCESS;
}

static void flush_file(struct aiFile *file) { (void)file; }

/* assimp guesses names of other files: of those not found, only material files get a warning. */
static struct aiFile *open_file(struct aiFileIO *io, const char *name, const char *mode) {
    struct gn_import *import = (struct gn_import *)(void *)io->UserData;
    struct gn_bytes bytes;
    if (*mode != 'r') return NULL;
    const bool is_model = strcmp(name, import->name) == 0;
    const size_t length = strlen(name);
    const bool is_material = length > 4 && strcasecmp(name + length - 4, ".mtl") == 0;
    const bool found = is_model ? gn_import_model_read(import, &bytes, NULL)
                                : gn_import_folder_read(import, name, &bytes);
    if (!found) {
        if (is_material && !import->warned_materials)
            gn_warn(import->warnings,
                    "%s: material file %.100s not found in the model's folder; shown without it",
                    import->opts->model, gn_import_relative_name(import, name));
        import->warned_materials |= is_material;
        return NULL;
    }
    if (is_model && import->format == GN_MODEL_PLY) gn_import_ply_guard(&bytes);
    if (is_model && import->format == GN_MODEL_OBJ) gn_import_obj_pad(&bytes);
    if (!is_model && is_material)
        gn_import_mtl_clean(import, gn_import_relative_name(import, name), &bytes);
    struct opened *o = gn_import_alloc(sizeof *o);
    *o = (struct opened){.bytes = bytes};
    o->file = (struct aiFile){.ReadProc = read_some,
                              .WriteProc = write_none,
                              .TellProc = tell_file,
                              .FileSizeProc = size_of,
                              .SeekProc = seek_file,
                              .FlushProc = flush_file,
                              .UserData = (char *)o};
    return &o->file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    struct opened *o = opened_of(file);
    gn_bytes_finish(&o->bytes);
    free(o);
}

struct aiFileIO gn_import_folder_io(struct gn_import *import) {
    return (struct aiFileIO){
        .OpenProc = open_file, .CloseProc = close_file, .UserData = (char *)import};
}
