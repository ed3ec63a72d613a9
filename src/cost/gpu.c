#include "cost/gpu.h"

const struct gn_cost_gpu gn_cost_gpus[GN_COST_GPU_COUNT] = {
#define X(NAME, ...) [GN_COST_##NAME] = {__VA_ARGS__},
    GN_COST_GPUS(X)
#undef X
};
