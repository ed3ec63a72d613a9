/* A build without libassimp. */
#include "import/import.h"

bool gn_import_scene_build(struct gn_import *import) {
    return gn_fail(import->err,
                   "%s: this gnomon-import was built without libassimp; export it as .glb",
                   import->opts->model);
}
