#include "cost/gpu.h"

#include <stddef.h>
#include <string.h>

const struct gn_cost_gpu gn_cost_gpus[GN_COST_GPU_COUNT] = {
#define X(NAME, ...) [GN_COST_##NAME] = {__VA_ARGS__},
    GN_COST_GPUS(X)
#undef X
};

const struct gn_cost_gpu *gn_cost_gpu_of(const char *renderer) {
    static const struct {
        const char *begins;
        enum gn_cost_gpu_id id;
    } known[] = {{"V3D 4.2", GN_COST_PI4}, {"V3D 7.1", GN_COST_PI5}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strncmp(renderer, known[i].begins, strlen(known[i].begins)) == 0)
            return &gn_cost_gpus[known[i].id];
    return NULL;
}
