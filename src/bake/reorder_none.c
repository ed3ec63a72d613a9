#include "bake/reorder.h"

const struct gn_reorder *const gn_reorder = NULL;
