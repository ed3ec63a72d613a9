#include "frame/plan.h"

const struct gn_program_row gn_programs[GN_PROGRAM_KIND_COUNT] = {
#define X(NAME, name, vertex, fragment, pass, reads)                                               \
    {name, vertex, fragment, GN_PASS_##pass, reads},
    GN_PROGRAM_TABLE(X)
#undef X
};
