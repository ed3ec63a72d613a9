/* Whether a camera that the loader added has all in the picture: every vertex of every item, at
 * many times. */
#ifndef GN_TESTS_UNIT_FRAMING_HELP_H
#define GN_TESTS_UNIT_FRAMING_HELP_H

#include "scene/framing.h"

/* How far vertices reach from the middle of the picture at most, where 1 is its border; INFINITY: a
 * vertex is before the near plane or behind the far one. The last camera must be an added one. */
float help_framing_reach(const struct gn_scene *scene, int clips,
                         const struct gn_framing_opts *opts);

#endif
