#include <math.h>

#include "import/private.h"

json_t *gn_import_matrix(const struct aiMatrix4x4 *m) {
    float values[16] = {m->a1, m->b1, m->c1, 0.0f, m->a2, m->b2, m->c2, 0.0f,
                        m->a3, m->b3, m->c3, 0.0f, m->a4, m->b4, m->c4, 1.0f};
    for (int i = 0; i < 16; i++)
        if (!isfinite(values[i])) values[i] = i % 5 == 0 ? 1.0f : 0.0f;
    return gn_glb_floats(values, 16);
}
