/* The scenes of `make book`: `make_book NAME OUT.glb`. Their configurations are book/NAME.ini. */
#include "book/book.h"

static const struct {
    const char *name;
    void (*make)(struct gn_book *book);
} scenes[] = {
    {"watch", gn_book_make_watch},       {"room", gn_book_make_room},
    {"carousel", gn_book_make_carousel}, {"foliage", gn_book_make_foliage},
    {"product", gn_book_make_product},   {"architecture", gn_book_make_architecture},
    {"studio", gn_book_make_studio},     {"window", gn_book_make_window},
};

int main(int argc, char **argv) {
    for (int i = 0; argc == 3 && i < GN_COUNT(scenes); i++) {
        if (strcmp(argv[1], scenes[i].name) != 0) continue;
        struct gn_book book = {
            .glb = gn_glb_create("gnomon assets", "CC0 1.0, the authors of gnomon")};
        scenes[i].make(&book);
        const bool ok = gn_glb_write(book.glb, argv[2]);
        gn_shape_finish(&book.shape);
        gn_glb_destroy(book.glb);
        return ok ? 0 : 1;
    }
    fprintf(stderr, "usage: make_book SCENE OUT.glb, where SCENE is one of");
    for (int i = 0; i < GN_COUNT(scenes); i++) fprintf(stderr, " %s", scenes[i].name);
    fprintf(stderr, "\n");
    return 2;
}
